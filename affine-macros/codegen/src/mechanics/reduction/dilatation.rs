//! A mean stretch that moves by itself: it follows its closed form, and `Psi`, `det Psi = 1`, is left.
//!
//! Where the kinetic energy is isotropic up to a commuting rotation and `U = U_dil(q) + U_sh(Psi)`, what is left to integrate is
//! (Slawianowski et al., section 5)
//!
//! ```text
//! Psi' = Psi O  (co-moving)  or  O Psi  (spatial),   O = sigma/alpha,   sigma the traceless part of the affine spin
//! ```
//!
//! `O` itself is the state, split into symmetric and skew parts, so that no coefficient is left in `Psi'`.

use std::cmp::Ordering;

use crate::algebra::passage::{Constant, Extent, MatrixFunction, Passage, Statement, Tensor, Word};
use crate::algebra::ring::{pairs, table};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::body::Body;
use crate::mechanics::charts::{Chart, Coordinate, Momentum};
use crate::mechanics::equations::{Load, System};
use crate::mechanics::hamiltonian::Isotropic;
use crate::mechanics::loads::of_potential;
use crate::mechanics::separation::{Separation, Slope};
use crate::symbol::{Quantity, Symbol};

use super::left_out::{LeftOut, Scope};

/// The systems of a motion without its dilatation, in the charts that admit them; `turns` and `drifts` tell what else is split
/// off. None where the dilatation is coupled to anything.
pub(super) fn systems(
    arena: &mut Arena,
    body: &Body,
    turns: bool,
    drifts: bool,
) -> Vec<(Chart, Separation, System)> {
    let Some((iso, separation)) = separated(arena, body, turns, drifts) else { return Vec::new() };
    let system = |momentum| {
        let chart = Chart::new(arena, body.motion.dim(), momentum, None);
        let load = of_potential(arena, &chart, body.potential?, body.forces);
        let system = shear_system(arena, &chart, iso, &load)?;
        Some((chart, separation.clone(), system))
    };
    [Momentum::Body, Momentum::Space].into_iter().filter_map(system).collect()
}

/// The energy and the motion of the dilatation.
fn separated<'a>(
    arena: &mut Arena,
    body: &Body<'a>,
    turns: bool,
    drifts: bool,
) -> Option<(&'a Isotropic, Separation)> {
    let h = body.motion.hamiltonian()?;
    let iso = h.isotropic.as_ref()?;
    // Proved of potentials that are formulas alone: forces couple the dilatation to the rest, or are unknown.
    let alone =
        body.forces.is_empty() && (h.translation.is_none() || drifts) && (iso.skew.is_zero() || turns);
    // With C(3) the velocity is no multiple of the traceless momentum.
    if !alone || h.constraint.is_some() || !iso.casimir3.is_zero() {
        return None;
    }
    let slope = body.potential?.dilatational_slope(arena)?;
    Some((iso, Separation { slope, inverse_mass: iso.inverse_dilatational_mass(h.dim) }))
}

/// `rests` where `w` is conserved.
pub(super) fn left_out(motion: &Separation, chart: &Chart, rests: bool) -> Vec<LeftOut> {
    let path = match motion.slope {
        Slope::Zero => "moves freely",
        Slope::Linear(_) => "swings harmonically",
        Slope::Hyperbolic { .. } => "moves by an elliptic function",
    };
    let name = chart.momentum.symbol();
    let dilatation = Scope::Reduction.without(format!(
        "the dilatation: phi = e^q Psi with det Psi = 1, and q {path}; the state is Psi with O, the traceless part \
         of {name} over alpha, in parts O = s + w, symmetric and skew"
    ));
    [dilatation].into_iter().chain(rests.then(|| Scope::Reduction.without("w: conserved"))).collect()
}

/// `Psi`, the parts of `O`, and the closed form; `fixed` are parts that are constants.
pub(super) fn pass(motion: &Separation, n: usize, fixed: &[Symbol], passage: &mut Passage) {
    let [momentum, q, start, p_q] =
        [Word::Momentum, Word::MeanLogStretch, Word::Start, Word::DilatationalMomentum].map(Tensor::Variable);
    let placement = || Tensor::OfPoint(Quantity::Placement);
    let trace = momentum.clone().under(MatrixFunction::Trace);
    let path = MatrixFunction::Dilatation((&motion.slope).into());
    let path = Tensor::Applied(path, vec![start, q.clone(), trace, Tensor::OfDilatation]);
    let inverse_alpha = || Tensor::Factor(Quantity::InverseAlpha);
    let psi: Vec<Vec<Symbol>> = table(n, |i, a| Quantity::IsochoricPlacement.at([i + 1, a + 1]));
    let parts: Vec<Vec<Symbol>> = table(n, part);
    passage.inward.extend([
        Statement::Named(Word::MeanLogStretch, placement().under(MatrixFunction::MeanLogStretch)),
        Statement::Named(Word::Dilatation, path),
        Statement::Entries(psi.clone(), placement().under(MatrixFunction::Isochoric)),
        Statement::Entries(
            parts.clone(),
            Tensor::Applied(MatrixFunction::ShearAndTurn, vec![momentum, inverse_alpha()]),
        ),
    ]);
    let meaning = "The motion of `q = ln(det phi)/n` and its momentum `tr Sigma`.";
    passage.constants.push(Constant::new(Word::Dilatation, Extent::Dilatation, meaning));
    let at =
        Tensor::Applied(MatrixFunction::DilatationAt, vec![Tensor::Constant(Word::Dilatation), Tensor::Time]);
    let spread = Tensor::Matrix(psi).times(q.under(MatrixFunction::Exp));
    passage.outward.extend([
        Statement::Pair([Word::MeanLogStretch, Word::DilatationalMomentum], at),
        Statement::Named(Word::Placement, spread),
    ]);
    let known = Tensor::Constant(Word::Fixed);
    passage.outward.extend((!fixed.is_empty()).then(|| Statement::Listed(fixed.to_vec(), known)));
    let above = (0..n - 1).map(|a| part(a, a)).collect();
    let momentum =
        Tensor::Applied(MatrixFunction::FromShearAndTurn, vec![Tensor::Matrix(parts), inverse_alpha(), p_q]);
    passage.outward.extend([
        Statement::Symbol(part(n - 1, n - 1), Tensor::NegativeSum(above)),
        Statement::Named(Word::Momentum, momentum),
    ]);
}

/// The system of `Psi` and `O` in place of `phi` and an affine spin; `load` are the forces of the potential in the
/// chart, `casimirs` the kinetic energy without the rotation that commutes. `None` where the forces still depend on
/// the dilatation.
fn shear_system(arena: &mut Arena, chart: &Chart, casimirs: &Isotropic, load: &Load) -> Option<System> {
    let n = chart.dim;
    let psi = Matrix::symbols(arena, Quantity::IsochoricPlacement, n);
    let velocity = velocity(arena, n);
    let forces = forces(arena, chart, &psi, load);
    let mut system = System { shared: forces.shared.clone(), work: forces.work.clone(), ..System::default() };
    let o = Matrix::symbols(arena, Quantity::IsochoricVelocity, n);
    for (a, b) in pairs(n) {
        system.shared.push((o.0[a][b], velocity[a][b].clone()));
    }
    for (i, a) in pairs(n) {
        let product = |k: usize| match chart.momentum {
            Momentum::Space => [o.0[i][k], psi.0[k][a]],
            _ => [psi.0[i][k], o.0[k][a]],
        };
        let rate = (0..n).map(|k| Polynomial::monomial(product(k))).sum();
        system.rates.push((Coordinate::Phi(i, a), psi.0[i][a], rate));
    }
    let force = |a: usize, b: usize| forces.force(Coordinate::M(a, b));
    let nth = Rational::one_over(n);
    let half = Rational::HALF;
    let mean: Polynomial = (0..n).map(|a| force(a, a).scaled(&nth)).sum();
    for (a, b) in pairs(n) {
        let rate = match a.cmp(&b) {
            Ordering::Less => force(a, b).add(&force(b, a)).scaled(&half),
            Ordering::Equal => force(a, a).sub(&mean),
            Ordering::Greater => force(b, a).sub(&force(a, b)).scaled(&half),
        };
        let rate = rate.mul(&casimirs.casimir2);
        if (a, b) != (n - 1, n - 1) {
            system.rates.push((Coordinate::M(a, b), arena.symbol(part(a, b)), rate));
        }
    }
    let system = system.tidied(arena);
    let depends = |p: &Polynomial| {
        p.any_symbol(arena, &mut |s| arena.quantity(s).is_some_and(|quantity| UNDEFORMED.contains(&quantity)))
    };
    let depends = system.polynomials().any(depends);
    (!depends).then_some(system)
}

/// What is a constant at `det phi = 1`.
const UNDEFORMED: [Quantity; 5] = [
    Quantity::Determinant,
    Quantity::InverseDeterminant,
    Quantity::Dilatation,
    Quantity::InverseDilatation,
    Quantity::MeanLogStretch,
];

/// The forces at `q = 0` with `Psi` for `phi`. Where they do not depend on `q`, nor `U_dil` on the time, neither does their
/// power `dU/dt`.
fn forces(arena: &mut Arena, chart: &Chart, psi: &Matrix, load: &Load) -> Load {
    let value_at_rest = UNDEFORMED.map(|quantity| {
        let value = if quantity == Quantity::MeanLogStretch { Rational::ZERO } else { Rational::ONE };
        (arena.symbol(quantity), arena.constant(value))
    });
    let replaced: Vec<(Expr, Expr)> =
        pairs(chart.dim).map(|(i, a)| (chart.phi.0[i][a], psi.0[i][a])).chain(value_at_rest).collect();
    let is_undefined = |symbol: Expr| listed(&value_at_rest)(symbol).is_none();
    let mut at_rest = |form: &Polynomial| {
        let form = form.expression(arena);
        // Dilatations of a placement have no part in what vanishes.
        let form = arena.replaced(form, &listed(&replaced));
        Polynomial::normal_form(arena, form)
    };
    let shared = load.shared.iter().filter(|(symbol, _)| is_undefined(*symbol)).cloned().collect();
    let load = Load { shared, kernels: Vec::new(), ..load.clone() };
    load.mapped(&mut at_rest)
}

/// `O_ab` in its parts: `s_ab + w_ab`, `s_ab - w_ab`, `s_aa`, and the last diagonal entry from the trace.
fn velocity(arena: &mut Arena, n: usize) -> Vec<Vec<Polynomial>> {
    let mut symbol = |a, b| Polynomial::atom(arena.symbol(part(a, b)));
    table(n, |a, b| match a.cmp(&b) {
        Ordering::Less => symbol(a, b).add(&symbol(b, a)),
        Ordering::Equal if a + 1 < n => symbol(a, a),
        Ordering::Equal => (0..a).map(|c| symbol(c, c).neg()).sum(),
        Ordering::Greater => symbol(b, a).sub(&symbol(a, b)),
    })
}

/// The symbol of the symmetric part above the diagonal and on it, of the skew part `w_ba`, `b < a`, below.
fn part(a: usize, b: usize) -> Symbol {
    if a <= b { Quantity::Shear.at([a + 1, b + 1]) } else { Quantity::Turn.at([b + 1, a + 1]) }
}

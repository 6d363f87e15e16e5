//! The dilatation apart from the shear: `phi = e^q Psi`, `det Psi = 1`.
//!
//! Where the kinetic energy is isotropic up to a commuting rotation and `U = U_dil(q) + U_sh(Psi)`, the dilatation is
//! a motion of one degree of freedom that is known in closed form, and what is left to integrate is
//! (Slawianowski et al., section 5)
//!
//! ```text
//! Psi' = Psi O  (co-moving)  or  O Psi  (spatial),   O = sigma/alpha,   sigma the traceless part of the affine spin
//! ```
//!
//! `O` itself is the state, split into symmetric and skew parts, so that no coefficient is left in `Psi'`.

use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::symbol::Quantity;

use super::charts::{Chart, Coordinate, Momentum};
use super::equations::{Load, System};
use super::hamiltonian::Isotropic;

/// The motion of `q` with its momentum `p = tr Sigma`.
#[derive(Clone, Debug)]
pub struct Separation {
    /// `U_dil'`.
    pub slope: Slope,
    /// `1/m = 1/(n (I + A + n B))`.
    pub inverse_mass: Polynomial,
}

/// Derivatives `U_dil'(q)` under which `q'' = -U_dil'(q)/m` has a closed form.
#[derive(Clone, Debug, PartialEq)]
pub enum Slope {
    /// `0`
    Zero,
    /// `stiffness q`
    Linear(Polynomial),
    /// `stiffness sinh(2 scale q)/(2 scale)`
    Hyperbolic {
        /// `U_dil''(0)`.
        stiffness: Polynomial,
        /// Half the power of `D`.
        scale: Rational,
    },
}

impl Slope {
    /// `U_dil'` as an expression in `q`, `D` and `1/D`.
    pub(super) fn derivative(&self, arena: &mut Arena) -> Option<Expr> {
        let [q, up, down] =
            arena.symbols([Quantity::MeanLogStretch, Quantity::Dilatation, Quantity::InverseDilatation]);
        match self {
            Self::Zero => Some(arena.constant(Rational::ZERO)),
            Self::Linear(stiffness) => {
                let stiffness = stiffness.expression(arena);
                arena.product(&[(stiffness, 1), (q, 1)])
            }
            Self::Hyperbolic { stiffness, scale } => {
                // stiffness (D^j - D^-j)/(2 j), j = 2 scale.
                let j = i32::try_from((scale * &Rational::from(2)).to_i64()?).ok()?;
                let weight = Rational::ratio(1, 2 * i64::from(j))?;
                let (up, down) = (arena.pow(up, j)?, arena.pow(down, j)?);
                let difference = arena.linear(&[(up, weight.clone()), (down, -&weight)]);
                let stiffness = stiffness.expression(arena);
                arena.product(&[(stiffness, 1), (difference, 1)])
            }
        }
    }

    /// Reads `U_dil'` off a polynomial in `q`, `D` and `1/D` with coefficients in parameters.
    pub(super) fn of(arena: &mut Arena, slope: &Polynomial) -> Option<Self> {
        let powers = powers(arena, slope)?;
        // Not time, nor q inside other functions.
        if powers.iter().any(|(_, c)| c.any_symbol(arena, &mut |s| !arena.is_parameter(s))) {
            return None;
        }
        match powers.as_slice() {
            [] => Some(Self::Zero),
            [((1, 0), stiffness)] => Some(Self::Linear(stiffness.clone())),
            [((0, low), lower), ((0, high), upper)] if *low == -*high => {
                sum(lower, upper, &Rational::ONE).is_zero().then(|| Self::hyperbolic(upper, *high))?
            }
            _ => None,
        }
    }

    /// The stiffest slope with a closed form among the terms of a polynomial in `q`, `D`, `1/D` and anything else. Only what
    /// binds the dilatation is taken: what drives it apart is not stiff, and would leave in a finite time without the rest.
    pub(super) fn stiffest_in(arena: &mut Arena, slope: &Polynomial) -> Option<Self> {
        let powers = powers(arena, slope)?;
        let mut found: Option<(_, Self)> = None;
        for (key, coefficient) in &powers {
            let binding = match *key {
                (1, 0) => binding(arena, coefficient, None),
                (0, 1..) => {
                    let opposite = powers.iter().find(|(other, _)| *other == (0, -key.1));
                    opposite.map_or_else(Polynomial::zero, |(_, c)| binding(arena, coefficient, Some(c)))
                }
                _ => continue,
            };
            let one = match *key {
                _ if binding.is_zero() => continue,
                (0, power) => Self::hyperbolic(&binding, power)?,
                _ => Self::Linear(binding),
            };
            let stiffness = one.stiffness_by_fields();
            if found.as_ref().is_none_or(|(most, _)| *most <= stiffness) {
                found = Some((stiffness, one));
            }
        }
        found.map(|(_, slope)| slope)
    }

    /// `upper (D^j - D^-j) = 2 upper sinh(j q)`, `j = 2 scale`.
    fn hyperbolic(upper: &Polynomial, j: i64) -> Option<Self> {
        let scale = Rational::ratio(j, 2)?;
        Some(Self::Hyperbolic { stiffness: upper.scaled(&Rational::from(2 * j)), scale })
    }

    /// Is the stiffness set by fields, whose values may be of any size, and what is it where they are all 1?
    fn stiffness_by_fields(&self) -> (bool, Rational) {
        let (Self::Linear(stiffness) | Self::Hyperbolic { stiffness, .. }) = self else {
            return (false, Rational::ZERO);
        };
        let size = stiffness.terms().fold(Rational::ZERO, |size, (_, weight)| &size + weight);
        (stiffness.as_constant().is_none(), size)
    }
}

/// A slope by the powers of `q` and `D`, in their order.
type Powers = Vec<((usize, i64), Polynomial)>;

fn powers(arena: &mut Arena, slope: &Polynomial) -> Option<Powers> {
    let [q, up, down] =
        arena.symbols([Quantity::MeanLogStretch, Quantity::Dilatation, Quantity::InverseDilatation]);
    let mut powers = Powers::new();
    for (monomial, weight) in slope.terms() {
        let count = |symbol: Expr| monomial.iter().filter(|atom| **atom == symbol).count();
        let power = i64::try_from(count(up)).ok()? - i64::try_from(count(down)).ok()?;
        let key = (count(q), power);
        let rest = monomial.iter().copied().filter(|atom| ![q, up, down].contains(atom)).collect();
        let rest = Polynomial::term(rest, weight.clone());
        match powers.iter_mut().find(|(known, _)| *known == key) {
            Some((_, sum)) => sum.add_scaled(&rest, &Rational::ONE),
            None => powers.push((key, rest)),
        }
    }
    powers.retain(|(_, coefficient)| !coefficient.is_zero());
    powers.sort_by_key(|(key, _)| *key);
    Some(powers)
}

/// The terms in parameters alone that are positive and, where an opposite is asked for, as much of them as it has with the
/// other sign.
fn binding(arena: &Arena, coefficient: &Polynomial, opposite: Option<&Polynomial>) -> Polynomial {
    let mut part = Polynomial::zero();
    for (monomial, weight) in coefficient.terms() {
        if monomial.iter().any(|atom| arena.any_symbol(*atom, &mut |s| !arena.is_parameter(s))) {
            continue;
        }
        let against = |(_, w): (_, &Rational)| -w;
        let limit = opposite.map(|o| o.terms().find(|(m, _)| *m == monomial).map_or(Rational::ZERO, against));
        let weight = limit.map_or_else(|| weight.clone(), |limit| weight.clone().min(limit));
        if weight > Rational::ZERO {
            part.add_term(monomial.clone(), &weight);
        }
    }
    part
}

/// The system of `Psi` and `O` in place of `phi` and an affine spin; `load` are the forces of the potential in the
/// chart, `casimirs` the kinetic energy without the rotation that commutes. `None` where the forces still depend on
/// the dilatation.
pub(super) fn shear_system(
    arena: &mut Arena,
    chart: &Chart,
    casimirs: &Isotropic,
    load: &Load,
) -> Option<System> {
    let n = chart.dim;
    let psi = Matrix::symbols(arena, Quantity::IsochoricPlacement, n);
    let velocity = velocity(arena, n);
    let forces = forces(arena, chart, &psi, load);
    let mut system = System { shared: forces.shared, work: forces.work, ..System::default() };
    let o = Matrix::symbols(arena, Quantity::IsochoricVelocity, n);
    for (a, b) in pairs(n) {
        system.shared.push((o.0[a][b], velocity[a][b].clone()));
    }
    for (i, a) in pairs(n) {
        let mut rate = Polynomial::zero();
        for k in 0..n {
            let product = match chart.momentum {
                Momentum::Space => vec![o.0[i][k], psi.0[k][a]],
                _ => vec![psi.0[i][k], o.0[k][a]],
            };
            rate.add_term(product, &Rational::ONE);
        }
        system.rates.push((Coordinate::Phi(i, a), psi.0[i][a], rate));
    }
    let force = |a: usize, b: usize| {
        let found = forces.forces.iter().find(|(z, _)| *z == Coordinate::M(a, b));
        found.map_or_else(Polynomial::zero, |(_, force)| force.clone())
    };
    let nth = Rational::one_over(n);
    let half = Rational::HALF;
    let mut mean = Polynomial::zero();
    (0..n).for_each(|a| mean.add_scaled(&force(a, a), &nth));
    for (a, b) in pairs(n) {
        let mut rate = match (a < b, a == b) {
            (true, _) => sum(&force(a, b), &force(b, a), &Rational::ONE).scaled(&half),
            (_, true) => sum(&force(a, a), &mean, &Rational::MINUS_ONE),
            _ => sum(&force(b, a), &force(a, b), &Rational::MINUS_ONE).scaled(&half),
        };
        rate = rate.mul(&casimirs.casimir2);
        if (a, b) != (n - 1, n - 1) {
            system.rates.push((Coordinate::M(a, b), part(arena, a, b), rate));
        }
    }
    let system = system.tidied(arena);
    let depends = |p: &Polynomial| {
        p.any_symbol(arena, &mut |s| arena.quantity(s).is_some_and(|quantity| UNDEFORMED.contains(&quantity)))
    };
    let free =
        !system.shared.iter().any(|(_, p)| depends(p)) && !system.rates.iter().any(|(.., p)| depends(p));
    free.then_some(system)
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
    let value = |atom: Expr| replaced.iter().find(|(s, _)| *s == atom).map(|(_, value)| *value);
    let defined = |symbol: Expr| value_at_rest.iter().any(|(s, _)| *s == symbol);
    let mut at_rest = |form: &Polynomial| {
        let form = form.expression(arena);
        // Dilatations of a placement have no part in what vanishes.
        let form = arena.replaced(form, &value);
        Polynomial::normal_form(arena, form)
    };
    let shared = load.shared.iter().filter(|(symbol, _)| !defined(*symbol));
    Load {
        shared: shared.map(|(symbol, form)| (*symbol, at_rest(form))).collect(),
        forces: load.forces.iter().map(|(z, form)| (*z, at_rest(form))).collect(),
        work: load.work.as_ref().map(|(symbol, power)| (*symbol, at_rest(power))),
        ..Load::default()
    }
}

/// `O_ab` in its parts: `s_ab + w_ab`, `s_ab - w_ab`, `s_aa`, and the last diagonal entry from the trace.
fn velocity(arena: &mut Arena, n: usize) -> Vec<Vec<Polynomial>> {
    let mut rows = vec![vec![Polynomial::zero(); n]; n];
    for (a, b) in pairs(n) {
        let symbol = |arena: &mut Arena, a, b| Polynomial::atom(part(arena, a, b));
        rows[a][b] = match (a < b, a == b) {
            (true, _) => sum(&symbol(arena, a, b), &symbol(arena, b, a), &Rational::ONE),
            (_, true) if a + 1 < n => symbol(arena, a, a),
            (_, true) => {
                let mut rest = Polynomial::zero();
                (0..a).for_each(|c| rest.add_scaled(&symbol(arena, c, c), &Rational::MINUS_ONE));
                rest
            }
            _ => sum(&symbol(arena, b, a), &symbol(arena, a, b), &Rational::MINUS_ONE),
        };
    }
    rows
}

/// The symbol of the symmetric part above the diagonal and on it, of the skew part `w_ba`, `b < a`, below.
fn part(arena: &mut Arena, a: usize, b: usize) -> Expr {
    if a <= b {
        arena.symbol(Quantity::Shear.at([a + 1, b + 1]))
    } else {
        arena.symbol(Quantity::Turn.at([b + 1, a + 1]))
    }
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |a| (0..n).map(move |b| (a, b)))
}

fn sum(left: &Polynomial, right: &Polynomial, weight: &Rational) -> Polynomial {
    let mut sum = left.clone();
    sum.add_scaled(right, weight);
    sum
}

impl Isotropic {
    /// `1/m` of `p^2/(2 m)`, the energy of the dilatational momentum `p = tr Sigma`: `1/(n alpha) + 1/beta`.
    pub(super) fn inverse_dilatational_mass(&self, n: usize) -> Polynomial {
        let nth = Rational::one_over(n);
        sum(&self.casimir2.scaled(&nth), &self.casimir1_squared, &Rational::ONE)
    }
}

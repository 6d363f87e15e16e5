//! Isotropic potentials on the principal axes: `phi = L D R^T` has the potential of `D`.

use crate::algebra::ring::pairs;
use crate::algebra::{Arena, Expr, Function, Polynomial, Rational};
use crate::mechanics::metric::Definitions;
use crate::mechanics::symmetry::Side;
use crate::mechanics::two_polar::{Lattice, Variables};
use crate::symbol::Quantity;

use super::Potential;
use super::base::Base;
use super::counting::{Counting, Forms};
use super::rewriting::through_dilatation;
use super::sums::Sums;

/// A potential as a function of the places of a lattice.
#[derive(Clone, Debug)]
pub struct OnAxes {
    /// What the forces share.
    pub shared: Definitions,
    /// `-dU/dq_a` or `-dU/dQ_a`.
    pub forces: Vec<Polynomial>,
    /// `U`, counted from the undeformed state, with what it shares.
    pub energy: (Polynomial, Definitions),
    /// The same for places far from it, where that differs.
    pub energy_far_away: Option<(Polynomial, Definitions)>,
}

impl Potential {
    /// The first rotation that changes the potential: its side and plane, axes from 1.
    pub fn anisotropy(&self) -> Option<(Side, (usize, usize))> {
        let turned = |side| self.invariance.changed_by(side).map(|(a, b)| (side, (a + 1, b + 1)));
        turned(Side::Space).or_else(|| turned(Side::Body))
    }

    /// Does it depend on `q = ln(det phi)/n` alone?
    pub fn is_dilatational(&self) -> bool {
        self.slopes.iter().all(|(base, _)| *base == Base::MeanLogStretch)
    }

    /// Does it depend on `q_1, .., q_n` alone?
    pub fn is_of_places(&self) -> bool {
        let is_place = |base: &Base| matches!(base, Base::LogStretch(_) | Base::MeanLogStretch);
        self.slopes.iter().all(|(base, _)| is_place(base)) && !self.depends_on_time()
    }

    /// The potential on the principal axes, where it is isotropic: off-diagonal entries of tensors are zero there.
    pub fn on_axes(&self, arena: &mut Arena, lattice: &Lattice) -> OnAxes {
        let stretches: Vec<Expr> = arena.components(Quantity::Stretches, self.dim);
        let diagonal = |arena: &mut Arena, expr: Expr| {
            let zeros = off_diagonal(arena, self.dim);
            let zero = arena.constant(Rational::ZERO);
            // An isotropic function that is smooth has no pole on the axes.
            arena.replaced(expr, &|e| zeros.contains(&e).then_some(zero))
        };
        let mut axes = OnAxes {
            shared: Vec::new(),
            forces: vec![Polynomial::zero(); self.dim],
            energy: (Polynomial::zero(), Vec::new()),
            energy_far_away: None,
        };
        let mut sums = Sums::of_slopes();
        for (base, slope) in &self.slopes {
            let form = diagonal(arena, *slope);
            let form = through_dilatation(arena, form);
            let form = sums.named(arena, form);
            let form = Polynomial::normal_form(arena, form).scaled(&base.weight(self.dim));
            let moves = form.any_symbol(arena, &mut |s| !arena.is_parameter(s));
            let symbol = arena.symbol(base.slope());
            let slope = if moves { Polynomial::atom(symbol) } else { form.clone() };
            if moves {
                axes.shared.push((symbol, form));
            }
            for (a, force) in axes.forces.iter_mut().enumerate() {
                let step = along_axis(arena, *base, lattice.variables, &stretches, a);
                force.add_product(&slope, &step, &Rational::ONE);
            }
        }
        axes.shared.extend(sums.forms(arena));
        let definitions = definitions(arena, lattice, &stretches);
        axes.shared.extend(definitions.iter().cloned());
        let written = diagonal(arena, self.energy);
        let mut shared = Vec::new();
        let counting = counted_from_undeformed(arena, lattice, &mut shared);
        let energy = Forms::new(arena, &[written]);
        let near = energy.counted(arena, &counting);
        axes.energy = (near.values.iter().sum(), [shared, near.sums, definitions.clone()].concat());
        // Angles have no volume to be far away by.
        if lattice.variables == Variables::Angles {
            return axes;
        }
        if let Some((value, sums)) = self.far_away(arena, written) {
            let unit = unit_definitions(arena, &stretches);
            axes.energy_far_away = Some((value, [unit, sums, definitions].concat()));
        } else if energy.lose_small(arena, &counting) {
            axes.energy_far_away = Some((energy.values.iter().sum(), [definitions, energy.sums].concat()));
        }
        axes
    }
}

impl OnAxes {
    /// Forces on SL(n), where the sum of the momenta vanishes: each less their mean.
    pub fn keep_volume(&mut self) {
        let sum: Polynomial = self.forces.iter().sum();
        let mean = sum.scaled(&Rational::one_over(self.forces.len()));
        self.forces.iter_mut().for_each(|force| force.add_scaled(&mean, &Rational::MINUS_ONE));
    }
}

/// Symbols of entries beside the diagonal.
fn off_diagonal(arena: &mut Arena, n: usize) -> Vec<Expr> {
    let bases = |(a, b)| [Base::Green(a, b), Base::Finger(a, b), Base::Placement(a, b)];
    let pairs = pairs(n).filter(|(a, b)| a != b);
    pairs.flat_map(bases).map(|base| base.symbol(arena)).collect()
}

/// The derivative of a base function by a place, divided by the number that its slope carries.
fn along_axis(
    arena: &mut Arena,
    base: Base,
    variables: Variables,
    stretches: &[Expr],
    a: usize,
) -> Polynomial {
    // d/dQ = (1/Q) d/dq
    let less = usize::from(variables == Variables::Stretches);
    let mut power = |exponent: usize, number: i64| match exponent.checked_sub(less) {
        Some(exponent) => Polynomial::term(vec![stretches[a]; exponent], Rational::from(number)),
        // A symbol is not the number zero.
        None => Polynomial::atom(arena.reciprocal(stretches[a])),
    };
    match base {
        Base::MeanLogStretch => power(0, 1),
        Base::LogStretch(k) if k == a => power(0, 1),
        Base::Trace(_) => power(base.degree(), 1),
        Base::Green(c, d) | Base::Finger(c, d) if c == a && d == a => power(2, 2),
        Base::Placement(c, d) if c == a && d == a => power(1, 1),
        // The others do not move with this place.
        _ => Polynomial::zero(),
    }
}

/// Base functions through the places.
fn definitions(arena: &mut Arena, lattice: &Lattice, stretches: &[Expr]) -> Definitions {
    let n = lattice.dim;
    let nth = Rational::one_over(n);
    let (mut list, mut squares) = (Vec::new(), Vec::new());
    for (a, stretch) in stretches.iter().enumerate() {
        let inverse = arena.symbol(Quantity::InverseStretch.at([a + 1]));
        // A symbol is not the number zero.
        list.push((inverse, Polynomial::atom(arena.reciprocal(*stretch))));
        let square = arena.symbol(Quantity::StretchSquared.at([a + 1]));
        list.push((square, Polynomial::monomial([*stretch, *stretch])));
        squares.push(Polynomial::atom(square));
        for base in [Base::Green(a, a), Base::Finger(a, a)] {
            list.push((base.symbol(arena), Polynomial::atom(square)));
        }
        list.push((Base::Placement(a, a).symbol(arena), Polynomial::atom(*stretch)));
    }
    list.extend(traces(arena, Base::symbol, &squares));
    let [q, d, inverse_d] =
        arena.symbols([Quantity::MeanLogStretch, Quantity::Dilatation, Quantity::InverseDilatation]);
    match lattice.variables {
        Variables::LogStretches | Variables::Angles => {
            let mut mean = Polynomial::zero();
            for (place, stretch) in lattice.q.iter().zip(stretches) {
                mean.add_term(vec![*place], &nth);
                list.push((*stretch, Polynomial::atom(arena.apply(Function::Exp, *place))));
            }
            list.push((q, mean));
            list.push((d, Polynomial::atom(arena.apply(Function::Exp, q))));
            let opposite = arena.neg(q);
            list.push((inverse_d, Polynomial::atom(arena.apply(Function::Exp, opposite))));
        }
        Variables::Stretches => {
            let det = arena.symbol(Quantity::Determinant);
            list.push((det, Polynomial::term(stretches.to_vec(), Rational::ONE)));
            let root = arena.apply(if n == 2 { Function::Sqrt } else { Function::Cbrt }, det);
            list.push((d, Polynomial::atom(root)));
            list.push((inverse_d, Polynomial::atom(arena.reciprocal(d))));
            list.push((q, Polynomial::term(vec![arena.apply(Function::Ln, det)], nth)));
            for (a, stretch) in stretches.iter().enumerate() {
                let own = Base::LogStretch(a).symbol(arena);
                list.push((own, Polynomial::atom(arena.apply(Function::Ln, *stretch))));
            }
        }
    }
    list
}

/// `Psi`, `phi = D Psi`, its tensors and traces.
fn unit_definitions(arena: &mut Arena, stretches: &[Expr]) -> Definitions {
    let d = arena.symbol(Quantity::Dilatation);
    // A symbol is not the number zero.
    let inverse = arena.reciprocal(d);
    let (mut list, mut squares) = (Vec::new(), Vec::new());
    for (a, stretch) in stretches.iter().enumerate() {
        let unit = Base::Placement(a, a).unit(arena);
        list.push((unit, Polynomial::monomial([inverse, *stretch])));
        let square = Polynomial::monomial([unit, unit]);
        list.extend([Base::Green(a, a), Base::Finger(a, a)].map(|base| (base.unit(arena), square.clone())));
        squares.push(square);
    }
    list.extend(traces(arena, Base::unit, &squares));
    list
}

/// `tr G^k = sum (1 + f_a)^k` multiplied out, with `f_a = Q_a^2 - 1` free of cancellation near `Q_a = 1`.
fn counted_from_undeformed(arena: &mut Arena, lattice: &Lattice, shared: &mut Definitions) -> Counting {
    let (mut list, mut squares) = (Vec::new(), Vec::new());
    for (a, place) in lattice.q.iter().enumerate() {
        let strain = arena.symbol(Quantity::Strain.at([a + 1]));
        let value = match lattice.variables {
            Variables::LogStretches | Variables::Angles => {
                let twice = arena.scale(*place, &Rational::from(2));
                Polynomial::atom(arena.apply(Function::ExpM1, twice))
            }
            Variables::Stretches => {
                let one = arena.constant(Rational::ONE);
                let factors = [arena.sub(*place, one), arena.add(*place, one)];
                // The product stays one: its factors are exact near 1.
                let names = [Quantity::LessOne, Quantity::MoreOne].map(|of| arena.symbol(of.at([a + 1])));
                for (name, factor) in names.iter().zip(factors) {
                    shared.push((*name, Polynomial::normal_form(arena, factor)));
                }
                Polynomial::term(names.to_vec(), Rational::ONE)
            }
        };
        shared.push((strain, value));
        let square = Polynomial::constant(Rational::ONE).add(&Polynomial::atom(strain));
        for base in [Base::Green(a, a), Base::Finger(a, a)] {
            list.push((base.symbol(arena), square.clone()));
        }
        squares.push(square);
    }
    list.extend(traces(arena, Base::symbol, &squares));
    Counting::new(arena, lattice.dim, list, &Rational::MINUS_ONE)
}

/// `tr G^k`, the sums of powers of these `Q_a^2`, by their names.
fn traces(arena: &mut Arena, name: fn(Base, &mut Arena) -> Expr, squares: &[Polynomial]) -> Definitions {
    let mut powers = vec![Polynomial::constant(Rational::ONE); squares.len()];
    let mut trace = |base: Base| {
        powers.iter_mut().zip(squares).for_each(|(power, square)| *power = power.mul(square));
        (name(base, arena), powers.iter().sum())
    };
    Base::TRACES.map(&mut trace).into()
}

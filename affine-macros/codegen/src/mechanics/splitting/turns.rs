//! The flow of one momentum `l = <E, M>` at a constant rate `s`: `phi -> phi exp(h s E)` and its like.
//!
//! The exponential is finite where the minimal polynomial of `E` is short, as it is for every square of
//! `1/2 tr(X^T J^-1 X)` and for rotations about axes. With `x = h s`
//!
//! ```text
//! E^2 = tr(E) E     exp(x E) = 1 + g E             g = (exp(x tr E) - 1)/tr E, x for a shear
//! E^3 = k E         exp(x E) = 1 + u E + v E^2     u = sinh(x sqrt k)/sqrt k, v = (cosh(x sqrt k) - 1)/k; sin and cos for k < 0
//! ```
//!
//! What else there is has a series. Shears whose products vanish are one shear.

use crate::algebra::kernel::{Callee, Group};
use crate::algebra::ring::{self, multiple, pairs};
use crate::algebra::{Arena, Expr, Kernel, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::equations::{Form, System};
use crate::mechanics::kinetics::Kinetics;
use crate::mechanics::reduction::Reduction;
use crate::symbol::Quantity;

use super::flows::{Flow, confined, expanded, generator, turns_along};
use super::summand::over_the_state;

type Square = ring::Square<Polynomial>;

/// `phi' = s phi E` or `s E phi`, and `M` along with it.
pub(super) struct Turn {
    /// The symbol of `s`, and its value.
    rate: (Expr, Polynomial),
    /// `E`, with the sign of its flow.
    direction: Square,
    /// Does it stand on the right?
    right: bool,
}

/// The flows of turns that commute.
pub(super) fn flows(arena: &mut Arena, reduction: &Reduction, turns: &[Turn]) -> Option<Vec<Flow>> {
    match turns.iter().all(|one| turns.iter().all(|other| one.vanishes_times(other))) {
        true => Some(vec![sheared(arena, reduction, turns)?]),
        false => turns.iter().map(|turn| turn.flow(arena, reduction)).collect(),
    }
}

impl Turn {
    /// Along the momentum `l`; `None` where its equations are no exponential.
    pub(super) fn of(
        arena: &mut Arena,
        reduction: &Reduction,
        l: &Polynomial,
        rate: (Expr, Polynomial),
    ) -> Option<Self> {
        let chart = &reduction.chart;
        let system = expanded(Kinetics::polynomial(arena, chart, l).system(Form::Expanded));
        let system = over_the_state(arena, reduction, system)?;
        let (direction, right) = generator(chart, &system)?;
        turns_along(chart, &system, &direction, right).then_some(Self { rate, direction, right })
    }

    fn vanishes_times(&self, other: &Self) -> bool {
        ring::product(&self.direction, &other.direction).iter().flatten().all(Polynomial::is_zero)
    }

    /// `s E`.
    fn generator(&self) -> Square {
        multiple(&self.direction, &Polynomial::atom(self.rate.0))
    }

    fn flow(&self, arena: &mut Arena, reduction: &Reduction) -> Option<Flow> {
        let square = ring::product(&self.direction, &self.direction);
        let trace = ring::trace(&self.direction);
        if square == multiple(&self.direction, &trace) {
            return self.elongated(arena, reduction, &trace);
        }
        let k = ring::trace(&square).scaled(&Rational::HALF);
        if ring::product(&square, &self.direction) == multiple(&self.direction, &k) {
            return self.turned(arena, reduction, (&square, &k));
        }
        let (shared, generator) = (vec![self.rate.clone()], self.generator());
        Some(Flow::Exponential { shared, generator, right: self.right, turns_momentum: true })
    }

    /// `1 + g E`, and `1 + d E` back.
    fn elongated(&self, arena: &mut Arena, reduction: &Reduction, trace: &Polynomial) -> Option<Flow> {
        let [g, d] = arena.symbols([Quantity::Growth, Quantity::FlowDecay]);
        let kernel = self.kernel(arena, Callee::Elongation, trace, [g, d]);
        let factors = [g, d].map(|factor| multiple(&self.direction, &Polynomial::atom(factor)));
        let along_an_axis = self.direction.iter().flatten().filter(|entry| !entry.is_zero()).count() == 1;
        let known = along_an_axis.then(|| trace.as_constant()?.recip()).flatten().map(|reciprocal| {
            // 1 + g tr E and 1 + d tr E are reciprocals. Beside a small trace the sum would lose digits.
            let mut sum = Polynomial::atom(g);
            sum.add_term(vec![d], &Rational::ONE);
            ([g, d], sum.scaled(&-&reciprocal))
        });
        self.rise((arena, reduction), kernel, &factors, known)
    }

    /// `1 + u E + v E^2`, and `1 - u E + v E^2` back.
    fn turned(
        &self,
        arena: &mut Arena,
        reduction: &Reduction,
        (square, k): (&Square, &Polynomial),
    ) -> Option<Flow> {
        let [u, v] = arena.symbols([Quantity::Sine, Quantity::Versine]);
        let kernel = self.kernel(arena, Callee::Turn, k, [u, v]);
        let factors = [Rational::ONE, Rational::MINUS_ONE].map(|sign| {
            let odd = multiple(&self.direction, &Polynomial::atom(u).scaled(&sign));
            ring::sum(&odd, &multiple(square, &Polynomial::atom(v)))
        });
        // u^2 = 2 v + k v^2: both ways undo each other.
        let mut known = k.mul(&Polynomial::monomial([v, v]));
        known.add_term(vec![v], &Rational::from(2));
        self.rise((arena, reduction), kernel, &factors, Some(([u, u], known)))
    }

    /// `(h s, parameter) -> results`.
    fn kernel(
        &self,
        arena: &mut Arena,
        callee: Callee,
        parameter: &Polynomial,
        results: [Expr; 2],
    ) -> Kernel {
        let h = arena.symbol(Quantity::TimeOfFlow);
        let extent = Polynomial::monomial([h, self.rate.0]);
        let arguments = [extent, parameter.clone()].map(Group::Scalar).to_vec();
        Kernel { callee, arguments, results: results.map(Group::Scalar).to_vec() }
    }

    /// The flow with the increments `factors` there and back; a product of two symbols is `known`: rounded, it would
    /// move the momentum that is conserved.
    fn rise(
        &self,
        (arena, reduction): (&Arena, &Reduction),
        kernel: Kernel,
        factors: &[Square; 2],
        known: Option<([Expr; 2], Polynomial)>,
    ) -> Option<Flow> {
        let chart = &reduction.chart;
        let mut rates = rises(chart, factors, self.right);
        if let Some((product, value)) = &known {
            rates.iter_mut().for_each(|(.., rise)| *rise = replaced(rise, *product, value));
            rates.retain(|(.., rise)| !rise.is_zero());
        }
        let system = System { shared: vec![self.rate.clone()], kernels: vec![kernel], rates, work: None };
        over_the_state(arena, reduction, confined(chart, system)).map(Flow::Rise)
    }
}

/// The flow of momenta whose `E` have no products: `exp(Y) = 1 + Y`.
fn sheared(arena: &mut Arena, reduction: &Reduction, turns: &[Turn]) -> Option<Flow> {
    let generator = turns.iter().map(Turn::generator).reduce(|sum, y| ring::sum(&sum, &y))?;
    let h = Polynomial::atom(arena.symbol(Quantity::TimeOfFlow));
    let factors = [Rational::ONE, Rational::MINUS_ONE].map(|sign| multiple(&generator, &h.scaled(&sign)));
    let rates = rises(&reduction.chart, &factors, turns.first()?.right);
    let shared = turns.iter().map(|turn| turn.rate.clone()).collect();
    let system = System { shared, rates, ..System::default() };
    over_the_state(arena, reduction, confined(&reduction.chart, system)).map(Flow::Rise)
}

/// The increments of `phi` and `M` by `1 + there` and its inverse `1 + back`.
fn rises(chart: &Chart, [there, back]: &[Square; 2], right: bool) -> Vec<(Coordinate, Expr, Polynomial)> {
    let (phi, m) = (chart.placement(), chart.m.atoms());
    let placed = if right { ring::product(&phi, there) } else { ring::product(there, &phi) };
    let (before, after) = if right { (back, there) } else { (there, back) };
    // (1 + before) M (1 + after) - M
    let first = ring::product(before, &m);
    let second = ring::product(&ring::sum(&m, &first), after);
    let turned = ring::sum(&first, &second);
    let mut rates = Vec::new();
    for (a, b) in pairs(chart.dim) {
        for (z, rise) in [(Coordinate::Phi(a, b), &placed[a][b]), (Coordinate::M(a, b), &turned[a][b])] {
            if !rise.is_zero() {
                rates.push((z, chart.symbol(z), rise.clone()));
            }
        }
    }
    rates
}

/// With `value` for the product of two symbols, which it contains at most once.
fn replaced(polynomial: &Polynomial, [one, other]: [Expr; 2], value: &Polynomial) -> Polynomial {
    let mut factor = polynomial.derivative(one).derivative(other);
    if one == other {
        factor = factor.scaled(&Rational::HALF);
    }
    let mut sum = polynomial.clone();
    sum.add_product(&factor, &Polynomial::monomial([one, other]), &Rational::MINUS_ONE);
    sum.add_product(&factor, value, &Rational::ONE);
    sum
}

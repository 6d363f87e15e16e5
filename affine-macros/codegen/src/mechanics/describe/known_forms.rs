//! Matrix forms that the derived components are compared with.

use super::hamiltonian::pulled_back_momentum;
use super::{Notation, Sentence, Sum, Summand, momentum, velocity};
use crate::algebra::ring::{self, Square, difference, outer, times, transpose};
use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Linear};
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::notation::{commutator, letters, placement, product, slope};
use crate::mechanics::term::Frame;

/// A matrix or vector formula with its components.
pub(super) struct Known {
    pub(super) value: Sentence,
    pub(super) shape: Shape,
    pub(super) components: Vec<Polynomial>,
}

/// What the constraints have to know of a formula.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Zero,
    /// `[X, O]` of a momentum and a velocity: in the algebra where both are.
    Commutator,
    Other,
}

/// Balance laws of section 4 and (3.1), as candidates to compare the derived equations with.
pub(super) fn known_forms(
    arena: &mut Arena,
    notation: &Notation,
    h: &Hamiltonian,
    chart: &Chart,
    o: &Square<Polynomial>,
) -> Vec<Known> {
    let n = chart.dim;
    let (phi, m) = (chart.placement(), chart.m.atoms());
    let p = Polynomial::vector(&chart.p);
    let commutators = Commutators::of(chart);
    let omega = || Sentence::from(velocity(chart.momentum));
    let mut known = Vec::new();
    let mut add = |shape: Shape, value: Sentence, components: Vec<Polynomial>| {
        known.push(Known { value, shape, components });
    };
    add(Shape::Zero, Sum::default().value(), vec![Polynomial::zero(); n]);
    add(Shape::Zero, Sum::default().value(), vec![Polynomial::zero(); n * n]);
    let [comoving, spatial] =
        [ring::product(&phi, o), ring::product(o, &phi)].map(|velocity| velocity.concat());
    add(Shape::Other, product([letters::PLACEMENT.into(), omega()]), comoving);
    add(Shape::Other, product([omega(), letters::PLACEMENT.into()]), spatial);
    let canonical = slope(letters::HAMILTONIAN, letters::CANONICAL_MOMENTUM).transposed();
    add(Shape::Other, canonical, o.concat());
    let (xo, ox) = (ring::product(&m, o), ring::product(o, &m));
    add(Shape::Commutator, commutators.body, difference(&xo, &ox).concat());
    add(Shape::Commutator, commutators.space, difference(&ox, &xo).concat());
    if let Some((frame, inverse_mass)) = &h.translation {
        known.extend(translation(arena, notation, chart, (*frame, inverse_mass), [&phi, &m, o], &p));
    }
    known
}

/// Those that the energy `|p_hat|^2/(2 m)` or `|p|^2/(2 m)` of the centre of mass has.
fn translation(
    arena: &mut Arena,
    notation: &Notation,
    chart: &Chart,
    (frame, inverse_mass): (Frame, &Polynomial),
    [phi, m, o]: [&Square<Polynomial>; 3],
    p: &[Polynomial],
) -> Vec<Known> {
    let n = chart.dim;
    let comoving = chart.linear == Some(Linear::Body);
    let ph: Vec<Polynomial> = if comoving { p.to_vec() } else { times(&transpose(phi), p) };
    let scaled = |v: &[Polynomial]| -> Vec<Polynomial> { v.iter().map(|c| c.mul(inverse_mass)).collect() };
    // rest + coefficient * body
    let mut sum =
        |rest: Option<Sentence>, weight: &Polynomial, body: Sentence, components: Vec<Polynomial>| {
            let mut sum = Sum::new(rest.map(Summand::plus));
            sum.add(arena, notation, weight, body);
            Known { value: sum.value(), shape: Shape::Other, components }
        };
    let one = Polynomial::constant(Rational::ONE);
    let minus = inverse_mass.neg();
    let spatial = || Sentence::from(letters::LINEAR_MOMENTUM);
    // p_hat, or phi^T p where p is the momentum of the chart.
    let pulled = || if comoving { letters::COMOVING_LINEAR_MOMENTUM.into() } else { pulled_back_momentum() };
    let turned = product([
        Sentence::from(velocity(chart.momentum)).transposed(),
        letters::COMOVING_LINEAR_MOMENTUM.into(),
    ]);
    let mut list = vec![
        sum(None, inverse_mass, spatial(), scaled(p)),
        sum(None, inverse_mass, product([placement(), pulled()]), scaled(&times(phi, &ph))),
        sum(None, &one, turned, times(&transpose(o), p)),
    ];
    if frame == Frame::Body {
        let (xo, ox) = (ring::product(m, o), ring::product(o, m));
        let commutators = Commutators::of(chart);
        let zero = vec![vec![Polynomial::zero(); n]; n];
        let body = difference(&difference(&xo, &ox), &outer(&scaled(&ph), &ph));
        let space = difference(&difference(&ox, &xo), &outer(&scaled(&times(phi, &ph)), p));
        let flat = difference(&zero, &outer(&scaled(&ph), p));
        let thrust = product([pulled(), pulled().transposed()]);
        let on_flat = product([pulled_back_momentum(), spatial().transposed()]);
        let on_space = product([placement(), on_flat.clone()]);
        list.extend([
            sum(Some(commutators.body), &minus, thrust, body.concat()),
            sum(Some(commutators.space), &minus, on_space, space.concat()),
            sum(None, &minus, on_flat, flat.concat()),
        ]);
    }
    list
}

/// `[X, O]` and `[O, X]` of momentum and velocity.
struct Commutators {
    body: Sentence,
    space: Sentence,
}

impl Commutators {
    fn of(chart: &Chart) -> Self {
        let (x, o) = (momentum(chart.momentum), velocity(chart.momentum));
        Self { body: commutator(x.clone(), o), space: commutator(o, x) }
    }
}

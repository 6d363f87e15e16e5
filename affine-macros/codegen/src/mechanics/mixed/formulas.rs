//! A mixed energy and its equations as formulas.

use crate::algebra::{Arena, Polynomial};
use crate::mechanics::charts::Chart;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::describe::{Notation, Sentence, Sum, Summand, projection};
use crate::mechanics::forces::Forces;
use crate::mechanics::notation::{half, letters, placement, product, rate, slope, trace};
use crate::mechanics::potential::Potential;
use crate::mechanics::term::Frame;

use super::Masses;
use super::laws::{Law, law};

/// Names of the forces that no potential has, on `p` and on `Pi`.
#[derive(Default)]
pub struct ForceNames {
    on_linear: Vec<Summand>,
    on_affine: Vec<Summand>,
}

impl ForceNames {
    /// Those of a chart.
    pub fn of(chart: &Chart, forces: &Forces) -> Self {
        let mut names = Self::default();
        forces.name_on(chart, &mut names.on_linear, &mut names.on_affine);
        names
    }
}

/// The laws of the parts in words.
struct Laws {
    own: Vec<Sentence>,
    momentum: Sentence,
    rate: Sum,
}

impl Laws {
    /// Those of parts in the velocities of some frames, on a group or on all placements.
    fn of(frames: &[Frame], confined: bool) -> Self {
        let laws: Vec<&Law> = frames.iter().map(|frame| law(*frame, confined)).collect();
        let momentum = Sum::new(laws.iter().map(|law| Summand::plus((law.momentum)())));
        let rate = Sum::new(laws.iter().filter_map(|law| law.rate).map(|rate| rate()));
        let own = laws.iter().filter_map(|law| law.own).map(|(name, value)| value().of(name)).collect();
        Self { own, momentum: momentum.value(), rate }
    }
}

/// `H` through the velocities.
pub fn hamiltonian(
    arena: &mut Arena,
    notation: &Notation,
    (internal, definitions): (Sentence, Vec<Sentence>),
    masses: &Masses,
    potential: Option<&Potential>,
    forces: &Forces,
) -> Sentence {
    let mut sum = Sum::new([Summand::plus(internal)]);
    if !masses.are_none() {
        let power = product([Sentence::from(letters::LINEAR_MOMENTUM).transposed(), rate(letters::CENTRE)]);
        sum.push(Summand::plus(half(arena, power)));
    }
    if let Some(u) = potential {
        sum.add_expression(arena, notation, u.energy);
    }
    sum.extend(forces.potentials().into_iter().map(Summand::plus));
    sum.of(letters::HAMILTONIAN).with(definitions).with(forces.definitions(arena, notation))
}

/// The kinetic energy of the internal motion, through velocity and momentum.
pub fn internal_energy(arena: &mut Arena, confined: bool) -> Sentence {
    let factors = match confined {
        false => [Sentence::from(letters::CANONICAL_MOMENTUM), rate(letters::PLACEMENT)],
        true => [letters::COMOVING_AFFINE_SPIN, letters::COMOVING_AFFINE_VELOCITY].map(Sentence::from),
    };
    half(arena, trace(product(factors)))
}

/// The Legendre transformation and the balance of `Pi`, in the parts that the energy has.
pub fn internal_equations(
    arena: &mut Arena,
    notation: &Notation,
    frames: &[Frame],
    (masses, potential): (&Masses, Option<&Potential>),
    names: &ForceNames,
) -> Vec<Sentence> {
    let Laws { own: mut list, momentum, rate: mut force } = Laws::of(frames, false);
    if masses.body.is_some() {
        let mut sum = Sum::new([Summand::plus(letters::LINEAR_MOMENTUM)]);
        let [_, space] = masses.of_body_and_space(arena);
        sum.add(arena, notation, &space.neg(), rate(letters::CENTRE));
        let own = sum.value().transposed();
        force.push(Summand::minus(product([placement().inverse(), rate(letters::CENTRE), own])));
    }
    force.extend(potential.map(|_| Summand::plus(letters::CANONICAL_FORCE)));
    force.extend(names.on_affine.iter().cloned());
    let momentum = momentum.of(letters::CANONICAL_MOMENTUM);
    list.push(Sentence::Solved(Box::new(momentum), Box::new(rate(letters::PLACEMENT))));
    list.push(force.of(rate(letters::CANONICAL_MOMENTUM)));
    if potential.is_some() {
        let push = slope(letters::POTENTIAL, letters::PLACEMENT).transposed();
        list.push(Sum::new([Summand::minus(push)]).of(letters::CANONICAL_FORCE));
    }
    list
}

/// The Legendre transformation on a group and the balance of `Sigma_hat`, in the parts that the energy has.
pub fn confined_equations(
    arena: &mut Arena,
    notation: &Notation,
    frames: &[Frame],
    group: Constraint,
    (masses, potential): (&Masses, Option<&Potential>),
    names: &ForceNames,
) -> Vec<Sentence> {
    let Laws { own: mut list, momentum, rate: mut force } = Laws::of(frames, true);
    let [mass, _] = masses.of_body_and_space(arena);
    let v = || Sentence::from(letters::COMOVING_CENTRE_VELOCITY);
    force.add(arena, notation, &mass.neg(), product([v(), v().transposed()]));
    force.extend(potential.map(|_| Summand::plus(letters::COMOVING_AFFINE_FORCE)));
    force.extend(names.on_affine.iter().cloned());
    let projected = |of: Sentence| Sentence::Applied(letters::PROJECTION, vec![of]);
    let [spin, velocity] = [letters::COMOVING_AFFINE_SPIN, letters::COMOVING_AFFINE_VELOCITY];
    list.push(Sentence::Solved(Box::new(projected(momentum).of(spin)), Box::new(velocity.into())));
    list.push(product([placement(), velocity.into()]).of(rate(letters::PLACEMENT)));
    list.push(projected(force.value()).of(rate(spin)));
    list.push(projection(group));
    if potential.is_some() {
        let push = slope(letters::POTENTIAL, letters::PLACEMENT).transposed();
        let force = Summand::minus(product([push, placement()]));
        list.push(Sum::new([force]).of(letters::COMOVING_AFFINE_FORCE));
    }
    list
}

/// The velocity of the centre of mass; `None` where it does not move.
fn centre_velocity(arena: &mut Arena, notation: &Notation, masses: &Masses) -> Option<Sentence> {
    let p = || Sentence::from(letters::LINEAR_MOMENTUM);
    let pulled = || [placement().transposed(), p()];
    let mut sum = Sum::default();
    let (mass, of) = match (masses.body, masses.space) {
        (None, None) => return None,
        (Some(mass), None) => (mass, product([placement(), product(pulled())])),
        (None, Some(mass)) => (mass, p()),
        (Some(_), Some(_)) => {
            let [body, space] = masses.of_body_and_space(arena);
            sum.add(arena, notation, &space, letters::GREEN);
            // A multiple of the identity.
            sum.add_number(arena, notation, &body);
            let velocity = product([placement(), sum.value().inverse(), product(pulled())]);
            return Some(velocity.of(rate(letters::CENTRE)));
        }
    };
    let inverse = arena.reciprocal(mass);
    let inverse = Polynomial::normal_form(arena, inverse);
    sum.add(arena, notation, &inverse, of);
    Some(sum.of(rate(letters::CENTRE)))
}

/// The velocity of the centre of mass and the balance of `p`.
pub fn centre_equations(
    arena: &mut Arena,
    notation: &Notation,
    (masses, potential): (&Masses, Option<&Potential>),
    names: &ForceNames,
) -> Vec<Sentence> {
    let Some(velocity) = centre_velocity(arena, notation, masses) else { return Vec::new() };
    let pull = potential.filter(|u| u.moves_the_centre());
    let pull = pull.map(|_| Summand::minus(slope(letters::POTENTIAL, letters::CENTRE)));
    let force = Sum::new(pull.into_iter().chain(names.on_linear.iter().cloned()));
    vec![velocity, force.of(rate(letters::LINEAR_MOMENTUM))]
}

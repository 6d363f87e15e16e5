//! Generated code against exact values, for every family, on random models at random states.

use affine_oracle::{Matrix as Exact, Random, State};
use affine_runtime::model::{Group, StateVector};
use affine_runtime::prelude::*;

use crate::dual::Dual;
use crate::families::{Family, Parameters};
use crate::reference::{Reference, assert_close, entries, exact_state, norm};
use crate::tolerances::CANONICAL;

/// Models per family and dimension.
const SAMPLES: u64 = 10;
/// Time of the start.
pub(crate) const T0: f64 = 0.25;

/// The random sources of the samples: all families draw the same numbers.
fn sources() -> impl Iterator<Item = Random> {
    (0..SAMPLES).map(|seed| Random::new(418 + seed))
}

#[test]
fn parameters_are_as_bad_as_they_should() {
    for n in [2, 3] {
        let models: Vec<Parameters> =
            sources().map(|mut random| Parameters::random(n, &mut random)).collect();
        let indefinite = models.iter().filter(|model| model.is_indefinite()).count();
        assert!(3 * indefinite >= models.len(), "{indefinite} of {} for n = {n}", models.len());
        let extremes: Vec<[f64; 2]> = models.iter().map(Parameters::extremes).collect();
        let most = |value: fn(&[f64; 2]) -> f64| extremes.iter().map(value).fold(0.0, f64::max);
        let condition = most(|[least, largest]| largest / least);
        assert!((3e2..1e4).contains(&condition), "condition {condition:e}");
        assert!(
            most(|[_, largest]| *largest) > 1e2 && most(|[least, _]| least.recip()) > 1e2,
            "{extremes:?}"
        );
    }
}

/// The components of a plain array, group after group.
pub(crate) fn groups<'a, T>(layout: &'static [Group], array: &'a [T]) -> Vec<(&'static str, &'a [T])> {
    let mut rest = array;
    let parts = layout.iter().map(|group| {
        let (part, after) = rest.split_at(group.len);
        rest = after;
        (group.name, part)
    });
    let parts: Vec<_> = parts.collect();
    assert!(rest.is_empty(), "the layout covers the array");
    parts
}

/// A random state, and with translation the special ones that a turn of space has to deal with: `p = 0`, `p` along
/// an axis.
fn states<const N: usize, F: Family<N>>(random: &mut Random) -> Vec<State> {
    let state = F::random_state(random);
    if !F::TRANSLATION {
        return vec![state];
    }
    let along = |axis: usize, length: f64| {
        let mut p = [0.0; N];
        p[axis] = length;
        State { p: Exact::from_f64("p", N, 1, &p).unwrap(), ..state.clone() }
    };
    vec![along(0, -1.5), along(N - 1, 0.5), state.at_rest(), state]
}

/// Velocities, energies, Hamilton's equations and the way back from velocities.
fn agrees_with_the_oracle<const N: usize, F: Family<N>>() {
    for mut random in sources() {
        let (model, kinetic) = F::with(&Parameters::random(N, &mut random));
        let state = F::random_state(&mut random);
        let reference = Reference::new(&kinetic, &state);
        let point = model.at(&state);

        let velocity = model.velocity(&point);
        reference.assert_rate("x", velocity.x_dot.as_slice(), CANONICAL);
        reference.assert_rate("phi", &entries(&velocity.phi_dot), CANONICAL);

        let energy = |what, found: f64| {
            let tolerance = CANONICAL * reference.condition;
            assert_close(
                what,
                &[found],
                &[reference.expected.hamiltonian],
                reference.energy_size(),
                tolerance,
            );
        };
        energy("H", model.hamiltonian(T0, &point));
        energy("T", model.kinetic_energy(point.phi(), &velocity));

        let full = model.flatten(&point);
        let rates = model.hamilton_equations(0.0, &full);
        for (name, rate) in groups(F::DESCRIPTION.full, rates.as_ref()) {
            reference.assert_rate(name, rate, CANONICAL);
        }

        let back = model.at_velocity(point.x(), *point.phi(), &velocity);
        let tolerance = CANONICAL * reference.condition;
        let (p, pi) = (state.p.to_f64(), state.pi.to_f64());
        assert_close("p of velocity", back.p().as_slice(), &p, norm(&p), tolerance);
        assert_close("Pi of velocity", &entries(&back.pi().0.0), &pi, norm(&pi), tolerance);
        assert_eq!((back.x(), back.phi()), (point.x(), point.phi()));
    }
}

/// `unflatten` undoes `flatten`, `expand` undoes `reduce`; the derivative of `expand` along the reduced equations is
/// the exact vector field.
fn reduction_keeps_the_motion<const N: usize, F: Family<N>>() {
    for mut random in sources() {
        let (model, kinetic) = F::with(&Parameters::random(N, &mut random));
        for state in states::<N, F>(&mut random) {
            let point = model.at(&state);
            let tolerance = CANONICAL * kinetic.condition(&state.phi).unwrap();
            assert_charts_lead_back(&model, &point, &state, tolerance);
            assert_reduced_equations_move(&model, &point, CANONICAL, |_, state| {
                Reference::new(&kinetic, state)
            });
        }
    }
}

/// `point` is that of `state`.
pub(crate) fn assert_charts_lead_back<const N: usize, M: Model<N>>(
    model: &M,
    point: &M::Point<f64>,
    state: &State,
    tolerance: f64,
) {
    let (reduced, constants) = model.reduce(T0, point);
    for back in [model.unflatten(&model.flatten(point)), model.expand(T0, &constants, &reduced)] {
        for (what, found, expected) in [
            ("x", back.x().as_slice().to_vec(), state.x.to_f64()),
            ("phi", entries(back.phi()), state.phi.to_f64()),
            ("p", back.p().as_slice().to_vec(), state.p.to_f64()),
            ("Pi", entries(&back.pi().0.0), state.pi.to_f64()),
        ] {
            assert_close(what, &found, &expected, norm(&expected), tolerance);
        }
    }
}

/// Of everything a point has, in every frame; at a time away from the start, by which the pieces that commute have
/// moved the point. There the reduced state of the start stands for another point, as good as any; `reference` is the
/// exact motion through it.
pub(crate) fn assert_reduced_equations_move<const N: usize, M: Model<N>>(
    model: &M,
    start: &M::Point<f64>,
    tolerance: f64,
    reference: impl FnOnce(f64, &State) -> Reference,
) {
    // Rotations by angles of order 1.
    let t = T0 + 0.75 * start.phi().norm() / model.velocity(start).phi_dot.norm();
    let (reduced, constants) = model.reduce(T0, start);
    let spin = M::DESCRIPTION.full.last().unwrap().name;
    let reference = reference(t, &exact_state(spin, &model.expand(t, &constants, &reduced)));

    let mut full = M::Full::<Dual>::zeros();
    for (dual, value) in full.as_mut().iter_mut().zip(model.flatten(start).as_ref()) {
        *dual = Dual::fixed(*value);
    }
    let (mut reduced, constants) = model.reduce(Dual::fixed(T0), &model.unflatten(&full));
    let now = Dual { value: t, slope: 1.0 };
    let rates = model.reduced_equations(now, &constants, &reduced);
    for (state, rate) in reduced.as_mut().iter_mut().zip(rates.as_ref()) {
        state.slope = rate.value;
    }
    let moving = model.expand(now, &constants, &reduced);
    let slopes = |values: &[Dual]| values.iter().map(|dual| dual.slope).collect::<Vec<_>>();
    for (name, found) in [
        ("x", slopes(moving.x().as_slice())),
        ("phi", slopes(&entries(moving.phi()))),
        ("p", slopes(moving.p().as_slice())),
        ("p_hat", slopes(moving.p_hat().0.0.as_slice())),
        ("Sigma", slopes(&entries(&moving.sigma().0.0))),
        ("Sigma_hat", slopes(&entries(&moving.sigma_hat().0.0))),
        ("Pi", slopes(&entries(&moving.pi().0.0))),
    ] {
        reference.assert_rate(name, &found, tolerance);
    }
}

mod full {
    use super::agrees_with_the_oracle;
    each_family!(agrees_with_the_oracle);
}

mod reduced {
    use super::reduction_keeps_the_motion;
    each_family!(reduction_keeps_the_motion);
}

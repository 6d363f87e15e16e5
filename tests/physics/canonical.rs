//! Generated code against exact values, for every family, on random models at random states.

use affine_oracle::Random;
use affine_runtime::model::{Group, StateVector};
use affine_runtime::prelude::*;

use crate::dual::Dual;
use crate::families::{Family, Parameters};
use crate::reference::{Reference, assert_close, entries, exact_state, norm};
use crate::tolerances::CANONICAL;

/// Models per family and dimension.
const SAMPLES: u64 = 6;

/// The random sources of the samples: all families draw the same numbers.
fn sources() -> impl Iterator<Item = Random> {
    (0..SAMPLES).map(|seed| Random::new(418 + seed))
}

#[test]
fn parameters_are_indefinite_and_ill_conditioned_often_enough() {
    for n in [2, 3] {
        let models: Vec<Parameters> = sources().map(|mut random| Parameters::random(n, &mut random)).collect();
        let indefinite = models.iter().filter(|model| model.is_indefinite()).count();
        assert!(3 * indefinite >= models.len(), "{indefinite} of {} for n = {n}", models.len());
    }
}

/// The components of a plain array, group after group.
fn groups<'a, T>(layout: &'static [Group], array: &'a [T]) -> Vec<(&'static str, &'a [T])> {
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
    let along = |axis, sign| State { p: Exact::unit(N, axis, 0).rows(0, N).scaled(&sign), ..state.clone() };
    vec![along(0, rational(-3, 2)), along(N - 1, rational(1, 2)), state.at_rest(), state]
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
            assert_close(what, &[found], &[reference.expected.hamiltonian], reference.energy_size(), tolerance);
        };
        energy("H", model.hamiltonian(&point));
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

/// `unflatten` undoes `flatten`, `expand` undoes `reduce`.
fn charts_lead_back<const N: usize, F: Family<N>>() {
    for mut random in sources() {
        let (model, kinetic) = F::with(&Parameters::random(N, &mut random));
        let state = F::random_state(&mut random);
        let tolerance = CANONICAL * kinetic.condition(&state.phi).unwrap();
        let point = model.at(&state);
        let (reduced, constants) = model.reduce(0.25, &point);
        for back in [model.unflatten(&model.flatten(&point)), model.expand(0.25, &constants, &reduced)] {
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
}

/// The derivative of `expand` along the reduced equations is the exact vector field at the expanded point: of
/// everything a point has, in every frame, at a time away from the start, where what commutes has moved the point.
fn reduced_equations_move_the_point<const N: usize, F: Family<N>>() {
    for mut random in sources() {
        let (model, kinetic) = F::with(&Parameters::random(N, &mut random));
        let point = model.at(&F::random_state(&mut random));
        let velocity = model.velocity(&point);
        // Rotations by angles of order 1.
        let elapsed = 0.75 * point.phi().norm() / velocity.phi_dot.norm();

        let mut full = F::Full::<Dual>::zeros();
        for (dual, value) in full.as_mut().iter_mut().zip(model.flatten(&point).as_ref()) {
            *dual = Dual::fixed(*value);
        }
        let (mut reduced, constants) = model.reduce(Dual::fixed(0.25), &model.unflatten(&full));
        let t = Dual { value: 0.25 + elapsed, slope: 1.0 };
        let rates = model.reduced_equations(t, &constants, &reduced);
        for (state, rate) in reduced.as_mut().iter_mut().zip(rates.as_ref()) {
            state.slope = rate.value;
        }
        let moving = model.expand(t, &constants, &reduced);

        let (plain_reduced, plain_constants) = model.reduce(0.25, &point);
        let expanded = model.expand(t.value, &plain_constants, &plain_reduced);
        let spin = F::DESCRIPTION.full.last().unwrap().name;
        let reference = Reference::new(&kinetic, &exact_state(spin, &expanded));
        let slopes = |values: &[Dual]| values.iter().map(|dual| dual.slope).collect::<Vec<_>>();
        for (name, found) in [
            ("x", slopes(moving.x().as_slice())),
            ("phi", slopes(&entries(moving.phi()))),
            ("p", slopes(moving.p().as_slice())),
            ("p_hat", slopes(moving.p_hat().0.0.as_slice())),
            ("sigma", slopes(&entries(&moving.sigma().0.0))),
            ("sigma_hat", slopes(&entries(&moving.sigma_hat().0.0))),
            ("pi", slopes(&entries(&moving.pi().0.0))),
        ] {
            reference.assert_rate(name, &found, CANONICAL);
        }
    }
}

mod full {
    use super::agrees_with_the_oracle;
    each_family!(agrees_with_the_oracle);
}

mod charts {
    use super::charts_lead_back;
    each_family!(charts_lead_back);
}

mod reduced {
    use super::reduced_equations_move_the_point;
    each_family!(reduced_equations_move_the_point);
}

//! Generated code against exact values, for every family, on random models at random states.

use affine_oracle::{Matrix as Exact, Random, State};
use affine_runtime::prelude::*;

use crate::families::{Family, Parameters};
pub(crate) use affine_tests::charts::{T0, assert_charts_lead_back, assert_reduced_equations_move, groups};
use affine_tests::reference::{Reference, assert_close, entries, norm};
use affine_tests::tolerances::CANONICAL;

/// Models per family and dimension.
const SAMPLES: u64 = 10;
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
            assert_reduced_equations_move(&model, &point, CANONICAL, &|_, state| {
                Reference::new(&kinetic, state)
            });
        }
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

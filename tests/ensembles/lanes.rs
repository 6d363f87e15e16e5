//! Lanes give the bits of scalars.

use affine_oracle::Random;
use affine_runtime::lanes::{F64x8, Lanes};
use affine_runtime::model::StateVector;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

use crate::models::{DrunkMissile, Elastic, Sampled, Unprotected, between, vibrating};

/// Every function of a scalar, on numbers of all sizes, lane by lane.
fn functions_agree<T: Lanes>() {
    type Of<S> = fn(S) -> S;
    fn all<S: Scalar>() -> [Of<S>; 16] {
        [
            S::sqrt,
            S::cbrt,
            S::inverse_cbrt,
            S::exp,
            S::exp_m1,
            S::ln,
            S::ln_1p,
            S::sin,
            S::cos,
            S::tan,
            S::sinh,
            S::cosh,
            S::tanh,
            S::abs,
            |a| -a,
            |a| a.copysign(S::constant(-1.0, 0.0)),
        ]
    }
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
    let mut random = Random::new(17);
    for _ in 0..200 {
        let mut number = || between(&mut random, -1.0, 1.0) * between(&mut random, -40.0, 40.0).exp2();
        let mut numbers = || [(); 16].map(|()| number());
        let (mut a, b, c) = (numbers(), numbers(), numbers());
        (a[1], a[2], a[3]) = (-0.0, f64::INFINITY, f64::NAN);
        let [x, y, z] = [a, b, c].map(|numbers| T::from_lanes(|lane| numbers[lane]));
        for lane in 0..T::LANES {
            let (a, b, c) = (a[lane], b[lane], c[lane]);
            assert!(same(x.lane(lane), a));
            for (in_lanes, of_one) in all::<T>().iter().zip(all::<f64>()) {
                assert!(same(in_lanes(x).lane(lane), of_one(a)), "{a}");
            }
            let pairs = [
                (x + y, a + b),
                (x - y, a - b),
                (x * y, a * b),
                (x / y, a / b),
                (x.fma(y, z), Scalar::fma(a, b, c)),
                (y.copysign(x), Scalar::copysign(b, a)),
                (y.abs().inverse_cbrt(), b.abs().inverse_cbrt()),
            ];
            assert!(pairs.iter().all(|(in_lanes, of_one)| same(in_lanes.lane(lane), *of_one)), "{a} {b} {c}");
        }
        assert!(x.lane(T::LANES).is_nan(), "there is no such lane");
    }
}

#[test]
fn numbers_in_lanes_are_those_of_scalars() {
    functions_agree::<F64x8>();
}

/// Emitted right-hand sides of different bodies at different times, with constants of their own.
fn equations_agree<const N: usize, M: Sampled<N>, T: Lanes>(model: &M) {
    let starts = model.samples(T::LANES, 5);
    let reduced: Vec<_> =
        starts.iter().enumerate().map(|(k, start)| model.reduce(0.1 * k as f64, start)).collect();
    let constants: Vec<_> = reduced.iter().map(|(_, constants)| *constants).collect();
    let mut state = M::Reduced::<T>::zeros();
    for (k, component) in state.as_mut().iter_mut().enumerate() {
        *component = T::from_lanes(|lane| reduced[lane].0.as_ref()[k]);
    }
    let in_lanes = M::constants_in_lanes::<T>(&constants);
    let t = T::from_lanes(|lane| 0.3 + lane as f64);
    let at_once = model.reduced_equations(t, &in_lanes, &state);
    let mut rates = M::Reduced::<T>::zeros();
    M::equations_in_lanes(|_| model, t, &in_lanes, &state, &mut rates);
    assert_eq!(at_once.as_ref(), rates.as_ref());
    for (lane, (state, constants)) in reduced.iter().enumerate() {
        let alone = model.reduced_equations(0.3 + lane as f64, constants, state);
        let bits = |number: f64| number.to_bits();
        let found: Vec<u64> = rates.as_ref().iter().map(|rate| bits(rate.lane(lane))).collect();
        let expected: Vec<u64> = alone.as_ref().iter().map(|rate| bits(*rate)).collect();
        assert_eq!(found, expected, "{} lane {lane}", M::DESCRIPTION.name);
    }
}

#[test]
fn emitted_equations_in_lanes_are_those_of_scalars() {
    equations_agree::<3, _, F64x8>(&DrunkMissile);
    equations_agree::<3, _, F64x8>(&vibrating());
    equations_agree::<3, _, F64x8>(&Elastic);
    equations_agree::<2, _, F64x8>(&Unprotected);
}

/// Different bodies, each with the steps that it takes alone: more of them than lanes, so that each follows another in a
/// lane, and fewer, so that lanes are left. The bits are those of a simulation.
fn bodies_are_as_alone<const N: usize, M: Sampled<N>>(model: &M)
where
    M::Point<f64>: Send + Sync,
{
    let starts = model.samples(37, 11);
    for t_end in [1.2, -1.0] {
        let alone = |start: &M::Point<f64>| {
            let simulation = Simulation::new(model, *start).until(t_end).tolerance(1e-9);
            *simulation.method(Method::RungeKutta8).run().unwrap().end().1
        };
        let expected: Vec<_> = starts.iter().map(alone).collect();
        for bodies in [37, 3] {
            let ensemble = Ensemble::new(model, starts[..bodies].to_vec()).until(t_end).tolerance(1e-9);
            let ends: Vec<_> = ensemble.run().unwrap().into_iter().map(Result::unwrap).collect();
            assert_eq!(ends, expected[..bodies], "{} to {t_end}", M::DESCRIPTION.name);
        }
    }
}

#[test]
fn every_body_has_the_bits_of_itself_alone() {
    bodies_are_as_alone(&vibrating());
    bodies_are_as_alone(&DrunkMissile);
    bodies_are_as_alone(&Elastic);
    bodies_are_as_alone(&Unprotected);
}

/// Bodies at rest, and momenta whose squares underflow: norms that are not the plain ones.
#[test]
fn bodies_at_rest_have_the_bits_of_themselves_alone() {
    let moving = Elastic.samples(1, 13)[0];
    let starts: Vec<_> = [0.0, 1e-170, 1.0, 1e-150, 1e-100]
        .map(|size| Elastic.at_momentum(*moving.phi(), TwoPoint(moving.pi().0.0 * size)).unwrap())
        .to_vec();
    let ends = Ensemble::new(&Elastic, starts.clone()).until(0.7).tolerance(1e-9).run().unwrap();
    for (start, end) in starts.iter().zip(ends) {
        let alone = Simulation::new(&Elastic, *start).until(0.7).tolerance(1e-9).method(Method::RungeKutta8);
        assert_eq!(end.unwrap(), *alone.run().unwrap().end().1);
    }
}

//! One model to a lane: to the bit what each gives alone.

use affine_oracle::{Random, rounded};
use affine_runtime::capability::InLanes;
use affine_runtime::lanes::{F64x8, Lanes};
use affine_runtime::parametric::Parametric;
use affine_runtime::prelude::*;

use crate::models::{Anisotropic, Drawn, Ellipsoid, Missile, Oblique, Split, Wind, start};
use crate::numbers::vector;

/// Models of one kind with fields of their own.
fn several<const N: usize, F: Drawn<N>>(count: usize) -> Vec<F::Prepared> {
    let mut random = Random::new(31);
    let mut prepared = || {
        let values = F::drawn(&mut random);
        F::prepared(&vector(|k| rounded(&values[k])))
    };
    (0..count).map(|_| prepared()).collect()
}

/// What a lane has of numbers, and what it should have.
fn assert_lane<T: Lanes>(lanes: &[T], lane: usize, alone: &[f64]) {
    let found: Vec<u64> = lanes.iter().map(|number| number.lane(lane).to_bits()).collect();
    let expected: Vec<u64> = alone.iter().map(|number| number.to_bits()).collect();
    assert_eq!(found, expected, "lane {lane}");
}

fn equations_are_those_of_each<const N: usize, F: Drawn<N>, T: Lanes>() {
    let models = several::<N, F>(T::LANES);
    let mut random = Random::new(32);
    let starts: Vec<_> = models.iter().map(|_| start::<N, F::Prepared>(&mut random)).collect();
    let full: <F::Prepared as Model<N>>::Full<T> = vector(|k| T::from_lanes(|lane| starts[lane].as_ref()[k]));
    let coefficients = F::Prepared::coefficients_in_lanes::<T>(&models);
    let t = T::constant(0.25, 0.0);
    let rates = models[0].hamilton_equations_with(&coefficients, t, &full);
    for (lane, (model, start)) in models.iter().zip(&starts).enumerate() {
        assert_lane(rates.as_ref(), lane, model.hamilton_equations(0.25, start).as_ref());
    }
    let differ = |k: usize| models[k].coefficients::<f64>() != models[0].coefficients::<f64>();
    assert!((1..models.len()).all(differ), "each model has fields of its own");
}

#[test]
fn coefficients_in_lanes_give_the_equations_of_each_model() {
    equations_are_those_of_each::<3, Missile, F64x8>();
    equations_are_those_of_each::<3, Ellipsoid, F64x8>();
    equations_are_those_of_each::<2, Anisotropic, F64x8>();
    equations_are_those_of_each::<2, Oblique<Wind>, F64x8>();
    equations_are_those_of_each::<2, Split, F64x8>();
}

#[test]
fn lanes_that_are_left_have_the_last_model() {
    let models = several::<3, Missile>(3);
    let coefficients = crate::models::PreparedMissile::coefficients_in_lanes::<F64x8>(&models);
    for lane in 0..8 {
        assert_lane(&coefficients, lane, &models[lane.min(2)].coefficients::<f64>());
    }
}

#[test]
fn trajectories_of_several_models_go_in_lanes() {
    let models = several::<3, Missile>(8);
    let mut random = Random::new(33);
    let point = models[0].unflatten(&start::<3, crate::models::PreparedMissile>(&mut random));
    let reduced: Vec<_> = models.iter().map(|model| model.reduce(0.0, &point)).collect();
    let constants: Vec<_> = reduced.iter().map(|(_, constants)| *constants).collect();
    let constants = crate::models::PreparedMissile::constants_in_lanes::<F64x8>(&constants);
    let state = std::array::from_fn(|k| F64x8::from_lanes(|lane| reduced[lane].0[k]));
    let rates = models[0].reduced_equations(F64x8::from_lanes(|_| 0.5), &constants, &state);
    for (lane, (model, (state, constants))) in models.iter().zip(&reduced).enumerate() {
        assert_lane(&rates, lane, &model.reduced_equations(0.5, constants, state));
    }
}

//! Dual numbers of other scalars than doubles: of lanes against each lane alone, of other precision against differences of doubles.

use affine_runtime::analysis::JacobianMatrix;
use affine_runtime::dual::Dual;
use affine_runtime::lanes::{F64x8, Lanes};
use affine_runtime::model::{Model, StateVector};
use affine_runtime::prelude::*;
use affine_runtime::scalar::{Real, Scalar};
use qd::Quad;

#[affine_model(dim = 3, kinetic(dalembert = 1), potential = cosh(Q1) + cosh(Q2) + cosh(Q3))]
struct Spatial;
#[affine_model(dim = 2, kinetic(dalembert = 1), potential = cosh(Q1) + cosh(Q2))]
struct Planar;
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = tr(G) + norm(x)^3 + sqrt(norm(x)^2 + 1)*q
)]
struct Central;
#[affine_model(dim = 3, kinetic(dalembert = 1), potential = self_gravity(1))]
struct Gravitating;

/// The slopes of Hamilton's equations along an axis.
fn slopes<const N: usize, M: Model<N>, T: Scalar>(
    model: &M,
    axis: usize,
    value: impl Fn(usize) -> T,
) -> Vec<T> {
    let mut varied = M::Full::<Dual<T>>::zeros();
    varied.as_mut().iter_mut().enumerate().for_each(|(k, own)| *own = Dual::fixed(value(k)));
    varied.as_mut()[axis].slope = T::one();
    let rates = model.hamilton_equations(Dual::constant(0.0, 0.0), &varied);
    rates.as_ref().iter().map(|rate| rate.slope).collect()
}

/// Several points, each in a lane: dual numbers, and what is recorded.
fn assert_lanes<const N: usize, M: Model<N>>(model: &M, points: &[&[f64]]) {
    let own = points[0].len();
    let mut first = M::Full::<f64>::zeros();
    first.as_mut().copy_from_slice(points[0]);
    let jacobian = JacobianMatrix::of(model, 0.0, &model.unflatten(&first));
    let lane_of = |lane: usize, k: usize| points[lane % points.len()][k];
    let in_lanes: Vec<F64x8> = (0..own).map(|k| F64x8::from_lanes(|lane| lane_of(lane, k))).collect();
    let recorded = jacobian.at(F64x8::constant(0.0, 0.0), &in_lanes);
    for axis in 0..own {
        let together = slopes(model, axis, |k| in_lanes[k]);
        for lane in 0..F64x8::LANES {
            let alone = slopes(model, axis, |k| lane_of(lane, k));
            for (row, (together, alone)) in together.iter().zip(alone).enumerate() {
                for found in [together.lane(lane), recorded[(row, axis)].lane(lane)] {
                    let is_near = (found - alone).abs() <= 1e-12 * (1.0 + alone.abs());
                    assert!(is_near, "{lane} {row} {axis}: {found} {alone}");
                }
            }
        }
    }
}

#[test]
fn lanes_are_what_they_are_alone() {
    let spatial = |off: f64| {
        let mut point = [0.0; 18];
        [0, 4, 8].into_iter().for_each(|k| point[k] = 1.1);
        (point[1], point[9]) = (off, 0.3);
        point
    };
    let [same, near, far] = [0.0, 1e-3, 0.3].map(spatial);
    assert_lanes(&Spatial, &[&same, &near, &far]);
    assert_lanes(&Gravitating, &[&same, &near, &far]);
    let same = [1.2, 0.0, 0.0, 1.2, 0.1, 0.2, 0.3, 0.4];
    let far = [1.2, 0.3, 0.0, 0.9, 0.1, 0.2, 0.3, 0.4];
    assert_lanes(&Planar, &[&same, &far]);
    assert_lanes(
        &Central,
        &[&[&[0.0; 2], &same[..], &[0.0; 2]].concat(), &[&[0.3, -0.2], &far[..], &[0.1; 2]].concat()],
    );
}

/// The slope of an energy along an entry of the placement.
fn slope_of_energy<const N: usize, M: Model<N>, T: Real>(model: &M, phi: &[f32], axis: usize) -> f64 {
    let mut varied = M::Full::<Dual<T>>::zeros();
    varied
        .as_mut()
        .iter_mut()
        .zip(phi)
        .for_each(|(own, value)| *own = Dual::constant(f64::from(*value), 0.0));
    varied.as_mut()[axis].slope = T::one();
    model.hamiltonian(Dual::constant(0.0, 0.0), &model.unflatten(&varied)).slope.to_f64()
}

/// Stretches coincide that are further apart in singles, and nearer in double-double numbers.
fn assert_precisions<const N: usize, M: Model<N>>(model: &M, phi: &Matrix<N>) {
    const H: f64 = 1e-4;
    let phi: Vec<f32> = phi.transpose().iter().map(|entry| *entry as f32).collect();
    for axis in 0..N * N {
        let energy = |steps: f64| {
            let mut full = M::Full::<f64>::zeros();
            full.as_mut().iter_mut().zip(&phi).for_each(|(own, value)| *own = f64::from(*value));
            full.as_mut()[axis] += steps * H;
            model.hamiltonian(0.0, &model.unflatten(&full))
        };
        let difference = (8.0 * (energy(1.0) - energy(-1.0)) - (energy(2.0) - energy(-2.0))) / (12.0 * H);
        let single = slope_of_energy::<N, M, f32>(model, &phi, axis);
        assert!((single - difference).abs() < 1e-3, "{phi:?} {axis}: {single} {difference}");
        let quad = slope_of_energy::<N, M, Quad>(model, &phi, axis);
        assert!((quad - difference).abs() < 1e-10, "{phi:?} {axis}: {quad} {difference}");
    }
}

#[test]
fn any_precision_has_slopes_near_stretches_that_coincide() {
    for off in [0.0, 1e-30, 1e-20, 1e-16, 1e-12, 1e-9, 1e-8, 1e-7, 3e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1] {
        assert_precisions(&Planar, &Matrix::<2>::new(1.1, off, 0.0, 1.1));
        assert_precisions(
            &Spatial,
            &Matrix::<3>::new(1.1, off, 0.0, 0.0, 1.1, 0.0, 0.0, 0.0, 1.1 + 1e-3 * off),
        );
        let turned = Matrix::<3>::new(0.8, 0.6, 0.0, -0.6, 0.8, 0.0, 0.0, 0.0, 1.0);
        let strain = Matrix::<3>::new(1.0, 1.0, 0.0, 1.0, -1.0, 1.0, 0.0, 1.0, 1.0) * off;
        assert_precisions(&Spatial, &(turned * (Matrix::<3>::identity() + strain)));
    }
}

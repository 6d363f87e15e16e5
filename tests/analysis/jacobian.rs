//! Jacobians of recorded operations against dual numbers, which differentiate by another route, and what they cost.

use affine_runtime::analysis::JacobianMatrix;
use affine_runtime::counting::Counting;
use affine_runtime::dual::Dual;
use affine_runtime::force::{Force, Motion};
use affine_runtime::frames::Body as OnBody;
use affine_runtime::frames::Matrix;
use affine_runtime::model::{Model, Operations, StateVector};
use affine_runtime::nalgebra::Rotation3;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

/// Problems P2 and P3.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
)]
struct Vibrating;
#[affine_model(dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), potential = hyperbolic_dilatation(10) + neo_hookean(0.5))]
struct Elastic;

/// Every operation that equations have, friction and a force of the user among them.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1),
    potential = cosh(q) + sqrt(1 + tr(G)) + tanh(tr(G)/9) + exp(-tr(G)) + ln(1 + det^2) + tan(det/9) + sinh(tr(Ct)/20)
        + cos(t)*sin(tr(Ct)/5) + x[1]^2,
    dissipation(body_inertia = 0.3),
    forces = custom(motor, comoving),
)]
struct Driven {
    motor: Motor,
}

#[derive(Clone, Copy, Debug)]
struct Motor;

impl Force<2> for Motor {
    type Form = OnBody;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Matrix<2, T> {
        let largest = motion.phi[(0, 0)].max(motion.phi[(1, 1)]).copysign(motion.phi[(0, 1)]);
        motion.phi_dot * largest.abs() / (T::one() + motion.t * motion.t).cbrt().asinh()
    }
}

fn point<const N: usize, M: Model<N>>(model: &M) -> M::Full<f64> {
    let mut full = M::Full::<f64>::zeros();
    let mut start = 0;
    for group in M::DESCRIPTION.full {
        for k in 0..group.len {
            let diagonal = if group.name() == "phi" && k % (N + 1) == 0 { 1.2 } else { 0.0 };
            full.as_mut()[start + k] = diagonal + 0.3 * ((3 * (start + k) + k * k) as f64).sin();
        }
        start += group.len;
    }
    model.flatten(&model.unflatten(&full))
}

fn assert_near(exact: f64, expected: f64, size: f64, what: impl std::fmt::Debug) {
    assert!((exact - expected).abs() <= 1e-12 * size, "{what:?}: {exact} and not {expected}");
}

/// Entries against those of dual numbers, one column a pass.
fn assert_columns<const N: usize, M: Model<N>>(model: &M) {
    let full = point::<N, M>(model);
    assert_same(&JacobianMatrix::of(model, 0.3, &model.unflatten(&full)), model, full);
}

fn assert_same<const N: usize, M: Model<N>>(jacobian: &JacobianMatrix, model: &M, full: M::Full<f64>) {
    let t = 0.3;
    let matrix = jacobian.at(t, full);
    let size = matrix.amax();
    for k in 0..full.as_ref().len() {
        let mut varied = M::Full::<Dual<f64>>::zeros();
        varied.as_mut().iter_mut().zip(full.as_ref()).for_each(|(dual, value)| *dual = Dual::fixed(*value));
        varied.as_mut()[k].slope = 1.0;
        let rates = model.hamilton_equations(Dual::fixed(t), &varied);
        for (i, rate) in rates.as_ref().iter().enumerate() {
            assert_near(matrix[(i, k)], rate.slope, size, (i, k));
        }
    }
}

#[test]
fn columns_are_those_of_dual_numbers() {
    assert_columns::<3, Vibrating>(&Vibrating);
    assert_columns::<3, Elastic>(&Elastic);
    assert_columns::<2, _>(&Driven { motor: Motor }.prepare().unwrap());
}

#[affine_model(dim = 3, kinetic(dalembert = 1), potential = exp(3*q1) + exp(3*q2) + exp(3*q3) + pairs(cosh(d)))]
struct Stretched;

/// The slopes of Hamilton's equations by dual numbers, against differences of order 4.
fn assert_differences(phi: Matrix<3>) {
    const H: f64 = 1e-4;
    let full = Stretched.flatten(&Stretched.at_velocity(phi, Matrix::<3>::zeros()).unwrap());
    for k in 0..9 {
        let mut varied = <Stretched as Model<3>>::Full::<Dual<f64>>::zeros();
        varied.as_mut().iter_mut().zip(full.as_ref()).for_each(|(dual, value)| *dual = Dual::fixed(*value));
        varied.as_mut()[k].slope = 1.0;
        let slopes = Stretched.hamilton_equations(Dual::fixed(0.0), &varied);
        let at = |steps: f64| {
            let mut moved = full;
            moved.as_mut()[k] += steps * H;
            Stretched.hamilton_equations(0.0, &moved)
        };
        let [far, near, before, behind] = [2.0, 1.0, -1.0, -2.0].map(at);
        for (i, slope) in slopes.as_ref().iter().enumerate() {
            let of = |state: &<Stretched as Model<3>>::Full<f64>| state.as_ref()[i];
            let difference = (8.0 * (of(&near) - of(&before)) - (of(&far) - of(&behind))) / (12.0 * H);
            // Of 12: rounding of differences, and where stretches are nearly one 1e-8 of their size.
            assert!((slope.slope - difference).abs() < 5e-8, "{phi}{i} {k}: {} {difference}", slope.slope);
        }
    }
}

/// Axes are not determined there, and no derivative of them has a bound: forces have one all the same.
#[test]
fn forces_have_slopes_where_stretches_coincide() {
    let [left, right] = [(0.3, -0.7, 1.1), (-0.4, 0.2, 0.9)]
        .map(|(a, b, c)| Rotation3::from_euler_angles(a, b, c).into_inner());
    let of = |a: f64, b: f64, c: f64| left * Matrix::<3>::from_diagonal(&[a, b, c].into()) * right;
    let one = Matrix::<3>::identity();
    let coincide =
        [one, one * 2.0, left, left * 2.0, of(1.5, 1.5, 1.0), of(1.5, 1.0, 1.0), of(0.7, 1.3, 0.7)];
    coincide.into_iter().for_each(assert_differences);
    for gap in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15] {
        assert_differences(of(1.5, 1.5 + gap, 0.8));
        assert_differences(of(1.0 - gap, 1.0, 1.0 + gap));
    }
    // All directions at once, recorded there or elsewhere.
    let elsewhere = Stretched.at_velocity(of(1.5, 1.3, 0.8), Matrix::<3>::zeros()).unwrap();
    let elsewhere = JacobianMatrix::of(&Stretched, 0.0, &elsewhere);
    for phi in coincide {
        let point = Stretched.at_velocity(phi, Matrix::<3>::zeros()).unwrap();
        let full = Stretched.flatten(&point);
        assert_same(&JacobianMatrix::of(&Stretched, 0.0, &point), &Stretched, full);
        assert_same(&elsewhere, &Stretched, full);
    }
}

fn total(operations: Operations) -> usize {
    let Operations { mul, add, div, sqrt, exp, ln } = operations;
    mul + add + div + sqrt + exp + ln
}

/// The operations of the Jacobian of the reduced equations, counted as they are done, and those of the equations.
fn costs<M: Model<3>>(model: &M) -> (usize, usize) {
    let point = model.unflatten(&point::<3, M>(model));
    let (reduced, _) = model.reduce(0.0, &point);
    let jacobian = JacobianMatrix::of_reduced(model, 0.0, &point);
    let mut counting = M::Reduced::<Counting>::zeros();
    counting
        .as_mut()
        .iter_mut()
        .zip(reduced.as_ref())
        .for_each(|(count, value)| *count = Counting::from(*value));
    let (matrix, operations) = Counting::count(|| jacobian.at(Counting::from(0.0), counting));
    let full = model.flatten(&point);
    let mut fixed = M::Full::<Dual<f64>>::zeros();
    fixed.as_mut().iter_mut().zip(full.as_ref()).for_each(|(dual, value)| *dual = Dual::fixed(*value));
    let (_, varied) = model.reduce(Dual::fixed(0.0), &model.unflatten(&fixed));
    for k in 0..reduced.as_ref().len() {
        let mut state = M::Reduced::<Dual<f64>>::zeros();
        state.as_mut().iter_mut().zip(reduced.as_ref()).for_each(|(dual, value)| *dual = Dual::fixed(*value));
        state.as_mut()[k].slope = 1.0;
        let rates = model.reduced_equations(Dual::fixed(0.0), &varied, &state);
        for (i, rate) in rates.as_ref().iter().enumerate() {
            assert_near(matrix[(i, k)].value(), rate.slope, 10.0, (i, k));
        }
    }
    (total(operations), total(M::DESCRIPTION.reduced_operations))
}

/// Problems P2 and P3: at most 8 times the equations themselves.
#[test]
fn operations_are_few() {
    for (jacobian, equations) in [costs(&Vibrating), costs(&Elastic)] {
        assert!(jacobian <= 8 * equations, "{jacobian} operations for {equations}");
    }
}

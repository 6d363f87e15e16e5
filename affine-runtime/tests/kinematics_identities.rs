//! Identities of kinematics (Slawianowski et al., section 2) at random placements `phi = L diag(Q) R^T` with
//! known rotations and stretches.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_runtime::__private::phase_point;
use affine_runtime::Error;
use affine_runtime::decompose::LinearMap;
use affine_runtime::frames::{
    AffineSpin, AffineVelocity, Body, Canonical, Comoving, Matrix, Space, Spatial, TwoPoint, Vector,
};
use affine_runtime::kinematics::{DeformationTensor, Kinematics, Strain};
use affine_runtime::model::Velocity;
use affine_runtime::state::{Centre, Orthonormal, Phase, PhasePoint, Pinned};
use proptest::prelude::*;

/// Stretches lie between `exp(-1)` and `exp(1)`: condition number at most `e^2 = 7.4`; products of two such
/// placements at most 55. With its square, and some ten roundings, identities hold to 3e4 epsilons.
const IDENTITY: f64 = 3e4 * f64::EPSILON;

#[derive(Clone, Debug)]
struct Scene<const N: usize> {
    left: Matrix<N>,
    log_stretches: Vector<N>,
    right: Matrix<N>,
    pi: Matrix<N>,
    phi_dot: Matrix<N>,
    centre: Centre<N>,
}

impl<const N: usize> Scene<N> {
    fn phi(&self) -> Matrix<N> {
        self.left * Matrix::from_diagonal(&self.log_stretches.map(f64::exp)) * self.right.transpose()
    }
    fn point(&self) -> PhasePoint<N, Canonical, Centre<N>> {
        phase_point(self.phi(), TwoPoint(self.pi), self.centre).unwrap()
    }
    fn velocity(&self) -> Velocity<N> {
        Velocity { x_dot: self.centre.x, phi_dot: self.phi_dot }
    }
    /// `phi -> A phi B`, `Pi -> B^-1 Pi A^-1`.
    fn transformed(&self, a: &Matrix<N>, b: &Matrix<N>) -> PhasePoint<N, Canonical, Centre<N>> {
        let pi = inverse(b) * self.pi * inverse(a);
        phase_point(a * self.phi() * b, TwoPoint(pi), self.centre).unwrap()
    }
}

/// The product of plane rotations through the given angles: no code of the crate.
fn rotation<const N: usize>(angles: [f64; 3]) -> Matrix<N> {
    let planes = [(0, 1), (0, 2), (1, 2)];
    planes.iter().zip(angles).filter(|((_, j), _)| *j < N).fold(
        Matrix::identity(),
        |product, (&(i, j), angle)| {
            let mut plane = Matrix::<N>::identity();
            (plane[(i, i)], plane[(j, j)]) = (angle.cos(), angle.cos());
            (plane[(i, j)], plane[(j, i)]) = (-angle.sin(), angle.sin());
            product * plane
        },
    )
}

fn inverse<const N: usize>(matrix: &Matrix<N>) -> Matrix<N> {
    matrix.try_inverse().unwrap()
}

fn scene<const N: usize>() -> impl Strategy<Value = Scene<N>> {
    let angles = || prop::array::uniform3(-3.0..3.0);
    let entries = || prop::array::uniform9(-1.0..1.0f64);
    (angles(), angles(), prop::array::uniform3(-1.0..1.0), entries(), entries(), entries()).prop_map(
        |(left, right, q, pi, phi_dot, centre)| Scene {
            left: rotation(left),
            log_stretches: Vector::from_fn(|a, _| q[a]),
            right: rotation(right),
            pi: Matrix::from_fn(|i, j| pi[3 * i + j]),
            phi_dot: Matrix::from_fn(|i, j| phi_dot[3 * i + j]),
            centre: Centre { x: Vector::from_fn(|i, _| centre[i]), p: Vector::from_fn(|i, _| centre[3 + i]) },
        },
    )
}

fn close<const N: usize>(left: &Matrix<N>, right: &Matrix<N>) {
    let error = (left - right).amax();
    let scale = left.amax().max(right.amax()).max(1.0);
    assert!(error <= IDENTITY * scale, "{left} differs from {right} by {error:e}");
}

fn near(left: f64, right: f64, scale: f64) {
    assert!((left - right).abs() <= IDENTITY * scale.max(1.0), "{left:e} differs from {right:e}");
}

fn stretches_are_eigenvalues<const N: usize>(scene: &Scene<N>) {
    let point = scene.point();
    let in_body = |of: fn(f64) -> f64| -> Matrix<N> {
        scene.right * Matrix::from_diagonal(&scene.log_stretches.map(of)) * scene.right.transpose()
    };
    let in_space = |of: fn(f64) -> f64| -> Matrix<N> {
        scene.left * Matrix::from_diagonal(&scene.log_stretches.map(of)) * scene.left.transpose()
    };
    close(&point.green().0.0, &in_body(|q| (2.0 * q).exp()));
    close(&point.green_inverse().0.0, &in_body(|q| (-2.0 * q).exp()));
    close(&point.cauchy().0.0, &in_space(|q| (-2.0 * q).exp()));
    close(&point.cauchy_inverse().0.0, &in_space(|q| (2.0 * q).exp()));
    close(&point.lagrange_strain().0.0, &in_body(|q| (2.0 * q).exp_m1() / 2.0));
    close(&point.euler_strain().0.0, &in_space(|q| -(-2.0 * q).exp_m1() / 2.0));
    for k in 0..=N as u32 {
        let sum: f64 = scene.log_stretches.iter().map(|q| (2.0 * f64::from(k) * q).exp()).sum();
        near(point.green().power_trace(k), sum, sum);
        let sum: f64 = scene.log_stretches.iter().map(|q| (-2.0 * f64::from(k) * q).exp()).sum();
        near(point.cauchy().power_trace(k), sum, sum);
    }
    near(point.mean_log_stretch(), scene.log_stretches.mean(), 1.0);
    near(point.dilatation(), scene.log_stretches.mean().exp(), 1.0);
    near(point.isochoric_part().mean_log_stretch(), 0.0, 1.0);
    close(&(point.isochoric_part() * point.dilatation()), point.phi());
}

fn transformation_rules<const N: usize>(scene: &Scene<N>, other: &Scene<N>) {
    let point = scene.point();
    let any = other.phi();
    let (rotation, identity) = (other.left, Matrix::<N>::identity());
    // G under any B and an orthogonal A; C under any A and an orthogonal B.
    let moved = scene.transformed(&rotation, &any);
    close(&moved.green().0.0, &(any.transpose() * point.green().0.0 * any));
    let moved = scene.transformed(&any, &rotation);
    let any_inverse = inverse(&any);
    close(&moved.cauchy().0.0, &(any_inverse.transpose() * point.cauchy().0.0 * any_inverse));
    // Affine velocities and spins under any A and B.
    let both = scene.transformed(&any, &scene.phi());
    let velocity = Velocity { phi_dot: any * scene.phi_dot * scene.phi(), ..scene.velocity() };
    close(&both.omega(&velocity).0.0, &(any * point.omega(&scene.velocity()).0.0 * any_inverse));
    close(&both.sigma().0.0, &(any * point.sigma().0.0 * any_inverse));
    let b_inverse = inverse(&scene.phi());
    let expected = b_inverse * point.omega_hat(&scene.velocity()).0.0 * scene.phi();
    close(&both.omega_hat(&velocity).0.0, &expected);
    close(&both.sigma_hat().0.0, &(b_inverse * point.sigma_hat().0.0 * scene.phi()));
    // Spin and vorticity under rotations: each moves on its own side only.
    let turned = scene.transformed(&rotation, &identity);
    close(&turned.spin().0.0, &(rotation * point.spin().0.0 * rotation.transpose()));
    close(&turned.vorticity().0.0, &point.vorticity().0.0);
    let relabelled = scene.transformed(&identity, &rotation);
    close(&relabelled.spin().0.0, &point.spin().0.0);
    close(&relabelled.vorticity().0.0, &(rotation.transpose() * point.vorticity().0.0 * rotation));
    near(turned.spin().norm_squared(), point.spin().norm_squared(), point.spin().0.0.norm_squared());
}

fn momenta_fit_together<const N: usize>(scene: &Scene<N>) {
    let (point, velocity) = (scene.point(), scene.velocity());
    let (omega, omega_hat) = (point.omega(&velocity), point.omega_hat(&velocity));
    let power = (point.pi().0.0 * scene.phi_dot).trace();
    let scale = point.sigma().0.0.norm() * omega.0.0.norm();
    near(point.sigma().pair(omega), power, scale);
    near(point.sigma_hat().pair(omega_hat), power, scale * 55.0);
    near(point.pi().pair(TwoPoint(AffineVelocity(scene.phi_dot))), power, scale);
    let shear = point.sigma().deviator().pair(omega.deviator());
    near(shear + point.dilatational_momentum() * omega.dilatation_rate(), power, scale);
    near(omega.deviator().dilatation_rate(), 0.0, omega.0.0.norm());
    near(point.sigma_hat().deviator().dilatational_momentum(), 0.0, scale);
    near(point.p_hat().pair(point.v_hat(&velocity)), scene.centre.p.dot(&velocity.x_dot), 1.0);
    for k in 1..=N as u32 {
        let scale = point.sigma().0.0.norm().powi(k as i32);
        near(point.sigma().casimir(k), point.casimir(k), scale);
        near(point.sigma_hat().deviator().casimir(k), point.shear_casimir(k), scale);
    }
    let spin = point.spin().0.0;
    near(point.spin().norm_squared(), -(spin * spin).trace() / 2.0, spin.norm_squared());
    let vorticity = point.vorticity().0.0;
    near(point.vorticity().norm_squared(), -(vorticity * vorticity).trace() / 2.0, vorticity.norm_squared());
    let total = point.total_affine_momentum();
    close(&total.angular_momentum().0.0, &point.total_angular_momentum().0.0);
    close(&(total - point.orbital_affine_momentum()).0.0, &point.sigma().0.0);
}

/// Newton's identities: `e2 = (t1^2 - t2)/2`, `e3 = (t1^3 - 3 t1 t2 + 2 t3)/6`.
fn newton(traces: [f64; 3]) -> [f64; 3] {
    let [t1, t2, t3] = traces;
    [t1, (t1 * t1 - t2) / 2.0, (t1 * t1 * t1 - 3.0 * t1 * t2 + 2.0 * t3) / 6.0]
}

fn invariants_from_power_traces<const N: usize>(green: Comoving<DeformationTensor<N>>, invariants: [f64; N]) {
    let traces = [1, 2, 3].map(|k| green.power_trace(k));
    for (k, (invariant, expected)) in invariants.into_iter().zip(newton(traces)).enumerate() {
        near(invariant, expected, traces[0].powi(k as i32 + 1));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(256) })]

    #[test]
    fn two_dimensions(scene in scene::<2>(), other in scene::<2>()) {
        stretches_are_eigenvalues(&scene);
        transformation_rules(&scene, &other);
        momenta_fit_together(&scene);
        invariants_from_power_traces(scene.point().green(), scene.point().invariants());
    }

    #[test]
    fn three_dimensions(scene in scene::<3>(), other in scene::<3>()) {
        stretches_are_eigenvalues(&scene);
        transformation_rules(&scene, &other);
        momenta_fit_together(&scene);
        invariants_from_power_traces(scene.point().green(), scene.point().invariants());
    }
}

/// A simple shear with a momentum, in numbers that are exact.
fn sheared() -> PhasePoint<2, Canonical, Pinned> {
    let phi = Matrix::<2>::new(1.0, 1.0, 0.0, 1.0);
    phase_point(phi, TwoPoint(Matrix::<2>::new(0.0, 1.0, 0.0, 2.0)), Pinned).unwrap()
}

#[test]
fn spin_is_not_the_vorticity_in_another_frame() {
    let point = sheared();
    assert_eq!(point.spin().0.0, Matrix::<2>::new(0.0, 3.0, -3.0, 0.0));
    assert_eq!(point.vorticity().0.0, Matrix::<2>::new(0.0, 1.0, -1.0, 0.0));
    let carried = point.phi() * point.vorticity().0.0 * inverse(point.phi());
    assert_eq!(carried, Matrix::<2>::new(-1.0, 2.0, -1.0, 1.0));
}

#[test]
fn green_is_not_invariant_under_deformations_of_space() {
    let point = sheared();
    let stretched = Matrix::<2>::new(2.0, 0.0, 0.0, 1.0) * point.phi();
    assert_eq!(point.green().0.0, Matrix::<2>::new(1.0, 1.0, 1.0, 2.0));
    assert_eq!(DeformationTensor::green(&stretched).0.0, Matrix::<2>::new(4.0, 4.0, 4.0, 5.0));
}

#[test]
fn a_rotation_has_no_strain_and_no_dilatation() {
    let quarter_turn = Matrix::<2>::new(0.0, -1.0, 1.0, 0.0);
    assert_eq!(Strain::lagrange(&quarter_turn).0.0, Matrix::<2>::zeros());
    assert_eq!(Strain::euler(&quarter_turn).0.0, Matrix::<2>::zeros());
    assert_eq!(quarter_turn.mean_log_stretch(), 0.0);
    assert_eq!(Matrix::<3>::identity().mean_log_stretch(), 0.0);
    assert_eq!(Matrix::<3>::identity().dilatation(), 1.0);
}

#[test]
fn degenerate_placements_have_the_stated_dilatation() {
    let singular = Matrix::<3>::new(1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 0.0, 1.0, 0.0);
    assert_eq!((singular.mean_log_stretch(), singular.dilatation()), (f64::NEG_INFINITY, 0.0));
    assert_eq!(
        (Matrix::<2>::zeros().mean_log_stretch(), Matrix::<2>::zeros().dilatation()),
        (f64::NEG_INFINITY, 0.0)
    );
    let mirror = Matrix::<2>::new(0.0, 1.0, 1.0, 0.0);
    assert!(mirror.mean_log_stretch().is_nan() && mirror.dilatation().is_nan());
    let broken = Matrix::<2>::new(1.0, f64::INFINITY, 0.0, 1.0);
    assert!(broken.mean_log_stretch().is_nan() && broken.dilatation().is_nan());
}

#[test]
fn extreme_numbers_keep_their_dilatation() {
    // Powers of two, so that the expected values are exact: the whole range, subnormal numbers included.
    for power in [-1074, -1060, -1022, -500, -1, 0, 1, 500, 1023] {
        let entry = 2.0_f64.powi(power / 2) * 2.0_f64.powi(power - power / 2);
        assert_eq!((Matrix::<3>::identity() * entry).dilatation(), entry, "2^{power}");
        assert_eq!((Matrix::<2>::identity() * entry).dilatation(), entry, "2^{power}");
    }
    // Single precision: det phi = 1e90 is beyond the range.
    let wide = Matrix::<3, f32>::identity() * 1e30;
    assert!((wide.mean_log_stretch() / (30.0 * core::f32::consts::LN_10) - 1.0).abs() <= 2.0 * f32::EPSILON);
    assert!((wide.dilatation() / 1e30 - 1.0).abs() <= 4.0 * f32::EPSILON);
}

#[test]
fn phase_points_are_checked() {
    let placement = |phi: Matrix<2>| {
        phase_point::<2, Body, _, f64, Orthonormal>(phi, Comoving(Matrix::<2>::zeros()), Pinned).map(|_| ())
    };
    assert_eq!(placement(Matrix::<2>::identity() * 1e-300), Ok(()));
    assert_eq!(placement(Matrix::<2>::zeros()), Err(Error::Placement { determinant: 0.0 }));
    let mirror = Matrix::<2>::new(0.0, 3.0, 2.0, 0.0);
    assert!(
        matches!(placement(mirror), Err(Error::Placement { determinant }) if (determinant + 6.0).abs() < 1e-14)
    );
    for bad in [f64::NAN, f64::INFINITY] {
        let error = placement(Matrix::<2>::new(bad, 0.0, 0.0, 1.0)).unwrap_err();
        assert!(matches!(error, Error::Placement { determinant } if determinant.is_nan()));
    }

    let fine = Centre { x: Vector::<2>::zeros(), p: Vector::<2>::zeros() };
    let start = |momentum: Matrix<2>, centre: Centre<2>| {
        let momentum = Spatial(AffineSpin(momentum));
        phase_point::<2, Space, _, f64, Orthonormal>(Matrix::identity(), momentum, centre).map(|_| ())
    };
    let broken = Vector::<2>::new(0.0, f64::NAN);
    assert_eq!(start(Matrix::identity(), fine), Ok(()));
    let refused = |quantity| Err(Error::NotFinite { quantity });
    assert_eq!(start(Matrix::identity() * f64::INFINITY, fine), refused("Sigma"));
    assert_eq!(start(Matrix::identity(), Centre { x: broken, ..fine }), refused("x"));
    assert_eq!(start(Matrix::identity(), Centre { p: broken, ..fine }), refused("p"));
}

//! Closed-form trajectories, substituted into the equations of motion.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_runtime::frames::{Matrix, Vector};
use affine_runtime::geodesic::{Geodesic, Orbit};

/// Tolerances, relative to the largest entry compared.
mod tolerance {
    /// Velocities by differences: truncation `(h w)^8/630` with `h = 1/64` and rates up to 3, rounding
    /// `eps/h`, over the condition number of `phi`.
    pub(crate) const DIFFERENCES: f64 = 1e-11;
    /// Two closed forms of one trajectory, and conserved quantities, at times where `t |X| < 10`: the errors
    /// of two exponentials, `eps (1 + kappa)` each, and of three products.
    pub(crate) const CLOSED_FORM: f64 = 2e-14;
    /// Quantities made by a rotation alone, angles below 10: `eps (1 + angle)` and two products.
    pub(crate) const ROTATED: f64 = 4e-15;
}

/// Coefficients of `T = I/2 tr(O^T O) + A/2 tr(O^2) + B/2 (tr O)^2`.
#[derive(Clone, Copy, Debug)]
struct Inertia {
    i: f64,
    a: f64,
    b: f64,
}

/// Definite; `I < |A|`; `I + A + n B < 0`; both `I - A` and `I + A` negative; affine-affine.
const INERTIAS: [Inertia; 5] = [
    Inertia { i: 1.0, a: 0.2, b: 0.1 },
    Inertia { i: 0.5, a: 1.25, b: -0.1 },
    Inertia { i: 1.0, a: -0.3, b: -1.5 },
    Inertia { i: -1.5, a: 0.25, b: 0.2 },
    Inertia { i: 0.0, a: 0.8, b: -0.1 },
];

impl Inertia {
    /// `X = I O^T + A O + B tr(O) 1`, equations (4.18) and (4.20).
    fn legendre<const N: usize>(self, o: &Matrix<N>) -> Matrix<N> {
        o.transpose() * self.i + o * self.a + Matrix::<N>::identity() * (self.b * o.trace())
    }

    /// Generators `X/alpha + tr(X)/beta` and `-(X - X^T)/mu`; the second is zero for `I = 0`.
    fn generators<const N: usize>(self, x: &Matrix<N>) -> (Matrix<N>, Option<Matrix<N>>) {
        let Self { i, a, b } = self;
        let alpha = i + a;
        let per_beta = -b / (alpha * (alpha + N as f64 * b));
        let stretch = x / alpha + Matrix::<N>::identity() * (per_beta * x.trace());
        let whirl = (x.transpose() - x) * (i / (i * i - a * a));
        (stretch, (i != 0.0).then_some(whirl))
    }
}

/// Placement and affine spin at the start: those of the drunk missile for `n = 3`.
fn start_in_space() -> (Matrix<3>, Matrix<3>) {
    (
        Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05),
        Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05),
    )
}

fn start_in_plane() -> (Matrix<2>, Matrix<2>) {
    (Matrix::<2>::new(1.2, -0.3, 0.4, 0.9), Matrix::<2>::new(0.3, -0.5, 0.7, -0.1))
}

const T0: f64 = 0.75;
const TIMES: [f64; 6] = [-1.5, 0.75, 1.0, 2.25, 4.0, 6.5];

fn body<const N: usize>(inertia: Inertia, spin: &Matrix<N>) -> Geodesic<N> {
    let (stretch, whirl) = inertia.generators(spin);
    Geodesic { t0: T0, motion: Orbit::Body { stretch, whirl }, drift: Vector::<N>::zeros() }
}

fn space<const N: usize>(inertia: Inertia, spin: &Matrix<N>, drift: Vector<N>) -> Geodesic<N> {
    let (stretch, whirl) = inertia.generators(spin);
    Geodesic { t0: T0, motion: Orbit::Space { stretch, whirl }, drift }
}

/// `d phi/dt` by central differences of order eight.
fn velocity<const N: usize>(geodesic: &Geodesic<N>, t: f64, start: &Matrix<N>) -> Matrix<N> {
    const STEP: f64 = 1.0 / 64.0;
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let pairs = weights.iter().zip(1..).map(|(weight, k)| {
        let h = STEP * f64::from(k);
        (geodesic.placement(t + h, start) - geodesic.placement(t - h, start)) * *weight
    });
    pairs.sum::<Matrix<N>>() / STEP
}

fn inverse<const N: usize>(matrix: &Matrix<N>) -> Matrix<N> {
    matrix.try_inverse().expect("placements are invertible")
}

fn assert_close<const N: usize>(left: &Matrix<N>, right: &Matrix<N>, tolerance: f64, what: &str) {
    let (distance, size) = ((left - right).amax(), left.amax().max(right.amax()));
    assert!(distance <= tolerance * size, "{what}: {distance:e} of {size:e}\n{left}{right}");
}

fn condition<const N: usize>(matrix: &Matrix<N>) -> f64 {
    matrix.norm() * inverse(matrix).norm()
}

fn assert_spatially_affine<const N: usize>(inertia: Inertia, phi0: &Matrix<N>, sigma_hat0: &Matrix<N>) {
    let geodesic = body(inertia, sigma_hat0);
    let sigma = phi0 * sigma_hat0 * inverse(phi0);
    for t in TIMES {
        let (phi, sigma_hat) = (geodesic.placement(t, phi0), geodesic.spin(t, sigma_hat0));
        let omega_hat = inverse(&phi) * velocity(&geodesic, t, phi0);
        let legendre = inertia.legendre(&omega_hat);
        let what = format!("{inertia:?}, t = {t}");
        assert_close(&legendre, &sigma_hat, tolerance::DIFFERENCES * condition(&phi), &what);
        assert_close(&(phi * sigma_hat), &(sigma * phi), tolerance::CLOSED_FORM, &what);
        let vorticity = |spin: &Matrix<N>| spin - spin.transpose();
        assert_close(&vorticity(&sigma_hat), &vorticity(sigma_hat0), tolerance::ROTATED, &what);
    }
    assert_eq!(geodesic.placement(T0, phi0), *phi0);
    assert_eq!(geodesic.spin(T0, sigma_hat0), *sigma_hat0);
}

fn assert_materially_affine<const N: usize>(inertia: Inertia, phi0: &Matrix<N>, sigma0: &Matrix<N>) {
    let geodesic = space(inertia, sigma0, Vector::<N>::zeros());
    let sigma_hat = inverse(phi0) * sigma0 * phi0;
    for t in TIMES {
        let (phi, sigma) = (geodesic.placement(t, phi0), geodesic.spin(t, sigma0));
        let omega = velocity(&geodesic, t, phi0) * inverse(&phi);
        let legendre = inertia.legendre(&omega);
        let what = format!("{inertia:?}, t = {t}");
        assert_close(&legendre, &sigma, tolerance::DIFFERENCES * condition(&phi), &what);
        assert_close(&(sigma * phi), &(phi * sigma_hat), tolerance::CLOSED_FORM, &what);
        let spin = |sigma: &Matrix<N>| sigma - sigma.transpose();
        assert_close(&spin(&sigma), &spin(sigma0), tolerance::ROTATED, &what);
    }
    assert_eq!(geodesic.placement(T0, phi0), *phi0);
    assert_eq!(geodesic.spin(T0, sigma0), *sigma0);
}

#[test]
fn spatially_affine_motion_solves_its_equations() {
    let ((phi3, spin3), (phi2, spin2)) = (start_in_space(), start_in_plane());
    for inertia in INERTIAS {
        assert_spatially_affine(inertia, &phi3, &spin3);
        assert_spatially_affine(inertia, &phi2, &spin2);
    }
}

#[test]
fn materially_affine_motion_solves_its_equations() {
    let ((phi3, spin3), (phi2, spin2)) = (start_in_space(), start_in_plane());
    for inertia in INERTIAS {
        assert_materially_affine(inertia, &phi3, &spin3);
        assert_materially_affine(inertia, &phi2, &spin2);
    }
}

/// `phi0 exp(t (sym M - w skew M)) exp(t (1 + w) skew M)`, `w = (I - A)/(I + A)`, from the velocity
/// `M = Omega_hat(0)` alone (Martin and Neff, arXiv:1409.7849), with the exponential of nalgebra.
#[test]
fn agrees_with_the_velocity_form() {
    let (phi0, m) = start_in_space();
    let (symmetric, skew) = ((m + m.transpose()) * 0.5, (m - m.transpose()) * 0.5);
    for inertia in INERTIAS {
        let w = (inertia.i - inertia.a) / (inertia.i + inertia.a);
        let geodesic = body(inertia, &inertia.legendre(&m));
        for t in TIMES {
            let elapsed = t - T0;
            let first = ((symmetric - skew * w) * elapsed).exp();
            let second = (skew * ((1.0 + w) * elapsed)).exp();
            let what = format!("{inertia:?}, t = {t}");
            assert_close(
                &geodesic.placement(t, &phi0),
                &(phi0 * first * second),
                tolerance::CLOSED_FORM,
                &what,
            );
        }
    }
}

#[test]
fn a_one_parameter_group_needs_a_normal_velocity() {
    let phi0 = start_in_space().0;
    let inertia = INERTIAS[0];
    let normal = Matrix::<3>::new(0.2, -0.7, 0.0, 0.7, 0.2, 0.0, 0.0, 0.0, -0.3);
    let sheared = Matrix::<3>::new(0.2, -0.7, 0.0, 0.1, 0.2, 0.0, 0.0, 0.0, -0.3);
    let distance = |m: &Matrix<3>| {
        let on_group = phi0 * (m * 2.0).exp();
        let phi = body(inertia, &inertia.legendre(m)).placement(T0 + 2.0, &phi0);
        (phi - on_group).amax() / on_group.amax()
    };
    assert!(distance(&normal) <= tolerance::CLOSED_FORM);
    assert!(distance(&sheared) > 1e-2);
}

#[test]
fn the_centre_of_mass_drifts_uniformly() {
    let (phi0, spin0) = start_in_space();
    let geodesic = space(INERTIAS[0], &spin0, Vector::<3>::new(0.5, -0.25, 2.0));
    let x0 = Vector::<3>::new(1.0, 2.0, -3.0);
    assert_eq!(geodesic.position(T0 + 4.0, &x0), Vector::<3>::new(3.0, 1.0, 5.0));
    assert_eq!(
        space(INERTIAS[0], &spin0, Vector::<3>::zeros()).placement(2.0, &phi0),
        geodesic.placement(2.0, &phi0)
    );
}

#[test]
fn dalembert_motion_is_straight() {
    let phi0 = Matrix::<3>::new(1.25, 0.5, 0.0, -0.25, 1.0, 0.125, 0.0, 0.75, 1.5);
    let phi_dot = Matrix::<3>::new(0.5, -1.0, 0.25, 2.0, 0.0, -0.5, 0.125, 1.0, -0.75);
    let pi = Matrix::<3>::from_diagonal(&Vector::<3>::new(1.0, 1.5, 2.0)) * phi_dot.transpose();
    let geodesic =
        Geodesic { t0: T0, motion: Orbit::Straight { velocity: phi_dot }, drift: Vector::<3>::zeros() };
    assert_eq!(geodesic.placement(T0 + 2.0, &phi0), phi0 + phi_dot + phi_dot);
    assert_eq!(geodesic.spin(T0 + 2.0, &pi), pi);
}

/// Bounded shear: `tr sigma^2 < 0` in the plane (section 5). After a thousand periods the placement is
/// back at its start, to a few roundings of the angle.
#[test]
fn a_bounded_motion_stays_on_its_period() {
    let (alpha, phi0) = (0.8, start_in_plane().0);
    // sigma^2 = -(3/4)^2 1: frequency 3/(4 alpha).
    let sigma_hat = Matrix::<2>::new(0.75, -1.125, 1.0, -0.75);
    let geodesic = body(Inertia { i: 0.0, a: alpha, b: 0.0 }, &sigma_hat);
    let period = core::f64::consts::TAU * alpha / 0.75;
    for periods in [1.0, 10.0, 1000.0] {
        let angle_error = 8.0 * f64::EPSILON * core::f64::consts::TAU * periods;
        let phi = geodesic.placement(T0 + periods * period, &phi0);
        assert_close(&phi, &phi0, angle_error * condition(&phi0) * 2.0, &format!("{periods} periods"));
    }
}

//! The free rigid body, triaxial.

use affine_runtime::__private::point as point_of;
use affine_runtime::frames::{Body, Comoving, Matrix, Vector};
use affine_runtime::geodesic::Geodesic;
use affine_runtime::model::{Conserved, Constraint, Description, Group, Model, Quantity, Velocity};
use affine_runtime::scalar::{Real, Scalar};
use affine_runtime::state::{Phase, PhasePoint, Pinned};

use super::{description, matrix, write};

/// `T = tr(Oh J Oh^T)/2` on skew `Oh`, `J = diag(1.3, 0.9, 0.5)`: `Oh_ab = 2 X_ba/(j_a + j_b)`, `X` the skew `Sigma_hat`.
pub(crate) struct Top;

pub(crate) type Body3<T = f64> = PhasePoint<3, Body, Pinned, T>;

const J: [f64; 3] = [1.3, 0.9, 0.5];
const GROUPS: &[Group] = &[Group::new(Quantity::Placement, 9), Group::new(Quantity::ComovingAffineSpin, 9)];

fn affine_velocity<T: Scalar>(spin: &Matrix<3, T>) -> Matrix<3, T> {
    Matrix::<3, T>::from_fn(|a, b| spin[(b, a)] * T::constant(2.0 / (J[a] + J[b]), 0.0))
}

impl Model<3> for Top {
    const DESCRIPTION: Description = {
        let mut text = description("Top");
        text.full = GROUPS;
        text.reduced = GROUPS;
        text.constraint = Some(Constraint::Rigid);
        text.conserved = &[Conserved::Energy, Conserved::Spin, Conserved::VorticityNorm];
        text.conserved_at_rest = text.conserved;
        text
    };

    type Point<T: Real> = Body3<T>;
    type Reduced<T: Scalar> = [T; 18];
    type Constants<T: Scalar> = ();
    type Full<T: Scalar> = [T; 18];

    fn velocity<T: Real>(&self, point: &Body3<T>) -> Velocity<3, T> {
        let phi_dot = point.phi() * affine_velocity(&point.sigma_hat().0.0);
        Velocity { x_dot: Vector::<3, T>::zeros(), phi_dot }
    }
    fn kinetic_energy<T: Real>(&self, phi: &Matrix<3, T>, velocity: &Velocity<3, T>) -> T {
        let oh = phi.transpose() * velocity.phi_dot;
        let weighted = Matrix::<3, T>::from_fn(|a, b| oh[(a, b)] * T::constant(0.5 * J[b], 0.0));
        weighted.dot(&oh)
    }
    fn hamiltonian<T: Real>(&self, _t: T, point: &Body3<T>) -> T {
        let spin = point.sigma_hat().0.0;
        spin.transpose().dot(&affine_velocity(&spin)) * T::constant(0.5, 0.0)
    }
    fn flatten<T: Real>(&self, point: &Body3<T>) -> [T; 18] {
        let mut flat = [T::zero(); 18];
        write(&mut flat[..9], point.phi());
        write(&mut flat[9..], &point.sigma_hat().0.0);
        flat
    }
    fn unflatten<T: Real>(&self, flat: &[T; 18]) -> Body3<T> {
        point_of(matrix(&flat[..9]), Comoving(matrix(&flat[9..])), Pinned)
    }
    fn hamilton_equations<T: Scalar>(&self, _t: T, flat: &[T; 18]) -> [T; 18] {
        let (phi, spin) = (matrix::<3, T>(&flat[..9]), matrix::<3, T>(&flat[9..]));
        let oh = affine_velocity(&spin);
        let mut rates = [T::zero(); 18];
        write(&mut rates[..9], &(phi * oh));
        write(&mut rates[9..], &(spin * oh - oh * spin));
        rates
    }
    fn reduce<T: Real>(&self, _t0: T, point: &Body3<T>) -> ([T; 18], ()) {
        (self.flatten(point), ())
    }
    fn reduced_equations<T: Scalar>(&self, t: T, _constants: &(), reduced: &[T; 18]) -> [T; 18] {
        self.hamilton_equations(t, reduced)
    }
    fn expand<T: Real>(&self, _t: T, _constants: &(), reduced: &[T; 18]) -> Body3<T> {
        self.unflatten(reduced)
    }
    fn geodesic(&self, _t0: f64, _point: &Body3) -> Option<Geodesic<3>> {
        None
    }
}

/// Turned, with an angular momentum along no axis.
pub(crate) fn start() -> Body3 {
    let (s, c) = 0.4f64.sin_cos();
    let phi = Matrix::<3>::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
    point_of(phi, Comoving(Matrix::<3>::new(0.0, 0.6, -0.4, -0.6, 0.0, 0.3, 0.4, -0.3, 0.0)), Pinned)
}

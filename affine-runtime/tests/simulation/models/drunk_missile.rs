//! The drunk missile, written naively: affine in space, metrical in the body, with translation and without a
//! potential. Nothing is taken out of the state, which is `x, phi, p_hat, Sigma_hat`.

use affine_runtime::__private::point as point_of;
use affine_runtime::frames::{AffineSpin, Body, Comoving, Matrix, Vector};
use affine_runtime::geodesic::Geodesic;
use affine_runtime::model::{Conserved, Description, Group, LeftOut, Model, Quantity, Scope, Velocity};
use affine_runtime::scalar::{Real, Scalar};
use affine_runtime::state::{Centre, Phase, PhasePoint};

use super::{description, inverse, isotropic_energy, matrix, write};

/// `T = |v_hat|^2/2 + tr(Oh^T Oh)/2 + (A tr Oh^2 + B (tr Oh)^2)/2` with `I = m = 1`, `A = 1/5`, `B = 1/10`.
pub(crate) struct DrunkMissile;

pub(crate) type Missile<T = f64> = PhasePoint<3, Body, Centre<3, T>, T>;

const GROUPS: &[Group] = &[
    Group::new(Quantity::Position, 3),
    Group::new(Quantity::Placement, 9),
    Group::new(Quantity::ComovingLinearMomentum, 3),
    Group::new(Quantity::ComovingAffineSpin, 9),
];

/// `Oh = Sh^T/I~ + Sh/A~ + tr(Sh)/B~` with the reciprocals `25/24, -5/24, -5/90` at these coefficients:
/// `I/(I^2-A^2) = 1/0.96`, `A/(A^2-I^2) = -0.2/0.96`, `-B/((I+A)(I+A+3B)) = -0.1/1.8`.
fn affine_velocity<T: Scalar>(spin: &Matrix<3, T>) -> Matrix<3, T> {
    let ratio = |n: f64, d: f64| T::constant(n, 0.0) / T::constant(d, 0.0);
    let trace = (spin[(0, 0)] + spin[(1, 1)] + spin[(2, 2)]) * ratio(-1.0, 18.0);
    let mut velocity = spin.transpose() * ratio(25.0, 24.0) + spin * ratio(-5.0, 24.0);
    for a in 0..3 {
        velocity[(a, a)] += trace;
    }
    velocity
}

impl Model<3> for DrunkMissile {
    const DESCRIPTION: Description = {
        let mut text = description("DrunkMissile");
        text.full = GROUPS;
        text.reduced = GROUPS;
        text.conserved = &[
            Conserved::Energy,
            Conserved::LinearMomentum,
            Conserved::TotalAffineMomentum,
            Conserved::TotalAngularMomentum,
            Conserved::Vorticity,
            Conserved::VorticityNorm,
        ];
        text.conserved_at_rest =
            &[Conserved::Energy, Conserved::AffineSpin, Conserved::Vorticity, Conserved::Casimir2];
        text.left_out = &[LeftOut { what: "nothing: a naive fixture", scope: Scope::Model }];
        text
    };

    type Point<T: Real> = Missile<T>;
    type Reduced<T: Scalar> = [T; 24];
    type Constants<T: Scalar> = ();
    type Full<T: Scalar> = [T; 24];

    fn velocity<T: Real>(&self, point: &Missile<T>) -> Velocity<3, T> {
        let p_hat = point.phi().tr_mul(&point.p());
        Velocity {
            x_dot: point.phi() * p_hat,
            phi_dot: point.phi() * affine_velocity(&point.sigma_hat().0.0),
        }
    }

    fn kinetic_energy<T: Real>(&self, phi: &Matrix<3, T>, velocity: &Velocity<3, T>) -> T {
        let v_hat = inverse(phi) * velocity.x_dot;
        let internal = isotropic_energy(&(inverse(phi) * velocity.phi_dot), [1.0, 0.2, 0.1]);
        internal + v_hat.dot(&v_hat) * T::constant(0.5, 0.0)
    }

    fn hamiltonian<T: Real>(&self, _t: T, point: &Missile<T>) -> T {
        let spin = &point.sigma_hat().0.0;
        let p_hat = point.phi().tr_mul(&point.p());
        let half = T::constant(0.5, 0.0);
        half * (p_hat.dot(&p_hat) + spin.transpose().dot(&affine_velocity(spin)))
    }

    fn flatten<T: Real>(&self, point: &Missile<T>) -> [T; 24] {
        let mut flat = [T::zero(); 24];
        flat[..3].copy_from_slice(point.x().as_slice());
        write(&mut flat[3..12], point.phi());
        flat[12..15].copy_from_slice(point.phi().tr_mul(&point.p()).as_slice());
        write(&mut flat[15..24], &point.sigma_hat().0.0);
        flat
    }

    fn unflatten<T: Real>(&self, flat: &[T; 24]) -> Missile<T> {
        let phi = matrix(&flat[3..12]);
        let p_hat = Vector::<3, T>::from_column_slice(&flat[12..15]);
        let centre =
            Centre { x: Vector::<3, T>::from_column_slice(&flat[..3]), p: inverse(&phi).tr_mul(&p_hat) };
        point_of(phi, Comoving(matrix(&flat[15..24])), centre)
    }

    /// `x' = phi p_hat/m`, `phi' = phi Oh`, `p_hat' = Oh^T p_hat`, `Sh' = [Sh, Oh] - p_hat p_hat^T/m`.
    fn hamilton_equations<T: Scalar>(&self, _t: T, flat: &[T; 24]) -> [T; 24] {
        let (phi, spin): (Matrix<3, T>, Matrix<3, T>) = (matrix(&flat[3..12]), matrix(&flat[15..24]));
        let p_hat = Vector::<3, T>::from_column_slice(&flat[12..15]);
        let velocity = affine_velocity(&spin);
        let mut rates = [T::zero(); 24];
        rates[..3].copy_from_slice((phi * p_hat).as_slice());
        write(&mut rates[3..12], &(phi * velocity));
        rates[12..15].copy_from_slice((velocity.transpose() * p_hat).as_slice());
        write(&mut rates[15..24], &(spin * velocity - velocity * spin - p_hat * p_hat.transpose()));
        rates
    }

    fn reduce<T: Real>(&self, _t0: T, point: &Missile<T>) -> ([T; 24], ()) {
        (self.flatten(point), ())
    }

    fn reduced_equations<T: Scalar>(&self, t: T, _constants: &(), reduced: &[T; 24]) -> [T; 24] {
        self.hamilton_equations(t, reduced)
    }

    fn expand<T: Real>(&self, _t: T, _constants: &(), reduced: &[T; 24]) -> Missile<T> {
        self.unflatten(reduced)
    }

    fn geodesic(&self, _t0: f64, _point: &Missile) -> Option<Geodesic<3>> {
        None
    }

    fn on_geodesic(&self, _geodesic: &Geodesic<3>, _t: f64, start: &Missile) -> Missile {
        *start
    }
}

/// The start of the benchmark problem: `x = 0`, `p = (0.3, -0.2, 0.5)`.
pub(crate) fn start() -> Missile {
    let centre = Centre { x: Vector::<3>::zeros(), p: Vector::<3>::new(0.3, -0.2, 0.5) };
    point_of(super::phi0(), Comoving(super::spin0()), centre)
}

/// The same with `p = 0`.
pub(crate) fn start_at_rest() -> Missile {
    let centre = Centre { x: Vector::<3>::zeros(), p: Vector::<3>::zeros() };
    affine_runtime::__private::phase_point(super::phi0(), Comoving(AffineSpin(super::spin0())), centre)
        .unwrap()
}

/// The start of the benchmark problem after a rotation of space: `phi -> Q phi`, `p -> Q p`, same `Sigma_hat`.
pub(crate) fn turned_start(turn: &Matrix<3>) -> Missile {
    let centre = Centre { x: Vector::<3>::zeros(), p: turn * start().p() };
    point_of(turn * super::phi0(), Comoving(super::spin0()), centre)
}

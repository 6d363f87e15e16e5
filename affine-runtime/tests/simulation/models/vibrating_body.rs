//! An isotropic body affine in space and metrical in the body, pinned, with a dilatational and an isochoric
//! neo-Hookean potential. The state is `phi, Sigma_hat, r` with `r = (det phi)^(-1/3)`, which makes the equations
//! rational.

use affine_runtime::__private::point as point_of;
use affine_runtime::frames::{Body, Comoving, Matrix};
use affine_runtime::geodesic::Geodesic;
use affine_runtime::model::{Conserved, Description, Group, LeftOut, Model, Quantity, Scope, Velocity};
use affine_runtime::scalar::{Real, Scalar};
use affine_runtime::state::{Phase, PhasePoint, Pinned};

use super::{description, inverse, isotropic_energy, matrix, write};

/// `T = (I tr(Oh^T Oh) + A tr Oh^2 + B (tr Oh)^2)/2`, `U = (kappa/2) sinh^2 q + c1 (r^2 tr G - 3)`.
pub(crate) struct VibratingBody {
    pub(crate) i: f64,
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) kappa: f64,
    pub(crate) c1: f64,
}

pub(crate) type Body3<T = f64> = PhasePoint<3, Body, Pinned, T>;

const GROUPS: &[Group] = &[
    Group::new(Quantity::Placement, 9),
    Group::new(Quantity::ComovingAffineSpin, 9),
    Group::new(Quantity::Other("r"), 1),
];

impl VibratingBody {
    /// The benchmark problem "vibrating body".
    pub(crate) const BENCHMARK: Self = Self { i: 1.0, a: 0.2, b: 0.1, kappa: 10.0, c1: 0.5 };

    pub(crate) fn affine_velocity<T: Scalar>(&self, spin: &Matrix<3, T>) -> Matrix<3, T> {
        let Self { i, a, b, .. } = *self;
        let number = |value: f64| T::constant(value, 0.0);
        let trace = (spin[(0, 0)] + spin[(1, 1)] + spin[(2, 2)]) * number(-b / ((i + a) * (i + a + 3.0 * b)));
        let determinant = i * i - a * a;
        let mut velocity = spin.transpose() * number(i / determinant) + spin * number(-a / determinant);
        for k in 0..3 {
            velocity[(k, k)] += trace;
        }
        velocity
    }

    fn rates<T: Scalar>(
        &self,
        phi: Matrix<3, T>,
        spin: Matrix<3, T>,
        r: T,
    ) -> (Matrix<3, T>, Matrix<3, T>, T) {
        let number = |value: f64| T::constant(value, 0.0);
        let velocity = self.affine_velocity(&spin);
        let green = phi.transpose() * phi;
        let trace = green[(0, 0)] + green[(1, 1)] + green[(2, 2)];
        // Qh = -(U'(q)/3) 1 - 2 c1 r^2 (G - tr(G)/3), U'(q) = (kappa/4)(r^-2 - r^2), r = exp(-q).
        let shear = r * r * number(-2.0 * self.c1);
        let slope = (T::one() / (r * r) - r * r) * number(self.kappa / 4.0);
        let mut force = green * shear;
        for k in 0..3 {
            force[(k, k)] -= (shear * trace + slope) / number(3.0);
        }
        let expansion = velocity[(0, 0)] + velocity[(1, 1)] + velocity[(2, 2)];
        (phi * velocity, spin * velocity - velocity * spin + force, -r * expansion / number(3.0))
    }
}

impl Model<3> for VibratingBody {
    const DESCRIPTION: Description = {
        let mut text = description("VibratingBody");
        text.full = GROUPS;
        text.reduced = GROUPS;
        text.conserved = &[Conserved::Energy, Conserved::Spin, Conserved::Vorticity, Conserved::SpinNorm];
        text.conserved_at_rest = text.conserved;
        text.left_out = &[LeftOut { what: "x and p: the model has no translation", scope: Scope::Model }];
        text
    };

    type Point<T: Real> = Body3<T>;
    type Reduced<T: Scalar> = [T; 19];
    type Constants<T: Scalar> = ();
    type Full<T: Scalar> = [T; 19];

    fn velocity<T: Real>(&self, point: &Body3<T>) -> Velocity<3, T> {
        let phi_dot = point.phi() * self.affine_velocity(&point.sigma_hat().0.0);
        Velocity { x_dot: point.x(), phi_dot }
    }

    fn kinetic_energy<T: Real>(&self, phi: &Matrix<3, T>, velocity: &Velocity<3, T>) -> T {
        isotropic_energy(&(inverse(phi) * velocity.phi_dot), [self.i, self.a, self.b])
    }

    fn hamiltonian<T: Real>(&self, _t: T, point: &Body3<T>) -> T {
        let number = |value: f64| T::constant(value, 0.0);
        let spin = &point.sigma_hat().0.0;
        let r = self.flatten(point)[18];
        let r_squared = r * r;
        let kinetic = spin.transpose().dot(&self.affine_velocity(spin)) * number(0.5);
        let dilatational = (r_squared + T::one() / r_squared - number(2.0)) * number(self.kappa / 8.0);
        kinetic + dilatational + (r_squared * point.phi().dot(point.phi()) - number(3.0)) * number(self.c1)
    }

    fn flatten<T: Real>(&self, point: &Body3<T>) -> [T; 19] {
        let mut flat = [T::zero(); 19];
        write(&mut flat[..9], point.phi());
        write(&mut flat[9..18], &point.sigma_hat().0.0);
        let row = |i: usize| point.phi().row(i).transpose();
        let determinant = row(0).dot(&row(1).cross(&row(2)));
        flat[18] = (-(determinant.ln() / T::from_f64(3.0))).exp();
        flat
    }

    fn unflatten<T: Real>(&self, flat: &[T; 19]) -> Body3<T> {
        point_of(matrix(&flat[..9]), Comoving(matrix(&flat[9..18])), Pinned)
    }

    fn hamilton_equations<T: Scalar>(&self, _t: T, flat: &[T; 19]) -> [T; 19] {
        let (phi, spin, r) = self.rates(matrix(&flat[..9]), matrix(&flat[9..18]), flat[18]);
        let mut rates = [r; 19];
        write(&mut rates[..9], &phi);
        write(&mut rates[9..18], &spin);
        rates
    }

    fn reduce<T: Real>(&self, _t0: T, point: &Body3<T>) -> ([T; 19], ()) {
        (self.flatten(point), ())
    }

    fn reduced_equations<T: Scalar>(&self, t: T, _constants: &(), reduced: &[T; 19]) -> [T; 19] {
        self.hamilton_equations(t, reduced)
    }

    fn expand<T: Real>(&self, _t: T, _constants: &(), reduced: &[T; 19]) -> Body3<T> {
        self.unflatten(reduced)
    }

    fn geodesic(&self, _t0: f64, _point: &Body3) -> Option<Geodesic<3>> {
        None
    }

    fn on_geodesic(&self, _geodesic: &Geodesic<3>, _t: f64, start: &Body3) -> Body3 {
        *start
    }
}

/// The start of the benchmark problem.
pub(crate) fn start() -> Body3 {
    point_of(super::phi0(), Comoving(super::spin0()), Pinned)
}

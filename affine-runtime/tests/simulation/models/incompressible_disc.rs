//! The planar body of d'Alembert under `det phi = 1`, on the algebra of that group: another form than the macro writes.

use affine_runtime::__private::{Unconstrained, point};
use affine_runtime::frames::{Body, Comoving, Matrix, Vector};
use affine_runtime::model::{Constraint, Description, Group, Handle, Model, Quantity, Velocity};
use affine_runtime::scalar::{Real, Scalar};
use affine_runtime::state::{Phase, PhasePoint, Pinned};

use super::planar::Planar;

/// `H = (|phi_dot|^2 + |phi|^2)/2` on `det phi = 1`, `tr(phi^-1 phi_dot) = 0`.
pub(crate) struct IncompressibleDisc;

pub(crate) type Drop<T = f64> = PhasePoint<2, Body, Pinned, T>;

type Square<T> = [[T; 2]; 2];

fn product<T: Scalar>(a: Square<T>, b: Square<T>) -> Square<T> {
    let entry = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

fn transposed<T: Scalar>([[a, b], [c, d]]: Square<T>) -> Square<T> {
    [[a, c], [b, d]]
}

/// `G = phi^T phi`, and `Oh` from `Sigma_hat = P(Oh^T G)`: `Oh = G^-1 (Sigma_hat^T + lambda)`, `tr Oh = 0`.
fn velocity<T: Scalar>(phi: Square<T>, spin: Square<T>) -> [Square<T>; 2] {
    let green = product(transposed(phi), phi);
    let [[g, h], [_, k]] = green;
    let inverse = [[k, -h], [-h, g]];
    let free = product(inverse, transposed(spin));
    let lambda = -(free[0][0] + free[1][1]) / (g + k);
    let entry = |i: usize, j: usize| free[i][j] + lambda * inverse[i][j];
    [green, [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]]
}

fn squares<T: Scalar>([a, b, c, d, e, f, g, h]: [T; 8]) -> [Square<T>; 2] {
    [[[a, b], [c, d]], [[e, f], [g, h]]]
}

impl Model<2> for IncompressibleDisc {
    const DESCRIPTION: Description = {
        let groups = &[Group::new(Quantity::Placement, 4), Group::new(Quantity::ComovingAffineSpin, 4)];
        Description {
            name: "IncompressibleDisc",
            constraint: Some(Constraint::Isochoric),
            full: groups,
            reduced: groups,
            second_order: false,
            series: true,
            ..<Planar>::DESCRIPTION
        }
    };

    type Point<T: Real> = Drop<T>;
    type Reduced<T: Scalar> = [T; 8];
    type Constants<T: Scalar> = ();
    type Full<T: Scalar> = [T; 8];

    fn velocity<T: Real>(&self, point: &Drop<T>) -> Velocity<2, T> {
        let [phi, spin] = squares(self.flatten(point));
        let [_, [[a, b], [c, d]]] = velocity(phi, spin);
        let phi_dot = point.phi() * Matrix::<2, T>::new(a, b, c, d);
        Velocity { x_dot: Vector::<2, T>::zeros(), phi_dot }
    }
    fn kinetic_energy<T: Real>(&self, phi: &Matrix<2, T>, velocity: &Velocity<2, T>) -> T {
        Planar::SPRING.kinetic_energy(phi, velocity)
    }
    fn hamiltonian<T: Real>(&self, _t: T, point: &Drop<T>) -> T {
        let (phi, velocity) = (point.phi(), self.velocity(point).phi_dot);
        let twice = |m: &Matrix<2, T>| m.iter().fold(T::zero(), |sum, entry| entry.fma(*entry, sum));
        (twice(phi) + twice(&velocity)) * T::constant(0.5, 0.0)
    }
    fn flatten<T: Real>(&self, point: &Drop<T>) -> [T; 8] {
        let (phi, spin) = (point.phi(), point.sigma_hat().0.0);
        let entry = |m: &Matrix<2, T>, k: usize| m[(k / 2, k % 2)];
        core::array::from_fn(|k| if k < 4 { entry(phi, k) } else { entry(&spin, k - 4) })
    }
    fn unflatten<T: Real>(&self, full: &[T; 8]) -> Drop<T> {
        let matrix = |from: usize| Matrix::<2, T>::from_fn(|i, j| full[from + 2 * i + j]);
        point(matrix(0), Comoving(matrix(4)), Pinned)
    }
    /// `phi' = phi Oh`, `Sigma_hat' = P(Oh^T G Oh - G)`.
    fn hamilton_equations<T: Scalar>(&self, _t: T, full: &[T; 8]) -> [T; 8] {
        let [phi, spin] = squares(*full);
        let [green, oh] = velocity(phi, spin);
        let phi_dot = product(phi, oh);
        let rate = product(transposed(oh), product(green, oh));
        let rate = |i: usize, j: usize| rate[i][j] - green[i][j];
        let half = (rate(0, 0) - rate(1, 1)) * T::constant(0.5, 0.0);
        let [[a, b], [c, d]] = phi_dot;
        [a, b, c, d, half, rate(0, 1), rate(1, 0), -half]
    }
    fn reduce<T: Real>(&self, _t0: T, point: &Drop<T>) -> ([T; 8], ()) {
        (self.flatten(point), ())
    }
    fn reduced_equations<T: Scalar>(&self, t: T, _constants: &(), reduced: &[T; 8]) -> [T; 8] {
        self.hamilton_equations(t, reduced)
    }
    fn expand<T: Real>(&self, _t: T, _constants: &(), reduced: &[T; 8]) -> Drop<T> {
        self.unflatten(reduced)
    }
    fn unconstrained(_model: impl Handle<2, Model = Self>) -> Option<impl Unconstrained> {
        Some(Free)
    }
}

/// `phi' = Pi^T`, `Pi' = -phi^T`.
struct Free;

impl Unconstrained for Free {
    type State = [f64; 8];
    const GROUPS: &'static [Group] = <Planar>::DESCRIPTION.full;

    fn rates(&self, t: f64, state: &[f64; 8]) -> [f64; 8] {
        Planar::SPRING.hamilton_equations(t, state)
    }
}

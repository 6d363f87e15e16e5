//! The planar body of d'Alembert under `det phi = 1`: its equations are the free ones, as the macro writes them.

use affine_runtime::frames::Matrix;
use affine_runtime::geodesic::Geodesic;
use affine_runtime::model::{Constraint, Description, Model, Velocity};
use affine_runtime::scalar::{Real, Scalar};

use super::planar::{Disc, Planar};

/// `H = (|Pi|^2 + |phi|^2)/2` on `det phi = 1`, `tr(phi^-1 phi_dot) = 0`.
pub(crate) struct IncompressibleDisc;

impl Model<2> for IncompressibleDisc {
    const DESCRIPTION: Description = Description {
        name: "IncompressibleDisc",
        constraint: Some(Constraint::Isochoric),
        ..<Planar>::DESCRIPTION
    };

    type Point<T: Real> = Disc<T>;
    type Reduced<T: Scalar> = [T; 8];
    type Constants<T: Scalar> = ();
    type Full<T: Scalar> = [T; 8];

    fn velocity<T: Real>(&self, point: &Disc<T>) -> Velocity<2, T> {
        Planar::SPRING.velocity(point)
    }
    fn kinetic_energy<T: Real>(&self, phi: &Matrix<2, T>, velocity: &Velocity<2, T>) -> T {
        Planar::SPRING.kinetic_energy(phi, velocity)
    }
    fn hamiltonian<T: Real>(&self, t: T, point: &Disc<T>) -> T {
        Planar::SPRING.hamiltonian(t, point)
    }
    fn flatten<T: Real>(&self, point: &Disc<T>) -> [T; 8] {
        Planar::SPRING.flatten(point)
    }
    fn unflatten<T: Real>(&self, full: &[T; 8]) -> Disc<T> {
        Planar::SPRING.unflatten(full)
    }
    fn hamilton_equations<T: Scalar>(&self, t: T, full: &[T; 8]) -> [T; 8] {
        Planar::SPRING.hamilton_equations(t, full)
    }
    fn reduce<T: Real>(&self, t0: T, point: &Disc<T>) -> ([T; 8], ()) {
        Planar::SPRING.reduce(t0, point)
    }
    fn reduced_equations<T: Scalar>(&self, t: T, constants: &(), reduced: &[T; 8]) -> [T; 8] {
        Planar::SPRING.reduced_equations(t, constants, reduced)
    }
    fn expand<T: Real>(&self, t: T, constants: &(), reduced: &[T; 8]) -> Disc<T> {
        Planar::SPRING.expand(t, constants, reduced)
    }
    fn geodesic(&self, _t0: f64, _point: &Disc) -> Option<Geodesic<2>> {
        None
    }
}

//! The d'Alembert body in the plane with unit inertia: `phi'' = -k phi + drive(t)`. Free (`k = 0`, no drive) its
//! placement moves along a straight line, the one closed form that needs no exponential; with a spring it swings
//! through `det phi = 0` as through anything else.

use affine_runtime::__private::point as point_of;
use affine_runtime::frames::{Canonical, Matrix, TwoPoint, Vector};
use affine_runtime::geodesic::{Geodesic, Orbit};
use affine_runtime::model::{Conserved, Description, Group, Model, Quantity, Regularity, Velocity};
use affine_runtime::scalar::{Real, Scalar};
use affine_runtime::state::{Phase, PhasePoint, Pinned};

use super::{description, matrix, write};

/// `H = (|Pi|^2 + k |phi|^2)/2`, with a force that turns infinite at the time `singular_at`. A driven body does not say that it
/// keeps its energy. Where `is_weighed`, it says that its mass matrix has the pivot `phi22`, and where not `IN_PI`, that its
/// momentum is another than that of a flat metric.
pub(crate) struct Planar<const DRIVEN: bool = false, const IN_PI: bool = true> {
    pub(crate) spring: f64,
    pub(crate) singular_at: Option<f64>,
    pub(crate) is_weighed: bool,
}

pub(crate) type Disc<T = f64> = PhasePoint<2, Canonical, Pinned, T>;

const GROUPS: &[Group] = &[Group::new(Quantity::Placement, 4), Group::new(Quantity::CanonicalMomentum, 4)];
const OTHER_GROUPS: &[Group] = &[Group::new(Quantity::Placement, 4), Group::new(Quantity::AffineSpin, 4)];

impl Planar {
    pub(crate) const FREE: Self = Self { spring: 0.0, singular_at: None, is_weighed: false };
    pub(crate) const SPRING: Self = Self { spring: 1.0, singular_at: None, is_weighed: false };
}

impl Planar<false, false> {
    pub(crate) const OTHERWISE: Self = Self { spring: 1.0, singular_at: None, is_weighed: false };
}

impl<const DRIVEN: bool, const IN_PI: bool> Model<2> for Planar<DRIVEN, IN_PI> {
    const DESCRIPTION: Description = {
        let mut text = description("Planar");
        text.full = if IN_PI { GROUPS } else { OTHER_GROUPS };
        text.reduced = GROUPS;
        text.conserved = match DRIVEN {
            false => &[Conserved::Energy, Conserved::Spin, Conserved::Vorticity],
            true => &[],
        };
        text.conserved_at_rest = text.conserved;
        text
    };

    type Point<T: Real> = Disc<T>;
    type Reduced<T: Scalar> = [T; 8];
    type Constants<T: Scalar> = ();
    type Full<T: Scalar> = [T; 8];

    fn velocity<T: Real>(&self, point: &Disc<T>) -> Velocity<2, T> {
        Velocity { x_dot: Vector::<2, T>::zeros(), phi_dot: point.pi().0.0.transpose() }
    }

    fn kinetic_energy<T: Real>(&self, _phi: &Matrix<2, T>, velocity: &Velocity<2, T>) -> T {
        velocity.phi_dot.dot(&velocity.phi_dot) * T::constant(0.5, 0.0)
    }

    fn hamiltonian<T: Real>(&self, _t: T, point: &Disc<T>) -> T {
        let (phi, pi) = (point.phi(), point.pi().0.0);
        (pi.dot(&pi) + phi.dot(phi) * T::constant(self.spring, 0.0)) * T::constant(0.5, 0.0)
    }

    fn regularity(&self, phi: &Matrix<2>) -> Option<Regularity> {
        let pivot = phi[(1, 1)];
        self.is_weighed.then(|| Regularity { negative: usize::from(pivot < 0.0), weakest: pivot.abs() })
    }

    fn flatten<T: Real>(&self, point: &Disc<T>) -> [T; 8] {
        let mut flat = [T::zero(); 8];
        write(&mut flat[..4], point.phi());
        write(&mut flat[4..], &point.pi().0.0);
        flat
    }

    fn unflatten<T: Real>(&self, flat: &[T; 8]) -> Disc<T> {
        point_of(matrix(&flat[..4]), TwoPoint(matrix(&flat[4..])), Pinned)
    }

    fn hamilton_equations<T: Scalar>(&self, t: T, flat: &[T; 8]) -> [T; 8] {
        let mut force = matrix::<2, T>(&flat[..4]).transpose() * T::constant(-self.spring, 0.0);
        if let Some(singular_at) = self.singular_at {
            let gap = T::constant(singular_at, 0.0) - t;
            force[(0, 0)] += T::one() / (gap * gap);
        }
        let mut rates = [T::zero(); 8];
        write(&mut rates[..4], &matrix::<2, T>(&flat[4..]).transpose());
        write(&mut rates[4..], &force);
        rates
    }

    fn reduce<T: Real>(&self, _t0: T, point: &Disc<T>) -> ([T; 8], ()) {
        (self.flatten(point), ())
    }

    fn reduced_equations<T: Scalar>(&self, t: T, _constants: &(), reduced: &[T; 8]) -> [T; 8] {
        self.hamilton_equations(t, reduced)
    }

    fn expand<T: Real>(&self, _t: T, _constants: &(), reduced: &[T; 8]) -> Disc<T> {
        self.unflatten(reduced)
    }

    fn geodesic(&self, t0: f64, point: &Disc) -> Option<Geodesic<2>> {
        (self.spring == 0.0 && self.singular_at.is_none()).then(|| Geodesic {
            t0,
            motion: Orbit::Straight { velocity: point.pi().0.0.transpose() },
            drift: Vector::<2>::zeros(),
        })
    }

    fn on_geodesic(&self, geodesic: &Geodesic<2>, t: f64, start: &Disc) -> Disc {
        let Orbit::Straight { velocity } = geodesic.motion else { unreachable!("made above") };
        point_of(start.phi() + velocity * (t - geodesic.t0), TwoPoint(start.pi().0.0), Pinned)
    }

    fn collapse(&self, geodesic: &Geodesic<2>, t_end: f64, start: &Matrix<2>) -> Option<f64> {
        geodesic.collapse(t_end, start)
    }
}

/// A stretched placement whose first row moves by `rate` per unit of time.
pub(crate) fn start(rate: f64) -> Disc {
    point_of(Matrix::<2>::new(1.0, 0.2, 0.0, 1.5), TwoPoint(Matrix::<2>::new(rate, 0.1, 0.0, -0.2)), Pinned)
}

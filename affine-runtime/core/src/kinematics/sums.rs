//! Sums and differences of like quantities in one frame.

use core::ops::{Add, Sub};

use super::deformation::{InertialQuadrupole, Strain};
use super::momenta::{AffineMomentum, AngularMomentum, LinearMomentum, Vorticity};
use super::velocities::LinearVelocity;
use crate::frames::{AffineSpin, AffineVelocity, Comoving, Spatial, TwoPoint};
use crate::scalar::Real;

macro_rules! sums_in_frame {
    ($($frame:ident)*) => {$(
        impl<Q: Add<Output = Q>> Add for $frame<Q> {
            type Output = Self;
            fn add(self, other: Self) -> Self {
                Self(self.0 + other.0)
            }
        }
        impl<Q: Sub<Output = Q>> Sub for $frame<Q> {
            type Output = Self;
            fn sub(self, other: Self) -> Self {
                Self(self.0 - other.0)
            }
        }
    )*};
}

macro_rules! sums {
    ($($quantity:ident)*) => {$(
        impl<const N: usize, T: Real> Add for $quantity<N, T> {
            type Output = Self;
            fn add(self, other: Self) -> Self {
                Self(self.0 + other.0)
            }
        }
        impl<const N: usize, T: Real> Sub for $quantity<N, T> {
            type Output = Self;
            fn sub(self, other: Self) -> Self {
                Self(self.0 - other.0)
            }
        }
    )*};
}

sums_in_frame!(Spatial Comoving TwoPoint);
// Not the deformation tensors: a sum of two metrics is not the metric of a deformation.
sums!(AffineVelocity AffineSpin LinearVelocity LinearMomentum AngularMomentum Vorticity AffineMomentum);
sums!(Strain InertialQuadrupole);

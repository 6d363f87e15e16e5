//! Sums and differences of like quantities in one frame.

use core::ops::{Add, Sub};

use super::deformation::{InertialQuadrupole, Strain};
use super::momenta::{AffineMomentum, AngularMomentum, LinearMomentum, Vorticity};
use super::velocities::LinearVelocity;
use crate::frames::{AffineSpin, AffineVelocity, Comoving, Spatial, TwoPoint};
use crate::scalar::Real;

macro_rules! termwise {
    ($trait:ident, $method:ident, $sign:tt) => {
        termwise!($trait, $method, $sign, Spatial Comoving TwoPoint;
            // Not the deformation tensors: a sum of two metrics is not the metric of a deformation.
            AffineVelocity AffineSpin LinearVelocity LinearMomentum AngularMomentum Vorticity AffineMomentum
            Strain InertialQuadrupole);
    };
    ($trait:ident, $method:ident, $sign:tt, $($frame:ident)*; $($quantity:ident)*) => {
        $(impl<Q: $trait<Output = Q>> $trait for $frame<Q> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        })*
        $(impl<const N: usize, T: Real> $trait for $quantity<N, T> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        })*
    };
}

termwise!(Add, add, +);
termwise!(Sub, sub, -);

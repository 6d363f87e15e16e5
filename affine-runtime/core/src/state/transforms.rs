//! Phase points as transformations of nalgebra: `a -> x + phi a`.

use nalgebra::{Affine2, Affine3, Isometry2, Isometry3, Rotation2, Rotation3, Translation2, Translation3};

use super::{Euclidean, PhasePoint};
use crate::decompose::Polar;
use crate::frames::{Frame, Matrix};
use crate::parts::{Basis, Translation};
use crate::state::Phase;

macro_rules! transforms {
    ($n:literal, $affine:ident, $isometry:ident, $rotation:ident, $translation:ident) => {
        impl<F: Frame, C: Translation<$n, f64>, B: Basis> From<&PhasePoint<$n, F, C, f64, B>>
            for $affine<f64>
        {
            /// `a -> x + phi a`.
            fn from(point: &PhasePoint<$n, F, C, f64, B>) -> Self {
                let mut homogeneous = point.phi().to_homogeneous();
                homogeneous.fixed_view_mut::<$n, 1>(0, $n).copy_from(&point.x());
                Self::from_matrix_unchecked(homogeneous)
            }
        }

        impl<F: Frame, C: Translation<$n, f64>, B: Basis> From<&PhasePoint<$n, F, C, f64, B>>
            for $isometry<f64>
        where
            PhasePoint<$n, F, C, f64, B>: Euclidean,
        {
            /// `a -> x + R a` with the rotation of the polar decomposition `phi = R U`: `phi` itself of a rigid body.
            fn from(point: &PhasePoint<$n, F, C, f64, B>) -> Self {
                let rotation =
                    Polar::of(point.phi()).map_or_else(|_| Matrix::<$n>::identity(), |polar| polar.rotation);
                let rotation = $rotation::from_matrix_unchecked(rotation);
                Self::from_parts($translation::from(point.x()), rotation.into())
            }
        }
    };
}
transforms!(2, Affine2, Isometry2, Rotation2, Translation2);
transforms!(3, Affine3, Isometry3, Rotation3, Translation3);

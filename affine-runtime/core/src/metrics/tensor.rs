//! Components of tensors in the bases of a model with metrics.

use super::Bases;
use crate::frames::{Comoving, Matrix, Spatial};
use crate::kinematics::{AngularMomentum, DeformationTensor, InverseDeformationTensor, Strain, Vorticity};
use crate::scalar::Real;

/// A tensor with two indices in space, or two in the body, read off a phase point in orthonormal bases.
pub trait Tensor<const N: usize, T: Real = f64> {
    /// Its components in the bases from which `bases` leads to orthonormal ones; `None` where these are orthonormal:
    /// `F^T X F` of two lower indices, `F^-1 X F^-T` of two upper ones, with `F = A` in space and `F = B` in the body.
    fn components(&self, bases: Option<&Bases<N, T>>) -> Matrix<N, T>;
}

/// The law of each tensor, with its factor on the left and its factor on the right.
macro_rules! tensors {
    ($($tensor:ty: |$x:ident, $bases:ident| $components:expr;)*) => {$(
        impl<const N: usize, T: Real> Tensor<N, T> for $tensor {
            fn components(&self, bases: Option<&Bases<N, T>>) -> Matrix<N, T> {
                let $x = self.0.0;
                bases.map_or($x, |$bases| $components)
            }
        }
    )*};
}

tensors! {
    Comoving<DeformationTensor<N, T>>: |x, bases| bases.body.tr_mul(&x) * bases.body;
    Comoving<InverseDeformationTensor<N, T>>: |x, bases| bases.body_inverse * x * bases.body_inverse.transpose();
    Comoving<Strain<N, T>>: |x, bases| bases.body.tr_mul(&x) * bases.body;
    Comoving<Vorticity<N, T>>: |x, bases| bases.body_inverse * x * bases.body_inverse.transpose();
    Spatial<DeformationTensor<N, T>>: |x, bases| bases.space.tr_mul(&x) * bases.space;
    Spatial<InverseDeformationTensor<N, T>>: |x, bases| bases.space_inverse * x * bases.space_inverse.transpose();
    Spatial<Strain<N, T>>: |x, bases| bases.space.tr_mul(&x) * bases.space;
    Spatial<AngularMomentum<N, T>>: |x, bases| bases.space.tr_mul(&x) * bases.space;
}

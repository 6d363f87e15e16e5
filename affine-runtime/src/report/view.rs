//! The deformed unit ball `{x + phi u : |u| <= 1}` as seen from a fixed direction.

use core::f64::consts::{PI, TAU};

use crate::decompose::LinearMap;
use crate::frames::{Matrix, Vector};

/// A point of the picture plane: to the right, upward.
pub(super) type Planar = (f64, f64);

/// Corners of an ellipse drawn as a polygon.
const OUTLINE_CORNERS: usize = 96;
/// Points of a half circle drawn as a line.
const ARC_POINTS: usize = 49;

/// Azimuth and elevation of the eye in space, in degrees: no axis foreshortened to nothing, none like another.
const EYE: (f64, f64) = (35.0, 25.0);

/// Orthographic projection along a fixed direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct View<const N: usize> {
    right: Vector<N>,
    up: Vector<N>,
    /// Unit vector to the eye; `None` in the plane.
    eye: Option<Vector<N>>,
}

impl<const N: usize> View<N> {
    /// The plane itself for `n = 2`; for `n = 3` an oblique view from azimuth 35 and elevation 25 degrees, with
    /// the third axis upward.
    pub(super) fn new() -> Self {
        if N < 3 {
            return Self { right: vector([1.0, 0.0, 0.0]), up: vector([0.0, 1.0, 0.0]), eye: None };
        }
        let (sin_a, cos_a) = EYE.0.to_radians().sin_cos();
        let (sin_e, cos_e) = EYE.1.to_radians().sin_cos();
        Self {
            right: vector([-sin_a, cos_a, 0.0]),
            up: vector([-sin_e * cos_a, -sin_e * sin_a, cos_e]),
            eye: Some(vector([cos_e * cos_a, cos_e * sin_a, sin_e])),
        }
    }

    /// The picture of a vector.
    pub(super) fn project(&self, v: &Vector<N>) -> Planar {
        (self.right.dot(v), self.up.dot(v))
    }

    /// Outline of the deformed unit ball about its centre. With `A = P phi`, `P` the projection, it is the image
    /// of the unit circle under the symmetric root of `A A^T`:
    /// `sqrt(M) = (M + sqrt(det M) 1)/sqrt(tr M + 2 sqrt(det M))` for a 2x2 matrix `M`.
    pub(super) fn outline(&self, phi: &Matrix<N>) -> Vec<Planar> {
        let (right, up) = (phi.tr_mul(&self.right), phi.tr_mul(&self.up));
        let (m11, m12, m22) = (right.dot(&right), right.dot(&up), up.dot(&up));
        let root = (m11 * m22 - m12 * m12).max(0.0).sqrt();
        let scale = 1.0 / (m11 + m22 + 2.0 * root).sqrt();
        let (r11, r12, r22) = (scale * (m11 + root), scale * m12, scale * (m22 + root));
        let corner = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / OUTLINE_CORNERS as f64).sin_cos();
            (r11 * cos + r12 * sin, r12 * cos + r22 * sin)
        };
        (0..OUTLINE_CORNERS).map(corner).collect()
    }

    /// What is painted on the body, about its centre, as far as the eye sees it: for `n = 3` the images of the
    /// three great circles in the coordinate planes of the body, for `n = 2` the image of its first axis.
    ///
    /// `phi u` of the surface faces the eye `d` where its normal `phi^-T u` does: `u . phi^-1 d > 0`, which holds
    /// on one half of each circle.
    pub(super) fn marks(&self, phi: &Matrix<N>) -> Vec<Vec<Planar>> {
        let axis = |a: usize| phi.column(a).clone_owned();
        let Some(eye) = self.eye else {
            return vec![vec![(0.0, 0.0), self.project(&axis(0))]];
        };
        let facing = phi.inverse() * eye;
        let half_circle = |(a, b): (usize, usize)| {
            let middle = facing[b].atan2(facing[a]);
            let point = |k: usize| {
                let (sin, cos) = (middle + PI * (k as f64 / (ARC_POINTS - 1) as f64 - 0.5)).sin_cos();
                self.project(&(axis(a) * cos + axis(b) * sin))
            };
            (0..ARC_POINTS).map(point).collect()
        };
        [(0, 1), (1, 2), (2, 0)].map(half_circle).into()
    }
}

/// The first `N` of three components.
fn vector<const N: usize>(components: [f64; 3]) -> Vector<N> {
    Vector::from_fn(|a, _| components.get(a).copied().unwrap_or(0.0))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Rounding of a dozen operations on numbers below 4.
    const ROUNDING: f64 = 2e-15;

    fn sheared() -> Matrix<3> {
        Matrix::<3>::new(1.2, 0.4, -0.3, 0.1, 0.7, 0.5, -0.2, 0.3, 1.5)
    }

    #[test]
    fn the_view_is_a_right_handed_orthonormal_frame() {
        let view = View::<3>::new();
        let eye = view.eye.unwrap();
        assert!((view.right.cross(&view.up) - eye).norm() < ROUNDING);
        assert!((eye.norm() - 1.0).abs() < ROUNDING && (view.up.norm() - 1.0).abs() < ROUNDING);
        assert!(view.project(&Vector::<3>::z()).0 == 0.0 && view.project(&Vector::<3>::z()).1 > 0.0);
        assert_eq!(View::<2>::new().project(&Vector::<2>::new(3.0, -4.0)), (3.0, -4.0));
    }

    #[test]
    fn the_outline_is_the_support_of_the_projected_ball() {
        // The support function of {A u} is h(w) = |A^T w|: no outline point beyond it, and one touches it.
        let (view, phi) = (View::<3>::new(), sheared());
        let outline = view.outline(&phi);
        for k in 0..16 {
            let (sin, cos) = (TAU * f64::from(k) / 16.0).sin_cos();
            let support = phi.tr_mul(&(view.right * cos + view.up * sin)).norm();
            let reached = outline.iter().map(|(x, y)| x * cos + y * sin).fold(f64::MIN, f64::max);
            // A polygon of 96 corners stays within 1 - cos(pi/96) of the ellipse, relative to its long axis.
            assert!(reached <= support + ROUNDING && reached > support - 2.0 * (1.0 - (PI / 96.0).cos()));
        }
    }

    #[test]
    fn the_outline_in_the_plane_is_the_deformed_circle() {
        let phi = Matrix::<2>::new(2.0, 0.5, -0.3, 0.8);
        let back = phi.inverse();
        for (x, y) in View::<2>::new().outline(&phi) {
            assert!(((back * Vector::<2>::new(x, y)).norm() - 1.0).abs() < ROUNDING);
        }
    }

    #[test]
    fn marks_face_the_eye_and_end_on_the_outline() {
        let (view, phi) = (View::<3>::new(), sheared());
        let marks = view.marks(&phi);
        assert_eq!(marks.len(), 3);
        for arc in &marks {
            for &(x, y) in [&arc[0], &arc[arc.len() - 1]] {
                // On the outline: the largest value of |P phi u| in its own direction, M^-1 of which is 1.
                let (right, up) = (phi.tr_mul(&view.right), phi.tr_mul(&view.up));
                let m = Matrix::<2>::new(right.dot(&right), right.dot(&up), right.dot(&up), up.dot(&up));
                let z = Vector::<2>::new(x, y);
                assert!((z.dot(&(m.inverse() * z)) - 1.0).abs() < 10.0 * ROUNDING);
            }
        }
        // The undeformed ball: the middle of the arc in the plane of the axes 1 and 2 lies straight below the eye.
        let middle = view.marks(&Matrix::<3>::identity())[0][ARC_POINTS / 2];
        assert!(middle.0.abs() < ROUNDING && (middle.1 + EYE.1.to_radians().sin()).abs() < ROUNDING);
    }
}

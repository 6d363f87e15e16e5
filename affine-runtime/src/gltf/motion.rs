//! A motion frame by frame, and what lies between the frames.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion};

use crate::decompose::TwoPolar;
use crate::frames::{Matrix, Vector};
use crate::simulate::Trajectory;
use crate::state::Phase;

/// The body at one time, counted from the start in either direction.
pub(super) struct Frame<const N: usize> {
    pub(super) t: f64,
    pub(super) x: Vector<N>,
    pub(super) phi: Matrix<N>,
}

/// Start, outputs and end, but for those that single precision does not tell from the one before.
pub(super) fn frames<const N: usize, P: Phase<N>>(run: &Trajectory<N, P>) -> Vec<Frame<N>> {
    let mut frames: Vec<Frame<N>> = Vec::with_capacity(run.len() + 2);
    for (t, point) in run.samples() {
        let t = (t - run.start().0).abs();
        if frames.last().is_none_or(|last| t as f32 > last.t as f32) {
            frames.push(Frame { t, x: point.x(), phi: *point.phi() });
        }
    }
    frames
}

/// `phi = L D R^T` in three dimensions.
pub(super) struct Factors {
    left: UnitQuaternion<f64>,
    pub(super) stretches: [f64; 3],
    right: UnitQuaternion<f64>,
}

/// Errors between frames, relative to the size of the body, that nobody sees.
const INVISIBLE: f64 = 1e-3;

/// The two-polar factors of all frames, each continued from its neighbour; `None` where a placement is too thin to have any,
/// and where straight lines between placements are nearer to the motion.
pub(super) fn factors<const N: usize>(frames: &[Frame<N>]) -> Option<Vec<Factors>> {
    let mut all: Vec<Factors> = Vec::with_capacity(frames.len());
    for found in continued(frames)? {
        all.push(Factors::of(&found, all.last()));
    }
    let (mut turned, mut straight, mut floor) = (0.0, 0.0, 0.0);
    for (near, factors) in frames.windows(4).zip(all.windows(4)) {
        let middle = in_space(&between(near));
        turned += (factors[1].half_way(&factors[2]) - middle).norm_squared();
        straight += (in_space(&(near[1].phi + near[2].phi)) * 0.5 - middle).norm_squared();
        floor += (INVISIBLE * middle.norm()).powi(2);
    }
    (turned <= straight || turned <= floor).then_some(all)
}

/// From where stretches are furthest apart, in either direction: a body that starts undeformed has no axes there.
fn continued<const N: usize>(frames: &[Frame<N>]) -> Option<Vec<TwoPolar<N>>> {
    let mut all: Vec<TwoPolar<N>> = Vec::with_capacity(frames.len());
    for frame in frames {
        all.push(TwoPolar::of(&frame.phi).ok()?);
    }
    let apart = |found: &TwoPolar<N>| {
        let ratios = (1..N).map(|a| found.stretches[a - 1] / found.stretches[a]);
        ratios.fold(f64::INFINITY, f64::min)
    };
    let (start, _) = all.iter().enumerate().max_by(|(_, a), (_, b)| apart(a).total_cmp(&apart(b)))?;
    for k in start + 1..frames.len() {
        all[k] = all[k - 1].continued(&frames[k].phi).ok()?;
    }
    for k in (0..start).rev() {
        all[k] = all[k + 1].continued(&frames[k].phi).ok()?;
    }
    Some(all)
}

impl Factors {
    /// Of the two quaternions of a rotation the one nearer to that of the frame before.
    fn of<const N: usize>(found: &TwoPolar<N>, before: Option<&Self>) -> Self {
        let quaternion = |rotation: &Matrix<N>, before: Option<&UnitQuaternion<f64>>| {
            let rotation = nalgebra::Rotation3::from_matrix_unchecked(in_space(rotation));
            let found = UnitQuaternion::from_rotation_matrix(&rotation);
            let is_far = before.is_some_and(|before| before.coords.dot(&found.coords) < 0.0);
            if is_far { UnitQuaternion::new_unchecked(-found.into_inner()) } else { found }
        };
        Self {
            left: quaternion(&found.left, before.map(|before| &before.left)),
            stretches: core::array::from_fn(|k| if k < N { found.stretches[k] } else { 1.0 }),
            right: quaternion(&found.right, before.map(|before| &before.right)),
        }
    }

    /// `x`, `y`, `z`, `w` of `L`.
    pub(super) fn left(&self) -> [f64; 4] {
        components(&self.left)
    }

    /// Those of `R^T`.
    pub(super) fn right_transposed(&self) -> [f64; 4] {
        components(&self.right.conjugate())
    }

    /// The placement half way to the next frame, of rotations that turn evenly and stretches that grow so.
    fn half_way(&self, next: &Self) -> Matrix3<f64> {
        let [left, right] = [(&self.left, &next.left), (&self.right, &next.right)].map(|(a, b)| {
            UnitQuaternion::new_normalize(a.into_inner() + b.into_inner()).to_rotation_matrix()
        });
        let stretches = core::array::from_fn(|k| 0.5 * (self.stretches[k] + next.stretches[k]));
        left.matrix() * Matrix3::from_diagonal(&<[f64; 3]>::into(stretches)) * right.matrix().transpose()
    }
}

fn components(rotation: &Quaternion<f64>) -> [f64; 4] {
    [rotation.i, rotation.j, rotation.k, rotation.w]
}

/// A matrix of the plane leaves the third axis as it is.
fn in_space<const N: usize>(matrix: &Matrix<N>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| if i < N && j < N { matrix[(i, j)] } else { f64::from(u8::from(i == j)) })
}

/// The placement half way between the second and the third of four frames, on the cubic through them all: nearer to a smooth
/// motion than either way to interpolate.
fn between<const N: usize>(frames: &[Frame<N>]) -> Matrix<N> {
    let t = 0.5 * (frames[1].t + frames[2].t);
    let weight = |one: &Frame<N>| {
        let others = frames.iter().filter(|other| other.t != one.t);
        others.map(|other| (t - other.t) / (one.t - other.t)).product::<f64>()
    };
    frames.iter().map(|frame| frame.phi * weight(frame)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A body that turns by a fifth from frame to frame, with stretches that differ by this much and by no rule.
    fn turning(noise: f64) -> Vec<Frame<3>> {
        let stretch = |k: usize| {
            let random = |a: usize| ((k * k + 1) as f64 * (a * a + 3) as f64 * 12.9898).sin();
            let entries = Matrix::<3>::from_fn(|i, j| random(i + j + 4 * i * j));
            Matrix::<3>::identity() + entries * noise
        };
        let rotation = |k: usize| nalgebra::Rotation3::from_euler_angles(0.2 * k as f64, 0.1 * k as f64, 0.3);
        (0..40)
            .map(|k| Frame { t: k as f64, x: Vector::zeros(), phi: rotation(k).matrix() * stretch(k) })
            .collect()
    }

    #[test]
    fn coincident_stretches_have_no_axes() {
        assert!(factors(&turning(0.0)).is_some(), "rotations alone: axes turn as near as they can");
        assert!(factors(&turning(1e-9)).is_none(), "axes of rounding errors jump");
    }
}

//! The motion of a run as glTF, for viewers and modellers.

mod document;
mod motion;
mod shape;

use std::io;
use std::path::Path;

use gltf_json::accessor::Type;
use gltf_json::animation::Property;
use gltf_json::mesh::{MorphTarget, Semantic};

use crate::error::{Error, Result};
use crate::frames::Vector;
use crate::simulate::Trajectory;
use crate::state::Phase;
use document::{Clip, Document, Part};
use motion::{Factors, Frame, factors, frames};
pub use shape::Shape;

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// The motion as a file of binary glTF 2.0 (`.glb`): a mesh of the shape, and an animation in which a unit of time is a
    /// second. Keyframes are the start, the outputs and the end; a run backward in time plays in the order of its outputs. Bodies
    /// of a model with `metrics(...)` are shown in orthonormal bases. The third axis points upward.
    ///
    /// glTF animates translations, rotations and scales, and no matrices. So `x + phi u` is the road through three nodes,
    /// `phi = L D R^T` with rotations `L`, `R` and stretches `D`, continued along the motion by
    /// [`TwoPolar::continued`](crate::decompose::TwoPolar::continued). At keyframes it is exact to single precision; between
    /// them rotations turn evenly. Where stretches coincide for long, or nearly so, their axes are those of rounding errors and
    /// jump. Where straight lines between the placements are nearer to the motion than such rotations are, the animation has
    /// them instead: `n^2` morph targets `e_i u_A` with the weights `phi_iA - phi_iA(t0)`. Viewers shade these flat.
    ///
    /// ```no_run
    /// use affine_runtime::gltf::Shape;
    /// use affine_runtime::prelude::*;
    ///
    /// #[affine_model(dim = 3, kinetic(dalembert = 1, space_translation = 1), potential = orthogonality(2) + x[3])]
    /// struct Block;
    ///
    /// let (x, v) = (Vector::<3>::zeros(), Vector::<3>::new(1.0, 0.0, 3.0));
    /// let start = Block.at_velocity(x, Matrix::<3>::identity(), v, Matrix::<3>::new(0.2, -1.0, 0.0, 1.0, 0.0, 0.5, 0.0, 0.0, -0.3))?;
    /// let run = Simulation::new(&Block, start).until(5.0).every(0.02).run()?;
    /// run.save_glb("block.glb", &Shape::cuboid(Vector::<3>::new(2.0, 2.0, 2.0)))?;
    /// # Ok::<(), affine_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`InvalidData`](io::ErrorKind::InvalidData) for a shape without points, a triangle of points that it does not have, numbers
    /// that are none in single precision, and more than 4 GiB.
    pub fn to_glb(&self, shape: &Shape<N>) -> io::Result<Vec<u8>> {
        if let Some(fault) = shape.fault() {
            return Err(io::Error::new(io::ErrorKind::InvalidData, fault));
        }
        let frames = frames(self);
        let mut document = Document::new(self.description().name);
        let times = frames.iter().map(|frame| frame.t);
        let mut clip = Clip::new(document.floats(Type::Scalar, times, None));
        let inner = match factors(&frames) {
            Some(factors) => by_factors(&mut document, &mut clip, shape, &factors),
            None => by_weights(&mut document, &mut clip, shape, &frames),
        };
        // It is the inner node that moves with the centre, whichever it is.
        let places = frames.iter().flat_map(|frame| three(&frame.x));
        document.animate(&mut clip, inner, Property::Translation, Type::Vec3, places);
        document.finish(clip, inner, N == 3)
    }

    /// Writes [`to_glb`](Self::to_glb) to a file.
    ///
    /// # Errors
    /// [`Error::File`] with path and kind of the failure, of those of [`to_glb`](Self::to_glb) too.
    pub fn save_glb(&self, path: impl AsRef<Path>, shape: &Shape<N>) -> Result<()> {
        let path = path.as_ref();
        let written = self.to_glb(shape).and_then(|bytes| std::fs::write(path, bytes));
        written.map_err(|error| Error::File { path: path.to_path_buf(), kind: error.kind() })
    }
}

/// Nodes for `L`, `D` and `R^T`, one in the other; the outermost.
fn by_factors<const N: usize>(
    document: &mut Document,
    clip: &mut Clip,
    shape: &Shape<N>,
    factors: &[Factors],
) -> Part {
    let points = document.points(shape.points().map(three));
    let normals = shape.normals().map(|normals| document.points(normals.map(three)));
    let attributes = [(Semantic::Positions, Some(points)), (Semantic::Normals, normals)];
    let mesh = document.mesh(shape, &attributes, None);
    let right = document.node("R^T", None, Some(mesh));
    let stretches = document.node("D", Some(right), None);
    let left = document.node("L", Some(stretches), None);
    let turns = |of: fn(&Factors) -> [f64; 4]| factors.iter().flat_map(of);
    document.animate(clip, left, Property::Rotation, Type::Vec4, turns(Factors::left));
    let scales = factors.iter().flat_map(|factors| factors.stretches);
    document.animate(clip, stretches, Property::Scale, Type::Vec3, scales);
    document.animate(clip, right, Property::Rotation, Type::Vec4, turns(Factors::right_transposed));
    left
}

/// A mesh at the first placement with a target for each entry of `phi`.
fn by_weights<const N: usize>(
    document: &mut Document,
    clip: &mut Clip,
    shape: &Shape<N>,
    frames: &[Frame<N>],
) -> Part {
    let first = frames[0].phi;
    let points = document.points(shape.points().map(|point| three(&(first * point))));
    let entries = || (0..N).flat_map(|i| (0..N).map(move |a| (i, a)));
    let mut target = |(i, a): (usize, usize)| {
        let moved = shape
            .points()
            .map(|point| three(&Vector::<N>::from_fn(|k, _| if k == i { point[a] } else { 0.0 })));
        MorphTarget { positions: Some(document.points(moved)), normals: None, tangents: None }
    };
    let targets: Vec<MorphTarget> = entries().map(&mut target).collect();
    let mesh = document.mesh(shape, &[(Semantic::Positions, Some(points))], Some(targets));
    let body = document.node("phi", None, Some(mesh));
    let weights = frames.iter().flat_map(|frame| entries().map(move |entry| frame.phi[entry] - first[entry]));
    document.animate(clip, body, Property::MorphTargetWeights, Type::Scalar, weights);
    body
}

/// Vectors of the plane lie in that of the first two axes.
fn three<const N: usize>(vector: &Vector<N>) -> [f64; 3] {
    core::array::from_fn(|k| if k < N { vector[k] } else { 0.0 })
}

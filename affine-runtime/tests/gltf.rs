//! Motions as glTF, read back by another crate: what its nodes do at keyframes is what the run says, to single precision.
#![cfg(feature = "gltf")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_runtime::gltf::Shape;
use affine_runtime::prelude::*;
use gltf::animation::util::ReadOutputs;
use gltf::animation::{Interpolation, Property};
use gltf::{Gltf, Node};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

#[affine_model(dim = 3, kinetic(dalembert = 1, space_translation = 1), potential = orthogonality(2) + x[3])]
struct Block;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = neo_hookean(0.5) + 2*q^2)]
struct Disc;

#[affine_model(
    dim = 2,
    metrics(space = diag(4, 1), body = diag(1, 1)),
    kinetic(casimir2 = 0.2, body_inertia = 1)
)]
struct Skew;

#[affine_model(dim = 3, kinetic(dalembert = 1))]
struct Free;

/// Its stretches stay apart.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)
)]
struct Missile;

/// What is animated of one node, at keyframes.
struct Track {
    node: usize,
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
    property: Property,
}

/// A file that was read.
struct Read {
    file: Gltf,
    tracks: Vec<Track>,
}

impl Read {
    fn new(bytes: &[u8]) -> Self {
        // The container of binary glTF: its length, and whole words.
        assert_eq!(bytes[..8], *b"glTF\x02\0\0\0");
        assert_eq!(u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize, bytes.len());
        assert_eq!(bytes.len() % 4, 0);
        let file = Gltf::from_slice(bytes).unwrap();
        let blob = file.blob.clone().unwrap();
        let animation = file.animations().next().unwrap();
        let track = |channel: gltf::animation::Channel<'_>| {
            assert_eq!(channel.sampler().interpolation(), Interpolation::Linear);
            let reader = channel.reader(|_| Some(&blob));
            let times: Vec<f64> = reader.read_inputs().unwrap().map(f64::from).collect();
            let wide = |values: &[f32]| values.iter().map(|value| f64::from(*value)).collect::<Vec<f64>>();
            let values = match reader.read_outputs().unwrap() {
                ReadOutputs::Translations(all) => all.map(|value| wide(&value)).collect(),
                ReadOutputs::Scales(all) => all.map(|value| wide(&value)).collect(),
                ReadOutputs::Rotations(all) => all.into_f32().map(|value| wide(&value)).collect(),
                ReadOutputs::MorphTargetWeights(all) => {
                    let all: Vec<f32> = all.into_f32().collect();
                    all.chunks(all.len() / times.len()).map(wide).collect()
                }
            };
            Track {
                node: channel.target().node().index(),
                times,
                values,
                property: channel.target().property(),
            }
        };
        let tracks = animation.channels().map(track).collect();
        Self { file, tracks }
    }

    /// A property of a node at a time: linear between keyframes, rotations along great circles.
    fn value(&self, node: &Node<'_>, property: Property, t: f64) -> Option<Vec<f64>> {
        let track =
            self.tracks.iter().find(|track| track.node == node.index() && track.property == property)?;
        let next = track.times.partition_point(|time| *time < t).clamp(1, track.times.len() - 1);
        let w = (t - track.times[next - 1]) / (track.times[next] - track.times[next - 1]);
        let (a, b) = (&track.values[next - 1], &track.values[next]);
        if property == Property::Rotation {
            let [a, b] =
                [a, b].map(|q| UnitQuaternion::new_normalize(Quaternion::new(q[3], q[0], q[1], q[2])));
            let turned = a.slerp(&b, w);
            return Some(turned.coords.iter().copied().collect());
        }
        Some(a.iter().zip(b).map(|(a, b)| a + w * (b - a)).collect())
    }

    /// The points of the mesh in the scene at a time.
    fn points(&self, t: f64) -> Vec<Vector3<f64>> {
        let scene = self.file.scenes().next().unwrap();
        let (mut matrix, mut shift) = (Matrix3::identity(), Vector3::zeros());
        let mut node = scene.nodes().next().unwrap();
        loop {
            let (translation, rotation, scale) = node.transform().decomposed();
            let wide = |values: &[f32]| values.iter().map(|value| f64::from(*value)).collect::<Vec<f64>>();
            let at = |property, rest: &[f32]| self.value(&node, property, t).unwrap_or_else(|| wide(rest));
            shift += matrix * Vector3::from_vec(at(Property::Translation, &translation));
            let q = at(Property::Rotation, &rotation);
            let turn =
                UnitQuaternion::new_normalize(Quaternion::new(q[3], q[0], q[1], q[2])).to_rotation_matrix();
            matrix *= turn.matrix() * Matrix3::from_diagonal(&Vector3::from_vec(at(Property::Scale, &scale)));
            if let Some(mesh) = node.mesh() {
                let blob = self.file.blob.as_ref().unwrap();
                let primitive = mesh.primitives().next().unwrap();
                let reader = primitive.reader(|_| Some(blob));
                let three = |point: [f32; 3]| Vector3::from(point.map(f64::from));
                let mut points: Vec<Vector3<f64>> = reader.read_positions().unwrap().map(three).collect();
                let weights = self.value(&node, Property::MorphTargetWeights, t).unwrap_or_default();
                for ((moved, _, _), weight) in reader.read_morph_targets().zip(weights) {
                    points
                        .iter_mut()
                        .zip(moved.unwrap())
                        .for_each(|(point, moved)| *point += three(moved) * weight);
                }
                return points.into_iter().map(|point| shift + matrix * point).collect();
            }
            node = node.children().next().unwrap();
        }
    }

    fn names(&self) -> Vec<&str> {
        self.file.nodes().map(|node| node.name().unwrap()).collect()
    }
}

/// `x + phi u` in the scene, whose second axis points upward where there are three.
fn expected<const N: usize>(x: &Vector<N>, phi: &Matrix<N>, u: &Vector<N>) -> Vector3<f64> {
    let y = x + phi * u;
    if N == 3 { Vector3::new(y[0], y[2], -y[1]) } else { Vector3::new(y[0], y[1], 0.0) }
}

/// A shape of four points in general position, of which any affine map can be read off.
fn tetrahedron<const N: usize>() -> (Vec<Vector<N>>, Shape<N>) {
    let corner = |k: usize| Vector::<N>::from_fn(|a, _| if a + 1 == k { 1.0 } else { 0.125 });
    let points: Vec<Vector<N>> = (0..=N).map(corner).collect();
    (points.clone(), Shape::mesh(points, [[0, 1, 2]]))
}

/// Largest distance at a time of the file's points from those of a phase point, in parts of the largest distance from the origin.
fn error<const N: usize, P: Phase<N>>(read: &Read, elapsed: f64, point: &P, u: &[Vector<N>]) -> f64 {
    let wanted: Vec<Vector3<f64>> = u.iter().map(|u| expected(&point.x(), point.phi(), u)).collect();
    let size = wanted.iter().map(|y| y.norm()).fold(0.0, f64::max);
    let found = read.points(elapsed);
    assert_eq!(found.len(), wanted.len());
    found.iter().zip(&wanted).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max) / size
}

/// Rounding of single precision: of a vertex, three factors and a sum, in a chain of four nodes.
const SINGLE: f64 = 8.0 * f32::EPSILON as f64;

/// At all keyframes the file is the run.
fn assert_exact<const N: usize, P: Phase<N>>(run: &Trajectory<N, P>) -> Read {
    let (points, shape) = tetrahedron::<N>();
    let read = Read::new(&run.to_glb(&shape).unwrap());
    let at =
        |(t, point): (f64, &P)| error(&read, (t - run.start().0).abs(), &run.orthonormal(point), &points);
    let worst = run.iter().chain([run.start(), run.end()]).map(at).fold(0.0, f64::max);
    println!("{:?}: {worst:.1e} at keyframes", read.names());
    assert!(worst < SINGLE, "{worst:e}");
    read
}

fn flown(every: f64) -> Trajectory<3, <Missile as Model<3>>::Point<f64>> {
    let start = Missile.at_momentum(
        Vector::<3>::zeros(),
        Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05),
        Vector::<3>::new(0.3, -0.2, 0.5),
        Comoving(Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05)),
    );
    Simulation::new(&Missile, start.unwrap()).until(6.0).every(every).dense().run().unwrap()
}

fn thrown(every: f64) -> Trajectory<3, <Block as Model<3>>::Point<f64>> {
    let (x, v) = (Vector::<3>::zeros(), Vector::<3>::new(1.0, 0.0, 3.0));
    let rate = Matrix::<3>::new(0.2, -1.0, 0.0, 1.0, 0.0, 0.5, 0.0, 0.0, -0.3);
    let start = Block.at_velocity(x, Matrix::<3>::identity(), v, rate).unwrap();
    Simulation::new(&Block, start).until(6.0).every(every).dense().run().unwrap()
}

#[test]
fn keyframes_are_exact_and_what_lies_between_is_near() {
    let (coarse, fine) = (between(&flown(0.1), "L"), between(&flown(0.05), "L"));
    assert!(fine < 2e-4, "{fine:e}");
    assert!(coarse / fine > 3.5, "of second order: {coarse:e} {fine:e}");
    // Stretches of about 1 that come near one another, from a start without any.
    for every in [0.1, 0.05, 0.02] {
        let found = between(&thrown(every), "");
        assert!(found < f64::max(1e-3, 0.3 * every * every), "{found:e}");
    }
}

/// Largest error half way between keyframes.
fn between<P: Phase<3>>(run: &Trajectory<3, P>, node: &str) -> f64 {
    let read = assert_exact(run);
    assert!(node.is_empty() || read.names().contains(&node));
    let (points, _) = tetrahedron::<3>();
    let middles = run.times().windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let error = |t: f64| error(&read, t, &run.orthonormal(&run.at(t).unwrap()), &points);
    let found = middles.map(error).fold(0.0, f64::max);
    println!("{:?}: {found:.1e} between {} keyframes", read.names(), run.len());
    found
}

#[test]
fn discs_stay_in_their_plane() {
    let start = Disc.at_velocity(Matrix::<2>::identity(), Matrix::<2>::new(0.3, 0.5, -0.2, 0.1)).unwrap();
    for t_end in [3.0, -3.0] {
        let run = Simulation::new(&Disc, start).from(0.5).until(0.5 + t_end).every(0.05).run().unwrap();
        let read = assert_exact(&run);
        assert!(read.points(1.0).iter().all(|point| point.z == 0.0));
    }
}

#[test]
fn bodies_with_metrics_are_shown_in_orthonormal_bases() {
    let spin = Comoving(Matrix::<2>::new(0.1, 0.3, -0.2, 0.2));
    let start = Skew.at_momentum(Matrix::<2>::identity(), spin).unwrap();
    assert_exact(&Simulation::new(&Skew, start).until(1.0).every(0.5).run().unwrap());
}

/// A body at rest at one instant is a file all the same.
#[test]
fn an_instant_is_a_keyframe() {
    let start = Disc.at_velocity(Matrix::<2>::new(2.0, 0.5, -0.3, 0.8), Matrix::<2>::zeros()).unwrap();
    let run = Simulation::new(&Disc, start).until(0.0).run().unwrap();
    let read = Read::new(&run.to_glb(&Shape::ball()).unwrap());
    assert!(read.tracks.iter().all(|track| track.times == [0.0] && track.values.len() == 1));
}

/// The free motion `phi = 1 + t V` with few outputs: straight lines are exact, and rotations that turn evenly are not.
#[test]
fn straight_motions_have_targets() {
    let rate = Matrix::<3>::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.5, 0.0, -0.5, 0.0);
    let start = Free.at_velocity(Matrix::<3>::identity(), rate).unwrap();
    let run = Simulation::new(&Free, start).until(4.0).every(0.5).dense().run().unwrap();
    let read = assert_exact(&run);
    assert_eq!(read.names(), ["phi", "space"]);
    let (points, _) = tetrahedron::<3>();
    for k in 0..40 {
        let t = 0.1 * f64::from(k);
        assert!(error(&read, t, &run.at(t).unwrap(), &points) < SINGLE, "{t}");
    }
}

/// Triangles look outward: what they enclose has the volume of the shape. Divergence of `y/3`, or area by Green's formula.
fn enclosed<const N: usize>(shape: &Shape<N>, run: &Trajectory<N, impl Phase<N>>) -> (f64, usize) {
    let file = Gltf::from_slice(&run.to_glb(shape).unwrap()).unwrap();
    let blob = file.blob.as_ref().unwrap();
    let mesh = file.meshes().next().unwrap();
    let mut volume = 0.0;
    for primitive in mesh.primitives() {
        let reader = primitive.reader(|_| Some(blob));
        let points: Vec<Vector3<f64>> =
            reader.read_positions().unwrap().map(|point| Vector3::from(point.map(f64::from))).collect();
        let corners: Vec<usize> = reader.read_indices().unwrap().into_u32().map(|k| k as usize).collect();
        for [a, b, c] in corners.chunks(3).map(|three| [three[0], three[1], three[2]].map(|k| points[k])) {
            volume += if N == 3 { a.dot(&b.cross(&c)) / 6.0 } else { (b - a).cross(&(c - a)).z / 2.0 };
        }
        if let Some(normals) = reader.read_normals() {
            for (normal, point) in normals.zip(&points) {
                let normal = Vector3::from(normal.map(f64::from));
                assert!((normal.norm() - 1.0).abs() < 1e-6 && normal.dot(point) > 0.0);
            }
        }
    }
    (volume, mesh.primitives().count())
}

#[test]
fn shapes_look_outward() {
    let (body, disc) = (thrown(0.5), {
        let start = Disc.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
        Simulation::new(&Disc, start).until(1.0).every(0.5).run().unwrap()
    });
    let near = |(found, colours): (f64, usize), volume: f64, part: f64| {
        assert!((found / volume - 1.0).abs() < part, "{found} for {volume}");
        assert_eq!(colours, 3);
    };
    let pi = core::f64::consts::PI;
    near(enclosed(&Shape::cuboid(Vector::<3>::new(1.0, 2.0, 3.0)), &body), 6.0, 1e-6);
    near(enclosed(&Shape::cuboid(Vector::<2>::new(1.0, 2.0)), &disc), 2.0, 1e-6);
    // Polyhedra inside the ellipsoid.
    near(enclosed(&Shape::ellipsoid(Vector::<3>::new(1.0, 2.0, 3.0)), &body), 8.0 * pi, 5e-3);
    near(enclosed(&Shape::ellipsoid(Vector::<2>::new(1.0, 2.0)), &disc), 2.0 * pi, 5e-3);
}

#[test]
fn what_no_file_can_hold_is_refused() {
    let run = thrown(0.5);
    let point = Vector::<3>::zeros();
    for shape in [
        Shape::points_alone([]),
        Shape::mesh([point; 3], [[0, 1, 3]]),
        Shape::points_alone([Vector::<3>::new(1e39, 0.0, 0.0)]),
    ] {
        assert_eq!(run.to_glb(&shape).unwrap_err().kind(), std::io::ErrorKind::InvalidData);
        let error = run.save_glb("no such folder/body.glb", &shape).unwrap_err().to_string();
        assert!(error.contains("the format does not hold it") && !error.contains("permissions"), "{error}");
    }
    let said = |shape: Shape<3>| run.to_glb(&shape).unwrap_err().to_string();
    assert_eq!(said(Shape::points_alone([])), "a shape without points");
    assert!(said(Shape::mesh([point; 3], [[0, 1, 3]])).contains("triangles of points"));
    let path = std::env::temp_dir().join(format!("affine-{}.glb", std::process::id()));
    run.save_glb(&path, &Shape::points_alone([point])).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), run.to_glb(&Shape::points_alone([point])).unwrap());
    std::fs::remove_file(&path).unwrap();
    assert!(run.save_glb(path.join("no such folder"), &Shape::ball()).is_err());
}

//! What a body looks like.

use core::f64::consts::{PI, TAU};

use crate::frames::Vector;

/// A body in its own coordinates: points, and triangles between them. In the plane it is a disc, a rectangle, or any flat mesh.
///
/// Balls and cuboids have two colours, which alternate from octant to octant, and a third one where the first axis of the body
/// comes out.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape<const N: usize> {
    points: Vec<Vector<N>>,
    /// Unit normals, where the surface is smooth.
    normals: Vec<Vector<N>>,
    /// One list a colour.
    triangles: [Vec<[u32; 3]>; 3],
}

/// Points around a ball; half as many from pole to pole.
const AROUND: usize = 64;
/// What has the third colour: points further out along the first axis, in parts of the way.
const CAP: f64 = 0.95;

impl<const N: usize> Shape<N> {
    /// The unit ball, or the unit disc.
    #[must_use]
    pub fn ball() -> Self {
        Self::ellipsoid(Vector::<N>::repeat(1.0))
    }

    /// An ellipsoid, or an ellipse, with semi-axes along the axes of the body.
    #[must_use]
    pub fn ellipsoid(semi_axes: Vector<N>) -> Self {
        let mut shape = Self::bare();
        let around = |v: f64| (TAU * v).sin_cos();
        if N == 2 {
            shape.patch((AROUND / 4, AROUND), |u, v| {
                let (sin, cos) = around(v);
                vector([u * cos, u * sin, 0.0])
            });
        } else {
            shape.patch((AROUND / 2, AROUND), |u, v| {
                let ((ring, height), (sin, cos)) = ((PI * u).sin_cos(), around(v));
                vector([ring * cos, ring * sin, height])
            });
            let normal = |point: &Vector<N>| point.component_div(&semi_axes).normalize();
            shape.normals = shape.points.iter().map(normal).collect();
        }
        shape.scaled(&semi_axes)
    }

    /// A cuboid, or a rectangle, about the origin with edges of these lengths along the axes of the body.
    #[must_use]
    pub fn cuboid(edges: Vector<N>) -> Self {
        let mut shape = Self::bare();
        if N == 2 {
            // Narrow strips, so that there is one with the third colour.
            shape.patch((40, 2), |u, v| vector([2.0 * u - 1.0, 2.0 * v - 1.0, 0.0]));
        } else {
            for (axis, side) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
                shape.patch((2, 2), |u, v| {
                    let mut point = [0.0; 3];
                    point[axis] = side;
                    // Turned so that all faces look outward.
                    point[(axis + 1) % 3] = side * (2.0 * u - 1.0);
                    point[(axis + 2) % 3] = 2.0 * v - 1.0;
                    vector(point)
                });
            }
        }
        shape.scaled(&(edges * 0.5))
    }

    /// Points of your own, without a surface.
    #[must_use]
    pub fn points_alone(points: impl IntoIterator<Item = Vector<N>>) -> Self {
        Self::mesh(points, [])
    }

    /// Points of your own, and triangles of three of them each, counted from 0. It has one colour.
    #[must_use]
    pub fn mesh(
        points: impl IntoIterator<Item = Vector<N>>,
        triangles: impl IntoIterator<Item = [u32; 3]>,
    ) -> Self {
        let mut shape = Self::bare();
        shape.points.extend(points);
        shape.triangles[0].extend(triangles);
        shape
    }

    fn bare() -> Self {
        Self { points: Vec::new(), normals: Vec::new(), triangles: Default::default() }
    }

    fn scaled(mut self, factors: &Vector<N>) -> Self {
        self.points.iter_mut().for_each(|point| point.component_mul_assign(factors));
        self
    }

    /// Adds a grid of points over `0 <= u, v <= 1` of a surface of size 1, and the triangles between them.
    fn patch(&mut self, (across, along): (usize, usize), place: impl Fn(f64, f64) -> Vector<N>) {
        let first = self.points.len();
        for i in 0..=across {
            for j in 0..=along {
                self.points.push(place(i as f64 / across as f64, j as f64 / along as f64));
            }
        }
        for (i, j) in (0..across).flat_map(|i| (0..along).map(move |j| (i, j))) {
            let here = first + i * (along + 1) + j;
            let below = here + along + 1;
            for corners in [[here, below, here + 1], [here + 1, below, below + 1]] {
                let colour = self.colour(corners);
                self.triangles[colour].push(corners.map(|corner| corner as u32));
            }
        }
    }

    fn colour(&self, corners: [usize; 3]) -> usize {
        let middle = corners.iter().map(|corner| self.points[*corner]).sum::<Vector<N>>() / 3.0;
        match middle {
            middle if middle[0] > CAP => 2,
            middle if middle.iter().product::<f64>() > 0.0 => 0,
            _ => 1,
        }
    }

    pub(super) fn points(&self) -> impl Iterator<Item = &Vector<N>> {
        self.points.iter()
    }

    pub(super) fn normals(&self) -> Option<impl Iterator<Item = &Vector<N>>> {
        (!self.normals.is_empty()).then(|| self.normals.iter())
    }

    pub(super) fn triangles(&self) -> &[Vec<[u32; 3]>] {
        &self.triangles
    }

    /// What is wrong with it: there are points, and all that triangles name.
    pub(super) fn fault(&self) -> Option<&'static str> {
        let mut corners = self.triangles.iter().flatten().flatten();
        if corners.any(|corner| (*corner as usize) >= self.points.len()) {
            return Some("triangles of points that the shape does not have");
        }
        self.points.is_empty().then_some("a shape without points")
    }
}

/// The first `N` of three components.
fn vector<const N: usize>(components: [f64; 3]) -> Vector<N> {
    Vector::from_fn(|k, _| components.get(k).copied().unwrap_or(0.0))
}

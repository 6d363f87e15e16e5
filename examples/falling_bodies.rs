//! Soft bodies that fall: 200 affine bodies in a frame loop, 60 frames a second; in free fall, and on a ground that
//! they bounce off, a force at their corners. Both by splitting of order 2, and by steps that follow their error.
//!
//! Each body is a `Flow` with a model of its own, stepped from frame to frame as a game or a controller would; then all of them are
//! `Flows`, eight at once in the vectors of the processor, and have to be where they are alone, to the bit. What is measured
//! is the time of one step, or frame, of one body with everything that a frame does; what is checked is where the centres of mass are,
//! which gravity alone moves, and the energies, with that of the ground.
//!
//! Run times on shared machines are noise: the least of several seconds counts.

use std::time::Instant;

use affine_runtime::capability::{InLanes, Splitting};
use affine_runtime::force::{AtPoint, PointForce, Translation};
use affine_runtime::frames::Space;
use affine_runtime::model::Owned;
use affine_runtime::prelude::*;
use affine_runtime::report::{Curve, CurveDiagram, CurvePanel};
use affine_runtime::scalar::Scalar;

/// A cube of unit edge and mass that resists whatever is no rotation, as in affine body dynamics.
#[affine_model(
    dim = 3,
    kinetic(dalembert = 1/12, space_translation = 1),
    potential = orthogonality(1e4) + g*x[3],
    emit(splitting, lanes),
)]
#[derive(Clone, Copy)]
pub struct Cube {
    /// Acceleration of free fall.
    pub g: f64,
}

/// The same with a ground below.
#[affine_model(
    dim = 3,
    kinetic(dalembert = 1/12, space_translation = 1),
    potential = orthogonality(1e4) + g*x[3],
    forces = custom(press, translation, position) + custom(turn, spatial, position),
    emit(splitting, lanes),
)]
#[derive(Clone, Copy)]
pub struct Bouncing {
    /// Acceleration of free fall.
    pub g: f64,
    /// What the ground does to the centre.
    pub press: AtPoint<3, Ground, Translation, 8>,
    /// What it does to the placement.
    pub turn: AtPoint<3, Ground, Space, 8>,
}

/// Presses what is below it upward, in proportion to the depth.
#[derive(Clone, Copy)]
pub struct Ground {
    /// Force by depth.
    pub stiffness: f64,
}

impl PointForce<3> for Ground {
    fn force<T: Scalar>(&self, _: T, x: &Vector<3, T>, _: &Vector<3, T>) -> Vector<3, T> {
        let depth = (-x[2]).max(T::zero());
        Vector::<3, T>::new(T::zero(), T::zero(), T::constant(self.stiffness, 0.0) * depth)
    }
}

const BODIES: usize = 200;
const SECONDS: u32 = 10;
const FRAMES: u32 = 60;
/// Steps of a frame. The vibration of a stretch, of angular frequency `sqrt(8 k/m) = 980`, takes six of them.
const STEPS: u32 = 16;
/// Of steps that follow their error.
const TOLERANCE: f64 = 1e-6;
/// Seconds on the ground, and of steps that follow their error.
const BOUNCING: u32 = 2;
const GRAVITY: f64 = 9.81;
/// Softer than the body by far.
const GROUND: Ground = Ground { stiffness: 2e3 };
const CORNERS: [[f64; 3]; 8] = [
    [-0.5, -0.5, -0.5],
    [0.5, -0.5, -0.5],
    [-0.5, 0.5, -0.5],
    [0.5, 0.5, -0.5],
    [-0.5, -0.5, 0.5],
    [0.5, -0.5, 0.5],
    [-0.5, 0.5, 0.5],
    [0.5, 0.5, 0.5],
];

fn main() -> affine_runtime::Result<()> {
    println!("{BODIES} bodies, {FRAMES} frames a second, in free fall {STEPS} steps a frame");
    in_free_fall()?;
    on_the_ground()
}

/// Centres of mass are where gravity alone takes them.
fn in_free_fall() -> affine_runtime::Result<()> {
    let cube = Cube { g: GRAVITY }.prepare()?;
    let start = |k| {
        let (x, spin) = placed(k, 600.0);
        cube.at_velocity(x, Matrix::identity(), Vector::zeros(), spin)
    };
    by_steps_of_their_own("in free fall", &cube, start)?;
    let step = 1.0 / f64::from(FRAMES * STEPS);
    let method = Method::Splitting { order: 2, step };
    let (bodies, starts, least) = fallen("in free fall", &cube, (method, SECONDS), start)?;
    println!("least: {:.0} ns a body and step", least / f64::from(STEPS));
    let ends: Vec<_> = bodies.iter().map(Flow::point).collect();
    together("in free fall", &cube, (method, SECONDS), [&starts, &ends])?;
    let (mut off, mut swing) = (0.0_f64, 0.0_f64);
    for (body, start) in bodies.iter().zip(&starts) {
        let (t, point) = (body.t(), body.point());
        let height = start.x()[2] - 0.5 * GRAVITY * t * t;
        off = off.max((point.x()[2] - height).abs() / height.abs());
        let energy = |point| body.model().hamiltonian(t, point);
        swing = swing.max((energy(&point) - energy(start)).abs() / energy(start).abs());
    }
    println!(
        "centres of mass after {SECONDS} s: {off:.1e} off x0 - g t^2/2, energies {swing:.1e} off the first"
    );
    assert!(off < 1e-12 && swing < 0.1, "the bodies fall as they should");
    Ok(())
}

/// What the ground takes up it gives back.
fn on_the_ground() -> affine_runtime::Result<()> {
    let bouncing =
        Bouncing { g: GRAVITY, press: AtPoint::new(CORNERS, GROUND), turn: AtPoint::new(CORNERS, GROUND) };
    let cube = bouncing.prepare()?;
    let start = |k| {
        let (x, spin) = placed(k, 1.5);
        cube.at_velocity(x, Matrix::identity(), Vector::zeros(), spin)
    };
    by_steps_of_their_own("on the ground", &cube, start)?;
    let method = Method::Splitting { order: 2, step: 1.0 / f64::from(FRAMES * STEPS) };
    let (bodies, starts, least) = fallen("on the ground", &cube, (method, BOUNCING), start)?;
    println!("least: {:.0} ns a body and step", least / f64::from(STEPS));
    let ends: Vec<_> = bodies.iter().map(Flow::point).collect();
    together("on the ground", &cube, (method, BOUNCING), [&starts, &ends])?;
    let (mut deepest, mut highest, mut swing) = (f64::INFINITY, 0.0_f64, 0.0_f64);
    for (body, start) in bodies.iter().zip(&starts) {
        let (t, point) = (body.t(), body.point());
        let energy = |point: &<PreparedBouncing as Model<3>>::Point<f64>| {
            body.model().hamiltonian(t, point) + pressed(point)
        };
        swing = swing.max((energy(&point) - energy(start)).abs() / energy(start).abs());
        deepest = deepest.min(point.x()[2]);
        highest = highest.max(point.x()[2]);
    }
    println!(
        "on the ground after {BOUNCING} s: centres between {deepest:.2} and {highest:.2}, energies {swing:.1e} off the first"
    );
    let shown = [0, BODIES / 2, BODIES - 1].into_iter().map(start);
    draw(&cube, shown.collect::<affine_runtime::Result<_>>()?)?;
    assert!(deepest > 0.2 && highest < 2.0 && swing < 0.1, "the ground holds and gives back");
    Ok(())
}

/// How high the centres of some bodies are.
fn draw(
    cube: &PreparedBouncing,
    starts: Vec<<PreparedBouncing as Model<3>>::Point<f64>>,
) -> affine_runtime::Result<()> {
    let mut curves = Vec::new();
    for (category, start) in starts.into_iter().enumerate() {
        let run = Simulation::new(cube, start).until(f64::from(BOUNCING)).tolerance(TOLERANCE);
        let run = run.every(1.0 / f64::from(FRAMES)).run()?;
        curves.push(Curve { category, points: run.iter().map(|(t, point)| (t, point.x()[2])).collect() });
    }
    let panel = CurvePanel {
        x: "t".into(),
        y: "height of the centre".into(),
        logarithmic: false,
        range: None,
        curves,
    };
    // A folder that cannot be made shows in the file that cannot be written.
    let _ = std::fs::create_dir_all("output");
    CurveDiagram::new("Three soft cubes bounce", vec![panel]).save_svg("output/falling_bodies.svg")
}

/// The energy of the ground below the corners of a cube.
fn pressed<P: Phase<3>>(point: &P) -> f64 {
    let depth = |corner: &[f64; 3]| {
        let place = point.x() + point.phi() * Vector::<3>::from(*corner);
        (-place[2]).max(0.0)
    };
    CORNERS.iter().map(|corner| 0.5 * GROUND.stiffness * depth(corner).powi(2)).sum()
}

/// The bodies of a model at the end, where they began, and the least nanoseconds of a frame.
#[allow(clippy::type_complexity)]
fn fallen<M: Model<3> + Clone + 'static>(
    name: &str,
    model: &M,
    (method, seconds): (Method, u32),
    start: impl Fn(usize) -> affine_runtime::Result<M::Point<f64>>,
) -> affine_runtime::Result<(Vec<Flow<'static, 3, Owned<M>>>, Vec<M::Point<f64>>, f64)> {
    let body = |k| Ok(Flow::by(method, Owned(model.clone()), (0.0, start(k)?))?);
    let mut bodies = (0..BODIES).map(body).collect::<affine_runtime::Result<Vec<_>>>()?;
    bodies.iter_mut().try_for_each(|body| body.set_tolerance(TOLERANCE))?;
    let starts = bodies.iter().map(Flow::point).collect();
    let mut least = f64::INFINITY;
    for second in 1..=seconds {
        let began = Instant::now();
        for frame in (second - 1) * FRAMES + 1..=second * FRAMES {
            for body in &mut bodies {
                body.advance_to(f64::from(frame) / f64::from(FRAMES))?;
            }
        }
        let frames = BODIES as f64 * f64::from(FRAMES);
        let cost = began.elapsed().as_secs_f64() * 1e9 / frames;
        least = least.min(cost);
        println!("{name}, t = {second:>2}: {cost:.0} ns a body and frame");
    }
    Ok((bodies, starts, least))
}

/// Each body, and then eight at once, by steps that follow their errors.
fn by_steps_of_their_own<M: InLanes<3> + Splitting<3> + Clone + Send + Sync + 'static>(
    name: &str,
    model: &M,
    start: impl Fn(usize) -> affine_runtime::Result<M::Point<f64>>,
) -> affine_runtime::Result<()>
where
    M::Point<f64>: Send,
{
    let (method, name) = ((Method::RungeKutta8, BOUNCING), format!("{name}, Runge-Kutta 8"));
    let (bodies, starts, least) = fallen(&name, model, method, start)?;
    println!("least: {least:.0} ns a body and frame");
    let ends: Vec<_> = bodies.iter().map(Flow::point).collect();
    together(&name, model, method, [&starts, &ends])
}

/// The same bodies eight at once: where they are alone, in less time.
fn together<M: InLanes<3> + Splitting<3> + Clone + Send + Sync>(
    name: &str,
    model: &M,
    (method, seconds): (Method, u32),
    [starts, ends]: [&[M::Point<f64>]; 2],
) -> affine_runtime::Result<()>
where
    M::Point<f64>: Send,
{
    let bodies = starts.iter().map(|start| (Owned(model.clone()), *start));
    let (mut flows, steps, unit) = match method {
        Method::Splitting { order, step } => {
            (Flows::by_splitting((order, step), 0.0, bodies)?, f64::from(STEPS), "step")
        }
        _ => (Flows::by_runge_kutta(TOLERANCE, 0.0, bodies)?, 1.0, "frame"),
    };
    let mut least = f64::INFINITY;
    for second in 1..=seconds {
        let began = Instant::now();
        for frame in (second - 1) * FRAMES + 1..=second * FRAMES {
            flows.advance_to(f64::from(frame) / f64::from(FRAMES))?;
        }
        let steps = BODIES as f64 * f64::from(FRAMES) * steps;
        least = least.min(began.elapsed().as_secs_f64() * 1e9 / steps);
    }
    println!("{name}, eight at once: least {least:.1} ns a body and {unit}");
    assert!(flows.points().eq(ends.iter().copied()), "each body is where it is alone");
    Ok(())
}

/// Centre and velocity of a body that spins, each another way.
fn placed(k: usize, height: f64) -> (Vector<3>, Matrix<3>) {
    let part = k as f64 / BODIES as f64;
    let spin = Matrix::<3>::new(0.0, -1.0, part, 1.0, 0.0, -0.3, -part, 0.3, 0.0);
    (Vector::<3>::new(2.0 * k as f64, 0.0, height), spin)
}

//! `Trajectory::at` where steps are short, on a ground and at a steep wall: as close as elsewhere, in units of the rounding of times.

use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

/// A ground that presses below `x_2 = 0`.
#[derive(Clone, Copy, Debug)]
struct Ground;

impl Force<2> for Ground {
    type Form = Translation;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        let depth = (-motion.x[1]).max(T::zero());
        Vector::<2, T>::new(T::zero(), T::constant(1e4, 0.0) * depth)
    }
}

#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = orthogonality(1) + x[2],
    forces = custom(ground, translation, position)
)]
struct Kink {
    ground: Ground,
}

#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = orthogonality(1) + x[2] + exp(-2000*x[2])
)]
struct Wall;

/// What a rounding of the time moves a point by is known to a few of these.
const ROUNDINGS: f64 = 16.0;

/// A dense run is where outputs are: within a third of the tolerance, or of what roundings of the time make of an output.
fn is_where_outputs_are<M: Model<2>>(model: &M, start: M::Point<f64>, t0: f64, tolerance: f64) {
    let simulation = || Simulation::new(model, start).from(t0).until(t0 + 6.0).tolerance(tolerance);
    let dense = simulation().dense().run().unwrap();
    let parts = [0.0, 0.1, 0.3, 0.5, 0.7, 0.9];
    let times = dense.times().windows(2).flat_map(|ends| {
        let time = |part| ends[0] + part * (ends[1] - ends[0]);
        parts.map(time).into_iter().flat_map(|t| [t, t.next_up()])
    });
    let mut times: Vec<f64> = times.filter(|t| *t > t0 && *t < t0 + 6.0).collect();
    times.dedup();
    let outputs = simulation().output(times).run().unwrap();
    let largest =
        |size: &dyn Fn(&M::Point<f64>) -> f64| outputs.points().iter().map(size).fold(0.0, f64::max);
    let (p, spin) = (largest(&|point| point.p().norm()), largest(&|point| point.sigma().0.0.norm()));
    let off = |a: &M::Point<f64>, b: &M::Point<f64>| {
        let of_spin = (a.sigma().0.0 - b.sigma().0.0).norm() / spin;
        let of_placement = (a.phi() - b.phi()).norm() / b.phi().norm();
        ((a.p() - b.p()).norm() / p).max(of_spin).max(of_placement)
    };
    for ((t, point), (next, after)) in outputs.iter().zip(outputs.iter().skip(1)) {
        if next != t.next_up() {
            continue;
        }
        let (found, rounding) = (off(&dense.at(t).unwrap(), point), off(point, after));
        assert!(
            found <= f64::max(tolerance / 3.0, ROUNDINGS * rounding),
            "{t0:e} {tolerance:e}: {found:e} off at {:.4} for {rounding:e}",
            t - t0
        );
    }
}

#[test]
fn where_steps_are_short() {
    let (x, v) = (Vector::<2>::new(0.0, 1.0), Vector::<2>::new(0.5, 0.0));
    let (phi, rate) = (Matrix::<2>::new(1.1, 0.1, 0.0, 0.95), Matrix::<2>::new(0.1, -0.3, 0.4, 0.0));
    let kink = Kink { ground: Ground }.prepare().unwrap();
    let start = kink.at_velocity(x, phi, v, rate).unwrap();
    for (t0, tolerance) in [(0.0, 1e-10), (0.0, 1e-12), (1e3, 1e-12), (1e5, 1e-10)] {
        is_where_outputs_are(&kink, start, t0, tolerance);
    }
    let start = Wall.at_velocity(x, phi, v, rate).unwrap();
    for (t0, tolerance) in [(0.0, 1e-12), (1e3, 1e-10), (1e3, 1e-12), (1e5, 1e-10), (1e7, 1e-8)] {
        is_where_outputs_are(&Wall, start, t0, tolerance);
    }
}

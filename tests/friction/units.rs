//! Units of mass and time are of no account where friction is stiff, and where there is none.

use affine_runtime::force::{AtPoint, Force, Motion, PointForce, Translation};
use affine_runtime::frames::Space;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;
use affine_runtime::simulate::Reason;

/// Units of mass and time.
const UNITS: [(f64, f64); 9] = [
    (1.0, 1.0),
    (1208925819614629174706176.0, 1.0),
    (1.0 / 1208925819614629174706176.0, 1.0),
    (1099511627776.0, 1.0 / 1099511627776.0),
    (1.0 / 1099511627776.0, 1099511627776.0),
    (1.0, 1.0 / 1152921504606846976.0),
    (1.0, 1152921504606846976.0),
    (2e30, 1e5),
    (1e-27, 1e-15),
];

#[affine_model(
    dim = 3,
    kinetic(body_inertia = m/12, space_translation = m),
    potential = neo_hookean(k) + k*q^2 + m*g*x[3],
    dissipation(body_inertia = r)
)]
struct Falling {
    m: f64,
    k: f64,
    g: f64,
    r: f64,
}

/// Viscous bodies and others take as many implicit steps in all units, to the same end, by a method that needs none of them.
#[test]
fn implicit_steps_do_not_see_units() {
    let x = Vector::<3>::new(0.0, 0.2, 0.9);
    let phi = Matrix::<3>::new(1.1, 0.1, 0.0, 0.0, 0.9, 0.1, 0.0, 0.0, 1.0);
    let rate = Matrix::<3>::new(0.1, -1.0, 0.0, 0.8, -0.1, 0.2, 0.0, 0.3, 0.0);
    let v = Vector::<3>::new(1.0, 0.25, 0.0);
    for (friction, methods) in [
        (0.0, [Method::Radau { stages: None }, Method::RungeKutta8]),
        (0.5, [Method::Radau { stages: None }, Method::RungeKutta8]),
        (1e4, [Method::Automatic, Method::Radau { stages: Some(5) }]),
    ] {
        let ends = UNITS.map(|(mass, time)| {
            let (k, g) = (30.0 * mass / (time * time), 9.75 / (time * time));
            let body = Falling { m: mass, k, g, r: friction * mass / time }.prepare().unwrap();
            let start = body.at_velocity(x, phi, v / time, rate / time).unwrap();
            methods.map(|method| {
                let run = Simulation::new(&body, start).until(1.5 * time).tolerance(1e-9);
                let run = run.method(method).max_steps(20_000).output([]).run();
                let run = run.unwrap_or_else(|halt| panic!("{mass:e} {time:e} {friction}: {halt}"));
                (run.statistics().steps, *run.end().1.phi(), run.end().1.x())
            })
        });
        for ([first, second], unit) in ends.iter().zip(UNITS) {
            assert_eq!((first.0, second.0), (ends[0][0].0, ends[0][1].0), "steps in {unit:?}, {friction}");
            let off = (first.1 - ends[0][1].1).norm() + (first.2 - ends[0][1].2).norm();
            assert!(off < 2e-7, "{unit:?}, {friction}: {off:e} off the other method");
            let off = (first.1 - ends[0][0].1).norm() + (first.2 - ends[0][0].2).norm();
            assert!(off < 1e-9, "{unit:?}, {friction}: {off:e} off the same method");
        }
    }
}

/// A ground that presses below `x_2 = 0`, and a wind.
#[derive(Clone, Copy, Debug)]
struct Ground {
    stiffness: f64,
    wind: f64,
}

impl PointForce<2> for Ground {
    fn force<T: Scalar>(&self, _: T, x: &Vector<2, T>, _: &Vector<2, T>) -> Vector<2, T> {
        let depth = (-x[1]).max(T::zero());
        Vector::<2, T>::new(T::constant(self.wind, 0.0), T::constant(self.stiffness, 0.0) * depth)
    }
}

#[affine_model(
    dim = 2,
    kinetic(body_inertia = m/10, casimir2 = m/40, space_translation = m),
    potential = k*q^2 + k/4*tr(G)*exp(-2*q) + m*g*x[2],
    dissipation(body_inertia = r),
    forces = custom(press, translation) + custom(turn, spatial)
)]
struct Bouncing {
    m: f64,
    k: f64,
    g: f64,
    r: f64,
    press: AtPoint<2, Ground, Translation, 4>,
    turn: AtPoint<2, Ground, Space, 4>,
}

/// A body that bounces with little friction: the steps that it takes, and where it ends.
fn bounced((mass, time): (f64, f64), method: impl Fn(f64) -> Method) -> (u64, Matrix<2>) {
    let feet = [[-0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]];
    let (x, v) = (Vector::<2>::new(0.0, 0.9), Vector::<2>::new(1.0, 0.25));
    let phi = Matrix::<2>::new(1.1, 0.1, 0.0, 0.9);
    let rate = Matrix::<2>::new(0.1, -1.0, 0.8, -0.1);
    let of_force = mass / (time * time);
    let (k, g) = (32.0 * of_force, 9.75 / (time * time));
    let ground = Ground { stiffness: 1e3 * of_force, wind: 0.5 * of_force };
    let (press, turn) = (AtPoint::new(feet, ground), AtPoint::new(feet, ground));
    let body = Bouncing { m: mass, k, g, r: mass / (64.0 * time), press, turn }.prepare().unwrap();
    let start = body.at_velocity(x, phi, v / time, rate / time).unwrap();
    let run = Simulation::new(&body, start).until(1.5 * time).tolerance(1e-7).output([]);
    let run = run.method(method(time)).max_steps(5000).run();
    let run = run.unwrap_or_else(|halt| panic!("{mass:e} {time:e}: {halt}"));
    (run.statistics().steps, *run.end().1.phi())
}

/// Contacts by steps of Gauss collocation, which need Newton's iteration.
#[test]
fn steps_of_contacts_do_not_see_units() {
    for stages in [2, 4] {
        let ends = UNITS.map(|unit| bounced(unit, |time| Method::Gauss { stages, step: time / 64.0 }).1);
        for (end, unit) in ends.iter().zip(UNITS) {
            assert!((end - ends[0]).norm() < 1e-9, "{stages} stages, {unit:?}: {:e}", (end - ends[0]).norm());
        }
    }
}

/// The frame in which velocities are the variables of Radau steps is that of the friction beside forces of contact: in units that
/// are powers of two all bits are the same.
#[test]
fn variables_of_steps_do_not_see_units() {
    let ends = UNITS.map(|unit| (unit, bounced(unit, |_| Method::Radau { stages: None })));
    for (unit, end) in &ends[..7] {
        assert_eq!(*end, ends[0].1, "{unit:?}");
    }
}

/// The pull of a companion that stays where it is.
#[derive(Clone, Copy, Debug)]
struct Pull {
    strength: f64,
}

impl Force<2> for Pull {
    type Form = Translation;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        let square = motion.x[0] * motion.x[0] + motion.x[1] * motion.x[1];
        let pull = T::constant(self.strength, 0.0) / (square * square.sqrt());
        Vector::<2, T>::new(-(pull * motion.x[0]), -(pull * motion.x[1]))
    }
}

#[affine_model(
    dim = 2,
    kinetic(dalembert = j, space_translation = m),
    potential = orthogonality(k),
    dissipation(dalembert = r),
    forces = custom(pull, translation, position),
    emit(splitting)
)]
struct Star {
    j: f64,
    m: f64,
    k: f64,
    r: f64,
    pull: Pull,
}

/// Rounding of the power of forces that only depend on the place is no friction, in whatever units, and friction beside them is.
#[test]
fn conservative_forces_are_no_friction_in_any_units() {
    // Metres: the size of a body, and a distance of many of them.
    for distance in [1e10, 7e9, 3.0] {
        for (mass, time) in UNITS {
            let speed = 1e-1 * distance / time;
            let strength = mass * speed * speed * distance;
            let star = |friction: f64| {
                let (k, r) = (mass * 1e-4 / (time * time), friction * mass / time);
                Star { j: mass, m: mass, k, r, pull: Pull { strength } }.prepare().unwrap()
            };
            let (x, v) = (Vector::<2>::new(0.6, 0.8) * distance, Vector::<2>::new(-0.8, 0.6) * speed);
            let spin = Matrix::<2>::new(0.0, -0.01, 0.01, 0.0) / time;
            let period = 2.0 * core::f64::consts::PI * distance / speed;
            let named = format!("{mass:e} {time:e} {distance:e}");
            let free = star(0.0);
            let start = free.at_velocity(x, Matrix::identity(), v, spin).unwrap();
            let run = |orbits: f64| Simulation::new(&free, start).until(orbits * period).tolerance(1e-8);
            for order in [4, 8] {
                let run = run(1.0).method(Method::Splitting { order, step: period / 200.0 }).run();
                let run = run.unwrap_or_else(|halt| panic!("{named}: {halt}"));
                let off = (run.end().1.x() - x).norm() / distance;
                assert!(off < 1e-5, "{named}: {off:e} off a closed orbit");
            }
            let chosen = run(100.0).output([]).run().unwrap();
            assert!(
                !matches!(chosen.computation().method, Method::Radau { .. }),
                "{named}: {}",
                chosen.why()
            );
            let viscous = star(20.0);
            let start = viscous.at_velocity(x, Matrix::identity(), v, spin).unwrap();
            let run = || Simulation::new(&viscous, start).until(3.0 * period);
            let chosen = run().output([]).run().unwrap();
            assert!(matches!(chosen.computation().method, Method::Radau { .. }), "{named}: {}", chosen.why());
            let refused = run().method(Method::Splitting { order: 4, step: time }).run().unwrap_err();
            match refused.stop.reason {
                Reason::Friction { rate, .. } => {
                    assert!((rate * time / 20.0 - 1.0).abs() < 0.1, "{named}: {rate}");
                }
                _ => panic!("{named}: {refused}"),
            }
        }
    }
}

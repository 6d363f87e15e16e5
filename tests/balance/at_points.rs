//! Forces at material points: against the potential that they have, the same forces written by hand, and their power `f . v`.

use affine_oracle::Random;
use affine_runtime::force::{AtPoint, Force, Motion, PointForce, Translation};
use affine_runtime::frames::{Body as OnBody, Space as OnSpace};
use affine_runtime::model::Quantity;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

/// Rates of one motion by two programs, in units of the largest: some ten roundings.
const RATES: f64 = 1e-14;

/// Two runs of tolerance 1e-12, whose steps pass over kinks of contact and friction.
const MOTION: f64 = 1e-8;

const T0: f64 = 0.25;
const A: [f64; 2] = [0.75, -0.5];
const B: [f64; 2] = [-0.25, 1.5];

/// A spring between two points of the body and the point `(1, 2)` of space: `f = -(x_a - c)`.
#[derive(Clone, Copy, Debug)]
struct Spring;

impl PointForce<2> for Spring {
    fn force<T: Scalar>(&self, _: T, x: &Vector<2, T>, _: &Vector<2, T>) -> Vector<2, T> {
        Vector::<2, T>::new(T::constant(1.0, 0.0) - x[0], T::constant(2.0, 0.0) - x[1])
    }
}

/// Friction on a ground that presses, and a gust: of time, place and velocity.
#[derive(Clone, Copy, Debug)]
struct Ground;

fn pushed<T: Scalar>(t: T, x: [T; 2], v: [T; 2]) -> [T; 2] {
    let pressure = T::constant(30.0, 0.0) * (T::constant(0.5, 0.0) - x[1]).max(T::zero());
    let grip = (pressure * T::constant(0.25, 0.0)).min(T::constant(3.0, 0.0));
    [t.sin() - grip * v[0], pressure]
}

impl PointForce<2> for Ground {
    fn force<T: Scalar>(&self, t: T, x: &Vector<2, T>, v: &Vector<2, T>) -> Vector<2, T> {
        pushed(t, [x[0], x[1]], [v[0], v[1]]).into()
    }
}

/// The same at `A` alone, on the centre.
#[derive(Clone, Debug)]
struct OnCentre;

/// And on the placement.
#[derive(Clone, Debug)]
struct OnPlacement;

/// `phi A`, and the force at `A`.
fn at_a<T: Scalar>(m: &Motion<2, T>) -> ([T; 2], [T; 2]) {
    let [a, b] = A.map(|a| T::constant(a, 0.0));
    let arm = [m.phi[(0, 0)] * a + m.phi[(0, 1)] * b, m.phi[(1, 0)] * a + m.phi[(1, 1)] * b];
    let turn = [m.phi_dot[(0, 0)] * a + m.phi_dot[(0, 1)] * b, m.phi_dot[(1, 0)] * a + m.phi_dot[(1, 1)] * b];
    let (x, v) = ([m.x[0] + arm[0], m.x[1] + arm[1]], [m.x_dot[0] + turn[0], m.x_dot[1] + turn[1]]);
    (arm, pushed(m.t, x, v))
}

impl Force<2> for OnCentre {
    type Form = Translation;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        at_a(motion).1.into()
    }
}

impl Force<2> for OnPlacement {
    type Form = OnSpace;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Matrix<2, T> {
        let (arm, force) = at_a(motion);
        Matrix::<2, T>::new(arm[0] * force[0], arm[0] * force[1], arm[1] * force[0], arm[1] * force[1])
    }
}

/// The same rates and, over a run, the same motion.
fn moves_like<M: Model<2>, L: Model<2>>(
    (model, start): (&M, M::Point<f64>),
    (like, like_start): (&L, L::Point<f64>),
) {
    let rates = model.hamilton_equations(T0, &model.flatten(&start));
    let expected = like.hamilton_equations(T0, &like.flatten(&like_start));
    let groups: usize =
        M::DESCRIPTION.full.iter().filter(|g| g.quantity != Quantity::Work).map(|g| g.len).sum();
    let size = expected.as_ref().iter().fold(1.0, |size: f64, rate| size.max(rate.abs()));
    assert_eq!(groups, 12);
    for (own, rate) in rates.as_ref().iter().zip(expected.as_ref()).take(groups) {
        assert!((own - rate).abs() <= RATES * size, "{own} {rate} of {size}");
    }
    let run = Simulation::new(model, start).from(T0).until(T0 + 0.25).tolerance(1e-12).run().unwrap();
    let expected =
        Simulation::new(like, like_start).from(T0).until(T0 + 0.25).tolerance(1e-12).run().unwrap();
    let (point, other) = (run.end().1, expected.end().1);
    let off = (point.phi() - other.phi()).norm() + (point.x() - other.x()).norm();
    assert!(off <= MOTION * (1.0 + other.phi().norm() + other.x().norm()), "{off:e}");
}

/// `x`, `phi` and their velocities, drawn.
fn drawn(seed: u64) -> (Vector<2>, Matrix<2>, Vector<2>, Matrix<2>) {
    let state = Random::new(seed).state(2);
    let matrix = |m: &affine_oracle::Matrix| Matrix::<2>::from_row_slice(&m.to_f64());
    let vector = |m: &affine_oracle::Matrix| Vector::<2>::from_column_slice(&m.to_f64());
    (vector(&state.x), matrix(&state.phi), vector(&state.p), matrix(&state.pi))
}

/// A spring at two points pulls as its energy `|x_A - c|^2/2 + |x_B - c|^2/2` does: a route by slopes alone.
#[test]
fn springs_pull_as_their_energy_does() {
    type Springs<Q> = AtPoint<2, Spring, Q, 2>;

    #[affine_model(
        dim = 2, kinetic(dalembert = 0.5, space_translation = 1.5),
        forces = custom(pull, translation) + custom(turn, spatial)
    )]
    #[derive(Clone)]
    struct InSpace {
        pull: Springs<Translation>,
        turn: Springs<OnSpace>,
    }

    #[affine_model(
        dim = 2, kinetic(dalembert = 0.5, space_translation = 1.5),
        forces = custom(pull, translation) + custom(turn, comoving)
    )]
    #[derive(Clone)]
    struct InBody {
        pull: Springs<Translation>,
        turn: Springs<OnBody>,
    }

    #[affine_model(
        dim = 2, kinetic(dalembert = 0.5, space_translation = 1.5),
        potential = ((x[1] + 3/4*phi[1,1] - 1/2*phi[1,2] - 1)^2 + (x[2] + 3/4*phi[2,1] - 1/2*phi[2,2] - 2)^2)/2
            + ((x[1] - 1/4*phi[1,1] + 3/2*phi[1,2] - 1)^2 + (x[2] - 1/4*phi[2,1] + 3/2*phi[2,2] - 2)^2)/2
    )]
    #[derive(Clone)]
    struct ByEnergy;

    let space = InSpace { pull: AtPoint::new([A, B], Spring), turn: AtPoint::new([A, B], Spring) };
    let body = InBody { pull: AtPoint::new([A, B], Spring), turn: AtPoint::new([A, B], Spring) };
    let (space, body) = (space.prepare().unwrap(), body.prepare().unwrap());
    for seed in 1..6 {
        let (x, phi, v, phi_dot) = drawn(seed);
        let expected = ByEnergy.at_velocity(x, phi, v, phi_dot).unwrap();
        moves_like((&space, space.at_velocity(x, phi, v, phi_dot).unwrap()), (&ByEnergy, expected));
        moves_like((&body, body.at_velocity(x, phi, v, phi_dot).unwrap()), (&ByEnergy, expected));
    }
}

/// The power that a run books is `f . v_a`, and the motion that of the two forces written by hand: in a frame of its own.
#[test]
fn contact_has_the_power_of_its_point() {
    #[affine_model(
        dim = 2, kinetic(casimir2 = 0.5, body_inertia = 1, space_translation = 2),
        potential = tr(G)/2 - 2*q + 3*x[2],
        forces = custom(press, translation) + custom(turn, spatial)
    )]
    #[derive(Clone)]
    struct Written {
        press: OnCentre,
        turn: OnPlacement,
    }

    #[affine_model(
        dim = 2, kinetic(casimir2 = 0.5, body_inertia = 1, space_translation = 2),
        potential = tr(G)/2 - 2*q + 3*x[2],
        forces = custom(press, translation) + custom(turn, comoving)
    )]
    #[derive(Clone)]
    struct Pressed {
        press: AtPoint<2, Ground, Translation>,
        turn: AtPoint<2, Ground, OnBody>,
    }

    let written = Written { press: OnCentre, turn: OnPlacement }.prepare().unwrap();
    let pressed = Pressed { press: AtPoint::new([A], Ground), turn: AtPoint::new([A], Ground) };
    let pressed = pressed.prepare().unwrap();
    let mut touched = 0;
    for seed in 1..12 {
        let (x, phi, v, phi_dot) = drawn(seed);
        let start = pressed.at_velocity(x, phi, v, phi_dot).unwrap();
        let (a, arm) = (Vector::<2>::from(A), phi * Vector::<2>::from(A));
        let (place, speed) = (x + arm, v + phi_dot * a);
        let force = Vector::<2>::from(pushed(T0, place.into(), speed.into()));
        let (power, expected) = (pressed.power(T0, &start), force.dot(&speed));
        touched += usize::from(force[1] > 0.0);
        // `Q_hat` and `Omega_hat` have been to the body and back.
        let size = 1.0 + force.norm() * (v.norm() + phi_dot.norm() * (1.0 + phi.norm() * a.norm()));
        assert!((power - expected).abs() <= 1e-12 * size, "{power} {expected}");
        if seed < 6 {
            moves_like((&pressed, start), (&written, written.at_velocity(x, phi, v, phi_dot).unwrap()));
        }
        let run = Simulation::new(&pressed, start).from(T0).until(T0 + 0.5).tolerance(1e-12).run().unwrap();
        let balance = run.power_balance().unwrap();
        assert!(balance.relative() < 1e-10 && balance.work != 0.0, "{balance}");
    }
    assert!((3..11).contains(&touched), "some are on the ground, and some above: {touched}");
}

/// Beside metrics a force is a covector in the bases of the user: its power is `f . v` there.
#[test]
fn beside_metrics() {
    #[affine_model(
        dim = 2, kinetic(casimir2 = 0.5, body_inertia = 1, space_translation = 2),
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
        forces = custom(press, translation) + custom(turn, spatial)
    )]
    #[derive(Clone)]
    struct Skewed {
        press: AtPoint<2, Ground, Translation>,
        turn: AtPoint<2, Ground, OnSpace>,
    }
    let skewed = Skewed { press: AtPoint::new([B], Ground), turn: AtPoint::new([B], Ground) };
    let skewed = skewed.prepare().unwrap();
    for seed in 1..8 {
        let (x, phi, v, phi_dot) = drawn(seed);
        let start = skewed.at_velocity(x, phi, v, phi_dot).unwrap();
        let (place, speed) = (x + phi * Vector::<2>::from(B), v + phi_dot * Vector::<2>::from(B));
        let expected = Vector::<2>::from(pushed(T0, place.into(), speed.into())).dot(&speed);
        let power = skewed.power(T0, &start);
        assert!((power - expected).abs() <= 1e-11 * (1.0 + expected.abs()), "{power} {expected}");
    }
}

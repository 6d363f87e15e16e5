//! A body that is stepped frame by frame: the steps of a run, times that are hit, what may change in between, and what is
//! refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod barrier;
mod dense;
mod dense_at_walls;
mod models;
mod refusals;
mod together;

use std::rc::Rc;
use std::sync::Arc;

use affine_runtime::model::{Handle, Owned};
use affine_runtime::prelude::*;
use models::{Counted, Cube, Driven, Drop, Dust, Free, Lift, block, sheared, strained, thrown};

/// Times of frames are sums of it without rounding, so that their differences are the length of a step of a run.
const DT: f64 = 1.0 / 64.0;
const FRAMES: u32 = 96;

fn time(frame: u32) -> f64 {
    f64::from(frame) * DT
}

/// Frames of one step each go where a run with these steps goes, to the bit.
fn takes_the_steps_of_a_run<const N: usize, M: Model<N>>(
    model: &M,
    start: M::Point<f64>,
    methods: &[Method],
) {
    for method in methods {
        let end = time(FRAMES);
        let run = Simulation::new(model, start).until(end).every(DT).method(*method).run().unwrap();
        let mut flow = Flow::by(*method, model, (0.0, start)).unwrap();
        for (frame, (t, point)) in (1..=FRAMES).zip(run.iter().skip(1)) {
            flow.advance_to(time(frame)).unwrap();
            assert_eq!(flow.t(), t, "{method:?}");
            assert_eq!(flow.point(), *point, "{method:?} at {t}");
        }
        assert_eq!(flow.statistics().steps, u64::from(FRAMES), "{method:?}");
    }
}

#[test]
fn equal_steps_are_those_of_a_run() {
    let (cube, step) = (block(9.81), DT);
    let splitting = [2, 4, 6, 8].map(|order| Method::Splitting { order, step });
    let gauss = [2, 3].map(|stages| Method::Gauss { stages, step });
    takes_the_steps_of_a_run(&cube, thrown(&cube), &[splitting.as_slice(), &gauss].concat());
    let driven = Driven.at_velocity(strained(), sheared()).unwrap();
    takes_the_steps_of_a_run(&Driven, driven, &[splitting.as_slice(), &gauss].concat());
    let drop = Drop.at_velocity(Matrix::identity(), Matrix::<2>::new(0.3, 1.0, -0.5, -0.3)).unwrap();
    takes_the_steps_of_a_run(
        &Drop,
        drop,
        &[Method::Rattle { order: 2, step }, Method::Rattle { order: 4, step }],
    );
}

/// One frame is a run: the same first step, the same steps after it.
fn takes_a_run_in_one_frame<const N: usize, M: Model<N>>(
    model: &M,
    start: M::Point<f64>,
    methods: &[Method],
) {
    for method in methods {
        let run = Simulation::new(model, start).until(1.5).output([]).method(*method).run().unwrap();
        let mut flow = Flow::by(*method, model, (0.0, start)).unwrap();
        flow.advance(1.5).unwrap();
        assert_eq!((flow.t(), &flow.point()), run.end(), "{method:?}");
        assert_eq!(flow.statistics().steps, run.statistics().steps, "{method:?}");
    }
}

const BY_THEIR_ERROR: [Method; 7] = [
    Method::Radau { stages: None },
    Method::RungeKutta8,
    Method::RungeKutta5,
    Method::RungeKuttaNystrom12,
    Method::RungeKuttaNystrom8,
    Method::Taylor { order: None },
    Method::AdaptiveSplitting { order: None },
];

#[test]
fn steps_by_their_error_are_those_of_a_run() {
    let cube = block(9.81);
    takes_a_run_in_one_frame(&cube, thrown(&cube), &BY_THEIR_ERROR);
    takes_a_run_in_one_frame(&cube, thrown(&cube), &[Method::Automatic]);
    let driven = Driven.at_velocity(strained(), sheared()).unwrap();
    takes_a_run_in_one_frame(&Driven, driven, &[Method::Automatic, Method::RungeKutta5]);
    let drop = Drop.at_velocity(Matrix::identity(), Matrix::<2>::new(0.3, 1.0, -0.5, -0.3)).unwrap();
    takes_a_run_in_one_frame(&Drop, drop, &[Method::Automatic, Method::RungeKutta5]);
    let free = Free.at_velocity(strained(), sheared()).unwrap();
    takes_a_run_in_one_frame(&Free, free, &[Method::Automatic, Method::ClosedForm, Method::RungeKutta8]);
}

/// Frames of any length end where they were asked to, and the motion is that of a run to its tolerance.
#[test]
fn frames_of_any_length_land_exactly() {
    let cube = block(9.81);
    let start = thrown(&cube);
    let end = Simulation::new(&cube, start).until(1.0).tolerance(1e-13).run().unwrap();
    let fixed = [Method::Splitting { order: 6, step: 0.002 }, Method::Gauss { stages: 4, step: 0.01 }];
    for method in BY_THEIR_ERROR.into_iter().chain(fixed) {
        let mut flow = Flow::by(method, &cube, (0.0, start)).unwrap();
        let mut t = 0.0;
        for frame in 0.. {
            t += 0.003 + 0.011 * f64::from(frame % 7);
            if t >= 1.0 {
                break;
            }
            flow.advance_to(t).unwrap();
            assert_eq!(flow.t(), t, "{method:?}");
        }
        flow.advance_to(1.0).unwrap();
        let (phi, exact) = (*flow.point().phi(), *end.end().1.phi());
        assert!((phi - exact).norm() < 1e-8, "{method:?}: {}", (phi - exact).norm());
    }
}

/// A step by its error does not begin anew with each frame: one frame, one step, twelve evaluations.
#[test]
fn lengths_of_steps_go_on_from_frame_to_frame() {
    let cube = block(9.81);
    let mut flow = Flow::by(Method::RungeKutta8, &cube, (0.0, thrown(&cube))).unwrap();
    flow.set_tolerance(1e-5).unwrap();
    flow.advance(DT).unwrap();
    let before = flow.statistics();
    for _ in 0..60 {
        flow.advance(DT).unwrap();
    }
    let after = flow.statistics();
    let tried = after.steps + after.rejected - before.steps - before.rejected;
    assert!((60..=64).contains(&tried), "{tried}");
    assert!(after.evaluations - before.evaluations <= 12 * tried);
}

#[test]
fn no_time_is_no_step_and_time_goes_backward() {
    let cube = block(9.81);
    let start = thrown(&cube);
    for method in BY_THEIR_ERROR.into_iter().chain([Method::Splitting { order: 4, step: DT }]) {
        let mut flow = Flow::by(method, &cube, (0.0, start)).unwrap();
        flow.advance(0.0).unwrap();
        assert_eq!((flow.t(), flow.point(), flow.statistics().steps), (0.0, start, 0));
        flow.advance(0.5).unwrap();
        let there = flow.point();
        flow.advance(0.0).unwrap();
        assert_eq!(flow.point(), there);
        flow.advance(-0.5).unwrap();
        assert_eq!(flow.t(), 0.0);
        let way = (flow.point().phi() - start.phi()).norm() + (flow.point().x() - start.x()).norm();
        assert!(way < 1e-8, "{method:?} {way:e}");
    }
}

/// Other fields, another point: what goes on is the motion that begins there.
#[test]
fn what_changes_between_frames_begins_anew() {
    for method in [Method::Splitting { order: 4, step: DT }, Method::RungeKutta8, Method::RungeKuttaNystrom12]
    {
        let mut flow = Flow::by(method, Owned(block(9.81)), (0.0, thrown(&block(9.81)))).unwrap();
        flow.advance_to(time(10)).unwrap();
        let lifted = Owned(block(-2.0));
        let mut fresh = Flow::by(method, lifted, (flow.t(), flow.point())).unwrap();
        flow.set_model(lifted);
        assert_eq!(flow.point(), fresh.point());
        for frame in 11..20 {
            flow.advance_to(time(frame)).unwrap();
            fresh.advance_to(time(frame)).unwrap();
            assert_eq!(flow.point(), fresh.point(), "{method:?}");
        }
        assert_eq!(flow.model(), &block(-2.0));

        let start = thrown(&block(-2.0));
        flow.set_point(start).unwrap();
        flow.set_time(3.0).unwrap();
        assert_eq!((flow.t(), flow.point()), (3.0, start));
        let mut fresh = Flow::by(method, lifted, (3.0, start)).unwrap();
        flow.advance(DT).unwrap();
        fresh.advance(DT).unwrap();
        assert_eq!((flow.t(), flow.point()), (fresh.t(), fresh.point()), "{method:?}");
    }
}

/// Gravity that is another in every frame: `v = sum g dt` and `x = x0 + v0 t + sum of what each frame adds`, exactly what
/// splitting gives for a constant force.
#[test]
fn a_force_that_is_another_in_every_frame() {
    let mut flow = {
        let start = thrown(&block(0.0));
        Flow::by(Method::Splitting { order: 2, step: DT }, Owned(block(0.0)), (0.0, start)).unwrap()
    };
    let (mut x, mut v) = (2.0, 3.0);
    for frame in 0..FRAMES {
        let g = 9.81 * (0.3 * f64::from(frame)).cos();
        flow.set_model(Owned(block(g)));
        flow.advance_to(time(frame + 1)).unwrap();
        x += v * DT - 0.5 * g * DT * DT;
        v -= g * DT;
    }
    assert!((flow.point().x()[2] - x).abs() < 1e-12 && (flow.point().p()[2] - v).abs() < 1e-12);
}

/// The times within the last step are those of a run with outputs there.
#[test]
fn times_within_the_last_step() {
    let cube = block(9.81);
    let start = thrown(&cube);
    let methods = [Method::Splitting { order: 4, step: 0.0625 }, Method::Gauss { stages: 3, step: 0.0625 }];
    for method in methods {
        let run =
            Simulation::new(&cube, start).until(1.0).method(method).output([0.94, 0.98, 1.0]).run().unwrap();
        let mut flow = Flow::by(method, &cube, (0.0, start)).unwrap();
        for frame in 1..=16 {
            flow.advance_to(0.0625 * f64::from(frame)).unwrap();
        }
        for (t, point) in run.iter() {
            assert_eq!(flow.interpolate(t).unwrap(), *point, "{method:?}");
        }
        flow.advance(0.0625).unwrap();
        assert_eq!(flow.interpolate(1.0).unwrap().phi(), run.end().1.phi(), "where it began");
    }
    for method in BY_THEIR_ERROR {
        let mut flow = Flow::by(method, &cube, (0.0, start)).unwrap();
        flow.advance_to(0.01).unwrap();
        flow.advance_to(0.02).unwrap();
        let there = flow.point();
        let run = Simulation::new(&cube, start).until(0.0195).tolerance(1e-14).output([]).run().unwrap();
        let found = flow.interpolate(0.0195).unwrap();
        assert!((found.phi() - run.end().1.phi()).norm() < 1e-9, "{method:?}");
        assert_eq!(flow.point(), there, "the motion stays where it is");
    }
    let free = Free.at_velocity(strained(), sheared()).unwrap();
    let mut flow = Flow::new(&Free, (0.0, free)).unwrap();
    flow.advance_to(0.5).unwrap();
    let run = Simulation::new(&Free, free).until(0.5).output([0.25]).run().unwrap();
    assert_eq!(flow.interpolate(0.25).unwrap(), run.points()[0]);
}

/// A shared model, in threads that make their own flows.
#[test]
fn threads_step_a_shared_model() {
    for method in BY_THEIR_ERROR.into_iter().chain([Method::Gauss { stages: 2, step: DT }]) {
        let cube = Arc::new(block(9.81));
        let start = thrown(&cube);
        let moved = |cube: Arc<Cube>| {
            let mut flow = Flow::by(method, cube, (0.0, start)).unwrap();
            flow.advance(0.25).unwrap();
            flow.advance(0.25).unwrap();
            flow.point()
        };
        let shared = Arc::clone(&cube);
        let sent = std::thread::scope(|scope| scope.spawn(|| moved(shared)).join().unwrap());
        assert_eq!(sent, moved(cube), "{method:?}");
    }
}

/// A model may hold what threads do not share.
#[test]
fn fields_that_threads_do_not_share() {
    let counted = Counted { lift: Lift { asked: Rc::default() } }.prepare().unwrap();
    let asked = Rc::clone(&counted.lift.asked);
    let rest = Matrix::<2>::zeros();
    let start = counted.at_velocity(Vector::zeros(), Matrix::identity(), Vector::zeros(), rest).unwrap();
    let run = Simulation::new(&counted, start).until(1.0).run().unwrap();
    let mut flow = Flow::new(Owned(counted), (0.0, start)).unwrap();
    flow.advance_to(1.0).unwrap();
    assert_eq!(&flow.point(), run.end().1);
    assert!((flow.point().x()[0] - 1.0).abs() < 1e-12 && asked.get() > 0);
}

/// Many bodies in one place, each with its own model.
#[test]
fn a_thousand_bodies() {
    let body = |k: u32| {
        let cube = block(0.01 * f64::from(k));
        Flow::by(Method::Splitting { order: 2, step: DT }, Owned(cube), (0.0, thrown(&cube))).unwrap()
    };
    let mut bodies: Vec<Flow<'static, 3, Owned<Cube>>> = (0..1000).map(body).collect();
    for frame in 1..=4 {
        for body in &mut bodies {
            body.advance_to(time(frame)).unwrap();
        }
    }
    for (k, body) in (0_u32..).zip(&bodies) {
        let t = time(4);
        let height = 2.0 + 3.0 * t - 0.005 * f64::from(k) * t * t;
        assert!((body.point().x()[2] - height).abs() < 1e-12);
    }
}

/// Another method from a frame on; the energy is what the model says of the point.
#[test]
fn another_method_and_the_energy() {
    let cube = block(9.81);
    let start = thrown(&cube);
    let mut flow = Flow::new(&cube, (0.0, start)).unwrap();
    flow.advance(0.25).unwrap();
    let steps = flow.statistics().steps;
    flow.set_method(Method::Gauss { stages: 4, step: 0.01 }).unwrap();
    flow.advance(0.25).unwrap();
    assert_eq!(flow.statistics().steps, steps + 25);
    flow.set_tolerance(1e-12).unwrap();
    flow.set_method(Method::Automatic).unwrap();
    flow.advance(0.5).unwrap();
    let energy = |point| cube.hamiltonian(0.0, &point);
    assert!((energy(flow.point()) - energy(start)).abs() < 1e-9 * energy(start).abs());
}

/// A closed form goes on where there is one from a new point, and begins to be integrated where there is none.
#[test]
fn closed_forms_from_new_points() {
    fn moved<'a, H: Handle<2, Model = Free> + 'a>(flow: &mut Flow<'a, 2, H>) {
        flow.advance(0.5).unwrap();
        flow.advance(0.5).unwrap();
    }
    let start = Free.at_velocity(strained(), sheared()).unwrap();
    let mut flow = Flow::new(Owned(Free), (0.0, start)).unwrap();
    moved(&mut flow);
    let run = Simulation::new(&Free, start).until(1.0).run().unwrap();
    assert_eq!(&flow.point(), run.end().1);
    assert_eq!(flow.statistics().evaluations, 0);
    flow.set_point(start).unwrap();
    moved(&mut flow);
    assert!((flow.point().phi() - run.end().1.phi()).norm() < 1e-14);
    assert_eq!(flow.t(), 2.0);
}

/// The last good point stands, and from there the flow goes on, as by other fields.
#[test]
fn after_a_collapse() {
    let start = Dust { pull: 1.0 }.prepare().unwrap();
    let dust = |pull: f64| Owned(Dust { pull }.prepare().unwrap());
    let point = start.at_velocity(Matrix::identity(), Matrix::<2>::new(0.0, 0.0, 0.0, 1.0)).unwrap();
    for method in [Method::Splitting { order: 2, step: DT }, Method::RungeKutta8] {
        let mut flow = Flow::by(method, dust(1.0), (0.0, point)).unwrap();
        // phi_11 = 1 - t^2/2 has its zero at sqrt 2, phi_22 = 1 + t - t^2/2 has not by then.
        let stop = flow.advance_to(3.0).unwrap_err();
        let affine_runtime::simulate::Reason::Placement { determinant, rate, t } = stop.reason else {
            panic!("{stop}")
        };
        assert!(determinant <= 0.0 && rate.unwrap() < 0.0, "{determinant} {rate:?}");
        assert!((t - 2.0_f64.sqrt()).abs() < 1e-9, "{method:?} {t}");
        assert_eq!(stop.t, flow.t());
        assert_eq!(stop.steps, flow.statistics().steps);
        assert!(flow.t() < t && flow.point().phi().determinant() > 0.0);
        let exact = 1.0 - 0.5 * flow.t() * flow.t();
        assert!((flow.point().phi()[(0, 0)] - exact).abs() < 1e-9, "{method:?}");

        // No step leads past it, however often it is tried.
        for _ in 0..3 {
            let (before, again) = (flow.t(), flow.advance(1.0).unwrap_err());
            assert!(matches!(again.reason, affine_runtime::simulate::Reason::Placement { .. }), "{again}");
            assert!(before <= flow.t() && flow.t() < t && flow.point().phi().determinant() > 0.0);
        }
        let t = flow.t();
        flow.set_model(dust(-1e4));
        flow.advance(0.5).unwrap();
        assert_eq!(flow.t(), t + 0.5);
        assert!(flow.point().phi()[(0, 0)] > 1.0);
    }
}

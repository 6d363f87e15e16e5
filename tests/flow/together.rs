//! Many bodies of one loop: what each of them does by itself, what may change in between, and what is refused.

use std::sync::atomic::{AtomicBool, Ordering};

use affine_runtime::capability::{InLanes, Splitting};
use affine_runtime::force::AtPoint;
use affine_runtime::model::{Handle, Owned};
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Setting, Stop};

use crate::models::{
    Block, Cube, Driven, Dust, Held, PreparedDust, Push, Pushed, Slanted, Spring, Tightened, Walled, block,
    sheared, strained, thrown,
};

type PointOf<const N: usize, M> = <M as Model<N>>::Point<f64>;

const STEP: f64 = 0.01;
const METHOD: Method = Method::Splitting { order: 2, step: STEP };

const TOLERANCE: f64 = 1e-9;

/// Both ways to step bodies together.
const WAYS: [Method; 2] = [METHOD, Method::RungeKutta8];

/// Bodies by one of them.
fn together<const N: usize, M>(
    way: Method,
    bodies: Vec<(Owned<M>, PointOf<N, M>)>,
) -> Result<Flows<'static, N, Owned<M>>, Stop>
where
    M: Model<N> + InLanes<N> + Splitting<N> + Clone + Send + Sync + 'static,
    M::Point<f64>: Send,
{
    match way {
        Method::RungeKutta8 => Flows::by_runge_kutta(TOLERANCE, 0.0, bodies),
        _ => Flows::by_splitting((2, STEP), 0.0, bodies),
    }
}

/// Each body by itself.
fn alone<const N: usize, H: Handle<N> + 'static>(
    way: Method,
    bodies: &[(H, PointOf<N, H::Model>)],
) -> Vec<Flow<'static, N, H>> {
    let alone = |(handle, start): &(H, _)| {
        let mut body = Flow::by(way, handle.clone(), (0.0, *start)).unwrap();
        body.set_tolerance(TOLERANCE).unwrap();
        body
    };
    bodies.iter().map(alone).collect()
}

/// Every body a cube of its own stiffness and weight.
fn cubes(count: i32) -> Vec<(Owned<Cube>, PointOf<3, Cube>)> {
    let cube = |k| Block { stiffness: 50.0 + f64::from(k), g: 9.81 - 0.1 * f64::from(k) }.prepare().unwrap();
    (0..count).map(|k| (Owned(cube(k)), thrown(&cube(k)))).collect()
}

#[test]
fn bodies_with_models_of_their_own() {
    for way in WAYS {
        let bodies = cubes(19);
        let mut flows = together(way, bodies.clone()).unwrap();
        let mut alone = alone(way, &bodies);
        assert_eq!((flows.len(), flows.is_empty(), flows.t()), (19, false, 0.0));
        for frame in 1..=20 {
            flows.advance(0.025).unwrap();
            alone.iter_mut().for_each(|body| body.advance(0.025).unwrap());
            assert!(flows.points().eq(alone.iter().map(Flow::point)), "{way:?}: {frame}");
        }
        assert_eq!(flows.model(7).unwrap().hamiltonian(0.0, &thrown(&bodies[7].0.0)), {
            bodies[7].0.0.hamiltonian(0.0, &thrown(&bodies[7].0.0))
        });
        flows.advance(0.0).unwrap();
        assert!(flows.points().eq(alone.iter().map(Flow::point)), "no time has passed");
        assert!(flows.model(19).is_none() && flows.point(19).is_none());
        assert!(format!("{flows:?}").contains("alone: 0"), "{flows:?}");
    }
}

/// Points, models and times between frames, as each body has them by itself; frames of many steps and of parts of one.
#[test]
fn points_and_models_change_between_frames() {
    for way in WAYS {
        let bodies = cubes(9);
        let mut flows = together(way, bodies.clone()).unwrap();
        let mut alone = alone(way, &bodies);
        for frame in 0..9 {
            let dt = [0.03, 0.001, 0.7][frame % 3];
            flows.advance(dt).unwrap();
            alone.iter_mut().for_each(|body| body.advance(dt).unwrap());
            assert!(flows.points().eq(alone.iter().map(Flow::point)), "{way:?}: {frame}");
            let bounced = {
                let (point, model) = (alone[frame].point(), alone[frame].model());
                let p = Vector::<3>::new(point.p()[0], point.p()[1], -point.p()[2]);
                model.at_momentum(point.x(), *point.phi(), p, point.pi()).unwrap()
            };
            flows.set_point(frame, bounced).unwrap();
            alone[frame].set_point(bounced).unwrap();
            let none = block(1.0).unflatten(&[f64::NAN; 24]);
            let stop = flows.set_point(frame, none).unwrap_err();
            assert!(stop == alone[frame].set_point(none).unwrap_err() && stop.steps > 0, "{stop}");
            let next = 8 - frame;
            flows.set_model(next, Owned(block(-1.0))).unwrap();
            alone[next].set_model(Owned(block(-1.0)));
            assert!(flows.points().eq(alone.iter().map(Flow::point)), "{frame}, before the next step");
        }
        flows.advance(-0.1).unwrap();
        alone.iter_mut().for_each(|body| body.advance(-0.1).unwrap());
        assert!(flows.points().eq(alone.iter().map(Flow::point)), "{way:?}");
    }
}

/// In one step it turns by a quarter of a radian and more, so that it is looked at whether it kept its orientation.
#[test]
fn bodies_that_spin_fast_stay_in_lanes() {
    let cube = block(9.81);
    let start = |k: i32| {
        let spin =
            Matrix::<3>::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0) * (16.0 + 4.0 * f64::from(k));
        cube.at_velocity(Vector::zeros(), Matrix::identity(), Vector::zeros(), spin).unwrap()
    };
    let bodies: Vec<_> = (0..9).map(|k| (Owned(cube), start(k))).collect();
    let step = 1.0 / 64.0;
    let mut flows = Flows::by_splitting((2, step), 0.0, bodies.clone()).unwrap();
    let mut alone: Vec<_> = bodies
        .iter()
        .map(|(cube, start)| Flow::by(Method::Splitting { order: 2, step }, *cube, (0.0, *start)).unwrap())
        .collect();
    for _ in 0..32 {
        flows.advance(step).unwrap();
        alone.iter_mut().for_each(|body| body.advance(step).unwrap());
        assert!(flows.points().eq(alone.iter().map(Flow::point)));
    }
    assert!(format!("{flows:?}").contains("alone: 0"), "{flows:?}");
}

fn are_where_each_is<const N: usize, M>(bodies: Vec<(Owned<M>, PointOf<N, M>)>, count: usize)
where
    M: Model<N> + InLanes<N> + Splitting<N> + Clone + Send + Sync + 'static,
    M::Point<f64>: Send,
{
    for way in WAYS {
        let mut flows = together(way, bodies.clone()).unwrap();
        assert!(format!("{flows:?}").contains(&format!("alone: {count}")), "{flows:?}");
        let mut alone = alone(way, &bodies);
        for _ in 0..10 {
            flows.advance(0.05).unwrap();
            alone.iter_mut().for_each(|body| body.advance(0.05).unwrap());
            assert!(flows.points().eq(alone.iter().map(Flow::point)), "{way:?}");
        }
        assert!(format!("{flows:?}").contains(&format!("alone: {count}")), "{flows:?}");
    }
}

/// With bases and forces of the user's own, and where steps are looked after.
#[test]
fn bodies_of_other_kinds() {
    let phi = |k: i32| strained() * (1.0 + 0.02 * f64::from(k));
    let slanted = |k: i32| Slanted { c: 1.0 + 0.1 * f64::from(k) }.prepare().unwrap();
    let slanted = (0..10).map(|k| (Owned(slanted(k)), slanted(k).at_velocity(phi(k), sheared()).unwrap()));
    are_where_each_is(slanted.collect(), 0);
    let phi = |k: i32| Matrix::<2>::new(1.0 + 0.01 * f64::from(k), 0.1, -0.1, 0.95);
    let (x, v) = (Vector::<2>::new(0.1, 0.4), Vector::<2>::new(0.2, -0.1));
    let held = |k: i32| {
        let (ends, spring) = ([[1.0, 0.0], [-1.0, 0.5]], Spring(1.0 + f64::from(k)));
        Held { press: AtPoint::new(ends, spring), turn: AtPoint::new(ends, spring) }
    };
    // A prepared model is copied where the fields that it holds are.
    let tightened = (0..10).map(|k| {
        let Held { press, turn } = held(k);
        let model = Tightened { stiffness: 10.0, press, turn }.prepare().unwrap();
        (Owned(model), model.at_velocity(x, phi(k), v, 0.3 * sheared()).unwrap())
    });
    are_where_each_is(tightened.collect(), 0);
    let held = (0..10).map(|k| (Owned(held(k)), held(k).at_velocity(x, phi(k), v, 0.3 * sheared()).unwrap()));
    are_where_each_is(held.collect(), 0);
    let walled = (0..10).map(|k| (Owned(Walled), Walled.at_velocity(x, phi(k), v, 0.3 * sheared()).unwrap()));
    are_where_each_is(walled.collect(), 10);
    let driven = (0..10).map(|k| (Owned(Driven), Driven.at_velocity(phi(k), 0.3 * sheared()).unwrap()));
    are_where_each_is(driven.collect(), 0);
}

/// Dust that is pulled together: bodies 2 and 9 collapse.
fn dust() -> Vec<(Owned<PreparedDust>, PointOf<2, PreparedDust>)> {
    let dust = |k: usize| {
        let dust = Dust { pull: if k == 2 || k == 9 { 4.0 } else { 0.1 } }.prepare().unwrap();
        (Owned(dust), dust.at_velocity(Matrix::identity(), Matrix::<2>::new(0.0, 0.1, 0.2, 0.0)).unwrap())
    };
    (0..12).map(dust).collect()
}

/// A body that collapses does so at the time and in the words that it has by itself, and the others go on.
#[test]
fn a_body_that_stops_does_not_stop_the_others() {
    for way in WAYS {
        stops_alone(way);
    }
}

fn stops_alone(way: Method) {
    let bodies = dust();
    let mut flows = together(way, bodies.clone()).unwrap();
    let mut alone = alone(way, &bodies);
    let mut frame = 0;
    let stop = loop {
        frame += 1;
        assert!(frame < 100, "nothing collapses");
        if let Err(stop) = flows.advance_to(0.05 * f64::from(frame)) {
            break stop;
        }
    };
    let t = 0.05 * f64::from(frame);
    let stops: Vec<_> = alone
        .iter_mut()
        .map(|body| {
            let mut frames = (1..=frame).map(|frame| body.advance_to(0.05 * f64::from(frame)));
            frames.find_map(Result::err)
        })
        .collect();
    assert_eq!(flows.t(), t);
    let stopped: Vec<_> = flows.stopped().map(|(number, _)| number).collect();
    assert_eq!(stopped, [2, 9]);
    assert!(matches!(stop.reason, Reason::Placement { .. }), "{stop}");
    for (number, stop) in flows.stopped() {
        let own = stops[number].as_ref().unwrap();
        let (Reason::Placement { t, .. }, Reason::Placement { t: alone, .. }) = (&stop.reason, &own.reason)
        else {
            panic!("{stop} {own}")
        };
        // What rounding left out of its state stays behind in its lane, and so do the lengths of its steps.
        let is_near = if way == METHOD { (t - alone).abs() < 1e-14 } else { (t - alone).abs() < TOLERANCE };
        assert!(stop.steps == own.steps || way != METHOD && stop.steps > 1, "{stop} {own}");
        assert!(is_near && (stop.t == own.t || way != METHOD && stop.t > own.t), "{stop} {own}");
    }
    for (number, (point, body)) in flows.points().zip(&alone).enumerate() {
        let off = (point.phi() - body.point().phi()).norm();
        let has_left = stops[number].is_some();
        assert!(if has_left { off < 1e-14 || way != METHOD } else { off == 0.0 }, "{number}: {off:e}");
    }

    // They are still there a frame later, until one is put elsewhere.
    let stuck = flows.point(2).unwrap();
    assert!(flows.advance(0.05).is_err());
    assert_eq!(flows.stopped().count(), 2);
    // Equal steps fail as they did; those by errors begin with a shorter one.
    assert!(flows.point(2).unwrap() == stuck || way != METHOD);
    let (_, start) = bodies[0];
    for number in [2, 9] {
        flows.set_model(number, Owned(Dust { pull: 0.1 }.prepare().unwrap())).unwrap();
        flows.set_point(number, start).unwrap();
    }
    flows.advance(0.05).unwrap();
    assert_eq!(flows.stopped().count(), 0);
    assert!(format!("{flows:?}").contains("alone: 0"), "{flows:?}");
}

/// Three bodies in eight lanes, the second of which comes to where the push has no value: it stops there, as by itself, the others go
/// on, and no force is asked in lanes where no body is. Nothing begins where there is no value.
#[test]
fn a_force_without_a_value_stops_its_body_alone() {
    static WAS_ASKED_NOWHERE: AtomicBool = AtomicBool::new(false);
    let pushed = Pushed { push: Push(&WAS_ASKED_NOWHERE) };
    let start = |x: f64| {
        let (x, v) = (Vector::<2>::new(x, 0.0), Vector::<2>::new(0.3, 0.0));
        pushed.at_velocity(x, strained(), v, 0.3 * sheared()).unwrap()
    };
    let bodies = [-8.0, 1.5, -6.0].map(|x| (Owned(pushed), start(x)));
    for way in WAYS {
        let mut flows = together(way, bodies.to_vec()).unwrap();
        let mut alone = alone(way, &bodies);
        for _ in 0..20 {
            let moved = flows.advance(0.1);
            let own: Vec<bool> = alone.iter_mut().map(|body| body.advance_to(flows.t()).is_ok()).collect();
            assert_eq!(moved.is_ok(), !own.contains(&false), "{way:?}");
            assert!(flows.stopped().map(|(number, _)| own[number]).all(|moves| !moves), "{way:?}");
            for number in [0, 2] {
                assert_eq!(flows.point(number), Some(alone[number].point()), "{way:?}");
            }
        }
        assert!(flows.stopped().map(|(number, _)| number).eq([1]), "{way:?}");
        // Steps of their own lengths begin anew beside the lane, and come to another place before the last value.
        let (off, apart) = ((flows.point(1).unwrap().x() - alone[1].point().x()).norm(), [1e-12, 0.1]);
        assert!(off < apart[usize::from(way != METHOD)], "{way:?}: {off:e}");
        flows.set_point(1, start(0.0)).unwrap();
        flows.advance(0.1).unwrap();
        assert_eq!((flows.stopped().count(), flows.len()), (0, 3));
    }
    assert!(!WAS_ASKED_NOWHERE.load(Ordering::Relaxed));
    let mut flows = together(Method::RungeKutta8, bodies.to_vec()).unwrap();
    assert_eq!(flows.set_point(0, start(2.5)).unwrap_err().reason, Reason::NotFinite);
    assert_eq!(flows.point(0), Some(bodies[0].1), "it stays where it is");
    let beyond = together(Method::RungeKutta8, vec![(Owned(pushed), start(2.5))]);
    assert_eq!(beyond.err().unwrap().reason, Reason::NotFinite);
}

/// So many that threads share them: each is still the body of its number.
#[test]
fn more_bodies_than_one_thread_takes() {
    let kept = dust();
    let falls = |k: usize| [3, 700, 1099].contains(&k);
    let bodies: Vec<_> = (0..1100).map(|k| if falls(k) { kept[2] } else { kept[0] }).collect();
    let point =
        |k: usize| kept[0].0.0.at_momentum(*kept[0].1.phi() * (1.0 + 1e-4 * k as f64), kept[0].1.pi());
    for way in WAYS {
        let mut flows = together(way, bodies.clone()).unwrap();
        (0..1100).filter(|k| !falls(*k)).for_each(|k| flows.set_point(k, point(k).unwrap()).unwrap());
        assert!(flows.advance(1.0).is_err());
        assert!(flows.stopped().map(|(number, _)| number).eq([3, 700, 1099]));
        for k in (0..1100).step_by(89) {
            let mut alone = alone(way, &[(bodies[k].0, point(k).unwrap())]);
            alone[0].advance(1.0).unwrap();
            assert_eq!(flows.point(k).unwrap(), alone[0].point(), "{way:?}: {k}");
        }
    }
}

/// Steps to one time are counted for each body; one that has taken as many as it may goes on with the next frame.
#[test]
fn a_body_of_too_many_steps_waits_where_it_is() {
    let bodies = cubes(9);
    let mut flows = together(Method::RungeKutta8, bodies.clone()).unwrap();
    let mut alone = alone(Method::RungeKutta8, &bodies);
    flows.set_max_steps(6);
    alone.iter_mut().for_each(|body| body.set_max_steps(6));
    let stop = flows.advance(2.0).unwrap_err();
    let own: Vec<_> = alone.iter_mut().map(|body| body.advance(2.0).unwrap_err()).collect();
    assert_eq!((stop.reason, stop.t), (Reason::StepLimit { limit: 6 }, own[0].t));
    assert_eq!((flows.stopped().count(), flows.t()), (9, 2.0));
    for ((number, stop), own) in flows.stopped().zip(&own) {
        assert_eq!((stop.reason, stop.t, stop.steps), (own.reason, own.t, 6), "{number}");
    }
    assert!(flows.points().eq(alone.iter().map(Flow::point)));
    flows.set_max_steps(0);
    assert_eq!(flows.advance(0.1).unwrap_err().reason, Reason::StepLimit { limit: 0 });
    assert_eq!(flows.advance(0.0).unwrap_err().reason, Reason::StepLimit { limit: 0 }, "they try again");
    flows.set_max_steps(1000);
    flows.advance(0.1).unwrap();
    alone.iter_mut().for_each(|body| {
        body.set_max_steps(1000);
        body.advance_to(2.1).unwrap();
    });
    for (point, body) in flows.points().zip(&alone) {
        let off = (point.phi() - body.point().phi()).norm();
        assert!(off < 1e-7, "the steps of one begin anew: {off:e}");
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let said = |(order, step), t0, bodies| {
        Flows::by_splitting((order, step), t0, bodies).err().map(|stop| stop.to_string()).unwrap_or_default()
    };
    assert!(said((3, STEP), 0.0, cubes(9)).starts_with("order 3"));
    assert!(said((3, STEP), 0.0, cubes(0)).starts_with("order 3"), "without bodies");
    for step in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert!(said((2, step), 0.0, cubes(1)).starts_with("a step of "), "{step}");
    }
    assert!(said((2, STEP), f64::NAN, cubes(1)).contains("times are finite numbers"));
    let mut bodies = cubes(9);
    bodies[8].1 = bodies[8].0.0.unflatten(&[f64::NAN; 24]);
    assert!(said((2, STEP), 0.0, bodies).contains("finite"));

    for (tolerance, t0) in [(0.0, 0.0), (1.0, 0.0), (f64::NAN, 0.0), (1e-9, f64::INFINITY)] {
        let stop = Flows::by_runge_kutta(tolerance, t0, cubes(9)).err().unwrap();
        assert!(matches!(stop.reason, Reason::Setting(_)), "{stop}");
    }
    let mut bodies = cubes(9);
    bodies[8].1 = bodies[8].0.0.unflatten(&[f64::INFINITY; 24]);
    assert!(together(Method::RungeKutta8, bodies).err().unwrap().to_string().contains("finite"));
    WAYS.iter().for_each(|way| is_not_moved(*way));
}

fn is_not_moved(way: Method) {
    let mut flows = together(way, cubes(9)).unwrap();
    let (points, cube) = (flows.points().collect::<Vec<_>>(), block(1.0));
    for dt in [f64::NAN, f64::INFINITY] {
        assert!(flows.advance(dt).unwrap_err().to_string().ends_with("times are finite numbers"));
    }
    if way == METHOD {
        assert!(matches!(flows.advance(1e300).unwrap_err().reason, Reason::Setting(Setting::Step { .. })));
        assert_eq!(flows.advance(1e5).unwrap_err().reason, Reason::StepLimit { limit: 1_000_000 });
        flows.set_max_steps(10);
        assert_eq!(flows.advance(0.101).unwrap_err().reason, Reason::StepLimit { limit: 10 });
    }
    assert!(matches!(flows.advance(1e-320).unwrap_err().reason, Reason::Setting(Setting::Interval { .. })));
    assert!(flows.set_point(8, cube.unflatten(&[f64::NAN; 24])).is_err());
    for refused in [flows.set_point(9, points[0]), flows.set_model(9, Owned(cube))] {
        let stop = refused.unwrap_err();
        assert_eq!(stop.reason, Reason::Setting(Setting::Body { number: 9, of: 9 }));
        assert!(stop.to_string().contains("body 9 of 9: bodies are counted from 0"), "{stop}");
    }
    assert!(flows.points().eq(points) && flows.t() == 0.0, "nothing has moved");
    let mut none = together(way, cubes(0)).unwrap();
    none.advance(1.0).unwrap();
    assert!(none.is_empty() && none.t() == 1.0);
}

/// A frame that some bodies did not reach may be asked for again.
#[test]
fn bodies_that_stopped_try_again() {
    for way in WAYS {
        let mut flows = together(way, cubes(9)).unwrap();
        flows.advance(0.01).unwrap();
        flows.set_max_steps(if way == METHOD { 100 } else { 1 });
        let stop = flows.advance(0.5).err();
        assert!(way == METHOD || stop.is_some_and(|stop| matches!(stop.reason, Reason::StepLimit { .. })));
        assert_eq!(flows.stopped().count(), if way == METHOD { 0 } else { 9 });
        flows.set_max_steps(1000);
        flows.advance_to(flows.t()).unwrap();
        assert_eq!(flows.stopped().count(), 0, "{way:?}");
        let mut others = together(way, cubes(9)).unwrap();
        others.advance(0.51).unwrap();
        let apart = |(one, other): (PointOf<3, Cube>, PointOf<3, Cube>)| (one.x() - other.x()).norm();
        assert!(flows.points().zip(others.points()).map(apart).all(|apart| apart < 1e-6), "{way:?}");
    }
}

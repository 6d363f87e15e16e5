//! What a flow refuses, and in which words; it stays where it is.

use affine_runtime::model::Owned;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Setting};

use crate::models::{Driven, Drop, Free, block, sheared, strained, thrown};

/// The words of what is refused.
fn said<const N: usize, M: Model<N>>(model: &M, start: M::Point<f64>, method: Method) -> String {
    Flow::by(method, model, (0.0, start)).err().unwrap().to_string()
}

#[test]
fn methods_that_the_model_does_not_have() {
    let cube = block(9.81);
    let start = thrown(&cube);
    assert_eq!(
        said(&cube, start, Method::ClosedForm),
        "Block has no closed form from this start: use Method::Automatic, which takes one only where it exists"
    );
    assert!(
        said(&cube, start, Method::Rattle { order: 2, step: 0.1 }).contains("say `constraint = isochoric`")
    );
    let driven = Driven.at_velocity(strained(), sheared()).unwrap();
    assert_eq!(
        said(&Driven, driven, Method::Taylor { order: None }),
        "Driven was not given `taylor`: write `emit(taylor)` in its `#[affine_model(...)]`, which the compiler refuses where \
         such a model cannot have it, or use Method::Automatic, which takes what there is"
    );
    assert!(said(&Driven, driven, Method::RungeKuttaNystrom8).contains("`emit(nystrom)`"));
    let drop = Drop.at_velocity(Matrix::identity(), Matrix::<2>::new(0.3, 1.0, -0.5, -0.3)).unwrap();
    assert!(said(&Drop, drop, Method::Splitting { order: 2, step: 0.1 }).contains("`emit(splitting)`"));
}

#[test]
fn methods_that_make_no_sense() {
    let cube = block(9.81);
    let start = thrown(&cube);
    for order in [0, 3, 10] {
        assert!(
            said(&cube, start, Method::Splitting { order, step: 0.1 }).starts_with(&format!("order {order}"))
        );
    }
    assert!(
        said(&cube, start, Method::Gauss { stages: 5, step: 0.1 }).starts_with("Gauss collocation with 5")
    );
    for step in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        for method in [Method::Splitting { order: 2, step }, Method::Gauss { stages: 2, step }] {
            assert!(said(&cube, start, method).starts_with("a step of "), "{method:?}");
        }
    }
    let mut flow = Flow::new(&cube, (0.0, start)).unwrap();
    for tolerance in [0.0, 1.0, f64::NAN, -1e-9] {
        let stop = flow.set_tolerance(tolerance).unwrap_err();
        assert!(matches!(stop.reason, Reason::Setting(Setting::Tolerance { .. })));
    }
    let stop = flow.set_method(Method::Splitting { order: 7, step: 0.1 }).unwrap_err();
    assert_eq!(stop.reason, Reason::Setting(Setting::Order { given: 7 }));
    flow.advance(0.1).unwrap();
}

#[test]
fn times_that_are_none() {
    let cube = block(9.81);
    let start = thrown(&cube);
    for t in [f64::NAN, f64::INFINITY] {
        let stop = Flow::new(&cube, (t, start)).err().unwrap();
        assert!(matches!(stop.reason, Reason::Setting(Setting::Time { .. })), "{stop}");
    }
    for method in [Method::RungeKutta8, Method::Splitting { order: 2, step: 0.01 }] {
        let mut flow = Flow::by(method, &cube, (0.0, start)).unwrap();
        flow.advance(0.5).unwrap();
        let (t, there) = (flow.t(), flow.point());
        for dt in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let stop = flow.advance(dt).unwrap_err();
            assert!(stop.to_string().ends_with("times are finite numbers"), "{stop}");
            assert!(flow.set_time(dt).is_err());
            assert_eq!((flow.t(), flow.point()), (t, there));
        }
        flow.advance(0.5).unwrap();
        assert_eq!(flow.t(), 1.0);
    }
}

/// A frame that is lost in the rounding of the time would be one that never ends: a loop waits for it in vain.
#[test]
fn frames_that_are_lost_in_rounding() {
    let cube = block(9.81);
    let start = thrown(&cube);
    for method in [Method::RungeKutta8, Method::Splitting { order: 2, step: 0.01 }] {
        let mut flow = Flow::by(method, &cube, (1e16, start)).unwrap();
        for dt in [0.1, -0.1] {
            let stop = flow.advance(dt).unwrap_err();
            let lost = Setting::Step { given: 0.1, t0: 1e16, t_end: 1e16 };
            assert_eq!(stop.reason, Reason::Setting(lost), "{stop}");
            assert_eq!((flow.t(), flow.point()), (1e16, start));
        }
        flow.advance(0.0).unwrap();
        flow.set_time(0.0).unwrap();
        flow.advance(0.1).unwrap();
    }
}

/// A frame so long that its equal steps cannot be counted, or that takes more steps than are allowed.
#[test]
fn frames_that_are_too_long() {
    let cube = block(9.81);
    let start = thrown(&cube);
    let mut flow = Flow::by(Method::Splitting { order: 2, step: 0.01 }, &cube, (0.0, start)).unwrap();
    let stop = flow.advance(1e300).unwrap_err();
    assert!(matches!(stop.reason, Reason::Setting(Setting::Step { .. })), "{stop}");
    assert!(stop.to_string().contains(" between 0 and 1e300: "), "{stop}");
    let tiny = flow.interpolate(5e-324).unwrap_err().to_string();
    assert!(tiny.contains("time 5e-324 lies outside the last step, from 0 to 0"), "{tiny}");
    assert_eq!((flow.t(), flow.point()), (0.0, start));
    flow.set_max_steps(100);
    let stop = flow.advance_to(2.0).unwrap_err();
    assert_eq!((stop.reason, stop.t, stop.steps), (Reason::StepLimit { limit: 100 }, flow.t(), 100));
    assert!((flow.t() - 1.0).abs() < 1e-12);
    flow.advance_to(2.0).unwrap();
    assert_eq!(flow.t(), 2.0);
    let mut adaptive = Flow::new(&cube, (0.0, start)).unwrap();
    adaptive.set_max_steps(50);
    let stop = adaptive.advance(1e5).unwrap_err();
    assert_eq!(stop.reason, Reason::StepLimit { limit: 50 });
    assert_eq!(adaptive.statistics().steps, 50);
}

#[test]
fn times_outside_the_last_step() {
    let cube = block(9.81);
    let mut flow =
        Flow::by(Method::Splitting { order: 2, step: 0.015625 }, Owned(cube), (0.0, thrown(&cube))).unwrap();
    assert!(flow.interpolate(0.0).is_ok());
    assert!(flow.interpolate(0.01).is_err(), "no step has been taken");
    flow.advance(1.0).unwrap();
    for t in [0.98, 1.1, f64::NAN] {
        let stop = flow.interpolate(t).unwrap_err();
        assert!(matches!(stop.reason, Reason::Setting(Setting::OutsideStep { from: 0.984375, to: 1.0, .. })));
        assert!(stop.to_string().contains("lies outside the last step, from 0.984375 to 1"), "{stop}");
    }
    flow.set_model(Owned(block(1.0)));
    assert!(flow.interpolate(0.99).is_err(), "a step by other fields");
    assert!(flow.interpolate(1.0).is_ok());
}

#[test]
fn points_that_are_none() {
    let start = Free.at_velocity(strained(), sheared()).unwrap();
    let inside_out = Free.unflatten(&[1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0]);
    let lost = Free.unflatten(&[f64::NAN; 8]);
    assert!(Flow::new(&Free, (0.0, inside_out)).is_err() && Flow::new(&Free, (0.0, lost)).is_err());
    let mut flow = Flow::new(&Free, (0.0, start)).unwrap();
    assert!(matches!(flow.set_point(inside_out).unwrap_err().reason, Reason::Placement { .. }));
    assert_eq!(flow.set_point(lost).unwrap_err().reason, Reason::NotFinite);
    assert_eq!(flow.point(), start);
}

//! Forward and back.

use affine_runtime::Method;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, RoundTrip};

use crate::models::drunk_missile::{self, DrunkMissile, Missile};

fn missile<'a>(tolerance: f64) -> Simulation<'a, 3, DrunkMissile> {
    Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0).tolerance(tolerance)
}

/// The errors of both ways, each against the reference at its end, bound what is left, and the parts are what they say.
#[test]
fn what_is_left_follows_the_tolerance() {
    let left = [1e-4, 1e-7, 1e-10, 1e-13].map(|eps| missile(eps).forward_and_back().unwrap().worst());
    for pair in left.windows(2) {
        assert!(pair[1] < 0.1 * pair[0], "{left:?}");
    }
    assert!(left[0] > 1e-8 && left[3] < 1e-11, "{left:?}");
}

#[test]
fn parts_are_relative_distances() {
    let trip: RoundTrip<3, Missile> = missile(1e-6).forward_and_back().unwrap();
    let (start, back) = (drunk_missile::start(), *trip.back.end().1);
    let phi = (back.phi() - start.phi()).norm() / start.phi().norm();
    assert_eq!(trip.placement(), phi);
    assert!(trip.placement() > 0.0 && trip.affine_spin() > 0.0 && trip.centre() > 0.0);
    assert!(
        trip.worst() >= trip.placement()
            && trip.worst() >= trip.affine_spin()
            && trip.worst() >= trip.centre()
    );
    let text = trip.to_string();
    assert!(text.starts_with("from t = 0 to 10 and back") && text.lines().count() == 4, "{text}");
}

/// A symmetric method in equal steps returns up to rounding and the residual of its iterations, however long the step.
#[test]
fn symmetric_steps_return() {
    let step = 0.25;
    let gauss = |stages| missile(1e-10).method(Method::Gauss { stages, step }).forward_and_back().unwrap();
    for stages in [2, 3] {
        let (trip, exact) = (gauss(stages), missile(1e-14).run().unwrap());
        let error = (trip.forward.end().1.phi() - exact.end().1.phi()).norm();
        assert!(error > 1e-8 && trip.worst() < 1e-12, "{error:e} {:e}", trip.worst());
    }
}

#[test]
fn outputs_and_directions() {
    let trip = missile(1e-8).output([0.5, 2.0, 7.0]).forward_and_back().unwrap();
    assert_eq!(trip.back.times(), [7.0, 2.0, 0.5]);
    let trip = missile(1e-8).until(-3.0).every(1.5).forward_and_back().unwrap();
    assert_eq!((trip.forward.times(), trip.back.times()), (&[0.0, -1.5, -3.0][..], &[-3.0, -1.5, 0.0][..]));
    let still = missile(1e-8).until(0.0).forward_and_back().unwrap();
    assert_eq!(still.worst(), 0.0);
}

/// From where an event stopped it the run goes back; outputs it never reached are none of the way back.
#[test]
fn from_where_an_event_stopped_it() {
    let stop = Event::new("half way", |t, _: &Missile| t - 5.0).stop();
    let trip = missile(1e-10).output([1.0, 9.0]).event(stop).forward_and_back().unwrap();
    assert!((trip.forward.end().0 - 5.0).abs() < 1e-12);
    assert_eq!((trip.back.end().0, trip.back.times()), (0.0, &[1.0][..]));
    assert!(trip.worst() < 1e-7);
}

#[test]
fn a_halt_of_either_way_is_the_outcome() {
    let halt = missile(1e-10).max_steps(3).forward_and_back().unwrap_err();
    assert!(matches!(halt.stop.reason, Reason::StepLimit { limit: 3 }), "{:?}", halt.stop);
}

//! What becomes of each body of an ensemble.

use affine_runtime::lanes::{F64x8, FastF64x8, Lanes};
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Setting};

use crate::models::{Elastic, Heavy, Sampled, Top, Unprotected, vibrating};

/// Two integrations with the tolerance 1e-11 per step, over some tens of steps.
const INTEGRATION: f64 = 1e-9;

#[test]
fn bodies_come_to_where_each_comes_alone() {
    let model = vibrating();
    let starts = model.samples(21, 3);
    let ends = Ensemble::new(&model, starts.clone()).from(0.5).until(3.5).tolerance(1e-11).run().unwrap();
    assert_eq!(ends.len(), starts.len());
    for (start, end) in starts.iter().zip(&ends) {
        let alone = Simulation::new(&model, *start).from(0.5).until(3.5).tolerance(1e-13).run().unwrap();
        let (end, expected) = (end.as_ref().unwrap().phi(), alone.end().1.phi());
        assert!((end - expected).norm() < INTEGRATION * expected.norm());
    }
}

/// More than there are lanes.
const BODIES: usize = F64x8::LANES + 4;

#[test]
fn a_bad_body_does_not_touch_the_others() {
    let good = Unprotected.samples(BODIES, 7);
    let collapsing = Unprotected
        .at_momentum(
            Vector::<2>::zeros(),
            Matrix::<2>::identity(),
            Vector::<2>::zeros(),
            TwoPoint(Matrix::<2>::new(-5.0, 0.0, 0.0, 0.1)),
        )
        .unwrap();
    let ensemble =
        |starts: Vec<_>| Ensemble::new(&Unprotected, starts).until(0.6).tolerance(1e-10).run().unwrap();
    let without_bad = ensemble(good.clone());
    for lane in [0, 3, 7, 8, BODIES - 1] {
        let mut with_bad = good.clone();
        with_bad[lane] = collapsing;
        let ends = ensemble(with_bad.clone());
        let stop = ends[lane].as_ref().unwrap_err();
        assert!(matches!(stop.reason, Reason::Placement { determinant, .. } if determinant < 0.0), "{stop}");
        let alone = Simulation::new(&Unprotected, collapsing).until(0.6).tolerance(1e-10).output([]);
        assert_eq!(*stop, alone.method(Method::RungeKutta8).run().unwrap_err().stop);
        for (k, end) in ends.iter().enumerate().filter(|(k, _)| *k != lane) {
            assert_eq!(end, &without_bad[k], "body {k} beside {lane}");
        }
    }
}

/// A body whose stretches all pass through zero within one step has positive determinants at both of its ends.
#[test]
fn a_body_that_turns_inside_out_twice_within_a_step() {
    let (zero, phi) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let through = |rate: f64| Unprotected.at_momentum(zero, phi, zero, TwoPoint(-rate * phi)).unwrap();
    let starts: Vec<_> = (0..BODIES).map(|k| through(0.1 + k as f64)).collect();
    let ends = Ensemble::new(&Unprotected, starts.clone()).until(0.3).tolerance(1e-2).run().unwrap();
    let mut lost = 0;
    for (start, end) in starts.into_iter().zip(ends) {
        let alone = Simulation::new(&Unprotected, start).until(0.3).tolerance(1e-2).output([]);
        match (end, alone.method(Method::RungeKutta8).run()) {
            (Ok(end), Ok(alone)) => assert_eq!(end, *alone.end().1),
            (Err(stop), Err(halt)) => {
                assert_eq!(stop, halt.stop);
                assert!(matches!(stop.reason, Reason::Placement { .. }), "{stop}");
                lost += 1;
            }
            (end, alone) => panic!("{end:?} {alone:?}"),
        }
    }
    assert_eq!(lost, BODIES - 4, "those that are through by then");
}

/// The equations of such a body have values, by which it could go in lanes.
#[test]
fn a_body_whose_energy_is_out_of_range() {
    let at = |height: f64| Heavy.unflatten(&[height, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.1]);
    let starts = [1.0, 1e10, 2.0].map(at);
    let ends = Ensemble::new(&Heavy, starts).until(1e-150).run().unwrap();
    for (start, end) in starts.into_iter().zip(&ends) {
        let alone = Simulation::new(&Heavy, start).until(1e-150).output([]).method(Method::RungeKutta8).run();
        assert_eq!(*end, alone.map(|run| *run.end().1).map_err(|halt| halt.stop));
    }
    assert!(ends[0].is_ok() && ends[2].is_ok(), "{ends:?}");
    assert!(matches!(ends[1].as_ref().unwrap_err().reason, Reason::Energy { .. }), "{ends:?}");
}

#[test]
fn all_bad_and_none_at_all() {
    let nan = Unprotected.unflatten(&[f64::NAN; 12]);
    let ends = Ensemble::new(&Unprotected, vec![nan; 5]).until(1.0).run().unwrap();
    assert!(ends.iter().all(|end| end.as_ref().unwrap_err().reason == Reason::NotFinite));
    assert!(Ensemble::new(&Unprotected, []).until(1.0).run().unwrap().is_empty());
    let one = Unprotected.samples(1, 2);
    let ends = Ensemble::new(&Unprotected, one.clone()).until(0.0).run().unwrap();
    assert_eq!(ends[0].as_ref().unwrap(), &one[0], "an empty interval");
    let ends = Ensemble::new(&Unprotected, one.clone()).until(1.0).max_steps(1).run().unwrap();
    assert_eq!(ends[0].as_ref().unwrap_err().reason, Reason::StepLimit { limit: 1 });
    let refused = Ensemble::new(&Unprotected, one.clone()).until(1.0).tolerance(0.0).run().unwrap_err();
    assert_eq!(refused, Setting::Tolerance { given: 0.0 });
    let unread = Ensemble::new(&Unprotected, one.clone()).until(1.0).every(0.0).run();
    assert!(unread.is_err_and(|refused| refused.to_string().starts_with("output every 0")));
    assert_eq!(Ensemble::new(&Unprotected, one.clone()).run().unwrap_err(), Setting::NoEnd);
    // A program that returns errors says of an ensemble what it says of a run.
    let of_all = affine_runtime::Error::from(refused);
    let of_one = Simulation::new(&Unprotected, one[0]).until(1.0).tolerance(0.0).run().unwrap_err();
    assert_eq!(of_all, affine_runtime::Error::from(of_one));
}

#[test]
fn constrained_bodies_are_taken_one_by_one() {
    let spin = |s: f64| Matrix::<3>::new(0.0, -2.0 * s, 0.1, 2.0 * s, 0.0, -0.3, -0.1, 0.3, 0.0);
    let starts = [1.0, 1.3, 0.2].map(|s| Top.at_velocity(Matrix::<3>::identity(), spin(s)).unwrap());
    let ends = Ensemble::new(&Top, starts).until(1.0).tolerance(1e-9).run().unwrap();
    for (start, end) in starts.iter().zip(ends) {
        let alone = Simulation::new(&Top, *start).until(1.0).tolerance(1e-9).run().unwrap();
        assert_eq!(end.unwrap(), *alone.end().1);
    }
}

/// Fast functions are not those of scalars, and the bodies come to within the tolerance of where they come alone.
#[test]
fn bodies_in_fast_lanes_come_to_the_same_place() {
    fn come<const N: usize, M: Sampled<N>>(model: &M)
    where
        M::Point<f64>: Send + Sync,
    {
        let ensemble = || Ensemble::new(model, model.samples(11, 5)).until(1.5).tolerance(1e-11);
        let (fast, strict) = (ensemble().run_in::<FastF64x8>().unwrap(), ensemble().run().unwrap());
        for (fast, strict) in fast.iter().zip(&strict) {
            let (fast, strict) = (fast.as_ref().unwrap().phi(), strict.as_ref().unwrap().phi());
            assert!((fast - strict).norm() < INTEGRATION * strict.norm(), "{}", M::DESCRIPTION.name);
        }
    }
    come(&Elastic);
    come(&Unprotected);
}

/// Nor on the neighbours of a body. Without the feature there is one thread, and the test shows that two runs agree.
#[test]
fn results_do_not_depend_on_threads() {
    results_are_one::<F64x8>();
    results_are_one::<FastF64x8>();
}

fn results_are_one<T: Lanes>() {
    let model = vibrating();
    let run = || {
        let starts = model.samples(37, 23);
        Ensemble::new(&model, starts).until(1.5).tolerance(1e-9).run_in::<T>().unwrap()
    };
    let in_pool = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(run)
    };
    let expected = run();
    for threads in [1, 2, 3, 8] {
        assert_eq!(in_pool(threads), expected, "{threads} threads");
    }
}

/// What is asked of bodies in one thread runs in another.
#[test]
fn an_ensemble_goes_to_another_thread() {
    let starts = Elastic.samples(11, 29);
    let ensemble = || {
        let events = || vec![Event::determinant(1.0)];
        Ensemble::new(&Elastic, starts.iter().copied()).until(0.5).events(events).progress(|_| ())
    };
    let here = ensemble();
    let there = std::thread::scope(|scope| scope.spawn(move || here.run().unwrap()).join().unwrap());
    assert_eq!(there, ensemble().run().unwrap());
}

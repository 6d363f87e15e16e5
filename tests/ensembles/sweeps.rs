//! Bodies that have a model each.

use std::sync::atomic::{AtomicU64, Ordering};

use affine_runtime::capability::InLanes;
use affine_runtime::model::Owned;
use affine_runtime::prelude::*;
use affine_runtime::simulate::Member;

use crate::models::{Blown, PreparedBlown, PreparedVibrating, Sampled, Vibrating, Wind, vibrating};

const BODIES: u32 = 21;

fn vibrating_bodies() -> Vec<(Owned<PreparedVibrating>, <PreparedVibrating as Model<3>>::Point<f64>)> {
    let starts = vibrating().samples(BODIES as usize, 41);
    let model = |k| Vibrating { kappa: 5.0 + f64::from(k), c1: 0.1 * f64::from(k + 1) }.prepare().unwrap();
    (0..BODIES).map(model).map(Owned).zip(starts).collect()
}

#[test]
fn a_sweep_has_the_bits_of_each_body_alone() {
    let bodies = vibrating_bodies();
    let ensemble = Ensemble::of(bodies.iter().cloned()).until(1.5).tolerance(1e-9);
    for ((Owned(model), start), end) in bodies.iter().zip(ensemble.run().unwrap()) {
        let alone = Simulation::new(model, *start).until(1.5).tolerance(1e-9);
        assert_eq!(end.unwrap(), *alone.method(Method::RungeKutta8).run().unwrap().end().1);
    }
}

/// Events, with a model each and with that of the first body for all.
fn events_are_those_of_each_body_alone<const N: usize, M: InLanes<N> + Sync>(bodies: &[(&M, M::Point<f64>)])
where
    M::Point<f64>: Send + Sync,
{
    let level = || vec![Event::new("level", |_, point: &M::Point<f64>| point.phi()[(0, 1)] - 0.1)];
    for is_one in [false, true] {
        let body = move |k: usize| (if is_one { bodies[0].0 } else { bodies[k].0 }, bodies[k].1);
        let mut seen = 0;
        let each = |member: Member<M::Point<f64>, _>| {
            let (model, start) = body(member.number as usize);
            let alone = Simulation::new(model, start).until(1.5).tolerance(1e-9).method(Method::RungeKutta8);
            let run = level().into_iter().fold(alone, Simulation::event).run().unwrap();
            assert_eq!((&member.events[..], member.end.unwrap()), (run.events(), *run.end().1));
            seen += member.events.len();
        };
        let ensemble = Ensemble::of((0..bodies.len()).map(body)).until(1.5).tolerance(1e-9);
        ensemble.events(level).each(each).unwrap();
        assert!(seen > bodies.len() / 4, "{seen} events");
    }
}

#[test]
fn events_of_a_sweep_are_those_of_each_body() {
    let bodies = vibrating_bodies();
    let bodies: Vec<_> = bodies.iter().map(|(Owned(model), start)| (model, *start)).collect();
    events_are_those_of_each_body_alone(&bodies);
}

/// A force that equations ask, and bases that depend on fields, are those of the body's own model.
#[test]
fn fields_that_are_no_coefficients_are_those_of_each_body() {
    let model = |k: u32| {
        let eta = Matrix::<2>::new(1.0 + 0.1 * f64::from(k), 0.2, 0.2, 1.0);
        Blown { eta, j: 1.0 + 0.2 * f64::from(k), s: 0.5, wind: Wind(0.3 * f64::from(k)) }.prepare().unwrap()
    };
    let models: Vec<PreparedBlown> = (0..BODIES).map(model).collect();
    let start = models[0]
        .at_velocity(
            Vector::<2>::zeros(),
            Matrix::<2>::identity(),
            Vector::<2>::new(0.1, 0.2),
            Matrix::<2>::new(0.1, 0.2, 0.0, -0.1),
        )
        .unwrap();
    let ends =
        Ensemble::of(models.iter().map(|model| (model, start))).until(1.0).tolerance(1e-9).run().unwrap();
    for (k, (model, end)) in models.iter().zip(&ends).enumerate() {
        let alone = Simulation::new(model, start).until(1.0).tolerance(1e-9).method(Method::RungeKutta8);
        assert_eq!(end.as_ref().unwrap(), alone.run().unwrap().end().1, "body {k}");
    }
    let bodies: Vec<_> = models.iter().map(|model| (model, start)).collect();
    events_are_those_of_each_body_alone(&bodies);
    // The uniform part of the wind alone moves the centre along x by w t^2/2.
    for (k, end) in ends.iter().enumerate() {
        let x = end.as_ref().unwrap().x()[0];
        assert!((x - (0.1 + 0.15 * k as f64)).abs() < 1e-8, "body {k}: {x}");
    }
}

/// Of a thousand chunks no more than one is there at a time: starts are taken when they are needed, and not kept.
#[test]
fn starts_are_taken_as_they_are_needed() {
    let model = vibrating();
    let start = model.samples(1, 5)[0];
    let (taken, done) = (AtomicU64::new(0), std::cell::Cell::new(0_u64));
    let mut most = 0;
    let starts = (0..60_000).map(|_| {
        taken.fetch_add(1, Ordering::Relaxed);
        start
    });
    let each = |body: affine_runtime::simulate::Member<_, ()>| {
        assert_eq!(body.number, done.get());
        done.set(done.get() + 1);
        most = most.max(taken.load(Ordering::Relaxed) - done.get());
    };
    // An empty interval: what is looked at is the way of the starts.
    Ensemble::new(&model, starts).until(0.0).fold(|_, _| (), |(), _, _| (), each).unwrap();
    assert_eq!(done.get(), 60_000);
    let at_once = 4096 * rayon::current_num_threads() as u64;
    assert!(most <= at_once, "{most} bodies at once");
}

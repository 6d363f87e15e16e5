//! What is written with serde is read back, to the bit.

use std::fmt::Debug;

use affine_runtime::model::Description;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Checkpoint, Conservation, Halt, Member, Reason, Setting, Stop};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::events::PlanarBody;
use crate::models::{Blown, DrunkMissile, Elastic, Sampled, Top, Unprotected, Wind, vibrating};

/// Through text, and through a value of it; what is read is written alike.
fn comes_back<V: Serialize + DeserializeOwned + PartialEq>(value: &V) -> V {
    let text = serde_json::to_string(value).unwrap();
    let read: V = serde_json::from_str(&text).unwrap();
    assert!(read == *value, "{text}");
    assert_eq!(serde_json::to_string(&read).unwrap(), text);
    assert!(serde_json::from_value::<V>(serde_json::to_value(value).unwrap()).unwrap() == *value);
    read
}

/// With events, energies, statistics, how it was computed, and what it conserves.
fn run_comes_back<const N: usize, M: Model<N>>(run: Simulation<'_, N, M>) -> Trajectory<N, M::Point<f64>>
where
    M::Point<f64>: Serialize + DeserializeOwned + PartialEq + Debug,
{
    let run = run.run().unwrap();
    let read = comes_back(&run);
    comes_back(run.description());
    let conservation: Conservation = comes_back(&run.conservation());
    assert_eq!((read.conservation(), read.table()), (conservation, run.table()));
    assert_eq!((read.why().to_string(), read.events()), (run.why().to_string(), run.events()));
    read
}

#[test]
fn runs_come_back() {
    let model = vibrating();
    run_comes_back(Simulation::new(&model, model.samples(1, 11)[0]).until(1.0));
    run_comes_back(Simulation::new(&DrunkMissile, DrunkMissile.samples(1, 12)[0]).until(2.0).every(0.5));
    let spin = Matrix::<3>::new(0.0, -2.0, 0.1, 2.0, 0.0, -0.3, -0.1, 0.3, 0.0);
    run_comes_back(Simulation::new(&Top, Top.at_velocity(Matrix::<3>::identity(), spin).unwrap()).until(0.5));
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let start = PlanarBody.at_momentum(phi, Comoving(Matrix::<2>::new(0.3, 0.2, 0.1, -0.3))).unwrap();
    let level = Event::largest_stretch(2.0).named("of the program").stop();
    let read = run_comes_back(Simulation::new(&PlanarBody, start).until(6.0).event(level));
    assert_eq!(read.stopped_by(), Some("of the program"));
    let checkpoint: Checkpoint = comes_back(read.checkpoint().unwrap());
    let on = Simulation::new(&PlanarBody, start).until(6.0);
    let on = on.event(Event::largest_stretch(2.0).named("of the program").stop()).resume(&checkpoint);
    assert_eq!(on.run().unwrap().end().0, 6.0);
}

/// Bases in which metrics are the identity come back too, and what is read off points in them.
#[test]
fn runs_with_metrics_and_works_come_back() {
    let eta = Matrix::<2>::new(1.3, 0.2, 0.2, 0.9);
    let blown = Blown { eta, j: 1.0, s: 0.5, wind: Wind(0.3) }.prepare().unwrap();
    let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let start = blown.at_velocity(zero, one, zero, Matrix::<2>::new(0.1, 0.2, 0.0, -0.1)).unwrap();
    let read = run_comes_back(Simulation::new(&blown, start).until(1.0).every(0.25));
    let plain = read.orthonormal(&start).phi() - start.phi();
    assert!(plain.norm() > 0.01, "bases are not those of the user");
    assert!(read.conservation().balance().is_some());
}

#[test]
fn bodies_and_stops_come_back() {
    let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let collapsing = TwoPoint(Matrix::<2>::new(-5.0, 0.0, 0.0, 0.1));
    let mut starts = Unprotected.samples(5, 14);
    starts.push(Unprotected.at_momentum(zero, one, zero, collapsing).unwrap());
    type Planar = <Unprotected as Model<2>>::Point<f64>;
    let mut bodies: Vec<Member<Planar, Vec<(f64, Planar)>>> = Vec::new();
    let events = || vec![Event::determinant(1.01)];
    let ensemble = Ensemble::new(&Unprotected, starts.iter().copied()).until(0.6).every(0.1).events(events);
    ensemble.each(|body| bodies.push(body)).unwrap();
    assert!(bodies.iter().any(|body| !body.events.is_empty()) && bodies[5].end.is_err());
    bodies.iter().for_each(|body| drop(comes_back(body)));
    let halt: Halt<2, Planar> = Simulation::new(&Unprotected, starts[5]).until(0.6).run().unwrap_err();
    comes_back(&halt);
}

/// Every kind of reason that has a text or a number that may not be finite.
#[test]
fn reasons_come_back() {
    let reasons = [
        Reason::NotFinite,
        Reason::Energy { energy: f64::INFINITY, t: 1.0 },
        Reason::Placement { determinant: f64::NEG_INFINITY, rate: Some(-1e-300), t: 0.1 },
        Reason::Event { event: "where it is no number", t: 0.3 },
        Reason::Setting(Setting::Time { name: "the time of the end", given: f64::NEG_INFINITY }),
        Reason::Setting(Setting::Checkpoint { model: "Unprotected" }),
        Reason::StepLimit { limit: u64::MAX },
    ];
    for reason in reasons {
        let stop = comes_back(&Stop { reason, t: 0.1 + 0.2, steps: 3 });
        assert_eq!(stop.to_string(), Stop { reason, t: 0.1 + 0.2, steps: 3 }.to_string());
    }
    let nan = Stop { reason: Setting::Tolerance { given: f64::NAN }.into(), t: 0.0, steps: 0 };
    let read: Stop = serde_json::from_str(&serde_json::to_string(&nan).unwrap()).unwrap();
    assert!(matches!(read.reason, Reason::Setting(Setting::Tolerance { given }) if given.is_nan()));
}

/// What is read again is not kept again.
#[test]
fn texts_are_kept_once() {
    let text = serde_json::to_string(&Elastic::DESCRIPTION).unwrap();
    let read = || serde_json::from_str::<Description>(&text).unwrap();
    let (one, other) = (read(), read());
    assert_eq!((one, other), (Elastic::DESCRIPTION, Elastic::DESCRIPTION));
    assert!(std::ptr::eq(one.name, other.name) && std::ptr::eq(one.equations, other.equations));
}

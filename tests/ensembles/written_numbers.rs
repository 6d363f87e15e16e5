//! Numbers that are not finite come back too, wherever one can stand.

use std::collections::BTreeSet;

use affine_runtime::prelude::*;
use affine_runtime::simulate::{Member, Reason, Setting, Stop};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use crate::models::{Blown, Elastic, Sampled, Unprotected, Wind};

type Planar = <Unprotected as Model<2>>::Point<f64>;

/// The paths of all that is a number or may be missing.
fn places(value: &Value, path: &str, places: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(k, own)| self::places(own, &format!("{path}/{k}"), places));
        }
        Value::Object(map) => {
            map.iter().for_each(|(k, own)| self::places(own, &format!("{path}/{k}"), places))
        }
        Value::Null => places.push(path.to_owned()),
        Value::Number(number) if number.is_f64() => places.push(path.to_owned()),
        _ => {}
    }
}

/// In the place of each number of a value, and of each that is missing, one that text formats do not have: it is read, and written
/// alike. With their count.
fn any_number_comes_back<V: Serialize + DeserializeOwned>(value: &V) -> usize {
    let written = serde_json::to_value(value).unwrap();
    let mut paths = Vec::new();
    places(&written, "", &mut paths);
    let with = |path: &str, number: Value| {
        let mut edited = written.clone();
        *edited.pointer_mut(path).unwrap() = number;
        edited
    };
    // What may be missing need not be a number.
    paths.retain(|path| serde_json::from_value::<V>(with(path, json!(0.5))).is_ok());
    for path in &paths {
        for number in ["NaN", "NaN(0xfff8000000000000)", "NaN(0x7ff8000000000123)", "inf", "-inf"] {
            let edited = with(path, json!(number));
            let read: V =
                serde_json::from_value(edited.clone()).unwrap_or_else(|error| panic!("{path}: {error}"));
            assert_eq!(serde_json::to_value(&read).unwrap(), edited, "{path}");
        }
    }
    paths.len()
}

#[test]
fn of_points_and_tables() {
    assert_eq!(any_number_comes_back(&Unprotected.samples(1, 21)[0]), 12);
    assert_eq!(any_number_comes_back(&Elastic.samples(1, 22)[0]), 18);
    let run = Simulation::new(&Unprotected, Unprotected.samples(1, 23)[0]).until(0.1).run().unwrap();
    assert_eq!(any_number_comes_back(&run.table()), run.table().names().len() * run.len());
}

/// With metrics, a work, an event, and a method with a step: all points, all bases, all energies.
#[test]
fn of_runs_and_drifts() {
    let eta = Matrix::<2>::new(1.3, 0.2, 0.2, 0.9);
    let blown = Blown { eta, j: 1.0, s: 0.5, wind: Wind(0.3) }.prepare().unwrap();
    let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let start = blown.at_velocity(zero, one, zero, Matrix::<2>::new(0.1, 0.2, 0.0, -0.1)).unwrap();
    let run = Simulation::new(&blown, start).until(0.2).every(0.2).event(Event::new("half", |t, _| t - 0.1));
    let run = run.method(Method::Gauss { stages: 2, step: 0.1 }).run().unwrap();
    assert_eq!((run.len(), run.events().len(), run.power_balance().is_some()), (2, 1, true));
    // Start, end, two outputs and the event with their times; energies and works of outputs, and four numbers about them.
    let (points, energies) = (5 * (12 + 1), 2 * 2 + 4);
    // Four matrices; the steps of two methods, and ten numbers more, five of which are missing.
    let (bases, computation) = (4 * 4, 2 + 10);
    assert_eq!(any_number_comes_back(&run), points + energies + bases + computation);
    let conservation = run.conservation();
    assert_eq!(any_number_comes_back(&conservation), 2 * conservation.drifts().len() + 4);
    for method in [Method::Rattle { order: 2, step: 0.1 }, Method::Splitting { order: 2, step: 0.1 }] {
        assert_eq!(any_number_comes_back(&method), 1);
    }
}

/// Angles of the potential that turn by the time, with their name.
#[affine_model(dim = 2, kinetic(dalembert = 1), potential = 0.1*phi[1,2]*sin(3*t) + tr(G), emit(lanes))]
struct Driven;

#[test]
fn of_a_motion_that_is_driven() {
    let (one, zero) = (Matrix::<2>::identity(), Matrix::<2>::zeros());
    let start = Driven.at_velocity(one, zero).unwrap();
    let run = Simulation::new(&Driven, start).until(0.1).run().unwrap();
    let written = serde_json::to_value(&run).unwrap();
    assert!(written["computation"]["turns"][1].is_f64(), "{written}");
    any_number_comes_back(&run);
}

#[test]
fn of_bodies() {
    let events = || vec![Event::new("half", |t, _: &Planar| t - 0.1)];
    let starts = Unprotected.samples(1, 24);
    let mut bodies: Vec<Member<Planar, ()>> = Vec::new();
    let ensemble = Ensemble::new(&Unprotected, starts).until(0.2).events(events);
    ensemble.fold(|_, _| (), |(), _, _| (), |body| bodies.push(body)).unwrap();
    assert_eq!(any_number_comes_back(&bodies[0]), 12 + 1 + 13);
}

/// The names that an enumeration knows, as it says where it is given another.
fn names<V: DeserializeOwned + std::fmt::Debug>() -> BTreeSet<String> {
    let message = serde_json::from_str::<V>("\"no such name\"").unwrap_err().to_string();
    message.split('`').skip(3).step_by(2).map(str::to_owned).collect()
}

/// The name of what is written.
fn name<V: Serialize>(value: &V) -> String {
    match serde_json::to_value(value).unwrap() {
        Value::String(name) => name,
        value => value.as_object().unwrap().keys().next().unwrap().clone(),
    }
}

#[test]
fn of_every_reason() {
    let (t, model) = (0.5, "Body");
    let settings = [
        Setting::NoEnd,
        Setting::Time { name: "the time of the end", given: t },
        Setting::Interval { t0: t, t_end: t },
        Setting::Tolerance { given: t },
        Setting::NoSteps,
        Setting::RadauStages { given: 1 },
        Setting::Stages { given: 1 },
        Setting::Order { given: 1 },
        Setting::NotIsochoric { model },
        Setting::NotSeparable { model },
        Setting::OffConstraint { defect: t },
        Setting::NotEmitted { model, key: "taylor" },
        Setting::EventIndex { event: "x", index: 4 },
        Setting::EventLevel { event: "x", given: t },
        Setting::Checkpoint { model },
        Setting::Shard { k: 1, of: 1 },
        Setting::Body { number: 1, of: 1 },
        Setting::Step { given: t, t0: t, t_end: t },
        Setting::OutputSpacing { dt: t, t0: t, t_end: t },
        Setting::OutputOutside { index: 0, t, t0: t, t_end: t },
        Setting::OutputOrder { index: 1, t, before: t },
        Setting::OutsideStep { t, from: t, to: t },
        Setting::NotDense { t },
        Setting::OutsideRun { t, from: t, to: t },
        Setting::NotKept { t },
        Setting::NoClosedForm { model },
    ];
    assert_eq!(settings.iter().map(name).collect::<BTreeSet<_>>(), names::<Setting>());
    let guard = affine_runtime::model::Guard {
        part: "ln(q)",
        argument: "q",
        bound: affine_runtime::model::Bound::Positive,
    };
    let mut reasons = vec![
        Reason::NotFinite,
        Reason::Placement { determinant: t, rate: None, t },
        Reason::Distortion { determinant: t, t },
        Reason::Domain { guard, value: t, t },
        Reason::Energy { energy: t, t },
        Reason::EnergyLost { defect: t, scale: t, t },
        Reason::Degenerate { weakest: t, t },
        Reason::Friction { order: 4, rate: t, longest: t },
        Reason::Range { q: t, t },
        Reason::Unresolved { rate: t, t },
        Reason::StepUnderflow { tolerance: t },
        Reason::NoSolution { residual: t, step: t },
        Reason::StepLimit { limit: 1 },
        Reason::Event { event: "x", t },
        Reason::Accumulation { event: "x", t, count: 1 },
        Reason::Change { event: "x" },
        Reason::Interrupted(affine_runtime::simulate::Callback::Observer),
    ];
    reasons.extend(settings.map(Reason::Setting));
    assert_eq!(reasons.iter().map(name).collect::<BTreeSet<_>>(), names::<Reason>());
    // 25 of settings and 25 of others, and the time of a stop.
    assert_eq!(reasons.iter().map(any_number_comes_back).sum::<usize>(), 25 + 25);
    assert_eq!(any_number_comes_back(&Stop { reason: Reason::NotFinite, t, steps: 1 }), 1);
}

/// Wherever a run has come to, it comes back: a start that is none, an energy out of range, a body that has collapsed.
#[test]
fn of_what_runs_have_come_to() {
    #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = 1e200*q^2)]
    struct Huge;
    let (one, zero) = (Matrix::<2>::identity(), Vector::<2>::zeros());
    let fast = Huge.at_momentum(one, Comoving(one * 1e160)).unwrap();
    let bad = Huge.unflatten(&Huge.flatten(&fast).map(|_| f64::NAN));
    let mirrored = Huge.unflatten(&[-1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    for start in [fast, bad, mirrored] {
        let halt = Simulation::new(&Huge, start).until(1e-110).run().unwrap_err();
        let text = serde_json::to_string(&halt).unwrap();
        let read: affine_runtime::simulate::Halt<2, <Huge as Model<2>>::Point<f64>> =
            serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", halt.stop));
        assert_eq!(serde_json::to_string(&read).unwrap(), text);
        let bits = |point: &<Huge as Model<2>>::Point<f64>| Huge.flatten(point).map(f64::to_bits);
        assert_eq!(bits(read.trajectory.start().1), bits(halt.trajectory.start().1));
    }
    let collapsing = TwoPoint(Matrix::<2>::new(-5.0, 0.0, 0.0, 0.1));
    let start = Unprotected.at_momentum(zero, one, zero, collapsing).unwrap();
    let run =
        Simulation::new(&Unprotected, start).until(0.6).event(Event::determinant(0.0).stop()).run().unwrap();
    let read: Trajectory<2, Planar> = serde_json::from_str(&serde_json::to_string(&run).unwrap()).unwrap();
    assert!(read == run && run.end().1.phi().determinant() <= 0.0, "{}", run.end().1.phi().determinant());
}

//! Any model under stress: what is held, refused in words, and falls short, where that is known beforehand.

use affine_runtime::Error;
use affine_runtime::model::Quantity;
use affine_runtime::prelude::*;
use affine_runtime::report::{
    Finding, Oracle, StabilityCase, StabilityReport, Stress, Verdict, reference_solution,
};
use affine_runtime::simulate::{Reason, Setting};

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = neo_hookean(0.5) + 2*q^2)]
struct Disc;

/// `phi'' = -phi`.
#[affine_model(dim = 2, kinetic(dalembert = 1), potential = 0.5*tr(G))]
struct Spring;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = i), potential = neo_hookean(0.5) + 2*q^2)]
struct Weighed {
    i: f64,
}

fn started<M: Model<2>>(
    start: impl FnOnce(Matrix<2>, Matrix<2>) -> affine_runtime::Result<M::Point<f64>>,
) -> M::Point<f64> {
    start(Matrix::<2>::new(1.1, 0.2, -0.1, 0.9), Matrix::<2>::new(0.3, -0.4, 0.5, 0.1)).unwrap()
}

/// Turns with the angular velocity 1: `phi = exp(t J)` is the motion.
fn turning() -> <Spring as Model<2>>::Point<f64> {
    Spring.at_velocity(Matrix::<2>::identity(), Matrix::<2>::new(0.0, -1.0, 1.0, 0.0)).unwrap()
}

fn words(case: &StabilityCase) -> &str {
    match &case.finding {
        Finding::Stopped(words) => words,
        Finding::Ran { .. } => panic!("{case:?} ran"),
    }
}

fn error(case: &StabilityCase) -> f64 {
    match &case.finding {
        Finding::Ran { error, .. } => *error,
        Finding::Stopped(words) => panic!("{words}"),
    }
}

fn all(report: &StabilityReport, verdict: Verdict) {
    assert!(report.cases().iter().all(|case| case.verdict() == verdict), "{report}");
}

/// A soft body that cannot collapse is held everywhere; there is a row and a call for every case.
#[test]
fn a_soft_body_is_held_everywhere() {
    let mut calls = Vec::new();
    let report = Stress::new(&Disc, started::<Disc>(|phi, rate| Disc.at_velocity(phi, rate)))
        .until(4.0)
        .tolerances([1e-4, 1e-8])
        .speeds([1e-3, 1e1])
        .progress(|done, of| calls.push((done, of)))
        .run()
        .unwrap();
    all(&report, Verdict::Held);
    // Three methods, two tolerances; to the end, two other speeds, ten times as far, and back.
    let count = 3 * 2 * 5;
    assert_eq!(report.cases().len(), count);
    assert_eq!(calls, (1..=count).map(|done| (done, count)).collect::<Vec<_>>());
    let csv = report.to_csv();
    let rows =
        csv::Reader::from_reader(csv.as_bytes()).into_records().map(Result::unwrap).collect::<Vec<_>>();
    assert_eq!(rows.len(), count);
    for (row, case) in rows.iter().zip(report.cases()) {
        assert_eq!((&row[1], &row[3], &row[9]), ("Disc", case.scene.as_str(), "held"));
        let expected = match case.quantity {
            "start come back to" => Oracle::Invariance,
            _ => Oracle::TighterRun,
        };
        assert_eq!(case.oracle, expected);
    }
    let headings: Vec<_> = report.cases().iter().map(|case| case.heading).collect();
    assert_eq!([headings[0], headings[10], headings[20]], ["automatic", "Runge-Kutta 8", "Radau"]);
}

/// The errors are those against extrapolation in double-double numbers, which shares nothing with the runs that judge.
#[test]
fn errors_are_those_against_a_reference() {
    let start = started::<Disc>(|phi, rate| Disc.at_velocity(phi, rate));
    let methods = [Method::RungeKutta8, Method::RungeKutta5, Method::Radau { stages: None }];
    let report =
        Stress::new(&Disc, start).until(4.0).methods(methods).tolerances([1e-6]).speeds([]).run().unwrap();
    let exact = Disc.flatten(&reference_solution(&Disc, &start, (0.0, 4.0)).unwrap());
    let groups: Vec<_> = Disc::DESCRIPTION.full.iter().map(|group| group.quantity).collect();
    assert_eq!(groups, [Quantity::Placement, Quantity::ComovingAffineSpin]);
    for (method, cases) in methods.into_iter().zip(report.cases().chunks(3)) {
        let run = Simulation::new(&Disc, start).until(4.0).output([4.0]).tolerance(1e-6).method(method).run();
        let end = Disc.flatten(run.unwrap().end().1);
        let first = Disc.flatten(&start);
        let part = |from: usize| {
            let size =
                |of: &dyn Fn(usize) -> f64| (from..from + 4).map(|k| of(k).powi(2)).sum::<f64>().sqrt();
            size(&|k| end[k] - exact[k]) / size(&|k| exact[k]).max(size(&|k| first[k]))
        };
        let expected = part(0).max(part(4));
        assert!(expected > 1e-11, "{method:?}: {expected:e} is above what judges err by");
        assert!((error(&cases[0]) / expected - 1.0).abs() < 1e-2, "{method:?}: {expected:e}, {report}");
    }
}

/// Momenta are scaled, and fast ones go for a shorter time: a body with a closed form comes to `phi + t phi_dot` of these.
#[test]
fn a_closed_form_judges_other_methods() {
    #[affine_model(dim = 2, kinetic(dalembert = 1))]
    struct Free;
    let start = Free.at_velocity(Matrix::<2>::identity(), Matrix::<2>::new(0.1, -0.2, 0.3, 0.1)).unwrap();
    let report = Stress::new(&Free, start).until(2.0).tolerances([1e-6, 1e-12]).run().unwrap();
    all(&report, Verdict::Held);
    for case in report.cases().iter().filter(|case| case.quantity != "start come back to") {
        let expected = if case.heading == "automatic" { Oracle::TighterRun } else { Oracle::ClosedForm };
        assert_eq!(case.oracle, expected, "{report}");
    }
    let only = Stress::new(&Free, start).until(2.0).methods([Method::ClosedForm]).run().unwrap();
    assert_eq!(only.cases().len(), 7, "a closed form goes once through each of the extremes");
    all(&only, Verdict::Held);
}

/// The first column of `phi = cos t + sin t phi_dot` vanishes at `t = pi/4`, and with any other speed before `t = pi/2`.
#[test]
fn a_collapse_is_refused_in_words() {
    let start = Spring.at_velocity(Matrix::<2>::identity(), Matrix::<2>::new(-1.0, 0.0, 0.0, 0.3)).unwrap();
    let report = Stress::new(&Spring, start).until(1.6).tolerances([1e-2, 1e-6, 1e-14]).run().unwrap();
    all(&report, Verdict::Refused);
    for case in report.cases() {
        assert!(words(case).contains("det phi"), "{}", words(case));
    }
}

/// Gauss collocation of two stages turns by `2 atan((h/2)/(1 - h^2/12))` in a step `h`, the Pade approximant of `exp(i h)`: a
/// known wrong angle, which energy and the way back do not see.
#[test]
fn long_steps_fall_short_by_a_known_angle() {
    let method = Method::Gauss { stages: 2, step: 2.0 };
    let report = Stress::new(&Spring, turning())
        .until(50.0)
        .methods([method])
        .tolerances([1e-2])
        .speeds([])
        .run()
        .unwrap();
    let lost = 25.0 * (2.0 - 2.0 * 1.5_f64.atan());
    let cases = report.cases();
    assert_eq!(
        cases.iter().map(|case| case.scene.as_str()).collect::<Vec<_>>(),
        ["steps of 2", "time x 10, steps of 2", "forward and back, steps of 2"]
    );
    for (case, lost) in cases.iter().zip([lost, 10.0 * lost]) {
        let expected = 2.0 * (lost / 2.0).sin().abs();
        assert!((error(case) - expected).abs() < 1e-9, "{} for {expected}", error(case));
        assert_eq!(case.verdict(), Verdict::FellShort, "{report}");
    }
    assert_eq!(cases[2].verdict(), Verdict::Held, "a symmetric method comes back");
}

/// An end that no other method reaches is no end.
#[test]
fn what_nobody_can_judge_falls_short() {
    let method = Method::Gauss { stages: 2, step: 0.5 };
    let stress = Stress::new(&Spring, turning()).until(10.0).methods([method]).speeds([]).max_steps(20);
    let report = stress.run().unwrap();
    let judged = &report.cases()[0];
    assert_eq!(judged.verdict(), Verdict::FellShort, "{report}");
    assert!(words(judged).starts_with("ran in 20 steps, to where no other method goes; Runge-Kutta 8: "));
    let long = &report.cases()[1];
    assert_eq!(long.verdict(), Verdict::Refused, "200 steps are more than 20: {}", words(long));
}

/// Fields up to the threshold of `prepare`, whose words are the refusal; a method that the model lacks is refused too.
#[test]
fn fields_and_methods_are_refused_in_words() {
    let model = Weighed { i: 1.0 }.prepare().unwrap();
    let start = model
        .at_momentum(Matrix::<2>::identity(), Comoving(AffineSpin(Matrix::<2>::new(0.1, 0.2, -0.3, 0.1))));
    let report = Stress::new(&model, start.unwrap())
        .until(1.0)
        .methods([Method::RungeKutta8, Method::Taylor { order: None }])
        .tolerances([1e-6])
        .speeds([])
        .fields([1e1, -0.2], |k| Weighed { i: k }.prepare())
        .run()
        .unwrap();
    let [.., heavy, ill_posed] = &report.cases()[..5] else { panic!("{report}") };
    assert_eq!((heavy.scene.as_str(), heavy.verdict()), ("fields x 1e1, 1e-6", Verdict::Held));
    assert_eq!((ill_posed.quantity, ill_posed.verdict()), ("end with other fields", Verdict::Refused));
    assert_eq!(words(ill_posed), Weighed { i: -0.2 }.prepare().unwrap_err().to_string());
    for case in &report.cases()[5..] {
        assert_eq!(case.verdict(), Verdict::Refused);
        assert!(
            words(case).contains(if case.scene.contains("-2e-1") { "I + A" } else { "taylor" }),
            "{report}"
        );
    }
}

#[test]
fn settings_that_make_no_sense_are_errors() {
    let refused = |stress: Stress<'_, 2, Spring>| match stress.run() {
        Err(Error::Stopped(stop)) => stop.reason,
        other => panic!("{other:?}"),
    };
    let stress = || Stress::new(&Spring, turning());
    assert!(matches!(refused(stress()), Reason::Setting(Setting::NoEnd)));
    assert!(matches!(refused(stress().until(f64::NAN)), Reason::Setting(Setting::Time { .. })));
    let loose = stress().until(1.0).tolerances([1e-2, 2.0]);
    assert!(matches!(refused(loose), Reason::Setting(Setting::Tolerance { .. })));
}

/// All that was emitted is tried, and held.
#[test]
fn every_method_that_serves_is_tried() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1),
        potential = neo_hookean(0.5) + 2*q^2,
        emit(taylor, splitting, nystrom)
    )]
    struct Able;

    let start = started::<Able>(|phi, rate| Able.at_velocity(phi, rate));
    let report = Stress::new(&Able, start).until(4.0).tolerances([1e-6]).speeds([]).run().unwrap();
    all(&report, Verdict::Held);
    let headings: Vec<_> = report.cases().iter().step_by(3).map(|case| case.heading).collect();
    let expected = [
        "automatic",
        "Runge-Kutta 8",
        "Radau",
        "Taylor",
        "adaptive splitting",
        "Runge-Kutta-Nystrom 12",
        "Runge-Kutta-Nystrom 8",
    ];
    assert_eq!(headings, expected);
}

//! Reports on models written by hand: figures, columns and pictures. Run times are never asserted.
#![cfg(feature = "report")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[allow(dead_code, unreachable_pub, reason = "models and references that other tests use too")]
#[path = "../simulation"]
mod simulation {
    pub mod models;
    pub mod reference;
}
mod page;
mod stress;
mod svg;
mod truth;

use std::time::Duration;

use affine_runtime::frames::{AffineSpin, Matrix, TwoPoint};
use affine_runtime::model::Model;
use affine_runtime::report::{
    Curve, CurveDiagram, CurvePanel, WorkPrecision, WorkPrecisionDiagram, WorkPrecisionReport,
};
use affine_runtime::simulate::{Drift, Reason, Setting};
use affine_runtime::state::{Phase, Pinned};
use affine_runtime::{__private, Error, Method, Simulation};
use simulation::models::drunk_missile::{self, DrunkMissile};
use simulation::models::planar::{self, Disc, Planar};
use simulation::models::vibrating_body::{self, VibratingBody};
use simulation::reference;
use svg::Picture;

const TOLERANCES: [f64; 5] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11];

fn missile() -> WorkPrecision<'static, 3, DrunkMissile> {
    let (t_end, state) = reference::DRUNK_MISSILE[1];
    WorkPrecision::new(&DrunkMissile, drunk_missile::start(), t_end)
        .against(DrunkMissile.unflatten(&state))
        .tolerances(TOLERANCES)
        .repeats(3)
}

/// Runs into the singularity of its force.
fn doomed() -> WorkPrecisionReport {
    let model = Planar::<true> { spring: 0.0, singular_at: Some(0.5), is_weighed: false };
    let start = planar::start(0.1);
    WorkPrecision::new(&model, start, 1.0).against(start).tolerances([1e-6, 1e-9]).run().unwrap()
}

#[test]
fn rows_hold_what_was_asked_for() {
    let report = missile().run().unwrap();
    assert_eq!(report.model(), "DrunkMissile");
    assert_eq!(report.interval(), (0.0, 10.0));
    assert_eq!(report.quantities(), ["x", "phi", "p_hat", "Sigma_hat"]);
    assert_eq!(report.rows().len(), TOLERANCES.len());
    for (row, tolerance) in report.rows().iter().zip(TOLERANCES) {
        assert_eq!((row.method, row.tolerance), (Method::RungeKutta8, Some(tolerance)));
        let measured = row.outcome.as_ref().unwrap();
        let run = Simulation::new(&DrunkMissile, drunk_missile::start())
            .until(10.0)
            .tolerance(tolerance)
            .method(Method::RungeKutta8)
            .output([10.0])
            .run()
            .unwrap();
        assert_eq!(measured.statistics, run.statistics(), "the same run costs the same");
        assert_eq!(measured.errors.len(), 4);
        assert_eq!(measured.repeats, 3);
        assert!(measured.run_time > Duration::ZERO);
    }
}

#[test]
fn tighter_tolerances_give_smaller_errors_and_cost_more() {
    let report = missile().run().unwrap();
    let rows: Vec<_> = report.rows().iter().map(|row| row.outcome.as_ref().unwrap()).collect();
    for (quantity, name) in report.quantities().iter().enumerate() {
        for pair in rows.windows(2) {
            assert!(pair[1].errors[quantity] < 0.1 * pair[0].errors[quantity], "{name}: 1e-2 in tolerance");
        }
    }
    for pair in rows.windows(2) {
        assert!(pair[1].statistics.evaluations > pair[0].statistics.evaluations);
        assert!(pair[1].energy_drift < pair[0].energy_drift);
    }
}

#[test]
fn the_error_of_a_known_perturbation_is_exact() {
    // The free body moves along phi + t phi_dot exactly; against twice its placement and minus three times its
    // momentum the relative errors are 1/2 and 4/3.
    let start = planar::start(0.25);
    let end = |t: f64| start.phi() + start.pi().0.0.transpose() * t;
    let perturbed = |t: f64| -> Disc {
        let momentum = TwoPoint(AffineSpin(start.pi().0.0 * -3.0));
        __private::phase_point(end(t) * 2.0, momentum, Pinned).unwrap()
    };
    let report = WorkPrecision::new(&Planar::FREE, start, 2.0)
        .methods([Method::ClosedForm])
        .against_solution(perturbed)
        .run()
        .unwrap();
    assert_eq!(report.quantities(), ["phi", "Pi"]);
    let row = &report.rows()[0];
    assert_eq!(report.error(row, "phi"), Some(0.5));
    // One rounding each of the products by 3, the squares, their sum and root, the quotient.
    assert!((report.error(row, "Pi").unwrap() - 4.0 / 3.0).abs() < 8.0 * f64::EPSILON);
    assert_eq!(report.error(row, "Sigma"), None, "not a quantity of this model");
}

#[test]
fn a_closed_form_is_reference_and_one_row() {
    let report = WorkPrecision::new(&Planar::FREE, planar::start(0.1), 3.0)
        .tolerances([1e-4, 1e-8])
        .repeats(1)
        .run()
        .unwrap();
    let methods: Vec<_> = report.rows().iter().map(|row| (row.method, row.tolerance)).collect();
    let expected =
        [(Method::RungeKutta8, Some(1e-4)), (Method::RungeKutta8, Some(1e-8)), (Method::ClosedForm, None)];
    assert_eq!(methods, expected);
    assert_eq!(report.rows()[2].outcome.as_ref().unwrap().errors, [0.0, 0.0]);
    let automatic = WorkPrecision::new(&Planar::FREE, planar::start(0.1), 3.0)
        .methods([Method::Automatic])
        .repeats(1)
        .run()
        .unwrap();
    assert_eq!(automatic.rows().len(), 1, "what ran has no tolerance");
    assert_eq!(automatic.rows()[0].method, Method::ClosedForm);
}

#[test]
fn repeats_end_at_the_cap() {
    let report = missile().tolerances([1e-3]).repeats(1_000_000).time_cap(Duration::ZERO).run().unwrap();
    assert_eq!(report.rows()[0].outcome.as_ref().unwrap().repeats, 1);
    let report = missile().tolerances([1e-3]).repeats(0).run().unwrap();
    assert_eq!(report.rows()[0].outcome.as_ref().unwrap().repeats, 1);
}

#[test]
fn runs_that_stop_keep_their_rows() {
    let report = doomed();
    assert_eq!(report.rows().len(), 2);
    for row in report.rows() {
        let stop = row.outcome.as_ref().unwrap_err();
        assert!(stop.t < 0.5 && matches!(stop.reason, Reason::StepUnderflow { .. } | Reason::NotFinite));
        assert!(report.to_string().contains(&stop.to_string()), "the table gives the reason");
        assert_eq!(report.error(row, "phi"), None);
    }
    assert!(report.series("").is_empty(), "nothing to draw");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let model = Planar::<true> { spring: 0.0, singular_at: Some(0.5), is_weighed: false };
    let without = WorkPrecision::new(&model, planar::start(0.1), 1.0).run().unwrap_err();
    assert_eq!(without, Error::NoReference { model: "Planar" });
    assert!(without.to_string().contains(".against("));
    let refused = |report: WorkPrecision<'_, 3, DrunkMissile>| match report.run() {
        Err(Error::Stopped(stop)) => stop.reason,
        other => panic!("{other:?}"),
    };
    assert_eq!(
        refused(missile().tolerances([1e-6, 2.0])),
        Reason::Setting(Setting::Tolerance { given: 2.0 })
    );
    assert_eq!(
        refused(missile().methods([Method::ClosedForm])),
        Reason::Setting(Setting::NoClosedForm { model: "DrunkMissile" })
    );
    let nowhere = std::env::temp_dir().join("affine-no-such-folder").join("report.svg");
    let kind = std::io::ErrorKind::NotFound;
    assert_eq!(missile().run().unwrap().save_svg(&nowhere), Err(Error::File { path: nowhere, kind }));
}

#[test]
fn the_table_has_aligned_columns() {
    let report = missile().run().unwrap();
    let text = report.to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 2 + TOLERANCES.len());
    assert_eq!(lines[0], "DrunkMissile: relative errors at t = 10 of runs from t = 0");
    for name in ["method", "tolerance", "err phi", "err Sigma_hat", "steps", "rejected", "evaluations"] {
        let end = lines[1].find(name).unwrap() + name.len();
        for line in &lines[2..] {
            let before = line.chars().nth(end - 1).unwrap();
            assert!(name == "method" || before.is_ascii_digit(), "{name} ends every figure below it: {line}");
        }
    }
    let widths: Vec<usize> = lines[1..].iter().map(|line| line.chars().count()).collect();
    assert!(widths.iter().all(|width| *width == widths[0]), "{text}");
}

#[test]
fn csv_reads_back() {
    let report = missile().run().unwrap();
    let csv = report.to_csv();
    let mut lines = csv.lines();
    assert_eq!(
        lines.next().unwrap(),
        "model,method,tolerance,error_x,error_phi,error_p_hat,error_Sigma_hat,steps,rejected,evaluations,\
         series,equivalent_evaluations,seconds,repeats,energy_drift,above_tolerance,stopped"
    );
    for row in report.rows() {
        let fields: Vec<&str> = lines.next().unwrap().split(',').collect();
        let number = |index: usize| fields[index].parse::<f64>().unwrap();
        let measured = row.outcome.as_ref().unwrap();
        assert_eq!((fields[0], fields[1]), ("DrunkMissile", "Runge-Kutta 8"));
        assert_eq!(Some(number(2)), row.tolerance);
        assert_eq!([3, 4, 5, 6].map(number), measured.errors[..]);
        assert_eq!(fields[7].parse(), Ok(measured.statistics.steps));
        assert_eq!(fields[8].parse(), Ok(measured.statistics.rejected));
        assert_eq!(fields[9].parse(), Ok(measured.statistics.evaluations));
        assert_eq!(fields[10].parse(), Ok(measured.statistics.series));
        assert_eq!(fields[11].parse(), Ok(measured.statistics.equivalent_evaluations()));
        assert_eq!(number(12), measured.run_time.as_secs_f64());
        assert_eq!(fields[13].parse(), Ok(measured.repeats));
        assert_eq!(Some(number(14)), measured.energy_drift);
        assert_eq!(fields[15].parse().ok(), measured.above_tolerance);
        assert_eq!((fields[16], fields.len()), ("", 17));
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn csv_of_a_stopped_run_quotes_the_reason() {
    let csv = doomed().to_csv();
    let mut read = csv::Reader::from_reader(csv.as_bytes());
    let columns = read.headers().unwrap().len();
    let rows: Vec<csv::StringRecord> = read.records().collect::<Result<_, _>>().unwrap();
    assert!(!rows.is_empty());
    for row in rows {
        assert_eq!(row.len(), columns);
        assert!(row[columns - 1].starts_with("stopped at t = 0.4"), "{row:?}");
    }
}

#[test]
fn diagrams_have_a_line_per_series() {
    let missile = missile().run().unwrap();
    let other = [(1e-4, 2e-3), (1e-9, 5e-2), (0.0, 0.1), (f64::NAN, 0.2)];
    let diagram = WorkPrecisionDiagram::new("Error against run time", "relative error of phi")
        .all(missile.series("missile, "))
        .series("another tool, <unknown> & \"quoted\"", other);
    let text = diagram.to_svg();
    assert_eq!(text, diagram.to_svg(), "the same bytes for the same data");
    let picture = Picture::of(&text);
    assert_eq!(picture.polylines(), [TOLERANCES.len(), 3], "one line per series, one corner per point");
    // The first series has discs, one of them in the legend; the second has squares, and the page is one more.
    assert_eq!(picture.count("circle"), TOLERANCES.len() + 1);
    assert_eq!(picture.count("rect"), 3 + 1 + 1);
    for wanted in [
        "Error against run time",
        "relative error of phi",
        "run time",
        "missile, Runge-Kutta 8",
        "another tool, <unknown> & \"quoted\"",
        "1e-4",
        "1e-14",
        "0",
        "10 ms",
    ] {
        assert!(picture.texts().any(|text| text == wanted), "{wanted}");
    }
    picture.assert_legible();
    // Precision grows to the right, cost upward.
    let line = picture.polyline(1);
    assert!(line[0].0 < line[1].0 && line[1].0 < line[2].0 && line[0].1 > line[2].1);
}

/// Long titles of one panel are not cut.
#[test]
fn curves_have_room_for_their_title() {
    let curve = Curve { category: 0, points: vec![(0.0, 1.0), (1.0, 2.0), (2.0, 1.5)] };
    let (x, y) = ("x".to_owned(), "y".to_owned());
    let panel = CurvePanel { x, y, logarithmic: false, range: None, curves: vec![curve] };
    let title = "A title that is longer than the only panel of its diagram is wide";
    let text = CurveDiagram::new(title, vec![panel]).legend([(0, "the curve")]).to_svg();
    let picture = Picture::of(&text);
    picture.assert_legible();
    assert_eq!(picture.polylines(), [3]);
}

#[test]
fn empty_diagrams_are_drawn() {
    for diagram in [doomed().diagram(), WorkPrecisionDiagram::new("Nothing was measured", "error")] {
        let text = diagram.to_svg();
        let picture = Picture::of(&text);
        assert_eq!(picture.polylines(), [0; 0]);
        picture.assert_legible();
    }
}

#[test]
fn a_moving_body_leaves_its_path() {
    let run = Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0).every(0.1).run().unwrap();
    let text = run.to_svg();
    assert_eq!(text, run.to_svg(), "the same bytes for the same data");
    let picture = Picture::of(&text);
    // The centre of mass is where the discs of the scene are, in order of time and on the page as in space.
    let path = picture.discs(3.0);
    assert_eq!(path.len(), 6);
    let (first, last) = (run.start().1.x(), run.end().1.x());
    let (right, up) = (Picture::right(&(last - first)), Picture::up(&(last - first)));
    let (dx, dy) = (path[5].0 - path[0].0, path[0].1 - path[5].1);
    assert!(
        (dx * up - dy * right).abs() < 1e-2 * (dx * dx + dy * dy).sqrt() * (right * right + up * up).sqrt()
    );
    // Body, and outline and three half circles at six times; three stretches; six quantities that drift; the path.
    assert_eq!(picture.count("polygon"), 6 + 3, "bodies and arrow heads");
    assert!(picture.polylines().len() > 6 * 4 + 3 + 6);
    for wanted in ["DrunkMissile", "t = 0.0", "t = 10.0", "q1", "q3", "log-stretches", "relative drift", "x3"]
    {
        assert!(picture.texts().any(|text| text == wanted), "{wanted}");
    }
    assert!(picture.texts().any(|text| text.starts_with("energy: ")));
    picture.assert_legible();
}

#[test]
fn drifts_at_the_outputs_end_where_the_conservation_table_does() {
    let run =
        Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0).tolerance(1e-6).run().unwrap();
    for drift in run.conservation().drifts() {
        let history = run.relative_drifts(drift);
        assert_eq!((history.len(), history[0]), (run.len(), 0.0), "{}", drift.quantity.symbol());
        assert_eq!(history.into_iter().fold(0.0, f64::max), drift.relative(), "{}", drift.quantity.symbol());
    }
}

/// What stands in the legend is what the table has, wherever outputs are: the end counts.
#[test]
fn drifts_at_the_end_are_drawn_without_outputs_too() {
    let run = |outputs: &[f64]| {
        let run = Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0);
        run.method(Method::Gauss { stages: 2, step: 0.3 }).output(outputs.iter().copied()).run().unwrap()
    };
    for outputs in [&[][..], &[0.0, 5.0], &[0.0, 5.0, 10.0]] {
        let run = run(outputs);
        let (conservation, picture) = (run.conservation(), run.to_svg());
        let picture = Picture::of(&picture);
        let (kept, drifting): (Vec<&Drift>, Vec<&Drift>) =
            conservation.drifts().iter().partition(|drift| drift.absolute == 0.0);
        // There are as many colours.
        assert!(!drifting.is_empty() && drifting.len() <= 6, "{outputs:?}: {conservation}");
        for drift in drifting {
            let label = format!("{}: {:.0e}", drift.quantity.name(), drift.relative());
            assert!(picture.texts().any(|text| text == label), "{label} for {outputs:?}");
        }
        let remark = picture.texts().find(|text| text.starts_with("no drift"));
        assert_eq!(
            remark.map(str::to_owned),
            (!kept.is_empty()).then(|| format!("no drift: {} more", kept.len()))
        );
    }
}

#[test]
fn a_pinned_body_stands_side_by_side() {
    let run = Simulation::new(&VibratingBody::BENCHMARK, vibrating_body::start()).until(10.0).run().unwrap();
    let picture = run.to_svg();
    let picture = Picture::of(&picture);
    assert!(picture.discs(3.0).is_empty(), "no path");
    let bodies = picture.polygons(96);
    assert_eq!(bodies.len(), 6);
    for (k, body) in bodies.iter().enumerate() {
        for other in &bodies[k + 1..] {
            assert!(svg::apart(body, other), "bodies do not cover one another");
        }
    }
    picture.assert_legible();
}

#[test]
fn a_planar_body_and_a_single_instant_are_drawn() {
    let start = planar::start(0.1);
    let swing = Simulation::new(&Planar::SPRING, start).until(0.5).run().unwrap();
    let instant = Simulation::new(&Planar::FREE, start).until(0.0).run().unwrap();
    let (swing, instant) = (swing.to_svg(), instant.to_svg());
    let (swing, instant) = (Picture::of(&swing), Picture::of(&instant));
    let bodies = swing.polygons(96);
    assert!(bodies.len() > 1);
    for (k, body) in bodies.iter().enumerate() {
        assert!(
            bodies[k + 1..].iter().all(|other| svg::apart(body, other)),
            "bodies do not cover one another"
        );
    }
    assert_eq!(instant.polygons(96).len(), 1, "one time, one body");
    for picture in [swing, instant] {
        assert!(!picture.texts().any(|text| text == "x3" || text == "q3"));
        picture.assert_legible();
    }
}

/// Bodies of the plane that would cover one another stand side by side, with their path beside them; others stand on it.
#[test]
fn planar_bodies_do_not_cover_one_another() {
    #[affine_runtime::affine_model(
        dim = 2,
        kinetic(dalembert = 0.2, space_translation = 1),
        potential = neo_hookean(2) + 2*(det - 1)^2 + x[2]
    )]
    struct Thrown;
    for (speed, is_on_path) in [(0.3, false), (8.0, true)] {
        let velocity = affine_runtime::frames::Vector::<2>::new(speed, speed);
        let spin = Matrix::<2>::new(0.0, 1.0, -1.0, 0.0);
        let start = Thrown.at_velocity(velocity * 0.0, Matrix::<2>::identity(), velocity, spin).unwrap();
        let run = Simulation::new(&Thrown, start).until(2.0 * speed).every(0.1 * speed).run().unwrap();
        let text = run.to_svg();
        let picture = Picture::of(&text);
        let (bodies, centres) = (picture.polygons(96), picture.discs(3.0));
        assert_eq!((bodies.len(), centres.len()), (6, 6));
        for (k, (body, centre)) in bodies.iter().zip(&centres).enumerate() {
            assert!(bodies[k + 1..].iter().all(|other| svg::apart(body, other)));
            assert_eq!(!svg::apart(body, &[*centre]), is_on_path);
        }
        assert_eq!(picture.texts().any(|text| text == "path of the centre"), !is_on_path);
        picture.assert_legible();
    }
}

#[test]
fn the_deformed_circle_is_to_scale() {
    // At t = 0 the free body of this start is the ellipse of phi; its extent across is |row 1|, upward |row 2|.
    let phi: Matrix<2> = *planar::start(0.1).phi();
    let run = Simulation::new(&Planar::FREE, planar::start(0.1)).until(0.0).run().unwrap().to_svg();
    let picture = Picture::of(&run);
    let (width, height) = svg::extent(&picture.polygons(96)[0]);
    let ratio = phi.row(0).norm() / phi.row(1).norm();
    // Corners of the polygon miss the extremes of the ellipse by up to 1 - cos(pi/96).
    assert!((width / height - ratio).abs() < 2e-3 * ratio, "{width} {height} {ratio}");
}

#[test]
fn files_are_written() {
    let folder = std::env::temp_dir().join(format!("affine-report-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let report = missile().run().unwrap();
    let run = Simulation::new(&DrunkMissile, drunk_missile::start()).until(1.0).run().unwrap();
    let [table, diagram, picture] = ["table.csv", "diagram.svg", "picture.svg"].map(|name| folder.join(name));
    report.save_csv(&table).unwrap();
    report.save_svg(&diagram).unwrap();
    run.save_svg(&picture).unwrap();
    assert_eq!(std::fs::read_to_string(&table).unwrap(), report.to_csv());
    assert_eq!(std::fs::read_to_string(&diagram).unwrap(), report.diagram().to_svg());
    assert_eq!(std::fs::read_to_string(&picture).unwrap(), run.to_svg());
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn fixed_steps_give_a_row_each() {
    let steps = [0.4, 0.2, 0.1];
    let report = missile().methods(steps.map(|step| Method::Gauss { stages: 3, step })).run().unwrap();
    assert_eq!(report.rows().len(), steps.len(), "tolerances play no part");
    for (row, step) in report.rows().iter().zip(steps) {
        assert_eq!((row.method, row.tolerance), (Method::Gauss { stages: 3, step }, None));
        assert_eq!(row.outcome.as_ref().unwrap().statistics.steps as f64, 10.0 / step);
    }
    let errors: Vec<f64> = report.rows().iter().map(|row| report.error(row, "phi").unwrap()).collect();
    let order = (errors[1] / errors[2]).log2();
    assert!((order - 6.0).abs() < 0.5, "{errors:?}");
    let series = report.series("");
    assert_eq!((series.len(), series[0].0.as_str(), series[0].1.len()), (1, "Gauss 6", steps.len()));
}

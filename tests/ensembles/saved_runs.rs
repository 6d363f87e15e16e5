//! Runs that are written as they go, killed, and continued.

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use affine_runtime::Error;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Format, Reason, Setting};
use bytes::Bytes;
use parquet::file::reader::{FileReader, SerializedFileReader};

use crate::events::PlanarBody;
use crate::models::{Elastic, PreparedVibrating, Sampled, Unprotected, Vibrating};
use crate::saved::Folder;

const CHUNK: usize = 7;
/// Where a process of its own writes.
const PLACE: &str = "AFFINE_TESTS_SAVED_RUN";

type Point = <Elastic as Model<3>>::Point<f64>;
type Planar = <Unprotected as Model<2>>::Point<f64>;

/// Expands and contracts, with events in most chunks.
fn elastic<'a>() -> Simulation<'a, 3, Elastic> {
    let level = Event::new("level", |_, point: &Point| point.phi()[(0, 0)] - 1.02).rising();
    let start = Elastic.samples(1, 91)[0];
    Simulation::new(&Elastic, start).until(8.0).tolerance(1e-9).event(Event::determinant(1.0)).event(level)
}

/// Turned around where it comes to a line: the integration begins anew.
fn turned<'a>() -> Simulation<'a, 2, Unprotected> {
    let turn = |_: f64, point: &Planar| {
        Unprotected.at_momentum(point.x(), *point.phi(), -point.p(), TwoPoint(point.pi().0.0))
    };
    let start = Unprotected.samples(1, 54)[0];
    let way = start.x()[1] + 0.05 * start.p()[1].signum();
    Simulation::new(&Unprotected, start).until(0.6).every(0.02).event(Event::position(2, way).change(turn))
}

fn closed<'a>() -> Simulation<'a, 2, PlanarBody> {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let start = PlanarBody.at_momentum(phi, Comoving(Matrix::<2>::new(0.3, 0.2, 0.1, -0.3))).unwrap();
    Simulation::new(&PlanarBody, start).until(3.0).event(Event::largest_stretch(1.5)).every(0.1)
}

/// All lines of files whose names begin so, after the first of each, which is the same in all.
fn rows(folder: &Folder, name: &str) -> String {
    let files = folder.files().into_iter().filter(|(own, _)| own.starts_with(name));
    let mut all = String::new();
    for (k, (_, text)) in files.enumerate() {
        let text = String::from_utf8(text).unwrap();
        let (head, rest) = text.split_once('\n').unwrap();
        let head = if k == 0 { format!("{head}\n") } else { String::new() };
        all += &(head + rest);
    }
    all
}

/// Rows and events of a folder are those of the run.
fn are_the_run<const N: usize, M: Model<N>>(folder: &Folder, run: Simulation<'_, N, M>) -> usize {
    let run = run.run().unwrap();
    let (mut outputs, mut events) = (Vec::new(), Vec::new());
    run.csv(&mut outputs).unwrap();
    run.events_csv(&mut events).unwrap();
    assert_eq!(rows(folder, "chunk-"), String::from_utf8(outputs).unwrap());
    if !run.events().is_empty() {
        assert_eq!(rows(folder, "events-"), String::from_utf8(events).unwrap());
    }
    run.events().len()
}

#[test]
fn chunks_put_together_are_the_run() {
    fn saved<const N: usize, M: Model<N> + 'static>(
        name: &str,
        run: impl Fn() -> Simulation<'static, N, M>,
    ) -> usize {
        let folder = Folder::new(name);
        run().save(&folder.0, (Format::Csv, CHUNK), |_| ()).unwrap();
        assert!(folder.files().keys().filter(|name| name.starts_with("chunk-")).count() > 3, "{name}");
        are_the_run(&folder, run())
    }
    assert!(saved("steps", elastic) > 3);
    assert!(saved("times", || elastic().every(0.15)) > 3);
    assert!(saved("taylor", || closed().method(Method::Taylor { order: None })) > 0);
    assert!(saved("closed", closed) > 0);
    assert!(saved("turned", turned) > 0);
    saved("equal steps", || elastic().method(Method::Gauss { stages: 2, step: 0.01 }).every(0.2));
}

/// An end that is the last row of a chunk leaves no empty file; a run without outputs has the names of its columns.
#[test]
fn full_chunks_and_none() {
    let folder = Folder::new("full");
    let run = || closed().output((0..14).map(|k| 0.2 * f64::from(k)));
    run().save(&folder.0, (Format::Csv, CHUNK), |_| ()).unwrap();
    are_the_run(&folder, run());
    assert_eq!(folder.files().keys().filter(|name| name.starts_with("chunk-")).count(), 2);
    let folder = Folder::new("empty");
    closed().output([]).save(&folder.0, (Format::Csv, CHUNK), |_| ()).unwrap();
    are_the_run(&folder, closed().output([]));
}

/// The writing process of the test below, where that asks for one.
#[test]
fn writes_where_it_is_told() {
    if let Ok(place) = std::env::var(PLACE) {
        let slowly = |_: &_| {
            std::thread::sleep(Duration::from_millis(5));
            ControlFlow::Continue(())
        };
        elastic().progress(slowly).save(Path::new(&place), (Format::Csv, CHUNK), |_| ()).unwrap();
    }
}

#[test]
fn what_is_killed_is_continued_with_the_same_bytes() {
    let (whole, killed) = (Folder::new("whole run"), Folder::new("killed run"));
    elastic().save(&whole.0, (Format::Csv, CHUNK), |_| ()).unwrap();
    let mut process = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "saved_runs::writes_where_it_is_told"])
        .env(PLACE, &killed.0)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let manifest = || fs::read_to_string(killed.0.join("manifest.txt")).unwrap_or_default();
    let begin = Instant::now();
    while manifest().matches("\nstate ").count() < 2 {
        assert!(begin.elapsed() < Duration::from_secs(60), "no chunk: {}", manifest());
        std::thread::sleep(Duration::from_millis(2));
    }
    process.kill().unwrap();
    process.wait().unwrap();
    let before = manifest();
    assert!(!before.contains("state ended"), "it was done too early");
    // A state that was under way is none.
    fs::write(killed.0.join("manifest.txt"), before + "chunk chunk-000000999999.csv 999999 7\nstate 1 2")
        .unwrap();
    elastic().save(&killed.0, (Format::Csv, CHUNK), |_| ()).unwrap();
    let is_whole = |(name, _): &(String, Vec<u8>)| !name.ends_with(".part");
    assert!(killed.files().into_iter().filter(is_whole).eq(whole.files().into_iter().filter(is_whole)));
    // What has ended is not run again.
    let ends = |_: &_| ControlFlow::Break(());
    elastic().progress(ends).save(&killed.0, (Format::Csv, CHUNK), |_| ()).unwrap();
}

/// By callbacks of the user, and by the largest number of steps.
#[test]
fn what_is_interrupted_goes_on() {
    let folder = Folder::new("interrupted run");
    let reason = |run: Simulation<'_, 3, Elastic>| match run.save(&folder.0, (Format::Csv, CHUNK), |_| ()) {
        Err(Error::Stopped(stop)) => stop.reason,
        other => panic!("{other:?}"),
    };
    let limited = reason(elastic().max_steps(9));
    assert_eq!(limited, Reason::StepLimit { limit: 9 });
    let mut outputs = 0;
    let ends = |_: f64, _: &Point| {
        outputs += 1;
        if outputs < 11 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    assert!(matches!(reason(elastic().observe(ends)), Reason::Interrupted(_)));
    assert!(matches!(reason(elastic().progress(|_| ControlFlow::Break(()))), Reason::Interrupted(_)));
    elastic().save(&folder.0, (Format::Csv, CHUNK), |_| ()).unwrap();
    are_the_run(&folder, elastic());
}

/// With outputs that are far apart, or none, a run may be interrupted many times between two of them.
#[test]
fn events_between_two_outputs_are_kept() {
    fn interrupted(name: &str, run: impl Fn() -> Simulation<'static, 3, Elastic>, by_steps: bool) {
        let folder = Folder::new(name);
        let mut parts = 0;
        loop {
            parts += 1;
            let mut calls = 0;
            let fifth = move |_: &_| {
                calls += 1;
                if calls < 5 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            };
            let part = if by_steps { run().max_steps(5 * parts) } else { run().progress(fifth) };
            match part.save(&folder.0, (Format::Csv, CHUNK), |_| ()) {
                Ok(()) => break,
                Err(Error::Stopped(_)) => assert!(parts < 100, "{name}"),
                Err(other) => panic!("{name}: {other}"),
            }
        }
        assert!(parts > 5, "{name}: {parts}");
        assert!(are_the_run(&folder, run()) > 3, "{name}");
        let manifest = String::from_utf8(folder.files()["manifest.txt"].clone()).unwrap();
        let listed =
            manifest.lines().filter(|line| line.starts_with("chunk ") || line.starts_with("events "));
        let mut listed: Vec<&str> = listed.filter_map(|line| line.split(' ').nth(1)).collect();
        let count = listed.len();
        listed.sort_unstable();
        listed.dedup();
        assert_eq!((listed.len(), count), (folder.files().len() - 1, count), "{name}: {manifest}");
    }
    for by_steps in [true, false] {
        interrupted("no outputs", || elastic().output([]), by_steps);
        interrupted("one output", || elastic().output([5.0]), by_steps);
        interrupted("few outputs", || elastic().every(3.0), by_steps);
        interrupted("steps in parts", elastic, by_steps);
    }
}

#[test]
fn a_run_that_stops_has_its_rows_written() {
    let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let collapsing = TwoPoint(Matrix::<2>::new(-5.0, 0.0, 0.0, 0.1));
    let start = Unprotected.at_momentum(zero, one, zero, collapsing).unwrap();
    let run = || Simulation::new(&Unprotected, start).until(0.6).tolerance(1e-10).every(0.01);
    let folder = Folder::new("stopped run");
    let halt = run().run().unwrap_err();
    for _ in 0..2 {
        let stopped = run().save(&folder.0, (Format::Csv, CHUNK), |_| ()).unwrap_err();
        assert_eq!(stopped, Error::Stopped(halt.stop));
        let mut outputs = Vec::new();
        halt.trajectory.csv(&mut outputs).unwrap();
        assert_eq!(rows(&folder, "chunk-"), String::from_utf8(outputs).unwrap());
    }
}

#[test]
fn a_folder_of_another_run_is_refused() {
    let folder = Folder::new("refused run");
    let refused =
        |run: Simulation<'_, 3, Elastic>| run.save(&folder.0, (Format::Csv, CHUNK), |_| ()).unwrap_err();
    let other = Error::from(Setting::Checkpoint { model: "Elastic" });
    elastic().max_steps(9).save(&folder.0, (Format::Csv, CHUNK), |_| ()).unwrap_err();
    assert_eq!(refused(elastic().tolerance(1e-8)), other);
    assert_eq!(refused(elastic().every(0.5)), other);
    let place = folder.0.join("manifest.txt");
    let manifest = fs::read_to_string(&place).unwrap();
    for state in ["state 1 2 3", "state word", "state ffffffffffffffff ffffffffffffffff"] {
        fs::write(&place, format!("{manifest}{state}\n")).unwrap();
        assert_eq!(refused(elastic()), other, "{state}");
    }
    // A length or a number of the first state is another, and nothing comes after it.
    let (before, states) = manifest.split_once("\nstate ").unwrap();
    let words: Vec<&str> = states.lines().next().unwrap().split(' ').collect();
    // The first number names the arithmetic, which may be that of another machine.
    for (place_of, word) in words.iter().enumerate().take(40).skip(1) {
        let other_word = format!("{:x}", u64::from_str_radix(word, 16).unwrap().wrapping_sub(1));
        let edited: Vec<&str> =
            (0..words.len()).map(|k| if k == place_of { other_word.as_str() } else { words[k] }).collect();
        fs::write(&place, format!("{before}\nstate {}\n", edited.join(" "))).unwrap();
        assert_eq!(refused(elastic()), other, "word {place_of}");
    }
    // A number of its state is another.
    let last = manifest.trim_end().rfind(' ').unwrap();
    fs::write(&place, format!("{} 1\n", &manifest[..last])).unwrap();
    assert_eq!(refused(elastic()), other);
    fs::write(&place, [0xff, 0xfe, 0x00]).unwrap();
    assert_eq!(refused(elastic()), other, "no text");
    fs::write(&place, "notes without an end of a line").unwrap();
    assert_eq!(refused(elastic()), other, "not of a run");
    assert_eq!(fs::read_to_string(&place).unwrap(), "notes without an end of a line");
    fs::write(&place, manifest).unwrap();
    // Settings are looked at before.
    let nowhere = elastic().tolerance(0.0).save("no folder", (Format::Csv, CHUNK), |_| ()).unwrap_err();
    assert!(nowhere.to_string().contains("tolerance"), "{nowhere}");
    assert!(!Path::new("no folder").exists());
}

/// Each file says of which model it is, by which fields and how it was computed.
#[test]
fn files_say_what_their_rows_are() {
    let fields = Vibrating { kappa: 10.0, c1: 0.5 };
    let model = fields.clone().prepare().unwrap();
    let folder = Folder::new("about");
    let run = Simulation::new(&model, model.samples(1, 5)[0]).until(1.0).every(0.1);
    run.save(&folder.0, (Format::Parquet, CHUNK), |table| table.note_fields(&fields)).unwrap();
    let files: Vec<_> = folder.files().into_iter().filter(|(name, _)| name.ends_with(".parquet")).collect();
    assert_eq!(files.len(), 2);
    for (_, bytes) in files {
        let file = SerializedFileReader::new(Bytes::from(bytes)).unwrap();
        let about = file.metadata().file_metadata().key_value_metadata().unwrap();
        let said: Vec<_> =
            about.iter().map(|word| (word.key.as_str(), word.value.as_deref().unwrap())).collect();
        let expected = [
            ("model", "Vibrating"),
            ("kinetic_energy", PreparedVibrating::DESCRIPTION.kinetic_energy.text),
            ("hamiltonian", PreparedVibrating::DESCRIPTION.hamiltonian.text),
            ("method", "RungeKutta8"),
            ("tolerance", "0.0000000001"),
            ("field_kappa", "10"),
            ("field_c1", "0.5"),
        ];
        assert_eq!(said, expected);
    }
}

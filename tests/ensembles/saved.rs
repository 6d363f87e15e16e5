//! Ensembles that are written as they go, killed, and continued.

use std::collections::BTreeMap;
use std::fs;
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use affine_runtime::Error;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Format, Setting, Table};
use bytes::Bytes;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use crate::models::{Sampled, Unprotected};

const BODIES: usize = 90;
const CHUNK: usize = 16;
/// Where a process of its own writes.
const PLACE: &str = "AFFINE_TESTS_SAVED";

/// Two bodies of which collapse.
fn ensemble<'a>() -> Ensemble<'a, 2, &'a Unprotected> {
    let mut starts = Unprotected.samples(BODIES, 81);
    for place in [20, 70] {
        let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
        let collapsing = TwoPoint(Matrix::<2>::new(-5.0, 0.0, 0.0, 0.1));
        starts[place] = Unprotected.at_momentum(zero, one, zero, collapsing).unwrap();
    }
    Ensemble::new(&Unprotected, starts).until(0.6).tolerance(1e-10).every(0.2)
}

fn save<'a>(ensemble: Ensemble<'a, 2, &'a Unprotected>, folder: &Path) -> affine_runtime::Result<()> {
    ensemble.save(folder, (Format::Csv, CHUNK), &["half"], |number| vec![0.5 * number as f64])
}

/// A folder that goes when a test is done.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("affine-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        Self(path)
    }

    pub(crate) fn files(&self) -> BTreeMap<String, Vec<u8>> {
        let files = fs::read_dir(&self.0).unwrap().map(|file| file.unwrap().path());
        files
            .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read(&path).unwrap()))
            .collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn chunks_hold_the_outputs_of_all_bodies() {
    let folder = Folder::new("whole");
    save(ensemble(), &folder.0).unwrap();
    let files = folder.files();
    let manifest = String::from_utf8(files["manifest.txt"].clone()).unwrap();
    assert_eq!(files.len(), 1 + BODIES.div_ceil(CHUNK));
    assert_eq!(manifest.lines().filter(|line| line.starts_with("stopped ")).count(), 2, "{manifest}");
    assert!(manifest.contains("\nstopped 70 at "), "{manifest}");
    let mut rows = files.iter().filter(|(name, _)| name.starts_with("chunk")).flat_map(|(_, text)| {
        let text = String::from_utf8(text.clone()).unwrap();
        let numbers = |line: &str| line.split(',').map(|n| n.parse().unwrap()).collect::<Vec<f64>>();
        text.lines().skip(1).map(numbers).collect::<Vec<_>>()
    });
    ensemble()
        .each(|body| {
            for (t, point) in body.folded {
                let row = rows.next().unwrap();
                assert_eq!(
                    row[..5],
                    [body.number as f64, 0.5 * body.number as f64, t, point.x()[0], point.x()[1]]
                );
                assert_eq!(row[5], point.phi()[(0, 0)]);
            }
        })
        .unwrap();
    assert_eq!(rows.next(), None);
}

/// The writing process of the test below, where that asks for one.
#[test]
fn writes_where_it_is_told() {
    if let Ok(place) = std::env::var(PLACE) {
        save(ensemble().progress(|_| std::thread::sleep(Duration::from_millis(5))), Path::new(&place))
            .unwrap();
    }
}

#[test]
fn what_is_killed_is_continued_with_the_same_bytes() {
    let (whole, killed) = (Folder::new("uninterrupted"), Folder::new("killed"));
    save(ensemble(), &whole.0).unwrap();
    let mut process = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "saved::writes_where_it_is_told"])
        .env(PLACE, &killed.0)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let manifest = || fs::read_to_string(killed.0.join("manifest.txt")).unwrap_or_default();
    let begin = Instant::now();
    while manifest().matches("\nchunk ").count() < 2 {
        assert!(begin.elapsed() < Duration::from_secs(60), "no chunk: {}", manifest());
        std::thread::sleep(Duration::from_millis(2));
    }
    process.kill().unwrap();
    process.wait().unwrap();
    let (before, there) = (manifest(), killed.files());
    assert!(before.matches("\nchunk ").count() < BODIES.div_ceil(CHUNK), "it was done too early");
    // What is there is whole, and can be read; a line that was under way is one more trouble.
    for line in before.lines().filter(|line| line.starts_with("chunk ")) {
        let name = line.split(' ').nth(1).unwrap();
        assert_eq!(there[name], whole.files()[name]);
    }
    fs::write(killed.0.join("manifest.txt"), before + "stopped 70 at 1").unwrap();
    save(ensemble(), &killed.0).unwrap();
    let rest =
        |files: BTreeMap<String, Vec<u8>>| files.into_iter().filter(|(name, _)| !name.ends_with(".part"));
    assert!(rest(killed.files()).eq(rest(whole.files())));
    // Bodies that are done are not run again.
    let runs = std::sync::atomic::AtomicU64::new(0);
    let count = |_| {
        runs.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    };
    save(ensemble().progress(count), &killed.0).unwrap();
    assert_eq!(runs.into_inner(), 0);
}

#[test]
fn a_folder_of_another_run_is_refused() {
    let folder = Folder::new("refused");
    save(ensemble().shard(0, 9), &folder.0).unwrap();
    let shard = || ensemble().shard(0, 9);
    for other in [ensemble(), ensemble().shard(1, 9), shard().until(0.7), shard().numbers(0..9)] {
        let refused = save(other, &folder.0).unwrap_err();
        assert_eq!(refused, Error::from(Setting::Checkpoint { model: "Unprotected" }));
    }
    let file = Folder::new("file");
    fs::write(&file.0, "no folder").unwrap();
    assert!(matches!(save(ensemble(), &file.0), Err(Error::File { .. })));
    fs::remove_file(&file.0).unwrap();
}

/// A look at two bodies is no beginning of a run of all of them.
#[test]
fn a_folder_of_other_numbers_is_refused() {
    let folder = Folder::new("numbers");
    let some = || ensemble().numbers(6..8);
    save(some(), &folder.0).unwrap();
    let files = folder.files();
    for other in [ensemble(), ensemble().numbers(6..9), some().shard(0, 1), some().numbers(6..7)] {
        let refused = save(other, &folder.0).unwrap_err();
        assert_eq!(refused, Error::from(Setting::Checkpoint { model: "Unprotected" }));
    }
    save(some(), &folder.0).unwrap();
    assert_eq!(folder.files(), files);
}

/// A body whose run an event ends is written where and when it ended, alone or in lanes.
#[test]
fn ends_at_events_are_written_with_their_times() {
    let folder = Folder::new("events");
    let reached = || vec![Event::new("time", |t, _| t - 0.15).stop()];
    let starts = Unprotected.samples(9, 82);
    let bodies = || Ensemble::new(&Unprotected, starts.clone()).until(0.3).events(reached);
    let mut times = Vec::new();
    bodies().each(|body| times.push(body.t)).unwrap();
    assert!(times.iter().all(|t| (t - 0.15).abs() < 1e-15), "{times:?}");
    bodies().save(&folder.0, (Format::Csv, 9), &[], |_| Vec::new()).unwrap();
    let text = String::from_utf8(folder.files()["chunk-000000000000.csv"].clone()).unwrap();
    let written = text.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse::<f64>().unwrap());
    assert_eq!(written.collect::<Vec<_>>(), times);
    // Those that collapse before have the time of the last good phase point.
    ensemble().each(|body| assert_eq!(body.t, body.end.map_or_else(|stop| stop.t, |_| 0.6))).unwrap();
}

/// What would not run leaves nothing behind that is in the way of what does.
#[test]
fn settings_are_looked_at_before_the_folder() {
    let folder = Folder::new("refused");
    assert!(save(ensemble().tolerance(0.0), &folder.0).is_err());
    assert!(save(ensemble().shard(2, 2), &folder.0).is_err() && !folder.0.exists());
    save(ensemble().numbers(0..2), &folder.0).unwrap();
}

/// The same rows in every format, with what is known of all of them.
#[test]
fn chunks_are_written_in_any_format() {
    let rows = |format: Format| {
        let folder = Folder::new(&format!("{format:?}"));
        ensemble().save(&folder.0, (format, CHUNK), &["half"], |number| vec![0.5 * number as f64]).unwrap();
        let files = folder.files();
        assert!(files.keys().filter(|name| name.starts_with("chunk")).count() == BODIES.div_ceil(CHUNK));
        files.into_iter().filter(|(name, _)| name.starts_with("chunk"))
    };
    let text = rows(Format::Csv).flat_map(|(_, text)| {
        let text = String::from_utf8(text).unwrap();
        text.lines().skip(1).map(str::to_owned).collect::<Vec<_>>()
    });
    let numbers: Vec<f64> =
        text.flat_map(|row| row.split(',').map(|n| n.parse().unwrap()).collect::<Vec<_>>()).collect();
    let mut from_parquet = Vec::new();
    for (_, bytes) in rows(Format::Parquet) {
        let file = SerializedFileReader::new(Bytes::from(bytes)).unwrap();
        let about = file.metadata().file_metadata().key_value_metadata().unwrap();
        let keys: Vec<&str> = about.iter().map(|word| word.key.as_str()).collect();
        assert_eq!(keys, ["model", "kinetic_energy", "hamiltonian", "method", "tolerance"]);
        for row in file.get_row_iter(None).unwrap() {
            from_parquet.extend(row.unwrap().get_column_iter().map(|(_, value)| match value {
                Field::Double(value) => *value,
                other => panic!("{other}"),
            }));
        }
    }
    assert_eq!(from_parquet, numbers);
    let archives: usize = rows(Format::Npz)
        .map(|(_, bytes)| {
            let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
            let mut file = archive.by_name("half.npy").unwrap();
            let mut array = Vec::new();
            file.read_to_end(&mut array).unwrap();
            npyz::NpyFile::new(array.as_slice()).unwrap().into_vec::<f64>().unwrap().len()
        })
        .sum();
    assert_eq!(
        archives * Table::of_bodies::<2, Unprotected>(&["half"]).unwrap().names().len(),
        numbers.len()
    );
}

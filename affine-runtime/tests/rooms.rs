//! Which room of the runtime uses which, against the tables in `ARCHITECTURE.md`.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use affine_arrows::Arrows;

const TABLES: &str = include_str!("../ARCHITECTURE.md");

/// The rooms of a crate.
#[derive(Default)]
struct Rooms {
    /// From a file to its room.
    of: BTreeMap<String, String>,
    /// From a room to those that it may use.
    allowed: BTreeMap<String, BTreeSet<String>>,
}

/// The table under the heading of a crate.
fn rooms(name: &str) -> Rooms {
    let (_, after) = TABLES.split_once(&format!("### `{name}`")).unwrap();
    let section = after.split("\n#").next().unwrap();
    let mut rooms = Rooms::default();
    for row in section.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| room")) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let room = cells[1].to_owned();
        let files = cells[2].split('`').skip(1).step_by(2);
        rooms.of.extend(files.map(|file| (file.to_owned(), room.clone())));
        let allowed = cells[4].split(',').map(|room| room.trim().to_owned());
        rooms.allowed.insert(room, allowed.collect());
    }
    rooms
}

/// `simulate` of `simulate.rs` and `simulate/run.rs`.
fn stem(file: &str) -> &str {
    file.split('/').next().unwrap_or(file).trim_end_matches(".rs")
}

fn arrows(src: &str) -> Arrows {
    Arrows::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(src)).unwrap()
}

/// The arrows that are not allowed.
fn forbidden(rooms: &Rooms, arrows: &Arrows) -> BTreeSet<String> {
    let room = |file: &str| match stem(file) {
        // What only declares modules.
        "lib" if !rooms.of.contains_key("lib") => None,
        stem => Some(rooms.of.get(stem).unwrap_or_else(|| panic!("{file} is in no room of the table"))),
    };
    let mut found = BTreeSet::new();
    for (from, used) in &arrows.of {
        let Some(own) = room(from) else { continue };
        let is_allowed = |to: &String| {
            let there = room(to);
            there == Some(own) || there.is_some_and(|there| rooms.allowed[own].contains(there))
        };
        found.extend(used.iter().filter(|to| !is_allowed(to)).map(|to| format!("{from} -> {to}")));
    }
    found
}

fn circles(arrows: &Arrows) -> BTreeSet<String> {
    arrows.circles().into_iter().map(|circle| circle.into_iter().collect::<Vec<_>>().join(" ")).collect()
}

#[test]
fn every_arrow_is_allowed_and_no_files_form_a_circle() {
    for (name, src) in
        [("affine-core", "core/src"), ("affine-integrators", "integrators/src"), ("affine-runtime", "src")]
    {
        let (rooms, arrows) = (rooms(name), arrows(src));
        let known: BTreeSet<&str> = arrows.of.keys().map(|file| stem(file)).collect();
        assert!(
            rooms.of.keys().all(|file| known.contains(file.as_str())),
            "{name}: a file of the table is none"
        );
        let found = forbidden(&rooms, &arrows);
        assert!(found.is_empty(), "{name}: {found:#?}");
        let circles = circles(&arrows);
        assert!(circles.is_empty(), "{name}: {circles:#?}");
    }
}

/// A room that may not use another is found out.
#[test]
fn forbidden_arrows_are_found() {
    let arrows = arrows("core/src");
    let mut rooms = rooms("affine-core");
    rooms.allowed.insert("points".to_owned(), BTreeSet::new());
    assert!(forbidden(&rooms, &arrows).contains("state.rs -> error.rs"));
}

/// Lines of a file that are neither blank nor comments nor tests, which stand last.
fn lines_of_code(text: &str) -> usize {
    let (code, _) = text.split_once("\n#[cfg(test)]\n").unwrap_or((text, ""));
    code.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//")).count()
}

/// What a model without the standard library is linked against.
#[test]
fn the_core_is_small() {
    // Behind the features `std`, `double-double`, `serde` and `approx`, as lines are that say how what is written is read.
    let is_left_out = |file: &str| {
        file.starts_with("error/")
            || file.starts_with("state/")
            || file == "scalar/double_double.rs"
            || file == "interned.rs"
    };
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("core/src");
    let arrows = arrows("core/src");
    let files = arrows.of.keys().filter(|file| !is_left_out(file));
    let read = |file: &String| {
        let text = std::fs::read_to_string(src.join(file)).unwrap();
        let is_code = |line: &&str| {
            let line = line.trim_start();
            !line.starts_with("#[cfg_attr(feature = \"serde\", ") && line != "#[cfg(feature = \"serde\")]"
        };
        text.lines().filter(is_code).fold(String::new(), |text, line| text + line + "\n")
    };
    let lines: usize = files.map(|file| lines_of_code(&read(file))).sum();
    assert!((4000..=5000).contains(&lines), "{lines} lines");
}

/// What shows a motion: the page of a run with its script, and glTF.
#[test]
fn motions_are_shown_by_little() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let shows = |file: &str| {
        stem(file) == "gltf" || file.starts_with("report/page") || file == "report/reproduction.rs"
    };
    let files: Vec<String> = arrows("src").of.into_keys().filter(|file| shows(file)).collect();
    let others = ["report/page.js", "report/page.html"].map(str::to_owned);
    let read = |file: &String| lines_of_code(&std::fs::read_to_string(src.join(file)).unwrap());
    let lines: usize = files.iter().chain(&others).map(read).sum();
    assert!((800..=1200).contains(&lines), "{lines} lines in {files:?}");
}

/// What the feature `analysis` adds.
#[test]
fn the_analysis_is_small() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let arrows = arrows("src");
    let files = arrows.of.keys().filter(|file| stem(file) == "analysis");
    let lines: usize =
        files.map(|file| lines_of_code(&std::fs::read_to_string(src.join(file)).unwrap())).sum();
    assert!((1000..=2200).contains(&lines), "{lines} lines");
}

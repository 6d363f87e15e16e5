//! Which room of the generator uses which, against the table in `ARCHITECTURE.md`.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use affine_arrows::Arrows;

const TABLE: &str = include_str!("../../../ARCHITECTURE.md");

/// The rooms with the rooms and files that they may use.
fn allowed() -> BTreeMap<String, BTreeSet<String>> {
    let names = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<BTreeSet<_>>();
    let rows = TABLE.lines().filter(|line| line.starts_with("| `"));
    let cells = rows.map(|row| row.split('|').map(str::trim).collect::<Vec<_>>());
    cells.map(|cells| (names(cells[1]).pop_first().unwrap(), names(cells[3]))).collect()
}

/// `emit` of `emit.rs` and `emit/body.rs`.
fn room(file: &str) -> &str {
    file.split('/').next().unwrap_or(file).trim_end_matches(".rs")
}

fn arrows() -> Arrows {
    Arrows::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src")).unwrap()
}

#[test]
fn every_arrow_is_allowed_and_no_files_form_a_circle() {
    let (allowed, arrows) = (allowed(), arrows());
    let mut found = BTreeSet::new();
    for (from, used) in &arrows.of {
        let rooms = allowed.get(room(from)).unwrap_or_else(|| panic!("{from} is in no room of the table"));
        let within = |to: &String| {
            let is_allowed = rooms.contains(room(to)) || rooms.contains(to.trim_end_matches(".rs"));
            room(from) == "lib" || room(from) == room(to) || is_allowed
        };
        found.extend(used.iter().filter(|to| !within(to)).map(|to| format!("{from} -> {to}")));
    }
    for circle in arrows.circles() {
        found.insert(format!("circle: {}", circle.into_iter().collect::<Vec<_>>().join(" ")));
    }
    assert!(found.is_empty(), "{found:#?}");
}

/// What is used where, on this crate itself.
#[test]
fn arrows_are_followed() {
    let arrows = arrows();
    let uses = |from: &str, to: &str| arrows.of[from].contains(to);
    // Through a re-export, `crate::algebra::Arena`; in the middle of an expression, `super::` in a nested module; by a child.
    assert!(
        uses("ir/rounding.rs", "algebra/rational.rs")
            && uses("mechanics/reduction.rs", "mechanics/charts.rs")
    );
    assert!(uses("emit/kernel.rs", "algebra/kernel.rs") && uses("lib.rs", "derive.rs"));
    assert!(
        !uses("algebra/rational.rs", "mechanics/charts.rs") && !arrows.of["algebra.rs"].contains("ir.rs")
    );
}

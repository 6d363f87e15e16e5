//! What users reach: how many items of the door, and that no two of them have one name.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod source;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use source::{Place, Sources};

/// Types, functions, traits, constants and macros that a program can name through `affine_runtime` with all features, each once,
/// hidden ones too unless under `__private`. It may only shrink: who adds one makes another private.
const REACHABLE: usize = 170;

/// Likewise under `affine_runtime::analysis`, which only programs that ask for the feature see.
const OF_ANALYSIS: usize = 23;

fn reachable() -> BTreeSet<(Place, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../affine-runtime");
    let crates = [
        ("affine_core", root.join("core/src")),
        ("affine_integrators", root.join("integrators/src")),
        ("affine_runtime", root.join("src")),
    ];
    Sources::read(&crates).reachable("affine_runtime")
}

/// What is reached by several ways counts once, hidden items count, and what emitted code alone uses does not.
#[test]
fn re_exports_are_followed() {
    let items = reachable();
    let at = |place: &str| {
        let (place, name) = place.rsplit_once("::").unwrap();
        items.contains(&(place.split("::").map(str::to_owned).collect(), name.to_owned()))
    };
    for place in [
        "affine_core::matrix::Matrix",
        "affine_core::force::Force",
        "affine_core::error::stop::Reason",
        "affine_integrators::widest::FusedArithmetic",
        "affine_runtime::simulate::simulation::Simulation",
        "affine_runtime::report::work_precision::WorkPrecision",
        "affine_runtime::force::at_point::AtPoint",
    ] {
        assert!(at(place), "{place}");
    }
    for place in [
        "affine_core::custom::as_force",
        "affine_core::norm::larger",
        "affine_integrators::taylor::lanes::halves",
        "affine_integrators::runge_kutta::RungeKutta8",
        "affine_runtime::simulate::recorder::Recorder",
        "affine_runtime::without_report::Pictures",
    ] {
        assert!(!at(place), "{place}");
    }
    assert_eq!(items.iter().filter(|(_, name)| name == "Simulation").count(), 1);
}

#[test]
fn users_reach_no_more_than_they_need() {
    let listed = reachable().into_iter().map(|(place, name)| format!("{}::{name}", place.join("::")));
    let (of_analysis, others): (Vec<String>, Vec<String>) =
        listed.partition(|item| item.starts_with("affine_runtime::analysis::"));
    assert_eq!(others.len(), REACHABLE, "{others:#?}");
    assert_eq!(of_analysis.len(), OF_ANALYSIS, "{of_analysis:#?}");
}

#[test]
fn no_two_items_have_one_name() {
    let mut places: BTreeMap<String, Vec<Place>> = BTreeMap::new();
    for (place, name) in reachable() {
        places.entry(name).or_default().push(place);
    }
    places.retain(|_, places| places.len() > 1);
    assert!(places.is_empty(), "{places:#?}");
}

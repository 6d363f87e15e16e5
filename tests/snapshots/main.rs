//! What the attribute expands to, reviewed like source: pretty-printed in full for models in which every item that is ever
//! emitted stands, and by documentation, reduced equations and lines of each item for the others.
//!
//! `tests/expansions` compiles the full ones as ordinary code, without warnings. After a change of the macro,
//! `INSTA_UPDATE=always cargo test --test snapshots` writes them anew; read the difference before committing it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that fails panics")]

mod items;
mod summary;

use std::collections::BTreeSet;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::LazyLock;

use affine_codegen::expand;
use affine_tests::specimens::{BY_EQUATIONS, IN_FULL, Specimen};
use rayon::prelude::*;

/// Where snapshots of either kind are, beside this file.
const FULL: &str = ".";
const EQUATIONS: &str = "equations";

/// What is reviewed of a model.
struct Review {
    specimen: &'static Specimen,
    text: String,
    shapes: Vec<String>,
}

/// The models of one kind, expanded once for all tests.
fn reviews(specimens: &'static [Specimen], text: impl Fn(&syn::File) -> String + Sync) -> Vec<Review> {
    let review = |specimen: &'static Specimen| {
        let args = specimen.args.parse().expect("arguments");
        let tokens = expand(args, specimen.item().parse().expect("a struct"));
        let file = syn::parse2(tokens).expect("an expansion is a list of items");
        let shapes = items::of(&file).into_iter().map(|item| item.shape).collect();
        Review { specimen, text: text(&file), shapes }
    };
    specimens.par_iter().map(review).collect()
}

static IN_FULL_REVIEWED: LazyLock<Vec<Review>> = LazyLock::new(|| reviews(IN_FULL, prettyplease::unparse));
static REVIEWED_BY_EQUATIONS: LazyLock<Vec<Review>> = LazyLock::new(|| reviews(BY_EQUATIONS, summary::of));

/// Compares with the snapshots in `folder`, all of them whatever the first ones say.
fn compare(reviews: &[Review], folder: &str) {
    let differs = |Review { specimen, text, .. }: &&Review| {
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(folder);
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.set_description(specimen.args);
        let compared = || settings.bind(|| insta::assert_snapshot!(specimen.name, text));
        catch_unwind(AssertUnwindSafe(compared)).is_err()
    };
    let differing: Vec<&str> = reviews.iter().filter(differs).map(|review| review.specimen.name).collect();
    assert!(differing.is_empty(), "{} expansions differ: {differing:?}", differing.len());
}

#[test]
fn in_full() {
    compare(&IN_FULL_REVIEWED, FULL);
}

#[test]
fn by_equations() {
    compare(&REVIEWED_BY_EQUATIONS, EQUATIONS);
}

/// What is read after a change, a person can read.
#[test]
fn all_together_are_short() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("snapshots");
    let lines = |folder: PathBuf| -> usize {
        let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let snapshots = files.filter(|path| path.extension().is_some_and(|extension| extension == "snap"));
        snapshots.map(|path| fs::read_to_string(path).unwrap().lines().count()).sum()
    };
    let all = lines(folder.join(FULL)) + lines(folder.join(EQUATIONS));
    assert!(all < 20_000, "{all} lines");
}

/// A sum of frames in space: a mass matrix of nine rows is factorised once.
#[test]
fn a_sum_of_frames_is_short() {
    let sum = BY_EQUATIONS.iter().find(|specimen| specimen.name == "mixed_body_space_3").unwrap();
    let expansion = expand(sum.args.parse().unwrap(), sum.item().parse().unwrap());
    let lines = prettyplease::unparse(&syn::parse2(expansion).unwrap()).lines().count();
    assert!(lines <= 700, "{lines} lines");
}

/// What no full snapshot shows, nobody reviews.
#[test]
fn every_emitted_item_is_reviewed() {
    let shown: BTreeSet<&String> = IN_FULL_REVIEWED.iter().flat_map(|review| &review.shapes).collect();
    let hidden: Vec<(&String, &str)> = REVIEWED_BY_EQUATIONS
        .iter()
        .flat_map(|review| review.shapes.iter().map(|shape| (shape, review.specimen.name)))
        .filter(|(shape, _)| !shown.contains(shape))
        .collect();
    assert!(hidden.is_empty(), "emitted for these models, and shown in full for none: {hidden:#?}");
}

/// A snapshot whose model is gone would be compiled, and trusted, for ever.
#[test]
fn every_snapshot_has_its_model() {
    for (specimens, folder) in [(IN_FULL, FULL), (BY_EQUATIONS, EQUATIONS)] {
        let known: BTreeSet<String> =
            specimens.iter().map(|specimen| format!("{}.snap", specimen.name)).collect();
        assert_eq!(known.len(), specimens.len());
        let folder = format!("{}/snapshots/{folder}", env!("CARGO_MANIFEST_DIR"));
        let present: BTreeSet<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .filter(|name| name.ends_with(".snap"))
            .collect();
        assert_eq!(present, known);
    }
}

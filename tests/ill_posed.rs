//! Models that the compiler refuses, in folders by kind of mistake: one mistake a file, with what the user sees.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use affine_codegen::diagnostics::Diagnostic;

#[test]
fn refused_models() {
    trybuild::TestCases::new().compile_fail("ill_posed/*/*.rs");
}

/// Well-posed models, and calls that they have no answer to.
#[test]
fn refused_calls() {
    trybuild::TestCases::new().compile_fail("refused_calls/*.rs");
}

/// What the compiler says, case by case.
fn outcomes() -> Vec<(PathBuf, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("ill_posed");
    let entries = |folder: &Path| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let cases = entries(&folder).flat_map(|kind| entries(&kind).collect::<Vec<_>>());
    cases
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .map(|path| {
            let text = fs::read_to_string(path.with_extension("stderr")).unwrap();
            (path, text)
        })
        .collect()
}

/// Users depend on one crate: what it consists of is named in no message.
#[test]
fn inner_crates_are_not_named() {
    let calls = Path::new(env!("CARGO_MANIFEST_DIR")).join("refused_calls");
    let calls = fs::read_dir(calls).unwrap().map(|entry| entry.unwrap().path());
    let calls = calls.filter(|path| path.extension().is_some_and(|extension| extension == "stderr"));
    let calls: Vec<_> = calls.map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect();
    assert!(!calls.is_empty());
    for (path, text) in outcomes().into_iter().chain(calls) {
        let named = ["affine_core", "affine_integrators"].into_iter().find(|name| text.contains(name));
        assert_eq!(named, None, "{}", path.display());
    }
}

/// What no specification leads to: a fault of the macro itself.
const OF_THE_MACRO: &str = "impossible";

#[test]
fn every_mistake_has_a_case() {
    let outcomes = outcomes();
    let seen = |name: &str| {
        name == OF_THE_MACRO || outcomes.iter().any(|(_, text)| text.contains(&format!(" [{name}]\n")))
    };
    let missing: BTreeSet<&str> = Diagnostic::names().filter(|name| !seen(name)).collect();
    assert!(missing.is_empty(), "no case for {missing:?}");
}

/// Every error is one of ours: a refused model, used or not, raises no others.
#[test]
fn nothing_cascades() {
    for (path, text) in outcomes() {
        let errors = text.lines().filter(|line| line.starts_with("error") || line.starts_with("warning"));
        for line in errors {
            let ours = Diagnostic::names().any(|name| line.ends_with(&format!(" [{name}]")));
            assert!(ours, "{}: {line}", path.display());
        }
    }
}

#[test]
fn two_mistakes_arrive_together() {
    let (_, text) = outcomes().into_iter().find(|(path, _)| path.ends_with("two_mistakes.rs")).unwrap();
    assert!(text.contains(" [unknown-symbol]\n") && text.contains(" [division-by-zero]\n"), "{text}");
}

//! What is linked into programs that use one part of the library each, by the names of its functions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;
use std::fs;

use object::{Object, ObjectSymbol};

/// Parts of the library, each by a place that none of its functions does without.
const PARTS: [(&str, &str); 12] = [
    ("runs", "affine_runtime::simulate::run::"),
    ("flows", "affine_runtime::simulate::stepped::"),
    ("ensembles", "affine_runtime::simulate::ensemble::"),
    ("Runge-Kutta", "affine_integrators::runge_kutta::RungeKuttaSteps"),
    ("Taylor", "affine_integrators::taylor::TaylorSteps"),
    ("Nystrom", "affine_integrators::nystrom::NystromSteps"),
    ("splitting", "affine_integrators::splitting::SplittingSteps"),
    ("adaptive splitting", "affine_integrators::splitting::adaptive::HalvedSteps"),
    ("Radau", "affine_integrators::radau::RadauSteps"),
    ("Gauss", "affine_integrators::gauss::GaussSteps"),
    ("RATTLE", "affine_integrators::rattle::RattleSteps"),
    ("Schur", "nalgebra::linalg::schur::"),
];

/// The parts that are linked into a program.
fn parts(program: &str) -> BTreeSet<&'static str> {
    let bytes = fs::read(program).unwrap();
    let file = object::File::parse(&*bytes).unwrap();
    let names: Vec<String> = file
        .symbols()
        .filter(|symbol| symbol.is_definition())
        .map(|symbol| rustc_demangle::demangle(symbol.name().unwrap()).to_string())
        .collect();
    assert!(names.iter().any(|name| name.contains("affine_core::")), "{program} has its symbols");
    let is_there = |place: &str| names.iter().any(|name| name.contains(place));
    PARTS.into_iter().filter(|(_, place)| is_there(place)).map(|(part, _)| part).collect()
}

macro_rules! linked {
    ($($program:ident: [$($part:literal),*];)*) => { $(
        #[test]
        fn $program() {
            let expected = BTreeSet::from([$($part),*] as [&str; _]);
            assert_eq!(parts(env!(concat!("CARGO_BIN_EXE_", stringify!($program)))), expected);
        }
    )* };
}

linked! {
    evaluated: [];
    closed_form: ["runs"];
    straight: ["runs", "Schur"];
    default_run: ["runs", "Runge-Kutta"];
    taylor: ["runs", "Runge-Kutta", "Taylor"];
    nystrom: ["runs", "Runge-Kutta", "Nystrom"];
    splitting: ["runs", "Runge-Kutta"];
    stiff: ["runs", "Runge-Kutta", "adaptive splitting"];
    friction: ["runs", "Runge-Kutta", "Radau"];
    named: ["runs", "Runge-Kutta", "Gauss", "Radau"];
    stepped: ["flows", "Runge-Kutta"];
}

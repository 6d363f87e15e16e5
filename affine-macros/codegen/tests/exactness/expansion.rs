//! Reductions under random forces: what the reduced motion expands to moves by the full equations.
//!
//! A reduced state and the constants of its trajectory expand to a phase point at every time: space is turned back, what
//! moves in closed form is put where it is by then. Its rate follows from the reduced equations by the chain rule, and
//! has to be that of Hamilton's equations of the whole energy with all forces, at random points modulo a prime.

mod drawn;
mod equations;
mod number;
mod point;
mod programs;
mod whole;

use std::collections::BTreeSet;

use affine_codegen::algebra::fault::watch;
use affine_codegen::check;
use affine_codegen::derive::derive;
use affine_codegen::diagnostics::gate;
use affine_codegen::mechanics::form::Form;
use affine_codegen::spec;
use affine_oracle::Random;

use drawn::{Drawn, FORCES, Forces, ITEM, SUMS, energies, families};
use whole::Whole;

/// The energy that the checks let through; `None` where they refuse it.
fn accepted(drawn: &Drawn) -> Option<Form> {
    let spec = gate(|found| spec::parse(drawn.args.parse().unwrap(), ITEM.parse().unwrap(), found)).ok()?;
    gate(|found| check::as_written(&spec, found)).ok()?;
    gate(|found| check::energy(&spec, found)).ok()
}

/// What a derivation gives, on whose way nothing impossible happened.
fn without_fault<T>(args: &str, derivation: impl FnOnce() -> T) -> T {
    let (value, fault) = watch(derivation);
    assert_eq!(fault, None, "{args}");
    value
}

/// Every way to reduce a model, held against its whole motion; what was taken out of the state.
fn every_way(random: &mut Random, drawn: &Drawn) -> Option<BTreeSet<&'static str>> {
    without_fault(&drawn.args, || each_way(random, drawn))
}

fn each_way(random: &mut Random, drawn: &Drawn) -> Option<BTreeSet<&'static str>> {
    let mut whole = Whole::new(&drawn.args, accepted(drawn)?);
    let mut taken = whole.check(random, false);
    if whole.has_halves() {
        taken.extend(whole.check(random, true));
    }
    if whole.is_free() {
        whole.check_closed_form(random);
    }
    Some(taken)
}

/// All that a reduction can take out.
const EVERYTHING: [&str; 14] = [
    "|Vort|^2",
    "|S|^2",
    "drift",
    "p",
    "turn of space",
    "I(O)",
    "Sigma_hat",
    "Sigma",
    "Pi",
    "entries",
    "free dilatation",
    "harmonic dilatation",
    "hyperbolic dilatation",
    "root or logarithm",
];

/// Forces for a model of several, each in its turn: every second in the plane, every fourth in space.
fn in_turn(n: usize, place: usize) -> impl Iterator<Item = Forces> {
    let chosen = move |k: usize| (k + place).is_multiple_of(if n == 2 { 2 } else { 4 });
    FORCES.into_iter().enumerate().filter(move |(k, _)| chosen(*k)).map(|(_, forces)| forces)
}

/// Every family under every kind of forces.
#[test]
fn every_family() {
    let mut random = Random::new(61);
    let mut taken = BTreeSet::new();
    for n in [2, 3] {
        for (place, family) in families().into_iter().enumerate() {
            // Not every energy lets the dilatation move by itself.
            for forces in in_turn(n, place).chain([Forces::Separable]) {
                if let Some(drawn) = Drawn::of_family(&mut random, n, family, forces) {
                    let ways = every_way(&mut random, &drawn);
                    taken.extend(ways.unwrap_or_else(|| panic!("{} is refused", drawn.args)));
                }
            }
        }
    }
    assert_eq!(taken, BTreeSet::from(EVERYTHING));
}

/// Energies on momenta, and motions confined to groups: of each kind of forces some have a meaning there.
#[test]
fn every_energy() {
    let mut random = Random::new(62);
    for n in [2, 3] {
        for (place, energy) in energies(&mut random, n).into_iter().enumerate() {
            // The dilatation and the Casimirs meet in few of them.
            let always = energy.contains("casimir3").then_some(Forces::Separable);
            let forces = in_turn(n, place).filter(|forces| forces.act_on(&energy));
            for forces in always.into_iter().chain(forces) {
                let ways = (0..12).find_map(|_| {
                    let drawn = Drawn::stated(&mut random, n, &energy, forces);
                    every_way(&mut random, &drawn)
                });
                assert!(ways.is_some(), "{forces:?} for {energy}");
            }
        }
    }
}

/// The programs of the reduction that is chosen, of sums of energies of different frames too.
#[test]
fn programs() {
    let mut random = Random::new(63);
    for n in [2, 3] {
        let families =
            ["casimir2 = 1/5, body_inertia = 1", "casimir2 = 1/5", "dalembert = 2", "space_inertia = 3"];
        let translations = ["", ", body_translation = 1", ", space_translation = 2"];
        let each = families.iter().flat_map(|family| translations.map(|t| format!("kinetic({family}{t})")));
        let energies = SUMS.iter().map(|sum| (*sum).to_owned()).chain(each);
        for (place, energy) in energies.enumerate() {
            let forces =
                in_turn(n, place).filter(|forces| forces.act_on(&energy) && !forces.call_the_runtime());
            for forces in forces {
                let accepted = (0..12).find_map(|_| {
                    let drawn = Drawn::stated(&mut random, n, &energy, forces);
                    Some((accepted(&drawn)?, drawn.args))
                });
                let (form, args) = accepted.unwrap_or_else(|| panic!("{forces:?} for {energy}"));
                let model = without_fault(&args, || derive(form, false).expect("a derivation"));
                programs::check(&mut random, &args, &model);
            }
        }
    }
}

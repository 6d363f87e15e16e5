//! What goes together: every part beside every other, held against the table, and the table in the documentation.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_codegen::check::{Part, Refusal, refusals, table};
use affine_codegen::model;
use affine_codegen::spec::{Capability, Named};
use proc_macro2::TokenStream;

/// Keys of a model in the plane, and the parts that they make of it.
#[derive(Clone, Copy)]
struct Stated(&'static str, &'static [Part]);

/// Kinetic energies that rotations of space and body leave alone, so that a lattice is refused by the table or not at all.
const ENERGIES: [Stated; 7] = [
    Stated("kinetic(casimir2 = 0.2, body_inertia = 1)", &[Part::AffineVelocities]),
    Stated("kinetic(casimir2 = 0.2, space_inertia = 1)", &[Part::AffineVelocities]),
    Stated("kinetic(dalembert = 1)", &[Part::PhiDot]),
    Stated("kinetic(dalembert = 1, body_inertia = 1)", &[Part::Sum, Part::PhiDot]),
    Stated("kinetic(dalembert = 1, space_inertia = 1, casimir2 = 0.1)", &[Part::Sum, Part::PhiDot]),
    Stated("hamiltonian(casimir2 = 1, vorticity_squared = 2)", &[Part::AffineVelocities]),
    Stated("hamiltonian(casimir2 = 1, casimir3 = 0.1)", &[Part::AffineVelocities, Part::Casimir3]),
];

const FEATURES: [Stated; 14] = [
    Stated("", &[Part::Free]),
    Stated("potential = tr(G)", &[Part::Energy]),
    Stated("potential = tr(G)*cos(t)", &[Part::Energy, Part::OnTime]),
    Stated("potential = pairs(d^4)", &[Part::Energy, Part::OnStretches]),
    Stated("potential = custom(f, isotropic)", &[Part::FieldPotential]),
    Stated("potential = self_gravity(2)", &[Part::SelfGravity]),
    Stated("constraint = isochoric", &[Part::Free, Part::Confined]),
    Stated("constraint = conformal", &[Part::Free, Part::Confined, Part::Similar]),
    Stated("constraint = rigid", &[Part::Free, Part::Confined, Part::Similar]),
    Stated("metrics(space = 2, body = 3), potential = q^2", &[Part::Energy, Part::Metrics]),
    Stated("dissipation(casimir1_squared = 1), potential = q^2", &[Part::Energy, Part::Friction]),
    Stated("forces = custom(f, spatial), potential = q^2", &[Part::Energy, Part::Force]),
    Stated("forces = custom(f, spatial, gyroscopic), potential = q^2", &[Part::Energy, Part::Force]),
    Stated("forces = custom(f, comoving, position), potential = q^2", &[Part::Energy, Part::Kick]),
];

/// The centre of mass, where it is free.
const CENTRES: [Stated; 3] = [
    Stated("", &[]),
    Stated("space_translation = 2", &[]),
    Stated("body_translation = 2", &[Part::BodyTranslation]),
];

/// The parts that follow from others together.
fn with_pairs(mut parts: Vec<Part>, keys: &str) -> Vec<Part> {
    // Velocities of rotations are one and the same in both frames, up to a rotation.
    if keys.contains("rigid") {
        parts.retain(|part| *part != Part::Sum);
    }
    let has = |part: Part, parts: &[Part]| parts.contains(&part);
    let dalembert = has(Part::PhiDot, &parts) && !has(Part::Sum, &parts);
    if keys.contains("isochoric") && dalembert {
        parts.push(Part::Sum);
    }
    if keys.contains("conformal") && dalembert {
        parts.push(Part::Weight);
    }
    parts
}

/// What an expansion says: nothing, or the short names of its mistakes and its text.
fn said(keys: &str) -> Option<(Vec<&'static str>, String)> {
    let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
    let field = if keys.contains("custom") { "struct M { f: F }" } else { "struct M;" };
    let rejected = model(tokens(keys), tokens(field)).err()?;
    let names = rejected.diagnostics().map(|diagnostic| diagnostic.name()).collect();
    Some((names, rejected.diagnostics().map(|diagnostic| format!("{diagnostic}\n")).collect()))
}

/// An expansion is refused by the table exactly if two of its parts stand in it.
fn assert_as_the_table(keys: &str, parts: &[Part]) {
    let pairs = refusals().filter(|refusal| parts.contains(&refusal.part) && parts.contains(&refusal.beside));
    // What a potential depends on is seen where nothing is wrong before.
    let late = [Part::OnTime, Part::OnStretches, Part::OnCentre];
    let (late, early): (Vec<Refusal>, Vec<Refusal>) = pairs.partition(|pair| late.contains(&pair.beside));
    let first = if early.is_empty() { late } else { early };
    let reasons: Vec<&str> = first.iter().map(|refusal| refusal.why).collect();
    let (names, text) = said(keys).unwrap_or_default();
    let by_the_table = names.iter().filter(|name| **name == "beside").count();
    assert_eq!(by_the_table > 0, !reasons.is_empty(), "{keys}: {parts:?}\n{reasons:#?}\n{text}");
    for reason in &reasons {
        assert!(text.contains(reason), "{keys}: not said: {reason}\n{text}");
    }
    // What else may be wrong is no matter of pairs.
    let known = ["beside", "acceleration", "fixed-centre", "ratios-alone", "vanishing-term"];
    assert!(names.iter().all(|name| known.contains(name)), "{keys}: {names:?}\n{text}");
}

/// Every energy with every feature and everything that can be emitted.
#[test]
fn every_pair_as_the_table_says() {
    let mut tried = 0;
    for Stated(energy, of_energy) in ENERGIES {
        for Stated(feature, of_feature) in FEATURES {
            for capability in Capability::ALL.iter().copied() {
                let asked = match capability {
                    Capability::Ratios => "two_polar, ratios",
                    other => other.name(),
                };
                let keys =
                    [energy, feature].iter().filter(|key| !key.is_empty()).copied().collect::<Vec<_>>();
                // These are for n = 3 alone.
                let in_space = energy.contains("casimir3") || feature.contains("self_gravity");
                let n = if in_space { 3 } else { 2 };
                let keys = format!("dim = {n}, {}, emit({asked})", keys.join(", "));
                let mut parts = [of_energy, of_feature, &[Part::Emitted(capability)][..]].concat();
                if capability == Capability::Ratios {
                    parts.push(Part::Emitted(Capability::TwoPolar));
                }
                assert_as_the_table(&keys, &with_pairs(parts, &keys));
                tried += 1;
            }
        }
    }
    assert_eq!(tried, 7 * 14 * 10);
}

/// A free centre of mass, and a potential of its position.
#[test]
fn every_centre_as_the_table_says() {
    for Stated(centre, of_centre) in &CENTRES[1..] {
        for (potential, of_potential) in [("", Part::Free), ("potential = x[1]^2,", Part::OnCentre)] {
            for capability in Capability::ALL.iter().copied().filter(|c| *c != Capability::Ratios) {
                let keys = format!(
                    "dim = 2, kinetic(dalembert = 1, {centre}), {potential} emit({})",
                    capability.name()
                );
                let mut parts =
                    [&[Part::PhiDot, of_potential, Part::Emitted(capability)], *of_centre].concat();
                if of_potential == Part::OnCentre {
                    parts.push(Part::Energy);
                }
                // The translation of the body beside `phi_dot` is inverted apart: no sum.
                assert_as_the_table(&keys, &with_pairs(parts, &keys));
            }
        }
    }
}

/// The page of the attribute has the table.
#[test]
fn the_table_is_documented() {
    let page = include_str!("../../src/lib.rs");
    let documented: String =
        page.lines().filter_map(|line| line.strip_prefix("/// ")).map(|line| format!("{line}\n")).collect();
    assert!(documented.contains(&table()), "the page of the attribute should have:\n{}", table());
}

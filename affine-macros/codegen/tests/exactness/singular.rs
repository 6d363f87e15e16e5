//! Singular sets are exact: what vanishes in rational numbers is refused, and nothing beside it.

use affine_codegen::diagnostics::{Diagnostic, FormMistake, TermMistake};

use super::models::form;

const ITEM: &str = "struct Model { a: f64, b: f64 }";

fn refused(args: &str) -> Vec<String> {
    match form(args, ITEM) {
        Ok(_) => Vec::new(),
        Err(refusal) => refusal
            .diagnostics()
            .map(|mistake| match mistake {
                Diagnostic::Form(FormMistake::Degenerate { eigenvalue, .. }) => eigenvalue.clone(),
                Diagnostic::Form(FormMistake::DegenerateTensor { .. }) => "tensor".to_owned(),
                Diagnostic::Term(TermMistake::ZeroMass { .. }) => "mass".to_owned(),
                Diagnostic::Term(TermMistake::InertiaNotPositive { .. }) => "J".to_owned(),
                Diagnostic::Form(FormMistake::NotPositiveDefinite { .. }) => "definite".to_owned(),
                Diagnostic::Form(FormMistake::NoKineticEnergy) => "none".to_owned(),
                other => panic!("{args}: {other}"),
            })
            .collect(),
    }
}

/// In doubles `0.1 + 0.2 - 0.3` is 5.6e-17 and `1.2 - 3*0.4` is 2.2e-16; here both are zero.
#[test]
fn exactly_zero_eigenvalues() {
    let cases: &[(&str, &[&str])] = &[
        ("dim = 3, kinetic(casimir2 = 0.1 + 0.2, body_inertia = -0.3, casimir1_squared = 1)", &["I + A"]),
        ("dim = 3, kinetic(casimir2 = 0.1 + 0.2, body_inertia = -0.3)", &["I + A", "I + A + n B"]),
        ("dim = 2, kinetic(casimir2 = 0.1 + 0.2, space_inertia = 0.3)", &["I - A"]),
        ("dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1, casimir1_squared = -0.4)", &["I + A + n B"]),
        ("dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, casimir1_squared = -0.4)", &[]),
        ("dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, casimir1_squared = -0.6)", &["I + A + n B"]),
        ("dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1, casimir1_squared = -0.6)", &[]),
        ("dim = 3, kinetic(casimir2 = 1/3 + 1/3 + 1/3, body_inertia = 1)", &["I - A"]),
        ("dim = 3, kinetic(casimir2 = a, body_inertia = -a)", &["I + A", "I + A + n B"]),
        ("dim = 3, kinetic(casimir2 = a + b, body_inertia = b + a)", &["I - A"]),
        ("dim = 3, kinetic(casimir2 = a + b, body_inertia = b - a)", &[]),
        (
            "dim = 3, kinetic(casimir2 = (a + b)^2 - a^2 - b^2, body_inertia = -2*a*b, casimir1_squared = 1)",
            &["I + A"],
        ),
        ("dim = 2, kinetic(casimir2 = 1, body_translation = 0.1 + 0.2 - 0.3)", &["mass"]),
        ("dim = 2, kinetic(casimir2 = 1, body_translation = 0.1 + 0.2 - 0.30000000000000001)", &[]),
        ("dim = 2, kinetic(dalembert = [[0.1, 0.3], [0.3, 0.9]])", &["J"]),
        ("dim = 2, kinetic(dalembert = [[0.1, 0.3], [0.3, 0.90000000000000002]])", &[]),
        ("dim = 2, kinetic(dalembert = 0.1 + 0.2 - 0.3)", &["J"]),
    ];
    for (args, expected) in cases {
        let mut found = refused(args);
        let mut expected: Vec<String> = expected.iter().map(|e| (*e).to_owned()).collect();
        found.sort();
        expected.sort();
        assert_eq!(found, expected, "{args}");
    }
}

/// One unit in the last written digit to either side: another number, and a model.
#[test]
fn neighbours_are_accepted() {
    for digits in [2, 17, 30, 300] {
        for sign in ["+", "-"] {
            for (terms, singular) in [
                ("casimir2 = 0.1 + 0.2, casimir1_squared = 5, body_inertia = -0.3", "I + A"),
                ("casimir2 = 0.1 + 0.2, casimir1_squared = 5, space_inertia = 0.3", "I - A"),
                ("casimir2 = 0.1 + 0.2, casimir1_squared = -0.4, body_inertia = 0.9", "I + A + n B"),
            ] {
                let args = format!("dim = 3, kinetic({terms})");
                assert_eq!(refused(&args), [singular]);
                let beside = format!("dim = 3, kinetic({terms} {sign} 1e-{digits})");
                assert_eq!(refused(&beside), [""; 0], "{beside}");
            }
        }
    }
}

/// `K` with the kernel `(1, 1, 1, 1)`, by a sum that only exact arithmetic sees vanish.
#[test]
fn tensors_are_degenerate_exactly() {
    let tensor = |corner: &str| {
        format!(
            "dim = 2, kinetic(body_tensor = [[{corner}, -0.1, -0.2, 0], [-0.1, 0.2, 0, -0.1], [-0.2, 0, 0.5, -0.3], [0, -0.1, -0.3, 0.4]])"
        )
    };
    assert_eq!(refused(&tensor("0.3")), ["tensor"]);
    assert_eq!(refused(&tensor("0.30000000000000004")), [""; 0]);
    assert_eq!(refused(&tensor("0.29999999999999998")), [""; 0]);
}

/// The border between definite and indefinite is the singular set: refused on it, told apart beside it.
#[test]
fn definiteness_changes_across_the_singular_set() {
    let model = |inertia: &str| {
        format!(
            "dim = 3, require(positive_definite), kinetic(casimir2 = 0.1 + 0.2, casimir1_squared = 1, body_inertia = {inertia})"
        )
    };
    assert_eq!(refused(&model("0.3")), ["I - A"]);
    assert_eq!(refused(&model("0.3 + 1e-30")), [""; 0]);
    assert_eq!(refused(&model("0.3 - 1e-30")), ["definite"]);
}

//! Numbers that no double holds: refused where they are made, whatever makes them; what is accepted loses no term.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_codegen::derive::{Model, derive};
use affine_codegen::diagnostics::gate;
use affine_codegen::symbol::{Aspect, Quantity, Symbol};
use affine_codegen::{check, expand, model, spec};
use num_bigint::BigInt;
use proc_macro2::{TokenStream, TokenTree};
use proptest::prelude::*;

const FIELDS: &str = "struct Model { a: f64, k: f64 }";

/// Is the model refused, for the size of its numbers? The expansion is looked at in any case.
fn refused(args: &str, item: &str) -> bool {
    let expansion = expand(args.parse().expect(args), item.parse().expect(item));
    let text = expansion.to_string();
    if text.contains("compile_error") {
        assert!(text.contains("[value-range]"), "{args}: {text}");
        return true;
    }
    every_number(expansion, false, &mut |literal, is_rest| {
        let digits = literal.trim_end_matches("f64");
        let value: f64 = digits.parse().expect(literal);
        let held = if is_rest { value.is_finite() } else { value.is_normal() || digits == "0.0" };
        assert!(held, "{args}: {literal}");
    });
    false
}

/// The floating-point literals of an expansion, those in strings left out, and whether they are what rounding left over of
/// a number before, which may be as small as it is.
fn every_number(tokens: TokenStream, of_one_number: bool, visit: &mut impl FnMut(&str, bool)) {
    let (mut name, mut seen) = (String::new(), 0);
    for token in tokens {
        match token {
            TokenTree::Group(group) => {
                let parts = name == "constant" || name == "with_reciprocal";
                every_number(group.stream(), parts, visit);
            }
            TokenTree::Ident(ident) => {
                name = ident.to_string();
                continue;
            }
            TokenTree::Literal(literal) => {
                let text = literal.to_string();
                let number = text.starts_with(|c: char| c.is_ascii_digit());
                if number && (text.contains(['.', 'e']) || text.ends_with("f64")) {
                    visit(&text, of_one_number && seen > 0);
                    seen += 1;
                }
            }
            TokenTree::Punct(_) => {}
        }
        name.clear();
    }
}

#[test]
fn what_doubles_cannot_hold_is_refused() {
    let kinetic = "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1)";
    for args in [
        format!("{kinetic}, potential = 1e-200*1e-200*q^2"),
        format!("{kinetic}, potential = 1e200*1e200*q^2"),
        format!("{kinetic}, potential = 1e200*q*q*1e200"),
        format!("{kinetic}, potential = a*q^2/1e200/1e200"),
        format!("{kinetic}, potential = sin(1e-200*q*1e-200)"),
        format!("{kinetic}, potential = (1e200)^2*q^2 + q^4"),
        // Not a normal number, and a slope that is no number.
        format!("{kinetic}, potential = 1e-308*q^2"),
        format!("{kinetic}, potential = 1e308*q^2"),
        "dim = 2, kinetic(casimir2 = 0.2, body_inertia = diag(1, 1e-300*1e-12*a + 1))".to_owned(),
        "dim = 2, kinetic(casimir2 = 0.2, body_inertia = a/(1e-300*(k + 3)/7e24 + 1))".to_owned(),
        "dim = 3, kinetic(body_inertia = 1, casimir2 = 1e-200*1e-200*a)".to_owned(),
        "dim = 3, kinetic(dalembert = 1e-200*1e-150)".to_owned(),
        "dim = 2, kinetic(dalembert = 1), metrics(space = diag(1, 1e-300*1e-300*1e-200))".to_owned(),
        "dim = 2, hamiltonian(casimir2 = 1e200*1e200, vorticity_squared = 1)".to_owned(),
        "dim = 2, kinetic(dalembert = 1), dissipation(dalembert = 1e-200/1e200)".to_owned(),
        "dim = 2, kinetic(dalembert = diag(1, 2), space_inertia = 1e-200*1e-200)".to_owned(),
    ] {
        assert!(refused(&args, FIELDS), "accepted: {args}");
    }
}

#[test]
fn what_doubles_hold_is_accepted() {
    let kinetic = "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1)";
    for args in [
        format!("{kinetic}, potential = 1e-200*1e-200*1e300*q^2"),
        format!("{kinetic}, potential = 1e200*1e200*q^2*1e-300"),
        format!("{kinetic}, potential = 1e-300*q^2 + 1e300*q^4"),
        format!("{kinetic}, potential = 0*1e200*1e200*q^4 + q^2"),
        format!("{kinetic}, potential = a*q^2/1e200"),
        "dim = 2, kinetic(dalembert = 1e-300)".to_owned(),
        "dim = 2, kinetic(casimir2 = 1e-300*a)".to_owned(),
    ] {
        assert!(!refused(&args, FIELDS), "refused: {args}");
    }
}

/// A quotient of numbers that are beyond, in the one capability that takes numerators and denominators apart.
#[test]
fn a_number_may_have_parts_beyond() {
    let [above, below] = [(2, 1030), (3, 650)].map(|(base, power)| BigInt::from(base).pow(power));
    let args = format!("dim = 2, kinetic(dalembert = 1), emit(taylor), potential = {above}/{below}*tr(G)^2");
    assert!(!refused(&args, FIELDS));
}

/// A multiple of `q` that no one writes out as a product has an answer too, and a short one.
#[test]
fn high_multiples_of_logarithms_stay_in_their_functions() {
    for multiple in ["1e7", "-1e7", "1e9", "1e30", "33"] {
        for potential in ["exp(k*q)*sin(q)", "sinh(k*q)", "sinh(k*q)^7"] {
            let potential = potential.replace('k', multiple);
            let args = format!("dim = 2, kinetic(casimir2 = 1, body_inertia = 2), potential = {potential}");
            let model = derived(&args);
            assert!(
                model.dynamics.full.program.steps.len() < 200,
                "{args}: {}",
                model.dynamics.full.program.steps.len()
            );
        }
        for potential in ["exp(k*q1)+exp(k*q2)", "exp(k*q1)+exp(k*q2)-q1*q2", "(exp(k*q1)+exp(k*q2))^2"] {
            let potential = potential.replace('k', multiple);
            let args = format!(
                "dim = 2, kinetic(casimir2 = 1, body_inertia = 2), emit(two_polar), potential = {potential}"
            );
            let model = derived(&args);
            assert!(
                model.dynamics.full.program.steps.len() < 200,
                "{args}: {}",
                model.dynamics.full.program.steps.len()
            );
        }
    }
}

/// A product of powers of ten: its text, and the exponent of its value, counted by adding.
fn power_of_ten(factors: std::ops::Range<usize>) -> impl Strategy<Value = (String, i32)> {
    let size = prop::sample::select(vec![200, -200, 150, -150, 100, -100, 30, -30, 7, 0]);
    prop::collection::vec((size, any::<bool>(), any::<bool>()), factors).prop_map(|factors| {
        let mut text = "1".to_owned();
        let mut exponent = 0;
        for (size, below, squared) in factors {
            text += if below { "/" } else { "*" };
            text += &if squared { format!("(1e{size})^2") } else { format!("1e{size}") };
            exponent += if below { -size } else { size } * if squared { 2 } else { 1 };
        }
        (text, exponent)
    })
}

/// Exponents whose powers of ten are doubles, with room for what small factors a derivation multiplies them by.
const SAFE: std::ops::RangeInclusive<i32> = -290..=290;

/// Something that holds such numbers, anywhere in a specification.
fn any_specification() -> impl Strategy<Value = String> {
    let energies = vec![
        "dim = 3, kinetic(body_inertia = A*a, casimir2 = B, body_translation = C)",
        "dim = 2, kinetic(body_inertia = diag(1, A*a + 1), casimir2 = B*a)",
        "dim = 2, kinetic(body_inertia = a/(A*(k + 3)/(B) + 1))",
        "dim = 2, kinetic(dalembert = [[A, 0], [0, B]], space_translation = C)",
        "dim = 2, kinetic(dalembert = A, space_inertia = B)",
        "dim = 2, kinetic(space_tensor = [[A, 0, 0, 0], [0, B, 0, 0], [0, 0, C, 1], [0, 0, 1, A*k]])",
        "dim = 3, hamiltonian(casimir2 = A, vorticity_squared = B*a, body_translation = C)",
        "dim = 2, kinetic(casimir2 = 1, space_translation = 1), metrics(space = diag(A, B), body = C)",
        "dim = 2, kinetic(dalembert = 1), dissipation(dalembert = A, casimir1_squared = B*a)",
        "dim = 2, kinetic(casimir2 = 1), potential = (A*a*q + B*k)^2/(C + tr(G))",
        "dim = 2, kinetic(casimir2 = 1, body_translation = A), potential = exp(B*q)*sin(C*x[1]*t)",
        "dim = 2, kinetic(casimir2 = 1), emit(two_polar, taylor), potential = A*q1*q2 + pairs(B*d^2)",
        "dim = 2, kinetic(casimir2 = 1, body_inertia = [[A, 0], [0, B]]), emit(splitting), potential = C*q^2",
    ];
    (prop::sample::select(energies), power_of_ten(1..3), power_of_ten(0..3), power_of_ten(0..3)).prop_map(
        |(energy, (a, _), (b, _), (c, _))| energy.replace('A', &a).replace('B', &b).replace('C', &c),
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// Never a panic, and no number that is not one; other refusals may come first.
    #[test]
    fn any_extreme_specification_has_an_answer(args in any_specification()) {
        let expansion = expand(args.parse().expect("arguments"), FIELDS.parse().expect("an item"));
        if !expansion.to_string().contains("compile_error") {
            prop_assert!(!refused(&args, FIELDS));
        }
    }

    /// `U = sum of c_i x_i^2`: refused where a `c_i` is out of range, else energy and force of each term are what they are,
    /// where the others are zero.
    #[test]
    fn no_term_is_lost(terms in prop::collection::vec(power_of_ten(1..4), 2)) {
        let sum: Vec<String> =
            terms.iter().enumerate().map(|(i, (text, _))| format!("{text}*x[{}]^2", i + 1)).collect();
        let args =
            format!("dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = {}", sum.join(" + "));
        let safe = terms.iter().all(|(_, exponent)| SAFE.contains(exponent));
        let beyond = terms.iter().any(|(_, exponent)| !(-310..=310).contains(exponent));
        let answer = refused(&args, "struct Model;");
        prop_assert!(!safe || !answer, "refused: {}", args);
        prop_assert!(!beyond || answer, "accepted: {}", args);
        if answer {
            return Ok(());
        }
        let model = derived(&args);
        for (i, (_, exponent)) in terms.iter().enumerate() {
            // c x^2 = 1 up to the square root of ten.
            let x = format!("1e{}", -exponent.div_euclid(2)).parse::<f64>().expect("a number");
            let expected = format!("1e{}", exponent.rem_euclid(2)).parse::<f64>().expect("a number");
            let at = |symbol: &Symbol| match symbol {
                Symbol::Component(Quantity::Placement, entry) if entry[0] == entry[1] => Some(1.0),
                other => Some(if *other == Quantity::Position.at([i + 1]) { x } else { 0.0 }),
            };
            let energy = model.point.hamiltonian.run::<f64>(&at).expect("an energy")[0];
            prop_assert!((energy - expected).abs() < 1e-12 * expected, "{}: U = {}", args, energy);
            let rates = model.dynamics.full.program.run::<f64>(&at).expect("rates");
            let wanted = Quantity::LinearMomentum.at([i + 1]).seen(Aspect::Rate);
            let place = model.dynamics.full.program.results().position(|name| *name == wanted);
            let force = rates[place.expect("a force")] * x;
            prop_assert!((force + 2.0 * expected).abs() < 1e-12 * expected, "{}: x f = {}", args, force);
        }
    }
}

#[test]
fn extreme_specifications_have_either_answer() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let accepted = (0..60)
        .filter(|_| {
            let args = any_specification().new_tree(&mut runner).expect("a tree").current();
            model(args.parse().expect("arguments"), FIELDS.parse().expect("an item")).is_ok()
        })
        .count();
    assert!((10..50).contains(&accepted), "{accepted} of 60 are accepted: the test tests little");
}

fn derived(args: &str) -> Model {
    let spec =
        gate(|found| spec::parse(args.parse().unwrap(), "struct Model;".parse().unwrap(), found)).unwrap();
    gate(|found| check::as_written(&spec, found)).unwrap();
    derive(gate(|found| check::energy(&spec, found)).unwrap(), false).expect("a model")
}

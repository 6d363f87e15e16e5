//! Whatever the tokens: an answer, never a panic or a fault of the macro.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_codegen::{expand, model};
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use proptest::prelude::*;

/// Words of the language, and words that are not.
const WORDS: &[&str] = &[
    "dim",
    "symmetry",
    "kinetic",
    "require",
    "emit",
    "crate",
    "space",
    "body",
    "affine",
    "metric",
    "none",
    "casimir2",
    "casimir1_squared",
    "body_inertia",
    "space_inertia",
    "body_translation",
    "space_translation",
    "dalembert",
    "constraint",
    "isochoric",
    "rigid",
    "conformal",
    "body_tensor",
    "space_tensor",
    "diag",
    "positive_definite",
    "splitting",
    "potential",
    "casimir3",
    "q",
    "x",
    "G",
    "tr",
    "norm",
    "pairs",
    "custom",
    "sinh",
    "gas",
    "n",
    "a",
    "b",
    "m",
    "self",
    "r#type",
    "_",
    "struct",
    "enum",
    "pub",
    "f64",
    "where",
    "0",
    "1",
    "2",
    "3",
    "4",
    "0.2",
    "1e-3",
    "1e308",
    "1e400",
    "0.2f64",
    "2a",
    "0x10",
    "1_000.5",
    "\"text\"",
    "'c'",
    "b\"x\"",
    "1.",
    "'a",
    "=",
    ",",
    "+",
    "-",
    "*",
    "/",
    "^",
    "**",
    "::",
    ".",
    ";",
    "<",
    ">",
    "#",
    "!",
    "?",
    "=>",
    "$",
];

fn any_tokens() -> impl Strategy<Value = TokenStream> {
    let word = prop::sample::select(WORDS).prop_map(|word| word.parse::<TokenStream>().expect(word));
    word.prop_recursive(5, 80, 8, |inner| {
        let delimiters = vec![Delimiter::Parenthesis, Delimiter::Bracket, Delimiter::Brace, Delimiter::None];
        (prop::sample::select(delimiters), prop::collection::vec(inner, 0..8)).prop_map(
            |(delimiter, parts)| TokenTree::Group(Group::new(delimiter, parts.into_iter().collect())).into(),
        )
    })
}

fn any_stream() -> impl Strategy<Value = TokenStream> {
    prop::collection::vec(any_tokens(), 0..20).prop_map(|parts| parts.into_iter().collect())
}

/// Something like a value: short, and often well-formed.
fn any_value() -> impl Strategy<Value = String> {
    let good = prop::sample::select(vec!["0", "1", "-1", "a", "n", "1/3", "2*a^2"]);
    let bad = prop::sample::select(vec!["a/0", "2^a", "b", "m", "3^99", "f(a)"]);
    let entry = prop_oneof![9 => good, 1 => bad];
    let row = prop::collection::vec(entry.clone(), 0..5).prop_map(|entries| entries.join(","));
    let matrix =
        prop::collection::vec(row.clone(), 0..5).prop_map(|rows| format!("[[{}]]", rows.join("],[")));
    prop_oneof![4 => entry.prop_map(str::to_owned), 1 => row.prop_map(|row| format!("diag({row})")), 1 => matrix]
}

fn any_specification() -> impl Strategy<Value = String> {
    let terms = vec![
        "casimir2",
        "casimir1_squared",
        "body_inertia",
        "space_inertia",
        "body_translation",
        "space_translation",
        "dalembert",
        "body_tensor",
        "space_tensor",
        "casimir",
        "casimir3",
    ];
    let term =
        (prop::sample::select(terms), any_value()).prop_map(|(term, value)| format!("{term} = {value}"));
    let kinetic = prop::collection::vec(term, 1..4).prop_map(|terms| format!("kinetic({})", terms.join(",")));
    let dim =
        prop::sample::select(vec!["dim = 2", "dim = 3", "dim = 2, require(positive_definite)", "dim = 0"]);
    let other = prop::sample::select(vec![
        "dim = 2",
        "dim = 18446744073709551615",
        "dim",
        "symmetry()",
        "symmetry(space = affine, body = affine)",
        "emit(taylor)",
        "require(positive_definite)",
        "dimm = 2",
    ]);
    (dim, kinetic, prop::option::weighted(0.3, other))
        .prop_map(|(dim, kinetic, other)| format!("{dim}, {kinetic}, {}", other.unwrap_or_default()))
}

fn answered(args: TokenStream, item: TokenStream) -> Result<bool, TestCaseError> {
    let expansion = expand(args.clone(), item.clone()).to_string();
    let Some(rejected) = model(args, item.clone()).err() else {
        prop_assert!(!expansion.contains("compile_error"));
        return Ok(true);
    };
    let messages: Vec<String> = rejected.diagnostics().map(ToString::to_string).collect();
    prop_assert!(!messages.is_empty());
    prop_assert!(rejected.diagnostics().all(|mistake| mistake.name() != "impossible"), "{:?}", messages);
    for message in &messages {
        prop_assert_eq!(message.lines().count(), 3, "{}", message);
    }
    prop_assert!(expansion.starts_with(&item.to_string()));
    prop_assert_eq!(rejected.compile_errors().into_iter().count(), 8 * messages.len());
    Ok(false)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn on_any_arguments(args in any_stream()) {
        answered(args, "struct Model { a: f64, m: [[f64; 2]; 2] }".parse().expect("an item"))?;
    }

    #[test]
    fn on_any_expression(tokens in any_stream()) {
        let args = quote::quote!(dim = 3, kinetic(body_inertia = #tokens));
        answered(args, "struct Model { a: f64, m: [[f64; 2]; 2] }".parse().expect("an item"))?;
    }

    #[test]
    fn on_any_potential(tokens in any_stream()) {
        let args = quote::quote!(dim = 3, kinetic(casimir2 = 1, body_translation = a), potential = #tokens);
        answered(args, "struct Model { a: f64, m: [[f64; 2]; 2] }".parse().expect("an item"))?;
    }

    #[test]
    fn on_any_item(item in any_stream()) {
        answered("dim = 3, kinetic(casimir2 = a)".parse().expect("arguments"), item)?;
    }

    #[test]
    fn on_near_misses(args in any_specification()) {
        let item = "struct Model { a: f64, m: [[f64; 2]; 2] }".parse().expect("an item");
        answered(args.parse().expect("arguments"), item)?;
    }
}

#[test]
fn the_near_misses_include_good_models() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let accepted = (0..1000)
        .filter(|_| {
            let args = any_specification().new_tree(&mut runner).expect("a tree").current();
            let item = "struct Model { a: f64 }".parse().expect("an item");
            model(args.parse().expect("arguments"), item).is_ok()
        })
        .count();
    assert!(accepted > 40, "only {accepted} of 1000 are accepted: the generator tests little");
}

/// What the rules on degrees alone let through would be multiplied out for hours: six to twelve variables to high powers.
#[test]
fn no_specification_stalls_a_build() {
    let sum = "(G[1,1] + G[1,2] + G[1,3] + G[2,2] + G[2,3] + G[3,3] + x[1])";
    let potentials = [
        format!("{sum}^16"),
        format!("({sum}^8)^8"),
        format!("1/{sum}^16"),
        format!("exp({sum}^16)"),
        format!("{sum}*{sum}*{sum}*{sum}*{sum}"),
        // Functions that are undone.
        format!("(abs({sum}^4)^2 + x[1])^2"),
        format!("(sqrt({sum}^2 + 1)^8 + x[2])^2"),
        format!("(ln(exp({sum}^3)) + exp(ln({sum}^3)))^4"),
        format!("(1/(1/{sum}^3) + ({sum}^-3)^-1)^4"),
        "tr(G*Ct*phi*G*Ct*phi*G*Ct*phi*G*Ct*phi*G*Ct*phi*G*Ct*phi)".to_owned(),
        "tr((G*Ct + phi)^16*(Ct*G - phi)^8*(G + Ct)^2)".to_owned(),
        "pairs((exp(d) + exp(-d) + d + sin(d) + cos(d) + sinh(d) + cosh(d))^16)".to_owned(),
    ];
    let mut arguments: Vec<String> = potentials
        .iter()
        .map(|potential| {
            format!("dim = 3, kinetic(casimir2 = 1, body_translation = 1), potential = {potential}")
        })
        .collect();
    arguments.push("dim = 3, kinetic(casimir2 = (a + b + c + d + e + f + g + h)^16)".to_owned());
    let fields = "a: f64, b: f64, c: f64, d: f64, e: f64, f: f64, g: f64, h: f64";
    for args in arguments {
        let item: TokenStream = format!("struct Model {{ {fields} }}").parse().expect("an item");
        let start = std::time::Instant::now();
        assert!(answered(args.parse().expect("arguments"), item).is_ok(), "{args}");
        // Unoptimised, on a machine that does other things: seconds, where it would be hours.
        assert!(start.elapsed().as_secs() < 60, "{args}: {:?}", start.elapsed());
    }
}

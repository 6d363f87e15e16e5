//! Every message in full: `messages.txt` has, for each case, the attribute, the struct, and for each mistake the
//! tokens that the message underlines and its text.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;

use affine_codegen::diagnostics::{Diagnostic, Rejected};
use affine_codegen::model;
use proc_macro2::{Span, TokenStream, TokenTree};

const TABLE: &str = include_str!("messages.txt");

struct Case {
    args: String,
    item: String,
    expected: String,
}

/// Cases are separated by blank lines; the first two lines are `spec:` and `item:`.
fn cases() -> Vec<Case> {
    let case = |block: &str| {
        let (args, rest) = block.trim().split_once('\n').expect("a line for the attribute");
        let (item, expected) = rest.split_once('\n').expect("a line for the item");
        Case {
            args: args.strip_prefix("spec: ").expect("spec:").to_owned(),
            item: item.strip_prefix("item: ").expect("item:").to_owned(),
            expected: expected.to_owned(),
        }
    };
    TABLE.split("\n\n").filter(|block| !block.trim().is_empty()).map(case).collect()
}

fn refusal(args: &str, item: &str) -> Rejected {
    let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
    model(tokens(args), tokens(item)).err().unwrap_or_else(|| panic!("accepted: {args}"))
}

/// What the compiler would underline: from the first to the last token of each `compile_error!`.
fn underlined(rejected: &Rejected) -> Vec<String> {
    let tokens: Vec<TokenTree> = rejected.compile_errors().into_iter().collect();
    let text = |error: &[TokenTree]| {
        let (first, last) = (error.first()?.span(), error.last()?.span());
        // Fragments without a source, and the place of the attribute itself.
        let whole: Option<Span> = first.join(last);
        whole.and_then(|span| span.source_text()).filter(|text| !text.is_empty())
    };
    tokens.chunks(8).map(|error| text(error).unwrap_or_else(|| "#[affine_model]".to_owned())).collect()
}

#[test]
fn every_message_reads_as_reviewed() {
    let mut wrong = String::new();
    for Case { args, item, expected } in cases() {
        let rejected = refusal(&args, &item);
        let actual: Vec<String> = underlined(&rejected)
            .into_iter()
            .zip(rejected.diagnostics())
            .map(|(at, diagnostic)| format!("at: {at}\n{diagnostic}"))
            .collect();
        let actual = actual.join("\n");
        if actual.trim() != expected.trim() {
            wrong += &format!("spec: {args}\nitem: {item}\n{actual}\n\n");
        }
    }
    assert!(wrong.is_empty(), "these cases now read:\n\n{wrong}");
}

#[test]
fn every_mistake_has_a_reviewed_message() {
    let names: BTreeSet<&str> = Diagnostic::names().collect();
    assert_eq!(names.len(), Diagnostic::names().count(), "names are unique");
    let mut reviewed: BTreeSet<&str> = BTreeSet::new();
    for Case { args, item, .. } in cases() {
        reviewed.extend(refusal(&args, &item).diagnostics().map(Diagnostic::name));
    }
    let missing: Vec<&str> = names.into_iter().filter(|name| !reviewed.contains(name)).collect();
    assert!(missing.is_empty(), "no case for {missing:?}");
}

#[test]
fn several_mistakes_arrive_together() {
    let args = "dim = 4, kinetic(casimr2 = 0.2f64, body_inertia = ), emit(fast), emit(taylor)";
    let names: Vec<&str> = refusal(args, "enum M {}").diagnostics().map(Diagnostic::name).collect();
    assert_eq!(names, ["item-kind", "repeated-key", "unknown-key", "expected-value", "unknown-name"]);

    let args = "dim = 3, kinetic(casimir2 = b + c, dalembert = diag(1, 0), space_translation = 1/0)";
    let names: Vec<&str> = refusal(args, "struct M;").diagnostics().map(Diagnostic::name).collect();
    assert_eq!(names, ["unknown-symbol", "unknown-symbol", "matrix-size", "division-by-zero"]);
}

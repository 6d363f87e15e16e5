//! Every message in full: `messages.txt` has, for each case, the attribute, the struct, and for each mistake the
//! tokens that the message underlines and its text.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;

use affine_codegen::algebra::fault::never_missing;
use affine_codegen::diagnostics::{Diagnostic, FaultMistake, Rejected, gate};
use affine_codegen::{model, without_fault};
use proc_macro2::{Span, TokenStream, TokenTree};

const TABLE: &str = include_str!("messages.txt");

struct Case {
    args: String,
    item: String,
    expected: String,
}

/// Cases are separated by blank lines; the first two lines are `spec:` and `item:`. No specification is known that leads to a
/// fault of the macro: in its place stands what was thought to hold.
fn cases() -> Vec<Case> {
    let case = |block: &str| {
        let (args, rest) = block.trim().split_once('\n').expect("a line for the attribute");
        let (item, expected) = rest.split_once('\n').expect("a line for the item");
        Case {
            args: args.strip_prefix("spec: ").unwrap_or(args).to_owned(),
            item: item.strip_prefix("item: ").expect("item:").to_owned(),
            expected: expected.to_owned(),
        }
    };
    TABLE.split("\n\n").filter(|block| !block.trim().is_empty()).map(case).collect()
}

fn refusal(args: &str, item: &str) -> Rejected {
    if let Some(belief) = args.strip_prefix("fault: ") {
        let place = "algebra/rational.rs:1".to_owned();
        let mistake = FaultMistake::Impossible { belief: belief.to_owned().leak(), place };
        return gate::<()>(|found| Err(found.report(Span::call_site(), mistake))).unwrap_err();
    }
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
fn what_messages_advise_is_accepted() {
    let planar = |potential: &str| format!("dim = 2, kinetic(casimir2 = 1, body_inertia = 2), {potential}");
    let potentials = [
        "potential = -exp(1/3*ln(8))*det + exp(2/3*ln(8))*q",
        "potential = tr(phi)/det",
        "potential = ln(q + sqrt(q^2 + 1)) + ln((1 + q)/(1 - q))/2",
        "potential = ln(det + sqrt(det^2 - 1))",
        "emit(two_polar, ratios)",
    ];
    let spatial = [
        "dim = 3, kinetic(dalembert = 1), potential = (tr(phi)^2 - tr(phi^2))/(2*det)",
        "dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1, 0))",
    ];
    let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
    for args in potentials.map(planar).into_iter().chain(spatial.map(str::to_owned)) {
        if let Err(refusal) = model(tokens(&args), tokens("struct M;")) {
            panic!("{args}: {:?}", refusal.diagnostics().map(ToString::to_string).collect::<Vec<_>>());
        }
    }
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

#[test]
fn a_fault_of_the_macro_stops_the_expansion_and_asks_for_a_report() {
    let expansion = without_fault(|| {
        Ok(never_missing(None, "there is a first", 1) + never_missing(Some(2), "not this", 0))
    });
    let message =
        expansion.unwrap_err().diagnostics().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    assert!(
        message.contains("why: there is a first; that did not hold at ") && message.contains("messages.rs:")
    );
    assert!(message.contains("instead: report it") && !message.contains("not this"), "{message}");
    // The record is of one expansion, and a refusal with other reasons keeps them.
    assert!(without_fault(|| Ok(())).is_ok());
    let both = without_fault(|| {
        never_missing(None, "there is a first", ());
        Err::<(), _>(refusal("dim = 2", "struct M;"))
    });
    let names: Vec<&str> = both.as_ref().unwrap_err().diagnostics().map(Diagnostic::name).collect();
    assert_eq!(names.last(), Some(&"impossible"), "{names:?}");
    assert!(names.len() > 1);
}

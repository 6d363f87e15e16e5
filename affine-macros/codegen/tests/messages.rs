//! Every message in full: `messages.txt` has, for each case, the attribute, the struct, and for each mistake the
//! tokens that the message underlines and its text. The messages that come from the quadratic form are below.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;

use affine_codegen::diagnostics::{Diagnostic, Directions, Rejected, gate};
use affine_codegen::{check, spec};
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
    gate(|found| spec::parse(tokens(args), tokens(item), found))
        .and_then(|spec| gate(|found| check::as_written(&spec, found)))
        .err()
        .unwrap_or_else(|| panic!("accepted: {args}"))
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

fn from_the_quadratic_form() -> Vec<(Diagnostic, &'static str)> {
    let text = str::to_owned;
    vec![
        (
            Diagnostic::Degenerate {
                eigenvalue: text("I + A + n B"),
                numbers: text("1 + 2 + 3*(-1)"),
                directions: Directions::Trace,
            },
            "the kinetic energy is degenerate: I + A + n B = 1 + 2 + 3*(-1) = 0 on multiples of the identity \
             (dilatation) [degenerate]\n\
             why: the Legendre transformation X = I O^T + A O + B tr(O) 1 (4.18), (4.20) has the eigenvalue \
             I + A + n B there; the momentum does not determine the velocity\n\
             instead: change a coefficient so that I + A + n B is not zero; I is the sum of the inertias, A is \
             `casimir2`, B is `casimir1_squared`",
        ),
        (
            Diagnostic::DegenerateTensor {
                terms: text("`body_tensor` + `casimir2`"),
                velocity: "Oh",
                kernel: text("[[0, 1], [-1, 0]]"),
            },
            "the kinetic energy is degenerate: `body_tensor` + `casimir2` vanishes on Oh = [[0, 1], [-1, 0]] \
             [degenerate-tensor]\n\
             why: the Legendre transformation X[B,A] = K[(A,B),(C,D)] O[C,D] (4.6), (4.8) gives zero momentum \
             there; the momentum does not determine the velocity\n\
             instead: change the tensor, or add a term that is not zero on this velocity",
        ),
        (
            Diagnostic::NotPositiveDefinite { quantity: text("I - A"), value: text("1 - 2 = -1") },
            "the kinetic energy is not positive definite: I - A = 1 - 2 = -1 is not positive \
             [not-positive-definite]\n\
             why: `require(positive_definite)` asks for T > 0 at every velocity; the isotropic form has it iff \
             I > |A| and I + A + n B > 0\n\
             instead: change the coefficients, or remove the requirement: indefinite energies are legitimate",
        ),
        (
            Diagnostic::ClaimBroken {
                side: "body",
                claim: "affine",
                group: text("GL(3)"),
                term: "body_inertia",
                transformation: text("the generator E[1,2]"),
            },
            "`body_inertia` breaks the claim `body = affine` [claim-broken]\n\
             why: the claim is that T is invariant under GL(3) acting in the body, phi -> phi R, and T of \
             `body_inertia` changes under the generator E[1,2]\n\
             instead: claim less, `body = metric` or `body = none`, or replace the term",
        ),
        (
            Diagnostic::ClaimBroken {
                side: "space",
                claim: "metric",
                group: text("O(2)"),
                term: "space_tensor",
                transformation: text("the reflection diag(-1, 1)"),
            },
            "`space_tensor` breaks the claim `space = metric` [claim-broken]\n\
             why: the claim is that T is invariant under O(2) acting in space, phi -> L phi, and T of \
             `space_tensor` changes under the reflection diag(-1, 1)\n\
             instead: claim less, `space = none`, or replace the term",
        ),
    ]
}

#[test]
fn messages_of_the_quadratic_form_read_as_reviewed() {
    for (diagnostic, expected) in from_the_quadratic_form() {
        assert_eq!(diagnostic.to_string(), expected);
    }
}

#[test]
fn every_mistake_has_a_reviewed_message() {
    let names: BTreeSet<&str> = Diagnostic::NAMES.iter().copied().collect();
    assert_eq!(names.len(), Diagnostic::NAMES.len(), "names are unique");
    let mut reviewed: BTreeSet<String> =
        from_the_quadratic_form().iter().map(|(diagnostic, _)| diagnostic.name().to_owned()).collect();
    for Case { args, item, .. } in cases() {
        reviewed.extend(refusal(&args, &item).diagnostics().map(|diagnostic| diagnostic.name().to_owned()));
    }
    let missing: Vec<&str> = names.into_iter().filter(|name| !reviewed.contains(*name)).collect();
    assert!(missing.is_empty(), "no case for {missing:?}");
}

#[test]
fn several_mistakes_arrive_together() {
    let args = "dim = 4, kinetic(casimr2 = 0.2f64, body_inertia = ), emit(fast), emit(taylor)";
    let names: Vec<&str> = refusal(args, "enum M {}").diagnostics().map(Diagnostic::name).collect();
    assert_eq!(names, ["item-kind", "repeated-key", "unknown-key", "expected-value", "unknown-name"]);

    let args =
        "dim = 3, kinetic(casimir2 = b + c, dalembert = diag(1, 0), space_translation = 1/0), emit(taylor)";
    let names: Vec<&str> = refusal(args, "struct M;").diagnostics().map(Diagnostic::name).collect();
    assert_eq!(
        names,
        ["unknown-symbol", "unknown-symbol", "unavailable-capability", "matrix-size", "division-by-zero"]
    );
}

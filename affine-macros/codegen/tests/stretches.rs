//! Potentials in single stretches: what is rejected, and what needs no stretches after all.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_codegen::diagnostics::{Diagnostic, gate};
use affine_codegen::{check, expand, spec};
use proc_macro2::TokenStream;

fn arguments(n: usize, potential: &str) -> TokenStream {
    format!("dim = {n}, kinetic(body_inertia = 1, casimir2 = 0.25), potential = {potential}").parse().unwrap()
}

/// The names of the mistakes.
fn mistakes(n: usize, potential: &str) -> Vec<&'static str> {
    let item: TokenStream = "struct M { c: f64 }".parse().unwrap();
    let checked = gate(|found| spec::parse(arguments(n, potential), item, found)).and_then(|spec| {
        gate(|found| check::as_written(&spec, found))?;
        gate(|found| check::energy(&spec, found)).map(|_| ())
    });
    match checked {
        Ok(()) => Vec::new(),
        Err(rejected) => rejected.diagnostics().map(Diagnostic::name).collect(),
    }
}

fn expansion(n: usize, potential: &str) -> String {
    assert_eq!(mistakes(n, potential), [""; 0], "{potential}");
    expand(arguments(n, potential), "struct M { c: f64 }".parse().unwrap()).to_string()
}

#[test]
fn symmetric_functions_of_even_powers_need_no_stretches() {
    for (n, potential) in [
        (2, "q1 + q2"),
        (3, "(q1 + q2 + q3)^4*q"),
        (2, "Q1^2 + Q2^2"),
        (3, "Q1^4 + Q2^4 + Q3^4"),
        (3, "Q1^2*Q2^2 + Q1^2*Q3^2 + Q2^2*Q3^2"),
        (3, "Q1^-2 + Q2^-2 + Q3^-2"),
        (3, "Q1*Q2*Q3"),
        (2, "Q1/Q2 + Q2/Q1"),
        (3, "pairs(cosh(2*d))"),
        (2, "pairs(sinh(d/2)^2)"),
        (3, "exp(2*q1) + exp(2*q2) + exp(2*q3)"),
        (2, "c*ln(Q1*Q2)^2"),
        (2, "pairs(1/cosh(d)^2)"),
        (3, "exp(q1 + q2 + q3 - 3*q)*q"),
        (3, "sqrt(1 + Q1^2 + Q2^2 + Q3^2)"),
        (3, "c/(1 + Q1^2 + Q2^2 + Q3^2)"),
        (2, "(Q1^2 + Q2^2)*(q1 + q2)"),
        (2, "Q1*Q2*(Q1^2 + Q2^2)"),
        (3, "cosh(q1 + q2 + q3)"),
        // Twice the same with opposite signs.
        (2, "q1^4 + q2^4 + q - q1^4 - q2^4"),
        (2, "q1^2 + 2*q1*q2 + q2^2"),
    ] {
        let tokens = expansion(n, potential);
        assert!(!tokens.contains("stretches"), "{potential}");
    }
}

#[test]
fn other_functions_need_them() {
    for (n, potential) in [
        (2, "q1^2 + q2^2"),
        (3, "Q1 + Q2 + Q3"),
        (3, "pairs(d^2)"),
        (3, "pairs(cosh(d))"),
        (3, "pairs(1/cosh(d)^2)"),
        (3, "pairs(cos(d))*q"),
        (3, "q1*Q1^2 + q2*Q2^2 + q3*Q3^2"),
        (3, "tanh(q1)^2 + tanh(q2)^2 + tanh(q3)^2"),
        (2, "pairs(abs(d)^2)"),
        (2, "pairs(sqrt(d^2 + c^2))"),
    ] {
        let tokens = expansion(n, potential);
        assert!(tokens.contains("principal_stretches") && tokens.contains("log_stretches"), "{potential}");
    }
}

#[test]
fn what_is_not_a_smooth_function_of_the_placement_is_refused() {
    for (n, potential, mistake) in [
        (3, "q1^2", "not-symmetric"),
        (2, "q1 - q2", "not-symmetric"),
        (3, "Q1*Q2 + Q3", "not-symmetric"),
        (3, "pairs(d)", "odd-difference"),
        (3, "q + pairs(d^3)", "odd-difference"),
        (3, "pairs(sinh(d))", "odd-difference"),
        (3, "pairs(abs(d))", "not-smooth"),
        (2, "pairs(abs(d)^3)", "not-smooth"),
        (2, "pairs(sqrt(d^2))", "not-smooth"),
        (2, "pairs(sqrt(cosh(d) - 1))", "coincidence"),
        (2, "pairs(1/d^2)", "coincidence"),
        (2, "pairs(1/sinh(d)^2)", "coincidence"),
        (3, "pairs(d/tanh(d))", "coincidence"),
        (2, "pairs(ln(d^2))", "coincidence"),
        (2, "sqrt(tr(G) - 2*det)", "coincidence"),
        (2, "1/(q1 - q2)^2", "coincidence"),
        (2, "abs(q1) + abs(q2)", "not-smooth"),
        (3, "abs(q)", "not-smooth"),
        (3, "d^2", "loose-difference"),
        (2, "q1^2 + q3^2", "index-range"),
        (2, "Q0^2", "index-range"),
    ] {
        assert_eq!(mistakes(n, potential), [mistake], "{potential}");
    }
}

#[test]
fn absolute_values_that_are_smooth() {
    for potential in [
        "abs(c)*q^2",
        "abs(q)^2",
        "abs(q)^-2",
        "cos(abs(q))",
        "abs(tr(G))",
        "abs(-det)",
        "abs(abs(cosh(q)))^3",
    ] {
        assert!(!expansion(3, potential).contains("q . abs"), "{potential}");
    }
}

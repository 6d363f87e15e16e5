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

/// The form of a quotient may have another sign than the quotient, and an odd function pulls it out again.
#[test]
fn odd_functions_of_quotients_have_a_form() {
    for (n, potential) in [
        (3, "sin(1/(1 - q)) + q1^2 + q2^2 + q3^2"),
        (2, "sin(1/(1 - phi[2,2])) + q1^2 + q2^2"),
        (2, "tanh(t/(1 - t)) + q1^2 + q2^2"),
        (3, "sinh(c/I2)*(q1^2 + q2^2 + q3^2)"),
        (3, "pairs(cosh(d)) + tan(1/I2)"),
        (2, "tanh(tanh(1/(1 - q)))*(q1^2 + q2^2)"),
    ] {
        assert!(expansion(n, potential).contains("log_stretches"), "{potential}");
    }
    // Symmetric ones through traces, with the sign that they have: `sinh(3/(1 - 2 q)) = -sinh(3/(2 (q - 1/2)))`.
    for (n, potential, written) in [
        (3, "tanh(1/(Q1^2*Q2^2 + Q2^2*Q3^2 + Q3^2*Q1^2))", "- tanh(2/(tr(G^2) - tr(G)^2))"),
        (2, "sinh(3/(1 - q1 - q2))", "- sinh(3/(2*(q - 1/2)))"),
        (2, "q1 + q2 - tan(1/(2 - q1 - q2))", "+ tan(1/(2*(q - 1)))"),
        (2, "cos(3/(1 - q1 - q2))", "+ cos(3/(2*(q - 1/2)))"),
    ] {
        assert!(expansion(n, potential).contains(written), "{potential}");
    }
    assert!(!expansion(2, "det + sin(1/(1 - q1 - q2)) + sin(1/(q1 + q2 - 1))").contains("sin(1/"));
}

#[test]
fn what_is_divided_by_and_vanishes_everywhere_is_refused() {
    for (n, divisor) in [
        (2, "ln(D) - q"),
        (2, "tr(Ct) - tr(G)"),
        (3, "tr(G) - I1"),
        (2, "G[1,2] - G[2,1]"),
        (2, "exp(2*q) - det"),
        (2, "sqrt(I1)^2 - I1"),
        (3, "ln(1)"),
        (3, "sin(0)"),
        (2, "1 - cos(0)"),
        (3, "exp(0) - 1"),
        (2, "c - c + sin(0)"),
        (2, "det^2 - I2"),
        (2, "D^2 - det"),
        (3, "cosh(q)^2 - sinh(q)^2 - 1"),
        (3, "tanh(q)*cosh(q) - sinh(q)"),
        (2, "q1 + q2 - 2*q"),
        (2, "Q1*Q2 - det"),
        (3, "ln(Q1*Q2*Q3) - ln(det)"),
        (2, "q1 + q2 - ln(det)"),
        (3, "sqrt(det) - exp(1.5*q)"),
        (2, "sin(q1 - q2) + sin(q2 - q1)"),
        (2, "exp(exp(2*q) - D^2) - 1"),
        (2, "I1 - Q1^2 - Q2^2"),
        (2, "1/(1 - q) + 1/(q - 1)"),
        (3, "(I1 + q)^16 - (q + I1)^12*(q + I1)^4"),
        (2, "tr((G - 1)^2) - tr(G*G) + 2*tr(G) - 2"),
        (2, "I1 - G[1,1] - G[2,2]"),
        (3, "I1 - Ct[1,1] - Ct[2,2] - Ct[3,3]"),
        (2, "tr(phi)^2 - tr(phi^2) - 2*det"),
        (2, "G[1,1]*G[2,2] - G[1,2]^2 - D^4"),
        (3, "G[1,2] - phi[1,1]*phi[1,2] - phi[2,1]*phi[2,2] - phi[3,1]*phi[3,2]"),
    ] {
        for potential in [
            format!("I1 + q^2/({divisor})"),
            format!("q1^2 + q2^2 + q^2*({divisor})^-1"),
            format!("I1 + 0*(1/({divisor}))"),
            format!("I1 + sin(q/({divisor}))"),
            format!("orthogonality(5) + pairs(cosh(d/({divisor})))"),
        ] {
            assert_eq!(mistakes(n, &potential), ["division-by-zero"], "{potential}");
        }
        assert_eq!(mistakes(n, &format!("I1 + ln({divisor})")), ["domain"], "{divisor}");
    }
    assert_eq!(mistakes(2, "I1 + tr((G + 1/(ln(D) - q))^8)"), ["division-by-zero"]);
    // For one of the pairs.
    assert_eq!(mistakes(3, "pairs(1/(d^2 - (q1 - q3)^2))"), ["division-by-zero"]);
}

/// Nearly the same, and no zero.
#[test]
fn what_is_divided_by_and_vanishes_somewhere_is_left_to_the_run() {
    for (n, divisor) in [
        (3, "ln(D) - q - c"),
        (3, "tr(G*Ct) - tr(G*G)"),
        (2, "exp(2*q) - det^2"),
        (2, "sqrt(I1)^3 - I1"),
        (2, "cosh(q)^2 + sinh(q)^2 - 1"),
        (3, "det^2 - D^5"),
        (2, "abs(c) - c"),
        (2, "sqrt(c^2 + 1)*sqrt(c + 3) + sqrt((c^2 + 1)*(c + 3))"),
        (2, "tan(q) - tanh(q)"),
        (3, "I1 - G[1,1] - G[2,2]"),
        (2, "phi[1,1] - phi[2,2]"),
        (2, "G[1,1] - phi[1,1]^2 - phi[1,2]^2"),
        (2, "G[1,2] - Ct[1,2]"),
        // Multiples of the primes of the generator.
        (2, "4611686018427369527*q"),
        (2, "q/4611686018427369527"),
        (3, "2305843009213693951*q"),
    ] {
        assert_eq!(mistakes(n, &format!("I1 + q^2/({divisor})")), [""; 0], "{divisor}");
    }
}

/// Whether a function of single stretches is symmetric shows when it is multiplied out, each pair by itself.
#[test]
fn a_sum_over_pairs_is_a_sum() {
    let pairs = "(pairs(cos(d)) + pairs(cos(2*d)) + pairs(cos(3*d)))";
    assert_eq!(mistakes(3, &format!("{pairs}^12")), ["expression-size"]);
    assert_eq!(mistakes(3, &format!("{pairs}^4")), [""; 0]);
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

//! What is asked for is emitted or refused: no combination of energy, constraint and potential loses its exact flows in
//! silence.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_codegen::expand;
use proc_macro2::TokenStream;

const INERTIAS: [&str; 9] = [
    "casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1",
    "casimir2 = 0.2, space_inertia = 1",
    "casimir2 = 1",
    "body_inertia = J",
    "casimir2 = a, body_inertia = J",
    "space_inertia = j, casimir1_squared = a",
    "casimir2 = a, space_tensor = k",
    "dalembert = J",
    "casimir2 = 1, body_tensor = E",
];

const TRANSLATIONS: [&str; 3] = ["", ", body_translation = 2", ", space_translation = m"];

const CONSTRAINTS: [&str; 4] =
    ["", "constraint = isochoric, ", "constraint = rigid, ", "constraint = conformal, "];

const POTENTIALS: [&str; 4] = [
    "",
    ", potential = hyperbolic_dilatation(10) + neo_hookean(0.5)",
    ", potential = G[1,1]^2 + phi[1,2]*cos(t)",
    ", potential = norm(x)^2/2 + x[1]*phi[1,2]",
];

/// `E` is the square of one entry off the diagonal: its momentum is conserved.
fn spelled(args: &str, n: usize) -> String {
    let diagonal = if n == 2 { "diag(1, 1.5)" } else { "diag(1, 1.5, 2)" };
    let row = |k: usize| {
        (0..n * n).map(|l| if (k, l) == (1, 1) { "1" } else { "0" }).collect::<Vec<_>>().join(", ")
    };
    let entry = (0..n * n).map(|k| format!("[{}]", row(k))).collect::<Vec<_>>().join(", ");
    args.replace("= J", &format!("= {diagonal}")).replace("= E", &format!("= [{entry}]"))
}

#[test]
fn exact_flows_in_the_plane_are_emitted_or_refused() {
    let (emitted, refused) = every_combination(2);
    assert!(emitted > 200 && refused > 80, "{emitted} emitted, {refused} refused");
}

#[test]
fn exact_flows_in_space_are_emitted_or_refused() {
    let (emitted, refused) = every_combination(3);
    assert!(emitted > 50 && refused > 20, "{emitted} emitted, {refused} refused");
}

/// How many are emitted, and how many refused.
fn every_combination(n: usize) -> (usize, usize) {
    let (mut emitted, mut refused) = (0, 0);
    let item = format!(
        "pub struct M {{ pub a: f64, pub m: f64, pub j: frames::Matrix<{n}>, pub k: frames::Matrix<{}> }}",
        n * n
    );
    let item: TokenStream = item.parse().unwrap();
    // In space an expansion costs several times as much.
    let potentials = if n == 2 { &POTENTIALS[..] } else { &POTENTIALS[1..2] };
    for inertia in INERTIAS {
        for (translation, constraint) in TRANSLATIONS.iter().flat_map(|t| CONSTRAINTS.map(|c| (t, c))) {
            for potential in potentials {
                let args = format!(
                    "dim = {n}, {constraint}kinetic({inertia}{translation}){potential}, emit(splitting)"
                );
                let args = spelled(&args, n);
                let expansion = expand(args.parse().unwrap(), item.clone()).to_string();
                if expansion.contains("compile_error !") {
                    refused += 1;
                } else {
                    assert!(expansion.contains(":: Splitting <"), "nothing is emitted for {args}");
                    emitted += 1;
                }
            }
        }
    }
    (emitted, refused)
}

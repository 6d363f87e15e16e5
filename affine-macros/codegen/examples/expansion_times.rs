//! How long the macro takes to expand: families, what is slow, and the largest specification that is legal.
//!
//! ```sh
//! cargo run -p affine-codegen --example expansion_times            # as the macro is built in a debug build
//! cargo run -p affine-codegen --example expansion_times -- 3 tensor # three times those whose name contains `tensor`
//! ```
//!
//! The largest must take less than two seconds; the exit code says so.

use std::fmt::Write as _;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use affine_codegen::expand;
use proc_macro2::TokenStream;

/// What the largest specification may take.
const MOST: Duration = Duration::from_secs(2);

/// Name, arguments, fields.
type Case = (&'static str, String, String);

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let repeats = arguments.next().and_then(|text| text.parse().ok()).unwrap_or(1_u32);
    let wanted = arguments.next().unwrap_or_default();
    println!("{:<44} {:>9} {:>9}", "specification", "ms", "tokens");
    let mut slow = false;
    for (name, args, fields) in cases().into_iter().filter(|(name, ..)| name.contains(&wanted)) {
        let (time, tokens) = timed(repeats, &args, &format!("pub struct Model {{ {fields} }}"));
        slow |= time > MOST;
        println!("{name:<44} {:>9.1} {tokens:>9}", time.as_secs_f64() * 1e3);
    }
    if slow { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// The least time of several, and the tokens of the expansion.
fn timed(repeats: u32, args: &str, item: &str) -> (Duration, usize) {
    let parsed = |text: &str| -> TokenStream { text.parse().unwrap_or_default() };
    let (args, item) = (parsed(args), parsed(item));
    let mut least = Duration::MAX;
    let mut tokens = 0;
    for _ in 0..repeats.max(1) {
        let (args, item) = (args.clone(), item.clone());
        let start = Instant::now();
        let expansion = expand(args, item);
        least = least.min(start.elapsed());
        let text = expansion.to_string();
        if let Some((_, message)) = text.split_once("compile_error ! {") {
            println!("refused: {}", message.lines().next().unwrap_or_default());
        }
        tokens = count(expansion);
    }
    (least, tokens)
}

fn count(tokens: TokenStream) -> usize {
    let of_tree = |tree| match tree {
        proc_macro2::TokenTree::Group(group) => 2 + count(group.stream()),
        _ => 1,
    };
    tokens.into_iter().map(of_tree).sum()
}

fn cases() -> Vec<Case> {
    let plain = |name, args: &str| (name, args.to_owned(), String::new());
    let isotropic = "kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1)";
    let vibrating = "potential = hyperbolic_dilatation(10) + neo_hookean(0.5)";
    vec![
        plain("body-metric, n = 2", &format!("dim = 2, {isotropic}")),
        plain("body-metric, n = 3", &format!("dim = 3, {isotropic}")),
        plain("P2: vibrating, n = 3", &format!("dim = 3, {isotropic}, {vibrating}")),
        plain(
            "P3: d'Alembert, elastic, n = 3",
            &format!("dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), {vibrating}"),
        ),
        plain(
            "P7: drunk missile, vibrating, n = 3",
            &format!(
                "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1), \
                 {vibrating}"
            ),
        ),
        plain("single stretches, n = 3", &format!("dim = 3, {isotropic}, potential = q1^2 + q2^2 + q3^2")),
        plain("sum of frames, n = 3", "dim = 3, kinetic(body_inertia = 1, space_inertia = diag(1, 1.5, 2))"),
        tensor("tensor, n = 3", ""),
        tensor("tensor, n = 3, splitting", ", emit(splitting)"),
        tensor("tensor, n = 3, vibrating", ", potential = hyperbolic_dilatation(kappa) + neo_hookean(c)"),
        tensor(
            "tensor, n = 3, single stretches, lanes",
            ", potential = hyperbolic_dilatation(kappa) + q1^4 + q2^4 + q3^4 + c*x[1]^2, emit(lanes)",
        ),
        tensor(
            "tensor, n = 3, all capabilities",
            ", potential = hyperbolic_dilatation(kappa) + neo_hookean(c) + c*x[1]^2, \
             emit(taylor, splitting, lanes, metric, acceleration)",
        ),
        everything(),
    ]
}

/// A full symmetric 9 by 9 tensor beside fields, with translation.
fn tensor(name: &'static str, rest: &str) -> Case {
    // Dominated by its diagonal, so that it is definite; no two entries alike.
    let entry = |a: usize, b: usize| match a == b {
        true => format!("{}", 10 + a),
        false => format!("0.{}{}", a.min(b) + 1, a.max(b) + 1),
    };
    let mut rows = String::new();
    for a in 0..9 {
        let row: Vec<String> = (0..9).map(|b| entry(a, b)).collect();
        let _ = write!(rows, "[{}], ", row.join(", "));
    }
    let fields = "a: f64, kappa: f64, c: f64, m: f64";
    let args = format!("dim = 3, kinetic(casimir2 = a, body_tensor = [{rows}], body_translation = m){rest}");
    (name, args, fields.to_owned())
}

/// An isotropic body with every capability.
fn everything() -> Case {
    (
        "isotropic fields, n = 3, all capabilities",
        "dim = 3, kinetic(casimir2 = a, casimir1_squared = b, body_inertia = i), \
         potential = hyperbolic_dilatation(kappa) + neo_hookean(c), \
         emit(taylor, splitting, two_polar, lanes, metric)"
            .to_owned(),
        "i: f64, a: f64, b: f64, kappa: f64, c: f64".to_owned(),
    )
}

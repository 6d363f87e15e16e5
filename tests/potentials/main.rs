//! Energies that users of such software write, at placements from large stretches down to hardly strained ones, against forces
//! of 40 digits.
//!
//! `S` is what one rounding in every entry of `phi` does to a force, `sum |d2U/dphi dphi| |phi|`.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod charts;
mod counts;
mod energies;
mod table;
mod tidal;

use table::{Energy, Row, counted};

/// `|error| <= BOUND eps (|S| + |F|)`: a natural matrix formula needs 0.7 at most.
const BOUND: f64 = 4.0;

/// A constant moves nothing, and is part of the energy that was stated, whether it is written as a number or is a field.
#[test]
fn constants_are_part_of_the_energy() {
    use affine_runtime::prelude::*;
    let at = Matrix::<2>::new(1.1, 0.2, -0.1, 0.9);
    macro_rules! energy {
        ($($potential:tt)*) => {{
            #[affine_model(dim = 2, kinetic(body_inertia = 1), potential = $($potential)*)]
            struct Body;
            let point = Body.at_velocity(at, Matrix::zeros()).unwrap();
            assert!(Simulation::new(&Body, point).until(1.0).run().unwrap().points().iter().all(|end| (end.phi() - at).norm() < 1e-9));
            Body.hamiltonian(0.0, &point)
        }};
    }
    assert_eq!(energy!(3), 3.0);
    assert_eq!(energy!(tr(1)), 2.0);
    assert_eq!(energy!(0 * q + 5), 5.0);
    assert_eq!(energy!(det * det ^ -1 + 2), 3.0);
    assert_eq!(energy!(3 - 3), 0.0);
}

/// Functions of numbers beside fields in functions: energies and motions in closed form.
#[test]
fn numbers_in_functions_of_fields() {
    use affine_runtime::prelude::*;
    #[affine_model(dim = 2, kinetic(body_inertia = 1), potential = tanh(b*sqrt(2))*tr(G))]
    struct Alone {
        b: f64,
    }
    #[affine_model(dim = 2, kinetic(dalembert = m), potential = sin(sqrt(2)*c)*tr(G))]
    struct Beside {
        m: f64,
        c: f64,
    }
    #[affine_model(
        dim = 2,
        kinetic(dalembert = m),
        potential = exp(c*ln(2))*tr(G) + ln(b*sqrt(2))*tr(G)^2 + exp(b/ln(2))*det + abs(b*c*sqrt(3))*det^2 + cos((3 + a*cos(1))/3)*phi[1,1]
            + sqrt(b*exp(c*sqrt(2)))
    )]
    struct Several {
        m: f64,
        a: f64,
        b: f64,
        c: f64,
    }
    let (m, a, b, c) = (1.5_f64, 0.3_f64, 1.7_f64, 0.646_f64);
    let energy = |found: f64, expected: f64| {
        assert!((found - expected).abs() < 4e-15 * expected.abs(), "{found} {expected}")
    };
    let alone = Alone { b }.prepare().unwrap();
    let rest = alone.at_velocity(Matrix::identity(), Matrix::zeros()).unwrap();
    energy(alone.hamiltonian(0.0, &rest), 2.0 * (b * 2.0_f64.sqrt()).tanh());
    let beside = Beside { m, c }.prepare().unwrap();
    let rest = beside.at_velocity(Matrix::identity(), Matrix::zeros()).unwrap();
    let stiffness = (2.0_f64.sqrt() * c).sin();
    energy(beside.hamiltonian(0.0, &rest), 2.0 * stiffness);
    let run = Simulation::new(&beside, rest).until(1.0).tolerance(1e-12).run().unwrap();
    let (_, end) = run.end();
    assert!((end.phi()[(0, 0)] - (2.0 * stiffness / m).sqrt().cos()).abs() < 1e-10);
    let several = Several { m, a, b, c }.prepare().unwrap();
    let rest = several.at_velocity(Matrix::identity(), Matrix::zeros()).unwrap();
    let expected = 2.0 * (c * 2.0_f64.ln()).exp()
        + 4.0 * (b * 2.0_f64.sqrt()).ln()
        + (b / 2.0_f64.ln()).exp()
        + b * c * 3.0_f64.sqrt()
        + ((3.0 + a * 1.0_f64.cos()) / 3.0).cos()
        + (b * (c * 2.0_f64.sqrt()).exp()).sqrt();
    energy(several.hamiltonian(0.0, &rest), expected);
}

#[test]
fn forces_within_the_rounding_of_the_placement() {
    let energies = energies::all();
    assert_eq!(energies.len(), 39);
    let mut missed = Vec::new();
    for Energy { name, rows, .. } in &energies {
        assert_eq!(rows.len(), 6, "{name}");
        for Row { at, error, size, sensitivity, .. } in rows {
            let ratio = error / (f64::EPSILON * (sensitivity + size));
            if ratio.is_nan() || ratio > BOUND {
                missed.push(format!("{name} at {at}: {ratio:.1e}"));
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// Forces that are wrong by the rounding of `phi - 1` alone, down to hardly strained bodies.
#[test]
fn forces_within_the_rounding_of_the_strain() {
    let mut missed = Vec::new();
    for Energy { name, rows, .. } in &energies::all() {
        let of = |row: &Row| row.error / (f64::EPSILON * (row.near + row.size));
        let worst = rows.iter().filter(|row| row.at != "large").map(of).fold(0.0, f64::max);
        if worst.is_nan() || worst > BOUND {
            missed.push(format!("{name}: {worst:.1e}"));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// Operations at a point and along a motion, and the worst errors in `eps (|S| + |F|)` and in `eps (near + |F|)`, where `near` is `S` with `|phi - 1|` for
/// `|phi|`: `cargo test --test potentials figures -- --nocapture`.
#[test]
fn figures() {
    for Energy { name, operations, rows } in energies::all() {
        let worst = |part: fn(&Row) -> f64, strained: bool| {
            let rows = rows.iter().filter(|row| !strained || row.at != "large");
            rows.map(|row| row.error / (f64::EPSILON * (part(row) + row.size))).fold(0.0, f64::max)
        };
        let (first, second) = (worst(|row| row.sensitivity, false), worst(|row| row.near, true));
        let [at_point, along] = operations.each_ref().map(counted);
        println!("{name:14} {at_point:>24} {along:>24} {first:9.1e} {second:9.1e}");
        assert!(first.is_finite());
    }
}

/// An expansion forms no more than so many products of terms, counted where a clock would scatter.
const WORK: u64 = 25_000;

#[test]
fn expansions_multiply_little_out() {
    let product = |n: usize, potential: &str| {
        let centre = if potential.contains('x') { ", space_translation = 1" } else { "" };
        let args = format!("dim = {n}, kinetic(dalembert = 1{centre}), potential = {potential}");
        let before = affine_codegen::algebra::work::products();
        let tokens = affine_codegen::expand(args.parse().unwrap(), "struct Body;".parse().unwrap());
        assert!(!tokens.to_string().contains("compile_error"), "{args}");
        affine_codegen::algebra::work::products() - before
    };
    let more =
        ["(tr(G)-3)^12", "(I2-3)^4", "(tr(G)*exp(-2*q)-3)^6", "(tr(G*G*G)-3)^3", "(G[1,1]-1)^9*tr(G*G)"];
    let traces =
        ["tr(G^4*Ct^2)", "tr(G^3*Ct^2)", "tr(G*Ct*G*Ct*G)", "tr(phi^6)", "tr(G^16)", "(tr(G^2*Ct)-3)^4"];
    let matrices = ["tr((G+Ct)^4)", "tr((G+Ct)^16)", "tr((G*Ct)^4)", "tr((G-1)^16)", "tr((G*Ct+phi)^3)^2"];
    // Also where it is decided what is smooth, and far from rest.
    let entries = |name: &str| {
        let all = (1..=3).flat_map(|i| (1..=3).map(move |a| format!("{name}[{i},{a}]")));
        all.collect::<Vec<_>>().join(" + ")
    };
    let nine = entries("phi");
    let many = format!("{nine} + {} + {} + q", entries("G"), entries("Ct"));
    let in_functions = [
        format!("ln(({nine})^12 + 1)"),
        format!("sqrt(1 + ({nine})^16)"),
        format!("q/(({nine})^16 + 1)"),
        format!("ln(({many})^8 + 1)"),
        format!("q/(({many})^16 + 1)"),
    ];
    let in_functions = in_functions.iter().map(String::as_str);
    let more = more.into_iter().chain(traces).chain(matrices).chain(in_functions);
    let table = energies::TEXTS.iter().map(|(name, n, text)| (*name, *n, *text));
    for (name, n, text) in table.chain(more.map(|text| (text, 3, text))) {
        let work = product(n, text);
        println!("{name:20} {work}");
        assert!(work < WORK, "{name}: {work}");
    }
}

/// Phrases of textbooks are the same energies as those that are written by `q`.
#[test]
fn phrases_mean_what_they_say() {
    let tokens = |n: usize, potential: &str| {
        let args = format!("dim = {n}, kinetic(dalembert = 1), potential = {potential}");
        let tokens = affine_codegen::expand(args.parse().unwrap(), "struct Body;".parse().unwrap());
        assert!(!tokens.to_string().contains("compile_error"), "{args}");
        tokens.to_string()
    };
    let mut others = Vec::new();
    for (n, phrase, plain) in [
        (3, "0.5*(tr(G)*det^(-2/3) - 3)", "0.5*(tr(G)*exp(-2*q) - 3)"),
        (3, "tr(G)*I3^(-1/3)", "tr(G)*exp(-2*q)"),
        (2, "tr(G)*I2^(-1/2)", "tr(G)*exp(-2*q)"),
        (3, "D^0.5*tr(G)", "exp(q/2)*tr(G)"),
        (3, "tr(G^2) - 2*tr(G)", "tr(G*G) - 2*tr(G)"),
        (3, "tr(G^3*Ct^2)", "tr(G*G*G*Ct*Ct)"),
        (2, "Q1^1.3 + Q2^1.3", "exp(1.3*q1) + exp(1.3*q2)"),
        (3, "log(det)^2 + log1p(q^2)", "ln(det)^2 + ln(1 + q^2)"),
        (2, "expm1(q^2)*2 + log1p(tr(G))", "2*(exp(q^2) - 1) + ln(1 + tr(G))"),
        (2, "tr(G^-1)", "I1/I2"),
        (3, "tr(G^-1)", "I2/I3"),
        (2, "q^2 + tr(Ct^-1)", "q^2 + tr(Ct)/I2"),
        (3, "tr(2*Ct^-1 - 3)*tr(G)", "(2*I2/I3 - 9)*tr(G)"),
        (3, "tr((G-1)*(G-1))", "tr(G*G) - 2*tr(G) + n"),
        (2, "tr((G - 1)^2)", "tr(G*G) - 2*tr(G) + n"),
        (3, "0.7*tr((G - 1)^2)", "orthogonality(0.7)"),
        (3, "0.3/2*(tr(G - 1)/2)^2 + 0.2*tr((G - 1)^2)/4", "saint_venant_kirchhoff(0.3, 0.2)"),
        (3, "tr((G - 1)^3)", "tr(G*G*G) - 3*tr(G*G) + 3*tr(G) - n"),
        (2, "tr(2*G*G - 3*G + 1)", "2*tr(G*G) - 3*tr(G) + n"),
        (3, "tr((Ct - 1)*(Ct - 1))", "tr(Ct*Ct) - 2*tr(Ct) + n"),
        (3, "tr(1)*q^2", "n*q^2"),
        (3, "tr(G*(Ct*Ct^-1 + G^0))/2", "tr(G)"),
        (3, "tr((G - tr(G)/n)^2)", "tr(G*G) - tr(G)^2/3"),
        (2, "tr((G - 1/3)^2/2)", "tr(G*G)/2 - tr(G)/3 + 1/9"),
        (2, "tr(-(sin(t) - G)*G)", "-sin(t)*tr(G) + tr(G*G)"),
        (3, "pairs(d^2) + Q1^1.3 + Q2^1.3 + Q3^1.3", "pairs(d^2) + exp(1.3*q1) + exp(1.3*q2) + exp(1.3*q3)"),
    ] {
        if tokens(n, phrase) != tokens(n, plain) {
            others.push(format!("{phrase} is not {plain}"));
        }
    }
    assert!(others.is_empty(), "{others:#?}");
}

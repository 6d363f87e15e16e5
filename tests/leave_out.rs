//! What a model does not need is not in its expansion.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::{BTreeMap, BTreeSet};

use affine_codegen::expand;
use proc_macro2::{TokenStream, TokenTree};

const ITEM: &str = "pub struct Model { pub a: f64, pub b: f64 }";

fn expansion(args: &str) -> TokenStream {
    let tokens = expand(args.parse().unwrap(), ITEM.parse().unwrap());
    assert!(!tokens.to_string().contains("compile_error"), "{args}");
    tokens
}

/// Every name in the code, documentation and texts left aside.
fn names(tokens: TokenStream, found: &mut BTreeSet<String>) {
    for token in tokens {
        match token {
            TokenTree::Ident(name) => {
                found.insert(name.to_string());
            }
            TokenTree::Group(group) => names(group.stream(), found),
            _ => {}
        }
    }
}

fn names_of(args: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    names(expansion(args), &mut found);
    found
}

/// A Hamiltonian and the kinetic energy that it belongs to are one model: `I + A = 1/a`, `I - A = 1/(2c - a)`,
/// `I + A + n B = 1/(a + n b)`.
#[test]
fn statements_on_both_sides_are_the_same_tokens() {
    for (kinetic, hamiltonian) in [
        (
            "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 2)",
            "dim = 3, hamiltonian(casimir2 = 5/6, casimir1_squared = -1/18, vorticity_squared = 25/24, \
             body_translation = 1/2)",
        ),
        (
            "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = -1, space_translation = 2)",
            "dim = 2, hamiltonian(casimir2 = -5/4, casimir1_squared = -5/24, spin_squared = -25/24, \
             space_translation = 1/2)",
        ),
        ("dim = 2, kinetic(casimir2 = 0.2)", "dim = 2, hamiltonian(casimir2 = 5)"),
        (
            "dim = 3, kinetic(casimir2 = 0.2, body_translation = 2)",
            "dim = 3, hamiltonian(casimir2 = 5, spin_squared = 0, casimir3 = 0, body_translation = 0.5)",
        ),
        (
            "dim = 3, kinetic(body_inertia = 2), potential = (tr(G) - n)^2",
            "dim = 3, hamiltonian(casimir2 = 0.5, vorticity_squared = 0.5), potential = (tr(G) - n)^2",
        ),
    ] {
        assert_eq!(expansion(kinetic).to_string(), expansion(hamiltonian).to_string(), "{hamiltonian}");
    }
}

/// Bodies of all functions of an expansion, by name.
fn bodies(args: &str) -> BTreeMap<String, String> {
    let file: syn::File = syn::parse2(expansion(args)).unwrap();
    let items = file.items.into_iter().filter_map(|item| match item {
        syn::Item::Const(constant) => Some(*constant.expr),
        _ => None,
    });
    let statements = items.flat_map(|expression| match expression {
        syn::Expr::Block(block) => block.block.stmts,
        _ => Vec::new(),
    });
    let members = statements.flat_map(|statement| match statement {
        syn::Stmt::Item(syn::Item::Impl(implementation)) => implementation.items,
        _ => Vec::new(),
    });
    let functions = members.filter_map(|member| match member {
        syn::ImplItem::Fn(function) => Some(function),
        _ => None,
    });
    let body = |function: &syn::ImplItemFn| {
        let block = &function.block;
        quote::quote!(#block).to_string()
    };
    functions.map(|function| (function.sig.ident.to_string(), body(&function))).collect()
}

#[test]
fn a_zero_coefficient_leaves_no_trace() {
    let pairs = [
        ("dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1)", "casimir1_squared = 0"),
        ("dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1)", "casimir1_squared = 0.1 + 0.2 - 0.3"),
        ("dim = 3, kinetic(casimir2 = a, body_inertia = 1)", "casimir1_squared = b*(a + 1) - a*b - b"),
        ("dim = 2, kinetic(casimir2 = a, body_inertia = 1)", "space_inertia = n - 2"),
        ("dim = 2, kinetic(casimir2 = 1, space_translation = 2)", "body_inertia = 0"),
        (
            "dim = 2, kinetic(casimir2 = 1, space_inertia = 2)",
            "body_tensor = [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]",
        ),
    ];
    for (without, zero) in pairs {
        let with = without.replace("kinetic(", &format!("kinetic({zero}, "));
        assert_eq!(expansion(&with).to_string(), expansion(without).to_string(), "{with}");
    }
}

/// Requirements and claims are checked, and leave nothing behind either.
#[test]
fn conditions_leave_no_trace() {
    let plain = "dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1)";
    let checked = format!("{plain}, symmetry(space = affine, body = metric), require(positive_definite)");
    assert_eq!(expansion(&checked).to_string(), expansion(plain).to_string());
}

#[test]
fn no_translation_no_centre_of_mass() {
    let is_of_centre = |name: &&String| {
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('_');
        let plain =
            ["x", "p", "d_x", "d_p", "p_hat", "d_p_hat", "v", "turn", "Centre", "total_affine_momentum"];
        plain.contains(&stem)
    };
    for internal in [
        "dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1)",
        "dim = 2, kinetic(casimir2 = a, casimir1_squared = b, space_inertia = 1)",
        "dim = 3, kinetic(casimir2 = 0.2)",
        "dim = 3, kinetic(dalembert = diag(1, 2, a))",
        "dim = 2, kinetic(body_tensor = [[2, 1, 0, 1], [1, 3, 1, 0], [0, 1, 5, 1], [1, 0, 1, 4]])",
    ] {
        let names = names_of(internal);
        let of_centre: Vec<&String> = names.iter().filter(is_of_centre).collect();
        assert!(of_centre.is_empty(), "{internal}: {of_centre:?}");

        let moving = internal.replace("kinetic(", "kinetic(body_translation = 1, ");
        let names = names_of(&moving);
        for needed in ["x", "p", "Centre"] {
            assert!(names.contains(needed), "{moving}: no {needed}");
        }
    }
}

/// The default capability and nothing else, as nothing else was asked for.
#[test]
fn only_the_default_capability() {
    let default = [
        "at_momentum",
        "at_velocity",
        "expand",
        "flatten",
        "geodesic",
        "hamilton_equations",
        "hamiltonian",
        "kinetic_energy",
        "prepare",
        "reduce",
        "reduced_equations",
        "unflatten",
        "velocity",
    ];
    let emitted = |args: &str| bodies(args).into_keys().collect::<Vec<_>>();
    let with = |more: &[&'static str]| {
        let mut names = [&default[..], more].concat();
        names.sort_unstable();
        names
    };
    assert_eq!(emitted("dim = 2, kinetic(casimir2 = 0.2, body_translation = 1)"), default);
    // What depends on fields is a function of coefficients, and these of the fields.
    let of_fields = [
        "coefficients",
        "coefficients_of",
        "expand_with",
        "hamilton_equations_with",
        "hamiltonian_with",
        "kinetic_energy_with",
        "reduce_with",
        "values",
        "velocity_with",
    ];
    assert_eq!(emitted("dim = 2, kinetic(casimir2 = a, body_translation = 1)"), with(&of_fields));
    // The same equations in vectors, where the processor gains by them.
    let in_vectors = ["packed", "packed_equations", "packing", "unpacked"];
    assert_eq!(emitted("dim = 3, kinetic(casimir2 = 0.2, body_translation = 1)"), with(&in_vectors));
}

/// What is conserved, or moves in closed form, is not integrated.
#[test]
fn constants_and_closed_forms_are_not_integrated() {
    for (args, state) in [
        // phi; Sigma_hat is conserved once the vorticity is split off.
        ("dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1)", 9),
        // and x moves along a straight line.
        ("dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1, space_translation = 1)", 9),
        // x and phi; p and I(O) are conserved.
        ("dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1)", 12),
        ("dim = 2, kinetic(dalembert = diag(1, 2), space_translation = 1)", 4),
    ] {
        let text = expansion(args).to_string();
        assert!(text.contains(&format!("type Reduced < T : rt :: Scalar > = [T ; {state}]")), "{args}");
    }
}

/// `A/2 tr O^2 + B/2 (tr O)^2 + I/2 tr(O O^T)` as `1/2 K[nA+B][nC+D] O[A][B] O[C][D]`.
fn isotropic_tensor(n: usize, [a, b, i]: [&str; 3]) -> String {
    let entry = |row: usize, column: usize| {
        let ((p, q), (r, s)) = ((row / n, row % n), (column / n, column % n));
        let mut sum = String::from("0");
        for (holds, coefficient) in [(p == s && q == r, a), (p == q && r == s, b), (p == r && q == s, i)] {
            if holds {
                sum += &format!(" + ({coefficient})");
            }
        }
        sum
    };
    let row = |row| (0..n * n).map(|column| entry(row, column)).collect::<Vec<_>>().join(", ");
    format!("[[{}]]", (0..n * n).map(row).collect::<Vec<_>>().join("], ["))
}

/// An isotropic energy means the same whether it is written by its invariants or entry by entry: all functions
/// have the same tokens, the right-hand sides among them, but for the kinetic energy itself, whose squares stand
/// in the order in which they were written.
#[test]
fn isotropic_tensors_are_isotropic_terms() {
    let coefficients = [["0.2", "0.1", "1"], ["-3", "1/7", "2.5"], ["0", "0", "1"], ["0.5", "0", "-1/3"]];
    for n in [2, 3] {
        for [a, b, i] in coefficients {
            for frame in ["body", "space"] {
                for translation in ["", ", body_translation = 3", ", space_translation = 3"] {
                    let named = format!(
                        "dim = {n}, kinetic(casimir2 = {a}, casimir1_squared = {b}, {frame}_inertia = {i}{translation})"
                    );
                    let tensor = isotropic_tensor(n, [a, b, i]);
                    let written = format!("dim = {n}, kinetic({frame}_tensor = {tensor}{translation})");
                    let (mut named_bodies, mut written_bodies) = (bodies(&named), bodies(&written));
                    assert!(named_bodies.remove("kinetic_energy").is_some());
                    assert!(written_bodies.remove("kinetic_energy").is_some());
                    for function in ["hamilton_equations", "reduced_equations"] {
                        assert!(named_bodies[function].len() > 100, "{named}: {function} is written out");
                    }
                    assert_eq!(named_bodies, written_bodies, "{named}");
                }
            }
        }
    }
}

/// What each model costs: its state, its operations, its code. The table is reviewed like source: a feature that leaves a
/// trace in models that do not use it shows here.
#[test]
fn table_of_costs() {
    let models = [
        ("affine, n = 2", "dim = 2, kinetic(casimir2 = 0.2)"),
        ("left, n = 2", "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1)"),
        ("left, n = 3", "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1)"),
        (
            "drunk missile",
            "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)",
        ),
        (
            "its zero terms",
            "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1, \
             space_inertia = 0), potential = 0*tr(G)",
        ),
        ("free d'Alembert", "dim = 3, kinetic(dalembert = diag(1, 1.5, 2))"),
        (
            "vibrating body",
            "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), \
             potential = hyperbolic_dilatation(10) + neo_hookean(0.5)",
        ),
        (
            "elastic d'Alembert",
            "dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), potential = hyperbolic_dilatation(10) + neo_hookean(0.5)",
        ),
        (
            "rigid top",
            "dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2)), potential = 0.7*phi[3,3]",
        ),
        ("sum of frames", "dim = 2, kinetic(dalembert = 2, casimir2 = 0.2)"),
        ("cubic Hamiltonian", "dim = 3, hamiltonian(casimir2 = 1, casimir3 = 0.5)"),
        ("stretches", "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = q1^4 + q2^4"),
    ];
    let mut table = format!(
        "{:20} {:>5} {:>8} {:>5} {:>5} {:>5} {:>5} {:>6} {:>6}\n",
        "model", "state", "reduced", "mul", "add", "div", "root", "items", "lines"
    );
    for (name, args) in models {
        table += &row(name, args);
    }
    insta::with_settings!({ snapshot_path => "data" }, { insta::assert_snapshot!("costs", table) });
}

fn row(name: &str, args: &str) -> String {
    use affine_codegen::diagnostics::gate;
    use affine_codegen::{check, derive, spec};

    let spec = gate(|found| spec::parse(args.parse().unwrap(), ITEM.parse().unwrap(), found)).ok().unwrap();
    let energy = gate(|found| check::energy(&spec, found)).ok().unwrap();
    let model = derive::derive(energy, false).unwrap();
    let size =
        |equations: &derive::Equations| equations.groups.iter().map(|(_, names)| names.len()).sum::<usize>();
    let operations = model.dynamics.reduced.program.operations();
    let file: syn::File = syn::parse2(expansion(args)).unwrap();
    let text = prettyplease::unparse(&file);
    let items = text.lines().filter(|line| {
        let line = line.trim_start();
        ["fn ", "pub fn ", "impl", "pub struct ", "struct ", "type ", "const "]
            .iter()
            .any(|start| line.starts_with(start))
    });
    format!(
        "{name:20} {:>5} {:>8} {:>5} {:>5} {:>5} {:>5} {:>6} {:>6}\n",
        size(&model.dynamics.full),
        size(&model.dynamics.reduced),
        operations.mul,
        operations.add,
        operations.div,
        operations.sqrt,
        items.count(),
        text.lines().count(),
    )
}

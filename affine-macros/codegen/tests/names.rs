//! A field may be called what the derivation calls something else: its name changes nothing but the places where it stands.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use affine_codegen::expand;
use proc_macro2::{Group, Ident, Literal, TokenStream, TokenTree};

/// What no symbol is called.
const ORDINARY: [&str; 2] = ["ordinary", "usual"];

/// What symbols of the derivation, of printed formulas and of emitted code are called.
const NAMES: [[&str; 2]; 8] = [
    ["Omega", "inverse_1_1_1"],
    ["c_1", "stretch_1"],
    ["x_1", "d_phi_1_1"],
    ["sigma_hat_11", "dilatation"],
    ["coefficients", "point"],
    ["matrix_usual", "work"],
    ["k_1", "phi_11"],
    ["bases", "custom_1"],
];

/// The same beside no potential, whose notation has these.
const NAMES_OF_POTENTIALS: [[&str; 2]; 2] = [["t", "q"], ["phi", "x"]];

const KINETIC: [&str; 5] = [
    "dim = 2, kinetic(dalembert = ordinary, space_translation = usual)",
    "dim = 3, kinetic(casimir2 = ordinary, body_inertia = usual, body_translation = 1)",
    "dim = 2, kinetic(dalembert = ordinary, space_inertia = usual)",
    "dim = 2, kinetic(body_inertia = diag(ordinary, usual), casimir2 = 0.5), constraint = isochoric",
    "dim = 2, kinetic(space_inertia = ordinary, body_translation = usual), dissipation(space_translation = usual)",
];

const WITH_POTENTIALS: [&str; 5] = [
    "dim = 2, kinetic(dalembert = ordinary), potential = orthogonality(usual), emit(nystrom, tangent)",
    "dim = 3, kinetic(dalembert = 1), potential = ordinary*ln(det)^2 + usual*tr(G^2)",
    "dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = hyperbolic_dilatation(ordinary) + neo_hookean(usual)",
    "dim = 2, kinetic(body_inertia = ordinary, casimir2 = 1), potential = hyperbolic_dilatation(usual) + pairs(cos(d)), emit(splitting)",
    "dim = 2, kinetic(body_inertia = 1, space_translation = 1), potential = ordinary*exp(usual*G[1,1]) + sin(usual*t)*norm(x)^2",
];

/// Of numbers.
const NUMBERS: &str = "struct Model { ordinary: f64, usual: f64 }";

/// A matrix, an inertia of metrics, and what computes something.
const OTHERS: [[&str; 2]; 4] = [
    [
        "dim = 2, kinetic(body_inertia = usual, casimir2 = ordinary, body_translation = 1)",
        "struct Model { ordinary: f64, usual: [[f64; 2]; 2] }",
    ],
    [
        "dim = 2, kinetic(casimir2 = ordinary, body_inertia = 1), metrics(space = usual)",
        "struct Model { ordinary: f64, usual: [[f64; 2]; 2] }",
    ],
    [
        "dim = 2, kinetic(casimir2 = ordinary, body_inertia = 1), forces = custom(usual, spatial)",
        "struct Model<F: Force> { ordinary: f64, usual: F }",
    ],
    [
        "dim = 3, kinetic(casimir2 = 0.2, body_inertia = ordinary), potential = q^2 + custom(usual, isotropic)",
        "struct Model<U: Potential> { ordinary: f64, usual: U }",
    ],
];

/// The expansion with these names of the fields.
fn expansion([args, item]: [&str; 2], names: [&str; 2]) -> TokenStream {
    let [args, item] = [args, item].map(|text| renamed(text.parse().unwrap(), names));
    expand(args, item)
}

/// The tokens with the ordinary names replaced, also within longer ones.
fn renamed(tokens: TokenStream, names: [&str; 2]) -> TokenStream {
    let replaced = |text: String| {
        let pairs = ORDINARY.iter().zip(names);
        pairs.fold(text, |text, (ordinary, name)| text.replace(ordinary, name))
    };
    let tree = |tree: TokenTree| match tree {
        TokenTree::Group(group) => Group::new(group.delimiter(), renamed(group.stream(), names)).into(),
        TokenTree::Ident(ident) => Ident::new(&replaced(ident.to_string()), ident.span()).into(),
        TokenTree::Literal(literal) => said(&literal.to_string(), &replaced).unwrap_or(literal).into(),
        punct @ TokenTree::Punct(_) => punct,
    };
    tokens.into_iter().map(tree).collect()
}

/// What a literal says: texts call a field by its name, or by `self` and its name where a symbol is written so. LaTeX has
/// letters for some names and none for others.
fn said(literal: &str, replaced: &impl Fn(String) -> String) -> Option<Literal> {
    let text = literal.strip_prefix('"')?.strip_suffix('"')?;
    let shown = if text.contains('\\') { String::new() } else { replaced(text.replace("self.", "")) };
    Some(Literal::string(&shown))
}

fn change_nothing(specifications: &[[&str; 2]], names: &[[&str; 2]]) {
    for specification in specifications {
        let [args, _] = specification;
        let ordinary = expansion(*specification, ORDINARY);
        assert!(!ordinary.to_string().contains("compile_error"), "{args} is refused");
        for names in names {
            let (found, expected) =
                (renamed(expansion(*specification, *names), *names), renamed(ordinary.clone(), *names));
            let (found, expected) = (found.to_string(), expected.to_string());
            let place = found.bytes().zip(expected.bytes()).take_while(|(a, b)| a == b).count();
            let around =
                |text: &str| text.chars().skip(place.saturating_sub(120)).take(240).collect::<String>();
            assert!(found == expected, "{args}, {names:?}:\n{}\n{}", around(&found), around(&expected));
        }
    }
}

#[test]
fn names_of_fields_change_nothing() {
    let kinetic = KINETIC.map(|args| [args, NUMBERS]);
    change_nothing(&kinetic, &NAMES);
    change_nothing(&kinetic, &NAMES_OF_POTENTIALS);
}

#[test]
fn names_of_fields_of_potentials_change_nothing() {
    change_nothing(&WITH_POTENTIALS.map(|args| [args, NUMBERS]), &NAMES);
}

#[test]
fn names_of_matrices_and_of_what_computes_change_nothing() {
    change_nothing(&OTHERS, &NAMES);
}

/// Rooms that know what things are, and need not look at what they are called.
const TYPED: [&str; 6] = ["algebra", "ir", "optimise", "mechanics", "derive", "emit"];

/// How code looks at text.
const LOOKS: [&str; 17] = [
    "strip_prefix(",
    "strip_suffix(",
    "starts_with(",
    ".ends_with(",
    "split_once(",
    "rsplit(",
    ".split(",
    ".trim_",
    ".replace('",
    ".replace(\"",
    ".chars()",
    ".contains(\"",
    ".contains('",
    ".contains(&format!",
    "== \"",
    "!= \"",
    "== format!",
];

/// Where text is read or made: literals of the user and the notation of numbers, names of the user's fields, names of files, and
/// what identifiers are made of.
const TEXTS: [&str; 10] = [
    "algebra/rational.rs",
    "algebra/rational/rounded.rs",
    "algebra/text.rs",
    "algebra/fault.rs",
    "mechanics/notation/field.rs",
    "mechanics/notation/formula/latex.rs",
    "mechanics/notation/latex.rs",
    "mechanics/notation/symbols.rs",
    "ir/naming.rs",
    "emit/fields.rs",
];

fn files(folder: &Path, list: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { files(&path, list) } else { list.push(path) }
    }
}

/// The looks at text in a source, comments apart.
fn looks(source: &str) -> Vec<&str> {
    let lines = source.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.filter(|line| LOOKS.iter().any(|look| line.contains(look))).collect()
}

#[test]
fn no_pass_decides_by_text() {
    assert_eq!(looks("a.strip_prefix(\"c_\")\n// name == \"d\"\nname == \"d\"").len(), 2);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut sources = Vec::new();
    files(&root, &mut sources);
    let (mut found, mut read) = (Vec::new(), 0);
    for path in sources {
        let file = path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/");
        let room = file.split('/').next().unwrap().trim_end_matches(".rs");
        if !TYPED.contains(&room) {
            continue;
        }
        read += 1;
        let source = std::fs::read_to_string(&path).unwrap();
        let looks = looks(&source);
        assert!(!TEXTS.contains(&file.as_str()) || !looks.is_empty(), "{file} looks at no text any more");
        if !TEXTS.contains(&file.as_str()) {
            found.extend(looks.iter().map(|line| format!("{file}: {}", line.trim())));
        }
    }
    assert!(read > 200, "{read} files of rooms that are checked");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

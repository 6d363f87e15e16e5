//! The formulas of the derivation as a mathematician reads them: every LaTeX string parses, and every name is a field of
//! the model or a symbol of the mechanics.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;
use std::sync::LazyLock;

use affine_codegen::mechanics::notation::{SYMBOLS, is_symbol};
use affine_codegen::{expand, expand_for_reports};
use affine_tests::specimens::{BY_EQUATIONS, IN_FULL};
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use pulldown_latex::{Parser, Storage};

/// The formulas of a model, in the order of its description: groups of one, of `T` and `H`, and of several, of equations.
struct Described {
    name: String,
    fields: BTreeSet<String>,
    formulas: Vec<(String, String)>,
}

impl Described {
    fn new(name: &str, tokens: TokenStream) -> Self {
        let mut formulas = Vec::new();
        collect(tokens.clone(), &mut formulas);
        assert!(!formulas.is_empty(), "{name} has no formulas");
        let file: syn::File = syn::parse2(tokens).expect("a list of items");
        let fields = file.items.iter().find_map(|item| match item {
            syn::Item::Struct(item) => Some(item.fields.iter().filter_map(|field| field.ident.clone())),
            _ => None,
        });
        let fields = fields.into_iter().flatten().map(|field| field.to_string().replace("r#", "")).collect();
        Self { name: name.to_owned(), fields, formulas }
    }

    fn derived(args: &str, item: &str) -> Self {
        let tokens = expand_for_reports(args.parse().unwrap(), item.parse().unwrap());
        // What stands in for a refused model has formulas, too.
        assert!(!tokens.to_string().contains("compile_error"), "{args}: {tokens}");
        Self::new(args, tokens)
    }

    fn texts(&self) -> impl Iterator<Item = &str> {
        self.formulas.iter().map(|(text, _)| text.as_str())
    }

    /// The formula that begins with this.
    fn latex_of(&self, text: &str) -> &str {
        let found = self.formulas.iter().find(|(known, _)| known == text);
        &found.unwrap_or_else(|| panic!("no `{text}` in {:#?}", self.texts().collect::<Vec<_>>())).1
    }
}

/// Every `Formula { text: ..., latex: ... }`.
fn collect(tokens: TokenStream, formulas: &mut Vec<(String, String)>) {
    let mut last = String::new();
    for token in tokens {
        if let TokenTree::Group(group) = &token {
            if last == "Formula" && group.delimiter() == Delimiter::Brace {
                let [text, latex] = literals(group.stream()).try_into().expect("a text and a LaTeX string");
                formulas.push((text, latex));
            } else {
                collect(group.stream(), formulas);
            }
        }
        last = token.to_string();
    }
}

/// The strings of some tokens.
fn literals(tokens: TokenStream) -> Vec<String> {
    let strings = |token| match token {
        TokenTree::Group(group) => literals(group.stream()),
        TokenTree::Literal(literal) => {
            vec![syn::parse_str::<syn::LitStr>(&literal.to_string()).expect("a string").value()]
        }
        _ => Vec::new(),
    };
    tokens.into_iter().flat_map(strings).collect()
}

/// The models of all snapshots.
fn snapshots() -> Vec<Described> {
    let specimens = [IN_FULL, BY_EQUATIONS].concat();
    specimens.iter().map(|model| Described::derived(model.args, &model.item())).collect()
}

/// Models with names that are easily taken for something else.
fn hostile() -> Vec<Described> {
    let numbers = "pub struct Named { Omega: f64, phi: f64, inverse_1_1_1: f64, x_dot: f64, alpha_1: f64, kappa2: f64 }";
    let matrix = |name: &str, size: usize| format!("pub struct Named {{ {name}: [[f64; {size}]; {size}] }}");
    let mut list = vec![
        Described::derived(
            "dim = 2, kinetic(casimir2 = Omega, casimir1_squared = phi, body_inertia = inverse_1_1_1, \
             body_translation = x_dot), dissipation(casimir1_squared = alpha_1, body_inertia = kappa2)",
            numbers,
        ),
        Described::derived(
            "dim = 2, kinetic(body_inertia = [[alpha_1, Omega], [Omega, kappa2]], space_translation = x_dot)",
            numbers,
        ),
        Described::derived(
            "dim = 3, kinetic(casimir2 = k1, body_inertia = diag(m, 2*m, 3)), \
             potential = w*sin(e_1*t) + f*tr(G)^2 + r#type*phi[1,2]*det + größe*tr(G*G)",
            "pub struct Named { k1: f64, m: f64, w: f64, e_1: f64, f: f64, r#type: f64, größe: f64 }",
        ),
    ];
    for name in ["Omega", "phi", "inverse_1_1_1", "x_dot", "alpha_1", "kappa2", "e", "p", "k", "j_2"] {
        // Beside a potential no field has the name of what potentials read.
        let potential = if name == "phi" { "" } else { ", potential = phi[1,2]" };
        let kinetic = [
            (format!("dim = 2, kinetic(body_inertia = {name})"), 2),
            (format!("dim = 2, kinetic(casimir2 = 0.2, space_inertia = {name}, space_translation = 2)"), 2),
            (format!("dim = 3, kinetic(dalembert = {name}), dissipation(space_inertia = {name})"), 3),
            (format!("dim = 2, kinetic(body_tensor = {name})"), 4),
            (format!("dim = 2, metrics(body = {name}), kinetic(dalembert = {name}){potential}"), 2),
        ];
        list.extend(kinetic.iter().map(|(args, size)| Described::derived(args, &matrix(name, *size))));
    }
    list
}

/// Every matrix and every kind of force in one model, fields and numbers side by side.
fn composed() -> Vec<Described> {
    let bases = "pub struct Named { g: [[f64; 2]; 2], eta: [[f64; 2]; 2], a: f64, k: [[f64; 4]; 4] }";
    vec![
        Described::derived(
            "dim = 2, kinetic(casimir2 = 0.2, body_inertia = diag(1, 2), space_inertia = [[2, a], [a, 3]], \
             body_translation = a, space_translation = 2), dissipation(dalembert = diag(1, a), space_inertia = diag(2, 1))",
            "pub struct Named { a: f64 }",
        ),
        Described::derived(
            "dim = 2, metrics(space = g, body = eta), kinetic(dalembert = diag(a, 1), flat_tensor = k), \
             dissipation(space_tensor = k), potential = phi[1,2]^2 + G[1,1]",
            bases,
        ),
        Described::derived(
            "dim = 2, kinetic(space_tensor = [[2, a, 0, 0], [a, 3, 0, 0], [0, 0, 2, a], [0, 0, a, 4]])",
            "pub struct Named { a: f64 }",
        ),
    ]
}

fn all() -> &'static [Described] {
    static ALL: LazyLock<Vec<Described>> =
        LazyLock::new(|| [snapshots(), hostile(), composed()].into_iter().flatten().collect());
    &ALL
}

#[test]
fn latex_stands_where_it_is_asked_for() {
    let args = |emitted: &str| {
        format!("dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), emit(two_polar{emitted})")
    };
    let has_latex = |expansion: fn(TokenStream, TokenStream) -> TokenStream, emitted: &str| {
        let tokens = expansion(args(emitted).parse().unwrap(), "struct Body;".parse().unwrap());
        tokens.to_string().contains("latex")
    };
    assert!(!has_latex(expand, ""));
    assert!(has_latex(expand, ", latex"));
    assert!(has_latex(expand_for_reports, ""));
}

#[test]
fn every_latex_string_parses() {
    let mut invalid = Vec::new();
    for model in all() {
        for (_, latex) in &model.formulas {
            let storage = Storage::new();
            if let Some(Err(error)) = Parser::new(latex, &storage).find(Result::is_err) {
                invalid.push(format!("{}: {latex}\n{error}", model.name));
            }
        }
    }
    assert!(invalid.is_empty(), "{} invalid formulas:\n{}", invalid.len(), invalid.join("\n"));
}

/// Words between formulas.
const WORDS: [&str; 12] =
    ["at", "rest", "solved", "for", "in", "the", "given", "bases", "with", "multiplier", "d", "C"];

/// Runs of letters, digits and `_` that begin with a letter; a field that is told from a symbol keeps its `self.`.
fn words(text: &str) -> Vec<String> {
    let runs = text.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.'));
    let parts = runs.flat_map(|run| match run.starts_with("self.") {
        true => vec![run],
        false => run.split('.').collect(),
    });
    parts.filter(|word| word.starts_with(char::is_alphabetic)).map(str::to_owned).collect()
}

#[test]
fn texts_name_symbols_and_fields_alone() {
    let mut unknown = BTreeSet::new();
    for model in all() {
        // A field that is written like a symbol stands as `self.name`.
        let is_known = |word: &str| match word.strip_prefix("self.") {
            Some(field) => model.fields.contains(field) && is_symbol(field),
            None => is_symbol(word) || model.fields.contains(word) || WORDS.contains(&word),
        };
        for text in model.texts() {
            let strange = words(text).into_iter().filter(|word| !is_known(word));
            unknown.extend(strange.map(|word| format!("{word} in {}: {text}", model.name)));
        }
    }
    assert!(unknown.is_empty(), "{}", unknown.into_iter().collect::<Vec<_>>().join("\n"));
}

/// LaTeX that sets a formula and names nothing.
const SETTING: [&str; 20] = [
    "frac",
    "left",
    "right",
    "sqrt",
    "partial",
    "cdot",
    "tfrac",
    "operatorname",
    "mathrm",
    "text",
    "quad",
    "begin",
    "end",
    "exp",
    "ln",
    "sin",
    "cos",
    "tan",
    "sinh",
    "cosh",
];

/// Names in LaTeX: commands, words in a font, letters.
fn latex_names(latex: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut rest = latex;
    while let Some(first) = rest.chars().next() {
        if let Some(after) = rest.strip_prefix('\\') {
            let length = after.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(after.len());
            let (command, tail) = after.split_at(length);
            if command.is_empty() {
                rest = &after[after.chars().next().map_or(0, char::len_utf8)..];
                continue;
            }
            let in_font =
                ["mathit", "mathtt", "mathrm", "operatorname", "text", "begin", "end"].contains(&command);
            let argument = tail.strip_prefix('{').and_then(|tail| tail.split_once('}')).filter(|_| in_font);
            match argument {
                Some((word, tail)) => {
                    names.push(format!("{command} {}", word.replace("\\_", "_")));
                    rest = tail;
                }
                None => {
                    names.push(format!("\\{command}"));
                    rest = tail;
                }
            }
        } else {
            if first.is_alphabetic() {
                names.push(first.to_string());
            }
            rest = &rest[first.len_utf8()..];
        }
    }
    names
}

#[test]
fn latex_names_symbols_and_fields_alone() {
    let symbols: BTreeSet<String> = SYMBOLS.iter().flat_map(|symbol| latex_names(symbol.latex)).collect();
    let mut unknown = BTreeSet::new();
    for model in all() {
        // What a field may be written as: itself, or without its digit and `_`.
        let stems: BTreeSet<String> = model
            .fields
            .iter()
            .flat_map(|field| {
                let stem = field.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('_');
                [field.clone(), stem.to_owned()]
            })
            .collect();
        let is_known = |name: &str| match name.split_once(' ') {
            Some(("mathit", word)) => stems.contains(word),
            Some(("mathtt", word)) => model.fields.contains(word),
            Some(("operatorname", "tr" | "diag") | ("begin" | "end", "pmatrix") | ("text", _)) => true,
            Some(_) => symbols.contains(name),
            None => match name.strip_prefix('\\') {
                Some(command) => {
                    symbols.contains(name)
                        || stems.contains(command)
                        || SETTING.contains(&command)
                        || command == "tanh"
                }
                None => symbols.contains(name) || stems.contains(name) || ["a", "C", "d"].contains(&name),
            },
        };
        for (_, latex) in &model.formulas {
            let strange = latex_names(latex).into_iter().filter(|name| !is_known(name));
            unknown.extend(strange.map(|name| format!("{name} in {}: {latex}", model.name)));
        }
    }
    assert!(unknown.is_empty(), "{}", unknown.into_iter().collect::<Vec<_>>().join("\n"));
}

/// Matrices without a field, and all that the reduced equations abbreviate, are told what they are.
#[test]
fn nothing_is_left_undefined() {
    let abbreviations = [
        "beta_",
        "tau_",
        "cof_",
        "d_",
        "L_",
        "u_",
        "y_",
        "z_",
        "O_",
        "Psi_",
        "Q_R_",
        "Q_hat_R_",
        "N_R_",
        "N_flat_",
        "F_R_",
        "phi_inverse_",
        "v_hat_",
        "p_hat_",
        "p_body_",
        "omega_",
        "omega_hat_",
        "J",
        "K",
        "Gamma",
    ];
    let mut undefined = BTreeSet::new();
    for model in all() {
        let mut defined: BTreeSet<String> = BTreeSet::new();
        for part in model.texts().flat_map(|text| text.split(", ")) {
            let Some((left, _)) = part.split_once(" = ") else { continue };
            // A rate defines what it is the rate of.
            defined.extend(words(left).into_iter().flat_map(|word| match word.strip_prefix('d') {
                Some(of) if left.ends_with("/dt") => vec![of.to_owned(), word],
                _ => vec![word],
            }));
        }
        for text in model.texts() {
            for word in words(text).into_iter().filter(|word| !model.fields.contains(word)) {
                let abbreviates = abbreviations.iter().any(|stem| match stem.strip_suffix('_') {
                    Some(_) => word.strip_prefix(stem).is_some_and(|index| index.parse::<u32>().is_ok()),
                    None => {
                        word == *stem || word.strip_prefix(stem).is_some_and(|rest| rest.starts_with('_'))
                    }
                });
                if abbreviates && !defined.contains(&word) {
                    undefined.insert(format!("{word} in {}: {text}", model.name));
                }
            }
        }
    }
    assert!(undefined.is_empty(), "{}", undefined.into_iter().collect::<Vec<_>>().join("\n"));
}

/// No two symbols are written alike, in text or in LaTeX.
#[test]
fn symbols_are_told_apart() {
    for (k, symbol) in SYMBOLS.iter().enumerate() {
        for other in &SYMBOLS[k + 1..] {
            assert_ne!(symbol.text, other.text, "{} and {}", symbol.meaning, other.meaning);
            assert_ne!(symbol.latex, other.latex, "{} and {}", symbol.meaning, other.meaning);
        }
    }
}

/// Fields keep their names, and the inverse of a matrix is written as one.
#[test]
fn fields_are_called_what_the_user_called_them() {
    let matrix = "pub struct Named { j: [[f64; 2]; 2], k: [[f64; 4]; 4] }";
    let model =
        Described::derived("dim = 2, kinetic(body_inertia = j), dissipation(space_tensor = k)", matrix);
    let expected = [
        (
            "T = 1/2 tr(Omega_hat j Omega_hat^T)",
            r"T = \operatorname{tr}\left(\hat\Omega j \hat\Omega^T\right)",
        ),
        (
            "H = 1/2 tr(Sigma_hat^T j^-1 Sigma_hat)",
            r"H = \operatorname{tr}\left(\hat\Sigma^T j^{-1} \hat\Sigma\right)",
        ),
        ("Omega_hat = Sigma_hat^T j^-1", r"\hat\Omega = \hat\Sigma^T j^{-1}"),
        ("R = 1/2 k[(A,B),(C,D)] Omega[A,B] Omega[C,D]", r"R = k_{(AB)(CD)} \Omega_{AB} \Omega_{CD}"),
        (
            "Q_R_11 = -k[1,1]*omega_11 - k[1,2]*omega_12 - k[1,3]*omega_21 - k[1,4]*omega_22",
            r"Q_{R,11} = - k_{11} \Omega_{11} - k_{12} \Omega_{12} - k_{13} \Omega_{21} - k_{14} \Omega_{22}",
        ),
    ];
    for (text, latex) in expected {
        assert_eq!(model.latex_of(text).replace(r"\frac{1}{2}\, ", ""), latex);
    }
}

/// The energy of an inertia is known by itself, wherever its term stands in a sum of frames.
#[test]
fn an_inertia_is_written_whole_beside_terms_of_other_frames() {
    let terms = ["body_translation = 1", "body_inertia = j", "space_translation = 2"];
    for first in 0..terms.len() {
        let (last, start) = (&terms[..first], &terms[first..]);
        let kinetic = [start, last].concat().join(", ");
        let specification = format!("dim = 2, require(positive_definite), kinetic({kinetic})");
        let model = Described::derived(&specification, "pub struct Named { j: [[f64; 2]; 2] }");
        let inertia = "H = 1/2 tr(Sigma_hat^T j^-1 Sigma_hat)";
        assert!(model.texts().any(|text| text.starts_with(inertia)), "{kinetic}: {:#?}", model.formulas);
    }
}

/// What is written like a symbol is told from it; Greek letters and digits are set as such.
#[test]
fn hostile_names() {
    let item = "pub struct Named { Omega: f64, phi: f64, inverse_1_1_1: f64, x_dot: f64, alpha_1: f64, kappa2: f64 }";
    let model = Described::derived(
        "dim = 2, kinetic(casimir2 = Omega, casimir1_squared = phi, body_inertia = inverse_1_1_1, \
         body_translation = x_dot), dissipation(casimir1_squared = alpha_1, body_inertia = kappa2)",
        item,
    );
    let kinetic = "T = 1/2*self.Omega tr(Omega_hat^2) + 1/2*self.phi (tr Omega_hat)^2 \
                   + 1/2*inverse_1_1_1 tr(Omega_hat Omega_hat^T) + 1/2*x_dot |phi^-1 dx/dt|^2";
    assert_eq!(
        model.latex_of(kinetic).replace(r"\frac{1}{2}\,", ""),
        r"T = \mathtt{Omega}\, \operatorname{tr}\hat\Omega^2 + \mathtt{phi}\, \left(\operatorname{tr}\hat\Omega\right)^2 + \mathit{inverse\_1\_1\_1}\, \operatorname{tr}\left(\hat\Omega \hat\Omega^T\right) + \mathit{x\_dot}\, |\varphi^{-1} \dot{x}|^2"
    );
    let friction = "R = 1/2*alpha_1 (tr Omega_hat)^2 + 1/2*kappa2 tr(Omega_hat Omega_hat^T)";
    assert_eq!(
        model.latex_of(friction).replace(r"\frac{1}{2}\,", ""),
        r"R = \alpha_{1}\, \left(\operatorname{tr}\hat\Omega\right)^2 + \kappa_{2}\, \operatorname{tr}\left(\hat\Omega \hat\Omega^T\right)"
    );
    // An index is set at a name that has one already.
    let inertia = Described::derived(
        "dim = 2, kinetic(casimir2 = 0.2, body_inertia = alpha_1), dissipation(body_tensor = kappa2)",
        "pub struct Named { alpha_1: [[f64; 2]; 2], kappa2: [[f64; 4]; 4] }",
    );
    let drag = "Q_hat_R_11 = -omega_hat_11*kappa2[1,1] - omega_hat_12*kappa2[1,2] - omega_hat_21*kappa2[1,3] \
                - omega_hat_22*kappa2[1,4]";
    assert!(inertia.latex_of(drag).starts_with(r"\hat Q_{R,11} = - \hat\Omega_{11} (\kappa_{2})_{11}"));
}

/// What is negative in a potential is subtracted from the kinetic energy; a sum under a sign keeps its brackets.
#[test]
fn potentials_stand_with_their_signs() {
    let hamiltonian = |potential: &str| {
        let args = format!("dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = {potential}");
        let model = Described::derived(&args, "pub struct Named { g: f64 }");
        let text = model.texts().find_map(|text| text.strip_prefix("H = 1/2 tr(Pi^T Pi) + 1/2 |p|^2 "));
        text.expect("the Hamiltonian").to_owned()
    };
    assert_eq!(hamiltonian("-g*x[2]"), "- g*x_2");
    assert_eq!(hamiltonian("x[1]^2/2 - g*x[2] - 1"), "+ 1/2*x_1^2 - g*x_2 - 1");
    assert_eq!(hamiltonian("-2*(tr(G) - 2)^2"), "- 2*(tr(G) - 2)^2");
    assert_eq!(hamiltonian("-(x[1]^2 + x[2])^2"), "- (x_1^2 + x_2)^2");
}

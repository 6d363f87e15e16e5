//! The names of fields: as the user wrote them, but where a symbol of the mechanics is written so.

use super::matrix_name::MatrixName;
use super::symbols::{is_letter, is_symbol};
use crate::algebra::text::Written;
use crate::algebra::{Arena, Expr};
use crate::symbol::Symbol;

/// Names of letters that LaTeX has as commands.
const GREEK: [&str; 34] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu",
    "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega", "Gamma", "Delta",
    "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi", "Omega",
];

/// Text and LaTeX of a field that is a number.
pub(super) fn number(field: &str) -> [Written; 2] {
    [Written::letter(text(field)), Written::letter(latex(field, false).0)]
}

/// The same of a field that is a matrix.
pub(super) fn matrix(field: &str) -> MatrixName {
    let (latex, letter) = latex(field, true);
    MatrixName { text: text(field), latex, letter }
}

/// Text and LaTeX of a field as an index.
pub(in crate::mechanics) fn index(field: &str) -> [String; 2] {
    [bare(field).to_owned(), latex(field, false).0]
}

/// As text. What a symbol is written like stands as in Rust.
fn text(field: &str) -> String {
    let name = bare(field);
    if is_symbol(name) { format!("self.{name}") } else { name.to_owned() }
}

/// As LaTeX: letters as letters, with a digit for an index, words in italics, what a symbol is written like in
/// typewriter; and whether it has no index, so that one can be set.
fn latex(field: &str, entries: bool) -> (String, bool) {
    let name = bare(field);
    let (word, digit) = indexed(name);
    let mut first = word.chars();
    let letter = match (GREEK.contains(&word), first.next(), first.next()) {
        (true, ..) => Some(format!("\\{word}")),
        (false, Some(only), None) => Some(only.to_string()),
        _ => None,
    };
    let hides = letter.as_ref().is_some_and(|letter| is_letter(letter, entries || digit.is_some()));
    if hides || is_symbol(name) {
        return (typewriter(name), true);
    }
    let body = letter.unwrap_or_else(|| format!("\\mathit{{{}}}", escaped(word)));
    match digit {
        None => (body, true),
        Some(digit) => (format!("{body}_{{{digit}}}"), false),
    }
}

/// A name of the program.
pub(super) fn typewriter(name: &str) -> String {
    format!("\\mathtt{{{}}}", escaped(name))
}

/// The name without the mark of a raw identifier.
fn bare(field: &str) -> &str {
    field.strip_prefix("r#").unwrap_or(field)
}

fn escaped(name: &str) -> String {
    name.replace('_', "\\_")
}

/// A word of letters and the digit behind it, `kappa2` or `kappa_2`; everything else as it stands.
fn indexed(name: &str) -> (&str, Option<&str>) {
    let last = name.chars().last().filter(char::is_ascii_digit);
    let word =
        last.and_then(|_| name.get(..name.len() - 1)).map(|word| word.strip_suffix('_').unwrap_or(word));
    match word {
        Some(word) if !word.is_empty() && word.chars().all(char::is_alphabetic) => {
            (word, name.get(name.len() - 1..))
        }
        _ => (name, None),
    }
}

/// The field of which all these are the entries.
pub(super) fn field_of<'a>(arena: &'a Arena, rows: &[Vec<Expr>]) -> Option<&'a str> {
    let of = |e: &Expr| match arena.as_symbol(*e) {
        Some(Symbol::Entry(field, ..)) => Some(field.as_str()),
        _ => None,
    };
    let field = of(rows.first()?.first()?)?;
    rows.iter().flatten().all(|entry| of(entry) == Some(field)).then_some(field)
}

//! Expressions in text and LaTeX.

use crate::algebra::arena::Node;
use crate::algebra::{Arena, Expr, Function, Rational};

/// Text of an expression; fields keep their names, tensors and their traces get those of the specification.
pub(super) fn plain(arena: &Arena, expr: Expr) -> String {
    const NAMES: [(&str, &str); 10] = [
        ("trace_1", "tr(G)"),
        ("trace_2", "tr(G^2)"),
        ("green_", "G_"),
        ("finger_", "Ct_"),
        ("psi_", "Psi_"),
        ("shear_", "s_"),
        ("turn_", "w_"),
        ("isochoric_", "O_"),
        ("inverse_square", "D^-2"),
        ("square", "D^2"),
    ];
    // A field may have any of these names: only what is none is renamed.
    let parts = arena.text(expr);
    let mut written = String::with_capacity(parts.len());
    for part in parts.split_inclusive(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.')) {
        written += &match part.strip_prefix("self.") {
            Some(field) if is_number(field) => format!("J{field}"),
            Some(field) => field.to_owned(),
            None => match NAMES.iter().find(|(symbol, _)| part.starts_with(symbol)) {
                Some((symbol, name)) => format!("{name}{}", &part[symbol.len()..]),
                None => part.to_owned(),
            },
        };
    }
    written
}

/// LaTeX of an expression.
pub(super) fn latex(arena: &Arena, expr: Expr) -> String {
    match arena.node(expr) {
        Node::Constant(value) => number_latex(value),
        Node::Symbol(name) => symbol_latex(name),
        Node::Function(Function::Sqrt, argument) => format!("\\sqrt{{{}}}", latex(arena, *argument)),
        Node::Function(Function::Cbrt, argument) => format!("\\sqrt[3]{{{}}}", latex(arena, *argument)),
        Node::Function(Function::InverseCbrt, argument) => {
            format!("\\left({}\\right)^{{-1/3}}", latex(arena, *argument))
        }
        Node::Function(Function::Abs, argument) => format!("\\left|{}\\right|", latex(arena, *argument)),
        Node::Function(function, argument) => {
            format!("\\{}\\left({}\\right)", function.name(), latex(arena, *argument))
        }
        Node::Sum(constant, terms) => {
            let mut text = String::new();
            for (term, c) in terms {
                let sign = if c.is_negative() {
                    "-"
                } else if text.is_empty() {
                    ""
                } else {
                    "+"
                };
                let size = c.abs();
                let number =
                    if size.is_one() { String::new() } else { format!("{}\\,", number_latex(&size)) };
                let body = match arena.node(*term) {
                    Node::Sum(..) => format!("\\left({}\\right)", latex(arena, *term)),
                    _ => latex(arena, *term),
                };
                let space = if text.is_empty() { "" } else { " " };
                text += &format!("{space}{sign} {number}{body}");
            }
            if !constant.is_zero() {
                let sign = if constant.is_negative() { "-" } else { "+" };
                text += &format!(" {sign} {}", number_latex(&constant.abs()));
            }
            text.trim_start().to_owned()
        }
        Node::Product(factors) => {
            let body = |base: Expr, power: u32| {
                let inner = latex(arena, base);
                let inner = match arena.node(base) {
                    Node::Sum(..) => format!("\\left({inner}\\right)"),
                    _ => inner,
                };
                if power == 1 { inner } else { format!("{inner}^{{{power}}}") }
            };
            let side = |positive: bool| -> Vec<String> {
                factors
                    .iter()
                    .filter(|(_, e)| (*e > 0) == positive)
                    .map(|(b, e)| body(*b, e.unsigned_abs()))
                    .collect()
            };
            let (above, below) = (side(true), side(false));
            match below.is_empty() {
                true => above.join(" "),
                false => {
                    let above = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
                    format!("\\frac{{{above}}}{{{}}}", below.join(" "))
                }
            }
        }
    }
}

fn number_latex(value: &Rational) -> String {
    let text = value.shown();
    match text.split_once('/') {
        Some((above, below)) => match above.strip_prefix('-') {
            Some(above) => format!("-\\frac{{{above}}}{{{below}}}"),
            None => format!("\\frac{{{above}}}{{{below}}}"),
        },
        None => text,
    }
}

/// Field, row and column of the symbol of an entry of a field of matrix type.
pub(super) fn matrix_field(symbol: &str) -> Option<(&str, &str, &str)> {
    let (field, places) = symbol.strip_prefix("self.")?.strip_suffix(']')?.split_once('[')?;
    let (row, column) = places.split_once(',')?;
    Some((field, row, column))
}

/// Is it the name of no field, but of a matrix in orthonormal bases?
pub(super) fn is_number(field: &str) -> bool {
    field.starts_with(|c: char| c.is_ascii_digit())
}

/// The name of a field in LaTeX.
pub(super) fn field_latex(field: &str) -> String {
    if is_number(field) {
        return format!("J_{{{field}}}");
    }
    format!("\\mathit{{{}}}", field.replace('_', "\\_"))
}

/// `sigma_hat_12` becomes `\hat\Sigma_{12}`; a field keeps its name.
fn symbol_latex(name: &str) -> String {
    if let Some((field, row, column)) = matrix_field(name) {
        return format!("{}_{{{row}{column}}}", field_latex(field));
    }
    if let Some(field) = name.strip_prefix("self.") {
        return field_latex(field);
    }
    let whole = [
        ("q", "q"),
        ("trace_1", "\\operatorname{tr}G"),
        ("trace_2", "\\operatorname{tr}G^2"),
        ("det", "\\Delta"),
        ("dilatation", "D"),
        ("inverse_dilatation", "r"),
        ("inverse_det", "\\delta"),
        ("square", "D^2"),
        ("inverse_square", "D^{-2}"),
        ("work", "W"),
    ];
    if let Some((_, latex)) = whole.iter().find(|(known, _)| *known == name) {
        return (*latex).to_owned();
    }
    let stems = [
        ("psi_", "\\Psi"),
        ("shear_", "s"),
        ("turn_", "w"),
        ("isochoric_", "O"),
        ("sigma_hat_sym_", "\\hat\\Sigma^{s}"),
        ("sigma_sym_", "\\Sigma^{s}"),
        ("total_sym_", "I^{s}"),
        ("sigma_hat_skew_", "\\hat\\Sigma^{w}"),
        ("sigma_skew_", "\\Sigma^{w}"),
        ("total_skew_", "I^{w}"),
        ("sigma_hat_", "\\hat\\Sigma"),
        ("sigma_", "\\Sigma"),
        ("total_", "I"),
        ("pi_", "\\Pi"),
        ("green_", "G"),
        ("finger_", "\\tilde C"),
        ("phi_dot_", "\\dot\\varphi"),
        ("phi_inverse_", "\\varphi^{-1}"),
        ("drag_hat_", "\\hat Q"),
        ("drag_flat_", "N"),
        ("drag_centre_", "F"),
        ("drag_", "Q"),
        ("push_", "N'"),
        ("v_hat_", "\\hat v"),
        ("velocity_", "\\dot\\varphi"),
        ("phi_", "\\varphi"),
        ("omega_hat_", "\\hat\\Omega"),
        ("omega_", "\\Omega"),
        ("p_hat_", "\\hat p"),
        ("p_", "p"),
        ("x_", "x"),
        ("q_", "q"),
        ("stretch_", "Q"),
        ("m_", "M"),
        ("n_", "N"),
        ("k_", "k"),
        ("c_", "c"),
    ];
    stems
        .iter()
        .find_map(|(stem, latex)| name.strip_prefix(stem).map(|index| format!("{latex}_{{{index}}}")))
        .unwrap_or_else(|| format!("\\mathtt{{{}}}", name.replace('_', "\\_")))
}

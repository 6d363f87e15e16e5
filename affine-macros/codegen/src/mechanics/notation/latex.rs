//! Expressions in LaTeX.

use crate::algebra::arena::Node;
use crate::algebra::text::Written;
use crate::algebra::{Arena, Expr, Function, Rational};

/// An expression with these names for its symbols.
pub(super) fn latex(arena: &Arena, expr: Expr, name: &dyn Fn(Expr) -> Written) -> String {
    match arena.node(expr) {
        Node::Constant(value) => number(value),
        Node::Symbol(_) => name(expr).body,
        Node::Function(function, argument) => applied(*function, &latex(arena, *argument, name)),
        Node::Sum(constant, terms) => sum(arena, constant, terms, name),
        Node::Product(factors) => product(arena, factors, name),
    }
}

pub(super) fn bracketed(body: &str) -> String {
    format!("\\left({body}\\right)")
}

fn applied(function: Function, argument: &str) -> String {
    match function {
        Function::Sqrt => format!("\\sqrt{{{argument}}}"),
        Function::Cbrt => format!("\\sqrt[3]{{{argument}}}"),
        Function::InverseCbrt => format!("\\frac{{1}}{{\\sqrt[3]{{{argument}}}}}"),
        Function::Asinh => format!("\\operatorname{{arsinh}}{}", bracketed(argument)),
        Function::ExpM1 => bracketed(&format!("\\exp{} - 1", bracketed(argument))),
        Function::Abs => format!("\\left|{argument}\\right|"),
        Function::Sign => format!("\\operatorname{{sgn}}{}", bracketed(argument)),
        _ => format!("\\{}{}", function.name(), bracketed(argument)),
    }
}

fn sum(
    arena: &Arena,
    constant: &Rational,
    terms: &[(Expr, Rational)],
    name: &dyn Fn(Expr) -> Written,
) -> String {
    let mut text = String::new();
    for (term, c) in terms {
        let sign = match (c.is_negative(), text.is_empty()) {
            (true, true) => "- ",
            (true, false) => " - ",
            (false, true) => "",
            (false, false) => " + ",
        };
        let size = c.abs();
        let factor = if size.is_one() { String::new() } else { format!("{}\\,", number(&size)) };
        let body = latex(arena, *term, name);
        let body = if matches!(arena.node(*term), Node::Sum(..)) { bracketed(&body) } else { body };
        text += &format!("{sign}{factor}{body}");
    }
    if !constant.is_zero() {
        let sign = if constant.is_negative() { "-" } else { "+" };
        text += &format!(" {sign} {}", number(&constant.abs()));
    }
    text
}

fn product(arena: &Arena, factors: &[(Expr, i32)], name: &dyn Fn(Expr) -> Written) -> String {
    let side = |above: bool| -> String {
        let factors: Vec<_> = factors.iter().filter(|(_, exponent)| (*exponent > 0) == above).collect();
        let alone = factors.len() == 1;
        let powers = factors.iter().map(|(base, e)| power(arena, (*base, e.unsigned_abs()), alone, name));
        powers.collect::<Vec<_>>().join(" ")
    };
    let (above, below) = (side(true), side(false));
    match (above.is_empty(), below.is_empty()) {
        (_, true) => above,
        (true, false) => format!("\\frac{{1}}{{{below}}}"),
        (false, false) => format!("\\frac{{{above}}}{{{below}}}"),
    }
}

/// A factor of a product, of which it may be all.
fn power(
    arena: &Arena,
    (base, exponent): (Expr, u32),
    alone: bool,
    name: &dyn Fn(Expr) -> Written,
) -> String {
    let body = latex(arena, base, name);
    let bare = match arena.node(base) {
        Node::Sum(..) => exponent == 1 && alone,
        Node::Symbol(_) => name(base).is_bare(exponent, alone),
        Node::Function(function, _) => exponent == 1 || *function != Function::InverseCbrt,
        Node::Constant(_) | Node::Product(_) => true,
    };
    let body = if bare { body } else { bracketed(&body) };
    if exponent == 1 { body } else { format!("{body}^{{{exponent}}}") }
}

fn number(value: &Rational) -> String {
    let text = value.shown();
    match text.split_once('/') {
        Some((above, below)) => match above.strip_prefix('-') {
            Some(above) => format!("-\\frac{{{above}}}{{{below}}}"),
            None => format!("\\frac{{{above}}}{{{below}}}"),
        },
        None => text,
    }
}

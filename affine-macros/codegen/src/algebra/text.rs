//! Expressions as text.

use std::fmt::Write as _;

use super::arena::Node;
use super::{Arena, Expr, Rational};

/// A symbol as it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The symbol without brackets.
    pub body: String,
    /// Where it takes brackets.
    pub shape: Shape,
}

/// Where what is written for a symbol takes brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Nowhere: a letter, with an index or without.
    Letter,
    /// Before a power: it has a superscript already.
    Raised,
    /// Among factors too: a function without brackets of its own.
    Applied,
}

impl Written {
    /// A symbol that never takes brackets: a letter, with an index or without.
    pub fn letter(body: impl Into<String>) -> Self {
        Self { body: body.into(), shape: Shape::Letter }
    }

    /// What has a superscript.
    pub fn raised(body: impl Into<String>) -> Self {
        Self { body: body.into(), shape: Shape::Raised }
    }

    /// Can it stand as a factor with this exponent, `alone` or not, without brackets?
    pub fn is_bare(&self, exponent: u32, alone: bool) -> bool {
        match self.shape {
            Shape::Letter => true,
            Shape::Raised => exponent == 1,
            Shape::Applied => exponent == 1 && alone,
        }
    }
}

impl Arena {
    /// The expression as text in the notation of specifications: `2*a + b^2/3`.
    pub fn text(&self, expr: Expr) -> String {
        self.text_with(expr, &|symbol| Written::letter(self.symbol_name(symbol)))
    }

    /// The same with other names for the symbols.
    pub fn text_with(&self, expr: Expr, name: &dyn Fn(Expr) -> Written) -> String {
        match self.node(expr) {
            Node::Constant(value) => value.shown(),
            Node::Symbol(_) => name(expr).body,
            Node::Sum(constant, terms) => self.sum_text(constant, terms, name),
            Node::Product(factors) => self.product_text(factors, name),
            Node::Function(function, argument) => {
                format!("{}({})", function.name(), self.text_with(*argument, name))
            }
        }
    }

    fn sum_text(
        &self,
        constant: &Rational,
        terms: &[(Expr, Rational)],
        name: &dyn Fn(Expr) -> Written,
    ) -> String {
        let mut text = String::new();
        for (term, c) in terms {
            text.push_str(sign(c.is_negative(), text.is_empty()));
            text.push_str(&self.multiple_text(&c.abs(), *term, name));
        }
        if !constant.is_zero() {
            let sign = if constant.is_negative() { "-" } else { "+" };
            let _ = write!(text, " {sign} {}", constant.abs().shown());
        }
        text
    }

    /// A number times an expression: `2*a`, `5/6*a`, `5/(6*a)` of `1/a`.
    fn multiple_text(&self, number: &Rational, expr: Expr, name: &dyn Fn(Expr) -> Written) -> String {
        let number = (!number.is_one()).then(|| number.shown());
        match (self.node(expr), number) {
            (Node::Product(factors), Some(number)) if factors.iter().all(|(_, e)| *e < 0) => {
                let (above, below) = number.split_once('/').unwrap_or((&number, ""));
                let own = (!below.is_empty()).then(|| below.to_owned());
                let below: Vec<String> = own.into_iter().chain(self.powers_text(factors, name)).collect();
                quotient_text(above, &below)
            }
            (Node::Sum(..), Some(number)) => format!("{number}*({})", self.text_with(expr, name)),
            (Node::Sum(..), None) => format!("({})", self.text_with(expr, name)),
            (_, Some(number)) => format!("{number}*{}", self.text_with(expr, name)),
            (_, None) => self.text_with(expr, name),
        }
    }

    fn product_text(&self, factors: &[(Expr, i32)], name: &dyn Fn(Expr) -> Written) -> String {
        let (above, below): (Vec<_>, Vec<_>) = factors.iter().partition(|(_, exponent)| *exponent > 0);
        let above = match above.is_empty() {
            true => "1".to_owned(),
            false => self.powers_text(&above, name).join("*"),
        };
        quotient_text(&above, &self.powers_text(&below, name))
    }

    /// Each factor to the size of its exponent.
    fn powers_text(&self, factors: &[(Expr, i32)], name: &dyn Fn(Expr) -> Written) -> Vec<String> {
        let power = |(base, exponent): &(Expr, i32)| {
            let bare = match self.node(*base) {
                Node::Sum(..) => false,
                Node::Symbol(_) => *exponent == 1 || name(*base).shape == Shape::Letter,
                _ => true,
            };
            let body = self.text_with(*base, name);
            let body = if bare { body } else { format!("({body})") };
            match exponent.unsigned_abs() {
                1 => body,
                power => format!("{body}^{power}"),
            }
        };
        factors.iter().map(power).collect()
    }
}

/// The sign in front of a summand, of which it may be the first.
pub fn sign(negative: bool, first: bool) -> &'static str {
    match (negative, first) {
        (true, true) => "-",
        (true, false) => " - ",
        (false, true) => "",
        (false, false) => " + ",
    }
}

fn quotient_text(above: &str, below: &[String]) -> String {
    match below {
        [] => above.to_owned(),
        [only] => format!("{above}/{only}"),
        _ => format!("{above}/({})", below.join("*")),
    }
}

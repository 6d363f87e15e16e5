//! Expressions as text.

use std::fmt::Write as _;

use super::arena::Node;
use super::{Arena, Expr, Rational};

impl Arena {
    /// The expression as text in the notation of specifications: `2*a + b^2/3`.
    #[must_use]
    pub fn text(&self, expr: Expr) -> String {
        match self.node(expr) {
            Node::Constant(value) => value.shown(),
            Node::Symbol(name) => name.clone(),
            Node::Sum(constant, terms) => self.sum_text(constant, terms),
            Node::Product(factors) => self.product_text(factors),
            Node::Function(function, argument) => format!("{}({})", function.name(), self.text(*argument)),
        }
    }

    fn sum_text(&self, constant: &Rational, terms: &[(Expr, Rational)]) -> String {
        let mut text = String::new();
        for (term, c) in terms {
            let sign = if c.is_negative() { "-" } else { "+" };
            match (text.is_empty(), sign) {
                (true, "-") => text.push('-'),
                (true, _) => {}
                (false, sign) => {
                    let _ = write!(text, " {sign} ");
                }
            }
            if !c.abs().is_one() {
                let _ = write!(text, "{}*", c.abs().shown());
            }
            match self.node(*term) {
                Node::Sum(..) => {
                    let _ = write!(text, "({})", self.text(*term));
                }
                _ => text.push_str(&self.text(*term)),
            }
        }
        if !constant.is_zero() {
            let sign = if constant.is_negative() { "-" } else { "+" };
            let _ = write!(text, " {sign} {}", constant.abs().shown());
        }
        text
    }

    fn product_text(&self, factors: &[(Expr, i32)]) -> String {
        let mut above = Vec::new();
        let mut below = Vec::new();
        for &(base, exponent) in factors {
            let body = match self.node(base) {
                Node::Sum(..) => format!("({})", self.text(base)),
                _ => self.text(base),
            };
            let list = if exponent > 0 { &mut above } else { &mut below };
            list.push(match exponent.unsigned_abs() {
                1 => body,
                power => format!("{body}^{power}"),
            });
        }
        let above = if above.is_empty() { "1".to_owned() } else { above.join("*") };
        match below.len() {
            0 => above,
            1 => format!("{above}/{}", below[0]),
            _ => format!("{above}/({})", below.join("*")),
        }
    }
}

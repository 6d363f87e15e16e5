//! What stands in expressions of Rust and not in formulas: methods, `self.a`, paths.

use proc_macro2::{Group, Ident, TokenTree};

use super::applied::FUNCTIONS;
use super::{Language, Parser, exact};
use crate::algebra::Rational;
use crate::diagnostics::{ExpressionMistake, Region, Reported};
use crate::spec::entries::shortened;
use crate::spec::{Expression, ExpressionKind, Operator, textbook};

impl Parser<'_> {
    /// What follows a dot behind an operand.
    pub(super) fn behind_a_dot(&mut self, operand: &Expression, dot: Region) -> Reported {
        self.last = dot;
        let Some(TokenTree::Ident(name)) = self.tokens.next_if(|token| matches!(token, TokenTree::Ident(_)))
        else {
            let expected = "an operator or a comma";
            let mistake = ExpressionMistake::UnexpectedToken { found: "`.`".to_owned(), expected };
            return self.found.report(dot, mistake);
        };
        let arguments = self.tokens.next_if(|token| matches!(token, TokenTree::Group(_)));
        let (at, written, instead) = match arguments {
            Some(TokenTree::Group(group)) => {
                let written = format!(".{name}({})", group.stream());
                (dot.to(group.span_close()), written, self.as_formula(operand, &name, &group))
            }
            _ if matches!(&operand.kind, ExpressionKind::Symbol(symbol) if symbol == "self") => {
                (operand.span.to(name.span()), format!("self.{name}"), format!("write `{name}`"))
            }
            _ => {
                let familiar = (name == "T").then(|| textbook::quantity("T")).flatten();
                let instead = familiar.unwrap_or("write a field of the struct alone");
                (dot.to(name.span()), format!(".{name}"), instead.to_owned())
            }
        };
        self.found.report(at, ExpressionMistake::RustNotation { written: shortened(&written), instead })
    }

    /// What to write instead of a method.
    fn as_formula(&self, operand: &Expression, method: &Ident, arguments: &Group) -> String {
        let method = method.to_string();
        let function = FUNCTIONS.into_iter().find(|function| function.name() == method);
        let number = match arguments.stream().into_iter().collect::<Vec<_>>().as_slice() {
            [TokenTree::Literal(one)] => exact(&syn::Lit::new(one.clone()), &one.to_string()).ok(),
            _ => None,
        };
        let placed = |kind| Expression { kind, span: operand.span };
        match (method.as_str(), self.language, function) {
            ("powi" | "powf" | "pow", ..) => match number {
                Some(number) => {
                    let exponent = placed(ExpressionKind::Number(number));
                    format!("write `{}`", Operator::Power.apply(operand.clone(), exponent))
                }
                None => "write `a^b`, with an integer `b`".to_owned(),
            },
            ("recip", ..) => {
                let one = placed(ExpressionKind::Number(Rational::ONE));
                format!("write `{}`", Operator::Divide.apply(one, operand.clone()))
            }
            (_, Language::Potential(_), Some(function)) => {
                let value = placed(ExpressionKind::Call(function, Box::new(operand.clone())));
                format!("write `{value}`")
            }
            (_, Language::Potential(_), None) => textbook::function(&method)
                .unwrap_or("functions stand before their argument, as in `sqrt(a)`")
                .to_owned(),
            (_, Language::Coefficient, _) => "compute the value beforehand and keep it in a field".to_owned(),
        }
    }

    /// A path that begins with `written`, read already.
    pub(super) fn path(&mut self, first: Region, mut written: String) -> Reported {
        let (mut end, mut field) = (first, "value".to_owned());
        let belongs = |token: &TokenTree| match token {
            TokenTree::Punct(punct) => punct.as_char() == ':',
            token => matches!(token, TokenTree::Ident(_)),
        };
        while let Some(token) = self.tokens.next_if(belongs) {
            end = token.span().into();
            written += &token.to_string();
            if let TokenTree::Ident(name) = token {
                field = name.to_string().to_lowercase();
            }
        }
        self.found.report(first.to(end), ExpressionMistake::Path { path: shortened(&written), field })
    }
}

//! Sentences in LaTeX.

use super::latex::{bracketed, latex};
use super::names::Notation;
use super::sentence::{Exponent, Sentence, is_sum, summed};
use crate::algebra::Arena;

impl Notation<'_> {
    /// A sentence in LaTeX.
    pub(in crate::mechanics) fn latex(&self, arena: &Arena, sentence: &Sentence) -> String {
        let tex = |sentence: &Sentence| self.latex(arena, sentence);
        let list = |parts: &[Sentence]| parts.iter().map(tex).collect::<Vec<_>>().join(", ");
        match sentence {
            Sentence::Scalar(expr) => latex(arena, *expr, &|symbol| self.written(arena, symbol)[1].clone()),
            Sentence::One => "1".to_owned(),
            Sentence::Letter(letter) => letter.latex.to_owned(),
            Sentence::OfField(letter, [_, index]) => format!("{}_{{{index}}}", letter.latex),
            Sentence::Component(letter, index) => format!("{}_{{{index}}}", letter.latex),
            Sentence::Matrix(name) => name.latex.clone(),
            Sentence::Rows(rows) => {
                let row = |row: &Vec<Sentence>| row.iter().map(tex).collect::<Vec<_>>().join(" & ");
                let rows: Vec<String> = rows.iter().map(row).collect();
                format!("\\begin{{pmatrix}} {} \\end{{pmatrix}}", rows.join(" \\\\ "))
            }
            Sentence::Diagonal(entries) => format!("\\operatorname{{diag}}{}", bracketed(&list(entries))),
            Sentence::Entry(of, indices) => {
                format!("{}_{{{}}}", self.indexed(arena, of), indices_latex(indices))
            }
            Sentence::Sum(summands) => summed(summands, |value| self.among(arena, value, value.is_sum())),
            Sentence::Product(factors) => self.product_latex(arena, factors),
            Sentence::Multiple(number, of) => {
                let sum = is_sum(arena, *number);
                let number = self.among(arena, &Sentence::Scalar(*number), sum);
                format!("{number}\\, {}", self.among(arena, of, of.is_sum()))
            }
            Sentence::Over(of, number) => format!("\\frac{{{}}}{{{number}}}", tex(of)),
            Sentence::OverDimension(of) => format!("\\frac{{{}}}{{n}}", tex(of)),
            Sentence::Raised(of, exponent) => {
                format!("{}^{}", self.among(arena, of, of.is_composed()), raised(*exponent))
            }
            Sentence::Trace(of) => format!("\\operatorname{{tr}}{}", self.among(arena, of, of.is_several())),
            Sentence::Length(of) => format!("|{}|", tex(of)),
            Sentence::Norm(of) => format!("\\|{}\\|", of.latex),
            Sentence::Commutator(both) => format!("[{}]", list(&both[..])),
            Sentence::Rate(of) => match &**of {
                Sentence::Applied(function, arguments) => {
                    format!("\\dot {}({})", function.latex, list(arguments))
                }
                _ => format!("\\dot{{{}}}", tex(of)),
            },
            Sentence::RateOfAll(of) => format!("\\frac{{d}}{{dt}} {}", tex(of)),
            Sentence::Slope(both) => format!("\\partial {}/\\partial {}", tex(&both[0]), tex(&both[1])),
            Sentence::SlopeAtRest(of) => format!("\\partial_t {}", of.latex),
            Sentence::Applied(function, arguments) => format!("{}({})", function.latex, list(arguments)),
            Sentence::Inner(both) => format!("{}\\cdot {}", tex(&both[0]), tex(&both[1])),
            Sentence::Equation(both) => format!("{} = {}", tex(&both[0]), tex(&both[1])),
            Sentence::Solved(equation, _) => tex(equation),
            Sentence::InGivenBases(of) => format!("{}\\text{{ in the given bases}}", tex(of)),
            Sentence::Several(sentences) => sentences.iter().map(tex).collect::<Vec<_>>().join(",\\quad "),
        }
    }

    /// In brackets or without.
    fn among(&self, arena: &Arena, of: &Sentence, brackets: bool) -> String {
        let body = self.latex(arena, of);
        if brackets { bracketed(&body) } else { body }
    }

    /// What an index is set to.
    fn indexed(&self, arena: &Arena, of: &Sentence) -> String {
        match of {
            Sentence::Matrix(name) => name.indexed(),
            _ => self.latex(arena, of),
        }
    }

    /// Factors side by side; the identity apart, which would be read as a digit of what stands before it.
    fn product_latex(&self, arena: &Arena, factors: &[Sentence]) -> String {
        let mut product = String::new();
        for factor in factors {
            product += match factor {
                _ if product.is_empty() => "",
                Sentence::One => "\\,",
                _ => " ",
            };
            product += &self.among(arena, factor, factor.is_sum());
        }
        product
    }
}

fn raised(exponent: Exponent) -> String {
    match exponent {
        Exponent::Transpose => "T".to_owned(),
        Exponent::Inverse => "{-1}".to_owned(),
        Exponent::Power(power) => power.to_string(),
    }
}

/// `AB`, or `(AB)(CD)`.
fn indices_latex(indices: &[[char; 2]]) -> String {
    match indices {
        [[a, b]] => format!("{a}{b}"),
        several => several.iter().map(|[a, b]| format!("({a}{b})")).collect(),
    }
}

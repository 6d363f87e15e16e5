//! Sentences as text.

use super::names::Notation;
use super::sentence::{Exponent, Sentence, is_sum, summed};
use crate::algebra::Arena;

impl Notation<'_> {
    /// A sentence as text.
    pub(in crate::mechanics) fn text(&self, arena: &Arena, sentence: &Sentence) -> String {
        let text = |sentence: &Sentence| self.text(arena, sentence);
        let list = |parts: &[Sentence]| parts.iter().map(text).collect::<Vec<_>>().join(", ");
        match sentence {
            Sentence::Scalar(expr) => {
                arena.text_with(*expr, &|symbol| self.written(arena, symbol)[0].clone())
            }
            Sentence::One => "1".to_owned(),
            Sentence::Letter(letter) => letter.text.to_owned(),
            Sentence::OfField(letter, [name, _]) => format!("{}[{name}]", letter.text),
            Sentence::Component(letter, index) => format!("{}_{index}", letter.text),
            Sentence::Matrix(name) => name.text.clone(),
            Sentence::Rows(rows) => {
                let rows: Vec<String> = rows.iter().map(|row| format!("[{}]", list(row))).collect();
                format!("[{}]", rows.join(", "))
            }
            Sentence::Diagonal(entries) => format!("diag({})", list(entries)),
            Sentence::Entry(of, indices) => format!("{}[{}]", text(of), indices_text(indices)),
            Sentence::Sum(summands) => summed(summands, |value| bracketed(value.is_sum(), text(value))),
            Sentence::Product(factors) => {
                let factors = factors.iter().map(|factor| bracketed(factor.is_sum(), text(factor)));
                factors.collect::<Vec<_>>().join(" ")
            }
            Sentence::Multiple(number, of) => {
                let sum = is_sum(arena, *number);
                let number = bracketed(sum, text(&Sentence::Scalar(*number)));
                format!("{number} {}", bracketed(of.is_sum(), text(of)))
            }
            Sentence::Over(of, number) => format!("{}/{number}", bracketed(of.is_sum(), text(of))),
            Sentence::OverDimension(of) => format!("{}/n", bracketed(of.is_sum(), text(of))),
            Sentence::Raised(of, exponent) => {
                raised(&bracketed(of.is_composed(), self.inside(arena, of)), *exponent)
            }
            Sentence::Trace(of) => format!("tr({})", text(of)),
            Sentence::Length(of) => format!("|{}|", text(of)),
            Sentence::Norm(of) => format!("|{}|", of.text),
            Sentence::Commutator(both) => format!("[{}]", list(&both[..])),
            Sentence::Rate(of) => format!("d{}/dt", text(of)),
            Sentence::RateOfAll(of) => format!("d({})/dt", text(of)),
            Sentence::Slope(both) => {
                let by = bracketed(matches!(both[1], Sentence::Rate(_)), text(&both[1]));
                format!("d{}/d{by}", text(&both[0]))
            }
            Sentence::SlopeAtRest(of) => format!("d{}/dt at rest", of.text),
            Sentence::Applied(function, arguments) => format!("{}({})", function.text, list(arguments)),
            Sentence::Inner(both) => format!("{}.{}", text(&both[0]), text(&both[1])),
            Sentence::Equation(both) => format!("{} = {}", text(&both[0]), text(&both[1])),
            Sentence::Solved(equation, unknown) => {
                format!("{}, solved for {}", text(equation), text(unknown))
            }
            Sentence::InGivenBases(of) => format!("{} in the given bases", text(of)),
            Sentence::Several(sentences) => list(sentences),
        }
    }

    /// What stands in the brackets of a power: `(tr X)^2`, not `(tr(X))^2`.
    fn inside(&self, arena: &Arena, of: &Sentence) -> String {
        match of {
            Sentence::Trace(of) if !of.is_several() => format!("tr {}", self.text(arena, of)),
            _ => self.text(arena, of),
        }
    }
}

fn bracketed(brackets: bool, text: String) -> String {
    if brackets { format!("({text})") } else { text }
}

fn raised(text: &str, exponent: Exponent) -> String {
    match exponent {
        Exponent::Transpose => format!("{text}^T"),
        Exponent::Inverse => format!("{text}^-1"),
        Exponent::Power(power) => format!("{text}^{power}"),
    }
}

/// `A,B`, or `(A,B),(C,D)`.
fn indices_text(indices: &[[char; 2]]) -> String {
    match indices {
        [[a, b]] => format!("{a},{b}"),
        several => several.iter().map(|[a, b]| format!("({a},{b})")).collect::<Vec<_>>().join(","),
    }
}

//! The derivation as formulas, in text and LaTeX. A matrix formula is stated only after its components were
//! compared with the derived ones.

mod equations;
mod hamiltonian;
mod known_forms;
mod left_out;
mod system;

use crate::algebra::arena::Node;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::Momentum;
use crate::mechanics::kinetic::{Coefficient, Frame, Kinetic, Term, TermKind};
use crate::mechanics::notation::{field_latex, is_number, latex, matrix_field, plain};

pub use equations::equations;
pub use hamiltonian::{hamiltonian, kinetic_energy_of_momenta};
pub use left_out::{LeftOut, Scope, closed_form, left_out};
pub use system::system;

/// A formula in both notations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// Plain text.
    pub text: String,
    /// LaTeX.
    pub latex: String,
}

/// A sum under construction.
pub(super) struct Sum {
    text: String,
    latex: String,
}

impl Sum {
    pub(super) fn new(left: &str, left_latex: &str) -> Self {
        Self { text: format!("{left} ="), latex: format!("{left_latex} =") }
    }

    /// Adds `coefficient * body`, with the sign in front.
    pub(super) fn add(&mut self, arena: &mut Arena, coefficient: &Polynomial, body: (&str, &str)) {
        if coefficient.is_zero() {
            return;
        }
        let negative = coefficient.terms().all(|(_, c)| c.is_negative());
        let first = self.text.ends_with('=');
        let sign = match (negative, first) {
            (true, true) => " -",
            (true, false) => " - ",
            (false, true) => " ",
            (false, false) => " + ",
        };
        let size = if negative { coefficient.scaled(&Rational::MINUS_ONE) } else { coefficient.clone() };
        let factor = size.expression(arena);
        let one = arena.as_constant(factor).is_some_and(Rational::is_one);
        self.text.push_str(sign);
        self.latex.push_str(sign);
        if !one {
            let (text, latex) = (plain(arena, factor), latex(arena, factor));
            let bracket = matches!(arena.node(factor), Node::Sum(_, terms) if terms.len() > 1);
            self.text += &if bracket { format!("({text}) ") } else { format!("{text} ") };
            self.latex += &if bracket { format!("\\left({latex}\\right) ") } else { format!("{latex}\\, ") };
        }
        self.text.push_str(body.0);
        self.latex.push_str(body.1);
    }

    pub(super) fn finish(mut self) -> Formula {
        if self.text.ends_with('=') {
            self.text.push_str(" 0");
            self.latex.push_str(" 0");
        }
        Formula { text: self.text, latex: self.latex }
    }
}

/// `T` as the sum of its terms.
pub fn kinetic_energy(arena: &mut Arena, kinetic: &Kinetic) -> Formula {
    let mut sum = Sum::new("T", "T");
    // With its weight the energy is that in phi_dot.
    let frame = if kinetic.is_weighted() { Frame::Flat } else { kinetic.frame };
    quadratic_terms(arena, &mut sum, frame, &kinetic.terms);
    sum.finish()
}

/// Adds the terms of a quadratic form in the velocity of `frame`.
pub(super) fn quadratic_terms(arena: &mut Arena, sum: &mut Sum, frame: Frame, terms: &[Term]) {
    let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
    let (o, o_latex) = match frame {
        Frame::Body => ("Omega_hat", "\\hat\\Omega"),
        Frame::Space => ("Omega", "\\Omega"),
        Frame::Flat => ("phi_dot", "\\dot\\varphi"),
    };
    for term in terms {
        let (coefficient, (text, latex)) = match (term.kind, &term.value) {
            (TermKind::Casimir2, Coefficient::Scalar(c)) => {
                (*c, (format!("tr({o}^2)"), format!("\\operatorname{{tr}}{o_latex}^2")))
            }
            (TermKind::Casimir1Squared, Coefficient::Scalar(c)) => {
                (*c, (format!("(tr {o})^2"), format!("(\\operatorname{{tr}}{o_latex})^2")))
            }
            (TermKind::BodyTranslation, Coefficient::Scalar(m)) => {
                (*m, ("|phi^-1 dx/dt|^2".into(), "|\\varphi^{-1}\\dot x|^2".into()))
            }
            (TermKind::SpaceTranslation, Coefficient::Scalar(m)) => {
                (*m, ("|dx/dt|^2".into(), "|\\dot x|^2".into()))
            }
            (_, Coefficient::Scalar(c)) => {
                (*c, (format!("tr({o} {o}^T)"), format!("\\operatorname{{tr}}({o_latex}{o_latex}^T)")))
            }
            (kind, Coefficient::Matrix(j)) if !kind.is_tensor() => {
                let (j, j_latex) = matrix_name(arena, j, "J");
                let one = arena.constant(Rational::ONE);
                (
                    one,
                    (
                        format!("tr({o} {j} {o}^T)"),
                        format!("\\operatorname{{tr}}({o_latex} {j_latex} {o_latex}^T)"),
                    ),
                )
            }
            (_, Coefficient::Matrix(k)) => {
                let (k, k_latex) = matrix_name(arena, k, "K");
                let text = format!("{k}[(A,B),(C,D)] {o}[A,B] {o}[C,D]");
                let latex = format!("{k_latex}_{{(AB)(CD)}}\\,{o_latex}_{{AB}}{o_latex}_{{CD}}");
                (arena.constant(Rational::ONE), (text, latex))
            }
        };
        let weight = Polynomial::normal_form(arena, coefficient).scaled(&half);
        sum.add(arena, &weight, (&text, &latex));
    }
}

/// The name of the field that a matrix is, in text and LaTeX, or its letter.
fn matrix_name(arena: &Arena, matrix: &Matrix, letter: &str) -> (String, String) {
    let name = |e: &Expr| Some(matrix_field(arena.name(*e)?)?.0.to_owned());
    let field = name(&matrix.0[0][0])
        .filter(|field| matrix.0.iter().flatten().all(|entry| name(entry).as_ref() == Some(field)));
    match field.filter(|field| !is_number(field)) {
        Some(field) => (field.clone(), field_latex(&field)),
        None => (letter.to_owned(), letter.to_owned()),
    }
}

/// Names of a momentum and of its rate, in text and LaTeX.
fn momentum_names(momentum: Momentum) -> (&'static str, &'static str, &'static str, &'static str) {
    match momentum {
        Momentum::Body => ("Sigma_hat", "\\hat\\Sigma", "dSigma_hat/dt", "\\dot{\\hat\\Sigma}"),
        Momentum::Space => ("Sigma", "\\Sigma", "dSigma/dt", "\\dot\\Sigma"),
        Momentum::Total => ("I(O)", "I(O)", "dI(O)/dt", "\\dot I(O)"),
        Momentum::Canonical => ("Pi", "\\Pi", "dPi/dt", "\\dot\\Pi"),
    }
}

fn velocity_names(momentum: Momentum) -> (&'static str, &'static str) {
    match momentum {
        Momentum::Body => ("Omega_hat", "\\hat\\Omega"),
        Momentum::Space | Momentum::Total => ("Omega", "\\Omega"),
        Momentum::Canonical => ("phi_dot", "\\dot\\varphi"),
    }
}

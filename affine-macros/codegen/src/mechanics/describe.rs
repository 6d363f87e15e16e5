//! The derivation as formulas, in text and LaTeX. A matrix formula is stated only after its components were
//! compared with the derived ones.

mod conserved;
mod equations;
mod forces;
mod hamiltonian;
mod inertia;
mod known_forms;
mod system;

use crate::algebra::arena::Node;
use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::charts::Momentum;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::notation::MatrixName;
use crate::mechanics::term::{Coefficient, Frame, Pattern, Term, TermKind};

pub use super::notation::{Described, Formula, Notation};
pub use conserved::component;
pub use equations::equations;
pub use hamiltonian::{hamiltonian, kinetic_energy_of_momenta};
pub use system::system;

/// A summand, with its sign apart.
#[derive(Clone)]
pub(super) struct Summand {
    pub(super) negative: bool,
    pub(super) text: String,
    pub(super) latex: String,
}

impl Summand {
    pub(super) fn plus(text: impl Into<String>, latex: impl Into<String>) -> Self {
        Self { negative: false, text: text.into(), latex: latex.into() }
    }

    pub(super) fn minus(text: impl Into<String>, latex: impl Into<String>) -> Self {
        Self { negative: true, ..Self::plus(text, latex) }
    }
}

/// The right-hand side of a formula under construction.
#[derive(Default)]
pub(super) struct Sum {
    text: String,
    latex: String,
}

impl Sum {
    /// Adds `coefficient * body`, with the sign in front; the coefficient alone where there is no body.
    pub(super) fn add(
        &mut self,
        arena: &mut Arena,
        notation: &Notation,
        coefficient: &Polynomial,
        body: (&str, &str),
    ) {
        if coefficient.is_zero() {
            return;
        }
        let negative = coefficient.terms().all(|(_, c)| c.is_negative());
        let size = if negative { coefficient.scaled(&Rational::MINUS_ONE) } else { coefficient.clone() };
        let factor = size.expression(arena);
        let one = arena.as_constant(factor).is_some_and(Rational::is_one);
        let bracket = matches!(arena.node(factor), Node::Sum(_, terms) if terms.len() > 1);
        let Formula { text, latex } = notation.formula(arena, factor);
        let (text, latex) = match (one, bracket) {
            _ if body.0.is_empty() => (text, latex),
            (true, _) => (String::new(), String::new()),
            (false, true) => (format!("({text}) "), format!("\\left({latex}\\right) ")),
            (false, false) => (format!("{text} "), format!("{latex}\\, ")),
        };
        self.push(negative, &format!("{text}{}", body.0), &format!("{latex}{}", body.1));
    }

    /// Adds summands with their signs.
    pub(super) fn extend<'s>(&mut self, summands: impl IntoIterator<Item = &'s Summand>) {
        summands.into_iter().for_each(|one| self.push(one.negative, &one.text, &one.latex));
    }

    /// Adds a summand or subtracts it.
    pub(super) fn push(&mut self, negative: bool, text: &str, latex: &str) {
        let sign = match (negative, self.text.is_empty()) {
            (true, true) => "-",
            (true, false) => " - ",
            (false, true) => "",
            (false, false) => " + ",
        };
        self.text += &format!("{sign}{text}");
        self.latex += &format!("{sign}{latex}");
    }

    /// The finished sum; `0` without summands.
    pub(super) fn value(self) -> Formula {
        match self.text.is_empty() {
            true => Formula { text: "0".to_owned(), latex: "0".to_owned() },
            false => Formula { text: self.text, latex: self.latex },
        }
    }

    /// As what something is.
    pub(super) fn of(self, left: &str, left_latex: &str) -> Formula {
        self.value().of(left, left_latex)
    }
}

/// `T` as the sum of its terms, frame after frame.
pub fn kinetic_energy(arena: &mut Arena, notation: &Notation, parts: &[Kinetic]) -> Formula {
    let mut sum = Sum::default();
    parts.iter().for_each(|part| energy_terms(arena, notation, &mut sum, part));
    sum.of("T", "T").with(notation.matrices_in(parts.iter().flat_map(|part| &part.terms)))
}

/// Adds the terms of a kinetic energy.
fn energy_terms(arena: &mut Arena, notation: &Notation, sum: &mut Sum, kinetic: &Kinetic) {
    // With its weight the energy is that in phi_dot.
    let frame = if kinetic.is_weighted() { Frame::Flat } else { kinetic.frame };
    quadratic_terms(arena, notation, sum, frame, &kinetic.terms);
}

/// Adds the terms of a quadratic form in the velocity of `frame`.
pub(super) fn quadratic_terms(
    arena: &mut Arena,
    notation: &Notation,
    sum: &mut Sum,
    frame: Frame,
    terms: &[Term],
) {
    let half = Rational::HALF;
    let (o, o_latex) = match frame {
        Frame::Body => ("Omega_hat", "\\hat\\Omega"),
        Frame::Space => ("Omega", "\\Omega"),
        Frame::Flat => ("phi_dot", "\\dot\\varphi"),
    };
    for term in terms {
        let (coefficient, (text, latex)) = match &term.value {
            Coefficient::Scalar(c) => (*c, with_a_number(term.kind, (o, o_latex))),
            Coefficient::Matrix(matrix) => {
                let name = notation.matrix_name(arena, &matrix.0);
                (arena.constant(Rational::ONE), on_matrix(term.kind, &name, (o, o_latex)))
            }
        };
        let weight = Polynomial::normal_form(arena, coefficient).scaled(&half);
        sum.add(arena, notation, &weight, (&text, &latex));
    }
}

/// What a number multiplies.
fn with_a_number(kind: TermKind, (o, o_latex): (&str, &str)) -> (String, String) {
    match (kind.pattern(), kind.translation_frame()) {
        (Pattern::TraceOfSquare, _) => (format!("tr({o}^2)"), format!("\\operatorname{{tr}}{o_latex}^2")),
        (Pattern::SquareOfTrace, _) => (format!("(tr {o})^2"), format!("(\\operatorname{{tr}}{o_latex})^2")),
        (Pattern::Centre, Some(Frame::Body)) => {
            ("|phi^-1 dx/dt|^2".into(), "|\\varphi^{-1}\\dot x|^2".into())
        }
        (Pattern::Centre, _) => ("|dx/dt|^2".into(), "|\\dot x|^2".into()),
        (Pattern::Rows | Pattern::Pairs, _) => {
            (format!("tr({o} {o}^T)"), format!("\\operatorname{{tr}}({o_latex}{o_latex}^T)"))
        }
    }
}

/// `tr(O J O^T)`, or `K[(A,B),(C,D)] O[A,B] O[C,D]`.
fn on_matrix(kind: TermKind, name: &MatrixName, (o, o_latex): (&str, &str)) -> (String, String) {
    let (j, j_latex) = (&name.text, &name.latex);
    match kind.is_tensor() {
        false => {
            (format!("tr({o} {j} {o}^T)"), format!("\\operatorname{{tr}}({o_latex} {j_latex} {o_latex}^T)"))
        }
        true => (
            format!("{j}[(A,B),(C,D)] {o}[A,B] {o}[C,D]"),
            format!("{}_{{(AB)(CD)}}\\,{o_latex}_{{AB}}{o_latex}_{{CD}}", name.indexed()),
        ),
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

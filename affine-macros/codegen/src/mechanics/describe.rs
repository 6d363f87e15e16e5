//! The derivation as formulas, in text and LaTeX. A matrix formula is stated only after its components were
//! compared with the derived ones.

mod conserved;
mod equations;
mod forces;
mod hamiltonian;
mod inertia;
mod known_forms;
mod system;

use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::charts::Momentum;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::notation::{Letter, MatrixName, letters, product, rate, trace};
use crate::mechanics::term::{Coefficient, Frame, Pattern, Term, TermKind};

pub use super::notation::{Described, Formula, Notation, Sentence};
pub(super) use super::notation::{Sum, Summand};
pub use conserved::component;
pub use equations::equations;
pub(super) use equations::projection;
pub use hamiltonian::{hamiltonian, kinetic_energy_of_momenta, kinetic_part};
pub use system::system;

/// `T` as the sum of its terms, frame after frame.
pub fn kinetic_energy(arena: &mut Arena, notation: &Notation, parts: &[Kinetic]) -> Sentence {
    let mut sum = Sum::default();
    for part in parts {
        // With its weight the energy is that in phi_dot.
        let frame = if part.is_weighted() { Frame::Flat } else { part.frame };
        quadratic_terms(arena, notation, &mut sum, frame, &part.terms);
    }
    sum.of(letters::KINETIC_ENERGY).with(notation.matrices_in(parts.iter().flat_map(|part| &part.terms)))
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
    let velocity = velocity(Momentum::of(frame));
    for term in terms {
        let (coefficient, value) = match &term.value {
            Coefficient::Scalar(c) => (*c, with_a_number(term.kind, velocity)),
            Coefficient::Matrix(matrix) => {
                let name = notation.matrix_name(arena, &matrix.0);
                (arena.constant(Rational::ONE), on_matrix(term.kind, name, velocity))
            }
        };
        let weight = Polynomial::normal_form(arena, coefficient).scaled(&half);
        sum.add(arena, notation, &weight, value);
    }
}

/// What a number multiplies.
fn with_a_number(kind: TermKind, velocity: Letter) -> Sentence {
    let o = || Sentence::from(velocity);
    match (kind.pattern(), kind.translation_frame()) {
        (Pattern::TraceOfSquare, _) => trace(o().power(2)),
        (Pattern::SquareOfTrace, _) => trace(o()).power(2),
        (Pattern::Centre, Some(frame)) => centre_velocity(frame).length_squared(),
        (Pattern::Centre, None) => centre_velocity(Frame::Space).length_squared(),
        (Pattern::Rows | Pattern::Pairs, _) => trace(product([o(), o().transposed()])),
    }
}

/// The velocity of the centre of mass, or that seen from the body.
fn centre_velocity(frame: Frame) -> Sentence {
    match frame {
        Frame::Body => product([Sentence::from(letters::PLACEMENT).inverse(), rate(letters::CENTRE)]),
        Frame::Space | Frame::Flat => rate(letters::CENTRE),
    }
}

/// `tr(O J O^T)`, or `K[(A,B),(C,D)] O[A,B] O[C,D]`.
fn on_matrix(kind: TermKind, name: MatrixName, velocity: Letter) -> Sentence {
    let (o, matrix) = (|| Sentence::from(velocity), Sentence::Matrix(name));
    match kind.is_tensor() {
        false => trace(product([o(), matrix, o().transposed()])),
        true => product([
            matrix.entry(&[['A', 'B'], ['C', 'D']]),
            o().entry(&[['A', 'B']]),
            o().entry(&[['C', 'D']]),
        ]),
    }
}

/// A momentum.
fn momentum(of: Momentum) -> Sentence {
    match of {
        Momentum::Body => letters::COMOVING_AFFINE_SPIN.into(),
        Momentum::Space => letters::AFFINE_SPIN.into(),
        Momentum::Total => Sentence::Applied(letters::TOTAL_AFFINE_MOMENTUM, vec![letters::ORIGIN.into()]),
        Momentum::Canonical => letters::CANONICAL_MOMENTUM.into(),
    }
}

/// The velocity beside a momentum.
fn velocity(of: Momentum) -> Letter {
    match of {
        Momentum::Body => letters::COMOVING_AFFINE_VELOCITY,
        Momentum::Space | Momentum::Total => letters::AFFINE_VELOCITY,
        Momentum::Canonical => letters::PLACEMENT_VELOCITY,
    }
}

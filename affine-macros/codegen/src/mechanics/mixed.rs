//! Kinetic energies whose terms have constant coefficients in different frames: the mass matrix depends on `phi`.
//!
//! The internal motion of such a sum is written over `phi_dot` and `Pi`, whatever the frames: every other velocity is
//! `phi^-1 phi_dot` or `phi_dot phi^-1`, so that only `phi^-1` enters, products stay short, and the momentum is
//! canonical. Energies that agree on the internal motion and differ in the translation keep their own frame.

mod centre;
mod factorisation;
mod formulas;
mod internal;
mod laws;
mod mass;
mod parts;
mod placed;

use crate::algebra::Arena;

use super::constraint::Constraint;
use super::kinetic::Kinetic;
use super::term::{Frame, Term, TermKind};

pub use centre::Masses;
pub use factorisation::{Factorisation, SymmetricBlock};
pub use formulas::{
    ForceNames, centre_equations, confined_equations, hamiltonian, internal_energy, internal_equations,
};
pub use internal::{Internal, Legendre};
pub use laws::laws_hold;
pub use mass::Metric;

/// A sum of energies, each with constant coefficients in its frame.
#[derive(Clone, Debug)]
pub struct Mixed {
    /// Dimension of space.
    pub dim: usize,
    /// The group that the motion is confined to; `None` for GL+(n).
    pub constraint: Option<Constraint>,
    /// Internal energies of different frames.
    pub internal: Vec<Kinetic>,
    /// Translational energies of different frames.
    pub translations: Vec<Kinetic>,
}

impl Mixed {
    /// Sorts the terms by their frames. The Casimirs, which have constant coefficients in body and space, go with
    /// `casimirs` where it has other terms, and to the affine frame that has some otherwise. Under a constraint each term has
    /// the frame of what it is [there](Constraint::same_as).
    pub fn new(
        arena: &mut Arena,
        dim: usize,
        terms: &[Term],
        casimirs: Frame,
        constraint: Option<Constraint>,
    ) -> Self {
        let rigid = constraint.filter(|group| *group == Constraint::Rigid);
        let form = |kind: TermKind| constraint.map_or(kind, |group| group.same_as(kind));
        let has = |frame: Frame| terms.iter().any(|term| form(term.kind).internal_frame() == Some(frame));
        let affine = match (has(Frame::Body), has(Frame::Space)) {
            (true, true) => casimirs,
            (false, true) => Frame::Space,
            _ => Frame::Body,
        };
        let internal = |term: &Term| match term.kind.translation_frame() {
            Some(_) => None,
            None => Some(form(term.kind).internal_frame().unwrap_or(affine)),
        };
        let mut part = |wanted: &dyn Fn(&Term) -> bool| {
            let places: Vec<usize> = (0..terms.len()).filter(|place| wanted(&terms[*place])).collect();
            let chosen: Vec<Term> = places.iter().map(|place| terms[*place].clone()).collect();
            // Terms of one frame have a common one.
            let kinetic = Kinetic::under(arena, dim, &chosen, rigid).ok().filter(|_| !chosen.is_empty())?;
            let mut kinetic = Kinetic { constraint, ..kinetic };
            kinetic.internal.iter_mut().for_each(|(place, _)| *place = places[*place]);
            kinetic.translation.iter_mut().for_each(|t| t.place = places[t.place]);
            Some(kinetic)
        };
        let frames = [Frame::Body, Frame::Space, Frame::Flat];
        let inner = frames.iter().filter_map(|frame| part(&|term| internal(term) == Some(*frame))).collect();
        let outer = frames
            .iter()
            .filter_map(|frame| part(&|term| form(term.kind).translation_frame() == Some(*frame)))
            .collect();
        Self { dim, constraint, internal: inner, translations: outer }
    }

    /// All energies.
    pub fn parts(&self) -> Vec<Kinetic> {
        [self.internal.clone(), self.translations.clone()].concat()
    }
}

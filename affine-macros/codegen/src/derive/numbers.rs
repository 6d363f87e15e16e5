//! Every number that is written down of a model. Each part is taken apart by name: a new one does not compile before it
//! says whether it holds numbers.

use super::second_order::Halves;
use super::splitting::{FlowProgram, PrincipalProgram, Programs};
use super::{
    Balance, ChangeOfBases, Condition, Damping, Equations, GivenMatrix, GivenSource, Metric, MixedMasses,
    Model, NumericBlock, PieceProgram, PiecePrograms, Preparation, RatioProgram, Regularity, TwoPolar,
    VelocitySide,
};
use crate::algebra::Rational;
use crate::ir::packed::Packed;
use crate::ir::taylor::Recurrence;
use crate::ir::{Op, Program};
use crate::mechanics::metrics::{Bases, Factor};

/// What holds numbers that are written down.
pub trait Numbers {
    /// Hands each of them on.
    fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational));
}

impl Numbers for Rational {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational)) {
        each(self);
    }
}

impl Numbers for Program {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational)) {
        for step in &self.steps {
            if let Op::Constant(number) = step {
                each(number);
            }
        }
    }
}

impl<T: Numbers> Numbers for Option<T> {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational)) {
        self.iter().for_each(|one| one.visit(each));
    }
}

impl<T: Numbers> Numbers for Vec<T> {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational)) {
        self.iter().for_each(|one| one.visit(each));
    }
}

impl<T: Numbers, const K: usize> Numbers for [T; K] {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational)) {
        self.iter().for_each(|one| one.visit(each));
    }
}

impl<A: Numbers, B: Numbers> Numbers for (A, B) {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational)) {
        self.0.visit(each);
        self.1.visit(each);
    }
}

/// Places and names.
macro_rules! none {
    ($($ty:ty),*) => {
        $(impl Numbers for $ty {
            fn visit<'m>(&'m self, _: &mut dyn FnMut(&'m Rational)) {}
        })*
    };
}

none!(usize, String);

/// The fields that hold numbers; after the semicolon those that hold none.
macro_rules! numbers {
    ($($part:ident { $($held:ident),*; $($other:ident),* })*) => {
        $(impl Numbers for $part {
            fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational)) {
                let Self { $($held,)* $($other: _,)* } = self;
                $($held.visit(each);)*
            }
        })*
    };
}

numbers! {
    Model {
        coefficients, numeric_blocks, conditions, damping, velocity_side, velocity, mass, mixed_masses, regularity,
        metric, acceleration, balance, hamiltonian, hamiltonian_far_away, power, full, reduced, trajectory, isotropic,
        dilatation, metrics, two_polar, taylor, splitting, tangent, second_order, packed;
        dim, constraint, projected, frame, translation, reduction, fixed, closed_form, conserved, conserved_at_rest,
        signature, has_forces, groups, formulas
    }
    VelocitySide { legendre, kinetic_energy; }
    Equations { dependent, program; groups }
    MixedMasses { momentum, velocity; }
    Regularity { blocks; positive }
    Metric { entries, inverse; size }
    Balance { internal, centre; }
    Condition { program; name, directions, relation, positive }
    Damping { conditions, blocks; }
    NumericBlock { program, basis; inverse, size, positive }
    Bases { space, body; }
    Factor { matrix, inverse; axes }
    Preparation { metrics, matrices; }
    GivenMatrix { source; name }
    TwoPolar { rates, framed, energy, pieces, ratios; variables, state, frames, couplings, formulas, dilatation_only }
    PiecePrograms { list; nystrom }
    PieceProgram { program; name, shifted, turned }
    RatioProgram { program; state, couplings }
    Halves { velocity, force; positions, momenta }
    Programs { pieces, principal; nystrom }
    PrincipalProgram { program; values, vectors }
    Recurrence { program, start; moving, ready, rules, lanes, row, vectors, full, inner, columns }
    Packed { program; state, vectors, steps, in_lanes, rates }
}

impl Numbers for ChangeOfBases {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational)) {
        match self {
            Self::Known(bases) => bases.visit(each),
            Self::Prepared(preparation) => preparation.visit(each),
        }
    }
}

impl Numbers for GivenSource {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational)) {
        match self {
            Self::Form { entries, frame: _, tensor: _ } => entries.visit(each),
            Self::SpaceInverse | Self::Body => {}
        }
    }
}

impl Numbers for FlowProgram {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(&'m Rational)) {
        self.program().visit(each);
    }
}

//! Everything of a model that is written down as arithmetic: programs, and numbers by themselves. Each part is taken apart by
//! name: a new one does not compile before it says what it holds.

use super::second_order::Halves;
use super::splitting::{FlowProgram, PrincipalProgram, Programs};
use super::{
    Balance, BalancedQuantities, ChangeOfBases, Condition, Domain, Dynamics, Equations, GivenMatrix,
    GivenSource, Methods, Metric, MixedMasses, Model, NumericBlock, PieceProgram, PiecePrograms,
    PointPrograms, Prepared, Quantities, RatioProgram, Regularity, Step, TwoPolar, Variational, VelocitySide,
};
use crate::algebra::Rational;
use crate::ir::packed::Packed;
use crate::ir::taylor::Recurrence;
use crate::ir::{Op, Program};
use crate::mechanics::metrics::{Bases, Factor};
use crate::symbol::Symbol;

/// What is written down.
#[derive(Clone, Copy, Debug)]
pub enum Part<'m> {
    /// A program.
    Program(&'m Program),
    /// A number by itself.
    Number(&'m Rational),
}

/// What holds parts that are written down.
pub trait Written {
    /// Hands each of them on.
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>));

    /// Every number, those of programs among them.
    fn numbers(&self) -> Vec<&Rational> {
        let mut numbers = Vec::new();
        self.visit(&mut |part| match part {
            Part::Number(number) => numbers.push(number),
            Part::Program(program) => numbers.extend(program.steps.iter().filter_map(|step| match step {
                Op::Constant(number) => Some(number),
                _ => None,
            })),
        });
        numbers
    }

    /// The inputs of every program.
    fn symbols(&self) -> Vec<&Symbol> {
        let mut inputs = Vec::new();
        self.visit(&mut |part| {
            if let Part::Program(program) = part {
                inputs.extend(program.symbols());
            }
        });
        inputs
    }
}

impl Written for Rational {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
        each(Part::Number(self));
    }
}

impl Written for Program {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
        each(Part::Program(self));
    }
}

impl<T: Written> Written for Option<T> {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
        self.iter().for_each(|one| one.visit(each));
    }
}

impl<T: Written> Written for Vec<T> {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
        self.iter().for_each(|one| one.visit(each));
    }
}

impl<T: Written, const K: usize> Written for [T; K] {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
        self.iter().for_each(|one| one.visit(each));
    }
}

impl<A: Written, B: Written> Written for (A, B) {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
        self.0.visit(each);
        self.1.visit(each);
    }
}

/// Places and names.
macro_rules! none {
    ($($ty:ty),*) => {
        $(impl Written for $ty {
            fn visit<'m>(&'m self, _: &mut dyn FnMut(Part<'m>)) {}
        })*
    };
}

none!(usize, String, Symbol);

/// The fields that are written down; after the semicolon those that are not.
macro_rules! written {
    ($($part:ident { $($held:ident),*; $($other:ident),* })*) => {
        $(impl Written for $part {
            fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
                let Self { $($held,)* $($other: _,)* } = self;
                $($held.visit(each);)*
            }
        })*
    };
}

written! {
    Model {
        regularity, point, quantities, metrics, prepared, dynamics, methods;
        dim, constraint, frame, translation, description
    }
    PointPrograms {
        velocity_side, velocity, mass, mixed_masses, hamiltonian, hamiltonian_far_away, domain, power, isotropic;
    }
    Quantities { metric, acceleration, balance; }
    Prepared { steps, coefficients; }
    Dynamics { full, reduced, trajectory, dilatation; reduction, passage, closed_form }
    Methods { two_polar, taylor, splitting, tangent, second_order, packed, unconstrained; }
    Variational { program; }
    VelocitySide { legendre, kinetic_energy; }
    Domain { program, far_away; guards }
    Equations { dependent, program; groups }
    MixedMasses { momentum, velocity; }
    Regularity { blocks; positive }
    Metric { entries, inverse; size }
    Balance { internal, centre; }
    BalancedQuantities { program; quantities }
    Condition { program; factor, directions, relation, positive }
    NumericBlock { program, basis; inverse, size, positive }
    Bases { space, body; }
    Factor { matrix, inverse; axes }
    GivenMatrix { source; number }
    TwoPolar { rates, framed, energy, energy_far_away, pieces, ratios; places, state, frames, couplings, formulas, dilatation_only }
    PiecePrograms { list; nystrom }
    PieceProgram { program; name, shifted, turned }
    RatioProgram { program; state, couplings }
    Halves { velocity, force; positions, momenta }
    Programs { pieces; nystrom }
    PrincipalProgram { program; values, vectors }
    Recurrence { program, start; moving, ready, rules, lanes, row, vectors, full, inner, columns }
    Packed { program; state, vectors, steps, in_lanes, rates }
}

impl Written for ChangeOfBases {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
        match self {
            Self::Known(bases) => bases.visit(each),
            Self::Prepared => {}
        }
    }
}

impl Written for Step {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
        match self {
            Self::Bases(entries) => entries.visit(each),
            Self::Rebased(matrix) => matrix.visit(each),
            Self::WellPosed(conditions) | Self::Semidefinite(conditions) => conditions.visit(each),
            Self::Inverse(block) | Self::SemidefiniteForm(block) => block.visit(each),
            Self::PrincipalAxes(form) => form.visit(each),
        }
    }
}

impl Written for GivenSource {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
        match self {
            Self::Form { entries, frame: _, tensor: _ } => entries.visit(each),
            Self::SpaceInverse | Self::Body => {}
        }
    }
}

impl Written for FlowProgram {
    fn visit<'m>(&'m self, each: &mut dyn FnMut(Part<'m>)) {
        self.program().visit(each);
    }
}

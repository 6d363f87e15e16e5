//! `H`, and `T` on momenta, through the Casimirs where they are isotropic, through an inertia where that is all.

use super::inertia::{Inertial, inertial, scalar_inverse};
use super::{Notation, Sentence, Sum, Summand, momentum};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::charts::Momentum;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::forces::Forces;
use crate::mechanics::hamiltonian::{Hamiltonian, Isotropic};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::notation::{letters, product, trace};
use crate::mechanics::potential::Potential;
use crate::mechanics::term::Frame;

/// `T = tr(X O) - H` of a Hamiltonian with `C(3)`, on momenta: the cubic term counts twice (Euler).
pub fn kinetic_energy_of_momenta(arena: &mut Arena, notation: &Notation, h: &Hamiltonian) -> Sentence {
    let mut sum = Sum::default();
    if let Some(iso) = &h.isotropic {
        let doubled = Isotropic { casimir3: iso.casimir3.scaled(&Rational::from(2)), ..iso.clone() };
        casimirs(arena, notation, &mut sum, h, &doubled);
    }
    translation(arena, notation, &mut sum, h);
    sum.of(letters::KINETIC_ENERGY)
}

/// `H`, whose kinetic part is `kinetic` on velocities.
pub fn hamiltonian(
    arena: &mut Arena,
    notation: &Notation,
    (h, kinetic): (&Hamiltonian, &Kinetic),
    potential: Option<&Potential>,
    forces: &Forces,
) -> Sentence {
    let mut sum = Sum::default();
    let mut used = internal(arena, notation, &mut sum, (h, kinetic));
    translation(arena, notation, &mut sum, h);
    if let Some(u) = potential {
        sum.add_expression(arena, notation, u.energy);
        used.add_scaled(&Polynomial::atom(u.energy), &Rational::ONE);
    }
    sum.extend(forces.potentials().into_iter().map(Summand::plus));
    let definitions = notation.definitions(arena, std::iter::once(&used));
    sum.of(letters::HAMILTONIAN).with(definitions).with(forces.definitions(arena, notation))
}

/// The kinetic energy alone, and what defines what it names.
pub fn kinetic_part(
    arena: &mut Arena,
    notation: &Notation,
    (h, kinetic): (&Hamiltonian, &Kinetic),
) -> (Sentence, Vec<Sentence>) {
    let mut sum = Sum::default();
    let used = internal(arena, notation, &mut sum, (h, kinetic));
    translation(arena, notation, &mut sum, h);
    (sum.value(), notation.definitions(arena, std::iter::once(&used)))
}

/// Adds the energy of the internal motion; what it names that formulas may have to define.
fn internal(
    arena: &mut Arena,
    notation: &Notation,
    sum: &mut Sum,
    (h, kinetic): (&Hamiltonian, &Kinetic),
) -> Polynomial {
    if let Some(iso) = &h.isotropic {
        casimirs(arena, notation, sum, h, iso);
        return Polynomial::zero();
    }
    if let Some(Inertial { energy, .. }) = inertial(arena, notation, h, kinetic) {
        sum.push(Summand::plus(energy));
        return Polynomial::zero();
    }
    if let Some(scalar) = scalar_inverse(h) {
        let x = momentum(Momentum::of(h.frame));
        let square = trace(product([x.clone().transposed(), x]));
        sum.add(arena, notation, &scalar.scaled(&Rational::HALF), square);
        return Polynomial::zero();
    }
    let dependent = h.constraint.map_or_else(Vec::new, |group| group.dependent(&h.momentum));
    let written = h.internal().substitute(&listed(&dependent));
    sum.push(Summand::plus(notation.polynomial(arena, &written)));
    written
}

/// Adds the Casimirs of an isotropic energy.
fn casimirs(arena: &mut Arena, notation: &Notation, sum: &mut Sum, h: &Hamiltonian, iso: &Isotropic) {
    let (momentum, skew) = match h.frame {
        Frame::Body => (letters::COMOVING_AFFINE_SPIN, letters::VORTICITY),
        _ => (letters::AFFINE_SPIN, letters::SPIN),
    };
    let power = |exponent| trace(Sentence::from(momentum).power(exponent));
    let mut add = |coefficient: &Polynomial, weight: &Rational, body: Sentence| {
        sum.add(arena, notation, &coefficient.scaled(weight), body);
    };
    add(&iso.casimir2, &Rational::HALF, power(2));
    add(&trace_coefficient(h, iso), &Rational::HALF, trace(momentum).power(2));
    add(&iso.skew, &Rational::HALF, Sentence::Norm(skew).power(2));
    add(&iso.casimir3, &Rational::THIRD, power(3));
}

/// Adds the energy of the centre of mass.
fn translation(arena: &mut Arena, notation: &Notation, sum: &mut Sum, h: &Hamiltonian) {
    let Some((frame, inverse_mass)) = &h.translation else { return };
    let half = Rational::HALF;
    let momentum = match frame {
        Frame::Body => pulled_back_momentum(),
        _ => letters::LINEAR_MOMENTUM.into(),
    };
    sum.add(arena, notation, &inverse_mass.scaled(&half), momentum.length_squared());
}

/// `phi^T p`.
pub(super) fn pulled_back_momentum() -> Sentence {
    product([Sentence::from(letters::PLACEMENT).transposed(), letters::LINEAR_MOMENTUM.into()])
}

/// The coefficient of the trace of the affine spin, which is zero where a constraint makes it traceless.
pub(super) fn trace_coefficient(h: &Hamiltonian, iso: &Isotropic) -> Polynomial {
    match h.constraint.is_some_and(Constraint::is_traceless) {
        true => Polynomial::zero(),
        false => iso.casimir1_squared.clone(),
    }
}

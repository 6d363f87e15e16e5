//! `H`, and `T` on momenta, through the Casimirs where they are isotropic, through an inertia where that is all.

use super::inertia::{Inertial, inertial, scalar_inverse};
use super::{Formula, Notation, Sum, momentum_names};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::Momentum;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::forces::Forces;
use crate::mechanics::hamiltonian::{Hamiltonian, Isotropic};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::potential::Potential;
use crate::mechanics::term::Frame;

/// `T = tr(X O) - H` of a Hamiltonian with `C(3)`, on momenta: the cubic term counts twice (Euler).
pub fn kinetic_energy_of_momenta(arena: &mut Arena, notation: &Notation, h: &Hamiltonian) -> Formula {
    let mut sum = Sum::default();
    if let Some(iso) = &h.isotropic {
        let doubled = Isotropic { casimir3: iso.casimir3.scaled(&Rational::from(2)), ..iso.clone() };
        casimirs(arena, notation, &mut sum, h, &doubled);
    }
    translation(arena, notation, &mut sum, h);
    sum.of("T", "T")
}

/// `H`, whose kinetic part is `kinetic` on velocities.
pub fn hamiltonian(
    arena: &mut Arena,
    notation: &Notation,
    (h, kinetic): (&Hamiltonian, &Kinetic),
    potential: Option<&Potential>,
    forces: &Forces,
) -> Formula {
    let mut sum = Sum::default();
    let mut used = internal(arena, notation, &mut sum, (h, kinetic));
    translation(arena, notation, &mut sum, h);
    if let Some(u) = potential {
        let Formula { text, latex } = notation.formula(arena, u.energy);
        sum.push(false, &text, &latex);
        used.add_scaled(&Polynomial::atom(u.energy), &Rational::ONE);
    }
    for Formula { text, latex } in forces.potentials() {
        sum.push(false, &text, &latex);
    }
    let definitions = notation.definitions(arena, std::iter::once(&used));
    sum.of("H", "H").with(definitions).with(forces.definitions(arena, notation))
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
        sum.push(false, &energy.text, &energy.latex);
        return Polynomial::zero();
    }
    if let Some(scalar) = scalar_inverse(h) {
        let (x, latex, ..) = momentum_names(Momentum::of(h.frame));
        let body = (format!("tr({x}^T {x})"), format!("\\operatorname{{tr}}({latex}^T {latex})"));
        sum.add(arena, notation, &scalar.scaled(&Rational::HALF), (&body.0, &body.1));
        return Polynomial::zero();
    }
    let dependent = h.constraint.map_or_else(Vec::new, |group| group.dependent(&h.momentum));
    let value = |atom: Expr| dependent.iter().find(|(s, _)| *s == atom).map(|(_, value)| value.clone());
    let written = h.internal().substitute(&value);
    let Formula { text, latex } = notation.polynomial(arena, &written);
    sum.push(false, &text, &latex);
    written
}

/// Adds the Casimirs of an isotropic energy.
fn casimirs(arena: &mut Arena, notation: &Notation, sum: &mut Sum, h: &Hamiltonian, iso: &Isotropic) {
    let half = Rational::HALF;
    let third = Rational::THIRD;
    let (x, hat, skew) = match h.frame {
        Frame::Body => ("Sigma_hat", "\\hat\\Sigma", ("|Vort|^2", "\\|V\\|^2")),
        _ => ("Sigma", "\\Sigma", ("|S|^2", "\\|S\\|^2")),
    };
    let mut add = |coefficient: &Polynomial, weight: &Rational, text: &str, latex: &str| {
        sum.add(arena, notation, &coefficient.scaled(weight), (text, latex));
    };
    let trace = |power: &str| (format!("tr({x}^{power})"), format!("\\operatorname{{tr}}{hat}^{power}"));
    let (second, third_power) = (trace("2"), trace("3"));
    add(&iso.casimir2, &half, &second.0, &second.1);
    let (first, first_latex) = (format!("(tr {x})^2"), format!("(\\operatorname{{tr}}{hat})^2"));
    add(&trace_coefficient(h, iso), &half, &first, &first_latex);
    add(&iso.skew, &half, skew.0, skew.1);
    add(&iso.casimir3, &third, &third_power.0, &third_power.1);
}

/// Adds the energy of the centre of mass.
fn translation(arena: &mut Arena, notation: &Notation, sum: &mut Sum, h: &Hamiltonian) {
    let Some((frame, inverse_mass)) = &h.translation else { return };
    let half = Rational::HALF;
    let body = match frame {
        Frame::Body => ("|phi^T p|^2", "|\\varphi^T p|^2"),
        _ => ("|p|^2", "|p|^2"),
    };
    sum.add(arena, notation, &inverse_mass.scaled(&half), body);
}

/// The coefficient of the trace of the affine spin, which is zero where a constraint makes it traceless.
pub(super) fn trace_coefficient(h: &Hamiltonian, iso: &Isotropic) -> Polynomial {
    match h.constraint.is_some_and(Constraint::is_traceless) {
        true => Polynomial::zero(),
        false => iso.casimir1_squared.clone(),
    }
}

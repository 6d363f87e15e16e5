//! `H`, and `T` on momenta, through the Casimirs where they are isotropic.

use super::{Formula, Sum};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::forces::Forces;
use crate::mechanics::hamiltonian::{Hamiltonian, Isotropic};
use crate::mechanics::kinetic::Frame;
use crate::mechanics::notation::{latex, plain};
use crate::mechanics::potential::Potential;

/// `T = tr(X O) - H` of a Hamiltonian with `C(3)`, on momenta: the cubic term counts twice (Euler).
pub fn kinetic_energy_of_momenta(arena: &mut Arena, h: &Hamiltonian) -> Formula {
    let mut doubled = h.clone();
    if let Some(iso) = &mut doubled.isotropic {
        iso.casimir3 = iso.casimir3.scaled(&Rational::from(2));
    }
    let Formula { text, latex } = kinetic_hamiltonian(arena, &doubled, &Polynomial::zero());
    let named = |formula: String| formula.replacen('H', "T", 1);
    Formula { text: named(text), latex: named(latex) }
}

/// `H`, through the Casimirs where it is isotropic.
pub fn hamiltonian(
    arena: &mut Arena,
    h: &Hamiltonian,
    full: &Polynomial,
    potential: Option<&Potential>,
    forces: &Forces,
) -> Formula {
    let dependent = h.confined().map_or_else(Vec::new, |group| group.dependent(&h.momentum));
    let value = |atom: Expr| dependent.iter().find(|(s, _)| *s == atom).map(|(_, value)| value.clone());
    let mut formula = kinetic_hamiltonian(arena, h, &full.substitute(&value));
    if let Some(u) = potential {
        formula.text += &format!(" + {}", plain(arena, u.energy));
        formula.latex += &format!(" + {}", latex(arena, u.energy));
    }
    for custom in forces.potentials() {
        formula.text += &format!(" + {}", custom.text);
        formula.latex += &format!(" + {}", custom.latex);
    }
    formula
}

fn kinetic_hamiltonian(arena: &mut Arena, h: &Hamiltonian, full: &Polynomial) -> Formula {
    let Some(iso) = &h.isotropic else {
        let form = full.expression(arena);
        return Formula {
            text: format!("H = {}", plain(arena, form)),
            latex: format!("H = {}", latex(arena, form)),
        };
    };
    let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
    let mut sum = Sum::new("H", "H");
    let (x, hat, skew) = match h.frame {
        Frame::Body => ("Sigma_hat", "\\hat\\Sigma", ("|Vort|^2", "\\|V\\|^2")),
        _ => ("Sigma", "\\Sigma", ("|S|^2", "\\|S\\|^2")),
    };
    sum.add(
        arena,
        &iso.casimir2.scaled(&half),
        (&format!("tr({x}^2)"), &format!("\\operatorname{{tr}}{hat}^2")),
    );
    sum.add(
        arena,
        &trace_coefficient(h, iso).scaled(&half),
        (&format!("(tr {x})^2"), &format!("(\\operatorname{{tr}}{hat})^2")),
    );
    sum.add(arena, &iso.skew.scaled(&half), skew);
    let third = Rational::ratio(1, 3).unwrap_or(Rational::ONE);
    sum.add(
        arena,
        &iso.casimir3.scaled(&third),
        (&format!("tr({x}^3)"), &format!("\\operatorname{{tr}}{hat}^3")),
    );
    if let Some((frame, inverse_mass)) = &h.translation {
        let body = match frame {
            Frame::Body => ("|phi^T p|^2", "|\\varphi^T p|^2"),
            _ => ("|p|^2", "|p|^2"),
        };
        sum.add(arena, &inverse_mass.scaled(&half), body);
    }
    sum.finish()
}

/// The coefficient of the trace of the affine spin, which is zero where a constraint makes it traceless.
pub(super) fn trace_coefficient(h: &Hamiltonian, iso: &Isotropic) -> Polynomial {
    match h.confined().is_some_and(Constraint::is_traceless) {
        true => Polynomial::zero(),
        false => iso.casimir1_squared.clone(),
    }
}

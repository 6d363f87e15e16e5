//! A mixed energy and its equations as formulas.

use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::describe::{Formula, Notation, Sum, Summand, energy_terms};
use crate::mechanics::forces::Forces;
use crate::mechanics::potential::Potential;
use crate::mechanics::term::Frame;

use super::{Masses, Mixed};

/// A formula from text and LaTeX.
fn formula(text: impl Into<String>, latex: impl Into<String>) -> Formula {
    Formula { text: text.into(), latex: latex.into() }
}

/// Names of the forces that no potential has, on `p` and on `Pi`, in text and LaTeX.
#[derive(Default)]
pub struct ForceNames {
    on_linear: Vec<Summand>,
    on_affine: Vec<Summand>,
}

impl ForceNames {
    /// Those of a chart.
    #[must_use]
    pub fn of(chart: &Chart, forces: &Forces) -> Self {
        let mut names = Self::default();
        forces.name_on(chart, &mut names.on_linear, &mut names.on_affine);
        names
    }
}

/// `T` as the sum of its terms, frame after frame.
pub fn energy(arena: &mut Arena, notation: &Notation, mixed: &Mixed) -> Formula {
    let (mut sum, parts) = (Sum::default(), mixed.parts());
    parts.iter().for_each(|part| energy_terms(arena, notation, &mut sum, part));
    sum.of("T", "T").with(notation.matrices_in(parts.iter().flat_map(|part| &part.terms)))
}

/// `H` through the velocities.
pub fn hamiltonian(
    arena: &mut Arena,
    notation: &Notation,
    internal: Formula,
    masses: &Masses,
    potential: Option<&Potential>,
    forces: &Forces,
) -> Formula {
    let mut sum = internal;
    let mut add = |text: &str, latex: &str| {
        sum.text += &format!(" + {text}");
        sum.latex += &format!(" + {latex}");
    };
    if !masses.are_none() {
        add("1/2 p^T dx/dt", "\\frac{1}{2} p^T\\dot x");
    }
    if let Some(u) = potential {
        let Formula { text, latex } = notation.formula(arena, u.energy);
        add(&text, &latex);
    }
    forces.potentials().iter().for_each(|u| add(&u.text, &u.latex));
    sum
}

/// `H` of the internal motion.
#[must_use]
pub fn internal_hamiltonian() -> Formula {
    formula("H = 1/2 tr(Pi dphi/dt)", "H = \\frac{1}{2}\\operatorname{tr}(\\Pi\\dot\\varphi)")
}

/// The Legendre transformation and the balance of `Pi`, in the parts that the energy has.
#[must_use]
pub fn internal_equations(
    arena: &mut Arena,
    notation: &Notation,
    mixed: &Mixed,
    masses: &Masses,
    potential: Option<&Potential>,
    names: &ForceNames,
) -> Vec<Formula> {
    let has = |frame: Frame| mixed.internal.iter().any(|part| part.frame == frame);
    let mut parts: Vec<(&str, &str)> = Vec::new();
    let mut rate = Sum::default();
    let mut momenta: Vec<(&str, &str)> = Vec::new();
    if has(Frame::Body) {
        momenta.push((
            "Sigma_hat = (dT_body/dOmega_hat)^T",
            "\\hat\\Sigma = (\\partial T_{\\mathrm{body}}/\\partial\\hat\\Omega)^T",
        ));
        parts.push(("Sigma_hat phi^-1", "\\hat\\Sigma\\varphi^{-1}"));
        rate.push(true, "Omega_hat Sigma_hat phi^-1", "\\hat\\Omega\\hat\\Sigma\\varphi^{-1}");
    }
    if has(Frame::Space) {
        momenta.push((
            "Sigma = (dT_space/dOmega)^T",
            "\\Sigma = (\\partial T_{\\mathrm{space}}/\\partial\\Omega)^T",
        ));
        parts.push(("phi^-1 Sigma", "\\varphi^{-1}\\Sigma"));
        rate.push(true, "phi^-1 Sigma Omega", "\\varphi^{-1}\\Sigma\\,\\Omega");
    }
    if has(Frame::Flat) {
        parts.push(("(dT_flat/dphi_dot)^T", "(\\partial T_{\\mathrm{flat}}/\\partial\\dot\\varphi)^T"));
    }
    if masses.body.is_some() {
        let mut sum = Sum::default();
        sum.push(false, "p", "p");
        let space = space_mass(arena, masses).scaled(&Rational::MINUS_ONE);
        sum.add(arena, notation, &space, ("dx/dt", "\\dot x"));
        let Formula { text, latex } = sum.value();
        let (text, latex) = match masses.are_mixed() {
            true => (format!("({text})^T"), format!("({latex})^T")),
            false => ("p^T".to_owned(), "\\,p^T".to_owned()),
        };
        rate.push(true, &format!("phi^-1 dx/dt {text}"), &format!("\\varphi^{{-1}}\\dot x {latex}"));
    }
    if potential.is_some() {
        rate.push(false, "N", "N");
    }
    rate.extend(&names.on_affine);
    let mut list: Vec<Formula> = momenta.into_iter().map(|(text, latex)| formula(text, latex)).collect();
    list.push(formula(
        format!("Pi = {}, solved for dphi/dt", parts.iter().map(|p| p.0).collect::<Vec<_>>().join(" + ")),
        format!("\\Pi = {}", parts.iter().map(|p| p.1).collect::<Vec<_>>().join(" + ")),
    ));
    list.push(rate.of("dPi/dt", "\\dot\\Pi"));
    if potential.is_some() {
        list.push(formula("N = -(dU/dphi)^T", "N = -(\\partial U/\\partial\\varphi)^T"));
    }
    list
}

/// `H` of the internal motion on a group.
#[must_use]
pub fn confined_hamiltonian() -> Formula {
    formula("H = 1/2 tr(Sigma_hat Omega_hat)", "H = \\frac{1}{2}\\operatorname{tr}(\\hat\\Sigma\\hat\\Omega)")
}

/// The Legendre transformation on a group and the balance of `Sigma_hat`, in the parts that the energy has.
#[must_use]
pub fn confined_equations(
    arena: &mut Arena,
    notation: &Notation,
    mixed: &Mixed,
    group: Constraint,
    (masses, potential): (&Masses, Option<&Potential>),
    names: &ForceNames,
) -> Vec<Formula> {
    let has = |frame: Frame| mixed.internal.iter().any(|part| part.frame == frame);
    let mut momenta: Vec<Formula> = Vec::new();
    let mut parts: Vec<(&str, &str)> = Vec::new();
    let mut rate = Sum::default();
    if has(Frame::Body) {
        momenta.push(formula(
            "X = (dT_body/dOmega_hat)^T",
            "X = (\\partial T_{\\mathrm{body}}/\\partial\\hat\\Omega)^T",
        ));
        parts.push(("X", "X"));
        rate.push(false, "[X, Omega_hat]", "[X, \\hat\\Omega]");
    }
    if has(Frame::Space) {
        let text = "Y = phi^-1 (dT_space/dOmega)^T phi";
        let latex = "Y = \\varphi^{-1}(\\partial T_{\\mathrm{space}}/\\partial\\Omega)^T\\varphi";
        momenta.push(formula(text, latex));
        parts.push(("Y", "Y"));
    }
    if has(Frame::Flat) {
        let text = "Z = (dT_flat/dphi_dot)^T phi";
        let latex = "Z = (\\partial T_{\\mathrm{flat}}/\\partial\\dot\\varphi)^T\\varphi";
        momenta.push(formula(text, latex));
        parts.push(("Z", "Z"));
        rate.push(false, "Z Omega_hat", "Z\\hat\\Omega");
    }
    if let Some(mass) = masses.body {
        let mass = Polynomial::normal_form(arena, mass).scaled(&Rational::MINUS_ONE);
        rate.add(arena, notation, &mass, ("v_hat v_hat^T", "\\hat v\\hat v^T"));
    }
    if potential.is_some() {
        rate.push(false, "Q_hat", "\\hat Q");
    }
    rate.extend(&names.on_affine);
    let sum = |which: fn(&(&'static str, &'static str)) -> &'static str| {
        parts.iter().map(which).collect::<Vec<_>>().join(" + ")
    };
    let mut list = momenta;
    list.push(formula(
        format!("Sigma_hat = P ({}), solved for Omega_hat", sum(|p| p.0)),
        format!("\\hat\\Sigma = P ({})", sum(|p| p.1)),
    ));
    list.push(formula("dphi/dt = phi Omega_hat", "\\dot\\varphi = \\varphi\\hat\\Omega"));
    let Formula { text, latex } = rate.value();
    list.push(formula(format!("dSigma_hat/dt = P ({text})"), format!("\\dot{{\\hat\\Sigma}} = P ({latex})")));
    let (text, latex) = group.projection();
    list.push(formula(text, latex));
    if potential.is_some() {
        list.push(formula(
            "Q_hat = -(dU/dphi)^T phi",
            "\\hat Q = -(\\partial U/\\partial\\varphi)^T\\varphi",
        ));
    }
    list
}

/// The mass of the energy `m/2 |x_dot|^2`.
fn space_mass(arena: &mut Arena, masses: &Masses) -> Polynomial {
    masses.space.map_or_else(Polynomial::zero, |mass| Polynomial::normal_form(arena, mass))
}

/// The velocity of the centre of mass; `None` where it does not move.
fn centre_velocity(arena: &mut Arena, notation: &Notation, masses: &Masses) -> Option<Formula> {
    let (body, space) = ("phi phi^T p", "\\varphi\\varphi^T p");
    let mut sum = Sum::default();
    let (mass, of) = match (masses.body, masses.space) {
        (None, None) => return None,
        (Some(mass), None) => (mass, (body, space)),
        (None, Some(mass)) => (mass, ("p", "p")),
        (Some(mass), Some(_)) => {
            let (space, body) = (space_mass(arena, masses), Polynomial::normal_form(arena, mass));
            sum.add(arena, notation, &space, ("G", "G"));
            // A multiple of the identity.
            sum.add(arena, notation, &body, ("", ""));
            let Formula { text, latex } = sum.value();
            return Some(formula(
                format!("dx/dt = phi ({text})^-1 phi^T p"),
                format!("\\dot x = \\varphi ({latex})^{{-1}}\\varphi^T p"),
            ));
        }
    };
    let inverse = arena.reciprocal(mass);
    let inverse = Polynomial::normal_form(arena, inverse);
    sum.add(arena, notation, &inverse, of);
    Some(sum.of("dx/dt", "\\dot x"))
}

/// The velocity of the centre of mass and the balance of `p`.
#[must_use]
pub fn centre_equations(
    arena: &mut Arena,
    notation: &Notation,
    masses: &Masses,
    potential: Option<&Potential>,
    names: &ForceNames,
) -> Vec<Formula> {
    let Some(velocity) = centre_velocity(arena, notation, masses) else { return Vec::new() };
    let mut force = Sum::default();
    if potential.is_some_and(Potential::moves_the_centre) {
        force.push(true, "dU/dx", "\\partial U/\\partial x");
    }
    force.extend(&names.on_linear);
    vec![velocity, force.of("dp/dt", "\\dot p")]
}

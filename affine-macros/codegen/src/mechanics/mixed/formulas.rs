//! A mixed energy and its equations as formulas.

use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::describe::{Formula, Notation, Sum, Summand};
use crate::mechanics::forces::Forces;
use crate::mechanics::potential::Potential;
use crate::mechanics::term::Frame;

use super::Masses;
use super::laws::{Law, Words, law};

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

/// The laws of the parts in words.
struct Laws {
    own: Vec<Formula>,
    momentum: Formula,
    rate: Sum,
}

impl Laws {
    /// Those of parts in the velocities of some frames, on a group or on all placements.
    fn of(frames: &[Frame], confined: bool) -> Self {
        let laws: Vec<&Law> = frames.iter().map(|frame| law(*frame, confined)).collect();
        let sum = |which: fn(&Words) -> &'static str| {
            laws.iter().map(|law| which(&law.momentum)).collect::<Vec<_>>().join(" + ")
        };
        let mut rate = Sum::default();
        for (negative, (text, latex)) in laws.iter().filter_map(|law| law.rate) {
            rate.push(negative, text, latex);
        }
        Self {
            own: laws.iter().filter_map(|law| law.own).map(|(text, latex)| formula(text, latex)).collect(),
            momentum: formula(sum(|words| words.0), sum(|words| words.1)),
            rate,
        }
    }
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
    sum.with(forces.definitions(arena, notation))
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
    frames: &[Frame],
    (masses, potential): (&Masses, Option<&Potential>),
    names: &ForceNames,
) -> Vec<Formula> {
    let Laws { own: mut list, momentum, mut rate } = Laws::of(frames, false);
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
    list.push(formula(
        format!("Pi = {}, solved for dphi/dt", momentum.text),
        format!("\\Pi = {}", momentum.latex),
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
    frames: &[Frame],
    group: Constraint,
    (masses, potential): (&Masses, Option<&Potential>),
    names: &ForceNames,
) -> Vec<Formula> {
    let Laws { own: mut list, momentum, mut rate } = Laws::of(frames, true);
    if let Some(mass) = masses.body {
        let mass = Polynomial::normal_form(arena, mass).scaled(&Rational::MINUS_ONE);
        rate.add(arena, notation, &mass, ("v_hat v_hat^T", "\\hat v\\hat v^T"));
    }
    if potential.is_some() {
        rate.push(false, "Q_hat", "\\hat Q");
    }
    rate.extend(&names.on_affine);
    list.push(formula(
        format!("Sigma_hat = P ({}), solved for Omega_hat", momentum.text),
        format!("\\hat\\Sigma = P ({})", momentum.latex),
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
    (masses, potential): (&Masses, Option<&Potential>),
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

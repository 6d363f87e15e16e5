//! Forces that no potential has: what they add to the equations, and what they leave as it is.

use crate::algebra::{Arena, Expr, Rational};

use super::charts::{Chart, Linear, Momentum};
use super::conserved::Candidate;
use super::custom::{Custom, On, Role};
use super::describe::{Formula, Notation, Sum, quadratic_terms};
use super::dissipation::Dissipation;
use super::equations::Load;
use super::hamiltonian::{Hamiltonian, Isotropic};
use super::kinetic::Frame;
use super::metric::Definitions;
use super::mixed;
use super::notation::field_index;
use super::potential::TIME;
use super::shared::CentreVelocity;

/// The forces of a model besides those of its potential.
#[derive(Clone, Debug, Default)]
pub struct Forces {
    /// Rayleigh's function.
    pub dissipation: Option<Dissipation>,
    /// What fields of the model compute, forces and potentials.
    pub customs: Vec<Custom>,
    /// Does a potential that depends on the time stand beside them? Its power is part of the balance then.
    pub driven: bool,
}

impl Forces {
    /// Are there none?
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.dissipation.is_none() && self.customs.is_empty()
    }

    /// What they add to Hamilton's equations of a chart.
    pub fn loads(&self, arena: &mut Arena, chart: &Chart, centre: &CentreVelocity) -> Vec<Load> {
        let mut loads: Vec<Load> =
            self.dissipation.iter().map(|dissipation| dissipation.load(arena, chart, centre)).collect();
        loads.extend(self.customs.iter().map(|custom| custom.load(arena, chart, centre)));
        loads
    }

    /// Those of the candidates that they leave at rest; `chart` is that of the model's own frame, with `p` spatial.
    pub fn keep(
        &self,
        arena: &Arena,
        chart: &Chart,
        h: &Hamiltonian,
        mut candidates: Vec<Candidate>,
    ) -> Vec<Candidate> {
        candidates.retain(|candidate| self.customs.iter().all(|custom| custom.keeps(*candidate)));
        match &self.dissipation {
            None => candidates,
            Some(dissipation) => dissipation.keeps(arena, chart, h, &candidates),
        }
    }

    /// The same for a mass matrix that depends on the placement; `shared` defines the velocities of the chart.
    pub fn keep_varying(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        (centre, shared): (&CentreVelocity, &Definitions),
        mut candidates: Vec<Candidate>,
    ) -> Vec<Candidate> {
        candidates.retain(|candidate| self.customs.iter().all(|custom| custom.keeps(*candidate)));
        let Some(dissipation) = &self.dissipation else { return candidates };
        let load = dissipation.load(arena, chart, centre);
        mixed::unmoved(arena, chart, &load, shared, candidates)
    }

    /// Those that act where `p = 0`.
    #[must_use]
    pub fn at_rest(&self) -> Self {
        let dissipation = self.dissipation.as_ref().and_then(Dissipation::at_rest);
        Self { dissipation, ..self.clone() }
    }

    /// Does none act on the centre of mass?
    #[must_use]
    pub fn leave_the_centre(&self) -> bool {
        self.dissipation.as_ref().is_none_or(|dissipation| !dissipation.slows_the_centre())
            && self.customs.iter().all(Custom::leaves_the_centre)
    }

    /// Can any push a centre of mass that is at rest?
    #[must_use]
    pub fn push_from_rest(&self) -> bool {
        self.customs.iter().any(Custom::pushes_from_rest)
    }

    /// The time as a symbol, where a field is told it: an input of every program with forces.
    pub fn time(&self, arena: &mut Arena) -> Option<Expr> {
        (!self.customs.is_empty()).then(|| arena.symbol(TIME))
    }

    /// Do they look the same from every direction of space?
    #[must_use]
    pub fn are_isotropic_in_space(&self) -> bool {
        self.dissipation.as_ref().is_none_or(Dissipation::is_isotropic_in_space)
            && self.customs.iter().all(Custom::is_isotropic_in_space)
    }

    /// Adds the names of the forces on the linear and the affine momentum of a chart, in text and LaTeX.
    pub(super) fn name_on(
        &self,
        chart: &Chart,
        linear: &mut Vec<(String, String)>,
        affine: &mut Vec<(String, String)>,
    ) {
        let own = |(text, latex): (&str, &str)| (text.to_owned(), latex.to_owned());
        for custom in &self.customs {
            let [on_linear, on_affine] = custom_names(custom, chart);
            linear.extend(on_linear);
            affine.extend(on_affine);
        }
        let Some(dissipation) = &self.dissipation else { return };
        if dissipation.slows_the_centre() {
            linear.push(own(match chart.linear {
                Some(Linear::Body) => ("-phi^T dR/d(dx/dt)", "-\\varphi^T \\partial R/\\partial\\dot x"),
                _ => ("-dR/d(dx/dt)", "-\\partial R/\\partial\\dot x"),
            }));
        }
        if !dissipation.parts.is_empty() {
            affine.push(own(match chart.momentum {
                Momentum::Body => ("-(dR/dOmega_hat)^T", "-(\\partial R/\\partial\\hat\\Omega)^T"),
                Momentum::Space | Momentum::Total => ("-(dR/dOmega)^T", "-(\\partial R/\\partial\\Omega)^T"),
                Momentum::Canonical => ("-(dR/d(dphi/dt))^T", "-(\\partial R/\\partial\\dot\\varphi)^T"),
            }));
        }
    }

    /// What defines them, and the balance of energy.
    pub fn formulas(&self, arena: &mut Arena, notation: &Notation) -> Vec<Formula> {
        let mut list = Vec::new();
        let mut power: Vec<(String, String)> = Vec::new();
        if let Some(dissipation) = &self.dissipation {
            let mut sum = Sum::default();
            for part in &dissipation.parts {
                quadratic_terms(arena, notation, &mut sum, part.form.frame, &part.form.terms);
            }
            let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
            for (frame, coefficient) in &dissipation.centre {
                let body = match frame {
                    Frame::Body => ("|phi^-1 dx/dt|^2", "|\\varphi^{-1}\\dot x|^2"),
                    _ => ("|dx/dt|^2", "|\\dot x|^2"),
                };
                sum.add(arena, notation, &coefficient.scaled(&half), body);
            }
            let terms = dissipation.parts.iter().flat_map(|part| &part.form.terms);
            list.push(sum.of("R", "R").with(notation.matrices_in(terms)));
            power.push(("-2 R".to_owned(), "-2 R".to_owned()));
        }
        for custom in &self.customs {
            let Role::Force { on, gyroscopic: false } = custom.role else { continue };
            let (name, latex) = symbols(custom);
            power.push(match on {
                On::Space => (format!("tr({name} Omega)"), format!("\\operatorname{{tr}}({latex} \\Omega)")),
                On::Body => {
                    (format!("tr({name} Omega_hat)"), format!("\\operatorname{{tr}}({latex} \\hat\\Omega)"))
                }
                On::Centre => (format!("{name}.dx/dt"), format!("{latex}\\cdot\\dot x")),
            });
        }
        if self.driven {
            power.push(("dU/dt at rest".to_owned(), "\\partial_t U".to_owned()));
        }
        if !power.is_empty() {
            let (texts, formulas): (Vec<String>, Vec<String>) = power.into_iter().unzip();
            list.push(Formula {
                text: format!("dH/dt = {}", texts.join(" + ")),
                latex: format!("\\dot H = {}", formulas.join(" + ")),
            });
        }
        list
    }

    /// The potentials that fields compute, as summands of `H`.
    #[must_use]
    pub fn potentials(&self) -> Vec<Formula> {
        let is_potential = |custom: &&Custom| matches!(custom.role, Role::Potential { .. });
        let formula = |custom: &Custom| {
            let (text, latex) = symbols(custom);
            Formula { text, latex }
        };
        self.customs.iter().filter(is_potential).map(formula).collect()
    }

    /// May the squared vorticity or spin of `H` be applied apart from the rest?
    #[must_use]
    pub fn commute_with_rotation(&self, chart: &Chart, h: &Hamiltonian, iso: &Isotropic) -> bool {
        self.dissipation.as_ref().is_none_or(|dissipation| dissipation.commutes_with_rotation(chart, h, iso))
            && self.customs.iter().all(|custom| custom.commutes_with_rotation(h.frame))
    }
}

/// Names of what a field computes, in text and LaTeX.
fn symbols(custom: &Custom) -> (String, String) {
    let (stem, latex) = match custom.role {
        Role::Potential { .. } => ("U", "U"),
        Role::Force { on: On::Space, .. } => ("Q", "Q"),
        Role::Force { on: On::Body, .. } => ("Q_hat", "\\hat Q"),
        Role::Force { on: On::Centre, .. } => ("F", "F"),
    };
    let [name, index] = field_index(&custom.name);
    (format!("{stem}[{name}]"), format!("{latex}_{{{index}}}"))
}

/// What a field adds to the forces on the linear and the affine momentum of a chart.
fn custom_names(custom: &Custom, chart: &Chart) -> [Option<(String, String)>; 2] {
    let (name, latex) = symbols(custom);
    let around = |before: (&str, &str), after: (&str, &str)| {
        Some((format!("{}{name}{}", before.0, after.0), format!("{}{latex}{}", before.1, after.1)))
    };
    let (phi, inverse, none) = ((" phi", " \\varphi"), ("phi^-1 ", "\\varphi^{-1} "), ("", ""));
    let slope = |left: (&str, &str), right: (&str, &str)| {
        let text = format!("-{}(d{name}/dphi)^T{}", left.0, right.0);
        Some((text, format!("-{}(\\partial {latex}/\\partial\\varphi)^T{}", left.1, right.1)))
    };
    match (custom.role, chart.momentum) {
        (Role::Force { on: On::Centre, .. }, _) => {
            let force = match chart.linear {
                Some(Linear::Body) => around(("phi^T ", "\\varphi^T "), none),
                _ => around(none, none),
            };
            [force, None]
        }
        (Role::Force { on: On::Space, .. }, Momentum::Body) => [None, around(inverse, phi)],
        (Role::Force { on: On::Space, .. }, Momentum::Canonical) => [None, around(inverse, none)],
        (Role::Force { on: On::Body, .. }, Momentum::Space | Momentum::Total) => {
            [None, around(("phi ", "\\varphi "), (" phi^-1", " \\varphi^{-1}"))]
        }
        (Role::Force { on: On::Body, .. }, Momentum::Canonical) => {
            [None, around(none, (" phi^-1", " \\varphi^{-1}"))]
        }
        (Role::Force { .. }, _) => [None, around(none, none)],
        (Role::Potential { moves, .. }, momentum) => {
            let pull = match chart.linear {
                Some(Linear::Body) => ("-phi^T ", "-\\varphi^T "),
                _ => ("-", "-"),
            };
            let on_centre = moves.then(|| {
                (format!("{}d{name}/dx", pull.0), format!("{}\\partial {latex}/\\partial x", pull.1))
            });
            let on_affine = match momentum {
                Momentum::Body => slope(none, phi),
                Momentum::Space | Momentum::Total => slope(("phi ", "\\varphi "), none),
                Momentum::Canonical => slope(none, none),
            };
            [on_centre, on_affine]
        }
    }
}

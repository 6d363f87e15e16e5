//! Forces that no potential has: what they add to the equations, and what they leave as it is.

use crate::algebra::{Arena, Rational};

use super::charts::{Chart, Linear, Momentum};
use super::conserved::Candidate;
use super::describe::{Formula, Sum, quadratic_terms};
use super::dissipation::Dissipation;
use super::equations::Load;
use super::hamiltonian::{Hamiltonian, Isotropic};
use super::kinetic::Frame;

/// The forces of a model besides those of its potential.
#[derive(Clone, Debug, Default)]
pub struct Forces {
    /// Rayleigh's function.
    pub dissipation: Option<Dissipation>,
}

impl Forces {
    /// Are there none?
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.dissipation.is_none()
    }

    /// What they add to Hamilton's equations of a chart.
    pub fn loads(&self, arena: &mut Arena, chart: &Chart, h: &Hamiltonian) -> Vec<Load> {
        self.dissipation.iter().map(|dissipation| dissipation.load(arena, chart, h)).collect()
    }

    /// Those of the candidates that they leave at rest; `chart` is that of the model's own frame, with `p` spatial.
    pub fn keep(
        &self,
        arena: &Arena,
        chart: &Chart,
        h: &Hamiltonian,
        candidates: Vec<Candidate>,
    ) -> Vec<Candidate> {
        match &self.dissipation {
            None => candidates,
            Some(dissipation) => dissipation.keeps(arena, chart, h, &candidates),
        }
    }

    /// Those that act where `p = 0`.
    #[must_use]
    pub fn at_rest(&self) -> Self {
        let dissipation = self.dissipation.as_ref().and_then(Dissipation::at_rest);
        Self { dissipation }
    }

    /// Does none act on the centre of mass?
    #[must_use]
    pub fn leave_the_centre(&self) -> bool {
        self.dissipation.as_ref().is_none_or(|dissipation| !dissipation.slows_the_centre())
    }

    /// Do they look the same from every direction of space?
    #[must_use]
    pub fn are_isotropic_in_space(&self) -> bool {
        self.dissipation.as_ref().is_none_or(Dissipation::is_isotropic_in_space)
    }

    /// Adds the names of the forces on the linear and the affine momentum of a chart, in text and LaTeX.
    pub(super) fn name_on(
        &self,
        chart: &Chart,
        linear: &mut Vec<(String, String)>,
        affine: &mut Vec<(String, String)>,
    ) {
        let own = |(text, latex): (&str, &str)| (text.to_owned(), latex.to_owned());
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
    pub(super) fn formulas(&self, arena: &mut Arena) -> Vec<Formula> {
        let Some(dissipation) = &self.dissipation else { return Vec::new() };
        let mut sum = Sum::new("R", "R");
        for part in &dissipation.parts {
            quadratic_terms(arena, &mut sum, part.form.frame, &part.form.terms);
        }
        let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
        for (frame, coefficient) in &dissipation.centre {
            let body = match frame {
                Frame::Body => ("|phi^-1 dx/dt|^2", "|\\varphi^{-1}\\dot x|^2"),
                _ => ("|dx/dt|^2", "|\\dot x|^2"),
            };
            sum.add(arena, &coefficient.scaled(&half), body);
        }
        let balance = Formula { text: "dH/dt = -2 R".to_owned(), latex: "\\dot H = -2 R".to_owned() };
        vec![sum.finish(), balance]
    }

    /// May the squared vorticity or spin of `H` be applied apart from the rest?
    #[must_use]
    pub fn commute_with_rotation(&self, chart: &Chart, h: &Hamiltonian, iso: &Isotropic) -> bool {
        self.dissipation.as_ref().is_none_or(|dissipation| dissipation.commutes_with_rotation(chart, h, iso))
    }
}

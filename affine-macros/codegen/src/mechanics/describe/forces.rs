//! Forces that no potential has, as formulas.

use crate::algebra::{Arena, Rational};
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::custom::{By, Custom, On, Role};
use crate::mechanics::forces::Forces;
use crate::mechanics::notation::{Formula, Notation, field_index};
use crate::mechanics::term::Frame;

use super::{Sum, Summand, quadratic_terms};

impl Forces {
    /// Adds the names of the forces on the linear and the affine momentum of a chart, in text and LaTeX.
    pub(in crate::mechanics) fn name_on(
        &self,
        chart: &Chart,
        linear: &mut Vec<Summand>,
        affine: &mut Vec<Summand>,
    ) {
        for custom in &self.customs {
            let [on_linear, on_affine] = custom_names(custom, chart);
            linear.extend(on_linear);
            affine.extend(on_affine);
        }
        let Some(dissipation) = &self.dissipation else { return };
        if dissipation.slows_the_centre() {
            linear.push(match chart.linear {
                Some(Linear::Body) => {
                    Summand::minus("phi^T dR/d(dx/dt)", "\\varphi^T \\partial R/\\partial\\dot x")
                }
                _ => Summand::minus("dR/d(dx/dt)", "\\partial R/\\partial\\dot x"),
            });
        }
        if !dissipation.parts.is_empty() {
            let (text, latex) = match chart.momentum {
                Momentum::Body => ("(dR/dOmega_hat)^T", "(\\partial R/\\partial\\hat\\Omega)^T"),
                Momentum::Space | Momentum::Total => ("(dR/dOmega)^T", "(\\partial R/\\partial\\Omega)^T"),
                Momentum::Canonical => ("(dR/d(dphi/dt))^T", "(\\partial R/\\partial\\dot\\varphi)^T"),
            };
            affine.push(Summand::minus(text, latex));
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
            let half = Rational::HALF;
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
            let Role::Force { on, gyroscopic: false, .. } = custom.role else { continue };
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

    /// What of the potentials that are summands of `H` has a formula.
    pub(in crate::mechanics) fn definitions(&self, arena: &mut Arena, notation: &Notation) -> Vec<Formula> {
        let mut list = Vec::new();
        for custom in &self.customs {
            if let By::SelfGravity(strength) = custom.by {
                let unit = By::SelfGravity(strength).unit(arena);
                let integral = ("R_F(Q_1^2, Q_2^2, Q_3^2)", "R_F(Q_1^2, Q_2^2, Q_3^2)");
                let mut sum = Sum::default();
                sum.add(arena, notation, &unit, integral);
                let (text, latex) = symbols(custom);
                list.push(sum.of(&text, &latex));
            }
        }
        list
    }

    /// The potentials that no formula in base functions gives, as summands of `H`.
    #[must_use]
    pub fn potentials(&self) -> Vec<Formula> {
        let is_potential = |custom: &&Custom| matches!(custom.role, Role::Potential { .. });
        let formula = |custom: &Custom| {
            let (text, latex) = symbols(custom);
            Formula { text, latex }
        };
        self.customs.iter().filter(is_potential).map(formula).collect()
    }
}

/// Names of what is computed, in text and LaTeX.
fn symbols(custom: &Custom) -> (String, String) {
    if let By::SelfGravity(_) = custom.by {
        return ("U_g".to_owned(), "U_{\\mathrm{g}}".to_owned());
    }
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
fn custom_names(custom: &Custom, chart: &Chart) -> [Option<Summand>; 2] {
    let (name, latex) = symbols(custom);
    let around = |before: (&str, &str), after: (&str, &str)| {
        let text = format!("{}{name}{}", before.0, after.0);
        Some(Summand::plus(text, format!("{}{latex}{}", before.1, after.1)))
    };
    let (phi, inverse, none) = ((" phi", " \\varphi"), ("phi^-1 ", "\\varphi^{-1} "), ("", ""));
    let slope = |left: (&str, &str), right: (&str, &str)| {
        let text = format!("{}(d{name}/dphi)^T{}", left.0, right.0);
        Some(Summand::minus(text, format!("{}(\\partial {latex}/\\partial\\varphi)^T{}", left.1, right.1)))
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
                Some(Linear::Body) => ("phi^T ", "\\varphi^T "),
                _ => none,
            };
            let on_centre = moves.then(|| {
                let latex = format!("{}\\partial {latex}/\\partial x", pull.1);
                Summand::minus(format!("{}d{name}/dx", pull.0), latex)
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

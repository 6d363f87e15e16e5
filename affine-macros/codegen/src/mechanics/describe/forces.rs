//! Forces that no potential has, as formulas.

use crate::algebra::{Arena, Rational};
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::custom::{By, Custom, On, Role};
use crate::mechanics::forces::Forces;
use crate::mechanics::notation::{Notation, field_index, letters, placement, product, rate, slope, trace};
use crate::mechanics::term::Frame;
use crate::symbol::Quantity;

use super::{Sentence, Sum, Summand, centre_velocity, quadratic_terms};

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
            let drag = slope(letters::RAYLEIGH, rate(letters::CENTRE));
            linear.push(Summand::minus(on_linear(chart, drag)));
        }
        if !dissipation.parts.is_empty() {
            let velocity = match chart.momentum {
                Momentum::Body => letters::COMOVING_AFFINE_VELOCITY.into(),
                Momentum::Space | Momentum::Total => letters::AFFINE_VELOCITY.into(),
                Momentum::Canonical => rate(letters::PLACEMENT),
            };
            affine.push(Summand::minus(slope(letters::RAYLEIGH, velocity).transposed()));
        }
    }

    /// What defines them, and the balance of energy.
    pub fn formulas(&self, arena: &mut Arena, notation: &Notation) -> Vec<Sentence> {
        let mut list = Vec::new();
        let mut power: Vec<Summand> = Vec::new();
        if let Some(dissipation) = &self.dissipation {
            let mut sum = Sum::default();
            for part in &dissipation.parts {
                quadratic_terms(arena, notation, &mut sum, part.form.frame, &part.form.terms);
            }
            for (frame, coefficient) in &dissipation.centre {
                let square = centre_velocity(*frame).length_squared();
                sum.add(arena, notation, &coefficient.scaled(&Rational::HALF), square);
            }
            let terms = dissipation.parts.iter().flat_map(|part| &part.form.terms);
            list.push(sum.of(letters::RAYLEIGH).with(notation.matrices_in(terms)));
            let two = arena.constant(Rational::from(2));
            power.push(Summand::minus(Sentence::Multiple(two, Box::new(letters::RAYLEIGH.into()))));
        }
        for custom in &self.customs {
            let Role::Force { on, gyroscopic: false, .. } = custom.role else { continue };
            power.push(Summand::plus(match on {
                On::Space => trace(product([symbol(custom), letters::AFFINE_VELOCITY.into()])),
                On::Body => trace(product([symbol(custom), letters::COMOVING_AFFINE_VELOCITY.into()])),
                On::Centre => Sentence::Inner(Box::new([symbol(custom), rate(letters::CENTRE)])),
            }));
        }
        if self.driven {
            power.push(Summand::plus(Sentence::SlopeAtRest(letters::POTENTIAL)));
        }
        if !power.is_empty() {
            list.push(Sum::new(power).of(rate(letters::HAMILTONIAN)));
        }
        list
    }

    /// What of the potentials that are summands of `H` has a formula.
    pub(in crate::mechanics) fn definitions(&self, arena: &mut Arena, notation: &Notation) -> Vec<Sentence> {
        let mut list = Vec::new();
        for custom in &self.customs {
            if let By::SelfGravity(strength) = custom.by {
                let unit = By::SelfGravity(strength).unit(arena);
                let stretch = |a: usize| {
                    let stretch = arena.symbol(Quantity::Stretches.at([a]));
                    notation.scalar(arena, stretch).power(2)
                };
                let integral = Sentence::Applied(letters::CARLSON_RF, [1, 2, 3].map(stretch).into());
                let mut sum = Sum::default();
                sum.add(arena, notation, &unit, integral);
                list.push(sum.of(symbol(custom)));
            }
        }
        list
    }

    /// The potentials that no formula in base functions gives, as summands of `H`.
    pub fn potentials(&self) -> Vec<Sentence> {
        let is_potential = |custom: &&Custom| matches!(custom.role, Role::Potential { .. });
        self.customs.iter().filter(is_potential).map(symbol).collect()
    }
}

/// What is computed.
fn symbol(custom: &Custom) -> Sentence {
    if let By::SelfGravity(_) = custom.by {
        return letters::SELF_GRAVITY.into();
    }
    let letter = match custom.role {
        Role::Potential { .. } => letters::POTENTIAL,
        Role::Force { on: On::Space, .. } => letters::AFFINE_FORCE,
        Role::Force { on: On::Body, .. } => letters::COMOVING_AFFINE_FORCE,
        Role::Force { on: On::Centre, .. } => letters::FORCE,
    };
    Sentence::OfField(letter, field_index(&custom.name))
}

/// The force on the linear momentum of a chart that one on `p` is: on `p_hat` pulled back.
pub(super) fn on_linear(chart: &Chart, force: Sentence) -> Sentence {
    match chart.linear {
        Some(Linear::Body) => product([placement().transposed(), force]),
        _ => force,
    }
}

/// The force on the affine momentum of a chart that one on `Pi` is.
pub(super) fn on_affine(chart: &Chart, force: Sentence) -> Sentence {
    match chart.frame() {
        Frame::Body => product([force, placement()]),
        Frame::Space => product([placement(), force]),
        Frame::Flat => force,
    }
}

/// What a field adds to the forces on the linear and the affine momentum of a chart.
fn custom_names(custom: &Custom, chart: &Chart) -> [Option<Summand>; 2] {
    let force = symbol(custom);
    let inverse = || placement().inverse();
    match custom.role {
        Role::Force { on: On::Centre, .. } => [Some(Summand::plus(on_linear(chart, force))), None],
        Role::Force { on, .. } => {
            let force = match (on, chart.frame()) {
                (On::Space, Frame::Space) | (On::Body, Frame::Body) => force,
                (On::Space, _) => on_affine(chart, product([inverse(), force])),
                _ => on_affine(chart, product([force, inverse()])),
            };
            [None, Some(Summand::plus(force))]
        }
        Role::Potential { moves, .. } => {
            let on_centre =
                moves.then(|| Summand::minus(on_linear(chart, slope(force.clone(), letters::CENTRE))));
            let push = slope(force, letters::PLACEMENT).transposed();
            [on_centre, Some(Summand::minus(on_affine(chart, push)))]
        }
    }
}

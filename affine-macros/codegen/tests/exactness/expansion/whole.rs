//! A model with a constant mass matrix: its whole equations, and each of its reductions held against them.

use std::collections::BTreeSet;

use affine_codegen::algebra::{Arena, Polynomial};
use affine_codegen::mechanics::body::Body;
use affine_codegen::mechanics::charts::{Chart, Coordinate, Momentum};
use affine_codegen::mechanics::closed_form::ClosedForm;
use affine_codegen::mechanics::conserved::{Candidate, Conservation};
use affine_codegen::mechanics::equations::{Form as Way, System};
use affine_codegen::mechanics::forces::Forces;
use affine_codegen::mechanics::form::Form;
use affine_codegen::mechanics::hamiltonian::Hamiltonian;
use affine_codegen::mechanics::kinetics::Kinetics;
use affine_codegen::mechanics::loads::beside;
use affine_codegen::mechanics::motion::Motion;
use affine_codegen::mechanics::potential::Potential;
use affine_codegen::mechanics::reduction::drift::Drift;
use affine_codegen::mechanics::reduction::{Reduction, Wanted, reductions};
use affine_codegen::mechanics::separation::{Separation, Slope as Separated};
use affine_codegen::mechanics::term::Frame;
use affine_codegen::symbol::Quantity;
use affine_oracle::Random;

use super::equations::{AtPoint, Named, value};
use super::number::{Jet, Number, Table};
use super::point::{Dilatation, Phase, Point, Slope, Taken};

/// Tries for a point at which the functions of a model have values.
pub(super) const TRIES: usize = 40;

pub(super) struct Whole {
    args: String,
    arena: Arena,
    motion: Motion,
    h: Hamiltonian,
    potential: Option<Potential>,
    forces: Forces,
    /// The chart of the model's own frame, and Hamilton's equations in it with all forces.
    own: Chart,
    full: System,
    /// Do rotations of space leave the motion as it is?
    rotations: bool,
}

impl Whole {
    pub(super) fn new(args: &str, form: Form) -> Self {
        let Form { mut arena, parts, mass, stated, potential, forces, .. } = form;
        let motion = Motion::new(&mut arena, parts, mass, stated.as_ref()).expect("a regular energy");
        let h = motion.hamiltonian().expect("one frame").clone();
        let own = motion.chart(&mut arena, true);
        let energy = h.energy_in(&own);
        let kinetics = Kinetics::polynomial(&mut arena, &own, &energy);
        let mut full = kinetics.system(Way::ThroughVelocity);
        let weight: Vec<_> = h.weight.iter().map(|weight| weight.load(&own, &h.internal())).collect();
        let acting = beside(&mut arena, &own, &h.centre_velocity(), potential.as_ref(), &forces);
        weight.iter().chain(&acting).for_each(|load| full.add(load));
        let keeps = |candidate| potential.as_ref().is_none_or(|u| u.keeps(candidate));
        let moving: Vec<_> = weight.into_iter().chain([kinetics.load()]).collect();
        let mut kept = Conservation::of(&own, None);
        kept.under(&arena, &moving);
        let rotations = kept.whole.contains(&Candidate::TotalAngularMomentum)
            && keeps(Candidate::TotalAngularMomentum)
            && forces.are_isotropic_in_space();
        Self { args: args.to_owned(), arena, motion, h, potential, forces, own, full, rotations }
    }

    /// Are the equations ever asked for with a momentum for each position?
    pub(super) fn has_halves(&self) -> bool {
        self.h.isotropic.is_none()
    }

    pub(super) fn is_free(&self) -> bool {
        self.potential.is_none() && self.forces.is_empty()
    }

    /// The fields, and the inverses of the blocks of the mass matrix that need their values.
    fn coefficients(&self, random: &mut Random) -> Named {
        let fields = ["a", "b", "i", "m"].map(|name| (format!("self.{name}"), Number::random(random)));
        let mut named = Named::from(fields);
        for block in &self.h.numeric_blocks {
            let entry = |p: &Polynomial| value(&self.arena, p, &named).expect("a coefficient");
            let form: Vec<Vec<Number>> =
                block.form.iter().map(|row| row.iter().map(entry).collect()).collect();
            let inverse = Table::constant(&form).inverse().values().concat();
            let symbols = block.inverse.concat();
            let name = |symbol| self.arena.symbol_name(symbol);
            named.extend(symbols.into_iter().map(name).zip(inverse));
        }
        named
    }

    /// What a reduction took out, with these coefficients.
    fn taken(&self, reduction: &Reduction, coefficients: &Named) -> Taken {
        let number = |p: &Polynomial| value(&self.arena, p, coefficients).expect("a coefficient");
        let dilatation = |separation: &Separation| Dilatation {
            alpha: number(&self.h.isotropic.as_ref().expect("an isotropic energy").casimir2).inverse(),
            inverse_mass: number(&separation.inverse_mass),
            slope: match &separation.slope {
                Separated::Zero => Slope::Zero,
                Separated::Linear(stiffness) => Slope::Linear(number(stiffness)),
                Separated::Hyperbolic { stiffness, scale } => {
                    let twice = (scale * &2.into()).to_i64().expect("a power of D");
                    Slope::Hyperbolic(number(stiffness), twice)
                }
            },
        };
        let dilatation = reduction.dilatation.as_ref().map(dilatation);
        Taken::new(self.h.constraint, reduction, dilatation, &number)
    }

    /// Every way to reduce the motion against the whole one, with a momentum for each position or not; what they take out.
    pub(super) fn check(&mut self, random: &mut Random, halves: bool) -> BTreeSet<&'static str> {
        let Self { arena, motion, potential, forces, rotations, .. } = self;
        let body = Body { motion, potential: potential.as_ref(), forces };
        let wanted = Wanted { rotations: *rotations, halves, pieces: false };
        let ways = reductions(arena, &body, wanted).expect("equations");
        assert!(!ways.is_empty(), "{}", self.args);
        let rests: Vec<bool> = ways.iter().map(|way| self.check_one(random, way)).collect();
        for (way, resting) in ways.iter().zip(&rests) {
            if halves {
                self.every_position_has_a_momentum(way);
            }
            // Written through the velocity, what cancels is not seen to; then another way leaves it out.
            let alike = |other: &Reduction| other.chart.momentum == way.chart.momentum;
            let left_out = || ways.iter().zip(&rests).any(|(other, rests)| alike(other) && !rests);
            assert!(halves || !resting || left_out(), "{}: a momentum rests", self.described(way));
        }
        ways.iter().flat_map(left_out).collect()
    }

    /// The expansion of a reduced motion against the whole one, at a random point; does a momentum rest that is state?
    fn check_one(&self, random: &mut Random, reduction: &Reduction) -> bool {
        let coefficients = self.coefficients(random);
        let taken = self.taken(reduction, &coefficients);
        for _ in 0..TRIES {
            let point = Point::random(random, &taken);
            let mut here = point.reduced(&taken);
            here.extend(coefficients.clone());
            let Some(rates) = self.rates(&reduction.system, &here, &point) else { continue };
            let phase = point.expanded(&taken, &rates);
            let (mut there, moving) = phase.coordinates(self.h.frame);
            there.extend(coefficients.clone());
            there.insert("t".to_owned(), point.t);
            let Some(expected) = self.rates(&self.full, &there, &point) else { continue };
            for (name, expected) in &expected {
                let found = if name == "work" { &rates[name] } else { &moving[name] };
                assert_eq!(found, expected, "{name} of {}", self.described(reduction));
            }
            follows_the_placement(&self.described(reduction), &point, &phase, &rates);
            return self.has_a_resting_momentum(reduction, &rates);
        }
        panic!("no point of {} at which its functions have values", self.args);
    }

    fn described(&self, reduction: &Reduction) -> String {
        format!("{}, reduced to {:?}", self.args, sizes(reduction))
    }

    fn rates(&self, system: &System, here: &Named, point: &Point) -> Option<Named> {
        AtPoint::new(&self.arena, system, here, &point.stretches.each).rates()
    }

    fn every_position_has_a_momentum(&self, reduction: &Reduction) {
        let (chart, what) = (&reduction.chart, self.described(reduction));
        assert_eq!(chart.momentum, Momentum::of(self.h.frame), "{what}");
        let count =
            |wanted: fn(&Coordinate) -> bool| chart.independent().iter().filter(|z| wanted(z)).count();
        let size = |quantity: Quantity| {
            sizes(reduction).iter().find(|(group, _)| *group == quantity).map_or(0, |(_, size)| *size)
        };
        assert_eq!(size(chart.momentum.quantity()), count(|z| matches!(z, Coordinate::M(..))), "{what}");
    }

    fn has_a_resting_momentum(&self, reduction: &Reduction, rates: &Named) -> bool {
        let pulled = self.potential.as_ref().is_some_and(Potential::moves_the_centre);
        if self.h.constraint.is_some() || pulled || !self.forces.customs.is_empty() {
            // On a group more rests than polynomials tell, and forces with a name of their own may cancel.
            return false;
        }
        let listed = |wanted: fn(&Coordinate) -> bool| -> Vec<Number> {
            let listed = reduction.system.rates.iter().filter(|(z, ..)| wanted(z));
            listed.map(|(_, symbol, _)| rates[&self.arena.symbol_name(*symbol)]).collect()
        };
        // p leaves the state as a whole.
        let pushes = listed(|z| matches!(z, Coordinate::P(_)));
        let rests = !pushes.is_empty() && pushes.iter().all(|push| *push == Number::ZERO);
        rests || listed(|z| matches!(z, Coordinate::M(..))).contains(&Number::ZERO)
    }

    /// The closed form of the motion without forces: it is found exactly where `Sigma' = [Sigma, W]` with the generator `W`
    /// of the rotation that the skew part of the energy makes, for `Pi` where that rests.
    pub(super) fn check_closed_form(&mut self, random: &mut Random) {
        let Self { arena, motion, h, forces, .. } = self;
        let drift = Drift::of(arena, &Body { motion, potential: None, forces });
        let found = ClosedForm::of(h).map(|form| (form, h.translation.is_some() && drift.is_none()));
        let form = match self.h.frame {
            Frame::Body => ClosedForm::Body,
            Frame::Space => ClosedForm::Space,
            Frame::Flat => ClosedForm::Straight,
        };
        let bent = self.h.frame == Frame::Flat && self.h.constraint.is_some();
        let expected = match (self.is_closed(random, false), self.is_closed(random, true)) {
            _ if bent => None,
            (true, _) => Some((form, false)),
            (false, true) => Some((form, true)),
            (false, false) => None,
        };
        assert_eq!(found, expected, "{}", self.args);
    }

    /// Has the motion through a random point the closed form?
    fn is_closed(&self, random: &mut Random, at_rest: bool) -> bool {
        let coefficients = self.coefficients(random);
        let taken = Taken::of(self.h.constraint, &self.own, false);
        let point = Point::random(random, &taken);
        let point = if at_rest { point.at_rest() } else { point };
        let mut here = point.reduced(&taken);
        here.extend(coefficients.clone());
        let rates = self.rates(&self.full, &here, &point).expect("polynomials alone");
        let momentum = point.moving_momentum(&taken, &rates);
        let rates = momentum.rates();
        if self.h.frame == Frame::Flat {
            return rates == Table::zero(rates.size());
        }
        let Some(iso) = &self.h.isotropic else { return false };
        let inverse_mu = value(&self.arena, &iso.skew, &coefficients).expect("a coefficient");
        let spin = Table::constant(&momentum.values());
        let generator = spin.skew().scaled(Jet::constant(-inverse_mu));
        let commutator = &(&spin * &generator) - &(&generator * &spin);
        let zero = Table::zero(spin.size());
        rates == if self.h.frame == Frame::Body { commutator } else { &zero - &commutator }
    }
}

/// The groups of the state and their sizes.
fn sizes(reduction: &Reduction) -> Vec<(Quantity, usize)> {
    reduction.states.iter().map(|(group, symbols)| (*group, symbols.len())).collect()
}

/// What a reduction takes out of the state.
fn left_out(reduction: &Reduction) -> Vec<&'static str> {
    let rotation = reduction.commuting.rotation.as_ref().map(|rotation| match rotation.frame {
        Frame::Body => "|Vort|^2",
        _ => "|S|^2",
    });
    let drift = reduction.commuting.drift.as_ref().map(|_| "drift");
    let mut list: Vec<&'static str> = rotation.into_iter().chain(drift).collect();
    let chart = &reduction.chart;
    let pushed = sizes(reduction)
        .iter()
        .any(|(group, _)| [Quantity::LinearMomentum, Quantity::ComovingLinearMomentum].contains(group));
    let slope = reduction.dilatation.as_ref().map(|separation| match separation.slope {
        Separated::Zero => "free dilatation",
        Separated::Linear(_) => "harmonic dilatation",
        Separated::Hyperbolic { .. } => "hyperbolic dilatation",
    });
    let said = |holds: bool, what: &'static str| holds.then_some(what);
    list.extend(slope);
    list.extend(said(chart.linear.is_some() && !pushed, "p"));
    list.extend(said(reduction.turn.is_some(), "turn of space"));
    list.extend(said(reduction.conserved.affine, chart.momentum.symbol()));
    list.extend(said(!reduction.conserved.components.is_empty(), "entries"));
    list.extend(said(!reduction.carried.is_empty(), "root or logarithm"));
    list
}

/// `1/D` and `q`, where they are integrated, follow `phi`: `D' = D tr(phi^-1 phi')/n`.
pub(super) fn follows_the_placement(what: &str, point: &Point, phase: &Phase, rates: &Named) {
    let n = phase.phi.size();
    let velocity = &Table::constant(&phase.phi.values()).inverse() * &phase.phi.rates();
    let growth = velocity.trace().value * Number::integer(n as i64).inverse();
    let inverse = point.stretches.mean.inverse();
    for (name, expected) in [("inverse_dilatation", -(inverse * growth)), ("q", growth)] {
        if let Some(found) = rates.get(name) {
            assert_eq!(*found, expected, "{name} of {what}");
        }
    }
}

//! What has to be integrated: each step takes something out of it that is known without integration, and that the constants
//! of a trajectory tell.
//!
//! | step | takes out |
//! |---|---|
//! | [`rotation`] | the skew part of an isotropic energy |
//! | [`drift`] | a centre of mass that moves freely |
//! | [`dilatation`] | a mean stretch that moves by itself |
//! | [`carried`] | the root and the logarithm of `det phi` |
//! | [`conserved`] | momenta that are conserved |
//! | [`turn`] | components that vanish once space is turned |
//!
//! The first two are summands of `H` that commute with the rest; the others act on the equations of the rest.

pub mod carried;
pub mod conserved;
pub mod dilatation;
pub mod drift;
pub mod left_out;
mod passing;
pub mod rotation;
pub mod turn;

use crate::algebra::{Arena, Expr, Polynomial};

use super::body::Body;
use super::charts::{Chart, Coordinate, Linear, Momentum};
use super::equations::System;
use super::separation::Separation;
use super::term::Frame;
use crate::symbol::Quantity;
use carried::Carried;
use conserved::Conserved;
use drift::Drift;
use left_out::LeftOut;
use rotation::Rotation;
use turn::Turn;

/// What is left to integrate once conserved momenta, symmetries and summands of `H` in involution are used.
#[derive(Clone, Debug)]
#[must_use]
pub struct Reduction {
    /// Its chart.
    pub chart: Chart,
    /// The summands of `H` that are not part of it.
    pub commuting: Commuting,
    /// The motion of the dilatation where that is no part of it; the state is then `Psi` and `sigma/alpha`.
    pub dilatation: Option<Separation>,
    /// Functions of `det phi` that are state, so that no right-hand side takes a root or a logarithm.
    pub carried: Vec<Carried>,
    /// Momenta that are constants of a trajectory.
    pub conserved: Conserved,
    /// How space is turned.
    pub turn: Option<Turn>,
    /// The equations of the state variables.
    pub system: System,
    /// State variables: group name and symbols.
    pub states: Vec<(Quantity, Vec<Expr>)>,
}

/// Summands of `H` that commute with the rest and whose flows are known.
#[derive(Clone, Debug, Default)]
pub struct Commuting {
    /// The skew part of an isotropic energy.
    pub rotation: Option<Rotation>,
    /// The energy of a free centre of mass.
    pub drift: Option<Drift>,
}

/// What is wanted of a reduction.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted {
    /// Space may be turned: its rotations leave `H` unchanged.
    pub rotations: bool,
    /// A momentum for each position, conserved or not, of an energy that has no other chart than its own.
    pub halves: bool,
    /// Pieces of `H` whose flows are known.
    pub pieces: bool,
}

/// Every way to reduce a motion: in each chart in which what is left of `H` is a polynomial, in each form of its equations.
pub fn reductions(arena: &mut Arena, body: &Body, wanted: Wanted) -> Option<Vec<Reduction>> {
    let commuting = Commuting { rotation: Rotation::of(arena, body), drift: Drift::of(arena, body) };
    let [turns, drifts] = [commuting.rotation.is_some(), commuting.drift.is_some()];
    let mut found = Vec::new();
    for (chart, separation, mut system) in dilatation::systems(arena, body, turns, drifts) {
        let conserved = Conserved::default().with_components(&mut system);
        let dilatation = Some(separation);
        found.push(Reduction { dilatation, conserved, ..Reduction::new(chart, commuting.clone(), system) });
    }
    for chart in charts(arena, body, drifts, wanted) {
        for (system, _) in body.systems_without(arena, &chart, turns)? {
            let start = Reduction::new(chart.clone(), commuting.clone(), system);
            let ways = start.steps(arena, body, wanted);
            // No other form is shorter than one without the affine momentum.
            let rests = ways.iter().any(|way| way.conserved.affine);
            found.extend(ways);
            if rests {
                break;
            }
        }
    }
    Some(found.into_iter().map(|way| way.grouped(arena)).collect())
}

/// Charts in which what is left of `H` may be a polynomial.
fn charts(arena: &mut Arena, body: &Body, drifts: bool, wanted: Wanted) -> Vec<Chart> {
    let motion = body.motion;
    let own = motion.chart(arena, !drifts);
    let Some(h) = motion.hamiltonian() else { return vec![own] };
    let others = [Momentum::Body, Momentum::Space, Momentum::Total].into_iter();
    let others = others.filter(|m| *m != own.momentum && (*m != Momentum::Total || own.linear.is_some()));
    let mut chart = |momentum, linear| Chart::new(arena, h.dim, momentum, linear).under(own.confined);
    let mut charts: Vec<Chart> = others.map(|momentum| chart(momentum, own.linear)).collect();
    // Where a force moves `p` anyway: a constant is worth more than short equations. Splitting and Nystrom steps want `p`.
    let comoving = matches!(h.translation, Some((Frame::Body, _))) && h.frame == Frame::Body;
    let comoving = comoving.then(|| chart(Momentum::Body, Some(Linear::Body)));
    charts.extend(comoving.filter(|_| !wanted.pieces && pushes_the_centre(arena, body)));
    charts.insert(0, own);
    charts
}

/// Does a force act on `p`, which the kinetic energy conserves?
fn pushes_the_centre(arena: &mut Arena, body: &Body) -> bool {
    let chart = body.motion.chart(arena, true);
    let loads = body.loads(arena, &chart, body.potential).unwrap_or_default();
    let mut all = loads.iter().flat_map(|load| &load.forces);
    all.any(|(z, force)| matches!(z, Coordinate::P(_)) && !force.is_zero())
}

impl Reduction {
    /// Nothing is taken out of a system yet but what commutes with it.
    fn new(chart: Chart, commuting: Commuting, system: System) -> Self {
        Self {
            chart,
            commuting,
            dilatation: None,
            carried: Vec::new(),
            conserved: Conserved::default(),
            turn: None,
            system,
            states: Vec::new(),
        }
    }

    /// The steps on the equations, in their order.
    fn steps(self, arena: &mut Arena, body: &Body, wanted: Wanted) -> Vec<Self> {
        let momenta_may_rest = !wanted.halves;
        let chart = &self.chart;
        let ways = carried::systems(arena, body, chart, self.system.clone()).into_iter();
        let taken = |(carried, mut system)| {
            let conserved = Conserved::of(chart, &mut system, momenta_may_rest);
            let turn = Turn::of(chart, &conserved).filter(|_| wanted.rotations);
            let mut way = Self { carried, conserved, turn, ..self.clone() };
            let taken = system.substitute(&way.gauge());
            way.system = taken.tidied(arena);
            if momenta_may_rest {
                way.conserved = way.conserved.with_components(&mut way.system);
            }
            way
        };
        ways.map(taken).collect()
    }

    /// The symbols of its state.
    pub fn symbols(&self) -> Vec<Expr> {
        self.states.iter().flat_map(|(_, symbols)| symbols.clone()).collect()
    }

    /// Zero for components of the state that vanish.
    pub fn gauge(&self) -> impl Fn(Expr) -> Option<Polynomial> {
        let vanishing = self.turn.as_ref().map_or(&[][..], |turn| &turn.vanishing);
        |atom| vanishing.contains(&atom).then(Polynomial::zero)
    }

    /// With what is left in groups.
    fn grouped(self, arena: &Arena) -> Self {
        let (placement, momentum) = match self.dilatation {
            Some(_) => (Quantity::IsochoricPlacement, Quantity::IsochoricVelocity),
            None => (Quantity::Placement, self.chart.momentum.quantity()),
        };
        let rates = &self.system.rates;
        let group = |quantity: Quantity, wanted: &dyn Fn(Coordinate, Expr) -> bool| {
            let symbols =
                rates.iter().filter(|(z, symbol, _)| wanted(*z, *symbol)).map(|(_, symbol, _)| *symbol);
            (quantity, symbols.collect::<Vec<Expr>>())
        };
        let carried = |quantity: Quantity| {
            group(quantity, &|z, symbol| {
                matches!(z, Coordinate::Carried(_)) && arena.quantity(symbol) == Some(quantity)
            })
        };
        let linear = self.chart.linear.map_or(Quantity::LinearMomentum, Linear::quantity);
        let groups = [
            group(Quantity::Position, &|z, _| matches!(z, Coordinate::X(_))),
            group(placement, &|z, _| matches!(z, Coordinate::Phi(..))),
            group(linear, &|z, _| matches!(z, Coordinate::P(_))),
            group(momentum, &|z, _| matches!(z, Coordinate::M(..))),
            carried(Quantity::InverseDilatation),
            carried(Quantity::MeanLogStretch),
            // After all rates.
            (Quantity::Work, self.system.work.iter().map(|(symbol, _)| *symbol).collect()),
        ];
        let states = groups.into_iter().filter(|(_, symbols)| !symbols.is_empty()).collect();
        Self { states, ..self }
    }

    /// What is taken out of the state, a sentence each.
    pub fn left_out(&self) -> Vec<LeftOut> {
        let Self { chart, conserved, .. } = self;
        let Commuting { rotation, drift } = &self.commuting;
        let turns = rotation.as_ref().is_some_and(|rotation| rotation.turns(chart));
        let rests = !conserved.components.is_empty();
        let mut list = Vec::new();
        list.extend(rotation.iter().map(Rotation::left_out));
        list.extend(drift.iter().map(|_| Drift::left_out()));
        list.extend(self.dilatation.iter().flat_map(|motion| dilatation::left_out(motion, chart, rests)));
        list.extend(self.carried.iter().map(|carried| carried.left_out()));
        list.extend(conserved.left_out(chart, turns));
        list.extend(self.turn.iter().map(|_| Turn::left_out()));
        list
    }
}

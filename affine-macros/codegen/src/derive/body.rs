//! A motion with what acts on it: its equations, what it conserves, how it is reduced.

use crate::algebra::{Arena, Expr, Polynomial};
use crate::mechanics::asked::Asked;
use crate::mechanics::charts::{Chart, Linear};
use crate::mechanics::conserved::{Candidate, candidates, still};
use crate::mechanics::equations::{Form, Load, System};
use crate::mechanics::forces::Forces;
use crate::mechanics::loads::beside;
use crate::mechanics::metric::Definitions;
use crate::mechanics::motion::Motion;
use crate::mechanics::potential::{Base, Potential};
use crate::mechanics::reduce::{self, ClosedForm, Commuting, Reduction};
use crate::mechanics::shared::CentreVelocity;
use crate::mechanics::term::Frame;

/// A motion under a potential and forces.
pub(super) struct Body<'a> {
    pub(super) motion: &'a Motion,
    pub(super) potential: Option<&'a Potential>,
    pub(super) forces: &'a Forces,
}

/// What a motion conserves.
pub(super) struct Kept {
    pub(super) moving: Vec<Candidate>,
    /// With `p = 0`.
    pub(super) at_rest: Vec<Candidate>,
    /// Do rotations of space leave the motion unchanged, and the forces of themselves as well? Friction takes the angular
    /// momentum all the same.
    pub(super) rotations: bool,
}

impl Body<'_> {
    /// Does nothing act on it?
    pub(super) fn is_free(&self) -> bool {
        self.potential.is_none() && self.forces.is_empty()
    }

    /// The time as a symbol, where any force depends on it.
    pub(super) fn time(&self, arena: &mut Arena) -> Option<Expr> {
        self.potential.and_then(Potential::time).or_else(|| self.forces.time(arena))
    }

    /// What is added to the equations of the energy in a chart under a potential in place of its own.
    pub(super) fn loads(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        potential: Option<&Potential>,
    ) -> Option<Vec<Load>> {
        let own = self.motion.added(arena, chart)?.into_iter();
        let mut loads: Vec<Load> = match chart.confined {
            Some(group) => own.map(|load| load.confined(arena, chart, group)).collect(),
            None => own.collect(),
        };
        if !self.forces.is_empty() {
            loads.push(self.motion.velocity_names(arena, chart));
        }
        let centre = self.motion.centre_velocity(arena);
        let mut acting = beside(arena, chart, &centre, potential, self.forces);
        // Last beside phi^-1: where a potential has a root of det phi, 1/det phi comes from that.
        if potential.is_some() && self.motion.hamiltonian().is_none() {
            acting.rotate_left(1);
        }
        loads.extend(acting);
        Some(loads)
    }

    /// Hamilton's equations of a chart, in each form that may be the shortest.
    pub(super) fn systems(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        potential: Option<&Potential>,
    ) -> Option<Vec<(System, Form)>> {
        let loads = self.loads(arena, chart, potential)?;
        let ways = self.motion.kinetics(arena, chart);
        let is_whole = self.motion.hamiltonian().is_some();
        let joined = |mut system: System| {
            for load in &loads {
                if !is_whole {
                    // What two of them use has one name.
                    system.shared.retain(|(symbol, _)| !load.shared.iter().any(|(s, _)| s == symbol));
                }
                system.add(load);
            }
            if is_whole { system } else { system.tidied(arena) }
        };
        Some(ways.into_iter().map(|(kinetics, form)| (joined(kinetics.system(form)), form)).collect())
    }

    /// What is conserved by the kinetic energy, and then by what is added to it.
    pub(super) fn kept(&self, arena: &mut Arena) -> Option<Kept> {
        let (motion, forces) = (self.motion, self.forces);
        let [chart, resting] = [true, false].map(|moving| motion.chart(arena, moving));
        let whole = motion.loads(arena, &chart)?;
        let internal = motion.loads(arena, &resting)?;
        let mut moving = still(arena, &chart, &whole, candidates(&chart));
        // Translation dropped, and with it what it alone makes meaningful.
        let mut at_rest = match chart.linear {
            None => moving.clone(),
            Some(_) => still(arena, &resting, &internal, candidates(&resting)),
        };
        if let Some(reaction) = self.multiplier(arena) {
            moving.retain(|candidate| reaction.keeps(*candidate));
            at_rest.retain(|candidate| reaction.keeps(*candidate));
        }
        if let Some(u) = self.potential {
            moving.retain(|candidate| u.keeps(*candidate));
            at_rest.retain(|candidate| u.keeps(*candidate));
            // A force on the centre of mass does not leave it at rest.
            if u.moves_the_centre() {
                at_rest.clone_from(&moving);
            }
        }
        // Of the undamped motion: the forces are held against the same rotations on their own.
        let rotations = moving.contains(&Candidate::TotalAngularMomentum) && forces.are_isotropic_in_space();
        if !forces.is_empty() {
            let mut defined = |chart: &Chart, loads: &[Load]| -> Definitions {
                let names = motion.velocity_names(arena, chart);
                loads.iter().chain([&names]).flat_map(|load| load.shared.clone()).collect()
            };
            let [of_whole, of_internal] = [defined(&chart, &whole), defined(&resting, &internal)];
            let centre = motion.centre_velocity(arena);
            moving = forces.keep(arena, &chart, (&centre, &of_whole), moving);
            at_rest = match forces.push_from_rest() {
                true => moving.clone(),
                false => {
                    let fixed = (&CentreVelocity::Fixed, &of_internal);
                    forces.at_rest().keep(arena, &resting, fixed, at_rest)
                }
            };
        }
        Some(Kept { moving, at_rest, rotations })
    }

    /// The force of the multiplier of a constraint that acts through one: it has the directions of that of a potential in
    /// `q`, and no other is known of it.
    fn multiplier(&self, arena: &mut Arena) -> Option<Potential> {
        let acts = self.motion.constraint().is_some() && self.motion.confined().is_none();
        acts.then(|| {
            let q = Base::MeanLogStretch.symbol(arena);
            Potential::new(arena, self.motion.dim(), q)
        })
    }

    /// The closed form of the geodesics, and whether it needs `p = 0`: with masses in both frames that of the internal motion.
    pub(super) fn closed_form(&self, arena: &mut Arena) -> Option<(ClosedForm, bool)> {
        let (_, h) = self.motion.polynomial().filter(|_| self.is_free())?;
        let commuting = reduce::commuting(arena, h, None, self.forces);
        let (form, at_rest) = reduce::closed_form(h, &commuting)?;
        Some((form, at_rest || self.motion.masses.are_mixed()))
    }

    /// What has to be integrated, in each way that may be the shortest.
    pub(super) fn reductions(
        &self,
        arena: &mut Arena,
        rotations: bool,
        asked: Asked,
    ) -> Option<Vec<Reduction>> {
        if let Some(h) = self.motion.hamiltonian() {
            // The squares of an anisotropic energy move each momentum, also one that their sum conserves.
            let in_squares = h.isotropic.is_none() && h.frame != Frame::Flat;
            let halves = asked.nystrom || (asked.splitting && in_squares);
            let wanted = (rotations, halves, asked.nystrom || asked.splitting);
            return Some(reduce::candidates(arena, h, self.potential, self.forces, wanted));
        }
        let drift = self.drifts();
        let chart = self.motion.chart(arena, drift.is_none());
        let commuting = match drift {
            Some(mass) => {
                let reciprocal = arena.pow(mass, -1)?;
                vec![Commuting::Drift(Polynomial::normal_form(arena, reciprocal))]
            }
            None => Vec::new(),
        };
        let turn = rotations && chart.linear == Some(Linear::Space);
        let systems = self.systems(arena, &chart, self.potential)?;
        let reduced = |(system, _)| reduce::reduced(arena, chart.clone(), commuting.clone(), turn, system);
        Some(systems.into_iter().map(reduced).collect())
    }

    /// `|p|^2/(2m)` commutes with what contains neither `x` nor `p`.
    fn drifts(&self) -> Option<Expr> {
        let masses = &self.motion.masses;
        let free = masses.body.is_none()
            && self.potential.is_none_or(|u| !u.moves_the_centre())
            && self.forces.leave_the_centre();
        masses.space.filter(|_| free)
    }
}

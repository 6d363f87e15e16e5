//! A motion with what acts on it, and its equations.

use crate::algebra::{Arena, Expr};

use super::charts::Chart;
use super::equations::{Form, Load, System};
use super::forces::Forces;
use super::kinetics::Kinetics;
use super::loads::beside;
use super::motion::Motion;
use super::potential::Potential;

/// A motion under a potential and forces.
#[derive(Clone, Copy)]
pub struct Body<'a> {
    /// Kinetic energies, masses and the inverse Legendre transformation.
    pub motion: &'a Motion,
    /// The potential, where there is one.
    pub potential: Option<&'a Potential>,
    /// The forces that no potential has.
    pub forces: &'a Forces,
}

impl Body<'_> {
    /// Does nothing act on it?
    pub fn is_free(&self) -> bool {
        self.potential.is_none() && self.forces.is_empty()
    }

    /// The time as a symbol, where any force depends on it.
    pub fn time(&self, arena: &mut Arena) -> Option<Expr> {
        self.potential.and_then(Potential::time).or_else(|| self.forces.time(arena))
    }

    /// What programs over a chart read: its coordinates, and the time.
    pub fn inputs(&self, arena: &mut Arena, chart: &Chart) -> Vec<Expr> {
        let mut inputs = chart.symbols();
        inputs.extend(self.time(arena));
        inputs
    }

    /// What is added to the equations of the energy in a chart under a potential in place of its own.
    pub fn loads(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        potential: Option<&Potential>,
    ) -> Option<Vec<Load>> {
        let own = self.motion.added(arena, chart)?.into_iter();
        let mut loads: Vec<Load> = own.map(|load| load.confined(arena, chart)).collect();
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

    /// Hamilton's equations of a chart under a potential in place of its own, in each form that may be the shortest.
    pub fn systems(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        potential: Option<&Potential>,
    ) -> Option<Vec<(System, Form)>> {
        let ways = self.motion.kinetics(arena, chart);
        self.joined(arena, chart, ways, potential)
    }

    /// Those of what is left of the energy once its skew part, on demand, and the energy of a centre of mass that the chart
    /// does not have are split off; none where that is no polynomial in the chart.
    pub fn systems_without(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        skew: bool,
    ) -> Option<Vec<(System, Form)>> {
        let mut ways = self.motion.kinetics_without(arena, chart, skew);
        if ways.is_empty() {
            return Some(Vec::new());
        }
        ways.sort_by_key(|(_, form)| *form != Form::Expanded);
        self.joined(arena, chart, ways, self.potential)
    }

    /// Equations of an energy with all that is added to them.
    fn joined(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        ways: Vec<(Kinetics, Form)>,
        potential: Option<&Potential>,
    ) -> Option<Vec<(System, Form)>> {
        let loads = self.loads(arena, chart, potential)?;
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
}

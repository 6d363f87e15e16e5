//! What potential and forces add to Hamilton's equations.

use crate::algebra::Arena;
use crate::algebra::ring::table;
use crate::algebra::substitute::listed;

use super::charts::{Chart, Coordinate};
use super::equations::Load;
use super::forces::Forces;
use super::potential::Potential;
use super::shared::CentreVelocity;

/// What the potential and the forces add to Hamilton's equations of a chart, under a constraint projected; `centre` says how
/// the velocity of the centre of mass is known. The power of the forces comes with it, and where it is accounted for `dU/dt`
/// of a potential that depends on the time: `dH/dt` is their sum.
pub fn beside(
    arena: &mut Arena,
    chart: &Chart,
    centre: &CentreVelocity,
    potential: Option<&Potential>,
    forces: &Forces,
) -> Vec<Load> {
    let mut loads = Vec::new();
    loads.extend(potential.map(|u| of_potential(arena, chart, u, forces)));
    let pushes = forces.loads(arena, chart, centre).into_iter();
    loads.extend(pushes.map(|load| load.confined(arena, chart)));
    loads
}

/// What a potential adds, with `dU/dt` where that is accounted for.
pub(super) fn of_potential(arena: &mut Arena, chart: &Chart, u: &Potential, forces: &Forces) -> Load {
    let load = u.load(arena, chart);
    Load { work: load.work.filter(|_| forces.accounted), ..load }
}

impl Load {
    /// The same, where the motion is confined to a group: of the forces on the affine momentum the part that acts on its Lie
    /// algebra, and entries of momentum and velocity that are linear in others written through those.
    pub fn confined(mut self, arena: &mut Arena, chart: &Chart) -> Self {
        let Some(group) = chart.confined else { return self };
        let projected = group.projected(&table(chart.dim, |a, b| self.force(Coordinate::M(a, b))));
        for (z, force) in &mut self.forces {
            if let Coordinate::M(a, b) = z {
                *force = projected[*a][*b].clone();
            }
        }
        let dependent = [chart.dependent(), group.dependent(&chart.velocity(arena))].concat();
        self.mapped(&mut |p| p.substitute(&listed(&dependent)))
    }
}

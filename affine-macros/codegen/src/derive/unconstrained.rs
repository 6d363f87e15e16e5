//! The equations of a body without its constraint, for a method that solves for the multiplier step by step.

use crate::algebra::Arena;
use crate::algebra::bind::Constants;
use crate::mechanics::body::Body;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::custom::Role;
use crate::mechanics::forces::Forces;
use crate::mechanics::form::Mass;
use crate::mechanics::hessian::Hessian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::motion::Motion;
use crate::mechanics::potential::Potential;
use crate::mechanics::term::Term;

use super::equations::Equations;

/// The motion without the constraint `det phi = 1`, where its equations are `phi' = T'(Pi)`, `Pi' = F(t, phi)`: those of masses
/// under forces that depend on positions alone.
pub(super) fn motion(arena: &mut Arena, confined: &Motion, forces: &Forces) -> Option<Motion> {
    let is_of_masses = confined.constraint() == Some(Constraint::Isochoric)
        && confined.internal().all(Kinetic::is_dalembert)
        && confined.masses.body.is_none();
    let at_rest = |role: Role| matches!(role, Role::Potential { .. } | Role::Force { at_rest: true, .. });
    if !is_of_masses
        || forces.dissipation.is_some()
        || !forces.customs.iter().all(|custom| at_rest(custom.role))
    {
        return None;
    }
    let terms: Vec<Term> = confined.parts.iter().flat_map(|part| part.terms.clone()).collect();
    let kinetic = Kinetic::new(arena, confined.dim(), &terms).ok()?;
    let mass = Mass::Constant(Hessian::new(&kinetic));
    Motion::new(arena, vec![kinetic], mass, None)
}

/// Its equations over `phi` and `Pi`, with the work of its forces.
pub(super) fn equations(
    arena: &mut Arena,
    motion: &Motion,
    (potential, forces): (Option<&Potential>, &Forces),
    coefficients: &mut Constants,
) -> Option<Equations> {
    let chart = motion.full_chart(arena);
    Body { motion, potential, forces }.full_equations(arena, &chart, (potential, true), coefficients)
}

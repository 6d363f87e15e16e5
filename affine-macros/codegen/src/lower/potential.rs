//! The potential energy as the user wrote it, and where it has a value.

use super::base_functions::{Reading, value};
use super::{components, domain};
use crate::algebra::residue::depends_on;
use crate::algebra::{Arena, Expr};
use crate::mechanics::metrics::{Metrics, Rebased};
use crate::mechanics::potential::Guard;
use crate::mechanics::potential::stretches::{canonical, is_stretched};
use crate::spec::Spec;

/// The potential energy, if the model states one that is not constant, and where it has a value: expressions in the symbols
/// of [base functions](crate::mechanics::potential::Base). Beside metrics these stand in orthonormal bases; what `prepare()`
/// has to know of them is added to `rebased`.
pub fn potential(
    arena: &mut Arena,
    spec: &Spec,
    metrics: Option<&Metrics>,
    rebased: &mut Vec<Rebased>,
) -> Option<(Expr, Vec<Guard>)> {
    let written = &spec.potential.as_ref()?.energy;
    let (n, given) = (spec.dim.value, metrics.is_some());
    let mut energy = value(arena, n, written, Reading { difference: None, given })?;
    let mut domain = domain::guards(arena, n, written, given);
    if let Some(metrics) = metrics {
        let mut all = vec![energy];
        all.extend(domain.iter().map(|guard| guard.value));
        let mut carried = components::carried(arena, n, &all, metrics, rebased)?.into_iter();
        energy = carried.next()?;
        domain.iter_mut().zip(carried).for_each(|(guard, value)| guard.value = value);
    }
    if is_stretched(arena, n, energy) {
        // It decides; what needs the single stretches after all stays as it is written.
        let symmetric = canonical(arena, n, energy);
        if !is_stretched(arena, n, symmetric) {
            energy = symmetric;
        }
    }
    // A constant moves nothing and leaves no trace.
    depends_on(arena, energy, &|_| None).then_some((energy, domain))
}

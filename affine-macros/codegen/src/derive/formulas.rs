//! A derivation as formulas.

use crate::algebra::Arena;
use crate::mechanics::body::Body;
use crate::mechanics::charts::Chart;
use crate::mechanics::closed_form::ClosedForm;
use crate::mechanics::describe::{self, Notation, Sentence};
use crate::mechanics::mixed::{self, ForceNames};
use crate::mechanics::reduction::Reduction;
use crate::mechanics::reduction::left_out::Scope;

use super::model::Formulas;

impl Body<'_> {
    /// `T`, `H`, Hamilton's equations in a chart, the reduced ones, and what these leave out.
    pub(super) fn formulas(
        &self,
        arena: &mut Arena,
        notation: &Notation,
        chart: &Chart,
        reduction: &Reduction,
        closed: Option<(ClosedForm, bool)>,
    ) -> Option<Formulas> {
        let motion = self.motion;
        let kinetic_energy = match motion.polynomial().filter(|_| !motion.determines_momentum()) {
            Some((_, h)) => describe::kinetic_energy_of_momenta(arena, notation, h),
            None => describe::kinetic_energy(arena, notation, &motion.parts),
        };
        let (hamiltonian, equations, reduced) = match (motion.polynomial(), motion.hamiltonian()) {
            (Some(energy @ (kinetic, _)), Some(h)) => {
                let full = h.energy_in(chart);
                let hamiltonian =
                    describe::hamiltonian(arena, notation, (h, kinetic), self.potential, self.forces);
                let (energy, acting) = ((energy.1, kinetic), (self.potential, self.forces));
                let equations =
                    describe::equations(arena, notation, energy, (chart, &full), acting.0, acting.1);
                (hamiltonian, equations, describe::system(arena, notation, &reduction.system))
            }
            (Some((kinetic, h)), None) => {
                let internal = describe::kinetic_part(arena, notation, (h, kinetic));
                let (system, _) = self.systems(arena, chart, self.potential)?.swap_remove(0);
                let reduced = describe::system(arena, notation, &reduction.system);
                let equations = describe::system(arena, notation, &system);
                let equations = self.with_forces(arena, notation, equations);
                (self.with_centre(arena, notation, internal), equations, reduced)
            }
            (None, _) => {
                let equations = self.in_parts(arena, notation, chart)?;
                let internal = mixed::internal_energy(arena, motion.constraint().is_some());
                let hamiltonian = self.with_centre(arena, notation, (internal, Vec::new()));
                (hamiltonian, self.with_forces(arena, notation, equations.clone()), equations)
            }
        };
        let pinned = motion.masses.are_none();
        let pinned = pinned.then(|| Scope::Model.without("x and p: the model has no translation"));
        let closed = closed.map(|(_, only_at_rest)| ClosedForm::left_out(only_at_rest));
        let left_out = pinned.into_iter().chain(reduction.left_out()).chain(closed).collect();
        let printed = |sentence: &Sentence| notation.printed(arena, sentence);
        Some(Formulas {
            kinetic_energy: printed(&kinetic_energy),
            hamiltonian: printed(&hamiltonian),
            equations: equations.iter().map(printed).collect(),
            reduced: reduced.iter().map(printed).collect(),
            left_out,
        })
    }

    fn with_centre(
        &self,
        arena: &mut Arena,
        notation: &Notation,
        internal: (Sentence, Vec<Sentence>),
    ) -> Sentence {
        mixed::hamiltonian(arena, notation, internal, &self.motion.masses, self.potential, self.forces)
    }

    fn with_forces(&self, arena: &mut Arena, notation: &Notation, mut list: Vec<Sentence>) -> Vec<Sentence> {
        list.extend(self.forces.formulas(arena, notation));
        list
    }

    /// The equations of a factorised mass matrix in the parts of the energy, or component by component where they are not
    /// proved to be those.
    fn in_parts(&self, arena: &mut Arena, notation: &Notation, chart: &Chart) -> Option<Vec<Sentence>> {
        let motion = self.motion;
        let own = motion.chart(arena, true);
        let loads = motion.loads(arena, &own)?;
        if !mixed::laws_hold(arena, (&motion.parts, &motion.masses), &own, &loads) {
            let (system, _) = self.systems(arena, chart, self.potential)?.swap_remove(0);
            return Some(describe::system(arena, notation, &system));
        }
        let names = ForceNames::of(chart, self.forces);
        let frames: Vec<_> = motion.internal().map(|part| part.frame).collect();
        let acting = (&motion.masses, self.potential);
        let mut list = match motion.constraint() {
            None => mixed::internal_equations(arena, notation, &frames, acting, &names),
            Some(group) => mixed::confined_equations(arena, notation, &frames, group, acting, &names),
        };
        list.extend(mixed::centre_equations(arena, notation, acting, &names));
        Some(list)
    }
}

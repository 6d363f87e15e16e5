//! What a motion conserves, and how it is reduced.

use crate::algebra::{Arena, Matrix};
use crate::mechanics::body::Body;
use crate::mechanics::charts::Chart;
use crate::mechanics::closed_form::ClosedForm;
use crate::mechanics::conserved::{Candidate, Conservation};
use crate::mechanics::equations::Load;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::metric::Definitions;
use crate::mechanics::potential::Potential;
use crate::mechanics::reduction::drift::Drift;
use crate::mechanics::reduction::{Reduction, Wanted, reductions};
use crate::mechanics::shared::CentreVelocity;
use crate::mechanics::splitting::dilates;
use crate::mechanics::term::Frame;
use crate::symbol::{Asked, Capability};

/// What a motion conserves.
pub(super) struct Kept {
    pub(super) moving: Conservation,
    /// With `p = 0`.
    pub(super) at_rest: Conservation,
    /// Do rotations of space leave the motion unchanged, and the forces of themselves as well? Friction takes the angular
    /// momentum all the same.
    pub(super) rotations: bool,
}

impl Body<'_> {
    /// What is conserved by the kinetic energy, and then by what is added to it.
    /// `bases` are those of [`Conservation`].
    pub(super) fn kept(&self, arena: &mut Arena, bases: Option<&[Matrix; 2]>) -> Option<Kept> {
        let (motion, forces) = (self.motion, self.forces);
        let [chart, resting] = [true, false].map(|moving| motion.chart(arena, moving));
        let whole = motion.loads(arena, &chart)?;
        let internal = motion.loads(arena, &resting)?;
        let mut moving = Conservation::of(&chart, bases);
        moving.under(arena, &whole);
        // Translation dropped, and with it what it alone makes meaningful.
        let mut at_rest = moving.clone();
        if chart.linear.is_some() {
            at_rest = Conservation::of(&resting, bases);
            at_rest.under(arena, &internal);
        }
        if let Some(u) = self.potential {
            u.keep(arena, &mut moving);
            u.keep(arena, &mut at_rest);
        }
        // Of the undamped motion: the forces are held against the same rotations on their own.
        let rotations =
            moving.whole.contains(&Candidate::TotalAngularMomentum) && forces.are_isotropic_in_space();
        if !forces.is_empty() {
            let mut defined = |chart: &Chart, loads: &[Load]| -> Definitions {
                let names = motion.velocity_names(arena, chart);
                loads.iter().chain([&names]).flat_map(|load| load.shared.clone()).collect()
            };
            let [of_whole, of_internal] = [defined(&chart, &whole), defined(&resting, &internal)];
            let centre = motion.centre_velocity(arena);
            forces.keep(arena, &chart, (&centre, &of_whole), &mut moving);
            let fixed = (&CentreVelocity::Fixed, &of_internal);
            forces.at_rest().keep(arena, &resting, fixed, &mut at_rest);
        }
        // A force on the centre of mass does not leave it at rest.
        let pushed = self.potential.is_some_and(Potential::moves_the_centre) || forces.push_from_rest();
        if pushed {
            at_rest.clone_from(&moving);
        }
        Some(Kept { moving, at_rest, rotations })
    }

    /// The closed form of the geodesics, and whether it needs `p = 0`: with masses in both frames that of the internal motion.
    pub(super) fn closed_form(&self, arena: &mut Arena) -> Option<(ClosedForm, bool)> {
        let (_, h) = self.motion.polynomial().filter(|_| self.is_free())?;
        // The translational energy is quadratic in p: at p = 0 its flow stands still.
        let at_rest = !self.motion.masses.are_none() && Drift::of(arena, self).is_none();
        Some((ClosedForm::of(h)?, at_rest))
    }

    /// Would pieces of a reduced motion move the dilatation along a closed form of its own, asked for or not?
    pub(super) fn dilates(&self, arena: &mut Arena, reduction: &Reduction) -> bool {
        self.motion.hamiltonian().is_some_and(|h| dilates(arena, (h, self), reduction))
    }

    /// What has to be integrated, in each way that may be the shortest.
    pub(super) fn reductions(
        &self,
        arena: &mut Arena,
        rotations: bool,
        asked: Asked,
    ) -> Option<Vec<Reduction>> {
        // The squares of an anisotropic energy move each momentum, also one that their sum conserves.
        let in_squares = |h: &Hamiltonian| h.isotropic.is_none() && h.frame != Frame::Flat;
        let [nystrom, splitting] = [Capability::Nystrom, Capability::Splitting].map(|one| asked.has(one));
        let halves = self.motion.hamiltonian().is_some_and(|h| nystrom || (splitting && in_squares(h)));
        reductions(arena, self, Wanted { rotations, halves, pieces: nystrom || splitting })
    }
}

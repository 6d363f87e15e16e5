//! The phase space of a model, as its points hold it.

use super::components::Components;
use super::model::Model;
use crate::mechanics::closed_form::ClosedForm;

impl Model {
    /// The components of the affine spin that points hold, and of the affine velocity that goes with it.
    pub fn spin(&self) -> Components {
        self.frame.into()
    }

    /// The components of the velocity that geodesics are made of, where these are known in closed form: of an exponential
    /// beside the placement, or of a straight line. And whether they need `p = 0`.
    pub fn geodesics(&self) -> Option<(Components, bool)> {
        let (form, at_rest) = self.dynamics.closed_form?;
        let components = match form {
            ClosedForm::Body => Components::Comoving,
            ClosedForm::Space => Components::Spatial,
            ClosedForm::Straight => Components::TwoPoint,
        };
        Some((components, at_rest))
    }

    /// The components of the velocity of the centre of mass that its energy is the square of, where it moves.
    pub fn centre(&self) -> Option<Components> {
        self.translation.map(Components::from)
    }
}

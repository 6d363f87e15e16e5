//! The derivation of one model: from its quadratic form to straight-line programs, ready to be written down.

mod batch;
mod components;
mod constant;
mod dilatation;
mod domain;
mod equations;
mod invariance;
mod lattice;
mod metrics;
mod mixed;
mod model;
mod phase_space;
mod prepared;
mod programs;
mod quantities;
pub mod second_order;
pub mod splitting;
mod stated;
mod symbols;
mod trajectory;
mod ways;
mod well_posed;
mod written;

use crate::mechanics::form::Energy;

pub use components::Components;
pub use dilatation::DilatationalMotion;
pub use domain::{Domain, Sign, SignedArgument};
pub use equations::Equations;
pub use lattice::{PieceProgram, PiecePrograms, Places, RatioProgram, TwoPolar};
pub use metrics::{ChangeOfBases, GivenMatrix, GivenSource, Preparation};
pub use model::{
    Balance, BalancedQuantities, Formulas, Metric, MixedMasses, Model, Regularity, VelocitySide,
};
pub use symbols::{VolumeMeasure, reads_time};
pub use trajectory::{AffineMomentum, Trajectory};
pub use well_posed::{Condition, Damping, NumericBlock, Relation};
pub use written::{Part, Written};

/// Derives a model; `None` only for energies that the checks refuse.
pub fn derive(energy: impl Into<Energy>, require_positive: bool) -> Option<Model> {
    let (model, asked) = match energy.into() {
        Energy::Constant(form) => {
            let asked = form.asked;
            (constant::constant(*form, require_positive)?, asked)
        }
        Energy::Mixed(form) => {
            let asked = form.asked;
            (mixed::derive(*form, require_positive)?, asked)
        }
    };
    Some(model.completed(asked))
}

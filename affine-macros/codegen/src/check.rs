//! Rules of well-posedness, one function each with its reason above it.
//!
//! [`as_written`] holds the rules that need only what the user wrote; they leave a model in which every name
//! has a meaning, every coefficient a value and every matrix its size.

mod arithmetic;
mod capabilities;
mod custom;
mod definite;
mod dimension;
mod dissipation;
mod form;
mod frames;
mod identity;
mod inertia;
mod metrics;
mod mixed;
mod momentum_side;
mod parts;
mod potential;
mod shapes;
mod size;
mod smooth;
mod symbols;
mod tensors;
mod together;
mod two_polar;
mod unitary;
mod written;

pub use parts::Part;
pub use together::{Refusal, refusals, table};

use crate::algebra::Arena;
use crate::diagnostics::{Diagnostics, Reported};
use crate::lower;
use crate::mechanics::form::Form;
use crate::spec::Spec;

/// The rules that need only what the user wrote.
///
/// # Errors
/// [`Reported`] if any rule is broken; all broken ones are in the bag.
pub fn as_written(spec: &Spec, found: &mut Diagnostics) -> Result<(), Reported> {
    symbols::hidden(spec, found);
    symbols::resolved(spec, found);
    unitary::casimirs_alone(spec, found);
    together::as_written(spec, found);
    capabilities::ratios(spec, found);
    capabilities::centre(spec, found);
    potential::differences(spec, found);
    potential::scalar(spec, found);
    potential::centre(spec, found);
    custom::fields(spec, found);
    custom::centre(spec, found);
    dissipation::centre(spec, found);
    frames::internal_motion(spec, found);
    frames::affine_translation(spec, found);
    shapes::shapes(spec, found);
    momentum_side::scalars(spec, found);
    // The size of a matrix and the value of `n` follow from the dimension, and no value is computed before the
    // powers in it are known to be bounded.
    dimension::two_or_three(spec, found)?;
    shapes::sizes(spec, found);
    metrics::sizes(spec, found);
    potential::indices(spec, found);
    custom::in_space(spec, found);
    arithmetic::computable(spec, found)?;
    potential::in_domain(spec, found);
    momentum_side::one_frame(spec, found);
    momentum_side::third_casimir(spec, found);
    momentum_side::inverse_masses(spec, found);
    metrics::positive(spec, found);
    metrics::invariant(spec, found);
    inertia::masses(spec, found);
    inertia::symmetric(spec, found);
    inertia::positive(spec, found);
    tensors::symmetric(spec, found);
    found.verdict()
}

/// The rules on the kinetic energy as a quadratic form, and on what acts beside it.
///
/// # Errors
/// [`Reported`] if any rule is broken; all broken ones are in the bag.
pub fn energy(spec: &Spec, found: &mut Diagnostics) -> Result<Form, Reported> {
    let mut arena = Arena::new();
    let energy = match lower::stated(&mut arena, spec) {
        Some(stated) => form::of_momenta(&mut arena, spec, stated, found)?,
        None if frames::are_mixed(spec) => mixed::energy(&mut arena, spec, found)?,
        None => form::of_one_frame(&mut arena, spec, found)?,
    };
    form::beside(arena, spec, energy, found)
}

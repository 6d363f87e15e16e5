//! Equations of several bodies at once.

use affine_core::model::Group;

/// `y' = f(t, y)` in lanes. A trait, since a closure cannot be made part of the function that is compiled for the
/// processor's vectors: what is called from there is compiled for the vectors of every processor.
pub trait Equations<T, S> {
    /// What states consist of.
    const GROUPS: &'static [Group];

    /// These lanes are for processors whose vectors have no multiply-add: there are fused ones for the others.
    #[inline(always)]
    fn are_a_last_resort(&self) -> bool {
        false
    }

    /// Writes `f(t, y)`; to be `#[inline(always)]`. In place, since states of many lanes are long.
    fn slope(&self, t: T, y: &S, slope: &mut S);

    /// A step may end at the state in a lane; to be `#[inline(always)]`.
    fn is_sound(&self, y: &S, lane: usize) -> bool;
}

//! Eight bodies in the lanes of vectors, each of a model of its own if it has one.

mod steps;

use core::array;
use core::ops::Range;

use super::layout::{Layout, placement_in};
use super::motion::{PointOf, WithWork};
use super::point::is_clearly_positive;
use crate::capability::InLanes;
use crate::frames::Matrix;
use crate::inner::{Equations, IS_FUSED};
use crate::lanes::{F64x8, Lanes};
use crate::model::{Group, Handle, Model};

pub(super) use steps::{Bodies, moving};

/// Lanes, of every kind.
pub(super) const EIGHT: usize = F64x8::LANES;

/// Reduced states of the bodies.
pub(super) type Reduced<const N: usize, H, T> = <<H as Handle<N>>::Model as Model<N>>::Reduced<T>;
/// Constants of their trajectories.
pub(super) type Constants<const N: usize, H, T> = <<H as Handle<N>>::Model as Model<N>>::Constants<T>;

/// The models of bodies in lanes, with the constants of their trajectories.
pub(super) struct Together<const N: usize, T, H: Handle<N>>
where
    H::Model: InLanes<N>,
    T: Lanes,
{
    pub(super) handles: [H; EIGHT],
    pub(super) of_lanes: [Constants<N, H, f64>; EIGHT],
    /// The same in lanes.
    pub(super) constants: Constants<N, H, T>,
}

impl<const N: usize, T: Lanes, H: Handle<N>> Together<N, T, H>
where
    H::Model: InLanes<N>,
{
    /// The model of the body in each lane, and the constants of its trajectory.
    pub(super) fn of(body: impl Fn(usize) -> (H, Constants<N, H, f64>)) -> Self {
        const { assert!(T::LANES == EIGHT, "one body for each lane") }
        let (handles, of_lanes) = (array::from_fn(|lane| body(lane).0), array::from_fn(|lane| body(lane).1));
        let constants = H::Model::constants_in_lanes(&of_lanes);
        Self { handles, of_lanes, constants }
    }

    /// Puts a body into a lane.
    pub(super) fn put(&mut self, lane: usize, handle: H, constants: Constants<N, H, f64>) {
        H::Model::put_constants(&mut self.constants, lane, &constants);
        (self.handles[lane], self.of_lanes[lane]) = (handle, constants);
    }

    /// The phase point of a state in a lane, with the work done.
    pub(super) fn expanded(
        &self,
        lane: usize,
        t: f64,
        state: &Reduced<N, H, f64>,
    ) -> WithWork<PointOf<N, H>> {
        let work = const { Layout::of(<H::Model as Model<N>>::DESCRIPTION.reduced, N) }.work;
        let point = self.handles[lane].model().expand(t, &self.of_lanes[lane], state);
        (point, work.map_or(0.0, |place| state.as_ref()[place]))
    }

    /// The potential has a value at a state in a lane, as far as functions of the user's are part of it.
    pub(super) fn has_value(&self, lane: usize, reached: impl FnOnce() -> (f64, Reduced<N, H, f64>)) -> bool {
        if const { !<H::Model as Model<N>>::DESCRIPTION.custom_potential } {
            return true;
        }
        let (t, state) = reached();
        self.handles[lane].model().hamiltonian(t, &self.expanded(lane, t, &state).0).is_finite()
    }
}

/// The steps of a model are in vectors, so that those of the processor decide whether its lanes are fused as well; where the
/// target has decided that already, there is one kind of lanes.
#[inline(always)]
pub(super) fn has_fused_lanes<const N: usize, M: Model<N>>(model: &M) -> bool {
    !IS_FUSED && M::packing(model).is_some()
}

impl<const N: usize, T: Lanes, H: Handle<N>> Equations<T, Reduced<N, H, T>> for Together<N, T, H>
where
    H::Model: InLanes<N>,
{
    const GROUPS: &'static [Group] = <H::Model as Model<N>>::DESCRIPTION.reduced;

    #[inline(always)]
    fn slope(&self, t: T, y: &Reduced<N, H, T>, slope: &mut Reduced<N, H, T>) {
        H::Model::equations_in_lanes(|lane| self.handles[lane].model(), t, &self.constants, y, slope);
    }

    #[inline(always)]
    fn are_a_last_resort(&self) -> bool {
        !T::IS_FUSED && has_fused_lanes(self.handles[0].model())
    }

    #[inline(always)]
    fn is_sound(&self, y: &Reduced<N, H, T>, lane: usize) -> bool {
        match const { placement_in(<H::Model as Model<N>>::DESCRIPTION.reduced, N) } {
            Some(Range { start, end }) => {
                let entries = &y.as_ref()[start..end];
                is_clearly_positive(&Matrix::<N>::from_fn(|i, k| entries[N * i + k].lane(lane)))
            }
            // Bodies without one are not taken into lanes.
            None => false,
        }
    }
}

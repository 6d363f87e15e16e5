//! The pieces of motions in lanes, and what steps are held against.

use core::ops::Range;

use num_traits::Zero;

use crate::capability::{InLanes, Splitting};
use crate::frames::Matrix;
use crate::inner::{PiecesInLanes, Sum, of_lane, set_lane};
use crate::lanes::{F64x8, Lanes};
use crate::model::{Handle, Model};
use crate::simulate::in_lanes::{EIGHT, Reduced, Together};
use crate::simulate::layout::placement_in;
use crate::simulate::orientation::{Moment, passes_through_zero};
use crate::simulate::point::is_clearly_positive;

/// The placement of a state, up to a factor of positive determinant, or its rate.
#[inline(always)]
fn placement<const N: usize, H: Handle<N>>(state: &Reduced<N, H, f64>) -> Matrix<N> {
    let Range { start, .. } =
        const { placement_in(<H::Model as Model<N>>::DESCRIPTION.reduced, N) }.unwrap_or_default();
    let (mut placement, entries) = (Matrix::<N>::zeros(), state.as_ref());
    // Row by row, of columns; counted by hand, as what is taken from lanes.
    let (mut place, by_columns) = (0, placement.as_mut_slice());
    while place < N * N {
        let column_by_column = N * (place % N) + place / N;
        if let (Some(entry), Some(own)) = (entries.get(start + place), by_columns.get_mut(column_by_column)) {
            *own = *entry;
        }
        place += 1;
    }
    placement
}

/// A state is finite, and its placement clearly keeps orientation.
#[inline(always)]
pub(super) fn stands<const N: usize, H: Handle<N>>(state: &Reduced<N, H, f64>) -> bool {
    let (mut zero, mut place, numbers) = (0.0, 0, state.as_ref());
    while let Some(number) = numbers.get(place) {
        // NaN once one of them is not finite.
        zero += 0.0 * number;
        place += 1;
    }
    (zero == 0.0) & is_clearly_positive(&placement::<N, H>(state))
}

/// The pieces of the motions of eight bodies.
pub(super) struct Moved<const N: usize, H: Handle<N>>(pub(super) Together<N, F64x8, H>)
where
    H::Model: InLanes<N>;

impl<const N: usize, H: Handle<N>> Moved<N, H>
where
    H::Model: InLanes<N> + Splitting<N>,
{
    /// A loop over lanes, which compilers turn into vector instructions where no function is called in it.
    #[inline(always)]
    fn flow_in_lanes(&self, piece: usize, (t, h): (f64, f64), state: &mut Sum<Reduced<N, H, F64x8>>) {
        // A copy, which no state can be taken for: few lanes are not worth a check of that.
        let constants = self.0.constants;
        for lane in 0..EIGHT {
            let constants = H::Model::constants_of_lane(&constants, lane);
            let (mut value, mut carry) = (of_lane(&state.value, lane), of_lane(&state.carry, lane));
            self.0.handles[lane].model().flow(piece, t, h, &constants, &mut value, &mut carry);
            set_lane(&mut state.value, lane, &value);
            set_lane(&mut state.carry, lane, &carry);
        }
    }

    #[inline(always)]
    fn moment(&self, lane: usize, t: f64, state: &Reduced<N, H, f64>) -> Moment<N> {
        let constants = H::Model::constants_of_lane(&self.0.constants, lane);
        let rates = self.0.handles[lane].model().reduced_equations(t, &constants, state);
        Moment::at(t, placement::<N, H>(state), placement::<N, H>(&rates))
    }
}

impl<const N: usize, H: Handle<N>> PiecesInLanes<F64x8, Reduced<N, H, F64x8>> for Moved<N, H>
where
    H::Model: InLanes<N> + Splitting<N>,
{
    const COUNT: usize = H::Model::PIECES.len();
    const NYSTROM: bool = H::Model::NYSTROM;
    const DILATES: bool = H::Model::DILATES;

    #[inline(always)]
    fn flow(&self, piece: usize, t: f64, h: f64, state: &mut Sum<Reduced<N, H, F64x8>>) {
        // A loop over lanes for each: one that looks at the piece in every lane does not become vectors.
        match (piece, H::Model::PIECES.len().saturating_sub(1)) {
            (0, _) => self.flow_in_lanes(0, (t, h), state),
            (1, 2..) => self.flow_in_lanes(1, (t, h), state),
            (2, 3..) => self.flow_in_lanes(2, (t, h), state),
            (piece, last) if piece < last => self.flow_in_lanes(piece, (t, h), state),
            (_, last) => self.flow_in_lanes(last, (t, h), state),
        }
    }

    #[inline(always)]
    fn doubts(&self, (t, from): (f64, &Reduced<N, H, F64x8>), h: f64, to: &Reduced<N, H, F64x8>) -> F64x8 {
        let mut doubts = F64x8::zero();
        for lane in 0..EIGHT {
            let (begin, end) = (of_lane(from, lane), of_lane(to, lane));
            let keeps_orientation = match const { passes_through_zero(&H::Model::DESCRIPTION) } {
                true => self.moment(lane, t, &begin).clearly_reaches(&self.moment(lane, t + h, &end)),
                false => true,
            };
            doubts.set_lane(lane, if stands::<N, H>(&end) & keeps_orientation { 0.0 } else { 1.0 });
        }
        doubts
    }
}

//! What a model has beyond the default, by `emit(...)`, and how code that serves every model finds it.
//!
//! Each capability is a trait that generated code implements, so that a function which needs one says so in its
//! bound. A `Simulation`, which takes any model, asks [`Model`] instead: a provided method gives
//! `Some` of the capability where it was emitted and `None::<NotEmitted>` elsewhere, a type without values.

use crate::divisor::Divisor;
use crate::lanes::{Lanes, in_lane};
use crate::model::{Group, Handle, Model};
use crate::scalar::{Real, Scalar};
use crate::system::{
    Packing, Pieces, SecondOrder, Series, StateVector, Sum, Unconstrained, of_lane, set_lane,
};
use crate::vectors::{Portable, Vectors};

/// `emit(taylor)`: Taylor coefficients of the reduced motion to any order, `y(t + h) = sum_k y_k h^k`.
///
/// The recurrence is unrolled over the components of the state; every order keeps a row of what later convolutions
/// read.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no Taylor coefficients",
    label = "`emit(taylor)` is missing",
    note = "write `emit(taylor)` in its `#[affine_model(...)]`"
)]
pub trait Taylor<const N: usize>: Model<N> {
    /// What is kept of each order.
    type Row<T: Scalar>: StateVector<T>;
    /// Coefficients in lanes: states whose rates are the lanes of one convolution go from order to order as vectors.
    type Columns<T: Scalar>: Copy;
    /// There is a square root, or a size, of what moves: where that falls to zero and rises again, as `norm(x)` through x = 0, the
    /// root stays positive and its series does not, without any coefficient that tells.
    const ROOTS: bool;

    /// `y_1` from `y_0` at time `t`; fills the row of order 0.
    fn start<T: Scalar>(
        &self,
        t: T,
        constants: &Self::Constants<T>,
        state: &Self::Reduced<T>,
        row: &mut Self::Row<T>,
    ) -> Self::Reduced<T>;

    /// The columns of a coefficient.
    fn columns<T: Scalar>(coefficient: &Self::Reduced<T>) -> Self::Columns<T>;

    /// Writes what of an order above 0 follows from its coefficient alone, given with its columns, to its row.
    fn ready<T: Scalar>(
        &self,
        vectors: impl Vectors,
        constants: &Self::Constants<T>,
        coefficient: (&Self::Reduced<T>, Self::Columns<T>),
        row: &mut Self::Row<T>,
    );

    /// `y_(k+1)` from `y_k`, for `k > 0`, and its columns; `order` is `k` and `k + 1` over the unit of time, by which rates
    /// are divided. The rows are those of the orders 0 to k; fills the slots of the last one that [`Taylor::ready`] left.
    fn next<T: Scalar>(
        &self,
        vectors: impl Vectors,
        order: (T, Divisor<T>),
        constants: &Self::Constants<T>,
        coefficient: &Self::Reduced<T>,
        rows: &mut [Self::Row<T>],
    ) -> (Self::Reduced<T>, Self::Columns<T>);

    /// Fills in all coefficients `y_k unit^k` after the first, which is the reduced state at a time; the unit of time is a
    /// power of two. The order is one less than the shorter of the number of coefficients, and of rows and one.
    fn coefficients<T: Scalar>(
        &self,
        (t, unit): (T, T),
        constants: &Self::Constants<T>,
        coefficients: &mut [Self::Reduced<T>],
        rows: &mut [Self::Row<T>],
    ) {
        self.coefficients_on(Portable, (t, unit), constants, coefficients, rows);
    }

    /// The same coefficients, on the vectors of a processor.
    #[inline(always)]
    fn coefficients_on<T: Scalar>(
        &self,
        vectors: impl Vectors,
        (t, unit): (T, T),
        constants: &Self::Constants<T>,
        coefficients: &mut [Self::Reduced<T>],
        rows: &mut [Self::Row<T>],
    ) {
        let highest = rows.len().min(coefficients.len().saturating_sub(1));
        let ([before, after, ..], [row, ..], 1..) = (&mut *coefficients, &mut *rows, highest) else { return };
        // A copy, which no row can be taken for: what follows from constants alone is computed once.
        let constants = *constants;
        *after = self.start(t, &constants, before, row);
        after.as_mut().iter_mut().for_each(|slope| *slope *= unit);
        if let Some(row) = rows.get_mut(1) {
            self.ready(vectors, &constants, (after, Self::columns(after)), row);
        }
        let mut order = T::one();
        for k in 1..highest {
            let by = (order, Divisor::of(k + 1).over(unit));
            let (next, columns) = self.next(vectors, by, &constants, &coefficients[k], &mut rows[..=k]);
            coefficients[k + 1] = next;
            if let Some(row) = rows.get_mut(k + 1) {
                self.ready(vectors, &constants, (&next, columns), row);
            }
            order += T::one();
        }
    }
}

/// `emit(lanes)`: several bodies of one model at once, each in a lane with constants of its own.
///
/// The reduced equations are generic over the scalar as they stand; what has to be emitted is how the constants of
/// several trajectories become those of one in lanes.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot gather the constants of several trajectories in lanes",
    label = "`emit(lanes)` is missing",
    note = "write `emit(lanes)` in its `#[affine_model(...)]`"
)]
pub trait InLanes<const N: usize>: Model<N> {
    /// The constants of one trajectory to a lane, those of the last in the lanes that are left. Of what moves in closed
    /// form the reduced equations read nothing, and lanes hold nothing.
    fn constants_in_lanes<T: Lanes>(constants: &[Self::Constants<f64>]) -> Self::Constants<T>;

    /// Puts the constants of one trajectory into a lane, beside those of the others.
    fn put_constants<T: Lanes>(constants: &mut Self::Constants<T>, lane: usize, own: &Self::Constants<f64>);

    /// The constants of the trajectory in a lane.
    fn constants_of_lane<T: Lanes>(constants: &Self::Constants<T>, lane: usize) -> Self::Constants<T::Lane>;

    /// [`Model::reduced_equations`] of every lane, by the model of the lane, written to `rates`: a loop over lanes, which
    /// compilers turn into vector instructions where no function is called in it, as none is with `Fast` numbers but for
    /// sines, cosines and tangents. Fields stand in the constants; the model itself is read where a force or a potential of
    /// the user is asked.
    #[inline(always)]
    fn equations_in_lanes<'m, T: Lanes>(
        model: impl Fn(usize) -> &'m Self,
        t: T,
        constants: &Self::Constants<T>,
        y: &Self::Reduced<T>,
        rates: &mut Self::Reduced<T>,
    ) where
        Self: 'm,
    {
        // Their own, so that nothing that is read can be what is written: few lanes are not worth a check of that.
        let mut of_lanes = Self::Reduced::<T>::zeros();
        for lane in 0..T::LANES {
            let (t, constants) = (in_lane(&t, lane), Self::constants_of_lane(constants, lane));
            let rates_of_lane = model(lane).reduced_equations(t, &constants, &of_lane(y, lane));
            set_lane(&mut of_lanes, lane, &rates_of_lane);
        }
        *rates = of_lanes;
    }
}

/// `emit(splitting)`: exact flows of pieces of the Hamiltonian over the reduced state, those of the kinetic energy first.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no exact sub-flows",
    label = "`emit(splitting)` is missing",
    note = "write `emit(splitting)` in its `#[affine_model(...)]`"
)]
pub trait Splitting<const N: usize>: Model<N> {
    /// The pieces, in words.
    const PIECES: &'static [&'static str];
    /// There are two pieces, `A` and `B`, with `[B, [B, [B, A]]] = 0`.
    const NYSTROM: bool;
    /// The first piece contains a dilatation of its own, and may be much larger than the others.
    const DILATES: bool = false;

    /// Moves the reduced state along a piece for the time `h`, adding to each component and to what rounding left out
    /// of it; `t` is the time that a potential reads. What is a function of the rest, `1/D` and `q`, stays as it is:
    /// [`renewed`](Model::renewed).
    fn flow<T: Real>(
        &self,
        piece: usize,
        t: T,
        h: T,
        constants: &Self::Constants<T>,
        state: &mut Self::Reduced<T>,
        carry: &mut Self::Reduced<T>,
    );
}

/// `emit(nystrom)`: the reduced equations as `q' = V(p)`, `p' = F(t, q)`, for models whose kinetic energy has constant
/// coefficients in `phi_dot` and `x_dot`. The reduced state is the positions, as many momenta, and `1/D` where it is carried
/// along.
#[diagnostic::on_unimplemented(
    message = "the equations of `{Self}` are not stated as q'' = f(t, q)",
    label = "`emit(nystrom)` is missing",
    note = "write `emit(nystrom)` in its `#[affine_model(...)]`"
)]
pub trait SecondOrderEquations<const N: usize>: Model<N> {
    /// The positions, or the momenta.
    type Half<T: Scalar>: StateVector<T>;

    /// `V(p)`, linear.
    fn drift<T: Scalar>(&self, constants: &Self::Constants<T>, momenta: &Self::Half<T>) -> Self::Half<T>;

    /// `F(t, q)`.
    fn force<T: Scalar>(
        &self,
        t: T,
        constants: &Self::Constants<T>,
        positions: &Self::Half<T>,
    ) -> Self::Half<T>;
}

/// The reduced equations in vectors of four doubles, of every model for which that takes fewer instructions: what its
/// Runge-Kutta steps are taken in.
pub trait PackedEquations<const N: usize>: Model<N> {
    /// The reduced state in vectors of four.
    type Packed: StateVector<f64>;

    /// The state in vectors: some components may stand in several lanes, and some lanes hold none.
    fn packed(state: &Self::Reduced<f64>) -> Self::Packed;

    /// The state of vectors.
    fn unpacked(packed: &Self::Packed) -> Self::Reduced<f64>;

    /// [`Model::reduced_equations`] of doubles, to the bit but for signs of what is not a number.
    fn packed_equations(
        &self,
        vectors: impl Vectors,
        t: f64,
        constants: &Self::Constants<f64>,
        packed: &Self::Packed,
    ) -> Self::Packed;
}

/// A model that has the capability in question, by what leads to it.
#[derive(Clone, Copy, Debug)]
pub struct Emitted<H, const N: usize>(pub H);

impl<const N: usize, M: Taylor<N>, H: Handle<N, Model = M>> Series<M::Reduced<f64>, M::Constants<f64>>
    for Emitted<H, N>
{
    type Row = M::Row<f64>;
    const ROOTS: bool = M::ROOTS;

    fn coefficients(
        &self,
        at: (f64, f64),
        constants: &M::Constants<f64>,
        coefficients: &mut [M::Reduced<f64>],
        rows: &mut [Self::Row],
    ) {
        self.0.model().coefficients(at, constants, coefficients, rows);
    }

    #[inline(always)]
    fn coefficients_on<V: Vectors>(
        &self,
        vectors: V,
        at: (f64, f64),
        constants: &M::Constants<f64>,
        coefficients: &mut [M::Reduced<f64>],
        rows: &mut [Self::Row],
    ) {
        let mut fill = || self.0.model().coefficients_on(vectors, at, constants, coefficients, rows);
        // Compiled once there, for slopes and for steps.
        if const { V::IS_LAST_RESORT } { called(fill) } else { fill() }
    }
}

impl<const N: usize, M: Splitting<N>, H: Handle<N, Model = M>> Pieces<M::Reduced<f64>, M::Constants<f64>>
    for Emitted<H, N>
{
    const COUNT: usize = M::PIECES.len();
    const NYSTROM: bool = M::NYSTROM;
    const DILATES: bool = M::DILATES;

    #[inline]
    fn flow(
        &self,
        piece: usize,
        t: f64,
        h: f64,
        constants: &M::Constants<f64>,
        state: &mut Sum<M::Reduced<f64>>,
    ) {
        self.0.model().flow(piece, t, h, constants, &mut state.value, &mut state.carry);
    }
}

impl<const N: usize, M: SecondOrderEquations<N>, H: Handle<N, Model = M>>
    SecondOrder<M::Reduced<f64>, M::Constants<f64>> for Emitted<H, N>
{
    type Half = M::Half<f64>;

    #[inline(always)]
    fn drift(&self, constants: &M::Constants<f64>, momenta: &Self::Half) -> Self::Half {
        self.0.model().drift(constants, momenta)
    }

    #[inline(always)]
    fn force(&self, t: f64, constants: &M::Constants<f64>, positions: &Self::Half) -> Self::Half {
        self.0.model().force(t, constants, positions)
    }

    fn renewed(&self, state: &M::Reduced<f64>) -> M::Reduced<f64> {
        self.0.model().renewed(state)
    }
}

impl<const N: usize, M: Model<N> + Unconstrained, H: Handle<N, Model = M>> Unconstrained for Emitted<H, N> {
    type State = M::State;
    const GROUPS: &'static [Group] = M::GROUPS;

    fn rates(&self, t: f64, state: &M::State) -> M::State {
        self.0.model().rates(t, state)
    }
}

impl<const N: usize, M: PackedEquations<N>, H: Handle<N, Model = M>>
    Packing<M::Reduced<f64>, M::Constants<f64>> for Emitted<H, N>
{
    type Packed = M::Packed;

    #[inline(always)]
    fn packed(&self, state: &M::Reduced<f64>) -> M::Packed {
        M::packed(state)
    }

    #[inline(always)]
    fn unpacked(&self, packed: &M::Packed) -> M::Reduced<f64> {
        M::unpacked(packed)
    }

    #[inline(always)]
    fn slope(
        &self,
        vectors: impl Vectors,
        t: f64,
        constants: &M::Constants<f64>,
        packed: &M::Packed,
    ) -> M::Packed {
        self.0.model().packed_equations(vectors, t, constants, packed)
    }
}

/// Calls `act` out of line: inlined, the arithmetic of `act` would be compiled once for each of its callers.
#[inline(never)]
fn called(act: impl FnOnce()) {
    act();
}

//! Motions as integrators see them: vectors of numbers, their equations, and what more can be known of these.

use core::fmt::Debug;

use crate::lanes::{Lanes, in_lane};
use crate::quantity::Group;
use crate::scalar::{Real, Scalar};
use crate::vectors::Vectors;

/// A fixed-size vector of numbers that integrators step.
pub trait StateVector<T>: Copy + Debug + PartialEq + AsRef<[T]> + AsMut<[T]> + Send + Sync {
    /// Number of components.
    const LEN: usize;
    /// All components zero.
    fn zeros() -> Self;
}

impl<T: Scalar, const D: usize> StateVector<T> for [T; D] {
    const LEN: usize = D;
    fn zeros() -> Self {
        [T::zero(); D]
    }
}

/// A state from what stands in a lane of its components.
#[inline(always)]
pub fn of_lane<T: Lanes, S: StateVector<T::Lane>>(lanes: &impl StateVector<T>, lane: usize) -> S {
    let mut state = S::zeros();
    let (components, lanes) = (state.as_mut(), lanes.as_ref());
    // Counted by hand: compilers write out such a loop over any state, and one that iterates not always. Lanes become vectors only
    // where no loop is left within that over lanes.
    let mut place = 0;
    while place < S::LEN {
        if let (Some(component), Some(lanes)) = (components.get_mut(place), lanes.get(place)) {
            *component = in_lane(lanes, lane);
        }
        place += 1;
    }
    state
}

/// Puts a state into a lane.
#[inline(always)]
pub fn set_lane<T: Lanes, S: StateVector<T::Lane>>(lanes: &mut impl StateVector<T>, lane: usize, state: &S) {
    let (components, lanes) = (state.as_ref(), lanes.as_mut());
    let mut place = 0;
    while place < S::LEN {
        if let (Some(component), Some(lanes)) = (components.get(place), lanes.get_mut(place)) {
            lanes.set_lane(lane, component.to_f64());
        }
        place += 1;
    }
}

/// `value + carry`, the carry being what rounding left out of the value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sum<S> {
    /// The state.
    pub value: S,
    /// What is to be added to it.
    pub carry: S,
}

impl<S: StateVector<f64>> Sum<S> {
    /// A state as it stands.
    #[must_use]
    pub fn of(value: S) -> Self {
        Self { value, carry: S::zeros() }
    }

    /// The sum with `rise` added, rounded once.
    #[must_use]
    #[inline(always)]
    pub fn plus(&self, rise: &S) -> Self {
        let mut sum = *self;
        for (c, (value, carry)) in sum.value.as_mut().iter_mut().zip(sum.carry.as_mut()).enumerate() {
            let before = *value;
            let rise = *carry + rise.as_ref()[c];
            *value = before + rise;
            *carry = (before - *value) + rise;
        }
        sum
    }
}

/// Taylor coefficients of the solutions of `y' = f(t, y)`, where `f` depends on constants `C`.
pub trait Series<S, C> {
    /// What is kept of each order.
    type Row: StateVector<f64>;
    /// The equations contain roots, whose series go through zero with another sign than they have.
    const ROOTS: bool = false;

    /// Fills in all coefficients `y_k unit^k` after the first, which is the state, `at` a time and with a unit of time; as
    /// many rows as coefficients, less one. The unit, a power of two, keeps them in the range of numbers.
    fn coefficients(&self, at: (f64, f64), constants: &C, coefficients: &mut [S], rows: &mut [Self::Row]);

    /// The same coefficients, on the vectors of a processor where that is worth the while.
    #[inline(always)]
    fn coefficients_on<V: Vectors>(
        &self,
        _vectors: V,
        (t, unit): (f64, f64),
        constants: &C,
        coefficients: &mut [S],
        rows: &mut [Self::Row],
    ) {
        self.coefficients((t, unit), constants, coefficients, rows);
    }
}

/// Exact flows of the pieces of a motion whose equations depend on constants `C`.
pub trait Pieces<S, C> {
    /// Number of pieces.
    const COUNT: usize;
    /// There are two pieces, `A` and `B`, with `[B, [B, [B, A]]] = 0`.
    const NYSTROM: bool;
    /// The first piece contains a dilatation in closed form: where that is stiff, it is much larger than the others.
    const DILATES: bool;

    /// Moves the state along a piece for the time `h`; `t` is the time that a potential reads.
    fn flow(&self, piece: usize, t: f64, h: f64, constants: &C, state: &mut Sum<S>);
}

/// A motion with `q' = V(p)`, linear in the momenta, and `p' = F(t, q)`, whose equations depend on constants `C`.
///
/// A state holds the positions, then as many momenta, then what is a function of the positions.
pub trait SecondOrder<S, C> {
    /// The positions, or the momenta.
    type Half: StateVector<f64>;

    /// `V(p)`, linear.
    fn drift(&self, constants: &C, momenta: &Self::Half) -> Self::Half;

    /// `F(t, q)`.
    fn force(&self, t: f64, constants: &C, positions: &Self::Half) -> Self::Half;

    /// The state with what is a function of the positions computed anew.
    fn renewed(&self, state: &S) -> S;
}

/// `y' = f(t, y)` of states `S` in vectors, where `f` depends on constants `C`.
pub trait Packing<S, C> {
    /// A state in vectors.
    type Packed: StateVector<f64>;

    /// The state in vectors; some components may stand in several lanes, and some lanes may hold none.
    fn packed(&self, state: &S) -> Self::Packed;

    /// The state of vectors.
    fn unpacked(&self, packed: &Self::Packed) -> S;

    /// `f(t, y)`, with the bits that it has over single components whose multiply-add is that of the vectors.
    fn slope(&self, vectors: impl Vectors, t: f64, constants: &C, packed: &Self::Packed) -> Self::Packed;
}

/// `phi' = T'(Pi)`, `Pi' = F(t, phi)`, with a centre of mass or without, and with the work of its forces: the motion of a body
/// without its constraint `det phi = 1`, for a method that solves for the multiplier. Models have it that are masses under forces
/// that depend on positions alone.
pub trait Unconstrained {
    /// Placement and canonical momentum, with the centre of mass where there is one, and with the work where that is accounted for.
    type State: StateVector<f64>;
    /// What the components of a state are.
    const GROUPS: &'static [Group];

    /// The time derivative of a state.
    fn rates(&self, t: f64, state: &Self::State) -> Self::State;
}

/// A capability that was not emitted: there is no such value.
#[derive(Clone, Copy, Debug)]
pub enum NotEmitted {}

/// Whether there are values of a capability's type, [`NotEmitted`] being the one without: only then does `Option<R>` have
/// to tell two cases apart. What is done under this condition is not compiled for models that have no use for it.
pub const fn is_emitted<R>() -> bool {
    size_of::<Option<R>>() != 0
}

impl<S, C> Series<S, C> for NotEmitted {
    type Row = [f64; 0];

    fn coefficients(&self, _: (f64, f64), _: &C, _: &mut [S], _: &mut [[f64; 0]]) {
        match *self {}
    }
}

impl<S, C> Pieces<S, C> for NotEmitted {
    const COUNT: usize = 0;
    const NYSTROM: bool = false;
    const DILATES: bool = false;

    fn flow(&self, _: usize, _: f64, _: f64, _: &C, _: &mut Sum<S>) {
        match *self {}
    }
}

impl<S, C> SecondOrder<S, C> for NotEmitted {
    type Half = [f64; 0];

    fn drift(&self, _: &C, _: &[f64; 0]) -> [f64; 0] {
        match *self {}
    }

    fn force(&self, _: f64, _: &C, _: &[f64; 0]) -> [f64; 0] {
        match *self {}
    }

    fn renewed(&self, _: &S) -> S {
        match *self {}
    }
}

impl Unconstrained for NotEmitted {
    type State = [f64; 0];
    const GROUPS: &'static [Group] = &[];

    fn rates(&self, _: f64, _: &[f64; 0]) -> [f64; 0] {
        match *self {}
    }
}

impl<S, C> Packing<S, C> for NotEmitted {
    type Packed = [f64; 0];

    fn packed(&self, _: &S) -> [f64; 0] {
        match *self {}
    }

    fn unpacked(&self, _: &[f64; 0]) -> S {
        match *self {}
    }

    fn slope(&self, _: impl Vectors, _: f64, _: &C, _: &[f64; 0]) -> [f64; 0] {
        match *self {}
    }
}

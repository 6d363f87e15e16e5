//! Coordinates in which one-step methods run: the components themselves, or a chart of a group around the last
//! placement.

mod chart;

pub use affine_core::system::Sum;
pub use chart::Chart;
pub(crate) use chart::adjugate;

use affine_core::model::StateVector;

/// Local coordinates `z` around a point of the state space, in which a step of a method for vector spaces is taken.
///
/// [`Flat`]: the state itself. [`Chart`]: a chart of the group that holds the placement, so that whatever a method
/// does to `z`, the state stays on the group (RKMK methods: H. Munthe-Kaas, Appl. Numer. Math. 29 (1999) 115-127;
/// Hairer, Lubich, Wanner, Geometric Numerical Integration, section IV.8).
pub trait Coordinates<S: StateVector<f64>>: Copy {
    /// The coordinates of `base` itself.
    fn origin(&self, base: &Sum<S>) -> Sum<S>;

    /// The state with the coordinates `z` around `base`.
    fn state(&self, base: &Sum<S>, z: &S) -> Sum<S>;

    /// `z'` of a state at `z` whose time derivative is `rate`.
    fn velocity(&self, state: &S, z: &S, rate: &S) -> S;

    /// The change of the state that a small change of its coordinates near those of `base` makes.
    fn change(&self, base: &Sum<S>, dz: &S) -> S;

    /// The point half-way to the one with the coordinates `rise` around `base`, as seen from there: a method that
    /// works around it is symmetric where it is symmetric in vector spaces (A. Zanna, K. Engo, H. Munthe-Kaas, BIT 41
    /// (2001) 395-421). A vector space is symmetric about each of its points: `base` itself.
    fn middle(&self, base: &Sum<S>, rise: &S) -> Sum<S>;

    /// The coordinates around [`middle`](Self::middle) of the point `z` as counted from the beginning of the step.
    fn centred(&self, z: &S, rise: &S) -> S;

    /// The end of a step of total increment `rise`: from `base` to the middle and once more as far.
    fn end(&self, base: &Sum<S>, rise: &S) -> Sum<S>;
}

/// The components of the state are its coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flat;

impl<S: StateVector<f64>> Coordinates<S> for Flat {
    #[inline(always)]
    fn origin(&self, base: &Sum<S>) -> Sum<S> {
        *base
    }
    #[inline(always)]
    fn state(&self, _base: &Sum<S>, z: &S) -> Sum<S> {
        Sum::of(*z)
    }
    #[inline(always)]
    fn velocity(&self, _state: &S, _z: &S, rate: &S) -> S {
        *rate
    }
    #[inline(always)]
    fn change(&self, _base: &Sum<S>, dz: &S) -> S {
        *dz
    }
    #[inline(always)]
    fn middle(&self, base: &Sum<S>, _rise: &S) -> Sum<S> {
        *base
    }
    #[inline(always)]
    fn centred(&self, z: &S, _rise: &S) -> S {
        *z
    }
    #[inline(always)]
    fn end(&self, base: &Sum<S>, rise: &S) -> Sum<S> {
        base.plus(rise)
    }
}

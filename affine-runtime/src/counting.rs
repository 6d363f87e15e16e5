//! A number that counts the operations done with it.
//!
//! ```
//! use affine_runtime::counting::Counting;
//!
//! let (_, operations) = Counting::count(|| Counting::from(2.0) * Counting::from(3.0) + Counting::from(1.0));
//! assert_eq!((operations.mul, operations.add), (1, 1));
//! ```

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use std::cell::Cell;

use num_traits::{One, Zero};

use crate::model::Operations;
use crate::scalar::{Real, Scalar};

thread_local! {
    static DONE: Cell<Operations> = const {
        Cell::new(Operations { mul: 0, add: 0, div: 0, sqrt: 0, exp: 0, ln: 0 })
    };
}

/// A double that counts: additions and subtractions as `add`, a multiply-add as one of each, a change of sign
/// and a constant as nothing.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Counting(f64);

impl Counting {
    /// Runs `work` and returns its result with the operations this thread did meanwhile.
    pub fn count<R>(work: impl FnOnce() -> R) -> (R, Operations) {
        let before = DONE.replace(Operations::default());
        let result = work();
        (result, DONE.replace(before))
    }

    /// The number itself.
    #[must_use]
    pub fn value(self) -> f64 {
        self.0
    }
}

impl From<f64> for Counting {
    fn from(value: f64) -> Self {
        Self(value)
    }
}

/// Counts one operation.
fn tick(count: impl FnOnce(&mut Operations)) {
    let mut done = DONE.get();
    count(&mut done);
    DONE.set(done);
}

macro_rules! counted {
    ($trait:ident $method:ident, $assign:ident $assign_method:ident, $field:ident) => {
        impl $trait for Counting {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                tick(|done| done.$field += 1);
                Self(self.0.$method(other.0))
            }
        }
        impl $assign for Counting {
            fn $assign_method(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    };
}

counted!(Add add, AddAssign add_assign, add);
counted!(Sub sub, SubAssign sub_assign, add);
counted!(Mul mul, MulAssign mul_assign, mul);
counted!(Div div, DivAssign div_assign, div);

impl Neg for Counting {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Zero for Counting {
    fn zero() -> Self {
        Self(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Counting {
    fn one() -> Self {
        Self(1.0)
    }
}

macro_rules! counted_functions {
    ($($function:ident counts $field:ident;)*) => { $(
        fn $function(self) -> Self {
            tick(|done| done.$field += 1);
            Self(Scalar::$function(self.0))
        }
    )* };
}

impl Scalar for Counting {
    fn constant(hi: f64, _lo: f64) -> Self {
        Self(hi)
    }

    counted_functions! {
        sqrt counts sqrt;
        cbrt counts sqrt;
        exp counts exp;
        exp_m1 counts exp;
        sinh counts exp;
        cosh counts exp;
        tanh counts exp;
        asinh counts ln;
        ln counts ln;
        ln_1p counts ln;
        sin counts exp;
        cos counts exp;
        tan counts exp;
    }

    fn abs(self) -> Self {
        Self(Scalar::abs(self.0))
    }

    fn copysign(self, sign: Self) -> Self {
        Self(Scalar::copysign(self.0, sign.0))
    }

    fn max(self, other: Self) -> Self {
        Self(Scalar::max(self.0, other.0))
    }
}

impl Real for Counting {
    const EPSILON: Self = Self(f64::EPSILON);

    fn hypot(self, other: Self) -> Self {
        tick(|done| {
            done.mul += 2;
            done.add += 1;
            done.sqrt += 1;
        });
        Self(Real::hypot(self.0, other.0))
    }
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    fn to_f64(self) -> f64 {
        self.0
    }
}

//! What straight-line code computes, written down while it computes: a number that records the operations done with it.

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use std::cell::RefCell;

use num_traits::{One, Zero};

use crate::scalar::{Real, Scalar};

/// What an operation reads: what an earlier one gave, or a number that does not depend on the arguments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Operand {
    Node(usize),
    Constant(f64),
}

/// An elementary function of one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unary {
    Sqrt,
    Cbrt,
    InverseCbrt,
    Exp,
    ExpM1,
    Ln,
    Ln1p,
    Sin,
    Cos,
    Tan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Abs,
}

impl Unary {
    pub(super) fn of<T: Scalar>(self, x: T) -> T {
        match self {
            Self::Sqrt => x.sqrt(),
            Self::Cbrt => x.cbrt(),
            Self::InverseCbrt => x.inverse_cbrt(),
            Self::Exp => x.exp(),
            Self::ExpM1 => x.exp_m1(),
            Self::Ln => x.ln(),
            Self::Ln1p => x.ln_1p(),
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => x.tanh(),
            Self::Asinh => x.asinh(),
            Self::Abs => x.abs(),
        }
    }
}

/// An operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Operation {
    Argument,
    Add(Operand, Operand),
    Sub(Operand, Operand),
    Mul(Operand, Operand),
    Div(Operand, Operand),
    Neg(Operand),
    /// `a*b + c`.
    Fma(Operand, Operand, Operand),
    CopySign(Operand, Operand),
    Max(Operand, Operand),
    Of(Unary, Operand),
}

impl Operation {
    pub(super) fn operands(self) -> [Option<Operand>; 3] {
        match self {
            Self::Argument => [None; 3],
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::CopySign(a, b)
            | Self::Max(a, b) => [Some(a), Some(b), None],
            Self::Fma(a, b, c) => [Some(a), Some(b), Some(c)],
            Self::Neg(a) | Self::Of(_, a) => [Some(a), None, None],
        }
    }
}

thread_local! {
    static TAPE: RefCell<Option<Vec<Operation>>> = const { RefCell::new(None) };
}

/// Runs `work`, which is given that many arguments, and returns what is recorded with the operands that it returns.
/// What depends on no argument is computed and not recorded.
pub(super) fn recorded(
    arguments: &[f64],
    work: impl FnOnce(&[Recorded]) -> Vec<Recorded>,
) -> (Vec<Operation>, Vec<Operand>) {
    let before = TAPE.replace(Some(vec![Operation::Argument; arguments.len()]));
    let numbers = arguments.iter().enumerate().map(|(k, value)| Recorded { value: *value, node: Some(k) });
    let results = work(&numbers.collect::<Vec<_>>());
    let tape = TAPE.replace(before).unwrap_or_default();
    (tape, results.iter().map(Recorded::operand).collect())
}

/// A double that is recorded where it depends on an argument.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recorded {
    value: f64,
    node: Option<usize>,
}

impl Recorded {
    fn operand(&self) -> Operand {
        self.node.map_or(Operand::Constant(self.value), Operand::Node)
    }

    /// The result of an operation.
    fn result(value: f64, operands: &[Self], operation: Operation) -> Self {
        if operands.iter().all(|operand| operand.node.is_none()) {
            return Self { value, node: None };
        }
        let node = TAPE.with_borrow_mut(|tape| {
            let tape = tape.as_mut()?;
            tape.push(operation);
            Some(tape.len() - 1)
        });
        Self { value, node }
    }

    fn of(self, function: Unary) -> Self {
        Self::result(function.of(self.value), &[self], Operation::Of(function, self.operand()))
    }
}

/// Comparisons choose a branch as the values do.
impl PartialEq for Recorded {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for Recorded {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

macro_rules! recorded_operators {
    ($($trait:ident $method:ident $assign:ident $assign_method:ident;)*) => { $(
        impl $trait for Recorded {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                let operation = Operation::$trait(self.operand(), other.operand());
                Self::result(self.value.$method(other.value), &[self, other], operation)
            }
        }
        impl $assign for Recorded {
            fn $assign_method(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    )* };
}

recorded_operators! {
    Add add AddAssign add_assign;
    Sub sub SubAssign sub_assign;
    Mul mul MulAssign mul_assign;
    Div div DivAssign div_assign;
}

impl Neg for Recorded {
    type Output = Self;
    fn neg(self) -> Self {
        Self::result(-self.value, &[self], Operation::Neg(self.operand()))
    }
}

impl Zero for Recorded {
    fn zero() -> Self {
        Self { value: 0.0, node: None }
    }
    fn is_zero(&self) -> bool {
        self.value == 0.0
    }
}

impl One for Recorded {
    fn one() -> Self {
        Self { value: 1.0, node: None }
    }
}

macro_rules! recorded_functions {
    ($($function:ident $name:ident;)*) => { $(
        fn $function(self) -> Self {
            self.of(Unary::$name)
        }
    )* };
}

impl Scalar for Recorded {
    fn constant(hi: f64, _lo: f64) -> Self {
        Self { value: hi, node: None }
    }
    fn fma(self, factor: Self, term: Self) -> Self {
        let operation = Operation::Fma(self.operand(), factor.operand(), term.operand());
        Self::result(self.value.fma(factor.value, term.value), &[self, factor, term], operation)
    }
    fn copysign(self, sign: Self) -> Self {
        let operation = Operation::CopySign(self.operand(), sign.operand());
        Self::result(Scalar::copysign(self.value, sign.value), &[self, sign], operation)
    }
    fn max(self, other: Self) -> Self {
        let operation = Operation::Max(self.operand(), other.operand());
        Self::result(Scalar::max(self.value, other.value), &[self, other], operation)
    }

    recorded_functions! {
        sqrt Sqrt;
        cbrt Cbrt;
        inverse_cbrt InverseCbrt;
        exp Exp;
        exp_m1 ExpM1;
        ln Ln;
        ln_1p Ln1p;
        sin Sin;
        cos Cos;
        tan Tan;
        sinh Sinh;
        cosh Cosh;
        tanh Tanh;
        asinh Asinh;
        abs Abs;
    }
}

impl Real for Recorded {
    const EPSILON: Self = Self { value: f64::EPSILON, node: None };

    fn hypot(self, other: Self) -> Self {
        let size = Real::hypot(self.value, other.value);
        let scale = Self { value: if size == 0.0 { 1.0 } else { size }, node: None };
        let (a, b) = (self / scale, other / scale);
        (a * a + b * b).sqrt() * scale
    }
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }
    fn to_f64(self) -> f64 {
        self.value
    }
}

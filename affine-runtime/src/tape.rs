//! What straight-line code computes, written down while it computes: a number that records the operations done with it.

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use std::cell::RefCell;

use num_traits::{One, Zero};

use crate::dual::Dual;
use crate::scalar::{Real, Scalar};

/// What an operation reads: what an earlier one gave, or a number that does not depend on the arguments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Operand {
    Node(usize),
    Constant(f64),
}

impl Operand {
    /// What is read.
    pub(crate) fn of<T: Scalar>(self, values: &[T]) -> T {
        match self {
            Self::Node(node) => values[node],
            Self::Constant(value) => T::constant(value, 0.0),
        }
    }
}

/// An operation with what it reads; those of one or two numbers read zeros besides.
pub(crate) type Operation = (Kind, [Operand; 3]);

/// What was done, in order, with what came of it.
#[derive(Clone, Debug)]
pub(crate) struct Tape {
    pub(crate) operations: Vec<Operation>,
    /// Numbers of which one at least depends on the arguments, and whether they were equal: with another answer other operations
    /// may follow.
    pub(crate) comparisons: Vec<([Operand; 2], bool)>,
    pub(crate) results: Vec<Operand>,
}

impl Tape {
    /// Before anything is done with so many arguments.
    const fn new(operations: Vec<Operation>) -> Self {
        Self { operations, comparisons: Vec::new(), results: Vec::new() }
    }

    /// The values of all operations, from those of the arguments.
    pub(crate) fn values<T: Scalar>(&self, mut values: Vec<T>) -> Vec<T> {
        for (kind, operands) in &self.operations[values.len()..] {
            values.push(kind.of(operands.map(|operand| operand.of(&values))));
        }
        values
    }

    /// Whether what these values come from would do the same operations: whether what is compared is equal where it was.
    pub(crate) fn is_branch_of<T: Scalar>(&self, values: &[T]) -> bool {
        self.comparisons.iter().all(|([a, b], is_equal)| (a.of(values) == b.of(values)) == *is_equal)
    }

    /// Whether derivatives depend on the direction along which they are taken: where stretches coincide, numbers on the way do, and
    /// at the ends of branches so do these.
    pub(crate) fn is_directed(&self) -> bool {
        let is_apart = |(kind, _): &Operation| matches!(kind, Kind::FirstApart | Kind::SecondApart);
        !self.comparisons.is_empty() || self.operations.iter().any(is_apart)
    }
}

impl Kind {
    /// The derivative by one of the numbers that are read, up to the sign, which is minus where it is `true`. `None` is 1, by which
    /// nothing is multiplied.
    pub(crate) fn partial<T: Scalar>(self, k: usize, operands: [T; 3]) -> (bool, Option<T>) {
        match (self, k) {
            (Self::Add, _) | (Self::Sub, 0) | (Self::Fma, 2) => (false, None),
            (Self::Sub | Self::Neg, _) => (true, None),
            (Self::Mul | Self::Fma, k) => (false, Some(operands[1 - k])),
            _ => {
                let mut varied = operands.map(Dual::fixed);
                varied[k].slope = T::one();
                (false, Some(self.of(varied).slope))
            }
        }
    }
}

macro_rules! operations {
    ({ $($operator:ident $operate:ident $assign:ident $operate_assign:ident;)* } { $($name:ident $function:ident;)* }) => {
        /// What is done.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(crate) enum Kind {
            Argument,
            Neg,
            /// `a*b + c`.
            Fma,
            CopySign,
            Max,
            /// What tells directions apart, see [`Scalar::told_apart`].
            FirstApart,
            SecondApart,
            $($operator,)*
            $($name,)*
        }

        impl Kind {
            pub(crate) fn of<T: Scalar>(self, [a, b, c]: [T; 3]) -> T {
                match self {
                    Self::Argument => a,
                    Self::Neg => -a,
                    Self::Fma => a.fma(b, c),
                    Self::CopySign => a.copysign(b),
                    Self::Max => Scalar::max(a, b),
                    Self::FirstApart => T::told_apart([a, b], c)[0],
                    Self::SecondApart => T::told_apart([a, b], c)[1],
                    $(Self::$operator => a.$operate(b),)*
                    $(Self::$name => Scalar::$function(a),)*
                }
            }
        }

        $(
            impl $operator for Recorded {
                type Output = Self;
                fn $operate(self, other: Self) -> Self {
                    Self::result(Kind::$operator, [self, other, Self::zero()])
                }
            }
            impl $assign for Recorded {
                fn $operate_assign(&mut self, other: Self) {
                    *self = self.$operate(other);
                }
            }
        )*

        impl Scalar for Recorded {
            fn constant(hi: f64, _lo: f64) -> Self {
                Self { value: hi, node: None }
            }
            fn told_apart([a, b]: [Self; 2], size: Self) -> [Self; 2] {
                [Kind::FirstApart, Kind::SecondApart].map(|kind| Self::result(kind, [a, b, size]))
            }
            fn fma(self, factor: Self, term: Self) -> Self {
                Self::result(Kind::Fma, [self, factor, term])
            }
            fn copysign(self, sign: Self) -> Self {
                Self::result(Kind::CopySign, [self, sign, Self::zero()])
            }
            fn max(self, other: Self) -> Self {
                Self::result(Kind::Max, [self, other, Self::zero()])
            }
            $(
                fn $function(self) -> Self {
                    Self::result(Kind::$name, [self, Self::zero(), Self::zero()])
                }
            )*
        }
    };
}

operations! {
    {
        Add add AddAssign add_assign;
        Sub sub SubAssign sub_assign;
        Mul mul MulAssign mul_assign;
        Div div DivAssign div_assign;
    }
    {
        Sqrt sqrt;
        Cbrt cbrt;
        InverseCbrt inverse_cbrt;
        Exp exp;
        ExpM1 exp_m1;
        Ln ln;
        Ln1p ln_1p;
        Sin sin;
        Cos cos;
        Tan tan;
        Sinh sinh;
        Cosh cosh;
        Tanh tanh;
        Asinh asinh;
        Abs abs;
    }
}

thread_local! {
    static TAPE: RefCell<Tape> = const { RefCell::new(Tape::new(Vec::new())) };
}

/// Runs `work`, which is given that many arguments, and returns what is recorded with what it returns.
/// What depends on no argument is computed and not recorded.
pub(crate) fn recorded(arguments: &[f64], work: impl FnOnce(&[Recorded]) -> Vec<Recorded>) -> Tape {
    let argument = (Kind::Argument, [Operand::Constant(0.0); 3]);
    let before = TAPE.replace(Tape::new(vec![argument; arguments.len()]));
    let numbers = arguments.iter().enumerate().map(|(k, value)| Recorded { value: *value, node: Some(k) });
    let results = work(&numbers.collect::<Vec<_>>());
    Tape { results: results.iter().map(Recorded::operand).collect(), ..TAPE.replace(before) }
}

/// A double that is recorded where it depends on an argument.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recorded {
    value: f64,
    node: Option<usize>,
}

impl Recorded {
    fn operand(&self) -> Operand {
        self.node.map_or(Operand::Constant(self.value), Operand::Node)
    }

    fn result(kind: Kind, operands: [Self; 3]) -> Self {
        let value = kind.of(operands.map(|operand| operand.value));
        if operands.iter().all(|operand| operand.node.is_none()) {
            return Self { value, node: None };
        }
        TAPE.with_borrow_mut(|Tape { operations, .. }| {
            operations.push((kind, operands.map(|operand| operand.operand())));
            Self { value, node: Some(operations.len() - 1) }
        })
    }
}

/// Comparisons choose a branch as the values do, and are recorded as well.
impl PartialEq for Recorded {
    fn eq(&self, other: &Self) -> bool {
        let (both, is_equal) = ([self, other], self.value == other.value);
        if both.iter().any(|number| number.node.is_some()) {
            let comparison = (both.map(Self::operand), is_equal);
            TAPE.with_borrow_mut(|tape| tape.comparisons.push(comparison));
        }
        is_equal
    }
}

/// Equations alone are recorded, and ask for no order, see [`Scalar`].
impl PartialOrd for Recorded {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl Neg for Recorded {
    type Output = Self;
    fn neg(self) -> Self {
        Self::result(Kind::Neg, [self, Self::zero(), Self::zero()])
    }
}

impl Zero for Recorded {
    fn zero() -> Self {
        Self { value: 0.0, node: None }
    }
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl One for Recorded {
    fn one() -> Self {
        Self { value: 1.0, node: None }
    }
}

impl Real for Recorded {
    const EPSILON: Self = Self { value: f64::EPSILON, node: None };

    fn hypot(self, other: Self) -> Self {
        (self * self + other * other).sqrt()
    }
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }
    fn to_f64(self) -> f64 {
        self.value
    }
}

//! The methods with their embedded solutions.

use super::{dormand_el_mikkawy_prince_86 as dep86, dormand_el_mikkawy_prince_1210 as dep1210};
use crate::stages::difference;

/// The most stages there are.
pub(super) const MOST_STAGES: usize = 17;

/// Pairs (stage, coefficient), stages counted from 1.
pub(super) type Row = &'static [(usize, f64)];

/// A Runge-Kutta-Nystrom method with an embedded solution: [`Tableau::ORDER_12`] or [`Tableau::ORDER_8`].
///
/// The pair 6(4) of the same authors takes 314 evaluations for an error of 1e-3 on P3 where order 8 takes 329, but twice
/// as many steps, and is slower at every error.
#[derive(Debug, PartialEq)]
pub struct Tableau {
    order: u32,
    /// Order of the leading term of the error estimate in the step size: that of the local error of the embedded
    /// solution.
    pub(super) error_order: f64,
    /// Steps aim at an error so many times below the tolerance.
    pub(super) margin: f64,
    /// The stages after the first, without the one at the end of the step.
    pub(super) inner: &'static [Later],
    /// The last stage is the first of the next step.
    pub(super) closes: bool,
    /// `b_i`
    pub(super) position: Row,
    /// `b'_i`
    pub(super) momentum: Row,
    /// Solution less the embedded solution.
    pub(super) position_error: Row,
    /// The same of the momenta.
    pub(super) momentum_error: Row,
}

/// A stage after the first.
#[derive(Debug, PartialEq)]
pub(super) struct Later {
    pub(super) number: usize,
    /// `c_i`
    pub(super) node: f64,
    /// `a_ij` of the stages before the one just before.
    pub(super) earlier: Row,
    /// `a_i,i-1`; the last two stages of order 12 do not wait for each other.
    pub(super) newest: f64,
}

const fn later(number: usize, nodes: Row, row: Row) -> Later {
    let (_, node) = nodes[number - 2];
    match row {
        [earlier @ .., (last, newest)] if *last == number - 1 => {
            Later { number, node, earlier, newest: *newest }
        }
        earlier => Later { number, node, earlier, newest: 0.0 },
    }
}

impl Tableau {
    /// Order 12 with an embedded solution of order 10, 17 stages.
    pub const ORDER_12: Self = {
        use dep1210::*;
        Self {
            order: 12,
            error_order: 11.0,
            // With it one step in twelve is rejected where it was one in five, and the same errors cost 3 percent less
            // (eleven motions in two and three dimensions, errors from 1e-3 to 1e-12).
            margin: 5.0,
            inner: &[
                later(2, &NODES, &A2),
                later(3, &NODES, &A3),
                later(4, &NODES, &A4),
                later(5, &NODES, &A5),
                later(6, &NODES, &A6),
                later(7, &NODES, &A7),
                later(8, &NODES, &A8),
                later(9, &NODES, &A9),
                later(10, &NODES, &A10),
                later(11, &NODES, &A11),
                later(12, &NODES, &A12),
                later(13, &NODES, &A13),
                later(14, &NODES, &A14),
                later(15, &NODES, &A15),
                later(16, &NODES, &A16),
                later(17, &NODES, &A17),
            ],
            closes: false,
            position: &POSITION,
            momentum: &MOMENTUM,
            position_error: &difference(POSITION, &EMBEDDED_POSITION),
            momentum_error: &difference(MOMENTUM, &EMBEDDED_MOMENTUM),
        }
    };

    /// Order 8 with an embedded solution of order 6, 9 stages, the last of which is the first of the next step.
    pub const ORDER_8: Self = {
        use dep86::*;
        Self {
            order: 8,
            error_order: 7.0,
            // P3 to an error of 1e-3: 329 evaluations where 1 takes 364; to 1e-6, 699 where it takes 741.
            margin: 3.0,
            inner: &[
                later(2, &NODES, &A2),
                later(3, &NODES, &A3),
                later(4, &NODES, &A4),
                later(5, &NODES, &A5),
                later(6, &NODES, &A6),
                later(7, &NODES, &A7),
                later(8, &NODES, &A8),
            ],
            closes: true,
            position: &POSITION,
            momentum: &MOMENTUM,
            position_error: &difference(POSITION, &EMBEDDED_POSITION),
            momentum_error: &MOMENTUM_ERROR_8,
        }
    };

    /// Order of the method.
    #[must_use]
    pub fn order(&self) -> u32 {
        self.order
    }

    /// Evaluations of an attempted step.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.inner.len() as u64 + u64::from(self.closes)
    }
}

/// `difference` wants the stages of the longer row, which is the embedded one here.
const MOMENTUM_ERROR_8: [(usize, f64); dep86::EMBEDDED_MOMENTUM.len()] = {
    let mut negative = difference(dep86::EMBEDDED_MOMENTUM, &dep86::MOMENTUM);
    let mut k = 0;
    while k < negative.len() {
        negative[k].1 = -negative[k].1;
        k += 1;
    }
    negative
};

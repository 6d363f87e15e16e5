//! Coefficients of the method of Dormand and Prince of order 5 with an embedded solution and a dense output of order 4.
//!
//! Source: J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19-26; dense output of L. F. Shampine as in
//! E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd revised edition, Springer 1993,
//! table II.5.2 and section II.6, in the fractions of their program DOPRI5. The tests check the order conditions exactly.
//!
//! The slope at the end of the step, the seventh stage, is number 13, where [`OneStep`](super::step::OneStep) keeps it.

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod order_conditions;

use crate::published::rows;

rows! {
    /// Nodes `c_2` to `c_7`.
    NODES: 6 = [
        (2, 1.0 / 5.0),
        (3, 3.0 / 10.0),
        (4, 4.0 / 5.0),
        (5, 8.0 / 9.0),
        (6, 1.0),
        (13, 1.0),
    ];
    /// Row 2 of the matrix `a_ij`.
    A2: 1 = [
        (1, 1.0 / 5.0),
    ];
    /// Row 3.
    A3: 2 = [
        (1, 3.0 / 40.0),
        (2, 9.0 / 40.0),
    ];
    /// Row 4.
    A4: 3 = [
        (1, 44.0 / 45.0),
        (2, -56.0 / 15.0),
        (3, 32.0 / 9.0),
    ];
    /// Row 5.
    A5: 4 = [
        (1, 19372.0 / 6561.0),
        (2, -25360.0 / 2187.0),
        (3, 64448.0 / 6561.0),
        (4, -212.0 / 729.0),
    ];
    /// Row 6.
    A6: 5 = [
        (1, 9017.0 / 3168.0),
        (2, -355.0 / 33.0),
        (3, 46732.0 / 5247.0),
        (4, 49.0 / 176.0),
        (5, -5103.0 / 18656.0),
    ];
    /// Weights of the solution of order 5.
    B: 5 = [
        (1, 35.0 / 384.0),
        (3, 500.0 / 1113.0),
        (4, 125.0 / 192.0),
        (5, -2187.0 / 6784.0),
        (6, 11.0 / 84.0),
    ];
    /// Solution less the embedded solution of order 4.
    E: 6 = [
        (1, 71.0 / 57600.0),
        (3, -71.0 / 16695.0),
        (4, 71.0 / 1920.0),
        (5, -17253.0 / 339200.0),
        (6, 22.0 / 525.0),
        (13, -1.0 / 40.0),
    ];
    /// Dense output.
    D: 6 = [
        (1, -12715105075.0 / 11282082432.0),
        (3, 87487479700.0 / 32700410799.0),
        (4, -10690763975.0 / 1880347072.0),
        (5, 701980252875.0 / 199316789632.0),
        (6, -1453857185.0 / 822651844.0),
        (13, 69997945.0 / 29380423.0),
    ];
}

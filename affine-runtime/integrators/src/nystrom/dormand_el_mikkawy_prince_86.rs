//! Coefficients of the Runge-Kutta-Nystrom method of Dormand, El-Mikkawy and Prince of order 8, with an embedded
//! solution of order 6: RKN8(6)9FM.
//!
//! Source: J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince, High-order embedded Runge-Kutta-Nystrom formulae, IMA
//! Journal of Numerical Analysis 7 (1987) 423-430, table 1, with the corrections that D. F. Crouse gives in the Tracker
//! Component Library. The tests check the order conditions on these fractions exactly.

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod order_conditions;

use crate::published::rows;

rows! {
    /// Nodes `c_2` to `c_9`.
    NODES: 8 = [
        (2, 1.0 / 20.0),
        (3, 1.0 / 10.0),
        (4, 3.0 / 10.0),
        (5, 1.0 / 2.0),
        (6, 7.0 / 10.0),
        (7, 9.0 / 10.0),
        (8, 1.0),
        (9, 1.0),
    ];
    /// Row 2 of the matrix `a_ij`.
    A2: 1 = [
        (1, 1.0 / 800.0),
    ];
    /// Row 3 of the matrix `a_ij`.
    A3: 2 = [
        (1, 1.0 / 600.0),
        (2, 1.0 / 300.0),
    ];
    /// Row 4 of the matrix `a_ij`.
    A4: 3 = [
        (1, 9.0 / 200.0),
        (2, -9.0 / 100.0),
        (3, 9.0 / 100.0),
    ];
    /// Row 5 of the matrix `a_ij`.
    A5: 4 = [
        (1, -66701.0 / 197352.0),
        (2, 28325.0 / 32892.0),
        (3, -2665.0 / 5482.0),
        (4, 2170.0 / 24669.0),
    ];
    /// Row 6 of the matrix `a_ij`.
    A6: 5 = [
        (1, 227015747.0 / 304251000.0),
        (2, -54897451.0 / 30425100.0),
        (3, 12942349.0 / 10141700.0),
        (4, -9499.0 / 304251.0),
        (5, 539.0 / 9250.0),
    ];
    /// Row 7 of the matrix `a_ij`.
    A7: 6 = [
        (1, -1131891597.0 / 901789000.0),
        (2, 41964921.0 / 12882700.0),
        (3, -6663147.0 / 3220675.0),
        (4, 270954.0 / 644135.0),
        (5, -108.0 / 5875.0),
        (6, 114.0 / 1645.0),
    ];
    /// Row 8 of the matrix `a_ij`.
    A8: 7 = [
        (1, 13836959.0 / 3667458.0),
        (2, -17731450.0 / 1833729.0),
        (3, 1063919505.0 / 156478208.0),
        (4, -33213845.0 / 39119552.0),
        (5, 13335.0 / 28544.0),
        (6, -705.0 / 14272.0),
        (7, 1645.0 / 57088.0),
    ];
    /// Weights `b_i` of the positions, order 8: row 9 of the matrix as well.
    POSITION: 6 = [
        (1, 223.0 / 7938.0),
        (3, 1175.0 / 8064.0),
        (4, 925.0 / 6048.0),
        (5, 41.0 / 448.0),
        (6, 925.0 / 14112.0),
        (7, 1175.0 / 72576.0),
    ];
    /// Weights `b'_i` of the momenta, order 8.
    MOMENTUM: 7 = [
        (1, 223.0 / 7938.0),
        (3, 5875.0 / 36288.0),
        (4, 4625.0 / 21168.0),
        (5, 41.0 / 224.0),
        (6, 4625.0 / 21168.0),
        (7, 5875.0 / 36288.0),
        (8, 223.0 / 7938.0),
    ];
    /// Weights of the positions in the embedded solution, order 6.
    EMBEDDED_POSITION: 6 = [
        (1, 7987313.0 / 109941300.0),
        (3, 1610737.0 / 44674560.0),
        (4, 10023263.0 / 33505920.0),
        (5, -497221.0 / 12409600.0),
        (6, 10023263.0 / 78180480.0),
        (7, 1610737.0 / 402071040.0),
    ];
    /// Weights of the momenta in the embedded solution, order 6.
    EMBEDDED_MOMENTUM: 8 = [
        (1, 7987313.0 / 109941300.0),
        (3, 1610737.0 / 40207104.0),
        (4, 10023263.0 / 23454144.0),
        (5, -497221.0 / 6204800.0),
        (6, 10023263.0 / 23454144.0),
        (7, 1610737.0 / 40207104.0),
        (8, -4251941.0 / 54970650.0),
        (9, 3.0 / 20.0),
    ];
}

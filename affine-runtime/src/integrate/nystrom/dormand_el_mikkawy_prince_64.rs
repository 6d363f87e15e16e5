//! Coefficients of the Runge-Kutta-Nystrom method of Dormand, El-Mikkawy and Prince of order 6, with an embedded
//! solution of order 4: RKN6(4)6FM.
//!
//! Source: J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince, Families of Runge-Kutta-Nystrom formulae, IMA Journal of
//! Numerical Analysis 7 (1987) 235-250. The tests check the order conditions on these fractions exactly.

use crate::integrate::published::rows;

rows! {
    /// Nodes `c_2` to `c_6`.
    NODES: 5 = [
        (2, 1.0 / 10.0),
        (3, 3.0 / 10.0),
        (4, 7.0 / 10.0),
        (5, 17.0 / 25.0),
        (6, 1.0),
    ];
    /// Row 2 of the matrix `a_ij`.
    A2: 1 = [
        (1, 1.0 / 200.0),
    ];
    /// Row 3 of the matrix `a_ij`.
    A3: 2 = [
        (1, -1.0 / 2200.0),
        (2, 1.0 / 22.0),
    ];
    /// Row 4 of the matrix `a_ij`.
    A4: 3 = [
        (1, 637.0 / 6600.0),
        (2, -7.0 / 110.0),
        (3, 7.0 / 33.0),
    ];
    /// Row 5 of the matrix `a_ij`.
    A5: 4 = [
        (1, 225437.0 / 1968750.0),
        (2, -30073.0 / 281250.0),
        (3, 65569.0 / 281250.0),
        (4, -9367.0 / 984375.0),
    ];
    /// Row 6 of the matrix `a_ij`.
    A6: 5 = [
        (1, 151.0 / 2142.0),
        (2, 5.0 / 116.0),
        (3, 385.0 / 1368.0),
        (4, 55.0 / 168.0),
        (5, -6250.0 / 28101.0),
    ];
    /// Weights `b_i` of the positions, order 6.
    POSITION: 5 = [
        (1, 151.0 / 2142.0),
        (2, 5.0 / 116.0),
        (3, 385.0 / 1368.0),
        (4, 55.0 / 168.0),
        (5, -6250.0 / 28101.0),
    ];
    /// Weights `b'_i` of the momenta, order 6.
    MOMENTUM: 6 = [
        (1, 151.0 / 2142.0),
        (2, 25.0 / 522.0),
        (3, 275.0 / 684.0),
        (4, 275.0 / 252.0),
        (5, -78125.0 / 112404.0),
        (6, 1.0 / 12.0),
    ];
    /// Weights of the positions in the embedded solution, order 4.
    EMBEDDED_POSITION: 5 = [
        (1, 1349.0 / 157500.0),
        (2, 7873.0 / 50000.0),
        (3, 192199.0 / 900000.0),
        (4, 521683.0 / 2100000.0),
        (5, -16.0 / 125.0),
    ];
    /// Weights of the momenta in the embedded solution, order 4.
    EMBEDDED_MOMENTUM: 6 = [
        (1, 1349.0 / 157500.0),
        (2, 7873.0 / 45000.0),
        (3, 27457.0 / 90000.0),
        (4, 521683.0 / 630000.0),
        (5, -2.0 / 5.0),
        (6, 1.0 / 12.0),
    ];
}

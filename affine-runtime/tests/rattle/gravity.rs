//! A self-gravitating, homogeneous, incompressible ellipsoid: a body of d'Alembert with `det phi = 1` (Dirichlet; S.
//! Chandrasekhar, Ellipsoidal Figures of Equilibrium, 1969), in units `G = M = 1`, unit ball at `phi = 1`.
//!
//! ```text
//! T = tr(phi_dot^T phi_dot)/10,      W = -(3/5) R_F(a_1^2, a_2^2, a_3^2),      a_i the stretches
//! ```

use affine_runtime::frames::Matrix;
use ellip::{elliprd, elliprf};

use crate::body::{part, state};

/// `J = M/5` of the unit ball.
pub(crate) const INERTIA: f64 = 0.2;
/// `pi G rho`: the ball of volume `4 pi/3` has mass 1.
pub(crate) const PI_G_RHO: f64 = 0.75;

/// Eigenvalues and eigenvectors, in columns, of a symmetric matrix: cyclic Jacobi rotations (Golub, Van Loan, Matrix
/// Computations, section 8.5).
pub(crate) fn eigen(symmetric: &Matrix<3>) -> ([f64; 3], Matrix<3>) {
    let (mut a, mut vectors) = (*symmetric, Matrix::<3>::identity());
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[(p, q)].abs() < 1e-300 {
                continue;
            }
            let theta = (a[(q, q)] - a[(p, p)]) / (2.0 * a[(p, q)]);
            let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
            let c = 1.0 / t.hypot(1.0);
            let mut turn = Matrix::<3>::identity();
            (turn[(p, p)], turn[(q, q)], turn[(p, q)], turn[(q, p)]) = (c, c, t * c, -t * c);
            a = turn.transpose() * a * turn;
            vectors *= turn;
        }
    }
    ([a[(0, 0)], a[(1, 1)], a[(2, 2)]], vectors)
}

/// `phi' = Pi^T/J`, `Pi' = -(dW/dphi)^T`, `dW/dphi = 2 (dW/dC) phi` with `C = phi phi^T` and `dW/dC` along its
/// eigenvectors `R_D/10`: `dR_F(x, y, z)/dz = -R_D(x, y, z)/6` (NIST DLMF 19.18.1).
pub(crate) fn equations(_: f64, y: &[f64; 18]) -> [f64; 18] {
    let (phi, pi) = (part::<3>(y, 0), part::<3>(y, 1));
    let (squares, axes) = eigen(&(phi * phi.transpose()));
    let mut slope = Matrix::<3>::zeros();
    for k in 0..3 {
        let axis = axes.column(k);
        let (a, b) = (squares[(k + 1) % 3], squares[(k + 2) % 3]);
        slope += axis * axis.transpose() * (elliprd(a, b, squares[k]).unwrap() / 5.0);
    }
    state(&(pi.transpose() / INERTIA), &-(slope * phi).transpose())
}

pub(crate) fn energy(y: &[f64; 18]) -> f64 {
    let (phi, pi) = (part::<3>(y, 0), part::<3>(y, 1));
    let ([a, b, c], _) = eigen(&(phi * phi.transpose()));
    pi.norm_squared() / (2.0 * INERTIA) - 0.6 * elliprf(a, b, c).unwrap()
}

/// Chandrasekhar's index symbols `A_i = (2/3) a_1 a_2 a_3 R_D(a_j^2, a_k^2, a_i^2)`.
pub(crate) fn index_symbols(a: [f64; 3]) -> [f64; 3] {
    let volume: f64 = a.iter().product();
    let square = a.map(|a| a * a);
    core::array::from_fn(|i| {
        2.0 / 3.0 * volume * elliprd(square[(i + 1) % 3], square[(i + 2) % 3], square[i]).unwrap()
    })
}

/// Axes of volume 1 in the given proportions.
pub(crate) fn axes(proportions: [f64; 3]) -> [f64; 3] {
    let mean = proportions.iter().product::<f64>().cbrt();
    proportions.map(|a| a / mean)
}

/// `Omega^2/(pi G rho)` of the Maclaurin spheroid of eccentricity `e`, `2 (A_1 - (1 - e^2) A_3)`: balance of gravity and
/// rotation at pole and equator.
pub(crate) fn maclaurin(e: f64) -> f64 {
    let [a, _, c] = index_symbols(spheroid(e));
    2.0 * (a - (1.0 - e * e) * c)
}

/// Axes of the spheroid of eccentricity `e`.
pub(crate) fn spheroid(e: f64) -> [f64; 3] {
    axes([1.0, 1.0, (1.0 - e * e).sqrt()])
}

/// The ellipsoid that turns with the angular velocity `omega` about its third axis and is at rest in the turning frame.
pub(crate) fn turning(a: [f64; 3], omega: f64) -> [f64; 18] {
    let phi = Matrix::<3>::from_fn(|i, k| if i == k { a[i] } else { 0.0 });
    state(&phi, &(whirl(omega) * phi).transpose().scale(INERTIA))
}

pub(crate) fn whirl(omega: f64) -> Matrix<3> {
    Matrix::<3>::new(0.0, -omega, 0.0, omega, 0.0, 0.0, 0.0, 0.0, 0.0)
}

/// The rotation about the third axis.
pub(crate) fn rotation(angle: f64) -> Matrix<3> {
    let (s, c) = angle.sin_cos();
    Matrix::<3>::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}

/// A zero of `f` between `a` and `b`, by bisection to the last bit.
pub(crate) fn zero(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let sign = f(a) > 0.0;
    assert!(sign != (f(b) > 0.0), "no change of sign");
    while b - a > 2.0 * f64::EPSILON * b {
        let middle = 0.5 * (a + b);
        if (f(middle) > 0.0) == sign { a = middle } else { b = middle }
    }
    0.5 * (a + b)
}

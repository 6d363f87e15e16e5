//! Carlson's symmetric elliptic integrals, by duplication (B. C. Carlson, Numerical Algorithms 10 (1995) 13), and the energy of an
//! ellipsoid in its own gravity, which consists of them: `potential = self_gravity(k)`.

pub(crate) mod ellipsoid;

pub use affine_core::__private::numerics::carlson_rf;

use crate::inner::duplicated;
use crate::scalar::Real;

/// `R_D(x, y, z) = 3/2 int_0^inf ((t + x)(t + y))^(-1/2) (t + z)^(-3/2) dt`, symmetric in `x` and `y`, of which at most one is
/// zero, with positive `z`; not a number where an argument is negative (NIST DLMF 19.16.5, 19.36.2).
///
/// It is the slope of [`carlson_rf`], `dR_F/dz = -R_D(x, y, z)/6`, and gives Chandrasekhar's index symbols of an ellipsoid:
/// `A_3 = (2/3) a b c R_D(a^2, b^2, c^2)`.
///
/// ```
/// use affine_runtime::elliptic::carlson_rd;
///
/// let [a, b, c] = [1.0_f64, 2.0, 3.0];
/// let symbol = |j: f64, k: f64, i: f64| 2.0 / 3.0 * a * b * c * carlson_rd(j * j, k * k, i * i);
/// assert!((symbol(b, c, a) + symbol(c, a, b) + symbol(a, b, c) - 2.0).abs() < 1e-14);
/// ```
#[must_use]
pub fn carlson_rd<T: Real>(x: T, y: T, z: T) -> T {
    let number = T::from_f64;
    let (mut sum, mut scale) = (T::zero(), T::one());
    let mean = |[x, y, z]: [T; 3]| (x + y + number(3.0) * z) / number(5.0);
    let [a, u, v] = duplicated([x, y, z], mean, |root, next| {
        sum += scale / (root * next);
        scale *= number(0.25);
    });
    let w = -(u + v) / number(3.0);
    let square = w * w;
    let e2 = u * v - number(6.0) * square;
    let e3 = (number(3.0) * u * v - number(8.0) * square) * w;
    let e4 = number(3.0) * (u * v - square) * square;
    let e5 = u * v * square * w;
    let series =
        T::one() - number(3.0) * e2 / number(14.0) + e3 / number(6.0) + number(9.0) * e2 * e2 / number(88.0)
            - number(3.0) * e4 / number(22.0)
            - number(9.0) * e2 * e3 / number(52.0)
            + number(3.0) * e5 / number(26.0)
            - e2 * e2 * e2 / number(16.0)
            + number(3.0) * e3 * e3 / number(40.0)
            + number(3.0) * e2 * e4 / number(20.0)
            + number(45.0) * e2 * e2 * e3 / number(272.0)
            - number(9.0) * (e3 * e4 + e2 * e5) / number(68.0);
    number(3.0) * sum + scale * series / (a * a.sqrt())
}

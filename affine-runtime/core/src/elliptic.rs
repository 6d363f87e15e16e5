//! Carlson's elliptic integral `R_F`; Jacobi's functions, and the integral that inverts them.

use crate::scalar::Real;

/// Most halvings of the arithmetic-geometric mean: quadratic convergence needs fewer for any number format. Duplications likewise
/// halve the logarithms of proportions, and then bring arguments four times closer to each other.
const LEVELS: usize = 40;
/// Places for means. From the smallest `m1` that a double can be, twelve means agree in half of the digits of a double, and
/// thirteen in half of those of a double-double number. A place that stays free is filled in all the same.
const MEANS: usize = 16;

/// `sn(u|m)`, `cn(u|m)`, `dn(u|m)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Jacobi<T> {
    /// Sine amplitude.
    pub(crate) sn: T,
    /// Cosine amplitude.
    pub(crate) cn: T,
    /// Delta amplitude.
    pub(crate) dn: T,
}

/// The Jacobi functions of `u` for the complementary parameter `m1 = 1 - m` in `(0, 1]`, by the descending Gauss
/// transformation (R. Bulirsch, Numerische Mathematik 7, 78, 1965).
///
/// `m1` instead of `m`: near the separatrix `m = 1` it is `m1` that has digits.
pub(crate) fn jacobi<T: Real>(u: T, m1: T) -> Jacobi<T> {
    let half = T::from_f64(0.5);
    let enough = T::EPSILON.sqrt();
    let (mut a, mut b) = (T::one(), m1);
    let mut means = [(T::one(), T::one()); MEANS];
    let mut last = 0;
    let mut c = T::one();
    for (level, mean) in means.iter_mut().enumerate() {
        let root = b.sqrt();
        *mean = (a, root);
        last = level;
        c = half * (a + root);
        // Written so that NaN ends it as well.
        let apart = (a - root).abs() > enough * a;
        if !apart {
            break;
        }
        b = a * root;
        a = c;
    }
    let (sin, cos) = (u * c).sin_cos();
    if sin == T::zero() {
        return Jacobi { sn: sin, cn: cos, dn: T::one() };
    }
    let mut dn = T::one();
    let mut ratio = cos / sin;
    c *= ratio;
    for (mean, root) in means[..=last].iter().rev() {
        ratio *= c;
        c *= dn;
        dn = (*root + ratio) / (*mean + ratio);
        ratio = c / *mean;
    }
    let size = T::one() / c.hypot(T::one());
    let sn = if sin < T::zero() { -size } else { size };
    Jacobi { sn, cn: c * sn, dn }
}

/// The quarter period `K(m) = R_F(0, m1, 1)`, by the arithmetic-geometric mean.
pub(crate) fn quarter_period<T: Real>(m1: T) -> T {
    let half = T::from_f64(0.5);
    let (mut a, mut b) = (T::one(), m1.sqrt());
    for _ in 0..LEVELS {
        let apart = (a - b).abs() > T::EPSILON * a;
        if !apart {
            break;
        }
        (a, b) = (half * (a + b), (a * b).sqrt());
    }
    // pi/2 as a sum of two doubles.
    T::constant(core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17) / (half * (a + b))
}

/// The `u` in `[-K, K]` or `[K, 3 K]` with these `sn` and `cn`: `F = sn R_F(cn^2, dn^2, 1)` on the first sheet.
pub(crate) fn argument<T: Real>(sn: T, cn: T, m1: T) -> T {
    let squared = cn * cn;
    let dn_squared = m1 + (T::one() - m1) * squared;
    let first = sn * carlson_rf(squared, dn_squared, T::one());
    if cn < T::zero() { T::from_f64(2.0) * quarter_period(m1) - first } else { first }
}

/// `R_F(x, y, z) = 1/2 int_0^inf ((t + x)(t + y)(t + z))^(-1/2) dt`, symmetric, of arguments that are not negative and of which
/// at most one is zero; not a number elsewhere (NIST DLMF 19.16.1), by duplication and a series of order seven (B.
/// C. Carlson, Numerical Algorithms 10 (1995) 13; 19.36.1).
///
/// The energy of a homogeneous ellipsoid of mass `m` with half axes `a`, `b`, `c` in its own gravity is
/// `-(3/5) G m^2 R_F(a^2, b^2, c^2)` (S. Chandrasekhar, Ellipsoidal Figures of Equilibrium, 1969, chapter 3).
///
/// ```
/// use affine_runtime::elliptic::carlson_rf;
///
/// // Of a ball of radius 2, and of an ellipsoid with the axes 1, 2, 3.
/// assert_eq!(carlson_rf(4.0, 4.0, 4.0), 0.5);
/// assert!((carlson_rf(1.0_f64, 4.0, 9.0) - 0.508_644_618_570_030_2).abs() < 1e-15);
/// ```
#[must_use]
pub fn carlson_rf<T: Real>(x: T, y: T, z: T) -> T {
    let number = T::from_f64;
    let [a, u, v] = duplicated([x, y, z], |[x, y, z]| (x + y + z) / number(3.0), |_, _| {});
    let w = -(u + v);
    let (e2, e3) = (u * v - w * w, u * v * w);
    let low = T::one() - e2 / number(10.0) + e3 / number(14.0) + e2 * e2 / number(24.0);
    let threes = number(3.0) * e3 * (e3 / number(104.0) - e2 / number(44.0));
    (low + threes + e2 * e2 * (e3 / number(16.0) - number(5.0) * e2 / number(208.0))) / a.sqrt()
}

/// `x -> (x + lambda)/4` with `lambda = sqrt(xy) + sqrt(yz) + sqrt(zx)`, until the arguments are so close to their mean `a` that
/// series of order seven are exact to rounding: `a`, `1 - x/a` and `1 - y/a`. `each` is told `sqrt(z)` and `z + lambda`. No numbers
/// where two of them are zero: they stay so.
pub fn duplicated<T: Real>(mut x: [T; 3], mean: impl Fn([T; 3]) -> T, mut each: impl FnMut(T, T)) -> [T; 3] {
    let limit = (T::EPSILON * T::from_f64(0.25)).sqrt().sqrt().sqrt();
    let mut a = mean(x);
    for _ in 0..LEVELS {
        // Written so that NaN ends it as well.
        if !x.iter().any(|value| (a - *value).abs() > limit * a) {
            return [a, (a - x[0]) / a, (a - x[1]) / a];
        }
        let root = x.map(T::sqrt);
        let lambda = root[0] * root[1] + root[1] * root[2] + root[2] * root[0];
        each(root[2], x[2] + lambda);
        x = x.map(|value| (value + lambda) * T::from_f64(0.25));
        a = mean(x);
    }
    [T::from_f64(f64::NAN); 3]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values by mpmath at 40 digits: u, m, sn, cn, dn.
    const VALUES: [[f64; 5]; 6] = include!("elliptic_values.in");

    #[test]
    fn functions_have_their_values() {
        for [u, m, sn, cn, dn] in VALUES {
            let found = jacobi(u, 1.0 - m);
            for (ours, theirs) in [(found.sn, sn), (found.cn, cn), (found.dn, dn)] {
                assert!((ours - theirs).abs() < 4e-15 * (1.0 + u.abs()), "u = {u}, m = {m}: {ours} {theirs}");
            }
        }
    }

    #[test]
    fn argument_inverts_them() {
        for m1 in [1.0, 0.5, 1e-3, 1e-12, 1e-200, f64::from_bits(1)] {
            let k: f64 = quarter_period(m1);
            for fraction in [-0.9, -0.2, 0.0, 1e-9, 0.4, 0.95, 1.1, 1.9, 2.7] {
                let u = fraction * k;
                let Jacobi { sn, cn, dn } = jacobi(u, m1);
                assert!((sn * sn + cn * cn - 1.0).abs() < 4e-16 * 4.0);
                let back = argument(sn, cn, m1);
                // u is badly determined by sn and cn where du/dsn = 1/(cn dn) is large and cn is small.
                let digits = 1e-14 * (1.0 + k + 1.0 / dn);
                assert!((back - u).abs() < digits, "m1 = {m1}, u = {u}: {back}");
            }
        }
    }
}

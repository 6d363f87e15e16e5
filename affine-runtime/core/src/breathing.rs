//! The dilatational motion where it separates, in closed form.
//!
//! With `phi = e^q Psi`, `det Psi = 1`, an isotropic model whose potential splits into `U_dil(q)` and a part that no
//! dilatation changes has a motion of one degree of freedom beside that of `Psi` (Slawianowski et al., section 5):
//!
//! ```text
//! q' = p/m,   p' = -U_dil'(q),   m = n (I + A + n B)
//! ```

use crate::elliptic::{Jacobi, argument, jacobi, quarter_period};
use crate::scalar::{Real, Scalar};

/// A motion `q(t)` of one degree of freedom that is known in closed form.
#[derive(Clone, Copy, Debug)]
pub struct Breathing<T> {
    t0: T,
    inverse_mass: T,
    path: Path<T>,
}

impl<T: Scalar> Breathing<T> {
    /// No motion: what stands in lanes, whose bodies move along paths of different kinds that no equation reads.
    #[must_use]
    pub fn none() -> Self {
        Self { t0: T::zero(), inverse_mass: T::zero(), path: Path::Free { q: T::zero(), v: T::zero() } }
    }
}

#[derive(Clone, Copy, Debug)]
enum Path<T> {
    /// `q0 + v t`
    Free { q: T, v: T },
    /// `q0 cos(w t) + (v0/w) sin(w t)`
    Harmonic { q: T, v: T, w: T },
    /// `q0 cosh(w t) + (v0/w) sinh(w t)`
    Runaway { q: T, v: T, w: T },
    /// `sinh(scale q) = 1/sinh(start - rate (t - t0))`: towards the undeformed state, or from it.
    Separatrix { scale: T, start: T, rate: T },
    /// `sinh(scale q)` as an elliptic function of `start + rate (t - t0)`.
    Elliptic { scale: T, branch: Branch, size: T, rate: T, start: T, m1: T },
}

/// The solutions of `(y')^2 = (1 + y^2)(e - w0^2 y^2)` for `y = sinh`, by the signs of `w0^2` and `e`.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Branch {
    /// `w0^2 > 0`: `y = b cn`, bounded.
    Bounded,
    /// `w0^2 < 0 < e`: `y = b sc`, through the undeformed state.
    Passing,
    /// `w0^2 < 0`, `e < 0`: `y = b nc`, turned back.
    Repelled,
}

impl<T: Real> Breathing<T> {
    /// `U_dil = 0`: `q = q0 + (p0/m)(t - t0)`.
    pub fn free(t0: T, q: T, p: T, inverse_mass: T) -> Self {
        Self { t0, inverse_mass, path: Path::Free { q, v: p * inverse_mass } }
    }

    /// `U_dil' = stiffness q`.
    pub fn harmonic(t0: T, q: T, p: T, inverse_mass: T, stiffness: T) -> Self {
        let (squared, v) = (stiffness * inverse_mass, p * inverse_mass);
        let w = squared.abs().sqrt();
        let path = if squared > T::zero() {
            Path::Harmonic { q, v, w }
        } else if squared < T::zero() {
            Path::Runaway { q, v, w }
        } else {
            Path::Free { q, v }
        };
        Self { t0, inverse_mass, path }
    }

    /// `U_dil' = stiffness sinh(2 scale q)/(2 scale)`, so that `stiffness = U_dil''(0)`; for `scale = 1` this is
    /// `U_dil = stiffness/2 sinh(q)^2`.
    ///
    /// `y = sinh(scale q)` obeys `(y')^2 = (1 + y^2)(e - w0^2 y^2)` with `w0^2 = stiffness/m` and
    /// `e = (scale q0')^2 + w0^2 y0^2`, which Jacobi's functions solve.
    pub fn hyperbolic(t0: T, q: T, p: T, inverse_mass: T, stiffness: T, scale: T) -> Self {
        let squared = stiffness * inverse_mass;
        if squared == T::zero() {
            return Self::free(t0, q, p, inverse_mass);
        }
        let (y, v) = ((scale * q).sinh(), scale * p * inverse_mass);
        Self { t0, inverse_mass, path: elliptic(scale, squared, y, v) }
    }

    /// `q` and `p = m q'` at time `t`; NaN where the motion has left the range of numbers before.
    pub fn at(&self, t: T) -> (T, T) {
        let elapsed = t - self.t0;
        let (q, v) = match self.path {
            Path::Free { q, v } => (q + v * elapsed, v),
            Path::Harmonic { q, v, w } => {
                let (sin, cos) = (w * elapsed).sin_cos();
                (q * cos + v / w * sin, v * cos - w * q * sin)
            }
            Path::Runaway { q, v, w } => {
                let (sinh, cosh) = ((w * elapsed).sinh(), (w * elapsed).cosh());
                (q * cosh + v / w * sinh, v * cosh + w * q * sinh)
            }
            Path::Separatrix { scale, start, rate } => {
                let left = start - rate * elapsed;
                let ahead = (left > T::zero()) == (start > T::zero());
                let y = if ahead { T::one() / left.sinh() } else { T::from_f64(f64::NAN) };
                // y' = rate y sqrt(1 + y^2) for y > 0, and odd.
                let speed = if start < T::zero() { -rate } else { rate };
                (inverse_sinh(y) / scale, speed * y / scale)
            }
            Path::Elliptic { scale, branch, size, rate, start, m1 } => {
                let (y, v) = follow(branch, size, rate, start + rate * elapsed, m1);
                (inverse_sinh(y) / scale, v / scale)
            }
        };
        (q, v / self.inverse_mass)
    }
}

/// The elliptic path through `y = sinh(scale q)` with the velocity `v = scale q'`.
fn elliptic<T: Real>(scale: T, squared: T, y: T, v: T) -> Path<T> {
    let one = T::one();
    let w = squared.abs().sqrt();
    let energy = v * v + squared * y * y;
    if squared > T::zero() {
        let size = y.hypot(v / w);
        let m1 = one / (one + size * size);
        let at_rest = size == T::zero();
        let start = if at_rest { T::zero() } else { argument(-v / (w * size), y / size, m1) };
        let rate = w * (one + size * size).sqrt();
        return Path::Elliptic { scale, branch: Branch::Bounded, size, rate, start, m1 };
    }
    if energy == T::zero() {
        if y == T::zero() {
            return Path::Free { q: T::zero(), v: T::zero() };
        }
        let start = inverse_sinh(one / y);
        return Path::Separatrix { scale, start, rate: if v < T::zero() { -w } else { w } };
    }
    if energy > T::zero() {
        // y' = v at y = 0; the smaller of v and w over the larger is the complementary modulus.
        let a = energy.sqrt();
        let (rate, size, m1) =
            if a >= w { (a, one, squared.abs() / energy) } else { (w, a / w, energy / squared.abs()) };
        let (sn, cn) = (y / y.hypot(size), size / y.hypot(size));
        let start = argument(sn, cn, m1);
        let rate = if v < T::zero() { -rate } else { rate };
        return Path::Elliptic { scale, branch: Branch::Passing, size, rate, start, m1 };
    }
    let turning = (-energy).sqrt() / w;
    let m1 = turning * turning / (one + turning * turning);
    let size = if y < T::zero() { -turning } else { turning };
    let start = argument(v / (w * y), size / y, m1);
    let rate = w * (one + turning * turning).sqrt();
    Path::Elliptic { scale, branch: Branch::Repelled, size, rate, start, m1 }
}

/// `y` and the rate of its inverse hyperbolic sine at the argument `u`.
fn follow<T: Real>(branch: Branch, size: T, rate: T, u: T, m1: T) -> (T, T) {
    let one = T::one();
    match branch {
        Branch::Bounded => {
            let Jacobi { sn, cn, .. } = jacobi(u, m1);
            // rate/sqrt(1 + b^2) is w0.
            (size * cn, -size * (rate / (one + size * size).sqrt()) * sn)
        }
        Branch::Passing | Branch::Repelled => {
            if u.abs() >= quarter_period(m1) {
                let gone = T::from_f64(f64::NAN);
                return (gone, gone);
            }
            let Jacobi { sn, cn, dn } = jacobi(u, m1);
            let (y, numerator) = match branch {
                Branch::Passing => (size * sn / cn, size * rate * dn),
                _ => (size / cn, size * rate * sn * dn),
            };
            (y, numerator / (cn * cn * one.hypot(y)))
        }
    }
}

/// `arsinh(y)` without cancellation: `ln(1 + |y| + y^2/(1 + sqrt(1 + y^2)))` with the sign of `y`.
fn inverse_sinh<T: Real>(y: T) -> T {
    let size = y.abs();
    let value = (size + size * (size / (T::one() + size.hypot(T::one())))).ln_1p();
    if y < T::zero() { -value } else { value }
}

#[cfg(test)]
#[allow(clippy::expect_used)]
mod tests {
    use super::Breathing;
    use affine_integrators::RungeKutta8;
    use affine_runtime::model::{Group, Quantity};

    const T_END: f64 = 3.0;

    /// `(q, p)` at `T_END` by integration.
    fn integrated(q: f64, p: f64, inverse_mass: f64, slope: impl Fn(f64) -> f64) -> [f64; 2] {
        let rates = |_: f64, y: &[f64; 2]| [y[1] * inverse_mass, -slope(y[0])];
        const GROUPS: &[Group] =
            &[Group::new(Quantity::MeanLogStretch, 1), Group::new(Quantity::LinearMomentum, 1)];
        let mut run =
            RungeKutta8::new(rates, GROUPS, (0.0, [q, p]), T_END, 1e-13).expect("the start is finite");
        while !run.is_finished() {
            run.advance().expect("the motion is smooth");
        }
        *run.y()
    }

    fn agree(closed: (f64, f64), integrated: [f64; 2], case: &str) {
        let size = 1.0 + integrated[0].abs() + integrated[1].abs();
        for (ours, theirs) in [(closed.0, integrated[0]), (closed.1, integrated[1])] {
            // Local errors of 1e-13 over the steps of three units of time.
            assert!((ours - theirs).abs() < 2e-11 * size, "{case}: {ours} {theirs}");
        }
    }

    #[test]
    fn closed_forms_solve_their_equations() {
        for (q, p, inverse_mass, stiffness) in [
            (0.3, 0.2, 0.4, 10.0),
            (-0.2, 0.0, 0.5, 3.0),
            (0.0, -0.7, 2.0, 0.1),
            (2.0, 1.0, 1.0, 1.0),
            (0.1, 0.5, -0.4, -7.0),
            // Repelled or passing through the undeformed state.
            (0.2, 0.0, 0.5, -0.3),
            (-0.2, 0.01, 0.5, -0.3),
            (-0.1, 0.3, 0.5, -0.2),
            (0.1, 0.9, 0.6, -0.02),
            (0.3, -0.1, -0.3, 0.5),
            // w^2 = 1/4 and v = -y/2: on the separatrix for one of the scales.
            ((0.75_f64).asinh(), -0.375, 1.0, -0.25),
            ((-0.75_f64).asinh(), 0.375, 1.0, -0.25),
        ] {
            let case = format!("{q} {p} {inverse_mass} {stiffness}");
            for scale in [1.0, 0.5, 1.5] {
                let slope = |q: f64| stiffness * (2.0 * scale * q).sinh() / (2.0 * scale);
                let closed = Breathing::hyperbolic(0.0, q, p, inverse_mass, stiffness, scale).at(T_END);
                agree(closed, integrated(q, p, inverse_mass, slope), &case);
            }
            let closed = Breathing::harmonic(0.0, q, p, inverse_mass, stiffness).at(T_END);
            agree(closed, integrated(q, p, inverse_mass, |q| stiffness * q), &case);
            let closed = Breathing::free(0.0, q, p, inverse_mass).at(T_END);
            agree(closed, integrated(q, p, inverse_mass, |_| 0.0), &case);
        }
    }

    #[test]
    fn start_is_met() {
        for stiffness in [1e6_f64, 1.0, -1.0] {
            for (q, p) in
                [(0.0_f64, 0.0_f64), (1e-9, 0.0), (0.0, 1e-9), (0.4, -0.3), (-5.0, 2.0), (20.0, 0.0)]
            {
                let (found, momentum) = Breathing::hyperbolic(1.0, q, p, 0.5, stiffness, 1.0).at(1.0);
                assert!((found - q).abs() <= 8e-16 * (1.0 + q.abs()), "{stiffness} {q} {p}: {found}");
                // The momentum is sqrt(stiffness/inverse_mass) times an amplitude.
                let size = p.abs() + (2.0 * stiffness.abs()).sqrt() * q.abs().sinh();
                assert!((momentum - p).abs() <= 8e-15 * size, "{stiffness} {q} {p}: {momentum}");
            }
        }
    }

    #[test]
    fn energy_stays_over_many_periods() {
        let (q, p, inverse_mass, stiffness) = (0.3_f64, 0.1_f64, 1.0_f64 / 4.5, 1e6_f64);
        let motion = Breathing::hyperbolic(0.0, q, p, inverse_mass, stiffness, 1.0);
        let energy = |(q, p): (f64, f64)| 0.5 * inverse_mass * p * p + 0.5 * stiffness * q.sinh().powi(2);
        let start = energy((q, p));
        for k in 0..1000 {
            let found = energy(motion.at(f64::from(k)));
            assert!((found - start).abs() < 2e-14 * start);
        }
    }

    #[test]
    fn escape_in_finite_time_is_not_a_number() {
        let motion = Breathing::<f64>::hyperbolic(0.0, 0.5, 1.0, 1.0, -1.0, 1.0);
        assert!(motion.at(0.1).0.is_finite());
        assert!(motion.at(50.0).0.is_nan());
    }
}

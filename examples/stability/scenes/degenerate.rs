//! Nearly degenerate kinetic energies.

use affine_runtime::decompose::LinearMap;
use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};

use super::shared::{relative_distance, run, scene};

#[affine_model(dim = 2, kinetic(casimir2 = a, casimir1_squared = b, body_inertia = i))]
pub(crate) struct Disc {
    i: f64,
    a: f64,
    b: f64,
}

#[affine_model(dim = 3, kinetic(casimir2 = a, casimir1_squared = b, body_inertia = i))]
pub(crate) struct Body {
    i: f64,
    a: f64,
    b: f64,
}

#[affine_model(dim = 3, kinetic(casimir2 = a, casimir1_squared = b, space_inertia = i))]
pub(crate) struct Mirrored {
    i: f64,
    a: f64,
    b: f64,
}

const SIZES: [f64; 7] = [1e-3, 1e-6, 1e-9, 1e-12, 1e-13, 1e-14, 1e-15];

/// Which eigenvalue of the kinetic energy is small.
#[derive(Clone, Copy)]
enum Small {
    Turn,
    Shear,
    Dilatation,
}

impl Small {
    const ALL: [Self; 3] = [Self::Turn, Self::Shear, Self::Dilatation];

    fn name(self) -> &'static str {
        match self {
            Self::Turn => "I-A",
            Self::Shear => "I+A",
            Self::Dilatation => "I+A+nB",
        }
    }

    /// `I`, `A`, `B` with that eigenvalue `size`, up to rounding.
    fn coefficients(self, size: f64, n: f64) -> [f64; 3] {
        match self {
            Self::Turn => [1.0, 1.0 - size, 0.1],
            Self::Shear => [1.0, size - 1.0, 0.1],
            Self::Dilatation => [1.0, 0.2, (size - 1.2) / n],
        }
    }

    /// The skew part of the velocity, so that `skew/(I+A)` is of order 1.
    fn skew(self, size: f64) -> f64 {
        match self {
            Self::Shear => size,
            _ => 1.0,
        }
    }
}

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("nearly degenerate kinetic energy");
    for small in Small::ALL {
        for size in SIZES {
            let named = |model, n| {
                scene(model, n, format!("{} = {size:e}", small.name()), "phi, t = 1", Oracle::ClosedForm)
            };
            // Momenta are known to eps, velocities to eps times the condition of the energy.
            let rounding = f64::EPSILON * 2.0 / size;
            let demand = if size >= 1e-12 { Demand::Held(rounding) } else { Demand::HeldOrRefused(rounding) };

            let [i, a, b] = small.coefficients(size, 2.0);
            report.case(named("body-metric", 2), demand, || {
                let skew = Matrix::<2>::new(0.0, -0.4, 0.4, 0.0) * small.skew(size);
                let rate = Matrix::<2>::new(0.3, 0.2, 0.2, -0.1) + skew;
                let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
                let model = Disc { i, a, b }.prepare()?;
                let solution = run(&model, model.at_velocity(phi, phi * rate)?, 1.0)?;
                let exact = phi * martin_neff(&rate, (i - a) / (i + a), 1.0);
                Ok((relative_distance(solution.end().1.phi(), &exact), solution.statistics().steps))
            });

            let [i, a, b] = small.coefficients(size, 3.0);
            let skew = Matrix::<3>::new(0.0, -0.4, 0.1, 0.4, 0.0, 0.3, -0.1, -0.3, 0.0) * small.skew(size);
            let rate = Matrix::<3>::new(0.3, 0.2, 0.1, 0.2, -0.1, 0.25, 0.1, 0.25, 0.15) + skew;
            let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
            let w = (i - a) / (i + a);
            report.case(named("body-metric", 3), demand, || {
                let model = Body { i, a, b }.prepare()?;
                let solution = run(&model, model.at_velocity(phi, phi * rate)?, 1.0)?;
                let exact = phi * martin_neff(&rate, w, 1.0);
                Ok((relative_distance(solution.end().1.phi(), &exact), solution.statistics().steps))
            });
            report.case(named("space-metric", 3), demand, || {
                let model = Mirrored { i, a, b }.prepare()?;
                let solution = run(&model, model.at_velocity(phi, rate * phi)?, 1.0)?;
                let exact = martin_neff(&rate.transpose(), w, 1.0).transpose() * phi;
                Ok((relative_distance(solution.end().1.phi(), &exact), solution.statistics().steps))
            });
        }
    }
    conditions(report);
    Ok(())
}

/// The answer says what it is worth: the quotient of the eigenvalues, also where only its order is known.
fn conditions(report: &mut StabilityReport) {
    for small in Small::ALL {
        for size in SIZES {
            let [i, a, b] = small.coefficients(size, 3.0);
            let eigenvalues = [i - a, i + a, i + a + 3.0 * b].map(f64::abs);
            let (most, least) =
                eigenvalues.iter().fold((0.0_f64, f64::INFINITY), |(m, l), e| (m.max(*e), l.min(*e)));
            // The factors between velocity and momentum are known to eps, their quotient to eps times itself.
            let rounding = 8.0 * f64::EPSILON * most / least;
            let demand = if size >= 1e-12 { Demand::Held(rounding) } else { Demand::HeldOrRefused(rounding) };
            let named = scene(
                "body-metric",
                3,
                format!("{} = {size:e}", small.name()),
                "condition in the answer",
                Oracle::ClosedForm,
            );
            report.case(named, demand, || {
                let model = Body { i, a, b }.prepare()?;
                let start = model.at_momentum(Matrix::<3>::identity(), Comoving(Matrix::<3>::zeros()))?;
                let solution = run(&model, start, 1.0)?;
                let said = solution.computation().condition.unwrap_or(f64::NAN);
                // Where the answer is worth saying so, `why` says it.
                let words = solution.why().to_string().contains("condition number") == (said > 1e8);
                let error = if words { (said * least / most - 1.0).abs() } else { f64::NAN };
                Ok((error, solution.statistics().steps))
            });
        }
    }
}

/// `exp(t (sym M - w skew M)) exp(t (1 + w) skew M)` (Martin and Neff, arXiv:1409.7849), from the velocity alone.
fn martin_neff<const N: usize>(rate: &Matrix<N>, w: f64, t: f64) -> Matrix<N> {
    let (sym, skew) = ((rate + rate.transpose()) * 0.5, (rate - rate.transpose()) * 0.5);
    ((sym - skew * w) * t).exponential() * (skew * ((1.0 + w) * t)).skew_exponential()
}

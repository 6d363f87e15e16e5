//! The choice of a method.

use super::course::{Choice, Course};
use super::friction::{Fastest, is_stiff, rate_of_friction};
use super::layout::carries_dilatation;
use super::method::Method;
use super::range::by_halves;
use super::stiffness::{Trial, stiffness};
use crate::model::{Description, Model, StateVector};
use affine_core::system::Series;

/// [`Method::Automatic`] takes Taylor series from this tolerance down, where they were emitted. At it they take 0.70 to 0.93
/// of the time of Runge-Kutta steps on the benchmark problems, at ten times as much 0.78 to 1.07, and at equal errors they take
/// less on all of them from here on: `cargo run --release -p affine-comparison -- --methods`.
pub(super) const TAYLOR_TOLERANCE: f64 = 1e-11;
/// [`Method::Automatic`] takes the Nystrom method of order 12 from this tolerance down, and that of order 8 above. On P3
/// order 8 needs less time down to an error of 1e-4, where order 12 begins to, and at a given tolerance errs ten times
/// less.
pub(super) const NYSTROM_TOLERANCE: f64 = 1e-3;

/// The integrator to take, noted with what was missing for a better one.
pub(super) fn choose<const N: usize, M: Model<N>>(
    model: &M,
    course: &Course<'_, M::Point<f64>>,
    choice: &mut Choice,
) {
    let by_halves = by_halves::<N, M>(model, course);
    let Fastest { rate, evaluations } = match course.method {
        Method::Automatic => rate_of_friction::<N, M>(model, (course.t0, course.start)),
        _ => Fastest::default(),
    };
    choice.evaluations += evaluations;
    choice.friction = rate.filter(|rate| is_stiff(*rate, course.t_end - course.t0));
    let Trial { radians: stiffness, evaluations } = match course.method {
        Method::Automatic if by_halves => stiffness(model, M::splitting(model), course),
        _ => Trial::default(),
    };
    choice.evaluations += evaluations;
    choice.stiffness = stiffness;
    let Description { constraint, series, second_order, .. } = M::DESCRIPTION;
    let has_series = series && constraint.is_none() && course.tolerance <= TAYLOR_TOLERANCE;
    let is_emitted = has_series && M::taylor(model).is_some();
    choice.method = match course.method {
        Method::Automatic if choice.friction.is_some() => Method::Radau { stages: None },
        Method::Automatic if by_halves && M::second_order(model).is_some() => {
            match course.tolerance > NYSTROM_TOLERANCE {
                true => Method::RungeKuttaNystrom8,
                false => Method::RungeKuttaNystrom12,
            }
        }
        Method::Automatic if by_halves && stiffness.is_some() => Method::AdaptiveSplitting { order: None },
        Method::Automatic
            if is_emitted && begins_as_series(model, M::taylor(model), course, &mut choice.evaluations) =>
        {
            Method::Taylor { order: None }
        }
        Method::Automatic => Method::RungeKutta8,
        asked => asked,
    };
    choice.missing = match (course.method, choice.method) {
        (Method::Automatic, Method::RungeKutta8 | Method::Taylor { .. }) if by_halves && second_order => {
            Some("nystrom")
        }
        (Method::Automatic, Method::RungeKutta8) if has_series && !is_emitted => Some("taylor"),
        _ => None,
    };
    choice.needs_determinant =
        const { carries_dilatation(&M::DESCRIPTION) } && forms_determinant(choice.method);
}

/// The motion begins as a series, which its first two orders tell at the price of three evaluations: a root that vanishes there has
/// none, as `norm(x)` at x = 0, although a force that is a power of it has a value.
fn begins_as_series<const N: usize, M: Model<N>, R: Series<M::Reduced<f64>, M::Constants<f64>>>(
    model: &M,
    series: Option<R>,
    course: &Course<'_, M::Point<f64>>,
    evaluations: &mut u64,
) -> bool {
    let Some(series) = series else { return false };
    let (reduced, constants) = model.reduce(course.t0, course.start);
    let mut coefficients = [reduced, M::Reduced::zeros(), M::Reduced::zeros()];
    series.coefficients((course.t0, 1.0), &constants, &mut coefficients, &mut [R::Row::zeros(); 2]);
    *evaluations += 3;
    coefficients.iter().all(|coefficient| coefficient.as_ref().iter().all(|value| value.is_finite()))
}

/// Forces are computed from the placement alone, nothing being carried along.
fn forms_determinant(method: Method) -> bool {
    matches!(
        method,
        Method::RungeKuttaNystrom12
            | Method::RungeKuttaNystrom8
            | Method::Splitting { .. }
            | Method::AdaptiveSplitting { .. }
    )
}

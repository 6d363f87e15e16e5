//! Reference solutions where nobody has one: extrapolation in double-double arithmetic.

use qd::Quad;

use crate::error::{Error, Result};
use crate::inner::{larger, norm};
use crate::model::{Description, Model, StateVector};

/// Columns of the extrapolation table; the last is of order 20.
const COLUMNS: usize = 10;
/// Tolerated difference of the last two columns, relative to each geometric object: a hundred thousand steps of it stay
/// below the rounding of a double.
const TOLERANCE: f64 = 1e-22;
/// Steps, rejected ones included, after which a motion is given up.
const MOST_STEPS: usize = 100_000;

/// The phase point at `t_end` of the motion of `model` through `start` at time `t0`, to about the rounding of a double.
///
/// Shares nothing with the methods that it is to judge but Hamilton's equations: it integrates those of the full phase
/// point ([`Model::hamilton_equations`]), not the reduced ones, by Gragg's modified midpoint rule with Richardson
/// extrapolation of order 20 (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.9), not by a
/// Runge-Kutta or Taylor method, and in double-double arithmetic. A step costs 110 evaluations of some thirty times
/// the price: a second for a thousand oscillations.
///
/// What is left is the rounding of `start` to the components of the plain array, which where `metrics(...)` changes the
/// basis is one of a double; and in a model with fields that of its coefficients, which are doubles then. Stiff motions
/// amplify that, to 1e-12 for the stiff shear P8 of the example `work_precision`: write numbers instead of fields where it
/// matters.
///
/// # Errors
/// [`Error::NoReference`] for a motion that ends on the way, or needs more than 100000 steps, and for times that are not
/// finite.
pub fn reference_solution<const N: usize, M: Model<N>>(
    model: &M,
    start: &M::Point<f64>,
    (t0, t_end): (f64, f64),
) -> Result<M::Point<f64>> {
    if !(t_end - t0).is_finite() {
        return Err(Error::NoReference { model: M::DESCRIPTION.name });
    }
    let mut y = doubled::<N, M>(&model.flatten(start));
    let slope = |t: Quad, y: &M::Full<Quad>| model.hamilton_equations(t, y);
    let mut t = Quad::from(t0);
    let mut length = first_length(&y, &slope(t, &y));
    let shortest = f64::EPSILON * (t_end - t0).abs();
    for _ in 0..MOST_STEPS {
        let rest = (Quad::from(t_end) - t).0;
        let last = length >= rest.abs();
        let h = if last { rest } else { length.copysign(rest) };
        let (end, error) = step(&slope, &M::DESCRIPTION, (t, &y), h);
        if error <= TOLERANCE {
            (t, y) = (t + Quad::from(h), end);
            if last {
                return Ok(model.unflatten(&rounded::<N, M>(&y)));
            }
        }
        // The difference of the last two columns is of order 19 in the step.
        let factor = 0.9 * (TOLERANCE / error).powf(1.0 / 19.0);
        length = h.abs() * if factor.is_nan() { 0.2 } else { factor.clamp(0.2, 3.0) };
        if length < shortest {
            break;
        }
    }
    Err(Error::NoReference { model: M::DESCRIPTION.name })
}

/// A tenth of the time in which the state changes by its own size.
fn first_length<S: StateVector<Quad>>(y: &S, slope: &S) -> f64 {
    0.1 * size(y.as_ref()) / size(slope.as_ref())
}

/// The extrapolated end of a step, and the relative difference of the last two columns.
fn step<S: StateVector<Quad>>(
    slope: &impl Fn(Quad, &S) -> S,
    description: &Description,
    start: (Quad, &S),
    h: f64,
) -> (S, f64) {
    let first = slope(start.0, start.1);
    let mut row = [*start.1; COLUMNS];
    for j in 0..COLUMNS {
        let mut column = midpoint(slope, start, &first, h, 2 * (j + 1));
        for k in 0..j {
            // Aitken and Neville: step numbers 2, 4, 6, ... leave the squares of (j + 1)/(j - k).
            let ratio = Quad::from((j + 1) as f64) / Quad::from((j - k) as f64);
            let weight = Quad::ONE / (ratio * ratio - Quad::ONE);
            let coarser = core::mem::replace(&mut row[k], column);
            for (finer, coarser) in column.as_mut().iter_mut().zip(coarser.as_ref()) {
                *finer += (*finer - *coarser) * weight;
            }
        }
        row[j] = column;
    }
    let [.., before, last] = &row;
    let mut offset = 0;
    let mut error: f64 = 0.0;
    for group in description.full {
        let range = offset..offset + group.len;
        offset = range.end;
        let difference: Vec<f64> = before.as_ref()[range.clone()]
            .iter()
            .zip(&last.as_ref()[range.clone()])
            .map(|(a, b)| (*a - *b).0)
            .collect();
        let of_group = norm(&difference);
        // 0/0 is a group that stays zero.
        let relative = if of_group == 0.0 { 0.0 } else { of_group / size(&last.as_ref()[range]) };
        error = larger(error, relative);
    }
    (*last, error)
}

/// Gragg's modified midpoint rule with an even number of substeps: the error is a series in the square of the substep.
fn midpoint<S: StateVector<Quad>>(
    slope: &impl Fn(Quad, &S) -> S,
    (t, y): (Quad, &S),
    first: &S,
    h: f64,
    substeps: usize,
) -> S {
    let substep = Quad::from(h) / Quad::from(substeps as f64);
    let (mut before, mut now) = (*y, moved(y, first, substep));
    for k in 1..substeps {
        let rate = slope(t + substep * Quad::from(k as f64), &now);
        (before, now) = (now, moved(&before, &rate, substep + substep));
    }
    now
}

fn moved<S: StateVector<Quad>>(y: &S, rate: &S, by: Quad) -> S {
    let mut moved = *y;
    for (y, rate) in moved.as_mut().iter_mut().zip(rate.as_ref()) {
        *y += *rate * by;
    }
    moved
}

fn size(components: &[Quad]) -> f64 {
    norm(&components.iter().map(|component| component.0).collect::<Vec<_>>())
}

fn doubled<const N: usize, M: Model<N>>(full: &M::Full<f64>) -> M::Full<Quad> {
    let mut doubled = M::Full::<Quad>::zeros();
    for (doubled, value) in doubled.as_mut().iter_mut().zip(full.as_ref()) {
        *doubled = Quad::from(*value);
    }
    doubled
}

fn rounded<const N: usize, M: Model<N>>(full: &M::Full<Quad>) -> M::Full<f64> {
    let mut rounded = M::Full::<f64>::zeros();
    for (rounded, value) in rounded.as_mut().iter_mut().zip(full.as_ref()) {
        *rounded = value.0;
    }
    rounded
}

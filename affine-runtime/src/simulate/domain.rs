//! Whether a motion stays where its potential has a value, and its steps see what the time does to it.

use core::f64::consts::TAU;

use super::collapse::first_failure;
use super::mechanics::Mechanics;
use super::motion::Motion;
use crate::error::Reason;
use crate::inner::norm;
use crate::integrate::Failure;
use crate::model::{Bound, Description, Guard};
use crate::state::Phase;

/// Part of the way that a state goes by its own size, by which the rates of the functions are found as differences: half of
/// the digits are left.
const SHORT_WAY: f64 = 1e-6;
/// A function that comes nearer to zero within a step than this part of what it is at the ends is looked at in between.
const NEAR: f64 = 0.5;
/// Parts of such a step.
const PARTS: u32 = 8;
/// A step that fails where a function reaches zero within this part of the time since the start has run into that zero.
const AT_HAND: f64 = 1e-6;

/// The functions that keep their sign, where a step ends.
pub(super) struct Domain {
    guards: &'static [Guard],
    t: f64,
    values: Vec<f64>,
    rates: Vec<f64>,
}

impl Domain {
    /// The functions at a point; nothing where the potential has a value everywhere.
    ///
    /// # Errors
    /// [`Reason::Domain`] for a point at which it has none.
    pub(super) fn at<const N: usize, P: Phase<N>>(
        model: &dyn Mechanics<N, P>,
        (t, point): (f64, &P),
    ) -> Result<Option<Self>, Reason> {
        let guards = model.description().domain;
        if guards.is_empty() {
            return Ok(None);
        }
        let values = values(model, (t, point));
        for (guard, value) in guards.iter().zip(&values) {
            if !admits(guard, *value, *value) {
                return Err(left(guard, *value, t));
            }
        }
        let rates = rates(model, (t, point), &values);
        Ok(Some(Self { guards, t, values, rates }))
    }

    /// Holds the step to where a motion has come against the signs at its beginning, and goes there.
    ///
    /// # Errors
    /// [`Reason::Domain`] with the time at which the first function loses its sign, to the rounding of times on the dense output
    /// of the step.
    pub(super) fn keep<const N: usize, P: Phase<N>>(
        &mut self,
        model: &dyn Mechanics<N, P>,
        motion: &mut dyn Motion<P>,
        reason: &dyn Fn(Failure) -> Reason,
    ) -> Result<(), Reason> {
        let (t, (point, _)) = (motion.t(), motion.reached());
        let values = values(model, (t, &point));
        let rates = rates(model, (t, &point), &values);
        let holds = |values: &[f64]| {
            let signs = self.guards.iter().zip(&self.values).zip(values);
            signs.into_iter().position(|((guard, before), now)| !admits(guard, *now, *before))
        };
        let length = t - self.t;
        let comes_near = (0..self.guards.len()).any(|k| {
            let ends = [(self.values[k], self.rates[k] * length), (values[k], rates[k] * length)];
            lowest(ends) < NEAR * values[k].abs().min(self.values[k].abs())
        });
        let parts = if comes_near { PARTS } else { 1 };
        let mut good = self.t;
        for part in 1..=parts {
            let sample =
                if part == parts { t } else { self.t + length * (f64::from(part) / f64::from(parts)) };
            let mut at = |sample: f64| match sample == t {
                true => Ok(values.clone()),
                false => motion.between(sample).map(|(point, _)| self::values(model, (sample, &point))),
            };
            if holds(&at(sample).map_err(reason)?).is_some() {
                let edge =
                    first_failure(good, sample, |t| at(t).is_ok_and(|values| holds(&values).is_none()));
                let there = at(edge).map_err(reason)?;
                let lost = holds(&there).unwrap_or(0);
                return Err(left(&self.guards[lost], there[lost], edge));
            }
            good = sample;
        }
        (self.t, self.values, self.rates) = (t, values, rates);
        Ok(())
    }

    /// Why no step leads on from where the last one ended, if that is because a function is about to vanish.
    pub(super) fn failing(&self, since: f64) -> Option<Reason> {
        let at_hand = AT_HAND * (self.t - since).abs();
        let lost = (0..self.guards.len()).find(|k| {
            let (value, rate) = (self.values[*k], self.rates[*k] * (self.t - since).signum());
            rate * value < 0.0 && (value / rate).abs() <= at_hand
        })?;
        Some(left(&self.guards[lost], self.values[lost], self.t))
    }
}

/// The potential has a value at a point, as far as functions of the user's are part of it.
///
/// # Errors
/// [`Reason::Energy`] where it has none.
pub(super) fn has_value<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    (t, point): (f64, &P),
) -> Result<(), Reason> {
    if !model.description().custom_potential {
        return Ok(());
    }
    let energy = model.hamiltonian(t, point);
    if energy.is_finite() { Ok(()) } else { Err(Reason::Energy { energy, t }) }
}

/// May a function have a value, with one that it had before?
fn admits(guard: &Guard, value: f64, before: f64) -> bool {
    match guard.bound {
        Bound::Positive => value > 0.0,
        Bound::NotNegative => value >= 0.0,
        Bound::NotZero => value != 0.0 && value.signum() == before.signum(),
    }
}

fn left(guard: &Guard, value: f64, t: f64) -> Reason {
    Reason::Domain { guard: *guard, value, t }
}

/// The largest part of a turn that an angle of the potential makes by the time alone, with that part of the potential.
pub(super) fn turns<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    point: &P,
    (begin, end): (f64, f64),
) -> Option<(&'static str, f64)> {
    let Description { domain, angles, .. } = model.description();
    if angles.is_empty() {
        return None;
    }
    let [before, after] = [begin, end].map(|t| values(model, (t, point)));
    let angles = angles.iter().zip(after.iter().zip(&before).skip(domain.len()));
    let turned = angles.map(|(part, (after, before))| (*part, (after - before).abs() / TAU));
    turned.reduce(|most, next| if next.1 > most.1 { next } else { most })
}

fn values<const N: usize, P: Phase<N>>(model: &dyn Mechanics<N, P>, (t, point): (f64, &P)) -> Vec<f64> {
    let mut values = Vec::with_capacity(model.description().domain.len() + model.description().angles.len());
    model.domain(t, point, &mut |value| values.push(value));
    values
}

/// Their rates along the motion, as differences.
fn rates<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    (t, point): (f64, &P),
    values: &[f64],
) -> Vec<f64> {
    let velocity = model.velocity(point);
    let own = |way: f64, speed: f64| if speed > 0.0 { way / speed } else { f64::INFINITY };
    let placed = norm(point.phi().as_slice());
    let deforming = own(placed, norm(velocity.phi_dot.as_slice()));
    let moving = own(placed + norm(point.x().as_slice()), norm(velocity.x_dot.as_slice()));
    let whole = deforming.min(moving);
    let dt = SHORT_WAY * if whole.is_finite() { whole } else { 1.0 };
    let moved =
        point.moved(point.x() + velocity.x_dot * dt, point.phi() + velocity.phi_dot * dt, |spin| *spin);
    let later = self::values(model, (t + dt, &moved));
    later.iter().zip(values).map(|(later, now)| (later - now) / dt).collect()
}

/// The lowest of some values, relative to the sign at the ends, of the cubic polynomial with given values and rates there.
fn lowest([(a, from), (b, to)]: [(f64, f64); 2]) -> f64 {
    let sign = a.signum();
    let value = |s: f64| {
        let rest = 1.0 - s;
        a * (1.0 + 2.0 * s) * rest * rest + from * s * rest * rest + b * (3.0 - 2.0 * s) * s * s
            - to * rest * s * s
    };
    (1..8).map(|k| sign * value(f64::from(k) / 8.0)).fold(sign * b, f64::min)
}

#[cfg(test)]
mod tests {
    use super::lowest;

    /// `(s - 1/2)^2 - 1/50` is lowest in the middle, and has that sign at neither end.
    #[test]
    fn a_dip_between_two_ends() {
        let dip = [(0.23, -1.0), (0.23, 1.0)];
        assert!((lowest(dip) + 0.02).abs() < 1e-15, "{}", lowest(dip));
        let mirrored = dip.map(|(value, rate)| (-value, -rate));
        assert!((lowest(mirrored) + 0.02).abs() < 1e-15);
        assert!((lowest([(1.0, 0.5), (1.5, 0.5)]) - 1.0625).abs() < 1e-15, "a straight line");
    }
}

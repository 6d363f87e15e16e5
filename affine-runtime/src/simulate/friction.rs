//! How fast friction takes velocities away.

use super::layout::{Layout, has_work};
use super::method::Method;
use crate::error::Reason;
use crate::inner::larger;
use crate::model::{Model, Quantity};
use crate::state::Phase;

/// [`Method::Automatic`](super::Method::Automatic) takes the Radau method where velocities die out so many times, by powers of e, from the start to the
/// end: steps of order 8 are at most 6.4 of these times long, and on problems of viscous bodies 250 of them take as many
/// operations as the few implicit steps that do not see the friction. Friction that grows on the way is looked at again after 512
/// explicit steps, 1024 and so on, for what is left of the run.
pub(super) const STIFF_FRICTION: f64 = 1600.0;

/// How often velocities may die out, by powers of e, within a step by splitting of an order above 2. Such an order flows some of its
/// pieces backward in time, as all do (Q. Sheng, IMA J. Numer. Anal. 9 (1989) 199-212; M. Suzuki, J. Math. Phys. 32 (1991) 400-407;
/// D. Goldman, T. Kaper, SIAM J. Numer. Anal. 33 (1996) 349-367): there friction gives back what it has taken, by a factor that grows
/// exponentially. Up to here they err less than order 2, which goes forward alone, and from some 12 on, of order 8 from 8, more
/// (`cargo test --test friction orders`).
const WITHIN_A_STEP: f64 = 10.0;
/// The same of order 8, which goes back further.
const WITHIN_A_STEP_OF_8: f64 = 6.0;

/// Components of all momenta of a body: `n^2 + n`.
const MOMENTA: usize = 12;
/// Squarings of a matrix, after which the size of the power is that of the largest eigenvalue, within
/// `12^(1/64)`, four percent.
const SQUARINGS: i32 = 6;

/// Where the momentum that the forces of a body give it is larger than the one whose kinetic energy is 1 by more than that, friction
/// is read off at the former: up to there rounding of their power passes for friction that takes less than a billionth of the
/// motion in the time in which they move the body by its own size.
const FAR: f64 = 1e6;

type Form = nalgebra::SMatrix<f64, MOMENTA, MOMENTA>;

/// What the equations say at a momentum.
#[derive(Clone, Copy, Debug, Default)]
struct Reading {
    /// The kinetic energy.
    energy: f64,
    /// The power of the forces.
    power: f64,
    /// How fast the placement moves, over its size.
    speed: f64,
}

/// The fastest rate at which friction takes velocities away, `1/time`, and the evaluations that it took to see.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Fastest {
    pub(super) rate: Option<f64>,
    pub(super) evaluations: u64,
}

/// The fastest rate at which the friction of a model takes velocities away at a start: the largest eigenvalue of
/// `M^-1 R`, with `T = 1/2 v^T M v` the kinetic energy and `1/2 v^T R v` the dissipation function. `None` where there is no
/// such force, or no momentum that it acts on.
///
/// Both forms are read off the energies, at momenta along the axes and between two of them. An oscillation, however fast, is
/// in neither. Forces that are no friction cancel there to the rounding of their power, which is linear in momenta: beside it
/// friction is seen at momenta as large as these forces give the body.
pub(super) fn rate_of_friction<const N: usize, M: Model<N>>(
    model: &M,
    (t0, start): (f64, &M::Point<f64>),
) -> Fastest {
    if const { !has_work(&M::DESCRIPTION) } {
        return Fastest::default();
    }
    let asked = core::cell::Cell::new(0);
    let rate = fastest(model, (t0, start), &asked).filter(|rate| rate.is_finite());
    Fastest { rate, evaluations: asked.get() }
}

fn fastest<const N: usize, M: Model<N>>(
    model: &M,
    (t0, start): (f64, &M::Point<f64>),
    asked: &core::cell::Cell<u64>,
) -> Option<f64> {
    let (reduced, constants) = model.reduce(t0, start);
    let work = const { Layout::of(M::DESCRIPTION.reduced, N) }.work?;
    let (mut places, mut from) = ([0; MOMENTA], 0);
    let mut count = 0;
    for group in M::DESCRIPTION.reduced {
        let end = from + group.len;
        if is_momentum(group.quantity) && count + group.len <= MOMENTA {
            places[count..count + group.len].iter_mut().zip(from..end).for_each(|(place, k)| *place = k);
            count += group.len;
        }
        from = end;
    }
    let places = places.get(..count).filter(|places| !places.is_empty())?;
    // At momenta `a e_i + b e_j`, and none else.
    let at = |steps: [(usize, f64); 2]| {
        let mut state = reduced;
        places.iter().for_each(|place| state.as_mut()[*place] = 0.0);
        steps.iter().for_each(|(i, step)| state.as_mut()[places[*i]] += step);
        let state = model.renewed(&state);
        asked.set(asked.get() + 1);
        let rates = model.reduced_equations(t0, &constants, &state);
        // Of the momenta alone: beside a large potential it would be lost.
        let point = model.expand(t0, &constants, &state);
        let velocity = model.velocity(&point);
        let internal = point.pi().0.0.transpose().dot(&velocity.phi_dot);
        let size = point.phi().norm();
        let speed = velocity.phi_dot.norm() / size + velocity.x_dot.norm() / (size + point.x().norm());
        let energy = 0.5 * (internal + point.p().dot(&velocity.x_dot));
        Reading { energy, power: rates.as_ref()[work], speed }
    };
    let unit = unit(at([(0, 1.0), (0, 0.0)]).energy);
    let (mut forms, natural) = forms(&at, count, unit);
    if natural > FAR && natural.is_finite() {
        forms = self::forms(&at, count, unit * natural).0;
    }
    let [inertia, friction] = forms;
    Some(spectral_radius(inertia.lu().solve(&friction)?))
}

/// The forms of the kinetic energy and of friction over so many momenta, in multiples of a unit; and the largest momentum that forces
/// which are no friction give the body while it moves by its own size, in that unit.
fn forms(at: &dyn Fn([(usize, f64); 2]) -> Reading, count: usize, unit: f64) -> ([Form; 2], f64) {
    let (mut inertia, mut friction) = (Form::identity(), Form::zeros());
    let (rest, mut natural) = (at([(0, 0.0); 2]), 0.0);
    let mut before = [Reading::default(); MOMENTA];
    for i in 0..count {
        let (ahead, behind) = (at([(i, unit), (0, 0.0)]), at([(i, -unit), (0, 0.0)]));
        inertia[(i, i)] = ahead.energy + behind.energy - 2.0 * rest.energy;
        friction[(i, i)] = rest.power - 0.5 * (ahead.power + behind.power);
        // There the energy is the work of the forces, power over speed, along the size of the body.
        let push = 0.5 * (ahead.power - behind.power).abs();
        if push > 0.0 {
            natural = larger(natural, libm::sqrt(push / (ahead.speed * ahead.energy.abs())));
        }
        for (j, other) in before.iter().enumerate().take(i) {
            let both = at([(i, unit), (j, unit)]);
            let mixed_energy = both.energy - ahead.energy - other.energy + rest.energy;
            let mixed_power = -0.5 * (both.power - ahead.power - other.power + rest.power);
            (inertia[(i, j)], inertia[(j, i)]) = (mixed_energy, mixed_energy);
            (friction[(i, j)], friction[(j, i)]) = (mixed_power, mixed_power);
        }
        before[i] = ahead;
    }
    ([inertia, friction], natural)
}

/// A momentum whose kinetic energy is about 1, by that of the momentum 1, in whatever units.
fn unit(energy: f64) -> f64 {
    let unit = libm::sqrt(1.0 / energy.abs());
    if unit.is_finite() && unit > 0.0 { unit } else { 1.0 }
}

/// `|A^k|^(1/k)`, `k` a power of two.
fn spectral_radius(matrix: Form) -> f64 {
    let (mut power, mut logarithm) = (matrix, 0.0);
    for squaring in 0..=SQUARINGS {
        let size = power.norm();
        if size == 0.0 || !size.is_finite() {
            return size;
        }
        logarithm += libm::log(size) / f64::from(1 << squaring);
        power /= size;
        power = power * power;
    }
    libm::exp(logarithm)
}

fn is_momentum(quantity: Quantity) -> bool {
    matches!(
        quantity,
        Quantity::LinearMomentum
            | Quantity::ComovingLinearMomentum
            | Quantity::CanonicalMomentum
            | Quantity::AffineSpin
            | Quantity::ComovingAffineSpin
    )
}

/// Velocities die out so often within a time that the Radau method is taken. Backward in time they grow, and no method may
/// pass over that.
pub(super) fn is_stiff(rate: f64, time: f64) -> bool {
    rate * time > STIFF_FRICTION
}

/// Refuses friction that takes velocities away at a rate that a method does not follow on its way forward in time; the rate is
/// asked for where it matters.
///
/// # Errors
/// [`Reason::Friction`].
pub(super) fn is_followed(method: Method, rate: impl FnOnce() -> Option<f64>) -> Result<(), Reason> {
    let (order, step, most) = match method {
        Method::Splitting { order: order @ (4 | 6), step } => (order, step, WITHIN_A_STEP),
        Method::Splitting { order: order @ 8, step } => (order, step, WITHIN_A_STEP_OF_8),
        _ => return Ok(()),
    };
    match rate() {
        Some(rate) if rate * step > most => Err(Reason::Friction { order, rate, longest: most / rate }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_grow_by_the_largest_eigenvalue() {
        let mut matrix = Form::zeros();
        (matrix[(0, 0)], matrix[(0, 1)], matrix[(1, 1)]) = (3.0, 1.0, 2.0);
        assert!((spectral_radius(matrix) / 3.0 - 1.0).abs() < 0.04);
        assert_eq!(spectral_radius(Form::zeros()), 0.0);
        matrix[(0, 0)] = f64::NAN;
        assert!(spectral_radius(matrix).is_nan());
    }
}

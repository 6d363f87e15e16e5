//! Between which places a potential of the dilatation alone keeps it.
//!
//! `p^2/(2m) + U(q)` is conserved, `1/m = (1/alpha + n/beta)/n`, so that the motion stays where the margin
//! `p0^2/(2m) + U(q0) - U(q)` is not negative, and turns where it vanishes. The search goes outwards from where the motion is, in
//! steps over each of which the margin and its slope are enclosed by intervals: a step counts where the margin is positive all
//! over it, or falls all over it and is negative at its end. Otherwise it is halved. So no pole and no barrier is stepped over.

use super::interval::Interval;
use super::{Isotropic, TwoPolarForm};
use crate::dual::Dual;
use crate::model::StateVector;
use crate::scalar::Real;

/// How far turning points of the dilatation are looked for: beyond it `det phi` leaves the range of doubles.
const FARTHEST: f64 = 230.0;
/// The longest step: intervals are wider than what they enclose by its square.
const LONGEST: f64 = 1.0;
/// Steps on one side, at most: a hundred times those over a smooth potential.
const MOST_STEPS: u32 = 1 << 15;

/// What becomes of the dilatation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dilatation {
    /// No dilatational momentum, and no force of a potential: the volume is constant.
    Still,
    /// No potential, or a constant one: `q = q0 + rate t`.
    Uniform {
        /// `p_dil/(n(I + A + nB))`.
        rate: f64,
    },
    /// The potential confines it: `q` moves between two turning points.
    Confined {
        /// The lower one.
        from: f64,
        /// The upper one.
        to: f64,
    },
    /// No turning point on one side at least, for `|q|` up to 230.
    Free,
}

/// What is found on one side.
#[derive(Clone, Copy)]
enum Side {
    Turns(f64),
    Open,
    /// The potential ends, or rounding decides.
    Undecided,
}

/// The margin and its derivatives outwards.
#[derive(Clone, Copy)]
struct Margin {
    value: Interval,
    slope: Interval,
    curvature: Interval,
}

/// The motion of the dilatation.
struct Motion<'a, const N: usize, M> {
    model: &'a M,
    /// 1 with the sign of the mass.
    sign: Interval,
    kinetic: Interval,
    /// At the start.
    potential: Interval,
}

/// What becomes of the dilatation; `None` where the motion comes to the end of the domain of the potential, or rounding decides.
pub(super) fn confinement<const N: usize, M: TwoPolarForm<N>>(
    model: &M,
    (q, p_dil): (f64, f64),
    isotropic: &Isotropic,
) -> Option<Dilatation> {
    let inverse_mass = isotropic.inverse_alpha / N as f64 + isotropic.inverse_beta;
    let kinetic = 0.5 * p_dil * p_dil * inverse_mass.abs();
    // A motion that is too slow for its square moves all the same.
    let kinetic = if p_dil == 0.0 { 0.0 } else { kinetic.max(f64::MIN_POSITIVE) };
    let [potential, ..] = derivatives::<N, M>(model, Interval::point(q));
    if !(potential.is_finite() && kinetic.is_finite()) {
        return None;
    }
    let sign = Interval::point(1.0_f64.copysign(inverse_mass));
    let motion = Motion { model, sign, kinetic: Interval::point(kinetic), potential };
    let start = motion.margin(Interval::point(q), 1.0);
    if kinetic == 0.0 && start.slope.contains(0.0) {
        return (start.curvature.hi <= 0.0).then_some(Dilatation::Still);
    }
    let [(lower, flat_below), (upper, flat_above)] = [-1.0, 1.0].map(|way| motion.side(q, way));
    match (lower, upper) {
        _ if flat_below && flat_above => Some(Dilatation::Uniform { rate: p_dil * inverse_mass }),
        (Side::Turns(from), Side::Turns(to)) => Some(Dilatation::Confined { from, to }),
        (Side::Open, _) | (_, Side::Open) => Some(Dilatation::Free),
        _ => None,
    }
}

impl<const N: usize, M: TwoPolarForm<N>> Motion<'_, N, M> {
    /// The margin over an interval, its derivatives upwards for the way 1 and downwards for -1.
    fn margin(&self, q: Interval, way: f64) -> Margin {
        let [potential, slope, curvature] = derivatives::<N, M>(self.model, q);
        Margin {
            value: self.kinetic - self.sign * (potential - self.potential),
            slope: -self.sign * Interval::point(way) * slope,
            curvature: -self.sign * curvature,
        }
    }

    /// What is found in one way, and whether the potential is constant up to there.
    fn side(&self, mut q: f64, way: f64) -> (Side, bool) {
        let (mut here, mut step, mut flat) = (self.kinetic, LONGEST, true);
        for _ in 0..MOST_STEPS {
            if way * q >= FARTHEST {
                return (Side::Open, flat);
            }
            let next = q + way * step;
            if next == q {
                break;
            }
            let length = (next - q).abs();
            let over = self.margin(Interval::between(q, next), way);
            // By the mean value theorem, from where the step begins.
            let at = |way: Interval| here + over.slope * way;
            let least = over.value.and(at(Interval::between(0.0, length))).lo;
            let there = self.margin(Interval::point(next), way).value.and(at(Interval::point(length)));
            if least > 0.0 || over.slope.lo > 0.0 {
                flat &= over.slope == Interval::point(0.0);
                (q, here) = (next, there);
                step = if step < 0.5 * LONGEST { 2.0 * step } else { LONGEST };
            } else if over.slope.hi < 0.0 && there.hi < 0.0 {
                return (Side::Turns(self.turning(q, next, way)), false);
            } else {
                step *= 0.5;
            }
        }
        (Side::Undecided, false)
    }

    /// The turning point between two places, between which the margin falls from what is not negative to what is.
    fn turning(&self, mut inside: f64, mut outside: f64, way: f64) -> f64 {
        loop {
            let middle = 0.5 * (inside + outside);
            if middle == inside || middle == outside {
                return inside;
            }
            let within = self.margin(Interval::point(middle), way).value.to_f64() >= 0.0;
            *(if within { &mut inside } else { &mut outside }) = middle;
        }
    }
}

/// `U` over an interval, and its first two derivatives.
fn derivatives<const N: usize, M: TwoPolarForm<N>>(model: &M, q: Interval) -> [Interval; 3] {
    let mut places = M::Places::<Dual<Dual<Interval>>>::zeros();
    // Stretches apart and at rest: the energy is the potential's.
    let apart = (0..N).map(|a| Interval::point(0.5 * (N as f64 - 1.0) - a as f64));
    for (place, apart) in places.as_mut().iter_mut().zip(apart) {
        let one = Interval::point(1.0);
        *place = Dual { value: Dual { value: q + apart, slope: one }, slope: Dual::fixed(one) };
    }
    let energy = model.lattice_hamiltonian(&M::Couplings::zeros(), &places);
    [energy.value.value, energy.value.slope, energy.slope.slope]
}

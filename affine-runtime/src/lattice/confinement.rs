//! Between which places a potential of the dilatation alone keeps it.
//!
//! `p^2/(2m) + U(q)` is conserved, `1/m = (1/alpha + n/beta)/n`, so that the motion stays where the margin
//! `p0^2/(2m) + U(q0) - U(q)` is not negative, and turns where it vanishes. The search goes outwards from where the motion is. A
//! step counts where the margin and its first two derivatives at one end, held against what is found at the other, say that it
//! vanishes nowhere between; otherwise it is halved. So no pole is stepped over that shows in the digits of the potential, and none
//! at all where the potential says that it ends.

use super::{Dilatation, Isotropic, Lattice, TwoPolarForm};
use crate::dual::Dual;
use crate::frames::{Matrix, Vector};
use crate::model::StateVector;

/// What is zero to rounding, in units of `eps` times the sizes it is made of.
pub(super) const ROUNDING: f64 = 32.0;
/// How far turning points of the dilatation are looked for: beyond it `det phi` leaves the range of doubles.
const FARTHEST: f64 = 230.0;
/// The longest step. A barrier that is much narrower, and does not show beside the rest of the potential, is not seen.
const LONGEST: f64 = 1.0 / 32.0;
/// Steps on one side, at most: ten times those over a smooth potential.
const MOST_STEPS: u32 = 1 << 17;
/// A step that ends beyond a turning point has told right how far the margin falls, but for this part.
const TOLD: f64 = 0.25;

/// The margin at a place, and its derivatives outwards.
#[derive(Clone, Copy)]
struct Margin {
    value: f64,
    slope: f64,
    curvature: f64,
    /// What rounding of energies and of the place leaves open.
    error: f64,
}

/// What is found on one side.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Turns(f64),
    Open,
    /// The potential ends, or rounding decides.
    Undecided,
}

/// The motion of the dilatation.
struct Motion<'a, const N: usize, M> {
    model: &'a M,
    /// Of the mass.
    sign: f64,
    kinetic: f64,
    potential: f64,
    /// Signs of the functions that keep them where the potential has a value.
    signs: u64,
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
    let sign = if inverse_mass < 0.0 { -1.0 } else { 1.0 };
    let [potential, ..] = derivatives::<N, M>(model, q);
    let signs = signs(model, q)?;
    let motion = Motion { model, sign, kinetic, potential, signs };
    let start = motion.margin(q, 1.0)?;
    if kinetic == 0.0 && start.slope == 0.0 && start.curvature <= 0.0 {
        return Some(Dilatation::Still);
    }
    if kinetic == 0.0 && start.is_marginal() {
        return None;
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
    /// The margin at a place, its derivatives upwards for the way 1 and downwards for -1; `None` where the potential has no value.
    fn margin(&self, q: f64, way: f64) -> Option<Margin> {
        let [potential, slope, curvature] = derivatives::<N, M>(self.model, q);
        let sizes = potential.abs() + self.potential.abs() + self.kinetic;
        let shift = ROUNDING * f64::EPSILON * (1.0 + q.abs());
        let margin = Margin {
            value: self.kinetic - self.sign * (potential - self.potential),
            slope: -way * self.sign * slope,
            curvature: -self.sign * curvature,
            error: ROUNDING * f64::EPSILON * sizes + 0.5 * curvature.abs() * shift * shift,
        };
        let is_finite = [margin.value, margin.slope, margin.error].iter().all(|value| value.is_finite());
        let in_domain = M::DESCRIPTION.domain.is_empty() || signs(self.model, q) == Some(self.signs);
        (is_finite && in_domain).then_some(margin)
    }

    /// What is found in one way, and whether the potential is constant up to there.
    fn side(&self, mut q: f64, way: f64) -> (Side, bool) {
        let Some(mut here) = self.margin(q, way) else { return (Side::Undecided, false) };
        let (mut step, mut flat) = (LONGEST, true);
        for _ in 0..MOST_STEPS {
            flat &= here.slope == 0.0 && here.curvature == 0.0;
            if q.abs() >= FARTHEST {
                let open = here.value > here.error;
                return (if open { Side::Open } else { Side::Undecided }, flat);
            }
            let next = q + way * step;
            if next == q {
                break;
            }
            match self.margin(next, way) {
                Some(there) if there.value < 0.0 && here.tells_fall(&there, step) => {
                    return (self.turning(q, next, way), false);
                }
                Some(there) if there.value >= 0.0 && here.stays_positive(&there, step) => {
                    if here.slope < 0.0 && there.slope >= 0.0 && there.is_marginal() {
                        break;
                    }
                    (q, here) = (next, there);
                    step = if step < 0.5 * LONGEST { 2.0 * step } else { LONGEST };
                }
                _ => step *= 0.5,
            }
        }
        (Side::Undecided, false)
    }

    /// The turning point between two places, the margin being negative at the outer one.
    fn turning(&self, mut inside: f64, mut outside: f64, way: f64) -> Side {
        loop {
            let middle = 0.5 * (inside + outside);
            if middle == inside || middle == outside {
                break;
            }
            let within = self.margin(middle, way).is_some_and(|margin| margin.value >= 0.0);
            *(if within { &mut inside } else { &mut outside }) = middle;
        }
        let there = self.margin(inside, way);
        if there.is_some_and(|margin| !margin.is_marginal()) { Side::Turns(inside) } else { Side::Undecided }
    }
}

impl Margin {
    /// How far the margin and its slope are from what was expected of them after a step.
    fn missed(&self, there: &Self, step: f64) -> f64 {
        let value = self.value + step * (self.slope + 0.5 * step * self.curvature);
        let slope = self.slope + step * self.curvature;
        (there.value - value).abs() + step * (there.slope - slope).abs()
    }

    /// Is it known how far the margin falls within a step?
    fn tells_fall(&self, there: &Self, step: f64) -> bool {
        self.missed(there, step) <= TOLD * (self.value - there.value)
    }

    /// Is the margin positive all over a step? Errors grow with the square of the way at least.
    fn stays_positive(&self, there: &Self, step: f64) -> bool {
        let square = 0.5 * self.curvature - self.missed(there, step) / (step * step);
        let end = self.value + step * (self.slope + step * square);
        let lowest = -0.5 * self.slope / square;
        let dips = square > 0.0 && 0.0 < lowest && lowest < step;
        end > 0.0 && !(dips && self.value + 0.5 * self.slope * lowest <= 0.0)
    }

    /// Does the margin have its least value nearby, which is zero to rounding?
    fn is_marginal(&self) -> bool {
        let depth = if self.slope == 0.0 { 0.0 } else { self.slope * (0.5 * self.slope / self.curvature) };
        self.curvature >= 0.0 && (self.value - depth).abs() <= self.error
    }
}

/// `U` and its first two derivatives.
fn derivatives<const N: usize, M: TwoPolarForm<N>>(model: &M, q: f64) -> [f64; 3] {
    let still = at_rest::<N>(q);
    let (_, places) = still.places::<M>();
    let mut moving = M::Places::<Dual<Dual<f64>>>::zeros();
    for (k, (both, place)) in moving.as_mut().iter_mut().zip(places.as_ref()).enumerate() {
        let moves = if k < N { 1.0 } else { 0.0 };
        *both = Dual { value: Dual { value: *place, slope: moves }, slope: Dual::fixed(moves) };
    }
    let energy = model.lattice_hamiltonian(&M::Couplings::zeros(), &moving);
    [energy.value.value, energy.value.slope, energy.slope.slope]
}

/// Which of the functions that keep their sign are positive; `None` where one has none.
fn signs<const N: usize, M: TwoPolarForm<N>>(model: &M, q: f64) -> Option<u64> {
    if M::DESCRIPTION.domain.is_empty() {
        return Some(0);
    }
    let point = model.at_lattice(&at_rest(q)).ok()?;
    let mut signs = Some(0);
    model.domain(0.0, &point, &mut |value| {
        let has_one = value != 0.0 && !value.is_nan();
        signs = signs.filter(|_| has_one).map(|signs: u64| signs << 1 | u64::from(value > 0.0));
    });
    signs
}

/// Stretches apart and at rest: the energy is the potential's.
fn at_rest<const N: usize>(q: f64) -> Lattice<N> {
    Lattice {
        q: Vector::<N>::from_fn(|a, _| q + (0.5 * (N as f64 - 1.0) - a as f64)),
        p: Vector::zeros(),
        m: Matrix::zeros(),
        n: Matrix::zeros(),
        left: Matrix::identity(),
        right: Matrix::identity(),
    }
}

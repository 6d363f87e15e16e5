//! Whether motions near a relative equilibrium stay near it.

use nalgebra::{Complex, DMatrix, DVector};

use super::error::AnalysisError;
use super::field::{linear_field, vector};
use super::generator::Generator;
use super::linear::{Dense, RANK, absolute_kernel, from_columns, kernel, span};
use super::relative::{Linearised, RelativeEquilibrium};
use super::spectrum::{Eigenvalue, principal, signs, spectrum};
use crate::model::Model;

/// A part of a second variation by which it may fail to be symmetric.
const ASYMMETRY: f64 = 1e-9;
/// Part of the largest stiffness that may be rounding.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// How far a group goes to show whether it is bounded, and by what.
const FAR: f64 = 1e6;
const BOUND: f64 = 1e3;
/// Sections of an interval in the search for a definite second variation.
const SECTIONS: usize = 60;
/// Rounds of that search over the generators of an isotropy group.
const ROUNDS: usize = 8;

/// What becomes of motions near a relative equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StabilityVerdict {
    /// They stay near its orbit: the second variation of `H - J_zeta` is definite, modulo the symmetries that keep the momentum.
    /// With friction, they come to it.
    Stable,
    /// Those of the linearised motion do: all eigenvalues are imaginary and simple, or of one signature.
    LinearlyStable,
    /// Some leave it.
    Unstable {
        /// The fastest rate, of `exp(rate t)`.
        rate: f64,
    },
    /// Neither is shown.
    Undecided(Doubt),
}

/// Why a stability is undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Doubt {
    /// An eigenvalue is zero though no symmetry makes it so: a branch point.
    ZeroMode,
    /// Equal eigenvalues have energies of both signs.
    MixedSigns,
    /// The symmetries that keep the momentum change the others without bound, or neighbours with another `p` have fewer: motions
    /// may leave, though energy and momentum are kept.
    NonCompact,
    /// Neither damped nor growing.
    Neutral,
}

/// The linearised motion near a relative equilibrium, without the directions of symmetries and of conserved momenta.
#[derive(Clone, Debug)]
pub struct Stability<const N: usize> {
    /// What follows.
    pub verdict: StabilityVerdict,
    /// Numbers of positive, negative and zero directions of the second variation of `H - J_zeta` where the momenta are kept;
    /// `None` where the motion is not Hamiltonian.
    pub signature: Option<(usize, usize, usize)>,
    /// Eigenvalues, with bounds of their errors.
    pub eigenvalues: Vec<Eigenvalue>,
    /// Eigenvalues of the second variation with the `zeta` of the motion, without the directions of symmetries, from the least: a
    /// negative one grows under friction at rest in the frame that moves by `zeta`.
    pub stiffnesses: Vec<f64>,
    /// The `zeta` of the second variation: of those that move the point alike, the one for which it is nearest to definite.
    pub zeta: Generator<N>,
    /// Dimension of the group that does not move the point.
    pub isotropy: usize,
}

impl<const N: usize, P> RelativeEquilibrium<N, P> {
    /// Its stability.
    ///
    /// # Errors
    /// [`AnalysisError::NoDecomposition`].
    pub fn stability<M: Model<N, Point<f64> = P>>(&self, model: &M) -> Result<Stability<N>, AnalysisError> {
        let at = Linearised::at(model, &self.zeta, &self.point);
        // The point is open to be set.
        if at.motion.iter().any(|entry| !entry.is_finite()) {
            return Err(AnalysisError::NoDecomposition);
        }
        let slice = Slice::of(&at);
        let (motion, energy) = (slice.columns.tr_mul(&at.motion) * &slice.columns, slice.energy(&at));
        let eigenvalues = spectrum(&motion, energy.as_ref())?;
        let isotropy = kernel(&at.orbit, RANK);
        let mut stability = Stability {
            verdict: damped(&eigenvalues),
            signature: None,
            eigenvalues,
            stiffnesses: Vec::new(),
            zeta: self.zeta,
            isotropy: isotropy.ncols(),
        };
        let Some(energy) = energy else { return Ok(stability) };
        stability.stiffnesses = principal(&energy);
        let own = isotropic(model, self, &at, &isotropy);
        let variations: Vec<_> = own.iter().map(|(_, slopes)| slice.form(&slopes.tr_mul(&at.form))).collect();
        let (factors, energy) = nearest_to_definite(&energy, &variations);
        let shifts = factors.into_iter().zip(own.iter().map(|(generator, _)| generator));
        stability.zeta = self.zeta.plus(1.0, &Generator::sum(shifts));
        let (positive, negative, zero) = signs(&energy);
        stability.signature = Some((positive, negative, zero + slice.along_orbit));
        stability.verdict = match (growth(&stability.eigenvalues), zero > 0, positive == 0 || negative == 0) {
            (Some(rate), true, _) | (Some(rate), _, false) => StabilityVerdict::Unstable { rate },
            (None, true, _) => StabilityVerdict::Undecided(Doubt::ZeroMode),
            (None, _, false) => conservative(&stability.eigenvalues),
            _ if slice.is_compact => StabilityVerdict::Stable,
            _ => StabilityVerdict::Undecided(Doubt::NonCompact),
        };
        Ok(stability)
    }
}

impl<const N: usize> Stability<N> {
    /// The eigenvalue that grows fastest.
    pub(super) fn fastest(&self) -> Option<Eigenvalue> {
        self.eigenvalues.iter().copied().max_by(|a, b| a.value.re.total_cmp(&b.value.re))
    }

    /// The two eigenvalues nearest to where a growing one oscillates.
    pub(super) fn nearest(&self, growing: Complex<f64>) -> Option<[Eigenvalue; 2]> {
        let target = Complex::new(0.0, growing.im);
        let mut near = self.eigenvalues.clone();
        near.sort_by(|a, b| (a.value - target).norm().total_cmp(&(b.value - target).norm()));
        near.first_chunk().copied()
    }

    /// The square of their difference: negative while both are frequencies, positive where they grow and fall, smooth between.
    pub(super) fn discriminant(&self, growing: Complex<f64>) -> Option<f64> {
        self.nearest(growing).map(|[a, b]| (a.value - b.value).powi(2).re)
    }

    /// The stiffnesses; what rounding leaves of one that vanishes is zero.
    pub(super) fn rounded_stiffnesses(&self) -> impl Iterator<Item = f64> + '_ {
        let largest = self.stiffnesses.iter().fold(0.0_f64, |largest, one| largest.max(one.abs()));
        let is_some = move |one: f64| one.abs() > ROUNDING * largest;
        self.stiffnesses.iter().map(move |one| if is_some(*one) { *one } else { 0.0 })
    }
}

/// The directions that keep all momenta, without those along the orbit of the group that keeps them.
struct Slice {
    /// Orthonormal columns.
    columns: Dense,
    /// Dimension of what was left out of the kernel of the momenta.
    along_orbit: usize,
    is_compact: bool,
}

impl Slice {
    fn of<const N: usize>(at: &Linearised<N>) -> Self {
        let keeping = kernel(&at.orbit.tr_mul(&at.form), RANK);
        let moments = |orbit: &Dense| {
            let size = (at.orbit.norm() * orbit.norm() * at.form.norm()).max(f64::MIN_POSITIVE);
            (at.orbit.tr_mul(&at.form) * orbit, RANK * size)
        };
        let keeps = |(moments, threshold): &(Dense, f64)| absolute_kernel(moments, *threshold);
        let own = moments(&at.orbit);
        let along = keeping.tr_mul(&(&at.moved * keeps(&moments(&at.moved))));
        let along = span(&along, RANK * (at.size + at.moved.norm()));
        let columns = &keeping * kernel(&along.transpose(), RANK);
        Self {
            columns,
            along_orbit: along.ncols(),
            is_compact: is_compact(&at.symmetries, (&own.0, own.1), &keeps(&own)),
        }
    }

    fn form(&self, form: &Dense) -> Dense {
        let form = self.columns.tr_mul(form) * &self.columns;
        (&form + form.transpose()) * 0.5
    }

    /// The second variation, where the motion is Hamiltonian.
    fn energy<const N: usize>(&self, at: &Linearised<N>) -> Option<Dense> {
        let whole = at.second_variation();
        let defect = (&whole - whole.transpose()).norm();
        (defect <= ASYMMETRY * whole.norm()).then(|| self.form(&whole))
    }
}

/// Whether what keeps the momentum keeps an inner product on the algebra of all that keep `p`, translations apart: then energy and
/// momentum hold the motion (G. W. Patrick, J. Geom. Phys. 9 (1992) 111; translations come first, of which `p` is left as a number:
/// N. E. Leonard, J. E. Marsden, Physica D 105 (1997) 130).
fn is_compact<const N: usize>(
    symmetries: &[Generator<N>],
    (moments, threshold): (&Dense, f64),
    stays: &Dense,
) -> bool {
    let still = |one: &Generator<N>| Generator { drift: Generator::zero().drift, ..*one }.components();
    let all = from_columns(3 * N * N + N, &symmetries.iter().map(still).collect::<Vec<_>>());
    let turned = absolute_kernel(&all, RANK).tr_mul(moments);
    let rank = |first: usize, rows: usize| span(&all.rows(first, rows).into_owned(), RANK).ncols();
    // Others keep other momenta, where what moves the centre moves the body.
    if turned.norm() <= threshold
        && rank(0, 2 * N * N) + rank(2 * N * N, N * N) > rank(0, all.nrows())
        && rank(0, all.nrows()) < all.ncols()
    {
        return false;
    }
    let [whole, own] = [&absolute_kernel(&turned, threshold), stays].map(|own| span(&(&all * own), RANK));
    let adjoint = |one: &Generator<N>, basis: &Dense| {
        let brackets =
            basis.column_iter().map(|other| one.bracket(&Generator::of(other.as_slice())).components());
        basis.tr_mul(&from_columns(basis.nrows(), &brackets.collect::<Vec<_>>()))
    };
    let elements: Vec<Generator<N>> = own.column_iter().map(|one| Generator::of(one.as_slice())).collect();
    let within: Vec<Dense> = elements.iter().map(|one| adjoint(one, &own)).collect();
    let killing = DMatrix::from_fn(within.len(), within.len(), |a, b| (&within[a] * &within[b]).trace());
    let stacked: Vec<_> = within.iter().map(|one| DVector::from_column_slice(one.as_slice())).collect();
    let centre = absolute_kernel(&from_columns(within.len() * within.len(), &stacked), RANK);
    let values = principal(&killing);
    let negative = values.iter().filter(|value| **value < -RANK).count();
    let is_bounded = |factors: &[f64]| {
        let action = adjoint(&Generator::sum(factors.iter().copied().zip(&elements)), &whole);
        let size = action.norm();
        size <= RANK || (action * (FAR / size)).exp().norm() <= BOUND
    };
    let negative_beside_centre = negative + centre.ncols() == within.len();
    negative_beside_centre && centre.column_iter().all(|one| is_bounded(one.as_slice()))
}

/// Generators that do not move the point, with the derivatives of their fields, by which `zeta` may change.
fn isotropic<const N: usize, M: Model<N>>(
    model: &M,
    turn: &RelativeEquilibrium<N, M::Point<f64>>,
    at: &Linearised<N>,
    isotropy: &Dense,
) -> Vec<(Generator<N>, Dense)> {
    let z = vector(&model.flatten(&turn.point));
    let of = |column: usize| {
        let generator = Generator::sum(isotropy.column(column).iter().copied().zip(&at.symmetries));
        let slopes = at.basis.tr_mul(&linear_field(model, &generator, &z)) * &at.basis;
        // The augmented Hamiltonian changes by `-J`.
        (generator, -slopes)
    };
    let all = (0..isotropy.ncols()).map(of);
    // What turns `zeta` itself away would not be conserved by the linearised motion.
    all.filter(|(generator, _)| {
        let bracket = generator.bracket(&turn.zeta).components().norm();
        bracket <= RANK * (1.0 + turn.zeta.components().norm())
    })
    .collect()
}

/// The factors of variations for which the least eigenvalue of a form, or of its negative, is largest: a concave function.
fn nearest_to_definite(energy: &Dense, variations: &[Dense]) -> (Vec<f64>, Dense) {
    let mut best = (vec![0.0; variations.len()], energy.clone());
    if energy.is_empty() || variations.is_empty() {
        return best;
    }
    let mut height = f64::NEG_INFINITY;
    for sign in [1.0, -1.0] {
        let least = |form: &Dense| (form * sign).symmetric_eigenvalues().min();
        if least(energy) > 0.0 {
            return (vec![0.0; variations.len()], energy.clone());
        }
        let (mut factors, mut form) = (vec![0.0; variations.len()], energy.clone());
        for _ in 0..if variations.len() == 1 { 1 } else { ROUNDS } {
            for (factor, variation) in factors.iter_mut().zip(variations).filter(|(_, one)| one.norm() > 0.0)
            {
                let reach = 4.0 * form.norm() / variation.norm();
                let shift = highest((-reach, reach), |shift| least(&(&form + variation * shift)));
                *factor += shift;
                form += variation * shift;
            }
        }
        if least(&form) > height.max(0.0) {
            height = least(&form);
            best = (factors, form);
        }
    }
    best
}

/// Where a concave function is highest, by golden sections.
fn highest((mut low, mut high): (f64, f64), value: impl Fn(f64) -> f64) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..SECTIONS {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if value(a) < value(b) { low = a } else { high = b }
    }
    0.5 * (low + high)
}

/// The largest rate that is above its error.
fn growth(eigenvalues: &[Eigenvalue]) -> Option<f64> {
    let growing = eigenvalues.iter().filter(|one| one.value.re > one.error);
    growing.map(|one| one.value.re).reduce(f64::max)
}

/// Of eigenvalues of which none grows.
fn conservative(eigenvalues: &[Eigenvalue]) -> StabilityVerdict {
    if eigenvalues.iter().any(|one| one.value.norm() <= one.error) {
        StabilityVerdict::Undecided(Doubt::ZeroMode)
    } else if eigenvalues.iter().any(|one| one.is_mixed) {
        StabilityVerdict::Undecided(Doubt::MixedSigns)
    } else {
        StabilityVerdict::LinearlyStable
    }
}

fn damped(eigenvalues: &[Eigenvalue]) -> StabilityVerdict {
    match growth(eigenvalues) {
        Some(rate) => StabilityVerdict::Unstable { rate },
        None if eigenvalues.iter().all(|one| one.value.re < -one.error) => StabilityVerdict::Stable,
        None => StabilityVerdict::Undecided(Doubt::Neutral),
    }
}

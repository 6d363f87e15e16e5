//! Which motions are bounded.
//!
//! Without a potential, or with one of `q = ln(det phi)/n` alone, the shear of an isotropic affine model moves as
//! `exp(t sigma/alpha)` times a rotation, `sigma = Sigma - (tr Sigma/n) 1` being conserved up to a rotation (section 5). So
//! it is bounded exactly where `sigma` has imaginary eigenvalues and is diagonalisable:
//!
//! * `n = 2`: `tr sigma^2 < 0`, an open set;
//! * `n = 3`: `det sigma = 0` and `tr sigma^2 < 0`, since the eigenvalues are the roots of
//!   `l^3 - (tr sigma^2/2) l - det sigma`, a real one among them, whose sign is that of `det sigma` where the other two are
//!   not real.
//!
//! The paper claims an open set of bounded motions for every `n`. For `n = 3` that is false: `det sigma = 0` is one equation,
//! and any perturbation that makes `det sigma` different from zero makes an eigenvalue with a positive real part, of
//! `sigma` or of `-sigma`, as the sum of all three vanishes: a skew `sigma`, whose motion is a rotation, has
//! escaping neighbours arbitrarily near, and almost all neighbours are. The claim for unbounded motions, that they fill an
//! open set, is right.

use core::f64::consts::{FRAC_1_SQRT_2, TAU};

use super::confinement::{Dilatation, confinement};
use super::{MetricSide, PotentialClass, TwoPolarForm};
use crate::frames::Matrix;
use crate::inner::norm;
use crate::kinematics::Kinematics;
use crate::state::Phase;

/// What is zero to rounding, in units of `eps` times the sizes it is made of.
const ROUNDING: f64 = 32.0;

/// What becomes of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionClass {
    /// The shear, `phi/det(phi)^(1/n)`.
    pub shear: Growth,
    /// Angular frequency of the second, rotating factor: `|Vort/mu|` or `|S/mu|`.
    pub whirl: f64,
    /// The dilatation, `det(phi)^(1/n)`.
    pub dilatation: Dilatation,
}

/// What becomes of the shear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Growth {
    /// Bounded for all times; `exp(t sigma/alpha)` has this period, and is constant without one.
    Bounded {
        /// `2 pi/w`, `w = sqrt(-tr(sigma^2)/2)/|alpha|`.
        period: Option<f64>,
    },
    /// The stretches part like `exp(rate t)`, forward in time.
    Escaping {
        /// The largest real part of the eigenvalues of `sigma/alpha`.
        rate: f64,
    },
    /// On the threshold to rounding: `sigma` is nilpotent and not zero, and the stretches part like a power of time.
    Marginal,
}

impl MotionClass {
    /// The class of the motion through a phase point by the exact criterion, and by a search for turning points where there is a
    /// potential, which passes no barrier and no pole.
    ///
    /// `None` where there is no criterion: for d'Alembert's model, whose free motions are straight lines, for potentials of more
    /// than `q = ln(det phi)/n`, and for points that are not finite. `None` too where the dilatation comes to the end of the domain
    /// of its potential, where it is at rest on top of a hump, and where its energy is that of a hump, to rounding.
    #[must_use]
    pub fn of<const N: usize, M: TwoPolarForm<N>>(model: &M, point: &M::Point<f64>) -> Option<Self> {
        let isotropic = model.isotropic()?;
        let point = model.orthonormal(point);
        if !point.is_finite() {
            return None;
        }
        let (n, spin) = (N as f64, point.mixed_spin());
        // To rounding: the momentum may have come from another frame.
        let p_dil = Some(point.dilatational_momentum());
        let p_dil =
            p_dil.filter(|p| p.abs() > ROUNDING * f64::EPSILON * norm(spin.as_slice())).unwrap_or(0.0);
        let dilatation = match M::LATTICE.potential {
            PotentialClass::Stretches => return None,
            PotentialClass::None if p_dil == 0.0 => Dilatation::Still,
            PotentialClass::None => {
                Dilatation::Uniform { rate: p_dil * (isotropic.inverse_alpha / n + isotropic.inverse_beta) }
            }
            PotentialClass::Dilatation => confinement(model, (point.mean_log_stretch(), p_dil), &isotropic)?,
        };
        let whirl = match isotropic.side {
            MetricSide::Body => norm(point.vorticity().0.0.as_slice()),
            MetricSide::Space => norm(point.spin().0.0.as_slice()),
        };
        Some(Self {
            shear: growth(&spin, isotropic.inverse_alpha),
            // Every entry stands twice in a skew matrix.
            whirl: (FRAC_1_SQRT_2 * whirl * isotropic.inverse_mu).abs(),
            dilatation,
        })
    }

    /// Is `phi` bounded, and bounded away from singular matrices, for all times?
    #[must_use]
    pub fn is_bounded(&self) -> bool {
        let confined = matches!(self.dilatation, Dilatation::Still | Dilatation::Confined { .. });
        confined && matches!(self.shear, Growth::Bounded { .. })
    }
}

/// The growth of `exp(t sigma/alpha)`, `sigma` the traceless part of a matrix.
fn growth<const N: usize>(spin: &Matrix<N>, inverse_alpha: f64) -> Growth {
    let size = norm(spin.as_slice());
    if size == 0.0 {
        return Growth::Bounded { period: None };
    }
    // Of size 1, so that no power leaves the range of numbers.
    let unit = spin / size.copysign(inverse_alpha);
    let exponent = unit - Matrix::<N>::from_diagonal_element(unit.trace() / N as f64);
    let (scale, negligible) = (size * inverse_alpha.abs(), ROUNDING * f64::EPSILON);
    if exponent.norm() <= negligible {
        return Growth::Bounded { period: None };
    }
    let half_square = 0.5 * (exponent * exponent).trace();
    // l^2 = tr/2 for n = 2; l^3 - (tr/2) l - det = 0 for n = 3.
    let determinant = if N == 3 { (exponent * exponent * exponent).trace() / 3.0 } else { 0.0 };
    if determinant.abs() > negligible {
        return Growth::Escaping { rate: scale * largest_real_part(half_square, determinant) };
    }
    if half_square.abs() <= negligible {
        return Growth::Marginal;
    }
    let root = scale * libm::sqrt(half_square.abs());
    match half_square < 0.0 {
        true => Growth::Bounded { period: Some(TAU / root) },
        false => Growth::Escaping { rate: root },
    }
}

/// The largest real part of the roots of `l^3 - h l - d`.
fn largest_real_part(h: f64, d: f64) -> f64 {
    let polynomial = |l: f64| (l * l - h) * l - d;
    // All roots are smaller than this bound (Cauchy's, for roots whose sum vanishes).
    let bound = libm::sqrt(h.abs()) + libm::cbrt(d.abs());
    // A real root of the sign of d lies between 0 and the bound.
    let (mut inside, mut outside) = (0.0, if d > 0.0 { 2.0 * bound } else { -2.0 * bound });
    for _ in 0..200 {
        let middle = 0.5 * (inside + outside);
        if middle == inside || middle == outside {
            break;
        }
        let beyond = polynomial(middle) * d > 0.0;
        *(if beyond { &mut outside } else { &mut inside }) = middle;
    }
    let real = 0.5 * (inside + outside);
    // The others: l^2 + real l + real^2 - h.
    let discriminant = 0.25 * real * real - (real * real - h);
    let other = -0.5 * real + if discriminant > 0.0 { libm::sqrt(discriminant) } else { 0.0 };
    if real > other { real } else { other }
}

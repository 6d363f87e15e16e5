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

use super::{Isotropic, Lattice, LatticeForm, MetricSide, PotentialClass, TwoPolarForm};
use crate::frames::Matrix;
use crate::kinematics::Kinematics;
use crate::state::Phase;

/// What is zero to rounding, in units of `eps` times the sizes it is made of.
const ROUNDING: f64 = 32.0;
/// How far turning points of the dilatation are looked for: beyond it `det phi` leaves the range of doubles.
const FARTHEST: f64 = 230.0;

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

/// What becomes of the dilatation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dilatation {
    /// No potential and no dilatational momentum: the volume is constant.
    Still,
    /// No potential: `q = q0 + rate t`.
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

impl MotionClass {
    /// The class of the motion through a phase point by the exact criterion; `None` where there is none: for d'Alembert's
    /// model, whose free motions are straight lines, and for potentials of more than `q = ln(det phi)/n`.
    #[must_use]
    pub fn of<const N: usize, M: TwoPolarForm<N>>(model: &M, point: &M::Point<f64>) -> Option<Self> {
        let isotropic = model.isotropic()?;
        let point = model.orthonormal(point);
        let p_dil = point.dilatational_momentum();
        let n = N as f64;
        let dilatation = match M::LATTICE.potential {
            PotentialClass::Stretches => return None,
            // To rounding: the momentum may have come from another frame.
            PotentialClass::None if p_dil.abs() <= ROUNDING * f64::EPSILON * point.mixed_spin().norm() => {
                Dilatation::Still
            }
            PotentialClass::None => {
                Dilatation::Uniform { rate: p_dil * (isotropic.inverse_alpha / n + isotropic.inverse_beta) }
            }
            PotentialClass::Dilatation => confinement(model, point.mean_log_stretch(), p_dil, &isotropic),
        };
        let whirl = match isotropic.side {
            MetricSide::Body => point.vorticity().norm_squared(),
            MetricSide::Space => point.spin().norm_squared(),
        };
        Some(Self {
            shear: growth(&point.mixed_spin(), isotropic.inverse_alpha),
            whirl: (libm::sqrt(whirl) * isotropic.inverse_mu).abs(),
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
    let size = spin.norm();
    let sigma = spin - Matrix::<N>::from_diagonal_element(spin.trace() / N as f64);
    let exponent = sigma * inverse_alpha;
    let unit = size * inverse_alpha.abs();
    let negligible = ROUNDING * f64::EPSILON;
    if exponent.norm() <= negligible * unit {
        return Growth::Bounded { period: None };
    }
    let half_square = 0.5 * (exponent * exponent).trace();
    // l^2 = tr/2 for n = 2; l^3 - (tr/2) l - det = 0 for n = 3.
    let determinant = if N == 3 { (exponent * exponent * exponent).trace() / 3.0 } else { 0.0 };
    if determinant.abs() > negligible * unit * unit * unit {
        return Growth::Escaping { rate: largest_real_part(half_square, determinant) };
    }
    if half_square.abs() <= negligible * unit * unit {
        return Growth::Marginal;
    }
    let root = libm::sqrt(half_square.abs());
    match half_square < 0.0 {
        true => Growth::Bounded { period: Some(2.0 * core::f64::consts::PI / root) },
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

/// Turning points of `k p^2/2 + U(q)` with `k = (1/alpha + n/beta)/n`, looked for outwards from where the motion is.
fn confinement<const N: usize, M: LatticeForm<N>>(
    model: &M,
    q: f64,
    p_dil: f64,
    isotropic: &Isotropic,
) -> Dilatation {
    let inverse_mass = isotropic.inverse_alpha / N as f64 + isotropic.inverse_beta;
    let potential = |q: f64| {
        // Stretches apart and at rest: the energy is the potential's.
        let still = Lattice::<N> {
            q: crate::frames::Vector::<N>::from_fn(|a, _| q + (0.5 * (N as f64 - 1.0) - a as f64)),
            p: crate::frames::Vector::zeros(),
            m: Matrix::zeros(),
            n: Matrix::zeros(),
            left: Matrix::identity(),
            right: Matrix::identity(),
        };
        let (couplings, places) = still.places::<M>();
        model.lattice_hamiltonian(&couplings, &places)
    };
    let start = potential(q);
    // Negative beyond a turning point.
    let kinetic = |at: f64| {
        let rest = 0.5 * p_dil * p_dil * inverse_mass - (potential(at) - start);
        if inverse_mass > 0.0 { rest } else { -rest }
    };
    let turning = |direction: f64| {
        let (mut reached, mut step) = (0.0, 1e-3);
        while reached < FARTHEST {
            let next = reached + step;
            if kinetic(q + direction * next) < 0.0 {
                let (mut inside, mut outside) = (reached, next);
                for _ in 0..80 {
                    let middle = 0.5 * (inside + outside);
                    let beyond = kinetic(q + direction * middle) < 0.0;
                    *(if beyond { &mut outside } else { &mut inside }) = middle;
                }
                return Some(q + direction * inside);
            }
            reached = next;
            step = if step * 1.1 < 0.05 { step * 1.1 } else { 0.05 };
        }
        None
    };
    match (turning(-1.0), turning(1.0)) {
        (Some(from), Some(to)) => Dilatation::Confined { from, to },
        _ => Dilatation::Free,
    }
}

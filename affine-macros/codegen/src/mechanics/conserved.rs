//! Conserved quantities by exact brackets: a candidate is listed exactly when its bracket with `H` vanishes
//! identically.

use crate::algebra::evaluate::evaluate_polynomial;
use crate::algebra::ring::{Ring, Square, adjugate, deviator, difference, product, skew, sum, table};
use crate::algebra::{Arena, Polynomial, Rational};

use super::brackets::{Generator, generator_bracket};
use super::charts::{Chart, Coordinate, Momentum};
use super::equations::{Form, gradient, rate, velocities};

/// What a model may conserve, named as in the runtime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Candidate {
    /// Energy `H`.
    Energy,
    /// `p`
    LinearMomentum,
    /// `p_hat = phi^T p`
    ComovingLinearMomentum,
    /// `x p^T - p x^T`
    OrbitalAngularMomentum,
    /// `I(O) = x p^T + Sigma`
    TotalAffineMomentum,
    /// `I(O) - I(O)^T`
    TotalAngularMomentum,
    /// `Sigma`
    AffineSpin,
    /// traceless part of `Sigma`
    Deviator,
    /// `S = Sigma - Sigma^T`
    Spin,
    /// `|S|^2`
    SpinNorm,
    /// `Sigma_hat`
    ComovingAffineSpin,
    /// traceless part of `Sigma_hat`
    ComovingDeviator,
    /// `Vort = Sigma_hat - Sigma_hat^T`
    Vorticity,
    /// `|Vort|^2`
    VorticityNorm,
    /// `Pi`
    CanonicalMomentum,
    /// `tr Sigma`
    Casimir1,
    /// `tr Sigma^2`
    Casimir2,
    /// `tr Sigma^3`
    Casimir3,
    /// `tr sigma^2` of the deviator
    DeviatorCasimir2,
    /// `tr sigma^3` of the deviator
    DeviatorCasimir3,
}

impl Candidate {
    const ALL: [Candidate; 20] = [
        Candidate::Energy,
        Candidate::LinearMomentum,
        Candidate::ComovingLinearMomentum,
        Candidate::OrbitalAngularMomentum,
        Candidate::TotalAffineMomentum,
        Candidate::TotalAngularMomentum,
        Candidate::AffineSpin,
        Candidate::Deviator,
        Candidate::Spin,
        Candidate::SpinNorm,
        Candidate::ComovingAffineSpin,
        Candidate::ComovingDeviator,
        Candidate::Vorticity,
        Candidate::VorticityNorm,
        Candidate::CanonicalMomentum,
        Candidate::Casimir1,
        Candidate::Casimir2,
        Candidate::Casimir3,
        Candidate::DeviatorCasimir2,
        Candidate::DeviatorCasimir3,
    ];

    /// Does the quantity exist for a model of this dimension, with or without translation?
    fn exists(self, dim: usize, translation: bool) -> bool {
        match self {
            Candidate::LinearMomentum
            | Candidate::ComovingLinearMomentum
            | Candidate::OrbitalAngularMomentum
            | Candidate::TotalAffineMomentum
            | Candidate::TotalAngularMomentum => translation,
            Candidate::Casimir3 | Candidate::DeviatorCasimir3 => dim == 3,
            _ => true,
        }
    }
}

/// The candidates that `h` conserves, a polynomial in the chart of the model's own frame with `p` spatial.
pub fn conserved(arena: &mut Arena, chart: &Chart, h: &Polynomial) -> Vec<Candidate> {
    let symbolic = Flow::new(arena, chart, h);
    let sample = symbolic.at_a_point(arena);
    Candidate::ALL
        .into_iter()
        .filter(|c| c.exists(chart.dim, chart.linear.is_some()))
        .filter(|c| {
            // One point where the bracket is not zero is a proof; only the rest needs polynomials.
            sample.as_ref().is_none_or(|s| s.bracket(*c).iter().all(Rational::is_zero))
                && symbolic.bracket(*c).iter().all(Polynomial::is_zero)
        })
        .collect()
}

/// Coordinates and their rates, as polynomials or at one point.
struct Flow<R> {
    momentum: Momentum,
    x: Vec<R>,
    p: Vec<R>,
    phi: Square<R>,
    m: Square<R>,
    x_dot: Vec<R>,
    p_dot: Vec<R>,
    phi_dot: Square<R>,
    /// Rate of `Pi`, where the chart has it.
    pi_dot: Square<R>,
    /// Rates of `Sigma` and `Sigma_hat`.
    sigma_dot: Square<R>,
    sigma_hat_dot: Square<R>,
    velocity: Square<R>,
}

impl Flow<Polynomial> {
    fn new(arena: &mut Arena, chart: &Chart, h: &Polynomial) -> Self {
        let n = chart.dim;
        let velocity = velocities(arena, chart, h);
        let gradient = gradient(chart, h);
        let dot = |z: Coordinate| rate(chart, &gradient, &velocity, Form::Expanded, z);
        let square = |entry: &dyn Fn(usize, usize) -> Polynomial| -> Square<Polynomial> {
            (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
        };
        let generated = |g: Generator| {
            let mut sum = Polynomial::zero();
            for (z, d) in &gradient {
                sum.add_product(&generator_bracket(chart, g, *z), d, &Rational::ONE);
            }
            sum
        };
        let moving = chart.x.len();
        Self {
            momentum: chart.momentum,
            x: chart.x.iter().map(|x| Polynomial::atom(*x)).collect(),
            p: chart.p.iter().map(|p| Polynomial::atom(*p)).collect(),
            phi: square(&|i, j| Polynomial::atom(chart.phi.0[i][j])),
            m: square(&|i, j| Polynomial::atom(chart.m.0[i][j])),
            x_dot: (0..moving).map(|i| dot(Coordinate::X(i))).collect(),
            p_dot: (0..moving).map(|i| dot(Coordinate::P(i))).collect(),
            phi_dot: square(&|i, j| dot(Coordinate::Phi(i, j))),
            pi_dot: match chart.momentum {
                Momentum::Canonical => square(&|i, j| dot(Coordinate::M(i, j))),
                _ => Vec::new(),
            },
            sigma_dot: square(&|i, j| generated(Generator::Space(i, j))),
            sigma_hat_dot: square(&|i, j| generated(Generator::Body(i, j))),
            velocity: square(&|i, j| velocity[i][j].1.clone()),
        }
    }

    /// All of it at one rational point, where parameters take values too.
    fn at_a_point(&self, arena: &Arena) -> Option<Flow<Rational>> {
        let value = |p: &Polynomial| evaluate_polynomial(arena, p, &|name| Some(sample(name)));
        let list = |v: &Vec<Polynomial>| v.iter().map(value).collect::<Option<Vec<Rational>>>();
        let square = |m: &Square<Polynomial>| m.iter().map(list).collect::<Option<Square<Rational>>>();
        Some(Flow {
            momentum: self.momentum,
            x: list(&self.x)?,
            p: list(&self.p)?,
            phi: square(&self.phi)?,
            m: square(&self.m)?,
            x_dot: list(&self.x_dot)?,
            p_dot: list(&self.p_dot)?,
            phi_dot: square(&self.phi_dot)?,
            pi_dot: square(&self.pi_dot)?,
            sigma_dot: square(&self.sigma_dot)?,
            sigma_hat_dot: square(&self.sigma_hat_dot)?,
            velocity: square(&self.velocity)?,
        })
    }
}

/// A small rational that depends on the name alone.
fn sample(name: &str) -> Rational {
    let hash = name.bytes().fold(0x811c_9dc5_u32, |h, b| (h ^ u32::from(b)).wrapping_mul(0x0100_0193));
    let (above, below) = (i64::from(hash >> 8 & 0x3f) + 1, i64::from(hash & 7) + 1);
    Rational::ratio(if hash >> 20 & 1 == 0 { above } else { -above }, below).unwrap_or(Rational::ONE)
}

impl<R: Ring> Flow<R> {
    /// The components of `{candidate, H}`, up to common factors that do not vanish.
    fn bracket(&self, candidate: Candidate) -> Vec<R> {
        match candidate {
            Candidate::Energy => Vec::new(),
            Candidate::LinearMomentum => self.p_dot.clone(),
            Candidate::ComovingLinearMomentum => self.comoving_momentum_rate(),
            Candidate::OrbitalAngularMomentum => skew(&self.orbital_rate()),
            Candidate::TotalAffineMomentum => sum(&self.orbital_rate(), &self.sigma_dot).concat(),
            Candidate::TotalAngularMomentum => skew(&sum(&self.orbital_rate(), &self.sigma_dot)),
            Candidate::AffineSpin => self.sigma_dot.concat(),
            Candidate::Deviator => deviator(&self.sigma_dot).concat(),
            Candidate::Spin => skew(&self.sigma_dot),
            Candidate::SpinNorm => norm_rate(&self.sigma_up_to_scale(), &self.sigma_dot),
            Candidate::ComovingAffineSpin => self.sigma_hat_dot.concat(),
            Candidate::ComovingDeviator => deviator(&self.sigma_hat_dot).concat(),
            Candidate::Vorticity => skew(&self.sigma_hat_dot),
            Candidate::VorticityNorm => norm_rate(&self.sigma_hat_up_to_scale(), &self.sigma_hat_dot),
            Candidate::CanonicalMomentum => self.canonical_rate().concat(),
            Candidate::Casimir1 => self.casimir_rate(1, Clone::clone),
            Candidate::Casimir2 => self.casimir_rate(2, Clone::clone),
            Candidate::Casimir3 => self.casimir_rate(3, Clone::clone),
            Candidate::DeviatorCasimir2 => self.casimir_rate(2, deviator),
            Candidate::DeviatorCasimir3 => self.casimir_rate(3, deviator),
        }
    }

    /// Rate of the trace of a power of the affine spin or of its deviator. `Sigma` and `Sigma_hat` have the same
    /// traces, so one of them at rest settles it.
    fn casimir_rate(&self, k: usize, part: impl Fn(&Square<R>) -> Square<R>) -> Vec<R> {
        let still = |rate: &Square<R>| rate.iter().flatten().all(Ring::vanishes);
        if still(&self.sigma_dot) || still(&self.sigma_hat_dot) {
            return Vec::new();
        }
        power_rate(k, &part(&self.spin()), &part(self.spin_rate()))
    }

    /// `phi_dot^T p + phi^T p_dot`.
    fn comoving_momentum_rate(&self) -> Vec<R> {
        (0..self.phi.len())
            .map(|a| {
                let mut rate = R::zero();
                for i in 0..self.p.len() {
                    rate.plus_product(&self.phi_dot[i][a], &self.p[i], &Rational::ONE);
                    rate.plus_product(&self.phi[i][a], &self.p_dot[i], &Rational::ONE);
                }
                rate
            })
            .collect()
    }

    /// Rate of `x p^T`.
    fn orbital_rate(&self) -> Square<R> {
        table(self.phi.len(), |i, j| {
            let mut rate = R::zero();
            if !self.x.is_empty() {
                rate.plus_product(&self.x_dot[i], &self.p[j], &Rational::ONE);
                rate.plus_product(&self.x[i], &self.p_dot[j], &Rational::ONE);
            }
            rate
        })
    }

    /// Rate of `Pi`, times `phi` on the side where that makes it a polynomial.
    fn canonical_rate(&self) -> Square<R> {
        let (rate, lost) = match self.momentum {
            // Pi_dot phi = d(Pi phi)/dt - Pi phi_dot = Sigma_hat_dot - Sigma_hat Omega_hat
            Momentum::Body => (&self.sigma_hat_dot, product(&self.m, &self.velocity)),
            // phi Pi_dot = Sigma_dot - Omega Sigma
            Momentum::Space | Momentum::Total => (&self.sigma_dot, product(&self.velocity, &self.m)),
            Momentum::Canonical => return self.pi_dot.clone(),
        };
        difference(rate, &lost)
    }

    /// The affine spin whose traces are the Casimirs, in whichever frame is at hand.
    fn spin(&self) -> Square<R> {
        match self.momentum {
            Momentum::Canonical => product(&self.phi, &self.m),
            _ => self.m.clone(),
        }
    }

    fn spin_rate(&self) -> &Square<R> {
        match self.momentum {
            Momentum::Body => &self.sigma_hat_dot,
            _ => &self.sigma_dot,
        }
    }

    /// `Sigma`, times `det phi` where the chart has `Sigma_hat`.
    fn sigma_up_to_scale(&self) -> Square<R> {
        match self.momentum {
            Momentum::Body => product(&product(&self.phi, &self.m), &adjugate(&self.phi)),
            _ => self.spin(),
        }
    }

    /// `Sigma_hat`, times `det phi` where the chart has `Sigma`.
    fn sigma_hat_up_to_scale(&self) -> Square<R> {
        match self.momentum {
            Momentum::Body => self.m.clone(),
            Momentum::Canonical => product(&self.m, &self.phi),
            Momentum::Space | Momentum::Total => product(&product(&adjugate(&self.phi), &self.m), &self.phi),
        }
    }
}

/// Half the rate of the squared norm of the skew part.
fn norm_rate<R: Ring>(m: &Square<R>, m_dot: &Square<R>) -> Vec<R> {
    let mut rate = R::zero();
    for (w, w_dot) in skew(m).iter().zip(&skew(m_dot)) {
        rate.plus_product(w, w_dot, &Rational::ONE);
    }
    vec![rate]
}

/// `tr(m^(k-1) m_dot)`, the rate of `tr m^k / k`.
fn power_rate<R: Ring>(k: usize, m: &Square<R>, m_dot: &Square<R>) -> Vec<R> {
    let mut power = m_dot.clone();
    for _ in 1..k {
        power = product(m, &power);
    }
    let mut trace = R::zero();
    (0..m.len()).for_each(|a| trace.plus(&power[a][a], &Rational::ONE));
    vec![trace]
}

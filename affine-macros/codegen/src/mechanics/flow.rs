//! Rates of momenta along the motion, as polynomials or modulo a prime at one point.
//!
//! One point where a rate is not zero is a proof that it is no identity, and costs next to nothing; polynomials
//! are formed for the rest alone.

use std::cell::OnceCell;

use crate::algebra::evaluate::evaluate_polynomial;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, Square, adjugate, product, skew, table};
use crate::algebra::{Arena, Polynomial, Rational};

use super::brackets::{Generator, bracket, generator_bracket};
use super::charts::{Chart, Coordinate, Momentum};

/// Coordinates of a chart and their rates under a Hamiltonian.
pub(super) struct Flow<'a, R> {
    pub(super) chart: &'a Chart,
    lift: &'a dyn Fn(&Polynomial) -> R,
    gradient: Vec<(Coordinate, R)>,
    sigma_dot: OnceCell<Square<R>>,
    sigma_hat_dot: OnceCell<Square<R>>,
    /// What moves the momenta alone, beside which nothing else moves.
    push: Option<Push<R>>,
}

/// Forces: the rates of the momenta at rest of the placement, all times one factor that does not vanish.
pub(super) struct Push<R> {
    /// On `p`.
    pub(super) p: Vec<R>,
    /// On `Pi`.
    pub(super) pi: Square<R>,
}

/// The value of a polynomial at one point modulo a prime, parameters included.
pub(super) fn at_a_point(arena: &Arena) -> impl Fn(&Polynomial) -> Residue {
    move |polynomial| {
        let value = evaluate_polynomial(arena, polynomial, &|name| Some(Residue::sample(name)));
        value.unwrap_or(Residue::UNKNOWN)
    }
}

impl<'a, R: Ring> Flow<'a, R> {
    /// The flow of `h`, its derivatives given, seen through `lift`.
    pub(super) fn new(
        chart: &'a Chart,
        gradient: &[(Coordinate, Polynomial)],
        lift: &'a dyn Fn(&Polynomial) -> R,
    ) -> Self {
        let gradient = gradient.iter().map(|(z, slope)| (*z, lift(slope))).collect();
        Self { chart, lift, gradient, sigma_dot: OnceCell::new(), sigma_hat_dot: OnceCell::new(), push: None }
    }

    /// The flow of forces alone, seen through `lift`.
    pub(super) fn vertical(chart: &'a Chart, push: Push<R>, lift: &'a dyn Fn(&Polynomial) -> R) -> Self {
        let flow = Self::new(chart, &[], lift);
        let phi = flow.phi();
        // Sigma = phi Pi and Sigma_hat = Pi phi at fixed phi.
        let sigma_dot = flow.projected(product(&phi, &push.pi));
        let sigma_hat_dot = flow.projected(product(&push.pi, &phi));
        Self { sigma_dot: sigma_dot.into(), sigma_hat_dot: sigma_hat_dot.into(), push: Some(push), ..flow }
    }

    fn value(&self, coordinate: Coordinate) -> R {
        (self.lift)(&Polynomial::atom(self.chart.symbol(coordinate)))
    }

    /// `sum over coordinates y of {f, y} dH/dy`.
    fn sum(&self, bracket: impl Fn(Coordinate) -> Polynomial) -> R {
        let mut sum = R::zero();
        for (y, slope) in &self.gradient {
            let fy = bracket(*y);
            if !fy.is_zero() {
                sum.plus_product(&(self.lift)(&fy), slope, &Rational::ONE);
            }
        }
        sum
    }

    fn rate(&self, z: Coordinate) -> R {
        self.sum(|y| bracket(self.chart, z, y))
    }

    fn table(&self, entry: impl Fn(usize, usize) -> R) -> Square<R> {
        table(self.chart.dim, entry)
    }

    pub(super) fn p(&self) -> Vec<R> {
        (0..self.chart.p.len()).map(|i| self.value(Coordinate::P(i))).collect()
    }

    pub(super) fn p_dot(&self) -> Vec<R> {
        if let Some(push) = &self.push {
            return push.p.clone();
        }
        (0..self.chart.p.len()).map(|i| self.rate(Coordinate::P(i))).collect()
    }

    fn phi(&self) -> Square<R> {
        self.table(|i, a| self.value(Coordinate::Phi(i, a)))
    }

    fn m(&self) -> Square<R> {
        self.table(|i, j| self.value(Coordinate::M(i, j)))
    }

    pub(super) fn m_dot(&self) -> Square<R> {
        self.projected(self.table(|i, j| self.rate(Coordinate::M(i, j))))
    }

    /// The rate of an affine spin, projected under a constraint.
    fn projected(&self, rate: Square<R>) -> Square<R> {
        match self.chart.confined {
            Some(group) => group.projected(&rate),
            None => rate,
        }
    }

    /// Rate of `Sigma`.
    pub(super) fn sigma_dot(&self) -> &Square<R> {
        let rate = |i, j| self.sum(|y| generator_bracket(self.chart, Generator::Space(i, j), y));
        self.sigma_dot.get_or_init(|| self.projected(self.table(rate)))
    }

    /// Rate of `Sigma_hat`.
    pub(super) fn sigma_hat_dot(&self) -> &Square<R> {
        let rate = |a, b| self.sum(|y| generator_bracket(self.chart, Generator::Body(a, b), y));
        self.sigma_hat_dot.get_or_init(|| self.projected(self.table(rate)))
    }

    /// `phi_dot^T p + phi^T p_dot`.
    pub(super) fn comoving_momentum_rate(&self) -> Vec<R> {
        let (p, p_dot) = (self.p(), self.p_dot());
        let rate = |a: usize| {
            let mut rate = R::zero();
            for i in 0..p.len() {
                rate.plus_product(&self.rate(Coordinate::Phi(i, a)), &p[i], &Rational::ONE);
                rate.plus_product(&self.value(Coordinate::Phi(i, a)), &p_dot[i], &Rational::ONE);
            }
            rate
        };
        (0..self.chart.dim).map(rate).collect()
    }

    /// Rate of `x p^T`.
    pub(super) fn orbital_rate(&self) -> Square<R> {
        let (p, p_dot) = (self.p(), self.p_dot());
        self.table(|i, j| {
            let mut rate = R::zero();
            if !p.is_empty() {
                rate.plus_product(&self.rate(Coordinate::X(i)), &p[j], &Rational::ONE);
                rate.plus_product(&self.value(Coordinate::X(i)), &p_dot[j], &Rational::ONE);
            }
            rate
        })
    }

    /// Rate of `Pi`, times `phi` on the side where that makes it a polynomial.
    pub(super) fn canonical_rate(&self) -> Square<R> {
        if let Some(push) = &self.push {
            return if self.chart.confined.is_some() {
                self.sigma_hat_dot().clone()
            } else {
                push.pi.clone()
            };
        }
        let slope = |a: usize, b: usize| {
            let found = self.gradient.iter().find(|(z, _)| *z == Coordinate::M(b, a));
            found.map_or_else(R::zero, |(_, slope)| slope.clone())
        };
        let velocity = || self.table(slope);
        let lost = match self.chart.momentum {
            // Pi_dot phi = d(Pi phi)/dt - Pi phi_dot = Sigma_hat_dot - Sigma_hat Omega_hat
            Momentum::Body => product(&self.m(), &velocity()),
            // phi Pi_dot = Sigma_dot - Omega Sigma
            Momentum::Space | Momentum::Total => product(&velocity(), &self.m()),
            Momentum::Canonical => return self.m_dot(),
        };
        let mut rate = self.m_dot();
        for (row, other) in rate.iter_mut().zip(&lost) {
            for (value, loss) in row.iter_mut().zip(other) {
                value.plus(loss, &Rational::MINUS_ONE);
            }
        }
        rate
    }

    /// The affine spin whose traces are the Casimirs, in whichever frame is at hand.
    pub(super) fn spin(&self) -> Square<R> {
        match self.chart.momentum {
            Momentum::Canonical => product(&self.phi(), &self.m()),
            _ => self.m(),
        }
    }

    /// Its rate.
    pub(super) fn spin_rate(&self) -> &Square<R> {
        match self.chart.momentum {
            Momentum::Body => self.sigma_hat_dot(),
            _ => self.sigma_dot(),
        }
    }

    /// `Sigma`, times `det phi` where the chart has `Sigma_hat`.
    pub(super) fn sigma_up_to_scale(&self) -> Square<R> {
        match self.chart.momentum {
            Momentum::Body => product(&product(&self.phi(), &self.m()), &adjugate(&self.phi())),
            _ => self.spin(),
        }
    }

    /// `Sigma_hat`, times `det phi` where the chart has `Sigma`.
    pub(super) fn sigma_hat_up_to_scale(&self) -> Square<R> {
        match self.chart.momentum {
            Momentum::Body => self.m(),
            Momentum::Canonical => product(&self.m(), &self.phi()),
            Momentum::Space | Momentum::Total => {
                product(&product(&adjugate(&self.phi()), &self.m()), &self.phi())
            }
        }
    }
}

/// Half the rate of the squared norm of the skew part.
pub(super) fn norm_rate<R: Ring>(m: &Square<R>, m_dot: &Square<R>) -> Vec<R> {
    let mut rate = R::zero();
    for (w, w_dot) in skew(m).iter().zip(&skew(m_dot)) {
        rate.plus_product(w, w_dot, &Rational::ONE);
    }
    vec![rate]
}

/// `tr(m^(k-1) m_dot)`, the rate of `tr m^k / k`.
pub(super) fn power_rate<R: Ring>(k: usize, m: &Square<R>, m_dot: &Square<R>) -> Vec<R> {
    let mut power = m_dot.clone();
    for _ in 1..k {
        power = product(m, &power);
    }
    let mut trace = R::zero();
    (0..m.len()).for_each(|a| trace.plus(&power[a][a], &Rational::ONE));
    vec![trace]
}

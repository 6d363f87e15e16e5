//! Potentials from their plain definition, and their gradients by forward-mode differentiation.
//!
//! A potential is a function of a [`Place`]. Its gradient is found one coordinate at a time, so that no chain rule is
//! written down for any of the measures of deformation.

use std::ops::Add;

use crate::differential::Differential;

/// Where a potential is evaluated: `(t, x, phi)`, and the measures of deformation by their definitions.
#[derive(Clone, Debug)]
pub struct Place {
    n: usize,
    t: Differential,
    x: Vec<Differential>,
    phi: Vec<Differential>,
}

impl Place {
    fn new(t: f64, x: &[f64], phi: &[f64]) -> Self {
        let plain = |numbers: &[f64]| numbers.iter().map(|&number| Differential::constant(number)).collect();
        Place { n: x.len(), t: Differential::constant(t), x: plain(x), phi: plain(phi) }
    }

    /// The dimension `n`.
    pub fn n(&self) -> f64 {
        self.n as f64
    }

    /// Time.
    pub fn t(&self) -> Differential {
        self.t
    }

    /// `x[i]`, counted from 1 as in the paper.
    pub fn x(&self, i: usize) -> Differential {
        self.x[i - 1]
    }

    /// `|x| = sqrt(sum_i x_i^2)`.
    pub fn distance(&self) -> Differential {
        self.x.iter().map(|&x| x * x).fold(Differential::constant(0.0), Add::add).sqrt()
    }

    /// `phi[i,A]`, counted from 1.
    pub fn phi(&self, i: usize, a: usize) -> Differential {
        self.phi[(i - 1) * self.n + a - 1]
    }

    /// `G[A,B] = sum_i phi[i,A] phi[i,B]`: the Green tensor `phi^T phi`.
    pub fn green(&self, a: usize, b: usize) -> Differential {
        self.sum(|i| self.phi(i, a) * self.phi(i, b))
    }

    /// `Ct[i,j] = sum_A phi[i,A] phi[j,A]`: the inverse Cauchy tensor `phi phi^T`.
    pub fn finger(&self, i: usize, j: usize) -> Differential {
        self.sum(|a| self.phi(i, a) * self.phi(j, a))
    }

    /// `tr G`.
    pub fn trace_green(&self) -> Differential {
        self.sum(|a| self.green(a, a))
    }

    /// `tr G^2`.
    pub fn trace_green_squared(&self) -> Differential {
        self.sum(|a| self.sum(|b| self.green(a, b) * self.green(b, a)))
    }

    /// `det phi`, by Leibniz's formula.
    pub fn det(&self) -> Differential {
        let phi = |i, a| self.phi(i, a);
        if self.n == 2 {
            return phi(1, 1) * phi(2, 2) - phi(1, 2) * phi(2, 1);
        }
        let turn = |i, j, k| phi(1, i) * phi(2, j) * phi(3, k);
        turn(1, 2, 3) + turn(2, 3, 1) + turn(3, 1, 2) - turn(1, 3, 2) - turn(2, 1, 3) - turn(3, 2, 1)
    }

    /// The mean log-stretch `q = ln(det phi)/n`.
    pub fn q(&self) -> Differential {
        self.det().ln() * self.n().recip()
    }

    fn sum(&self, term: impl Fn(usize) -> Differential) -> Differential {
        (1..=self.n).map(term).fold(Differential::constant(0.0), Add::add)
    }
}

/// A potential and its derivatives at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Slopes {
    /// `U`.
    pub value: f64,
    /// `dU/dt`.
    pub t: f64,
    /// `dU/dx[i]`.
    pub x: Vec<f64>,
    /// `dU/dphi[i][A]`, row-major; the force on `Pi` is its transpose with the sign changed.
    pub phi: Vec<f64>,
}

impl Slopes {
    /// Derivatives of `potential` at `(t, x, phi)`; `phi` row-major, of the dimension `x.len()`, 2 or 3.
    pub fn of(potential: &dyn Fn(&Place) -> Differential, t: f64, x: &[f64], phi: &[f64]) -> Self {
        let place = Place::new(t, x, phi);
        let along = |coordinate: &dyn Fn(&mut Place) -> &mut Differential| {
            let mut moved = place.clone();
            coordinate(&mut moved).slope = 1.0;
            potential(&moved).slope
        };
        Slopes {
            value: potential(&place).value,
            t: along(&|place| &mut place.t),
            x: (0..x.len()).map(|i| along(&move |place| &mut place.x[i])).collect(),
            phi: (0..phi.len()).map(|k| along(&move |place| &mut place.phi[k])).collect(),
        }
    }
}

//! `x . Ct x = |y|^2` with the position pulled back to the body, `y = phi^T x`: energies of tides and of gravity gradients are
//! functions of it, and their forces `c x y^T` and `c phi y` need none of the entries of `Ct`.

use crate::algebra::ring::upper;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::symbol::Quantity;

use super::base::{Along, Base};

/// The vectors and the number of an energy that has the entries of `Ct` in `x . Ct x` alone.
pub(super) struct PulledBack {
    /// `x`.
    x: Vec<Expr>,
    /// `y = phi^T x`.
    y: Vec<Expr>,
    /// `Ct x = phi y`.
    pushed: Vec<Expr>,
    /// `|y|^2`.
    square: Expr,
    /// `2 dU/d(x . Ct x)`, with the number that slopes by entries of `Ct` carry.
    pub(super) slope: Polynomial,
}

impl PulledBack {
    /// Finds it in the slopes of a potential: by `Ct_ij`, `i <= j`, they are then multiples of `x_i x_j`.
    pub(super) fn of(arena: &mut Arena, chart: &Chart, slopes: &[(Base, Polynomial)]) -> Option<Self> {
        let n = chart.dim;
        let x = chart.x.clone();
        let first = *x.first()?;
        let by = |i: usize, j: usize| {
            slopes.iter().find(|(base, _)| *base == Base::Finger(i, j)).map(|(_, slope)| slope)
        };
        let slope = by(0, 0)?.over(&[first; 2])?;
        for (i, j) in upper(n) {
            let number = Rational::from(if i == j { 1 } else { 2 });
            if *by(i, j)? != slope.mul(&Polynomial::term(vec![x[i], x[j]], number)) {
                return None;
            }
        }
        let [y, pushed] = [Quantity::PulledBack, Quantity::PushedForward].map(|of| arena.components(of, n));
        let slope = slope.scaled(&Rational::from(2));
        Some(Self { x, y, pushed, square: arena.symbol(Quantity::PulledBackSquare), slope })
    }

    /// The polynomial through these quantities instead of the entries of `Ct`.
    pub(super) fn through(&self, arena: &mut Arena, form: &Polynomial) -> Polynomial {
        let mut square = Polynomial::zero();
        let mut names = Vec::new();
        for (i, x) in self.x.iter().enumerate() {
            let row = self.pushed_forward(arena, i);
            square.add_product(&Polynomial::atom(*x), &row, &Rational::ONE);
            names.push((Polynomial::atom(self.pushed[i]), row));
        }
        // The rows stand in the square.
        names.insert(0, (Polynomial::atom(self.square), square));
        form.by_names(&names)
    }

    /// `(Ct x)_i`.
    fn pushed_forward(&self, arena: &mut Arena, i: usize) -> Polynomial {
        self.x
            .iter()
            .enumerate()
            .map(|(j, x)| Polynomial::monomial([Base::Finger(i, j).symbol(arena), *x]))
            .sum()
    }

    /// What the quantities stand for.
    pub(super) fn definitions(&self, chart: &Chart) -> Vec<(Expr, Polynomial)> {
        let product = |left: Expr, right: Expr| Polynomial::monomial([left, right]);
        let sum = |terms: &mut dyn Iterator<Item = Polynomial>| terms.sum();
        let phi = &chart.phi.0;
        let n = chart.dim;
        let mut list = Vec::new();
        for a in 0..n {
            list.push((self.y[a], sum(&mut (0..n).map(|i| product(phi[i][a], self.x[i])))));
        }
        for i in 0..n {
            list.push((self.pushed[i], sum(&mut (0..n).map(|a| product(phi[i][a], self.y[a])))));
        }
        list.push((self.square, sum(&mut self.y.iter().map(|y| product(*y, *y)))));
        list
    }

    /// Half of the derivative of `x . Ct x` along the group, as the vectors of whose entries it has the products.
    pub(super) fn direction(&self, along: Along) -> [&[Expr]; 2] {
        match along {
            Along::Body => [&self.y, &self.y],
            Along::Space => [&self.pushed, &self.x],
            // Indices of `Pi_Ai`.
            Along::Placement => [&self.y, &self.x],
        }
    }
}

//! `x . Ct x = |y|^2` with the position pulled back to the body, `y = phi^T x`: energies of tides and of gravity gradients are
//! functions of it, and their forces `c x y^T` and `c phi y` need none of the entries of `Ct`.

use crate::algebra::ring::{dot, times, transpose, upper};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::metric::Definitions;
use crate::symbol::{Frame, Quantity};

use super::base::Base;
use super::tensors::symbols;

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
        let x = Polynomial::vector(&self.x);
        let rows = times(&symbols(arena, x.len(), Base::Finger, false), &x);
        // The rows stand in the square.
        let mut names = vec![(Polynomial::atom(self.square), dot(x.iter().zip(&rows)))];
        names.extend(Polynomial::vector(&self.pushed).into_iter().zip(rows));
        form.by_names(&names)
    }

    /// What the quantities stand for.
    pub(super) fn definitions(&self, chart: &Chart) -> Definitions {
        let (phi, x, y) = (chart.placement(), Polynomial::vector(&self.x), Polynomial::vector(&self.y));
        let mut list: Definitions = self.y.iter().copied().zip(times(&transpose(&phi), &x)).collect();
        list.extend(self.pushed.iter().copied().zip(times(&phi, &y)));
        list.push((self.square, dot(y.iter().zip(&y))));
        list
    }

    /// Half of the derivative of `x . Ct x` along the group, as the vectors of whose entries it has the products.
    pub(super) fn direction(&self, along: Frame) -> [&[Expr]; 2] {
        match along {
            Frame::Body => [&self.y, &self.y],
            Frame::Space => [&self.pushed, &self.x],
            // Indices of `Pi_Ai`.
            Frame::Flat => [&self.y, &self.x],
        }
    }
}

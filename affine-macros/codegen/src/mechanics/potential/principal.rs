//! Stretches and principal axes: `phi R = L diag(Q)`, `L` and `R` rotations.

use crate::algebra::kernel::{Callee, Group};
use crate::algebra::ring::{Ring, Square, table};
use crate::algebra::{Arena, Expr, Function, Kernel, Matrix, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::symbol::Quantity;

use super::Base;
use super::base::Along;

/// Products of the entries of principal axes, in which the derivatives of log-stretches are written: with column `k` of `R`
/// and of `L` written `R_k` and `L_k`, `dq_k = R_k . Oh R_k = L_k . Om L_k`.
pub(super) struct Principal<R> {
    /// `R_Ak R_Bk`, an array for each `k`.
    body: Vec<Square<R>>,
    /// `Q_k^2 L_ik L_jk`.
    space: Vec<Square<R>>,
    /// `Q_k L_ik R_Ak`.
    placement: Vec<Square<R>>,
}

impl Principal<Polynomial> {
    /// Through what the kernel returns: `R`, and `W = phi R` with `L_k = W_k/Q_k`.
    pub(super) fn new(arena: &mut Arena, n: usize) -> Self {
        let [axis, stretched] =
            [Quantity::Axis, Quantity::StretchedAxis].map(|of| Matrix::symbols(arena, of, n).0);
        let product = |factors: Vec<Expr>| Polynomial::monomial(factors);
        let each = |entry: &dyn Fn(usize, usize, usize) -> Vec<Expr>| {
            (0..n).map(|k| table(n, |a, b| product(entry(k, a, b)))).collect()
        };
        Self {
            body: each(&|k, a, b| vec![axis[a][k], axis[b][k]]),
            space: each(&|k, i, j| vec![stretched[i][k], stretched[j][k]]),
            placement: each(&|k, i, a| vec![stretched[i][k], axis[a][k]]),
        }
    }
}

impl<R: Ring> Principal<R> {
    /// With values for the components of axes of which only their length is known: `R_nk^2 = 1 - R_1k^2 - ...`, so that
    /// traces are exact. `L` is as good as `R` for what depends on one of them.
    pub(super) fn on_unit_axes(n: usize, component: impl Fn(usize, usize) -> R) -> Self {
        let axes = |k: usize| {
            let mut products = table(n, |a, b| {
                let mut product = R::zero();
                product.plus_product(&component(a, k), &component(b, k), &Rational::ONE);
                product
            });
            let mut last = R::number(&Rational::ONE);
            (0..n - 1).for_each(|a| last.plus(&products[a][a], &Rational::MINUS_ONE));
            products[n - 1][n - 1] = last;
            products
        };
        let body: Vec<_> = (0..n).map(axes).collect();
        Self { space: body.clone(), body, placement: Vec::new() }
    }

    /// Derivative of `q_k`, times `Q_k^2` unless it is along the body.
    pub(super) fn direction(&self, k: usize, along: Along, a: usize, b: usize) -> R {
        match along {
            Along::Body => self.body[k][a][b].clone(),
            Along::Space => self.space[k][a][b].clone(),
            Along::Placement => self.placement[k][a][b].clone(),
        }
    }
}

/// The kernel, and what else follows from it: `1/Q_k` and `q_k = ln Q_k`, or `q_k` as it `counts` from the undeformed state.
pub(super) fn computed(arena: &mut Arena, chart: &Chart, counts: bool) -> (Kernel, Vec<(Expr, Polynomial)>) {
    let n = chart.dim;
    let [stretched, axes] =
        [Quantity::StretchedAxis, Quantity::Axis].map(|of| Matrix::symbols(arena, of, n).0);
    let stretches: Vec<Expr> = (0..n).map(|k| stretch(arena, k)).collect();
    let logarithms: Vec<Expr> = (0..n).map(|k| Base::LogStretch(k).symbol(arena)).collect();
    let mut results = vec![Group::Vector(stretches.clone()), Group::Matrix(stretched), Group::Matrix(axes)];
    if counts {
        results.insert(1, Group::Vector(logarithms.clone()));
    }
    let kernel = Kernel {
        callee: if counts { Callee::LogStretches } else { Callee::Stretches },
        arguments: vec![Group::Matrix(chart.placement())],
        results,
    };
    let mut shared = Vec::new();
    for (k, (stretch, logarithm)) in stretches.into_iter().zip(logarithms).enumerate() {
        let reciprocal = arena.reciprocal(stretch);
        shared.push((inverse_stretch(arena, k), Polynomial::atom(reciprocal)));
        if !counts {
            let value = arena.apply(Function::Ln, stretch);
            shared.push((logarithm, Polynomial::atom(value)));
        }
    }
    (kernel, shared)
}

/// `Q_k`
pub(super) fn stretch(arena: &mut Arena, k: usize) -> Expr {
    arena.symbol(Quantity::Stretches.at([k + 1]))
}

/// `1/Q_k`
pub(super) fn inverse_stretch(arena: &mut Arena, k: usize) -> Expr {
    arena.symbol(Quantity::InverseStretch.at([k + 1]))
}

/// `1/Q_k^2`
pub(super) fn inverse_square(arena: &mut Arena, k: usize) -> Polynomial {
    let inverse = inverse_stretch(arena, k);
    Polynomial::monomial([inverse, inverse])
}

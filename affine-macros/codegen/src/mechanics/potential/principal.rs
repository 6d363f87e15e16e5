//! Stretches and principal axes: `phi R = L diag(Q)`, `L` and `R` rotations.

use crate::algebra::kernel::{Callee, Group};
use crate::algebra::ring::{Ring, Square, dot, table};
use crate::algebra::{Arena, Expr, Function, Kernel, Matrix, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::metric::Definitions;
use crate::symbol::{Frame, Quantity};

use super::base::log_stretches;

/// Products of the entries of principal axes, in which the derivatives of log-stretches are written: with column `k` of `R`
/// and of `L` written `R_k` and `L_k`, `dq_k = R_k . Oh R_k = L_k . Om L_k`.
pub(super) struct Principal<R> {
    /// `R_Ak R_Bk`, `Q_k^2 L_ik L_jk` and `Q_k L_ik R_Ak`, for each frame an array for each `k`.
    products: [Vec<Square<R>>; 3],
}

impl Principal<Polynomial> {
    /// Through what the kernel returns: `R`, and `W = phi R` with `L_k = W_k/Q_k`.
    pub(super) fn new(arena: &mut Arena, n: usize) -> Self {
        let [axis, stretched] =
            [Quantity::Axis, Quantity::StretchedAxis].map(|of| Matrix::symbols(arena, of, n).0);
        let pairs = [(&axis, &axis), (&stretched, &stretched), (&stretched, &axis)];
        let products = pairs.map(|(left, right)| {
            (0..n).map(|k| table(n, |a, b| Polynomial::monomial([left[a][k], right[b][k]]))).collect()
        });
        Self { products }
    }
}

impl<R: Ring> Principal<R> {
    /// With values for the components of axes of which only their length is known: `R_nk^2 = 1 - R_1k^2 - ...`, so that
    /// traces are exact. `L` is as good as `R` for what depends on one of them.
    pub(super) fn on_unit_axes(n: usize, component: impl Fn(usize, usize) -> R) -> Self {
        let axes = |k: usize| {
            let mut products = table(n, |a, b| dot([(&component(a, k), &component(b, k))]));
            let mut last = R::number(&Rational::ONE);
            (0..n - 1).for_each(|a| last.plus(&products[a][a], &Rational::MINUS_ONE));
            products[n - 1][n - 1] = last;
            products
        };
        let body: Vec<_> = (0..n).map(axes).collect();
        Self { products: [body.clone(), body, Vec::new()] }
    }

    /// Derivative of `q_k`, times `Q_k^2` unless it is along the body.
    pub(super) fn direction(&self, k: usize, along: Frame, a: usize, b: usize) -> R {
        self.products[along as usize][k][a][b].clone()
    }
}

/// The kernel, and what else follows from it: `1/Q_k` and `q_k = ln Q_k`, or `q_k` as it `counts` from the undeformed state.
pub(super) fn computed(arena: &mut Arena, chart: &Chart, counts: bool) -> (Kernel, Definitions) {
    let n = chart.dim;
    let [stretched, axes] =
        [Quantity::StretchedAxis, Quantity::Axis].map(|of| Matrix::symbols(arena, of, n).0);
    let stretches = arena.components(Quantity::Stretches, n);
    let logarithms = log_stretches(arena, n);
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

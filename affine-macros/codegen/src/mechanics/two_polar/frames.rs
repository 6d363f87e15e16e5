//! The frames `L` and `R` beside the lattice: `dL/dt = L chi_hat`, `dR/dt = R theta_hat`.

use crate::algebra::ring::above_diagonal;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::symbol::Quantity;

/// Symbols of the frames: an angle each in the plane, the entries of `L` and `R` in space.
#[derive(Clone, Debug)]
pub struct Frames {
    dim: usize,
    /// Of `L`.
    pub left: Vec<Expr>,
    /// Of `R`.
    pub right: Vec<Expr>,
}

impl Frames {
    /// The symbols for `n` stretches.
    pub fn new(arena: &mut Arena, dim: usize) -> Self {
        let mut of = |rotation: Quantity, angle: Quantity| -> Vec<Expr> {
            match dim {
                2 => vec![arena.symbol(angle)],
                _ => Matrix::symbols(arena, rotation, dim).0.concat(),
            }
        };
        Self {
            dim,
            left: of(Quantity::LeftRotation, Quantity::LeftAngle),
            right: of(Quantity::RightRotation, Quantity::RightAngle),
        }
    }

    /// All of them, `L` first.
    pub fn symbols(&self) -> Vec<Expr> {
        [&self.left[..], &self.right].concat()
    }

    /// Rate of component `k` of a frame from `chi_hat_ab` or `theta_hat_ab`, `a < b`: entry `k` of `L chi_hat`, or of the
    /// angle `w`, where `L^T dL/dt = [[0, -1], [1, 0]] dw/dt`.
    pub fn rate(&self, frame: &[Expr], angular: &[Polynomial], k: usize) -> Polynomial {
        let mut sum = Polynomial::zero();
        if self.dim == 2 {
            sum.add_scaled(&angular[0], &Rational::MINUS_ONE);
            return sum;
        }
        let (row, column) = (k / self.dim, k % self.dim);
        let pairs = above_diagonal(self.dim);
        for ((a, b), value) in pairs.zip(angular) {
            // chi_hat_ab = value = -chi_hat_ba
            if column == b {
                let entry = Polynomial::atom(frame[row * self.dim + a]);
                sum.add_product(&entry, value, &Rational::ONE);
            }
            if column == a {
                let entry = Polynomial::atom(frame[row * self.dim + b]);
                sum.add_product(&entry, value, &Rational::MINUS_ONE);
            }
        }
        sum
    }
}

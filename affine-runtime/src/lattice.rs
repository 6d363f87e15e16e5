//! The two-polar form `phi = L D R^T` of doubly isotropic models: a lattice of stretches (section 6 of the paper).
//!
//! ```text
//! D = diag(exp(q_a)),  L, R in SO(n),  dL/dt = L chi_hat,  dR/dt = R theta_hat
//! rho_hat = L^T S L,  tau_hat = -R^T Vort R,  M = -rho_hat - tau_hat,  N = rho_hat - tau_hat
//! Z_aa = p_a,  Z_ab = (N_ab/ch x_ab - M_ab/sh x_ab)/4,  x_ab = (q_a - q_b)/2,  C(k) = tr Z^k          (6.1)
//! ```
//!
//! `(q, p, M, N)` move by themselves: particles on a line that `M` keeps apart and `N` draws together, like those of
//! the hyperbolic Sutherland system. For `n = 2` both are constants; for `n = 3` they move, also where `N = 0`: the paper's
//! family of constant equal `M_ab` is not invariant, since `dM_12/dt = M_13 M_32 (w_32 - w_13)` with
//! `w_ab = 1/(8 alpha sh^2 x_ab)` vanishes for three different stretches only with one of the couplings.
//! What is printed as `V = tau` there is `Vort = -tau`.
//!
//! Where two stretches coincide the equations have a pole although the motion has none: see [`LatticeFlow`].

mod circle;
mod classify;
mod confinement;
pub(crate) mod conversion;
mod flow;
mod interval;
pub(crate) mod pieces;
mod ratios;

pub use circle::CircleFlow;
pub use classify::{Growth, MotionClass};
pub use confinement::Dilatation;
pub(crate) use conversion::{lattice_of, placement_and_spin};
pub use flow::{LatticeFlow, LatticeStop, StopReason};
pub use pieces::{LatticePieces, LatticeSplitting};
pub use ratios::RatioForm;

use core::fmt::Debug;

use crate::decompose::TwoPolar;
use crate::error::Result;
use crate::frames::{Matrix, Vector};
use crate::model::{Formula, Group, Model, Operations, StateVector};
use crate::scalar::{Real, Scalar};

/// A phase point in two-polar variables. `q` and `p` are conjugate, also for d'Alembert's model, whose equations are
/// in `Q_a = exp(q_a)` and `P_a = p_a/Q_a`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice<const N: usize> {
    /// `q_a`, logarithms of the stretches.
    pub q: Vector<N>,
    /// `p_a`, conjugate to `q_a`; their sum is `tr Sigma`.
    pub p: Vector<N>,
    /// `M`, skew; keeps stretches apart.
    pub m: Matrix<N>,
    /// `N`, skew; draws stretches together.
    pub n: Matrix<N>,
    /// `L` in SO(n).
    pub left: Matrix<N>,
    /// `R` in SO(n).
    pub right: Matrix<N>,
}

/// What is written on the diagonal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variables {
    /// `q_a` and `p_a`.
    LogStretches,
    /// `Q_a = exp(q_a)` and `P_a = p_a/Q_a`.
    Stretches,
    /// Angles `q_a` of `D = diag(exp(i q_a))`, and `p_a`: U(n).
    Angles,
}

/// What a potential on the lattice depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PotentialClass {
    /// There is no potential.
    None,
    /// `q = ln(det phi)/n` alone: the shear moves as without it.
    Dilatation,
    /// All stretches.
    Stretches,
}

/// What was derived about a lattice; made by the macro alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatticeDescription {
    /// What the places are.
    pub variables: Variables,
    /// What the potential depends on.
    pub potential: PotentialClass,
    /// The Hamiltonian.
    pub hamiltonian: Formula,
    /// The equations.
    pub equations: &'static [Formula],
    /// Components of the state.
    pub state: &'static [Group],
    /// Components of the state with frames.
    pub framed: &'static [Group],
    /// Operations of the equations.
    pub operations: Operations,
}

/// The Hamiltonian and the equations of a lattice, over plain arrays.
///
/// The state is `q_a, p_a` (or `Q_a, P_a`), for `n = 3` followed by `M_12, M_13, M_23, N_12, N_13, N_23`; for `n = 2`
/// these are the couplings `M_12, N_12`, which do not move. With frames, the angles of `L` and `R` follow for `n = 2`, their
/// entries row by row for `n = 3`. Nothing overflows for `q_1 >= .. >= q_n`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no two-polar form in dimension {N}",
    label = "no lattice here",
    note = "add `emit(two_polar)` to the `#[affine_model(...)]` of a doubly isotropic model"
)]
pub trait LatticeForm<const N: usize> {
    /// What was derived.
    const LATTICE: LatticeDescription;

    /// The state.
    type Places<T: Scalar>: StateVector<T>;
    /// The state with frames.
    type Framed<T: Scalar>: StateVector<T>;
    /// Couplings that do not move.
    type Couplings<T: Scalar>: StateVector<T>;

    /// `H(q, p, M, N)`.
    fn lattice_hamiltonian<T: Real>(&self, couplings: &Self::Couplings<T>, state: &Self::Places<T>) -> T;
    /// The time derivative of the state.
    fn lattice_equations<T: Scalar>(
        &self,
        couplings: &Self::Couplings<T>,
        state: &Self::Places<T>,
    ) -> Self::Places<T>;
    /// The time derivative of state and frames.
    fn framed_equations<T: Scalar>(
        &self,
        couplings: &Self::Couplings<T>,
        state: &Self::Framed<T>,
    ) -> Self::Framed<T>;
}

/// A model with a two-polar form: conversions between phase points and the lattice.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no conversions between phase points and a lattice",
    label = "no lattice of phase points here",
    note = "add `emit(two_polar)` to the `#[affine_model(...)]` of a doubly isotropic model; the lattice on the circle of \
            `group = unitary` has no phase points"
)]
pub trait TwoPolarForm<const N: usize>: Model<N> + LatticeForm<N> {
    /// The lattice of a phase point, stretches in descending order.
    ///
    /// # Errors
    /// [`Error::Placement`](crate::Error::Placement) where the stretches cannot be told from zero.
    fn lattice(&self, point: &Self::Point<f64>) -> Result<Lattice<N>>;
    /// The lattice of a phase point of the same motion a little later, with labels and frames nearest to those before.
    ///
    /// # Errors
    /// Those of [`lattice`](Self::lattice).
    fn lattice_after(&self, point: &Self::Point<f64>, before: &Lattice<N>) -> Result<Lattice<N>>;
    /// The phase point of a lattice. A centre of mass moves freely beside it: here it is at rest at the origin.
    ///
    /// # Errors
    /// [`Error::CoincidentStretches`](crate::Error::CoincidentStretches) where two `q_a` are equal;
    /// [`Error::Placement`](crate::Error::Placement), [`Error::NotFinite`](crate::Error::NotFinite) where the entries
    /// of `phi` or of the momentum leave the range of doubles.
    fn at_lattice(&self, lattice: &Lattice<N>) -> Result<Self::Point<f64>>;
    /// The coefficients of the kinetic Hamiltonian; `None` for d'Alembert's model.
    fn isotropic(&self) -> Option<Isotropic>;
}

/// `H = C(2)/(2 alpha) + C(1)^2/(2 beta) + |W|^2/(2 mu)`, (4.24), `W` the vorticity or the spin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isotropic {
    /// `1/alpha = 1/(I + A)`.
    pub inverse_alpha: f64,
    /// `1/beta = -B/((I + A)(I + A + nB))`.
    pub inverse_beta: f64,
    /// `1/mu = I/(I^2 - A^2)`.
    pub inverse_mu: f64,
    /// Where the model is metrical.
    pub side: MetricSide,
}

/// Where a model is metrical: `W` is the vorticity or the spin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MetricSide {
    /// In the body.
    Body,
    /// In space.
    Space,
}

impl<const N: usize> Lattice<N> {
    /// `L`, `Q_a`, `R`.
    #[must_use]
    pub fn two_polar(&self) -> TwoPolar<N> {
        TwoPolar { left: self.left, stretches: self.q.map(libm::exp), right: self.right }
    }

    /// `x_ab = (q_a - q_b)/2`.
    fn half_difference(&self, a: usize, b: usize) -> f64 {
        0.5 * (self.q[a] - self.q[b])
    }

    /// `rho_hat = (N - M)/2 = L^T S L`.
    #[must_use]
    pub fn spin(&self) -> Matrix<N> {
        (self.n - self.m) * 0.5
    }

    /// `tau_hat = -(N + M)/2 = -R^T Vort R`.
    #[must_use]
    pub fn minus_vorticity(&self) -> Matrix<N> {
        (self.n + self.m) * -0.5
    }

    /// `Z`, similar to `Sigma`: `C(k) = tr Z^k` (6.1). Not finite where two `q_a` are equal.
    #[must_use]
    pub fn z(&self) -> Matrix<N> {
        Matrix::from_fn(|a, b| {
            if a == b {
                return self.p[a];
            }
            let x = self.half_difference(a, b);
            0.25 * (self.n[(a, b)] / libm::cosh(x) - self.m[(a, b)] / libm::sinh(x))
        })
    }

    /// The least distance of two `q_a`.
    #[must_use]
    pub fn gap(&self) -> f64 {
        let pairs = (0..N).flat_map(|a| (0..a).map(move |b| (a, b)));
        pairs.map(|(a, b)| (self.q[a] - self.q[b]).abs()).fold(f64::INFINITY, f64::min)
    }

    /// The same point in other labels: `(L W, W^T q, W^T p, W^T M W, W^T N W, R W)` for a signed permutation `W`.
    #[must_use]
    pub fn relabelled(&self, w: &Matrix<N>) -> Self {
        let moved = |v: &Vector<N>| w.component_mul(w).tr_mul(v);
        let turned = |x: &Matrix<N>| w.tr_mul(x) * w;
        Self {
            q: moved(&self.q),
            p: moved(&self.p),
            m: turned(&self.m),
            n: turned(&self.n),
            left: self.left * w,
            right: self.right * w,
        }
    }

    /// A signed permutation of determinant 1 that puts the stretches in descending order.
    fn descending(&self) -> Matrix<N> {
        let mut order: [usize; N] = core::array::from_fn(|a| a);
        let mut odd = false;
        for a in 1..N {
            for b in (0..a).rev() {
                if self.q[order[b + 1]] > self.q[order[b]] {
                    order.swap(b, b + 1);
                    odd = !odd;
                }
            }
        }
        let mut w = Matrix::<N>::zeros();
        for (a, from) in order.into_iter().enumerate() {
            w[(from, a)] = if odd && a == 0 { -1.0 } else { 1.0 };
        }
        w
    }
}

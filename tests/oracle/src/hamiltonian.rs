//! A Hamiltonian on the momentum side, as a function of the canonical coordinates, and its vector field.

use num_bigint::BigInt;
use num_rational::BigRational;

use crate::error::Error;
use crate::matrix::Matrix;
use crate::motion::Expected;
use crate::observable::Observable;
use crate::ring::{Ring, rational, rounded};
use crate::state::State;

/// A term of a Hamiltonian, with `Sigma = phi Pi`, `Sigma_hat = Pi phi`.
#[derive(Clone, Debug)]
pub enum Invariant {
    /// `a/2 tr Sigma^2`.
    Casimir2(BigRational),
    /// `b/2 (tr Sigma)^2`.
    Casimir1Squared(BigRational),
    /// `c/2 |Vort|^2`, `Vort = Sigma_hat - Sigma_hat^T`, `|W|^2` the sum over `a < b` of `W_ab^2`.
    VorticitySquared(BigRational),
    /// `c/2 |S|^2`, `S = Sigma - Sigma^T`.
    SpinSquared(BigRational),
    /// `d/3 tr Sigma^3`.
    Casimir3(BigRational),
    /// `k/2 |phi^T p|^2`.
    BodyTranslation(BigRational),
    /// `k/2 |p|^2`.
    SpaceTranslation(BigRational),
    /// `1/2 p^T phi M phi^T p`.
    BodyTranslationMetric(Matrix),
    /// `1/2 p^T M p`.
    SpaceTranslationMetric(Matrix),
}

impl Invariant {
    fn energy<R: Ring>(&self, state: &State<R>) -> Matrix<R> {
        let State { phi, p, pi, .. } = state;
        let sigma = || phi * pi;
        let half = |value: Matrix<R>, c: &BigRational| value.scaled(c).scaled(&rational(1, 2));
        // -tr(W^2)/2 of a skew matrix.
        let squared = |w: Matrix<R>| (&w * &w).trace().scaled(&rational(-1, 2));
        let length = |v: Matrix<R>| &v.transpose() * &v;
        let form = |v: Matrix<R>, m: &Matrix| &v.transpose() * &(&Matrix::constant(m) * &v);
        let one = rational(1, 1);
        match self {
            Invariant::Casimir2(a) => half((&sigma() * &sigma()).trace(), a),
            Invariant::Casimir1Squared(b) => half(&sigma().trace() * &sigma().trace(), b),
            Invariant::VorticitySquared(c) => half(squared((pi * phi).skew()), c),
            Invariant::SpinSquared(c) => half(squared(sigma().skew()), c),
            Invariant::Casimir3(d) => {
                let cube = &(&sigma() * &sigma()) * &sigma();
                cube.trace().scaled(d).scaled(&rational(1, 3))
            }
            Invariant::BodyTranslation(k) => half(length(&phi.transpose() * p), k),
            Invariant::SpaceTranslation(k) => half(length(p.clone()), k),
            Invariant::BodyTranslationMetric(m) => half(form(&phi.transpose() * p, m), &one),
            Invariant::SpaceTranslationMetric(m) => half(form(p.clone(), m), &one),
        }
    }
}

/// A sum of terms.
#[derive(Clone, Debug)]
pub struct Hamiltonian {
    terms: Vec<Invariant>,
}

impl Hamiltonian {
    /// The sum.
    pub fn new(terms: Vec<Invariant>) -> Self {
        Hamiltonian { terms }
    }

    /// `H` at a point, as a `1 x 1` matrix.
    pub fn energy<R: Ring>(&self, state: &State<R>) -> Matrix<R> {
        self.terms.iter().fold(Matrix::zeros(1, 1), |sum, term| &sum + &term.energy(state))
    }

    /// The canonical vector field `x_dot = dH/dp`, `phi_dot[i][A] = dH/dPi[A][i]`, `p_dot = -dH/dx = 0`,
    /// `Pi_dot[A][i] = -dH/dphi[i][A]`, each derivative by dual numbers through `H`.
    pub fn rate(&self, state: &State) -> State {
        let n = state.dimension();
        let still = State {
            x: Matrix::zeros(n, 1),
            phi: Matrix::zeros(n, n),
            p: Matrix::zeros(n, 1),
            pi: Matrix::zeros(n, n),
        };
        let slope = |tangent: State| self.energy(&state.along(&tangent)).slope();
        let of_p = |i| slope(State { p: Matrix::identity(n).rows(i, 1).transpose(), ..still.clone() });
        let of_pi = |i, a| slope(State { pi: Matrix::unit(n, a, i), ..still.clone() });
        let of_phi = |a, i| slope(State { phi: Matrix::unit(n, i, a), ..still.clone() });
        let entries = |entries: Vec<Matrix>| -> Vec<BigRational> {
            entries.iter().map(|slope| slope.entry(0, 0)).collect()
        };
        let places = || (0..n * n).map(|k| (k / n, k % n));
        let phi_dot = entries(places().map(|(i, a)| of_pi(i, a)).collect());
        let pi_dot = entries(places().map(|(a, i)| of_phi(a, i)).collect());
        State {
            x: Matrix::from_rationals(n, 1, &entries((0..n).map(of_p).collect())),
            phi: Matrix::from_rationals(n, n, &phi_dot),
            p: Matrix::zeros(n, 1),
            pi: Matrix::from_rationals(n, n, &pi_dot).scaled(&rational(-1, 1)),
        }
    }

    /// `{F, H}` as the derivative of `F` along the vector field.
    pub fn bracket(&self, observable: Observable, state: &State) -> Matrix {
        let moving = state.along(&self.rate(state));
        observable.of_state(&moving).unwrap_or_else(|| self.energy(&moving)).slope()
    }

    /// Energy and derivatives at a point, each correctly rounded from the exact value.
    ///
    /// # Errors
    /// As [`State::new`].
    pub fn expected(&self, state: &State) -> Result<Expected, Error> {
        let state = &state.clone().checked()?;
        let rate = self.rate(state);
        let bracket = |observable| self.bracket(observable, state).to_f64();
        Ok(Expected {
            hamiltonian: rounded(&self.energy::<BigInt>(state).entry(0, 0)),
            x_dot: rate.x.to_f64(),
            phi_dot: rate.phi.to_f64(),
            p_dot: rate.p.to_f64(),
            pi_dot: rate.pi.to_f64(),
            sigma_dot: bracket(Observable::AffineSpin),
            sigma_hat_dot: bracket(Observable::ComovingAffineSpin),
            p_hat_dot: bracket(Observable::ComovingLinearMomentum),
        })
    }
}

//! The kinetic energy on the velocity side, and what follows from it by linear algebra alone.

use nalgebra::DMatrix;
use num_bigint::BigInt;
use num_rational::BigRational;

use crate::error::Error;
use crate::linear::Signature;
use crate::matrix::Matrix;
use crate::ring::{Ring, rational};
use crate::state::{State, check, inverse};

/// A term of the kinetic energy, with `Oh = phi^-1 phi_dot` and `Om = phi_dot phi^-1`.
///
/// `J` is `n x n`, `K` is `n^2 x n^2` with the rows and columns numbered `(A, B) -> n A + B`.
#[derive(Clone, Debug)]
pub enum Term {
    /// `A/2 tr Om^2`.
    Casimir2(BigRational),
    /// `B/2 (tr Om)^2`.
    Casimir1Squared(BigRational),
    /// `1/2 tr(Oh J Oh^T)`.
    BodyInertia(Matrix),
    /// `1/2 tr(Om J Om^T)`.
    SpaceInertia(Matrix),
    /// `m/2 |phi^-1 x_dot|^2`.
    BodyTranslation(BigRational),
    /// `m/2 |x_dot|^2`.
    SpaceTranslation(BigRational),
    /// `1/2 v^T M v`, `v = phi^-1 x_dot`.
    BodyTranslationMetric(Matrix),
    /// `1/2 x_dot^T M x_dot`.
    SpaceTranslationMetric(Matrix),
    /// `1/2 tr(phi_dot J phi_dot^T)`.
    DAlembert(Matrix),
    /// `1/2 K[nA+B][nC+D] Oh[A][B] Oh[C][D]`.
    BodyTensor(Matrix),
    /// `1/2 K[nA+B][nC+D] Om[A][B] Om[C][D]`.
    SpaceTensor(Matrix),
    /// `1/2 K[nA+B][nC+D] phi_dot[A][B] phi_dot[C][D]`.
    FlatTensor(Matrix),
}

impl Term {
    /// [`Term::BodyInertia`] with `J = I 1`.
    pub fn body_inertia(n: usize, i: BigRational) -> Self {
        Term::BodyInertia(Matrix::identity(n).scaled(&i))
    }

    /// [`Term::SpaceInertia`] with `J = I 1`.
    pub fn space_inertia(n: usize, i: BigRational) -> Self {
        Term::SpaceInertia(Matrix::identity(n).scaled(&i))
    }

    /// [`Term::DAlembert`] with `J = I 1`.
    pub fn dalembert(n: usize, i: BigRational) -> Self {
        Term::DAlembert(Matrix::identity(n).scaled(&i))
    }

    fn is_translational(&self) -> bool {
        matches!(
            self,
            Term::BodyTranslation(_)
                | Term::SpaceTranslation(_)
                | Term::BodyTranslationMetric(_)
                | Term::SpaceTranslationMetric(_)
        )
    }

    fn check(&self, n: usize) -> Result<(), Error> {
        match self {
            Term::BodyInertia(j) | Term::SpaceInertia(j) | Term::DAlembert(j) => check("J", j, (n, n)),
            Term::BodyTranslationMetric(m) | Term::SpaceTranslationMetric(m) => check("M", m, (n, n)),
            Term::BodyTensor(k) | Term::SpaceTensor(k) | Term::FlatTensor(k) => check("K", k, (n * n, n * n)),
            Term::Casimir2(_)
            | Term::Casimir1Squared(_)
            | Term::BodyTranslation(_)
            | Term::SpaceTranslation(_) => Ok(()),
        }
    }

    fn energy<R: Ring>(&self, velocity: &Velocities<R>) -> Matrix<R> {
        let Velocities { x_dot, v_hat, phi_dot, body, space } = velocity;
        let twice = match self {
            Term::Casimir2(a) => (body * body).trace().scaled(a),
            Term::Casimir1Squared(b) => (&body.trace() * &body.trace()).scaled(b),
            Term::BodyInertia(j) => quadratic(body, j),
            Term::SpaceInertia(j) => quadratic(space, j),
            Term::BodyTranslation(m) => (&v_hat.transpose() * v_hat).scaled(m),
            Term::SpaceTranslation(m) => (&x_dot.transpose() * x_dot).scaled(m),
            Term::BodyTranslationMetric(m) => &v_hat.transpose() * &(&Matrix::constant(m) * v_hat),
            Term::SpaceTranslationMetric(m) => &x_dot.transpose() * &(&Matrix::constant(m) * x_dot),
            Term::DAlembert(j) => quadratic(phi_dot, j),
            Term::BodyTensor(k) => contracted(body, k),
            Term::SpaceTensor(k) => contracted(space, k),
            Term::FlatTensor(k) => contracted(phi_dot, k),
        };
        twice.scaled(&rational(1, 2))
    }
}

/// `tr(O J O^T)`.
fn quadratic<R: Ring>(o: &Matrix<R>, j: &Matrix) -> Matrix<R> {
    (&(o * &Matrix::constant(j)) * &o.transpose()).trace()
}

/// `K[nA+B][nC+D] O[A][B] O[C][D]`.
fn contracted<R: Ring>(o: &Matrix<R>, k: &Matrix) -> Matrix<R> {
    let column = o.clone().reshaped(k.shape().0, 1);
    &column.transpose() * &(&Matrix::constant(k) * &column)
}

/// Velocities in every frame that a term may use.
struct Velocities<R> {
    x_dot: Matrix<R>,
    v_hat: Matrix<R>,
    phi_dot: Matrix<R>,
    body: Matrix<R>,
    space: Matrix<R>,
}

impl<R: Ring> Velocities<R> {
    fn new(phi_inverse: &Matrix<R>, x_dot: &Matrix<R>, phi_dot: &Matrix<R>) -> Self {
        Velocities {
            v_hat: phi_inverse * x_dot,
            body: phi_inverse * phi_dot,
            space: phi_dot * phi_inverse,
            x_dot: x_dot.clone(),
            phi_dot: phi_dot.clone(),
        }
    }
}

/// A kinetic energy: a sum of terms in dimension `n`.
#[derive(Clone, Debug)]
pub struct Kinetic {
    n: usize,
    terms: Vec<Term>,
}

impl Kinetic {
    /// The sum of `terms` in dimension `n`.
    ///
    /// # Errors
    /// [`Error::Dimension`], and [`Error::Shape`] for a `J` or `K` that does not fit.
    pub fn new(n: usize, terms: Vec<Term>) -> Result<Self, Error> {
        if !(2..=3).contains(&n) {
            return Err(Error::Dimension(n));
        }
        terms.iter().try_for_each(|term| term.check(n))?;
        Ok(Kinetic { n, terms })
    }

    /// The dimension `n`.
    pub fn dimension(&self) -> usize {
        self.n
    }

    /// A term contains `x_dot`. Without one the body is pinned: `x`, `p` are no variables.
    pub fn has_translation(&self) -> bool {
        self.terms.iter().any(Term::is_translational)
    }

    /// `T(phi; x_dot, phi_dot)`, as a `1 x 1` matrix.
    ///
    /// # Errors
    /// [`Error::Shape`], [`Error::SingularPlacement`].
    pub fn energy<R: Ring>(
        &self,
        phi: &Matrix<R>,
        x_dot: &Matrix<R>,
        phi_dot: &Matrix<R>,
    ) -> Result<Matrix<R>, Error> {
        check("phi", phi, (self.n, self.n))?;
        check("x_dot", x_dot, (self.n, 1))?;
        check("phi_dot", phi_dot, (self.n, self.n))?;
        Ok(self.sum(&inverse(phi)?, x_dot, phi_dot))
    }

    fn sum<R: Ring>(&self, phi_inverse: &Matrix<R>, x_dot: &Matrix<R>, phi_dot: &Matrix<R>) -> Matrix<R> {
        let velocity = Velocities::new(phi_inverse, x_dot, phi_dot);
        self.terms.iter().fold(Matrix::zeros(1, 1), |sum, term| &sum + &term.energy(&velocity))
    }

    /// The mass matrix, `T = v^T M v/2`, by polarisation: `M_ij = T(e_i + e_j) - T(e_i) - T(e_j)`.
    ///
    /// The coordinates of `v` are `x_dot` (with translation only), then `phi_dot` row-major.
    ///
    /// # Errors
    /// [`Error::Shape`], [`Error::SingularPlacement`].
    pub fn mass_matrix<R: Ring>(&self, phi: &Matrix<R>) -> Result<Matrix<R>, Error> {
        check("phi", phi, (self.n, self.n))?;
        let phi_inverse = inverse(phi)?;
        let size = self.degrees_of_freedom();
        let along = |i: usize, j: usize| {
            let mut v = vec![BigInt::from(0); size];
            v[i] += 1;
            v[j] += 1;
            let v = Matrix::new(size, 1, v, BigInt::from(1));
            let (x_dot, phi_dot) = self.split(&Matrix::constant(&v));
            self.sum(&phi_inverse, &x_dot, &phi_dot)
        };
        // Along e_i + e_i stands 4 T(e_i).
        let squares: Vec<_> = (0..size).map(|i| along(i, i).scaled(&rational(1, 4))).collect();
        let mut entries: Vec<Matrix<R>> = Vec::with_capacity(size * size);
        for i in 0..size {
            for j in 0..size {
                entries.push(if j < i {
                    entries[j * size + i].clone()
                } else {
                    &(&along(i, j) - &squares[i]) - &squares[j]
                });
            }
        }
        Ok(Matrix::collected(size, size, &entries.iter().collect::<Vec<_>>()))
    }

    /// The signature of the mass matrix; by Sylvester's law the same at every `phi` for invariant energies.
    ///
    /// # Errors
    /// As [`Kinetic::mass_matrix`].
    pub fn signature(&self, phi: &Matrix) -> Result<Signature, Error> {
        Ok(self.mass_matrix(phi)?.signature())
    }

    /// The largest over the smallest |eigenvalue| of the mass matrix at `phi`, in floating point: an estimate of how
    /// far rounding errors of the Legendre transformation are amplified.
    ///
    /// # Errors
    /// As [`Kinetic::mass_matrix`].
    pub fn condition(&self, phi: &Matrix) -> Result<f64, Error> {
        let mass = self.mass_matrix(phi)?;
        let size = mass.shape().0;
        let eigenvalues = DMatrix::from_row_slice(size, size, &mass.to_f64()).symmetric_eigenvalues().abs();
        Ok(eigenvalues.max() / eigenvalues.min())
    }

    /// The Legendre transformation `P = M v`.
    ///
    /// # Errors
    /// [`Error::Shape`], [`Error::SingularPlacement`].
    pub fn legendre(
        &self,
        x: &Matrix,
        phi: &Matrix,
        x_dot: &Matrix,
        phi_dot: &Matrix,
    ) -> Result<State, Error> {
        let momentum = &self.mass_matrix(phi)? * &self.joined(x_dot, phi_dot);
        let (p, pi) = self.split(&momentum);
        State::new(x.clone(), phi.clone(), p, pi.transpose())
    }

    /// The velocities `v = M^-1 P`, as `(x_dot, phi_dot)`.
    ///
    /// # Errors
    /// [`Error::Shape`], [`Error::SingularPlacement`], [`Error::SingularMass`],
    /// [`Error::MomentumWithoutTranslation`].
    pub fn velocity<R: Ring>(&self, state: &State<R>) -> Result<(Matrix<R>, Matrix<R>), Error> {
        let (_, velocity) = self.conjugates(state)?;
        Ok(self.split(&velocity))
    }

    /// The Hamiltonian `H = P^T M^-1 P/2`, as a `1 x 1` matrix.
    ///
    /// # Errors
    /// As [`Kinetic::velocity`].
    pub fn hamiltonian<R: Ring>(&self, state: &State<R>) -> Result<Matrix<R>, Error> {
        let (momentum, velocity) = self.conjugates(state)?;
        Ok((&momentum.transpose() * &velocity).scaled(&rational(1, 2)))
    }

    /// Number of velocities.
    fn degrees_of_freedom(&self) -> usize {
        self.n * self.n + if self.has_translation() { self.n } else { 0 }
    }

    /// `P` and `v = M^-1 P` in the coordinates of the mass matrix.
    fn conjugates<R: Ring>(&self, state: &State<R>) -> Result<(Matrix<R>, Matrix<R>), Error> {
        check("phi", &state.phi, (self.n, self.n))?;
        let state = state.clone().checked()?;
        let momentum = self.joined(&state.p, &state.pi.transpose());
        if !self.has_translation() && !state.p.is_zero() {
            return Err(Error::MomentumWithoutTranslation);
        }
        let velocity = R::solve(&self.mass_matrix(&state.phi)?, &momentum).ok_or(Error::SingularMass)?;
        Ok((momentum, velocity))
    }

    pub(crate) fn joined<R: Ring>(&self, vector: &Matrix<R>, matrix: &Matrix<R>) -> Matrix<R> {
        let column = matrix.clone().reshaped(self.n * self.n, 1);
        if self.has_translation() { vector.above(&column) } else { column }
    }

    pub(crate) fn split<R: Ring>(&self, column: &Matrix<R>) -> (Matrix<R>, Matrix<R>) {
        let square = self.n * self.n;
        let vector = if self.has_translation() { column.rows(0, self.n) } else { Matrix::zeros(self.n, 1) };
        let matrix = column.rows(column.shape().0 - square, square).reshaped(self.n, self.n);
        (vector, matrix)
    }
}

//! One-parameter groups of symmetries, and those that a model is proved to have.

use nalgebra::DVector;
use num_traits::Zero;

use super::error::AnalysisError;
use super::linear::{Column, from_columns, solved};

use crate::dual::{Dual, fixed};
use crate::frames::{Matrix, Vector};
use crate::inner::projected;
use crate::metrics::Bases;
use crate::model::{Conserved, Entry, Model, Quantity, StateVector};
use crate::scalar::Real;
use crate::state::Phase;

/// Relative distance of a generator from those of symmetries that rounding leaves.
const ROUNDING: f64 = 1e-12;

/// The generator of `phi -> exp(t xi) phi exp(t eta)`, `x -> exp(t xi') x + t c`, in orthonormal bases.
///
/// Its momentum is `J = tr(Sigma xi) + tr(Sigma_hat eta) + p.(xi' x + c)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Generator<const N: usize> {
    /// `xi`, which acts on the placement in space.
    pub space: Matrix<N>,
    /// `xi'`, which acts on the position; `xi` where space turns as a whole.
    pub orbit: Matrix<N>,
    /// `eta`, which acts on the placement in the body.
    pub body: Matrix<N>,
    /// `c`.
    pub drift: Vector<N>,
}

impl<const N: usize> Generator<N> {
    /// What moves nothing.
    #[must_use]
    pub fn zero() -> Self {
        let zero = Matrix::<N>::zeros();
        Self { space: zero, orbit: zero, body: zero, drift: Vector::<N>::zeros() }
    }

    /// Space turns from axis `i` to axis `j`, numbered from 1; the momentum is the `ij` entry of the total angular momentum,
    /// `S_ij` of a body without translation. Axes that there are not turn nothing.
    #[must_use]
    pub fn rotation(i: usize, j: usize) -> Self {
        let turn = skew(i, j);
        Self { space: turn, orbit: turn, ..Self::zero() }
    }

    /// The body turns: the momentum is the `ij` entry of the vorticity.
    #[must_use]
    pub fn vorticity(i: usize, j: usize) -> Self {
        Self { body: skew(i, j), ..Self::zero() }
    }

    /// Space moves along axis `i`, numbered from 1: the momentum is `p_i`.
    #[must_use]
    pub fn translation(i: usize) -> Self {
        Self { drift: Vector::<N>::from_fn(|k, _| f64::from(u8::from(k + 1 == i))), ..Self::zero() }
    }

    /// `self + factor other`.
    #[must_use]
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        Self {
            space: self.space + other.space * factor,
            orbit: self.orbit + other.orbit * factor,
            body: self.body + other.body * factor,
            drift: self.drift + other.drift * factor,
        }
    }

    /// The sum of multiples of generators.
    pub(super) fn sum<'a>(terms: impl IntoIterator<Item = (f64, &'a Self)>) -> Self {
        terms.into_iter().fold(Self::zero(), |sum, (factor, generator)| sum.plus(factor, generator))
    }

    /// The bracket of the fields of two generators, which is that of matrices in space and its negative in the body.
    pub(super) fn bracket(&self, other: &Self) -> Self {
        Self {
            space: self.space * other.space - other.space * self.space,
            orbit: self.orbit * other.orbit - other.orbit * self.orbit,
            body: other.body * self.body - self.body * other.body,
            drift: self.orbit * other.drift - other.orbit * self.drift,
        }
    }

    /// Its components. Multiples of the identity do the same to `phi` from either side, and are taken in space.
    pub(super) fn components(&self) -> Column {
        let one = Matrix::<N>::identity();
        let mean = self.body.trace() / N as f64;
        let (space, body) = (self.space + one * mean, self.body - one * mean);
        let all = space.iter().chain(body.iter()).chain(self.orbit.iter()).chain(self.drift.iter());
        DVector::from_iterator(3 * N * N + N, all.copied())
    }

    /// That of components.
    pub(super) fn of(components: &[f64]) -> Self {
        let matrix = |k: usize| Matrix::<N>::from_fn(|i, j| components[k * N * N + j * N + i]);
        let drift = Vector::<N>::from_fn(|i, _| components[3 * N * N + i]);
        Self { space: matrix(0), body: matrix(1), orbit: matrix(2), drift }
    }

    /// The momentum `J` of a point.
    pub(super) fn momentum<M: Model<N>, T: Real>(&self, model: &M, point: &M::Point<T>) -> T {
        let point = model.orthonormal(point);
        let over = |matrix: &Matrix<N>| matrix.map(|entry| T::constant(entry, 0.0));
        let drift = self.drift.map(|entry| T::constant(entry, 0.0));
        (point.sigma().0.0 * over(&self.space)).trace()
            + (point.sigma_hat().0.0 * over(&self.body)).trace()
            + point.p().dot(&(over(&self.orbit) * point.x() + drift))
    }

    /// The field of the group over the plain array.
    pub(super) fn field<M: Model<N>, T: Real>(&self, model: &M, full: &M::Full<T>) -> M::Full<T> {
        let over = |matrix: &Matrix<N>| matrix.map(|entry| T::constant(entry, 0.0));
        let (space, orbit, body) = (over(&self.space), over(&self.orbit), over(&self.body));
        let drift = self.drift.map(|entry| T::constant(entry, 0.0));
        let point = model.orthonormal(&model.unflatten(full));
        let (phi, x, p) = (*point.phi(), point.x(), point.p());
        let (spin, spin_rate) = if has::<N, M>(Quantity::CanonicalMomentum) {
            let pi = point.pi().0.0;
            (pi, -(pi * space + body * pi))
        } else if has::<N, M>(Quantity::AffineSpin) {
            let sigma = point.sigma().0.0;
            (sigma, space * sigma - sigma * space)
        } else {
            let sigma_hat = point.sigma_hat().0.0;
            (sigma_hat, sigma_hat * body - body * sigma_hat)
        };
        let values = [phi.as_slice(), spin.as_slice(), x.as_slice(), p.as_slice()].concat();
        let (of_phi, of_x, of_p) = (space * phi + phi * body, orbit * x + drift, -(orbit.transpose() * p));
        let rates = [of_phi.as_slice(), spin_rate.as_slice(), of_x.as_slice(), of_p.as_slice()].concat();
        let mut entries = values.into_iter().zip(rates).map(|(value, slope)| Dual { value, slope });
        let varied: M::Full<Dual<T>> = fixed(full.as_ref());
        let varied = model.orthonormal(&model.unflatten(&varied));
        let moved = varied.with_entries(&mut || entries.next().unwrap_or_else(Dual::zero));
        let moved = <M::Point<Dual<T>>>::from_orthonormal(&moved, &bases(model).over());
        let mut rates = M::Full::<T>::zeros();
        let moved = model.flatten(&moved);
        rates.as_mut().iter_mut().zip(moved.as_ref()).for_each(|(rate, both)| *rate = both.slope);
        rates
    }
}

/// Bases in which the metrics are the identity.
pub(super) fn bases<const N: usize, M: Model<N>>(model: &M) -> Bases<N> {
    let one = Matrix::<N>::identity();
    model.bases().unwrap_or_else(|| Bases::of_factors((one, one), (one, one)))
}

/// A quantity stands in the plain array.
fn has<const N: usize, M: Model<N>>(quantity: Quantity) -> bool {
    M::DESCRIPTION.full.iter().any(|group| group.quantity == quantity)
}

/// `E_ji - E_ij`, numbered from 1.
fn skew<const N: usize>(i: usize, j: usize) -> Matrix<N> {
    unit(j, i) - unit(i, j)
}

/// `E_ij`, numbered from 1.
fn unit<const N: usize>(i: usize, j: usize) -> Matrix<N> {
    Matrix::<N>::from_fn(|row, column| f64::from(u8::from((row + 1, column + 1) == (i, j))))
}

/// What turns and moves space, the body and its centre.
pub(super) fn isometries<const N: usize, M: Model<N>>() -> Vec<Generator<N>> {
    use Conserved::{LinearMomentum, OrbitalAngularMomentum, Spin, Vorticity};
    let whole = [LinearMomentum, OrbitalAngularMomentum, Spin, Vorticity];
    let all = whole.into_iter().flat_map(|quantity| generators(quantity, None));
    all.map(|generator| confined::<N, M>(&generator)).collect()
}

/// The algebra of the symmetries that the energy is proved to have, as far as they move points linearly: a basis.
pub(super) fn symmetries<const N: usize, M: Model<N>>(model: &M) -> Vec<Generator<N>> {
    let mut basis: Vec<Generator<N>> = Vec::new();
    let bases = model.bases();
    let listed = M::DESCRIPTION.conserved.iter();
    for generator in listed.flat_map(|quantity| generators(*quantity, bases.as_ref())) {
        let generator = confined::<N, M>(&generator);
        if assert_symmetry(&basis, &generator).is_err() {
            basis.push(generator);
        }
    }
    basis
}

/// Checks that a generator is one of symmetries.
pub(super) fn assert_symmetry<const N: usize>(
    basis: &[Generator<N>],
    generator: &Generator<N>,
) -> Result<(), AnalysisError> {
    let components = generator.components();
    let span = from_columns(components.len(), &basis.iter().map(Generator::components).collect::<Vec<_>>());
    let rest = &components - &span * solved(&span, &components)?;
    let defect = rest.norm() / components.norm();
    let is_one = components.norm() == 0.0 || defect <= ROUNDING;
    is_one.then_some(()).ok_or(AnalysisError::NotASymmetry { defect })
}

/// What leaves the group to which the motion is confined is left out, and what moves a centre of mass that the model has not.
pub(super) fn confined<const N: usize, M: Model<N>>(generator: &Generator<N>) -> Generator<N> {
    let kept = |matrix: &Matrix<N>| {
        M::DESCRIPTION.constraint.map_or(*matrix, |constraint| projected(constraint, matrix))
    };
    let (space, body) = (kept(&generator.space), kept(&generator.body));
    match has::<N, M>(Quantity::Position) {
        true => Generator { space, body, ..*generator },
        false => Generator { space, body, ..Generator::zero() },
    }
}

/// The generators whose momenta a quantity consists of; `bases` are those that the entries of a component stand in.
fn generators<const N: usize>(quantity: Conserved, bases: Option<&Bases<N>>) -> Vec<Generator<N>> {
    if let Conserved::Component(component) = quantity {
        let add = |sum: Generator<N>, entry: &Entry| {
            let (row, column) = if entry.of == Conserved::LinearMomentum {
                (entry.row, 1)
            } else {
                (entry.row, entry.column)
            };
            let one = generator_of(entry.of, row, column);
            let one = one.map(|one| bases.map_or(one, |bases| in_orthonormal(entry.of, &one, bases)));
            one.map_or(sum, |one| sum.plus(entry.factor as f64, &one))
        };
        return vec![component.entries.iter().fold(Generator::zero(), add)];
    }
    let all = (1..=N).flat_map(|row| (1..=N).map(move |column| (row, column)));
    all.filter_map(|(row, column)| generator_of(quantity, row, column)).collect()
}

/// The generator in orthonormal bases of an entry that a momentum has in others: `tr(m' X')` is `tr(m X)` with `m = A^-1 m' A`,
/// `m = A^T m' A` where both indices are lowered, `m = B^-1 m' B` and `m = B^-1 m' B^-T` where both are raised.
fn in_orthonormal<const N: usize>(of: Conserved, one: &Generator<N>, bases: &Bases<N>) -> Generator<N> {
    use Conserved::{OrbitalAngularMomentum, Spin, TotalAngularMomentum, Vorticity};
    let (a, b) = (&bases.space, &bases.body);
    let is_turn = matches!(of, OrbitalAngularMomentum | TotalAngularMomentum | Spin | Vorticity);
    let (right, left) = match is_turn {
        true => (a.transpose(), bases.body_inverse.transpose()),
        false => (bases.space_inverse, *b),
    };
    Generator {
        space: a * one.space * right,
        orbit: a * one.orbit * right,
        body: left * one.body * bases.body_inverse,
        drift: a * one.drift,
    }
}

/// The generator of an entry of a momentum.
fn generator_of<const N: usize>(quantity: Conserved, row: usize, column: usize) -> Option<Generator<N>> {
    let one = Generator::<N>::zero();
    let (full, turn) = (unit::<N>(column, row), skew::<N>(row, column));
    let mean = if row == column { Matrix::<N>::identity() / N as f64 } else { Matrix::<N>::zeros() };
    Some(match quantity {
        Conserved::LinearMomentum => Generator { drift: Generator::<N>::translation(row).drift, ..one },
        Conserved::OrbitalAngularMomentum => Generator { orbit: turn, ..one },
        Conserved::TotalAngularMomentum => Generator { space: turn, orbit: turn, ..one },
        Conserved::TotalAffineMomentum => Generator { space: full, orbit: full, ..one },
        Conserved::Spin => Generator { space: turn, ..one },
        Conserved::AffineSpin => Generator { space: full, ..one },
        Conserved::Deviator => Generator { space: full - mean, ..one },
        Conserved::Vorticity => Generator { body: turn, ..one },
        Conserved::ComovingAffineSpin => Generator { body: full, ..one },
        Conserved::ComovingDeviator => Generator { body: full - mean, ..one },
        Conserved::Casimir1 => Generator { space: mean, ..one },
        _ => return None,
    })
}

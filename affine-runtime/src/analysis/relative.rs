//! Equilibria and relative equilibria: points at which the motion is that of a group of symmetries.

use nalgebra::{DMatrix, DVector};

use super::error::AnalysisError;
use super::field::{
    Kinds, confinement, full, linear_motion, motion, normals, orbit, symplectic_form, vector,
};
use super::generator::{Generator, assert_symmetry, confined, symmetries};
use super::jacobian::JacobianMatrix;
use super::linear::{Column, Dense, RANK, absolute_kernel, kernel, solved, span};
use super::newton::{Equations, FLOOR, solve};
use super::symmetry::equivariances;
use crate::inner::LogDeterminant;
use crate::model::Model;
use crate::state::Phase;

/// Singular values at a solution that are none, relative to the largest.
pub(super) const DEGENERATE: f64 = 1e-8;

/// What is asked of a relative equilibrium, by the place of a generator in the list of those that are free, from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Condition {
    /// The velocity of a generator: the factor with which it stands in `zeta`.
    Velocity(usize, f64),
    /// The value of its momentum map.
    MomentumMap(usize, f64),
}

impl Condition {
    /// Checks that it is one of so many generators.
    fn assert_among(&self, generators: usize) -> Result<(), AnalysisError> {
        let (Self::Velocity(generator, value) | Self::MomentumMap(generator, value)) = *self;
        match generator < generators && value.is_finite() {
            true => Ok(()),
            false => Err(AnalysisError::Condition { generator, generators, value }),
        }
    }
}

/// A point of rest, or one through which the motion is `exp(t zeta)`.
#[derive(Clone, Debug, PartialEq)]
pub struct RelativeEquilibrium<const N: usize, P> {
    /// The phase point.
    pub point: P,
    /// The generator of the motion; zero at rest.
    pub zeta: Generator<N>,
    /// The velocity of each generator that was free.
    pub velocities: Vec<f64>,
    /// Norm of the equations that are solved: `X_H - X_zeta`, constraints and conditions.
    pub residual: f64,
    /// Steps of Newton's iteration.
    pub steps: usize,
    /// Directions in which solutions go on to first order, along orbits of symmetries not counted.
    pub kernel: usize,
    /// Velocities that no condition fixes: as many directions are expected.
    pub expected: usize,
}

impl<const N: usize, P> RelativeEquilibrium<N, P> {
    /// Itself, where it is the only one near, or where only the velocities that are left open lead away.
    ///
    /// # Errors
    /// [`AnalysisError::Degenerate`] at a bifurcation point, of which the place is known to few digits, and within a family.
    pub fn isolated(self) -> Result<Self, AnalysisError> {
        let Self { kernel, expected, .. } = self;
        if kernel <= expected { Ok(self) } else { Err(AnalysisError::Degenerate { kernel, expected }) }
    }
}

/// A point of rest near a guess, `X_H = 0`: one near it, where symmetries make families of them.
///
/// ```
/// use affine_runtime::analysis::equilibrium;
/// use affine_runtime::prelude::*;
///
/// #[affine_model(dim = 3, kinetic(dalembert = 1), potential = neo_hookean(0.5) + 5*q^2)]
/// struct Ball;
///
/// let guess = Ball.at_velocity(Matrix::<3>::identity() * 1.1, Matrix::<3>::zeros())?;
/// let rest = equilibrium(&Ball, &guess)?;
/// assert!((rest.point.phi() - Matrix::<3>::identity()).norm() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`AnalysisError`].
pub fn equilibrium<const N: usize, M: Model<N>>(
    model: &M,
    guess: &M::Point<f64>,
) -> Result<RelativeEquilibrium<N, M::Point<f64>>, AnalysisError> {
    relative_equilibrium(model, guess, &[], &[])
}

/// A relative equilibrium near a guess: `X_H = X_zeta`, where `zeta` is a sum of multiples of the generators, under conditions.
///
/// The generators are those of symmetries that the energy is proved to have, [`Description::conserved`]. What the conditions
/// leave open stays near the guess; the velocities begin at those that move the guess most like its motion does.
///
/// [`Description::conserved`]: crate::model::Description::conserved
///
/// # Errors
/// [`AnalysisError`].
pub fn relative_equilibrium<const N: usize, M: Model<N>>(
    model: &M,
    guess: &M::Point<f64>,
    generators: &[Generator<N>],
    conditions: &[Condition],
) -> Result<RelativeEquilibrium<N, M::Point<f64>>, AnalysisError> {
    let basis = symmetries(model);
    let generators = &generators.iter().map(confined::<N, M>).collect::<Vec<_>>();
    generators.iter().try_for_each(|generator| assert_symmetry(&basis, generator))?;
    conditions.iter().try_for_each(|condition| condition.assert_among(generators.len()))?;
    let z = vector(&model.flatten(guess));
    assert_timeless(model, guess)?;
    let velocities = solved(&orbit(model, generators, &z), &motion(model, &z))?;
    let problem = Problem { model, generators, conditions };
    let start = DVector::from_iterator(z.len() + velocities.len(), z.iter().chain(&velocities).copied());
    let solution = solve(start, FLOOR, |unknowns| problem.equations(unknowns))?;
    Ok(problem.relative_equilibrium(&solution.at, solution.steps))
}

/// Checks that the equations do not contain the time.
pub(super) fn assert_timeless<const N: usize, M: Model<N>>(
    model: &M,
    point: &M::Point<f64>,
) -> Result<(), AnalysisError> {
    let is_timeless = !JacobianMatrix::of(model, 0.0, point).contains_time();
    is_timeless.then_some(()).ok_or(AnalysisError::DependsOnTime)
}

/// An orthonormal basis of the directions in which solutions go on, without those of symmetries: the kernel of a Jacobian by the
/// plain array, first, and by what else there is.
pub(super) fn free<const N: usize, M: Model<N>>(model: &M, z: &Column, jacobian: &Dense, rank: f64) -> Dense {
    let slopes = jacobian.view((0, 0), (z.len(), z.len())).into_owned();
    let moved = orbit(model, &equivariances(model, z, &slopes), z).resize_vertically(jacobian.ncols(), 0.0);
    let threshold = rank * jacobian.norm() * (1.0 + moved.norm());
    let along = &moved * absolute_kernel(&(jacobian * &moved), threshold);
    let along = span(&along, rank * (z.norm() + moved.norm()));
    let all = kernel(jacobian, rank);
    &all * absolute_kernel(&along.tr_mul(&all), 0.5)
}

/// The equations of a relative equilibrium in `(z, velocities)`.
pub(super) struct Problem<'a, const N: usize, M> {
    pub(super) model: &'a M,
    pub(super) generators: &'a [Generator<N>],
    pub(super) conditions: &'a [Condition],
}

impl<const N: usize, M: Model<N>> Problem<'_, N, M> {
    fn split(&self, unknowns: &Column) -> (Column, Vec<f64>) {
        let components = unknowns.len() - self.generators.len();
        (unknowns.rows(0, components).into_owned(), unknowns.iter().skip(components).copied().collect())
    }

    pub(super) fn zeta(&self, velocities: &[f64]) -> Generator<N> {
        Generator::sum(velocities.iter().copied().zip(self.generators))
    }

    /// `X_H - X_zeta`, the constraints of the model, the conditions. `None` where `det phi <= 0`.
    pub(super) fn values(&self, unknowns: &Column) -> Option<Column> {
        let (z, velocities) = self.split(unknowns);
        let point = self.model.unflatten(&full::<N, M>(&z));
        if !LogDeterminant::of(point.phi()).is_positive() {
            return None;
        }
        let field = self.zeta(&velocities).field(self.model, &full::<N, M>(&z));
        let unmoved = motion(self.model, &z) - vector(&field);
        let mut values: Vec<f64> = unmoved.iter().copied().chain(confinement(self.model, &z)).collect();
        for condition in self.conditions {
            values.push(match *condition {
                Condition::Velocity(k, value) => velocities.get(k)? - value,
                Condition::MomentumMap(k, value) => {
                    self.generators.get(k)?.momentum(self.model, &point) - value
                }
            });
        }
        Some(DVector::from_vec(values))
    }

    /// These with their derivatives.
    pub(super) fn equations(&self, unknowns: &Column) -> Option<Equations> {
        let (model, values, (z, velocities)) = (self.model, self.values(unknowns)?, self.split(unknowns));
        let fields = orbit(model, self.generators, &z);
        let slopes = linear_motion(model, &self.zeta(&velocities), &z);
        let normals = normals(model, &z);
        let (own, first) = (z.len(), z.len() + normals.nrows());
        let mut jacobian = DMatrix::zeros(values.len(), unknowns.len());
        jacobian.view_mut((0, 0), (own, own)).copy_from(&slopes);
        jacobian.view_mut((0, own), fields.shape()).copy_from(&-&fields);
        jacobian.view_mut((own, 0), normals.shape()).copy_from(&normals);
        for (k, condition) in self.conditions.iter().enumerate() {
            match *condition {
                Condition::Velocity(generator, _) => jacobian[(first + k, own + generator)] = 1.0,
                Condition::MomentumMap(generator, _) => {
                    let slope = fields.column(generator).transpose() * symplectic_form(model, &z);
                    jacobian.view_mut((first + k, 0), (1, own)).copy_from(&slope);
                }
            }
        }
        let size = motion(model, &z).norm() + slopes.norm() * z.norm() + values.norm();
        let scale = self.scale(&jacobian, (unknowns, &values));
        Some(Equations { values, jacobian, size: size.max(f64::MIN_POSITIVE), scale })
    }

    /// What each value is a difference of. Places and momenta may be in any units: how large momenta are that are not zero
    /// follows from the places, the masses and the stiffnesses.
    fn scale(&self, jacobian: &Dense, (unknowns, values): (&Column, &Column)) -> Column {
        let kinds = Kinds::of::<N, M>();
        let ([by_mass, stiffness], momentum) = (kinds.slopes(jacobian), kinds.momentum(jacobian));
        let rate = momentum.map_or(1.0, |_| stiffness.sqrt() * by_mass.sqrt());
        let (momentum, kinds) = (momentum.unwrap_or(1.0), [kinds.places, kinds.momenta]);
        let own = kinds.each_ref().map(|kind| unknowns.select_rows(kind).norm());
        let mut sizes = unknowns.map(|value| value.abs().max(rate));
        kinds[0].iter().for_each(|k| sizes[*k] = own[0].max(own[1] / momentum));
        kinds[1].iter().for_each(|k| sizes[*k] = own[1].max(own[0] * momentum));
        let mut scale = values.abs() + jacobian.abs() * sizes;
        for kind in &kinds {
            let size = scale.select_rows(kind).norm();
            kind.iter().for_each(|k| scale[*k] = size);
        }
        scale
    }

    pub(super) fn relative_equilibrium(
        &self,
        at: &Column,
        steps: usize,
    ) -> RelativeEquilibrium<N, M::Point<f64>> {
        let (z, velocities) = self.split(at);
        let (residual, kernel) = self.equations(at).map_or((f64::NAN, 0), |own| {
            (own.values.norm(), free(self.model, &z, &own.jacobian, DEGENERATE).ncols())
        });
        RelativeEquilibrium {
            kernel,
            expected: self.generators.len().saturating_sub(self.conditions.len()),
            point: self.model.unflatten(&full::<N, M>(&z)),
            zeta: self.zeta(&velocities),
            velocities,
            residual,
            steps,
        }
    }
}

/// A point with what its linearised motion is made of.
pub(super) struct Linearised<const N: usize> {
    pub(super) symmetries: Vec<Generator<N>>,
    /// An orthonormal basis of the directions in which the constraint lets points go, over the plain array.
    pub(super) basis: Dense,
    /// `D(X_H - X_zeta)` in the basis.
    pub(super) motion: Dense,
    /// The symplectic form in the basis.
    pub(super) form: Dense,
    /// Fields of the symmetries in the basis.
    pub(super) orbit: Dense,
    /// Those of all symmetries of the equations.
    pub(super) moved: Dense,
    /// The size of the point.
    pub(super) size: f64,
}

impl<const N: usize> Linearised<N> {
    pub(super) fn at<M: Model<N>>(model: &M, zeta: &Generator<N>, point: &M::Point<f64>) -> Self {
        let z = vector(&model.flatten(point));
        let symmetries = symmetries(model);
        let basis = kernel(&normals(model, &z), RANK);
        let slopes = linear_motion(model, zeta, &z);
        let form = symplectic_form(model, &z);
        let fields = |symmetries: &[Generator<N>]| basis.tr_mul(&orbit(model, symmetries, &z));
        Self {
            orbit: fields(&symmetries),
            size: z.norm(),
            moved: fields(&equivariances(model, &z, &slopes)),
            motion: basis.tr_mul(&slopes) * &basis,
            form: basis.tr_mul(&form) * &basis,
            symmetries,
            basis,
        }
    }

    /// `D2(H - J_zeta)(u, v) = omega(A u, v)`, as it comes: symmetric where the motion is Hamiltonian.
    pub(super) fn second_variation(&self) -> Dense {
        self.motion.tr_mul(&self.form)
    }
}

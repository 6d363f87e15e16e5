//! The derivative of the equations of motion by the state.

use nalgebra::DMatrix;

use super::rates::rates;
use super::sparse::differentiated;
use super::tape::{Operand, Operation, Recorded, recorded};
use crate::model::{Model, StateVector};
use crate::scalar::Scalar;

/// `df/dy` of equations of motion `y' = f(t, y)`, as straight-line code.
///
/// The operations of `f` are recorded once, at a point, and differentiated one after the other by those components alone that they
/// depend on: the result is exact, and all of its columns share the values of `f`. Where `f` has a branch, as a force of the user
/// may, the code is that of the branch at the point.
///
/// ```
/// use affine_runtime::analysis::JacobianMatrix;
/// use affine_runtime::prelude::*;
///
/// #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)/2)]
/// struct Oscillator;
///
/// let point = Oscillator.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros())?;
/// let matrix = JacobianMatrix::of(&Oscillator, 0.0, &point).at(0.0, &Oscillator.flatten(&point));
/// assert_eq!((matrix[(0, 4)], matrix[(4, 0)]), (1.0, -1.0)); // phi' = Pi, Pi' = -phi
/// # Ok::<(), affine_runtime::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct JacobianMatrix {
    tape: Vec<Operation>,
    results: Vec<Operand>,
    components: usize,
}

impl JacobianMatrix {
    /// That of Hamilton's equations over the plain array, [`Model::hamilton_equations`]; the multiplier of an isochoric
    /// `dalembert` is differentiated as well.
    pub fn of<const N: usize, M: Model<N>>(model: &M, t: f64, point: &M::Point<f64>) -> Self {
        let full = model.flatten(point);
        Self::recorded(t, full.as_ref(), |t, numbers| {
            let mut state = M::Full::<Recorded>::zeros();
            state.as_mut().copy_from_slice(numbers);
            rates(model, t, &state).as_ref().to_vec()
        })
    }

    /// That of [`Model::reduced_equations`] over the reduced state, at the constants of the trajectory that passes through a
    /// point at a time.
    pub fn of_reduced<const N: usize, M: Model<N>>(model: &M, t: f64, point: &M::Point<f64>) -> Self {
        let values = model.flatten(point);
        let mut full = M::Full::<Recorded>::zeros();
        for (number, value) in full.as_mut().iter_mut().zip(values.as_ref()) {
            *number = Recorded::constant(*value, 0.0);
        }
        let (_, constants) = model.reduce(Recorded::constant(t, 0.0), &model.unflatten(&full));
        let (reduced, _) = model.reduce(t, point);
        Self::recorded(t, reduced.as_ref(), |t, numbers| {
            let mut state = M::Reduced::<Recorded>::zeros();
            state.as_mut().copy_from_slice(numbers);
            model.reduced_equations(t, &constants, &state).as_ref().to_vec()
        })
    }

    /// The arguments are the state and, last, the time.
    fn recorded(t: f64, state: &[f64], f: impl FnOnce(Recorded, &[Recorded]) -> Vec<Recorded>) -> Self {
        let components = state.len();
        let arguments = [state, &[t]].concat();
        let (tape, results) = recorded(&arguments, |numbers| f(numbers[components], &numbers[..components]));
        Self { tape, results, components }
    }

    /// `df_i/dy_k` at a time and a state, in row `i` and column `k`. Any number will do, in the precision of doubles.
    ///
    /// A function that has no derivative at the state gives entries that are not finite. Components that are missing are zero.
    #[must_use]
    pub fn at<T: Scalar>(&self, t: T, state: impl AsRef<[T]>) -> DMatrix<T> {
        let mut arguments = vec![T::zero(); self.components + 1];
        arguments.iter_mut().zip(state.as_ref()).take(self.components).for_each(|(a, value)| *a = *value);
        arguments[self.components] = t;
        let mut matrix = DMatrix::from_element(self.components, self.components, T::zero());
        differentiated((&self.tape, &self.results), (&arguments, self.components), |row, column, value| {
            matrix[(row, column)] = value;
        });
        matrix
    }
}

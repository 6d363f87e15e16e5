//! The derivative of the equations of motion by the state.

use nalgebra::DMatrix;

use crate::dual::Dual;
use crate::model::{Model, StateVector};
use crate::scalar::Scalar;
use crate::tape::{Kind, Operand, Recorded, Tape, recorded};

/// `df/dy` of equations of motion `y' = f(t, y)`, as straight-line code.
///
/// The operations of `f` are recorded once, at a point, and differentiated one after the other by those components alone that they
/// depend on: the result is exact, and all of its columns share the values of `f`. Where `f` has a branch, as a force of the user
/// may that asks whether numbers are equal, the code is that of the branch at the point, each column is computed alone, and those in
/// which [`Dual`] numbers would take another branch are NaN. With a potential in single stretches each column is computed alone, too:
/// where stretches coincide, so do the axes that belong to them, and which are right depends on the direction.
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
    tape: Tape,
    components: usize,
}

impl JacobianMatrix {
    /// That of Hamilton's equations over the plain array, [`Model::hamilton_equations`].
    pub fn of<const N: usize, M: Model<N>>(model: &M, t: f64, point: &M::Point<f64>) -> Self {
        let full = model.flatten(point);
        Self::recorded(t, full.as_ref(), |t, numbers| {
            model.hamilton_equations(t, &state_of(numbers)).as_ref().to_vec()
        })
    }

    /// That of [`Model::reduced_equations`] over the reduced state, at the constants of the trajectory that passes through a
    /// point at a time.
    pub fn of_reduced<const N: usize, M: Model<N>>(model: &M, t: f64, point: &M::Point<f64>) -> Self {
        let number = |value: &f64| Recorded::constant(*value, 0.0);
        let full = state_of(&model.flatten(point).as_ref().iter().map(number).collect::<Vec<_>>());
        let (_, constants) = model.reduce(number(&t), &model.unflatten(&full));
        let (reduced, _) = model.reduce(t, point);
        Self::recorded(t, reduced.as_ref(), |t, numbers| {
            model.reduced_equations(t, &constants, &state_of(numbers)).as_ref().to_vec()
        })
    }

    /// The arguments are the state and, last, the time.
    fn recorded(t: f64, state: &[f64], f: impl FnOnce(Recorded, &[Recorded]) -> Vec<Recorded>) -> Self {
        let components = state.len();
        let arguments = [state, &[t]].concat();
        let tape = recorded(&arguments, |numbers| f(numbers[components], &numbers[..components]));
        Self { tape, components }
    }

    /// Whether the equations have a branch: whether numbers are equal that depend on the state or the time.
    pub(super) fn has_branch(&self) -> bool {
        !self.tape.comparisons.is_empty()
    }

    /// Whether the equations contain the time: a function of it that nothing multiplies by zero, or a branch by it.
    pub(super) fn contains_time(&self) -> bool {
        let mut timed: Vec<bool> = (0..=self.components).map(|node| node == self.components).collect();
        let is_timed =
            |operand: &Operand, timed: &[bool]| matches!(*operand, Operand::Node(node) if timed[node]);
        let zero = Operand::Constant(0.0);
        for (kind, operands) in &self.tape.operations[timed.len()..] {
            let vanishes = |k: usize| match (kind, k) {
                (Kind::Mul | Kind::Fma, 0 | 1) => operands[1 - k] == zero,
                (Kind::Div, 1) => operands[0] == zero,
                _ => false,
            };
            timed.push((0..3).any(|k| is_timed(&operands[k], &timed) && !vanishes(k)));
        }
        let compared = self.tape.comparisons.iter().flat_map(|(both, _)| both);
        self.tape.results.iter().chain(compared).any(|number| is_timed(number, &timed))
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
        differentiated(&self.tape, (&arguments, self.components), |row, column, value| {
            matrix[(row, column)] = value;
        });
        matrix
    }
}

fn state_of<S: StateVector<Recorded>>(numbers: &[Recorded]) -> S {
    let mut state = S::zeros();
    state.as_mut().copy_from_slice(numbers);
    state
}

/// The derivatives of results by so many of the first arguments that are not zero, each given to `each` with its row and column.
fn differentiated<T: Scalar>(
    tape: &Tape,
    (arguments, columns): (&[T], usize),
    mut each: impl FnMut(usize, usize, T),
) {
    if tape.is_directed() {
        for column in 0..columns {
            let mut varied: Vec<_> = arguments.iter().copied().map(Dual::fixed).collect();
            varied[column].slope = T::one();
            let values = tape.values(varied);
            let unless_other = if tape.is_branch_of(&values) { T::one() } else { T::constant(f64::NAN, 0.0) };
            let slopes = tape.results.iter().map(|result| result.of(&values).slope * unless_other);
            slopes.enumerate().for_each(|(row, slope)| each(row, column, slope));
        }
        return;
    }
    let mut values: Vec<T> = arguments.to_vec();
    // Sorted by columns.
    let mut slopes: Vec<Vec<(usize, T)>> = (0..arguments.len())
        .map(|node| (node < columns).then(|| (node, T::one())).into_iter().collect())
        .collect();
    for (kind, operands) in &tape.operations[arguments.len()..] {
        let numbers = operands.map(|operand| operand.of(&values));
        let mut sums: Vec<(usize, T)> = Vec::new();
        for (k, operand) in operands.iter().enumerate() {
            let Operand::Node(from) = *operand else { continue };
            let (is_negative, partial) = kind.partial(k, numbers);
            for (column, slope) in &slopes[from] {
                let term = match partial {
                    None => *slope,
                    Some(partial) if from < arguments.len() => partial,
                    // As dual numbers have roots of zero.
                    Some(partial) if matches!(kind, Kind::Sqrt | Kind::Cbrt) => slope.times_any(partial),
                    Some(partial) => partial * *slope,
                };
                let term = if is_negative { -term } else { term };
                match sums.binary_search_by_key(column, |(own, _)| *own) {
                    Ok(place) => sums[place].1 += term,
                    Err(place) => sums.insert(place, (*column, term)),
                }
            }
        }
        values.push(kind.of(numbers));
        slopes.push(sums);
    }
    for (row, result) in tape.results.iter().enumerate() {
        if let Operand::Node(node) = *result {
            slopes[node].iter().for_each(|(column, slope)| each(row, *column, *slope));
        }
    }
}

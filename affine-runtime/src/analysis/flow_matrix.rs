//! How motions depend on where they start, and on the fields of their model.

use core::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::error::AnalysisError;
use super::field::{Kinds, columns, full, normals, symplectic_form, vector};
use super::jacobian::JacobianMatrix;
use super::linear::{RANK, decomposed, from_columns, kernel};
use crate::dual::{Dual, fixed};
use crate::inner::DEFAULT_MAX_STEPS;
use crate::integrate::RungeKutta8;
use crate::model::{Group, Model, Quantity};
use crate::parametric::{Fields, Parametric};

/// Components of the largest state with a matrix of as many columns, and what these are held against at the least.
const COMPONENTS: usize = 24 * 25 + 1;
/// That, where columns fall below all numbers that have their digits.
const LEAST: f64 = f64::MIN_POSITIVE / f64::EPSILON;
/// That of columns by fields, in roundings of the start over the tolerance: a field that has no effect leaves as much.
const ROUNDINGS: f64 = 16.0;
/// The least number of times that columns are made orthonormal, and the largest.
const ROUNDS: (f64, f64) = (128.0, 1e9);

/// A state, then its columns one after the other; last a constant that is measured with them.
type Wide = [f64; COMPONENTS];

/// Groups of a state, then one of all columns.
const fn with_columns(groups: &[Group]) -> ([Group; 8], usize) {
    let mut all = [Group::new(Quantity::TangentVector, COMPONENTS); 8];
    let (mut k, mut left) = (0, COMPONENTS);
    while k < groups.len() {
        all[k] = groups[k];
        left -= groups[k].len;
        k += 1;
    }
    all[k] = Group::new(Quantity::TangentVector, left);
    (all, k + 1)
}

/// The derivative of a motion with respect to its start, in all directions: `M' = A(z(t)) M`, `M(t0) = 1`, over the plain array.
///
/// State and matrix are integrated together, so that all columns share the motion. The equations are recorded at the start, see
/// [`JacobianMatrix`], and where they have a branch each column is computed alone, by [`Dual`] numbers. Columns along a constraint
/// mean something, others do not. The motion is followed as far as its equations have values, through `det phi = 0` too, where a
/// [`Simulation`](crate::Simulation) stops.
///
/// ```
/// use affine_runtime::analysis::FlowMatrix;
/// use affine_runtime::prelude::*;
///
/// #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)/2)]
/// struct Oscillator;
///
/// let start = Oscillator.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros())?;
/// let mut flow = FlowMatrix::new(&Oscillator, (0.0, &start), 1e-12);
/// flow.advance_to(1.0)?;
/// assert!((flow.matrix()[(0, 0)] - 1.0_f64.cos()).abs() < 1e-11);
/// assert!(flow.defect() < 1e-11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct FlowMatrix<'a, const N: usize, M: Model<N>> {
    model: &'a M,
    jacobian: JacobianMatrix,
    start: DVector<f64>,
    t: f64,
    state: Box<Wide>,
    tolerance: f64,
}

impl<'a, const N: usize, M: Model<N>> FlowMatrix<'a, N, M> {
    const GROUPS: &'static ([Group; 8], usize) = &with_columns(M::DESCRIPTION.full);

    /// The identity at a point and a time. The tolerance bounds the relative error of each step.
    pub fn new(model: &'a M, (t, point): (f64, &M::Point<f64>), tolerance: f64) -> Self {
        let jacobian = JacobianMatrix::of(model, t, point);
        let start = vector(&model.flatten(point));
        let mut flow = Self { model, jacobian, start, t, state: Box::new([0.0; COMPONENTS]), tolerance };
        flow.state[..flow.start.len()].copy_from_slice(flow.start.as_slice());
        flow.set(&DMatrix::identity(flow.start.len(), flow.start.len()), LEAST);
        flow
    }

    fn set(&mut self, columns: &DMatrix<f64>, least: f64) {
        self.state[self.start.len()..].fill(0.0);
        self.state[self.start.len()..][..columns.len()].copy_from_slice(columns.as_slice());
        self.state[COMPONENTS - 1] = least;
    }

    fn columns(&self, count: usize) -> DMatrix<f64> {
        let own = self.start.len();
        DMatrix::from_column_slice(own, count, &self.state[own..own * (count + 1)])
    }

    /// Moves to a time, forward or backward.
    ///
    /// # Errors
    /// [`AnalysisError::Integration`]; the matrix stays where it was.
    pub fn advance_to(&mut self, t: f64) -> Result<(), AnalysisError> {
        self.advance(t, |_, _| DMatrix::zeros(0, 0))
    }

    /// `M' = A M + forcing(t, z)`.
    fn advance(
        &mut self,
        end: f64,
        forcing: impl Fn(f64, &M::Full<f64>) -> DMatrix<f64>,
    ) -> Result<(), AnalysisError> {
        let (own, groups) = (self.start.len(), Self::GROUPS.0.split_at(Self::GROUPS.1).0);
        let slope = |t: f64, wide: &Wide| {
            let z = full::<N, M>(&DVector::from_column_slice(&wide[..own]));
            let columns = DMatrix::from_column_slice(own, own, &wide[own..own * (own + 1)]);
            let (rates, forced) = (self.model.hamilton_equations(t, &z), forcing(t, &z));
            let moved = self.slopes(t, z) * columns;
            let mut slope = [0.0; COMPONENTS];
            slope[..own].copy_from_slice(rates.as_ref());
            slope[own..][..moved.len()].copy_from_slice(moved.as_slice());
            slope[own..].iter_mut().zip(forced.iter()).for_each(|(slope, forced)| *slope += forced);
            slope
        };
        let steps = RungeKutta8::new(slope, groups, (self.t, *self.state), end, self.tolerance)?;
        *self.state = steps.finish(DEFAULT_MAX_STEPS)?;
        self.t = end;
        Ok(())
    }

    /// The derivative of the equations.
    fn slopes(&self, t: f64, z: M::Full<f64>) -> DMatrix<f64> {
        if !self.jacobian.has_branch() {
            return self.jacobian.at(t, z);
        }
        // What was recorded at the start may be another branch.
        let rates = |full: &_| self.model.hamilton_equations(Dual::fixed(t), full).as_ref().to_vec();
        columns::<N, M>(&vector(&z), rates)
    }

    /// The phase point.
    #[must_use]
    pub fn point(&self) -> M::Point<f64> {
        self.model.unflatten(&full::<N, M>(&self.z()))
    }

    /// Its plain array.
    fn z(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.state[..self.start.len()])
    }

    /// `M`: the derivative of component `i` by component `k` of the start in row `i` and column `k`.
    #[must_use]
    pub fn matrix(&self) -> DMatrix<f64> {
        self.columns(self.start.len())
    }

    /// How far the matrix is from symplectic, `|M^T W(t) M - W(t0)|` over the size of what cancels, on the directions that a
    /// constraint leaves: rounding and tolerance where the motion is Hamiltonian.
    #[must_use]
    pub fn defect(&self) -> f64 {
        let [before, after] = [&self.start, &self.z()].map(|z| symplectic_form(self.model, z));
        let matrix = self.matrix();
        // Before it is squared, what has grown.
        let basis = kernel(&normals(self.model, &self.start), RANK).unscale(matrix.camax().max(1.0));
        let moved = matrix * &basis;
        let difference = moved.tr_mul(&after) * &moved - basis.tr_mul(&before) * &basis;
        difference.norm() / (moved.norm_squared() * after.norm())
    }
}

/// How the plain array at a time depends on the start of its motion and on the fields of the model: one column for each component
/// or field. What is held fixed makes a difference: a start that is given by its velocity has other momenta where fields differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivities {
    /// By the plain array of the start, see [`FlowMatrix::matrix`].
    pub by_start: DMatrix<f64>,
    /// By the start as positions and velocities: those of `x` and `phi` in the plain array, then their rates in the same order.
    /// Of a constraint, along what it admits.
    pub by_velocity: DMatrix<f64>,
    /// By the fields in the order of [`Fields::FIELDS`], numbers before matrices, where the plain array of the start is held:
    /// placement and momentum in bases in which the metrics are the identity.
    pub by_fields: DMatrix<f64>,
    /// By the fields, where placement and velocity of the start are held, in the bases of the user's points.
    pub by_fields_at_velocity: DMatrix<f64>,
}

impl Sensitivities {
    /// Those of the motion that passes through a point at `t0`. The tolerance bounds the relative error of each step, but for
    /// roundings of the start: by a field without effect there is nothing that an error could be relative to.
    ///
    /// # Errors
    /// [`AnalysisError::Model`] where coefficients have no derivative, [`AnalysisError::Integration`],
    /// [`AnalysisError::NoDecomposition`].
    pub fn of<const N: usize, F: Fields<N>>(
        fields: &F,
        model: &F::Prepared,
        (t0, point): (f64, &<F::Prepared as Model<N>>::Point<f64>),
        t: f64,
        tolerance: f64,
    ) -> Result<Self, AnalysisError> {
        let values = fields.values();
        // By parts of a field that is not zero: all columns have the units of the state.
        let unit = |k: usize| Some(values.as_ref()[k].abs()).filter(|unit| *unit > 0.0).unwrap_or(1.0);
        let varied = (0..values.as_ref().len()).map(|k| {
            let mut varied: F::Values<Dual<f64>> = fixed(values.as_ref());
            varied.as_mut()[k].slope = unit(k);
            F::coefficients_of(&varied)
        });
        let coefficients = varied.collect::<Result<Vec<_>, _>>()?;
        let mut flow = FlowMatrix::new(model, (t0, point), tolerance);
        let (own, mut by_fields) = (flow.start.len(), Vec::new());
        let forced = |coefficients: &[_], t: f64, z: &[f64]| {
            let still: <F::Prepared as Model<N>>::Full<Dual<f64>> = fixed(z);
            slopes_by(coefficients, own, |c| model.hamilton_equations_with(c, Dual::fixed(t), &still))
        };
        // As many at once as the state has components.
        for coefficients in coefficients.chunks(own) {
            let mut flow = FlowMatrix::new(model, (t0, point), tolerance);
            flow.set(&DMatrix::zeros(0, 0), ROUNDINGS * f64::EPSILON / tolerance * flow.start.norm());
            flow.advance(t, |t, z| forced(coefficients, t, z.as_ref()))?;
            by_fields.extend(flow.columns(coefficients.len()).column_iter().map(|one| one.into_owned()));
        }
        let mut by_fields = from_columns(own, &by_fields);
        let start = flow.start.as_slice();
        // Places and velocities by the plain array, and that by these.
        let mut both = flow.slopes(t0, full::<N, F::Prepared>(&flow.start)).insert_rows(0, own, 0.0);
        both.rows_mut(0, own).fill_with_identity();
        let places = Kinds::of::<N, F::Prepared>().places;
        let rows: Vec<usize> = places.iter().copied().chain(places.iter().map(|place| own + place)).collect();
        let inverse = inverse(both.select_rows(&rows), places.len())?;
        // Bases in which the metrics are the identity change with them, and a place and a velocity that are held change in these.
        let rates = model.hamilton_equations(t0, &full::<N, F::Prepared>(&flow.start));
        let mut moving = flow.start.clone();
        places.iter().for_each(|place| moving[*place] = rates.as_ref()[*place]);
        let [turned, turned_rates] = [start, moving.as_slice()].map(|z| {
            let point = model.unflatten(&fixed(z));
            slopes_by(&coefficients, own, |c| model.flatten_with(c, &point)).select_rows(&places)
        });
        let mut held = turned.insert_rows(places.len(), places.len(), 0.0);
        let rates = turned_rates - forced(&coefficients, t0, start).select_rows(&places);
        held.rows_mut(places.len(), places.len()).copy_from(&rates);
        flow.advance_to(t)?;
        let by_start = flow.matrix();
        let by_velocity = &by_start * inverse;
        let mut by_fields_at_velocity = &by_fields + &by_velocity * held;
        for by in [&mut by_fields, &mut by_fields_at_velocity] {
            by.column_iter_mut().enumerate().for_each(|(k, mut column)| column.unscale_mut(unit(k)));
        }
        Ok(Self { by_start, by_velocity, by_fields, by_fields_at_velocity })
    }
}

/// The inverse of how places and velocities depend on the plain array, as far as there is one. Velocities are small in heavy bodies,
/// and none the less.
fn inverse(mut matrix: DMatrix<f64>, places: usize) -> Result<DMatrix<f64>, AnalysisError> {
    let unit = matrix.rows(places, places).norm().max(f64::MIN_POSITIVE);
    matrix.rows_mut(places, places).unscale_mut(unit);
    let svd = decomposed(matrix).ok_or(AnalysisError::NoDecomposition)?;
    let none = RANK * svd.singular_values.max();
    let mut inverse = svd.pseudo_inverse(none).map_err(|_| AnalysisError::NoDecomposition)?;
    inverse.columns_mut(places, places).unscale_mut(unit);
    Ok(inverse)
}

/// The derivatives of a function of coefficients, over the plain array, by fields in columns.
fn slopes_by<C, S: AsRef<[Dual<f64>]>>(
    coefficients: &[C],
    rows: usize,
    of: impl Fn(&C) -> S,
) -> DMatrix<f64> {
    let slopes =
        coefficients.iter().flat_map(|own| of(own).as_ref().iter().map(|one| one.slope).collect::<Vec<_>>());
    DMatrix::from_iterator(rows, coefficients.len(), slopes)
}

/// Lyapunov exponents of a motion over a time, from the largest, in the norm of the plain array.
#[derive(Clone, Debug)]
pub struct LyapunovSpectrum {
    /// The exponents.
    pub exponents: Vec<f64>,
    /// An estimate of what they are off by: their change over the second half of the time, the sum of the pair that should be
    /// opposite, and `ln(1 + r t)/t` of growth that is no exponential, with the norm `r` of the derivative of the equations at the
    /// start. No finite time gives a bound; with friction there are no pairs, and the estimate is too large.
    pub errors: Vec<f64>,
}

/// The Lyapunov spectrum of a motion, by columns that are made orthonormal again and again (G. Benettin et al., Meccanica 15
/// (1980) 9). On motions that are not bounded it depends on the layout, see [`Description::full`](crate::model::Description::full).
///
/// # Errors
/// [`AnalysisError::Time`], [`AnalysisError::Integration`].
pub fn lyapunov_spectrum<const N: usize, M: Model<N>>(
    model: &M,
    start: &M::Point<f64>,
    time: f64,
    tolerance: f64,
) -> Result<LyapunovSpectrum, AnalysisError> {
    if time == 0.0 || !time.is_finite() {
        return Err(AnalysisError::Time(time));
    }
    let mut flow = FlowMatrix::new(model, (0.0, start), tolerance);
    let basis = kernel(&normals(model, &flow.start), RANK);
    // Of no special directions, in which growth would be less.
    let mixed = |i: usize, k: usize| ((1 + i + k * k) as f64 * 12.9898).sin();
    let mut columns = &basis * DMatrix::from_fn(basis.ncols(), basis.ncols(), mixed).qr().q();
    let slopes = flow.slopes(0.0, full::<N, M>(&flow.start));
    // Once in a turn of what is fastest at the start, in whatever units: masses and lengths cancel in what a square has of one quantity.
    let (square, mut at) = (&slopes * &slopes, 0);
    let own = M::DESCRIPTION.full.iter().map(|group| {
        at += group.len;
        square.view((at - group.len, at - group.len), (group.len, group.len)).norm_squared()
    });
    let turns = time.abs() * own.sum::<f64>().powf(0.25) / TAU;
    // Where there are no rates there is no motion, which the first round says.
    let rounds = if turns.is_nan() { ROUNDS.0 } else { turns.clamp(ROUNDS.0, ROUNDS.1).ceil() };
    let count = columns.ncols();
    let (mut sums, mut half) = (DVector::<f64>::zeros(count), DVector::<f64>::zeros(count));
    for round in 1..=rounds as usize {
        flow.set(&columns, LEAST);
        flow.advance_to(time * round as f64 / rounds)?;
        // Off the group nothing falls, and what rounding leaves there would outlast what does.
        let basis = kernel(&normals(model, &flow.z()), RANK);
        let decomposition = (&basis * basis.tr_mul(&flow.columns(count))).qr();
        sums += decomposition.r().diagonal().map(|entry| entry.abs().ln());
        columns = decomposition.q();
        if 2 * round <= rounds as usize {
            half.copy_from(&sums);
        }
    }
    let secular = (time.abs() * slopes.norm()).ln_1p() / time.abs();
    let mut exponents: Vec<f64> = sums.iter().map(|sum| sum / time).collect();
    exponents.sort_by(|a, b| b.total_cmp(a));
    let drift = (sums - half * 2.0).amax() / time.abs();
    let pair = |k: usize| (exponents[k] + exponents[count - 1 - k]).abs();
    let errors = (0..count).map(|k| drift + pair(k) + secular).collect();
    Ok(LyapunovSpectrum { exponents, errors })
}

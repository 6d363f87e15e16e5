//! Flows, forces, series and lanes, by plain arrays.

use affine_runtime::capability::{InLanes as Lanes, SecondOrderEquations, Splitting, Taylor};
use affine_runtime::lanes::{F64x8, Lanes as _};
use affine_runtime::model::StateVector;
use affine_tests::jet::{Jet, LENGTH};

use crate::body::{Trajectory, Whole, filled};

/// `emit(splitting)`.
pub(crate) trait Flows {
    fn pieces(&self) -> usize;
    /// `[B, [B, [B, A]]] = 0`, and a dilatation of its own in the first piece.
    fn kind(&self) -> [bool; 2];
    fn flow(&self, from: Trajectory, piece: usize, times: [f64; 2], y: &mut [f64], carry: &mut [f64]);
}

impl<const N: usize, M: Splitting<N>> Flows for Whole<N, M> {
    fn pieces(&self) -> usize {
        M::PIECES.len()
    }

    fn kind(&self) -> [bool; 2] {
        [M::NYSTROM, M::DILATES]
    }

    fn flow(&self, from: Trajectory, piece: usize, [t, h]: [f64; 2], y: &mut [f64], carry: &mut [f64]) {
        let (_, constants) = self.begin(from);
        let (mut value, mut rest) = (filled::<M::Reduced<f64>>(y), filled::<M::Reduced<f64>>(carry));
        self.0.flow(piece, t, h, &constants, &mut value, &mut rest);
        y.copy_from_slice(value.as_ref());
        carry.copy_from_slice(rest.as_ref());
    }
}

/// `emit(nystrom)`.
pub(crate) trait Forces {
    fn half(&self) -> usize;
    fn drift(&self, from: Trajectory, momenta: &[f64]) -> Vec<f64>;
    fn force(&self, from: Trajectory, t: f64, positions: &[f64]) -> Vec<f64>;
}

impl<const N: usize, M: SecondOrderEquations<N>> Forces for Whole<N, M> {
    fn half(&self) -> usize {
        M::Half::<f64>::LEN
    }

    fn drift(&self, from: Trajectory, momenta: &[f64]) -> Vec<f64> {
        let (_, constants) = self.begin(from);
        self.0.drift(&constants, &filled::<M::Half<f64>>(momenta)).as_ref().to_vec()
    }

    fn force(&self, from: Trajectory, t: f64, positions: &[f64]) -> Vec<f64> {
        let (_, constants) = self.begin(from);
        self.0.force(t, &constants, &filled::<M::Half<f64>>(positions)).as_ref().to_vec()
    }
}

/// `emit(taylor)`.
pub(crate) trait Coefficients {
    /// The recurrence that is emitted.
    fn by_recurrence(&self, from: Trajectory) -> Vec<Vec<f64>>;
    /// The reduced equations over series: the coefficients so far, as a polynomial in the time, give the next one.
    fn by_series(&self, from: Trajectory) -> Vec<Vec<f64>>;
}

impl<const N: usize, M: Taylor<N>> Coefficients for Whole<N, M> {
    fn by_recurrence(&self, from: Trajectory) -> Vec<Vec<f64>> {
        let (state, constants) = self.begin(from);
        let mut coefficients = vec![state; LENGTH];
        let mut rows = vec![M::Row::<f64>::zeros(); LENGTH - 1];
        self.0.coefficients((from.t0, 1.0), &constants, &mut coefficients, &mut rows);
        coefficients.iter().map(|c| c.as_ref().to_vec()).collect()
    }

    fn by_series(&self, from: Trajectory) -> Vec<Vec<f64>> {
        let mut time = Jet::fixed(from.t0);
        let mut full = M::Full::<Jet>::zeros();
        full.as_mut().iter_mut().zip(from.full).for_each(|(jet, value)| *jet = Jet::fixed(*value));
        let (mut series, constants) = self.0.reduce(time, &self.0.unflatten(&full));
        time.0[1] = 1.0;
        for k in 1..LENGTH {
            let rate = self.0.reduced_equations(time, &constants, &series);
            for (series, rate) in series.as_mut().iter_mut().zip(rate.as_ref()) {
                series.0[k] = rate.0[k - 1] / k as f64;
            }
        }
        (0..LENGTH).map(|k| series.as_ref().iter().map(|jet| jet.0[k]).collect()).collect()
    }
}

/// `emit(lanes)`.
pub(crate) trait InLanes {
    /// Rates of the reduced states of several starts, at times of their own.
    fn at_once(&self, from: &[Trajectory], times: &[f64]) -> Vec<Vec<f64>>;
}

impl<const N: usize, M: Lanes<N>> InLanes for Whole<N, M> {
    fn at_once(&self, from: &[Trajectory], times: &[f64]) -> Vec<Vec<f64>> {
        let begun: Vec<_> = from.iter().map(|from| self.begin(*from)).collect();
        let of = |lane: usize| begun.get(lane).or(begun.last()).unwrap();
        let mut state = M::Reduced::<F64x8>::zeros();
        for (k, component) in state.as_mut().iter_mut().enumerate() {
            *component = F64x8::from_lanes(|lane| of(lane).0.as_ref()[k]);
        }
        let constants: Vec<_> = begun.iter().map(|(_, constants)| *constants).collect();
        let constants = M::constants_in_lanes::<F64x8>(&constants);
        let t = F64x8::from_lanes(|lane| times.get(lane).copied().unwrap_or(0.0));
        let mut rates = M::Reduced::<F64x8>::zeros();
        M::equations_in_lanes(|_| self.0, t, &constants, &state, &mut rates);
        (0..begun.len()).map(|lane| rates.as_ref().iter().map(|rate| rate.lane(lane)).collect()).collect()
    }
}

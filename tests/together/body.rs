//! What every model has, by plain arrays.

use affine_oracle::State;
use affine_runtime::capability::Tangent;
use affine_runtime::dual::Dual;
use affine_runtime::model::StateVector;
use affine_runtime::prelude::*;
use affine_runtime::scalar::{Real, Scalar};
use affine_tests::reference::entries;

/// A number with two slopes, and how each changes along the other.
pub(crate) type Twice = Dual<Dual<f64>>;

/// `x, phi, p, Pi` of a phase point, or their rates; matrices row by row.
#[derive(Clone, Debug)]
pub(crate) struct Canonical {
    pub(crate) x: Vec<f64>,
    pub(crate) phi: Vec<f64>,
    pub(crate) p: Vec<f64>,
    pub(crate) pi: Vec<f64>,
}

impl Canonical {
    fn of<const N: usize, T: Real>(point: &impl Phase<N, T>, part: impl Fn(&T) -> f64) -> Self {
        let numbers = |entries: Vec<T>| entries.iter().map(&part).collect();
        Self {
            x: numbers(point.x().as_slice().to_vec()),
            phi: numbers(entries(point.phi())),
            p: numbers(point.p().as_slice().to_vec()),
            pi: numbers(entries(&point.pi().0.0)),
        }
    }

    /// With their names.
    pub(crate) fn named(&self) -> [(&'static str, &[f64]); 4] {
        [("x", &self.x), ("phi", &self.phi), ("p", &self.p), ("Pi", &self.pi)]
    }

    /// Exactly.
    pub(crate) fn state(&self) -> State {
        State::from_f64(self.x.len(), &self.x, &self.phi, &self.p, &self.pi).unwrap()
    }
}

/// A trajectory, by its point at a time, and a later time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trajectory<'a> {
    pub(crate) t0: f64,
    pub(crate) full: &'a [f64],
}

/// A model, for what is told of it by plain arrays.
pub(crate) struct Whole<const N: usize, M: 'static>(pub(crate) &'static M);

/// What every model has. The plain array of a point is `full`, a reduced state `y`.
pub(crate) trait Body {
    fn point(&self, full: &[f64]) -> Canonical;
    fn back(&self, full: &[f64]) -> Vec<f64>;
    /// `x_dot` and `phi_dot`.
    fn velocity(&self, full: &[f64]) -> [Vec<f64>; 2];
    /// `H` and its rate.
    fn energy(&self, t: f64, full: &[f64]) -> [f64; 2];
    fn hamilton(&self, t: f64, full: &[f64]) -> Vec<f64>;
    /// How the point changes as its plain array does.
    fn moving(&self, full: &[f64], rates: &[f64]) -> Canonical;
    fn reduced(&self, from: Trajectory) -> Vec<f64>;
    fn rates(&self, from: Trajectory, t: f64, y: &[f64]) -> Vec<f64>;
    fn expanded(&self, from: Trajectory, t: f64, y: &[f64]) -> Canonical;
    fn renewed(&self, y: &[f64]) -> Vec<f64>;
    /// At a time, the point of the reduced state of the start; its rate, its change along a direction, and the rate of the
    /// change, by the variational equations.
    fn varied(&self, from: Trajectory, t: f64, direction: &[f64]) -> [Canonical; 4];
}

/// An array as a state.
pub(crate) fn filled<S: StateVector<f64>>(values: &[f64]) -> S {
    let mut state = S::zeros();
    state.as_mut().copy_from_slice(values);
    state
}

/// An array with its slopes.
fn along<T: Scalar, S: StateVector<Dual<T>>>(values: &[f64], slopes: &[f64], number: impl Fn(f64) -> T) -> S {
    let mut state = S::zeros();
    for (dual, (value, slope)) in state.as_mut().iter_mut().zip(values.iter().zip(slopes)) {
        *dual = Dual { value: number(*value), slope: number(*slope) };
    }
    state
}

impl<const N: usize, M: Tangent<N>> Body for Whole<N, M> {
    fn point(&self, full: &[f64]) -> Canonical {
        Canonical::of(&self.0.unflatten(&filled::<M::Full<f64>>(full)), |v: &f64| *v)
    }

    fn back(&self, full: &[f64]) -> Vec<f64> {
        self.0.flatten(&self.0.unflatten(&filled::<M::Full<f64>>(full))).as_ref().to_vec()
    }

    fn velocity(&self, full: &[f64]) -> [Vec<f64>; 2] {
        let velocity = self.0.velocity(&self.0.unflatten(&filled::<M::Full<f64>>(full)));
        [velocity.x_dot.as_slice().to_vec(), entries(&velocity.phi_dot)]
    }

    fn energy(&self, t: f64, full: &[f64]) -> [f64; 2] {
        let point = self.0.unflatten(&filled::<M::Full<f64>>(full));
        [self.0.hamiltonian(t, &point), self.0.power(t, &point)]
    }

    fn hamilton(&self, t: f64, full: &[f64]) -> Vec<f64> {
        self.0.hamilton_equations(t, &filled::<M::Full<f64>>(full)).as_ref().to_vec()
    }

    fn moving(&self, full: &[f64], rates: &[f64]) -> Canonical {
        let full: M::Full<Dual<f64>> = along(full, rates, |v| v);
        Canonical::of(&self.0.unflatten(&full), |v: &Dual<f64>| v.slope)
    }

    fn reduced(&self, from: Trajectory) -> Vec<f64> {
        self.begin(from).0.as_ref().to_vec()
    }

    fn rates(&self, from: Trajectory, t: f64, y: &[f64]) -> Vec<f64> {
        let (_, constants) = self.begin(from);
        self.0.reduced_equations(t, &constants, &filled::<M::Reduced<f64>>(y)).as_ref().to_vec()
    }

    fn expanded(&self, from: Trajectory, t: f64, y: &[f64]) -> Canonical {
        let (_, constants) = self.begin(from);
        Canonical::of(&self.0.expand(t, &constants, &filled::<M::Reduced<f64>>(y)), |v: &f64| *v)
    }

    fn renewed(&self, y: &[f64]) -> Vec<f64> {
        self.0.renewed(&filled::<M::Reduced<f64>>(y)).as_ref().to_vec()
    }

    fn varied(&self, from: Trajectory, t: f64, direction: &[f64]) -> [Canonical; 4] {
        let model = self.0;
        let start: M::Full<Dual<f64>> = along(from.full, direction, |v| v);
        let (reduced, constants) = model.reduce(Dual::fixed(from.t0), &model.unflatten(&start));
        let size = reduced.as_ref().len();
        let mut varied = M::Varied::<f64>::zeros();
        for (k, both) in reduced.as_ref().iter().enumerate() {
            (varied.as_mut()[k], varied.as_mut()[size + k]) = (both.value, both.slope);
        }
        let rates = model.variational_equations(t, &constants, &varied);

        // Outside the time, inside the direction.
        let start: M::Full<Twice> = along(from.full, &vec![0.0; from.full.len()], Dual::fixed);
        let mut turned = start;
        for (twice, slope) in turned.as_mut().iter_mut().zip(direction) {
            twice.value.slope = *slope;
        }
        let (mut state, constants) =
            model.reduce(Twice::fixed(Dual::fixed(from.t0)), &model.unflatten(&turned));
        for (k, twice) in state.as_mut().iter_mut().enumerate() {
            twice.slope = Dual { value: rates.as_ref()[k], slope: rates.as_ref()[size + k] };
        }
        let now = Dual { value: Dual::fixed(t), slope: Dual::fixed(1.0) };
        let point = model.expand(now, &constants, &state);
        let part = |part: fn(&Twice) -> f64| Canonical::of(&point, part);
        [part(|v| v.value.value), part(|v| v.slope.value), part(|v| v.value.slope), part(|v| v.slope.slope)]
    }
}

impl<const N: usize, M: Model<N>> Whole<N, M> {
    /// The reduced state of a start, and what its trajectory conserves.
    pub(crate) fn begin(&self, from: Trajectory) -> (M::Reduced<f64>, M::Constants<f64>) {
        self.0.reduce(from.t0, &self.0.unflatten(&filled::<M::Full<f64>>(from.full)))
    }
}

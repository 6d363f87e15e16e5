//! Lattices of stretches, by plain arrays: the couplings that do not move, then the state with frames.

use affine_runtime::decompose::LinearMap;
use affine_runtime::frames::{Matrix, Vector};
use affine_runtime::lattice::{
    Lattice, LatticeForm, LatticePieces, LatticeSplitting, RatioForm, TwoPolarForm,
};
use affine_runtime::model::StateVector;

use crate::body::{Whole, filled};

/// `emit(two_polar)`.
pub(crate) trait Lattices {
    /// A state with stretches apart, of unit volume that does not change if `balanced`.
    fn start(&self, balanced: bool) -> Vec<f64>;
    /// Its rates: zero of the couplings.
    fn rates(&self, state: &[f64]) -> Vec<f64>;
    fn energy(&self, state: &[f64]) -> f64;
    /// The plain array of its phase point.
    fn full(&self, state: &[f64]) -> Vec<f64>;
    /// The state of a phase point that is near another.
    fn of_full(&self, full: &[f64], near: &[f64]) -> Vec<f64>;
}

fn begun<const N: usize>(balanced: bool) -> Lattice<N> {
    let skew = |entries: [f64; 3]| {
        let mut matrix = Matrix::<N>::zeros();
        for (k, (a, b)) in (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b))).enumerate() {
            (matrix[(a, b)], matrix[(b, a)]) = (entries[k], -entries[k]);
        }
        matrix
    };
    let turn = |entries: [f64; 3]| skew(entries).skew_exponential();
    let q = Vector::<N>::from_fn(|a, _| [0.6, 0.05, -0.5][a]);
    let p = Vector::<N>::from_fn(|a, _| [0.15, -0.3, 0.2][a]);
    let mean = |v: &Vector<N>| if balanced { v.sum() / N as f64 } else { 0.0 };
    Lattice {
        q: q.add_scalar(-mean(&q)),
        p: p.add_scalar(-mean(&p)),
        m: skew([0.5, -0.4, 0.3]),
        n: skew([0.6, 0.25, -0.45]),
        left: turn([0.4, -0.2, 0.7]),
        right: turn([-0.3, 0.5, 0.1]),
    }
}

/// Both arrays in one.
fn joined<const N: usize, M: LatticeForm<N>>(lattice: &Lattice<N>) -> Vec<f64> {
    let (couplings, framed) = lattice.framed::<M>();
    [couplings.as_ref(), framed.as_ref()].concat()
}

type Framed<const N: usize, M> = <M as LatticeForm<N>>::Framed<f64>;
type Couplings<const N: usize, M> = <M as LatticeForm<N>>::Couplings<f64>;

fn apart<const N: usize, M: LatticeForm<N>>(state: &[f64]) -> (Couplings<N, M>, Framed<N, M>) {
    let (couplings, framed) = state.split_at(Couplings::<N, M>::LEN);
    (filled(couplings), filled(framed))
}

fn lattice<const N: usize, M: LatticeForm<N>>(state: &[f64]) -> Lattice<N> {
    let (couplings, framed) = apart::<N, M>(state);
    Lattice::from_framed::<M>(&couplings, &framed)
}

impl<const N: usize, M: TwoPolarForm<N>> Lattices for Whole<N, M> {
    fn start(&self, balanced: bool) -> Vec<f64> {
        joined::<N, M>(&begun(balanced))
    }

    fn rates(&self, state: &[f64]) -> Vec<f64> {
        let (couplings, framed) = apart::<N, M>(state);
        let rates = self.0.framed_equations(&couplings, &framed);
        [Couplings::<N, M>::zeros().as_ref(), rates.as_ref()].concat()
    }

    fn energy(&self, state: &[f64]) -> f64 {
        let (couplings, places) = lattice::<N, M>(state).places::<M>();
        self.0.lattice_hamiltonian(&couplings, &places)
    }

    fn full(&self, state: &[f64]) -> Vec<f64> {
        self.0.flatten(&self.0.at_lattice(&lattice::<N, M>(state)).unwrap()).as_ref().to_vec()
    }

    fn of_full(&self, full: &[f64], near: &[f64]) -> Vec<f64> {
        let point = self.0.unflatten(&filled::<M::Full<f64>>(full));
        joined::<N, M>(&self.0.lattice_after(&point, &lattice::<N, M>(near)).unwrap())
    }
}

/// `emit(two_polar, splitting)`.
pub(crate) trait Pieces {
    /// The state after a time, by a method of an order.
    fn after(&self, state: &[f64], order: usize, t: f64, step: f64) -> Vec<f64>;
}

impl<const N: usize, M: LatticePieces<N>> Pieces for Whole<N, M> {
    fn after(&self, state: &[f64], order: usize, t: f64, step: f64) -> Vec<f64> {
        let start = lattice::<N, M>(state);
        let mut steps = LatticeSplitting::new(self.0, order, (0.0, start), t, step).unwrap().unwrap();
        joined::<N, M>(&steps.finish().unwrap())
    }
}

/// `emit(two_polar, ratios)`.
pub(crate) trait Ratios {
    /// The rates of `t_ab`, `p/alpha`, and of `U` and `W` for `n = 3`; `1/alpha`, and the rate of the mean of `q`.
    fn rates(&self, state: &[f64]) -> (Vec<f64>, f64, f64);
}

impl<const N: usize, M: RatioForm<N>> Ratios for Whole<N, M> {
    fn rates(&self, state: &[f64]) -> (Vec<f64>, f64, f64) {
        let lattice = lattice::<N, M>(state);
        let (couplings, ratios) = self.0.in_ratios(&lattice);
        let rates = self.0.ratio_equations(&couplings, &ratios).as_ref().to_vec();
        (rates, self.0.isotropic().unwrap().inverse_alpha, self.0.mean_rate(&lattice))
    }
}

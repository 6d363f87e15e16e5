//! The lattice by splitting.

use core::fmt;

use super::{Lattice, LatticeForm, LatticeStop, MetricSide, StopReason, Variables};
use crate::decompose::LinearMap;
use crate::error::Error;
use crate::frames::Matrix;
use crate::inner::accumulate;
use crate::scalar::{Real, Scalar};
use affine_integrators::Statistics;
use affine_integrators::lie::Sum;
use affine_integrators::splitting::{Pieces, Splitting};

/// A step that takes a coupled pair nearer than this part of its distance does not resolve the pole between them.
const RESOLVED: f64 = 0.5;

/// `emit(two_polar, splitting)`, or `group = unitary` with `emit(splitting)`: exact flows of pieces of the lattice's
/// Hamiltonian, over the state with frames.
///
/// ```text
/// drift          q_a -> q_a + h (p_a/alpha + p/beta)
/// pair a < b     p -> p - h dH_ab/dq,   M, N, L, R -> turned in planes by h dH_ab/dM_ab and h dH_ab/dN_ab
/// ```
///
/// with `H_ab = M_ab^2 f(q_a - q_b) + N_ab^2 g(q_a - q_b)`, whose two terms commute; `M_ab`, `N_ab` and all places stay as they
/// are. The potential pushes along with the first pair.
#[diagnostic::on_unimplemented(
    message = "the lattice of `{Self}` has no exact flows in dimension {N}",
    label = "no pieces here",
    note = "write `emit(two_polar, splitting)` in its `#[affine_model(...)]`"
)]
pub trait LatticePieces<const N: usize>: LatticeForm<N> {
    /// The pieces, in words; the drift first.
    const PIECES: &'static [&'static str];
    /// There are two pieces, `A` and `B`, with `[B, [B, [B, A]]] = 0`.
    const NYSTROM: bool;

    /// `1/mu` of `|Vort|^2/(2 mu)` or `|S|^2/(2 mu)` in the energy, which commutes with all pieces and is none of them.
    fn turning(&self) -> Option<(f64, MetricSide)> {
        None
    }

    /// Moves state and frames along a piece for the time `h`, adding to each component and to what rounding left out
    /// of it.
    fn lattice_flow<T: Real>(
        &self,
        piece: usize,
        h: T,
        couplings: &Self::Couplings<T>,
        state: &mut Self::Framed<T>,
        carry: &mut Self::Framed<T>,
    );
}

/// `sin w` and `cos w - 1`.
#[inline]
pub fn rotation<T: Scalar>(w: T) -> [T; 2] {
    let half = w * T::constant(0.5, 0.0);
    let (s, c) = half.sin_cos();
    let twice = s + s;
    [twice * c, -(twice * s)]
}

/// `z -> z cos w + y sin w`, `y -> y cos w - z sin w` for two components, with compensation.
#[inline]
pub fn turned<const K: usize, T: Real>(
    state: &mut [T; K],
    carry: &mut [T; K],
    (z, y): (usize, usize),
    [sine, less]: [T; 2],
) {
    let (a, b) = (state[z], state[y]);
    accumulate(&mut state[z], &mut carry[z], less * a + sine * b);
    accumulate(&mut state[y], &mut carry[y], less * b - sine * a);
}

/// The motion of a lattice by splitting, in equal steps, of order 2, 4, 6 or 8; see
/// [`Splitting`](affine_integrators::Splitting) for the compositions.
///
/// Every piece is a Poisson map. `|S|^2 = |rho_hat|^2`, `|Vort|^2 = |tau_hat|^2`, `sum M_ab N_ab` (Casimirs of the bracket of
/// `M` and `N`) and `sum p_a` are conserved to rounding, the orthogonality of `L` and `R` likewise; the energy, and with it `tr Z^2`,
/// to the order of the method, without drift. Where a part `|Vort|^2` or `|S|^2` of the energy turns a frame, that is
/// exact for all times.
///
/// *Coincidences.* The pieces have poles where two stretches coincide, `M_ab != 0`, and on the circle where two angles are opposite,
/// `N_ab != 0`. A step that crosses one, or halves the distance from it, does not resolve the motion and stops with
/// [`StopReason::Coincidence`] and the last good state; [`LatticeFlow`](super::LatticeFlow) goes on from there.
pub struct LatticeSplitting<'a, const N: usize, M: LatticePieces<N>> {
    steps: Splitting<M::Framed<f64>, M::Couplings<f64>, InTurn<'a, N, M>>,
    couplings: M::Couplings<f64>,
    sorting: Matrix<N>,
    /// Generator of the rotation of `R` (body) or `L` (space), from the left.
    whirl: Option<(Matrix<N>, MetricSide)>,
    t0: f64,
    stop: Option<LatticeStop<N>>,
}

/// The pieces of a model's lattice.
struct InTurn<'a, const N: usize, M>(&'a M);

impl<const N: usize, M: LatticePieces<N>> Pieces<M::Framed<f64>, M::Couplings<f64>> for InTurn<'_, N, M> {
    const COUNT: usize = M::PIECES.len();
    const NYSTROM: bool = M::NYSTROM;
    const DILATES: bool = false;

    #[inline]
    fn flow(
        &self,
        piece: usize,
        _: f64,
        h: f64,
        couplings: &M::Couplings<f64>,
        state: &mut Sum<M::Framed<f64>>,
    ) {
        self.0.lattice_flow(piece, h, couplings, &mut state.value, &mut state.carry);
    }
}

impl<'a, const N: usize, M: LatticePieces<N>> LatticeSplitting<'a, N, M> {
    /// The motion through `lattice` at the time `t0`, until `t_end` in either direction, in
    /// `ceil(|t_end - t0|/step)` steps of the method of order 2, 4, 6 or 8; `None` for other orders.
    ///
    /// # Errors
    /// [`StopReason::Coincidence`] where two stretches are equal; [`StopReason::Integration`] where the state is not finite,
    /// `step` not positive, not finite, or smaller than floating-point times tell apart.
    pub fn new(
        model: &'a M,
        order: usize,
        (t0, lattice): (f64, Lattice<N>),
        t_end: f64,
        step: f64,
    ) -> Option<Result<Self, LatticeStop<N>>> {
        let stop = |reason| LatticeStop { t: t0, lattice, reason };
        // Angles have no order.
        let sorting = match M::LATTICE.variables {
            Variables::Angles => Matrix::identity(),
            _ => lattice.descending(),
        };
        let sorted = lattice.relabelled(&sorting);
        let (couplings, state) = sorted.framed::<M>();
        let steps = Splitting::new((InTurn(model), couplings), order, (t0, state), t_end, step)?;
        if M::LATTICE.variables != Variables::Angles && lattice.gap() == 0.0 {
            return Some(Err(stop(StopReason::Coincidence { distance: 0.0 })));
        }
        let whirl = model.turning().filter(|(inverse_mu, _)| *inverse_mu != 0.0).map(|(inverse_mu, side)| {
            // R' = Vort R/mu, Vort = -R tau_hat R^T; L' = -S L/mu, S = L rho_hat L^T.
            let (frame, spin) = match side {
                MetricSide::Body => (sorted.right, sorted.minus_vorticity()),
                MetricSide::Space => (sorted.left, sorted.spin()),
            };
            (frame * spin * frame.transpose() * -inverse_mu, side)
        });
        let begun = steps.map(|steps| Self { steps, couplings, sorting, whirl, t0, stop: None });
        Some(begun.map_err(|failure| stop(StopReason::Integration(failure))))
    }

    /// Takes one step; does nothing at `t_end`.
    ///
    /// # Errors
    /// [`LatticeStop`] with the last good state, now and ever after.
    pub fn advance(&mut self) -> Result<(), LatticeStop<N>> {
        if let Some(stop) = &self.stop {
            return Err(stop.clone());
        }
        if self.is_finished() {
            return Ok(());
        }
        let (t, before) = (self.t(), *self.steps.y());
        let reason = match self.steps.advance() {
            Err(failure) => Some(StopReason::Integration(failure)),
            Ok(()) => self.unresolved(&before),
        };
        let Some(reason) = reason else { return Ok(()) };
        let stop = LatticeStop { t, lattice: self.lattice_at(t, &before), reason };
        self.stop = Some(stop.clone());
        Err(stop)
    }

    /// Takes all steps.
    ///
    /// # Errors
    /// Those of [`advance`](Self::advance).
    pub fn finish(&mut self) -> Result<Lattice<N>, LatticeStop<N>> {
        while !self.is_finished() {
            self.advance()?;
        }
        Ok(self.lattice())
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.stop.as_ref().map_or_else(|| self.steps.t(), |stop| stop.t)
    }

    /// State reached, in the labels of the start.
    #[must_use]
    pub fn lattice(&self) -> Lattice<N> {
        self.stop
            .as_ref()
            .map_or_else(|| self.lattice_at(self.steps.t(), self.steps.y()), |stop| stop.lattice)
    }

    /// `t_end` is reached.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.stop.is_none() && self.steps.is_finished()
    }

    /// Steps, and flows of the last piece.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        self.steps.statistics()
    }

    fn lattice_at(&self, t: f64, state: &M::Framed<f64>) -> Lattice<N> {
        let mut lattice = Lattice::from_framed::<M>(&self.couplings, state);
        if let Some((generator, side)) = &self.whirl {
            let turn = (generator * (t - self.t0)).skew_exponential();
            let frame = match side {
                MetricSide::Body => &mut lattice.right,
                MetricSide::Space => &mut lattice.left,
            };
            *frame = turn * *frame;
        }
        lattice.relabelled(&self.sorting.transpose())
    }

    /// The pole that the last step did not resolve.
    fn unresolved(&self, before: &M::Framed<f64>) -> Option<StopReason> {
        let after = self.steps.y();
        let places = &after.as_ref()[..N];
        if M::LATTICE.variables == Variables::Stretches && places.iter().any(|place| *place <= 0.0) {
            return Some(StopReason::Conversion(Error::Placement { determinant: 0.0 }));
        }
        let pairs = (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b))).enumerate();
        pairs
            .filter_map(|(k, (a, b))| {
                let [m, n] = self.coupled(after, k);
                let [from, to] = [before, after].map(|state| distances::<N, M>(state, a, b));
                let poles = [(m, from[0], to[0]), (n, from[1], to[1])];
                let near =
                    |(coupling, from, to): &(f64, f64, f64)| *coupling != 0.0 && *to / *from < RESOLVED;
                poles.into_iter().find(near).map(|(_, _, to)| to.abs())
            })
            .next()
            .map(|distance| StopReason::Coincidence { distance })
    }

    /// `M_ab` and `N_ab` of the pair in the place `k`.
    fn coupled(&self, state: &M::Framed<f64>, k: usize) -> [f64; 2] {
        match N {
            2 => [self.couplings.as_ref()[0], self.couplings.as_ref()[1]],
            _ => [state.as_ref()[2 * N + k], state.as_ref()[2 * N + N * (N - 1) / 2 + k]],
        }
    }
}

impl<const N: usize, M: LatticePieces<N>> fmt::Debug for LatticeSplitting<'_, N, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LatticeSplitting")
            .field("steps", &self.steps)
            .field("stop", &self.stop)
            .finish_non_exhaustive()
    }
}

/// How far a pair is from the pole of `M_ab` and from that of `N_ab`, with a sign; the latter is none on the line.
fn distances<const N: usize, M: LatticeForm<N>>(state: &M::Framed<f64>, a: usize, b: usize) -> [f64; 2] {
    let apart = state.as_ref()[a] - state.as_ref()[b];
    match M::LATTICE.variables {
        Variables::Angles => [libm::sin(0.5 * apart), libm::cos(0.5 * apart)],
        Variables::LogStretches | Variables::Stretches => [apart, 1.0],
    }
}

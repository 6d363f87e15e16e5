//! What models of several tests are stated by: kinetic terms as the oracle knows them, states, and the phase points that
//! models make of these.

use core::ops::Range;

use affine_oracle::{Matrix as Exact, Random, State, Term, rational};

/// States of a body in dimension `n`, with its centre of mass where there is translation.
pub(crate) fn states(n: usize, seeds: Range<u64>, translation: bool) -> Vec<State> {
    let of_seed = |seed| {
        let state = Random::new(seed).state(n);
        if translation { state } else { State { x: Exact::zeros(n, 1), ..state.at_rest() } }
    };
    seeds.map(of_seed).collect()
}

/// The same states without momenta.
pub(crate) fn at_rest(states: &[State]) -> Vec<State> {
    states.iter().map(State::at_rest).collect()
}

/// Each state without momenta, and then as it is.
pub(crate) fn at_rest_and_moving(states: &[State]) -> Vec<State> {
    states.iter().flat_map(|state| [state.at_rest(), state.clone()]).collect()
}

/// Whether a model has translation, by the word that stands in its row.
macro_rules! is_moving {
    (pinned) => {
        false
    };
    (moving) => {
        true
    };
}
pub(crate) use is_moving;

/// The phase point of a state by `at_momentum`.
macro_rules! phase_point {
    (pinned $model:ident $state:ident) => {{
        let (phi, pi) = ($state.phi.to_f64(), $state.pi.to_f64());
        $model.at_momentum(matrix(&phi), TwoPoint(matrix(&pi))).unwrap()
    }};
    (moving $model:ident $state:ident) => {{
        let (phi, pi) = ($state.phi.to_f64(), $state.pi.to_f64());
        let (x, p) = (vector(&$state.x.to_f64()), vector(&$state.p.to_f64()));
        $model.at_momentum(x, matrix(&phi), p, TwoPoint(matrix(&pi))).unwrap()
    }};
}
pub(crate) use phase_point;

pub(crate) fn body_inertia(n: usize) -> Term {
    Term::body_inertia(n, rational(3, 2))
}

pub(crate) fn space_inertia(n: usize) -> Term {
    Term::space_inertia(n, rational(3, 2))
}

pub(crate) fn casimir2(_n: usize) -> Term {
    Term::Casimir2(rational(1, 4))
}

pub(crate) fn casimir1_squared(_n: usize) -> Term {
    Term::Casimir1Squared(rational(1, 8))
}

pub(crate) fn body_translation(_n: usize) -> Term {
    Term::BodyTranslation(rational(5, 4))
}

pub(crate) fn space_translation(_n: usize) -> Term {
    Term::SpaceTranslation(rational(5, 4))
}

pub(crate) fn dalembert_scalar(n: usize) -> Term {
    Term::dalembert(n, rational(3, 2))
}

pub(crate) fn dalembert(n: usize) -> Term {
    Term::DAlembert(diagonal(n))
}

/// `diag(1, 3/2, 2)`, or its first two rows and columns.
pub(crate) fn diagonal(n: usize) -> Exact {
    (0..n).fold(Exact::zeros(n, n), |sum, a| &sum + &Exact::unit(n, a, a).scaled(&rational([2, 3, 4][a], 2)))
}

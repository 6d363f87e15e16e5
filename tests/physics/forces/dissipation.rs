//! Rayleigh's dissipation function, in every frame under kinetic energies of every frame.

use affine_oracle::{Kinetic, Motion, Observable, State, Term, rational};
use affine_runtime::model::{Conserved, StateVector};
use affine_runtime::prelude::*;

use crate::canonical::{T0, assert_charts_lead_back, assert_reduced_equations_move, groups};
use crate::conserved::{exists, listed_as_a_whole};
use crate::families::{matrix, vector};
use crate::integrate::extrapolated;
use crate::stated::{
    at_rest, at_rest_and_moving, body_inertia, body_translation, casimir1_squared, casimir2, dalembert,
    diagonal, is_moving, phase_point, space_inertia, space_translation, states,
};
use affine_tests::reference::{Reference, assert_close};
use affine_tests::tolerances::{DAMPED, POWER_BALANCE};

/// How long energy is lost.
const DURATION: f64 = 0.125;

/// A damped model, with both forms stated a second time for the oracle.
trait Damped<const N: usize>: Model<N> + Sized {
    const TRANSLATION: bool;

    fn body() -> Self;
    fn kinetic() -> Kinetic;
    fn dissipation() -> Kinetic;
    fn at(&self, state: &State) -> Self::Point<f64>;

    fn states() -> Vec<State> {
        states(N, 7001..7004, Self::TRANSLATION)
    }
}

fn motion<'k>(kinetic: &'k Kinetic, state: &State, dissipation: &Kinetic) -> Motion<'k> {
    kinetic.motion(state).unwrap().damped(dissipation).unwrap()
}

fn number(value: &affine_oracle::Matrix) -> f64 {
    value.to_f64()[0]
}

/// Hamilton's equations with the forces, and their power: the derivative of `H` along the exact vector field.
fn agrees_with_the_oracle<const N: usize, M: Damped<N>>() {
    let (model, kinetic, dissipation) = (M::body(), M::kinetic(), M::dissipation());
    for state in M::states() {
        let reference = Reference::damped(&kinetic, &state, &dissipation);
        let point = model.at(&state);
        let rates = model.hamilton_equations(T0, &model.flatten(&point));
        for (name, rate) in groups(M::DESCRIPTION.full, rates.as_ref()) {
            reference.assert_rate(name, rate, DAMPED);
        }
        let exact = number(&motion(&kinetic, &state, &dissipation).bracket(Observable::Energy).unwrap());
        assert!(exact < 0.0, "the samples lose energy: {exact}");
        let tolerance = DAMPED * reference.condition * reference.condition;
        assert_close("power", &[model.power(T0, &point)], &[exact], exact.abs(), tolerance);

        let (reduced, constants) = model.reduce(T0, &point);
        let rates = model.reduced_equations(T0, &constants, &reduced);
        let work =
            groups(M::DESCRIPTION.reduced, rates.as_ref()).into_iter().find(|(name, _)| *name == "work");
        assert_close("work", work.unwrap().1, &[exact], exact.abs(), tolerance);
        assert_eq!(*reduced.as_ref().last().unwrap(), 0.0, "no work at the start");
        assert_eq!(M::Reduced::<f64>::LEN, reduced.as_ref().len());
    }
}

/// `expand` undoes `reduce`; its derivative along the reduced equations is the vector field of the oracle.
fn reduction_keeps_the_motion<const N: usize, M: Damped<N>>() {
    let (model, kinetic, dissipation) = (M::body(), M::kinetic(), M::dissipation());
    for state in at_rest_and_moving(&M::states()) {
        let point = model.at(&state);
        let tolerance = DAMPED * kinetic.condition(&state.phi).unwrap();
        assert_charts_lead_back(&model, &point, &state, tolerance);
        assert_reduced_equations_move(&model, &point, DAMPED, &|_, state| {
            Reference::damped(&kinetic, state, &dissipation)
        });
    }
}

/// What is listed has rate 0 along the damped motion, exactly; what is not listed has not.
fn lists_are_exact<const N: usize, M: Damped<N>>() {
    let body = (&M::kinetic(), &M::dissipation());
    assert_listed(body, M::DESCRIPTION.conserved, &M::states(), M::TRANSLATION);
    assert_listed(body, M::DESCRIPTION.conserved_at_rest, &at_rest(&M::states()), false);
}

/// Of no model, so that it is compiled once.
fn assert_listed(
    (kinetic, dissipation): (&Kinetic, &Kinetic),
    listed: &[Conserved],
    states: &[State],
    translation: bool,
) {
    let n = kinetic.dimension();
    let motions: Vec<Motion> = states.iter().map(|state| motion(kinetic, state, dissipation)).collect();
    let brackets = |of| motions.iter().map(|motion| motion.bracket(of).unwrap()).collect();
    let listed = listed_as_a_whole(listed, &|of| exists(of, n, translation), 0.0, &brackets);
    for &quantity in Observable::ALL {
        let conserved = exists(quantity, n, translation)
            && motions.iter().all(|motion| motion.bracket(quantity).unwrap().is_zero());
        assert_eq!(listed.contains(&quantity), conserved, "{quantity:?} listed");
    }
}

/// `H(t) - H(t0)` is the work done along the reduced equations. For a short time: an indefinite metric turns friction
/// into a growing motion.
fn work_is_lost_energy<const N: usize, M: Damped<N>>() {
    let model = M::body();
    let start = model.at(&M::states()[0]);
    let (reduced, constants) = model.reduce(T0, &start);
    let equations = |reduced: &M::Reduced<f64>| model.reduced_equations(T0, &constants, reduced);
    let end = extrapolated(&equations, reduced, DURATION, 16);
    let after = model.hamiltonian(T0, &model.expand(T0, &constants, &end));
    let before = model.hamiltonian(T0, &start);
    let work = *end.as_ref().last().unwrap();
    assert!(work < 0.0, "{work}");
    assert_close("energy", &[after - before], &[work], before.abs().max(after.abs()), POWER_BALANCE);
}

/// The same of runs, by the explicit and the implicit methods.
fn balance_closes<const N: usize, M: Damped<N>>() {
    let model = M::body();
    let start = model.at(&M::states()[0]);
    for method in [Method::Automatic, Method::Gauss { stages: 3, step: 1e-3 }, Method::Radau { stages: None }]
    {
        let run =
            Simulation::new(&model, start).until(DURATION).tolerance(1e-12).method(method).run().unwrap();
        let balance = run.power_balance().unwrap();
        assert!(balance.work < 0.0 && balance.energy < 0.0, "{balance}");
        assert!(balance.relative() <= POWER_BALANCE, "{method:?}: {balance}");
        assert_eq!(run.conservation().balance(), Some(&balance));
        assert!(run.conservation().to_string().contains("work of the forces"));
        assert_eq!(run.work().len(), run.len());
        assert_eq!(run.work()[0], 0.0);
    }
}

fn body_friction(n: usize) -> Term {
    Term::BodyInertia(diagonal(n))
}

fn space_friction(n: usize) -> Term {
    Term::SpaceInertia(diagonal(n))
}

fn flat_friction(n: usize) -> Term {
    Term::DAlembert(diagonal(n).scaled(&rational(1, 2)))
}

/// `1/4 tr (O + O^T)^2 / 2`: what does not turn.
fn body_shear(n: usize) -> Term {
    Term::body_inertia(n, rational(1, 4))
}

fn space_shear(n: usize) -> Term {
    Term::space_inertia(n, rational(1, 4))
}

/// A square of one combination of the entries: `1/2 (O_11 + 2 O_12 - O_21)^2`.
fn one_square(n: usize) -> affine_oracle::Matrix {
    let mut weights = vec![0.0; n * n];
    (weights[0], weights[1], weights[n]) = (1.0, 2.0, -1.0);
    let row = affine_oracle::Matrix::from_f64("K", 1, n * n, &weights).unwrap();
    &row.transpose() * &row
}

fn body_square(n: usize) -> Term {
    Term::BodyTensor(one_square(n))
}

fn flat_square(n: usize) -> Term {
    Term::FlatTensor(one_square(n))
}

fn body_drag(_n: usize) -> Term {
    Term::BodyTranslation(rational(3, 4))
}

fn space_drag(_n: usize) -> Term {
    Term::SpaceTranslation(rational(1, 2))
}

/// Tests of one model.
macro_rules! damped {
    ($n:literal $centre:ident [$($term:ident)*] ($($kinetic:tt)*) [$($drag:ident)*] ($($dissipation:tt)*)
        $($runs:ident)?) => {
        #[allow(clippy::wildcard_imports)]
        use super::super::super::*;

        #[affine_model(dim = $n, kinetic($($kinetic)*), dissipation($($dissipation)*))]
        struct Body;

        impl Damped<$n> for Body {
            const TRANSLATION: bool = is_moving!($centre);

            fn body() -> Self {
                Body
            }
            fn kinetic() -> Kinetic {
                Kinetic::new($n, vec![$($term($n)),*]).unwrap()
            }
            fn dissipation() -> Kinetic {
                Kinetic::new($n, vec![$($drag($n)),*]).unwrap()
            }
            fn at(&self, state: &State) -> Self::Point<f64> {
                phase_point!($centre self state)
            }
        }

        #[test]
        fn full_equations() {
            agrees_with_the_oracle::<$n, Body>();
        }
        #[test]
        fn reduced_equations() {
            reduction_keeps_the_motion::<$n, Body>();
        }
        #[test]
        fn conserved_quantities() {
            lists_are_exact::<$n, Body>();
        }
        #[test]
        fn power_balance() {
            work_is_lost_energy::<$n, Body>();
        }
        $(
            #[test]
            fn $runs() {
                balance_closes::<$n, Body>();
            }
        )?
    };
}

/// Every dissipation with one kind of kinetic energy, in the plane and in space. One of them for each kind is followed by
/// runs: what runs do is one text for all, and is long to compile.
macro_rules! under_each {
    ($($kind:ident: $centre:ident $terms:tt $plane:tt $space:tt;)*) => { $(
        mod $kind {
            under_each! { @$centre $terms $plane $space }
        }
    )* };
    (@pinned $terms:tt $plane:tt $space:tt) => {
        under_each! { @each pinned $terms $plane $space
            bulk: [casimir1_squared] (casimir1_squared = 1/8) (casimir1_squared = 1/8);
            body_shear: [body_shear casimir2] (body_inertia = 1/4, casimir2 = 1/4) (body_inertia = 1/4, casimir2 = 1/4);
            space_shear: [space_shear casimir2]
                (space_inertia = 1/4, casimir2 = 1/4) (space_inertia = 1/4, casimir2 = 1/4);
            of_the_body: [body_friction casimir2]
                (body_inertia = diag(1, 1.5), casimir2 = 1/4) (body_inertia = diag(1, 1.5, 2), casimir2 = 1/4);
            of_space: [space_friction] (space_inertia = diag(1, 1.5)) (space_inertia = diag(1, 1.5, 2));
            flat: [flat_friction] (dalembert = diag(0.5, 0.75)) (dalembert = diag(0.5, 0.75, 1)) runs;
        }
    };
    (@moving $terms:tt $plane:tt $space:tt) => {
        under_each! { @each moving $terms $plane $space
            bulk: [casimir1_squared] (casimir1_squared = 1/8) (casimir1_squared = 1/8);
            body_drag: [body_drag] (body_translation = 3/4) (body_translation = 3/4);
            space_drag: [space_drag] (space_translation = 1/2) (space_translation = 1/2);
            everything: [body_friction space_friction flat_friction casimir1_squared body_drag space_drag]
                (body_inertia = diag(1, 1.5), space_inertia = diag(1, 1.5), dalembert = diag(0.5, 0.75),
                    casimir1_squared = 1/8, body_translation = 3/4, space_translation = 1/2)
                (body_inertia = diag(1, 1.5, 2), space_inertia = diag(1, 1.5, 2), dalembert = diag(0.5, 0.75, 1),
                    casimir1_squared = 1/8, body_translation = 3/4, space_translation = 1/2) runs;
        }
    };
    (@each $centre:ident $terms:tt $plane:tt $space:tt
        $($name:ident: $drag:tt $dissipation:tt $dissipation3:tt $($runs:ident)?;)*) => { $(
        mod $name {
            mod plane {
                damped! { 2 $centre $terms $plane $drag $dissipation $($runs)? }
            }
            mod space {
                damped! { 3 $centre $terms $space $drag $dissipation3 $($runs)? }
            }
        }
    )* };
}

under_each! {
    left: pinned [body_inertia casimir2 casimir1_squared]
        (body_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125)
        (body_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125);
    right: pinned [space_inertia casimir2 casimir1_squared]
        (space_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125)
        (space_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125);
    affine_affine: pinned [casimir2 casimir1_squared]
        (casimir2 = 0.25, casimir1_squared = 0.125)
        (casimir2 = 0.25, casimir1_squared = 0.125);
    dalembert: pinned [dalembert]
        (dalembert = diag(1, 1.5))
        (dalembert = diag(1, 1.5, 2));
    left_missile: moving [body_inertia casimir2 body_translation]
        (body_inertia = 1.5, casimir2 = 0.25, body_translation = 1.25)
        (body_inertia = 1.5, casimir2 = 0.25, body_translation = 1.25);
    right_drift: moving [space_inertia casimir2 space_translation]
        (space_inertia = 1.5, casimir2 = 0.25, space_translation = 1.25)
        (space_inertia = 1.5, casimir2 = 0.25, space_translation = 1.25);
    affine_missile: moving [casimir2 casimir1_squared body_translation]
        (casimir2 = 0.25, casimir1_squared = 0.125, body_translation = 1.25)
        (casimir2 = 0.25, casimir1_squared = 0.125, body_translation = 1.25);
}

mod special {
    mod squares {
        mod of_the_body {
            damped! { 2 pinned [body_inertia casimir2] (body_inertia = 1.5, casimir2 = 0.25)
            [body_square] (body_tensor = [[1, 2, -1, 0], [2, 4, -2, 0], [-1, -2, 1, 0], [0, 0, 0, 0]]) runs }
        }
        mod flat {
            damped! { 2 moving [dalembert space_translation] (dalembert = diag(1, 1.5), space_translation = 1.25)
            [flat_square] (flat_tensor = [[1, 2, -1, 0], [2, 4, -2, 0], [-1, -2, 1, 0], [0, 0, 0, 0]]) runs }
        }
    }
}

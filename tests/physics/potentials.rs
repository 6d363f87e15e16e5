//! Generated code with potentials against the oracle: every potential with every kind of kinetic energy, n = 2 and 3,
//! its coefficient a literal and a field.

use core::ops::Range;

use affine_oracle::{Differential, Kinetic, Motion, Observable, Place, Slopes, State};
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

use crate::canonical::{T0, assert_charts_lead_back, assert_reduced_equations_move, groups};
use crate::conserved::{exists, listed_as_a_whole};
use crate::families::{matrix, vector};
use crate::stated::{
    at_rest, at_rest_and_moving, body_inertia, body_translation, casimir1_squared, casimir2, dalembert,
    dalembert_scalar, is_moving, phase_point, space_inertia, space_translation, states,
};
use affine_tests::reference::{Reference, assert_close};
use affine_tests::tolerances::{BRACKET_VISIBLE, BRACKET_ZERO, UNDER_POTENTIAL};

/// The coefficient of every potential.
pub(crate) const C: f64 = 1.75;

/// A model under a potential, with both stated a second time for the oracle.
pub(crate) trait Loaded<const N: usize>: Model<N> + Sized {
    const TRANSLATION: bool;
    /// The potential depends on `x`: a body at rest does not stay there.
    const HELD: bool;
    /// In roundings times the condition of the kinetic energy.
    const TOLERANCE: f64 = UNDER_POTENTIAL;
    /// Seeds of the states.
    const SEEDS: Range<u64> = 2003..2007;

    fn body() -> Self;
    fn kinetic() -> Kinetic;
    fn potential(place: &Place) -> Differential;
    fn at(&self, state: &State) -> Self::Point<f64>;

    fn states() -> Vec<State> {
        states(N, Self::SEEDS, Self::TRANSLATION)
    }
}

/// Hamiltonian and Hamilton's equations.
pub(crate) fn agrees_with_the_oracle<const N: usize, M: Loaded<N>>() {
    let (model, kinetic) = (M::body(), M::kinetic());
    for state in M::states() {
        let reference = Reference::under(&kinetic, &state, T0, &M::potential);
        let point = model.at(&state);
        let tolerance = M::TOLERANCE * reference.condition;
        let energy = reference.expected.hamiltonian;
        assert_close("H", &[model.hamiltonian(T0, &point)], &[energy], reference.energy_size(), tolerance);
        let rates = model.hamilton_equations(T0, &model.flatten(&point));
        for (name, rate) in groups(M::DESCRIPTION.full, rates.as_ref()) {
            reference.assert_rate(name, rate, M::TOLERANCE);
        }
    }
}

/// `expand` undoes `reduce`; its derivative along the reduced equations is the vector field of the oracle. At `p = 0`
/// too, where a turn of space has nothing to hold on to.
pub(crate) fn reduction_keeps_the_motion<const N: usize, M: Loaded<N>>() {
    let (model, kinetic) = (M::body(), M::kinetic());
    for state in at_rest_and_moving(&M::states()) {
        let point = model.at(&state);
        let tolerance = M::TOLERANCE * kinetic.condition(&state.phi).unwrap();
        assert_charts_lead_back(&model, &point, &state, tolerance);
        assert_reduced_equations_move(&model, &point, M::TOLERANCE, &|t, state| {
            Reference::under(&kinetic, state, t, &M::potential)
        });
    }
}

/// The lists of conserved quantities are those whose brackets with `H` vanish: nothing is missing, nothing is claimed.
pub(crate) fn lists_are_exact<const N: usize, M: Loaded<N>>() {
    let description = M::DESCRIPTION;
    let body = (&M::kinetic(), &M::potential as &dyn Fn(&Place) -> Differential);
    assert_listed(body, description.conserved, &M::states(), M::TRANSLATION);
    if M::HELD {
        // No motion keeps p = 0, so nothing can be promised beyond what all motions conserve.
        for quantity in description.conserved_at_rest {
            assert!(description.conserved.contains(quantity), "{quantity:?} of a body at rest");
        }
    } else {
        assert_listed(body, description.conserved_at_rest, &at_rest(&M::states()), false);
    }
}

/// Of no model, so that it is compiled once.
fn assert_listed(
    (kinetic, potential): (&Kinetic, &dyn Fn(&Place) -> Differential),
    listed: &[Conserved],
    states: &[State],
    translation: bool,
) {
    let n = kinetic.dimension();
    let motions: Vec<Motion> =
        states.iter().map(|state| kinetic.motion(state).unwrap().under(T0, potential).unwrap()).collect();
    let brackets = |of| motions.iter().map(|motion| motion.bracket(of).unwrap()).collect();
    let listed = listed_as_a_whole(listed, &|of| exists(of, n, translation), BRACKET_ZERO, &brackets);
    for &observable in Observable::ALL {
        let expected = if observable == Observable::Energy {
            // The oracle's observable is the kinetic energy alone; dH/dt = dU/dt.
            states
                .iter()
                .all(|state| Slopes::of(potential, T0, &state.x.to_f64(), &state.phi.to_f64()).t == 0.0)
        } else if !exists(observable, n, translation) {
            false
        } else {
            let rates = motions.iter().flat_map(|motion| motion.bracket(observable).unwrap().to_f64());
            let largest = rates.fold(0.0, |largest: f64, rate| largest.max(rate.abs()));
            assert!(
                largest <= BRACKET_ZERO || largest > BRACKET_VISIBLE,
                "{observable:?} undecided: {largest:e}"
            );
            largest <= BRACKET_ZERO
        };
        assert_eq!(listed.contains(&observable), expected, "{observable:?} listed");
    }
}

/// Tests of one model.
macro_rules! loaded {
    ($n:literal $centre:ident $held:ident $form:ident [$($term:ident)*] ($($kinetic:tt)*) ($($potential:tt)*) $energy:expr) => {
        #[allow(clippy::wildcard_imports)]
        use super::super::super::*;

        loaded! { @$form $n ($($kinetic)*) ($($potential)*) }

        impl Loaded<$n> for Form {
            const TRANSLATION: bool = is_moving!($centre);
            const HELD: bool = loaded!(@held $held);

            fn body() -> Self {
                form()
            }
            fn kinetic() -> Kinetic {
                Kinetic::new($n, vec![$($term($n)),*]).unwrap()
            }
            fn potential(place: &Place) -> Differential {
                let energy: fn(&Place) -> Differential = $energy;
                energy(place) * C
            }
            fn at(&self, state: &State) -> Self::Point<f64> {
                phase_point!($centre self state)
            }
        }

        #[test]
        fn full_equations() {
            agrees_with_the_oracle::<$n, Form>();
        }
        #[test]
        fn reduced_equations() {
            reduction_keeps_the_motion::<$n, Form>();
        }
        #[test]
        fn conserved_quantities() {
            lists_are_exact::<$n, Form>();
        }
    };
    (@literal $n:literal ($($kinetic:tt)*) ($($potential:tt)*)) => {
        #[affine_model(dim = $n, kinetic($($kinetic)*), potential = 7/4*($($potential)*))]
        struct Body;
        type Form = Body;
        fn form() -> Form {
            Body
        }
    };
    (@field $n:literal ($($kinetic:tt)*) ($($potential:tt)*)) => {
        #[affine_model(dim = $n, kinetic($($kinetic)*), potential = c*($($potential)*))]
        struct Body {
            c: f64,
        }
        type Form = PreparedBody;
        fn form() -> Form {
            Body { c: C }.prepare().unwrap()
        }
    };
    (@held free) => { false };
    (@held held) => { true };
}

/// Every potential with one kind of kinetic energy: fields in the plane, literals in space, and both in both where the
/// potential is one that everybody uses.
macro_rules! under_each {
    ($($kind:ident: $centre:ident $terms:tt $plane:tt $space:tt;)*) => { $(
        mod $kind {
            under_each! { @isotropic $centre $terms $plane $space }
            under_each! { @$centre $terms $plane $space }
        }
    )* };
    (@isotropic $centre:ident $terms:tt $plane:tt $space:tt) => {
        under_each! { @each $centre free $terms $plane $space
            hyperbolic_dilatation: field literal (1/2*sinh(q)^2) |place| place.q().sinh().power(2) * 0.5;
            hyperbolic_dilatation_given: literal field (1/2*sinh(q)^2) |place| place.q().sinh().power(2) * 0.5;
            neo_hookean: field literal (tr(G)*exp(-2*q) - n)
                |place| place.trace_green() * (place.q() * -2.0).exp() - place.n();
            neo_hookean_given: literal field (tr(G)*exp(-2*q) - n)
                |place| place.trace_green() * (place.q() * -2.0).exp() - place.n();
            square_of_green: field literal (tr(G*G)) |place| place.trace_green_squared();
            entries_of_green: field literal (G[1,2]*G[1,1]) |place| place.green(1, 2) * place.green(1, 1);
            entry_of_finger: field literal (Ct[1,2]^2) |place| place.finger(1, 2).power(2);
            entry_of_placement: field literal (phi[1,2]^3) |place| place.phi(1, 2).power(3);
        }
    };
    (@pinned $terms:tt $plane:tt $space:tt) => {};
    (@moving $terms:tt $plane:tt $space:tt) => {
        under_each! { @each moving held $terms $plane $space
            oscillator: field literal (norm(x)^2/2) |place| place.distance().power(2) * 0.5;
            attraction: field literal (-1/norm(x)) |place| (place.distance().ln() * -1.0).exp() * -1.0;
            coordinates: field literal (x[1]^3 + x[1]*x[2]) |place| place.x(1).power(3) + place.x(1) * place.x(2);
            position_and_stretch: field literal (x[1]*tr(G)) |place| place.x(1) * place.trace_green();
        }
    };
    (@each $centre:ident $held:ident $terms:tt $plane:tt $space:tt
        $($name:ident: $form:ident $form3:ident $potential:tt |$place:ident| $energy:expr;)*) => { $(
        mod $name {
            mod plane {
                loaded! { 2 $centre $held $form $terms $plane $potential |$place| $energy }
            }
            mod space {
                loaded! { 3 $centre $held $form3 $terms $space $potential |$place| $energy }
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
    left_body_translation: moving [body_inertia casimir2 casimir1_squared body_translation]
        (body_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125, body_translation = 1.25)
        (body_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125, body_translation = 1.25);
    right_space_translation: moving [space_inertia casimir2 casimir1_squared space_translation]
        (space_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125, space_translation = 1.25)
        (space_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125, space_translation = 1.25);
    affine_affine_body_translation: moving [casimir2 casimir1_squared body_translation]
        (casimir2 = 0.25, casimir1_squared = 0.125, body_translation = 1.25)
        (casimir2 = 0.25, casimir1_squared = 0.125, body_translation = 1.25);
    affine_affine_space_translation: moving [casimir2 casimir1_squared space_translation]
        (casimir2 = 0.25, casimir1_squared = 0.125, space_translation = 1.25)
        (casimir2 = 0.25, casimir1_squared = 0.125, space_translation = 1.25);
    dalembert_scalar: moving [dalembert_scalar space_translation]
        (dalembert = 1.5, space_translation = 1.25)
        (dalembert = 1.5, space_translation = 1.25);
    dalembert_diagonal: pinned [dalembert]
        (dalembert = diag(1, 1.5))
        (dalembert = diag(1, 1.5, 2));
}

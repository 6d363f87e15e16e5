//! Potentials in single stretches and in time against the oracle: n = 2 and 3, every chart, coefficients that are literals
//! and fields, generic placements and coincident stretches.

use affine_oracle::{Differential, Kinetic, Matrix as Exact, Place, Random, State, rational};
use affine_runtime::prelude::*;

use crate::canonical::{T0, groups};
use crate::families::{matrix, vector};
use crate::potentials::{C, Loaded, agrees_with_the_oracle, lists_are_exact, reduction_keeps_the_motion};
use crate::stated::{
    body_inertia, body_translation, casimir1_squared, casimir2, dalembert, is_moving, phase_point,
    space_inertia, space_translation,
};
use affine_tests::reference::Reference;
use affine_tests::tolerances::UNDER_POTENTIAL;

/// `sum_a f(q_a)`.
fn each(place: &Place, f: impl Fn(Differential) -> Differential) -> Differential {
    place.log_stretches().into_iter().map(f).fold(Differential::constant(0.0), |sum, term| sum + term)
}

/// Placements with coincident stretches, with a momentum drawn as for others: turned and scaled ones, two of three
/// stretches equal, the undeformed body.
fn coincident(n: usize) -> Vec<State> {
    let (c, s) = (rational(3, 5), rational(4, 5));
    let zero = || rational(0, 1);
    let one = || rational(1, 1);
    let rotation = match n {
        2 => vec![c.clone(), -s.clone(), s, c],
        _ => vec![c.clone(), -s.clone(), zero(), s, c, zero(), zero(), zero(), one()],
    };
    let rotation = Exact::from_rationals(n, n, &rotation);
    let stretched = |stretches: [i64; 3]| {
        (0..n).fold(Exact::zeros(n, n), |sum, a| {
            &sum + &Exact::unit(n, a, a).scaled(&rational(stretches[a], 2))
        })
    };
    [stretched([2, 2, 2]), stretched([3, 3, 5]), &stretched([1, 1, 3]) * &rotation]
        .into_iter()
        .map(|diagonal| &rotation * &diagonal)
        .chain([stretched([2, 2, 2])])
        .enumerate()
        .map(|(seed, phi)| State { phi, ..Random::new(611 + seed as u64).state(n).at_rest() })
        .collect()
}

/// Hamiltonian and equations where stretches coincide.
fn coincidence_is_smooth<const N: usize, M: Loaded<N>>() {
    let (model, kinetic) = (M::body(), M::kinetic());
    for state in coincident(N) {
        let state = if M::TRANSLATION { state } else { State { x: state.at_rest().p, ..state } };
        let reference = Reference::under(&kinetic, &state, T0, &M::potential);
        let rates = model.hamilton_equations(T0, &model.flatten(&model.at(&state)));
        for (name, rate) in groups(M::DESCRIPTION.full, rates.as_ref()) {
            reference.assert_rate(name, rate, UNDER_POTENTIAL);
        }
    }
}

/// Every potential with every kind of kinetic energy.
macro_rules! stretched {
    ($($kind:ident: $centre:ident $terms:tt $plane:tt $space:tt;)*) => { $(
        mod $kind {
            stretched! { @each $centre $terms $plane $space
                quartic: field literal (q1^4 + q2^4) (q1^4 + q2^4 + q3^4) |place| each(place, |q| q.power(4));
                biot: literal field (Q1 + Q2) (Q1 + Q2 + Q3) |place| each(place, Differential::exp);
                wells: field literal (pairs(cos(d))) (pairs(cos(d))) |place| place.pairs(Differential::cos);
                hyperbolic: literal field (pairs(tanh(d)^2) - q^2) (pairs(tanh(d)^2) - q^2)
                    |place| place.pairs(|d| d.tanh().power(2)) - place.q().power(2);
                stiffened: field literal (tr(G)*pairs(abs(d)^4 + sqrt(d^2 + 1))) (tr(G)*pairs(abs(d)^4 + sqrt(d^2 + 1)))
                    |place| place.trace_green() * place.pairs(|d| d.power(4) + (d * d + 1.0).sqrt());
                oriented: literal field (G[1,2]*pairs(d^2)) (G[1,2]*pairs(d^2))
                    |place| place.green(1, 2) * place.pairs(|d| d * d);
                driven: field literal (cos(2*t)*pairs(cosh(d)) + t*q) (cos(2*t)*pairs(cosh(d)) + t*q)
                    |place| (place.t() * 2.0).cos() * place.pairs(Differential::cosh) + place.t() * place.q();
            }
        }
    )* };
    (@each $centre:ident $terms:tt $plane:tt $space:tt
        $($name:ident: $form:ident $form3:ident $potential:tt $potential3:tt |$place:ident| $energy:expr;)*) => { $(
        mod $name {
            mod plane {
                loaded! { 2 $centre free $form $terms $plane $potential |$place| $energy }
                #[test]
                fn coincident_stretches() {
                    coincidence_is_smooth::<2, Form>();
                }
            }
            mod space {
                loaded! { 3 $centre free $form3 $terms $space $potential3 |$place| $energy }
                #[test]
                fn coincident_stretches() {
                    coincidence_is_smooth::<3, Form>();
                }
            }
        }
    )* };
}

stretched! {
    left: pinned [body_inertia casimir2 casimir1_squared]
        (body_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125)
        (body_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125);
    right_space_translation: moving [space_inertia casimir2 casimir1_squared space_translation]
        (space_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125, space_translation = 1.25)
        (space_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125, space_translation = 1.25);
    left_body_translation: moving [body_inertia casimir2 casimir1_squared body_translation]
        (body_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125, body_translation = 1.25)
        (body_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125, body_translation = 1.25);
    dalembert_diagonal: pinned [dalembert]
        (dalembert = diag(1, 1.5))
        (dalembert = diag(1, 1.5, 2));
}

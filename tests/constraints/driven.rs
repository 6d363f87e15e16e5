//! Forces under constraints. At one state a force is the slope of a potential that is linear in `x` and `phi`: under that
//! the oracle's multipliers give the motion.

use affine_oracle::{
    Constraint, Differential, Kinetic, Matrix as Exact, Observable, Place, State, Term, rational,
};
use affine_runtime::force::Motion;
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

use affine_tests::charts::{
    T0, assert_charts_lead_back, assert_reduced_equations_move, exists, groups, listed_as_a_whole, matrix,
    vector,
};
use affine_tests::fields::{
    Fibre, Kneading, Spring, Stirring, Wind, blown, canonical, kneaded, stirred, under,
};
use affine_tests::group::{Start, assert_components, diagonal, has_another_name, none, starts};
use affine_tests::reference::{Reference, exact_state};
use affine_tests::tolerances::{BRACKET_VISIBLE, BRACKET_ZERO, POWER_BALANCE, UNDER_POTENTIAL};

/// A constrained model with forces, stated a second time for the oracle.
trait Driven<const N: usize>: Model<N> + Sized {
    const CONSTRAINT: Constraint;
    const TRANSLATION: bool;

    fn body() -> Self;
    fn kinetic() -> Kinetic;
    /// The forces on `p` and, row-major, on `Pi`.
    fn push(motion: &Motion<N>) -> (Vec<f64>, Vec<f64>);
    fn at(&self, start: &Start<N>) -> Self::Point<f64>;

    fn points(&self) -> Vec<Self::Point<f64>> {
        starts::<N>(Self::CONSTRAINT).map(|start| self.at(&start)).collect()
    }

    /// The potential whose slopes at the state are the forces, by their parts.
    fn linear(t: f64, state: &State) -> (Vec<f64>, Vec<f64>) {
        let kinetic = Self::kinetic();
        let free = kinetic.constrained_motion(Self::CONSTRAINT, state, t, &none).unwrap().expected().unwrap();
        Self::push(&Motion {
            t,
            x: vector(&state.x.to_f64()),
            phi: matrix(&state.phi.to_f64()),
            x_dot: vector(&free.x_dot),
            phi_dot: matrix(&free.phi_dot),
        })
    }

    fn reference(t: f64, state: &State) -> Reference {
        let (on_p, on_pi) = Self::linear(t, state);
        Reference::confined(&Self::kinetic(), Self::CONSTRAINT, state, t, &|place| {
            energy::<N>(place, &on_p, &on_pi)
        })
    }
}

/// `-F.x - tr(N phi)`
fn energy<const N: usize>(place: &Place, on_p: &[f64], on_pi: &[f64]) -> Differential {
    let mut sum = Differential::constant(0.0);
    for (i, force) in on_p.iter().enumerate().filter(|(_, force)| **force != 0.0) {
        sum = sum - place.x(i + 1) * *force;
    }
    for (k, force) in on_pi.iter().enumerate() {
        sum = sum - place.phi(k % N + 1, k / N + 1) * *force;
    }
    sum
}

fn agrees_with_the_oracle<const N: usize, M: Driven<N>>() {
    let model = M::body();
    let spin = M::DESCRIPTION.full.last().unwrap().name();
    for point in model.points() {
        let state = exact_state(spin, &point);
        let reference = M::reference(T0, &state);
        let rates = model.hamilton_equations(T0, &model.flatten(&point));
        for (name, rate) in groups(M::DESCRIPTION.full, rates.as_ref()) {
            assert_components(&reference, N, name, rate, UNDER_POTENTIAL);
        }
        let tolerance = UNDER_POTENTIAL * reference.condition;
        assert_charts_lead_back(&model, &point, &state, tolerance);
        assert_reduced_equations_move(&model, &point, UNDER_POTENTIAL, &M::reference);
    }
}

/// What is listed does not change along the forced motion; what else does not change at the sampled states is listed too,
/// except where it depends on what a field computes.
fn lists_are_exact<const N: usize, M: Driven<N>>(decided: bool) {
    let (model, kinetic) = (M::body(), M::kinetic());
    let spin = M::DESCRIPTION.full.last().unwrap().name();
    let brackets = |observable: Observable| -> Vec<Exact> {
        let bracket = |point| {
            let state = exact_state(spin, &point);
            let (on_p, on_pi) = M::linear(T0, &state);
            let linear = |place: &Place| energy::<N>(place, &on_p, &on_pi);
            let motion = kinetic.constrained_motion(M::CONSTRAINT, &state, T0, &linear).unwrap();
            motion.bracket(observable).unwrap()
        };
        model.points().into_iter().map(bracket).collect()
    };
    let is_decided = |observable| decided && exists(observable, N, M::TRANSLATION);
    let listed = listed_as_a_whole(M::DESCRIPTION.conserved, &is_decided, BRACKET_ZERO, &brackets);
    for &observable in Observable::ALL {
        if observable == Observable::Energy {
            continue;
        }
        let rates = brackets(observable).into_iter().flat_map(|rate| rate.to_f64());
        let largest = rates.fold(0.0, |largest: f64, rate| largest.max(rate.abs()));
        assert!(
            largest <= BRACKET_ZERO || largest > BRACKET_VISIBLE,
            "{observable:?} undecided: {largest:e}"
        );
        let named = exists(observable, N, M::TRANSLATION) && !has_another_name(M::CONSTRAINT, observable);
        let still = named && largest <= BRACKET_ZERO;
        assert!(!listed.contains(&observable) || still, "{observable:?} listed");
        assert!(!decided || listed.contains(&observable) || !still, "{observable:?} not listed");
    }
}

/// Energy against work along a run that stays on the group.
fn energy_is_accounted_for<const N: usize, M: Driven<N>>() {
    let model = M::body();
    for start in model.points() {
        let run = Simulation::new(&model, start).from(T0).until(T0 + 0.5).tolerance(1e-12).run().unwrap();
        match run.power_balance() {
            Some(balance) => {
                assert!(balance.relative() <= POWER_BALANCE, "{balance}");
                assert!(balance.work.abs() > 1e-4 * balance.scale, "{balance}");
                assert!(!M::DESCRIPTION.conserved.contains(&Conserved::Energy));
            }
            None => {
                assert!(M::DESCRIPTION.conserved.contains(&Conserved::Energy));
                assert!(run.conservation().worst() <= POWER_BALANCE, "{}", run.conservation());
            }
        }
    }
}

macro_rules! driven {
    ($($name:ident: $n:literal $constraint:ident $key:ident $centre:ident $decided:literal ($($spec:tt)*) [$($term:expr),*]
        { $($field:ident: $type:ty = $value:expr),* } |$motion:ident| $push:expr;)*) => { $(
        mod $name {
            #[allow(clippy::wildcard_imports)]
            use super::*;

            #[affine_model(dim = $n, constraint = $key, $($spec)*)]
            struct Body {
                $($field: $type,)*
            }

            impl Driven<$n> for Body {
                const CONSTRAINT: Constraint = Constraint::$constraint;
                const TRANSLATION: bool = driven!(@translation $centre);

                fn body() -> Self {
                    Body { $($field: $value,)* }
                }
                fn kinetic() -> Kinetic {
                    Kinetic::new($n, vec![$($term),*]).unwrap()
                }
                fn push($motion: &Motion<$n>) -> (Vec<f64>, Vec<f64>) {
                    $push
                }
                fn at(&self, start: &Start<$n>) -> Self::Point<f64> {
                    driven!(@point $centre self start).unwrap()
                }
            }

            #[test]
            fn equations() {
                agrees_with_the_oracle::<$n, Body>();
            }
            #[test]
            fn conserved_quantities() {
                lists_are_exact::<$n, Body>($decided);
            }
            #[test]
            fn energy() {
                energy_is_accounted_for::<$n, Body>();
            }
        }
    )* };
    (@translation pinned) => { false };
    (@translation moving) => { true };
    (@point pinned $model:ident $start:ident) => { $model.at_momentum($start.phi, Comoving($start.spin)) };
    (@point moving $model:ident $start:ident) => {
        $model.at_momentum($start.x, $start.phi, $start.p, Comoving($start.spin))
    };
}

/// Rayleigh forces `Q_hat = -body Oh^T`, `Q = -space Om^T - bulk tr(Om) 1`, and `-flat phi_dot^T` on `Pi`.
fn drag<const N: usize>(m: &Motion<N>, [body, space, bulk, flat]: [f64; 4]) -> (Vec<f64>, Vec<f64>) {
    let inverse = m.phi.try_inverse().unwrap();
    let (comoving, spatial) = (inverse * m.phi_dot, m.phi_dot * inverse);
    let q = -spatial.transpose() * space - Matrix::<N>::identity() * (bulk * spatial.trace());
    let q = q - m.phi * m.phi_dot.transpose() * flat;
    canonical(Some(q), Some(-comoving.transpose() * body), None, &m.phi)
}

/// The sum of two forces.
fn both(left: (Vec<f64>, Vec<f64>), right: (Vec<f64>, Vec<f64>)) -> (Vec<f64>, Vec<f64>) {
    let sum = |left: Vec<f64>, right: Vec<f64>| left.iter().zip(&right).map(|(l, r)| l + r).collect();
    (sum(left.0, right.0), sum(left.1, right.1))
}

fn spring(place: &Place) -> Differential {
    place.trace_green() * 0.75
}

fn fibre(place: &Place) -> Differential {
    place.green(1, 1).power(2) * 0.75
}

driven! {
    viscous_isochoric_3: 3 Isochoric isochoric pinned true
        (kinetic(body_inertia = 1.5, casimir2 = 0.25), dissipation(body_inertia = 0.5))
        [Term::body_inertia(3, rational(3, 2)), Term::Casimir2(rational(1, 4))] {} |m| drag(m, [0.5, 0.0, 0.0, 0.0]);
    viscous_isochoric_across_2: 2 Isochoric isochoric moving true
        (kinetic(space_inertia = 1.5, casimir2 = 0.25, space_translation = 1.25), potential = tr(G)/2,
         dissipation(body_inertia = 0.5, dalembert = 0.25))
        [Term::space_inertia(2, rational(3, 2)), Term::Casimir2(rational(1, 4)), Term::SpaceTranslation(rational(5, 4))]
        {} |m| both(drag(m, [0.5, 0.0, 0.0, 0.25]), under(m, |place| place.trace_green() * 0.5));
    damped_top_3: 3 Rigid rigid pinned true
        (kinetic(dalembert = diag(1, 1.5, 2)), potential = phi[3,3], dissipation(space_inertia = 0.5))
        [Term::DAlembert(diagonal(&[2, 3, 4]))] {}
        |m| both(drag(m, [0.0, 0.5, 0.0, 0.0]), under(m, |place| place.phi(3, 3)));
    damped_disc_2: 2 Rigid rigid moving true
        (kinetic(body_inertia = 1.5, body_translation = 1.25), dissipation(body_inertia = 0.5))
        [Term::body_inertia(2, rational(3, 2)), Term::BodyTranslation(rational(5, 4))] {} |m| drag(m, [0.5, 0.0, 0.0, 0.0]);
    bulk_viscous_conformal_3: 3 Conformal conformal pinned true
        (kinetic(body_inertia = 1.5, casimir2 = 0.25), potential = sinh(q)^2, dissipation(casimir1_squared = 0.5))
        [Term::body_inertia(3, rational(3, 2)), Term::Casimir2(rational(1, 4))] {}
        |m| both(drag(m, [0.0, 0.0, 0.5, 0.0]), under(m, |place| place.q().sinh().power(2)));
    viscous_conformal_dalembert_3: 3 Conformal conformal moving true
        (kinetic(dalembert = diag(1, 1.5, 2), space_translation = 1.25),
         dissipation(dalembert = 0.25, casimir1_squared = 0.5))
        [Term::DAlembert(diagonal(&[2, 3, 4])), Term::SpaceTranslation(rational(5, 4))] {}
        |m| drag(m, [0.0, 0.0, 0.5, 0.25]);
    driven_viscous_top_3: 3 Rigid rigid pinned true
        (kinetic(dalembert = diag(1, 1.5, 2)), potential = phi[3,3]*cos(t), dissipation(body_inertia = 0.25))
        [Term::DAlembert(diagonal(&[2, 3, 4]))] {}
        |m| both(drag(m, [0.25, 0.0, 0.0, 0.0]), under(m, |place| place.phi(3, 3) * place.t().cos()));
    stirred_isochoric_3: 3 Isochoric isochoric pinned false
        (kinetic(body_inertia = 1.5, casimir2 = 0.25), forces = custom(field, spatial))
        [Term::body_inertia(3, rational(3, 2)), Term::Casimir2(rational(1, 4))]
        { field: Stirring = Stirring { strength: 0.75 } } |m| stirred(m);
    stirred_top_3: 3 Rigid rigid moving false
        (kinetic(dalembert = diag(1, 1.5, 2), space_translation = 1.25), potential = norm(x)^2/2,
         forces = custom(field, spatial) + custom(wind, translation))
        [Term::DAlembert(diagonal(&[2, 3, 4])), Term::SpaceTranslation(rational(5, 4))]
        { field: Stirring = Stirring { strength: 0.75 }, wind: Wind = Wind { strength: 0.75 } }
        |m| both(both(stirred(m), blown(m)), under(m, |place| place.distance().power(2) * 0.5));
    kneaded_conformal_2: 2 Conformal conformal moving false
        (kinetic(dalembert = 1.5, space_translation = 1.25), forces = custom(field, comoving))
        [Term::dalembert(2, rational(3, 2)), Term::SpaceTranslation(rational(5, 4))]
        { field: Kneading = Kneading { strength: 0.75 } } |m| kneaded(m);
    fibred_isochoric_3: 3 Isochoric isochoric moving false
        (kinetic(body_inertia = 1.5, casimir2 = 0.25, body_translation = 1.25), potential = custom(field, green))
        [Term::body_inertia(3, rational(3, 2)), Term::Casimir2(rational(1, 4)), Term::BodyTranslation(rational(5, 4))]
        { field: Fibre = Fibre { strength: 0.75 } } |m| under(m, fibre);
    sprung_conformal_2: 2 Conformal conformal pinned true
        (kinetic(space_inertia = 1.5, casimir1_squared = 0.125), potential = custom(field, isotropic) + sinh(q)^2)
        [Term::space_inertia(2, rational(3, 2)), Term::Casimir1Squared(rational(1, 8))]
        { field: Spring = Spring { strength: 0.75 } }
        |m| both(under(m, spring), under(m, |place| place.q().sinh().power(2)));
}

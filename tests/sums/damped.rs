//! Rayleigh's function and fields beside sums of frames: the forces are linear in velocities that the equations solve for.

use affine_oracle::{Kinetic, Matrix as Exact, Motion, Observable, Random, Rational, State, Term, rational};
use affine_runtime::force::Motion as At;
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

use affine_tests::charts::{
    T0, assert_charts_lead_back, assert_reduced_equations_move, exists, groups, listed_as_a_whole, matrix,
    vector,
};
use affine_tests::drawn::Coefficients;
use affine_tests::fields::{Fibre, Stirring, Wind, blown, stirred, under};
use affine_tests::reference::{Reference, assert_close, entries};
use affine_tests::tolerances::{DAMPED, MIXED, POWER_BALANCE};

/// Models per statement, and states per model.
const DRAWS: u64 = 3;
const SAMPLES: u64 = 2;

/// A statement of a damped sum, with both forms stated a second time for the oracle.
trait Damped<const N: usize>: Model<N> + Sized {
    const TRANSLATION: bool;

    fn draw(random: &mut Random) -> (Self, Kinetic, Kinetic);
    fn at(&self, state: &State) -> Self::Point<f64>;

    fn models() -> impl Iterator<Item = (Self, Kinetic, Kinetic)> {
        (0..DRAWS).map(|seed| Self::draw(&mut Random::new(6100 + seed)))
    }
}

fn states(n: usize, translation: bool) -> Vec<State> {
    let state = |seed| {
        let state = Random::new(6200 + seed).state(n);
        if translation { state } else { State { x: Exact::zeros(n, 1), ..state.at_rest() } }
    };
    (0..SAMPLES).map(state).collect()
}

fn motion<'k>(kinetic: &'k Kinetic, state: &State, dissipation: &Kinetic) -> Motion<'k> {
    kinetic.motion(state).unwrap().damped(dissipation).unwrap()
}

/// Rounding errors of the factorisation and of the drag, which is linear in what it solves for.
const ROUNDING: f64 = MIXED + DAMPED;

/// Hamilton's equations with the forces, and their power: the derivative of `H` along the exact vector field.
fn agrees_with_the_oracle<const N: usize, M: Damped<N>>() {
    for (model, kinetic, dissipation) in M::models() {
        for state in states(N, M::TRANSLATION) {
            let reference = Reference::damped(&kinetic, &state, &dissipation);
            let point = model.at(&state);
            let velocity = model.velocity(&point);
            reference.assert_rate("x", velocity.x_dot.as_slice(), ROUNDING);
            reference.assert_rate("phi", &entries(&velocity.phi_dot), ROUNDING);
            let rates = model.hamilton_equations(T0, &model.flatten(&point));
            for (name, rate) in groups(M::DESCRIPTION.full, rates.as_ref()) {
                reference.assert_rate(name, rate, ROUNDING);
            }
            let exact = motion(&kinetic, &state, &dissipation).bracket(Observable::Energy).unwrap().to_f64();
            assert!(exact[0] < 0.0, "the samples lose energy: {exact:?}");
            let tolerance = ROUNDING * reference.condition * reference.condition;
            assert_close("power", &[model.power(T0, &point)], &exact, exact[0].abs(), tolerance);
            let (reduced, constants) = model.reduce(T0, &point);
            let rates = model.reduced_equations(T0, &constants, &reduced);
            let rates = groups(M::DESCRIPTION.reduced, rates.as_ref());
            let work = rates.into_iter().find(|(name, _)| *name == "work").unwrap().1;
            assert_close("work", work, &exact, exact[0].abs(), tolerance);
        }
    }
}

/// `expand` undoes `reduce`; its derivative along the reduced equations is the vector field of the oracle.
fn reduction_keeps_the_motion<const N: usize, M: Damped<N>>() {
    for (model, kinetic, dissipation) in M::models() {
        for state in states(N, M::TRANSLATION).into_iter().flat_map(|state| [state.at_rest(), state]) {
            let point = model.at(&state);
            let condition = kinetic.condition(&state.phi).unwrap();
            assert_charts_lead_back(&model, &point, &state, ROUNDING * condition);
            assert_reduced_equations_move(&model, &point, ROUNDING, &|_, state| {
                Reference::damped(&kinetic, state, &dissipation)
            });
        }
    }
}

/// What is listed has rate 0 along the damped motion, exactly; what is not listed has not.
fn lists_are_exact<const N: usize, M: Damped<N>>() {
    let (_, kinetic, dissipation) = M::models().next().unwrap();
    let holds = |listed: &[Conserved], states: Vec<State>, translation: bool| {
        let motions: Vec<Motion> = states.iter().map(|state| motion(&kinetic, state, &dissipation)).collect();
        let brackets = |of| motions.iter().map(|motion| motion.bracket(of).unwrap()).collect();
        let listed = listed_as_a_whole(listed, &|of| exists(of, N, translation), 0.0, &brackets);
        for &quantity in Observable::ALL {
            let conserved = exists(quantity, N, translation)
                && motions.iter().all(|motion| motion.bracket(quantity).unwrap().is_zero());
            assert_eq!(listed.contains(&quantity), conserved, "{quantity:?} listed");
        }
    };
    let states = states(N, M::TRANSLATION);
    let still = states.iter().map(State::at_rest).collect();
    holds(M::DESCRIPTION.conserved, states, M::TRANSLATION);
    holds(M::DESCRIPTION.conserved_at_rest, still, false);
}

/// `H(t) - H(t0)` is the work done, for the explicit and the implicit methods.
fn balance_closes<const N: usize, M: Damped<N>>() {
    let (model, ..) = M::models().next().unwrap();
    let start = model.at(&states(N, M::TRANSLATION)[0]);
    for method in [Method::Automatic, Method::Gauss { stages: 3, step: 1e-3 }, Method::Radau { stages: None }]
    {
        let run = Simulation::new(&model, start).until(0.0625).tolerance(1e-12).method(method).run().unwrap();
        let balance = run.power_balance().unwrap();
        assert!(balance.work < 0.0 && balance.energy < 0.0, "{balance}");
        assert!(balance.relative() <= POWER_BALANCE, "{method:?}: {balance}");
    }
}

/// The square of a field: a mass, an inertia, a friction.
fn square(v: &Coefficients, name: &str) -> Rational {
    v.value(name) * v.value(name)
}

/// `diag(1, 3/2, 2)`, or its first two rows and columns, times a number.
fn diagonal(n: usize, factor: &Rational) -> Exact {
    let entry = |a: usize| rational(i64::try_from(a).unwrap() + 2, 2) * factor;
    (0..n).fold(Exact::zeros(n, n), |sum, a| &sum + &Exact::unit(n, a, a).scaled(&entry(a)))
}

macro_rules! damped {
    ($($name:ident: $n:literal $centre:ident |$v:ident| ($($kinetic:tt)*) [$($term:expr),*]
        ($($dissipation:tt)*) [$($drag:expr),*];)*) => { $(
        mod $name {
            #[allow(clippy::wildcard_imports)]
            use super::*;

            #[affine_model(dim = $n, kinetic($($kinetic)*), dissipation($($dissipation)*))]
            #[allow(dead_code, reason = "one list of fields serves every statement; each reads its own")]
            struct Body { a: f64, b: f64, c: f64, k: f64 }

            impl Damped<$n> for PreparedBody {
                const TRANSLATION: bool = damped!(@translation $centre);

                fn draw(random: &mut Random) -> (Self, Kinetic, Kinetic) {
                    let $v = &Coefficients::random(random, |_| true);
                    let body = Body { a: $v.field("a"), b: $v.field("b"), c: $v.field("c"), k: $v.field("k") };
                    let form = |terms| Kinetic::new($n, terms).unwrap();
                    (body.prepare().unwrap(), form(vec![$($term),*]), form(vec![$($drag),*]))
                }
                fn at(&self, state: &State) -> Self::Point<f64> {
                    let (phi, pi) = (matrix(&state.phi.to_f64()), TwoPoint(matrix(&state.pi.to_f64())));
                    damped!(@point $centre self state phi pi)
                }
            }

            #[test]
            fn full_equations() {
                agrees_with_the_oracle::<$n, PreparedBody>();
            }
            #[test]
            fn reduced_equations() {
                reduction_keeps_the_motion::<$n, PreparedBody>();
            }
            #[test]
            fn conserved_quantities() {
                lists_are_exact::<$n, PreparedBody>();
            }
            #[test]
            fn power() {
                balance_closes::<$n, PreparedBody>();
            }
        }
    )* };
    (@translation pinned) => { false };
    (@translation moving) => { true };
    (@point pinned $model:ident $state:ident $phi:ident $pi:ident) => { $model.at_momentum($phi, $pi).unwrap() };
    (@point moving $model:ident $state:ident $phi:ident $pi:ident) => {
        $model.at_momentum(vector(&$state.x.to_f64()), $phi, vector(&$state.p.to_f64()), $pi).unwrap()
    };
}

damped! {
    flat_and_casimirs_2: 2 pinned |v| (dalembert = 1 + b^2, casimir2 = a/4)
        [Term::dalembert(2, rational(1, 1) + square(v, "b")), Term::Casimir2(v.value("a") * rational(1, 4))]
        (dalembert = c^2) [Term::dalembert(2, square(v, "c"))];
    flat_and_casimirs_3: 3 pinned |v| (dalembert = 1 + b^2, casimir2 = a/4)
        [Term::dalembert(3, rational(1, 1) + square(v, "b")), Term::Casimir2(v.value("a") * rational(1, 4))]
        (body_inertia = c^2, casimir2 = c^2)
        [Term::body_inertia(3, square(v, "c")), Term::Casimir2(square(v, "c"))];
    body_and_space_3: 3 moving |v| (body_inertia = 1 + b^2, space_inertia = c^2, space_translation = k)
        [Term::body_inertia(3, rational(1, 1) + square(v, "b")), Term::space_inertia(3, square(v, "c")),
         Term::SpaceTranslation(v.value("k"))]
        (casimir1_squared = a^2, body_translation = k)
        [Term::Casimir1Squared(square(v, "a")), Term::BodyTranslation(v.value("k"))];
    body_and_space_2: 2 moving |v| (body_inertia = diag(1, 1.5), space_inertia = c^2, body_translation = k)
        [Term::BodyInertia(diagonal(2, &rational(1, 1))), Term::space_inertia(2, square(v, "c")),
         Term::BodyTranslation(v.value("k"))]
        (dalembert = diag(b^2, 3*b^2/2), space_translation = k)
        [Term::DAlembert(diagonal(2, &square(v, "b"))), Term::SpaceTranslation(v.value("k"))];
    everything_3: 3 moving |v|
        (body_inertia = 1, space_inertia = c^2, dalembert = diag(1, 1.5, 2), body_translation = k, space_translation = 0.5)
        [Term::body_inertia(3, rational(1, 1)), Term::space_inertia(3, square(v, "c")),
         Term::DAlembert(diagonal(3, &rational(1, 1))), Term::BodyTranslation(v.value("k")),
         Term::SpaceTranslation(rational(1, 2))]
        (body_inertia = a^2, space_inertia = b^2, dalembert = c^2, body_translation = k)
        [Term::body_inertia(3, square(v, "a")), Term::space_inertia(3, square(v, "b")),
         Term::dalembert(3, square(v, "c")), Term::BodyTranslation(v.value("k"))];
    masses_beside_left_2: 2 moving |v|
        (body_inertia = 1 + b^2, casimir2 = a/4, body_translation = k, space_translation = 0.5)
        [Term::body_inertia(2, rational(1, 1) + square(v, "b")), Term::Casimir2(v.value("a") * rational(1, 4)),
         Term::BodyTranslation(v.value("k")), Term::SpaceTranslation(rational(1, 2))]
        (space_inertia = c^2, body_translation = b^2, space_translation = k)
        [Term::space_inertia(2, square(v, "c")), Term::BodyTranslation(square(v, "b")),
         Term::SpaceTranslation(v.value("k"))];
    masses_beside_right_3: 3 moving |v|
        (space_inertia = 1 + b^2, body_translation = k, space_translation = 0.5)
        [Term::space_inertia(3, rational(1, 1) + square(v, "b")),
         Term::BodyTranslation(v.value("k")), Term::SpaceTranslation(rational(1, 2))]
        (casimir1_squared = c^2) [Term::Casimir1Squared(square(v, "c"))];
}

/// Forces and potentials that fields compute, `N = phi^-1 Q`, under a sum of frames.
mod fields_beside_sums {
    #[allow(clippy::wildcard_imports)]
    use super::*;

    #[affine_model(
        dim = 3,
        kinetic(dalembert = diag(1, 1.5, 2), casimir2 = 0.125, body_translation = 1, space_translation = 0.5),
        potential = custom(fibre, green) + tr(Ct)/2 + norm(x)^2/2,
        forces = custom(field, spatial) + custom(wind, translation)
    )]
    struct Body {
        field: Stirring,
        wind: Wind,
        fibre: Fibre,
    }

    fn kinetic() -> Kinetic {
        Kinetic::new(
            3,
            vec![
                Term::DAlembert(diagonal(3, &rational(1, 1))),
                Term::Casimir2(rational(1, 8)),
                Term::BodyTranslation(rational(1, 1)),
                Term::SpaceTranslation(rational(1, 2)),
            ],
        )
        .unwrap()
    }

    fn reference(kinetic: &Kinetic, t: f64, state: &State) -> Reference {
        let free = kinetic.expected(state).unwrap();
        let at = At {
            t,
            x: vector(&state.x.to_f64()),
            phi: matrix(&state.phi.to_f64()),
            x_dot: vector(&free.x_dot),
            phi_dot: matrix(&free.phi_dot),
        };
        let pushes: [(Vec<f64>, Vec<f64>); 3] = [
            stirred::<3>(&at),
            blown(&at),
            under(&at, |place| {
                place.green(1, 1).power(2) * 0.75
                    + place.trace_green() * 0.5
                    + place.distance().power(2) * 0.5
            }),
        ];
        let mut sum = (vec![0.0; 3], vec![0.0; 9]);
        for (on_p, on_pi) in pushes {
            sum.0.iter_mut().zip(on_p).for_each(|(sum, push)| *sum += push);
            sum.1.iter_mut().zip(on_pi).for_each(|(sum, push)| *sum += push);
        }
        Reference::pushed(kinetic, state, &sum.0, &sum.1)
    }

    #[test]
    fn equations() {
        let kinetic = kinetic();
        let (field, wind) = (Stirring { strength: 0.75 }, Wind { strength: 0.75 });
        let model = Body { field, wind, fibre: Fibre { strength: 0.75 } };
        for state in states(3, true) {
            let (x, p) = (vector(&state.x.to_f64()), vector(&state.p.to_f64()));
            let (phi, pi) = (matrix(&state.phi.to_f64()), TwoPoint(matrix(&state.pi.to_f64())));
            let point = model.at_momentum(x, phi, p, pi).unwrap();
            let expected = reference(&kinetic, T0, &state);
            let rates = model.hamilton_equations(T0, &model.flatten(&point));
            for (name, rate) in groups(<Body as Model<3>>::DESCRIPTION.full, rates.as_ref()) {
                expected.assert_rate(name, rate, ROUNDING);
            }
            assert_reduced_equations_move(&model, &point, ROUNDING, &|t, state| {
                reference(&kinetic, t, state)
            });
            let run =
                Simulation::new(&model, point).from(T0).until(T0 + 0.25).tolerance(1e-12).run().unwrap();
            let balance = run.power_balance().unwrap();
            assert!(
                balance.relative() <= POWER_BALANCE && balance.work.abs() > 1e-4 * balance.scale,
                "{balance}"
            );
        }
    }
}

//! Sums of terms of different frames: generated code against the oracle, which knows nothing of frames but the velocity
//! form of each term, and what becomes of motions into a degenerate mass matrix.

use core::ops::Range;

use affine_oracle::{Differential, Kinetic, Matrix as Exact, Place, State, Term, rational};
use affine_runtime::model::Model;
use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;
use affine_runtime::{Error, error::IllPosed};

use crate::canonical::T0;
use crate::families::{Velocity, matrix, vector};
use crate::potentials::{Loaded, agrees_with_the_oracle, lists_are_exact, reduction_keeps_the_motion};
use crate::stated::{diagonal, is_moving, phase_point};
use affine_tests::reference::{Reference, assert_close, entries, norm};
use affine_tests::tolerances::{DEGENERATION, MIXED, TWO_METHODS};

/// A model of a mixed sum that makes phase points of velocities too.
trait Sum<const N: usize>: Loaded<N> {
    fn moving(&self, x: Vector<N>, phi: Matrix<N>, velocity: &Velocity<N>) -> Self::Point<f64>;
}

fn no_potential(place: &Place) -> Differential {
    place.q() * 0.0
}

/// Velocities, the kinetic energy and the way back from velocities.
fn velocities_agree<const N: usize, M: Sum<N>>() {
    let (model, kinetic) = (M::body(), M::kinetic());
    for state in M::states() {
        let reference = Reference::under(&kinetic, &state, T0, &M::potential);
        let point = model.at(&state);
        let tolerance = MIXED * reference.condition;

        let velocity = model.velocity(&point);
        reference.assert_rate("x", velocity.x_dot.as_slice(), MIXED);
        reference.assert_rate("phi", &entries(&velocity.phi_dot), MIXED);

        let kinetic_energy = Reference::new(&kinetic, &state).expected.hamiltonian;
        let found = model.kinetic_energy(point.phi(), &velocity);
        assert_close("T", &[found], &[kinetic_energy], reference.energy_size(), tolerance);

        let back = model.moving(point.x(), *point.phi(), &velocity);
        let (p, pi) = (state.p.to_f64(), state.pi.to_f64());
        assert_close("p of velocity", back.p().as_slice(), &p, norm(&p), tolerance);
        assert_close("Pi of velocity", &entries(&back.pi().0.0), &pi, norm(&pi), tolerance);
    }
}

/// `diag(1, 3/2, 2)`, or its first rows and columns, times a number.
fn halves(n: usize, halves: i64) -> Exact {
    diagonal(n).scaled(&rational(halves, 2))
}

/// Tests of one sum in one dimension.
macro_rules! sum {
    ($n:literal $form:ident $centre:ident $held:ident [$($term:expr),*] ($($kinetic:tt)*) $potential:tt $energy:expr) => {
        #[allow(clippy::wildcard_imports)]
        use super::super::*;

        sum! { @$form $n ($($kinetic)*) $potential }

        impl Loaded<$n> for Form {
            const TRANSLATION: bool = is_moving!($centre);
            const HELD: bool = sum!(@held $held);
            const TOLERANCE: f64 = MIXED;
            const SEEDS: Range<u64> = 3001..3007;

            fn body() -> Self {
                form()
            }
            fn kinetic() -> Kinetic {
                let terms: Vec<fn(usize) -> Term> = vec![$($term),*];
                Kinetic::new($n, terms.iter().map(|term| term($n)).collect()).unwrap()
            }
            fn potential(place: &Place) -> Differential {
                let energy: fn(&Place) -> Differential = $energy;
                energy(place)
            }
            fn at(&self, state: &State) -> Self::Point<f64> {
                phase_point!($centre self state)
            }
        }

        impl Sum<$n> for Form {
            sum! { @moving $centre $n }
        }

        #[test]
        fn velocities() {
            velocities_agree::<$n, Form>();
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
    (@literal $n:literal ($($kinetic:tt)*) ()) => {
        #[affine_model(dim = $n, kinetic($($kinetic)*))]
        struct Body;
        type Form = Body;
        fn form() -> Form {
            Body
        }
    };
    (@literal $n:literal ($($kinetic:tt)*) ($($potential:tt)*)) => {
        #[affine_model(dim = $n, kinetic($($kinetic)*), potential = $($potential)*)]
        struct Body;
        type Form = Body;
        fn form() -> Form {
            Body
        }
    };
    (@field $n:literal ($($kinetic:tt)*) ()) => {
        #[affine_model(dim = $n, kinetic($($kinetic)*))]
        #[allow(dead_code, reason = "each sum reads its own of the fields")]
        struct Body {
            i: f64,
            j: f64,
            a: f64,
            m: f64,
        }
        type Form = PreparedBody;
        fn form() -> Form {
            Body { i: 1.5, j: 0.75, a: -0.25, m: 1.25 }.prepare().unwrap()
        }
    };
    (@held free) => { false };
    (@held held) => { true };
    (@moving pinned $n:literal) => {
        fn moving(&self, _x: Vector<$n>, phi: Matrix<$n>, velocity: &Velocity<$n>) -> Self::Point<f64> {
            self.at_velocity(phi, velocity.phi_dot).unwrap()
        }
    };
    (@moving moving $n:literal) => {
        fn moving(&self, x: Vector<$n>, phi: Matrix<$n>, velocity: &Velocity<$n>) -> Self::Point<f64> {
            self.at_velocity(x, phi, velocity.x_dot, velocity.phi_dot).unwrap()
        }
    };
}

macro_rules! sums {
    ($($name:ident: $form:ident $centre:ident $held:ident $terms:tt $plane:tt $space:tt $potential:tt $energy:expr;)*) => { $(
        mod $name {
            mod plane {
                sum! { 2 $form $centre $held $terms $plane $potential $energy }
            }
            mod space {
                sum! { 3 $form $centre $held $terms $space $potential $energy }
            }
        }
    )* };
}

sums! {
    flat_and_casimirs: field pinned free
        [|n| Term::dalembert(n, rational(3, 2)), |_| Term::Casimir2(rational(-1, 4)), |_| Term::Casimir1Squared(rational(1, 8))]
        (dalembert = i, casimir2 = a, casimir1_squared = 0.125)
        (dalembert = i, casimir2 = a, casimir1_squared = 0.125)
        () no_potential;
    flat_and_body: literal moving free
        [|n| Term::DAlembert(halves(n, 2)), |n| Term::body_inertia(n, rational(3, 4)), |_| Term::BodyTranslation(rational(5, 4))]
        (dalembert = diag(1, 1.5), body_inertia = 0.75, body_translation = 1.25)
        (dalembert = diag(1, 1.5, 2), body_inertia = 0.75, body_translation = 1.25)
        () no_potential;
    flat_and_space: field moving free
        [|n| Term::dalembert(n, rational(3, 2)), |n| Term::SpaceInertia(halves(n, 1)), |_| Term::SpaceTranslation(rational(5, 4))]
        (dalembert = i, space_inertia = diag(0.5, j), space_translation = m)
        (dalembert = i, space_inertia = diag(0.5, j, 1), space_translation = m)
        () no_potential;
    body_and_space: literal pinned free
        [|n| Term::body_inertia(n, rational(3, 2)), |n| Term::space_inertia(n, rational(3, 4)), |_| Term::Casimir2(rational(-1, 4))]
        (body_inertia = 1.5, space_inertia = 0.75, casimir2 = -0.25)
        (body_inertia = 1.5, space_inertia = 0.75, casimir2 = -0.25)
        () no_potential;
    everything: field moving free
        [|n| Term::BodyInertia(halves(n, 2)), |n| Term::space_inertia(n, rational(3, 4)), |n| Term::dalembert(n, rational(3, 2)),
         |_| Term::Casimir2(rational(-1, 4)), |_| Term::BodyTranslation(rational(5, 4)), |_| Term::SpaceTranslation(rational(1, 2))]
        (body_inertia = diag(1, 1.5), space_inertia = j, dalembert = i, casimir2 = a, body_translation = m, space_translation = 0.5)
        (body_inertia = diag(1, 1.5, 2), space_inertia = j, dalembert = i, casimir2 = a, body_translation = m, space_translation = 0.5)
        () no_potential;
    masses_beside_left: field moving free
        [|n| Term::body_inertia(n, rational(3, 2)), |_| Term::Casimir2(rational(-1, 4)), |_| Term::BodyTranslation(rational(5, 4)),
         |_| Term::SpaceTranslation(rational(1, 2))]
        (body_inertia = i, casimir2 = a, body_translation = m, space_translation = 0.5)
        (body_inertia = i, casimir2 = a, body_translation = m, space_translation = 0.5)
        () no_potential;
    masses_beside_right: literal moving free
        [|n| Term::SpaceInertia(halves(n, 2)), |_| Term::BodyTranslation(rational(5, 4)), |_| Term::SpaceTranslation(rational(1, 2))]
        (space_inertia = diag(1, 1.5), body_translation = 1.25, space_translation = 0.5)
        (space_inertia = diag(1, 1.5, 2), body_translation = 1.25, space_translation = 0.5)
        () no_potential;
    masses_beside_flat: literal moving free
        [|n| Term::DAlembert(halves(n, 2)), |_| Term::BodyTranslation(rational(5, 4)), |_| Term::SpaceTranslation(rational(1, 2))]
        (dalembert = diag(1, 1.5), body_translation = 1.25, space_translation = 0.5)
        (dalembert = diag(1, 1.5, 2), body_translation = 1.25, space_translation = 0.5)
        () no_potential;
    flat_and_casimirs_under_neo_hookean: literal pinned free
        [|n| Term::dalembert(n, rational(3, 2)), |_| Term::Casimir2(rational(-1, 4))]
        (dalembert = 1.5, casimir2 = -0.25)
        (dalembert = 1.5, casimir2 = -0.25)
        (tr(G)*exp(-2*q) - n + 2*sinh(q)^2)
        |place| place.trace_green() * (place.q() * -2.0).exp() - place.n() + place.q().sinh().power(2) * 2.0;
    body_and_space_under_entries: literal moving held
        [|n| Term::body_inertia(n, rational(3, 2)), |n| Term::space_inertia(n, rational(3, 4)), |_| Term::BodyTranslation(rational(5, 4)),
         |_| Term::SpaceTranslation(rational(1, 2))]
        (body_inertia = 1.5, space_inertia = 0.75, body_translation = 1.25, space_translation = 0.5)
        (body_inertia = 1.5, space_inertia = 0.75, body_translation = 1.25, space_translation = 0.5)
        (G[1,2]*Ct[1,1] + x[1]*tr(G) + norm(x)^2/2)
        |place| place.green(1, 2) * place.finger(1, 1) + place.x(1) * place.trace_green() + place.distance().power(2) * 0.5;
    masses_beside_left_under_a_well: literal moving held
        [|n| Term::body_inertia(n, rational(3, 2)), |_| Term::BodyTranslation(rational(5, 4)), |_| Term::SpaceTranslation(rational(1, 2))]
        (body_inertia = 1.5, body_translation = 1.25, space_translation = 0.5)
        (body_inertia = 1.5, body_translation = 1.25, space_translation = 0.5)
        (norm(x)^2/2 + tr(G))
        |place| place.distance().power(2) * 0.5 + place.trace_green();
}

/// A definite sum with an anisotropic part on either side.
#[affine_model(
    dim = 3,
    kinetic(body_inertia = diag(1, 1.5, 2), space_inertia = 0.5, body_translation = 1, space_translation = 0.5),
    potential = hyperbolic_dilatation(4) + neo_hookean(0.5)
)]
struct Driven;

fn driven() -> <Driven as Model<3>>::Point<f64> {
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let spin = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    Driven.at_momentum(Vector::<3>::zeros(), phi, Vector::<3>::new(0.3, -0.2, 0.5), TwoPoint(spin)).unwrap()
}

/// Two integrators that have nothing in common but the equations, and the energy of both.
#[test]
fn two_methods_agree() {
    let run = |method: Method| {
        Simulation::new(&Driven, driven())
            .until(4.0)
            .every(1.0)
            .tolerance(1e-13)
            .method(method)
            .run()
            .unwrap()
    };
    let (explicit, implicit) = (run(Method::RungeKutta8), run(Method::Gauss { stages: 3, step: 0.004 }));
    for (one, other) in explicit.points().iter().zip(implicit.points()) {
        for (what, a, b) in [
            ("phi", entries(one.phi()), entries(other.phi())),
            ("Pi", entries(&one.pi().0.0), entries(&other.pi().0.0)),
            ("x", one.x().as_slice().to_vec(), other.x().as_slice().to_vec()),
        ] {
            assert_close(what, &a, &b, norm(&b).max(1.0), TWO_METHODS);
        }
    }
    for run in [&explicit, &implicit] {
        let energy = run.energies()[0];
        for later in run.energies() {
            assert!((later - energy).abs() <= TWO_METHODS * energy.abs(), "{later} of {energy}");
        }
    }
    assert!(implicit.why().to_string().contains("symplectic"), "{}", implicit.why());
}

/// `T = 1/2 tr(phi_dot phi_dot^T) - A/2 tr Oh^2` at `phi = c 1`: `(n/2)(1 - A/c^2) c_dot^2`.
#[affine_model(dim = 2, kinetic(dalembert = 1, casimir2 = -a))]
struct Shrinking {
    a: f64,
}

/// Along `phi = c 1` the energy is `E = (1 - A/c^2) c_dot^2`, and the mass matrix degenerates at `c^2 = A`, which is
/// reached from `c_0` after `(sqrt(c^2 - A) - sqrt(A) arccos(sqrt(A)/c))/sqrt(E)` at `c = c_0`, with infinite velocity.
#[test]
fn a_degenerate_mass_matrix_ends_the_run() {
    let (a, c, speed) = (0.25_f64, 1.5_f64, -0.8_f64);
    let model = Shrinking { a }.prepare().unwrap();
    let start = model.at_velocity(Matrix::<2>::identity() * c, Matrix::<2>::identity() * speed).unwrap();
    let energy = (1.0 - a / (c * c)) * speed * speed;
    let time = ((c * c - a).sqrt() - a.sqrt() * (a.sqrt() / c).acos()) / energy.sqrt();

    let before = Simulation::new(&model, start).until(0.9 * time).tolerance(1e-12).run().unwrap();
    let drift = (before.energies().last().unwrap() - energy).abs();
    assert!(drift <= 1e-11 * energy, "energy {drift:e}");

    let halt = Simulation::new(&model, start).until(2.0 * time).tolerance(1e-12).run().unwrap_err();
    let Reason::Degenerate { weakest, t } = halt.stop.reason else { panic!("{}", halt.stop) };
    assert!(weakest < 1e-5 && halt.stop.steps > 10, "{}", halt.stop);
    assert!((t - time).abs() <= DEGENERATION * time, "{t} of {time}");
    let (last, good) = halt.trajectory.end();
    assert!(last <= t && good.phi()[(0, 0)] >= a.sqrt() && good.phi()[(0, 0)] < a.sqrt() + 1e-4, "{good:?}");
    assert!(halt.stop.to_string().contains("the mass matrix degenerates"), "{}", halt.stop);

    // Equal steps either jump over the place, and see another signature, or find no solution.
    let gauss = Method::Gauss { stages: 2, step: time / 64.0 };
    let halt = Simulation::new(&model, start).until(2.0 * time).method(gauss).run().unwrap_err();
    let typed = matches!(halt.stop.reason, Reason::Degenerate { .. } | Reason::NoSolution { .. });
    assert!(typed && (halt.stop.t - time).abs() < 0.1 * time, "{}", halt.stop);
}

/// A start where the mass matrix is degenerate is refused, and one where it is indefinite on demand.
#[test]
fn a_degenerate_start_is_refused() {
    let model = Shrinking { a: 0.25 }.prepare().unwrap();
    let half = Matrix::<2>::identity() * 0.5;
    let refused = model.at_momentum(half, TwoPoint(Matrix::<2>::zeros())).unwrap_err();
    assert!(matches!(refused, Error::IllPosed(IllPosed { condition: "det K(phi) != 0", .. })), "{refused}");
    assert!(model.at_velocity(half, Matrix::<2>::zeros()).is_err());
    assert!(model.at_velocity(half * 0.5, Matrix::<2>::zeros()).is_ok(), "indefinite, and regular");
    assert!(matches!(model.at_velocity(half * 0.0, half), Err(Error::Placement { .. })));

    #[affine_model(dim = 2, kinetic(dalembert = 1, casimir2 = -a), require(positive_definite))]
    struct Definite {
        a: f64,
    }
    let model = Definite { a: 0.25 }.prepare().unwrap();
    assert!(model.at_velocity(half * 2.0, half).is_ok());
    let refused = model.at_velocity(half * 0.5, half).unwrap_err();
    assert!(matches!(refused, Error::IllPosed(IllPosed { condition: "K(phi) > 0", .. })), "{refused}");
}

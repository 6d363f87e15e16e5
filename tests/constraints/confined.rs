//! Generated code of constrained models against the oracle's multipliers: every constraint with every kind of kinetic
//! energy, with and without potential and translation, n = 2 and 3.

use affine_oracle::{
    Constraint, Differential, Kinetic, Matrix as Exact, Motion, Place, Slopes, State, Term, rational,
};
use affine_runtime::Error;
use affine_runtime::decompose::LinearMap;
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Setting};

use affine_tests::charts::{T0, assert_charts_lead_back, assert_reduced_equations_move, groups};
use affine_tests::group::{Start, assert_components, assert_listed, diagonal, none, off_the_group, starts};
use affine_tests::reference::{Reference, assert_close, entries, exact_state};
use affine_tests::tolerances::{FREE_DILATATION, ON_THE_GROUP, UNDER_POTENTIAL};

/// A constrained model, stated a second time for the oracle.
trait Confined<const N: usize>: Model<N> + Sized {
    const CONSTRAINT: Constraint;
    const TRANSLATION: bool;

    fn body() -> Self;
    fn kinetic() -> Kinetic;
    fn potential(place: &Place) -> Differential;
    fn at_spin(&self, start: &Start<N>) -> affine_runtime::Result<Self::Point<f64>>;
    fn at_speed(
        &self,
        point: &Self::Point<f64>,
        x_dot: Vector<N>,
        phi_dot: Matrix<N>,
    ) -> affine_runtime::Result<Self::Point<f64>>;

    /// Points on the group with momenta in the dual of its algebra; every other one at `p = 0`.
    fn points(&self) -> Vec<Self::Point<f64>> {
        starts::<N>(Self::CONSTRAINT).map(|start| self.at_spin(&start).unwrap()).collect()
    }

    /// The exact motion through a point that the code may have moved.
    fn reference(&self, point: &Self::Point<f64>) -> Reference {
        let state = exact_state(Self::DESCRIPTION.full.last().unwrap().name(), point);
        Reference::confined(&Self::kinetic(), Self::CONSTRAINT, &state, T0, &Self::potential)
    }
}

/// Velocities, energies, Hamilton's equations, and the way back from velocities.
fn agrees_with_the_oracle<const N: usize, M: Confined<N>>() {
    let model = M::body();
    for point in model.points() {
        let reference = model.reference(&point);
        let velocity = model.velocity(&point);
        reference.assert_rate("x", velocity.x_dot.as_slice(), UNDER_POTENTIAL);
        reference.assert_rate("phi", &entries(&velocity.phi_dot), UNDER_POTENTIAL);
        let energy = reference.expected.hamiltonian;
        let tolerance = UNDER_POTENTIAL * reference.condition;
        assert_close("H", &[model.hamiltonian(0.0, &point)], &[energy], reference.energy_size(), tolerance);
        let potential = Slopes::of(&M::potential, T0, point.x().as_slice(), &entries(point.phi())).value;
        let kinetic = model.kinetic_energy(point.phi(), &velocity);
        assert_close("T", &[kinetic], &[energy - potential], reference.energy_size(), tolerance);

        let rates = model.hamilton_equations(T0, &model.flatten(&point));
        for (name, rate) in groups(M::DESCRIPTION.full, rates.as_ref()) {
            assert_components(&reference, N, name, rate, UNDER_POTENTIAL);
        }

        let back = model.at_speed(&point, velocity.x_dot, velocity.phi_dot).unwrap();
        let (found, expected) = (entries(&back.pi().0.0), entries(&point.pi().0.0));
        assert_close(
            "Pi of velocity",
            &found,
            &expected,
            affine_tests::reference::norm(&expected),
            tolerance,
        );
    }
}

/// `expand` undoes `reduce`; its derivative along the reduced equations is the vector field of the oracle.
fn reduction_keeps_the_motion<const N: usize, M: Confined<N>>() {
    let model = M::body();
    for point in model.points() {
        let spin = M::DESCRIPTION.full.last().unwrap().name();
        let state = exact_state(spin, &point);
        let condition = M::kinetic().constrained_condition(M::CONSTRAINT, &state.phi).unwrap();
        assert_charts_lead_back(&model, &point, &state, UNDER_POTENTIAL * condition);
        assert_reduced_equations_move(&model, &point, UNDER_POTENTIAL, &|t, state| {
            Reference::confined(&M::kinetic(), M::CONSTRAINT, state, t, &M::potential)
        });
    }
}

/// Exactly what the constrained motion conserves is listed, once.
fn lists_are_exact<const N: usize, M: Confined<N>>() {
    let (model, kinetic) = (M::body(), M::kinetic());
    let spin = M::DESCRIPTION.full.last().unwrap().name();
    let states: Vec<State> = model.points().iter().map(|point| exact_state(spin, point)).collect();
    let held = |state: &State| {
        let slopes = Slopes::of(&M::potential, T0, &state.x.to_f64(), &state.phi.to_f64());
        slopes.x.iter().any(|slope| *slope != 0.0)
    };
    let motion = |state| kinetic.constrained_motion(M::CONSTRAINT, state, T0, &M::potential).unwrap();
    let motions: Vec<Motion> = states.iter().map(motion).collect();
    assert_listed(N, M::CONSTRAINT, M::DESCRIPTION.conserved, &motions, M::TRANSLATION);
    if states.iter().any(held) {
        assert_eq!(M::DESCRIPTION.conserved_at_rest, M::DESCRIPTION.conserved);
    } else {
        let still: Vec<State> = states.iter().map(State::at_rest).collect();
        let motions: Vec<Motion> = still.iter().map(motion).collect();
        assert_listed(N, M::CONSTRAINT, M::DESCRIPTION.conserved_at_rest, &motions, false);
    }
}

/// What is off the group, off the algebra or off its dual is refused, with the size of the defect.
fn defects_are_refused<const N: usize, M: Confined<N>>() {
    let model = M::body();
    let defect = |error: affine_runtime::Result<M::Point<f64>>| match error {
        Err(Error::OffConstraint { quantity, defect, threshold, .. }) => {
            assert!(defect > threshold);
            (quantity, defect)
        }
        other => panic!("{other:?}"),
    };
    for start in starts::<N>(M::CONSTRAINT).take(2) {
        let mut bent = start;
        bent.phi[(0, 0)] += 1e-10;
        let (quantity, size) = defect(model.at_spin(&bent));
        assert_eq!(quantity, "phi");
        assert!((1e-12..1e-8).contains(&size), "{size:e}");

        let point = model.points()[0];
        let velocity = model.velocity(&point);
        let stretched = velocity.phi_dot
            + point.phi() * Matrix::<N>::from_fn(|i, j| if (i, j) == (0, 0) { 1e-10 } else { 0.0 });
        let (quantity, _) = defect(model.at_speed(&point, velocity.x_dot, stretched));
        assert_eq!(quantity, "phi_dot");

        let mut loaded = start;
        loaded.spin[(0, 0)] += 1e-10;
        let (quantity, _) = defect(model.at_spin(&loaded));
        assert!(["Sigma", "Sigma_hat"].contains(&quantity), "{quantity}");
    }
}

/// Every motion stays on its group.
fn nothing_drifts<const N: usize, M: Confined<N>>() {
    let model = M::body();
    for point in model.points() {
        // Under an indefinite energy a body may escape in finite time; the last good state is on the group as well.
        let run = match Simulation::new(&model, point).until(1.0).run() {
            Ok(run) => run,
            Err(halt) => {
                let reason = &halt.stop.reason;
                let is_told = matches!(reason, Reason::StepUnderflow { .. } | Reason::Distortion { .. });
                assert!(is_told, "{}", halt.stop);
                *halt.trajectory
            }
        };
        let (_, end) = run.end();
        let (phi, defect) = (end.phi(), off_the_group(M::CONSTRAINT, &model.orthonormal(end)));
        // A placement of condition c is on the group to c roundings.
        let condition = phi.norm() * phi.inverse().norm();
        assert!(defect < ON_THE_GROUP * condition, "{defect:e} at {condition:e}");
    }
}

/// Rows of quarters.
fn quarters(n: usize, entries: &[i64]) -> Exact {
    let entries: Vec<_> = entries.iter().map(|entry| rational(*entry, 4)).collect();
    Exact::from_rationals(n, n, &entries)
}

macro_rules! confined {
    ($($name:ident: $n:literal $constraint:ident $key:ident $centre:ident ($($kinetic:tt)*) [$($term:expr),*]
        $(=> ($($potential:tt)*))? $energy:expr;)*) => { $(
        mod $name {
            #[allow(clippy::wildcard_imports)]
            use super::*;

            #[affine_model(dim = $n, constraint = $key, kinetic($($kinetic)*) $(, potential = $($potential)*)?)]
            struct Body;

            impl Confined<$n> for Body {
                const CONSTRAINT: Constraint = Constraint::$constraint;
                const TRANSLATION: bool = confined!(@translation $centre);

                fn body() -> Self {
                    Body
                }
                fn kinetic() -> Kinetic {
                    Kinetic::new($n, vec![$($term),*]).unwrap()
                }
                fn potential(place: &Place) -> Differential {
                    let energy: fn(&Place) -> Differential = $energy;
                    energy(place)
                }
                fn at_spin(&self, start: &Start<$n>) -> affine_runtime::Result<Self::Point<f64>> {
                    confined!(@point $centre self start)
                }
                fn at_speed(&self, point: &Self::Point<f64>, x_dot: Vector<$n>, phi_dot: Matrix<$n>)
                    -> affine_runtime::Result<Self::Point<f64>> {
                    confined!(@velocity $centre self point x_dot phi_dot)
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
            fn defects() {
                defects_are_refused::<$n, Body>();
            }
            #[test]
            fn runs() {
                nothing_drifts::<$n, Body>();
            }
        }
    )* };
    (@translation pinned) => { false };
    (@translation moving) => { true };
    (@point pinned $model:ident $start:ident) => { $model.at_momentum($start.phi, Comoving($start.spin)) };
    (@point moving $model:ident $start:ident) => {
        $model.at_momentum($start.x, $start.phi, $start.p, Comoving($start.spin))
    };
    (@velocity pinned $model:ident $point:ident $x_dot:ident $phi_dot:ident) => {{
        let _ = $x_dot;
        $model.at_velocity(*$point.phi(), $phi_dot)
    }};
    (@velocity moving $model:ident $point:ident $x_dot:ident $phi_dot:ident) => {
        $model.at_velocity($point.x(), *$point.phi(), $x_dot, $phi_dot)
    };
}

fn body(n: usize) -> Term {
    Term::body_inertia(n, rational(3, 2))
}
fn space(n: usize) -> Term {
    Term::space_inertia(n, rational(3, 2))
}
fn casimir2() -> Term {
    Term::Casimir2(rational(1, 4))
}
fn casimir1() -> Term {
    Term::Casimir1Squared(rational(1, 8))
}
fn body_translation() -> Term {
    Term::BodyTranslation(rational(5, 4))
}
fn space_translation() -> Term {
    Term::SpaceTranslation(rational(5, 4))
}

/// What `prepare()` refuses, and with which condition.
macro_rules! conditions {
    ($($name:ident: $n:literal $key:ident ($($kinetic:tt)*) [$($good:expr),*] [$($bad:expr => $condition:literal),*];)*) => { $(
        #[test]
        fn $name() {
            #[affine_model(dim = $n, constraint = $key, kinetic($($kinetic)*))]
            struct Body {
                i: f64,
                a: f64,
                b: f64,
            }
            let prepare = |[i, a, b]: [f64; 3]| Body { i, a, b }.prepare();
            $(assert!(prepare($good).is_ok(), "{:?}", $good);)*
            $(match prepare($bad) {
                Err(Error::IllPosed(defect)) => assert_eq!(defect.condition, $condition),
                other => panic!("{:?}: {other:?}", $bad),
            })*
        }
    )* };
}

// Only the directions that the constraint leaves free count.
conditions! {
    isochoric_conditions: 3 isochoric (body_inertia = i, casimir2 = a + b)
        [[1.0, 0.5, 0.0]] [[1.0, -1.0, 0.0] => "I + A != 0", [1.0, 1.0, 0.0] => "I - A != 0"];
    rigid_conditions: 3 rigid (body_inertia = i, casimir2 = a + b)
        [[1.0, 0.5, 0.0], [1.0, -1.0, 0.0]] [[1.0, 1.0, 0.0] => "I - A != 0"];
    conformal_conditions: 2 conformal (body_inertia = i, casimir2 = a, casimir1_squared = b)
        [[1.0, 0.5, 0.25], [1.0, -1.0, 0.5]]
        [[1.0, 1.0, 0.25] => "I - A != 0", [1.0, 0.5, -0.75] => "I + A + n B != 0"];
    conformal_masses: 3 conformal (dalembert = [[i, a, 0], [a, i, 0], [0, 0, b]])
        [[1.0, 0.5, 1.0]] [[1.0, 1.5, 1.0] => "a leading minor of J > 0", [1.0, 0.5, -0.5] => "a leading minor of J > 0"];
    rigid_masses: 3 rigid (dalembert = [[i, a, 0], [a, i, 0], [0, 0, b]])
        [[1.0, 0.5, 1.0], [1.0, 0.5, 0.0], [1.0, 1.5, 1.0]]
        [[1.0, 0.5, -0.5] => "T != 0 on every principal velocity", [0.0, 0.5, 1.0] => "the eigenvalue of T != 0"];
}

/// A top whose inertia has a field in every place, and the same in numbers.
#[test]
fn fields_in_a_full_inertia() {
    #[affine_model(dim = 3, constraint = rigid, kinetic(casimir2 = a, body_inertia = [[j, k, 0], [k, 2, l], [0, l, 3]]))]
    struct Fields {
        a: f64,
        j: f64,
        k: f64,
        l: f64,
    }
    #[affine_model(dim = 3, constraint = rigid, kinetic(casimir2 = 0.25, body_inertia = [[1, 0.5, 0], [0.5, 2, 0.25], [0, 0.25, 3]]))]
    struct Numbers;

    let fields = Fields { a: 0.25, j: 1.0, k: 0.5, l: 0.25 }.prepare().unwrap();
    for start in starts::<3>(Constraint::Rigid) {
        let point = Numbers.at_momentum(start.phi, Comoving(start.spin)).unwrap();
        let rates = Numbers.hamilton_equations(T0, &Numbers.flatten(&point));
        let found = fields.hamilton_equations(T0, &fields.flatten(&point));
        assert_close("rates", &found, &rates, affine_tests::reference::norm(&rates), UNDER_POTENTIAL);
    }
}

/// Without forces `phi = D R` of `J = I 1` has `T = n I/2 D'^2 + I D^2 |w|^2` and a constant spin: `(D^2)'' = 4 T/(n I)`, as for
/// a free particle at the distance `D`.
#[test]
fn free_conformal_motion() {
    #[affine_model(dim = 3, constraint = conformal, kinetic(dalembert = 2.5))]
    struct Ball;
    for start in starts::<3>(Constraint::Conformal) {
        let from = Ball.at_momentum(start.phi, Comoving(start.spin)).unwrap();
        let velocity = Ball.velocity(&from).phi_dot;
        let energy = 1.25 * velocity.norm_squared();
        let square = |phi: &Matrix<3>| phi.norm_squared() / 3.0;
        let t_end = 3.0;
        let run = Simulation::new(&Ball, from).until(t_end).tolerance(1e-13).run().unwrap();
        let rise = 2.0 * start.phi.dot(&velocity) / 3.0;
        let expected = square(&start.phi) + t_end * (rise + t_end * 2.0 * energy / (3.0 * 2.5));
        let found = square(run.end().1.phi());
        assert!((found - expected).abs() <= FREE_DILATATION * expected, "{found:e} {expected:e}");
        assert!(Ball::DESCRIPTION.conserved.contains(&Conserved::Spin));
    }
}

confined! {
    isochoric_left_2: 2 Isochoric isochoric pinned (body_inertia = 1.5, casimir2 = 0.25) [body(2), casimir2()] none;
    isochoric_left_3: 3 Isochoric isochoric pinned (body_inertia = 1.5, casimir2 = 0.25) [body(3), casimir2()] none;
    isochoric_right_drift_3: 3 Isochoric isochoric moving
        (space_inertia = 1.5, casimir2 = 0.25, space_translation = 1.25) [space(3), casimir2(), space_translation()] none;
    isochoric_affine_missile_2: 2 Isochoric isochoric moving
        (casimir2 = 0.25, body_translation = 1.25) [casimir2(), body_translation()] none;
    isochoric_missile_3: 3 Isochoric isochoric moving
        (body_inertia = 1.5, casimir2 = 0.25, body_translation = 1.25) [body(3), casimir2(), body_translation()] none;
    isochoric_right_missile_2: 2 Isochoric isochoric moving
        (space_inertia = 1.5, body_translation = 1.25) [space(2), body_translation()]
        => (norm(x)^2/2) |place| place.distance().power(2) * 0.5;
    isochoric_neo_hookean_3: 3 Isochoric isochoric pinned
        (space_inertia = 1.5, casimir2 = 0.25) [space(3), casimir2()]
        => (tr(G)*exp(-2*q) - n) |place| place.trace_green() * (place.q() * -2.0).exp() - place.n();
    isochoric_square_of_green_2: 2 Isochoric isochoric pinned (body_inertia = 1.5) [body(2)]
        => (tr(G*G) + sinh(q)^2) |place| place.trace_green_squared() + place.q().sinh().power(2);
    isochoric_missile_under_finger_3: 3 Isochoric isochoric moving
        (body_inertia = 1.5, casimir2 = 0.25, body_translation = 1.25) [body(3), casimir2(), body_translation()]
        => (Ct[1,2]^2) |place| place.finger(1, 2).power(2);
    isochoric_inertia_2: 2 Isochoric isochoric pinned
        (body_inertia = [[1, 0.5], [0.5, 2]], casimir2 = 0.25)
        [Term::BodyInertia(quarters(2, &[4, 2, 2, 8])), casimir2()] none;
    isochoric_inertia_3: 3 Isochoric isochoric moving
        (space_inertia = diag(1, 1.5, 2), casimir2 = 0.25, space_translation = 1.25)
        [Term::SpaceInertia(diagonal(&[2, 3, 4])), casimir2(), space_translation()]
        => (phi[1,2]^3) |place| place.phi(1, 2).power(3);
    isochoric_tensor_2: 2 Isochoric isochoric pinned
        (body_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])
        [Term::BodyTensor(quarters(4, &[8, 2, 0, 4, 2, 12, 1, 0, 0, 1, -4, 2, 4, 0, 2, 16]))] none;
    isochoric_diagonal_tensor_2: 2 Isochoric isochoric pinned
        (space_tensor = [[2, 0, 0, 0], [0, 3, 0, 0], [0, 0, -1, 0], [0, 0, 0, 4]])
        [Term::SpaceTensor(quarters(4, &[8, 0, 0, 0, 0, 12, 0, 0, 0, 0, -4, 0, 0, 0, 0, 16]))] none;
    rigid_left_2: 2 Rigid rigid pinned (body_inertia = 1.5, casimir2 = 0.25) [body(2), casimir2()] none;
    rigid_left_3: 3 Rigid rigid pinned (body_inertia = 1.5, casimir2 = 0.25) [body(3), casimir2()] none;
    rigid_affine_missile_3: 3 Rigid rigid moving
        (casimir2 = 0.25, body_translation = 1.25) [casimir2(), body_translation()] none;
    rigid_missile_2: 2 Rigid rigid moving
        (body_inertia = 1.5, body_translation = 1.25) [body(2), body_translation()]
        => (norm(x)^2/2 + phi[1,2]) |place| place.distance().power(2) * 0.5 + place.phi(1, 2);
    rigid_top_3: 3 Rigid rigid pinned (dalembert = diag(1, 1.5, 2)) [Term::DAlembert(diagonal(&[2, 3, 4]))] none;
    rigid_heavy_top_3: 3 Rigid rigid moving
        (dalembert = diag(1, 1, 2), space_translation = 1.25)
        [Term::DAlembert(diagonal(&[2, 2, 4])), space_translation()] => (phi[3,3]) |place| place.phi(3, 3);
    rigid_right_top_3: 3 Rigid rigid pinned
        (space_inertia = [[1, 0.5, 0], [0.5, 2, 0.25], [0, 0.25, 3]], casimir2 = 0.25)
        [Term::SpaceInertia(quarters(3, &[4, 2, 0, 2, 8, 1, 0, 1, 12])), casimir2()]
        => (phi[1,2]*phi[2,1]) |place| place.phi(1, 2) * place.phi(2, 1);
    rigid_dalembert_2: 2 Rigid rigid moving
        (dalembert = [[1, 0.5], [0.5, 2]], space_translation = 1.25)
        [Term::DAlembert(quarters(2, &[4, 2, 2, 8])), space_translation()] => (x[1]*phi[1,2])
        |place| place.x(1) * place.phi(1, 2);
    rigid_tensor_2: 2 Rigid rigid pinned
        (body_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])
        [Term::BodyTensor(quarters(4, &[8, 2, 0, 4, 2, 12, 1, 0, 0, 1, -4, 2, 4, 0, 2, 16]))] none;
    conformal_left_2: 2 Conformal conformal pinned
        (body_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125) [body(2), casimir2(), casimir1()] none;
    conformal_left_3: 3 Conformal conformal pinned
        (body_inertia = 1.5, casimir2 = 0.25, casimir1_squared = 0.125) [body(3), casimir2(), casimir1()] none;
    conformal_missile_3: 3 Conformal conformal moving
        (body_inertia = 1.5, casimir2 = 0.25, body_translation = 1.25) [body(3), casimir2(), body_translation()] none;
    conformal_right_missile_3: 3 Conformal conformal moving
        (space_inertia = 1.5, casimir1_squared = 0.125, body_translation = 1.25)
        [space(3), casimir1(), body_translation()] none;
    conformal_right_drift_2: 2 Conformal conformal moving
        (space_inertia = 1.5, casimir2 = 0.25, space_translation = 1.25)
        [space(2), casimir2(), space_translation()] => (1/2*sinh(q)^2) |place| place.q().sinh().power(2) * 0.5;
    conformal_inertia_3: 3 Conformal conformal pinned
        (body_inertia = diag(1, 1.5, 2), casimir1_squared = 0.125)
        [Term::BodyInertia(diagonal(&[2, 3, 4])), casimir1()] => (phi[3,3]*exp(-q) + tr(G))
        |place| place.phi(3, 3) * (place.q() * -1.0).exp() + place.trace_green();
    conformal_matrix_2: 2 Conformal conformal moving
        (space_inertia = [[1, 0.5], [0.5, 2]], body_translation = 1.25)
        [Term::SpaceInertia(quarters(2, &[4, 2, 2, 8])), body_translation()]
        => (x[1]^3) |place| place.x(1).power(3);
    conformal_tensor_2: 2 Conformal conformal pinned
        (space_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])
        [Term::SpaceTensor(quarters(4, &[8, 2, 0, 4, 2, 12, 1, 0, 0, 1, -4, 2, 4, 0, 2, 16]))] none;
    isochoric_dalembert_2: 2 Isochoric isochoric pinned (dalembert = 1.5) [Term::dalembert(2, rational(3, 2))] none;
    isochoric_dalembert_3: 3 Isochoric isochoric moving
        (dalembert = 1.5, space_translation = 1.25) [Term::dalembert(3, rational(3, 2)), space_translation()]
        => (tr(G)*exp(-2*q)) |place| place.trace_green();
    isochoric_dalembert_diagonal_3: 3 Isochoric isochoric pinned
        (dalembert = diag(1, 1.5, 2)) [Term::DAlembert(diagonal(&[2, 3, 4]))]
        => (tr(G)/2) |place| place.trace_green() * 0.5;
    conformal_dalembert_2: 2 Conformal conformal pinned (dalembert = 1.5) [Term::dalembert(2, rational(3, 2))] none;
    conformal_dalembert_3: 3 Conformal conformal pinned (dalembert = 1.5) [Term::dalembert(3, rational(3, 2))]
        => (sinh(q)^2) |place| place.q().sinh().power(2);
    conformal_dalembert_diagonal_3: 3 Conformal conformal moving
        (dalembert = diag(1, 1.5, 2), space_translation = 1.25)
        [Term::DAlembert(diagonal(&[2, 3, 4])), space_translation()] => (sinh(q)^2 + phi[3,3])
        |place| place.q().sinh().power(2) + place.phi(3, 3);
    conformal_dalembert_matrix_2: 2 Conformal conformal moving
        (dalembert = [[1, 0.5], [0.5, 2]], body_translation = 1.25)
        [Term::DAlembert(quarters(2, &[4, 2, 2, 8])), body_translation()]
        => (x[1]^3) |place| place.x(1).power(3);
    conformal_dalembert_drift_3: 3 Conformal conformal moving
        (dalembert = [[1, 0.5, 0], [0.5, 2, 0.25], [0, 0.25, 3]], space_translation = 1.25)
        [Term::DAlembert(quarters(3, &[4, 2, 0, 2, 8, 1, 0, 1, 12])), space_translation()] none;
}

/// The velocity that is printed, `P((dH/dSigma_hat)^T)`, of the `H` that is printed, differentiated by hand as a function of nine
/// entries.
#[test]
fn the_velocity_on_a_group_is_the_projected_slope_that_is_printed() {
    #[affine_model(dim = 3, constraint = rigid, kinetic(body_inertia = diag(1, 2, 4)))]
    struct Top;
    let description = Top::DESCRIPTION;
    let texts: Vec<&str> = description.equations.iter().map(|formula| formula.text).collect();
    assert_eq!(
        description.hamiltonian.text,
        "H = 2/3*sigma_hat_12^2 + 2/5*sigma_hat_13^2 + 1/3*sigma_hat_23^2"
    );
    assert!(texts.contains(&"Omega_hat = P((dH/dSigma_hat)^T)"), "{texts:?}");
    assert!(texts.contains(&"P X = (X - X^T)/2"), "{texts:?}");
    let spin = Matrix::<3>::new(0.0, 0.7, -0.4, -0.7, 0.0, 1.1, 0.4, -1.1, 0.0);
    let point = Top.at_momentum(Matrix::<3>::identity(), Comoving(spin)).unwrap();
    let mut slope = Matrix::<3>::zeros();
    for ((i, k), weight) in [((0, 1), 4.0 / 3.0), ((0, 2), 4.0 / 5.0), ((1, 2), 2.0 / 3.0)] {
        slope[(i, k)] = weight * spin[(i, k)];
    }
    let projected = (slope.transpose() - slope) / 2.0;
    assert!((Top.velocity(&point).phi_dot - projected).norm() < 1e-15);
}

/// A point that no constructor gives, read from numbers: nothing moves from it, unless it is off by what long motions leave.
#[test]
fn starts_off_the_constraint_are_refused() {
    #[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2)))]
    struct Top;
    #[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = 1))]
    struct Drop;
    fn refused<const N: usize, M: Model<N>>(model: &M, start: M::Point<f64>, far: f64) {
        let scaled = |by: f64| {
            let mut numbers = model.flatten(&start);
            numbers.as_mut()[..N * N].iter_mut().for_each(|entry| *entry *= by);
            model.unflatten(&numbers)
        };
        for by in [1.0, 1.0 + 1e-11] {
            assert!(Simulation::new(model, scaled(by)).until(0.1).run().is_ok(), "{by}");
        }
        let halt = Simulation::new(model, scaled(far)).until(0.1).run().unwrap_err();
        assert!(matches!(halt.stop.reason, Reason::Setting(Setting::OffConstraint { .. })), "{halt}");
        assert!(halt.to_string().contains("off its constraint") && halt.trajectory.is_empty(), "{halt}");
        let stop = Flow::new(model, (0.0, scaled(far))).unwrap_err();
        assert!(matches!(stop.reason, Reason::Setting(Setting::OffConstraint { .. })), "{stop}");
        let mut flow = Flow::new(model, (0.0, start)).unwrap();
        assert!(flow.set_point(scaled(far)).is_err() && flow.advance(0.1).is_ok());
    }
    let rest = Matrix::<3>::new(0.0, 0.3, -0.2, -0.3, 0.0, 0.1, 0.2, -0.1, 0.0);
    refused(&Top, Top.at_velocity(Matrix::identity(), rest).unwrap(), 1.1);
    let phi = Matrix::<2>::new(2.0, 0.6, 0.0, 0.5);
    refused(&Drop, Drop.at_velocity(phi, Matrix::<2>::zeros()).unwrap(), 1.1);
}

//! Constrained models with random coefficients against the oracle's multipliers.

use affine_oracle::{
    Constraint, Differential, Kinetic, Motion, Place, Random, Rational, State, rational, rounded,
};
use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

use crate::charts::{T0, assert_charts_lead_back, assert_reduced_equations_move, groups};
use crate::group::{Start, assert_components, assert_listed, off_the_group, starts};
use crate::reference::{Reference, assert_close, entries, exact_state, norm};
use crate::tolerances::{ON_THE_GROUP, POWER_BALANCE};

/// Models of a statement.
const DRAWS: u64 = 4;

/// The fields that the statements have between them.
pub struct Coefficients {
    values: [Rational; 4],
}

impl Coefficients {
    /// `a`, `b`, `c` of both signs, `k` positive, all between 1/8 and 1, such that what a statement asks holds.
    pub fn random(random: &mut Random, regular: impl Fn(&Self) -> bool) -> Self {
        loop {
            let mut one = || rational((1 - 2 * random.integer(0, 1)) * random.integer(4, 32), 32);
            let [a, b, c, k] = [one(), one(), one(), one()];
            let k = if rounded(&k) < 0.0 { -k } else { k };
            let drawn = Self { values: [a, b, c, k] };
            if regular(&drawn) {
                return drawn;
            }
        }
    }

    /// A field.
    pub fn value(&self, name: &str) -> Rational {
        let [a, b, c, k] = &self.values;
        match name {
            "a" => a.clone(),
            "b" => b.clone(),
            "c" => c.clone(),
            "k" => k.clone(),
            other => panic!("no field {other}"),
        }
    }

    /// The same as the model has it.
    pub fn field(&self, name: &str) -> f64 {
        rounded(&self.value(name))
    }
}

/// A statement of a constrained model, with a second one of its kinetic energy for the oracle.
pub trait Drawn<const N: usize>: Model<N> + Sized {
    /// Its group.
    const CONSTRAINT: Constraint;
    /// Does its centre move?
    const TRANSLATION: bool;
    /// Roundings of the equations, per condition of the constrained mass matrix.
    const ROUNDING: f64;

    /// A model with random coefficients, and its kinetic energy.
    fn draw(random: &mut Random) -> (Self, Kinetic);
    /// The potential by its plain definition.
    fn potential(place: &Place) -> Differential;
    /// The phase point of a start.
    fn at_spin(&self, start: &Start<N>) -> affine_runtime::Result<Self::Point<f64>>;
    /// The phase point with the placement of another and these velocities.
    fn at_speed(
        &self,
        point: &Self::Point<f64>,
        x_dot: Vector<N>,
        phi_dot: Matrix<N>,
    ) -> affine_runtime::Result<Self::Point<f64>>;

    /// Models with different coefficients.
    fn models() -> impl Iterator<Item = (Self, Kinetic)> {
        (0..DRAWS).map(|seed| Self::draw(&mut Random::new(5100 + seed)))
    }

    /// Phase points on the group.
    fn points(&self) -> Vec<Self::Point<f64>> {
        starts::<N>(Self::CONSTRAINT).map(|start| self.at_spin(&start).unwrap()).collect()
    }
}

fn reference<const N: usize, M: Drawn<N>>(kinetic: &Kinetic, t: f64, state: &State) -> Reference {
    Reference::confined(kinetic, M::CONSTRAINT, state, t, &M::potential)
}

fn spin<const N: usize, M: Drawn<N>>() -> &'static str {
    M::DESCRIPTION.full.last().unwrap().name()
}

/// Velocities, energies, Hamilton's equations, and the way back from velocities.
pub fn full_equations<const N: usize, M: Drawn<N>>() {
    for (model, kinetic) in M::models() {
        for point in model.points() {
            let state = exact_state(spin::<N, M>(), &point);
            let reference = reference::<N, M>(&kinetic, T0, &state);
            let tolerance = M::ROUNDING * reference.condition;
            let velocity = model.velocity(&point);
            reference.assert_rate("x", velocity.x_dot.as_slice(), M::ROUNDING);
            reference.assert_rate("phi", &entries(&velocity.phi_dot), M::ROUNDING);

            let (size, energy) = (reference.energy_size(), reference.expected.hamiltonian);
            assert_close("H", &[model.hamiltonian(T0, &point)], &[energy], size, tolerance);
            let free = Reference::confined(&kinetic, M::CONSTRAINT, &state, T0, &crate::group::none);
            let found = model.kinetic_energy(point.phi(), &velocity);
            assert_close("T", &[found], &[free.expected.hamiltonian], size, tolerance);

            let rates = model.hamilton_equations(T0, &model.flatten(&point));
            for (name, rate) in groups(M::DESCRIPTION.full, rates.as_ref()) {
                assert_components(&reference, N, name, rate, M::ROUNDING);
            }

            let back = model.at_speed(&point, velocity.x_dot, velocity.phi_dot).unwrap();
            for (what, found, expected) in [
                ("p of velocity", back.p().as_slice().to_vec(), point.p().as_slice().to_vec()),
                ("Pi of velocity", entries(&back.pi().0.0), entries(&point.pi().0.0)),
            ] {
                assert_close(what, &found, &expected, norm(&expected), tolerance);
            }
        }
    }
}

/// `expand` undoes `reduce`; its derivative along the reduced equations is the vector field of the oracle.
pub fn reduced_equations<const N: usize, M: Drawn<N>>() {
    for (model, kinetic) in M::models() {
        for point in model.points() {
            let state = exact_state(spin::<N, M>(), &point);
            let condition = kinetic.constrained_condition(M::CONSTRAINT, &state.phi).unwrap();
            assert_charts_lead_back(&model, &point, &state, M::ROUNDING * condition);
            assert_reduced_equations_move(&model, &point, M::ROUNDING, &|t, state| {
                reference::<N, M>(&kinetic, t, state)
            });
        }
    }
}

/// Exactly what the motion conserves is listed, once. `held`: the potential depends on `x`.
pub fn conserved_quantities<const N: usize, M: Drawn<N>>(held: bool) {
    for (model, kinetic) in M::models().take(2) {
        let states: Vec<State> =
            model.points().iter().map(|point| exact_state(spin::<N, M>(), point)).collect();
        let motions = |states: &[State]| -> Vec<Motion<'_>> {
            let motion = |state| kinetic.constrained_motion(M::CONSTRAINT, state, T0, &M::potential).unwrap();
            states.iter().map(motion).collect()
        };
        let group = M::CONSTRAINT;
        assert_listed(N, group, M::DESCRIPTION.conserved, &motions(&states), M::TRANSLATION);
        if held {
            assert_eq!(M::DESCRIPTION.conserved_at_rest, M::DESCRIPTION.conserved);
        } else {
            let still: Vec<State> = states.iter().map(State::at_rest).collect();
            assert_listed(N, group, M::DESCRIPTION.conserved_at_rest, &motions(&still), false);
        }
    }
}

/// A run stays on the group, and its energy where it was.
pub fn runs<const N: usize, M: Drawn<N>>() {
    for (model, _) in M::models().take(2) {
        for point in model.points().into_iter().take(2) {
            // Under an indefinite energy a body may escape, or its mass matrix degenerate, in finite time.
            let run = match Simulation::new(&model, point).until(0.5).tolerance(1e-12).run() {
                Ok(run) => run,
                Err(halt) => {
                    assert!(
                        matches!(halt.stop.reason, Reason::StepUnderflow { .. } | Reason::Degenerate { .. }),
                        "{}",
                        halt.stop
                    );
                    continue;
                }
            };
            let (_, end) = run.end();
            let condition = end.phi().norm() * end.phi().inverse().norm();
            let defect = off_the_group(M::CONSTRAINT, &model.orthonormal(end));
            assert!(defect <= ON_THE_GROUP * condition, "{defect:e} at {condition:e}");
            let velocity = model.velocity(&point);
            let size = model.kinetic_energy(point.phi(), &velocity).abs()
                + model.hamiltonian(0.0, &point).abs()
                + point.pi().0.0.norm() * velocity.phi_dot.norm();
            let drift = (model.hamiltonian(0.5, end) - model.hamiltonian(0.0, &point)).abs();
            assert!(drift <= POWER_BALANCE * size * condition, "{drift:e} of {size:e}");
        }
    }
}

/// Statements `name: n, Group key, centre (spec) regular |v| condition, |v| terms, => (potential) value;`, tested with
/// coefficients that meet the condition.
#[macro_export]
macro_rules! drawn {
    ($rounding:expr; $($name:ident: $n:literal $constraint:ident $key:ident $centre:ident $held:literal ($($spec:tt)*)
        |$at:ident| $regular:expr, |$v:ident| $terms:expr $(=> ($($potential:tt)*))?, $energy:expr;)*) => { $(
        mod $name {
            #[allow(clippy::wildcard_imports)]
            use super::*;
            use $crate::group::Start;
            use $crate::drawn::{Coefficients, Drawn};

            #[affine_model(dim = $n, constraint = $key, $($spec)* $(, potential = $($potential)*)?)]
            #[allow(dead_code, reason = "one list of fields serves every statement; each reads its own")]
            struct Body { a: f64, b: f64, c: f64, k: f64 }

            impl Drawn<$n> for PreparedBody {
                const CONSTRAINT: Constraint = Constraint::$constraint;
                const TRANSLATION: bool = $crate::drawn!(@translation $centre);
                const ROUNDING: f64 = $rounding;

                fn draw(random: &mut Random) -> (Self, Kinetic) {
                    let $v = Coefficients::random(random, |$at| $regular);
                    let field = |name: &str| $v.field(name);
                    let body = Body { a: field("a"), b: field("b"), c: field("c"), k: field("k") };
                    (body.prepare().unwrap(), Kinetic::new($n, $terms).unwrap())
                }
                fn potential(place: &Place) -> Differential {
                    let energy: fn(&Place) -> Differential = $energy;
                    energy(place)
                }
                fn at_spin(&self, start: &Start<$n>) -> affine_runtime::Result<Self::Point<f64>> {
                    $crate::drawn!(@point $centre self start)
                }
                fn at_speed(&self, point: &Self::Point<f64>, x_dot: Vector<$n>, phi_dot: Matrix<$n>)
                    -> affine_runtime::Result<Self::Point<f64>> {
                    $crate::drawn!(@velocity $centre self point x_dot phi_dot)
                }
            }

            #[test]
            fn full_equations() {
                $crate::drawn::full_equations::<$n, PreparedBody>();
            }
            #[test]
            fn reduced_equations() {
                $crate::drawn::reduced_equations::<$n, PreparedBody>();
            }
            #[test]
            fn conserved_quantities() {
                $crate::drawn::conserved_quantities::<$n, PreparedBody>($held);
            }
            #[test]
            fn runs() {
                $crate::drawn::runs::<$n, PreparedBody>();
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

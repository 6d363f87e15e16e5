//! Hamiltonians stated on the momentum side, against the canonical equations of the same function of `(x, phi; p, Pi)`.

use affine_oracle::{
    Hamiltonian, Invariant, Matrix as Exact, Observable, Random, Rational, State, rational, rounded,
};
use affine_runtime::prelude::*;

use crate::canonical::{assert_charts_lead_back, assert_reduced_equations_move, groups};
use crate::conserved::{exists, listed_as_a_whole};
use crate::families::{Closed, matrix, vector};
use crate::geodesics::{T0, assert_motion};
use affine_tests::reference::{Reference, assert_close, entries, norm};
use affine_tests::tolerances::CANONICAL;

const SAMPLES: u64 = 8;

/// Values of the fields that the statements have between them.
struct Coefficients {
    n: usize,
    values: [Rational; 5],
}

impl Coefficients {
    /// Of both signs; `a`, `2c - a` and `a + n b` at least 1/16, at most about 8.
    fn random(n: usize, random: &mut Random) -> Self {
        let mut one = || rational((1 - 2 * random.integer(0, 1)) * random.integer(2, 32), 32);
        loop {
            let values = [one(), one(), one(), one(), one()];
            let [a, b, c, _, _] = &values;
            let count = rational(i64::try_from(n).unwrap(), 1);
            let eigenvalues = [rational(2, 1) * c - a, a + count * b];
            if eigenvalues.iter().all(|value| rounded(value).abs() >= 1.0 / 16.0) {
                return Coefficients { n, values };
            }
        }
    }

    fn value(&self, name: &str) -> &Rational {
        let [a, b, c, d, k] = &self.values;
        match name {
            "a" => a,
            "b" => b,
            "c" => c,
            "d" => d,
            "k" => k,
            other => panic!("no field {other}"),
        }
    }

    fn field(&self, name: &str) -> f64 {
        rounded(self.value(name))
    }

    /// How far the summands of the velocity cancel, at least 1.
    fn amplification(&self, state: &State, phi_dot: &[f64]) -> f64 {
        let size = |matrix: &Exact| norm(&matrix.to_f64());
        let spin = size(&(&state.phi * &state.pi)).max(size(&(&state.pi * &state.phi)));
        let [a, b, c, d, _] = self.values.each_ref().map(|value| rounded(value).abs());
        let velocity = (a + b * self.n as f64 + 2.0 * c + d * spin) * spin;
        (velocity * size(&state.phi) / norm(phi_dot)).max(1.0)
    }
}

/// A generated model with random coefficients, and the same Hamiltonian for the oracle.
trait Statement<const N: usize>: Model<N> + Sized {
    const TRANSLATION: bool;
    const CLOSED: Closed;
    fn with(coefficients: &Coefficients) -> (Self, Hamiltonian);
    fn at(&self, state: &State) -> Self::Point<f64>;

    fn random_state(random: &mut Random) -> State {
        let state = random.state(N);
        if Self::TRANSLATION { state } else { State { x: Exact::zeros(N, 1), ..state.at_rest() } }
    }
}

fn reference(hamiltonian: &Hamiltonian, coefficients: &Coefficients, state: &State) -> Reference {
    let expected = hamiltonian.expected(state).unwrap();
    let amplification = coefficients.amplification(state, &expected.phi_dot);
    Reference::of(expected, amplification, state)
}

/// Velocities, `H`, Hamilton's equations; reduction and expansion along the reduced equations.
fn agrees_with_the_oracle<const N: usize, S: Statement<N>>() {
    for seed in 0..SAMPLES {
        let mut random = Random::new(2100 + seed);
        let coefficients = Coefficients::random(N, &mut random);
        let (model, hamiltonian) = S::with(&coefficients);
        let state = S::random_state(&mut random);
        let reference = |state: &State| reference(&hamiltonian, &coefficients, state);
        let at_point = reference(&state);
        let point = model.at(&state);

        let velocity = model.velocity(&point);
        at_point.assert_rate("x", velocity.x_dot.as_slice(), CANONICAL);
        at_point.assert_rate("phi", &entries(&velocity.phi_dot), CANONICAL);
        let (found, expected) = (model.hamiltonian(0.0, &point), at_point.expected.hamiltonian);
        let size = at_point.energy_size() * at_point.condition;
        assert_close("H", &[found], &[expected], size, CANONICAL);

        let rates = model.hamilton_equations(0.0, &model.flatten(&point));
        for (name, rate) in groups(S::DESCRIPTION.full, rates.as_ref()) {
            at_point.assert_rate(name, rate, CANONICAL);
        }
        for state in [state.at_rest(), state] {
            let point = model.at(&state);
            assert_charts_lead_back(&model, &point, &state, CANONICAL * at_point.condition);
            assert_reduced_equations_move(&model, &point, CANONICAL, &|_, state| reference(state));
        }
    }
}

/// What is listed has bracket 0 with `H`, exactly; what is not listed has not.
fn lists_are_exact<const N: usize, S: Statement<N>>() {
    for seed in 0..2 {
        let mut random = Random::new(2200 + seed);
        let (_, hamiltonian) = S::with(&Coefficients::random(N, &mut random));
        let state = S::random_state(&mut random);
        for (state, listed, translation) in [
            (state.at_rest(), S::DESCRIPTION.conserved_at_rest, false),
            (state, S::DESCRIPTION.conserved, S::TRANSLATION),
        ] {
            let brackets = |of| vec![hamiltonian.bracket(of, &state)];
            let listed = listed_as_a_whole(listed, &|of| exists(of, N, translation), 0.0, &brackets);
            for &quantity in Observable::ALL {
                let conserved =
                    exists(quantity, N, translation) && hamiltonian.bracket(quantity, &state).is_zero();
                assert_eq!(listed.contains(&quantity), conserved, "{quantity:?} listed");
            }
        }
    }
}

/// Closed forms exist where they should and are the motion.
fn geodesics_are_the_motion<const N: usize, S: Statement<N>>() {
    for seed in 0..4 {
        let mut random = Random::new(2300 + seed);
        let (model, _) = S::with(&Coefficients::random(N, &mut random));
        let state = S::random_state(&mut random);
        for (start, exists) in [
            (model.at(&state), S::CLOSED == Closed::Always || S::CLOSED == Closed::AtRest && !S::TRANSLATION),
            (model.at(&state.at_rest()), S::CLOSED != Closed::Never),
        ] {
            let geodesic = model.geodesic(T0, &start);
            assert_eq!(geodesic.is_some(), exists, "a closed form");
            if let Some(geodesic) = geodesic {
                assert_motion(&model, &start, |t| model.on_geodesic(&geodesic, t, &start));
            }
        }
    }
}

macro_rules! statements {
    ($($name:ident: $n:literal $centre:ident $closed:ident [$($term:ident($field:ident))*] ($($spec:tt)*);)*) => { $(
        mod $name {
            #[allow(clippy::wildcard_imports)]
            use super::*;

            /// A model of this statement; it reads those fields that it names.
            #[affine_model(dim = $n, hamiltonian($($spec)*))]
            #[allow(dead_code, reason = "one list of fields serves every statement; each reads its own")]
            struct Body { a: f64, b: f64, c: f64, d: f64, k: f64 }

            impl Statement<$n> for PreparedBody {
                const TRANSLATION: bool = statements!(@translation $centre);
                const CLOSED: Closed = Closed::$closed;

                fn with(coefficients: &Coefficients) -> (Self, Hamiltonian) {
                    let field = |name: &str| coefficients.field(name);
                    let body = Body { a: field("a"), b: field("b"), c: field("c"), d: field("d"), k: field("k") };
                    let terms = vec![
                        $(Invariant::$term(coefficients.value(stringify!($field)).clone())),*
                    ];
                    (body.prepare().unwrap(), Hamiltonian::new(terms))
                }
                statements!(@at $centre);
            }

            #[test]
            fn equations() {
                agrees_with_the_oracle::<$n, PreparedBody>();
            }
            #[test]
            fn lists() {
                lists_are_exact::<$n, PreparedBody>();
            }
            #[test]
            fn geodesics() {
                geodesics_are_the_motion::<$n, PreparedBody>();
            }
        }
    )* };
    (@translation pinned) => { false };
    (@translation moving) => { true };
    (@at pinned) => {
        fn at(&self, state: &State) -> Self::Point<f64> {
            self.at_momentum(matrix(&state.phi.to_f64()), TwoPoint(matrix(&state.pi.to_f64()))).unwrap()
        }
    };
    (@at moving) => {
        fn at(&self, state: &State) -> Self::Point<f64> {
            let (x, p) = (vector(&state.x.to_f64()), vector(&state.p.to_f64()));
            let (phi, pi) = (matrix(&state.phi.to_f64()), matrix(&state.pi.to_f64()));
            self.at_momentum(x, phi, p, TwoPoint(pi)).unwrap()
        }
    };
}

statements! {
    vorticity_in_plane: 2 pinned Always [Casimir2(a) Casimir1Squared(b) VorticitySquared(c)]
        (casimir2 = a, casimir1_squared = b, vorticity_squared = c);
    vorticity_missile: 3 moving AtRest [Casimir2(a) Casimir1Squared(b) VorticitySquared(c) BodyTranslation(k)]
        (casimir2 = a, casimir1_squared = b, vorticity_squared = c, body_translation = k);
    spin_drift_in_plane: 2 moving Always [Casimir2(a) SpinSquared(c) SpaceTranslation(k)]
        (casimir2 = a, spin_squared = c, space_translation = k);
    spin_missile: 3 moving AtRest [Casimir2(a) Casimir1Squared(b) SpinSquared(c) BodyTranslation(k)]
        (casimir2 = a, casimir1_squared = b, spin_squared = c, body_translation = k);
    casimirs: 3 pinned Always [Casimir2(a) Casimir1Squared(b)] (casimir2 = a, casimir1_squared = b);
    cubic_vorticity: 3 pinned Always [Casimir2(a) Casimir1Squared(b) VorticitySquared(c) Casimir3(d)]
        (casimir2 = a, casimir1_squared = b, vorticity_squared = c, casimir3 = d);
    cubic_vorticity_missile: 3 moving AtRest [Casimir2(a) VorticitySquared(c) BodyTranslation(k) Casimir3(d)]
        (casimir2 = a, vorticity_squared = c, body_translation = k, casimir3 = d);
    cubic_vorticity_drift: 3 moving Always [Casimir2(a) VorticitySquared(c) SpaceTranslation(k) Casimir3(d)]
        (casimir2 = a, vorticity_squared = c, space_translation = k, casimir3 = d);
    cubic_spin: 3 pinned Always [Casimir2(a) Casimir1Squared(b) SpinSquared(c) Casimir3(d)]
        (casimir2 = a, casimir1_squared = b, spin_squared = c, casimir3 = d);
    cubic_spin_missile: 3 moving AtRest [Casimir2(a) SpinSquared(c) BodyTranslation(k) Casimir3(d)]
        (casimir2 = a, spin_squared = c, body_translation = k, casimir3 = d);
    cubic_alone: 3 pinned Always [Casimir3(d)] (casimir3 = d);
    cubic_alone_missile: 3 moving AtRest [BodyTranslation(k) Casimir3(d)] (body_translation = k, casimir3 = d);
}

/// The Legendre transformation from velocities undoes that from momenta, and `T = H`.
#[test]
fn velocities_lead_back() {
    #[affine_model(
        dim = 3,
        hamiltonian(casimir2 = a, casimir1_squared = b, spin_squared = c, body_translation = k)
    )]
    struct Body {
        a: f64,
        b: f64,
        c: f64,
        k: f64,
    }
    for seed in 0..SAMPLES {
        let mut random = Random::new(2400 + seed);
        let coefficients = Coefficients::random(3, &mut random);
        let [a, b, c, k] = ["a", "b", "c", "k"].map(|name| coefficients.field(name));
        let model = Body { a, b, c, k }.prepare().unwrap();
        let state = random.state(3);
        let (x, p) = (vector(&state.x.to_f64()), vector(&state.p.to_f64()));
        let (phi, pi) = (matrix(&state.phi.to_f64()), matrix(&state.pi.to_f64()));
        let point = model.at_momentum(x, phi, p, TwoPoint(pi)).unwrap();
        let velocity = model.velocity(&point);
        let back = model.at_velocity(x, phi, velocity.x_dot, velocity.phi_dot).unwrap();
        // Of the eigenvalues, between 1/16 and 8, and of phi.
        let tolerance = CANONICAL * 128.0 * phi.norm() * phi.try_inverse().unwrap().norm();
        assert_close("p", back.p().as_slice(), p.as_slice(), p.norm(), tolerance);
        assert_close("Pi", &entries(&back.pi().0.0), &entries(&pi), pi.norm(), tolerance);
        let (t, h) = (model.kinetic_energy(&phi, &velocity), model.hamiltonian(0.0, &point));
        let size = p.norm() * velocity.x_dot.norm() + pi.norm() * velocity.phi_dot.norm();
        assert_close("T", &[t], &[h], size, tolerance);
    }
}

/// What `prepare()` asks of the fields, and what it says.
#[test]
fn values_of_fields_are_checked() {
    #[affine_model(
        dim = 2,
        hamiltonian(casimir2 = a, casimir1_squared = b, vorticity_squared = c, body_translation = k)
    )]
    struct Quadratic {
        a: f64,
        b: f64,
        c: f64,
        k: f64,
    }
    #[affine_model(dim = 3, hamiltonian(casimir2 = a, casimir3 = d, body_translation = k))]
    struct Cubic {
        a: f64,
        d: f64,
        k: f64,
    }
    #[affine_model(dim = 2, require(positive_definite), hamiltonian(casimir2 = a, vorticity_squared = c))]
    struct Definite {
        a: f64,
        c: f64,
    }
    let refused = |[a, b, c, k]: [f64; 4]| Quadratic { a, b, c, k }.prepare().unwrap_err().to_string();
    assert!(Quadratic { a: 0.2, b: 0.1, c: 1.0, k: 2.0 }.prepare().is_ok());
    assert!(refused([0.0, 0.1, 1.0, 2.0]).contains("casimir2 != 0"));
    assert!(refused([0.2, 0.1, 0.1, 2.0]).contains("2 vorticity_squared - casimir2 != 0"));
    assert!(refused([0.2, -0.1, 1.0, 2.0]).contains("casimir2 + n casimir1_squared != 0"));
    assert!(refused([0.2, 0.1, 1.0, 0.0]).contains("1/m != 0"));
    let text = refused([0.2, 0.1, 0.1, 2.0]);
    assert!(text.contains("the velocity does not determine the momentum"), "{text}");
    assert!(Quadratic { a: f64::INFINITY, b: 0.1, c: 1.0, k: 2.0 }.prepare().is_err());
    assert!(Definite { a: 0.2, c: 1.0 }.prepare().is_ok());
    assert!(Definite { a: 0.2, c: 0.05 }.prepare().is_err());
    assert!(Definite { a: -0.2, c: 1.0 }.prepare().is_err());
    assert!(Cubic { a: 0.0, d: 1.0, k: 0.0 }.prepare().is_ok());
    assert!(Cubic { a: 0.0, d: f64::NAN, k: 0.0 }.prepare().is_err());
}

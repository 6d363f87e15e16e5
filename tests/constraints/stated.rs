//! Hamiltonians of constrained models. The oracle's kinetic energy is the Legendre transform of the Hamiltonian that is
//! stated, which it confirms, and then restricted to the velocities that the constraint leaves.

use affine_oracle::{
    Constraint, Differential, Hamiltonian, Invariant, Kinetic, Place, Random, Rational, State, Term,
    rational, rounded,
};
use affine_runtime::prelude::*;

use affine_tests::drawn::Coefficients;
use affine_tests::group::none;
use affine_tests::tolerances::UNDER_POTENTIAL;

/// Eigenvalues `a`, `2c - a`, `a + n b` of `a/2 C(2) + b/2 C(1)^2 + c/2 |W|^2`.
fn eigenvalues(n: usize, v: &Coefficients) -> [Rational; 3] {
    let [a, b, c] = ["a", "b", "c"].map(|name| v.value(name));
    let n = rational(i64::try_from(n).unwrap(), 1);
    [a.clone(), rational(2, 1) * c - &a, a + n * b]
}

fn regular(n: usize, v: &Coefficients) -> bool {
    eigenvalues(n, v).iter().all(|value| rounded(value).abs() >= 1.0 / 16.0)
}

/// `I`, `A`, `B` with `I + A`, `I - A`, `I + A + n B` the reciprocals of those.
fn velocity_side(n: usize, v: &Coefficients) -> [Rational; 3] {
    let [shear, rotation, dilatation] = eigenvalues(n, v).map(|value| rational(1, 1) / value);
    let half = rational(1, 2);
    let nth = rational(1, i64::try_from(n).unwrap());
    [(&shear + &rotation) * &half, (&shear - rotation) * half, (dilatation - shear) * nth]
}

fn of_body(n: usize, v: &Coefficients) -> Vec<Term> {
    let [i, a, b] = velocity_side(n, v);
    vec![Term::body_inertia(n, i), Term::Casimir2(a), Term::Casimir1Squared(b)]
}

fn of_space(n: usize, v: &Coefficients) -> Vec<Term> {
    let [i, a, b] = velocity_side(n, v);
    vec![Term::space_inertia(n, i), Term::Casimir2(a), Term::Casimir1Squared(b)]
}

fn and(mut terms: Vec<Term>, more: Term) -> Vec<Term> {
    terms.push(more);
    terms
}

fn mass(v: &Coefficients) -> Rational {
    rational(1, 1) / v.value("k")
}

/// `H(Pi)` and `T(phi_dot)` at states of GL(n), by the exact rates of both.
#[test]
fn energies_belong_together() {
    for (seed, n) in [(1, 2), (2, 3), (3, 3)] {
        let mut random = Random::new(5000 + seed);
        let v = Coefficients::random(&mut random, |v| regular(n, v));
        let state: State = random.state(n);
        let [a, b, c, k] = ["a", "b", "c", "k"].map(|name| v.value(name));
        let stated = |norm: Invariant, translation: Invariant| {
            Hamiltonian::new(vec![
                Invariant::Casimir2(a.clone()),
                Invariant::Casimir1Squared(b.clone()),
                norm,
                translation,
            ])
        };
        for (hamiltonian, terms) in [
            (
                stated(Invariant::VorticitySquared(c.clone()), Invariant::BodyTranslation(k.clone())),
                and(of_body(n, &v), Term::BodyTranslation(mass(&v))),
            ),
            (
                stated(Invariant::SpinSquared(c.clone()), Invariant::SpaceTranslation(k.clone())),
                and(of_space(n, &v), Term::SpaceTranslation(mass(&v))),
            ),
        ] {
            let kinetic = Kinetic::new(n, terms).unwrap();
            let (motion, rates) = (kinetic.motion(&state).unwrap(), hamiltonian.rate(&state));
            assert_eq!(motion.rate().phi, rates.phi);
            assert_eq!(motion.rate().pi, rates.pi);
            assert_eq!(motion.rate().x, rates.x);
        }
    }
}

affine_tests::drawn! { UNDER_POTENTIAL;
    isochoric_vorticity_2: 2 Isochoric isochoric pinned false (hamiltonian(casimir2 = a, vorticity_squared = c))
        |v| regular(2, v), |v| of_body(2, &v), none;
    isochoric_vorticity_missile_3: 3 Isochoric isochoric moving false
        (hamiltonian(casimir2 = a, vorticity_squared = c, body_translation = k))
        |v| regular(3, v), |v| and(of_body(3, &v), Term::BodyTranslation(mass(&v))), none;
    isochoric_spin_drift_3: 3 Isochoric isochoric moving false
        (hamiltonian(casimir2 = a, spin_squared = c, space_translation = k))
        |v| regular(3, v), |v| and(of_space(3, &v), Term::SpaceTranslation(mass(&v))) => (tr(G)/2),
        |place| place.trace_green() * 0.5;
    isochoric_casimir_3: 3 Isochoric isochoric pinned false (hamiltonian(casimir2 = a))
        |_v| true, |v| vec![Term::Casimir2(rational(1, 1) / v.value("a"))], none;
    rigid_vorticity_3: 3 Rigid rigid pinned false (hamiltonian(casimir2 = a, vorticity_squared = c))
        |v| regular(3, v), |v| of_body(3, &v) => (phi[3,3]), |place| place.phi(3, 3);
    rigid_norm_missile_3: 3 Rigid rigid moving false (hamiltonian(vorticity_squared = c, body_translation = k))
        |_v| true, |v| vec![
            Term::body_inertia(3, rational(1, 2) / v.value("c")),
            Term::BodyTranslation(mass(&v)),
        ], none;
    rigid_spin_2: 2 Rigid rigid moving true (hamiltonian(spin_squared = c, space_translation = k))
        |_v| true, |v| vec![
            Term::space_inertia(2, rational(1, 2) / v.value("c")),
            Term::SpaceTranslation(mass(&v)),
        ] => (x[1]*phi[1,2]), |place| place.x(1) * place.phi(1, 2);
    rigid_casimir_2: 2 Rigid rigid pinned false (hamiltonian(casimir2 = a))
        |_v| true, |v| vec![Term::Casimir2(rational(1, 1) / v.value("a"))], none;
    conformal_vorticity_2: 2 Conformal conformal pinned false
        (hamiltonian(casimir2 = a, casimir1_squared = b, vorticity_squared = c))
        |v| regular(2, v), |v| of_body(2, &v), none;
    conformal_vorticity_missile_3: 3 Conformal conformal moving false
        (hamiltonian(casimir2 = a, casimir1_squared = b, vorticity_squared = c, body_translation = k))
        |v| regular(3, v), |v| and(of_body(3, &v), Term::BodyTranslation(mass(&v))), none;
    conformal_spin_3: 3 Conformal conformal moving false
        (hamiltonian(casimir2 = a, casimir1_squared = b, spin_squared = c, space_translation = k))
        |v| regular(3, v), |v| and(of_space(3, &v), Term::SpaceTranslation(mass(&v))) => (sinh(q)^2),
        |place| place.q().sinh().power(2);
    conformal_without_shear_3: 3 Conformal conformal pinned false
        (hamiltonian(casimir1_squared = b, vorticity_squared = c))
        |_v| true, |v| vec![
            // I - A = 1/(2c), I + A + 3B = 1/(3b)
            Term::body_inertia(3, rational(1, 2) / v.value("c")),
            Term::Casimir1Squared((rational(1, 3) / v.value("b") - rational(1, 2) / v.value("c")) * rational(1, 3)),
        ], none;
}

/// What `prepare()` asks of the fields: of the eigenvalues, those on the momenta that the constraint leaves.
#[test]
fn values_of_fields_are_checked() {
    #[affine_model(dim = 3, constraint = rigid, hamiltonian(casimir2 = a, vorticity_squared = c))]
    struct Rigid {
        a: f64,
        c: f64,
    }
    #[affine_model(dim = 3, constraint = rigid, hamiltonian(casimir2 = a))]
    struct Bare {
        a: f64,
    }
    #[affine_model(dim = 2, constraint = conformal, hamiltonian(casimir2 = a, casimir1_squared = b, spin_squared = c))]
    struct Conformal {
        a: f64,
        b: f64,
        c: f64,
    }
    assert!(Rigid { a: 0.0, c: 1.0 }.prepare().is_ok());
    let text = Rigid { a: 2.0, c: 1.0 }.prepare().unwrap_err().to_string();
    assert!(text.contains("2 vorticity_squared - casimir2 != 0"), "{text}");
    assert!(Bare { a: 1.0 }.prepare().is_ok());
    let text = Bare { a: 0.0 }.prepare().unwrap_err().to_string();
    assert!(text.contains("-casimir2 != 0"), "{text}");
    assert!(Conformal { a: 0.0, b: 1.0, c: 1.0 }.prepare().is_ok());
    let text = Conformal { a: 1.0, b: -0.5, c: 1.0 }.prepare().unwrap_err().to_string();
    assert!(text.contains("casimir2 + n casimir1_squared != 0"), "{text}");
}

/// Whether an inertia from fields is positive does not depend on the units of mass and length: its minors are held against their
/// own terms.
#[test]
fn an_inertia_from_fields_has_any_unit() {
    macro_rules! holds {
        ($($name:ident: $dim:literal, [$($key:ident = $group:ident,)?] $j:tt)*) => { $({
            #[affine_model(dim = $dim, $($key = $group,)? kinetic(dalembert = $j, body_inertia = a))]
            #[allow(dead_code, reason = "a planar body has no third axis")]
            struct $name {
                a: f64,
                b: f64,
                c: f64,
            }
            let is_well_posed = |a: f64, b: f64, c: f64| $name { a, b, c }.prepare().is_ok();
            for unit in [1e-30, 1e-16, 5e-9, 1e-3, 1.0, 1e9, 1e16, 1e30] {
                assert!(is_well_posed(unit, 0.7 * unit, 0.4 * unit), "{}, {unit:e}", stringify!($name));
                assert!(!is_well_posed(unit, -0.7 * unit, 0.4 * unit), "{}, {unit:e}", stringify!($name));
            }
        })* };
    }
    holds! {
        Incompressible: 3, [constraint = isochoric,] [[a, b/10, 0], [b/10, b, 0], [0, 0, c]]
        Conformal: 3, [constraint = conformal,] [[a, b/10, 0], [b/10, b, 0], [0, 0, c]]
        Planar: 2, [constraint = isochoric,] [[a, b/10], [b/10, b]]
    }
}

//! What geodesic motions conserve, and what they do not: (3.1), (4.9)-(4.11) and the invariance of each energy. Each
//! model has a complete list: every observable that the list leaves out must visibly change.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_oracle::{Kinetic, Observable, Observable::*, Random, Term, rational};
use num_traits::Signed;

const SAMPLES: usize = 3;

/// Conserved by every model without potential.
const ALWAYS: &[Observable] = &[Energy, LinearMomentum];
const ANGULAR: &[Observable] = &[TotalAngularMomentum];
const SPATIAL: &[Observable] = &[AffineSpin, Deviator, Spin, SpinNorm];
const COMOVING: &[Observable] = &[ComovingAffineSpin, ComovingDeviator, Vorticity, VorticityNorm];
const VORTICITY: &[Observable] = &[Vorticity, VorticityNorm];
const SPIN: &[Observable] = &[Spin, SpinNorm];
const CASIMIRS: &[Observable] = &[Casimir1, Casimir2, Casimir3, DeviatorCasimir2, DeviatorCasimir3];
/// Zero with their derivatives at `p = 0`.
const TRIVIAL_AT_REST: &[Observable] = &[ComovingLinearMomentum, OrbitalAngularMomentum];

struct Row {
    name: &'static str,
    terms: Vec<Term>,
    /// Beyond [`ALWAYS`], with `p != 0`; absent for pinned bodies.
    moving: Option<Vec<&'static [Observable]>>,
    /// Beyond [`ALWAYS`] and [`TRIVIAL_AT_REST`], with `p = 0`.
    at_rest: Vec<&'static [Observable]>,
}

fn affine(i: Term, casimirs: bool) -> Vec<Term> {
    let mut terms = vec![i];
    if casimirs {
        terms.extend([Term::Casimir2(rational(1, 5)), Term::Casimir1Squared(rational(1, 10))]);
    }
    terms
}

fn with(mut terms: Vec<Term>, translation: Term) -> Vec<Term> {
    terms.push(translation);
    terms
}

fn rows(n: usize, random: &mut Random) -> Vec<Row> {
    let m = || rational(3, 2);
    let left = || affine(Term::body_inertia(n, rational(1, 1)), true);
    let right = || affine(Term::space_inertia(n, rational(1, 1)), true);
    let both = || vec![Term::Casimir2(rational(1, 5)), Term::Casimir1Squared(rational(1, 10))];
    let rigid = || affine(Term::dalembert(n, rational(2, 1)), false);
    let flat = affine(Term::DAlembert(random.inertia(n)), false);
    let tensor = affine(Term::BodyTensor(random.tensor(n)), false);
    let anisotropic = affine(Term::SpaceInertia(random.inertia(n)), true);

    const IO: &[Observable] = &[TotalAffineMomentum, TotalAngularMomentum];
    const PI: &[Observable] = &[CanonicalMomentum];
    const ORBITAL: &[Observable] = &[OrbitalAngularMomentum];
    let left_rest = || vec![IO, SPATIAL, VORTICITY, CASIMIRS];
    let both_rest = || vec![IO, SPATIAL, COMOVING, CASIMIRS];
    let right_any = || vec![ANGULAR, ORBITAL, SPIN, COMOVING, CASIMIRS];
    let flat_any = |more: &[&'static [Observable]]| [&[ANGULAR, ORBITAL, PI, SPIN], more].concat();
    vec![
        Row {
            name: "L",
            terms: with(left(), Term::BodyTranslation(m())),
            moving: Some(vec![IO, VORTICITY]),
            at_rest: left_rest(),
        },
        Row { name: "L pinned", terms: left(), moving: None, at_rest: left_rest() },
        Row {
            name: "L, anisotropic",
            terms: with(tensor.clone(), Term::BodyTranslation(m())),
            moving: Some(vec![IO]),
            at_rest: vec![IO, SPATIAL, CASIMIRS],
        },
        Row {
            name: "R",
            terms: with(right(), Term::SpaceTranslation(m())),
            moving: Some(right_any()),
            at_rest: right_any(),
        },
        Row { name: "R pinned", terms: right(), moving: None, at_rest: right_any() },
        Row {
            name: "AA with body translation",
            terms: with(both(), Term::BodyTranslation(m())),
            moving: Some(vec![IO, VORTICITY]),
            at_rest: both_rest(),
        },
        Row {
            name: "AA with space translation",
            terms: with(both(), Term::SpaceTranslation(m())),
            moving: Some(vec![ANGULAR, ORBITAL, SPATIAL, COMOVING, CASIMIRS]),
            at_rest: both_rest(),
        },
        Row { name: "AA pinned", terms: both(), moving: None, at_rest: both_rest() },
        Row {
            name: "d'Alembert, isotropic",
            terms: with(rigid(), Term::SpaceTranslation(m())),
            moving: Some(flat_any(&[VORTICITY])),
            at_rest: flat_any(&[VORTICITY]),
        },
        Row {
            name: "d'Alembert, isotropic, pinned",
            terms: rigid(),
            moving: None,
            at_rest: flat_any(&[VORTICITY]),
        },
        Row {
            name: "d'Alembert, anisotropic",
            terms: with(flat.clone(), Term::SpaceTranslation(m())),
            moving: Some(flat_any(&[])),
            at_rest: flat_any(&[]),
        },
        Row { name: "d'Alembert, anisotropic, pinned", terms: flat, moving: None, at_rest: flat_any(&[]) },
        Row {
            name: "R, anisotropic, pinned",
            terms: anisotropic,
            moving: None,
            at_rest: vec![COMOVING, CASIMIRS],
        },
    ]
}

/// The observables that do not vary with the state at hand: listed ones, and `tr sigma^3 = 0` for `n = 2`.
fn conserved(n: usize, lists: &[&[Observable]], at_rest: bool) -> Vec<Observable> {
    let mut all = [&[ALWAYS], lists].concat().concat();
    if at_rest {
        all.extend(TRIVIAL_AT_REST);
    }
    if n == 2 {
        all.push(DeviatorCasimir3);
    }
    all
}

#[test]
fn conserved_and_not_conserved_by_geodesic_motion() {
    // Rates of change of order 1 are the rule for data of order 1; a hundredth is far from an accidental zero.
    let visible = rational(1, 100);
    for n in [2, 3] {
        let mut random = Random::new(11);
        for row in rows(n, &mut random) {
            let kinetic = Kinetic::new(n, row.terms).unwrap();
            assert_eq!(kinetic.has_translation(), row.moving.is_some(), "{}", row.name);
            let moving = row.moving.map(|lists| (lists, false));
            for (lists, at_rest) in moving.into_iter().chain([(row.at_rest, true)]) {
                let conserved = conserved(n, &lists, at_rest);
                let mut largest = vec![rational(0, 1); Observable::ALL.len()];
                for _ in 0..SAMPLES {
                    let state = random.state(n);
                    let state = if at_rest { state.at_rest() } else { state };
                    let motion = kinetic.motion(&state).unwrap();
                    for (&observable, largest) in Observable::ALL.iter().zip(&mut largest) {
                        for entry in motion.bracket(observable).unwrap().entries() {
                            *largest = entry.abs().max(largest.clone());
                        }
                    }
                }
                for (&observable, largest) in Observable::ALL.iter().zip(&largest) {
                    let label = format!("{} n={n} at_rest={at_rest}: {observable:?} {largest}", row.name);
                    if conserved.contains(&observable) {
                        assert_eq!(*largest, rational(0, 1), "{label}");
                    } else {
                        assert!(*largest > visible, "{label}");
                    }
                }
            }
        }
    }
}

#[test]
fn names_are_those_of_the_variants() {
    for &observable in Observable::ALL {
        assert_eq!(observable.name(), format!("{observable:?}"));
        assert_eq!(Observable::named(observable.name()), Some(observable));
    }
    assert_eq!(Observable::named("Mass"), None);
}

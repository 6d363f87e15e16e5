//! Potentials of the oracle against closed forms of Slawianowski et al., Part I, section 5, which it does not use, and
//! what motions under potentials conserve: every observable that a row leaves out must visibly change.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_oracle::{
    Differential, Kinetic, Matrix, Motion, Observable, Observable::*, Place, Random, Slopes, State, Term,
    rational, rounded,
};
use nalgebra::DMatrix;

const SAMPLES: u64 = 6;
/// Some ten roundings in numbers of order 1 to 30. The largest error seen is 3e-15.
const CLOSED_FORM: f64 = 1e-13;
/// Rounding errors of gradients in `f64`, in numbers of order 1 to 100.
const ZERO: f64 = 1e-10;
/// Rates of change of order 1 are the rule for data of order 1; a thousandth is far from an accidental zero.
const VISIBLE: f64 = 1e-3;

fn states(n: usize) -> impl Iterator<Item = State> {
    (0..SAMPLES).map(move |seed| Random::new(71 + seed).state(n))
}

fn square(n: usize, entries: &[f64]) -> DMatrix<f64> {
    DMatrix::from_row_slice(n, n, entries)
}

/// `Q_hat = -(dU/dphi)^T phi` and `Q = -phi (dU/dphi)^T`.
fn forces(
    potential: impl Fn(&Place) -> Differential,
    state: &State,
) -> (f64, DMatrix<f64>, DMatrix<f64>, DMatrix<f64>) {
    let n = state.dimension();
    let phi = state.phi.to_f64();
    let slopes = Slopes::of(&potential, 0.0, &state.x.to_f64(), &phi);
    let (phi, gradient) = (square(n, &phi), square(n, &slopes.phi).transpose());
    (slopes.value, -(&gradient * &phi), -(&phi * &gradient), phi)
}

fn assert_near(what: &str, found: &DMatrix<f64>, expected: &DMatrix<f64>) {
    let (error, size) = ((found - expected).norm(), expected.norm().max(1.0));
    assert!(error <= CLOSED_FORM * size, "{what}: {error:e} of {size:e}\n{found}{expected}");
}

fn assert_equal(what: &str, found: f64, expected: f64) {
    assert_near(what, &DMatrix::from_element(1, 1, found), &DMatrix::from_element(1, 1, expected));
}

/// Any `U(q)`: `Q = Q_hat = -(U'(q)/n) 1`; with `U = sh^2(q)/2 = (D^2 + D^-2 - 2)/8`, `-1/(2 ch^2 q)` and `q^2/2`.
#[test]
fn dilatational_potentials() {
    type Function = (Potential, fn(f64) -> f64, fn(f64) -> f64);
    let functions: [Function; 3] = [
        (
            |place| place.q().sinh().power(2) * 0.5,
            |q| (q.exp().powi(2) + q.exp().powi(-2) - 2.0) / 8.0,
            |q| (2.0 * q).sinh() / 2.0,
        ),
        (
            |place| (place.q().tanh().power(2) - 1.0) * 0.5,
            |q| -0.5 / q.cosh().powi(2),
            |q| q.tanh() / q.cosh().powi(2),
        ),
        (|place| place.q().power(2) * 0.5, |q| q * q / 2.0, |q| q),
    ];
    for n in [2, 3] {
        for state in states(n) {
            for (potential, value, slope) in functions {
                let (found, body, space, phi) = forces(potential, &state);
                let q = phi.determinant().ln() / n as f64;
                let expected = DMatrix::identity(n, n) * (-slope(q) / n as f64);
                assert_equal("U", found, value(q));
                assert_near("Q_hat", &body, &expected);
                assert_near("Q", &space, &expected);
            }
        }
    }
}

/// `U_sh = tr(G) det^(-2/n) - n`: `Q_hat = -2 e^(-2q) (G - (tr G/n) 1)`, and `Q` with `phi phi^T` in the place of `G`.
#[test]
fn shear_potential() {
    for n in [2, 3] {
        for state in states(n) {
            let (value, body, space, phi) =
                forces(|place| place.trace_green() * (place.q() * -2.0).exp() - place.n(), &state);
            let scale = phi.determinant().powf(-2.0 / n as f64);
            let deviator = |matrix: DMatrix<f64>| {
                let mean = matrix.trace() / n as f64;
                (matrix - DMatrix::identity(n, n) * mean) * (-2.0 * scale)
            };
            assert_equal("U", value, (phi.transpose() * &phi).trace() * scale - n as f64);
            assert_near("Q_hat", &body, &deviator(phi.transpose() * &phi));
            assert_near("Q", &space, &deviator(&phi * phi.transpose()));
        }
    }
}

/// Isotropic `U(q_1 .. q_n)`: `Q_hat = -R diag(dU/dq_a) R^T`, `Q = -L diag(dU/dq_a) L^T` with `phi = L e^q R^T`; here
/// `U = tr G^2 = sum_a e^(4 q_a)`.
#[test]
fn isotropic_potential() {
    for n in [2, 3] {
        for state in states(n) {
            let (value, body, space, phi) = forces(Place::trace_green_squared, &state);
            let polar = phi.svd(true, true);
            let (left, right) = (polar.u.unwrap(), polar.v_t.unwrap().transpose());
            let fourth = polar.singular_values.map(|stretch| stretch.powi(4));
            let slopes = DMatrix::from_diagonal(&(&fourth * -4.0));
            assert_equal("U", value, fourth.sum());
            assert_near("Q_hat", &body, &(&right * &slopes * right.transpose()));
            assert_near("Q", &space, &(&left * &slopes * left.transpose()));
        }
    }
}

/// Where a closed form of the gradient is seen at once.
#[test]
fn gradients_of_entries_and_of_space_and_time() {
    for n in [2, 3] {
        for state in states(n) {
            let (x, phi) = (state.x.to_f64(), state.phi.to_f64());
            let of = |potential: &dyn Fn(&Place) -> Differential| Slopes::of(potential, 0.75, &x, &phi);
            let radial = of(&|place| place.distance().power(2) * 0.5);
            radial.x.iter().zip(&x).for_each(|(found, expected)| assert_equal("dU/dx", *found, *expected));
            assert!(radial.phi.iter().all(|slope| *slope == 0.0) && radial.t == 0.0);
            let driven = of(&|place| place.t().cos() * place.x(2));
            assert_equal("dU/dt", driven.t, -0.75f64.sin() * x[1]);
            assert_equal("dU/dx_2", driven.x[1], 0.75f64.cos());
            // phi[1,2] = phi[0 n + 1]; Ct[1,2] = sum_A phi[1,A] phi[2,A]; G[1,2] = sum_i phi[i,1] phi[i,2].
            assert_equal("phi[1,2]^3", of(&|place| place.phi(1, 2).power(3)).phi[1], 3.0 * phi[1].powi(2));
            let (finger, green) = (of(&|place| place.finger(1, 2)), of(&|place| place.green(1, 2)));
            for k in 0..n {
                assert_equal("dCt[1,2]/dphi[1,k]", finger.phi[k], phi[n + k]);
                assert_equal("dCt[1,2]/dphi[2,k]", finger.phi[n + k], phi[k]);
                assert_equal("dG[1,2]/dphi[k,1]", green.phi[k * n], phi[k * n + 1]);
                assert_equal("dG[1,2]/dphi[k,2]", green.phi[k * n + 1], phi[k * n]);
            }
        }
    }
}

/// The forces enter Hamilton's equations so that the power of the kinetic energy is that lost by the potential.
#[test]
fn energy_is_conserved() {
    for n in [2, 3] {
        for state in states(n) {
            let potential = |place: &Place| place.x(1) * place.trace_green() + place.phi(1, 2).power(3);
            for (name, kinetic) in models(n) {
                let motion = kinetic.motion(&state).unwrap();
                let rest = motion.energy().clone();
                let motion = motion.under(0.0, &potential).unwrap();
                let slopes = Slopes::of(&potential, 0.0, &state.x.to_f64(), &state.phi.to_f64());
                let rate = motion.rate();
                let along = |slopes: &[f64], rate: &Matrix| {
                    slopes.iter().zip(rate.to_f64()).map(|(slope, rate)| slope * rate).sum::<f64>()
                };
                let lost = along(&slopes.x, &rate.x) + along(&slopes.phi, &rate.phi);
                let gained = motion.bracket(Energy).unwrap().to_f64()[0];
                let size = gained.abs().max(1.0);
                assert!((gained + lost).abs() <= CLOSED_FORM * size * 10.0, "{name}: {gained} {lost}");
                assert_equal("H", rounded(motion.energy()), rounded(&rest) + slopes.value);
            }
        }
    }
}

const ANGULAR: &[Observable] = &[TotalAngularMomentum];
const ORBITAL: &[Observable] = &[OrbitalAngularMomentum];
const SPIN: &[Observable] = &[Spin, SpinNorm];
const VORTICITY: &[Observable] = &[Vorticity, VorticityNorm];
const COMOVING: &[Observable] = &[ComovingAffineSpin, ComovingDeviator];
const CASIMIRS: &[Observable] = &[Casimir1, Casimir2, Casimir3];
const DEVIATOR_CASIMIRS: &[Observable] = &[DeviatorCasimir2, DeviatorCasimir3];
const P: &[Observable] = &[LinearMomentum];
const PI: &[Observable] = &[CanonicalMomentum];

type Lists = Vec<&'static [Observable]>;

fn models(n: usize) -> Vec<(&'static str, Kinetic)> {
    let m = || rational(3, 2);
    let both = || vec![Term::Casimir2(rational(1, 5)), Term::Casimir1Squared(rational(1, 10))];
    let with = |mut terms: Vec<Term>, more: Vec<Term>| {
        terms.extend(more);
        Kinetic::new(n, terms).unwrap()
    };
    let (body, space) = (Term::body_inertia(n, rational(1, 1)), Term::space_inertia(n, rational(1, 1)));
    let (carried, free) = (|| Term::BodyTranslation(m()), || Term::SpaceTranslation(m()));
    let inertia = Random::new(5).inertia(n);
    vec![
        ("L", with(both(), vec![body, carried()])),
        ("R", with(both(), vec![space, free()])),
        ("AA, body translation", with(both(), vec![carried()])),
        ("AA, space translation", with(both(), vec![free()])),
        ("d'Alembert, isotropic", with(vec![Term::dalembert(n, rational(2, 1))], vec![free()])),
        ("d'Alembert, anisotropic", with(vec![Term::DAlembert(inertia)], vec![free()])),
    ]
}

type Potential = fn(&Place) -> Differential;

/// Classes of potentials.
const CLASSES: [(&str, Potential); 7] = [
    ("U(q)", |place| place.q().sinh().power(2) * 1.5),
    ("U(q_a)", |place| place.trace_green() * (place.q() * -2.0).exp() + place.trace_green_squared()),
    ("U(G)", |place| place.green(1, 2) * place.green(1, 1)),
    ("U(phi phi^T)", |place| place.finger(1, 2).power(2) * place.finger(1, 1)),
    ("U(phi)", |place| place.phi(1, 2).power(3)),
    ("U(|x|)", |place| place.distance().power(4)),
    ("U(x)", |place| place.x(1).power(3) + place.x(1) * place.x(2)),
];

/// What a model conserves with `p != 0`, and with `p = 0` where the potential leaves it there; the energy is apart.
fn table(model: &str, class: &str) -> (Lists, Option<Lists>) {
    let radial = class == "U(|x|)";
    let held = radial || class == "U(x)";
    // Of S, Vort and the quantities of (q) alone: what the potential leaves to a kinetic energy with all of them.
    let spin = if ["U(q)", "U(q_a)", "U(G)"].contains(&class) || held { SPIN } else { &[] };
    let vorticity = if ["U(q)", "U(q_a)", "U(phi phi^T)"].contains(&class) || held { VORTICITY } else { &[] };
    let only = |condition: bool, list: &'static [Observable]| if condition { list } else { &[] };
    let dilatational = class == "U(q)";
    let p = only(!held, P);
    let at_rest = only(!held, &[LinearMomentum, ComovingLinearMomentum, OrbitalAngularMomentum]);
    let rotations = only(!spin.is_empty() && (radial || !held), ANGULAR);
    let orbital = only(!held || radial, ORBITAL);
    match model {
        "L" => {
            let moving = vec![p, rotations, vorticity];
            let resting = vec![
                at_rest,
                rotations,
                spin,
                vorticity,
                only(dilatational, &[Deviator]),
                only(dilatational, DEVIATOR_CASIMIRS),
            ];
            (moving, (!held).then_some(resting))
        }
        "R" => {
            let comoving = only(held, COMOVING);
            let casimirs = only(held, CASIMIRS);
            let deviator = only(dilatational, &[ComovingDeviator]);
            let shears = only(dilatational || held, DEVIATOR_CASIMIRS);
            let lists = vec![p, orbital, rotations, spin, vorticity, comoving, casimirs, deviator, shears];
            let resting = (!held).then(|| [lists.clone(), vec![at_rest]].concat());
            (lists, resting)
        }
        "AA, body translation" => {
            let moving = vec![p, rotations, vorticity];
            let resting = vec![
                at_rest,
                rotations,
                spin,
                vorticity,
                only(dilatational, &[Deviator, ComovingDeviator]),
                only(dilatational, DEVIATOR_CASIMIRS),
            ];
            (moving, (!held).then_some(resting))
        }
        "AA, space translation" => {
            let deviators = only(dilatational || held, &[Deviator, ComovingDeviator]);
            let shears = only(dilatational || held, DEVIATOR_CASIMIRS);
            let spins = only(held, &[AffineSpin, ComovingAffineSpin]);
            let casimirs = only(held, CASIMIRS);
            let lists = vec![p, orbital, rotations, spin, vorticity, deviators, shears, spins, casimirs];
            let resting = (!held).then(|| [lists.clone(), vec![at_rest]].concat());
            (lists, resting)
        }
        _ => {
            let vorticity = only(model == "d'Alembert, isotropic", vorticity);
            let lists = vec![p, orbital, rotations, spin, vorticity, only(held, PI)];
            let resting = (!held).then(|| [lists.clone(), vec![at_rest]].concat());
            (lists, resting)
        }
    }
}

fn largest_rates<'a>(motions: impl Iterator<Item = Motion<'a>>) -> Vec<(Observable, f64)> {
    let mut largest: Vec<(Observable, f64)> =
        Observable::ALL.iter().map(|observable| (*observable, 0.0)).collect();
    for motion in motions {
        for (observable, largest) in &mut largest {
            let rates = motion.bracket(*observable).unwrap().to_f64();
            *largest = rates.iter().fold(*largest, |largest, rate| largest.max(rate.abs()));
        }
    }
    largest
}

/// Model by model and class by class.
#[test]
fn conserved_and_not_conserved_under_potentials() {
    for n in [2, 3] {
        for (model, kinetic) in models(n) {
            for (class, potential) in CLASSES {
                let (moving, at_rest) = table(model, class);
                for (lists, resting) in [(Some(moving), false), (at_rest, true)] {
                    let Some(lists) = lists else { continue };
                    let points: Vec<State> = states(n)
                        .take(3)
                        .map(|state| if resting { state.at_rest() } else { state })
                        .collect();
                    let motions = points
                        .iter()
                        .map(|state| kinetic.motion(state).unwrap().under(0.0, &potential).unwrap());
                    for (observable, largest) in largest_rates(motions) {
                        // The kinetic energy is no constant; tr sigma^3 = 0 identically for n = 2.
                        let listed =
                            lists.concat().contains(&observable) || n == 2 && observable == DeviatorCasimir3;
                        let label =
                            format!("{model}, {class}, n = {n}, {resting}: {observable:?} {largest:e}");
                        if listed {
                            assert!(largest <= ZERO, "{label}");
                        } else {
                            assert!(largest > VISIBLE, "{label}");
                        }
                    }
                }
            }
        }
    }
}

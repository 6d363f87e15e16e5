//! At points: the Legendre transformation, Hamilton's equations, the reduced ones and changes of motions, by the oracle.

use affine_runtime::model::Quantity;
use affine_tests::reference::norm;

use crate::body::Trajectory;
use crate::case::{T0, cases};
use crate::runs::{count, in_order, slope};

/// Roundings, per condition of the mass matrix. The largest error seen is 5e-16.
const ROUNDING: f64 = 1e-14;
/// Differences of order 4 in steps of 2^-14, and of order 6 in steps of 2^-9, likewise. The largest error seen is 6e-12.
const DIFFERENCES: f64 = 1e-10;
/// What commutes with the rest has moved by then.
const LATER: f64 = T0 + 0.375;

#[test]
fn velocities_energies_and_hamiltons_equations() {
    for case in cases() {
        for full in case.points() {
            let body = &case.subject.body;
            let point = body.point(&full);
            case.law.assert_stated_twice(&point.state());
            let expected = case.law.at(T0, &point.state());
            let tolerance = ROUNDING * expected.condition;
            case.assert_close("the plain array", &body.back(&full), &full, norm(&full), ROUNDING);
            let [x_dot, phi_dot] = body.velocity(&full);
            case.assert_close("x_dot", &x_dot, &expected.rates[0], norm(&expected.rates[0]), tolerance);
            case.assert_close("phi_dot", &phi_dot, &expected.rates[1], norm(&expected.rates[1]), tolerance);
            let [energy, power] = body.energy(T0, &full);
            let size =
                expected.energy.abs() + norm(&point.pi) * norm(&phi_dot) + norm(&point.p) * norm(&x_dot);
            case.assert_close("H", &[energy], &[expected.energy], size, tolerance);
            let size = size + norm(&expected.push[1]) * norm(&phi_dot);
            case.assert_close("dH/dt", &[power], &[expected.power], size, tolerance);
            let rates = body.moving(&full, &body.hamilton(T0, &full));
            case.assert_parts("rate of", &rates, &expected.rates, tolerance);
        }
    }
}

/// From velocities to momenta, and the kinetic energy.
#[test]
fn momenta_of_velocities() {
    let mut tried = 0;
    for case in cases() {
        assert_eq!(case.subject.velocities.is_some(), case.law.kinetic().is_some(), "{}", case.name);
        let (Some(legendre), Some(kinetic)) = (&case.subject.velocities, case.law.kinetic()) else {
            continue;
        };
        tried += 1;
        for full in case.points() {
            let (point, [x_dot, phi_dot]) =
                (case.subject.body.point(&full), case.subject.body.velocity(&full));
            let condition = case.law.at(T0, &point.state()).condition;
            let (p, pi, energy) = legendre([&point.x, &point.phi, &x_dot, &phi_dot]);
            case.assert_close("p", &p, &point.p, norm(&point.p), ROUNDING * condition);
            case.assert_close("Pi", &pi, &point.pi, norm(&point.pi), ROUNDING * condition);
            let n = case.dim();
            let exact = |rows, columns, entries: &[f64]| {
                affine_oracle::Matrix::from_f64("velocity", rows, columns, entries).unwrap()
            };
            let state = point.state();
            let expected = kinetic.energy(&state.phi, &exact(n, 1, &x_dot), &exact(n, n, &phi_dot)).unwrap();
            let size = norm(&phi_dot) * norm(&pi);
            case.assert_close("T", &[energy], &expected.to_f64(), size, ROUNDING * condition);
        }
    }
    let cubic = cases().iter().filter(|case| case.law.kinetic().is_none()).count();
    assert_eq!(tried, cases().len() - cubic);
}

/// The chart of the reduced state leads back to the point, and a point of it at any time changes with the start as it is said to.
#[test]
fn reduced_states() {
    for case in cases() {
        for seed in 0..2 {
            let (full, direction) = case.drawn(seed);
            let body = &case.subject.body;
            let at = |t: f64, distance: f64| {
                let moved: Vec<f64> = full.iter().zip(&direction).map(|(v, d)| v + distance * d).collect();
                let from = Trajectory { t0: T0, full: &moved };
                in_order(&body.expanded(from, t, &body.reduced(from)))
            };
            let condition = case.law.at(T0, &body.point(&full).state()).condition;
            case.assert_parts("the point", &body.point(&full), &at(T0, 0.0), ROUNDING * condition);
            let slope = slope(|distance| at(LATER, distance).concat());
            let [_, _, change, _] = body.varied(Trajectory { t0: T0, full: &full }, LATER, &direction);
            let change = in_order(&change).concat();
            case.assert_close("change", &change, &slope, norm(&slope), DIFFERENCES * condition);
        }
    }
}

/// What is integrated, at a time away from the start: the rate of the point that a reduced state stands for, and the rate of
/// its change along a direction.
#[test]
fn reduced_equations_and_their_variations() {
    for case in cases() {
        for seed in 0..2 {
            let (full, direction) = case.drawn(seed);
            let (body, from) = (&case.subject.body, Trajectory { t0: T0, full: &full });
            let [point, rate, change, change_of_rate] = body.varied(from, LATER, &direction);
            let (state, along) = (point.state(), change.state());
            let expected = case.law.at(LATER, &state);
            case.assert_parts("reduced rate of", &rate, &expected.rates, ROUNDING * expected.condition);
            let changes = case.law.change(LATER, &state, &along);
            let tolerance = DIFFERENCES * expected.condition;
            case.assert_parts("changed rate of", &change_of_rate, &changes, tolerance);
            let rates = body.rates(from, LATER, &body.reduced(from));
            if let Some(work) = case.of_reduced(Quantity::Work, &rates) {
                let size = 1.0 + norm(&expected.push[1]) * norm(&expected.rates[1]);
                case.assert_close("work", work, &[expected.power], size, ROUNDING * expected.condition);
            }
        }
    }
}

/// The form of the kinetic energy, and its inverse.
#[test]
fn metrics() {
    let mut tried = 0;
    for case in cases() {
        let Some(metric) = &case.subject.metric else { continue };
        tried += 1;
        for full in case.points() {
            let point = case.subject.body.point(&full);
            let [form, inverse] = metric(&point.phi);
            let expected = case.law.at(T0, &point.state());
            let velocity = [&*expected.rates[0], &*expected.rates[1]];
            let rows: Vec<f64> = (0..case.dim().pow(2))
                .map(|k| point.pi[case.dim() * (k % case.dim()) + k / case.dim()])
                .collect();
            let momentum = [&*point.p, &*rows];
            let size = form.len().isqrt();
            let joined = |parts: [&[f64]; 2]| match size == case.dim().pow(2) {
                true => parts[1].to_vec(),
                false => parts.concat(),
            };
            let (v, p) = (joined(velocity), joined(momentum));
            let times = |m: &[f64], u: &[f64]| -> Vec<f64> {
                m.chunks(size).map(|row| row.iter().zip(u).map(|(m, u)| m * u).sum()).collect()
            };
            let tolerance = ROUNDING * expected.condition;
            case.assert_close("Gamma^-1 p", &times(&inverse, &p), &v, norm(&v), tolerance);
            let twice: f64 = times(&form, &v).iter().zip(&v).map(|(a, b)| a * b).sum();
            let kinetic = case.law.kinetic().unwrap();
            if case.law.constraint.is_none() {
                let mass = kinetic.mass_matrix(&point.state().phi).unwrap().to_f64();
                case.assert_close("Gamma", &form, &mass, norm(&mass), tolerance);
            }
            let product: f64 = v.iter().zip(&p).map(|(v, p)| v * p).sum();
            case.assert_close("v Gamma v", &[twice], &[product], norm(&v) * norm(&p), tolerance);
        }
    }
    assert_eq!(tried, count("metric"));
}

/// `x''`, by the change of `x'` along the motion.
#[test]
fn accelerations() {
    let mut tried = 0;
    for case in cases() {
        let Some(acceleration) = &case.subject.acceleration else { continue };
        tried += 1;
        for full in case.points() {
            let state = case.subject.body.point(&full).state();
            let rates = case.law.at(T0, &state).rates;
            let n = case.dim();
            let exact = |k: usize, rows, columns| {
                affine_oracle::Matrix::from_f64("rate", rows, columns, &rates[k]).unwrap()
            };
            let along = affine_oracle::State {
                x: exact(0, n, 1),
                phi: exact(1, n, n),
                p: exact(2, n, 1),
                pi: exact(3, n, n),
            };
            let [expected, ..] = case.law.change(T0, &state, &along);
            let [found] = acceleration(T0, &full);
            case.assert_close("x''", &found, &expected, norm(&expected), DIFFERENCES);
        }
    }
    assert_eq!(tried, count("acceleration"));
}

/// `K = phi Pi` and `K_hat = Pi phi^-T`: their rates along the exact motion, and which part of them forces have.
#[test]
fn balances() {
    use affine_oracle::{Matrix as Exact, Ring, State};
    fn both<R: Ring>(State { phi, p, pi, .. }: &State<R>) -> [Exact<R>; 4] {
        let inverse = phi.inverse().unwrap();
        [phi * pi, pi * &inverse.transpose(), p.clone(), &inverse * p]
    }
    let mut tried = 0;
    for case in cases() {
        let Some(balance) = &case.subject.balance else { continue };
        tried += 1;
        for full in case.points() {
            let state = case.subject.body.point(&full).state();
            let expected = case.law.at(T0, &state);
            let n = case.dim();
            let exact = |entries: &[f64], columns| Exact::from_f64("rate", n, columns, entries).unwrap();
            let [x, phi, p, pi] = &expected.rates;
            let rate = State { x: exact(x, 1), phi: exact(phi, n), p: exact(p, 1), pi: exact(pi, n) };
            let moving = both(&state.along(&rate)).map(|quantity| quantity.slope().to_f64());
            let still = State {
                x: Exact::zeros(n, 1),
                phi: Exact::zeros(n, n),
                p: exact(&expected.push[0], 1),
                pi: exact(&expected.push[1], n),
            };
            let pushed = both(&state.along(&still)).map(|quantity| quantity.slope().to_f64());
            let now = both(&state).map(|quantity| quantity.to_f64());
            let size = moving.iter().chain(&pushed).map(|part| norm(part)).fold(1.0, f64::max);
            let tolerance = ROUNDING * expected.condition;
            let close = |what: &str, [whole, inertia, force]: [&[f64]; 3], of: usize| {
                let rate: Vec<f64> = inertia.iter().zip(force).map(|(i, f)| i + f).collect();
                case.assert_close(what, whole, &now[of], norm(&now[of]), tolerance);
                case.assert_close(&format!("the rate of {what}"), &rate, &moving[of], size, tolerance);
                case.assert_close(&format!("the force on {what}"), force, &pushed[of], size, tolerance);
            };
            let [spin, inertia, moment, spin_hat, inertia_hat, moment_hat] = balance(T0, &full);
            close("K", [&spin, &inertia, &moment], 0);
            close("K_hat", [&spin_hat, &inertia_hat, &moment_hat], 1);
            if let Some(centre) = &case.subject.centre {
                let [k, force, k_hat, inertia_hat, force_hat] = centre(T0, &full);
                close("k", [&k, &vec![0.0; n], &force], 2);
                close("k_hat", [&k_hat, &inertia_hat, &force_hat], 3);
            }
        }
    }
    assert_eq!(tried, count("balance"));
}

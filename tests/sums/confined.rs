//! Sums of frames under constraints, and flat tensors: mass matrices on the Lie algebra that depend on the placement.

use affine_oracle::{
    Constraint, Differential, Kinetic, Matrix as Exact, Place, Random, Rational, Term, rational,
};
use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;
use affine_runtime::{Error, error::IllPosed};

use affine_tests::drawn::Coefficients;
use affine_tests::group::none;
use affine_tests::tolerances::{DEGENERATION, MIXED, UNDER_POTENTIAL};

/// Rounding errors of the factorisation, and of gradients in `f64`.
const ROUNDING: f64 = MIXED + UNDER_POTENTIAL;

/// The square of a field: a mass, an inertia.
fn square(v: &Coefficients, name: &str) -> Rational {
    v.value(name) * v.value(name)
}

fn one() -> Rational {
    rational(1, 1)
}

/// `diag(1, 3/2, 2)`, or its first two rows and columns, times a number.
fn diagonal(n: usize, factor: &Rational) -> Exact {
    let entry = |a: usize| rational(i64::try_from(a).unwrap() + 2, 2) * factor;
    (0..n).fold(Exact::zeros(n, n), |sum, a| &sum + &Exact::unit(n, a, a).scaled(&entry(a)))
}

/// Rows of quarters.
fn quarters(n: usize, entries: &[i64]) -> Exact {
    let entries: Vec<_> = entries.iter().map(|entry| rational(*entry, 4)).collect();
    Exact::from_rationals(n, n, &entries)
}

/// A positive definite form on 2 x 2 matrices without symmetries.
fn planar_tensor() -> Exact {
    quarters(4, &[8, 2, 0, 3, 2, 12, 1, 0, 0, 1, 4, 2, 3, 0, 2, 16])
}

/// A form on 3 x 3 matrices with six couplings.
fn spatial_tensor() -> Exact {
    let mut entries = [0_i64; 81];
    (0..9).for_each(|k| entries[10 * k] = 6 + i64::try_from(k).unwrap());
    for (k, l, value) in [(0, 4, 2), (1, 3, -1), (2, 7, 1), (4, 8, 2), (5, 6, 1), (0, 5, 1)] {
        (entries[9 * k + l], entries[9 * l + k]) = (value, value);
    }
    quarters(9, &entries)
}

affine_tests::drawn! { ROUNDING;
    isochoric_flat_and_casimirs_2: 2 Isochoric isochoric pinned false (kinetic(dalembert = 1 + b^2, casimir2 = a/4))
        |_v| true, |v| vec![Term::dalembert(2, one() + square(&v, "b")), Term::Casimir2(v.value("a") * rational(1, 4))], none;
    isochoric_flat_and_body_3: 3 Isochoric isochoric pinned false
        (kinetic(dalembert = diag(1, 1.5, 2), body_inertia = c^2, casimir2 = a/4))
        |_v| true, |v| vec![
            Term::DAlembert(diagonal(3, &one())), Term::body_inertia(3, square(&v, "c")),
            Term::Casimir2(v.value("a") * rational(1, 4)),
        ] => (tr(G)/2), |place| place.trace_green() * 0.5;
    isochoric_body_and_space_2: 2 Isochoric isochoric moving false
        (kinetic(body_inertia = 1 + b^2, space_inertia = diag(c^2, 3*c^2/2), body_translation = k))
        |_v| true, |v| vec![
            Term::body_inertia(2, one() + square(&v, "b")), Term::SpaceInertia(diagonal(2, &square(&v, "c"))),
            Term::BodyTranslation(v.value("k")),
        ], none;
    isochoric_body_and_space_3: 3 Isochoric isochoric moving true
        (kinetic(body_inertia = diag(1, 1.5, 2), space_inertia = c^2, body_translation = k, space_translation = 0.5))
        |_v| true, |v| vec![
            Term::BodyInertia(diagonal(3, &one())), Term::space_inertia(3, square(&v, "c")),
            Term::BodyTranslation(v.value("k")), Term::SpaceTranslation(rational(1, 2)),
        ] => (x[1]*tr(Ct)/4), |place| place.x(1) * place.trace_green() * 0.25;
    isochoric_space_tensor_2: 2 Isochoric isochoric pinned false
        (kinetic(body_inertia = b^2, space_tensor = [[2, 0.5, 0, 0.75], [0.5, 3, 0.25, 0], [0, 0.25, 1, 0.5], [0.75, 0, 0.5, 4]]))
        |_v| true, |v| vec![Term::body_inertia(2, square(&v, "b")), Term::SpaceTensor(planar_tensor())], none;
    isochoric_flat_tensor_2: 2 Isochoric isochoric pinned false
        (kinetic(dalembert = b^2, flat_tensor = [[2, 0.5, 0, 0.75], [0.5, 3, 0.25, 0], [0, 0.25, 1, 0.5], [0.75, 0, 0.5, 4]]))
        |_v| true, |v| vec![Term::dalembert(2, square(&v, "b")), Term::FlatTensor(planar_tensor())], none;
    isochoric_dalembert_of_two_masses_2: 2 Isochoric isochoric moving false
        (kinetic(dalembert = 1 + b^2, body_translation = k, space_translation = 0.5))
        |_v| true, |v| vec![
            Term::dalembert(2, one() + square(&v, "b")),
            Term::BodyTranslation(v.value("k")), Term::SpaceTranslation(rational(1, 2)),
        ], none;
    rigid_body_and_space_3: 3 Rigid rigid pinned false
        (kinetic(body_inertia = diag(1, 1.5, 2), space_inertia = diag(c^2, 3*c^2/2, 2*c^2)))
        |_v| true, |v| vec![Term::BodyInertia(diagonal(3, &one())), Term::SpaceInertia(diagonal(3, &square(&v, "c")))], none;
    rigid_dalembert_and_space_3: 3 Rigid rigid moving false
        (kinetic(dalembert = diag(1, 1.5, 2), space_inertia = diag(c^2, 3*c^2/2, 2*c^2), space_translation = k))
        |_v| true, |v| vec![
            Term::DAlembert(diagonal(3, &one())), Term::SpaceInertia(diagonal(3, &square(&v, "c"))),
            Term::SpaceTranslation(v.value("k")),
        ] => (phi[3,3]), |place| place.phi(3, 3);
    rigid_body_and_space_2: 2 Rigid rigid moving true
        (kinetic(body_inertia = diag(1, 1.5), space_inertia = diag(c^2, 3*c^2/2), body_translation = k, space_translation = 0.5))
        |_v| true, |v| vec![
            Term::BodyInertia(diagonal(2, &one())), Term::SpaceInertia(diagonal(2, &square(&v, "c"))),
            Term::BodyTranslation(v.value("k")), Term::SpaceTranslation(rational(1, 2)),
        ] => (x[1]*phi[1,2]), |place| place.x(1) * place.phi(1, 2);
    rigid_flat_tensor_3: 3 Rigid rigid pinned false
        (kinetic(flat_tensor = [
            [1.5, 0, 0, 0, 0.5, 0.25, 0, 0, 0], [0, 1.75, 0, -0.25, 0, 0, 0, 0, 0], [0, 0, 2, 0, 0, 0, 0, 0.25, 0],
            [0, -0.25, 0, 2.25, 0, 0, 0, 0, 0], [0.5, 0, 0, 0, 2.5, 0, 0, 0, 0.5], [0.25, 0, 0, 0, 0, 2.75, 0.25, 0, 0],
            [0, 0, 0, 0, 0, 0.25, 3, 0, 0], [0, 0, 0.25, 0, 0, 0, 0, 3.25, 0], [0, 0, 0, 0, 0.5, 0, 0, 0, 3.5]],
         body_inertia = b^2))
        |_v| true, |v| vec![Term::FlatTensor(spatial_tensor()), Term::body_inertia(3, square(&v, "b"))], none;
    rigid_one_frame_3: 3 Rigid rigid moving false
        (kinetic(dalembert = diag(1, 1.5, 2), body_inertia = diag(c^2, 3*c^2/2, 2*c^2), space_inertia = b^2, casimir2 = a/4,
         body_translation = k, space_translation = 0.5))
        |_v| true, |v| vec![
            Term::DAlembert(diagonal(3, &one())), Term::BodyInertia(diagonal(3, &square(&v, "c"))),
            Term::space_inertia(3, square(&v, "b")), Term::Casimir2(v.value("a") * rational(1, 4)),
            Term::BodyTranslation(v.value("k")), Term::SpaceTranslation(rational(1, 2)),
        ], none;
    rigid_space_frame_3: 3 Rigid rigid pinned false
        (kinetic(body_inertia = b^2, space_inertia = diag(1, 1.5, 2)))
        |_v| true, |v| vec![Term::body_inertia(3, square(&v, "b")), Term::SpaceInertia(diagonal(3, &one()))], none;
    conformal_flat_and_casimirs_2: 2 Conformal conformal pinned false (kinetic(dalembert = 1 + b^2, casimir2 = a/4))
        |_v| true, |v| vec![Term::dalembert(2, one() + square(&v, "b")), Term::Casimir2(v.value("a") * rational(1, 4))], none;
    conformal_everything_3: 3 Conformal conformal moving false
        (kinetic(dalembert = diag(1, 1.5, 2), body_inertia = diag(b^2, 3*b^2/2, 2*b^2),
         space_inertia = diag(c^2, 3*c^2/2, 2*c^2), body_translation = k, space_translation = 0.5))
        |_v| true, |v| vec![
            Term::DAlembert(diagonal(3, &one())), Term::BodyInertia(diagonal(3, &square(&v, "b"))),
            Term::SpaceInertia(diagonal(3, &square(&v, "c"))),
            Term::BodyTranslation(v.value("k")), Term::SpaceTranslation(rational(1, 2)),
        ] => (sinh(q)^2 + phi[3,3]), |place| place.q().sinh().power(2) + place.phi(3, 3);
    conformal_scalars_3: 3 Conformal conformal moving false
        (kinetic(body_inertia = 1 + b^2, space_inertia = c^2, casimir1_squared = a/16, body_translation = k))
        |_v| true, |v| vec![
            Term::body_inertia(3, one() + square(&v, "b")), Term::space_inertia(3, square(&v, "c")),
            Term::Casimir1Squared(v.value("a") * rational(1, 16)), Term::BodyTranslation(v.value("k")),
        ], none;
    conformal_tensors_2: 2 Conformal conformal pinned false
        (kinetic(body_inertia = diag(b^2, 1),
         space_tensor = [[2, 0.5, 0, 0.75], [0.5, 3, 0.25, 0], [0, 0.25, 1, 0.5], [0.75, 0, 0.5, 4]],
         flat_tensor = [[2, 0.5, 0, 0.75], [0.5, 3, 0.25, 0], [0, 0.25, 1, 0.5], [0.75, 0, 0.5, 4]]))
        |_v| true, |v| vec![
            Term::BodyInertia(&Exact::unit(2, 0, 0).scaled(&square(&v, "b")) + &Exact::unit(2, 1, 1)),
            Term::SpaceTensor(planar_tensor()), Term::FlatTensor(planar_tensor()),
        ], none;
}

/// `T = 1/2 tr(phi_dot phi_dot^T) - a/2 tr Oh^2` with `det phi = 1`: along `phi = diag(e^s, e^-s)` it is
/// `(cosh 2s - a) s'^2`, which degenerates at `cosh 2s = a`.
#[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = 1, casimir2 = -a))]
struct Pinched {
    a: f64,
}

fn stretched(s: f64) -> Matrix<2> {
    Matrix::<2>::new(s.exp(), 0.0, 0.0, (-s).exp())
}

/// The place is reached after `integral of sqrt((cosh 2s - a)/E) ds`, `s = s* + u^2`, by Simpson's rule.
#[test]
fn a_degenerate_mass_matrix_ends_the_run() {
    let (a, s0, speed) = (1.25_f64, 1.0_f64, -0.8_f64);
    let model = Pinched { a }.prepare().unwrap();
    let shape = Matrix::<2>::new(1.0, 0.0, 0.0, -1.0);
    let start = model.at_velocity(stretched(s0), stretched(s0) * shape * speed).unwrap();
    let energy = ((2.0 * s0).cosh() - a) * speed * speed;
    assert!((model.hamiltonian(0.0, &start) - energy).abs() <= 1e-13 * energy);
    let place = a.acosh() / 2.0;
    let (last, panels) = ((s0 - place).sqrt(), 1000_u32);
    let slope = |u: f64| (((2.0 * (place + u * u)).cosh() - a).max(0.0) / energy).sqrt() * 2.0 * u;
    let h = last / f64::from(panels);
    let panel = |k: u32| {
        let u = h * f64::from(k);
        (slope(u) + 4.0 * slope(u + h / 2.0) + slope(u + h)) * h / 6.0
    };
    let time: f64 = (0..panels).map(panel).sum();
    let halt = Simulation::new(&model, start).until(2.0 * time).tolerance(1e-12).run().unwrap_err();
    let Reason::Degenerate { t, .. } = halt.stop.reason else { panic!("{}", halt.stop) };
    assert!((t - time).abs() <= DEGENERATION * time, "{t} of {time}");
}

/// A start where the mass matrix on the Lie algebra is degenerate is refused.
#[test]
fn a_degenerate_start_is_refused() {
    let model = Pinched { a: 1.0 }.prepare().unwrap();
    let zero = Matrix::<2>::zeros();
    let refused = model.at_momentum(stretched(0.0), Comoving(zero)).unwrap_err();
    assert!(matches!(refused, Error::IllPosed(IllPosed { condition: "det K(phi) != 0", .. })), "{refused}");
    assert!(model.at_velocity(stretched(0.0), zero).is_err());
    let regular = Pinched { a: 0.5 }.prepare().unwrap();
    assert!(regular.at_velocity(stretched(0.0), zero).is_ok());
    assert!(matches!(model.at_velocity(stretched(0.0) * 2.0, zero), Err(Error::OffConstraint { .. })));
}

//! Three routes to the derivative of a motion: the emitted equations, dual numbers through equations and closed forms, and
//! differences of neighbouring motions.

use affine_integrators::Failure;
use affine_runtime::capability::Tangent;
use affine_runtime::dual::Dual;
use affine_runtime::model::StateVector;
use affine_runtime::prelude::*;
use affine_runtime::variation::Variation;
use affine_tests::fields::{Field, Stirring, Wind};

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    emit(tangent)
)]
struct Missile;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
    emit(tangent),
)]
struct Vibrating {
    kappa: f64,
}

#[affine_model(
    dim = 2,
    kinetic(casimir2 = a, body_inertia = i, body_translation = 1),
    potential = cosh(q) + neo_hookean(0.5) + sqrt(1 + tr(G)) + tanh(tr(G)/9) + exp(-tr(G)) + ln(1 + det^2)
        + tan(det/9) + sinh(tr(Ct)/20) + cos(t)*sin(tr(Ct)/5),
    emit(tangent),
)]
struct Driven {
    a: f64,
    i: f64,
}

#[affine_model(dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), potential = hyperbolic_dilatation(10) + neo_hookean(0.5), emit(tangent))]
struct Elastic;

#[affine_model(dim = 2, kinetic(body_inertia = diag(1, 2)), dissipation(body_inertia = 0.3), emit(tangent))]
struct Damped;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), emit(tangent))]
struct Geodesic;

#[affine_model(dim = 2, kinetic(dalembert = 1, body_inertia = 0.5), potential = tr(G)/2 - ln(det), emit(tangent))]
struct Mixed;

fn phi<const N: usize>() -> Matrix<N> {
    Matrix::<N>::from_fn(
        |i, j| if i == j { 1.1 - 0.1 * i as f64 } else { 0.15 * (i as f64 - 0.7 * j as f64) },
    )
}

fn spin<const N: usize>() -> Matrix<N> {
    Matrix::<N>::from_fn(|i, j| 0.4 * ((2 * i + 3 * j) as f64 + 0.3).sin())
}

fn along<V: StateVector<f64>>() -> V {
    let mut direction = V::zeros();
    for (k, component) in direction.as_mut().iter_mut().enumerate() {
        *component = (1.7 * k as f64 + 0.4).cos();
    }
    direction
}

/// The emitted equations are the derivative of the reduced ones, constants included.
fn assert_derivative<const N: usize, M: Tangent<N>>(model: &M, point: &M::Point<f64>) {
    let t = 0.3;
    let mut full = M::Full::<Dual<f64>>::zeros();
    let (values, slopes) = (model.flatten(point), along::<M::Full<f64>>());
    for (both, (value, slope)) in full.as_mut().iter_mut().zip(values.as_ref().iter().zip(slopes.as_ref())) {
        *both = Dual { value: *value, slope: *slope };
    }
    let (reduced, constants) = model.reduce(Dual::fixed(t), &model.unflatten(&full));
    let rates = model.reduced_equations(Dual::fixed(t), &constants, &reduced);
    let mut varied = M::Varied::<f64>::zeros();
    let size = reduced.as_ref().len();
    for (k, both) in reduced.as_ref().iter().enumerate() {
        (varied.as_mut()[k], varied.as_mut()[size + k]) = (both.value, both.slope);
    }
    let found = model.variational_equations(t, &constants, &varied);
    let scale: f64 = rates.as_ref().iter().map(|rate| rate.slope.abs() + rate.value.abs()).sum();
    for (k, both) in rates.as_ref().iter().enumerate() {
        let (value, slope) = (found.as_ref()[k], found.as_ref()[size + k]);
        assert!((value - both.value).abs() < 1e-13 * scale, "{k}: {value} {}", both.value);
        assert!((slope - both.slope).abs() < 1e-13 * scale, "{k}: {slope} {}", both.slope);
    }
    assert!(scale > 0.1 && M::VARIED.iter().map(|group| group.len).sum::<usize>() == 2 * size);
}

/// The change over a time against the difference of two motions, which is exact to the square of the distance.
fn assert_change<const N: usize, M: Tangent<N>>(model: &M, point: M::Point<f64>) {
    let (t_end, distance) = (2.5, 1e-5);
    let direction = along::<M::Full<f64>>();
    let mut variation = Variation::new(model, (0.0, &point), &direction, 1e-13).unwrap();
    variation.advance_to(1.0).unwrap();
    variation.advance_to(t_end).unwrap();
    let end = |sign: f64| {
        let mut full = model.flatten(&point);
        full.as_mut().iter_mut().zip(direction.as_ref()).for_each(|(v, d)| *v += sign * distance * d);
        let start = model.unflatten(&full);
        let run = Simulation::new(model, start).until(t_end).method(Method::RungeKutta8).tolerance(1e-14);
        model.flatten(run.output([t_end]).run().unwrap().end().1)
    };
    let (there, back) = (end(1.0), end(-1.0));
    let change = variation.change();
    let scale: f64 = change.as_ref().iter().map(|v| v.abs()).sum();
    for (k, change) in change.as_ref().iter().enumerate() {
        let difference = (there.as_ref()[k] - back.as_ref()[k]) / (2.0 * distance);
        assert!((change - difference).abs() < 2e-8 * scale, "{k}: {change} {difference}");
    }
    let middle = model.flatten(&variation.point());
    for (k, middle) in middle.as_ref().iter().enumerate() {
        let mean = 0.5 * (there.as_ref()[k] + back.as_ref()[k]);
        assert!((middle - mean).abs() < 1e-7 * (1.0 + mean.abs()), "{k}: {middle} {mean}");
    }
    let length = |v: &M::Full<f64>| v.as_ref().iter().map(|v| v * v).sum::<f64>().sqrt();
    let exponent = (length(&change) / length(&direction)).ln() / t_end;
    assert!((variation.exponent() - exponent).abs() < 1e-12);
}

macro_rules! check {
    ($model:expr, $point:expr) => {{
        let (model, point) = ($model, $point);
        assert_derivative(&model, &point);
        assert_change(&model, point);
    }};
}

#[test]
fn emitted_equations_are_derivatives_and_changes_are_differences() {
    let (x3, p3) = (Vector::<3>::new(0.1, 0.5, -0.2), Vector::<3>::new(0.3, -0.2, 0.5));
    let (x2, p2) = (Vector::<2>::new(0.1, 0.5), Vector::<2>::new(0.3, -0.2));
    check!(Missile, Missile.at_momentum(x3, phi(), p3, Comoving(spin())).unwrap());
    let vibrating = Vibrating { kappa: 10.0 }.prepare().unwrap();
    let start = vibrating.at_momentum(phi(), Comoving(spin())).unwrap();
    check!(vibrating, start);
    let driven = Driven { a: 0.2, i: 1.0 }.prepare().unwrap();
    let start = driven.at_momentum(x2, phi(), p2, Comoving(spin())).unwrap();
    check!(driven, start);
    check!(Elastic, Elastic.at_momentum(phi(), TwoPoint(spin())).unwrap());
    check!(Damped, Damped.at_momentum(phi(), Comoving(spin())).unwrap());
    check!(Geodesic, Geodesic.at_momentum(phi(), Comoving(spin())).unwrap());
    check!(Mixed, Mixed.at_momentum(phi(), TwoPoint(spin())).unwrap());
}

/// Fields, whose types compute over dual numbers too.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, space_translation = 2),
    potential = tr(G)/2 - ln(det) + custom(field, general, position),
    forces = custom(stirring, spatial) + custom(wind, translation),
    emit(tangent),
)]
struct Stirred {
    field: Field,
    stirring: Stirring,
    wind: Wind,
}

#[test]
fn fields_are_differentiated() {
    let (field, stirring) = (Field { strength: 0.2 }, Stirring { strength: 0.3 });
    let model = Stirred { field, stirring, wind: Wind { strength: 0.4 } }.prepare().unwrap();
    let (x, p) = (Vector::<3>::new(0.1, 0.5, -0.2), Vector::<3>::new(0.3, -0.2, 0.5));
    let start = model.at_momentum(x, phi(), p, Comoving(spin())).unwrap();
    check!(model, start);
}

/// Potentials of single stretches, which are found by an iteration: dual numbers go through it.
#[affine_model(dim = 3, kinetic(dalembert = 1), potential = exp(q1) + exp(q2) + exp(q3) - q1 - q2 - q3 + pairs(cosh(d)), emit(tangent))]
struct Stretched;
#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = i), potential = pairs(cosh(2*d)) + 4*q^2, emit(tangent))]
struct Paired {
    i: f64,
}

#[test]
fn stretches_are_differentiated() {
    check!(Stretched, Stretched.at_momentum(phi(), TwoPoint(spin())).unwrap());
    let paired = Paired { i: 1.0 }.prepare().unwrap();
    let start = paired.at_momentum(phi(), Comoving(spin())).unwrap();
    check!(paired, start);
    // Where all of them coincide, no axes are determined.
    check!(Stretched, Stretched.at_momentum(Matrix::<3>::identity() * 1.2, TwoPoint(spin())).unwrap());
}

#[affine_model(
    dim = 3,
    constraint = rigid,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = 2*phi[3,3] + phi[3,1]/2,
    emit(tangent)
)]
struct Top;

#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = tr(G)/2 + G[1,1]^2/4,
    emit(tangent)
)]
struct Incompressible;

/// Along curves on the group, `phi exp(s X)`, changes are differences, and stay tangent to it.
#[test]
fn on_groups() {
    fn assert_on_group<M: Tangent<3>>(
        model: &M,
        along: impl Fn(f64) -> M::Point<f64>,
        defect: impl Fn(&Matrix<3>, &Matrix<3>) -> f64,
    ) {
        let (t_end, distance) = (2.5, 1e-5);
        let slope = |by: &dyn Fn(f64) -> M::Full<f64>| {
            let (there, back) = (by(distance), by(-distance));
            let mut slope = M::Full::<f64>::zeros();
            for (k, slope) in slope.as_mut().iter_mut().enumerate() {
                *slope = (there.as_ref()[k] - back.as_ref()[k]) / (2.0 * distance);
            }
            slope
        };
        let direction = slope(&|s| model.flatten(&along(s)));
        let mut variation = Variation::new(model, (0.0, &along(0.0)), &direction, 1e-13).unwrap();
        variation.advance_to(t_end).unwrap();
        let change = variation.change();
        let expected = slope(&|s| {
            let run = Simulation::new(model, along(s)).until(t_end).tolerance(1e-14).output([t_end]);
            model.flatten(run.run().unwrap().end().1)
        });
        let scale: f64 = expected.as_ref().iter().map(|v| v.abs()).sum();
        for (k, (change, expected)) in change.as_ref().iter().zip(expected.as_ref()).enumerate() {
            assert!((change - expected).abs() < 2e-8 * scale, "{k}: {change} {expected}");
        }
        let by = Matrix::<3>::from_row_slice(&change.as_ref()[..9]);
        let defect = defect(variation.point().phi(), &by);
        assert!(defect.abs() < 1e-9 * scale, "{defect:e}");
    }
    let x = Matrix::<3>::new(0.2, 0.5, -0.3, 0.1, -0.5, 0.7, 0.4, -0.2, 0.3);
    let skew = |m: Matrix<3>| m - m.transpose();
    let rotation = affine_runtime::decompose::Polar::of(&phi::<3>()).unwrap().rotation;
    let turned = |s: f64| {
        let phi = rotation * (skew(x) * s).skew_exponential();
        Top.at_momentum(phi, Comoving(skew(spin::<3>()) + skew(x * x) * s)).unwrap()
    };
    assert_on_group(&Top, turned, |phi, by| (phi.tr_mul(by) + by.tr_mul(phi)).norm());
    let unit = phi::<3>() / phi::<3>().determinant().cbrt();
    let traceless = |m: Matrix<3>| m - Matrix::<3>::identity() * (m.trace() / 3.0);
    let sheared = |s: f64| {
        let phi = unit * (x * s).exponential();
        Incompressible.at_momentum(phi, Comoving(traceless(spin()) + traceless(x * x) * s)).unwrap()
    };
    assert_on_group(&Incompressible, sheared, |phi, by| (phi.try_inverse().unwrap() * by).trace());
}

/// A d'Alembert body in a quadratic potential: `phi'' = -k phi`, whose flow is linear: changes move like points.
#[test]
fn a_linear_motion_moves_its_changes_like_points() {
    #[affine_model(dim = 2, kinetic(dalembert = 2), potential = 3*tr(G), emit(tangent))]
    struct Springs;

    let start = Springs.at_momentum(phi(), TwoPoint(spin())).unwrap();
    let direction = along::<[f64; 8]>();
    let mut variation = Variation::new(&Springs, (0.0, &start), &direction, 1e-14).unwrap();
    // The determinant passes zero on the way; the equations know nothing of it.
    variation.advance_to(1.3).unwrap();
    let rate = 3.0_f64.sqrt();
    let (sin, cos) = (rate * 1.3).sin_cos();
    let change = variation.change();
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let (a, b) = (2 * i + j, 4 + 2 * j + i);
        let expected = cos * direction[a] + sin / (2.0 * rate) * direction[b];
        assert!((change[a] - expected).abs() < 1e-11, "{change:?}");
    }
}

/// The derivative of `phi0 exp(t X) exp(t W)`.
#[test]
fn closed_form_geodesics() {
    let start = Geodesic.at_momentum(phi(), Comoving(spin())).unwrap();
    let direction = along::<[f64; 8]>();
    let mut variation = Variation::new(&Geodesic, (0.0, &start), &direction, 1e-14).unwrap();
    variation.advance_to(2.0).unwrap();
    let end = |sign: f64, distance: f64| {
        let mut full = Geodesic.flatten(&start);
        full.iter_mut().zip(direction).for_each(|(v, d)| *v += sign * distance * d);
        let moved = Geodesic.unflatten(&full);
        let geodesic = Geodesic.geodesic(0.0, &moved).unwrap();
        Geodesic.flatten(&Geodesic.on_geodesic(&geodesic, 2.0, &moved))
    };
    // Richardson's extrapolation of central differences of the closed form: an error of order distance^4.
    let difference =
        |k: usize, distance: f64| (end(1.0, distance)[k] - end(-1.0, distance)[k]) / (2.0 * distance);
    for (k, change) in variation.change().iter().enumerate() {
        let expected = (4.0 * difference(k, 1e-3) - difference(k, 2e-3)) / 3.0;
        assert!((change - expected).abs() < 1e-10 * (1.0 + expected.abs()), "{k}: {change} {expected}");
    }
}

/// Where space is turned along a vanishing linear momentum there is no derivative.
#[test]
fn a_momentum_at_rest_has_no_direction() {
    let start =
        Missile.at_momentum(Vector::<3>::zeros(), phi(), Vector::<3>::zeros(), Comoving(spin())).unwrap();
    let mut variation = Variation::new(&Missile, (0.0, &start), &along(), 1e-10);
    assert_eq!(variation.as_mut().map(|v| v.t()).map_err(|failure| *failure), Err(Failure::NotFinite));
    // Along a direction that leaves p at rest there is one.
    let mut direction = [0.0; 24];
    direction[3] = 1.0;
    let mut variation = Variation::new(&Missile, (0.0, &start), &direction, 1e-10).unwrap();
    variation.advance_to(1.0).unwrap();
    assert!(variation.change().iter().all(|v| v.is_finite()) && variation.t() == 1.0);
    let refused = variation.advance_to(f64::NAN);
    assert!(matches!(refused, Err(Failure::Time { given }) if given.is_nan()), "{refused:?}");
}

/// No step meets a tolerance that is not positive.
#[test]
fn bad_tolerances_are_refused() {
    let start = Geodesic.at_momentum(phi(), Comoving(spin())).unwrap();
    for tolerance in [0.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let refused = Variation::new(&Geodesic, (0.0, &start), &along(), tolerance).map(|v| v.t());
        let Some(Failure::Tolerance { given }) = refused.err() else { panic!("{tolerance}") };
        assert_eq!(given.to_bits(), tolerance.to_bits());
    }
}

/// `x'' = -(x - 1) - 3 x'`: changes decay to any length beside the change of the work, which tends to a constant.
#[test]
fn decay_has_its_exponent() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1),
        potential = ((phi[1,1] - 1)^2 + phi[1,2]^2 + phi[2,1]^2 + (phi[2,2] - 1)^2)/2,
        dissipation(dalembert = 3),
        emit(tangent)
    )]
    struct Held;
    let start = Held.at_velocity(Matrix::<2>::new(1.1, 0.1, -0.2, 0.9), Matrix::<2>::zeros()).unwrap();
    let mut direction = [0.0; 8];
    direction[0] = 1.0;
    let mut variation = Variation::new(&Held, (0.0, &start), &direction, 1e-9).unwrap();
    variation.advance_to(300.0).unwrap();
    let root = 5.0_f64.sqrt();
    let (slow, fast) = ((-3.0 + root) / 2.0, (-3.0 - root) / 2.0);
    let known = (fast * (slow * 300.0).exp() - slow * (fast * 300.0).exp()) / (fast - slow);
    let found = variation.change()[0];
    assert!((found / known - 1.0).abs() < 1e-4, "{found:e} {known:e}");
    assert!((variation.exponent() - slow).abs() < 1e-3, "{}", variation.exponent());
}

//! Between which turning points a potential of the dilatation keeps it: poles, ends of domains, constants, humps.

use std::f64::consts::FRAC_PI_2;

use affine_oracle::Random;
use affine_runtime::frames::Matrix;
use affine_runtime::lattice::{Dilatation, Growth, MotionClass, TwoPolarForm};
use affine_runtime::prelude::*;

use crate::models::SpatiallyAffine3;

/// `1/m = 1/(n alpha)` of the models here.
const INVERSE_MASS: f64 = 1.0 / 2.4;
/// Turning points, relative to the size of `q`, but for the steepness of the potential.
const TURNING: f64 = 1e-12;

macro_rules! models {
    ($($name:ident = $potential:expr;)*) => { $(
        #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = $potential, emit(two_polar))]
        struct $name {
            k: f64,
        }
    )* };
}

models! {
    Parabola = k*q^2;
    Constant = k;
    Pole = exp(q) + k/q^2;
    Poles = k/(1 - q^2);
    Tangent = k*tan(q)^2;
    Logarithm = q - k*ln(q);
    Root = q - 2*k*sqrt(q);
    Attraction = q^2 - k/q^2;
    Hills = k*(q^2 - 1)^2;
    Bump = q^2 + k*exp(-1e6*(q - 1)^2);
    Gas = k*det^(-1);
    Volume = k*(det - 1)^2;
    Dissociation = dissociation(k);
}

/// Waves, a hump and a hole in a well.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = 0.01*q^4 + a*sin(3*q) + b*cos(7*q) + c*exp(-200*(q - h)^2) - e/(1 + 50*(q - f)^2) + g*tanh(q),
    emit(two_polar)
)]
struct Drawn {
    a: f64,
    b: f64,
    c: f64,
    h: f64,
    e: f64,
    f: f64,
    g: f64,
}

/// A mass that is negative, and a potential that is so too.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = -1, body_inertia = 1),
    potential = -1*q^2,
    emit(two_polar)
)]
struct Upside;

/// The class of a motion at `q` with `p_dil`, and a shear that turns.
macro_rules! class {
    ($model:expr, $q:expr, $p:expr) => {{
        let (model, q, p) = (&$model, f64::from($q), f64::from($p));
        let phi = Matrix::from_diagonal_element(q.exp());
        let spin = Matrix::<2>::new(0.5 * p, 0.9, -0.9, 0.5 * p);
        MotionClass::of(model, &model.at_momentum(phi, Comoving(spin)).unwrap())
    }};
}

macro_rules! dilatation {
    ($model:expr, $q:expr, $p:expr) => {
        class!($model, $q, $p).map(|class| class.dilatation)
    };
}

/// The place between two others where a potential has the energy of the motion.
fn turning(potential: impl Fn(f64) -> f64, (q, p): (f64, f64), (mut inside, mut outside): (f64, f64)) -> f64 {
    let margin = |at: f64| 0.5 * p * p * INVERSE_MASS + potential(q) - potential(at);
    assert!(margin(inside) > 0.0 && margin(outside) < 0.0);
    for _ in 0..200 {
        let middle = 0.5 * (inside + outside);
        *(if margin(middle) > 0.0 { &mut inside } else { &mut outside }) = middle;
    }
    inside
}

/// The motion turns between each of two pairs of places, where the energy says.
fn assert_confined(
    found: Option<Dilatation>,
    potential: impl Fn(f64) -> f64,
    start: (f64, f64),
    [lower, upper]: [(f64, f64); 2],
) {
    let Some(Dilatation::Confined { from, to }) = found else { panic!("{start:?}: {found:?}") };
    for (found, within) in [(from, lower), (to, upper)] {
        let expected = turning(&potential, start, within);
        assert!(
            (found - expected).abs() <= TURNING * (1.0 + expected.abs()),
            "{start:?}: {found} is not {expected}"
        );
    }
}

/// However high the barrier is, and however narrow where a motion meets it.
#[test]
fn poles_confine() {
    for (k, p) in
        [(1e-3, 0.3), (1e-3, 1.0), (1e-3, 2.0), (1e-3, 4.0), (1e-3, 8.0), (1e-3, 50.0), (1e-12, 8.0)]
    {
        let model = Pole { k }.prepare().unwrap();
        let potential = |q: f64| q.exp() + k / (q * q);
        assert_confined(dilatation!(model, 0.7, p), potential, (0.7, p), [(0.7, 1e-9), (0.7, 20.0)]);
    }
    let poles = Poles { k: 1.0 }.prepare().unwrap();
    let tangent = Tangent { k: 0.1 }.prepare().unwrap();
    for p in [0.1, 1.0, 5.0, 300.0] {
        let found = dilatation!(poles, 0.1, p);
        assert_confined(found, |q| 1.0 / (1.0 - q * q), (0.1, p), [(0.1, -1.0 + 1e-12), (0.1, 1.0 - 1e-12)]);
        let found = dilatation!(tangent, 0.1, p);
        assert_confined(found, |q| 0.1 * q.tan().powi(2), (0.1, p), [(0.1, -FRAC_PI_2), (0.1, FRAC_PI_2)]);
    }
}

#[test]
fn logarithms_confine() {
    let model = Logarithm { k: 1.0 }.prepare().unwrap();
    for p in [0.1, 1.0, 3.0, 6.0] {
        let found = dilatation!(model, 0.7, p);
        assert_confined(found, |q| q - q.ln(), (0.7, p), [(0.7, 1e-12), (0.7, 60.0)]);
    }
}

/// Where the energy is finite at the end of the domain, or falls without bounds, there is no verdict.
#[test]
fn ends_of_domains_are_no_turning_points() {
    let model = Root { k: 1.0 }.prepare().unwrap();
    let found = dilatation!(model, 0.7, 0.1);
    assert_confined(found, |q| q - 2.0 * q.sqrt(), (0.7, 0.1), [(0.7, 0.0), (0.7, 20.0)]);
    assert_eq!(class!(model, 0.7, 3.0), None);
    assert_eq!(class!(Attraction { k: 0.1 }.prepare().unwrap(), 0.7, 0.1), None);
}

/// A potential that does not depend on `q` leaves the motion as it is without one.
#[test]
fn constant_potentials_confine_nothing() {
    for p in [0.1, 1e-5, 1e-200] {
        for found in [
            dilatation!(Parabola { k: 0.0 }.prepare().unwrap(), 0.3, p),
            dilatation!(Constant { k: 2.0 }.prepare().unwrap(), 0.3, p),
        ] {
            // Beside the shear this momentum is rounding.
            if p < 1e-100 {
                assert_eq!(found, Some(Dilatation::Still));
                continue;
            }
            let Some(Dilatation::Uniform { rate }) = found else { panic!("{found:?}") };
            assert!((rate / (p * INVERSE_MASS) - 1.0).abs() < 1e-10, "{rate}");
        }
    }
    let still = class!(Parabola { k: 0.0 }.prepare().unwrap(), 0.3, 0.0).unwrap();
    assert!(still.dilatation == Dilatation::Still && still.is_bounded());
    assert_eq!(dilatation!(Constant { k: 2.0 }.prepare().unwrap(), 0.3, 0.0), Some(Dilatation::Still));
}

/// At rest in a well, on a hump, and on a slope.
#[test]
fn rest_is_told_from_motion() {
    for k in [1.0, 1e-300] {
        assert_eq!(dilatation!(Parabola { k }.prepare().unwrap(), 0.0, 0.0), Some(Dilatation::Still));
    }
    let hump = Parabola { k: -1.0 }.prepare().unwrap();
    assert_eq!(dilatation!(hump, 0.0, 0.0), None);
    assert_eq!(dilatation!(hump, 0.0, 0.1), Some(Dilatation::Free));
    let well = Parabola { k: 1.0 }.prepare().unwrap();
    for q in [0.4, -0.4] {
        let Some(Dilatation::Confined { from, to }) = dilatation!(well, q, 0.0) else { panic!() };
        assert!((from + 0.4).abs() < TURNING && (to - 0.4).abs() < TURNING, "{from}, {to}");
    }
    let gas = Gas { k: 1.0 }.prepare().unwrap();
    assert_eq!(dilatation!(gas, 0.4, 0.0), Some(Dilatation::Free));
}

/// In one of two wells, over the hump between them, and with its energy.
#[test]
fn humps_divide() {
    let model = Hills { k: 1.0 }.prepare().unwrap();
    let potential = |q: f64| (q * q - 1.0).powi(2);
    let threshold = (2.0 / INVERSE_MASS).sqrt();
    for part in [0.1, 0.9, 1.0 - 1e-4] {
        let start = (1.0, part * threshold);
        let found = dilatation!(model, 1.0, start.1);
        assert_confined(found, potential, start, [(1.0, 0.0), (1.0, 3.0)]);
    }
    for part in [1.0 + 1e-4, 1.1, 5.0] {
        let start = (1.0, part * threshold);
        let found = dilatation!(model, 1.0, start.1);
        assert_confined(found, potential, start, [(-1.0, -5.0), (1.0, 5.0)]);
    }
    assert_eq!(class!(model, 1.0, threshold), None);
    for (part, low, high) in [(1.0 - 1e-9, 0.0, 1.0), (1.0 + 1e-9, -2.0, -1.0)] {
        let found = dilatation!(model, 1.0, part * threshold);
        let Some(Dilatation::Confined { from, .. }) = found else { panic!("{found:?}") };
        assert!(low < from && from < high, "{part}: {found:?}");
    }
    let model = Bump { k: 8.0 }.prepare().unwrap();
    let potential = |q: f64| q * q + 8.0 * (-1e6 * (q - 1.0) * (q - 1.0)).exp();
    let found = dilatation!(model, 0.0, 3.0);
    assert_confined(found, potential, (0.0, 3.0), [(0.0, -3.0), (0.0, 1.0)]);
    // The threshold of a well that is open on both sides.
    let model = Dissociation { k: 2.0 }.prepare().unwrap();
    assert_eq!(class!(model, 0.0, threshold), None);
    assert_eq!(dilatation!(model, 0.0, 1.001 * threshold), Some(Dilatation::Free));
}

/// The first places on both sides where the energy is used up, found by small steps.
#[test]
fn drawn_potentials_confine_where_a_fine_search_says() {
    let mut random = Random::new(230);
    let mut number = |size: f64| size * random.integer(-9973, 9973) as f64 / 9973.0;
    for _ in 0..100 {
        let [a, b, c, h, e, f, g] = [1.0, 0.5, 3.0, 2.0, 2.0, 2.0, 1.0].map(&mut number);
        let (q, p) = (number(2.0), number(4.0));
        let model = Drawn { a, b, c, h, e, f, g }.prepare().unwrap();
        let potential = |q: f64| {
            let waves = 0.01 * q.powi(4) + a * (3.0 * q).sin() + b * (7.0 * q).cos() + g * q.tanh();
            waves + c * (-200.0 * (q - h).powi(2)).exp() - e / (1.0 + 50.0 * (q - f).powi(2))
        };
        // The model's own place, to its rounding.
        let margin = |at: f64| 0.5 * p * p * INVERSE_MASS + potential(q) - potential(at);
        let [lower, upper] = [-1e-4, 1e-4].map(|step| {
            let at = |k: u32| q + step * f64::from(k);
            let beyond = (1..).find(|k| margin(at(*k)) < 0.0).unwrap();
            (at(beyond - 1), at(beyond))
        });
        let Some(Dilatation::Confined { from, to }) = dilatation!(model, q, p) else { panic!("{a} {q} {p}") };
        for (found, within) in [(from, lower), (to, upper)] {
            let expected = turning(potential, (q, p), within);
            assert!((found - expected).abs() <= 1e-9, "{q}, {p}: {found} is not {expected}");
        }
    }
}

/// What is far from the undeformed state decides.
#[test]
fn expansions_are_not_bounded() {
    let model = Gas { k: 1.0 }.prepare().unwrap();
    for p in [0.1, 2.0, -2.0] {
        let class = class!(model, 0.1, p).unwrap();
        assert_eq!(class.dilatation, Dilatation::Free);
        assert!(!class.is_bounded());
    }
    for q in [-250.0, 250.0] {
        assert_eq!(dilatation!(model, q, 1.0), Some(Dilatation::Free));
    }
    // p^2/(2m) is more than the height at det = 0, or less.
    let model = Volume { k: 1.0 }.prepare().unwrap();
    assert_eq!(dilatation!(model, 0.0, 5.0), Some(Dilatation::Free));
    let found = dilatation!(model, 0.0, 2.0);
    assert_confined(found, |q| (2.0 * q).exp_m1().powi(2), (0.0, 2.0), [(0.0, -10.0), (0.0, 10.0)]);
}

#[test]
fn negative_masses_turn_where_the_potential_is_low() {
    let Some(Dilatation::Confined { from, to }) = dilatation!(Upside, 0.0, 0.5) else { panic!() };
    // 1/m = 1/(2 alpha) + 1/beta = 1/(n (I + A + n B)), -q^2 = p^2/(2m).
    let turning = (0.125_f64 / (2.0 * 0.8)).sqrt();
    assert!((from + turning).abs() < TURNING && (to - turning).abs() < TURNING, "{from}, {to}, {turning}");
}

/// A motion that is faster or slower, and points that are none.
#[test]
fn classes_do_not_depend_on_the_scale() {
    fn assert_scaled<M: TwoPolarForm<3>>(model: &M, at: impl Fn(f64) -> M::Point<f64>) {
        let class = |scale: f64| MotionClass::of(model, &at(scale)).unwrap();
        let one = class(1.0);
        for scale in [1e-200, 1e-120, 1e-10, 1e150] {
            let scaled = class(scale);
            let rates = |class: &MotionClass| match class.shear {
                Growth::Escaping { rate } => rate,
                Growth::Bounded { period } => period.unwrap().recip(),
                Growth::Marginal => 1.0,
            };
            assert_eq!(
                std::mem::discriminant(&scaled.shear),
                std::mem::discriminant(&one.shear),
                "{scale:e}"
            );
            let expected = if one.shear == Growth::Marginal { 1.0 } else { scale * rates(&one) };
            assert!((rates(&scaled) / expected - 1.0).abs() < 1e-13, "{scale:e}: {scaled:?}");
            assert!((scaled.whirl / (scale * one.whirl) - 1.0).abs() < 1e-13, "{scale:e}: {scaled:?}");
            assert_eq!(scaled.dilatation, one.dilatation, "{scale:e}");
        }
        assert_eq!(MotionClass::of(model, &at(f64::NAN)), None);
    }
    let at = |spin: Matrix<3>| {
        move |scale: f64| {
            let point = SpatiallyAffine3.at_momentum(Matrix::identity(), Comoving(spin)).unwrap();
            point.moved(Vector::zeros(), *point.phi(), |_| spin * scale)
        }
    };
    let escaping = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let turning = Matrix::<3>::new(0.0, 0.5, 0.1, -0.5, 0.0, 0.2, -0.1, -0.2, 0.0);
    let nilpotent = Matrix::<3>::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0);
    [escaping, turning, nilpotent].into_iter().for_each(|spin| assert_scaled(&SpatiallyAffine3, at(spin)));
}

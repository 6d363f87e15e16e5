//! Emitted recurrences against the reduced equations of the same model over truncated power series.

use affine_runtime::capability::Taylor;
use affine_runtime::model::{Model, StateVector};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Real;

use affine_tests::jet::{Jet, LENGTH};

/// Two routes of some hundred roundings each, relative to the largest coefficient of the order.
const TOLERANCE: f64 = 1e-12;

/// The time that series are about, which potentials of time read.
const BEGINNING: f64 = 0.3;

/// A point with no special entries and a dominant diagonal of the placement.
fn sample<const N: usize, M: Model<N>, T: Real>(model: &M) -> M::Point<T> {
    let mut full = M::Full::<T>::zeros();
    for (k, value) in full.as_mut().iter_mut().enumerate() {
        *value = T::from_f64(0.05 + 0.04 * ((k * k + 3 * k) % 11) as f64);
    }
    let skip = usize::from(M::DESCRIPTION.full[0].name() == "x") * N;
    (0..N).for_each(|k| full.as_mut()[skip + k * (N + 1)] = T::from_f64(1.1 + 0.1 * k as f64));
    model.unflatten(&full)
}

/// Order by order: the coefficients so far, as a polynomial in `t`, give the next one.
fn by_series<const N: usize, M: Model<N>>(model: &M) -> Vec<Vec<f64>> {
    let mut time = Jet::fixed(BEGINNING);
    let (mut series, constants) = model.reduce(time, &sample(model));
    time.0[1] = 1.0;
    for k in 1..LENGTH {
        let rate = model.reduced_equations(time, &constants, &series);
        for (series, rate) in series.as_mut().iter_mut().zip(rate.as_ref()) {
            series.0[k] = rate.0[k - 1] / k as f64;
        }
    }
    (0..LENGTH).map(|k| series.as_ref().iter().map(|jet| jet.0[k]).collect()).collect()
}

fn by_recurrence<const N: usize, M: Taylor<N>, T: Real>(model: &M, unit: f64) -> Vec<Vec<f64>> {
    let (state, constants) = model.reduce(T::from_f64(BEGINNING), &sample(model));
    let mut coefficients = vec![state; LENGTH];
    // Rows from another computation do no harm.
    let mut rows = vec![M::Row::<T>::zeros(); LENGTH - 1];
    rows.iter_mut().for_each(|row| row.as_mut().fill(T::from_f64(7.0)));
    model.coefficients((T::from_f64(BEGINNING), T::from_f64(unit)), &constants, &mut coefficients, &mut rows);
    coefficients.iter().map(|c| c.as_ref().iter().map(|v| v.to_f64()).collect()).collect()
}

fn assert_agree<const N: usize, M: Taylor<N>>(model: &M) {
    let (expected, found) = (by_series(model), by_recurrence::<N, M, f64>(model, 1.0));
    // Any scalar: this one does not go through vectors of doubles.
    let counted = by_recurrence::<N, M, affine_runtime::counting::Counting>(model, 1.0);
    assert_eq!(found, counted, "{}: vectors of doubles round otherwise", M::DESCRIPTION.name);
    // A power of two for a unit of time changes no digit.
    let in_eighths = by_recurrence::<N, M, f64>(model, 0.125);
    for (k, (eighths, found)) in in_eighths.iter().zip(&found).enumerate() {
        let scaled: Vec<f64> = found.iter().map(|c| c * 0.125_f64.powi(k as i32)).collect();
        assert_eq!(*eighths, scaled, "{}: order {k}", M::DESCRIPTION.name);
    }
    for (k, expected) in expected.iter().enumerate() {
        let size = expected.iter().fold(0.0f64, |size, c| size.max(c.abs()));
        assert!(size > 0.0 || k > 1, "{}: nothing moves", M::DESCRIPTION.name);
        for (component, (found, expected)) in found[k].iter().zip(expected).enumerate() {
            let error = (found - expected).abs();
            // Written so that NaN fails.
            assert!(
                error <= TOLERANCE * size,
                "{}: order {k}, component {component}: {found:e} {expected:e}",
                M::DESCRIPTION.name
            );
        }
    }
}

macro_rules! models {
    ($($name:ident $n:literal ($($spec:tt)*);)*) => {
        $(
            #[affine_model(dim = $n, $($spec)*, emit(taylor))]
            struct $name;
        )*

        #[test]
        fn recurrences_give_the_series_of_the_reduced_equations() {
            $(assert_agree::<$n, _>(&$name);)*
        }
    };
}

// Every kind of kinetic energy, and every function of the language with what its derivative brings along.
models! {
    Missile 3 (kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1));
    Left 3 (kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1));
    Right 2 (kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, body_translation = 2));
    AffineMissile 3 (kinetic(casimir2 = 0.2, body_translation = 2));
    Straight 2 (kinetic(dalembert = 3));
    Anisotropic 3 (kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = diag(1, 1.5, 2)));
    Tensor 2 (kinetic(casimir2 = 0.2,
        space_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]]));
    Vibrating 3 (kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5));
    VibratingMissile 3 (
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5));
    Vibrating2 2 (kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5));
    Elastic 3 (kinetic(dalembert = diag(1, 1.5, 2)), potential = hyperbolic_dilatation(10) + neo_hookean(0.5));
    Driven 2 (kinetic(dalembert = 1), potential = cos(2*t)*tr(G) + t^2*phi[1,2]);
    Swept 3 (kinetic(casimir2 = 0.2, body_inertia = 1), dissipation(body_inertia = 0.1),
        potential = (1 + sin(2*t)/2)*(tr(G)/2 - ln(det)) + exp(t/3)*G[1,2]/t);
    Exponential 2 (kinetic(dalembert = 1), potential = exp(tr(G)/4));
    Logarithm 2 (kinetic(dalembert = 1), potential = ln(tr(G)) + q^2);
    Root 2 (kinetic(dalembert = 1), potential = sqrt(tr(G) + 1));
    Sine 2 (kinetic(dalembert = 1), potential = sin(tr(G)));
    Cosine 2 (kinetic(dalembert = 1), potential = cos(phi[1,2]) + sin(det)*cos(det));
    Tangent 2 (kinetic(dalembert = 1), potential = tan(det/3));
    HyperbolicSine 2 (kinetic(dalembert = 1), potential = sinh(tr(G)/2));
    HyperbolicCosine 2 (kinetic(dalembert = 1), potential = cosh(phi[1,1] - phi[2,1]));
    HyperbolicTangent 2 (kinetic(dalembert = 1), potential = tanh(det - 2) + tanh(det));
    Quotient 2 (kinetic(dalembert = 1, space_translation = 2), potential = tr(G)/(1 + det^2) - 1/(x[1]^2 + 1) + x[2]);
    Together 3 (kinetic(casimir2 = 0.2, space_inertia = 1, space_translation = 2),
        potential = exp(-q^2)*sin(x[1]) + ln(1 + x[2]^2)/tr(Ct) + sqrt(1 + x[3]^2)*tanh(q));
}

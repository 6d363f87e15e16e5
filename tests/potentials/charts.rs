//! Sums in powers, the second invariant and isochoric traces in every chart: forces against differences of the energy as it is
//! written here, and runs against their own energy.

use affine_runtime::prelude::*;

/// A difference of order 4, whose error is that of rounding over the step, or of the fifth derivative.
const STEP: f64 = 1e-4;
const NEAR: f64 = 1e-10;

/// A strained placement.
fn strained<const N: usize>() -> Matrix<N> {
    let strain = [[0.13, -0.08, 0.05], [0.11, -0.09, 0.07], [-0.04, 0.12, 0.06]];
    Matrix::<N>::from_fn(|i, a| f64::from(u8::from(i == a)) + strain[i][a])
}

/// `dU/dphi`, by differences of order 4.
fn slopes<const N: usize>(energy: &dyn Fn(&Matrix<N>) -> f64, phi: &Matrix<N>) -> Matrix<N> {
    Matrix::<N>::from_fn(|i, a| {
        let at = |way: f64| {
            let mut moved = *phi;
            moved[(i, a)] += way;
            energy(&moved)
        };
        (8.0 * (at(STEP) - at(-STEP)) - (at(2.0 * STEP) - at(-2.0 * STEP))) / (12.0 * STEP)
    })
}

/// The rates at rest of the momentum of a chart, and the energy along a run.
fn check<const N: usize, M: Model<N>>(
    (label, model): (&str, &M),
    start: &M::Point<f64>,
    energy: &dyn Fn(&Matrix<N>) -> f64,
) {
    let phi = *start.phi();
    let slopes = slopes(energy, &phi);
    let rates = model.hamilton_equations(0.0, &model.flatten(start));
    let (mut at, mut seen) = (0, 0);
    for group in M::DESCRIPTION.full {
        let (name, len) = (&group.name(), &group.len);
        let expected = match *name {
            "Pi" => Some(-slopes.transpose()),
            "Sigma_hat" => Some(-slopes.transpose() * phi),
            "Sigma" => Some(-phi * slopes.transpose()),
            _ => None,
        };
        if let Some(expected) = expected {
            seen += 1;
            let found = Matrix::<N>::from_row_slice(&rates.as_ref()[at..at + len]);
            let error = (found - expected).norm() / expected.norm();
            assert!(error < NEAR, "{label}, {name}: {error:e}\n{found}{expected}");
        }
        at += len;
    }
    assert_eq!(seen, 1, "{label}");
    let run = Simulation::new(model, *start).until(1.0).tolerance(1e-13).run().unwrap();
    let drift = run.conservation().worst();
    assert!(drift < 1e-10, "{label}: {drift:e}");
    let kinetic = |point: &M::Point<f64>| model.kinetic_energy(point.phi(), &model.velocity(point));
    let total = |point: &M::Point<f64>| kinetic(point) + energy(point.phi());
    let (begin, end) = (total(start), total(run.end().1));
    assert!((begin - end).abs() < 1e-10 * (1.0 + begin.abs()), "{label}: {begin} {end}");
}

/// One energy, as written for the macro and here, in three charts.
macro_rules! in_charts {
    ($($name:ident: $dim:literal, [$($potential:tt)*], $energy:expr;)*) => {
        $(#[test]
        #[allow(dead_code)]
        fn $name() {
            mod flat {
                use affine_runtime::prelude::*;
                #[affine_model(dim = $dim, kinetic(dalembert = 1), potential = $($potential)*)]
                pub(super) struct Body;
            }
            mod body {
                use affine_runtime::prelude::*;
                #[affine_model(dim = $dim, kinetic(casimir2 = 0.2, body_inertia = 1), potential = $($potential)*)]
                pub(super) struct Body;
            }
            mod space {
                use affine_runtime::prelude::*;
                #[affine_model(dim = $dim, kinetic(casimir2 = 0.2, space_inertia = 1), potential = $($potential)*)]
                pub(super) struct Body;
            }
            let energy: &dyn Fn(&Matrix<$dim>) -> f64 = &$energy;
            let (phi, none) = (strained::<$dim>(), Matrix::<$dim>::zeros());
            let start = flat::Body.at_velocity(phi, none).unwrap();
            check(("dalembert", &flat::Body), &start, energy);
            let start = body::Body.at_velocity(phi, none).unwrap();
            check(("body", &body::Body), &start, energy);
            let start = space::Body.at_velocity(phi, none).unwrap();
            check(("space", &space::Body), &start, energy);
        })*
    };
}

/// `tr G` and `tr G^2`.
fn traces<const N: usize>(phi: &Matrix<N>) -> (f64, f64) {
    let green = phi.transpose() * phi;
    (green.trace(), (green * green).trace())
}

in_charts! {
    second_invariant_in_the_plane: 2, [(tr(G)^2 - tr(G*G) - 3)^2 + 0.5*tr(G)], |phi: &Matrix<2>| {
        let (first, second) = traces(phi);
        (first * first - second - 3.0).powi(2) + 0.5 * first
    };
    second_invariant_in_space: 3, [(I2 - 3.5)^4*tr(G) + (det - 1)^2], |phi: &Matrix<3>| {
        let (first, second) = traces(phi);
        (0.5 * (first * first - second) - 3.5).powi(4) * first + (phi.determinant() - 1.0).powi(2)
    };
    isochoric_trace_in_the_plane: 2, [30*(tr(G)*exp(-2*q) - 2)^2], |phi: &Matrix<2>| {
        let (first, _) = traces(phi);
        let det = phi.determinant();
        30.0 * (first / det - 2.0).powi(2)
    };
    isochoric_trace_in_space: 3, [100*(tr(G)*det^(-2/3) - 3)^3], |phi: &Matrix<3>| {
        let (first, _) = traces(phi);
        let det = phi.determinant();
        100.0 * (first / det.cbrt().powi(2) - 3.0).powi(3)
    };
    isochoric_trace_beside_others: 3, [(tr(G)*exp(-2*q) - 3)^2 + (det - 1)^2 + 0.1*(tr(G) - 2)^4], |phi: &Matrix<3>| {
        let (first, _) = traces(phi);
        let det = phi.determinant();
        (first / det.cbrt().powi(2) - 3.0).powi(2) + (det - 1.0).powi(2) + 0.1 * (first - 2.0).powi(4)
    };
    isochoric_trace_of_the_square: 2, [(tr(G*G)*exp(-4*q) - 2)^3 + (tr(G)*exp(-2*q) - 2)^2], |phi: &Matrix<2>| {
        let (first, second) = traces(phi);
        let det = phi.determinant();
        (second / (det * det) - 2.0).powi(3) + (first / det - 2.0).powi(2)
    };
    sums_within_sums: 2, [((tr(G) - 2)^2 + q^2 + 0.1)^3 + ln(2 + (det - 1)^2)], |phi: &Matrix<2>| {
        let (first, _) = traces(phi);
        let det = phi.determinant();
        let q = 0.5 * det.ln();
        ((first - 2.0).powi(2) + q * q + 0.1).powi(3) + (2.0 + (det - 1.0).powi(2)).ln()
    };
    products_of_tensors: 3, [0.02*tr(G^3*Ct^2) + 0.1*(tr(G*Ct*phi) - 2)^2 + 0.05*tr(phi^4)], |phi: &Matrix<3>| {
        let (green, finger) = (phi.transpose() * phi, phi * phi.transpose());
        0.02 * (green.pow(3) * finger * finger).trace() + 0.1 * ((green * finger * phi).trace() - 2.0).powi(2)
            + 0.05 * phi.pow(4).trace()
    };
    powers_of_tensors: 2, [0.1*(tr(G^5) - 2)^2 + 0.1*tr((G - 1)^4)*exp(-q) + tr((G*Ct)^3)], |phi: &Matrix<2>| {
        let (green, finger) = (phi.transpose() * phi, phi * phi.transpose());
        let strain = green - Matrix::<2>::identity();
        0.1 * (green.pow(5).trace() - 2.0).powi(2) + 0.1 * strain.pow(4).trace() / phi.determinant().sqrt()
            + (green * finger).pow(3).trace()
    };
    sums_of_entries: 3, [(G[1,1] - 1)^4*(Ct[1,2] + phi[3,1])^2 + (tr(G) - 3)^2/(1 + (q + 0.1)^2)], |phi: &Matrix<3>| {
        let (green, finger) = (phi.transpose() * phi, phi * phi.transpose());
        let q = phi.determinant().ln() / 3.0;
        (green[(0, 0)] - 1.0).powi(4) * (finger[(0, 1)] + phi[(2, 0)]).powi(2)
            + (green.trace() - 3.0).powi(2) / (1.0 + (q + 0.1).powi(2))
    };
}

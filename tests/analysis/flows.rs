//! Flow matrices, exponents and sensitivities against closed forms.

use affine_runtime::analysis::{AnalysisError, FlowMatrix, field_sensitivities, lyapunov_spectrum};
use affine_runtime::prelude::*;

use crate::models::{Disc, turning};

/// A left-invariant geodesic.
#[affine_model(dim = 3, kinetic(casimir2 = a, casimir1_squared = b, body_inertia = i))]
struct Left {
    i: f64,
    a: f64,
    b: f64,
}

const LEFT: Left = Left { i: 1.0, a: 0.2, b: 0.1 };

fn phi() -> Matrix<3> {
    Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05)
}

fn rate() -> Matrix<3> {
    Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05)
}

fn assert_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-11, "{found} and not {expected}");
    }
}

/// Row "flow matrix", by block exponentials.
#[test]
fn a_geodesic_has_its_flow_matrix() {
    let model = LEFT.prepare().unwrap();
    let start = model.at_momentum(phi(), Comoving(rate())).unwrap();
    let mut flow = FlowMatrix::new(&model, (0.0, &start), 1e-13);
    flow.advance_to(2.0).unwrap();
    let matrix = flow.matrix();
    assert_near(&[matrix.trace(), matrix.norm()], &[8.456407389588508, 7.948775410247863]);
    assert!((matrix.determinant() - 1.0).abs() < 1e-11);
    let last = [
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.9046084603203056,
        0.3498715428364138,
        0.1786028254624438,
        0.15592336564603645,
        0.07070144174756722,
        -0.06724226985536462,
        0.12029429045230773,
        0.15080363702201688,
        0.02469009793212715,
    ];
    assert_near(&matrix.row(17).iter().copied().collect::<Vec<_>>(), &last);
    assert!(flow.defect() < 1e-12, "{}", flow.defect());
    // And back.
    flow.advance_to(0.0).unwrap();
    assert!(flow.matrix().is_identity(1e-10));
}

/// With a constraint, with the multiplier of one, and with a potential: columns are those of neighbouring motions, and the flow is
/// symplectic on what the constraint leaves.
#[test]
fn constraints_keep_the_form() {
    #[affine_model(dim = 3, constraint = isochoric, kinetic(dalembert = diag(1, 1.5, 2)), potential = tr(G)/2)]
    struct Multiplied;
    #[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2)), potential = 0.7*phi[3,3])]
    struct Swung;
    let one = Matrix::<3>::identity();
    let skew = Matrix::<3>::new(0.0, -0.3, 0.2, 0.3, 0.0, -0.5, -0.2, 0.5, 0.0);
    let start =
        Multiplied.at_velocity(one, skew + Matrix::from_diagonal(&Vector::<3>::new(0.2, -0.3, 0.1))).unwrap();
    let mut flow = FlowMatrix::new(&Multiplied, (0.0, &start), 1e-12);
    flow.advance_to(0.7).unwrap();
    assert!(flow.defect() < 1e-11, "{}", flow.defect());
    let run = Simulation::new(&Multiplied, start).until(0.7).tolerance(1e-13).run().unwrap();
    assert!((run.end().1.phi() - flow.point().phi()).norm() < 1e-10);
    let start = Swung.at_velocity(one, skew).unwrap();
    let mut flow = FlowMatrix::new(&Swung, (0.0, &start), 1e-12);
    flow.advance_to(2.0).unwrap();
    assert!(flow.defect() < 1e-11, "{}", flow.defect());
}

/// Friction is not symplectic, and the defect shows it.
#[test]
fn friction_shrinks_the_form() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)/2, dissipation(body_inertia = 0.3))]
    struct Damped;
    let start = Damped.at_velocity(Matrix::<2>::identity(), turning(0.3)).unwrap();
    let mut flow = FlowMatrix::new(&Damped, (0.0, &start), 1e-10);
    flow.advance_to(1.0).unwrap();
    assert!(flow.defect() > 1e-2, "{}", flow.defect());
}

/// Row "Lyapunov spectrum": `+-sqrt(-k_i/j)`, and zeros for the row that oscillates; those of an integrable motion vanish within
/// their bound, and come in pairs.
#[test]
fn exponents_are_known_where_motions_are() {
    #[affine_model(dim = 2, kinetic(dalembert = 2), potential = -0.25*(phi[1,1]^2 + phi[1,2]^2) + 1.5*(phi[2,1]^2 + phi[2,2]^2))]
    struct Saddle;
    // On the stable directions, so that the motion stays small.
    let start = Saddle.at_velocity(Matrix::<2>::identity(), Matrix::<2>::new(-0.5, 0.0, 0.0, 0.0)).unwrap();
    let spectrum = lyapunov_spectrum(&Saddle, &start, 24.0, 1e-9).unwrap();
    for (k, expected) in [0.5, 0.5, 0.0, 0.0, 0.0, 0.0, -0.5, -0.5].into_iter().enumerate() {
        let off = (spectrum.exponents[k] - expected).abs();
        assert!(off <= spectrum.errors[k] && off < 0.1, "{spectrum:?}");
    }
    let disc = Disc { i: 1.0, kappa: 4.0, c1: 0.3 }.prepare().unwrap();
    let start = disc.at_velocity(Matrix::<2>::new(1.1, 0.0, 0.0, 1.0), turning(0.3)).unwrap();
    let spectrum = lyapunov_spectrum(&disc, &start, 60.0, 1e-9).unwrap();
    for (exponent, error) in spectrum.exponents.iter().zip(&spectrum.errors) {
        assert!(exponent.abs() <= *error && *error < 0.2, "{spectrum:?}");
    }
}

/// Row "sensitivity", by the coefficients of one geodesic with its momentum held.
#[test]
fn fields_move_the_end() {
    let model = LEFT.prepare().unwrap();
    let start = model.at_velocity(phi(), phi() * rate()).unwrap();
    let moved = field_sensitivities(&LEFT, &model, (0.0, &start), 1.5, 1e-13).unwrap();
    let by_i = [
        0.7343972375637229,
        -0.8612081237001055,
        0.13283437256124828,
        0.04011048919358406,
        0.048547694248099925,
        -0.18193708802359432,
        -0.8184863253771998,
        0.12950132871161504,
        0.2740615993101932,
    ];
    assert_near(&moved.column(0).as_slice()[..9], &by_i);
    let by_a = [
        -0.8342842280473045,
        0.35728983163412625,
        -0.27214089077773673,
        -0.3783379085037987,
        -0.16479422928977686,
        0.29327822779924545,
        0.6333917860324504,
        -0.11010108117029309,
        -0.31329802164003556,
    ];
    assert_near(&moved.column(1).as_slice()[..9], &by_a);
    assert_near(&moved.column(2).as_slice()[..9], &[0.0; 9]);

    #[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = j))]
    struct Held {
        j: f64,
    }
    let held = Held { j: 1.0 };
    let model = held.prepare().unwrap();
    let start = model.at_velocity(Matrix::<2>::identity(), turning(1.0)).unwrap();
    let refused = field_sensitivities(&held, &model, (0.0, &start), 1.0, 1e-9);
    assert_eq!(refused.unwrap_err(), AnalysisError::HasMultiplier);
}

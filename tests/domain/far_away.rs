//! Functions that keep their sign, and the energies they belong to, far from the undeformed state, where nothing counted from it has
//! a digit left.

use affine_runtime::frames::Matrix;
use affine_runtime::prelude::*;

/// Relative error of the values: 50 times `eps` in the exponents, and sums of some terms.
const RELATIVE: f64 = 1e-13;

/// `q` of the placements.
const MEANS: [f64; 14] =
    [-50.0, -40.0, -30.0, -20.0, -10.0, -3.0, -1.0, 0.5, 1.0, 3.0, 10.0, 20.0, 40.0, 50.0];

macro_rules! models {
    ($dim:literal, kinetic $terms:tt: $($name:ident = $potential:expr;)*) => { $(
        #[affine_model(dim = $dim, kinetic $terms, potential = $potential)]
        struct $name;
    )* };
}

models! { 2, kinetic(casimir2 = 0.2, body_inertia = 1):
    Decay2 = 1/(1 - exp(-1*q));
    Growth2 = 1/(1 - exp(q));
    High2 = 1/(1 - exp(-12*q));
    Volume2 = 1/(det - 1);
    Shear2 = 1/(tr(G)*exp(-2*q) - 1);
    Traces2 = 1/(tr(G) - tr(G^2)/2);
    Sum2 = 1/(tr(G) + tr(G^2));
    Quotient2 = tr(G^2)/tr(G)^2;
}

models! { 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1):
    Decay3 = 1/(1 - exp(-1*q));
    Cube3 = 1/(exp(3*q) - 1);
    Shear3 = 1/(tr(G)*exp(-2*q) - 1);
    Quotient3 = tr(G^2)/tr(G)^2;
}

/// A shear of two axes, without a change of volume.
fn shear<const N: usize>() -> Matrix<N> {
    let mut shear = Matrix::identity();
    shear[(0, 1)] = 0.5;
    shear
}

/// `tr G` and `tr G^2` of the shear.
fn traces<const N: usize>() -> [f64; 2] {
    let green = shear::<N>().tr_mul(&shear::<N>());
    [green.trace(), (green * green).trace()]
}

fn assert_close(what: &str, name: &str, q: f64, found: f64, exact: f64) {
    let error = (found - exact).abs();
    assert!(error <= RELATIVE * exact.abs(), "{what} of {name} at {q}: {found:e} is not {exact:e}");
}

/// At rest, the function and the energy are what is known of them.
macro_rules! assert_values {
    ($model:ident, $dim:literal, $guard:expr, $energy:expr) => {
        for q in MEANS {
            let (guard, energy): (fn(f64) -> Option<f64>, fn(f64) -> f64) = ($guard, $energy);
            let point = $model.at_velocity(shear::<$dim>() * q.exp(), Matrix::zeros()).unwrap();
            let name = stringify!($model);
            assert_close("energy", name, q, $model.hamiltonian(0.0, &point), energy(q));
            let mut found = Vec::new();
            $model.domain(0.0, &point, &mut |value| found.push(value));
            let exact = Vec::from_iter(guard(q));
            assert_eq!(found.len(), exact.len(), "{name}");
            found
                .iter()
                .zip(&exact)
                .for_each(|(found, exact)| assert_close("guard", name, q, *found, *exact));
        }
    };
}

#[test]
fn values_keep_their_digits_far_away() {
    assert_values!(Decay2, 2, |q| Some(-(-q).exp_m1()), |q| -1.0 / (-q).exp_m1());
    assert_values!(Growth2, 2, |q| Some(-q.exp_m1()), |q| -1.0 / q.exp_m1());
    assert_values!(High2, 2, |q| Some(-(-12.0 * q).exp_m1()), |q| -1.0 / (-12.0 * q).exp_m1());
    assert_values!(Volume2, 2, |q| Some((2.0 * q).exp_m1()), |q| 1.0 / (2.0 * q).exp_m1());
    assert_values!(Shear2, 2, |_| Some(traces::<2>()[0] - 1.0), |_| 1.0 / (traces::<2>()[0] - 1.0));
    assert_values!(Decay3, 3, |q| Some(-(-q).exp_m1()), |q| -1.0 / (-q).exp_m1());
    assert_values!(Cube3, 3, |q| Some((3.0 * q).exp_m1()), |q| 1.0 / (3.0 * q).exp_m1());
    assert_values!(Shear3, 3, |_| Some(traces::<3>()[0] - 1.0), |_| 1.0 / (traces::<3>()[0] - 1.0));
}

/// Traces that vanish with the body, in divisors and beside them.
#[test]
fn traces_keep_their_digits_far_away() {
    fn sum(q: f64, of_square: f64) -> f64 {
        let [first, second] = traces::<2>();
        let square = (2.0 * q).exp();
        square * (first + of_square * second * square)
    }
    assert_values!(Traces2, 2, |q| Some(sum(q, -0.5)), |q| 1.0 / sum(q, -0.5));
    assert_values!(Sum2, 2, |_| None, |q| 1.0 / sum(q, 1.0));
    assert_values!(Quotient2, 2, |_| None, |_| traces::<2>()[1] / traces::<2>()[0].powi(2));
    assert_values!(Quotient3, 3, |_| None, |_| traces::<3>()[1] / traces::<3>()[0].powi(2));
}

/// A body that is far away goes on, and back again.
#[test]
fn runs_go_on_far_away() {
    let phi = shear::<2>() * 45.0_f64.exp();
    let start = Decay2.at_velocity(phi, phi * 0.5).unwrap();
    for end in [10.0, -10.0] {
        let run = Simulation::new(&Decay2, start).until(end).tolerance(1e-9).run().unwrap();
        let q = run.end().1.mean_log_stretch();
        assert!((q - 45.0 - 0.5 * end).abs() < 1e-6, "{q}");
    }
}

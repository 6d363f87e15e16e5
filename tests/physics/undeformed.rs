//! Potential energies near the undeformed state, where `D^2 + D^-2 - 2` and `tr(G) exp(-2q) - 3` have no digits left.

use affine_runtime::prelude::*;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = 5/4*(D^2 + D^-2 - 2))]
struct Dilatation;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = neo_hookean(0.5))]
struct Shear;

/// Exponent `k` and `5 sinh(q)^2`, by its definition in 60-digit arithmetic, rounded.
const DILATATION: [(i32, f64); 3] =
    [(10, 6.707_429_604_694_819e-7), (20, 6.394_886_400_607_479e-13), (26, 1.561_251_135_164_592e-16)];

/// Exponent `k` and `(tr(G) exp(-2q) - 3)/2`, likewise.
const SHEAR: [(i32, f64); 3] =
    [(10, 2.978_631_590_785_511_5e-7), (20, 2.842_169_452_262_47e-13), (26, 6.938_893_847_038_561e-17)];

/// `1 + 2^-k H`, exact in binary.
fn placement(k: i32) -> Matrix<3> {
    let h = Matrix::<3>::new(0.5, -0.25, 0.125, 0.75, 0.375, -0.5, -0.625, 0.25, 0.25);
    Matrix::<3>::identity() + h * 2f64.powi(-k)
}

/// The error stays at the last digits however small the deformation is.
#[test]
fn dilatation_keeps_its_digits() {
    for (k, exact) in DILATATION {
        let phi = placement(k);
        let energy = Dilatation.hamiltonian(0.0, &Dilatation.at_velocity(phi, Matrix::<3>::zeros()).unwrap());
        assert!((energy / exact - 1.0).abs() < 1e-14, "k = {k}: {energy:e} for {exact:e}");
    }
}

/// Terms of the first order in the strain cancel: the relative error is a few epsilon over the strain.
#[test]
fn shear_keeps_half_its_digits() {
    for (k, exact) in SHEAR {
        let phi = placement(k);
        let energy = Shear.hamiltonian(0.0, &Shear.at_velocity(phi, Matrix::<3>::zeros()).unwrap());
        let tolerance = 8.0 * f64::EPSILON * 2f64.powi(k);
        assert!((energy / exact - 1.0).abs() < tolerance, "k = {k}: {energy:e} for {exact:e}");
    }
}

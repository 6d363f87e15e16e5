//! Anisotropic energies of affine velocities, whose pieces are squares of momenta.

use affine_runtime::capability::Splitting;
use affine_runtime::prelude::*;

use crate::models::{phi2, phi3, spin2, spin3};
use crate::motions::assert_kept;

/// Principal axes of inertia: shears and stretches along them.
#[affine_model(
    dim = 3,
    kinetic(body_inertia = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(splitting)
)]
pub(crate) struct Principal;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_translation = 1,
        body_inertia = [[1.5, 0.25, 0], [0.25, 2, -0.5], [0, -0.5, 1.25]]),
    potential = tr(G)/2 - ln(det) + x[1]^2/2,
    emit(splitting),
)]
pub(crate) struct Oblique;

/// Inertia in space, of fields.
#[affine_model(
    dim = 3,
    kinetic(space_inertia = j, space_translation = 2),
    potential = tr(G)/2 - ln(det) + x[1]*phi[1,2]/4,
    emit(splitting)
)]
pub(crate) struct Spatial3 {
    pub(crate) j: Matrix<3>,
}

/// Indefinite, in the plane, without a potential.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]]),
    emit(splitting),
)]
pub(crate) struct Tensor2;

#[affine_model(dim = 2, kinetic(casimir2 = a, space_tensor = k), potential = tr(G)/2 - ln(det), emit(splitting))]
pub(crate) struct TensorOfFields {
    pub(crate) a: f64,
    pub(crate) k: Matrix<4>,
}

/// `2 Oh_12 Oh_21` without squares of either.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 1, body_tensor = [[1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]),
    potential = tr(G)/2 - ln(det),
    emit(splitting),
)]
pub(crate) struct Products;

/// `Sigma_hat_12` is conserved by the sum and by none of its squares.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 1, body_tensor = [[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]),
    emit(splitting)
)]
pub(crate) struct Fixed;

#[affine_model(
    dim = 2,
    metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
    kinetic(casimir2 = 0.2, body_inertia = [[1.5, 0.25], [0.25, 2]]),
    potential = tr(G)/2 - ln(det),
    emit(splitting),
)]
pub(crate) struct InOtherMetrics;

#[affine_model(
    dim = 3,
    metrics(body = eta),
    kinetic(casimir2 = 0.2, body_inertia = diag(i, 1.5*i, 2)),
    potential = tr(G)/2 - ln(det),
    emit(splitting)
)]
pub(crate) struct InMetricsOfFields {
    pub(crate) i: f64,
    pub(crate) eta: Matrix<3>,
}

pub(crate) fn oblique() -> Matrix<3> {
    Matrix::<3>::new(1.5, 0.25, 0.0, 0.25, 2.0, -0.5, 0.0, -0.5, 1.25)
}

pub(crate) fn tensor() -> Matrix<4> {
    Matrix::<4>::new(2.0, 0.5, 0.0, 1.0, 0.5, 3.0, 0.25, 0.0, 0.0, 0.25, 1.5, 0.5, 1.0, 0.0, 0.5, 4.0)
}

/// Calls a macro with each model, its dimension and its start.
macro_rules! each_anisotropic {
    ($visit:ident) => {{
        use crate::anisotropic::*;
        let start = Principal.at_momentum(phi3(), Comoving(spin3())).unwrap();
        $visit!("principal", 3, &Principal, start);
        let start = Oblique.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap();
        $visit!("oblique", 3, &Oblique, start);
        let model = Spatial3 { j: oblique() }.prepare().unwrap();
        let start = model.at_momentum(x3(), phi3(), p3(), Spatial(spin3())).unwrap();
        $visit!("spatial", 3, &model, start);
        let start = Tensor2.at_momentum(phi2(), Comoving(1.5 * spin2())).unwrap();
        $visit!("tensor", 2, &Tensor2, start);
        let model = TensorOfFields { a: 0.2, k: tensor() }.prepare().unwrap();
        let start = model.at_momentum(phi2(), Spatial(spin2())).unwrap();
        $visit!("tensor of fields", 2, &model, start);
        let start = Products.at_momentum(phi2(), Comoving(spin2())).unwrap();
        $visit!("products", 2, &Products, start);
        let start = Fixed.at_momentum(phi2(), Comoving(spin2())).unwrap();
        $visit!("fixed", 2, &Fixed, start);
        let start = InOtherMetrics.at_momentum(phi2(), Comoving(spin2())).unwrap();
        $visit!("in other metrics", 2, &InOtherMetrics, start);
        let model = InMetricsOfFields { i: 1.0, eta: oblique() }.prepare().unwrap();
        let start = model.at_momentum(phi3(), Comoving(spin3())).unwrap();
        $visit!("in metrics of fields", 3, &model, start);
    }};
}
pub(crate) use each_anisotropic;

#[test]
fn a_hundred_thousand_steps() {
    // Angular momentum in space; none of the affine spin in the body.
    let start = Principal.at_momentum(phi3(), Comoving(spin3())).unwrap();
    assert_kept("principal", &Principal, start, (2, 0.02), 2e-4);
    let model = TensorOfFields { a: 0.2, k: tensor() }.prepare().unwrap();
    let start = model.at_momentum(phi2(), Spatial(spin2())).unwrap();
    assert_kept("tensor of fields", &model, start, (4, 0.05), 1e-5);
}

#[test]
fn squares_that_commute_are_one_piece() {
    // Stretches along the axes, and the shears of each row of phi.
    assert_eq!(Principal::PIECES.len(), 5, "{:?}", Principal::PIECES);
    assert_eq!(Principal::PIECES[1], "sigma_hat_12^2 + sigma_hat_13^2");
    assert_eq!(Tensor2::PIECES.len(), 4, "{:?}", Tensor2::PIECES);
}

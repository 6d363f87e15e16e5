//! Models of every kind that splits, with a start for each.

use affine_runtime::prelude::*;

/// Three dimensions, translation, geodesic: `p` couples the centre of mass to the placement.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    emit(splitting, lanes)
)]
pub(crate) struct Missile;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = m),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
    emit(splitting),
)]
pub(crate) struct VibratingMissile {
    pub(crate) m: f64,
    pub(crate) kappa: f64,
}

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(splitting),
)]
pub(crate) struct Vibrating;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(splitting),
)]
pub(crate) struct PlanarMirrored;

#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
    emit(splitting, lanes),
)]
pub(crate) struct Elastic {
    pub(crate) kappa: f64,
}

#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 2),
    potential = tr(G)/2 - ln(det) + x[1]^2/2 + x[2]^4/4 + x[1]*phi[1,2],
    emit(splitting, lanes),
)]
pub(crate) struct Anchored;

/// The vorticity turns: its norm commutes with the Casimirs, not with the potential.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = tr(G)/2 - ln(det) + G[1,1]^2/4 + G[1,2]/5,
    emit(splitting, lanes),
)]
pub(crate) struct Fibred;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, space_translation = 1),
    potential = tr(G)/2 - ln(det) + Ct[1,1]^2/4 + norm(x)^2/2,
    emit(splitting),
)]
pub(crate) struct Pressed;

/// Translation in the body and a force on the centre of mass: three pieces.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = tr(G)/2 - ln(det) + norm(x)^2/2,
    emit(splitting, lanes),
)]
pub(crate) struct Attracted;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = (1 + sin(2*t)/2)*(tr(G)/2 - ln(det)),
    emit(splitting, lanes),
)]
pub(crate) struct Driven;

/// A third Casimir: the generator is quadratic in the affine spin.
#[affine_model(
    dim = 3,
    hamiltonian(casimir2 = 5/6, casimir1_squared = -1/18, vorticity_squared = 25/24, casimir3 = 0.1),
    potential = tr(G)/2 - ln(det),
    emit(splitting),
)]
pub(crate) struct Cubic;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = (q1^2 + q2^2 + q3^2)/2 + q^4 + pairs(tanh(d)^2),
    emit(splitting, lanes),
)]
pub(crate) struct Stretched;

/// The trace changes with every dilatation: that of `U_dil` moves beside it.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(kappa) + 0.3*(tr(G) - 3),
    emit(splitting),
)]
pub(crate) struct Inflated {
    pub(crate) kappa: f64,
}

/// A force on one corner, in space.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5) + 0.7*phi[3,3],
    emit(splitting),
)]
pub(crate) struct Pulled {
    pub(crate) kappa: f64,
}

/// Forces on the centre of mass and between it and the placement; the centre moves beside the dilatation.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, space_translation = 2),
    potential = 10/2*q^2 + neo_hookean(0.5) + 0.1*x[1]^2 + 0.2*x[2]*phi[1,2]*cos(t),
    emit(splitting, lanes),
)]
pub(crate) struct Tied;

/// Of the functions of `q` one has a closed form; single stretches, and a weight on the centre: three pieces.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = 5*sinh(q)^2 + gas(0.3) - q/5 + (q1^2 + q2^2 + q3^2)/2 + 0.4*x[3],
    emit(splitting, lanes),
)]
pub(crate) struct Falling;

/// Over the total affine momentum, in two pieces.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 1, casimir1_squared = 0.1, body_translation = m),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5) + 0.7*phi[2,2],
    emit(splitting),
)]
pub(crate) struct Towed {
    pub(crate) kappa: f64,
    pub(crate) m: f64,
}

/// Over the total affine momentum, in three.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 2),
    potential = kappa/2*q^2 + neo_hookean(2) + x[1]^2,
    emit(splitting, lanes),
)]
pub(crate) struct Moored {
    pub(crate) kappa: f64,
}

pub(crate) fn phi3() -> Matrix<3> {
    Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05)
}

pub(crate) fn spin3() -> Matrix<3> {
    Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05)
}

pub(crate) fn phi2() -> Matrix<2> {
    Matrix::<2>::new(1.1, 0.2, -0.1, 0.9)
}

pub(crate) fn spin2() -> Matrix<2> {
    Matrix::<2>::new(0.1, 0.4, -0.3, -0.2)
}

pub(crate) fn x3() -> Vector<3> {
    Vector::<3>::new(0.4, -0.1, 0.3)
}

pub(crate) fn p3() -> Vector<3> {
    Vector::<3>::new(0.3, -0.2, 0.5)
}

/// Calls a macro with models of every kind of piece that go in lanes, their dimensions and their starts.
macro_rules! each_in_lanes {
    ($visit:ident) => {{
        use crate::models::*;
        let (x2, p2) = (Vector::<2>::new(0.4, -0.1), Vector::<2>::new(0.3, -0.2));
        let start = Missile.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap();
        $visit!("missile", 3, &Missile, start);
        let model = Elastic { kappa: 10.0 }.prepare().unwrap();
        let start = model.at_momentum(phi3(), Comoving(spin3())).unwrap();
        $visit!("elastic", 3, &model, start);
        let start = Fibred.at_momentum(phi3(), Comoving(spin3())).unwrap();
        $visit!("fibred", 3, &Fibred, start);
        let start = Attracted.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap();
        $visit!("attracted", 3, &Attracted, start);
        let start = Stretched.at_momentum(phi3(), Comoving(spin3())).unwrap();
        $visit!("stretched", 3, &Stretched, start);
        let start = Anchored.at_momentum(x2, phi2(), p2, Spatial(spin2())).unwrap();
        $visit!("anchored", 2, &Anchored, start);
        let start = Driven.at_momentum(phi2(), Comoving(spin2())).unwrap();
        $visit!("driven", 2, &Driven, start);
        let start = Tied.at_momentum(x2, phi2(), p2, Spatial(spin2())).unwrap();
        $visit!("tied", 2, &Tied, start);
        let start = Falling.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap();
        $visit!("falling", 3, &Falling, start);
        let model = Moored { kappa: 10.0 }.prepare().unwrap();
        let start = model.at_momentum(x2, phi2(), p2, Comoving(spin2())).unwrap();
        $visit!("moored", 2, &model, start);
    }};
}
pub(crate) use each_in_lanes;

/// Calls a macro with each model, its dimension and its start.
macro_rules! each_model {
    ($visit:ident) => {{
        use crate::models::*;
        let (x2, p2) = (Vector::<2>::new(0.4, -0.1), Vector::<2>::new(0.3, -0.2));
        let model = VibratingMissile { m: 2.0, kappa: 10.0 }.prepare().unwrap();
        let start = model.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap();
        $visit!("vibrating missile", 3, &model, start);
        let start = Vibrating.at_momentum(phi3(), Comoving(spin3())).unwrap();
        $visit!("vibrating", 3, &Vibrating, start);
        let start = Cubic.at_momentum(phi3(), Comoving(spin3())).unwrap();
        $visit!("cubic", 3, &Cubic, start);
        let start = PlanarMirrored.at_momentum(phi2(), Spatial(spin2())).unwrap();
        $visit!("planar mirrored", 2, &PlanarMirrored, start);
        let start = Pressed.at_momentum(x2, phi2(), p2, Spatial(spin2())).unwrap();
        $visit!("pressed", 2, &Pressed, start);
        let model = Inflated { kappa: 10.0 }.prepare().unwrap();
        let start = model.at_momentum(phi3(), Comoving(spin3())).unwrap();
        $visit!("inflated", 3, &model, start);
        let model = Pulled { kappa: 10.0 }.prepare().unwrap();
        let start = model.at_momentum(phi3(), Spatial(spin3())).unwrap();
        $visit!("pulled", 3, &model, start);
        let model = Towed { kappa: 10.0, m: 2.0 }.prepare().unwrap();
        let start = model.at_momentum(x3(), phi3(), p3(), Spatial(spin3())).unwrap();
        $visit!("towed", 3, &model, start);
        crate::models::each_in_lanes!($visit);
        crate::anisotropic::each_anisotropic!($visit);
        crate::confined::each_confined!($visit);
        crate::fields::each_with_fields!($visit);
    }};
}
pub(crate) use each_model;

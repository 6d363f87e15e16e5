//! Doubly isotropic models: affine-affine, spatially affine (6.3), materially affine (6.4), d'Alembert's (6.5); in the
//! plane and in space; geodesic, with a potential of the dilatation, and with one of all stretches.

use affine_runtime::prelude::*;

/// `kappa = 2`, `c1 = 0.3`, and a quartic well in the strain.
macro_rules! models {
    ($dim:literal: $($geodesic:ident $dilated:ident $sheared:ident = ($($kinetic:tt)*);)*) => { $(
        #[affine_model(dim = $dim, kinetic($($kinetic)*), emit(two_polar))]
        pub(crate) struct $geodesic;
        #[affine_model(
            dim = $dim,
            kinetic($($kinetic)*),
            potential = hyperbolic_dilatation(2),
            emit(two_polar)
        )]
        pub(crate) struct $dilated;
        #[affine_model(
            dim = $dim,
            kinetic($($kinetic)*),
            potential = 2/2*sinh(q)^2 + 0.3*(tr(G)*exp(-2*q) - n) + 0.01*tr(G*G) + 0.005*tr(G*G*G),
            emit(two_polar)
        )]
        pub(crate) struct $sheared;
    )* };
}

models! { 2:
    AffineAffine2 AffineAffineDilated2 AffineAffineSheared2 = (casimir2 = 1.2, casimir1_squared = 0.1);
    SpatiallyAffine2 SpatiallyAffineDilated2 SpatiallyAffineSheared2
        = (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1);
    MateriallyAffine2 MateriallyAffineDilated2 MateriallyAffineSheared2
        = (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1);
    Dalembert2 DalembertDilated2 DalembertSheared2 = (dalembert = 1.5);
}

models! { 3:
    AffineAffine3 AffineAffineDilated3 AffineAffineSheared3 = (casimir2 = 1.2, casimir1_squared = 0.1);
    SpatiallyAffine3 SpatiallyAffineDilated3 SpatiallyAffineSheared3
        = (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1);
    MateriallyAffine3 MateriallyAffineDilated3 MateriallyAffineSheared3
        = (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1);
    Dalembert3 DalembertDilated3 DalembertSheared3 = (dalembert = 1.5);
}

/// [`SpatiallyAffineSheared3`] as a Hamiltonian in momenta: `1/(I+A)`, `1/(I+A+nB)` and `1/(I-A)` give its coefficients.
#[affine_model(
    dim = 3,
    hamiltonian(casimir2 = 5/6, casimir1_squared = -1/18, vorticity_squared = 25/24),
    potential = 2/2*sinh(q)^2 + 0.3*(tr(G)*exp(-2*q) - n) + 0.01*tr(G*G) + 0.005*tr(G*G*G),
    emit(two_polar)
)]
pub(crate) struct Stated3;

/// A body whose centre of mass moves freely.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, space_translation = 2),
    potential = hyperbolic_dilatation(2),
    emit(two_polar)
)]
pub(crate) struct Thrown2;

/// The same coefficients as fields.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = a, casimir1_squared = b, body_inertia = i),
    potential = kappa/2*sinh(q)^2 + c*(tr(G)*exp(-2*q) - n),
    emit(two_polar)
)]
pub(crate) struct Family3 {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) i: f64,
    pub(crate) kappa: f64,
    pub(crate) c: f64,
}

/// d'Alembert's inertia and well as fields.
#[affine_model(dim = 2, kinetic(dalembert = i), potential = kappa/2*q^2 + c*orthogonality(1/2), emit(two_polar))]
pub(crate) struct Family2 {
    pub(crate) i: f64,
    pub(crate) kappa: f64,
    pub(crate) c: f64,
}

/// A potential of the single stretches: a well for each, and a force between them.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1),
    potential = q1^2 + q2^2 + q3^2 + 0.1*pairs(cosh(d)),
    emit(two_polar)
)]
pub(crate) struct Pairs3;

/// The same for d'Alembert's model.
#[affine_model(dim = 2, kinetic(dalembert = 1.5), potential = q1^2 + q2^2 + 0.1*pairs(d^2), emit(two_polar))]
pub(crate) struct Pairs2;

/// Bodies whose volume is constant.
macro_rules! isochoric {
    ($($name:ident = $dim:literal ($($kinetic:tt)*) $(($potential:expr))?;)*) => { $(
        #[affine_model(
            dim = $dim,
            constraint = isochoric,
            kinetic($($kinetic)*),
            $(potential = $potential,)?
            emit(two_polar)
        )]
        pub(crate) struct $name;
    )* };
}

isochoric! {
    IsochoricGeodesic2 = 2 (casimir2 = 0.2, body_inertia = 1);
    IsochoricSheared2 = 2 (casimir2 = 0.2, body_inertia = 1) (0.3*tr(G) + 0.01*tr(G*G));
    IsochoricAffine2 = 2 (casimir2 = 1.2) (0.3*tr(G));
    IsochoricGeodesic3 = 3 (casimir2 = 0.2, space_inertia = 1);
    IsochoricSheared3 = 3 (casimir2 = 0.2, body_inertia = 1) (0.3*tr(G) + 0.01*tr(G*G));
    IsochoricPairs3 = 3 (casimir2 = 0.2, space_inertia = 1) (pairs(cosh(d)) + q1^2 + q2^2 + q3^2);
}

//! A penalty on deformation, towards the rigid body.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};

use super::shared::{apart, energy, floor, relative_distance, run, scene};

#[affine_model(dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), potential = orthogonality(k))]
pub(crate) struct Penalised {
    k: f64,
}

#[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2)))]
pub(crate) struct Top;

#[affine_model(dim = 2, kinetic(dalembert = 1), potential = orthogonality(k))]
pub(crate) struct PenalisedDisc {
    k: f64,
}

const STIFFNESSES: [f64; 10] = [1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11];

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("penalty towards the rigid limit");
    let t = 1.0;
    // Angular velocities of order 1: centrifugal forces deform the body by about 1/(8 k).
    let omega_hat = Matrix::<3>::new(0.0, -0.5, 0.3, 0.5, 0.0, -0.7, -0.3, 0.7, 0.0);
    let unit = Matrix::<3>::identity();
    let top = run(&Top, Top.at_velocity(unit, omega_hat)?, t)?;
    for k in STIFFNESSES {
        let named =
            |n, quantity, oracle| scene("d'Alembert", n, format!("k = {k:e}, t = {t}"), quantity, oracle);
        let distance = Demand::Held((1.0 / k).max(1e-9));
        // U = 4 k tr E^2 with E = (G - 1)/2: omega^2 is at most 8 k times the largest inverse inertia.
        let drift = Demand::Held(floor((8.0 * k).sqrt(), t));

        let model = Penalised { k }.prepare()?;
        let solution = run(&model, model.at_velocity(unit, omega_hat)?, t)?;
        report.case(named(3, "phi", Oracle::Limit), distance, || Ok(apart(&solution, &top)));
        report.case(named(3, "energy", Oracle::Invariance), drift, || {
            Ok((energy(&solution), solution.statistics().steps))
        });

        let model = PenalisedDisc { k }.prepare()?;
        let turning = Matrix::<2>::new(0.0, -1.0, 1.0, 0.0);
        let solution = run(&model, model.at_velocity(Matrix::<2>::identity(), turning)?, t)?;
        let (sine, cosine) = t.sin_cos();
        let turned = Matrix::<2>::new(cosine, -sine, sine, cosine);
        report.case(named(2, "phi", Oracle::ClosedForm), distance, || {
            Ok((relative_distance(solution.end().1.phi(), &turned), solution.statistics().steps))
        });
    }
    Ok(())
}

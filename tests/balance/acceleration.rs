//! `emit(acceleration)` beside forces and time: against the derivative of the velocity along Hamilton's equations.

use affine_oracle::Random;
use affine_runtime::model::StateVector;
use affine_runtime::prelude::*;

use crate::Stirring;
use affine_tests::dual::Dual;

/// Some hundred roundings, in data with `phi^-1` of norm below 10.
const ACCELERATION: f64 = 1e-12;

const T0: f64 = 0.25;

/// `d(x_dot)/dt` along the equations, by numbers with a derivative.
fn rate_of_velocity<const N: usize, M: Model<N>>(model: &M, point: &M::Point<f64>) -> Vector<N> {
    let full = model.flatten(point);
    let rates = model.hamilton_equations(T0, &full);
    let mut moving = M::Full::<Dual>::zeros();
    for ((dual, value), slope) in moving.as_mut().iter_mut().zip(full.as_ref()).zip(rates.as_ref()) {
        *dual = Dual { value: *value, slope: *slope };
    }
    model.velocity(&model.unflatten(&moving)).x_dot.map(|dual| dual.slope)
}

#[test]
fn of_bodies_under_forces() {
    #[affine_model(
        dim = 3,
        kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1.5),
        potential = x[1]*x[2]*cos(t) + tr(G),
        dissipation(body_inertia = 0.25, space_translation = 0.5),
        forces = custom(field, spatial),
        emit(acceleration)
    )]
    struct Stirred {
        field: Stirring,
    }
    #[affine_model(
        dim = 3,
        kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1.5),
        potential = x[1]*sin(t),
        emit(acceleration)
    )]
    struct Pulled;
    #[affine_model(
        dim = 3,
        kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1.5),
        dissipation(body_inertia = 0.25, body_translation = 0.5),
        emit(acceleration)
    )]
    struct Damped;
    let stirred = Stirred { field: Stirring };
    for seed in 0..4 {
        let state = Random::new(560 + seed).state(3);
        let [x, p] = [&state.x, &state.p].map(|v| Vector::<3>::from_column_slice(&v.to_f64()));
        let [phi, pi] = [&state.phi, &state.pi].map(|m| Matrix::<3>::from_row_slice(&m.to_f64()));
        let close = |found: Vector<3>, expected: Vector<3>| {
            let size = 1.0 + expected.norm() + phi.norm_squared() * (p.norm() + x.norm()) * pi.norm();
            assert!((found - expected).norm() <= ACCELERATION * size, "{found} {expected}");
        };
        let point = stirred.at_momentum(x, phi, p, TwoPoint(pi)).unwrap();
        close(stirred.acceleration(T0, &point), rate_of_velocity(&stirred, &point));
        let point = Pulled.at_momentum(x, phi, p, TwoPoint(pi)).unwrap();
        close(Pulled.acceleration(T0, &point), rate_of_velocity(&Pulled, &point));
        let point = Damped.at_momentum(x, phi, p, TwoPoint(pi)).unwrap();
        close(Damped.acceleration(&point), rate_of_velocity(&Damped, &point));
    }
}

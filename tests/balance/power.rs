//! The power `dH/dt` of forces, with that of a potential that contains the time.

use affine_oracle::Random;
use affine_runtime::model::{Conserved, StateVector};
use affine_runtime::prelude::*;

use affine_tests::dual::Dual;

/// Derivatives of `H` along the equations against the emitted power: some hundred roundings.
const POWER: f64 = 1e-12;

/// Energy against work over a run at tolerance 1e-12.
const WORK: f64 = 1e-11;

/// Two methods at tolerance 1e-12, over a quarter of a unit of time.
const METHODS: f64 = 1e-10;

const T0: f64 = 0.25;

/// `dH/dt` along Hamilton's equations: the derivative of the emitted `H` at `t` and the state, in direction 1 and the rates.
fn rate_of_energy<const N: usize, M: Model<N>>(model: &M, point: &M::Point<f64>) -> f64 {
    let full = model.flatten(point);
    let rates = model.hamilton_equations(T0, &full);
    let mut moving = M::Full::<Dual>::zeros();
    for ((dual, value), slope) in moving.as_mut().iter_mut().zip(full.as_ref()).zip(rates.as_ref()) {
        *dual = Dual { value: *value, slope: *slope };
    }
    model.hamiltonian(Dual { value: T0, slope: 1.0 }, &model.unflatten(&moving)).slope
}

fn closes<const N: usize, M: Model<N>>(model: &M, start: M::Point<f64>) {
    let (power, expected) = (model.power(T0, &start), rate_of_energy(model, &start));
    let velocity = model.velocity(&start);
    let size = 1.0 + start.pi().0.0.norm() * velocity.phi_dot.norm() + start.phi().norm_squared();
    assert!((power - expected).abs() <= POWER * size, "{power:e} {expected:e} of {size:e}");
    let run = Simulation::new(model, start).from(T0).until(T0 + 0.5).tolerance(1e-12).run().unwrap();
    let balance = run.power_balance().unwrap();
    assert!(balance.relative() <= WORK, "{balance}");
    assert!(balance.work.abs() > 1e-3 * balance.scale, "{balance}");
    assert!(!M::DESCRIPTION.conserved.contains(&Conserved::Energy));
}

fn state<const N: usize>(seed: u64) -> [Matrix<N>; 2] {
    let state = Random::new(seed).state(N);
    [&state.phi, &state.pi].map(|m| Matrix::<N>::from_row_slice(&m.to_f64()))
}

#[test]
fn of_driven_and_damped_bodies() {
    #[affine_model(
        dim = 3,
        kinetic(body_inertia = 1.5, casimir2 = 0.25),
        potential = tr(G)/2*(2 + cos(3*t)) + sinh(q)^2*sin(t),
        dissipation(body_inertia = 0.25)
    )]
    struct Viscous;
    #[affine_model(
        dim = 2,
        kinetic(dalembert = diag(1, 2)),
        potential = tr(G*G)/4*(2 + cos(t)),
        dissipation(space_inertia = 0.25)
    )]
    struct Elastic;
    for seed in 0..4 {
        let [phi, pi] = state(510 + seed);
        closes(&Viscous, Viscous.at_momentum(phi, TwoPoint(pi)).unwrap());
        let [phi, pi] = state(520 + seed);
        closes(&Elastic, Elastic.at_momentum(phi, TwoPoint(pi)).unwrap());
    }
}

/// Taylor series of damped motions, work included, against the embedded Runge-Kutta method.
#[test]
fn by_taylor_series() {
    #[affine_model(
        dim = 3,
        kinetic(body_inertia = 1.5, casimir2 = 0.25),
        potential = hyperbolic_dilatation(2) + neo_hookean(0.5),
        dissipation(body_inertia = 0.25, dalembert = 0.125),
        emit(taylor)
    )]
    struct Viscous;
    for seed in 0..4 {
        let [phi, pi] = state(530 + seed);
        let start = Viscous.at_momentum(phi, TwoPoint(pi)).unwrap();
        closes(&Viscous, start);
        let run = |method| {
            Simulation::new(&Viscous, start).until(0.25).tolerance(1e-12).method(method).run().unwrap()
        };
        let (series, explicit) = (run(Method::Taylor { order: None }), run(Method::RungeKutta8));
        let (found, expected) = (series.end().1, explicit.end().1);
        assert!((found.phi() - expected.phi()).norm() <= METHODS * expected.phi().norm());
        let (found, expected) = (series.power_balance().unwrap(), explicit.power_balance().unwrap());
        assert!(found.relative() <= WORK, "{found}");
        assert!((found.work - expected.work).abs() <= METHODS * expected.scale);
    }
}

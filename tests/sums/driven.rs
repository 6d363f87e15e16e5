//! `dH/dt = dU/dt` at rest of the placement: the balance of a potential that contains the time, with nothing beside it.

use affine_oracle::Random;
use affine_runtime::model::{Conserved, StateVector};
use affine_runtime::prelude::*;

use affine_tests::dual::Dual;
use affine_tests::group::starts;
use affine_tests::tolerances::{CANONICAL, POWER_BALANCE, UNSEEN_POWER};

const T0: f64 = 0.25;

/// The rate of the emitted `H` along the emitted equations, in direction 1 and the rates; and of the energy of a run.
fn closes<const N: usize, M: Model<N>>(model: &M, start: M::Point<f64>, tolerance: f64) {
    let full = model.flatten(&start);
    let rates = model.hamilton_equations(T0, &full);
    let mut dual = M::Full::<Dual>::zeros();
    for ((dual, value), slope) in dual.as_mut().iter_mut().zip(full.as_ref()).zip(rates.as_ref()) {
        *dual = Dual { value: *value, slope: *slope };
    }
    let expected = model.hamiltonian(Dual { value: T0, slope: 1.0 }, &model.unflatten(&dual)).slope;
    let velocity = model.velocity(&start);
    let size = 1.0 + start.pi().0.0.norm() * velocity.phi_dot.norm() + start.phi().norm_squared();
    let power = model.power(T0, &start);
    // A hundred roundings of the derivatives that cancel.
    assert!((power - expected).abs() <= 100.0 * CANONICAL * size, "{power:e} {expected:e} of {size:e}");
    assert!(!M::DESCRIPTION.conserved.contains(&Conserved::Energy));
    for method in [Method::Automatic, Method::Gauss { stages: 3, step: 1e-3 }] {
        let run = Simulation::new(model, start).from(T0).until(T0 + 0.5).tolerance(1e-12).method(method);
        let run = run.run().unwrap();
        let balance = run.power_balance().unwrap();
        assert!(balance.relative() <= tolerance, "{method:?}: {balance}");
        assert!(balance.work.abs() > 1e-4 * balance.scale, "{balance}");
    }
}

fn state<const N: usize>(seed: u64) -> [Matrix<N>; 2] {
    let state = Random::new(seed).state(N);
    [&state.phi, &state.pi].map(|m| Matrix::<N>::from_row_slice(&m.to_f64()))
}

macro_rules! driven {
    ($($name:ident: $n:literal $tolerance:ident ($($spec:tt)*);)*) => { $(
        #[test]
        fn $name() {
            #[affine_model(dim = $n, $($spec)*)]
            struct Body;
            for seed in 0..3 {
                let [phi, pi] = state(6310 + seed);
                closes(&Body, Body.at_momentum(phi, TwoPoint(pi)).unwrap(), $tolerance);
            }
        }
    )* };
}

driven! {
    elastic_2: 2 POWER_BALANCE (kinetic(dalembert = diag(1, 2)), potential = tr(G*G)/4*(2 + cos(t)));
    vibrating_3: 3 POWER_BALANCE (kinetic(casimir2 = 0.25, body_inertia = 1.5), potential = sinh(q)^2*cos(t) + tr(G)/2*sin(t));
    separated_shear_2: 2 POWER_BALANCE (kinetic(casimir2 = 0.25, casimir1_squared = 0.125, body_inertia = 1.5),
        potential = hyperbolic_dilatation(10) + (2 + cos(3*t))*neo_hookean(0.5));
    separated_shear_3: 3 POWER_BALANCE (kinetic(casimir2 = 0.25, space_inertia = 1.5),
        potential = hyperbolic_dilatation(10) + (2 + cos(3*t))*neo_hookean(0.5));
    single_stretches_2: 2 POWER_BALANCE (kinetic(casimir2 = 0.25, space_inertia = 1.5), potential = (2 + cos(t))*(Q1 + Q2));
    single_stretches_of_a_sum_3: 3 POWER_BALANCE (kinetic(dalembert = 1.5, casimir2 = 0.25),
        potential = (2 + cos(t))*(q1^2 + q2^2 + q3^2));
    sum_of_frames_2: 2 POWER_BALANCE (kinetic(dalembert = 1.5, casimir2 = 0.25), potential = (2 + cos(t))*tr(G)/2 + sinh(q)^2*sin(t));
    time_alone_3: 3 UNSEEN_POWER (kinetic(casimir2 = 0.25, space_inertia = 1.5), potential = sin(2*t)^2);
    time_alone_of_a_sum_2: 2 UNSEEN_POWER (kinetic(dalembert = 1.5, body_inertia = 0.25), potential = sin(2*t)^2);
    metrics_2: 2 POWER_BALANCE (metrics(space = [[2, 0.5], [0.5, 1.5]], body = diag(4, 1)), kinetic(casimir2 = 0.25, body_inertia = 1.5),
        potential = tr(G)/2*(2 + cos(t)));
}

#[test]
fn confined_bodies() {
    #[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2)), potential = phi[3,3]*cos(t))]
    struct Top;
    #[affine_model(dim = 2, constraint = isochoric, kinetic(body_inertia = 1.5), potential = tr(G)*(2 + cos(t)))]
    struct Fluid;
    #[affine_model(dim = 3, constraint = conformal, kinetic(dalembert = 1.5), potential = sinh(q)^2*(2 + cos(t)))]
    struct Bubble;
    for start in starts::<3>(affine_oracle::Constraint::Rigid) {
        closes(&Top, Top.at_momentum(start.phi, Comoving(start.spin)).unwrap(), POWER_BALANCE);
    }
    for start in starts::<2>(affine_oracle::Constraint::Isochoric) {
        closes(&Fluid, Fluid.at_momentum(start.phi, Comoving(start.spin)).unwrap(), POWER_BALANCE);
    }
    for start in starts::<3>(affine_oracle::Constraint::Conformal) {
        closes(&Bubble, Bubble.at_momentum(start.phi, Comoving(start.spin)).unwrap(), POWER_BALANCE);
    }
}

/// Kicks and halves of the equations have no place for the work: the motion is emitted as it was.
#[test]
fn methods_that_take_the_equations_apart() {
    #[affine_model(dim = 2, emit(splitting), kinetic(dalembert = 1.5), potential = tr(G)/2*(2 + cos(t)))]
    struct Split;
    let [phi, pi] = state(6320);
    let run =
        Simulation::new(&Split, Split.at_momentum(phi, TwoPoint(pi)).unwrap()).until(0.5).run().unwrap();
    assert!(run.power_balance().is_none());
}

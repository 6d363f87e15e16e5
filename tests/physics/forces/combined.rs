//! Forces beside a constraint, a stated Hamiltonian and a dilatation that separates, each against the same model in
//! another statement.

use affine_oracle::Random;
use affine_runtime::force::{Force, Motion};
use affine_runtime::frames::Space as OnSpace;
use affine_runtime::model::{Conserved, Description};
use affine_runtime::potential::{Class, Place, Potential, Slopes};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

use crate::canonical::T0;
use crate::families::{matrix, vector};
use affine_tests::reference::assert_close;
use affine_tests::tolerances::{POWER_BALANCE, UNDER_POTENTIAL};

/// `tr(G)/2`.
#[derive(Clone)]
struct Spring;

impl<const N: usize> Potential<N> for Spring {
    const CLASS: Class = Class::Isotropic;
    fn energy<T: Scalar>(&self, place: &Place<N, T>) -> T {
        place.phi.iter().fold(T::zero(), |sum, entry| entry.fma(*entry, sum)) * T::constant(0.5, 0.0)
    }
    fn slopes<T: Scalar>(&self, place: &Place<N, T>) -> Slopes<N, T> {
        Slopes { x: Vector::<N, T>::from_fn(|_, _| T::zero()), phi: place.phi }
    }
}

/// `Q = -phi_dot phi^T cos t`.
#[derive(Clone)]
struct Drag;

impl<const N: usize> Force<N> for Drag {
    type Form = OnSpace;
    fn force<T: Scalar>(&self, motion: &Motion<N, T>) -> Matrix<N, T> {
        motion.phi_dot * motion.phi.transpose() * -motion.t.cos()
    }
}

/// An isochoric body under a potential of a field, and the same under a formula.
#[affine_model(dim = 3, constraint = isochoric, kinetic(dalembert = 0.2), potential = custom(spring, isotropic))]
struct ByField {
    spring: Spring,
}

#[affine_model(dim = 3, constraint = isochoric, kinetic(dalembert = 0.2), potential = tr(G)/2)]
struct ByFormula;

/// The first state, at `det phi = 1` with a velocity that keeps it.
fn isochoric_start() -> (Matrix<3>, Matrix<3>) {
    let phi = Matrix::<3>::new(1.2, 0.1, 0.2, 0.0, 1.0, -0.15, 0.0, 0.0, 1.0 / 1.2);
    let mut rate = Matrix::<3>::new(0.2, 0.5, -0.1, -0.3, 0.1, 0.2, 0.15, -0.25, -0.3);
    rate -= Matrix::<3>::identity() * (rate.trace() / 3.0);
    (phi, phi * rate)
}

#[test]
fn an_isochoric_body_under_a_potential_of_a_field_moves_as_under_the_formula() {
    let (phi, phi_dot) = isochoric_start();
    let (model, same) = (ByField { spring: Spring }, ByFormula);
    let (start, there) = (model.at_velocity(phi, phi_dot).unwrap(), same.at_velocity(phi, phi_dot).unwrap());
    let full = model.hamilton_equations(T0, &model.flatten(&start));
    let expected = same.hamilton_equations(T0, &same.flatten(&there));
    assert_close("rates", &full, &expected, 1.0, UNDER_POTENTIAL);
    let (energy, formula) = (model.hamiltonian(T0, &start), same.hamiltonian(T0, &there));
    assert_close("energy", &[energy], &[formula], formula.abs(), UNDER_POTENTIAL);
    assert_eq!(ByField::DESCRIPTION.conserved, ByFormula::DESCRIPTION.conserved);
    assert!(ByField::DESCRIPTION.conserved.contains(&Conserved::Vorticity));
    for method in
        [Method::Automatic, Method::Gauss { stages: 3, step: 0.05 }, Method::Rattle { order: 6, step: 0.05 }]
    {
        let run = Simulation::new(&model, start).until(2.0).tolerance(1e-12).method(method).run().unwrap();
        let other = Simulation::new(&same, there).until(2.0).tolerance(1e-12).method(method).run().unwrap();
        let (end, expected) = (run.end().1.phi(), other.end().1.phi());
        assert_close("end", end.as_slice(), expected.as_slice(), 1.0, POWER_BALANCE);
        assert!((end.determinant() - 1.0).abs() < UNDER_POTENTIAL);
    }
}

/// The drunk missile with friction, a force and a potential of fields: by its kinetic energy, and by its Hamiltonian.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 2),
    potential = hyperbolic_dilatation(2) + custom(spring, isotropic),
    dissipation(body_inertia = 0.5, casimir2 = 0.25, space_translation = 0.3),
    forces = custom(drag, spatial),
)]
struct ByVelocities {
    spring: Spring,
    drag: Drag,
}

#[affine_model(
    dim = 3,
    hamiltonian(casimir2 = 5/6, casimir1_squared = -1/18, vorticity_squared = 25/24, body_translation = 1/2),
    potential = hyperbolic_dilatation(2) + custom(spring, isotropic),
    dissipation(body_inertia = 0.5, casimir2 = 0.25, space_translation = 0.3),
    forces = custom(drag, spatial),
)]
struct ByMomenta {
    spring: Spring,
    drag: Drag,
}

#[test]
fn forces_on_a_stated_hamiltonian_are_those_on_its_kinetic_energy() {
    let (model, same) =
        (ByMomenta { spring: Spring, drag: Drag }, ByVelocities { spring: Spring, drag: Drag });
    for seed in 0..3 {
        let state = Random::new(9301 + seed).state(3);
        let (x, p) = (vector(&state.x.to_f64()), vector(&state.p.to_f64()));
        let (phi, pi) = (matrix(&state.phi.to_f64()), TwoPoint(matrix(&state.pi.to_f64())));
        let start = model.at_momentum(x, phi, p, pi).unwrap();
        let there = same.at_momentum(x, phi, p, pi).unwrap();
        let rates = model.hamilton_equations(T0, &model.flatten(&start));
        let expected = same.hamilton_equations(T0, &same.flatten(&there));
        let size = expected.iter().fold(0.0, |size: f64, rate| size.max(rate.abs()));
        assert_close("rates", &rates, &expected, size, UNDER_POTENTIAL);
        let (power, expected) = (model.power(T0, &start), same.power(T0, &there));
        assert_close("power", &[power], &[expected], expected.abs(), UNDER_POTENTIAL);
    }
    let (stated, derived) = (ByMomenta::DESCRIPTION, ByVelocities::DESCRIPTION);
    assert_eq!((stated.conserved, stated.reduced), (derived.conserved, derived.reduced));
}

/// The dilatation leaves the state of a body under formulas only.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(2),
)]
struct Undisturbed;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(2),
    dissipation(casimir1_squared = 0.3),
)]
struct Damped;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(2) + custom(spring, isotropic),
)]
struct Sprung {
    spring: Spring,
}

#[test]
fn forces_keep_the_dilatation_in_the_state() {
    let separates = |description: Description| description.reduced.iter().any(|group| group.name() == "Psi");
    assert!(separates(Undisturbed::DESCRIPTION));
    assert!(!separates(Damped::DESCRIPTION));
    assert!(!separates(Sprung::DESCRIPTION));
    let (phi, phi_dot) = isochoric_start();
    let start = Damped.at_velocity(phi, phi_dot).unwrap();
    let run = Simulation::new(&Damped, start).until(1.0).tolerance(1e-12).run().unwrap();
    let balance = run.power_balance().unwrap();
    assert!(balance.work < 0.0 && balance.relative() <= POWER_BALANCE, "{balance}");
    let model = Sprung { spring: Spring };
    let start = model.at_velocity(phi, phi_dot).unwrap();
    let run = Simulation::new(&model, start).until(1.0).tolerance(1e-12).run().unwrap();
    let change = model.hamiltonian(1.0, run.end().1) - model.hamiltonian(0.0, &start);
    assert!(change.abs() <= POWER_BALANCE * model.hamiltonian(0.0, &start).abs(), "{change:e}");
}

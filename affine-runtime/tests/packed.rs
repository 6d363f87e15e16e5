//! Right-hand sides and Runge-Kutta steps in vectors of four give the bits of those over single components; where vectors alone
//! have fused multiply-adds, the bits of single components are those of lanes, `cargo test --test ensembles`.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_core::system::Packing;
use affine_integrators::{FusedArithmetic, RungeKutta5, RungeKutta8};
use affine_runtime::__private::numerics::Portable;
use affine_runtime::model::Model;
use affine_runtime::prelude::*;
use affine_runtime::simulate::Method;

/// P2 of the benchmark problems.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
)]
struct Vibrating;

/// P1.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)
)]
struct Missile;

/// P7, its stiffness a field.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5)
)]
struct StiffMissile {
    kappa: f64,
}

/// P3.
#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
)]
struct Elastic;

/// Of the plane, and too short.
#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = neo_hookean(0.5))]
struct Planar;

fn phi() -> Matrix<3> {
    Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05)
}

fn spin() -> Matrix<3> {
    Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05)
}

fn x_and_p() -> (Vector<3>, Vector<3>) {
    (Vector::<3>::zeros(), Vector::<3>::new(0.3, -0.2, 0.5))
}

/// Bits, zeros of either sign being one.
fn bits(state: &impl AsRef<[f64]>) -> Vec<u64> {
    state.as_ref().iter().map(|value| (value + 0.0).to_bits()).collect()
}

/// Multiply-adds of vectors are rounded once, and those of numbers twice.
fn only_vectors_are_fused() -> bool {
    FusedArithmetic::here() == FusedArithmetic::InVectors
}

/// The same bits; of vectors that are fused the same within what rounding makes of 2.0 units of time at 1e-9.
fn assert_same(found: &impl AsRef<[f64]>, expected: &impl AsRef<[f64]>, what: &str) {
    if !only_vectors_are_fused() {
        return assert_eq!(bits(found), bits(expected), "{what}");
    }
    for (found, expected) in found.as_ref().iter().zip(expected.as_ref()) {
        assert!((found - expected).abs() < ROUNDING, "{what}: {found} {expected}");
    }
}

/// Some hundred roundings of the numbers of these bodies.
const ROUNDING: f64 = 1e-13;

/// The same by single components: evaluations along a run, and the run itself.
fn same_bits<const N: usize, M: Model<N>>(model: &M, start: M::Point<f64>) {
    let (reduced, constants) = model.reduce(0.0, &start);
    let packing = M::packing(model).expect("these equations are shorter in vectors");
    assert_eq!(bits(&packing.unpacked(&packing.packed(&reduced))), bits(&reduced));
    let equations = |t: f64, state: &M::Reduced<f64>| {
        let single = model.reduced_equations(t, &constants, state);
        let packed = packing.slope(Portable, t, &constants, &packing.packed(state));
        assert_eq!(bits(&packing.unpacked(&packed)), bits(&single), "{} at {t}", M::DESCRIPTION.name);
        single
    };
    let (groups, tolerance, t_end) = (M::DESCRIPTION.reduced, 1e-9, 2.0);
    let mut eighth = RungeKutta8::new(equations, groups, (0.0, reduced), t_end, tolerance).unwrap();
    let mut fifth = RungeKutta5::new(equations, groups, (0.0, reduced), t_end, tolerance).unwrap();
    while !eighth.is_finished() {
        eighth.advance().unwrap();
    }
    while !fifth.is_finished() {
        fifth.advance().unwrap();
    }
    for (method, end, statistics) in [
        (Method::RungeKutta8, eighth.y(), eighth.statistics()),
        (Method::RungeKutta5, fifth.y(), fifth.statistics()),
    ] {
        let run =
            Simulation::new(model, start).until(t_end).tolerance(tolerance).method(method).run().unwrap();
        let expected = model.flatten(&model.expand(t_end, &constants, end));
        assert_same(&model.flatten(run.end().1), &expected, &format!("{method:?}"));
        assert_eq!(run.statistics(), statistics, "{method:?}");
    }
}

#[test]
fn vibrating() {
    same_bits(&Vibrating, Vibrating.at_momentum(phi(), Comoving(spin())).unwrap());
}

#[test]
fn missile() {
    let (x, p) = x_and_p();
    same_bits(&Missile, Missile.at_momentum(x, phi(), p, Comoving(spin())).unwrap());
}

#[test]
fn stiff_missile() {
    let model = StiffMissile { kappa: 100.0 }.prepare().unwrap();
    let (x, p) = x_and_p();
    let start = model.at_momentum(x, phi(), p, Comoving(spin())).unwrap();
    same_bits(&model, start);
}

#[test]
fn elastic() {
    same_bits(&Elastic, Elastic.at_velocity(phi(), spin()).unwrap());
}

#[test]
fn others_keep_single_components() {
    assert!(Planar::packing(&Planar).is_none());
}

/// The dense output is that of single components, and so are its states between steps.
#[test]
fn between_steps() {
    let start = Vibrating.at_momentum(phi(), Comoving(spin())).unwrap();
    let (reduced, constants) = Vibrating.reduce(0.0, &start);
    let equations = |t: f64, state: &_| Vibrating.reduced_equations(t, &constants, state);
    let groups = <Vibrating as Model<3>>::DESCRIPTION.reduced;
    let mut single = RungeKutta8::new(equations, groups, (0.0, reduced), 2.0, 1e-9).unwrap();
    let times = [0.3, 1.1, 1.7];
    let run = Simulation::new(&Vibrating, start)
        .until(2.0)
        .tolerance(1e-9)
        .method(Method::RungeKutta8)
        .output(times)
        .run()
        .unwrap();
    for (t, point) in times.into_iter().zip(run.points()) {
        while single.t() < t {
            single.advance().unwrap();
        }
        let expected = Vibrating.expand(t, &constants, &single.dense().at(t));
        assert_same(&Vibrating.flatten(point), &Vibrating.flatten(&expected), &format!("at {t}"));
    }
}

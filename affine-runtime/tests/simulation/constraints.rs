//! Bodies under constraints: steps on their groups, RATTLE, what is said about them.

use affine_runtime::__private::point as point_of;
use affine_runtime::Simulation;
use affine_runtime::frames::{Comoving, Matrix};
use affine_runtime::model::{Conserved, Model};
use affine_runtime::simulate::{Method, Reason, Setting};
use affine_runtime::state::{Phase, Pinned};

use crate::models::incompressible_disc::{Drop, IncompressibleDisc};
use crate::models::planar::{self, Planar};
use crate::models::top::{self, Top};

/// Placement and velocity `phi L` with `det phi = 1`, `tr L = 0`.
fn disc() -> Drop {
    let phi = Matrix::<2>::new(1.25, 0.3, 0.0, 0.8);
    let spin = Matrix::<2>::new(0.3, -0.9, 0.5, -0.3).transpose() * phi.tr_mul(&phi);
    point_of(phi, Comoving(spin - Matrix::<2>::identity() * (spin.trace() / 2.0)), Pinned)
}

fn off(point: &Drop) -> f64 {
    let velocity = IncompressibleDisc.velocity(point).phi_dot;
    let phi = point.phi();
    let determinant = phi[(0, 0)] * phi[(1, 1)] - phi[(0, 1)] * phi[(1, 0)];
    let inverse = Matrix::<2>::new(phi[(1, 1)], -phi[(0, 1)], -phi[(1, 0)], phi[(0, 0)]);
    (determinant - 1.0).abs().max((inverse * velocity).trace().abs())
}

#[test]
fn the_incompressible_disc_by_every_method() {
    let run = |method| {
        Simulation::new(&IncompressibleDisc, disc()).until(10.0).every(0.37).tolerance(1e-13).method(method)
    };
    let exact = run(Method::Rattle { order: 8, step: 0.02 }).run().unwrap();
    for (method, accuracy) in [
        (Method::Automatic, 1e-11),
        (Method::RungeKutta8, 1e-11),
        (Method::Gauss { stages: 3, step: 0.05 }, 1e-6),
        (Method::Rattle { order: 6, step: 0.05 }, 1e-7),
    ] {
        let run = run(method).run().unwrap();
        for ((_, found), (_, expected)) in run.iter().zip(exact.iter()) {
            assert!(off(found) < 1e-14, "{method:?} {:e}", off(found));
            let error = (found.phi() - expected.phi()).norm() + (found.pi().0.0 - expected.pi().0.0).norm();
            assert!(error < accuracy, "{method:?} {error:e}");
        }
        let kept = run.conservation();
        assert!(kept.of(Conserved::Energy).unwrap().relative() < accuracy, "{method:?}");
    }
}

#[test]
fn rattle_says_what_it_keeps() {
    let method = Method::Rattle { order: 4, step: 0.1 };
    let run = Simulation::new(&IncompressibleDisc, disc()).until(5.0).method(method).run().unwrap();
    assert!(run.conservation().of(Conserved::Spin).unwrap().relative() < 1e-14);
    assert!(run.conservation().of(Conserved::Vorticity).unwrap().relative() < 1e-14);
    let why = run.why().to_string();
    assert!(why.contains("RATTLE of order 4, equal steps of at most 1e-1, det phi = 1 solved to"), "{why}");
    assert_eq!(run.computation().method, method);
    assert!(run.computation().residual.unwrap() < 1e-15);
}

#[test]
fn the_top_turns_on_its_group() {
    for method in [Method::Automatic, Method::RungeKutta8, Method::Gauss { stages: 2, step: 0.05 }] {
        let run = Simulation::new(&Top, top::start()).until(20.0).every(0.3).tolerance(1e-12).method(method);
        let run = run.run().unwrap();
        for (_, point) in run.iter() {
            let off = (point.phi().tr_mul(point.phi()) - Matrix::<3>::identity()).norm();
            assert!(off < 1e-14, "{method:?} {off:e}");
        }
        let spin = run.conservation().of(Conserved::Spin).unwrap().relative();
        let bound = if method == Method::Automatic || method == Method::RungeKutta8 { 1e-10 } else { 1e-4 };
        assert!(spin < bound, "{method:?} {spin:e}");
        let why = run.why().to_string();
        assert!(why.contains("steps on SO(n), in the Cayley chart around the placement"), "{why}");
    }
}

#[test]
fn settings_are_checked() {
    let setting = |method| {
        let halt = Simulation::new(&IncompressibleDisc, disc()).until(1.0).method(method).run().unwrap_err();
        (halt.stop.reason, halt.to_string())
    };
    let (reason, text) = setting(Method::Rattle { order: 3, step: 0.1 });
    assert_eq!(reason, Reason::Setting(Setting::Order { given: 3 }));
    assert!(text.contains("2, 4, 6 and 8"), "{text}");
    let (reason, _) = setting(Method::Rattle { order: 2, step: -0.1 });
    assert_eq!(reason, Reason::Setting(Setting::Step { given: -0.1, t0: 0.0, t_end: 1.0 }));

    let method = Method::Rattle { order: 2, step: 0.1 };
    let refused = Simulation::new(&Planar::SPRING, planar::start(0.1)).until(1.0).method(method).run();
    let halt = refused.unwrap_err();
    assert_eq!(halt.stop.reason, Reason::Setting(Setting::NotIsochoric { model: "Planar" }));
    assert!(halt.to_string().contains("constraint = isochoric"), "{halt}");

    let bulged: Drop = point_of(disc().phi() * 1.01, disc().sigma_hat(), Pinned);
    let halt = Simulation::new(&IncompressibleDisc, bulged).until(1.0).method(method).run().unwrap_err();
    assert!(
        matches!(halt.stop.reason, Reason::Setting(Setting::OffConstraint { defect }) if (defect - 0.0201).abs() < 1e-12)
    );
}

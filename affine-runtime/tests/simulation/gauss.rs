//! Simulations by Gauss collocation: what is kept, outputs, settings, refusals.

use affine_integrators::Statistics;
use affine_runtime::Simulation;
use affine_runtime::model::Conserved;
use affine_runtime::simulate::{Method, Reason, Setting};
use affine_runtime::state::Phase;

use crate::models::drunk_missile::{self, DrunkMissile};
use crate::models::planar::{self, Planar};
use crate::models::vibrating_body::{self, VibratingBody};

const fn gauss(stages: usize, step: f64) -> Method {
    Method::Gauss { stages, step }
}

#[test]
fn linear_and_quadratic_invariants_of_the_missile_are_kept() {
    // In x, phi, p_hat, Sigma_hat: H and |Vort|^2 are quadratic and Vort is linear, whatever the step. So is
    // p_hat - phi^T p for each p, and p = phi^-T p_hat stays. I = x p^T + Sigma is none of these: it shows the error
    // of the step.
    for stages in [2, 3] {
        let run =
            Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0).method(gauss(stages, 0.1));
        let run = run.run().unwrap();
        let conservation = run.conservation();
        let steps = run.statistics().steps as f64;
        assert_eq!(steps, 100.0);
        for quantity in
            [Conserved::Energy, Conserved::LinearMomentum, Conserved::Vorticity, Conserved::VorticityNorm]
        {
            let drift = conservation.of(quantity).unwrap().relative();
            assert!(drift < 8.0 * f64::EPSILON * steps.sqrt(), "{quantity:?} {drift:e}");
        }
        let error = conservation.of(Conserved::TotalAffineMomentum).unwrap().relative();
        assert!(error > 1e-10 && error < 1e-4, "{error:e}");
    }
}

#[test]
fn canonical_variables_keep_spin_and_vorticity() {
    // phi and Pi: spin phi Pi - (phi Pi)^T and vorticity are bilinear, the energy of the spring is quadratic.
    let run =
        Simulation::new(&Planar::SPRING, planar::start(0.1)).until(0.9).method(gauss(2, 0.1)).run().unwrap();
    assert!(run.conservation().worst() < 1e-15, "{}", run.conservation());
    let why = run.why().to_string();
    assert!(why.contains("Gauss collocation of 2 stages, order 4, equal steps of at most 1e-1"), "{why}");
    assert!(why.contains("symplectic: the reduced variables are canonical"), "{why}");
    assert!(run.computation().residual.unwrap() < 1e-15);
    let text = vibrating(2, 0.1, 1.0).run().unwrap().why().to_string();
    assert!(text.contains("not a Poisson map"), "{text}");
}

fn vibrating(stages: usize, step: f64, t_end: f64) -> Simulation<'static, 3, VibratingBody> {
    Simulation::new(&VibratingBody::BENCHMARK, vibrating_body::start())
        .until(t_end)
        .method(gauss(stages, step))
}

#[test]
fn energy_of_the_vibrating_body_does_not_grow() {
    // Neither quadratic nor canonical: the method is symmetric and the body reversible, and that is all. Errors of
    // S, which the steps do not keep, may grow; those of the energy oscillate.
    for (stages, steps, bound) in [(2, 10_000u32, 1e-6), (3, 10_000, 1e-9)] {
        let run = vibrating(stages, 0.1, 0.1 * f64::from(steps)).run().unwrap();
        assert_eq!(run.statistics().steps, u64::from(steps));
        let drift = *run.conservation().of(Conserved::Energy).unwrap();
        let drifts = run.relative_drifts(&drift);
        let largest = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
        let quarters: Vec<f64> = drifts[1..].chunks(drifts.len() / 4).map(largest).collect();
        assert!(quarters[0] > 1e-12, "the energy is no quadratic invariant: {quarters:?}");
        assert!(quarters[3] < 1.1 * quarters[0] && quarters[3] < bound, "{quarters:?}");
    }
}

#[test]
fn outputs_are_hit_and_leave_the_steps_alone() {
    let run = |times: &[f64]| vibrating(3, 0.1, 2.0).output(times.iter().copied()).run().unwrap();
    let (plain, watched) = (run(&[2.0]), run(&[0.0, 0.033, 0.05, 1.0, 1.234, 2.0]));
    assert_eq!(watched.times(), [0.0, 0.033, 0.05, 1.0, 1.234, 2.0]);
    assert_eq!(plain.end(), watched.end());
    assert!(plain.statistics().evaluations < watched.statistics().evaluations);
    let precise =
        Simulation::new(&VibratingBody::BENCHMARK, vibrating_body::start()).until(2.0).tolerance(1e-14);
    let precise = precise.output(watched.times().to_vec()).run().unwrap();
    for ((t, found), (_, expected)) in watched.iter().zip(precise.iter()) {
        let error = (found.phi() - expected.phi()).norm();
        assert!(error < 1e-7, "{t}: {error:e}");
    }
    // Without output times: at the steps.
    let steps = vibrating(3, 0.3, 1.0).run().unwrap();
    assert_eq!((steps.len(), steps.times()[4]), (5, 1.0));
}

#[test]
fn stiff_bodies_take_newton_and_evaluations_are_counted() {
    let stiff = VibratingBody { kappa: 1e6, ..VibratingBody::BENCHMARK };
    let run = |method| {
        Simulation::new(&stiff, vibrating_body::start())
            .until(1.0)
            .method(method)
            .output([1.0])
            .run()
            .unwrap()
    };
    let run = run(gauss(3, 0.01));
    assert!(run.computation().residual.unwrap() < 1e-9);
    // Where the target fuses multiply-adds, iterations end elsewhere.
    let evaluations = if cfg!(target_feature = "fma") { 4912 } else { 4816 };
    assert_eq!(run.statistics(), Statistics { steps: 100, evaluations, ..Statistics::default() });
}

#[test]
fn settings_are_checked() {
    let refused = |method| vibrating(2, 0.1, 1.0).method(method).run().unwrap_err().stop.reason;
    for given in [0, 1, 5, 7] {
        assert_eq!(refused(gauss(given, 0.1)), Reason::Setting(Setting::Stages { given }));
    }
    for given in [0.0, -0.1, f64::INFINITY, 1e-17] {
        assert_eq!(refused(gauss(2, given)), Reason::Setting(Setting::Step { given, t0: 0.0, t_end: 1.0 }));
    }
    assert!(matches!(refused(gauss(2, f64::NAN)), Reason::Setting(Setting::Step { .. })));
    assert_eq!(
        vibrating(2, 0.1, 1.0).max_steps(4).run().unwrap_err().stop.reason,
        Reason::StepLimit { limit: 4 }
    );
}

#[test]
fn steps_without_solution_halt_the_run() {
    let halt = vibrating(3, 1000.0, 1000.0).run().unwrap_err();
    assert!(matches!(halt.stop.reason, Reason::NoSolution { residual, step: 1000.0 } if residual > 1e-10));
    assert_eq!((halt.stop.t, halt.stop.steps), (0.0, 0));
    assert!(halt.to_string().contains("shorten the step"));
}

//! Checkpoints of other runs.

use core::ops::ControlFlow;

use affine_runtime::prelude::*;
use affine_runtime::simulate::{Checkpoint, Reason, Setting};

use crate::sweep::{Ask, Outputs, Sweep, refused, sound, sweep, within_patience};

/// That of a run which ends after its first step, or output.
fn checkpoint<const N: usize, M: Model<N>>(simulation: Simulation<'_, N, M>) -> Checkpoint {
    let halt = simulation.progress(|_| ControlFlow::Break(())).run().unwrap_err();
    halt.trajectory.checkpoint().unwrap_or_else(|| panic!("{}: {halt}", M::DESCRIPTION.name)).clone()
}

struct Changed;

impl Sweep for Changed {
    fn over<const N: usize, M: Model<N>>(&self, model: &M, start: M::Point<f64>, methods: &[Method]) {
        let of_another = |simulation: Simulation<'_, N, M>, checkpoint: &Checkpoint, label: String| {
            let words = ["checkpoint is not of this run", M::DESCRIPTION.name, "outputs"];
            let reason = refused(simulation.resume(checkpoint), &words, &label);
            assert_eq!(reason, Reason::Setting(Setting::Checkpoint { model: M::DESCRIPTION.name }));
        };
        let asked = Ask { outputs: Outputs::Every(0.1), ..sound() };
        for &method in methods {
            let kept = checkpoint(asked.of(model, start, method));
            let Ask { tolerance, until, .. } = sound();
            for other in [
                Ask { tolerance: 2.0 * tolerance, ..asked.clone() },
                Ask { until: 2.0 * until, ..asked.clone() },
                Ask { from: 1e-3, ..asked.clone() },
                Ask { outputs: Outputs::Every(0.2), ..asked.clone() },
                Ask { outputs: Outputs::Steps, ..asked.clone() },
                Ask { outputs: Outputs::At(vec![0.1, 0.2]), ..asked.clone() },
            ] {
                of_another(other.of(model, start, method), &kept, format!("{method:?}: {other:?}"));
            }
            let event = Event::new("another", |t, _: &M::Point<f64>| t - 0.2);
            of_another(asked.of(model, start, method).event(event), &kept, format!("{method:?}: an event"));
            for &other in methods.iter().filter(|other| **other != method) {
                of_another(asked.of(model, start, other), &kept, format!("{method:?}: {other:?}"));
            }
            // One component of the start, by one rounding.
            for k in 0..model.flatten(&start).as_ref().len() {
                let mut full = model.flatten(&start);
                full.as_mut()[k] = full.as_ref()[k].next_up();
                let other = model.unflatten(&full);
                of_another(asked.of(model, other, method), &kept, format!("{method:?}: component {k}"));
            }
            // The largest number of steps is free.
            let more = Ask { max_steps: 5000, ..asked.clone() };
            let rest = more.of(model, start, method).resume(&kept).run().unwrap();
            let whole = asked.of(model, start, method).run().unwrap();
            assert_eq!(rest.end(), whole.end(), "{method:?}");
        }
    }
}

#[test]
fn with_other_settings() {
    sweep(Changed);
}

#[affine_model(
    dim = 2,
    kinetic(casimir2 = a, body_inertia = 1, body_translation = m),
    potential = kappa/2*q^2 + pairs(c*d^2) + g*x[2]*t,
    dissipation(casimir2 = r, body_inertia = r),
)]
#[derive(Clone, Copy)]
struct Damped {
    a: f64,
    m: f64,
    kappa: f64,
    c: f64,
    g: f64,
    r: f64,
}

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2))]
struct Another;

/// At rest and undeformed, where no parameter makes itself felt.
#[test]
fn with_other_parameters_and_of_another_model() {
    within_patience(|| {
        let good = Damped { a: 0.2, m: 2.0, kappa: 10.0, c: 0.5, g: 1.0, r: 0.1 };
        let rest = |body: &PreparedDamped| {
            let (x, zero) = (Vector::<2>::zeros(), Matrix::<2>::zeros());
            body.at_momentum(x, Matrix::<2>::identity(), x, Comoving(zero)).unwrap()
        };
        let model = good.prepare().unwrap();
        let start = rest(&model);
        let kept = checkpoint(sound().of(&model, start, Method::RungeKutta8));
        let changed: [fn(&mut Damped); 6] =
            [|b| b.a = 0.3, |b| b.m = 2.5, |b| b.kappa = 11.0, |b| b.c = 0.6, |b| b.g = -1.0, |b| b.r = 0.2];
        for (k, change) in changed.into_iter().enumerate() {
            let mut other = good;
            change(&mut other);
            let other = other.prepare().unwrap();
            let run = sound().of(&other, start, Method::RungeKutta8).resume(&kept);
            refused(run, &["checkpoint is not of this run", "its parameters"], &format!("parameter {k}"));
        }
        let (x, phi, spin) = (start.x(), *start.phi(), start.sigma_hat());
        let start = Another.at_momentum(x, phi, x, spin).unwrap();
        let run = sound().of(&Another, start, Method::RungeKutta8).resume(&kept);
        refused(run, &["checkpoint is not of this run of Another"], "another model");
        let again = sound().of(&model, rest(&model), Method::RungeKutta8).resume(&kept);
        assert_eq!(again.run().unwrap().end().0, 0.5);
    });
}

//! Integrators called by hand, variations, and reports: what a simulation keeps from them.

use affine_integrators::gauss::Tableau;
use affine_integrators::{Failure, Gauss, RungeKutta5, RungeKutta8};
use affine_runtime::Error;
use affine_runtime::model::{Group, Quantity};
use affine_runtime::prelude::*;
use affine_runtime::report::WorkPrecision;
use affine_runtime::report::reference_solution;
use affine_runtime::simulate::{Reason, Setting};
use affine_runtime::variation::Variation;

use crate::sweep::{STEP, within_patience};
use affine_tests::models;

const NO_NUMBERS: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
const GROUPS: &[Group] = &[Group::new(Quantity::MeanLogStretch, 1), Group::new(Quantity::LinearMomentum, 1)];

fn spring(_: f64, y: &[f64; 2]) -> [f64; 2] {
    [y[1], -y[0]]
}

#[test]
fn integrators_by_hand() {
    within_patience(|| {
        let eight = |t0, y, t_end, eps| RungeKutta8::new(spring, GROUPS, (t0, y), t_end, eps).map(|_| ());
        let five = |t0, y, t_end, eps| RungeKutta5::new(spring, GROUPS, (t0, y), t_end, eps).map(|_| ());
        type New<'n> = &'n dyn Fn(f64, [f64; 2], f64, f64) -> Result<(), Failure>;
        let begun: [New<'_>; 2] = [&eight, &five];
        for new in begun {
            assert_eq!(new(0.0, [1.0, 0.0], 1.0, 1e-9), Ok(()));
            for tolerance in [0.0, -1e-9].into_iter().chain(NO_NUMBERS) {
                let failure = new(0.0, [1.0, 0.0], 1.0, tolerance).unwrap_err();
                assert!(failure.to_string().contains(&format!("tolerance {tolerance:e}")), "{failure}");
            }
            for t in NO_NUMBERS {
                for (t0, t_end) in [(t, 1.0), (0.0, t)] {
                    let failure = new(t0, [1.0, 0.0], t_end, 1e-9).unwrap_err();
                    assert!(failure.to_string().contains(&format!("is {t}: times are finite")), "{failure}");
                }
                assert_eq!(new(0.0, [1.0, t], 1.0, 1e-9), Err(Failure::NotFinite));
            }
        }
        let tableau = Tableau::of_stages(2).unwrap();
        let gauss = |t0, y, t_end, step| Gauss::new(spring, tableau, (t0, y), t_end, step).map(|_| ());
        for t in NO_NUMBERS {
            assert!(matches!(gauss(t, [1.0, 0.0], 1.0, 0.1), Err(Failure::Time { .. })));
            assert!(matches!(gauss(0.0, [1.0, 0.0], t, 0.1), Err(Failure::Time { .. })));
            assert_eq!(gauss(0.0, [t, 0.0], 1.0, 0.1), Err(Failure::NotFinite));
        }
        for step in [0.0, -0.1, 1e-300, f64::NAN, f64::NEG_INFINITY, f64::INFINITY] {
            let refused = gauss(0.0, [1.0, 0.0], 1.0, step).unwrap_err();
            assert!(
                matches!(refused, Failure::Step { given, .. } if given.to_bits() == step.to_bits()),
                "{refused}"
            );
        }
    });
}

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = (tr(G) - 2 - 2*ln(det))/2, emit(tangent))]
struct Varied;

#[test]
fn variations() {
    within_patience(|| {
        let spin = Matrix::<2>::new(0.3, 0.5, -0.4, 0.1);
        let start = Varied.at_momentum(Matrix::<2>::identity(), Comoving(spin)).unwrap();
        let along = |k: usize, value: f64| {
            let mut direction = [0.0; 8];
            direction[k] = value;
            direction
        };
        for tolerance in [0.0, -1e-9].into_iter().chain(NO_NUMBERS) {
            let refused =
                Variation::new(&Varied, (0.0, &start), &along(4, 1.0), tolerance).map(|v| v.t()).unwrap_err();
            assert!(refused.to_string().contains(&format!("tolerance {tolerance:e}")), "{refused}");
        }
        for t in NO_NUMBERS {
            let refused =
                Variation::new(&Varied, (t, &start), &along(4, 1.0), 1e-9).map(|v| v.t()).unwrap_err();
            assert!(matches!(refused, Failure::Time { .. }), "{refused}");
            let mut variation = Variation::new(&Varied, (0.0, &start), &along(4, 1.0), 1e-9).unwrap();
            assert!(matches!(variation.advance_to(t), Err(Failure::Time { .. })));
            assert_eq!(variation.t(), 0.0, "it stays where it was");
            let refused = Variation::new(&Varied, (0.0, &start), &along(4, t), 1e-9).map(|v| v.t());
            assert_eq!(refused.unwrap_err(), Failure::NotFinite);
        }
    });
}

#[test]
fn reports() {
    within_patience(|| {
        let served = models::vibrating(STEP);
        let report = |until: f64| WorkPrecision::new(&served.model, served.start, until).repeats(1);
        let setting = |report: WorkPrecision<'_, 2, _>| match report.run() {
            Err(Error::Stopped(stop)) => match stop.reason {
                Reason::Setting(setting) => setting,
                reason => panic!("{reason}"),
            },
            other => panic!("{other:?}"),
        };
        for t in NO_NUMBERS {
            assert!(matches!(setting(report(t)), Setting::Time { .. }));
            assert!(matches!(setting(report(0.5).from(t)), Setting::Time { .. }));
            let refused = reference_solution(&served.model, &served.start, (0.0, t));
            assert_eq!(refused.err(), Some(Error::NoReference { model: "Vibrating" }));
        }
        for tolerance in [0.0, -1e-6, 1e-30, f64::NAN] {
            assert!(matches!(setting(report(0.5).tolerances([1e-6, tolerance])), Setting::Tolerance { .. }));
        }
        let bad = Method::Gauss { stages: 2, step: f64::NAN };
        assert!(matches!(setting(report(0.5).methods([bad])), Setting::Step { .. }));
    });
}

/// Thrown against a wall that is a thousand times thinner than the way there.
#[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = orthogonality(1) + exp(-k*x[1]))]
#[derive(Clone)]
struct AtWall {
    k: f64,
}

/// Behind the wall the exponential overflows: the body is gone, and the placement, which is none the worse for it, comes last.
#[test]
fn a_reference_has_numbers() {
    within_patience(|| {
        for k in [30.0, 1e4, 1e6] {
            let model = AtWall { k }.prepare().unwrap();
            let turning = Matrix::<2>::new(0.0, -0.1, 0.1, 0.0);
            let (x, v) = (Vector::<2>::new(0.5, 0.0), Vector::<2>::new(-1.0, 0.0));
            let start = model.at_velocity(x, Matrix::<2>::identity(), v, turning).unwrap();
            match reference_solution(&model, &start, (0.0, 1.2)) {
                // All the energy that the wall took is given back but `exp(-k x)` of it.
                Ok(end) => assert!((end.p()[0] - 1.0).abs() < 1e-5, "{k:e}: {}", end.p()),
                Err(error) => assert_eq!(error, Error::NoReference { model: "AtWall" }, "{k:e}"),
            }
        }
    });
}

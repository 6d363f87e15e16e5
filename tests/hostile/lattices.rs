//! The lattice of stretches and RATTLE, with input that makes no sense.

use affine_integrators::Failure;
use affine_runtime::frames::{Matrix, Vector};
use affine_runtime::lattice::{CircleFlow, Lattice, LatticeFlow, LatticeSplitting, StopReason};
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Setting};

use crate::sweep::{sound, within_patience};
use affine_tests::models::{Droplet, Springs, Top};

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), emit(two_polar, splitting))]
struct Disc;

#[affine_model(dim = 2, group = unitary, kinetic(casimir2 = 0.2), emit(splitting))]
struct Circle;

fn start() -> Lattice<2> {
    let skew = |m: f64| Matrix::<2>::new(0.0, m, -m, 0.0);
    let unit = Matrix::<2>::identity();
    let (q, p) = (Vector::<2>::new(0.5, -0.3), Vector::<2>::new(0.3, -0.2));
    Lattice { q, p, m: skew(0.5), n: skew(0.6), left: unit, right: unit }
}

const NO_NUMBERS: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// The same for both flows.
macro_rules! flows {
    ($advanced:expr) => {
        for tolerance in [0.0, -1e-6, 5e-324, 1e-30, 1.0].into_iter().chain(NO_NUMBERS) {
            let stop = $advanced(0.0, start(), tolerance, 0.5).unwrap_err();
            assert!(stop.to_string().contains(&format!("tolerance {tolerance:e}")), "{stop}");
            assert!(matches!(stop.reason, StopReason::Tolerance { .. }) && stop.lattice == start());
        }
        for t in NO_NUMBERS {
            let stop = $advanced(0.0, start(), 1e-9, t).unwrap_err();
            assert!(stop.to_string().contains("t is not finite"), "{stop}");
            let stop = $advanced(t, start(), 1e-9, 0.5).unwrap_err();
            assert!(matches!(stop.reason, StopReason::Integration(Failure::Time { .. })), "{stop}");
            assert!(stop.to_string().contains(&format!("is {t}")), "{stop}");
        }
        for lattice in spoilt() {
            let stop = $advanced(0.0, lattice, 1e-9, 0.5).unwrap_err();
            assert!(stop.to_string().contains("not finite"), "{stop}");
        }
        assert_eq!($advanced(0.5, start(), 1e-9, 0.5).unwrap(), start(), "no time");
        let there = $advanced(0.0, start(), 1e-13, -0.5).unwrap();
        let back = $advanced(-0.5, there, 1e-13, 0.0).unwrap();
        assert!((back.q - start().q).norm() < 1e-11, "backward and forward");
    };
}

fn spoilt() -> Vec<Lattice<2>> {
    let mut list = Vec::new();
    for bad in NO_NUMBERS {
        let mut change = |with: &dyn Fn(&mut Lattice<2>)| {
            let mut lattice = start();
            with(&mut lattice);
            list.push(lattice);
        };
        change(&|l| l.q[0] = bad);
        change(&|l| l.p[1] = bad);
        change(&|l| (l.m[(0, 1)], l.m[(1, 0)]) = (bad, -bad));
        change(&|l| (l.n[(0, 1)], l.n[(1, 0)]) = (bad, -bad));
    }
    list
}

#[test]
fn flow_of_the_lattice() {
    within_patience(|| {
        flows!(|t0: f64, lattice: Lattice<2>, tolerance: f64, t: f64| {
            LatticeFlow::new(&Disc, t0, lattice).tolerance(tolerance).advance_to(t).copied()
        });
    });
}

#[test]
fn flow_on_the_circle() {
    within_patience(|| {
        flows!(|t0: f64, lattice: Lattice<2>, tolerance: f64, t: f64| {
            CircleFlow::new(&Circle, t0, lattice).tolerance(tolerance).advance_to(t).copied()
        });
    });
}

#[test]
fn lattice_by_splitting() {
    within_patience(|| {
        let begun = |order, (t0, lattice), t_end, step| {
            LatticeSplitting::new(&Disc, order, (t0, lattice), t_end, step)
                .map(|run| run.and_then(|mut run| run.finish()).map_err(|stop| stop.reason))
        };
        for order in [0, 1, 3, 10, usize::MAX] {
            assert!(begun(order, (0.0, start()), 0.5, 0.1).is_none(), "{order}");
        }
        for order in [2, 4, 6, 8] {
            for step in [0.0, -0.1, 1e-300, f64::NAN, f64::NEG_INFINITY, f64::INFINITY] {
                let refused = begun(order, (0.0, start()), 0.5, step).unwrap().unwrap_err();
                let message = refused.to_string();
                assert!(message.contains(&format!("a step of {step:e} between 0 and 0.5")), "{message}");
                assert!(matches!(refused, StopReason::Integration(Failure::Step { .. })), "{message}");
            }
            for t in NO_NUMBERS {
                for (t0, t_end) in [(t, 0.5), (0.0, t)] {
                    let refused = begun(order, (t0, start()), t_end, 0.1).unwrap().unwrap_err();
                    assert!(matches!(refused, StopReason::Integration(Failure::Time { .. })), "{refused}");
                }
            }
            for lattice in spoilt() {
                let refused = begun(order, (0.0, lattice), 0.5, 0.1).unwrap().unwrap_err();
                assert!(
                    matches!(refused, StopReason::Integration(Failure::NotFinite)),
                    "{refused}: {lattice:?}"
                );
            }
            assert_eq!(begun(order, (0.5, start()), 0.5, 0.1).unwrap().unwrap().q, start().q, "no time");
        }
    });
}

/// A start off the constraint, and models that it does not serve.
#[test]
fn rattle() {
    within_patience(|| {
        for order in [2, 4, 6, 8] {
            let method = Method::Rattle { order, step: 0.01 };
            let (x, v) = (Vector::<2>::zeros(), Vector::<2>::new(0.2, 0.5));
            // Of a traceless momentum the last entry follows from the first.
            let start = |phi: Matrix<2>, [a, b, c]: [f64; 3]| {
                let [[e, f], [g, h]] = [[phi[(0, 0)], phi[(0, 1)]], [phi[(1, 0)], phi[(1, 1)]]];
                Droplet.unflatten(&[x[0], x[1], e, f, g, h, v[0], v[1], a, b, c])
            };
            let named: Vec<&str> = Droplet::DESCRIPTION.full.iter().map(|group| group.name()).collect();
            assert_eq!(named, ["x", "phi", "p", "Sigma_hat"]);
            let unit = Matrix::<2>::identity();
            for spin in [[0.0; 3], [1.0, 0.5, -0.5]] {
                let halt = sound().of(&Droplet, start(unit * 1.1, spin), method).run().unwrap_err();
                let Reason::Setting(Setting::OffConstraint { defect }) = halt.stop.reason else {
                    panic!("{halt}")
                };
                assert!(defect > 0.1 && halt.to_string().contains(&format!("{defect:e}")), "{halt}");
            }
            // The energy of a motion as fast as this is no number.
            let fast = start(unit, [0.0, 1e200, 1e200]);
            let halt = sound().of(&Droplet, fast, method).run().unwrap_err();
            assert!(matches!(halt.stop.reason, Reason::Energy { t: 0.0, .. }), "{halt}");
            let refused = |reason| {
                let Reason::Setting(Setting::NotIsochoric { model }) = reason else { panic!("{reason:?}") };
                model
            };
            let p = Springs.at_velocity(x, unit, v, unit).unwrap();
            assert_eq!(refused(sound().of(&Springs, p, method).run().unwrap_err().stop.reason), "Springs");
            let (x, unit) = (Vector::<3>::zeros(), Matrix::<3>::identity());
            let p = Top.at_velocity(x, unit, x, Matrix::<3>::zeros()).unwrap();
            assert_eq!(refused(sound().of(&Top, p, method).run().unwrap_err().stop.reason), "Top");
        }
    });
}

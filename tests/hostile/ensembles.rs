//! Ensembles with bodies and settings that make no sense.

use affine_runtime::capability::InLanes;
use affine_runtime::lanes::{F64x8, Lanes};
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Ends, Reason, Setting};

use crate::sweep::within_patience;

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2),
    potential = harmonic_dilatation(10) + neo_hookean(0.5),
    emit(lanes),
)]
struct Disc;

/// Integrated one by one.
#[affine_model(dim = 2, constraint = isochoric, kinetic(casimir2 = 0.2, body_inertia = 1), potential = tr(G)/2, emit(lanes))]
struct Confined;

/// More than there are lanes.
const BODIES: usize = F64x8::LANES + 3;

fn turned(k: usize) -> Matrix<2> {
    let (sine, cosine) = (0.1 * k as f64).sin_cos();
    Matrix::<2>::new(cosine, -sine, sine, cosine)
}

fn discs() -> Vec<<Disc as Model<2>>::Point<f64>> {
    let spin = Matrix::<2>::new(0.3, -0.2, 0.5, 0.1);
    let (x, p) = (Vector::<2>::zeros(), Vector::<2>::new(0.2, 0.5));
    let start = |k| Disc.at_momentum(x, turned(k) * 1.1, p, Comoving(spin)).unwrap();
    (0..BODIES).map(start).collect()
}

fn confined() -> Vec<<Confined as Model<2>>::Point<f64>> {
    let spin = Matrix::<2>::new(0.3, -0.2, 0.5, -0.3);
    (0..BODIES).map(|k| Confined.at_momentum(turned(k), Comoving(spin)).unwrap()).collect()
}

fn ends<M: InLanes<2> + Sync>(model: &M, starts: Vec<M::Point<f64>>) -> Ends<M::Point<f64>>
where
    M::Point<f64>: Send + Sync,
{
    Ensemble::new(model, starts).until(0.5).tolerance(1e-9).max_steps(1000).run().unwrap()
}

/// One bad body, of each kind, in each of some places: its outcome is in its place, and all others keep their bits.
fn one_bad_body<M: InLanes<2> + Sync>(model: &M, good: &[M::Point<f64>])
where
    M::Point<f64>: Send + Sync,
{
    let entries = |point: &M::Point<f64>| {
        let mut list = Vec::new();
        point.entries(&mut |entry| list.push(entry));
        list
    };
    let with = |point: &M::Point<f64>, k: usize, bad: f64| {
        let mut list = entries(point);
        list[k] = bad;
        let mut list = list.into_iter();
        point.with_entries(&mut || list.next().unwrap())
    };
    let alone = ends(model, good.to_vec());
    assert!(alone.iter().all(Result::is_ok));
    let components = entries(&good[0]).len();
    let mut bad: Vec<(M::Point<f64>, Option<f64>)> = Vec::new();
    for k in 0..components {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            bad.push((with(&good[0], k, value), None));
        }
    }
    // The first four are phi.
    let placed = |phi: [f64; 4]| (0..4).fold(good[0], |point, k| with(&point, k, phi[k]));
    bad.push((placed([0.0; 4]), Some(0.0)));
    bad.push((placed([1.0, 2.0, 2.0, 4.0]), Some(0.0)));
    bad.push((placed([-1.0, 0.0, 0.0, 1.0]), Some(-1.0)));
    // A pinned body has neither x nor p to spoil.
    bad.retain(|(bad, _)| *bad != good[0]);
    for (kind, (bad, determinant)) in bad.into_iter().enumerate() {
        let place = [0, 1, F64x8::LANES - 1, F64x8::LANES, BODIES - 1][kind % 5];
        let mut starts = good.to_vec();
        starts[place] = bad;
        let ends = ends(model, starts);
        assert_eq!(ends.len(), BODIES);
        for (k, (end, expected)) in ends.iter().zip(&alone).enumerate() {
            if k != place {
                assert_eq!(end, expected, "body {k} beside {place}, kind {kind}");
                continue;
            }
            let Err(stop) = end else { panic!("kind {kind}: {end:?}") };
            match (stop.reason, determinant) {
                (Reason::NotFinite, None) => {}
                (Reason::Placement { determinant, rate: None, t: 0.0 }, Some(expected)) => {
                    assert_eq!(determinant, expected)
                }
                _ => panic!("{kind}: {stop}"),
            }
            assert_eq!((stop.t, stop.steps), (0.0, 0), "{kind}");
        }
    }
}

#[test]
fn with_one_bad_body() {
    within_patience(|| {
        one_bad_body(&Disc, &discs());
        one_bad_body(&Confined, &confined());
    });
}

/// Refused as a whole, with bodies and without.
#[test]
fn with_bad_settings() {
    within_patience(|| {
        for starts in [discs(), Vec::new()] {
            let ensemble = || Ensemble::new(&Disc, starts.clone()).until(0.5);
            for tolerance in [0.0, -1e-6, 1e-30, 5e-324, 1.0, f64::INFINITY, f64::NAN] {
                let refused = ensemble().tolerance(tolerance).run().unwrap_err();
                assert!(
                    matches!(refused, Setting::Tolerance { given } if given.to_bits() == tolerance.to_bits())
                );
                assert!(refused.to_string().contains(&format!("tolerance {tolerance:e}")));
            }
            for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert!(matches!(ensemble().until(t).run().unwrap_err(), Setting::Time { .. }), "{t}");
                assert!(matches!(ensemble().from(t).run().unwrap_err(), Setting::Time { .. }), "{t}");
            }
            let far = ensemble().from(-1e308).until(1e308).run().unwrap_err();
            assert_eq!(far, Setting::Interval { t0: -1e308, t_end: 1e308 });
            assert_eq!(ensemble().max_steps(0).run().unwrap_err(), Setting::NoSteps);
            assert_eq!(Ensemble::new(&Disc, starts.clone()).run().unwrap_err(), Setting::NoEnd);
        }
        assert_eq!(Ensemble::new(&Disc, []).until(0.5).run().unwrap(), Vec::new());
    });
}

/// No length, one that rounding hardly tells, and one that nobody comes to the end of.
#[test]
fn over_extreme_intervals() {
    within_patience(|| {
        let starts = discs();
        let over = |from: f64, until: f64| {
            let ensemble = Ensemble::new(&Disc, starts.clone()).from(from).until(until);
            ensemble.tolerance(1e-9).max_steps(20).run().unwrap()
        };
        for (end, start) in over(3.0, 3.0).iter().zip(&starts) {
            assert_eq!(end.as_ref().unwrap(), start);
        }
        for (from, until) in
            [(1e6, 1e6_f64.next_up()), (1e6, 1e6_f64.next_down()), (0.0, 1e-300), (0.0, -1e-300)]
        {
            for (end, start) in over(from, until).iter().zip(&starts) {
                assert!((end.as_ref().unwrap().phi() - start.phi()).norm() < 1e-8, "{from} {until:e}");
            }
        }
        for until in [1e308, -1e308] {
            assert!(
                over(0.0, until)
                    .iter()
                    .all(|end| end.as_ref().unwrap_err().reason == Reason::StepLimit { limit: 20 })
            );
        }
    });
}

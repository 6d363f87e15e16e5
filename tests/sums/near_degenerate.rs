//! Motions that come near a placement at which the mass matrix degenerates, and do not reach it.

use affine_oracle::Random;
use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

/// Driven and damped, with a mass matrix that is `m 1 + c (...)` in the co-moving frame: it degenerates where the body is thin.
#[affine_model(
    dim = 2,
    kinetic(dalembert = m, casimir2 = c),
    potential = k*(tr(G) - 2)^2/8 + h*cos(w*t)*tr(G)/2,
    dissipation(space_inertia = v)
)]
struct Sum {
    m: f64,
    c: f64,
    k: f64,
    h: f64,
    w: f64,
    v: f64,
}

/// Seeds of random bodies that go through at 1e-13, picked because steps of a tolerance of 1e-2, 1e-3 or 1e-4 lead them onto a
/// degenerate placement.
const NEAR: [u64; 46] = [
    8, 60, 309, 364, 373, 388, 415, 471, 499, 604, 621, 740, 756, 861, 873, 891, 993, 996, 1078, 1079, 1181,
    1187, 1209, 1266, 1268, 1271, 1339, 1362, 1405, 1513, 1610, 1696, 1863, 1987, 2025, 2112, 2137, 2178,
    2378, 2442, 2539, 2552, 2605, 2632, 2650, 2672,
];
/// Looser tolerances than this are not taken.
const TOLERANCE: f64 = 1e-6;
/// Comes within 1e-10 of a degenerate placement, where rounding decides on which side it passes.
const DECIDED_BY_ROUNDING: u64 = 309;

#[test]
fn what_only_passes_near_goes_through_at_every_tolerance() {
    for seed in NEAR {
        let mut random = Random::new(9100 + seed);
        let mut draw = |a: f64, b: f64| a + (b - a) * random.state(2).phi.to_f64()[0].abs().fract();
        let model = Sum {
            m: draw(0.5, 2.0),
            c: -draw(0.02, 0.5),
            k: draw(0.5, 4.0),
            h: draw(0.0, 1.0),
            w: draw(1.0, 6.0),
            v: draw(0.0, 0.3),
        };
        let model = model.prepare().unwrap();
        let phi = Matrix::<2>::new(draw(0.9, 1.5), draw(0.0, 0.4), draw(0.0, 0.4), draw(0.9, 1.5));
        let phi_dot = Matrix::<2>::new(-draw(0.0, 0.8), draw(0.0, 0.6), -draw(0.0, 0.6), -draw(0.0, 0.8));
        let start = model.at_velocity(phi, phi_dot).unwrap();
        let run = |tolerance: f64| Simulation::new(&model, start).until(3.0).tolerance(tolerance).run();
        let runs = [1e-13, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6].map(|tolerance| (tolerance, run(tolerance)));
        if seed == DECIDED_BY_ROUNDING {
            let halts = runs.iter().filter_map(|(_, run)| run.as_ref().err());
            halts.for_each(|halt| {
                assert!(matches!(halt.stop.reason, Reason::Degenerate { .. }), "{}", halt.stop)
            });
            continue;
        }
        let ends = runs.map(|(tolerance, run)| {
            let run = run.unwrap_or_else(|halt| panic!("{seed} at {tolerance:e}: {}", halt.stop));
            assert_eq!(
                run.why().to_string().contains("in place of"),
                tolerance > TOLERANCE,
                "{seed} at {tolerance:e}"
            );
            *run.end().1.phi()
        });
        for coarse in &ends[1..] {
            let distance = (coarse - ends[0]).norm();
            assert!(distance < 1e-2, "{seed}: {distance:e}");
        }
    }
}

//! Errors against references, with what they cost.

use affine_runtime::Simulation;
use affine_runtime::frames::Matrix;
use affine_runtime::state::Phase;

use crate::models::drunk_missile::{self, DrunkMissile};
use crate::models::vibrating_body::{self, VibratingBody};
use crate::reference;

#[test]
fn scratch() {
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12, 1e-13, 1e-14, 1e-15] {
        let (t, state) = reference::DRUNK_MISSILE[1];
        let run = Simulation::new(&DrunkMissile, drunk_missile::start())
            .until(t)
            .tolerance(tolerance)
            .run()
            .unwrap();
        let phi = Matrix::<3>::from_row_slice(&state[3..12]);
        let spin = Matrix::<3>::from_row_slice(&state[15..]);
        let e = run.end().1;
        println!(
            "P1 {tolerance:e} {:?} phi {:e} spin {:e}",
            run.statistics(),
            (e.phi() - phi).norm() / phi.norm(),
            (e.sigma_hat().0.0 - spin).norm() / spin.norm()
        );
        for (t, state) in reference::VIBRATING_BODY {
            let run = Simulation::new(&VibratingBody::BENCHMARK, vibrating_body::start())
                .until(t)
                .tolerance(tolerance)
                .run()
                .unwrap();
            let phi = Matrix::<3>::from_row_slice(&state[..9]);
            let spin = Matrix::<3>::from_row_slice(&state[9..]);
            let e = run.end().1;
            println!(
                "P2 {t} {tolerance:e} {:?} phi {:e} spin {:e}",
                run.statistics(),
                (e.phi() - phi).norm() / phi.norm(),
                (e.sigma_hat().0.0 - spin).norm() / spin.norm()
            );
        }
    }
    let run =
        Simulation::new(&DrunkMissile, drunk_missile::start()).until(10.0).tolerance(1e-12).run().unwrap();
    println!("{}{}", run.conservation(), run.why());
}

#[test]
fn rest() {
    use affine_runtime::__private::unchecked_point;
    use affine_runtime::state::Pinned;
    let (s, c) = 0.7f64.sin_cos();
    let (s2, c2) = 0.3f64.sin_cos();
    let turn = Matrix::<3>::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
        * Matrix::<3>::new(1.0, 0.0, 0.0, 0.0, c2, -s2, 0.0, s2, c2);
    for (kappa, c1) in [(10.0, 0.5), (1e6, 0.5), (10.0, 1e4)] {
        for amp in [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3] {
            let m = VibratingBody { kappa, c1, ..VibratingBody::BENCHMARK };
            let phi = turn
                * (Matrix::<3>::identity()
                    + Matrix::<3>::new(1.0, 0.5, 0.3, 0.1, -0.4, 0.2, 0.0, 0.3, 0.6) * amp);
            let start = unchecked_point(phi, Matrix::<3>::zeros(), Pinned);
            let run = Simulation::new(&m, start)
                .until(if kappa > 1e3 { 1.0 } else { 10.0 })
                .tolerance(1e-12)
                .max_steps(3000)
                .run();
            match run {
                Ok(r) => {
                    println!("{kappa} {c1} {amp:e}: {:?} {:e}", r.statistics(), r.conservation().worst())
                }
                Err(h) => println!("{kappa} {c1} {amp:e}: {h} {:?}", h.trajectory.statistics()),
            }
        }
    }
}

//! Runs against the references, at all tolerances.

use affine_runtime::model::Model;
use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;
use affine_runtime::state::Phase;

use crate::models::{Bulk, Driven, Spring, Viscous};

const TOLERANCES: [f64; 7] = [1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// What a row of a reference holds.
struct Row<const N: usize> {
    t: f64,
    phi: Matrix<N>,
    spin: Matrix<N>,
    energy: f64,
    work: f64,
}

fn rows<const N: usize>(data: &str) -> Vec<Row<N>> {
    let lines = data.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines
        .map(|line| {
            let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
            let matrix = |from: usize| Matrix::<N>::from_row_slice(&numbers[from..from + N * N]);
            let energy = numbers[1 + 2 * N * N];
            Row {
                t: numbers[0],
                phi: matrix(1),
                spin: matrix(1 + N * N),
                energy,
                work: numbers[2 + 2 * N * N],
            }
        })
        .collect()
}

/// A model with a start for a row, and its reference.
struct Problem<'a, const N: usize, M: Model<N>> {
    name: &'static str,
    model: &'a M,
    start: M::Point<f64>,
    rows: Vec<Row<N>>,
}

/// The most that errors may be, in tolerances, with a part of the energy that rounding takes at any tolerance. The work may
/// err by 5 tolerances everywhere.
#[derive(Clone, Copy)]
struct Bounds {
    placement: f64,
    momentum: f64,
    rounding: f64,
}

/// Those of the study that the method was chosen by.
fn usual(tolerance: f64) -> Bounds {
    Bounds { placement: 1.0, momentum: if tolerance < 1e-11 { 10.0 } else { 3.0 }, rounding: 0.0 }
}

impl<const N: usize, M: Model<N>> Problem<'_, N, M> {
    fn simulation(&self, tolerance: f64) -> Simulation<'_, N, M> {
        let t_end = self.rows.last().unwrap().t;
        Simulation::new(self.model, self.start).until(t_end).tolerance(tolerance)
    }

    /// Runs by the automatic choice, holds errors against bounds, and gives the steps.
    fn holds(&self, tolerance: f64, bounds: Bounds) -> u64 {
        let times: Vec<f64> = self.rows[1..].iter().map(|row| row.t).collect();
        let run = self.simulation(tolerance).output(times).run().unwrap();
        let why = run.why().to_string();
        assert!(why.contains("Radau IIA") && why.contains("friction takes velocities away"), "{why}");
        let momentum = self.rows.iter().map(|row| row.spin.norm()).fold(0.0, f64::max);
        let energy = self.rows[0].energy.abs();
        for ((row, point), work) in self.rows[1..].iter().zip(run.points()).zip(run.work()) {
            let errors = [
                ((point.phi() - row.phi).norm() / row.phi.norm(), bounds.placement),
                ((point.sigma_hat().0.0 - row.spin).norm() / momentum, bounds.momentum),
                ((self.model.hamiltonian(row.t, point) - row.energy).abs() / energy - bounds.rounding, 1.0),
                ((work - row.work).abs() / energy - bounds.rounding, 5.0),
            ];
            for ((error, bound), what) in errors.into_iter().zip(["phi", "Sigma_hat", "H", "work"]) {
                let context = format!("{} at {tolerance:e}, t = {}", self.name, row.t);
                assert!(error <= bound * tolerance, "{context}: {what} errs by {error:e}");
            }
        }
        let balance = run.power_balance().unwrap();
        assert!(balance.defect <= (5.0 * tolerance + bounds.rounding) * energy, "{}: {balance}", self.name);
        run.statistics().steps
    }

    /// Without a drive the energy falls from step to step.
    fn falls(&self, tolerance: f64, rounding: f64) {
        let run = self.simulation(tolerance).run().unwrap();
        let energies =
            run.times().iter().zip(run.points()).map(|(t, point)| self.model.hamiltonian(*t, point));
        let energies: Vec<f64> = energies.collect();
        for pair in energies.windows(2) {
            let rise = (pair[1] - pair[0]) / energies[0].abs();
            assert!(rise <= tolerance + rounding, "{} at {tolerance:e}: H rises by {rise:e}", self.name);
        }
    }
}

/// The steps allowed at 1e-3, 1e-6 and 1e-10.
fn allowed(steps: [u64; 3], tolerance: f64) -> u64 {
    match tolerance {
        1e-3 => steps[0],
        1e-6 => steps[1],
        1e-10 => steps[2],
        _ => u64::MAX,
    }
}

const VISCOUS: [(f64, &str, [u64; 3]); 4] = [
    (1e4, include_str!("../data/p9_1e4.csv"), [30, 50, 60]),
    (1e6, include_str!("../data/p9_1e6.csv"), [30, 50, 60]),
    (1e8, include_str!("../data/p9_1e8.csv"), [30, 50, 60]),
    (1e6, include_str!("../data/p9_1e6_long.csv"), [40, 60, 80]),
];

#[test]
fn a_viscous_body_creeps() {
    for (r, data, steps) in VISCOUS {
        let model = Viscous { r }.prepare().unwrap();
        let rows = rows::<3>(data);
        let start = model.at_momentum(rows[0].phi, Comoving(rows[0].spin)).unwrap();
        let problem = Problem { name: "P9", model: &model, start, rows };
        for tolerance in TOLERANCES {
            let taken = problem.holds(tolerance, usual(tolerance));
            assert!(taken <= allowed(steps, tolerance), "P9, r = {r:e}, {tolerance:e}: {taken} steps");
            problem.falls(tolerance, 0.0);
        }
    }
}

#[test]
fn soft_friction_keeps_its_method() {
    for (r, data) in [(0.1, include_str!("../data/p9_1e-1.csv")), (1e2, include_str!("../data/p9_1e2.csv"))] {
        let model = Viscous { r }.prepare().unwrap();
        let rows = rows::<3>(data);
        let start = model.at_momentum(rows[0].phi, Comoving(rows[0].spin)).unwrap();
        let problem = Problem { name: "P9", model: &model, start, rows };
        let automatic = problem.simulation(1e-10).run().unwrap();
        let explicit = problem.simulation(1e-10).method(Method::RungeKutta8).run().unwrap();
        assert_eq!(automatic.computation().method, Method::RungeKutta8);
        assert_eq!(automatic.end(), explicit.end(), "to the bit");
    }
}

#[test]
fn a_body_of_stiff_volume_swings_on() {
    let data = [
        (1e3, include_str!("../data/p10_1e3.csv")),
        (1e5, include_str!("../data/p10_1e5.csv")),
        (1e7, include_str!("../data/p10_1e7.csv")),
    ];
    for tolerance in TOLERANCES {
        let steps = data.map(|(r, data)| {
            let model = Bulk { r }.prepare().unwrap();
            let rows = rows::<2>(data);
            let start = model.at_momentum(rows[0].phi, Comoving(rows[0].spin)).unwrap();
            let problem = Problem { name: "P10", model: &model, start, rows };
            problem.falls(tolerance, 0.0);
            let mut bounds = usual(tolerance);
            if r == 1e7 && tolerance < 1e-11 {
                // The momentum of a velocity is rounded, and friction makes a force of 1e7 times that.
                bounds = Bounds { placement: 10.0, momentum: 50.0, rounding: 2e-11 };
            }
            problem.holds(tolerance, bounds)
        });
        assert!(
            steps.iter().all(|steps| *steps <= allowed([27, 45, 70], tolerance)),
            "{tolerance:e}: {steps:?}"
        );
        let rounds = tolerance < 1e-11;
        assert!(rounds || steps[2] as f64 <= 1.5 * steps[0] as f64 + 5.0, "{tolerance:e}: {steps:?}");
    }
}

/// Oscillations of 1e4 radians a time are followed until they have died; then steps grow.
#[test]
fn a_stiff_spring_dies_out() {
    let rows = rows::<3>(include_str!("../data/p11.csv"));
    let start = Spring.at_momentum(rows[0].phi, Comoving(rows[0].spin)).unwrap();
    let problem = Problem { name: "P11", model: &Spring, start, rows };
    for tolerance in TOLERANCES {
        // In doubles 3e7 (tr G e^-2q - n) leaves 7e-9 of noise in H, of 46.
        let taken = problem.holds(tolerance, Bounds { rounding: 1e-9, ..usual(tolerance) });
        assert!(taken <= allowed([110, 250, 400], tolerance), "P11 at {tolerance:e}: {taken} steps");
        problem.falls(tolerance, 1e-9);
    }
}

#[test]
fn a_light_body_follows_its_drive() {
    let rows = rows::<3>(include_str!("../data/p12.csv"));
    let start = Driven.at_momentum(rows[0].phi, Comoving(rows[0].spin)).unwrap();
    let problem = Problem { name: "P12", model: &Driven, start, rows };
    for tolerance in TOLERANCES {
        let taken = problem.holds(tolerance, usual(tolerance));
        assert!(taken <= allowed([110, 200, 300], tolerance), "P12 at {tolerance:e}: {taken} steps");
    }
}

/// Steps of explicit methods are bounded by the friction: what they cost beside the implicit ones, in evaluations.
#[test]
fn explicit_steps_cost_more() {
    let model = Viscous { r: 1e5 }.prepare().unwrap();
    let rows = rows::<3>(include_str!("../data/p9_1e6.csv"));
    let start = model.at_momentum(rows[0].phi, Comoving(rows[0].spin)).unwrap();
    let problem = Problem { name: "P9", model: &model, start, rows };
    let [implicit, explicit] = [Method::Automatic, Method::RungeKutta8]
        .map(|method| problem.simulation(1e-9).method(method).run().unwrap().statistics().evaluations);
    assert!(explicit > 150 * implicit, "{explicit} for {implicit}");
}

/// Units of mass and time are of no account: stars, needles and bodies whose time is nanoseconds take the same steps by the same method.
#[test]
fn units_are_of_no_account() {
    #[affine_model(dim = 3, constraint = isochoric, kinetic(body_inertia = j), potential = k*tr(G), dissipation(body_inertia = r))]
    struct Held {
        j: f64,
        k: f64,
        r: f64,
    }
    #[affine_model(
        dim = 2,
        kinetic(dalembert = j),
        potential = hyperbolic_dilatation(k) + neo_hookean(k),
        dissipation(body_inertia = r),
        emit(splitting)
    )]
    struct Disc {
        j: f64,
        k: f64,
        r: f64,
    }
    let phi = Matrix::<3>::new(1.0, 0.2, 0.0, 0.0, 1.0, 0.1, 0.0, 0.0, 1.0);
    let rate = Matrix::<3>::new(0.0, -1.0, 0.3, 1.0, 0.0, -0.2, -0.3, 0.2, 0.0);
    let flat = Matrix::<2>::new(1.2, 0.1, 0.0, 0.9);
    let mut seen: Vec<(u64, Matrix<3>, u64, Matrix<2>)> = Vec::new();
    for (mass, time) in [(1.0, 1.0), (1e12, 1.0), (1e-12, 1.0), (1.0, 1e-9), (1.0, 1e9), (1e9, 1e-6)] {
        let stiffness = mass / (time * time);
        let held = Held { j: mass, k: stiffness, r: 2000.0 * mass / time }.prepare().unwrap();
        let start = held.at_velocity(phi, phi * rate / time).unwrap();
        let viscous = Simulation::new(&held, start).until(10.0 * time).tolerance(1e-8).run().unwrap();
        assert!(matches!(viscous.computation().method, Method::Radau { .. }), "{mass} {time}");
        let disc = Disc { j: mass, k: stiffness, r: 2000.0 * mass / time }.prepare().unwrap();
        let start = disc.at_velocity(flat, Matrix::zeros()).unwrap();
        let fallen = Simulation::new(&disc, start).until(10.0 * time).tolerance(1e-8).run().unwrap();
        assert!(matches!(fallen.computation().method, Method::Radau { .. }), "{mass} {time}");
        let refused = Simulation::new(&disc, start)
            .until(10.0 * time)
            .method(Method::Splitting { order: 4, step: 0.05 * time })
            .run()
            .unwrap_err();
        assert!(matches!(refused.stop.reason, Reason::Friction { .. }), "{mass} {time}: {refused}");
        let steps = [viscous.statistics().steps, fallen.statistics().steps];
        seen.push((steps[0], *viscous.end().1.phi(), steps[1], *fallen.end().1.phi()));
    }
    for (held, end, disc, flat) in &seen {
        assert_eq!((*held, *disc), (seen[0].0, seen[0].2));
        assert!((end - seen[0].1).norm() < 1e-9 && (flat - seen[0].3).norm() < 1e-9, "{end} {flat}");
    }
}

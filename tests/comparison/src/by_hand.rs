//! The benchmark problems as a careful user of nalgebra and ode_solvers writes them.

use std::time::{Duration, Instant};

use nalgebra::{Matrix3, SVector, Vector3};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, System};

use super::timing::{Times, net};

type Placed = SVector<f64, 18>;
type Moving = SVector<f64, 21>;

const A: f64 = 0.2;
const B: f64 = 0.1;
const ALPHA: f64 = 1.0 + A;
const SHEAR: f64 = 1.0 / ALPHA;
const TRACE: f64 = -B / (ALPHA * (ALPHA + 3.0 * B));
const SKEW: f64 = 1.0 / (1.0 - A * A);

/// `Sigma = X/alpha + (tr X/beta) 1 - W/mu` of the isotropic form.
fn velocity(spin: &Matrix3<f64>) -> Matrix3<f64> {
    spin * SHEAR + Matrix3::identity() * (spin.trace() * TRACE) - (spin - spin.transpose()) * SKEW
}

/// `-(dU/dphi)^T phi` of `kappa/2 sinh(q)^2 + c1 (tr G e^(-2q) - 3)`, or the same with `phi phi^T`.
fn stress(tensor: &Matrix3<f64>, determinant: f64, kappa: f64, c1: f64) -> Matrix3<f64> {
    let dilatation = determinant.cbrt();
    let (up, down) = (dilatation * dilatation, 1.0 / (dilatation * dilatation));
    let pressure = kappa / 4.0 * (up - down) / 3.0;
    let deviator = tensor - Matrix3::identity() * (tensor.trace() / 3.0);
    deviator * (-2.0 * c1 * down) - Matrix3::identity() * pressure
}

fn matrix(state: &[f64], from: usize) -> Matrix3<f64> {
    Matrix3::from_column_slice(&state[from..from + 9])
}

/// `phi`, `Sigma_hat`.
struct Vibrating {
    kappa: f64,
    c1: f64,
}

impl System<f64, Placed> for Vibrating {
    fn system(&self, _t: f64, y: &Placed, dy: &mut Placed) {
        let (phi, spin) = (matrix(y.as_slice(), 0), matrix(y.as_slice(), 9));
        let o = velocity(&spin);
        let green = phi.transpose() * phi;
        let rate = spin * o - o * spin + stress(&green, phi.determinant(), self.kappa, self.c1);
        write(dy.as_mut_slice(), 0, &(phi * o));
        write(dy.as_mut_slice(), 9, &rate);
    }
}

/// `phi`, `Sigma`.
struct Mirrored;

impl System<f64, Placed> for Mirrored {
    fn system(&self, _t: f64, y: &Placed, dy: &mut Placed) {
        let (phi, spin) = (matrix(y.as_slice(), 0), matrix(y.as_slice(), 9));
        let o = velocity(&spin);
        let finger = phi * phi.transpose();
        let rate = o * spin - spin * o + stress(&finger, phi.determinant(), 10.0, 0.5);
        write(dy.as_mut_slice(), 0, &(o * phi));
        write(dy.as_mut_slice(), 9, &rate);
    }
}

/// `phi`, `Pi^T`.
struct Elastic {
    kappa: f64,
}

impl System<f64, Placed> for Elastic {
    fn system(&self, _t: f64, y: &Placed, dy: &mut Placed) {
        let (phi, momentum) = (matrix(y.as_slice(), 0), matrix(y.as_slice(), 9));
        let determinant = phi.determinant();
        let dilatation = determinant.cbrt();
        let (up, down) = (dilatation * dilatation, 1.0 / (dilatation * dilatation));
        let slope = self.kappa / 4.0 * (up - down) / 3.0 - phi.norm_squared() * down / 3.0;
        let inverse = phi.try_inverse().unwrap_or_else(Matrix3::zeros);
        let velocity = Matrix3::from_columns(&[
            momentum.column(0).into_owned(),
            momentum.column(1) / 1.5,
            momentum.column(2) / 2.0,
        ]);
        write(dy.as_mut_slice(), 0, &velocity);
        write(dy.as_mut_slice(), 9, &(-inverse.transpose() * slope - phi * down));
    }
}

/// `x`, `phi`, `Sigma_hat`, with `p` constant.
struct Missile {
    kappa: f64,
    c1: f64,
    p: Vector3<f64>,
}

impl System<f64, Moving> for Missile {
    fn system(&self, _t: f64, y: &Moving, dy: &mut Moving) {
        let (phi, spin) = (matrix(y.as_slice(), 3), matrix(y.as_slice(), 12));
        let o = velocity(&spin);
        let p_hat = phi.transpose() * self.p;
        let mut rate = spin * o - o * spin - p_hat * p_hat.transpose();
        if self.kappa != 0.0 || self.c1 != 0.0 {
            rate += stress(&(phi.transpose() * phi), phi.determinant(), self.kappa, self.c1);
        }
        dy.as_mut_slice()[..3].copy_from_slice((phi * p_hat).as_slice());
        write(dy.as_mut_slice(), 3, &(phi * o));
        write(dy.as_mut_slice(), 12, &rate);
    }
}

fn write(out: &mut [f64], from: usize, value: &Matrix3<f64>) {
    out[from..from + 9].copy_from_slice(value.as_slice());
}

/// One run.
pub(crate) struct Measured {
    pub(crate) tolerance: f64,
    pub(crate) error: f64,
    pub(crate) evaluations: u64,
    pub(crate) time: Duration,
}

/// `phi` at the start of all problems but P5 large.
const PHI: [f64; 9] = [1.1, 0.05, -0.2, 0.2, 0.9, 0.1, -0.1, 0.15, 1.05];
/// Column by column: `Sigma_hat`, `Sigma`, or `phi_dot`.
const SPIN: [f64; 9] = [0.1, -0.2, 0.35, 0.4, -0.15, -0.1, -0.3, 0.25, 0.05];

/// Runs a problem at many tolerances; `end` is `phi` at the end, column by column in rows.
pub(crate) fn measure(problem: &str, end: &[[f64; 3]; 3]) -> Vec<Measured> {
    let end = Matrix3::from_fn(|i, j| end[i][j]);
    let p = Vector3::new(0.3, -0.2, 0.5);
    let scaled = |factor: f64| placed(&PHI.map(|entry| entry * factor), &SPIN);
    let vibrating = |kappa: f64, c1: f64| move || Vibrating { kappa, c1 };
    match problem {
        "P1" => sweep(|| Missile { kappa: 0.0, c1: 0.0, p }, moving(), 10.0, 3, &end),
        "P2" => sweep(vibrating(10.0, 0.5), scaled(1.0), 50.0, 0, &end),
        "P2r" => sweep(|| Mirrored, scaled(1.0), 50.0, 0, &end),
        "P3" | "P6" => {
            let (kappa, t_end) = if problem == "P3" { (10.0, 50.0) } else { (1e6, 5.0) };
            let inertia = [1.0, 1.0, 1.0, 1.5, 1.5, 1.5, 2.0, 2.0, 2.0];
            let momentum: [f64; 9] = std::array::from_fn(|k| SPIN[k] * inertia[k]);
            sweep(|| Elastic { kappa }, placed(&PHI, &momentum), t_end, 0, &end)
        }
        "P5 1e4" => sweep(vibrating(1e4, 0.5), scaled(1.0), 10.0, 0, &end),
        "P5 1e6" => sweep(vibrating(1e6, 0.5), scaled(1.0), 10.0, 0, &end),
        "P5 large" => sweep(vibrating(1e4, 0.5), scaled(0.3_f64.exp()), 10.0, 0, &end),
        "P7" => sweep(|| Missile { kappa: 1e4, c1: 0.5, p }, moving(), 10.0, 3, &end),
        "P8" => sweep(vibrating(10.0, 1e4), scaled(1.0), 2.0, 0, &end),
        _ => Vec::new(),
    }
}

/// Net times of one evaluation; `None` where only numbers differ from another problem.
pub(crate) fn times(problem: &str) -> Option<Times> {
    let p = Vector3::new(0.3, -0.2, 0.5);
    match problem {
        "P1" => Some(of_system(&Missile { kappa: 0.0, c1: 0.0, p }, moving())),
        "P2" => Some(of_system(&Vibrating { kappa: 10.0, c1: 0.5 }, placed(&PHI, &SPIN))),
        "P2r" => Some(of_system(&Mirrored, placed(&PHI, &SPIN))),
        "P3" => Some(of_system(&Elastic { kappa: 10.0 }, placed(&PHI, &SPIN))),
        "P7" => Some(of_system(&Missile { kappa: 1e4, c1: 0.5, p }, moving())),
        _ => None,
    }
}

fn of_system<const D: usize>(system: &impl System<f64, SVector<f64, D>>, start: SVector<f64, D>) -> Times {
    net(start.into(), |y| {
        let mut slope = SVector::zeros();
        system.system(0.0, &SVector::from(*y), &mut slope);
        slope.into()
    })
}

fn placed(phi: &[f64; 9], spin: &[f64; 9]) -> Placed {
    Placed::from_iterator(phi.iter().chain(spin).copied())
}

fn moving() -> Moving {
    Moving::from_iterator([0.0; 3].iter().chain(&PHI).chain(&SPIN).copied())
}

fn sweep<const D: usize, F: System<f64, SVector<f64, D>>>(
    system: impl Fn() -> F,
    start: SVector<f64, D>,
    t_end: f64,
    phi_at: usize,
    end: &Matrix3<f64>,
) -> Vec<Measured> {
    let mut runs = Vec::new();
    for k in 2..=29 {
        let tolerance = 10f64.powf(-0.5 * f64::from(k));
        let run = || {
            let mut solver = Dop853::from_param(
                system(),
                0.0,
                t_end,
                t_end,
                start,
                tolerance,
                tolerance,
                0.9,
                0.0,
                0.333,
                6.0,
                t_end,
                0.0,
                10_000_000,
                u32::MAX,
                OutputType::Sparse,
            );
            let stats = solver.integrate();
            (stats, solver.y_out().last().copied())
        };
        let (Ok(stats), Some(reached)) = run() else { continue };
        let error = (matrix(reached.as_slice(), phi_at) - end).norm() / end.norm();
        let time = median_time(|| {
            std::hint::black_box(run().1);
        });
        runs.push(Measured { tolerance, error, evaluations: u64::from(stats.num_eval), time });
    }
    runs
}

/// Median of up to 15 repeats, fewer where they take long.
fn median_time(run: impl Fn()) -> Duration {
    let begun = Instant::now();
    let mut times = Vec::new();
    while times.len() < 15 && (times.is_empty() || begun.elapsed() < Duration::from_millis(150)) {
        let now = Instant::now();
        run();
        times.push(now.elapsed());
    }
    times.sort_unstable();
    times[times.len() / 2]
}

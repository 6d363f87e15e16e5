//! The benchmark problems as a careful user of nalgebra writes them.

use nalgebra::{Matrix3, SVector, Vector3};
use ode_solvers::System;

use crate::compiled::Compiled;
use crate::tools::{Problem, Swept};

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

pub(crate) fn matrix(state: &[f64], from: usize) -> Matrix3<f64> {
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

/// `phi` at the start of all problems but P5 large.
const PHI: [f64; 9] = [1.1, 0.05, -0.2, 0.2, 0.9, 0.1, -0.1, 0.15, 1.05];
/// Column by column: `Sigma_hat`, `Sigma`, or `phi_dot`.
const SPIN: [f64; 9] = [0.1, -0.2, 0.35, 0.4, -0.15, -0.1, -0.3, 0.25, 0.05];

/// Runs a problem with every tool at many tolerances; `end` is `phi` at the end.
pub(crate) fn measure(name: &'static str, end: Matrix3<f64>, c: Option<&mut Compiled>) -> Vec<Swept> {
    let p = Vector3::new(0.3, -0.2, 0.5);
    let scaled = |factor: f64| placed(&PHI.map(|entry| entry * factor), &SPIN);
    let vibrating = |kappa: f64, c1: f64| move || Vibrating { kappa, c1 };
    let pinned = |start, t_end| Problem { name, start, t_end, phi_at: 0, end };
    let flying = |t_end| Problem { name, start: moving(), t_end, phi_at: 3, end };
    match name {
        "P1" => flying(10.0).measure(|| Missile { kappa: 0.0, c1: 0.0, p }, c),
        "P2" => pinned(scaled(1.0), 50.0).measure(vibrating(10.0, 0.5), c),
        "P2r" => pinned(scaled(1.0), 50.0).measure(|| Mirrored, c),
        "P3" | "P6" => {
            let (kappa, t_end) = if name == "P3" { (10.0, 50.0) } else { (1e6, 5.0) };
            let inertia = [1.0, 1.0, 1.0, 1.5, 1.5, 1.5, 2.0, 2.0, 2.0];
            let momentum: [f64; 9] = std::array::from_fn(|k| SPIN[k] * inertia[k]);
            pinned(placed(&PHI, &momentum), t_end).measure(|| Elastic { kappa }, c)
        }
        "P5 1e4" => pinned(scaled(1.0), 10.0).measure(vibrating(1e4, 0.5), c),
        "P5 1e6" => pinned(scaled(1.0), 10.0).measure(vibrating(1e6, 0.5), c),
        "P5 large" => pinned(scaled(0.3_f64.exp()), 10.0).measure(vibrating(1e4, 0.5), c),
        "P7" => flying(10.0).measure(|| Missile { kappa: 1e4, c1: 0.5, p }, c),
        "P8" => pinned(scaled(1.0), 2.0).measure(vibrating(10.0, 1e4), c),
        _ => Vec::new(),
    }
}

/// A state at which a problem's equations of all components can be timed.
pub(crate) fn state(problem: &str) -> Vec<f64> {
    match problem {
        "P1" | "P7" => moving().as_slice().to_vec(),
        _ => placed(&PHI, &SPIN).as_slice().to_vec(),
    }
}

fn placed(phi: &[f64; 9], spin: &[f64; 9]) -> Placed {
    Placed::from_iterator(phi.iter().chain(spin).copied())
}

fn moving() -> Moving {
    Moving::from_iterator([0.0; 3].iter().chain(&PHI).chain(&SPIN).copied())
}

//! Two stretches as a hyperbolic Sutherland system, against its exact solution.
//!
//! For `n = 2` and `N = 0` the lattice of an affine-affine body, `H = C(2)/(2A)`, is in units of `A` the two-body system
//!
//! ```text
//! H = (p_1^2 + p_2^2)/2 + g^2 a^2/sinh^2(a (q_1 - q_2)),    a = 1/2,  g = M/2
//! cosh(a r(t)) = sqrt(1 + g^2 a^2/E) cosh(2 a sqrt(E) (t - t0)),    E = r'^2/4 + g^2 a^2/sinh^2(a r),  r = q_1 - q_2
//! ```
//!
//! (Olshanetsky and Perelomov, Phys. Rep. 71 (1981) 313). For three stretches with equal couplings the corresponding
//! statement is false: the couplings move. The picture goes to `output/`: motions, and errors over time.

use std::fs;

use affine_runtime::frames::Matrix;
use affine_runtime::lattice::{Lattice, LatticeFlow};
use affine_runtime::prelude::*;
use affine_runtime::report::{Curve, CurveDiagram, CurvePanel};

/// Affine in space and in the body, `alpha = 1`.
#[affine_model(dim = 2, kinetic(casimir2 = 1), emit(two_polar))]
pub struct Pair;

/// `a` and the time shown.
const A: f64 = 0.5;
const T_END: f64 = 8.0;
const OUTPUTS: u32 = 200;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let _ = fs::create_dir_all("output");
    let (mut motions, mut errors) = (Vec::new(), Vec::new());
    for (category, m) in [0.02, 0.5, 2.0].into_iter().enumerate() {
        let start = pair([1.5, -1.5], [-0.8, 0.8], m);
        let exact = Exact::new(&start, 0.5 * m);
        let mut flow = LatticeFlow::new(&Pair, 0.0, start).tolerance(1e-14);
        let (mut path, mut error) = (Vec::new(), Vec::new());
        for k in 0..=OUTPUTS {
            let t = T_END / f64::from(OUTPUTS) * f64::from(k);
            let now = flow.advance_to(t)?;
            let r = now.q[0] - now.q[1];
            path.push((t, r));
            error.push((t, ((r - exact.at(t)).abs() / r.abs()).max(0.5 * f64::EPSILON)));
        }
        let worst = error.iter().map(|point| point.1).fold(0.0, f64::max);
        let (steps, through) = flow.steps();
        println!(
            "M = {m}: largest relative error of q1 - q2 {worst:.1e}, {steps} steps, {through} of them through phi"
        );
        motions.push(Curve { category, points: path });
        errors.push(Curve { category, points: error });
    }
    let panel = |y: &str, logarithmic: bool, curves: Vec<Curve>| CurvePanel {
        x: "t".into(),
        y: y.into(),
        logarithmic,
        range: None,
        curves,
    };
    CurveDiagram::new(
        "Hyperbolic Sutherland system of two stretches: M = 0.02 (blue), 0.5 (red), 2 (green)",
        vec![panel("q1 - q2", false, motions), panel("relative error", true, errors)],
    )
    .save_svg("output/sutherland.svg")?;
    println!("picture: output/sutherland.svg");
    Ok(())
}

fn pair(q: [f64; 2], p: [f64; 2], m: f64) -> Lattice<2> {
    Lattice {
        q: Vector::from(q),
        p: Vector::from(p),
        m: Matrix::<2>::new(0.0, m, -m, 0.0),
        n: Matrix::<2>::zeros(),
        left: Matrix::<2>::identity(),
        right: Matrix::<2>::identity(),
    }
}

/// The exact solution.
struct Exact {
    amplitude: f64,
    /// `amplitude - 1`, without cancellation.
    excess: f64,
    rate: f64,
    t0: f64,
}

impl Exact {
    fn new(start: &Lattice<2>, g: f64) -> Self {
        let (r, velocity) = (start.q[0] - start.q[1], start.p[0] - start.p[1]);
        let energy = 0.25 * velocity * velocity + (g * A / (A * r).sinh()).powi(2);
        let square = (g * A).powi(2) / energy;
        let amplitude = (1.0 + square).sqrt();
        let excess = square / (1.0 + amplitude);
        let rate = 2.0 * A * energy.sqrt();
        // The slope of cosh(a r) at the start: a r' sinh(a r) = amplitude rate sinh(-rate t0).
        let t0 = -((A * velocity * (A * r).sinh()) / (amplitude * rate)).asinh() / rate;
        Self { amplitude, excess, rate, t0 }
    }

    fn at(&self, t: f64) -> f64 {
        // cosh(a r) - 1 = 2 sinh^2(a r/2), which small distances do not lose.
        let half = (0.5 * self.rate * (t - self.t0)).sinh();
        let less_one = 2.0 * self.amplitude * half * half + self.excess;
        2.0 * (0.5 * less_one).sqrt().asinh() / A
    }
}

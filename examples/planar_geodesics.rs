//! A planar body that is affine on both sides: whether a geodesic stays bounded depends on the sign of its energy.
//!
//! For `n = 2`, `T = A/2 tr Omega^2` and no dilatation, `c = cosh(q1 - q2)` obeys a linear equation,
//!
//! ```text
//! c'' = (4 E c + S V / A) / A        S = S_12, V = Vort_12: both conserved
//! ```
//!
//! so that `c` oscillates with the frequency `2 sqrt(-E/A)` where `E < 0` and grows where `E > 0`. The run through
//! the closed form of the model, and the run through the integrator, are both held against its solution. Pictures
//! go to `output/`.

use std::fs;
use std::path::Path;

use affine_runtime::gltf::Shape;
use affine_runtime::prelude::*;

/// Affine in space and in the body; its metric is indefinite: (3, 1).
#[affine_model(dim = 2, symmetry(space = affine, body = affine), kinetic(casimir2 = 0.5))]
pub struct PlanarBody;

const A: f64 = 0.5;

type Point = <PlanarBody as Model<2>>::Point<f64>;

fn main() -> affine_runtime::Result<()> {
    // A folder that cannot be made shows in the first file that cannot be written.
    let _ = fs::create_dir_all("output");
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    println!(
        "{}\n{}\n",
        PlanarBody::DESCRIPTION.kinetic_energy.text,
        PlanarBody::DESCRIPTION.hamiltonian.text
    );
    // Traceless spins: mostly rotation, mostly shear.
    let bounded = PlanarBody.at_momentum(phi, Comoving(Matrix::<2>::new(0.1, 0.5, -0.3, -0.1)))?;
    let escaping = PlanarBody.at_momentum(phi, Comoving(Matrix::<2>::new(0.3, 0.2, 0.1, -0.3)))?;
    for (name, start, t_end) in [("bounded", bounded, 40.0), ("escaping", escaping, 5.0)] {
        let exact = Stretch::new(&start);
        println!("{name}: E = {:+.4}, {}", exact.energy, exact.fate());
        let closed = Simulation::new(&PlanarBody, start).until(t_end).every(t_end / 400.0).run()?;
        let stepped = Simulation::new(&PlanarBody, start)
            .until(t_end)
            .every(t_end / 400.0)
            .tolerance(1e-13)
            .method(Method::RungeKutta8)
            .run()?;
        for (route, run) in [("closed form", &closed), ("Runge-Kutta 8", &stepped)] {
            let worst = run
                .iter()
                .map(|(t, point)| (stretch(point) - exact.at(t)).abs() / exact.at(t))
                .fold(0.0, f64::max);
            println!("  {route:<14} largest relative error of cosh(q1 - q2): {worst:.1e}");
        }
        let picture = Path::new("output").join(format!("planar_{name}"));
        closed.save_svg(picture.with_extension("svg"))?;
        closed.save_html(picture.with_extension("html"))?;
        closed.save_glb(picture.with_extension("glb"), &Shape::cuboid(Vector::<2>::new(2.0, 1.0)))?;
        println!("  written: {}.svg, .html, .glb\n", picture.display());
    }
    Ok(())
}

/// `cosh(q1 - q2) = tr G / (2 det phi)`.
fn stretch(point: &Point) -> f64 {
    point.phi().norm_squared() / (2.0 * point.phi().determinant())
}

/// The solution of the linear equation.
struct Stretch {
    energy: f64,
    start: f64,
    rate: f64,
    equilibrium: f64,
}

impl Stretch {
    fn new(start: &Point) -> Self {
        let energy = PlanarBody.hamiltonian(0.0, start);
        let (s, v) = (start.spin().0.0[(0, 1)], start.vorticity().0.0[(0, 1)]);
        // d/dt of tr(phi^T phi)/(2 det phi) for a traceless affine velocity, det phi constant.
        let velocity = PlanarBody.velocity(start).phi_dot;
        let rate = start.phi().dot(&velocity) / start.phi().determinant();
        Self { energy, start: stretch(start), rate, equilibrium: -s * v / (4.0 * A * energy) }
    }

    fn at(&self, t: f64) -> f64 {
        let w = 2.0 * (self.energy.abs() / A).sqrt();
        let (c, s) = match self.energy < 0.0 {
            true => ((w * t).cos(), (w * t).sin()),
            false => ((w * t).cosh(), (w * t).sinh()),
        };
        self.equilibrium + (self.start - self.equilibrium) * c + self.rate / w * s
    }

    fn fate(&self) -> String {
        match self.energy < 0.0 {
            true => format!("period {:.6}", std::f64::consts::PI / (-self.energy / A).sqrt()),
            false => format!("grows like exp({:.6} t)", 2.0 * (self.energy / A).sqrt()),
        }
    }
}

//! A star of Dirichlet: a homogeneous, incompressible, self-gravitating ellipsoid, whose gravity is a type of its own.
//!
//! In units `G = M = 1`, with the unit ball at `phi = 1` and stretches `a_i`,
//!
//! ```text
//! T = tr(phi_dot^T phi_dot)/10,   det phi = 1,   U = -(3/5) R_F(a_1^2, a_2^2, a_3^2)
//! ```
//!
//! (S. Chandrasekhar, Ellipsoidal Figures of Equilibrium, 1969, chapter 3). The pressure is the multiplier of the
//! constraint. Shown: spheroids of Maclaurin turn without changing, an oscillation with its period, and Dedekind's theorem,
//! that `phi -> phi^T` maps motions to motions. The picture goes to `output/`.

use std::f64::consts::TAU;
use std::fs;

use affine_runtime::decompose::principal_stretches;
use affine_runtime::frames::Matrix;
use affine_runtime::potential::{Class, Place, Potential, Slopes};
use affine_runtime::prelude::*;
use affine_runtime::report::{Curve, CurveDiagram, CurvePanel};
use affine_runtime::scalar::Scalar;

/// An isochoric body whose mass is spread evenly over the unit ball.
#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(dalembert = 0.2),
    potential = custom(gravity, isotropic),
)]
pub struct Star {
    /// What holds it together.
    pub gravity: Gravity,
}

type Point = <Star as Model<3>>::Point<f64>;

/// `-(3/5) R_F(a_1^2, a_2^2, a_3^2)`.
#[derive(Clone, Copy, Debug)]
pub struct Gravity;

impl Potential<3> for Gravity {
    const CLASS: Class = Class::Isotropic;

    fn energy<T: Scalar>(&self, place: &Place<3, T>) -> T {
        let (stretches, ..) = principal_stretches(rows(&place.phi));
        -(rational::<T>(3, 5) * carlson_f(stretches.map(|a| a * a)))
    }

    /// `dR_F(x, y, z)/dz = -R_D(x, y, z)/6` (NIST Digital Library of Mathematical Functions, 19.18.1): along the principal
    /// axes `dU/da_i = a_i R_D(a_j^2, a_k^2, a_i^2)/5`.
    fn slopes<T: Scalar>(&self, place: &Place<3, T>) -> Slopes<3, T> {
        let (stretches, stretched, axes) = principal_stretches(rows(&place.phi));
        let [x, y, z] = stretches.map(|a| a * a);
        let pull = [[y, z, x], [z, x, y], [x, y, z]].map(|squares| carlson_d(squares) * rational::<T>(1, 5));
        let entry = |i: usize, a: usize| {
            (0..3).fold(T::zero(), |sum, k| sum + stretched[i][k] * pull[k] * axes[a][k])
        };
        Slopes { x: Vector::<3, T>::zeros(), phi: Matrix::<3, T>::from_fn(entry) }
    }
}

fn rows<T: Scalar>(phi: &Matrix<3, T>) -> [[T; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|a| phi[(i, a)]))
}

fn rational<T: Scalar>(numerator: i32, denominator: i32) -> T {
    T::constant(f64::from(numerator), 0.0) / T::constant(f64::from(denominator), 0.0)
}

/// Each duplication brings the arguments four times closer to their mean, and what is left out below is of sixth order in
/// their distance: this many leave less than a rounding for axes in proportions up to a hundred.
const DUPLICATIONS: usize = 9;

/// `R_F(x, y, z)`: the integral of `1/2 ((t + x)(t + y)(t + z))^(-1/2)` over positive `t`, by duplication (B. C. Carlson,
/// Numer. Algorithms 10 (1995) 13, algorithm 1; the series is DLMF 19.36.1).
fn carlson_f<T: Scalar>(squares: [T; 3]) -> T {
    let mut now = squares;
    for _ in 0..DUPLICATIONS {
        let lambda = sum_of_products(now.map(Scalar::sqrt));
        now = now.map(|x| (x + lambda) * rational(1, 4));
    }
    let mean = (now[0] + now[1] + now[2]) * rational(1, 3);
    let [x, y, z] = now.map(|x| T::one() - x / mean);
    let (e2, e3) = (sum_of_products([x, y, z]), x * y * z);
    let series = T::one() - e2 * rational(1, 10) + e3 * rational(1, 14) + e2 * e2 * rational(1, 24)
        - e2 * e3 * rational(3, 44);
    series / mean.sqrt()
}

/// `R_D(x, y, z)`: the integral of `3/2 ((t + x)(t + y))^(-1/2) (t + z)^(-3/2)`, likewise (algorithm 4; DLMF 19.36.2).
fn carlson_d<T: Scalar>(squares: [T; 3]) -> T {
    let (mut now, mut sum, mut weight) = (squares, T::zero(), T::one());
    for _ in 0..DUPLICATIONS {
        let roots = now.map(Scalar::sqrt);
        let lambda = sum_of_products(roots);
        sum += weight / (roots[2] * (now[2] + lambda));
        weight *= rational(1, 4);
        now = now.map(|x| (x + lambda) * rational(1, 4));
    }
    let mean = (now[0] + now[1] + now[2] * rational(3, 1)) * rational(1, 5);
    let [x, y, z] = now.map(|x| T::one() - x / mean);
    let (xy, zz) = (x * y, z * z);
    let e2 = xy - zz * rational(6, 1);
    let e3 = (xy * rational(3, 1) - zz * rational(8, 1)) * z;
    let e4 = (xy - zz) * zz * rational(3, 1);
    let e5 = xy * zz * z;
    let series = T::one() - e2 * rational(3, 14) + e3 * rational(1, 6) + e2 * e2 * rational(9, 88)
        - e4 * rational(3, 22)
        - e2 * e3 * rational(9, 52)
        + e5 * rational(3, 26);
    sum * rational(3, 1) + weight * series / (mean * mean.sqrt())
}

fn sum_of_products<T: Scalar>([x, y, z]: [T; 3]) -> T {
    x * y + y * z + z * x
}

/// `pi G rho`: the ball of volume `4 pi/3` has mass 1.
const PI_G_RHO: f64 = 0.75;
const STAR: Star = Star { gravity: Gravity };

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let _ = fs::create_dir_all("output");
    let model = Star::DESCRIPTION;
    println!("{}\n{}", model.kinetic_energy.text, model.hamiltonian.text);
    println!("conserved: {:?}\n", model.conserved);

    println!("spheroids of Maclaurin over two turns, phi(t) = R(Omega t) phi(0):");
    for eccentricity in [0.4, 0.7, 0.9] {
        println!("  e = {eccentricity}: largest error of phi {:.1e}", unrest(eccentricity)?);
    }

    let period = 2.0 * time_of_rest()?;
    println!("\noscillation from rest at a = 1.2: period {period:.12} (7.42405610874 by quadrature)");
    draw(period)?;

    let (there, back) = (motion(start()?)?, motion(adjoint(&start()?)?)?);
    let distance = (back.phi() - there.phi().transpose()).norm();
    println!("Dedekind: |phi'(10) - phi(10)^T| = {distance:.1e} of motions from phi(0) and phi(0)^T");
    println!("picture: output/ellipsoids.svg");
    Ok(())
}

/// The placement of the spheroid with these axes in its equator, of volume 1.
fn spheroid(equator: f64) -> Matrix<3> {
    Matrix::from_diagonal(&Vector::<3>::new(equator, equator, 1.0 / (equator * equator)))
}

/// The largest distance of a spheroid of Maclaurin from its rotation:
/// `Omega^2/(pi G rho) = 2 sqrt(1 - e^2)/e^3 (3 - 2 e^2) asin e - 6 (1 - e^2)/e^2` (Chandrasekhar, section 32).
fn unrest(e: f64) -> affine_runtime::Result<f64> {
    let (squared, polar) = (e * e, 1.0 - e * e);
    let balance =
        2.0 * polar.sqrt() / (e * squared) * (3.0 - 2.0 * squared) * e.asin() - 6.0 * polar / squared;
    let omega = (balance * PI_G_RHO).sqrt();
    let phi = spheroid(polar.powf(-1.0 / 6.0));
    let whirl = Matrix::<3>::new(0.0, -omega, 0.0, omega, 0.0, 0.0, 0.0, 0.0, 0.0);
    let start = STAR.at_velocity(phi, whirl * phi)?;
    let t_end = 2.0 * TAU / omega;
    let method = Method::Rattle { order: 8, step: 0.1 };
    let run = Simulation::new(&STAR, start).until(t_end).every(t_end / 40.0).method(method).run()?;
    let error = |(t, point): (f64, &Point)| {
        let (s, c) = (omega * t).sin_cos();
        (point.phi() - Matrix::<3>::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0) * phi).norm()
    };
    Ok(run.iter().map(|(t, point)| error((t, point))).fold(0.0, f64::max))
}

/// When the star that starts from rest at `a = 1.2` is at rest again, at its other turning point: a zero of `Pi_33`.
fn time_of_rest() -> affine_runtime::Result<f64> {
    let start = STAR.at_velocity(spheroid(1.2), Matrix::<3>::zeros())?;
    let momentum = |t: f64| -> affine_runtime::Result<f64> {
        let run = Simulation::new(&STAR, start).until(t).tolerance(1e-14).run()?;
        Ok(run.end().1.pi().0.0[(2, 2)])
    };
    let (mut before, mut now) = (3.6, 3.8);
    let mut at_before = momentum(before)?;
    for _ in 0..8 {
        let at_now = momentum(now)?;
        if at_now == at_before {
            break;
        }
        (before, at_before, now) = (now, at_now, now - at_now * (now - before) / (at_now - at_before));
    }
    Ok(now)
}

/// Axes over two periods.
fn draw(period: f64) -> Result<(), Box<dyn std::error::Error>> {
    let start = STAR.at_velocity(spheroid(1.2), Matrix::<3>::zeros())?;
    let t_end = 2.0 * period;
    let run = Simulation::new(&STAR, start).until(t_end).every(t_end / 300.0).run()?;
    let axis = |category: usize, k: usize| Curve {
        category,
        points: run.iter().map(|(t, point)| (t, point.phi()[(k, k)])).collect(),
    };
    let panel = CurvePanel {
        x: "t".into(),
        y: "axes: equator, pole".into(),
        logarithmic: false,
        range: None,
        curves: vec![axis(0, 0), axis(1, 2)],
    };
    let title = "Self-gravitating ellipsoid, from rest at a = 1.2";
    CurveDiagram::new(title, vec![panel]).save_svg("output/ellipsoids.svg")?;
    Ok(())
}

/// A start without symmetry.
fn start() -> affine_runtime::Result<Point> {
    let phi = Matrix::<3>::new(1.2, 0.1, 0.2, 0.0, 1.0, -0.15, 0.0, 0.0, 1.0 / 1.2);
    let mut rate = Matrix::<3>::new(0.2, 0.5, -0.1, -0.3, 0.1, 0.2, 0.15, -0.25, -0.3);
    rate -= Matrix::<3>::identity() * (rate.trace() / 3.0);
    STAR.at_velocity(phi, phi * rate)
}

/// The transposed start.
fn adjoint(point: &Point) -> affine_runtime::Result<Point> {
    let velocity = STAR.velocity(point);
    STAR.at_velocity(point.phi().transpose(), velocity.phi_dot.transpose())
}

fn motion(start: Point) -> affine_runtime::Result<Point> {
    Ok(*Simulation::new(&STAR, start).until(10.0).tolerance(1e-14).run()?.end().1)
}

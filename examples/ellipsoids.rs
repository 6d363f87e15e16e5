//! Ellipsoids of Riemann: a homogeneous, incompressible star that its own gravity holds together, as Dirichlet stated it.
//!
//! In units `G = M = 1`, with the unit ball at `phi = 1` and stretches `a_i`,
//!
//! ```text
//! T = tr(phi_dot^T phi_dot)/10,   det phi = 1,   U = -(3/5) R_F(a_1^2, a_2^2, a_3^2)
//! ```
//!
//! (S. Chandrasekhar, Ellipsoidal Figures of Equilibrium, 1969, chapter 3). The pressure is the multiplier of the
//! constraint. Shown: spheroids of Maclaurin turn without changing, an oscillation with its period, and Dedekind's theorem,
//! that `phi -> phi^T` maps motions to motions; and, by continuation from the ball at rest, where the ellipsoids of Jacobi branch off
//! and where spheroids break. The pictures go to `output/`.

use std::f64::consts::TAU;
use std::fs;

use affine_runtime::analysis::{
    BranchPoint, Condition, Continuation, Generator, Special, StabilityVerdict, branch_diagram,
    relative_equilibrium,
};
use affine_runtime::prelude::*;
use affine_runtime::report::{Curve, CurveDiagram, CurvePanel};

/// An isochoric body whose mass is spread evenly over the unit ball.
#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(dalembert = 0.2),
    potential = self_gravity(1),
)]
pub struct Star;

type Point = <Star as Model<3>>::Point<f64>;

/// `pi G rho`: the ball of volume `4 pi/3` has mass 1.
const PI_G_RHO: f64 = 0.75;

/// Of the spheroid that starts from rest at `a = 1.2`, by quadrature.
const PERIOD: f64 = 7.424_056_108_741_6;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let _ = fs::create_dir_all("output");
    let model = Star::DESCRIPTION;
    println!("{}\n{}", model.kinetic_energy.text, model.hamiltonian.text);
    println!("conserved: {:?}\n", model.conserved);

    println!("spheroids of Maclaurin over two turns, phi(t) = R(Omega t) phi(0):");
    for eccentricity in [0.4, 0.7, 0.9] {
        let error = unrest(eccentricity)?;
        println!("  e = {eccentricity}: largest error of phi {error:.1e}");
        holds(error < 1e-8, "a spheroid of Maclaurin does not turn as it should")?;
    }

    let period = 2.0 * time_of_rest()?;
    println!("\noscillation from rest at a = 1.2: period {period:.12} ({PERIOD:.12} by quadrature)");
    holds((period - PERIOD).abs() < 1e-10, "the period of an oscillation is another")?;
    draw(period)?;

    let (there, back) = (motion(start()?)?, motion(adjoint(&start()?)?)?);
    let distance = (back.phi() - there.phi().transpose()).norm();
    println!("Dedekind: |phi'(10) - phi(10)^T| = {distance:.1e} of motions from phi(0) and phi(0)^T");
    holds(distance < 1e-10, "phi^T is no motion")?;
    figures_of_equilibrium()?;
    riemann_ellipsoids()?;
    println!("pictures: output/ellipsoids.svg, output/ellipsoid_branches.svg");
    Ok(())
}

/// What is known of the star, or the example ends there.
fn holds(is: bool, what: &str) -> Result<(), Box<dyn std::error::Error>> {
    is.then_some(()).ok_or_else(|| what.into())
}

/// From the ball at rest along the angular momentum `S_12`: the spheroids of Maclaurin, with the ellipsoids of Jacobi.
fn figures_of_equilibrium() -> Result<(), Box<dyn std::error::Error>> {
    let turn = [Generator::rotation(1, 2)];
    let along = |spin: f64| Ok((Star, vec![Condition::MomentumMap(0, spin)]));
    let ball = Star.at_velocity(Matrix::<3>::identity(), Matrix::<3>::zeros())?;
    let maclaurin = Continuation::new(&turn, (-0.01, 0.58), 0.08, along).run(&ball, 0.0)?;
    println!("\nfigures of equilibrium, from the ball at rest by the angular momentum: {maclaurin}");
    let eccentricity = |point: &BranchPoint<3, Point>| {
        let q = point.stretches();
        (1.0 - (q[2] / q[0]).powi(2)).sqrt()
    };
    let special =
        |kind: Special| maclaurin.special.iter().find(|(own, _)| *own == kind).map(|(_, point)| point);
    let jacobi = special(Special::Bifurcation).ok_or("no ellipsoids of Jacobi")?;
    let breaking = special(Special::Collision).ok_or("no dynamical instability")?;
    for (name, found, published) in [
        ("Jacobi branches off", eccentricity(jacobi), 0.812670010612),
        ("dynamical instability", eccentricity(breaking), 0.952886702034),
    ] {
        println!("  {name} at e = {found:.12} ({published})");
        holds((found - published).abs() < 1e-10, name)?;
    }
    let is_between = |point: &&BranchPoint<3, Point>| (0.85..0.95).contains(&eccentricity(point));
    let between = maclaurin.points.iter().find(is_between).ok_or("no point between")?;
    let negative = between.stability.stiffnesses.iter().filter(|stiffness| **stiffness < 0.0).count();
    println!("  between, e = {:.3}: {:?}", eccentricity(between), between.stability.verdict);
    println!(
        "    directions (up, down, level) where space and body share the turn: {:?}",
        between.stability.signature
    );
    println!("    directions down in the frame that turns: {negative}");
    let elongated = Continuation::new(&turn, (0.0, 0.5), 0.08, along).switch(jacobi, 0.04)?;
    let stable = elongated.points.iter().filter(|point| point.stability.verdict == StabilityVerdict::Stable);
    println!("  ellipsoids of Jacobi: {} of {} points stable", stable.count(), elongated.points.len());
    let (branches, axes) = ([&maclaurin, &elongated], ("angular momentum", "axes"));
    let diagram = branch_diagram("Maclaurin and Jacobi", &branches, axes, BranchPoint::stretches);
    diagram.save_svg("output/ellipsoid_branches.svg")?;
    Ok(())
}

/// An ellipsoid of Riemann of type S, one of Jacobi where `lambda = 0`: its axes turn at `Omega` in space, and what it is made of
/// along them at `lambda`; with its frequencies in the frame that turns, and the rate at which it breaks. All in units of
/// `(pi G rho)^(1/2)`, as Chandrasekhar has them.
struct Riemann {
    /// `b/a` and `c/a`.
    axes: [f64; 2],
    omega: f64,
    lambda: f64,
    frequencies: [f64; 4],
    growth: Option<f64>,
}

/// To 16 of 30 digits, by integrals of Carlson at 40 digits: frequencies as those of the amended potential and of 8 by 8 odd
/// blocks, and as the spectrum of the augmented Hamiltonian. The two even ones come first.
const RIEMANN: [Riemann; 4] = [
    Riemann {
        axes: [0.8, 0.5172160585801151],
        omega: 0.6056707328899238,
        lambda: 0.0,
        frequencies: [1.164333042765866, 1.285776179422469, 0.7952126926666512, 1.413038036546716],
        growth: None,
    },
    Riemann {
        axes: [0.9, 0.5],
        omega: 0.5861747442417786,
        lambda: 0.04904445314975895,
        frequencies: [1.07028495127457, 1.250276085718902, 0.8362313363476153, 1.375921116530418],
        growth: None,
    },
    Riemann {
        axes: [0.5, 0.3],
        omega: 0.4931920965744979,
        lambda: 0.1103966776135873,
        frequencies: [0.7390321548552794, 1.263140272585022, 0.8302108015804216, 1.313775140597097],
        growth: None,
    },
    Riemann {
        axes: [0.2, 0.26],
        omega: 0.3810779767801663,
        lambda: -0.2073658707133111,
        frequencies: [0.7170053049062802, 1.486930063913717, 1.520963497284105, 1.520963497284105],
        growth: Some(0.2103208908739031),
    },
];

/// Ellipsoids that turn in space and in themselves at once, found beside where they are, with what becomes of them.
fn riemann_ellipsoids() -> Result<(), Box<dyn std::error::Error>> {
    println!("\nellipsoids of Riemann, type S:");
    let turns = [Generator::rotation(1, 2), Generator::vorticity(1, 2)];
    for Riemann { axes: [b, c], omega, lambda, frequencies, growth } in RIEMANN {
        let unit = PI_G_RHO.sqrt();
        let [omega, lambda] = [omega, lambda].map(|velocity| velocity * unit);
        let axes = Vector::<3>::new(1.0, b, c) / (b * c).cbrt();
        let phi = Matrix::<3>::from_diagonal(&axes);
        let beside = Matrix::<3>::from_diagonal(&Vector::<3>::new(1.01, 1.0, 1.0 / 1.01)) * phi;
        let guess =
            Star.at_velocity(beside, turns[0].space * omega * beside + beside * turns[1].body * lambda)?;
        let conditions = [Condition::Velocity(0, omega), Condition::Velocity(1, lambda)];
        let found = relative_equilibrium(&Star, &guess, &turns, &conditions)?;
        let distance =
            (0..3).map(|k| (found.point.phi().column(k).norm() - axes[k]).abs()).fold(0.0, f64::max);
        let stability = found.stability(&Star)?;
        let missed = |known: f64| {
            let from = stability.eigenvalues.iter().map(|one| (one.value.im.abs() / unit - known).abs());
            from.fold(f64::INFINITY, f64::min)
        };
        let missed = frequencies.into_iter().map(missed).fold(0.0, f64::max);
        println!(
            "  b/a = {b:.1}, c/a = {c:.4}: {:?}, axes to {distance:.0e}, frequencies to {missed:.0e}",
            stability.verdict
        );
        let is_right = match (stability.verdict, growth) {
            (StabilityVerdict::Unstable { rate }, Some(known)) => (rate / unit - known).abs() < 1e-12,
            (StabilityVerdict::Stable | StabilityVerdict::LinearlyStable, None) => true,
            _ => false,
        };
        holds(
            distance < 1e-12 && missed < 1e-12 && is_right,
            "an ellipsoid of Riemann is not as it is known",
        )?;
    }
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
    let start = Star.at_velocity(phi, whirl * phi)?;
    let t_end = 2.0 * TAU / omega;
    let method = Method::Rattle { order: 8, step: 0.1 };
    let run = Simulation::new(&Star, start).until(t_end).every(t_end / 40.0).method(method).run()?;
    let error = |(t, point): (f64, &Point)| {
        let (s, c) = (omega * t).sin_cos();
        (point.phi() - Matrix::<3>::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0) * phi).norm()
    };
    Ok(run.iter().map(|(t, point)| error((t, point))).fold(0.0, f64::max))
}

/// When the star that starts from rest at `a = 1.2` is at rest again, at its other turning point: a zero of `Pi_33`.
fn time_of_rest() -> affine_runtime::Result<f64> {
    let start = Star.at_velocity(spheroid(1.2), Matrix::<3>::zeros())?;
    let momentum = |t: f64| -> affine_runtime::Result<f64> {
        let run = Simulation::new(&Star, start).until(t).tolerance(1e-14).run()?;
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
    let start = Star.at_velocity(spheroid(1.2), Matrix::<3>::zeros())?;
    let t_end = 2.0 * period;
    let run = Simulation::new(&Star, start).until(t_end).every(t_end / 300.0).run()?;
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
    Star.at_velocity(phi, phi * rate)
}

/// The transposed start.
fn adjoint(point: &Point) -> affine_runtime::Result<Point> {
    let velocity = Star.velocity(point);
    Star.at_velocity(point.phi().transpose(), velocity.phi_dot.transpose())
}

fn motion(start: Point) -> affine_runtime::Result<Point> {
    Ok(*Simulation::new(&Star, start).until(10.0).tolerance(1e-14).run()?.end().1)
}

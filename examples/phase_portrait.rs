//! Which planar geodesics are bounded: an ensemble, coloured by the exact threshold, and the lattice's effective potential.
//!
//! For `n = 2` the difference `x = (q_1 - q_2)/2` of the stretches moves by itself, in units of `alpha`, with
//! `E = p_x^2/4 + W(x)`, `p_x = p_1 - p_2`, in the effective potential
//!
//! ```text
//! W(x) = M^2/(16 sh^2 x) - N^2/(16 ch^2 x)                tr sigma^2 = 2 E
//! ```
//!
//! since `M` and `N` are constants. Where `|N| > |M|` there is a well, and motions with `tr sigma^2 < 0` stay in it: an open set.
//! In space it is a surface, `det sigma = 0`: the last lines count how many of a thousand nearly skew generators
//! are bounded in the plane and in space. The picture goes to `output/`.

use std::fs;

use affine_runtime::frames::Matrix;
use affine_runtime::lattice::{Growth, Lattice, LatticeFlow, MotionClass, TwoPolarForm};
use affine_runtime::prelude::*;
use affine_runtime::report::{Curve, CurveDiagram, CurvePanel};

/// Affine in space and in the body.
#[affine_model(dim = 2, kinetic(casimir2 = 1), emit(two_polar))]
pub struct PlanarBody;

/// The same in space.
#[affine_model(dim = 3, kinetic(casimir2 = 1), emit(two_polar))]
pub struct SpatialBody;

const M: f64 = 0.4;
const N: f64 = 1.6;
const T_END: f64 = 100.0;
/// Where the picture ends.
const FARTHEST: f64 = 3.4;

/// Colours of motions.
const BOUNDED: usize = 0;
const ESCAPING: usize = 1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let _ = fs::create_dir_all("output");
    let mut portrait = Vec::new();
    let mut levels = Vec::new();
    for k in 0..14 {
        let x = 0.3 + 0.1 * f64::from(k);
        // Moving inwards, so that motions that escape are seen to come and go.
        let start = at(x, -0.35);
        let point = PlanarBody.at_lattice(&start)?;
        let class = MotionClass::of(&PlanarBody, &point).map(|class| class.shear);
        let category = match class {
            Some(Growth::Bounded { .. }) => BOUNDED,
            _ => ESCAPING,
        };
        let energy = 0.5 * point.shear_casimir(2);
        println!("x = {x:.1}: tr sigma^2/2 = {energy:+.4}, {class:?}");
        // Once around.
        let until = match class {
            Some(Growth::Bounded { period: Some(period) }) => period.min(T_END),
            _ => T_END,
        };
        portrait.push(Curve { category, points: motion(&start, until)? });
        // Where the motion can be.
        let places = (1..=340).map(|k| 0.01 * f64::from(k)).filter(|x| effective(*x) <= energy);
        levels.push(Curve { category, points: places.map(|x| (x, energy)).collect() });
    }
    let well = (20..=340).map(|k| 0.01 * f64::from(k)).map(|x| (x, effective(x))).collect();
    levels.push(Curve { category: 2, points: well });
    let panel = |y: &str, range: Option<(f64, f64)>, curves: Vec<Curve>| CurvePanel {
        x: "x = (q1 - q2)/2".into(),
        y: y.into(),
        logarithmic: false,
        range,
        curves,
    };
    CurveDiagram::new(
        "Planar geodesics: bounded for tr sigma^2 < 0 (blue), escaping above (red)",
        vec![
            panel("p1 - p2", None, portrait),
            panel("effective potential (green), energies", Some((-0.1, 0.06)), levels),
        ],
    )
    .save_svg("output/phase_portrait.svg")?;
    println!("picture: output/phase_portrait.svg");
    let [plane, space] = nearly_skew()?;
    println!("bounded of 1000 nearly skew generators: {plane} in the plane, {space} in space");
    Ok(())
}

/// The lattice with a difference of stretches and of momenta.
fn at(x: f64, momentum: f64) -> Lattice<2> {
    let skew = |entry: f64| Matrix::<2>::new(0.0, entry, -entry, 0.0);
    Lattice {
        q: Vector::<2>::new(x, -x),
        p: Vector::<2>::new(0.5 * momentum, -0.5 * momentum),
        m: skew(M),
        n: skew(N),
        left: Matrix::<2>::identity(),
        right: Matrix::<2>::identity(),
    }
}

fn effective(x: f64) -> f64 {
    (M / x.sinh()).powi(2) / 16.0 - (N / x.cosh()).powi(2) / 16.0
}

/// `(x, p_1 - p_2)` along the motion, as long as it is in the picture.
fn motion(start: &Lattice<2>, until: f64) -> Result<Vec<(f64, f64)>, Box<dyn std::error::Error>> {
    let mut flow = LatticeFlow::new(&PlanarBody, 0.0, *start);
    let mut points = Vec::new();
    for k in 0..=1600 {
        let now = flow.advance_to(until / 1600.0 * f64::from(k))?;
        let x = 0.5 * (now.q[0] - now.q[1]);
        if x > FARTHEST {
            break;
        }
        points.push((x, now.p[0] - now.p[1]));
    }
    Ok(points)
}

/// How many of a thousand generators, skew but for a symmetric part of 5 percent, are bounded: in the plane, in space.
fn nearly_skew() -> affine_runtime::Result<[usize; 2]> {
    // Additive recurrences of irrational steps fill the cube evenly.
    let number = |k: usize, j: usize| {
        2.0 * (k as f64 * [0.754_878, 0.569_840, 0.819_173, 0.671_044][j % 4] * (1.0 + j as f64)).fract()
            - 1.0
    };
    let mut bounded = [0; 2];
    for k in 1..=1000 {
        let raw = Matrix::<3>::from_fn(|i, j| number(k, 3 * i + j));
        let symmetric = (raw + raw.transpose()) * 0.05;
        let sigma = raw - raw.transpose() + symmetric - Matrix::<3>::identity() * (symmetric.trace() / 3.0);
        let planar = Matrix::<2>::new(0.0, sigma[(0, 1)], sigma[(1, 0)], 0.0)
            + Matrix::<2>::new(sigma[(0, 0)], 0.0, 0.0, -sigma[(0, 0)]);
        let plane = PlanarBody.at_momentum(Matrix::<2>::identity(), Spatial(planar))?;
        let space = SpatialBody.at_momentum(Matrix::<3>::identity(), Spatial(sigma))?;
        let shears = [MotionClass::of(&PlanarBody, &plane), MotionClass::of(&SpatialBody, &space)];
        for (count, class) in bounded.iter_mut().zip(shears) {
            *count += usize::from(class.is_some_and(|class| matches!(class.shear, Growth::Bounded { .. })));
        }
    }
    Ok(bounded)
}

//! Frequencies of small vibrations.

use affine_runtime::analysis::{ModeClass, Modes, equilibrium};
use affine_runtime::model::Model;
use affine_runtime::nalgebra::Rotation3;
use affine_runtime::prelude::*;

use super::Row;

/// Affine inertia of a body, of which each axis has its own.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = a, casimir1_squared = b, body_inertia = diag(j1, j2, j3)),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c1)
)]
struct Body {
    j1: f64,
    j2: f64,
    j3: f64,
    a: f64,
    b: f64,
    kappa: f64,
    c1: f64,
}

/// The same in the plane.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = a, casimir1_squared = b, body_inertia = diag(j1, j2)),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c1)
)]
struct Plate {
    j1: f64,
    j2: f64,
    a: f64,
    b: f64,
    kappa: f64,
    c1: f64,
}

/// Affine inertia of space.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = a, casimir1_squared = b, space_inertia = i),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c1)
)]
struct Right {
    i: f64,
    a: f64,
    b: f64,
    kappa: f64,
    c1: f64,
}

/// D'Alembert's inertia.
#[affine_model(dim = 3, kinetic(dalembert = diag(j1, j2, j3)), potential = hyperbolic_dilatation(kappa) + neo_hookean(c1))]
struct Usual {
    j1: f64,
    j2: f64,
    j3: f64,
    kappa: f64,
    c1: f64,
}

/// Pulled along the last axis.
#[affine_model(
    dim = 3,
    kinetic(dalembert = j),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c1) - tau/2*(phi[3,1]^2 + phi[3,2]^2 + phi[3,3]^2)
)]
struct Pulled {
    j: f64,
    kappa: f64,
    c1: f64,
    tau: f64,
}

/// A centre of mass on a spring, of a body whose mass is an affine one.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = m),
    potential = k/2*(x[1]^2 + x[2]^2 + x[3]^2)
)]
struct OnSpring {
    m: f64,
    k: f64,
}

pub(super) fn assert_row(row: &Row) {
    if row.text("kind") == "equilibrium and modes" {
        return assert_pulled(row);
    }
    let of = |name: &str| row.parameter(name);
    let has_axes = row.has("parameters/j");
    match row.text("model") {
        "body_translation m, U = k |x|^2/2" => assert_on_spring(row),
        "R" => {
            let [i, a, b, kappa, c1] = ["I", "A", "B", "kappa", "c1"].map(of);
            let model = Right { i, a, b, kappa, c1 }.prepare().unwrap();
            assert_modes(&model, &model.at_velocity(near_one(), Matrix::<3>::zeros()).unwrap(), row);
        }
        "dalembert J" => {
            let [j1, j2, j3] = row.array("parameters/j");
            let model = Usual { j1, j2, j3, kappa: of("kappa"), c1: of("c1") }.prepare().unwrap();
            assert_modes(&model, &model.at_velocity(near_one(), Matrix::<3>::zeros()).unwrap(), row);
        }
        "L" | "body_inertia J + casimirs" if row.count("n") == 3 => {
            let [a, b, kappa, c1] = ["A", "B", "kappa", "c1"].map(of);
            let [j1, j2, j3] = if has_axes { row.array("parameters/j") } else { [of("I"); 3] };
            let model = Body { j1, j2, j3, a, b, kappa, c1 }.prepare().unwrap();
            assert_modes(&model, &model.at_velocity(near_one(), Matrix::<3>::zeros()).unwrap(), row);
        }
        "L" | "body_inertia J + casimirs" => {
            let [a, b, kappa, c1] = ["A", "B", "kappa", "c1"].map(of);
            let [j1, j2] = if has_axes { row.array("parameters/j") } else { [of("I"); 2] };
            let model = Plate { j1, j2, a, b, kappa, c1 }.prepare().unwrap();
            assert_modes(&model, &model.at_velocity(near_one(), Matrix::<2>::zeros()).unwrap(), row);
        }
        other => panic!("no model {other}"),
    }
}

fn near_one<const N: usize>() -> Matrix<N> {
    Matrix::<N>::identity() * 1.05
}

/// Shear and breathing where all axes are alike, pairs and a diagonal problem elsewhere.
fn assert_modes<const N: usize, M: Model<N>>(model: &M, guess: &M::Point<f64>, row: &Row) {
    let mut expected = Vec::new();
    if row.has("shear") {
        expected.push((row.number("shear"), ModeClass::Shear, row.count("shear_multiplicity")));
        expected.push((row.number("breathing"), ModeClass::Breathing, 1));
    } else {
        expected.extend(row.numbers("diagonal").into_iter().map(|one| (one, ModeClass::Diagonal, 1)));
        for (a, b) in [(1, 2), (1, 3), (2, 3)].into_iter().filter(|(_, b)| *b <= N) {
            let frequency = row.number(&format!("shear_ab/{a}{b}"));
            expected.push((frequency, ModeClass::Pair(a, b), 1));
        }
    }
    let modes = equilibrium(model, guess).unwrap().isolated().unwrap().modes(model).unwrap();
    assert_found(&modes, expected, row.count("zero_eigenvalues"));
}

/// Directions without restoring force are two eigenvalues each.
fn assert_found<const N: usize>(modes: &Modes<N>, mut expected: Vec<(f64, ModeClass, usize)>, zeros: usize) {
    expected.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(modes.modes.len(), expected.len(), "{modes}");
    for (mode, (frequency, class, multiplicity)) in modes.modes.iter().zip(&expected) {
        assert!((mode.frequency() - frequency).abs() < 1e-12, "{modes} and not {frequency}");
        assert!(mode.error < 1e-12);
        assert_eq!((mode.class, mode.multiplicity()), (*class, *multiplicity), "{modes}");
    }
    assert_eq!(2 * modes.zeros, zeros, "{modes}");
}

/// It has waves about its axis.
fn assert_pulled(row: &Row) {
    let [j, kappa, c1, tau] = ["j", "kappa", "c1", "tau"].map(|name| row.parameter(name));
    let pulled = Pulled { j, kappa, c1, tau }.prepare().unwrap();
    let start = Matrix::<3>::from_diagonal(&Vector::<3>::new(1.0, 1.0, 1.1));
    let guess = pulled.at_velocity(start, Matrix::<3>::zeros()).unwrap();
    let rest = equilibrium(&pulled, &guess).unwrap().isolated().unwrap();
    let phi = rest.point.phi();
    for (k, stretch) in row.numbers("phi").into_iter().enumerate() {
        assert!((phi[(k, k)] - stretch).abs() < 1e-13, "{phi}");
    }
    let mut expected = vec![
        (row.number("m1_twice"), ModeClass::Axial(1), 2),
        (row.number("m2_twice"), ModeClass::Axial(2), 2),
    ];
    expected.extend(row.numbers("m0").into_iter().map(|one| (one, ModeClass::Axial(0), 1)));
    let modes = rest.modes(&pulled).unwrap();
    assert_found(&modes, expected, row.count("zero_eigenvalues"));
    let path = std::env::temp_dir().join(format!("modes{}.svg", std::process::id()));
    modes.save_svg(&path).unwrap();
    let picture = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    assert!(picture.starts_with("<svg") && picture.contains("Axial(2)"));
}

/// `sqrt(k/m) Q_a`, wherever the body is turned.
fn assert_on_spring(row: &Row) {
    let model = OnSpring { m: row.parameter("m"), k: row.parameter("k") }.prepare().unwrap();
    let stretches = Vector::<3>::from(row.array("parameters/stretches_of_phi"));
    let [left, right] = [(0.3, -0.7, 1.1), (-0.4, 0.2, 0.9)]
        .map(|(a, b, c)| Rotation3::from_euler_angles(a, b, c).into_inner());
    let phi = left * Matrix::<3>::from_diagonal(&stretches) * right;
    let still = Vector::<3>::zeros();
    let guess = model.at_velocity(still, phi, still, Matrix::<3>::zeros());
    let rest = equilibrium(&model, &guess.unwrap()).unwrap();
    // Its stretches are held by nothing; turns are symmetries.
    assert_eq!((rest.kernel, rest.expected), (3, 0));
    let expected = row.numbers("frequencies").into_iter().map(|one| (one, ModeClass::Drift, 1));
    assert_found(&rest.modes(&model).unwrap(), expected.collect(), 18);
}

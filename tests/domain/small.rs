//! Energies of bodies of any size, in units that are not theirs, against the same body in its own: millimetres in metres have all
//! digits that metres have.

use affine_runtime::frames::Matrix;
use affine_runtime::prelude::*;

/// Relative error of the values: sums of some terms, of which some are differences.
const RELATIVE: f64 = 1e-13;

/// Sizes, as exponents of two: nothing is rounded where a body is scaled by them.
const SIZES: core::ops::RangeInclusive<i32> = -30..=20;

macro_rules! models {
    ($dim:literal: $($name:ident = $potential:expr;)*) => { $(
        #[affine_model(dim = $dim, kinetic(dalembert = 1), potential = $potential)]
        struct $name;
    )* };
}

macro_rules! models_with_fields {
    ($dim:literal: $($name:ident = $potential:expr;)*) => { $(
        #[affine_model(dim = $dim, kinetic(dalembert = 1), potential = $potential)]
        struct $name {
            k: f64,
            g: f64,
        }
    )* };
}

models! { 2:
    Linear2 = tr(G)/2;
    Square2 = tr(G)^2;
    OfSquare2 = tr(G^2);
    Cube2 = tr(G)^3;
    OfCube2 = tr(G^3);
    Difference2 = tr(G)^2/2 - tr(G^2)/4;
    Quartic2 = Q1^4 + Q2^4;
    Deviator2 = tr((G - tr(G)/n)^2);
    Mixed2 = tr(G)*tr(phi);
    Volume2 = tr(G)*det;
    Root2 = sqrt(tr(G));
    Degree2 = tr(G)^2/det^2;
}

#[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G) - 2*phi[2,2])]
struct Entries2;

models! { 3:
    Square3 = tr(G)^2;
    OfSquare3 = tr(G^2);
    Second3 = I2;
    Product3 = I1*I2;
    Quartic3 = Q1^4 + Q2^4 + Q3^4;
    Deviator3 = tr((G - tr(G)/n)^2);
    Shear3 = I1^2 - 3*I2;
    Inner3 = tr(G*Ct);
    Degree3 = I1*I2/I3;
}

models_with_fields! { 2:
    Rest2 = k*tr((G - g)^2);
    Relative2 = k*tr((G/g - 1)^2);
    Power2 = k*(tr(G) - 3*g)^4;
    Sum2 = k*tr(G)^2 + k*g*tr(G);
    Stiff2 = k*tr(G)^2/g;
    Pole2 = k/(tr(G)/g - 1);
    Logarithm2 = k*ln(tr(G)/g - 1);
}

models_with_fields! { 3:
    Rest3 = k*tr((G - g)^2);
    Relative3 = k*tr((G/g - 1)^2);
    Terms3 = k*I1*I2/g - k*g*I1;
    Scaled3 = k*tr((G - tr(G)/n)^2)/g;
    Pole3 = k/(tr(G^2)/g^2 - 1);
}

/// Of a body at size 1: `tr G`, `tr G^2`, `tr G^3`, `det phi`, `tr phi`, `tr(G Ct)`.
struct Plain {
    first: f64,
    of_square: f64,
    of_cube: f64,
    det: f64,
    trace: f64,
    inner: f64,
    /// `(tr G)^2 - tr G^2` by minors, halved.
    second: f64,
    /// `tr((G - tr(G)/n)^2)`
    deviator: f64,
    /// `tr((G - 1)^2)`
    strain: f64,
}

impl Plain {
    fn of<const N: usize>(phi: &Matrix<N>) -> Self {
        let (green, finger) = (phi.tr_mul(phi), phi * phi.transpose());
        let pairs = || (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b)));
        let minor = |(a, b): (usize, usize)| green[(a, a)] * green[(b, b)] - green[(a, b)] * green[(a, b)];
        let from = |number: f64| (green - Matrix::<N>::identity() * number).norm_squared();
        Self {
            first: green.trace(),
            of_square: (green * green).trace(),
            of_cube: (green * green * green).trace(),
            det: determinant(phi),
            trace: phi.trace(),
            inner: (green * finger).trace(),
            second: pairs().map(minor).sum(),
            deviator: from(green.trace() / N as f64),
            strain: from(1.0),
        }
    }
}

fn determinant<const N: usize>(phi: &Matrix<N>) -> f64 {
    let minor = |[a, b]: [usize; 2]| phi[(N - 2, a)] * phi[(N - 1, b)] - phi[(N - 2, b)] * phi[(N - 1, a)];
    match N {
        2 => minor([0, 1]),
        _ => {
            [[1, 2], [2, 0], [0, 1]].into_iter().enumerate().map(|(a, rest)| phi[(0, a)] * minor(rest)).sum()
        }
    }
}

/// Placements of no particular kind, with the body turned by some angles.
fn placements<const N: usize>() -> Vec<Matrix<N>> {
    let entries = [[1.05, 0.12, 0.2], [-0.23, 0.9, -0.15], [0.3, -0.1, 1.25]];
    let turned = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let mut turn = Matrix::<N>::identity();
        [turn[(0, 0)], turn[(1, 1)], turn[(0, 1)], turn[(1, 0)]] = [cos, cos, -sin, sin];
        turn * Matrix::from_fn(|i, a| entries[i][a])
    };
    [0.0, 0.4, -1.1].map(turned).into()
}

fn assert_close(what: &str, size: f64, found: f64, exact: f64) {
    assert!((found / exact - 1.0).abs() <= RELATIVE, "{what} at {size:e}: {found:e} is not {exact:e}");
}

/// At rest, the energy of a body is a power of its size times that of the body at size 1.
macro_rules! assert_energies {
    ($dim:literal, |$size:ident, $plain:ident|: $($model:expr, $degree:literal, $exact:expr;)*) => { $(
        for phi in placements::<$dim>() {
            let $plain = &Plain::of(&phi);
            let exact = $exact;
            for $size in SIZES.map(|exponent| f64::from(exponent).exp2()) {
                let model = $model;
                let point = model.at_velocity(phi * $size, Matrix::zeros()).unwrap();
                let found = model.hamiltonian(0.0, &point) / $size.powi($degree);
                assert_close(stringify!($model), $size, found, exact);
            }
        }
    )* };
}

/// A model whose square of a stretch at rest is that of the size.
macro_rules! fields {
    ($model:ident, $size:ident) => {
        $model { k: 0.7, g: $size * $size }.prepare().unwrap()
    };
}

#[test]
fn energies_of_planar_bodies_of_any_size() {
    assert_energies! { 2, |size, plain|:
        Linear2, 2, plain.first / 2.0;
        Square2, 4, plain.first.powi(2);
        OfSquare2, 4, plain.of_square;
        Cube2, 6, plain.first.powi(3);
        OfCube2, 6, plain.of_cube;
        Difference2, 4, plain.first.powi(2) / 2.0 - plain.of_square / 4.0;
        Quartic2, 4, plain.of_square;
        Deviator2, 4, plain.deviator;
        Mixed2, 3, plain.first * plain.trace;
        Volume2, 4, plain.first * plain.det;
        Root2, 1, plain.first.sqrt();
        Degree2, 0, (plain.first / plain.det).powi(2);
        fields!(Rest2, size), 4, 0.7 * plain.strain;
        fields!(Relative2, size), 0, 0.7 * plain.strain;
        fields!(Power2, size), 8, 0.7 * (plain.first - 3.0).powi(4);
        fields!(Sum2, size), 4, 0.7 * (plain.first.powi(2) + plain.first);
        fields!(Stiff2, size), 2, 0.7 * plain.first.powi(2);
        fields!(Pole2, size), 0, 0.7 / (plain.first - 1.0);
        fields!(Logarithm2, size), 0, 0.7 * (plain.first - 1.0).ln();
    }
}

#[test]
fn energies_of_bodies_in_space_of_any_size() {
    assert_energies! { 3, |size, plain|:
        Square3, 4, plain.first.powi(2);
        OfSquare3, 4, plain.of_square;
        Second3, 4, plain.second;
        Product3, 6, plain.first * plain.second;
        Quartic3, 4, plain.of_square;
        Deviator3, 4, plain.deviator;
        Shear3, 4, 1.5 * plain.deviator;
        Inner3, 4, plain.inner;
        Degree3, 0, plain.first * plain.second / plain.det.powi(2);
        fields!(Rest3, size), 4, 0.7 * plain.strain;
        fields!(Relative3, size), 0, 0.7 * plain.strain;
        fields!(Terms3, size), 4, 0.7 * plain.first * (plain.second - 1.0);
        fields!(Scaled3, size), 2, 0.7 * plain.deviator;
        fields!(Pole3, size), 0, 0.7 / (plain.of_square - 1.0);
    }
}

/// Functions that keep their sign are none the less when the body is small.
#[test]
fn functions_of_the_domain_of_bodies_of_any_size() {
    for size in SIZES.map(|exponent| f64::from(exponent).exp2()) {
        for phi in placements::<2>() {
            let model = fields!(Pole2, size);
            let point = model.at_velocity(phi * size, Matrix::zeros()).unwrap();
            let mut found = Vec::new();
            model.domain(0.0, &point, &mut |value| found.push(value));
            assert_eq!(found.len(), 1);
            assert_close("tr(G)/g - 1", size, found[0], Plain::of(&phi).first - 1.0);
        }
    }
}

/// A body of nanometres in metres goes as the same body at size 1: neither its energy is lost, nor a function that keeps its sign.
#[test]
fn runs_of_bodies_of_any_size() {
    let ends = [-30, -13, 0, 20].map(|exponent| {
        let size = f64::from(exponent).exp2();
        let model = Pole2 { k: 0.7 * size * size, g: size * size }.prepare().unwrap();
        let phi = placements::<2>()[1] * size;
        let rate = Matrix::<2>::new(0.1, -0.4, 0.5, -0.1) * size;
        let start = model.at_velocity(phi, rate).unwrap();
        let run = Simulation::new(&model, start).until(4.0).tolerance(1e-9).run().unwrap();
        assert!(!run.why().to_string().contains("energy is off"), "{}", run.why());
        run.end().1.phi() / size
    });
    assert!(ends.iter().all(|end| (end - ends[2]).norm() < 1e-8), "{ends:?}");
}

/// Energies that vanish in the undeformed state keep digits of small strains: what rounding leaves is `eps` times the strain, not
/// `eps`, which would be all of them.
#[test]
fn small_strains_keep_their_digits() {
    fn strained<const N: usize>(strain: f64) -> [Matrix<N>; 2] {
        let entries = [[0.75, 0.25, -0.5], [0.125, -0.5, 1.0], [0.375, -0.25, 0.5]];
        let change = Matrix::<N>::from_fn(|i, a| strain * entries[i][a]);
        [Matrix::identity() + change, change + change.transpose() + change.tr_mul(&change)]
    }
    let assert_close = |what: &str, strain: f64, found: f64, exact: f64| {
        let error = (found - exact).abs();
        assert!(error <= 8.0 * f64::EPSILON * strain, "{what} at {strain:e}: {found:e} is not {exact:e}");
    };
    for strain in [-10, -20, -24].map(|exponent: i32| f64::from(exponent).exp2()) {
        let ([plane, of_plane], [space, of_space]) = (strained::<2>(strain), strained::<3>(strain));
        let size = 1.0;
        macro_rules! assert_energies {
            ($phi:ident: $($model:expr, $exact:expr;)*) => { $(
                let model = $model;
                let point = model.at_velocity($phi, Matrix::zeros()).unwrap();
                assert_close(stringify!($model), strain, model.hamiltonian(0.0, &point), $exact);
            )* };
        }
        let deviator = |squares: f64, trace: f64, n: f64| squares - trace * trace / n;
        assert_energies! { plane:
            fields!(Rest2, size), 0.7 * of_plane.norm_squared();
            fields!(Relative2, size), 0.7 * of_plane.norm_squared();
            Deviator2, deviator(of_plane.norm_squared(), of_plane.trace(), 2.0);
            Entries2, of_plane.trace() + strain;
        }
        assert_energies! { space:
            fields!(Rest3, size), 0.7 * of_space.norm_squared();
            Deviator3, deviator(of_space.norm_squared(), of_space.trace(), 3.0);
            Shear3, 1.5 * deviator(of_space.norm_squared(), of_space.trace(), 3.0);
        }
    }
}

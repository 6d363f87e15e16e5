//! The two-polar decomposition against high-precision values, and its labels along motions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_runtime::Error;
use affine_runtime::decompose::{LinearMap, Polar, TwoPolar};
use affine_runtime::frames::{Matrix, Vector};
use proptest::prelude::*;

/// Tolerances, in units of `eps`. Errors of a rounding are up to half a unit.
mod tolerance {
    /// Error of a stretch of a 2x2 matrix relative to itself: two roots, a determinant, a quotient. Largest seen: 1.6.
    pub(crate) const PLANAR: f64 = 4.0;
    /// Error of a stretch of a 3x3 matrix relative to the largest one, and relative to itself where rows or columns are
    /// graded: up to 15 rotations of the columns, each with two roundings. Largest seen: 3.2.
    pub(crate) const SPATIAL: f64 = 8.0;
    /// Largest entry of `L^T L - 1`, `R^T R - 1`: the same rotations.
    pub(crate) const ORTHOGONAL: f64 = 16.0;
    /// Largest entry of `L D R^T - phi` over the largest stretch: both, and the product.
    pub(crate) const PRODUCT: f64 = 24.0;
}

struct Case {
    kind: String,
    phi: Vec<f64>,
    /// High and low part.
    stretches: Vec<[f64; 2]>,
}

fn cases(n: usize) -> Vec<Case> {
    let rows = include_str!("data/two_polar.csv").lines().filter(|line| !line.starts_with('#'));
    let cases: Vec<Case> = rows
        .map(|row| row.split(',').collect::<Vec<_>>())
        .filter(|fields| fields[0] == n.to_string())
        .map(|fields| {
            let numbers: Vec<f64> = fields[2..].iter().map(|field| field.parse().unwrap()).collect();
            let (phi, stretches) = numbers.split_at(n * n);
            assert_eq!(stretches.len(), 2 * n);
            let stretches = stretches.chunks(2).map(|parts| [parts[0], parts[1]]).collect();
            Case { kind: fields[1].to_string(), phi: phi.to_vec(), stretches }
        })
        .collect();
    assert_eq!(cases.len(), [312, 317][n - 2], "the data file was cut");
    cases
}

fn assert_stretches<const N: usize>(everywhere_relative: bool, allowed: f64) {
    let mut worst = 0.0_f64;
    for case in cases(N) {
        let phi = Matrix::<N>::from_row_slice(&case.phi);
        let found = match TwoPolar::of(&phi) {
            Ok(found) => found,
            Err(error) => panic!("{}: {error}", case.kind),
        };
        let relative = everywhere_relative || case.kind.contains("graded");
        for (a, [high, low]) in case.stretches.iter().enumerate() {
            let unit = if relative { *high } else { case.stretches[0][0] };
            let error = ((found.stretches[a] - high) - low).abs() / unit / f64::EPSILON;
            assert!(error <= allowed, "{}: stretch {a} of {phi:?} off by {error} eps", case.kind);
            worst = worst.max(error);
        }
        assert_decomposes(&found, &phi, &case.kind);
    }
    println!("n = {N}: worst error of a stretch {worst:.2} eps");
}

fn assert_decomposes<const N: usize>(found: &TwoPolar<N>, phi: &Matrix<N>, what: &str) {
    for frame in [&found.left, &found.right] {
        let defect = (frame.tr_mul(frame) - Matrix::<N>::identity()).amax() / f64::EPSILON;
        assert!(defect <= tolerance::ORTHOGONAL, "{what}: orthogonal to {defect} eps");
        assert!(minors(frame) > 0.0, "{what}: a reflection");
    }
    let largest = found.stretches.amax();
    let defect = (found.placement() / largest - phi / largest).amax() / f64::EPSILON;
    assert!(defect <= tolerance::PRODUCT, "{what}: the product is off by {defect} eps");
}

/// The determinant.
fn minors<const N: usize>(m: &Matrix<N>) -> f64 {
    let planar = |i: usize, j: usize| m[(N - 2, i)] * m[(N - 1, j)] - m[(N - 2, j)] * m[(N - 1, i)];
    if N == 2 {
        planar(0, 1)
    } else {
        m[(0, 0)] * planar(1, 2) - m[(0, 1)] * planar(0, 2) + m[(0, 2)] * planar(0, 1)
    }
}

#[test]
fn planar_stretches_are_exact_to_a_few_roundings() {
    assert_stretches::<2>(true, tolerance::PLANAR);
}

#[test]
fn spatial_stretches_are_exact_to_a_few_roundings() {
    assert_stretches::<3>(false, tolerance::SPATIAL);
}

#[test]
fn polar_factors_are_those_of_the_stretches() {
    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let found = Polar::of(&phi).unwrap();
    for product in [found.rotation * found.right_stretch, found.left_stretch * found.rotation] {
        assert!((product - phi).amax() < 4e-15);
    }
    // A^2 = phi^T phi, B^2 = phi phi^T.
    assert!((found.right_stretch * found.right_stretch - phi.tr_mul(&phi)).amax() < 1e-14);
    assert!((found.left_stretch * found.left_stretch - phi * phi.transpose()).amax() < 1e-14);
    assert!((found.rotation.tr_mul(&found.rotation) - Matrix::<3>::identity()).amax() < 4e-15);
}

#[test]
fn no_placement_is_refused() {
    for phi in [
        Matrix::<2>::new(1.0, 0.0, 0.0, -1.0),
        Matrix::<2>::new(1.0, 2.0, 2.0, 4.0),
        Matrix::<2>::zeros(),
        Matrix::<2>::new(1.0, f64::NAN, 0.0, 1.0),
        Matrix::<2>::new(f64::INFINITY, 0.0, 0.0, 1.0),
    ] {
        assert!(matches!(TwoPolar::of(&phi), Err(Error::Placement { .. })), "{phi:?}");
        let mut space = Matrix::<3>::identity();
        space.fixed_view_mut::<2, 2>(1, 1).copy_from(&phi);
        assert!(matches!(TwoPolar::of(&space), Err(Error::Placement { .. })), "{space:?}");
    }
}

/// A placement of determinant 1 whose stretches no quotient of numbers tells: it is not said to turn the body inside out.
#[test]
fn stretches_that_differ_beyond_all_numbers() {
    let phi = Matrix::<2>::new(1e200, 1e200, 1e-200, 2e-200);
    assert!((phi.mean_log_stretch()).abs() < 1e-12, "ln(det phi)/2 = 0");
    let error = TwoPolar::of(&phi).unwrap_err();
    assert_eq!(error, Error::NotFinite { quantity: "a quotient of stretches" });
    assert!(!error.to_string().contains("det phi"), "{error}");
}

/// A motion with known frames and stretches; `crossings` of its labels between `t = 0` and `t = 1`.
fn assert_followed<const N: usize>(known: impl Fn(f64) -> TwoPolar<N>, steps: u32, axes: f64) {
    let mut now = known(0.0);
    for k in 1..=steps {
        let t = f64::from(k) / f64::from(steps);
        let expected = known(t);
        now = now.continued(&expected.placement()).unwrap();
        let stretches = (now.stretches - expected.stretches).amax() / expected.stretches.amax();
        assert!(stretches < 1e-14, "t = {t}: stretches off by {stretches:e}");
        // Axes are as uncertain as the stretches are near to each other.
        let gap = (0..N).flat_map(|a| (0..a).map(move |b| (a, b))).fold(f64::INFINITY, |least, (a, b)| {
            least.min((expected.stretches[a] - expected.stretches[b]).abs())
        });
        if gap > 1e-9 {
            let frames = (now.left - expected.left).amax().max((now.right - expected.right).amax());
            assert!(frames < axes / gap, "t = {t}: frames off by {frames:e}, gap {gap:e}");
        }
    }
}

fn rotation(a: f64, b: f64, c: f64) -> Matrix<3> {
    Matrix::<3>::new(0.0, -c, b, c, 0.0, -a, -b, a, 0.0).skew_exponential()
}

#[test]
fn labels_follow_crossings_in_the_plane() {
    let turn = |angle: f64| Matrix::<2>::new(angle.cos(), -angle.sin(), angle.sin(), angle.cos());
    let known = |t: f64| TwoPolar {
        left: turn(7.0 * t),
        stretches: Vector::<2>::new(0.6 + t, 1.4 - 0.8 * t),
        right: turn(-3.0 * t + 2.0),
    };
    assert_followed(known, 90, 1e-14);
}

#[test]
fn labels_follow_crossings_in_space() {
    let known = |t: f64| TwoPolar {
        left: rotation(5.0 * t, 1.0 + t, -2.0 * t),
        stretches: Vector::<3>::new(0.6 + t, 1.5 - t, 1.1 + 0.3 * (5.0 * t).sin()),
        right: rotation(0.3, -4.0 * t, 2.0 * t),
    };
    assert_followed(known, 200, 1e-14);
}

/// At coincidence the axes are not determined by the placement; the nearest ones keep the frames from jumping.
#[test]
fn frames_stand_still_where_stretches_coincide() {
    let (left, right) = (rotation(0.4, -0.2, 1.0), rotation(-0.7, 0.1, 0.3));
    for stretches in [[1.5, 1.5, 0.7], [0.7, 1.5, 1.5], [1.5, 0.7, 1.5], [1.5, 1.5, 1.5]] {
        let known = TwoPolar { left, stretches: Vector::from(stretches), right };
        let found = known.continued(&known.placement()).unwrap();
        let jump = (found.left - left).amax().max((found.right - right).amax());
        assert!(jump < 1e-14, "{stretches:?}: {jump:e}");
        assert!((found.stretches - known.stretches).amax() < 1e-14, "{stretches:?}");
    }
}

/// Every relabelling is a decomposition; there are `2^(n-1) n!`.
#[test]
fn relabellings_are_signed_permutations() {
    let known = TwoPolar {
        left: rotation(0.4, -0.2, 1.0),
        stretches: Vector::<3>::new(0.5, 2.0, 1.1),
        right: rotation(-0.7, 0.1, 0.3),
    };
    let phi = known.placement();
    let mut count = 0;
    for code in 0..(3_u32.pow(9)) {
        let w = Matrix::<3>::from_fn(|i, j| f64::from(code / 3_u32.pow((3 * i + j) as u32) % 3) - 1.0);
        if w.tr_mul(&w) != Matrix::<3>::identity() || minors(&w) != 1.0 {
            continue;
        }
        count += 1;
        let other = known.relabelled(&w);
        assert!((other.placement() - phi).amax() < 1e-14);
        let back = other.continued(&phi).unwrap();
        assert!((back.left - other.left).amax() < 1e-13 && (back.right - other.right).amax() < 1e-13);
    }
    assert_eq!(count, 24);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(256) })]

    /// Whatever the entries: a decomposition, or a determinant that is not positive to rounding.
    #[test]
    fn every_matrix_decomposes_or_is_refused(entries in prop::array::uniform9(-3.0..3.0_f64)) {
        let phi = Matrix::<3>::from_row_slice(&entries);
        let plane = Matrix::<2>::from_row_slice(&entries[..4]);
        match TwoPolar::of(&phi) {
            Ok(found) => assert_decomposes(&found, &phi, "random"),
            Err(_) => prop_assert!(minors(&phi) < 1e-12),
        }
        match TwoPolar::of(&plane) {
            Ok(found) => assert_decomposes(&found, &plane, "random"),
            Err(_) => prop_assert!(minors(&plane) < 1e-12),
        }
    }

    /// `phi -> c phi` multiplies the stretches and leaves the frames, exactly for powers of two.
    #[test]
    fn scales_exactly(entries in prop::array::uniform9(-1.0..1.0_f64), power in -900..900_i32) {
        let phi = Matrix::<3>::from_row_slice(&entries).exponential();
        let scale = 2.0_f64.powi(power);
        let (plain, scaled) = (TwoPolar::of(&phi).unwrap(), TwoPolar::of(&(phi * scale)).unwrap());
        prop_assert_eq!(plain.left, scaled.left);
        prop_assert_eq!(plain.right, scaled.right);
        prop_assert_eq!(plain.stretches * scale, scaled.stretches);
    }
}

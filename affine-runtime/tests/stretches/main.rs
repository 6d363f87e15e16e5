//! Stretches and principal axes against high-precision values: generic, coincident and nearly coincident stretches, near
//! the undeformed body, and over random placements of every condition.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::excessive_precision)]

mod placements;

use affine_runtime::__private::{principal_log_stretches, principal_stretches};
use affine_runtime::decompose::LinearMap;
use affine_runtime::dual::Dual;
use affine_runtime::frames::Matrix;
use affine_runtime::scalar::Scalar;
use placements::{PLACEMENTS_2, PLACEMENTS_3};

pub(crate) struct Case<const N: usize> {
    phi: [[f64; N]; N],
    log_stretches: [f64; N],
    /// `sum_a q_a^3 R_a R_a^T`
    cubes: [[f64; N]; N],
    /// `sum_a q_a^4`
    fourth_powers: f64,
}

/// A stretch to a few units of rounding of the largest one; a log-stretch that much over the stretch.
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

fn sorted<const N: usize>(mut values: [f64; N]) -> [f64; N] {
    values.sort_by(f64::total_cmp);
    values
}

fn kernel_is_accurate<const N: usize>(cases: &[Case<N>]) {
    for case in cases {
        let (stretches, stretched, axes) = principal_stretches(case.phi);
        let largest = case.log_stretches[N - 1].exp();
        for (stretch, log) in sorted(stretches).into_iter().zip(case.log_stretches) {
            assert!(
                (stretch - log.exp()).abs() <= ROUNDINGS * largest,
                "{stretches:?} {:?}",
                case.log_stretches
            );
        }
        for (i, k) in (0..N).flat_map(|i| (0..N).map(move |k| (i, k))) {
            let image: f64 = (0..N).map(|a| case.phi[i][a] * axes[a][k]).sum();
            assert!((image - stretched[i][k]).abs() <= ROUNDINGS * largest, "phi R");
        }
        // A function of G, whatever axes were chosen where stretches coincide.
        let q = stretches.map(f64::ln);
        let steepest = q.iter().fold(0.0, |most: f64, q| most.max(3.0 * q * q));
        let size = q.iter().fold(0.0, |most: f64, q| most.max(q.abs().powi(3)));
        // What an error of a stretch makes of q and q^3; axes turn by an error over a gap, functions differ by the gap.
        let least = case.log_stretches[0].exp();
        let tolerance = ROUNDINGS * (size + (steepest + ROUNDINGS) * largest / least);
        for (a, b) in (0..N).flat_map(|a| (0..N).map(move |b| (a, b))) {
            let found: f64 = (0..N).map(|k| q[k].powi(3) * axes[a][k] * axes[b][k]).sum();
            let error = (found - case.cubes[a][b]).abs();
            assert!(error <= tolerance, "{error:e} of {size:e} at {:?}", case.log_stretches);
        }
    }
}

#[test]
fn functions_of_stretches() {
    kernel_is_accurate(&PLACEMENTS_2);
    kernel_is_accurate(&PLACEMENTS_3);
}

/// The kernel that counts from the undeformed body is as good far from it, and keeps the digits of `phi - 1` near it.
fn kernel_keeps_the_digits_of_strains<const N: usize>(cases: &[Case<N>]) {
    for case in cases {
        let (stretches, q, stretched, axes) = principal_log_stretches(case.phi);
        let largest = case.log_stretches[N - 1].exp();
        for (i, k) in (0..N).flat_map(|i| (0..N).map(move |k| (i, k))) {
            let image: f64 = (0..N).map(|a| case.phi[i][a] * axes[a][k]).sum();
            assert!((image - stretched[i][k]).abs() <= ROUNDINGS * largest, "phi R");
        }
        for (stretch, log) in sorted(stretches).into_iter().zip(case.log_stretches) {
            assert!((stretch - log.exp()).abs() <= ROUNDINGS * largest, "{stretches:?}");
        }
        let least = case.log_stretches[0].exp();
        let square = |i: usize, a: usize| (case.phi[i][a] - f64::from(u8::from(i == a))).powi(2);
        let strain = (0..N).flat_map(|i| (0..N).map(move |a| square(i, a))).sum::<f64>().sqrt();
        let size = if strain < 0.05 { strain } else { largest / least };
        let steepest = q.iter().fold(0.0, |most: f64, q| most.max(3.0 * q * q));
        let tolerance = ROUNDINGS * size * steepest;
        for (a, b) in (0..N).flat_map(|a| (0..N).map(move |b| (a, b))) {
            let found: f64 = (0..N).map(|k| q[k].powi(3) * axes[a][k] * axes[b][k]).sum();
            let error = (found - case.cubes[a][b]).abs();
            assert!(error <= tolerance, "{error:e} of {tolerance:e} at {:?}", case.log_stretches);
        }
    }
}

#[test]
fn functions_of_log_stretches() {
    kernel_keeps_the_digits_of_strains(&PLACEMENTS_2);
    kernel_keeps_the_digits_of_strains(&PLACEMENTS_3);
}

/// Near the undeformed body relative to the largest log-stretch, elsewhere to the condition of the placement.
fn log_stretches_are_accurate<const N: usize>(cases: &[Case<N>]) {
    for case in cases {
        let phi = Matrix::<N>::from_fn(|i, a| case.phi[i][a]);
        let found = sorted(phi.log_stretches());
        let spread = case.log_stretches[N - 1] - case.log_stretches[0];
        let strain = (phi - Matrix::<N>::identity()).norm();
        let size = if strain < 0.05 { strain } else { spread.exp() };
        for (q, expected) in found.into_iter().zip(case.log_stretches) {
            assert!((q - expected).abs() <= ROUNDINGS * size, "{found:?} {:?}", case.log_stretches);
        }
        let energy: f64 = found.iter().map(|q| q.powi(4)).sum();
        let largest = found.iter().fold(0.0, |most: f64, q| most.max(q.abs()));
        let error = (energy - case.fourth_powers).abs();
        assert!(error <= 4.0 * N as f64 * ROUNDINGS * size * largest.powi(3), "{error:e} of {energy:e}");
    }
}

#[test]
fn log_stretches_near_and_far() {
    log_stretches_are_accurate(&PLACEMENTS_2);
    log_stretches_are_accurate(&PLACEMENTS_3);
    assert_eq!(Matrix::<3>::identity().log_stretches(), [0.0; 3]);
}

/// Uniform in (-1, 1).
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// The largest cosine between two columns.
fn cosine<const N: usize>(rows: &[[f64; N]; N]) -> f64 {
    let dot = |a: usize, b: usize| (0..N).map(|i| rows[i][a] * rows[i][b]).sum::<f64>();
    let pairs = (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b)));
    pairs.map(|(a, b)| dot(a, b).abs() / (dot(a, a) * dot(b, b)).sqrt()).fold(0.0, f64::max)
}

/// The fixed number of sweeps is enough: columns are orthogonal to rounding, relative to each of them.
fn sweeps_suffice<const N: usize>() {
    let mut uniform = Uniform(5);
    for sample in 0..20_000 {
        let grade = [0.0, 1.0, 4.0, 8.0][sample % 4];
        let by_column = sample % 3 == 0;
        let off_diagonal = if sample % 5 == 0 { 1e-9 } else { 1.0 };
        let phi: [[f64; N]; N] = core::array::from_fn(|i| {
            core::array::from_fn(|a| {
                let small = if i == a { 1.0 } else { off_diagonal };
                uniform.next() * small * 10f64.powf(-grade * (if by_column { a } else { i }) as f64)
            })
        });
        let (_, stretched, axes) = principal_stretches(phi);
        assert!(cosine(&stretched) <= 4.0 * f64::EPSILON, "{phi:?}: {:e}", cosine(&stretched));
        assert!(cosine(&axes) <= 8.0 * f64::EPSILON, "{phi:?}: {:e}", cosine(&axes));
        let (.., stretched, axes) = principal_log_stretches(phi);
        assert!(cosine(&stretched) <= 8.0 * f64::EPSILON, "{phi:?}: {:e}", cosine(&stretched));
        assert!(cosine(&axes) <= 8.0 * f64::EPSILON, "{phi:?}: {:e}", cosine(&axes));
    }
}

#[test]
fn every_condition() {
    sweeps_suffice::<2>();
    sweeps_suffice::<3>();
}

/// Exactly coincident stretches, other scales and other precision.
#[test]
fn special_placements() {
    for scale in [1e-100, 1.0, 1e100] {
        let (stretches, _, axes) =
            principal_stretches([[scale, 0.0, 0.0], [0.0, scale, 0.0], [0.0, 0.0, scale]]);
        for stretch in stretches {
            assert!((stretch / scale - 1.0).abs() <= ROUNDINGS, "{stretches:?}");
        }
        assert_eq!(axes, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        let (_, logs, _, same) =
            principal_log_stretches([[scale, 0.0, 0.0], [0.0, scale, 0.0], [0.0, 0.0, scale]]);
        let error = logs.map(|log| (log - scale.ln()).abs()).into_iter().fold(0.0, f64::max);
        assert!(error <= ROUNDINGS * scale.ln().abs(), "{logs:?}");
        assert_eq!(axes, same);
    }
    assert_eq!(principal_log_stretches([[1.0f32, 0.0], [0.0, 1.0]]).1, [0.0; 2]);
    let (stretches, ..) = principal_stretches([[1.0f32, 0.0], [0.0, 1.0]]);
    assert!(
        stretches.iter().all(|stretch| Scalar::abs(*stretch - 1.0) <= 4.0 * f32::EPSILON),
        "{stretches:?}"
    );
    // Columns of one length and any angle.
    let (stretches, stretched, _) = principal_stretches([[1.0, 0.6], [0.0, 0.8]]);
    let expected = [0.4f64.sqrt(), 1.6f64.sqrt()];
    for (stretch, expected) in sorted(stretches).into_iter().zip(expected) {
        assert!((stretch - expected).abs() <= ROUNDINGS, "{stretches:?}");
    }
    assert!(cosine(&stretched) <= 4.0 * f64::EPSILON);
    assert!(principal_stretches([[f64::NAN, 0.0], [0.0, 1.0]]).0[0].is_nan());
}

/// As far as the page says that squares of entries have their digits: a shear has the golden ratio and its inverse.
#[test]
fn log_stretches_of_any_size() {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt()).ln();
    for size in [1e-140, 1e-100, 1e-30, 1.0, 1e30, 1e100, 1e150] {
        let logarithms = sorted((Matrix::<2>::new(1.0, 1.0, 0.0, 1.0) * size).log_stretches());
        for (found, expected) in logarithms.into_iter().zip([size.ln() - golden, size.ln() + golden]) {
            assert!((found - expected).abs() <= ROUNDINGS * expected.abs(), "{size:e}: {found} {expected}");
        }
    }
}

/// `dq = tr(phi^-1 dphi)/n`, at the undeformed body too, where the logarithm is that of 1.
#[test]
fn the_mean_log_stretch_has_its_derivative() {
    for phi in
        [Matrix::<2>::identity(), Matrix::<2>::new(1.1, 0.2, -0.1, 0.9), Matrix::<2>::new(3.0, 0.2, 0.5, 0.4)]
    {
        let change = Matrix::<2>::new(0.3, -0.5, 0.7, 0.2);
        let varied =
            Matrix::<2, Dual<f64>>::from_fn(|i, j| Dual { value: phi[(i, j)], slope: change[(i, j)] });
        let expected = (phi.try_inverse().unwrap() * change).trace() / 2.0;
        let found = varied.mean_log_stretch();
        assert!((found.slope - expected).abs() < 1e-14, "{} {expected}", found.slope);
        assert!((found.value - phi.mean_log_stretch()).abs() < 1e-15);
    }
}

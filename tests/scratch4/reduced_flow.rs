use affine_runtime::frames::Matrix;
use affine_runtime::lattice::Lattice;
use affine_runtime::prelude::*;
/// A lattice with stretches apart.
pub(crate) fn start<const N: usize>() -> Lattice<N> {
    let skew = |entries: [f64; 3]| {
        let mut matrix = Matrix::<N>::zeros();
        for (k, (a, b)) in (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b))).enumerate() {
            matrix[(a, b)] = entries[k];
            matrix[(b, a)] = -entries[k];
        }
        matrix
    };
    let turn = |entries: [f64; 3]| affine_runtime::decompose::skew_exponential(&skew(entries));
    Lattice {
        q: Vector::<N>::from_fn(|a, _| [0.9, 0.1, -0.7][a]),
        p: Vector::<N>::from_fn(|a, _| [0.15, -0.3, 0.2][a]),
        m: skew([0.5, -0.4, 0.3]),
        n: skew([0.6, 0.25, -0.45]),
        left: turn([0.4, -0.2, 0.7]),
        right: turn([-0.3, 0.5, 0.1]),
    }
}

/// Largest difference relative to the larger of 1 and the size.
pub(crate) fn distance<const N: usize>(a: &Lattice<N>, b: &Lattice<N>) -> f64 {
    let relative = |a: &[f64], b: &[f64]| {
        let size = b.iter().fold(1.0_f64, |most, v| most.max(v.abs()));
        a.iter().zip(b).map(|(a, b)| (a - b).abs() / size).fold(0.0, f64::max)
    };
    [
        relative(a.q.as_slice(), b.q.as_slice()),
        relative(a.p.as_slice(), b.p.as_slice()),
        relative(a.m.as_slice(), b.m.as_slice()),
        relative(a.n.as_slice(), b.n.as_slice()),
        relative(a.left.as_slice(), b.left.as_slice()),
        relative(a.right.as_slice(), b.right.as_slice()),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}


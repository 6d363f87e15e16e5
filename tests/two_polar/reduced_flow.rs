//! The lattice against the motion of the placement, and against itself in models that share it.

use affine_runtime::frames::Matrix;
use affine_runtime::integrate::RungeKutta8;
use affine_runtime::lattice::{Lattice, LatticeFlow, TwoPolarForm};
use affine_runtime::prelude::*;

use crate::models::*;

/// Relative error of `q, p, M, N, L, R` at `t = 10`.
const FLOW: f64 = 1e-11;
const T_END: f64 = 10.0;

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

/// Hamilton's equations of `phi` and its momentum, decomposed along the way.
fn through_placements<const N: usize, M: TwoPolarForm<N>>(model: &M, start: &Lattice<N>) -> Lattice<N> {
    let mut lattice = *start;
    let point = model.at_lattice(start).unwrap();
    let rates = |t: f64, y: &M::Full<f64>| model.hamilton_equations(t, y);
    let full = (0.0, model.flatten(&point));
    let mut steps = RungeKutta8::new(rates, M::DESCRIPTION.full, full, T_END, 3e-15).unwrap();
    while !steps.is_finished() {
        steps.advance().unwrap();
        lattice = model.lattice_after(&model.unflatten(steps.y()), &lattice).unwrap();
    }
    lattice
}

fn assert_same_motion<const N: usize, M: TwoPolarForm<N>>(model: &M) {
    let start = start::<N>();
    let back = model.lattice_after(&model.at_lattice(&start).unwrap(), &start).unwrap();
    let conversion = distance(&back, &start);
    assert!(conversion < 1e-14, "there and back: {conversion:e}");
    let mut flow = LatticeFlow::new(model, 0.0, start).tolerance(1e-14);
    let reduced = *flow.advance_to(T_END).unwrap();
    let full = through_placements(model, &start);
    let error = distance(&reduced, &full);
    println!(
        "{}: {error:.1e}, steps {:?}, H {}",
        M::DESCRIPTION.name,
        flow.steps(),
        M::LATTICE.operations.mul
    );
    assert!(error < FLOW, "{}: {error:e}", M::DESCRIPTION.name);
}

macro_rules! same_motion {
    ($($test:ident: $($model:ident)*;)*) => { $(
        #[test]
        fn $test() {
            $(assert_same_motion(&$model);)*
        }
    )* };
}

same_motion! {
    affine_affine: AffineAffine2 AffineAffineDilated2 AffineAffineSheared2
        AffineAffine3 AffineAffineDilated3 AffineAffineSheared3;
    spatially_affine: SpatiallyAffine2 SpatiallyAffineDilated2 SpatiallyAffineSheared2
        SpatiallyAffine3 SpatiallyAffineDilated3 SpatiallyAffineSheared3;
    materially_affine: MateriallyAffine2 MateriallyAffineDilated2 MateriallyAffineSheared2
        MateriallyAffine3 MateriallyAffineDilated3 MateriallyAffineSheared3;
    dalembert: Dalembert2 DalembertDilated2 DalembertSheared2 Dalembert3 DalembertDilated3 DalembertSheared3;
}

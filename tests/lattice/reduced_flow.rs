//! The lattice against the motion of the placement, and against itself in models that share it.

use affine_integrators::RungeKutta8;
use affine_runtime::frames::Matrix;
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
    let turn = |entries: [f64; 3]| skew(entries).skew_exponential();
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

/// Hamilton's equations of `phi` and its momentum.
fn through_placements<const N: usize, M: TwoPolarForm<N>>(model: &M, start: &Lattice<N>) -> M::Point<f64> {
    let point = model.at_lattice(start).unwrap();
    let rates = |t: f64, y: &M::Full<f64>| model.hamilton_equations(t, y);
    let full = (0.0, model.flatten(&point));
    let mut steps = RungeKutta8::new(rates, M::DESCRIPTION.full, full, T_END, 3e-15).unwrap();
    while !steps.is_finished() {
        steps.advance().unwrap();
    }
    model.unflatten(steps.y())
}

/// A body without potential whose stretches grow: straight lines of `phi` that do not meet a singular matrix.
fn growing<const N: usize>() -> Lattice<N> {
    Lattice { p: Vector::<N>::from_fn(|a, _| [1.9, 1.1, 0.4][a]), ..start() }
}

/// Of unit volume, which does not change.
fn balanced<const N: usize>() -> Lattice<N> {
    let Lattice { q, p, .. } = start::<N>();
    Lattice { q: q.add_scalar(-q.mean()), p: p.add_scalar(-p.mean()), ..start() }
}

/// Along a motion the volume stays, and so does the energy.
#[test]
fn isochoric_lattices_keep_their_volume() {
    let first = balanced();
    let mut flow = LatticeFlow::new(&IsochoricPairs3, 0.0, first).tolerance(1e-14);
    let last = *flow.advance_to(50.0).unwrap();
    assert!(last.q.sum().abs() < 1e-12 && last.p.sum().abs() < 1e-12, "{last:?}");
    let energy = |lattice: &Lattice<3>| {
        IsochoricPairs3.hamiltonian(0.0, &IsochoricPairs3.at_lattice(lattice).unwrap())
    };
    assert!((energy(&last) - energy(&first)).abs() < 1e-11 * energy(&first));
    // Of another volume it is no body of this model.
    assert!(IsochoricPairs3.at_lattice(&start()).is_err());
}

/// Through coincidences, by any tolerance, there and back: every lattice of the motion is one of the model, also at rest, where the
/// momenta that are left are errors alone.
fn stays_on_the_group<const N: usize, M: TwoPolarForm<N>>(model: &M, start: &Lattice<N>) {
    let energy = |lattice: &Lattice<N>| model.hamiltonian(0.0, &model.at_lattice(lattice).unwrap());
    for tolerance in [1e-4, 1e-6, 1e-9, 1e-12] {
        let mut flow = LatticeFlow::new(model, 0.0, *start).tolerance(tolerance);
        for t in (1..=20).map(|k| 2.0 * f64::from(k)).chain([1.0, 0.0]) {
            let lattice = *flow.advance_to(t).unwrap();
            let off = (energy(&lattice) / energy(start) - 1.0).abs();
            let steps = flow.steps().0 as f64;
            assert!(
                off < 0.1 * tolerance * steps + 1e-13,
                "{} {tolerance:e} {t}: {off:e}",
                M::DESCRIPTION.name
            );
        }
        assert!(flow.steps().1 > 0, "through the placement");
    }
}

#[test]
fn isochoric_lattices_stay_on_the_group() {
    let planar = Matrix::<2>::new(1.3, 0.2, 0.1, 0.8);
    let planar = planar / planar.determinant().sqrt();
    let spatial = Matrix::<3>::new(1.3, 0.2, -0.1, 0.3, 0.8, 0.15, -0.2, 0.1, 1.1);
    let spatial = spatial / spatial.determinant().cbrt();
    for spin in [Matrix::<2>::zeros(), Matrix::<2>::new(0.3, 0.9, -1.1, -0.3)] {
        let point = IsochoricSheared2.at_momentum(planar, Comoving(spin)).unwrap();
        stays_on_the_group(&IsochoricSheared2, &IsochoricSheared2.lattice(&point).unwrap());
    }
    let moving = Matrix::<3>::new(0.1, 0.6, -0.3, -0.5, -0.15, 0.25, 0.35, -0.1, 0.05);
    for spin in [Matrix::<3>::zeros(), moving] {
        let point = IsochoricSheared3.at_momentum(spatial, Comoving(spin)).unwrap();
        stays_on_the_group(&IsochoricSheared3, &IsochoricSheared3.lattice(&point).unwrap());
    }
}

fn assert_same_motion<const N: usize, M: TwoPolarForm<N>>(model: &M, start: Lattice<N>) {
    let back = model.lattice_after(&model.at_lattice(&start).unwrap(), &start).unwrap();
    let conversion = distance(&back, &start);
    assert!(conversion < 1e-14, "there and back: {conversion:e}");
    let mut flow = LatticeFlow::new(model, 0.0, start).tolerance(1e-14);
    let reduced = *flow.advance_to(T_END).unwrap();
    // Of the equal labellings of the end the one that the lattice gives.
    let full = model.lattice_after(&through_placements(model, &start), &reduced).unwrap();
    let error = distance(&reduced, &full);
    println!("{}: {error:.1e}, steps {:?}", M::DESCRIPTION.name, flow.steps());
    assert!(error < FLOW, "{}: {error:e}", M::DESCRIPTION.name);
}

macro_rules! same_motion {
    ($($test:ident from $start:ident: $($model:ident)*;)*) => { $(
        #[test]
        fn $test() {
            $(assert_same_motion(&$model, $start());)*
        }
    )* };
}

same_motion! {
    affine_affine from start: AffineAffine2 AffineAffineDilated2 AffineAffineSheared2
        AffineAffine3 AffineAffineDilated3 AffineAffineSheared3;
    spatially_affine from start: SpatiallyAffine2 SpatiallyAffineDilated2 SpatiallyAffineSheared2
        SpatiallyAffine3 SpatiallyAffineDilated3 SpatiallyAffineSheared3;
    materially_affine from start: MateriallyAffine2 MateriallyAffineDilated2 MateriallyAffineSheared2
        MateriallyAffine3 MateriallyAffineDilated3 MateriallyAffineSheared3;
    single_stretches from start: Pairs2 Pairs3;
    isochoric from balanced: IsochoricGeodesic2 IsochoricSheared2 IsochoricAffine2
        IsochoricGeodesic3 IsochoricSheared3 IsochoricPairs3;
    dalembert_geodesic from growing: Dalembert2 Dalembert3;
    dalembert from start: DalembertDilated2 DalembertSheared2 DalembertSheared3;
    dalembert_dilated from growing: DalembertDilated3;
}

/// Coefficients of fields are computed in `prepare()`, those of the lattice among them.
#[test]
fn families_of_models() {
    let space = Family3 { a: 0.2, b: 0.1, i: 1.0, kappa: 2.0, c: 0.3 }.prepare().unwrap();
    assert_same_motion(&space, start());
    let plane = Family2 { i: 1.5, kappa: 2.0, c: 0.3 }.prepare().unwrap();
    assert_same_motion(&plane, start());
}

/// A Hamiltonian in momenta has the lattice of the energy in velocities that it is the transform of.
#[test]
fn stated_on_the_momentum_side() {
    assert_same_motion(&Stated3, start());
    let [stated, derived] = [
        *LatticeFlow::new(&Stated3, 0.0, start()).advance_to(T_END).unwrap(),
        *LatticeFlow::new(&SpatiallyAffineSheared3, 0.0, start()).advance_to(T_END).unwrap(),
    ];
    assert!(distance(&stated, &derived) < FLOW);
}

/// A centre of mass that moves freely leaves the lattice alone.
#[test]
fn beside_a_free_centre() {
    assert_same_motion(&Thrown2, start());
    let lattice = start();
    let at_rest = Thrown2.at_lattice(&lattice).unwrap();
    let (x, p) = (Vector::<2>::new(0.3, 1.0), Vector::<2>::new(-2.0, 0.7));
    let thrown = Thrown2.at_momentum(x, *at_rest.phi(), p, Spatial(at_rest.sigma().0)).unwrap();
    let run = Simulation::new(&Thrown2, thrown).until(T_END).tolerance(1e-14).output([T_END]).run().unwrap();
    let (_, end) = run.end();
    assert!((end.x() - (x + p * (T_END / 2.0))).norm() < 1e-12);
    let moved = *LatticeFlow::new(&Thrown2, 0.0, lattice).advance_to(T_END).unwrap();
    assert!(distance(&Thrown2.lattice_after(end, &moved).unwrap(), &moved) < FLOW);
}

/// One motion of the stretches for three models: affine-affine with `A = 1.2`, and `I = 1`, `A = 0.2` in the body or in
/// space. The frames differ.
fn assert_shared<const N: usize>(models: [&dyn Fn(Lattice<N>) -> Lattice<N>; 3]) {
    let [affine, body, space] = models.map(|flow| flow(start()));
    for other in [body, space] {
        let stretches = Lattice { left: affine.left, right: affine.right, ..other };
        assert!(distance(&stretches, &affine) < FLOW);
        assert!(distance(&other, &affine) > 1e-2, "the frames move otherwise");
    }
    // The factor that rotates the body leaves L, the one that rotates space leaves R.
    assert!((body.left - affine.left).amax() < FLOW && (space.right - affine.right).amax() < FLOW);
}

macro_rules! shared {
    ($($test:ident $n:literal: $affine:ident $body:ident $space:ident;)*) => { $(
        #[test]
        fn $test() {
            assert_shared::<$n>([
                &|start| *LatticeFlow::new(&$affine, 0.0, start).advance_to(T_END).unwrap(),
                &|start| *LatticeFlow::new(&$body, 0.0, start).advance_to(T_END).unwrap(),
                &|start| *LatticeFlow::new(&$space, 0.0, start).advance_to(T_END).unwrap(),
            ]);
        }
    )* };
}

shared! {
    planar_models_share_their_stretches 2: AffineAffine2 SpatiallyAffine2 MateriallyAffine2;
    planar_models_share_them_under_potentials 2:
        AffineAffineSheared2 SpatiallyAffineSheared2 MateriallyAffineSheared2;
    spatial_models_share_their_stretches 3: AffineAffine3 SpatiallyAffine3 MateriallyAffine3;
    spatial_models_share_them_under_potentials 3:
        AffineAffineSheared3 SpatiallyAffineSheared3 MateriallyAffineSheared3;
}

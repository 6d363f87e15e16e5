//! The lattice by exact flows of its pieces: orders, what is kept to rounding over many steps, and where a fixed step
//! ends.

use affine_integrators::Failure;
use affine_runtime::frames::Matrix;
use affine_runtime::lattice::{
    CircleFlow, Lattice, LatticeFlow, LatticePieces, LatticeSplitting, StopReason, TwoPolarForm,
};
use affine_runtime::prelude::*;

use crate::reduced_flow::{distance, start};

macro_rules! models {
    ($($name:ident $n:literal ($($kinetic:tt)*) $(, $potential:expr)?;)*) => { $(
        #[affine_model(dim = $n, kinetic($($kinetic)*), $(potential = $potential,)? emit(two_polar, splitting))]
        struct $name;
    )* };
}

models! {
    Plane 2 (casimir2 = 1.2, casimir1_squared = 0.1);
    PlaneInWell 2 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), 0.3*(tr(G)*exp(-2*q) - n) + sinh(q)^2;
    PlaneDalembert 2 (dalembert = 1.5), 0.4*(tr(G) - n) + 0.1*tr(G*G);
    Space 3 (casimir2 = 1.2, casimir1_squared = 0.1);
    Body 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), 0.3*(tr(G)*exp(-2*q) - n) + sinh(q)^2;
    Mirrored 3 (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1), q1^2 + q2^2 + q3^2;
    Confined 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), q1^2 + q2^2 + q3^2;
    Dalembert 3 (dalembert = 1.5), 0.4*(tr(G) - n) + 0.1*tr(G*G);
}

#[affine_model(dim = 3, kinetic(casimir2 = a, body_inertia = i), potential = k*sinh(q)^2, emit(two_polar, splitting))]
struct Family {
    a: f64,
    i: f64,
    k: f64,
}

#[affine_model(dim = 2, kinetic(casimir2 = 0.9, casimir1_squared = 0.3), group = unitary, emit(splitting))]
struct Circle2;

#[affine_model(dim = 3, kinetic(casimir2 = a, casimir1_squared = 0.3), group = unitary, emit(splitting))]
struct Circle3 {
    a: f64,
}

fn begun<'a, const N: usize, M: LatticePieces<N>>(
    model: &'a M,
    order: usize,
    first: Lattice<N>,
    (t, step): (f64, f64),
) -> LatticeSplitting<'a, N, M> {
    LatticeSplitting::new(model, order, (0.0, first), t, step).unwrap().unwrap()
}

/// Errors of `q, p, M, N, L, R` at `t = 1` with steps of `steps`, halved.
fn assert_orders<const N: usize, M: LatticePieces<N>>(
    model: &M,
    name: &str,
    expected: &Lattice<N>,
    steps: [f64; 4],
) {
    for (order, step) in [2, 4, 6, 8].into_iter().zip(steps) {
        let error = |h: f64| distance(&begun(model, order, start(), (1.0, h)).finish().unwrap(), expected);
        let [coarse, fine] = [step, 0.5 * step].map(error);
        let measured = (coarse / fine).log2();
        println!("{name}, order {order}: {coarse:.1e}, {fine:.1e}, {measured:.2}");
        assert!(measured > 0.9 * order as f64, "{name} {order}: {measured}");
        assert!(fine > 1e-14, "{name} {order}: rounding, {fine:e}");
    }
}

/// The steps where the leading term of the error rules and rounding does not.
#[test]
fn orders() {
    fn against_flow<const N: usize, M: LatticePieces<N> + TwoPolarForm<N>>(model: &M, steps: [f64; 4]) {
        let expected = *LatticeFlow::new(model, 0.0, start()).tolerance(1e-15).advance_to(1.0).unwrap();
        assert_orders(model, M::DESCRIPTION.name, &expected, steps);
    }
    let [small, middle, coarse] = [1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0];
    against_flow(&Plane, [small, middle, 0.25, 0.5]);
    against_flow(&PlaneInWell, [small, middle, 0.25, 0.5]);
    against_flow(&PlaneDalembert, [small, small, middle, middle]);
    against_flow(&Space, [small, middle, 0.1, 0.2]);
    against_flow(&Body, [small, middle, middle, coarse]);
    against_flow(&Mirrored, [small, middle, middle, coarse]);
    against_flow(&Dalembert, [small, middle, small, middle]);
    let family = Family { a: 0.2, i: 1.0, k: 0.5 }.prepare().unwrap();
    against_flow(&family, [small, middle, 0.1, 0.2]);

    let expected = *CircleFlow::new(&Circle2, 0.0, start()).tolerance(1e-15).advance_to(1.0).unwrap();
    assert_orders(&Circle2, "Circle2", &expected, [small, small, 0.2, 0.2]);
    let model = Circle3 { a: 0.9 }.prepare().unwrap();
    let expected = *CircleFlow::new(&model, 0.0, start()).tolerance(1e-15).advance_to(1.0).unwrap();
    assert_orders(&model, "Circle3", &expected, [small, small, middle, 0.1]);
}

#[test]
fn pieces_are_found() {
    assert_eq!(Plane::PIECES, ["drift", "M_12^2 + N_12^2"]);
    assert_eq!(PlaneInWell::PIECES, ["drift", "M_12^2 + N_12^2 + potential"]);
    let three = ["drift", "M_12^2 + N_12^2 + potential", "M_13^2 + N_13^2", "M_23^2 + N_23^2"];
    assert_eq!(Body::PIECES, three);
    assert_eq!(Dalembert::PIECES, three);
    const { assert!(Plane::NYSTROM && PlaneDalembert::NYSTROM && Circle2::NYSTROM && !Body::NYSTROM) };
}

/// Steps of the long runs.
const MANY: u32 = if cfg!(debug_assertions) { 5_000 } else { 1_000_000 };
/// How far constants of the motion walk in `N` steps, in units of `eps sqrt(N)` and of the sizes that they are made of.
/// Largest seen over 1e6 steps: 0.033.
const C: f64 = 0.1;

/// `|rho_hat|`, `|tau_hat|` relative to themselves, `tr Z^k` relative to `|Z|^k`: largest distance from the start over a
/// motion of [`MANY`] steps, in units of `eps sqrt(N)`.
fn walk<const N: usize, M: LatticePieces<N>>(model: &M, order: usize, first: Lattice<N>, h: f64) -> [f64; 5] {
    let constants = |lattice: &Lattice<N>| {
        let z = lattice.z();
        [
            lattice.spin().norm(),
            lattice.minus_vorticity().norm(),
            z.trace(),
            (z * z).trace(),
            (z * z * z).trace(),
        ]
    };
    let expected = constants(&first);
    let size = first.z().norm();
    let sizes = [expected[0], expected[1], size, size.powi(2), size.powi(3)];
    let mut steps = begun(model, order, first, (f64::from(MANY) * h, h));
    let mut most = [0.0_f64; 5];
    for k in 1..=MANY {
        steps.advance().unwrap();
        if k % (MANY / 1000) == 0 {
            let now = constants(&steps.lattice());
            // A single rounding is more than the walk of a few steps.
            let unit = f64::EPSILON * f64::from(k.max(MANY / 10)).sqrt();
            for i in 0..5 {
                most[i] = most[i].max((now[i] - expected[i]).abs() / sizes[i] / unit);
            }
        }
    }
    most
}

/// Norms of spin and vorticity walk randomly with the rounding of the rotations, whatever the step.
#[test]
fn norms_walk_randomly() {
    for (name, [spin, vorticity, ..]) in [
        ("body, order 4", walk(&Confined, 4, apart(), 0.02)),
        ("body, order 8", walk(&Confined, 8, apart(), 0.05)),
        ("space, order 4", walk(&Mirrored, 4, apart(), 0.02)),
    ] {
        println!("{name}: {spin:.3} {vorticity:.3} eps sqrt(N), N = {MANY}");
        assert!(spin < C && vorticity < C, "{name}: {spin} {vorticity}");
    }
}

/// `tr Z^k` of bounded geodesics likewise, where a step is short enough for its own error to stay below rounding: for `n = 2`
/// `tr sigma^2 < 0`, for `n = 3` also `det sigma = 0`.
#[test]
fn traces_walk_randomly() {
    // Without a drift of the mean, in which digits of differences would be lost.
    let p = Vector::<2>::new(0.2, -0.2);
    let plane = Lattice { p, n: start::<2>().n * 3.0, ..start::<2>() };
    assert!((plane.z() * plane.z()).trace() < 0.0);
    for (name, walks) in
        [("n = 2", walk(&Plane, 8, plane, 0.04)), ("n = 3", walk(&Space, 8, on_the_threshold(), 0.01))]
    {
        println!("{name}: {walks:.3?} eps sqrt(N), N = {MANY}");
        assert!(walks.iter().all(|c| *c < C), "{name}: {walks:?}");
    }
}

/// A bounded geodesic of three stretches: `det Z = 0 = tr Z`, found by bisection.
fn on_the_threshold() -> Lattice<3> {
    let at = |s: f64| Lattice {
        q: Vector::<3>::new(0.8, 0.0, -0.8),
        p: Vector::<3>::new(s, -2.0 * s, s),
        m: skew([0.4, -0.3, 0.5]),
        n: skew([2.5, 1.5, -2.0]),
        ..start()
    };
    let (mut low, mut high) = (-1.0, 1.0);
    let sign = |s: f64| at(s).z().determinant() > 0.0;
    assert_ne!(sign(low), sign(high));
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        *(if sign(middle) == sign(low) { &mut low } else { &mut high }) = middle;
    }
    let found = at(low);
    assert!((found.z() * found.z()).trace() < 0.0, "bounded");
    found
}

fn skew(entries: [f64; 3]) -> Matrix<3> {
    let [a, b, c] = entries;
    Matrix::<3>::new(0.0, a, b, -a, 0.0, c, -b, -c, 0.0)
}

/// Near a relative equilibrium of confined stretches, whose outer ones turn fast and stay away from the one between.
fn apart() -> Lattice<3> {
    Lattice {
        q: Vector::<3>::new(0.9, 0.03, -0.95),
        p: Vector::<3>::new(0.1, -0.05, 0.02),
        m: skew([0.15, 6.0, -0.1]),
        n: skew([0.1, 0.4, 0.2]),
        ..start()
    }
}

/// No drift of the energy: over the second half of the motion it is as good as over the first.
#[test]
fn energy_does_not_drift() {
    fn errors<const N: usize, M: LatticePieces<N>>(model: &M, first: Lattice<N>, h: f64) -> [f64; 2] {
        let energy = |lattice: &Lattice<N>| {
            let (couplings, places) = lattice.places::<M>();
            model.lattice_hamiltonian(&couplings, &places)
        };
        let expected = energy(&first);
        let count = MANY.min(20_000);
        let mut steps = begun(model, 4, first, (f64::from(count) * h, h));
        let mut most = [0.0_f64; 2];
        for k in 0..count {
            steps.advance().unwrap();
            let half = usize::from(k >= count / 2);
            most[half] = most[half].max((energy(&steps.lattice()) - expected).abs());
        }
        most
    }
    for (name, [first, second]) in [
        ("Confined", errors(&Confined, apart(), 0.05)),
        ("Mirrored", errors(&Mirrored, apart(), 0.05)),
        ("PlaneInWell", errors(&PlaneInWell, start(), 0.05)),
        ("Circle2", errors(&Circle2, start(), 0.05)),
    ] {
        println!("{name}: {first:.1e}, {second:.1e}");
        assert!(second < 1.5 * first && first < 1e-3, "{name}: {first:e}, {second:e}");
    }
}

/// There and back again: a step is symmetric.
#[test]
fn steps_go_back() {
    let there = begun(&Body, 6, start(), (2.0, 0.02)).finish().unwrap();
    let back = LatticeSplitting::new(&Body, 6, (2.0, there), 0.0, 0.02).unwrap().unwrap().finish().unwrap();
    assert!(distance(&back, &start()) < 1e-13, "{:e}", distance(&back, &start()));
}

/// Stretches in any order keep their labels.
#[test]
fn labels_are_kept() {
    let w = Matrix::<3>::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0);
    let plain = begun(&Body, 8, start(), (1.0, 0.02)).finish().unwrap();
    let other = begun(&Body, 8, start().relabelled(&w), (1.0, 0.02)).finish().unwrap();
    assert_eq!(other, plain.relabelled(&w));
}

#[test]
fn meeting_stretches_stop_a_fixed_step() {
    let mut lattice = start::<2>();
    lattice.m *= 0.01 / lattice.m.amax();
    lattice.p = Vector::<2>::new(-1.2, 1.0);
    let mut steps = begun(&Plane, 4, lattice, (3.0, 0.05));
    let stop = steps.finish().unwrap_err();
    assert!(matches!(stop.reason, StopReason::Coincidence { .. }), "{stop}");
    assert!(stop.t > 0.1 && stop.t < 1.0 && stop.lattice == steps.lattice() && stop.t == steps.t(), "{stop}");
    assert_eq!(steps.advance().unwrap_err(), stop, "now and ever after");
    // What the fixed step refused, the adaptive one goes through.
    assert!(LatticeFlow::new(&Plane, stop.t, stop.lattice).advance_to(3.0).is_ok());
    // Angles that coincide, and that are opposite.
    for (m, n, gap) in [(1e-3, 0.0, -1.0), (0.0, 1e-3, 1.0)] {
        let mut lattice = Lattice { p: Vector::<2>::new(gap, -gap), ..start::<2>() };
        (lattice.m, lattice.n) = (lattice.m * (m / 0.5), lattice.n * (n / 0.6));
        let stop = begun(&Circle2, 4, lattice, (10.0, 0.05)).finish().unwrap_err();
        assert!(matches!(stop.reason, StopReason::Coincidence { .. }), "{stop}");
    }
}

#[test]
fn what_cannot_begin_is_refused() {
    assert!(LatticeSplitting::new(&Body, 3, (0.0, start()), 1.0, 0.1).is_none());
    let refused = |lattice: Lattice<3>, step: f64| {
        LatticeSplitting::new(&Body, 4, (0.0, lattice), 1.0, step).unwrap().unwrap_err().reason
    };
    for given in [0.0, -1.0, f64::INFINITY, 1e-300] {
        let failure = Failure::Step { given, t0: 0.0, t_end: 1.0 };
        assert_eq!(refused(start(), given), StopReason::Integration(failure));
    }
    let mut lattice = start::<3>();
    lattice.q[1] = lattice.q[0];
    assert_eq!(refused(lattice, 0.1), StopReason::Coincidence { distance: 0.0 });
    lattice.q[1] = f64::NAN;
    assert_eq!(refused(lattice, 0.1), StopReason::Integration(Failure::NotFinite));
    // A stretch of d'Alembert's model that goes through zero.
    let fast = Lattice { p: Vector::<2>::new(-0.5, -4.0), ..start::<2>() };
    let stop = begun(&PlaneDalembert, 4, fast, (5.0, 0.5)).finish().unwrap_err();
    assert!(matches!(stop.reason, StopReason::Conversion(_) | StopReason::Coincidence { .. }), "{stop}");
}

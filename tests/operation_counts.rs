//! Operations that emitted code really executes, counted by a counting scalar and pinned.
#![allow(missing_docs)]

use affine_runtime::counting::Counting;
use affine_runtime::model::{Model, Operations};
use affine_runtime::prelude::*;

/// Counts of Hamilton's equations and of the reduced equations at a generic point, and what the model says of them.
fn counts<const N: usize, M: Model<N>>(model: &M, point: &M::Point<Counting>) -> [(usize, usize); 2] {
    let full = model.flatten(point);
    let (_, full) = Counting::count(|| model.hamilton_equations(Counting::from(0.0), &full));
    let (reduced, constants) = model.reduce(Counting::from(0.0), point);
    let (_, reduced) = Counting::count(|| model.reduced_equations(Counting::from(0.0), &constants, &reduced));
    for (counted, stated) in
        [(full, M::DESCRIPTION.full_operations), (reduced, M::DESCRIPTION.reduced_operations)]
    {
        assert_eq!(counted, stated, "{}", M::DESCRIPTION.name);
    }
    [(full.mul, full.add), (reduced.mul, reduced.add)]
}

/// A point with no special entries, the momentum in whatever frame the model has.
fn sample<const N: usize, M: Model<N>>(model: &M) -> M::Point<Counting> {
    let mut full = <M::Full<Counting> as affine_runtime::model::StateVector<Counting>>::zeros();
    for (k, value) in full.as_mut().iter_mut().enumerate() {
        // Diagonally dominant placements are invertible; the rest is arbitrary.
        *value = Counting::from(0.1 + 0.07 * ((k * k + 3 * k) % 11) as f64);
    }
    let skip = usize::from(M::DESCRIPTION.full[0].name() == "x") * N;
    for k in 0..N {
        full.as_mut()[skip + k * (N + 1)] = Counting::from(2.0);
    }
    model.unflatten(&full)
}

macro_rules! pinned {
    ($($name:ident $n:literal ($($terms:tt)*) = full $full:expr, reduced $reduced:expr;)*) => {
        $(
            #[affine_model(dim = $n, kinetic($($terms)*))]
            pub struct $name;
        )*

        #[test]
        fn every_family() {
            let mut wrong = Vec::new();
            $(
                let counted = counts::<$n, $name>(&$name, &sample::<$n, $name>(&$name));
                for o in [$name::DESCRIPTION.full_operations, $name::DESCRIPTION.reduced_operations] {
                    assert_eq!((o.div, o.sqrt, o.exp, o.ln), (0, 0, 0, 0), "{}", stringify!($name));
                }
                if counted != [$full, $reduced] {
                    wrong.push(format!("{}: {:?}", stringify!($name), counted));
                }
            )*
            assert!(wrong.is_empty(), "{wrong:#?}");
        }
    };
}

/// Problem P1: the same function as other tools evaluate, `(x, phi, p_hat, Sigma_hat)` to their derivatives, and the
/// reduced right-hand side, which does the same task.
#[test]
fn drunk_missile() {
    let [full, reduced] = counts::<3, LeftMissile3>(&LeftMissile3, &sample::<3, LeftMissile3>(&LeftMissile3));
    assert!(full.0 + full.1 <= 150);
    assert!(reduced.0 + reduced.1 <= 67);
}

/// Problems P2 and P3: one root and two divisions in the equations of
/// `(phi, Sigma_hat)` and `(phi, Pi)`, none in the reduced ones.
#[test]
fn potentials() {
    #[affine_model(
        dim = 3,
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
    )]
    struct Vibrating;
    #[affine_model(
        dim = 3,
        kinetic(dalembert = diag(1, 1.5, 2)),
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5)
    )]
    struct Elastic;
    // The second division is that of `D - 1 = (det - 1)/(D^2 + D + 1)`, which keeps digits near the undeformed state.
    let once = |o: Operations| assert_eq!((o.div, o.sqrt, o.exp, o.ln), (2, 1, 0, 0));
    once(Vibrating::DESCRIPTION.full_operations);
    let reduced = Vibrating::DESCRIPTION.reduced_operations;
    assert_eq!((reduced.div, reduced.sqrt, reduced.exp, reduced.ln), (0, 0, 0, 0));
    once(Elastic::DESCRIPTION.full_operations);
    let counted = counts::<3, Vibrating>(&Vibrating, &sample::<3, Vibrating>(&Vibrating));
    assert_eq!(counted, [(102, 89), (51, 41)]);
    let counted = counts::<3, Elastic>(&Elastic, &sample::<3, Elastic>(&Elastic));
    // Full: `G - 1` and `det - 1` beside `G` and `det`. Reduced: `Psi = phi/D` before its cofactors, so that det phi is not formed.
    assert_eq!(counted, [(75, 55), (80, 38)]);
}

/// Single stretches cost twelve rotations of columns, whichever chart; what is symmetric in even powers costs none.
#[test]
fn stretches() {
    #[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = q1^2 + q2^2 + q3^2)]
    struct Hencky;
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = pairs(d^2))]
    struct Plane;
    #[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = Q1^2 + Q2^2 + Q3^2)]
    struct Traced;
    let [Operations { div, sqrt, ln, .. }, traced] =
        [Hencky::DESCRIPTION.reduced_operations, Traced::DESCRIPTION.reduced_operations];
    assert_eq!((div, sqrt, ln), (25, 28, 3));
    assert_eq!((traced.div, traced.sqrt, traced.ln), (0, 0, 0));
    assert_eq!(counts::<3, Hencky>(&Hencky, &sample::<3, Hencky>(&Hencky)), [(1205, 811), (573, 345)]);
    assert_eq!(counts::<2, Plane>(&Plane, &sample::<2, Plane>(&Plane)), [(188, 114), (92, 47)]);
    assert_eq!(counts::<3, Traced>(&Traced, &sample::<3, Traced>(&Traced)), [(81, 60), (60, 30)]);
}

/// The gravity of an ellipsoid on itself is eight duplications with 40 steps of Newton's iteration, whatever its axes are.
#[test]
fn self_gravity() {
    #[affine_model(dim = 3, kinetic(dalembert = 0.2), potential = self_gravity(1))]
    struct Cloud;
    let Operations { div, sqrt, .. } = Cloud::DESCRIPTION.reduced_operations;
    assert_eq!((div, sqrt), (114, 66));
    assert_eq!(counts::<3, Cloud>(&Cloud, &sample::<3, Cloud>(&Cloud)), [(664, 458); 2]);
}

/// Mass matrices that depend on the placement: a factorisation, with one division for each pivot and one for `det phi`.
#[test]
fn mixed_sums() {
    #[affine_model(dim = 2, kinetic(dalembert = 2, casimir2 = 0.2, casimir1_squared = 0.1))]
    struct FlatAffine;
    #[affine_model(dim = 3, kinetic(body_inertia = 1, space_inertia = diag(1, 1.5, 2)))]
    struct BodySpace;
    #[affine_model(dim = 3, kinetic(dalembert = 2, body_inertia = 1))]
    struct FlatBody;
    #[affine_model(dim = 2, kinetic(body_inertia = 1,
        space_tensor = [[2, 0.5, 0, 0.75], [0.5, 3, 0.25, 0], [0, 0.25, 1, 0.5], [0.75, 0, 0.5, 4]]))]
    struct BodySpaceTensor;
    #[affine_model(dim = 3, constraint = conformal, kinetic(dalembert = diag(1, 1.5, 2), body_inertia = 1))]
    struct Conformal;
    #[affine_model(dim = 3, constraint = isochoric, kinetic(dalembert = diag(1, 1.5, 2)), potential = tr(G)/2)]
    struct Isochoric;
    let divisions = |o: Operations| (o.div, o.sqrt, o.exp, o.ln);
    assert_eq!(divisions(FlatAffine::DESCRIPTION.full_operations), (5, 0, 0, 0));
    assert_eq!(divisions(BodySpace::DESCRIPTION.full_operations), (10, 0, 0, 0));
    // Three equal blocks are factorised once.
    assert_eq!(divisions(FlatBody::DESCRIPTION.full_operations), (4, 0, 0, 0));
    let counted = counts::<2, FlatAffine>(&FlatAffine, &sample::<2, FlatAffine>(&FlatAffine));
    assert_eq!(counted, [(75, 41), (75, 41)]);
    let counted = counts::<3, BodySpace>(&BodySpace, &sample::<3, BodySpace>(&BodySpace));
    assert_eq!(counted, [(346, 262), (346, 262)]);
    let counted = counts::<3, FlatBody>(&FlatBody, &sample::<3, FlatBody>(&FlatBody));
    assert_eq!(counted, [(142, 93), (142, 93)]);
    // Of the three parts of Pi the longest, that of the tensor, is what is left.
    let counted =
        counts::<2, BodySpaceTensor>(&BodySpaceTensor, &sample::<2, BodySpaceTensor>(&BodySpaceTensor));
    assert_eq!(counted, [(107, 76), (107, 76)]);
    // phi_dot = phi Oh with phi^T phi = D^2: the force of d'Alembert's energy is a multiple of 1.
    let counted = counts::<3, Conformal>(&Conformal, &sample::<3, Conformal>(&Conformal));
    assert_eq!(counted, [(52, 30), (52, 30)]);
    // The momentum of d'Alembert's energy is Sigma_hat and a multiple of 1, which one of its entries tells.
    // What the equations call computes velocities that they do not read, which compilers leave out and a count does not.
    let Operations { mul, add, div, .. } = Isochoric::DESCRIPTION.full_operations;
    assert_eq!((mul, add, div), (161, 146, 7));
    assert_eq!(Isochoric::DESCRIPTION.reduced_operations, Isochoric::DESCRIPTION.full_operations);
}

// (multiplications, additions); 0.2, 0.1, 1 are the coefficients of problem P1.
pinned! {
    Left2 2 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1) = full (19, 11), reduced (8, 4);
    Left3 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1) = full (58, 47), reduced (27, 18);
    LeftMissile2 2 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1) = full (30, 18), reduced (17, 9);
    LeftMissile3 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1) = full (82, 65), reduced (40, 26);
    LeftDrift2 2 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, space_translation = 1) = full (19, 11), reduced (8, 4);
    LeftDrift3 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, space_translation = 1) = full (58, 47), reduced (27, 18);
    Right2 2 (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1) = full (19, 11), reduced (8, 4);
    Right3 3 (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1) = full (58, 47), reduced (27, 18);
    RightDrift3 3 (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, space_translation = 1) = full (58, 47), reduced (27, 18);
    RightMissile2 2 (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, body_translation = 1) = full (33, 20), reduced (28, 16);
    RightMissile3 3 (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, body_translation = 1) = full (94, 77), reduced (76, 59);
    Affine2 2 (casimir2 = 0.2, casimir1_squared = 0.1) = full (14, 6), reduced (8, 4);
    Affine3 3 (casimir2 = 0.2, casimir1_squared = 0.1) = full (36, 23), reduced (27, 18);
    AffineMissile3 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_translation = 1) = full (60, 35), reduced (40, 26);
    AffineDrift3 3 (casimir2 = 0.2, casimir1_squared = 0.1, space_translation = 1) = full (36, 23), reduced (27, 18);
    DAlembert2 2 (dalembert = diag(1, 1.5)) = full (2, 0), reduced (0, 0);
    DAlembert3 3 (dalembert = diag(1, 1.5, 2), space_translation = 1) = full (6, 0), reduced (0, 0);
    DAlembertFull3 3 (dalembert = [[2, 1, 0], [1, 3, 1], [0, 1, 4]]) = full (27, 18), reduced (0, 0);
    DAlembertMissile3 3 (dalembert = diag(1, 1.5, 2), body_translation = 1) = full (51, 24), reduced (17, 6);
    BodyTensor2 2 (body_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]], body_translation = 1)
        = full (36, 29), reduced (36, 27);
    SpaceTensor2 2 (space_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])
        = full (25, 21), reduced (25, 21);
    BodyInertia2 2 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = diag(1, 2)) = full (22, 14), reduced (22, 14);
    BodyInertia3 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = diag(1, 1.5, 2)) = full (78, 63), reduced (78, 63);
    BodyInertiaMissile3 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = diag(1, 1.5, 2), body_translation = 1)
        = full (102, 84), reduced (99, 78);
    BodyInertiaFull2 2 (casimir2 = 0.2, body_inertia = [[1, 0.5], [0.5, 2]]) = full (30, 22), reduced (30, 22);
    SpaceInertia3 3 (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = diag(1, 1.5, 2)) = full (78, 63), reduced (78, 63);
    FlatTensor2 2 (flat_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])
        = full (11, 11), reduced (0, 0);
}

macro_rules! pinned_lattices {
    ($($name:ident $n:literal ($($terms:tt)*) = $counts:expr;)*) => {
        $(
            #[affine_model(dim = $n, kinetic($($terms)*), emit(two_polar))]
            pub struct $name;
        )*

        /// Multiplications, additions, divisions and exponentials of the equations of `(q, p, M, N)`.
        #[test]
        fn every_lattice() {
            use affine_runtime::lattice::LatticeForm;
            use affine_runtime::model::StateVector;
            let mut wrong = Vec::new();
            $(
                let mut state = <$name as LatticeForm<$n>>::Places::<Counting>::zeros();
                for (k, value) in state.as_mut().iter_mut().enumerate() {
                    *value = Counting::from([1.1, 0.4, -0.3, 0.7, 0.2][k % 5] + 0.01 * k as f64);
                }
                let mut couplings = <$name as LatticeForm<$n>>::Couplings::<Counting>::zeros();
                couplings.as_mut().fill(Counting::from(0.3));
                let (_, counted) = Counting::count(|| $name.lattice_equations(&couplings, &state));
                assert_eq!(counted, $name::LATTICE.operations, "{}", stringify!($name));
                if (counted.mul, counted.add, counted.div, counted.exp) != $counts {
                    wrong.push(format!("{}: {counted:?}", stringify!($name)));
                }
                assert_eq!(counted.sqrt + counted.ln, 0, "{}", stringify!($name));
            )*
            assert!(wrong.is_empty(), "{wrong:#?}");
        }
    };
}

pinned_lattices! {
    AffineLattice2 2 (casimir2 = 1.2, casimir1_squared = 0.1) = (20, 6, 1, 1);
    // Problem P4.
    AffineLattice3 3 (casimir2 = 1.2, casimir1_squared = 0.1) = (82, 40, 3, 2);
    // The frames alone differ from the affine-affine lattice.
    LeftLattice3 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1) = (82, 40, 3, 2);
    RightLattice3 3 (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1) = (82, 40, 3, 2);
    DAlembertLattice2 2 (dalembert = 1.5) = (15, 4, 1, 0);
    DAlembertLattice3 3 (dalembert = 1.5) = (68, 33, 3, 0);
}

macro_rules! pinned_ratios {
    ($($name:ident $n:literal ($($terms:tt)*) = $counts:expr;)*) => {
        $(
            #[affine_model(dim = $n, kinetic($($terms)*), emit(two_polar, ratios))]
            pub struct $name;
        )*

        /// Multiplications, additions and divisions of the lattice in ratios of stretches.
        #[test]
        fn every_lattice_in_ratios() {
            use affine_runtime::lattice::{LatticeForm, RatioForm};
            use affine_runtime::model::StateVector;
            let mut wrong = Vec::new();
            $(
                let mut state = <$name as RatioForm<$n>>::Ratios::<Counting>::zeros();
                for (k, value) in state.as_mut().iter_mut().enumerate() {
                    *value = Counting::from([0.6, 0.4, -0.3, 0.7, 0.2][k % 5] + 0.01 * k as f64);
                }
                let mut couplings = <$name as LatticeForm<$n>>::Couplings::<Counting>::zeros();
                couplings.as_mut().fill(Counting::from(0.3));
                let (_, counted) = Counting::count(|| $name.ratio_equations(&couplings, &state));
                assert_eq!(counted, $name::RATIO_OPERATIONS, "{}", stringify!($name));
                if (counted.mul, counted.add, counted.div) != $counts {
                    wrong.push(format!("{}: {counted:?}", stringify!($name)));
                }
                assert_eq!(counted.sqrt + counted.ln + counted.exp, 0, "{}", stringify!($name));
            )*
            assert!(wrong.is_empty(), "{wrong:#?}");
        }
    };
}

pinned_ratios! {
    AffineRatios2 2 (casimir2 = 1.2, casimir1_squared = 0.1) = (12, 5, 1);
    // Problem P4, the same task.
    AffineRatios3 3 (casimir2 = 1.2, casimir1_squared = 0.1) = (51, 23, 3);
    LeftRatios3 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1) = (51, 23, 3);
    RightRatios3 3 (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1) = (51, 23, 3);
}

/// A body with inertia that pushes its centre along with it: forces move `p` in any case, and equations with `p_hat` are shorter
/// than with `p`.
#[test]
fn co_moving_linear_momentum() {
    #[affine_model(
        dim = 2,
        kinetic(
            body_translation = 2,
            body_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, 1, 0.5], [1, 0, 0.5, 4]]
        ),
        potential = hyperbolic_dilatation(10) + 0.3*x[1]^2
    )]
    struct Pushed;
    assert!(Pushed::DESCRIPTION.reduced.iter().any(|group| group.name() == "p_hat"));
    let [full, reduced] = counts::<2, Pushed>(&Pushed, &sample::<2, Pushed>(&Pushed));
    assert!(reduced.0 + reduced.1 <= full.0 + full.1, "{reduced:?} {full:?}");
}

//! Inertias and tensors beside metrics that are numbers, whose orthonormal bases are irrational.

use affine_oracle::{Kinetic, Matrix as Exact, Term, rational};
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

use super::{agrees, moving, pinned, plane, product, space, twentieths};

fn inertia(n: usize) -> Exact {
    match n {
        2 => twentieths(2, &[30, 5, 5, 40]),
        _ => twentieths(3, &[30, 5, 0, 5, 40, -10, 0, -10, 25]),
    }
}

/// `diag(1, 3/2, 2)`.
fn diagonal() -> Exact {
    twentieths(3, &[20, 0, 0, 0, 30, 0, 0, 0, 40])
}

fn tensor() -> Exact {
    twentieths(4, &[40, 5, 0, 10, 5, 30, -10, 0, 0, -10, 50, 5, 10, 0, 5, 60])
}

/// `eta_KL Oh^K_A Oh^L_B J^AB`, (4.17).
#[test]
fn body_inertia() {
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = [[1.5, 0.25], [0.25, 2]], body_translation = 2)
    )]
    struct Plane;
    let [_, _, eta, _] = plane();
    let kinetic = Kinetic::new(
        2,
        vec![
            Term::BodyTensor(product(2, &eta, &inertia(2))),
            Term::Casimir2(rational(1, 5)),
            Term::Casimir1Squared(rational(1, 10)),
            Term::BodyTranslationMetric(eta.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    let (at, back) = moving!(Plane, 2);
    agrees(&Plane, &kinetic, at, back);

    #[affine_model(
        dim = 3,
        metrics(space = [[2, 0.5, 0], [0.5, 1.5, -0.25], [0, -0.25, 1]],
                body = [[1, -0.4, 0.2], [-0.4, 3, 0], [0.2, 0, 1.25]]),
        kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2))
    )]
    struct Space;
    let [_, _, eta, _] = space();
    let terms = vec![Term::BodyTensor(product(3, &eta, &diagonal())), Term::Casimir2(rational(1, 5))];
    let (at, back) = pinned!(Space, 3);
    agrees(&Space, &Kinetic::new(3, terms).unwrap(), at, back);
}

/// `g_ij Om^i_k Om^j_l J^kl`.
#[test]
fn space_inertia() {
    #[affine_model(
        dim = 3,
        metrics(space = [[2, 0.5, 0], [0.5, 1.5, -0.25], [0, -0.25, 1]],
                body = [[1, -0.4, 0.2], [-0.4, 3, 0], [0.2, 0, 1.25]]),
        kinetic(casimir1_squared = 0.1, casimir2 = 0.2, space_translation = 2,
                space_inertia = [[1.5, 0.25, 0], [0.25, 2, -0.5], [0, -0.5, 1.25]])
    )]
    struct Body;
    let [g, ..] = space();
    let kinetic = Kinetic::new(
        3,
        vec![
            Term::SpaceTensor(product(3, &g, &inertia(3))),
            Term::Casimir2(rational(1, 5)),
            Term::Casimir1Squared(rational(1, 10)),
            Term::SpaceTranslationMetric(g.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    let (at, back) = moving!(Body, 3);
    agrees(&Body, &kinetic, at, back);
}

/// `g_ij phi_dot^i_A phi_dot^j_B J^AB`, (2.1): the metric of the body is not read.
#[test]
fn dalembert() {
    #[affine_model(
        dim = 3,
        metrics(space = [[2, 0.5, 0], [0.5, 1.5, -0.25], [0, -0.25, 1]],
                body = [[1, -0.4, 0.2], [-0.4, 3, 0], [0.2, 0, 1.25]]),
        kinetic(dalembert = [[1.5, 0.25, 0], [0.25, 2, -0.5], [0, -0.5, 1.25]], space_translation = 2)
    )]
    struct Body;
    let [g, ..] = space();
    let kinetic = Kinetic::new(
        3,
        vec![
            Term::FlatTensor(product(3, &g, &inertia(3))),
            Term::SpaceTranslationMetric(g.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    let (at, back) = moving!(Body, 3);
    agrees(&Body, &kinetic, at, back);
}

/// Tensors are contracted with the components of a velocity, whatever the metrics; scalars beside them read these.
#[test]
fn tensors() {
    macro_rules! stated {
        ($name:ident $($kinetic:tt)*) => {
            #[affine_model(
                dim = 2,
                metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
                kinetic($($kinetic)*)
            )]
            struct $name;
        };
    }
    stated!(Body body_tensor = [[2, 0.25, 0, 0.5], [0.25, 1.5, -0.5, 0], [0, -0.5, 2.5, 0.25], [0.5, 0, 0.25, 3]],
        casimir2 = 0.2, body_inertia = 0.5);
    stated!(Space space_tensor = [[2, 0.25, 0, 0.5], [0.25, 1.5, -0.5, 0], [0, -0.5, 2.5, 0.25], [0.5, 0, 0.25, 3]],
        casimir2 = 0.2, space_inertia = 0.5);
    stated!(Flat flat_tensor = [[2, 0.25, 0, 0.5], [0.25, 1.5, -0.5, 0], [0, -0.5, 2.5, 0.25], [0.5, 0, 0.25, 3]],
        dalembert = 0.5);
    let [g, g_inverse, eta, eta_inverse] = plane();
    let half = |tensor: Exact| tensor.scaled(&rational(1, 2));
    let kinetic = |terms: Vec<Term>| Kinetic::new(2, terms).unwrap();
    let body = kinetic(vec![
        Term::BodyTensor(tensor()),
        Term::Casimir2(rational(1, 5)),
        Term::BodyTensor(half(product(2, &eta, &eta_inverse))),
    ]);
    let (at, back) = pinned!(Body, 2);
    agrees(&Body, &body, at, back);
    let space = kinetic(vec![
        Term::SpaceTensor(tensor()),
        Term::Casimir2(rational(1, 5)),
        Term::SpaceTensor(half(product(2, &g, &g_inverse))),
    ]);
    let (at, back) = pinned!(Space, 2);
    agrees(&Space, &space, at, back);
    let flat =
        kinetic(vec![Term::FlatTensor(tensor()), Term::FlatTensor(half(product(2, &g, &eta_inverse)))]);
    let (at, back) = pinned!(Flat, 2);
    agrees(&Flat, &flat, at, back);
}

/// Terms of different frames, whose mass matrix depends on `phi`: each is read by the metrics of its own indices.
#[test]
fn sums() {
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
        kinetic(dalembert = [[1.5, 0.25], [0.25, 2]], body_inertia = [[1.5, 0.25], [0.25, 2]], space_inertia = 0.5,
                casimir2 = 0.2, space_translation = 2)
    )]
    struct Plane;
    let [g, g_inverse, eta, _] = plane();
    let kinetic = Kinetic::new(
        2,
        vec![
            Term::FlatTensor(product(2, &g, &inertia(2))),
            Term::BodyTensor(product(2, &eta, &inertia(2))),
            Term::SpaceTensor(product(2, &g, &g_inverse).scaled(&rational(1, 2))),
            Term::Casimir2(rational(1, 5)),
            Term::SpaceTranslationMetric(g.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    let (at, back) = moving!(Plane, 2);
    agrees(&Plane, &kinetic, at, back);

    // The same from fields.
    #[affine_model(
        dim = 3,
        metrics(space = [[g, 0.5, 0], [0.5, 1.5, -0.25], [0, -0.25, 1]],
                body = [[1, -0.4, 0.2], [-0.4, 3, 0], [0.2, 0, 1.25]]),
        kinetic(dalembert = i, body_inertia = diag(1, 1.5, 2), body_translation = 2)
    )]
    struct Space {
        g: f64,
        i: f64,
    }
    let model = Space { g: 2.0, i: 3.0 }.prepare().unwrap();
    let [g, _, eta, eta_inverse] = space();
    let kinetic = Kinetic::new(
        3,
        vec![
            Term::FlatTensor(product(3, &g, &eta_inverse).scaled(&rational(3, 1))),
            Term::BodyTensor(product(3, &eta, &diagonal())),
            Term::BodyTranslationMetric(eta.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    let (at, back) = moving!(model, 3);
    agrees(&model, &kinetic, at, back);
}

/// `J^AB = I eta^AB` is `body_inertia = I`: isotropic, found exactly, whatever the roots, and integrated as such.
#[test]
fn the_metric_as_an_inertia() {
    #[affine_model(
        dim = 2,
        metrics(body = [[1, -0.5], [-0.5, 3]]),
        symmetry(space = affine, body = metric),
        kinetic(casimir2 = 0.2, body_inertia = [[12/11, 2/11], [2/11, 4/11]])
    )]
    struct Written;
    #[affine_model(dim = 2, metrics(body = [[1, -0.5], [-0.5, 3]]), kinetic(casimir2 = 0.2, body_inertia = 1))]
    struct Scalar;
    assert_eq!(Written::DESCRIPTION.conserved, Scalar::DESCRIPTION.conserved);
    assert_eq!(Written::DESCRIPTION.reduced_operations, Scalar::DESCRIPTION.reduced_operations);
    assert_eq!(Written::DESCRIPTION.hamiltonian, Scalar::DESCRIPTION.hamiltonian);
}

fn whole(conserved: &[Conserved]) -> Vec<Conserved> {
    conserved.iter().copied().filter(|quantity| !matches!(quantity, Conserved::Component(_))).collect()
}

/// No operation is added to those of the same model without metrics, whose numbers are no special ones.
#[test]
fn the_right_hand_side_does_not_grow() {
    macro_rules! beside_metrics {
        ($($n:literal ($($metrics:tt)*) ($($spec:tt)*);)*) => { $( {
            #[affine_model(dim = $n, metrics($($metrics)*), $($spec)*)]
            struct Metric;
            #[affine_model(dim = $n, $($spec)*)]
            struct Plain;
            let (metric, plain) = (Metric::DESCRIPTION, Plain::DESCRIPTION);
            assert_eq!(metric.reduced_operations, plain.reduced_operations, "{}", stringify!($($spec)*));
            assert_eq!(metric.full_operations, plain.full_operations, "{}", stringify!($($spec)*));
            // Components stand in the user's bases, where their factors are others.
            assert_eq!(whole(metric.conserved), whole(plain.conserved));
            assert_eq!(metric.conserved.len(), plain.conserved.len());
        } )* };
    }
    beside_metrics! {
        2 (space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]])
            (kinetic(casimir2 = 0.2, body_inertia = [[1.5, 0.25], [0.25, 2]], body_translation = 1));
        3 (space = [[2, 0.5, 0], [0.5, 1.5, -0.25], [0, -0.25, 1]], body = [[1, -0.4, 0.2], [-0.4, 3, 0.3], [0.2, 0.3, 1.25]])
            (kinetic(casimir2 = 0.2, space_inertia = [[1.5, 0.3, 0.7], [0.3, 2.1, -0.4], [0.7, -0.4, 1.1]]));
        3 (space = [[2, 0.5, 0], [0.5, 1.5, -0.25], [0, -0.25, 1]], body = [[1, -0.4, 0.2], [-0.4, 3, 0.3], [0.2, 0.3, 1.25]])
            (kinetic(dalembert = [[1.5, 0.3, 0.7], [0.3, 2.1, -0.4], [0.7, -0.4, 1.1]]),
             potential = neo_hookean(1));
        // A basis that is orthogonal for the metric leaves a diagonal matrix diagonal.
        3 (space = diag(2, 3, 5), body = diag(3, 7, 2)) (kinetic(dalembert = diag(1.5, 2, 3)), potential = hyperbolic_dilatation(1));
        3 (space = diag(2, 3, 5), body = diag(3, 7, 2)) (kinetic(casimir2 = 0.2, body_inertia = diag(1.5, 2, 3)));
    }
}

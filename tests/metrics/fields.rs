//! The same with metrics and matrices in fields, on random ones.

use affine_oracle::{Kinetic, Matrix as Exact, Random, Term, rational};
use affine_runtime::prelude::*;

use super::{agrees, pinned, product};

const SEEDS: u64 = 4;

fn numbers<const K: usize>(exact: &Exact) -> Matrix<K> {
    Matrix::<K>::from_row_slice(&exact.to_f64())
}

macro_rules! random {
    ($($name:ident $n:literal $k:literal ($($kinetic:tt)*) $sample:ident |$g:ident $eta:ident $j:ident| $term:expr;)*) => { $(
        #[test]
        fn $name() {
            #[affine_model(dim = $n, metrics(space = g, body = eta), kinetic($($kinetic)*))]
            struct Body {
                g: Matrix<$n>,
                eta: Matrix<$n>,
                j: Matrix<$k>,
            }
            for seed in 0..SEEDS {
                let mut random = Random::new(2617 + seed);
                let ($g, $eta, $j) = (random.inertia($n), random.inertia($n), random.$sample($n));
                let fields = Body { g: numbers(&$g), eta: numbers(&$eta), j: numbers(&$j) };
                let model = fields.prepare().unwrap();
                let kinetic = Kinetic::new($n, $term).unwrap();
                let (at, back) = pinned!(model, $n);
                agrees(&model, &kinetic, at, back);
            }
        }
    )* };
}

random! {
    body_inertia_in_the_plane 2 2 (casimir2 = 1/8, body_inertia = j) inertia
        |_g eta j| vec![Term::BodyTensor(product(2, &eta, &j)), Term::Casimir2(rational(1, 8))];
    body_inertia_in_space 3 3 (casimir2 = 1/8, casimir1_squared = 1/16, body_inertia = j) inertia
        |_g eta j| vec![
            Term::BodyTensor(product(3, &eta, &j)),
            Term::Casimir2(rational(1, 8)),
            Term::Casimir1Squared(rational(1, 16)),
        ];
    space_inertia_in_the_plane 2 2 (casimir2 = 1/8, space_inertia = j) inertia
        |g _eta j| vec![Term::SpaceTensor(product(2, &g, &j)), Term::Casimir2(rational(1, 8))];
    space_inertia_in_space 3 3 (casimir2 = 1/8, space_inertia = j) inertia
        |g _eta j| vec![Term::SpaceTensor(product(3, &g, &j)), Term::Casimir2(rational(1, 8))];
    dalembert_in_the_plane 2 2 (dalembert = j) inertia |g _eta j| vec![Term::FlatTensor(product(2, &g, &j))];
    dalembert_in_space 3 3 (dalembert = j) inertia |g _eta j| vec![Term::FlatTensor(product(3, &g, &j))];
    body_tensor_in_the_plane 2 4 (body_tensor = j, casimir2 = 1/8) tensor
        |_g _eta j| vec![Term::BodyTensor(j.clone()), Term::Casimir2(rational(1, 8))];
    body_tensor_in_space 3 9 (body_tensor = j) tensor |_g _eta j| vec![Term::BodyTensor(j.clone())];
    space_tensor_in_the_plane 2 4 (space_tensor = j, space_inertia = 1/2) tensor
        |g _eta j| vec![
            Term::SpaceTensor(j.clone()),
            Term::SpaceTensor(product(2, &g, &g.inverse().unwrap()).scaled(&rational(1, 2))),
        ];
    space_tensor_in_space 3 9 (space_tensor = j) tensor |_g _eta j| vec![Term::SpaceTensor(j.clone())];
    flat_tensor_in_the_plane 2 4 (flat_tensor = j) tensor |_g _eta j| vec![Term::FlatTensor(j.clone())];
    flat_tensor_in_space 3 9 (flat_tensor = j) tensor |_g _eta j| vec![Term::FlatTensor(j.clone())];
}

/// A matrix in fields beside metrics in numbers, and the reverse; entries of `diag(..)` are fields of their own.
#[test]
fn one_of_both() {
    #[affine_model(dim = 2, metrics(body = [[1, -0.4], [-0.4, 3]]), kinetic(casimir2 = 1/8, body_inertia = j))]
    struct OfMatrix {
        j: Matrix<2>,
    }
    #[affine_model(
        dim = 2,
        metrics(space = diag(2, 3), body = eta),
        kinetic(casimir2 = 1/8, body_inertia = [[1.5, 0.25], [0.25, 2]])
    )]
    struct OfMetric {
        eta: Matrix<2>,
    }
    #[affine_model(dim = 2, metrics(space = [[1, -0.4], [-0.4, 3]]), kinetic(dalembert = diag(a, 2)))]
    struct OfEntries {
        a: f64,
    }
    let known = super::twentieths(2, &[20, -8, -8, 60]);
    let casimir2 = || Term::Casimir2(rational(1, 8));
    for seed in 0..SEEDS {
        let mut random = Random::new(4099 + seed);
        let given = random.inertia(2);
        let model = OfMatrix { j: numbers(&given) }.prepare().unwrap();
        let kinetic =
            Kinetic::new(2, vec![Term::BodyTensor(product(2, &known, &given)), casimir2()]).unwrap();
        let (at, back) = pinned!(model, 2);
        agrees(&model, &kinetic, at, back);

        let model = OfMetric { eta: numbers(&given) }.prepare().unwrap();
        let inertia = super::twentieths(2, &[30, 5, 5, 40]);
        let kinetic =
            Kinetic::new(2, vec![Term::BodyTensor(product(2, &given, &inertia)), casimir2()]).unwrap();
        let (at, back) = pinned!(model, 2);
        agrees(&model, &kinetic, at, back);
    }
    let model = OfEntries { a: 1.5 }.prepare().unwrap();
    let inertia = super::twentieths(2, &[30, 0, 0, 40]);
    let kinetic = Kinetic::new(2, vec![Term::FlatTensor(product(2, &known, &inertia))]).unwrap();
    let (at, back) = pinned!(model, 2);
    agrees(&model, &kinetic, at, back);
}

/// What is degenerate or has a wrong sign is so in every basis, and the velocity is told in the user's.
#[test]
fn refused_by_prepare() {
    #[affine_model(dim = 2, metrics(space = diag(4, 1), body = [[4, 0], [0, 1]]), kinetic(casimir2 = a, body_inertia = j))]
    struct Body {
        a: f64,
        j: Matrix<2>,
    }
    // J' = diag(1, 1): I - A = 0, and the rotation w' is [[0, w], [-4 w, 0]] in the user's basis.
    let refused = Body { a: 1.0, j: Matrix::<2>::new(0.25, 0.0, 0.0, 1.0) }.prepare();
    let Err(affine_runtime::Error::IllPosed(defect)) = refused else { panic!("accepted") };
    let rows: Vec<f32> = defect.velocity.expect("a velocity").rows().flatten().copied().collect();
    assert!((rows[2] / rows[1] + 4.0).abs() < 1e-5 && rows[0].abs() < 1e-6, "{rows:?}");
    #[affine_model(dim = 2, metrics(body = eta), kinetic(dalembert = j))]
    struct Masses {
        eta: Matrix<2>,
        j: Matrix<2>,
    }
    let eta = Matrix::<2>::new(2.0, 0.5, 0.5, 1.0);
    assert!(Masses { eta, j: Matrix::<2>::new(1.0, 0.5, 0.5, 1.0) }.prepare().is_ok());
    assert!(Masses { eta, j: Matrix::<2>::new(1.0, 2.0, 2.0, 1.0) }.prepare().is_err());
    assert!(Masses { eta, j: Matrix::<2>::new(1.0, 0.5, 0.25, 1.0) }.prepare().is_err());
    #[affine_model(dim = 2, metrics(body = eta), kinetic(casimir2 = 1, body_inertia = j))]
    struct Given {
        eta: Matrix<2>,
        j: Matrix<2>,
    }
    let eta = Matrix::<2>::new(4.0, 0.0, 0.0, 1.0);
    let refused = Given { eta, j: Matrix::<2>::new(0.25, 0.0, 0.0, 1.0) }.prepare();
    let Err(affine_runtime::Error::IllPosed(defect)) = refused else { panic!("accepted") };
    let rows: Vec<f32> = defect.velocity.expect("a velocity").rows().flatten().copied().collect();
    assert!((rows[2] / rows[1] + 4.0).abs() < 1e-5 && rows[0].abs() < 1e-6, "{rows:?}");
}

/// No operation is added, and what is zero stays so where the metric is diagonal.
#[test]
fn the_right_hand_side_does_not_grow() {
    #[affine_model(dim = 3, metrics(space = g, body = diag(a, b, 1)), kinetic(dalembert = diag(1.5, 2, b)))]
    struct Diagonal {
        g: Matrix<3>,
        a: f64,
        b: f64,
    }
    #[affine_model(dim = 3, kinetic(dalembert = diag(1.5, 2, b)))]
    struct Plain {
        b: f64,
    }
    assert_eq!(PreparedDiagonal::DESCRIPTION.full_operations, PreparedPlain::DESCRIPTION.full_operations);
    #[affine_model(dim = 3, metrics(space = g), kinetic(casimir2 = 0.2, space_inertia = j, space_translation = 1))]
    struct Matrices {
        g: Matrix<3>,
        j: Matrix<3>,
    }
    #[affine_model(dim = 3, kinetic(casimir2 = 0.2, space_inertia = j, space_translation = 1))]
    struct Orthonormal {
        j: Matrix<3>,
    }
    let (metric, plain) = (PreparedMatrices::DESCRIPTION, PreparedOrthonormal::DESCRIPTION);
    assert_eq!(metric.reduced_operations, plain.reduced_operations);
    assert_eq!(metric.full_operations, plain.full_operations);
    assert_eq!(metric.conserved, plain.conserved);
    let model = Diagonal { g: Matrix::<3>::identity(), a: 2.0, b: 3.0 }.prepare().unwrap();
    assert_eq!(model.bases().unwrap().space, Matrix::<3>::identity());
    let _ = Plain { b: 1.0 }.prepare().unwrap();
    let _ = Orthonormal { j: Matrix::<3>::identity() }.prepare().unwrap();
    let _ = Matrices { g: Matrix::<3>::identity(), j: Matrix::<3>::identity() }.prepare().unwrap();
}

/// A matrix field beside a metric that is a field stands in the user's bases, and what is printed in the orthonormal ones has a name
/// of its own.
#[test]
fn fields_in_the_given_bases_are_printed_so() {
    #[affine_model(dim = 2, metrics(body = h), kinetic(dalembert = j), potential = tr(G))]
    struct Carried {
        h: Matrix<2>,
        j: Matrix<2>,
    }
    #[affine_model(dim = 2, kinetic(dalembert = j), potential = tr(G))]
    struct Plain {
        j: Matrix<2>,
    }
    let [carried, plain] = [PreparedCarried::DESCRIPTION, PreparedPlain::DESCRIPTION];
    assert_eq!(carried.kinetic_energy.text, "T = 1/2 tr(phi_dot J phi_dot^T), J = j in the given bases");
    assert_eq!(carried.hamiltonian.text, "H = 1/2 tr(Pi^T J^-1 Pi) + tr(G)");
    assert_eq!(plain.kinetic_energy.text, "T = 1/2 tr(phi_dot j phi_dot^T)");
    // eta = B^T B: J = B j B^T.
    let (h, j) = (Matrix::<2>::new(4.0, 0.0, 0.0, 9.0), Matrix::<2>::new(1.0, 0.25, 0.25, 2.0));
    let model = Carried { h, j }.prepare().unwrap();
    let rate = Matrix::<2>::new(0.3, -0.2, 0.5, 0.1);
    let point = model.at_velocity(Matrix::<2>::identity(), rate).unwrap();
    let factor = Matrix::<2>::new(2.0, 0.0, 0.0, 3.0);
    let [inertia, orthonormal] = [factor * j * factor.transpose(), rate * factor.try_inverse().unwrap()];
    let kinetic = 0.5 * (orthonormal * inertia * orthonormal.transpose()).trace();
    let green = (factor.try_inverse().unwrap().transpose() * factor.try_inverse().unwrap()).trace();
    assert!((model.hamiltonian(0.0, &point) - kinetic - green).abs() < 1e-14);
}

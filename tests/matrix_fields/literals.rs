//! A model with literals and one with fields of the same numbers are the same model, up to rounding.

use affine_oracle::{Random, State};
use affine_runtime::model::{Conserved, Description};
use affine_runtime::prelude::*;

/// Condition of the mass matrices below 10, and some hundred roundings.
const ROUNDING: f64 = 1e-13;

type Square<const K: usize> = [[f64; K]; K];

const J2: Square<2> = [[2.0, 0.5], [0.5, -1.0]];
const P2: Square<2> = [[2.0, 0.5], [0.5, 1.0]];
const J3: Square<3> = [[2.0, 0.5, 0.0], [0.5, -1.5, 0.25], [0.0, 0.25, 1.0]];
const P3: Square<3> = [[2.0, 0.5, 0.0], [0.5, 1.5, 0.25], [0.0, 0.25, 1.0]];
const K2: Square<4> =
    [[2.0, 0.5, -0.25, 0.5], [0.5, -3.0, 0.75, 0.0], [-0.25, 0.75, 1.75, 0.125], [0.5, 0.0, 0.125, 4.0]];
const K3: Square<9> = [
    [2.0, 0.25, 0.0, -0.125, 0.0, 0.5, 0.0, 0.0, 0.25],
    [0.25, 1.5, 0.125, 0.0, 0.25, 0.0, 0.0, -0.25, 0.0],
    [0.0, 0.125, -1.75, 0.25, 0.0, 0.0, 0.5, 0.0, 0.125],
    [-0.125, 0.0, 0.25, 2.5, 0.125, 0.0, 0.0, 0.75, 0.0],
    [0.0, 0.25, 0.0, 0.125, 3.0, -0.5, 0.25, 0.0, 0.5],
    [0.5, 0.0, 0.0, 0.0, -0.5, -2.25, 0.125, 0.25, 0.0],
    [0.0, 0.0, 0.5, 0.0, 0.25, 0.125, 1.75, 0.0, -0.25],
    [0.0, -0.25, 0.0, 0.75, 0.0, 0.25, 0.0, 2.0, 0.125],
    [0.25, 0.0, 0.125, 0.0, 0.5, 0.0, -0.25, 0.125, 2.25],
];

/// From rows.
fn matrix<const K: usize>(rows: Square<K>) -> Matrix<K> {
    Matrix::<K>::from_fn(|i, j| rows[i][j])
}

pub(crate) fn close(what: &str, found: &[f64], expected: &[f64]) {
    let norm = |entries: &[f64]| entries.iter().fold(0.0, |length, entry| f64::hypot(length, *entry));
    assert_eq!(found.len(), expected.len(), "{what}");
    let difference: Vec<f64> = found.iter().zip(expected).map(|(f, e)| f - e).collect();
    // Written so that NaN fails.
    assert!(norm(&difference) <= ROUNDING * (1.0 + norm(expected)), "{what}: {found:?} {expected:?}");
}

/// Velocities, energies, equations and the way back from velocities agree.
fn same<const N: usize, F: Model<N>, L: Model<N>>(
    (field, literal): (&F, &L),
    start: impl Fn(&State) -> (F::Point<f64>, L::Point<f64>),
) {
    // What is conserved as a whole is decided for all matrices: nothing more than for this one, nor less for a generic one.
    // Sums of components have numbers for factors: of matrices that are fields fewer can be told.
    let lists = |description: &Description| [description.conserved, description.conserved_at_rest];
    for (of_field, of_literal) in lists(&F::DESCRIPTION).into_iter().zip(lists(&L::DESCRIPTION)) {
        let whole = |list: &[Conserved]| -> Vec<Conserved> {
            list.iter().copied().filter(|quantity| !matches!(quantity, Conserved::Component(_))).collect()
        };
        assert_eq!(whole(of_field), whole(of_literal));
        assert!(of_field.iter().all(|quantity| of_literal.contains(quantity)), "{of_field:?}");
    }
    for seed in 0..8 {
        let state = Random::new(733 + seed).state(N);
        let (with_field, with_literal) = start(&state);
        let velocity = field.velocity(&with_field);
        let expected = literal.velocity(&with_literal);
        close("x_dot", velocity.x_dot.as_slice(), expected.x_dot.as_slice());
        close("phi_dot", velocity.phi_dot.as_slice(), expected.phi_dot.as_slice());
        let energy = literal.hamiltonian(0.5, &with_literal);
        close("H", &[field.hamiltonian(0.5, &with_field)], &[energy]);
        close(
            "T",
            &[field.kinetic_energy(with_field.phi(), &velocity)],
            &[literal.kinetic_energy(with_literal.phi(), &expected)],
        );
        let rates = field.hamilton_equations(0.5, &field.flatten(&with_field));
        let expected = literal.hamilton_equations(0.5, &literal.flatten(&with_literal));
        close("equations", rates.as_ref(), expected.as_ref());
        let (reduced, constants) = field.reduce(0.5, &with_field);
        let rates = field.reduced_equations(0.75, &constants, &reduced);
        let (reduced, constants) = literal.reduce(0.5, &with_literal);
        let expected = literal.reduced_equations(0.75, &constants, &reduced);
        close("reduced equations", rates.as_ref(), expected.as_ref());
    }
}

macro_rules! twins {
    ($($name:ident $n:literal $centre:ident [$($field:ident: $ty:ty = $value:expr),*] ($($with_fields:tt)*) ($($with_literals:tt)*);)*) => { $(
        #[test]
        fn $name() {
            #[affine_model(dim = $n, $($with_fields)*)]
            struct Field { $($field: $ty),* }
            #[affine_model(dim = $n, $($with_literals)*)]
            struct Literal;
            let field = Field { $($field: $value),* }.prepare().unwrap();
            same((&field, &Literal), |state| twins!(@start $centre $n state field));
        }
    )* };
    (@start pinned $n:literal $state:ident $field:ident) => {{
        let (phi, pi) = ($state.phi.to_f64(), $state.pi.to_f64());
        let [phi, pi] = [phi, pi].map(|m| Matrix::<$n>::from_row_slice(&m));
        let field = $field.at_momentum(phi, TwoPoint(pi)).unwrap();
        let literal = Literal.at_momentum(phi, TwoPoint(pi)).unwrap();
        // The Legendre transformation itself.
        let phi_dot = Literal.velocity(&literal).phi_dot;
        let back = $field.at_velocity(phi, phi_dot).unwrap();
        close("Pi", back.pi().0.0.as_slice(), pi.as_slice());
        (field, literal)
    }};
    (@start moving $n:literal $state:ident $field:ident) => {{
        let [x, p] = [&$state.x, &$state.p].map(|v| Vector::<$n>::from_column_slice(&v.to_f64()));
        let [phi, pi] = [&$state.phi, &$state.pi].map(|m| Matrix::<$n>::from_row_slice(&m.to_f64()));
        let field = $field.at_momentum(x, phi, p, TwoPoint(pi)).unwrap();
        (field, Literal.at_momentum(x, phi, p, TwoPoint(pi)).unwrap())
    }};
}

twins! {
    body_inertia 3 moving [j: Matrix<3> = matrix(J3), a: f64 = 0.25]
        (kinetic(body_inertia = j, casimir2 = a, body_translation = 2))
        (kinetic(
            body_inertia = [[2, 0.5, 0], [0.5, -1.5, 0.25], [0, 0.25, 1]],
            casimir2 = 0.25,
            body_translation = 2,
        ));
    body_inertia_alone 2 pinned [j: [[f64; 2]; 2] = J2]
        (kinetic(body_inertia = j))
        (kinetic(body_inertia = [[2, 0.5], [0.5, -1]]));
    space_inertia 2 moving [j: Matrix<2, f64> = matrix(J2), b: f64 = 0.5]
        (kinetic(space_inertia = j, casimir2 = 0.25, casimir1_squared = b, space_translation = 2))
        (kinetic(
            space_inertia = [[2, 0.5], [0.5, -1]],
            casimir2 = 0.25,
            casimir1_squared = 0.5,
            space_translation = 2,
        ));
    dalembert 3 moving [j: Matrix<3> = matrix(P3), m: f64 = 2.0]
        (kinetic(dalembert = j, space_translation = m), potential = neo_hookean(0.5) + q^2)
        (
            kinetic(dalembert = [[2, 0.5, 0], [0.5, 1.5, 0.25], [0, 0.25, 1]], space_translation = 2),
            potential = neo_hookean(0.5) + q^2
        );
    body_tensor 2 pinned [k: affine_runtime::frames::Matrix<4> = matrix(K2), a: f64 = 0.25]
        (kinetic(body_tensor = k, casimir2 = a))
        (kinetic(
            body_tensor = [[2, 0.5, -0.25, 0.5], [0.5, -3, 0.75, 0], [-0.25, 0.75, 1.75, 0.125], [0.5, 0, 0.125, 4]],
            casimir2 = 0.25,
        ));
    space_tensor 3 moving [k: Matrix<9> = matrix(K3)]
        (kinetic(space_tensor = k, space_translation = 2))
        (kinetic(
            space_tensor = [
                [2.0, 0.25, 0.0, -0.125, 0.0, 0.5, 0.0, 0.0, 0.25],
                [0.25, 1.5, 0.125, 0.0, 0.25, 0.0, 0.0, -0.25, 0.0],
                [0.0, 0.125, -1.75, 0.25, 0.0, 0.0, 0.5, 0.0, 0.125],
                [-0.125, 0.0, 0.25, 2.5, 0.125, 0.0, 0.0, 0.75, 0.0],
                [0.0, 0.25, 0.0, 0.125, 3.0, -0.5, 0.25, 0.0, 0.5],
                [0.5, 0.0, 0.0, 0.0, -0.5, -2.25, 0.125, 0.25, 0.0],
                [0.0, 0.0, 0.5, 0.0, 0.25, 0.125, 1.75, 0.0, -0.25],
                [0.0, -0.25, 0.0, 0.75, 0.0, 0.25, 0.0, 2.0, 0.125],
                [0.25, 0.0, 0.125, 0.0, 0.5, 0.0, -0.25, 0.125, 2.25],
            ],
            space_translation = 2,
        ));
    flat_tensor 2 moving [k: [[f64; 4]; 4] = K2, i: f64 = 0.5]
        (kinetic(flat_tensor = k, dalembert = i, space_translation = 2))
        (kinetic(
            flat_tensor = [[2, 0.5, -0.25, 0.5], [0.5, -3, 0.75, 0], [-0.25, 0.75, 1.75, 0.125], [0.5, 0, 0.125, 4]],
            dalembert = 0.5,
            space_translation = 2,
        ));
    sum_of_frames 2 moving [j: Matrix<2> = matrix(P2)]
        (kinetic(dalembert = j, casimir2 = 0.25, space_inertia = 2, space_translation = 1))
        (kinetic(dalembert = [[2, 0.5], [0.5, 1]], casimir2 = 0.25, space_inertia = 2, space_translation = 1));
    dissipation 3 pinned [r: Matrix<3> = matrix(P3)]
        (kinetic(casimir2 = 0.25, body_inertia = 1), dissipation(body_inertia = r, casimir2 = 0.5))
        (
            kinetic(casimir2 = 0.25, body_inertia = 1),
            dissipation(body_inertia = [[2, 0.5, 0], [0.5, 1.5, 0.25], [0, 0.25, 1]], casimir2 = 0.5)
        );
    left_metrics 3 moving [g: Matrix<3> = matrix(P3), c: f64 = 1.25]
        (
            kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, space_translation = 2),
            metrics(space = g, body = diag(1, c, 2)),
            potential = neo_hookean(0.5) + q^2
        )
        (
            kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, space_translation = 2),
            metrics(space = [[2, 0.5, 0], [0.5, 1.5, 0.25], [0, 0.25, 1]], body = diag(1, 1.25, 2)),
            potential = neo_hookean(0.5) + q^2
        );
    body_metric 2 pinned [eta: [[f64; 2]; 2] = P2, i: f64 = 1.5]
        (kinetic(dalembert = i), metrics(body = eta))
        (kinetic(dalembert = 1.5), metrics(body = [[2, 0.5], [0.5, 1]]));
}

#[test]
fn rigid_and_conformal_motions() {
    #[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = j), potential = 0.7*phi[3,3])]
    struct Top {
        j: Matrix<3>,
    }
    #[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = [[2, 0.5, 0], [0.5, 1.5, 0.25], [0, 0.25, 1]]),
                   potential = 0.7*phi[3,3])]
    struct Literal;
    let field = Top { j: matrix(P3) }.prepare().unwrap();
    let omega = Matrix::<3>::new(0.0, -2.0, 0.1, 2.0, 0.0, -0.3, -0.1, 0.3, 0.0);
    let point = field.at_velocity(Matrix::<3>::identity(), omega).unwrap();
    let expected = Literal.at_velocity(Matrix::<3>::identity(), omega).unwrap();
    close("Sigma_hat", point.sigma_hat().0.0.as_slice(), expected.sigma_hat().0.0.as_slice());
    let rates = field.hamilton_equations(0.0, &field.flatten(&point));
    close("top", rates.as_ref(), Literal.hamilton_equations(0.0, &Literal.flatten(&expected)).as_ref());
    assert_eq!(PreparedTop::DESCRIPTION.conserved, Literal::DESCRIPTION.conserved);
}

/// The motion follows, by every method that a literal model has.
#[test]
fn runs() {
    #[affine_model(dim = 3, kinetic(body_inertia = j, casimir2 = 0.25, body_translation = 2), emit(taylor, lanes))]
    #[derive(Clone)]
    struct Field {
        j: Matrix<3>,
    }
    #[affine_model(dim = 3, kinetic(body_inertia = [[2, 0.5, 0], [0.5, 1.5, 0.25], [0, 0.25, 1]], casimir2 = 0.25,
                                    body_translation = 2), emit(taylor, lanes))]
    struct Literal;
    let field = Field { j: matrix(P3) }.prepare().unwrap();
    let (x, p) = (Vector::<3>::zeros(), Vector::<3>::new(0.3, -0.2, 0.5));
    let spin = Comoving(Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05));
    let start = field.at_momentum(x, Matrix::<3>::identity(), p, spin).unwrap();
    let expected = Literal.at_momentum(x, Matrix::<3>::identity(), p, spin).unwrap();
    let run = Simulation::new(&field, start).until(2.0).tolerance(1e-13).run().unwrap();
    let reference = Simulation::new(&Literal, expected).until(2.0).tolerance(1e-13).run().unwrap();
    let error = (run.end().1.phi() - reference.end().1.phi()).norm();
    assert!(error < 1e-11, "{error:e}");
    assert!(run.conservation().worst() < 1e-11, "{}", run.conservation());
}

/// `phi -> phi exp(s X)` leaves spatial terms alone, and `tr(phi_dot J phi_dot^T)` where `X J` is skew. In the plane that is
/// `X = e J^-1` with `e_12 = 1 = -e_21`, and `tr(X Sigma_hat)` is conserved.
#[test]
fn numbers_tell_a_component_that_fields_do_not() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = [[2, 0.5], [0.5, 1]], casimir2 = 0.25, space_inertia = 2, space_translation = 1)
    )]
    struct Body;
    let component = Body::DESCRIPTION.conserved.last().unwrap();
    assert_eq!(component.symbol(), "sigma_hat_11 + 2*sigma_hat_12 - 4*sigma_hat_21 - sigma_hat_22");
    let x = Matrix::<2>::new(0.0, 1.0, -1.0, 0.0) * matrix(P2).try_inverse().unwrap();
    let expected = x.transpose() / x[(0, 0)];
    assert!((expected - Matrix::<2>::new(1.0, 2.0, -4.0, -1.0)).norm() < 1e-14, "{expected}");

    let (phi, spin) = (Matrix::<2>::new(1.1, 0.2, -0.1, 0.9), Matrix::<2>::new(0.1, 0.7, -0.2, 0.3));
    let start = Body.at_momentum(Vector::zeros(), phi, Vector::<2>::new(0.3, -0.2), Comoving(spin)).unwrap();
    let run = Simulation::new(&Body, start).until(1.0).tolerance(1e-13).run().unwrap();
    assert_eq!(run.conservation().drifts().len(), Body::DESCRIPTION.conserved.len());
    assert!(run.conservation().worst() < 1e-11, "{}", run.conservation());
}

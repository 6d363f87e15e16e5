//! Forces and potentials of fields beside metrics: their components are those of the user's bases.

use affine_oracle::{Differential, Kinetic, Place as Where, Random, State, Term, rational};
use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::frames::{Body as OnBody, Space as OnSpace};
use affine_runtime::model::Conserved;
use affine_runtime::potential::{Class, Place, Potential, Slopes};
use affine_runtime::prelude::*;
use affine_runtime::sampling;
use affine_runtime::scalar::Scalar;

use super::{agrees_under, close, moving, pinned, plane, product, space};

/// What a balance of power leaves open in runs of tolerance 1e-12.
pub(crate) const BALANCE: f64 = 1e-9;

type Matrices<const N: usize> = Matrix<N>;

fn motion<const N: usize>(kinetic: &Kinetic, state: &State) -> Motion<N> {
    let free = kinetic.expected(state).unwrap();
    Motion {
        t: 0.0,
        x: Vector::<N>::from_column_slice(&state.x.to_f64()),
        phi: Matrix::<N>::from_row_slice(&state.phi.to_f64()),
        x_dot: Vector::<N>::from_column_slice(&free.x_dot),
        phi_dot: Matrix::<N>::from_row_slice(&free.phi_dot),
    }
}

/// Row-major.
fn rows<const N: usize>(matrix: &Matrices<N>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// A matrix of components that belongs to no tensor: other bases would show.
#[derive(Clone)]
struct Components;

impl Components {
    fn matrix<const N: usize, T: Scalar>(motion: &Motion<N, T>) -> Matrix<N, T> {
        let outer = motion.x * motion.x_dot.transpose();
        motion.phi_dot * motion.phi + outer - Matrix::<N, T>::identity()
    }
}

#[derive(Clone)]
struct Spatially;

impl<const N: usize> Force<N> for Spatially {
    type Form = OnSpace;
    fn force<T: Scalar>(&self, motion: &Motion<N, T>) -> Matrix<N, T> {
        Components::matrix(motion)
    }
}

#[derive(Clone)]
struct InTheBody;

impl<const N: usize> Force<N> for InTheBody {
    type Form = OnBody;
    fn force<T: Scalar>(&self, motion: &Motion<N, T>) -> Matrix<N, T> {
        Components::matrix(motion)
    }
}

#[derive(Clone)]
struct OnTheCentre;

impl<const N: usize> Force<N> for OnTheCentre {
    type Form = Translation;
    fn force<T: Scalar>(&self, motion: &Motion<N, T>) -> Vector<N, T> {
        motion.phi * motion.x - motion.x_dot
    }
}

/// `Q_tr = B x_dot` with a two-form `B`: no power in any basis.
#[derive(Clone)]
struct Magnet;

impl<const N: usize> Force<N> for Magnet {
    type Form = Translation;
    const GYROSCOPIC: bool = true;
    fn force<T: Scalar>(&self, motion: &Motion<N, T>) -> Vector<N, T> {
        let mut force = Vector::<N, T>::from_fn(|_, _| T::zero());
        (force[0], force[1]) = (motion.x_dot[1], -motion.x_dot[0]);
        force
    }
}

/// The forces on `p` and, row-major in `(A, i)`, on `Pi`: `N = phi^-1 Q = Q_hat phi^-1`.
fn pushes<const N: usize>(motion: &Motion<N>) -> [(Vec<f64>, Vec<f64>); 4] {
    let inverse = motion.phi.try_inverse().unwrap();
    let (nothing, still) = (vec![0.0; N], vec![0.0; N * N]);
    let on_centre: Vector<N> = Force::<N>::force(&OnTheCentre, motion);
    let magnet: Vector<N> = Force::<N>::force(&Magnet, motion);
    let components = Components::matrix(motion);
    [
        (nothing.clone(), rows(&(inverse * components))),
        (nothing, rows(&(components * inverse))),
        (on_centre.as_slice().to_vec(), still.clone()),
        (magnet.as_slice().to_vec(), still),
    ]
}

macro_rules! forced {
    ($($name:ident $which:literal $field:ident ($($form:tt)*);)*) => { $(
        #[test]
        fn $name() {
            #[affine_model(
                dim = 2,
                metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
                kinetic(casimir2 = 0.2, body_inertia = [[1.5, 0.25], [0.25, 2]], body_translation = 2),
                forces = custom(field, $($form)*)
            )]
            struct Plane {
                field: $field,
            }
            #[affine_model(
                dim = 3,
                metrics(space = g, body = eta),
                kinetic(dalembert = 1, space_translation = 2),
                forces = custom(field, $($form)*)
            )]
            struct Space {
                g: Matrix<3>,
                eta: Matrix<3>,
                field: $field,
            }
            let [_, _, eta, _] = plane();
            let inertia = super::twentieths(2, &[30, 5, 5, 40]);
            let kinetic = Kinetic::new(
                2,
                vec![
                    Term::BodyTensor(product(2, &eta, &inertia)),
                    Term::Casimir2(rational(1, 5)),
                    Term::BodyTranslationMetric(eta.scaled(&rational(2, 1))),
                ],
            )
            .unwrap();
            let model = Plane { field: $field };
            let (at, back) = moving!(model, 2);
            accounted::<2, _>(&model, &kinetic, $which, at, back);
            let [g, _, eta, eta_inverse] = space();
            let kinetic = Kinetic::new(
                3,
                vec![
                    Term::FlatTensor(product(3, &g, &eta_inverse)),
                    Term::SpaceTranslationMetric(g.scaled(&rational(2, 1))),
                ],
            )
            .unwrap();
            let [g, eta] = [&g, &eta].map(|m| Matrix::<3>::from_row_slice(&m.to_f64()));
            let model = Space { g, eta, field: $field }.prepare().unwrap();
            let (at, back) = moving!(model, 3);
            accounted::<3, _>(&model, &kinetic, $which, at, back);
        }
    )* };
}

/// Equations, power, and the balance of a run.
fn accounted<const N: usize, M: Model<N>>(
    model: &M,
    kinetic: &Kinetic,
    which: usize,
    at: impl Fn(&State) -> M::Point<f64>,
    back: impl Fn(&M::Point<f64>, &affine_runtime::model::Velocity<N>) -> M::Point<f64>,
) {
    let push = |state: &State| pushes(&motion::<N>(kinetic, state))[which].clone();
    let under = |state: &State| {
        let (on_p, on_pi) = push(state);
        kinetic.motion(state).unwrap().pushed(&on_p, &on_pi).unwrap().expected().unwrap()
    };
    agrees_under(model, kinetic, under, &at, back);
    let energy = M::DESCRIPTION.conserved.contains(&Conserved::Energy);
    assert_eq!(energy, which == 3);
    for seed in 0..4 {
        let state = Random::new(3100 + seed).state(N);
        let (motion, (on_p, on_pi)) = (motion::<N>(kinetic, &state), push(&state));
        let on_pi = Matrix::<N>::from_row_slice(&on_pi);
        let power =
            (on_pi * motion.phi_dot).trace() + Vector::<N>::from_column_slice(&on_p).dot(&motion.x_dot);
        let expected = if energy { 0.0 } else { power };
        close("power", &[model.power(0.0, &at(&state))], &[expected], on_pi.norm() * motion.phi_dot.norm());
    }
    let start = at(&Random::new(3101).state(N));
    let run = Simulation::new(model, start).until(0.125).tolerance(1e-12).run().unwrap();
    match run.power_balance() {
        Some(balance) => assert!(balance.relative() <= BALANCE && balance.work != 0.0, "{balance}"),
        None => assert!(run.conservation().worst() <= BALANCE, "{}", run.conservation()),
    }
}

forced! {
    spatial 0 Spatially (spatial);
    comoving 1 InTheBody (comoving);
    translational 2 OnTheCentre (translation);
    gyroscopic 3 Magnet (translation, gyroscopic);
}

#[test]
fn the_magnet_has_no_power() {
    sampling::check_force::<2, _>(&Magnet, sampling::motions(8)).unwrap();
}

/// `x_1 phi_12 + phi_21^2`, which no rotation leaves unchanged.
#[derive(Clone)]
struct General;

impl<const N: usize> Potential<N> for General {
    const CLASS: Class = Class::General;
    const POSITION: bool = true;
    fn energy<T: Scalar>(&self, place: &Place<N, T>) -> T {
        place.x[0] * place.phi[(0, 1)] + place.phi[(1, 0)] * place.phi[(1, 0)]
    }
    fn slopes<T: Scalar>(&self, place: &Place<N, T>) -> Slopes<N, T> {
        let zero = T::zero();
        let mut x = Vector::<N, T>::from_fn(|_, _| zero);
        let mut phi = Matrix::<N, T>::from_fn(|_, _| zero);
        x[0] = place.phi[(0, 1)];
        phi[(0, 1)] = place.x[0];
        phi[(1, 0)] = place.phi[(1, 0)] + place.phi[(1, 0)];
        Slopes { x, phi }
    }
}

fn general(place: &Where) -> Differential {
    place.x(1) * place.phi(1, 2) + place.phi(2, 1) * place.phi(2, 1)
}

/// `tr(eta^-1 phi^T g phi)/2`, isotropic for the metrics.
#[derive(Clone)]
struct Spring<const N: usize> {
    g: Matrix<N>,
    eta_inverse: Matrix<N>,
}

impl<const N: usize> Spring<N> {
    fn pull<T: Scalar>(&self, phi: &Matrix<N, T>) -> Matrix<N, T> {
        let exact = |matrix: &Matrix<N>| matrix.map(|entry| T::constant(entry, 0.0));
        exact(&self.g) * phi * exact(&self.eta_inverse)
    }
}

impl<const N: usize> Potential<N> for Spring<N> {
    const CLASS: Class = Class::Isotropic;
    fn energy<T: Scalar>(&self, place: &Place<N, T>) -> T {
        (place.phi.transpose() * self.pull(&place.phi)).trace() * T::constant(0.5, 0.0)
    }
    fn slopes<T: Scalar>(&self, place: &Place<N, T>) -> Slopes<N, T> {
        Slopes { x: Vector::<N, T>::from_fn(|_, _| T::zero()), phi: self.pull(&place.phi) }
    }
}

#[test]
fn potentials_of_fields() {
    #[affine_model(
        dim = 3,
        metrics(space = g, body = eta),
        kinetic(casimir2 = 0.2, space_inertia = 1, space_translation = 2),
        potential = hyperbolic_dilatation(2) + custom(field, general, position)
    )]
    struct Anchored {
        g: Matrix<3>,
        eta: Matrix<3>,
        field: General,
    }
    let [g, g_inverse, eta, _] = space();
    let kinetic = Kinetic::new(
        3,
        vec![
            Term::SpaceTensor(product(3, &g, &g_inverse)),
            Term::Casimir2(rational(1, 5)),
            Term::SpaceTranslationMetric(g.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    let [g_rows, eta_rows] = [&g, &eta].map(|m| Matrix::<3>::from_row_slice(&m.to_f64()));
    // q of the volumes of the metrics: det' phi = sqrt(det g/det eta) det phi.
    let volumes = (g_rows.determinant() / eta_rows.determinant()).ln() / 6.0;
    let model = Anchored { g: g_rows, eta: eta_rows, field: General }.prepare().unwrap();
    let under = |state: &State| {
        let energy = |place: &Where| {
            let q = place.q() + Differential::constant(volumes);
            general(place) + q.sinh() * q.sinh()
        };
        kinetic.motion(state).unwrap().under(0.0, &energy).unwrap().expected().unwrap()
    };
    let (at, back) = moving!(model, 3);
    agrees_under(&model, &kinetic, under, at, back);

    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
        kinetic(casimir2 = 0.2, body_inertia = 1),
        potential = custom(field, isotropic)
    )]
    struct Bound {
        field: Spring<2>,
    }
    let [g, _, eta, eta_inverse] = plane();
    let kinetic = Kinetic::new(
        2,
        vec![Term::BodyTensor(product(2, &eta, &eta_inverse)), Term::Casimir2(rational(1, 5))],
    )
    .unwrap();
    let [g, eta_inverse] = [&g, &eta_inverse].map(|m| Matrix::<2>::from_row_slice(&m.to_f64()));
    let model = Bound { field: Spring { g, eta_inverse } };
    let under = |state: &State| {
        let energy = |place: &Where| {
            let mut sum = Differential::constant(0.0);
            for (i, j, a, b) in indices() {
                let weight = 0.5 * g[(i, j)] * eta_inverse[(a, b)];
                sum = sum + place.phi(i + 1, a + 1) * place.phi(j + 1, b + 1) * weight;
            }
            sum
        };
        kinetic.motion(state).unwrap().under(0.0, &energy).unwrap().expected().unwrap()
    };
    let (at, back) = pinned!(model, 2);
    agrees_under(&model, &kinetic, under, at, back);
    let kept = <Bound as Model<2>>::DESCRIPTION.conserved;
    assert!(kept.contains(&Conserved::Spin) && kept.contains(&Conserved::Vorticity));
    let start = model
        .at_velocity(Matrix::<2>::new(1.1, 0.2, -0.1, 0.9), Matrix::<2>::new(0.1, 0.4, -0.3, -0.2))
        .unwrap();
    let run = Simulation::new(&model, start).until(5.0).tolerance(1e-13).run().unwrap();
    assert!(run.conservation().worst() < 1e-11, "{}", run.conservation());
}

fn indices() -> impl Iterator<Item = (usize, usize, usize, usize)> {
    (0..16).map(|k| (k / 8, k / 4 % 2, k / 2 % 2, k % 2))
}

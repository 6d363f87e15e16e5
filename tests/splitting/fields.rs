//! Pieces besides T and U: kicks by what fields compute, and friction, with their work.

use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::frames::Space;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;
pub(crate) use affine_tests::fields::{Field, Spring, Wall};

use crate::models::{p3, phi2, phi3, spin2, spin3, x3};

/// `Q_tr = c (phi_11 + x_2 cos t, x_1 phi_21, ..)`, without a potential.
#[derive(Clone)]
pub(crate) struct Swirl {
    pub(crate) strength: f64,
}

impl<const N: usize> Force<N> for Swirl {
    type Form = Translation;
    fn force<T: Scalar>(&self, m: &Motion<N, T>) -> Vector<N, T> {
        let c = T::constant(self.strength, 0.0);
        // What a force that is said to depend on positions is told of velocities is zero.
        let still = m.x_dot[0] + m.phi_dot[(0, 0)];
        let first = m.phi[(0, 0)] + m.x[1] * m.t.cos() + still;
        Vector::<N, T>::from_fn(|i, _| if i == 0 { c * first } else { c * m.x[0] * m.phi[(i, 0)] })
    }
}

/// `Q = c (phi_1a x_j + Ct_12)`, without a potential.
#[derive(Clone)]
pub(crate) struct Twist {
    pub(crate) strength: f64,
}

impl<const N: usize> Force<N> for Twist {
    type Form = Space;
    fn force<T: Scalar>(&self, m: &Motion<N, T>) -> Matrix<N, T> {
        let c = T::constant(self.strength, 0.0);
        let entry = (0..N).fold(T::zero(), |sum, a| sum + m.phi[(0, a)] * m.phi[(1, a)]);
        Matrix::<N, T>::from_fn(|i, j| {
            c * (m.phi[(0, i)] * m.x[j] + if i == j { entry } else { m.phi[(j, 0)] })
        })
    }
}

/// The same in the frame of the body.
#[derive(Clone)]
pub(crate) struct Squeeze(pub(crate) Twist);

impl<const N: usize> Force<N> for Squeeze {
    type Form = affine_runtime::frames::Body;
    fn force<T: Scalar>(&self, m: &Motion<N, T>) -> Matrix<N, T> {
        <Twist as Force<N>>::force(&self.0, m)
    }
}

/// In one piece with the potential.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 2),
    potential = tr(G)/2 - ln(det) + custom(field, general, position),
    forces = custom(swirl, translation, position) + custom(twist, spatial, position),
    emit(splitting),
)]
pub(crate) struct Kicked {
    pub(crate) field: Field,
    pub(crate) swirl: Swirl,
    pub(crate) twist: Twist,
}

/// A force in the other frame than the energy.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    forces = custom(twist, spatial, position),
    emit(splitting),
)]
pub(crate) struct Twisted {
    pub(crate) twist: Twist,
}

/// Without a potential that is a formula; the weight of the centre reads the placement.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 2),
    potential = custom(spring, isotropic),
    forces = custom(squeeze, comoving, position) + custom(swirl, translation, position),
    emit(splitting),
)]
pub(crate) struct Squeezed {
    pub(crate) spring: Spring,
    pub(crate) squeeze: Squeeze,
    pub(crate) swirl: Swirl,
}

/// Squares of an anisotropic energy, kicks of a potential alone.
#[affine_model(
    dim = 3,
    kinetic(space_inertia = diag(1, 1.5, 2), casimir1_squared = 0.1),
    potential = tr(G)/2 - ln(det) + custom(wall, finger),
    emit(splitting),
)]
pub(crate) struct Walled {
    pub(crate) wall: Wall,
}

/// The force on what the constraint leaves.
#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = tr(G)/2,
    forces = custom(twist, spatial, position),
    emit(splitting),
)]
pub(crate) struct Confined {
    pub(crate) twist: Twist,
}

/// Friction in the frame of the energy: momenta fade in blocks.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    dissipation(body_inertia = 0.3, casimir1_squared = 0.2),
    emit(splitting),
)]
pub(crate) struct Viscous;

/// Friction in the frames of body and space, of placement and centre, and a field: all momenta fade together.
#[affine_model(
    dim = 2,
    kinetic(dalembert = diag(1, 1.5), space_translation = 2),
    potential = tr(G)/2 - ln(det) + norm(x)^2/2,
    dissipation(body_inertia = r, space_inertia = 0.2, space_translation = 0.3),
    forces = custom(twist, spatial, position),
    emit(splitting),
)]
pub(crate) struct Damped {
    pub(crate) r: f64,
    pub(crate) twist: Twist,
}

/// Friction on a group, beside the weight of a centre that the body carries.
#[affine_model(
    dim = 3,
    constraint = isochoric,
    kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2),
    potential = tr(G)/2 + norm(x)^2/2,
    dissipation(space_inertia = 0.3, body_translation = 0.2),
    emit(splitting),
)]
pub(crate) struct Sticky;

/// Friction of a top.
#[affine_model(
    dim = 3,
    constraint = rigid,
    kinetic(body_inertia = diag(1, 1.5, 2)),
    potential = 5*phi[3,3],
    dissipation(body_inertia = diag(0.1, 0.2, 0.4)),
    emit(splitting),
)]
pub(crate) struct Slowed;

/// Halves of the equations, one of which a field computes.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 2),
    potential = tr(G)/2 - ln(det) + custom(field, general, position),
    emit(nystrom),
)]
struct Halved {
    field: Field,
}

macro_rules! each_with_fields {
    ($visit:ident) => {{
        use crate::fields::*;
        let (field, swirl) = (Field { strength: 0.3 }, Swirl { strength: 0.4 });
        let model = Kicked { field, swirl, twist: Twist { strength: 0.5 } }.prepare().unwrap();
        let (x, p) = (Vector::<2>::new(0.4, -0.1), Vector::<2>::new(0.3, -0.2));
        $visit!("kicked", 2, &model, model.at_momentum(x, phi2(), p, Spatial(spin2())).unwrap());
        let model = Twisted { twist: Twist { strength: 0.5 } }.prepare().unwrap();
        $visit!("twisted", 3, &model, model.at_momentum(phi3(), Comoving(spin3())).unwrap());
        let (spring, squeeze) = (Spring { strength: 0.5 }, Squeeze(Twist { strength: 0.3 }));
        let model = Squeezed { spring, squeeze, swirl: Swirl { strength: 0.4 } }.prepare().unwrap();
        $visit!("squeezed", 3, &model, model.at_momentum(x3(), phi3(), p3(), Comoving(spin3())).unwrap());
        let model = Walled { wall: Wall { strength: 0.5 } }.prepare().unwrap();
        $visit!("walled", 3, &model, model.at_momentum(phi3(), Spatial(spin3())).unwrap());
        let model = Confined { twist: Twist { strength: 0.5 } }.prepare().unwrap();
        let phi = phi3() / phi3().determinant().cbrt();
        $visit!("confined", 3, &model, model.at_momentum(phi, Comoving(spin3())).unwrap());
        let start = Viscous.at_momentum(phi3(), Comoving(spin3())).unwrap();
        $visit!("viscous", 3, &Viscous, start);
        let model = Damped { r: 0.4, twist: Twist { strength: 0.5 } }.prepare().unwrap();
        $visit!("damped", 2, &model, model.at_momentum(x, phi2(), p, Spatial(spin2())).unwrap());
        let start = Sticky.at_momentum(x3(), phi, p3(), Comoving(spin3())).unwrap();
        $visit!("sticky", 3, &Sticky, start);
        let start = Slowed
            .at_momentum(
                affine_runtime::decompose::Polar::of(&phi3()).unwrap().rotation,
                Comoving(3.0 * (spin3() - spin3().transpose())),
            )
            .unwrap();
        $visit!("slowed", 3, &Slowed, start);
    }};
}
pub(crate) use each_with_fields;

/// The work of the forces converges with the motion, and closes the balance of energy.
#[test]
fn work_of_kicks() {
    fn assert_work<const N: usize, M: Model<N>>(name: &str, model: &M, start: M::Point<f64>) {
        let run = |method| {
            let run = Simulation::new(model, start).until(2.0).tolerance(1e-14).output([2.0]).method(method);
            run.run().unwrap()
        };
        let exact = run(Method::RungeKutta8);
        let Some(&work) = exact.work().last() else { panic!("{name}: no work") };
        let error = |step| (run(Method::Splitting { order: 4, step }).work().last().unwrap() - work).abs();
        let errors = [error(0.05), error(0.025)];
        let done = M::DESCRIPTION.reduced.iter().any(|group| group.name() == "work");
        assert!(!done || errors[1] > 0.0 && errors[0] / errors[1] > 11.0, "{name}: {errors:?} of {work}");
        let fine = run(Method::Splitting { order: 8, step: 0.02 });
        let defect = fine.power_balance().map_or(0.0, |balance| balance.defect);
        assert!(!done || defect < 1e-10, "{name}: {defect:e}");
    }
    let mut count = 0;
    macro_rules! visit {
        ($name:literal, $n:literal, $model:expr, $start:expr) => {
            assert_work::<$n, _>($name, $model, $start);
            count += 1;
        };
    }
    each_with_fields!(visit);
    assert_eq!(count, 9);
}

/// Nothing is said to be symplectic that is not.
#[test]
fn friction_is_no_poisson_map() {
    let start = Viscous.at_momentum(phi3(), Comoving(spin3())).unwrap();
    let run = Simulation::new(&Viscous, start).until(1.0).method(Method::Splitting { order: 2, step: 0.1 });
    let why = run.run().unwrap().why().to_string();
    assert!(why.contains("the fading of momenta by friction") && !why.contains("Poisson"), "{why}");
}

#[test]
fn halves_with_a_field() {
    let model = Halved { field: Field { strength: 0.3 } }.prepare().unwrap();
    let start =
        model.at_momentum(Vector::<2>::new(0.4, -0.1), phi2(), Vector::<2>::new(0.3, -0.2), Spatial(spin2()));
    let start = start.unwrap();
    let end = |method| {
        let run = Simulation::new(&model, start).until(5.0).tolerance(1e-13).output([5.0]).method(method);
        *run.run().unwrap().end().1
    };
    let [one, other] = [Method::RungeKuttaNystrom12, Method::RungeKutta8].map(end);
    let error = crate::motions::difference(&one, &other);
    assert!(error < 1e-11, "{error:e}");
}

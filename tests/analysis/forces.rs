//! Derivatives of motions under forces that have a branch or a root that vanishes, against closed forms.

use affine_runtime::analysis::{
    AnalysisError, FlowMatrix, JacobianMatrix, Sensitivities, equilibrium, lyapunov_spectrum,
};
use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::model::Model;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

/// Where the height and its momentum are in the plain array.
const HEIGHT: (usize, usize) = (1, 7);

macro_rules! forced {
    ($($(#[$doc:meta])* $force:ident: $motion:ident => $value:expr;)*) => { $(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        struct $force;

        impl Force<2> for $force {
            type Form = Translation;
            fn force<T: Scalar>(&self, $motion: &Motion<2, T>) -> Vector<2, T> {
                $value
            }
        }
    )* };
}

fn speed_squared<T: Scalar>(motion: &Motion<2, T>) -> T {
    motion.x_dot[0] * motion.x_dot[0] + motion.x_dot[1] * motion.x_dot[1]
}

/// How deep a body is in the ground.
fn depth<T: Scalar>(motion: &Motion<2, T>) -> T {
    (-motion.x[1]).max(T::zero())
}

forced! {
    /// Quadratic drag, `-|v| v`.
    Drag: motion => -motion.x_dot * speed_squared(motion).sqrt();
    /// The same, with a branch at rest.
    GuardedDrag: motion => if speed_squared(motion) == T::zero() {
        Vector::<2, T>::zeros()
    } else {
        -motion.x_dot * speed_squared(motion).sqrt()
    };
    /// A spring with a branch where it is not stretched.
    GuardedSpring: motion => if motion.x[1].is_zero() {
        Vector::<2, T>::zeros()
    } else {
        Vector::<2, T>::new(T::zero(), -motion.x[1])
    };
    /// A force that grows with the time, with a branch at the time zero.
    Growing: motion => if motion.t == T::zero() {
        Vector::<2, T>::zeros()
    } else {
        Vector::<2, T>::new(T::zero(), motion.t)
    };
    /// Contact of spheres, `100 d^(3/2)`.
    Hertz: motion => Vector::<2, T>::new(T::zero(), depth(motion) * depth(motion).sqrt() * T::constant(100.0, 0.0));
    /// A softer one, `100 d^(4/3)`.
    Soft: motion => Vector::<2, T>::new(T::zero(), depth(motion) * depth(motion).cbrt() * T::constant(100.0, 0.0));
}

macro_rules! bodies {
    ($($body:ident ($($force:tt)*) {$($potential:tt)*})*) => { $(
        #[affine_model(
            dim = 2,
            kinetic(dalembert = 1, space_translation = m),
            potential = orthogonality(1) + $($potential)*,
            forces = custom(force, $($force)*),
        )]
        struct $body<F: Force<2, Form = Translation> + Clone> {
            m: f64,
            force: F,
        }
    )* };
}

bodies! {
    Falling(translation) { x[2] }
    Free(translation, position) { 0 }
    Landing(translation, position) { x[2] }
}

fn jacobian<M: Model<2>>(model: &M, point: &M::Point<f64>) -> affine_runtime::nalgebra::DMatrix<f64> {
    JacobianMatrix::of(model, 0.0, point).at(0.0, model.flatten(point))
}

/// The velocity `-tanh(t)` of a fall from rest has the derivative `1/cosh(t)^2` by its start.
#[test]
fn a_branch_is_left_on_the_way() {
    let fields = Falling { m: 1.0, force: GuardedDrag };
    let model = fields.prepare().unwrap();
    let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let start = model.at_velocity(zero, one, zero, Matrix::<2>::zeros()).unwrap();
    let by_momentum = 2.0_f64.tanh();
    let mut flow = FlowMatrix::new(&model, (0.0, &start), 1e-12);
    flow.advance_to(2.0).unwrap();
    assert!((flow.matrix()[HEIGHT] - by_momentum).abs() < 1e-10, "{}", flow.matrix()[HEIGHT]);
    let sensitivities = Sensitivities::of(&fields, &model, (0.0, &start), 2.0, 1e-12).unwrap();
    assert!((sensitivities.by_start[HEIGHT] - by_momentum).abs() < 1e-10);
    // x = -m ln(cosh(t/m))
    let by_mass = 2.0 * by_momentum - 2.0_f64.cosh().ln();
    assert!((sensitivities.by_fields_at_velocity[(HEIGHT.0, 0)] - by_mass).abs() < 1e-10);
    // Falling bodies forget their velocity, by e^(-2 t).
    let exponents = lyapunov_spectrum(&model, &start, 40.0, 1e-9).unwrap().exponents;
    assert!((exponents[exponents.len() - 1] + 2.0).abs() < 0.1, "{exponents:?}");
}

/// What was recorded at rest is no derivative of a fall, and says so.
#[test]
fn code_of_another_branch_gives_no_number() {
    let model = Falling { m: 1.0, force: GuardedDrag }.prepare().unwrap();
    let at = |v: f64| {
        let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
        model.at_velocity(zero, one, Vector::<2>::new(0.0, v), Matrix::<2>::zeros()).unwrap()
    };
    let [still, falling] = [at(0.0), at(-1.0)];
    let [at_rest, on_the_way] = [&still, &falling].map(|point| JacobianMatrix::of(&model, 0.0, point));
    let momentum = (HEIGHT.1, HEIGHT.1);
    assert_eq!(at_rest.at(0.0, model.flatten(&still))[momentum], 0.0);
    assert!(at_rest.at(0.0, model.flatten(&falling))[momentum].is_nan());
    assert_eq!(on_the_way.at(0.0, model.flatten(&falling))[momentum], -2.0);
    assert!(on_the_way.at(0.0, model.flatten(&still))[momentum].is_nan());
}

/// Beside the start of a spring that is not stretched there are those of springs that are.
#[test]
fn a_branch_at_one_place_has_no_derivative_of_its_own() {
    let model = Free { m: 1.0, force: GuardedSpring }.prepare().unwrap();
    let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let start = model.at_velocity(zero, one, zero, Matrix::<2>::zeros()).unwrap();
    let mut flow = FlowMatrix::new(&model, (0.0, &start), 1e-12);
    flow.advance_to(1.0).unwrap();
    let found = flow.matrix();
    assert!((found[HEIGHT] - 1.0_f64.sin()).abs() < 1e-10 && (found[(1, 1)] - 1.0_f64.cos()).abs() < 1e-10);
}

#[test]
fn a_branch_by_the_time_depends_on_it() {
    let model = Free { m: 1.0, force: Growing }.prepare().unwrap();
    let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let guess = model.at_velocity(zero, one, zero, Matrix::<2>::zeros()).unwrap();
    assert_eq!(equilibrium(&model, &guess).unwrap_err(), AnalysisError::DependsOnTime);
}

/// A derivative by the height, at a height and on the way from it, where the force is zero.
fn assert_contact<F: Force<2, Form = Translation> + Clone>(force: F, slope: impl Fn(f64) -> f64) {
    let fields = Landing { m: 1.0, force };
    let model = fields.prepare().unwrap();
    let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let at =
        |height| model.at_velocity(Vector::<2>::new(0.0, height), one, zero, Matrix::<2>::zeros()).unwrap();
    for height in [1.0, 0.0, -0.1_f64] {
        let found = jacobian(&model, &at(height));
        assert!(found.iter().all(|entry| entry.is_finite()), "{height}");
        let (expected, stiffness) = (slope((-height).max(0.0)), found[(HEIGHT.1, HEIGHT.0)]);
        assert!((stiffness - expected).abs() <= 1e-14 * expected.abs(), "{height}: {stiffness} {expected}");
    }
    let start = at(1.0);
    let mut flow = FlowMatrix::new(&model, (0.0, &start), 1e-12);
    flow.advance_to(0.5).unwrap();
    assert!((flow.matrix()[HEIGHT] - 0.5).abs() < 1e-12);
    let sensitivities = Sensitivities::of(&fields, &model, (0.0, &start), 0.5, 1e-12).unwrap();
    assert!((sensitivities.by_fields_at_velocity[(HEIGHT.0, 0)] - 0.125).abs() < 1e-11);
    assert!(lyapunov_spectrum(&model, &start, 1.0, 1e-8).is_ok());
}

#[test]
fn contact_has_a_slope_in_free_flight() {
    assert_contact(Hertz, |depth| -150.0 * depth.sqrt());
    assert_contact(Soft, |depth| -400.0 / 3.0 * depth.cbrt());
}

#[test]
fn drag_has_a_slope_at_rest() {
    let model = Falling { m: 1.0, force: Drag }.prepare().unwrap();
    let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let start = model.at_velocity(zero, one, zero, Matrix::<2>::zeros()).unwrap();
    assert!(jacobian(&model, &start).iter().all(|entry| entry.is_finite()));
    let mut flow = FlowMatrix::new(&model, (0.0, &start), 1e-12);
    flow.advance_to(2.0).unwrap();
    assert!((flow.matrix()[HEIGHT] - 2.0_f64.tanh()).abs() < 1e-10, "{}", flow.matrix()[HEIGHT]);
}

/// Bodies at the centre swing by `norm(x)^2` alone, to first order.
#[test]
fn whole_powers_of_the_distance_have_slopes_at_the_centre() {
    macro_rules! at_the_centre {
        ($($power:literal)*) => { $( {
            #[affine_model(
                dim = 2,
                kinetic(dalembert = 1, space_translation = 1),
                potential = orthogonality(1) + norm(x)^2 + norm(x)^$power
            )]
            struct Body;
            let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
            let start = Body.at_velocity(zero, one, zero, Matrix::<2>::zeros()).unwrap();
            let found = jacobian(&Body, &start);
            assert_eq!((found[(6, 0)], found[(7, 1)], found[(6, 1)]), (-2.0, -2.0, 0.0), "{}", $power);
            let mut flow = FlowMatrix::new(&Body, (0.0, &start), 1e-12);
            flow.advance_to(1.0).unwrap();
            assert!((flow.matrix()[(0, 0)] - 2.0_f64.sqrt().cos()).abs() < 1e-10, "{}", $power);
        } )* };
    }
    at_the_centre!(3 5 7);
}

/// The distance from the undeformed body, to the third power.
#[test]
fn whole_powers_of_a_strain_have_slopes_without_any() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = sqrt(tr((G - 1)^2))^3)]
    struct Body;
    let start = Body.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let found = jacobian(&Body, &start);
    // phi' = Pi, and no force.
    assert_eq!((found[(0, 4)], found.norm()), (1.0, 2.0));
}

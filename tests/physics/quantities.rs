//! The configuration metric and the acceleration of the centre of mass, emitted on demand, against the oracle and the
//! formula of section 4.

use affine_oracle::{Kinetic, Random, Term, rational};
use affine_runtime::prelude::*;

use crate::families::{matrix, vector};
use affine_tests::reference::{assert_close, entries, norm};
use affine_tests::tolerances::MIXED;

/// The metric, its inverse and the acceleration of one model at random states.
macro_rules! quantities {
    ($($name:ident: $n:literal $size:literal [$($term:expr),*] ($($kinetic:tt)*);)*) => { $(
        #[test]
        fn $name() {
            #[affine_model(dim = $n, kinetic($($kinetic)*), emit(metric, acceleration))]
            struct Body;
            let kinetic = Kinetic::new($n, vec![$($term),*]).unwrap();
            for seed in 0..4 {
                let state = Random::new(71 + seed).state($n);
                let (x, p) = (vector(&state.x.to_f64()), vector(&state.p.to_f64()));
                let (phi, pi) = (matrix(&state.phi.to_f64()), matrix(&state.pi.to_f64()));
                let point = Body.at_momentum(x, phi, p, TwoPoint(pi)).unwrap();
                let tolerance = MIXED * kinetic.condition(&state.phi).unwrap();

                let metric: Matrix<$size> = Body.metric(&phi);
                let expected = kinetic.mass_matrix(&state.phi).unwrap().to_f64();
                assert_close("Gamma", &entries(&metric), &expected, norm(&expected), tolerance);
                let unit = Matrix::<$size>::identity();
                let product = metric * Body.inverse_metric(&phi);
                assert_close("Gamma Gamma^-1", &entries(&product), &entries(&unit), 1.0, tolerance);

                let motion = kinetic.motion(&state).unwrap();
                let (x_dot, phi_dot) = kinetic.velocity(&state.along(motion.rate())).unwrap();
                let expected = x_dot.slope().to_f64();
                let inverse = norm(&state.phi.inverse().unwrap().to_f64());
                let size = inverse * norm(&phi_dot.value().to_f64()) * norm(&x_dot.value().to_f64());
                let found = Body.acceleration(&point);
                assert_close("acceleration", found.as_slice(), &expected, size, tolerance);
            }
        }
    )* };
}

quantities! {
    missile: 3 12 [Term::body_inertia(3, rational(1, 1)), Term::Casimir2(rational(1, 5)), Term::BodyTranslation(rational(17, 10))]
        (body_inertia = 1, casimir2 = 0.2, body_translation = 1.7);
    metrical_in_space: 2 6 [Term::space_inertia(2, rational(1, 1)), Term::Casimir2(rational(1, 5)), Term::BodyTranslation(rational(2, 1))]
        (space_inertia = 1, casimir2 = 0.2, body_translation = 2);
    flat: 3 12 [Term::dalembert(3, rational(2, 1)), Term::BodyTranslation(rational(1, 2))]
        (dalembert = 2, body_translation = 0.5);
    free: 2 6 [Term::Casimir2(rational(1, 1)), Term::Casimir1Squared(rational(1, 4)), Term::SpaceTranslation(rational(3, 1))]
        (casimir2 = 1, casimir1_squared = 0.25, space_translation = 3);
    mixed_masses: 3 12 [Term::body_inertia(3, rational(1, 1)), Term::BodyTranslation(rational(1, 1)), Term::SpaceTranslation(rational(1, 2))]
        (body_inertia = 1, body_translation = 1, space_translation = 0.5);
    mixed: 2 6 [Term::dalembert(2, rational(1, 1)), Term::space_inertia(2, rational(1, 2)), Term::BodyTranslation(rational(1, 1)),
         Term::SpaceTranslation(rational(1, 2))]
        (dalembert = 1, space_inertia = 0.5, body_translation = 1, space_translation = 0.5);
}

/// `m dv/dt = (Om Ct + Ct Om^T) p + Ct Q_tr` (section 4), with `Ct = phi phi^T` and a force on the centre.
#[test]
fn drunk_missile() {
    #[affine_model(
        dim = 3,
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = m),
        potential = x[1]*x[2] + norm(x)^2/2 + tr(G),
        emit(acceleration)
    )]
    struct Missile {
        m: f64,
    }
    let m = 1.7;
    let model = Missile { m }.prepare().unwrap();
    for seed in 0..4 {
        let state = Random::new(91 + seed).state(3);
        let (x, p) = (vector(&state.x.to_f64()), vector(&state.p.to_f64()));
        let (phi, pi): (Matrix<3>, Matrix<3>) = (matrix(&state.phi.to_f64()), matrix(&state.pi.to_f64()));
        let point = model.at_momentum(x, phi, p, TwoPoint(pi)).unwrap();
        let om = model.velocity(&point).phi_dot * phi.try_inverse().unwrap();
        let ct = phi * phi.transpose();
        let pull = -Vector::<3>::new(x[1], x[0], 0.0) - x;
        let expected = ((om * ct + ct * om.transpose()) * p + ct * pull) / m;
        let found = model.acceleration(&point);
        let size = (om.norm() * ct.norm() * p.norm() + ct.norm() * pull.norm()) / m;
        assert_close("acceleration", found.as_slice(), expected.as_slice(), size, 100.0 * MIXED);
    }
}

//! The balance laws of d'Alembert models that `emit(balance)` computes (section 3): against the laws as printed, and
//! against the power series of the motion. The balance of power of every kind of model.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod acceleration;
mod at_points;
mod power;

use affine_oracle::{Differential, Place, Random, Slopes};
use affine_runtime::balance::{Balance, CentreBalance};
use affine_runtime::force::{Force, Motion};
use affine_runtime::model::{StateVector, Velocity};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

use affine_tests::jet::{Jet, LENGTH};

/// Sums of some ten products, in units of the largest of them; the largest error seen is below 3e-16.
const ALGEBRA: f64 = 1e-14;

/// Derivatives of series of nine terms at `t = 2^-10`, in motions with rates up to 50: the first term left out is
/// `9 * 50 * (50/1024)^8`.
const SERIES: f64 = 1e-11;
const STEP: f64 = 1.0 / 1024.0;

/// The time at which forces are asked.
const T0: f64 = 0.25;

/// `U = (x_1 x_2 + tr G^2/4) (2 + cos t) + sinh(q)^2`.
fn potential(place: &Place) -> Differential {
    let elastic = place.x(1) * place.x(2) + Differential::constant(0.25) * place.trace_green_squared();
    elastic * (Differential::constant(2.0) + place.t().cos()) + place.q().sinh() * place.q().sinh()
}

/// `Q_ij = x_dot_i x_j t - phi_dot_i1 phi_j1`.
#[derive(Clone)]
struct Stirring;

impl<const N: usize> Force<N> for Stirring {
    type Form = affine_runtime::frames::Space;
    fn force<T: Scalar>(&self, m: &Motion<N, T>) -> Matrix<N, T> {
        Matrix::<N, T>::from_fn(|i, j| m.x_dot[i] * m.x[j] * m.t - m.phi_dot[(i, 0)] * m.phi[(j, 0)])
    }
}

/// What is known of a motion on the velocity side.
struct Scene<const N: usize> {
    j: Matrix<N>,
    mass: f64,
    x: Vector<N>,
    phi: Matrix<N>,
    velocity: Velocity<N>,
}

impl<const N: usize> Scene<N> {
    /// A random one: `J = 1 + A A^T` with `A` of order 1.
    fn random(seed: u64) -> Self {
        let state = Random::new(seed).state(N);
        let other = Random::new(seed + 7000).state(N);
        let square = |m: &affine_oracle::Matrix| Matrix::<N>::from_row_slice(&m.to_f64());
        let vector = |m: &affine_oracle::Matrix| Vector::<N>::from_column_slice(&m.to_f64());
        let root = square(&other.phi);
        let velocity = Velocity { x_dot: vector(&state.p), phi_dot: square(&state.pi) };
        let j = Matrix::<N>::identity() + root * root.transpose();
        Scene { j, mass: 1.75, x: vector(&state.x), phi: square(&state.phi), velocity }
    }

    fn omega_hat(&self) -> Matrix<N> {
        self.phi.try_inverse().unwrap() * self.velocity.phi_dot
    }

    fn omega(&self) -> Matrix<N> {
        self.velocity.phi_dot * self.phi.try_inverse().unwrap()
    }

    /// `N = -phi (dU/dphi)^T` and `F = -dU/dx`, by forward differentiation of the plain definition.
    fn forces(&self) -> (Matrix<N>, Vector<N>) {
        let phi = self.phi.transpose();
        let slopes = Slopes::of(&potential, T0, self.x.as_slice(), phi.as_slice());
        let along_phi = Matrix::<N>::from_row_slice(&slopes.phi);
        (-self.phi * along_phi.transpose(), -Vector::<N>::from_column_slice(&slopes.x))
    }

    /// (3.6), (3.8), (3.9) as printed, under the moment `N`.
    fn assert_internal(&self, found: &Balance<N>, moment: Matrix<N>) {
        let (j, phi_dot) = (self.j, self.velocity.phi_dot);
        let inverse = self.phi.try_inverse().unwrap();
        let inertia = phi_dot * j * phi_dot.transpose();
        let size = j.norm() * (1.0 + self.velocity.phi_dot.norm_squared()) + moment.norm();
        let spin = self.phi * j * phi_dot.transpose();
        let spin_hat = j * self.omega_hat().transpose();
        let pull = |m: Matrix<N>| inverse * m * inverse.transpose();
        let scale = size * (1.0 + inverse.norm_squared());
        for (what, found, expected) in [
            ("K", found.spin.0, spin),
            ("phi_dot J phi_dot^T", found.inertia.0, inertia),
            ("Omega K", found.inertia.0, self.omega() * spin),
            ("N", found.moment.0, moment),
            ("K_hat", found.spin_hat.0, spin_hat),
            ("phi^-1 K phi^-T", found.spin_hat.0, pull(spin)),
            ("-K_hat J^-1 K_hat", found.inertia_hat.0, -spin_hat * j.try_inverse().unwrap() * spin_hat),
            ("N_hat", found.moment_hat.0, pull(moment)),
            ("dK/dt", found.rate().0, inertia + moment),
        ] {
            let error = (found - expected).norm();
            assert!(error <= ALGEBRA * scale * inverse.norm(), "{what}: {error:e} of {scale:e}");
        }
    }

    fn assert_centre(&self, found: &CentreBalance<N>, force: Vector<N>) {
        let inverse = self.phi.try_inverse().unwrap();
        let momentum = self.velocity.x_dot * self.mass;
        let momentum_hat = inverse * momentum;
        let spin_hat = self.j * self.omega_hat().transpose();
        let transport = -spin_hat.transpose() * self.j.try_inverse().unwrap() * momentum_hat;
        let scale = (1.0 + self.velocity.phi_dot.norm()) * momentum.norm() + force.norm();
        for (what, found, expected) in [
            ("k", found.momentum.0, momentum),
            ("F", found.force.0, force),
            ("k_hat", found.momentum_hat.0, momentum_hat),
            ("-K_hat^T J^-1 k_hat", found.inertia_hat.0, transport),
            ("F_hat", found.force_hat.0, inverse * force),
        ] {
            let error = (found - expected).norm();
            let scale = scale * (1.0 + inverse.norm_squared()) * self.j.norm();
            assert!(error <= ALGEBRA * scale, "{what}: {error:e} of {scale:e}");
        }
    }
}

/// Hamilton's equations solved by power series around the start: each pass makes one more coefficient right.
fn series<const N: usize, M: Model<N>>(model: &M, start: &M::Point<f64>) -> M::Full<Jet> {
    let from = model.flatten(start);
    let mut motion = M::Full::<Jet>::zeros();
    for (jet, value) in motion.as_mut().iter_mut().zip(from.as_ref()) {
        *jet = Jet::fixed(*value);
    }
    let mut now = Jet::fixed(T0);
    now.0[1] = 1.0;
    for _ in 1..LENGTH {
        let rates = model.hamilton_equations(now, &motion);
        for ((jet, rate), value) in motion.as_mut().iter_mut().zip(rates.as_ref()).zip(from.as_ref()) {
            let order = |k: usize| if k == 0 { *value } else { rate.0[k - 1] / k as f64 };
            *jet = Jet(core::array::from_fn(order));
        }
    }
    motion
}

/// A series and its derivative at [`STEP`].
fn at(jet: Jet) -> [f64; 2] {
    jet.0.iter().rev().fold([0.0, 0.0], |[value, slope], c| [value * STEP + c, slope * STEP + value])
}

/// `K = phi Pi` and `K_hat = Pi phi^-T` of the series, and of the centre `k = p`, `k_hat = phi^-1 p`, differentiated, are
/// the rates that the laws give at the point the series has led to.
fn assert_follows<const N: usize, M: Model<N>>(
    model: &M,
    start: &M::Point<f64>,
    rates: impl Fn(f64, &M::Point<f64>) -> ([Matrix<N>; 2], Option<[Vector<N>; 2]>),
) {
    let motion = series(model, start);
    let mut full = M::Full::<f64>::zeros();
    for (value, jet) in full.as_mut().iter_mut().zip(motion.as_ref()) {
        *value = at(*jet)[0];
    }
    let moving = model.unflatten(&motion);
    let (phi, pi, p) = (*moving.phi(), moving.pi().0.0, moving.p());
    let inverse = phi.inverse();
    let slope = |m: Matrix<N, Jet>| m.map(|jet| at(jet)[1]);
    let (found, centre) = rates(T0 + STEP, &model.unflatten(&full));
    for (what, found, expected) in
        [("dK/dt", found[0], slope(phi * pi)), ("dK_hat/dt", found[1], slope(pi * inverse.transpose()))]
    {
        let error = (found - expected).norm();
        assert!(error <= SERIES * expected.norm(), "{what}: {error:e} of {:e}", expected.norm());
    }
    let Some(centre) = centre else { return };
    for (what, found, expected) in [("dk/dt", centre[0], p), ("dk_hat/dt", centre[1], inverse * p)] {
        let expected = expected.map(|jet| at(jet)[1]);
        let error = (found - expected).norm();
        assert!(error <= SERIES * (1.0 + expected.norm()), "{what}: {error:e} of {:e}", expected.norm());
    }
}

macro_rules! balances {
    ($($name:ident $n:literal [$($j:tt)*] ($($entry:ident $row:literal $column:literal),*);)*) => { $(
        mod $name {
            use super::*;

            #[affine_model(
                dim = $n,
                kinetic(dalembert = [$($j)*], space_translation = m),
                potential = (x[1]*x[2] + tr(G*G)/4)*(2 + cos(t)) + sinh(q)^2,
                emit(balance)
            )]
            struct Elastic {
                $($entry: f64,)*
                m: f64,
            }

            #[affine_model(
                dim = $n,
                kinetic(dalembert = [$($j)*], space_translation = m),
                dissipation(body_inertia = r),
                forces = custom(stirring, spatial),
                emit(balance)
            )]
            struct Damped {
                $($entry: f64,)*
                m: f64,
                r: f64,
                stirring: Stirring,
            }

            #[affine_model(dim = $n, kinetic(dalembert = [$($j)*]), emit(balance))]
            struct Free {
                $($entry: f64,)*
            }

            #[test]
            fn under_a_potential() {
                for seed in 0..6 {
                    let scene = Scene::<$n>::random(310 + seed);
                    let model = Elastic { $($entry: scene.j[($row, $column)],)* m: scene.mass }.prepare().unwrap();
                    let Velocity { x_dot, phi_dot } = scene.velocity;
                    let point = model.at_velocity(scene.x, scene.phi, x_dot, phi_dot).unwrap();
                    let (moment, force) = scene.forces();
                    scene.assert_internal(&model.balance(T0, &point), moment);
                    scene.assert_centre(&model.centre_balance(T0, &point), force);
                    assert_follows(&model, &point, |t, point| {
                        let (internal, centre) = (model.balance(t, point), model.centre_balance(t, point));
                        let centre = [centre.force.0, centre.rate_hat().0];
                        ([internal.rate().0, internal.rate_hat().0], Some(centre))
                    });
                }
            }

            #[test]
            fn with_friction_and_a_force() {
                for seed in 0..6 {
                    let scene = Scene::<$n>::random(330 + seed);
                    let r = 0.375;
                    let model = Damped { $($entry: scene.j[($row, $column)],)* m: scene.mass, r, stirring: Stirring }.prepare().unwrap();
                    let Velocity { x_dot, phi_dot } = scene.velocity;
                    let point = model.at_velocity(scene.x, scene.phi, x_dot, phi_dot).unwrap();
                    // R = r/2 tr(Oh Oh^T): Q_hat = -r Oh^T, Q = phi Q_hat phi^-1.
                    let friction = -scene.phi * scene.omega_hat().transpose() * scene.phi.try_inverse().unwrap() * r;
                    let stirred = x_dot * scene.x.transpose() * T0
                        - phi_dot.column(0) * scene.phi.column(0).transpose();
                    scene.assert_internal(&model.balance(T0, &point), friction + stirred);
                    scene.assert_centre(&model.centre_balance(T0, &point), Vector::<$n>::zeros());
                    assert_follows(&model, &point, |t, point| {
                        let internal = model.balance(t, point);
                        ([internal.rate().0, internal.rate_hat().0], None)
                    });
                }
            }

            #[test]
            fn without_forces() {
                for seed in 0..6 {
                    let scene = Scene::<$n>::random(350 + seed);
                    let model = Free { $($entry: scene.j[($row, $column)]),* }.prepare().unwrap();
                    let point = model.at_velocity(scene.phi, scene.velocity.phi_dot).unwrap();
                    let found = model.balance(T0, &point);
                    scene.assert_internal(&found, Matrix::<$n>::zeros());
                    assert_eq!(found.moment.0, Matrix::<$n>::zeros());
                    // K_hat is not Sigma_hat = K_hat G (3.10).
                    let green = scene.phi.transpose() * scene.phi;
                    let sigma_hat = point.sigma_hat().0.0;
                    let size = found.spin_hat.0.norm() * green.norm();
                    assert!((found.spin_hat.0 * green - sigma_hat).norm() <= ALGEBRA * size);
                    assert!((found.spin_hat.0 - sigma_hat).norm() > 1e-3 * size);
                    assert_follows(&model, &point, |t, point| {
                        let internal = model.balance(t, point);
                        ([internal.rate().0, internal.rate_hat().0], None)
                    });
                }
            }
        }
    )* };
}

balances! {
    planar 2 [[a, k], [k, b]] (a 0 0, b 1 1, k 0 1);
    spatial 3 [[a, k, e], [k, b, f], [e, f, c]] (a 0 0, b 1 1, c 2 2, k 0 1, e 0 2, f 1 2);
}

/// Of a sum the kinetic energy depends on `phi`. A term of the body adds nothing to `dSigma/dt`, one of space `[Om, Sigma]`: of
/// `1/2 tr(phi_dot J phi_dot^T) + I/2 tr(Om Om^T)` and terms of the body `dK/dt = phi_dot J phi_dot^T + I [Om, Om^T] + N`.
macro_rules! sums {
    ($($name:ident $n:literal;)*) => { $(
        #[test]
        fn $name() {
            #[affine_model(
                dim = $n,
                kinetic(dalembert = 1.5, body_inertia = 0.7, casimir2 = 0.2, space_inertia = i, space_translation = 1.75),
                potential = (x[1]*x[2] + tr(G*G)/4)*(2 + cos(t)) + sinh(q)^2,
                emit(balance)
            )]
            struct Elastic {
                i: f64,
            }
            #[affine_model(
                dim = $n,
                kinetic(dalembert = 1.5, body_inertia = 0.7, space_translation = 1, body_translation = 0.75),
                dissipation(body_inertia = 0.375),
                forces = custom(stirring, spatial),
                emit(balance)
            )]
            struct Damped {
                stirring: Stirring,
            }
            for seed in 0..4 {
                let scene = Scene::<$n>::random(410 + seed);
                let Velocity { x_dot, phi_dot } = scene.velocity;
                let (omega, inverse) = (scene.omega(), scene.phi.try_inverse().unwrap());
                let (moment, force) = scene.forces();
                let close = |what: &str, found: Matrix<$n>, expected: Matrix<$n>| {
                    let size = (1.0 + phi_dot.norm_squared() + moment.norm()) * (1.0 + inverse.norm().powi(4));
                    let error = (found - expected).norm();
                    assert!(error <= 10.0 * ALGEBRA * size, "{what}: {error:e} of {size:e}");
                };
                let model = Elastic { i: 0.6 }.prepare().unwrap();
                let point = model.at_velocity(scene.x, scene.phi, x_dot, phi_dot).unwrap();
                let found = model.balance(T0, &point);
                let flat = phi_dot * phi_dot.transpose() * 1.5;
                let inertia = flat + (omega * omega.transpose() - omega.transpose() * omega) * 0.6;
                close("K", found.spin.0, scene.phi * point.pi().0.0);
                close("dK/dt without forces", found.inertia.0, inertia);
                close("N", found.moment.0, moment);
                close("K_hat", found.spin_hat.0, point.pi().0.0 * inverse.transpose());
                close("N_hat", found.moment_hat.0, inverse * moment * inverse.transpose());
                let centre = model.centre_balance(T0, &point);
                assert!((centre.momentum.0 - x_dot * 1.75).norm() <= 1e-13 * x_dot.norm());
                assert!((centre.force.0 - force).norm() <= 1e-13 * (1.0 + force.norm()));
                assert_follows(&model, &point, |t, point| {
                    let (internal, centre) = (model.balance(t, point), model.centre_balance(t, point));
                    ([internal.rate().0, internal.rate_hat().0], Some([centre.force.0, centre.rate_hat().0]))
                });
                // The weight of the centre in the body pulls at phi: phi T_Pi = -m x_dot (phi^-T v_hat)^T.
                let model = Damped { stirring: Stirring }.prepare().unwrap();
                let point = model.at_velocity(scene.x, scene.phi, x_dot, phi_dot).unwrap();
                let found = model.balance(T0, &point);
                let v_hat = inverse * x_dot;
                let inertia = flat - x_dot * (inverse.transpose() * v_hat).transpose() * 0.75;
                close("dK/dt beside a centre", found.inertia.0, inertia);
                let friction = -scene.phi * scene.omega_hat().transpose() * inverse * 0.375;
                let stirred = x_dot * scene.x.transpose() * T0
                    - phi_dot.column(0) * scene.phi.column(0).transpose();
                close("N of friction and a force", found.moment.0, friction + stirred);
                assert_follows(&model, &point, |t, point| {
                    let internal = model.balance(t, point);
                    ([internal.rate().0, internal.rate_hat().0], None)
                });
            }
        }
    )* };
}

sums! {
    sums_in_the_plane 2;
    sums_in_space 3;
}

/// Single stretches are found by an iteration: as the potential `Q_1^4 + Q_2^4 + Q_3^4 = tr G^2` they have the same moment.
#[test]
fn of_single_stretches() {
    #[affine_model(
        dim = 3,
        kinetic(dalembert = diag(1, 1.5, 2)),
        potential = exp(4*q1) + exp(4*q2) + exp(4*q3) + sqrt(1 + q1^2) + sqrt(1 + q2^2) + sqrt(1 + q3^2),
        emit(balance)
    )]
    struct Stretched;
    #[affine_model(
        dim = 3,
        kinetic(dalembert = diag(1, 1.5, 2)),
        potential = sqrt(1 + q1^2) + sqrt(1 + q2^2) + sqrt(1 + q3^2),
        emit(balance)
    )]
    struct Stretches;
    for seed in 0..4 {
        let scene = Scene::<3>::random(370 + seed);
        let start = Stretched.at_velocity(scene.phi, scene.velocity.phi_dot).unwrap();
        let other = Stretches.at_velocity(scene.phi, scene.velocity.phi_dot).unwrap();
        let found = Stretched.balance(T0, &start).moment.0 - Stretches.balance(T0, &other).moment.0;
        let ct = scene.phi * scene.phi.transpose();
        let expected = -4.0 * ct * ct;
        assert!((found - expected).norm() <= 1e-12 * expected.norm(), "{found} {expected}");
    }
}

/// A potential in `D`, whose inverse is a root of `det phi`: `N = -2 c D^-2 (phi phi^T - tr(G)/n 1)`.
#[test]
fn of_an_isochoric_potential() {
    #[affine_model(dim = 3, kinetic(dalembert = 1.5), potential = neo_hookean(0.5), emit(balance))]
    struct Elastic;
    for seed in 0..4 {
        let scene = Scene::<3>::random(390 + seed);
        let point = Elastic.at_velocity(scene.phi, scene.velocity.phi_dot).unwrap();
        let ct = scene.phi * scene.phi.transpose();
        let deviator = ct - Matrix::<3>::identity() * (ct.trace() / 3.0);
        let expected = -deviator / scene.phi.determinant().cbrt().powi(2);
        let found = Elastic.balance(T0, &point).moment.0;
        assert!((found - expected).norm() <= 1e-13 * expected.norm(), "{found} {expected}");
    }
}

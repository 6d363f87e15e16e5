//! How methods of models by themselves are asked, with plain arrays.

use affine_runtime::frames::{Matrix, Vector};

/// `N x N`, from entries row by row.
pub(crate) fn matrix<const N: usize>(entries: &[f64]) -> Matrix<N> {
    Matrix::from_row_slice(entries)
}

/// A vector.
pub(crate) fn vector<const N: usize>(entries: &[f64]) -> Vector<N> {
    Vector::from_column_slice(entries)
}

macro_rules! legendre {
    ($n:literal $centre:ident $model:ident) => {
        |[x, phi, x_dot, phi_dot]| {
            let (x, phi) = (vector::<$n>(x), matrix::<$n>(phi));
            let velocity = affine_runtime::model::Velocity { x_dot: vector(x_dot), phi_dot: matrix::<$n>(phi_dot) };
            let point = legendre!(@ $centre $model x phi velocity).unwrap();
            let energy = $model.kinetic_energy(&phi, &velocity);
            (point.p().as_slice().to_vec(), entries(&point.pi().0.0), energy)
        }
    };
    (@ held $model:ident $x:ident $phi:ident $velocity:ident) => {{
        let _ = $x;
        $model.at_velocity($phi, $velocity.phi_dot)
    }};
    (@ free $model:ident $x:ident $phi:ident $velocity:ident) => {
        $model.at_velocity($x, $phi, $velocity.x_dot, $velocity.phi_dot)
    };
}

macro_rules! metric {
    ($n:literal $model:ident) => {
        |phi| {
            let phi = matrix::<$n>(phi);
            [entries(&$model.metric(&phi)), entries(&$model.inverse_metric(&phi))]
        }
    };
}

macro_rules! acceleration {
    ($n:literal $model:ident) => {
        |_t, full| {
            let point = $model.unflatten(&crate::body::filled(full));
            [$model.acceleration(&point).as_slice().to_vec()]
        }
    };
}

macro_rules! balance {
    ($n:literal $model:ident) => {
        |t, full| {
            let found = $model.balance(t, &$model.unflatten(&crate::body::filled(full)));
            let (spin, inertia, moment) = (found.spin.0, found.inertia.0, found.moment.0);
            let (spin_hat, inertia_hat, moment_hat) =
                (found.spin_hat.0, found.inertia_hat.0, found.moment_hat.0);
            [spin, inertia, moment, spin_hat, inertia_hat, moment_hat].map(|m| entries::<$n, f64>(&m))
        }
    };
}

macro_rules! centre_balance {
    ($n:literal $model:ident) => {
        |t, full| {
            let found = $model.centre_balance(t, &$model.unflatten(&crate::body::filled(full)));
            let in_space = [found.momentum.0, found.force.0];
            let in_body = [found.momentum_hat.0, found.inertia_hat.0, found.force_hat.0];
            let [k, force] = in_space.map(|v| v.as_slice().to_vec());
            let [k_hat, inertia_hat, force_hat] = in_body.map(|v| v.as_slice().to_vec());
            [k, force, k_hat, inertia_hat, force_hat]
        }
    };
}

pub(crate) use {acceleration, balance, centre_balance, legendre, metric};

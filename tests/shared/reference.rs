//! The exact motion through a phase point, rounded, and comparisons with it.

use affine_oracle::{Constraint, Differential, Expected, Kinetic, Matrix as Exact, Place, Slopes, State};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Real;

/// Exact derivatives at a point, with the sizes that rounding errors of each are measured by.
pub struct Reference {
    /// The derivatives.
    pub expected: Expected,
    /// Condition of the mass matrix.
    pub condition: f64,
    state: State,
    /// What forces add to the sizes; all zero without.
    potential: Slopes,
}

impl Reference {
    /// Of a kinetic energy without forces.
    pub fn new(kinetic: &Kinetic, state: &State) -> Self {
        Self::of(kinetic.expected(state).unwrap(), kinetic.condition(&state.phi).unwrap(), state)
    }

    /// Exact derivatives from elsewhere, with the factor by which rounding errors of the velocity are amplified.
    pub fn of(expected: Expected, condition: f64, state: &State) -> Self {
        let potential = Slopes { value: 0.0, t: 0.0, x: Vec::new(), phi: Vec::new() };
        Reference { expected, condition, state: state.clone(), potential }
    }

    /// The motion under a potential.
    pub fn under(
        kinetic: &Kinetic,
        state: &State,
        t: f64,
        potential: &dyn Fn(&Place) -> Differential,
    ) -> Self {
        let slopes = Slopes::of(potential, t, &state.x.to_f64(), &state.phi.to_f64());
        Reference {
            expected: kinetic.motion(state).unwrap().under(t, potential).unwrap().expected().unwrap(),
            potential: slopes,
            ..Reference::new(kinetic, state)
        }
    }

    /// The motion under a constraint and a potential.
    pub fn confined(
        kinetic: &Kinetic,
        constraint: Constraint,
        state: &State,
        t: f64,
        potential: &dyn Fn(&Place) -> Differential,
    ) -> Self {
        let motion = kinetic.constrained_motion(constraint, state, t, potential).unwrap();
        Reference {
            expected: motion.expected().unwrap(),
            condition: kinetic.constrained_condition(constraint, &state.phi).unwrap(),
            state: state.clone(),
            potential: Slopes::of(potential, t, &state.x.to_f64(), &state.phi.to_f64()),
        }
    }

    /// The motion with a dissipation function, stated as a kinetic energy is.
    pub fn damped(kinetic: &Kinetic, state: &State, dissipation: &Kinetic) -> Self {
        let free = kinetic.motion(state).unwrap();
        let motion = free.clone().damped(dissipation).unwrap();
        let push = |before: &Exact, after: &Exact| (after - before).to_f64();
        let x = push(&free.rate().p, &motion.rate().p);
        let phi = push(&free.rate().pi, &motion.rate().pi);
        Reference {
            expected: motion.expected().unwrap(),
            potential: Slopes { value: 0.0, t: 0.0, x, phi },
            ..Reference::new(kinetic, state)
        }
    }

    /// The motion with forces on `p` and, row-major, on `Pi`.
    pub fn pushed(kinetic: &Kinetic, state: &State, on_p: &[f64], on_pi: &[f64]) -> Self {
        let motion = kinetic.motion(state).unwrap().pushed(on_p, on_pi).unwrap();
        Reference {
            expected: motion.expected().unwrap(),
            potential: Slopes { value: 0.0, t: 0.0, x: on_p.to_vec(), phi: on_pi.to_vec() },
            ..Reference::new(kinetic, state)
        }
    }

    /// The summands' size of `H`.
    pub fn energy_size(&self) -> f64 {
        let (p, pi) = (norm(&self.state.p.to_f64()), norm(&self.state.pi.to_f64()));
        p * norm(&self.expected.x_dot) + pi * norm(&self.expected.phi_dot) + self.potential.value.abs()
    }

    /// The exact derivative of a quantity named as in the layouts, and the size of its summands. Those of the
    /// momenta are products with `|Omega| <= |phi_dot| |phi^-1|` and the fluxes `p x_dot^T`.
    pub fn rate(&self, name: &str) -> (&[f64], f64) {
        let State { phi, p, pi, .. } = &self.state;
        let size = |matrix: &Exact| norm(&matrix.to_f64());
        let expected = &self.expected;
        let inverse = size(&phi.inverse().unwrap());
        let (x_dot, phi_dot) = (norm(&expected.x_dot), norm(&expected.phi_dot));
        let omega = phi_dot * inverse;
        let p_hat = size(&(&phi.transpose() * p));
        let (pull, force) = (norm(&self.potential.x), norm(&self.potential.phi));
        match name {
            "x" => (&expected.x_dot, x_dot),
            "phi" => (&expected.phi_dot, phi_dot),
            "p" => (&expected.p_dot, pull),
            "p_hat" => (&expected.p_hat_dot, omega * p_hat + size(phi) * pull),
            "Sigma" => (&expected.sigma_dot, omega * size(&(phi * pi)) + x_dot * size(p) + size(phi) * force),
            "Sigma_hat" => (
                &expected.sigma_hat_dot,
                omega * size(&(pi * phi)) + inverse * x_dot * p_hat + size(phi) * force,
            ),
            "Pi" => (&expected.pi_dot, omega * size(pi) + inverse * x_dot * size(p) + force),
            other => panic!("no quantity {other}"),
        }
    }

    /// Holds the derivative of the named quantity against the exact one.
    pub fn assert_rate(&self, name: &str, found: &[f64], tolerance: f64) {
        let (expected, size) = self.rate(name);
        assert_close(name, found, expected, size, tolerance * self.condition);
    }
}

/// The point as exact rationals, its own affine spin (named as in the layout) taken at its word.
pub fn exact_state<const N: usize>(spin: &str, point: &impl Phase<N>) -> State {
    let (x, p) = (column(&point.x()), column(&point.p()));
    let phi = square(point.phi());
    match spin {
        "Sigma" => State::with_affine_spin(x, phi, p, &square(&point.sigma().0.0)),
        "Sigma_hat" => State::with_comoving_affine_spin(x, phi, p, &square(&point.sigma_hat().0.0)),
        _ => State::new(x, phi, p, square(&point.pi().0.0)),
    }
    .unwrap()
}

fn square<const N: usize>(matrix: &Matrix<N>) -> Exact {
    Exact::from_f64("matrix", N, N, &entries(matrix)).unwrap()
}

fn column<const N: usize>(vector: &Vector<N>) -> Exact {
    Exact::from_f64("vector", N, 1, vector.as_slice()).unwrap()
}

/// `|found - expected| <= tolerance size`.
pub fn assert_close(what: &str, found: &[f64], expected: &[f64], size: f64, tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{what}: components");
    let difference: Vec<f64> = found.iter().zip(expected).map(|(f, e)| f - e).collect();
    let error = norm(&difference);
    // Written so that NaN fails.
    assert!(
        error <= tolerance * size,
        "{what}: error {error:e} of {size:e}, tolerance {tolerance:e}\n{found:?}\n{expected:?}"
    );
}

/// Frobenius norm.
pub fn norm(entries: &[f64]) -> f64 {
    entries.iter().fold(0.0, |length, entry| f64::hypot(length, *entry))
}

/// Row-major entries.
pub fn entries<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> Vec<T> {
    matrix.transpose().as_slice().to_vec()
}

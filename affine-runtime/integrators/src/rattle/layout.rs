//! Where placement and momenta are in the state, and the matrix of `T'`.

use core::ops::Range;

use crate::Failure;
use crate::finite::is_finite;
use affine_core::__private::numerics::norm;
use affine_core::frames::Matrix;
use affine_core::model::{Group, Quantity, StateVector};

/// Momenta of a body in space with its centre of mass.
const MOST: usize = 12;
/// Velocities that the matrix of `T'` gives may differ from those of the equations by some roundings.
const ROUNDING: f64 = 1e-12;

/// Components of a canonical state.
#[derive(Clone, Debug)]
pub(super) struct Layout<const N: usize> {
    phi: Range<usize>,
    pi: Range<usize>,
    /// Components that are momenta.
    momenta: [usize; MOST],
    /// Components that are positions.
    positions: [usize; MOST],
    count: usize,
    /// The component that is the work.
    work: Option<usize>,
    /// `dT'_i/dPi_k`, positions by momenta.
    inverse_mass: [[f64; MOST]; MOST],
}

impl<const N: usize> Layout<N> {
    /// The layout of `groups`, with the masses that the equations `f` have at `(t, y)`.
    pub(super) fn of<S: StateVector<f64>>(
        groups: &[Group],
        f: &dyn Fn(f64, &S) -> S,
        (t, y): (f64, &S),
    ) -> Result<Self, Failure> {
        let mut layout = Self::named(groups).ok_or(Failure::NotSeparable)?;
        let mut rest = *y;
        for k in &layout.momenta[..layout.count] {
            rest.as_mut()[*k] = 0.0;
        }
        for k in 0..layout.count {
            let mut unit = rest;
            unit.as_mut()[layout.momenta[k]] = 1.0;
            let rates = f(t, &unit);
            if !is_finite(&rates) {
                return Err(Failure::NotFinite);
            }
            for i in 0..layout.count {
                layout.inverse_mass[i][k] = rates.as_ref()[layout.positions[i]];
            }
        }
        if layout.is_separable(f, (t, y)) { Ok(layout) } else { Err(Failure::NotSeparable) }
    }

    /// Evaluations of the equations that making the layout took.
    pub(super) fn evaluations(&self) -> u64 {
        self.count as u64 + 1
    }

    fn named(groups: &[Group]) -> Option<Self> {
        let mut layout = Self {
            phi: 0..0,
            pi: 0..0,
            momenta: [0; MOST],
            positions: [0; MOST],
            count: 0,
            work: None,
            inverse_mass: [[0.0; MOST]; MOST],
        };
        let (mut start, mut momenta, mut positions) = (0, 0, 0);
        for group in groups {
            let range = start..start + group.len;
            start = range.end;
            let (list, count) = match group.quantity {
                Quantity::Work => {
                    layout.work = Some(range.start);
                    continue;
                }
                Quantity::Position | Quantity::Placement => (&mut layout.positions, &mut positions),
                Quantity::LinearMomentum | Quantity::CanonicalMomentum => (&mut layout.momenta, &mut momenta),
                _ => return None,
            };
            for k in range.clone() {
                *list.get_mut(*count)? = k;
                *count += 1;
            }
            match group.quantity {
                Quantity::Placement => layout.phi = range,
                Quantity::CanonicalMomentum => layout.pi = range,
                _ => {}
            }
        }
        layout.count = momenta;
        let complete = layout.phi.len() == N * N && layout.pi.len() == N * N && momenta == positions;
        complete.then_some(layout)
    }

    /// Velocities at another placement and the momenta of `y` are those of the matrix.
    fn is_separable<S: StateVector<f64>>(&self, f: &dyn Fn(f64, &S) -> S, (t, y): (f64, &S)) -> bool {
        let mut elsewhere = *y;
        // Shears of the body keep the determinant, and change every entry.
        for a in 0..N {
            for i in 0..N {
                let row = self.phi.start + N * i;
                let entry = elsewhere.as_ref()[row + a];
                elsewhere.as_mut()[row + (a + 1) % N] += 0.5 * entry;
            }
        }
        let rates = f(t, &elsewhere);
        let expected = self.drift(y, 1.0);
        let (mut difference, mut size) = ([0.0; MOST], [0.0; MOST]);
        for (i, k) in self.positions[..self.count].iter().enumerate() {
            difference[i] = rates.as_ref()[*k] - expected.as_ref()[*k];
            size[i] = expected.as_ref()[*k];
        }
        norm(&difference) <= ROUNDING * norm(&size)
    }

    /// The placement of a state, or the change of it.
    pub(super) fn placement<S: StateVector<f64>>(&self, state: &S) -> Matrix<N> {
        matrix(&state.as_ref()[self.phi.clone()])
    }

    /// Writes the placement of a state.
    pub(super) fn place<S: StateVector<f64>>(&self, state: &mut S, phi: &Matrix<N>) {
        for (k, entry) in state.as_mut()[self.phi.clone()].iter_mut().enumerate() {
            *entry = phi[(k / N, k % N)];
        }
    }

    /// The state whose momentum is `pi`, and which is zero otherwise.
    pub(super) fn momentum<S: StateVector<f64>>(&self, pi: &Matrix<N>) -> S {
        let mut state = S::zeros();
        for (k, entry) in state.as_mut()[self.pi.clone()].iter_mut().enumerate() {
            *entry = pi[(k / N, k % N)];
        }
        state
    }

    /// `h` times the rates of the momenta.
    pub(super) fn kick<S: StateVector<f64>>(&self, rates: &S, h: f64) -> S {
        let mut rise = S::zeros();
        for k in &self.momenta[..self.count] {
            rise.as_mut()[*k] = h * rates.as_ref()[*k];
        }
        rise
    }

    /// The state holds the work.
    pub(super) fn has_work(&self) -> bool {
        self.work.is_some()
    }

    /// The work of a step `h`, by the powers at its ends.
    pub(super) fn work<S: StateVector<f64>>(&self, ends: [&S; 2], h: f64) -> S {
        let mut rise = S::zeros();
        if let Some(k) = self.work {
            rise.as_mut()[k] = 0.5 * h * ends.iter().map(|rates| rates.as_ref()[k]).sum::<f64>();
        }
        rise
    }

    /// `h T'` of the momenta of `state`, a change of positions.
    pub(super) fn drift<S: StateVector<f64>>(&self, state: &S, h: f64) -> S {
        let mut rise = S::zeros();
        for (i, position) in self.positions[..self.count].iter().enumerate() {
            let mut velocity = 0.0;
            for (k, momentum) in self.momenta[..self.count].iter().enumerate() {
                velocity += self.inverse_mass[i][k] * state.as_ref()[*momentum];
            }
            rise.as_mut()[*position] = h * velocity;
        }
        rise
    }
}

/// The placement matrix of a group of components.
fn matrix<const N: usize>(components: &[f64]) -> Matrix<N> {
    Matrix::<N>::from_row_slice(components)
}

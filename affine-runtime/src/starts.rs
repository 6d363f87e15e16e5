//! Starts of ensembles, drawn: distributions of the crate `rand` whose values are phase points, and places in boxes of fields.
//!
//! ```
//! use affine_runtime::prelude::*;
//! use affine_runtime::starts::Gaussian;
//! use rand::{SeedableRng, distr::Distribution, rngs::StdRng};
//!
//! #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), emit(lanes))]
//! struct Disc;
//!
//! let rest = Disc.at_momentum(Matrix::<2>::identity(), Comoving(Matrix::<2>::zeros()))?;
//! let starts = Gaussian::around(&Disc, rest).placement(0.1).momentum(0.3).sample_iter(StdRng::seed_from_u64(1));
//! let ends = Ensemble::new(&Disc, starts.take(50)).until(1.0).run()?;
//! assert!(ends.iter().all(Result::is_ok));
//! # Ok::<(), affine_runtime::Error>(())
//! ```

use nalgebra::{SMatrix, SVector};
use rand::distr::Distribution;
use rand::{Rng, RngExt};
use rand_distr::StandardNormal;

use crate::inner::LogDeterminant;
use crate::model::{Model, Quantity, Velocity};
use crate::numbers::numbers;
use crate::state::Phase;

/// Phase points around one: all numbers of placement, momentum, position and linear momentum are independent, with a normal
/// distribution around those of the point and the standard deviation that was asked for, 0 if not set. The momentum is that of
/// the model's own frame, `Sigma`, `Sigma_hat` or `Pi`. Placements without positive determinant are drawn again.
///
/// Not for models under a constraint, whose points are no vectors: that does not compile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaussian<const N: usize, P> {
    point: P,
    /// Of placement, momentum, position and linear momentum.
    deviations: [f64; 4],
}

impl<const N: usize, P: Phase<N>> Gaussian<N, P> {
    /// Around a phase point of a model.
    #[must_use]
    pub fn around<M: Model<N, Point<f64> = P>>(_model: &M, point: P) -> Self {
        const { assert!(M::DESCRIPTION.constraint.is_none(), "points under a constraint are no vectors") }
        Self { point, deviations: [0.0; 4] }
    }

    /// Standard deviation of each entry of `phi`.
    #[must_use]
    pub fn placement(mut self, deviation: f64) -> Self {
        self.deviations[0] = deviation;
        self
    }

    /// Standard deviation of each entry of the momentum.
    #[must_use]
    pub fn momentum(mut self, deviation: f64) -> Self {
        self.deviations[1] = deviation;
        self
    }

    /// Standard deviation of each component of `x`; a pinned body has none.
    #[must_use]
    pub fn position(mut self, deviation: f64) -> Self {
        self.deviations[2] = deviation;
        self
    }

    /// Standard deviation of each component of `p`; a pinned body has none.
    #[must_use]
    pub fn linear_momentum(mut self, deviation: f64) -> Self {
        self.deviations[3] = deviation;
        self
    }
}

impl<const N: usize, P: Phase<N>> Distribution<P> for Gaussian<N, P> {
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> P {
        let numbers = numbers(&self.point);
        let mut draw = || {
            let mut place = 0;
            self.point.with_entries(&mut || {
                let group = group::<N>(place);
                let number = numbers[place] + self.deviations[group] * rng.sample::<f64, _>(StandardNormal);
                place += 1;
                number
            })
        };
        let mut drawn = draw();
        // Half of all matrices are placements. Around one that is none there may be none for ever: a run that starts there says so.
        for _ in 0..MOST_DRAWS {
            let phi = drawn.phi();
            let is_open = self.deviations[0] != 0.0 && phi.iter().all(|entry| entry.is_finite());
            if !is_open || LogDeterminant::of(phi).is_positive() {
                break;
            }
            drawn = draw();
        }
        drawn
    }
}

/// A placement is drawn so often at the most.
const MOST_DRAWS: usize = 1024;

/// Numbers of all momenta, the internal and the linear one.
const MOMENTA: usize = 12;

/// Phase points with the placement and the position of one, and momenta of a level: of the [energy](Self::of_energy), or of their
/// [norm](Self::of_norm).
///
/// Not for models under a constraint, whose momenta are no vectors: that does not compile.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentumLevel<const N: usize, P> {
    point: P,
    /// From the unit sphere to momenta.
    root: SMatrix<f64, MOMENTA, MOMENTA>,
    /// How many are drawn: the internal ones, or the linear ones too.
    momenta: usize,
}

impl<const N: usize, P: Phase<N>> MomentumLevel<N, P> {
    /// Uniform on the ellipsoid `T(momenta) = E - U` at the placement and the position of a phase point, at a time, as the
    /// microcanonical ensemble at a fixed placement has it, `delta(H - E)` over all momenta. With `T = 1/2 pi^T A pi` and
    /// `A = L L^T`, `L^T pi` is uniform on a sphere. `None` where rest has more energy than that, and where the kinetic energy is
    /// not quadratic or not positive.
    #[must_use]
    pub fn of_energy<M: Model<N, Point<f64> = P>>(
        model: &M,
        (t, point): (f64, P),
        energy: f64,
    ) -> Option<Self> {
        const { assert!(M::DESCRIPTION.constraint.is_none(), "momenta under a constraint are no vectors") }
        let moves = M::DESCRIPTION.full.iter().any(|group| group.quantity == Quantity::Position);
        let momenta = N * N + if moves { N } else { 0 };
        let with = |momenta: &SVector<f64, MOMENTA>| with_momenta(&point, momenta);
        let of = |momenta: &SVector<f64, MOMENTA>| model.hamiltonian(t, &with(momenta));
        let rest = of(&SVector::zeros());
        let unit = |i: usize| with(&SVector::from_fn(|k, _| f64::from(u8::from(i == k))));
        let units: Vec<P> = (0..momenta).map(unit).collect();
        // What momenta give for the velocities of others: whatever their units, and however large the potential is.
        let mut form = SMatrix::<f64, MOMENTA, MOMENTA>::identity();
        for (i, one) in units.iter().enumerate() {
            let Velocity { x_dot, phi_dot } = model.velocity(one);
            for (k, other) in units.iter().enumerate() {
                form[(i, k)] = (other.pi().0.0 * phi_dot).trace() + other.p().dot(&x_dot);
            }
        }
        let form = (form + form.transpose()) * 0.5;
        let free = energy - rest;
        let root =
            form.cholesky().filter(|_| free >= 0.0)?.l().transpose().try_inverse()? * (2.0 * free).sqrt();
        // Of no quadratic energy a sum of directions has the energy of the form.
        let probe =
            root * SVector::from_fn(|k, _| if k < momenta { 1.0 / (momenta as f64).sqrt() } else { 0.0 });
        let is_quadratic = (of(&probe) - energy).abs() <= NEARLY * (free + rest.abs());
        is_quadratic.then_some(Self { point, root, momenta })
    }

    /// Uniform on the sphere of this Frobenius norm in the momenta of the model's own frame, `Sigma`, `Sigma_hat` or `Pi`; the
    /// linear momentum is that of the phase point.
    #[must_use]
    pub fn of_norm<M: Model<N, Point<f64> = P>>(_model: &M, point: P, norm: f64) -> Self {
        const { assert!(M::DESCRIPTION.constraint.is_none(), "momenta under a constraint are no vectors") }
        Self { point, root: SMatrix::from_diagonal_element(norm), momenta: N * N }
    }
}

/// Part of an energy that rounding may make of the sums of a quadratic form.
const NEARLY: f64 = 1e-9;

impl<const N: usize, P: Phase<N>> Distribution<P> for MomentumLevel<N, P> {
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> P {
        let numbers =
            SVector::from_fn(|k, _| if k < self.momenta { rng.sample(StandardNormal) } else { 0.0 });
        let mut momenta = self.root * direction(numbers);
        if self.momenta == N * N {
            self.point.p().iter().enumerate().for_each(|(i, p)| momenta[N * N + i] = *p);
        }
        with_momenta(&self.point, &momenta)
    }
}

/// `count` places in a box, by its lower and upper bounds: of as many equal parts of every side each has one place, at random in
/// it, the parts of different sides being in random orders (Latin hypercube: McKay, Beckman, Conover, Technometrics 21 (1979)
/// 239). For sweeps over many fields, where a grid is too large.
pub fn latin_hypercube<R: Rng + ?Sized>(rng: &mut R, count: usize, bounds: &[(f64, f64)]) -> Vec<Vec<f64>> {
    let mut places = vec![Vec::with_capacity(bounds.len()); count];
    for (low, high) in bounds {
        let mut parts: Vec<usize> = (0..count).collect();
        // Fisher and Yates.
        for last in (1..count).rev() {
            parts.swap(last, rng.random_range(0..=last));
        }
        for (place, part) in places.iter_mut().zip(parts) {
            let within = (part as f64 + rng.random::<f64>()) / count as f64;
            // By halves: the length of a side may be out of the range of numbers.
            place.push(2.0 * (0.5 * low + (0.5 * high - 0.5 * low) * within));
        }
    }
    places
}

/// Placement, momentum, position, linear momentum: the group of a place among these numbers.
fn group<const N: usize>(place: usize) -> usize {
    match place / (N * N) {
        group @ (0 | 1) => group,
        _ => 2 + usize::from(place >= 2 * N * N + N),
    }
}

/// The point with other momenta: those of its own frame, then the linear ones.
fn with_momenta<const N: usize, P: Phase<N>>(point: &P, momenta: &SVector<f64, MOMENTA>) -> P {
    let numbers = numbers(point);
    let mut place = 0;
    point.with_entries(&mut || {
        let number = match group::<N>(place) {
            1 => momenta[place - N * N],
            3 => momenta[place - N * N - N],
            _ => numbers[place],
        };
        place += 1;
        number
    })
}

/// The vector over its length.
fn direction(vector: SVector<f64, MOMENTA>) -> SVector<f64, MOMENTA> {
    vector / vector.norm()
}

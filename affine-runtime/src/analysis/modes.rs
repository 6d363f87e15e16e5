//! Small vibrations about a point of rest.

use core::fmt;

use super::error::AnalysisError;
use super::field::{canonical_slopes, vector};
use super::linear::{Column, Dense, RANK, kernel};
use super::relative::{Linearised, RelativeEquilibrium};
use crate::decompose::TwoPolar;
use crate::frames::{Matrix, Vector};
use crate::metrics::Bases;
use crate::model::{Model, Velocity};
use crate::state::Phase;

/// Parts of the largest by which squares of frequencies may differ and be one, and below which one is zero.
const ALIKE: f64 = 1e-10;
/// Part of a shape that may be of another class.
const STRAY: f64 = 1e-9;

/// The modes of small vibrations about a point of rest: solutions of `K v = w^2 M v`.
#[derive(Clone, Debug)]
pub struct Modes<const N: usize> {
    /// Modes, from the lowest; equal frequencies are one mode.
    pub modes: Vec<Mode<N>>,
    /// Number of directions without restoring force: `|w^2|` is below 1e-10 of the largest, about where rounding is.
    pub zeros: usize,
    /// The placement at rest.
    pub rest: Matrix<N>,
    /// Those in which the metrics are the identity.
    bases: Option<Bases<N>>,
}

/// A frequency with its shapes.
#[derive(Clone, Debug)]
pub struct Mode<const N: usize> {
    /// `w^2`; negative where it grows.
    pub squared: f64,
    /// A bound of its error by rounding.
    pub error: f64,
    /// What the shapes have in common.
    pub class: ModeClass,
    /// A basis of the changes of position and placement, with `v^T M v = 1`, as many as the multiplicity.
    pub shapes: Vec<Velocity<N>>,
}

/// How a shape changes the body, in the principal axes of the deformation at rest; lengths and angles are those of the metrics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ModeClass {
    /// All stretches alike.
    Breathing,
    /// Volume and orientation stay.
    Shear,
    /// Of a body with an axis, by the number of waves about it: 0, 1 or 2.
    Axial(u8),
    /// Stretches along the axes alone.
    Diagonal,
    /// In the plane of two axes, numbered from 1, which do not change their lengths.
    Pair(usize, usize),
    /// The centre of mass moves, the body does not change.
    Drift,
    /// Several of these.
    Mixed,
}

impl<const N: usize> Mode<N> {
    /// The frequency `w`; NaN where the mode grows.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.squared.sqrt()
    }

    /// Number of independent shapes.
    #[must_use]
    pub fn multiplicity(&self) -> usize {
        self.shapes.len()
    }
}

/// A table of frequencies.
impl<const N: usize> fmt::Display for Modes<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:>22} {:>9}  {:<8} class", "frequency", "error", "shapes")?;
        for mode in &self.modes {
            let (w, error) = (mode.frequency(), mode.error / (2.0 * mode.squared.abs().sqrt()));
            writeln!(f, "{w:>22.15e} {error:>9.1e}  {:<8} {:?}", mode.multiplicity(), mode.class)?;
        }
        write!(f, "{} directions without restoring force", self.zeros)
    }
}

impl<const N: usize, P: Phase<N>> RelativeEquilibrium<N, P> {
    /// The small vibrations about a point of rest.
    ///
    /// # Errors
    /// [`AnalysisError::NoVibrations`] where `zeta` or a momentum is not zero, where the linearised forces have no potential, or
    /// where the mass matrix is not positive.
    pub fn modes<M: Model<N, Point<f64> = P>>(&self, model: &M) -> Result<Modes<N>, AnalysisError> {
        let at = Linearised::at(model, &self.zeta, &self.point);
        let moved = canonical_slopes(model, &vector(&model.flatten(&self.point))) * &at.basis;
        let moved = moved.rows(0, N + N * N).into_owned();
        let momenta = kernel(&moved, RANK);
        let places = kernel(&momenta.transpose(), RANK);
        let (mass, stiffness) = vibrating(&at, &places, &momenta).ok_or(AnalysisError::NoVibrations)?;
        let lower = mass.cholesky().ok_or(AnalysisError::NoVibrations)?.l();
        let inverse = lower.try_inverse().ok_or(AnalysisError::NoVibrations)?;
        let eigen = (&inverse * stiffness * inverse.transpose()).symmetric_eigen();
        let vectors = moved * places * inverse.tr_mul(&eigen.eigenvectors);
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let largest = eigen.eigenvalues.amax();
        let own = |k: usize| eigen.eigenvalues[k];
        let (zero, moving): (Vec<usize>, Vec<usize>) =
            order.into_iter().partition(|k| own(*k).abs() <= ALIKE * largest);
        let (zeros, rest, bases) = (zero.len(), *self.point.phi(), model.bases());
        let found = Modes { modes: Vec::new(), zeros, rest, bases };
        let frame = Frame::of(model.orthonormal::<f64>(&self.point).phi());
        let mode = |group: &[usize]| {
            let shapes: Vec<_> = group.iter().map(|k| shape(&vectors.column(*k).into_owned())).collect();
            Mode {
                squared: group.iter().map(|k| own(*k)).sum::<f64>() / group.len() as f64,
                error: 10.0 * f64::EPSILON * largest * group.len() as f64,
                class: frame.class(&shapes.iter().map(|shape| found.measured(shape).1).collect::<Vec<_>>()),
                shapes,
            }
        };
        let alike = |a: &usize, b: &usize| (own(*a) - own(*b)).abs() <= ALIKE * largest;
        let modes = moving.chunk_by(alike).map(mode).collect();
        Ok(Modes { modes, ..found })
    }
}

impl<const N: usize> Modes<N> {
    /// The placement at rest with a shape, in bases in which the metrics are the identity.
    pub(super) fn measured(&self, shape: &Velocity<N>) -> (Matrix<N>, Velocity<N>) {
        let bases = self.bases.as_ref();
        bases.map_or((self.rest, *shape), |bases| (bases.placement(&self.rest), bases.velocity(shape)))
    }
}

/// `M` and `K` over the places, from `q' = A_qp p` and `p' = A_pq q`.
fn vibrating<const N: usize>(at: &Linearised<N>, places: &Dense, momenta: &Dense) -> Option<(Dense, Dense)> {
    let (motion, size) = (&at.motion, at.motion.norm());
    let at_rest = (places.tr_mul(motion) * places).norm() + (momenta.tr_mul(motion) * momenta).norm();
    let pairing = places.tr_mul(&at.form) * momenta;
    if at_rest > RANK * size || !pairing.is_square() {
        return None;
    }
    let mass = &pairing * (places.tr_mul(motion) * momenta).try_inverse()?;
    let stiffness = -&pairing * (momenta.tr_mul(motion) * places);
    let is_symmetric = |form: &Dense| (form - form.transpose()).norm() <= RANK * form.norm();
    (is_symmetric(&mass) && is_symmetric(&stiffness)).then_some((mass, stiffness))
}

fn shape<const N: usize>(change: &Column) -> Velocity<N> {
    Velocity {
        x_dot: Vector::<N>::from_fn(|i, _| change[i]),
        phi_dot: Matrix::<N>::from_fn(|i, a| change[N + a * N + i]),
    }
}

/// The principal axes of a placement.
struct Frame<const N: usize> {
    left: Matrix<N>,
    right: Matrix<N>,
    /// The axis that the others are equal beside.
    axis: Option<usize>,
    is_round: bool,
}

impl<const N: usize> Frame<N> {
    fn of(phi: &Matrix<N>) -> Self {
        let near = |a: f64, b: f64| (a - b).abs() <= STRAY * (a + b);
        let round =
            |size: f64| Self { left: phi / size, right: Matrix::<N>::identity(), axis: None, is_round: true };
        let Ok(TwoPolar { left, stretches: own, right }) = TwoPolar::of(phi) else { return round(1.0) };
        if (1..N).all(|a| near(own[a], own[0])) {
            return round(own[0]);
        }
        let is_axis = |c: usize| N == 3 && near(own[(c + 1) % N], own[(c + 2) % N]);
        Self { left, right, axis: (0..N).find(|c| is_axis(*c)), is_round: false }
    }

    /// The class that has all of the shapes.
    fn class(&self, shapes: &[Velocity<N>]) -> ModeClass {
        let strains: Vec<Matrix<N>> =
            shapes.iter().map(|shape| self.left.transpose() * shape.phi_dot * self.right).collect();
        let square = |number: f64| number * number;
        let sum = |of: &dyn Fn(&Matrix<N>) -> f64| strains.iter().map(of).sum::<f64>();
        let drift = shapes.iter().map(|shape| shape.x_dot.norm_squared()).sum();
        // The squares of what the shapes have of each class.
        let mut parts = vec![(ModeClass::Drift, drift)];
        if self.is_round {
            let breathing = sum(&|e| square(e.trace()) / N as f64);
            let shear = sum(&|e| (e + e.transpose()).norm_squared() / 4.0) - breathing;
            parts.extend([(ModeClass::Breathing, breathing), (ModeClass::Shear, shear)]);
        }
        if let Some(c) = self.axis {
            let (a, b) = ((c + 1) % N, (c + 2) % N);
            let tilts = [(a, c), (c, a), (b, c), (c, b)];
            let shears = |e: &Matrix<N>| square(e[(a, a)] - e[(b, b)]) + square(e[(a, b)] + e[(b, a)]);
            parts.push((
                ModeClass::Axial(0),
                sum(&|e| square(e[(a, a)] + e[(b, b)]) / 2.0 + square(e[(c, c)])),
            ));
            parts.push((ModeClass::Axial(1), sum(&|e| tilts.iter().map(|at| square(e[*at])).sum())));
            parts.push((ModeClass::Axial(2), sum(&|e| shears(e) / 2.0)));
        } else {
            parts.push((ModeClass::Diagonal, sum(&|e| e.diagonal().norm_squared())));
            for (a, b) in (0..N).flat_map(|b| (0..b).map(move |a| (a, b))) {
                let pair = sum(&|e| square(e[(a, b)]) + square(e[(b, a)]));
                parts.push((ModeClass::Pair(a + 1, b + 1), pair));
            }
        }
        let all = drift + sum(&Matrix::<N>::norm_squared);
        let whole = parts.into_iter().find(|(_, part)| *part >= (1.0 - STRAY) * all);
        whole.map_or(ModeClass::Mixed, |(class, _)| class)
    }
}

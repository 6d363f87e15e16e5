//! The two-polar decomposition: principal axes of space and body, and stretches.

use super::jacobi::{Factors, factors};
use crate::error::{Error, Result};
use crate::frames::{Matrix, Vector};
use crate::kinematics::LogDeterminant;

/// `phi = L D R^T` (section 6 of the paper): `L`, `R` in SO(n), `D = diag(Q_a)`, `Q_a = exp(q_a) > 0`.
///
/// The columns of `R` are the principal axes of `G = phi^T phi`, those of `L` the principal axes of
/// `phi phi^T`. Frames are unique up to a common signed permutation `W` of determinant 1, `(L W, W^T D W, R W)`: there
/// are `2^(n-1) n!` of them (the paper prints `n n!`), and more where stretches coincide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoPolar<const N: usize> {
    /// `L`.
    pub left: Matrix<N>,
    /// `Q_a`.
    pub stretches: Vector<N>,
    /// `R`.
    pub right: Matrix<N>,
}

/// `phi = U A = B U`: `U` in SO(n), `A` and `B = U A U^T` symmetric and positive definite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polar<const N: usize> {
    /// `U = L R^T`.
    pub rotation: Matrix<N>,
    /// `A = R D R^T`, in the body.
    pub right_stretch: Matrix<N>,
    /// `B = L D L^T`, in space.
    pub left_stretch: Matrix<N>,
}

impl<const N: usize> Polar<N> {
    /// `phi = U A = B U` from [`TwoPolar::of`].
    ///
    /// # Errors
    /// Those of [`TwoPolar::of`].
    pub fn of(phi: &Matrix<N>) -> Result<Self> {
        TwoPolar::of(phi).map(|found| found.polar())
    }
}

impl<const N: usize> TwoPolar<N> {
    /// `phi = L D R^T` with the stretches in descending order, `n` = 2 or 3.
    ///
    /// Error of every stretch: a few units of rounding of the largest one. Relative to itself a few units of rounding for
    /// `n = 2`, whatever the matrix, and for `n = 3` where `phi` is a well-conditioned matrix with rescaled rows, or with
    /// rescaled columns; stretches may differ by a factor of `1e250`. `L`, `R` are orthogonal to a few units of rounding
    /// also where stretches coincide, exactly or nearly.
    ///
    /// Method: for `n = 2` in closed form, with a determinant that is exact to rounding; for `n = 3` rotations of the columns
    /// until they are orthogonal (one-sided Jacobi: Hestenes, J. SIAM 6 (1958) 51; relative accuracy: Demmel and Veselic,
    /// SIAM J. Matrix Anal. Appl. 13 (1992) 1204), of `phi` or of its transpose, whichever is nearer to having orthogonal
    /// columns.
    ///
    /// # Errors
    /// [`Error::Placement`] where an entry is not finite or the determinant is not positive, for `n = 3` as far as rounding
    /// shows it: certain where the condition number is below about `1/(10 eps)`. [`Error::NotFinite`] where stretches of a placement
    /// differ by more than the range of numbers.
    pub fn of(phi: &Matrix<N>) -> Result<Self> {
        const { assert!(N == 2 || N == 3, "two-polar decompositions are of 2x2 and 3x3 matrices") };
        let found = factors(phi);
        let is_lost = found.as_ref().is_none_or(|found| found.values.min() == 0.0);
        let found = found.filter(|found| found.proper && found.values.iter().all(|value| *value > 0.0));
        let found = found.map(|Factors { left, values, right, .. }| Self { left, stretches: values, right });
        found.ok_or_else(|| match LogDeterminant::of(phi) {
            log if log.is_positive() && is_lost => Error::NotFinite { quantity: "a quotient of stretches" },
            determinant => Error::Placement { determinant: determinant.to_f64() },
        })
    }

    /// `phi = L D R^T`.
    #[must_use]
    pub fn placement(&self) -> Matrix<N> {
        self.left * Matrix::from_diagonal(&self.stretches) * self.right.transpose()
    }

    /// `q_a = ln Q_a`.
    #[must_use]
    pub fn log_stretches(&self) -> Vector<N> {
        self.stretches.map(libm::log)
    }

    /// `U = L R^T`, `A = R D R^T`, `B = L D L^T`.
    #[must_use]
    pub fn polar(&self) -> Polar<N> {
        let stretch = |frame: &Matrix<N>| frame * Matrix::from_diagonal(&self.stretches) * frame.transpose();
        Polar {
            rotation: self.left * self.right.transpose(),
            right_stretch: stretch(&self.right),
            left_stretch: stretch(&self.left),
        }
    }

    /// The decomposition of a later placement of the same motion, with the labels and frames nearest to this one: the
    /// signed permutation `W` of determinant 1 that maximises `tr(L'^T L W) + tr(R'^T R W)`. Stretches that
    /// coincide to rounding leave a rotation of their axes free, which is chosen likewise. Labels then follow the motion
    /// through crossings, and frames do not jump, where the placements are near enough: the axes should turn by less than
    /// an eighth of a turn from one to the next.
    ///
    /// # Errors
    /// Those of [`of`](Self::of).
    pub fn continued(&self, phi: &Matrix<N>) -> Result<Self> {
        let next = Self::of(phi)?.turned_in_coincident_planes(self);
        let overlap = next.overlap(self);
        Ok(next.relabelled(&nearest_relabelling(&overlap)))
    }

    /// `(L W, W^T D W, R W)` for a signed permutation `W`.
    #[must_use]
    pub fn relabelled(&self, w: &Matrix<N>) -> Self {
        Self {
            left: self.left * w,
            // Squares of the signs: a permutation of the stretches.
            stretches: w.component_mul(w).tr_mul(&self.stretches),
            right: self.right * w,
        }
    }

    /// `L^T L' + R^T R'`, `L'` and `R'` those of the other.
    fn overlap(&self, other: &Self) -> Matrix<N> {
        self.left.tr_mul(&other.left) + self.right.tr_mul(&other.right)
    }

    /// Turns the axes of stretches that coincide to rounding as near to those of the other as they come.
    fn turned_in_coincident_planes(mut self, other: &Self) -> Self {
        // Rounding of a decomposition, twice.
        const COINCIDENT: f64 = 16.0 * f64::EPSILON;
        let near =
            |a: usize, b: usize| self.stretches[a] - self.stretches[b] <= COINCIDENT * self.stretches[a];
        if N == 3 && near(0, N - 1) {
            // U nearest to the overlap; where that is singular no direction is nearest.
            if let Ok(nearest) = Polar::of(&self.overlap(other)) {
                self.left *= nearest.rotation;
                self.right *= nearest.rotation;
            }
            return self;
        }
        for a in (0..N - 1).filter(|a| near(*a, *a + 1)) {
            // The labels of the plane's axes in the other are not known yet: any two of its axes may be near.
            let overlap = self.overlap(other);
            let pairs = (0..N).flat_map(|c| (0..N).map(move |d| (c, d))).filter(|(c, d)| c != d);
            let planar = |(c, d)| {
                let (even, odd) =
                    (overlap[(a, c)] + overlap[(a + 1, d)], overlap[(a + 1, c)] - overlap[(a, d)]);
                (libm::hypot(even, odd), libm::atan2(odd, even))
            };
            let best = pairs.map(planar).fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
            let (sine, cosine) = libm::sincos(best.1);
            for frame in [&mut self.left, &mut self.right] {
                let (first, second) = (frame.column(a).clone_owned(), frame.column(a + 1).clone_owned());
                frame.set_column(a, &(first * cosine + second * sine));
                frame.set_column(a + 1, &(second * cosine - first * sine));
            }
        }
        self
    }
}

/// The signed permutation `W` of determinant 1 that maximises `tr(W^T K)`.
fn nearest_relabelling<const N: usize>(overlap: &Matrix<N>) -> Matrix<N> {
    let mut best = (f64::NEG_INFINITY, Matrix::<N>::identity());
    for (places, odd) in permutations::<N>() {
        let entry = |a: usize| overlap[(places[a], a)];
        let mut signs: [f64; N] = core::array::from_fn(|a| if entry(a) < 0.0 { -1.0 } else { 1.0 });
        let negative = signs.iter().filter(|sign| **sign < 0.0).count() % 2 == 1;
        if negative != odd {
            let weakest = (1..N).fold(0, |k, a| if entry(a).abs() < entry(k).abs() { a } else { k });
            signs[weakest] = -signs[weakest];
        }
        let total: f64 = (0..N).map(|a| signs[a] * entry(a)).sum();
        if total > best.0 {
            let mut w = Matrix::<N>::zeros();
            (0..N).for_each(|a| w[(places[a], a)] = signs[a]);
            best = (total, w);
        }
    }
    best.1
}

/// The permutations of `n` = 2 or 3 labels, and whether they are odd.
fn permutations<const N: usize>() -> impl Iterator<Item = ([usize; N], bool)> {
    (0..N).flat_map(|shift| {
        let place =
            move |a: usize, mirrored: bool| if mirrored { (N - a + shift) % N } else { (a + shift) % N };
        // Shifts of three labels are even; of two labels they are all there is.
        let mirrors: &'static [bool] = if N == 3 { &[false, true] } else { &[false] };
        mirrors.iter().map(move |mirrored| {
            (core::array::from_fn(|a| place(a, *mirrored)), *mirrored || (N == 2 && shift == 1))
        })
    })
}

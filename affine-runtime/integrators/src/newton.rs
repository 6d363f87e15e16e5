//! Newton's corrections of the stage equations of collocation: `(1 - h M (x) J) dL = r`, `M` the matrix of the method.
//!
//! By the eigenvalues of `M` the system falls apart into one of dimension `dim y` for each mode,
//! `(1 - h lambda J) u = sum_j left_j r_j`, `dL_i = sum_modes Re(right_i u)`, as in Hairer, Wanner, Solving Ordinary
//! Differential Equations II, section IV.8. The Jacobian `J` is made of differences: its errors change how fast the
//! corrections converge, not what they converge to.

use nalgebra::{Complex, ComplexField};

use affine_core::model::StateVector;

/// Components of the largest state for which there is room: memory is fixed, so that nothing allocates. The
/// placement, its momentum and the centre of mass of a body in space have 24.
pub(crate) const CAPACITY: usize = 32;
/// Relative change for the differences: balances rounding, `eps/change`, and curvature, `change`.
const CHANGE: f64 = 1.5e-8;

/// A complex number, real part first.
pub(crate) type Pair = (f64, f64);

/// An eigenvalue `lambda` of the matrix `M` of a method, with eigenvectors such that the matrix is
/// `sum_modes Re(right_i lambda left_j)` and the identity `sum_modes Re(right_i left_j)`: of a conjugate pair one
/// stands for both.
#[derive(Debug, PartialEq)]
pub(crate) struct Mode {
    pub(crate) eigenvalue: Pair,
    pub(crate) right: &'static [Pair],
    pub(crate) left: &'static [Pair],
}

type Entry = Complex<f64>;

const ZERO: Entry = Complex::new(0.0, 0.0);

/// The Jacobian and the factors of the systems.
#[derive(Clone, Copy)]
pub(crate) struct Newton<S, const MODES: usize> {
    modes: &'static [Mode],
    /// Column by column; valid where `known`.
    columns: [S; CAPACITY],
    /// How large the components are there.
    sizes: S,
    known: bool,
    /// Of the components from here on nothing depends.
    dimension: usize,
    /// The first mode is solved for in real numbers.
    has_real_mode: bool,
    /// Of that mode, and of the others.
    real: Factors<f64>,
    factors: [Factors<Entry>; MODES],
    /// The step length of the factors; NaN before there are any.
    h: f64,
}

impl<S: StateVector<f64>, const MODES: usize> Newton<S, MODES> {
    pub(crate) fn new(modes: &'static [Mode]) -> Self {
        Self {
            modes,
            columns: [S::zeros(); CAPACITY],
            sizes: S::zeros(),
            known: false,
            dimension: S::LEN,
            has_real_mode: false,
            real: Factors::none(0.0),
            factors: [Factors::none(ZERO); MODES],
            h: f64::NAN,
        }
    }

    /// For equations that depend on the first components alone, the others being integrals over these, by a method whose first
    /// mode is real.
    pub(crate) fn with_real_mode(modes: &'static [Mode], dimension: usize) -> Self {
        Self { dimension, has_real_mode: true, ..Self::new(modes) }
    }

    /// The state is not too large.
    pub(crate) const FITS: bool = S::LEN <= CAPACITY;

    /// There is a Jacobian, of this step or an earlier one.
    pub(crate) fn is_known(&self) -> bool {
        self.known
    }

    /// The next iteration needs a new Jacobian.
    pub(crate) fn forget(&mut self) {
        self.known = false;
    }

    /// The Jacobian of `f` at `(t, y)`, where components change by about `extent` within a step. One evaluation,
    /// and one for each component.
    pub(crate) fn differentiate(&mut self, f: &dyn Fn(f64, &S) -> S, t: f64, y: &S, extent: &S) {
        let mut sizes = *extent;
        for (size, y) in sizes.as_mut().iter_mut().zip(y.as_ref()) {
            *size = size.abs() + y.abs();
        }
        self.learn(&sizes, |columns| by_differences(f, (t, y, &f(t, y)), extent, columns));
    }

    /// A Jacobian, column by column, where components are so large.
    pub(crate) fn learn(&mut self, sizes: &S, fill: impl FnOnce(&mut [S])) {
        fill(&mut self.columns[..S::LEN]);
        self.sizes = *sizes;
        self.known = true;
        self.h = f64::NAN;
    }

    /// Factors for steps of length `h`. `false` where a system is singular or not finite.
    #[must_use]
    pub(crate) fn prepare(&mut self, h: f64) -> bool {
        if self.h == h {
            return true;
        }
        self.h = f64::NAN;
        let columns = &self.columns[..self.dimension];
        let sizes = &self.sizes.as_ref()[..self.dimension];
        for (k, (mode, factors)) in self.modes.iter().zip(&mut self.factors).enumerate() {
            let factored = match self.has_real_mode && k == 0 {
                true => self.real.of(-h * mode.eigenvalue.0, columns, sizes),
                false => factors.of(Complex::new(mode.eigenvalue.0, mode.eigenvalue.1) * -h, columns, sizes),
            };
            if !factored {
                return false;
            }
        }
        self.h = h;
        true
    }

    /// `dL` from the defects `r`.
    pub(crate) fn correction<const STAGES: usize>(&self, defects: &[S; STAGES]) -> [S; STAGES] {
        let mut correction = [S::zeros(); STAGES];
        for (k, (mode, factors)) in self.modes.iter().zip(&self.factors).enumerate() {
            let Mode { right, left, .. } = mode;
            let mut u = [ZERO; CAPACITY];
            for (i, u) in u.iter_mut().enumerate().take(S::LEN) {
                for (left, defect) in left.iter().zip(defects) {
                    *u += Complex::new(left.0, left.1) * defect.as_ref()[i];
                }
            }
            match self.has_real_mode && k == 0 {
                true => {
                    let mut real = u.map(|u| u.re);
                    self.real.solve(&mut real, self.dimension);
                    u.iter_mut().zip(real).for_each(|(u, real)| u.re = real);
                }
                false => factors.solve(&mut u, self.dimension),
            }
            for (right, correction) in right.iter().zip(&mut correction) {
                for (value, u) in correction.as_mut().iter_mut().zip(&u) {
                    *value += right.0 * u.re - right.1 * u.im;
                }
            }
        }
        correction
    }

    /// `(1 - h lambda J)^-1 r` for the real mode.
    pub(crate) fn filtered(&self, r: &S) -> S {
        let mut u = [0.0; CAPACITY];
        u.iter_mut().zip(r.as_ref()).for_each(|(u, r)| *u = *r);
        self.real.solve(&mut u, self.dimension);
        let mut filtered = S::zeros();
        filtered.as_mut().iter_mut().zip(u).for_each(|(filtered, u)| *filtered = u);
        filtered
    }
}

/// The Jacobian of `f` at `(t, y)`, where it is `slope`, column by column, where components change by about `extent` within a
/// step. One evaluation for each component.
pub(crate) fn by_differences<S: StateVector<f64>>(
    f: &dyn Fn(f64, &S) -> S,
    (t, y, slope): (f64, &S, &S),
    extent: &S,
    columns: &mut [S],
) {
    let size = y.as_ref().iter().fold(0.0, |largest: f64, y| largest.max(y.abs()));
    for (c, column) in columns.iter_mut().enumerate() {
        let own = y.as_ref()[c].abs() + extent.as_ref()[c].abs();
        let scale = if own > 0.0 {
            own
        } else if size > 0.0 {
            size
        } else {
            1.0
        };
        let mut changed = *y;
        changed.as_mut()[c] += CHANGE * scale;
        // What the sum really changed by.
        let change = changed.as_ref()[c] - y.as_ref()[c];
        *column = f(t, &changed);
        for (entry, slope) in column.as_mut().iter_mut().zip(slope.as_ref()) {
            *entry = (*entry - slope) / change;
        }
    }
}

/// `P A = L U` with the unit diagonal of `L` left out.
#[derive(Clone, Copy)]
struct Factors<E> {
    entries: [[E; CAPACITY]; CAPACITY],
    pivots: [usize; CAPACITY],
}

impl<E: ComplexField<RealField = f64> + Copy> Factors<E> {
    fn none(zero: E) -> Self {
        Self { entries: [[zero; CAPACITY]; CAPACITY], pivots: [0; CAPACITY] }
    }

    /// Factors `1 + factor J`, `J` given by its columns, where components are so large. `false` where that is singular or not
    /// finite.
    fn of<S: AsRef<[f64]>>(&mut self, factor: E, columns: &[S], sizes: &[f64]) -> bool {
        let mut units = [0.0; CAPACITY];
        for (c, (column, size)) in columns.iter().zip(sizes).enumerate() {
            for (r, entry) in column.as_ref().iter().enumerate().take(sizes.len()) {
                let diagonal = if r == c { E::one() } else { E::zero() };
                self.entries[r][c] = factor * E::from_real(*entry) + diagonal;
                units[r] += self.entries[r][c].norm1() * size;
            }
        }
        self.eliminate(&mut units[..sizes.len()])
    }

    /// Gaussian elimination in place. The pivot of each column is the entry that is largest in the unit of its row, what that
    /// comes to where components have their sizes: rows of a placement and of a momentum differ by a mass, and by the
    /// entries alone the unit of mass would choose.
    fn eliminate(&mut self, units: &mut [f64]) -> bool {
        let dimension = units.len();
        // What nothing moves has no unit.
        units.iter_mut().filter(|unit| **unit == 0.0).for_each(|unit| *unit = 1.0);
        for k in 0..dimension {
            let mut pivot = k;
            for r in k + 1..dimension {
                if self.entries[r][k].norm1() / units[r] > self.entries[pivot][k].norm1() / units[pivot] {
                    pivot = r;
                }
            }
            self.pivots[k] = pivot;
            self.entries.swap(k, pivot);
            units.swap(k, pivot);
            let largest = self.entries[k][k].norm1();
            if !(largest > 0.0 && largest.is_finite()) {
                return false;
            }
            let inverse = E::one() / self.entries[k][k];
            let row = self.entries[k];
            for below in &mut self.entries[k + 1..dimension] {
                let factor = below[k] * inverse;
                below[k] = factor;
                for (entry, above) in below[k + 1..dimension].iter_mut().zip(&row[k + 1..dimension]) {
                    *entry -= factor * *above;
                }
            }
        }
        true
    }

    fn solve(&self, u: &mut [E; CAPACITY], dimension: usize) {
        // Multipliers moved with their rows in the elimination: the whole permutation comes first.
        for k in 0..dimension {
            u.swap(k, self.pivots[k]);
        }
        for r in 0..dimension {
            let sum = |sum: E, (entry, u): (&E, &E)| sum - *entry * *u;
            u[r] = self.entries[r][..r].iter().zip(&u[..r]).fold(u[r], sum);
        }
        for r in (0..dimension).rev() {
            let sum = |sum: E, (entry, u): (&E, &E)| sum - *entry * *u;
            let above = self.entries[r][r + 1..dimension].iter().zip(&u[r + 1..dimension]);
            u[r] = above.fold(u[r], sum) / self.entries[r][r];
        }
    }
}

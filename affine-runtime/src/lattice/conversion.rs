//! Between phase points and lattices, and between lattices and the arrays that integrators step.

use super::{Lattice, LatticeForm, Variables};
use crate::decompose::TwoPolar;
use crate::error::{Error, Result};
use crate::frames::{Body, Canonical, Frame, Matrix, Space, Vector};
use crate::inner::far_from_undeformed;
use crate::model::StateVector;
use crate::scalar::Real;

/// The affine spin of a frame on the principal axes: `Y = L^T Sigma L`, `R^T Sigma_hat R` or `R^T Pi L`, which are
/// `D^s Z D^-s` with `s` = 1/2, -1/2, and `D^(-1/2) Z D^(-1/2)`.
pub trait LatticeFrame: Frame {
    /// `(f, g)` with `Y_ab = exp(f q_a + g q_b) Z_ab`.
    const EXPONENTS: (f64, f64);
    /// The frames `(F, G)` with `spin = F Y G^T`.
    fn axes<'a, const N: usize>(left: &'a Matrix<N>, right: &'a Matrix<N>) -> (&'a Matrix<N>, &'a Matrix<N>);
}

impl LatticeFrame for Space {
    const EXPONENTS: (f64, f64) = (0.5, -0.5);
    fn axes<'a, const N: usize>(left: &'a Matrix<N>, _: &'a Matrix<N>) -> (&'a Matrix<N>, &'a Matrix<N>) {
        (left, left)
    }
}

impl LatticeFrame for Body {
    const EXPONENTS: (f64, f64) = (-0.5, 0.5);
    fn axes<'a, const N: usize>(_: &'a Matrix<N>, right: &'a Matrix<N>) -> (&'a Matrix<N>, &'a Matrix<N>) {
        (right, right)
    }
}

impl LatticeFrame for Canonical {
    const EXPONENTS: (f64, f64) = (-0.5, -0.5);
    fn axes<'a, const N: usize>(left: &'a Matrix<N>, right: &'a Matrix<N>) -> (&'a Matrix<N>, &'a Matrix<N>) {
        (right, left)
    }
}

/// The lattice of a placement and its affine spin in the frame `F`; with labels and frames nearest to those before.
///
/// `M_ab = -2 sh(x_ab) (Z_ab + Z_ba)` and `N_ab = 2 ch(x_ab) (Z_ab - Z_ba)`: as `-rho_hat - tau_hat`, `M` would be lost in
/// cancellation where stretches nearly coincide.
pub(crate) fn lattice_of<const N: usize, F: LatticeFrame>(
    phi: &Matrix<N>,
    spin: &Matrix<N>,
    before: Option<&Lattice<N>>,
) -> Result<Lattice<N>> {
    let axes = match before {
        None => TwoPolar::of(phi)?,
        Some(lattice) => lattice.two_polar().continued(phi)?,
    };
    let q = axes.log_stretches();
    let (left, right) = (axes.left, axes.right);
    let (first, second) = F::axes(&left, &right);
    let y = first.tr_mul(spin) * second;
    let (f, g) = F::EXPONENTS;
    let z = Matrix::<N>::from_fn(|a, b| y[(a, b)] * libm::exp(-f * q[a] - g * q[b]));
    let mut lattice = Lattice { q, p: z.diagonal(), m: Matrix::zeros(), n: Matrix::zeros(), left, right };
    for (a, b) in (0..N).flat_map(|a| (0..N).map(move |b| (a, b))).filter(|(a, b)| a != b) {
        let x = lattice.half_difference(a, b);
        lattice.m[(a, b)] = -2.0 * libm::sinh(x) * (z[(a, b)] + z[(b, a)]);
        lattice.n[(a, b)] = 2.0 * libm::cosh(x) * (z[(a, b)] - z[(b, a)]);
    }
    Ok(lattice)
}

/// `phi = L D R^T` and the affine spin in the frame `F`.
pub(crate) fn placement_and_spin<const N: usize, F: LatticeFrame>(
    lattice: &Lattice<N>,
) -> Result<(Matrix<N>, Matrix<N>)> {
    if lattice.gap() == 0.0 {
        return Err(Error::CoincidentStretches);
    }
    let (z, (f, g)) = (lattice.z(), F::EXPONENTS);
    let y = Matrix::<N>::from_fn(|a, b| z[(a, b)] * libm::exp(f * lattice.q[a] + g * lattice.q[b]));
    let (first, second) = F::axes(&lattice.left, &lattice.right);
    Ok((lattice.two_polar().placement(), first * y * second.transpose()))
}

impl<const N: usize> Lattice<N> {
    /// The couplings that do not move and the state with frames, as the model's equations read them.
    pub fn framed<M: LatticeForm<N>>(&self) -> (M::Couplings<f64>, M::Framed<f64>) {
        let mut couplings = M::Couplings::<f64>::zeros();
        let mut state = M::Framed::<f64>::zeros();
        let skew: [Vec2; 2] = [&self.m, &self.n].map(above_diagonal);
        let mut values = Values { into: state.as_mut(), at: 0 };
        let plain = M::LATTICE.variables == Variables::Stretches;
        (0..N).for_each(|a| values.push(if plain { libm::exp(self.q[a]) } else { self.q[a] }));
        (0..N).for_each(|a| values.push(if plain { self.p[a] * libm::exp(-self.q[a]) } else { self.p[a] }));
        if N == 2 {
            for (place, (entries, _)) in couplings.as_mut().iter_mut().zip(skew) {
                *place = entries[0];
            }
            for frame in [&self.left, &self.right] {
                values.push(libm::atan2(frame[(1, 0)], frame[(0, 0)]));
            }
        } else {
            skew.iter().for_each(|(entries, count)| entries[..*count].iter().for_each(|v| values.push(*v)));
            for frame in [&self.left, &self.right] {
                (0..N * N).for_each(|k| values.push(frame[(k / N, k % N)]));
            }
        }
        (couplings, state)
    }

    /// The couplings that do not move and the state without frames.
    pub fn places<M: LatticeForm<N>>(&self) -> (M::Couplings<f64>, M::Places<f64>) {
        let (couplings, framed) = self.framed::<M>();
        let mut places = M::Places::<f64>::zeros();
        let len = places.as_ref().len();
        places.as_mut().copy_from_slice(&framed.as_ref()[..len]);
        (couplings, places)
    }

    /// The lattice of such arrays. For `n = 3` the frames are brought back to SO(3).
    pub fn from_framed<M: LatticeForm<N>>(couplings: &M::Couplings<f64>, state: &M::Framed<f64>) -> Self {
        let values = state.as_ref();
        let plain = M::LATTICE.variables == Variables::Stretches;
        let places = Vector::<N>::from_fn(|a, _| values[a]);
        let momenta = Vector::<N>::from_fn(|a, _| values[N + a]);
        let pairs = N * (N - 1) / 2;
        let skew = |from: &[f64]| {
            let mut matrix = Matrix::<N>::zeros();
            let above = (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b)));
            for ((a, b), value) in above.zip(from) {
                matrix[(a, b)] = *value;
                matrix[(b, a)] = -value;
            }
            matrix
        };
        let frame = |from: usize| Matrix::<N>::from_fn(|i, j| values[from + N * i + j]);
        let turn = |angle: f64| {
            let (sine, cosine) = libm::sincos(angle);
            Matrix::<N>::from_fn(|i, j| match (i, j) {
                (0, 1) => -sine,
                (1, 0) => sine,
                _ => cosine,
            })
        };
        let (m, n, left, right) = if N == 2 {
            let couplings = couplings.as_ref();
            (skew(&couplings[..1]), skew(&couplings[1..]), turn(values[4]), turn(values[5]))
        } else {
            let (m, frames) = (2 * N, 2 * N + 2 * pairs);
            let [left, right] = [frames, frames + N * N].map(|from| orthogonalised(&frame(from)));
            (skew(&values[m..]), skew(&values[m + pairs..]), left, right)
        };
        Self {
            q: if plain { places.map(libm::log) } else { places },
            p: if plain { places.component_mul(&momenta) } else { momenta },
            m,
            n,
            left,
            right,
        }
    }
}

/// Is the placement of such a state [far from the undeformed one](far_from_undeformed)?
pub fn far_on_axes<const N: usize, M: LatticeForm<N>, T: Real>(state: &M::Places<T>) -> bool {
    let places = state.as_ref();
    let plain = M::LATTICE.variables == Variables::Stretches;
    let stretches = Vector::<N, T>::from_fn(|a, _| if plain { places[a] } else { places[a].exp() });
    far_from_undeformed(&Matrix::from_diagonal(&stretches))
}

/// From a defect of a tenth to rounding.
const NEWTON_STEPS: u32 = 5;

/// Up to three entries and their number.
type Vec2 = ([f64; 3], usize);

fn above_diagonal<const N: usize>(matrix: &Matrix<N>) -> Vec2 {
    let mut entries = ([0.0; 3], 0);
    for (a, b) in (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b))) {
        entries.0[entries.1] = matrix[(a, b)];
        entries.1 += 1;
    }
    entries
}

/// Fills an array from its start.
struct Values<'a> {
    into: &'a mut [f64],
    at: usize,
}

impl Values<'_> {
    fn push(&mut self, value: f64) {
        if let Some(place) = self.into.get_mut(self.at) {
            *place = value;
        }
        self.at += 1;
    }
}

/// The orthogonal polar factor by Newton steps `F (3 - F^T F)/2`: one, and others while the defect before was such that its square
/// is more than rounding.
fn orthogonalised<const N: usize>(frame: &Matrix<N>) -> Matrix<N> {
    let mut frame = *frame;
    for _ in 0..NEWTON_STEPS {
        let green = frame.tr_mul(&frame);
        frame *= Matrix::<N>::from_diagonal_element(1.5) - green * 0.5;
        if (green - Matrix::<N>::identity()).norm_squared() <= f64::EPSILON {
            break;
        }
    }
    frame
}

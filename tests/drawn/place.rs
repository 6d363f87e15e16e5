//! Random placements, positions and times, and the measures of deformation there by their definitions.

use affine_oracle::Random;
use affine_runtime::scalar::Scalar;
use qd::Quad;

use super::number::{Dual, Rounded, size};

/// A square matrix.
pub(crate) type Square<T> = Vec<Vec<T>>;

pub(crate) fn square<T>(n: usize, entry: impl Fn(usize, usize) -> T) -> Square<T> {
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// `a b`.
pub(crate) fn product(a: &Square<Quad>, b: &Square<Quad>) -> Square<Quad> {
    square(a.len(), |i, j| (0..a.len()).fold(Quad::ZERO, |sum, k| sum + a[i][k] * b[k][j]))
}

/// The same with derivatives.
pub(crate) fn dual_product(a: &Square<Dual>, b: &Square<Dual>) -> Square<Dual> {
    square(a.len(), |i, j| sum((0..a.len()).map(|k| a[i][k].times(&b[k][j]))))
}

pub(crate) fn sum(terms: impl Iterator<Item = Dual>) -> Dual {
    terms.fold(Dual::constant(Quad::ZERO), |sum, term| sum.plus(&term))
}

/// `a v`.
pub(crate) fn applied(a: &Square<Quad>, v: &[Quad]) -> Vec<Quad> {
    a.iter().map(|row| (0..v.len()).fold(Quad::ZERO, |sum, j| sum + row[j] * v[j])).collect()
}

/// `a^-1`, by elimination with the largest pivots.
pub(crate) fn inverse(a: &Square<Quad>) -> Square<Quad> {
    let n = a.len();
    let unit = |i: usize, j: usize| if i == j { Quad::ONE } else { Quad::ZERO };
    let mut rows: Square<Quad> =
        (0..n).map(|i| (0..2 * n).map(|j| if j < n { a[i][j] } else { unit(i, j - n) }).collect()).collect();
    for k in 0..n {
        let largest = (k..n).max_by(|i, j| size(rows[*i][k]).total_cmp(&size(rows[*j][k]))).expect("rows");
        rows.swap(k, largest);
        let pivot = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = if i == k { (row[k] - Quad::ONE) / pivot[k] } else { row[k] / pivot[k] };
            row.iter_mut().zip(&pivot).for_each(|(entry, pivot)| *entry -= factor * *pivot);
        }
    }
    rows.into_iter().map(|row| row[n..].to_vec()).collect()
}

pub(crate) fn transposed(a: &Square<Quad>) -> Square<Quad> {
    square(a.len(), |i, j| a[j][i])
}

/// A multiple of `1/1024` between the bounds: a double, exactly.
pub(crate) fn short(random: &mut Random, low: f64, high: f64) -> f64 {
    let steps = |bound: f64| (bound * 1024.0) as i64;
    random.integer(steps(low), steps(high)) as f64 / 1024.0
}

/// Where an energy is evaluated.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    pub(crate) t: Quad,
    pub(crate) x: Vec<Quad>,
    pub(crate) phi: Square<Quad>,
    /// Values of the fields `a` and `b`.
    pub(crate) fields: [Quad; 2],
}

impl Place {
    /// A placement strained by up to this, the centre away from the origin.
    pub(crate) fn random(random: &mut Random, n: usize, strain: f64) -> Self {
        let mut number = |low, high| Quad::from(short(random, low, high));
        let t = number(0.1, 2.0);
        let x = (0..n).map(|_| number(0.3, 1.5)).collect();
        let fields = [number(0.5, 1.5), number(0.5, 1.5)];
        let mut phi = square(n, |i, j| if i == j { Quad::ONE } else { Quad::ZERO });
        phi.iter_mut().flatten().for_each(|entry| *entry += number(-strain, strain));
        Self { t, x, phi, fields }
    }

    pub(crate) fn dim(&self) -> usize {
        self.phi.len()
    }

    /// `det phi`, by the first row.
    pub(crate) fn det(&self) -> Quad {
        let phi = square(self.dim(), |i, a| Dual::constant(self.phi[i][a]));
        determinant(&phi).value.value
    }
}

/// `det a` by the first row.
pub(crate) fn determinant(a: &Square<Dual>) -> Dual {
    if let [row] = a.as_slice() {
        return row[0];
    }
    let minor = |j: usize| -> Square<Dual> {
        let without = |row: &Vec<Dual>| (0..a.len()).filter(|k| *k != j).map(|k| row[k]).collect();
        a[1..].iter().map(without).collect()
    };
    let term = |j: usize| {
        let term = a[0][j].times(&determinant(&minor(j)));
        if j.is_multiple_of(2) { term } else { term.negated() }
    };
    (1..a.len()).fold(term(0), |sum, j| sum.plus(&term(j)))
}

/// The principal stretches and axes of a placement: `phi R = W = L diag(Q)`.
#[derive(Clone, Debug)]
pub(crate) struct Principal {
    pub(crate) stretches: Vec<Quad>,
    /// `W`, by columns `W[.][a]`.
    pub(crate) stretched: Square<Quad>,
    /// `R`, likewise.
    pub(crate) axes: Square<Quad>,
}

impl Principal {
    /// By rotations of Jacobi that make `G = phi^T phi` diagonal.
    pub(crate) fn of(phi: &Square<Quad>) -> Self {
        let n = phi.len();
        let mut green = product(&transposed(phi), phi);
        let mut axes = square(n, |i, j| if i == j { Quad::ONE } else { Quad::ZERO });
        for _ in 0..12 {
            for (a, b) in (0..n).flat_map(|a| (a + 1..n).map(move |b| (a, b))) {
                let turn = rotation(&green, a, b);
                green = product(&transposed(&turn), &product(&green, &turn));
                axes = product(&axes, &turn);
            }
        }
        let stretches = (0..n).map(|a| Scalar::sqrt(green[a][a])).collect();
        Self { stretches, stretched: product(phi, &axes), axes }
    }

    /// `ln Q_a` with its derivatives: `dQ_a = L_a . dphi R_a`. Axes are as much worse known as stretches are close.
    fn logarithm(&self, a: usize, phi: &Square<Dual>) -> Dual {
        let (n, stretch) = (phi.len(), self.stretches[a]);
        let others = (0..n).filter(|b| *b != a).map(|b| self.stretches[b]);
        let closeness: f64 = others.map(|other| size((stretch + other) / (stretch - other))).sum();
        let mut logarithm = Dual::constant(Scalar::ln(stretch));
        let norm: f64 = phi.iter().flatten().map(|entry| entry.value.error).sum();
        logarithm.value.error += norm / size(stretch);
        for (i, k) in (0..n).flat_map(|i| (0..n).map(move |k| (i, k))) {
            let value = self.stretched[i][a] * self.axes[k][a] / (stretch * stretch);
            let slope = Rounded { value, error: (4.0 + closeness) * norm / size(stretch * stretch) };
            logarithm.slopes =
                std::array::from_fn(|d| logarithm.slopes[d].plus(phi[i][k].slopes[d].times(slope)));
        }
        logarithm
    }
}

/// The rotation in a plane after which the entry vanishes.
fn rotation(green: &Square<Quad>, a: usize, b: usize) -> Square<Quad> {
    let n = green.len();
    let unit = square(n, |i, j| if i == j { Quad::ONE } else { Quad::ZERO });
    // Below all digits of the diagonal.
    if size(green[a][b]) < 1e-40 * size(green[a][a] + green[b][b]) {
        return unit;
    }
    let theta = (green[b][b] - green[a][a]) / (green[a][b] + green[a][b]);
    let root = Scalar::sqrt(theta * theta + Quad::ONE);
    let tangent = Scalar::copysign(Quad::ONE, theta) / (Scalar::abs(theta) + root);
    let cosine = Quad::ONE / Scalar::sqrt(tangent * tangent + Quad::ONE);
    let sine = tangent * cosine;
    let mut turn = unit;
    (turn[a][a], turn[b][b], turn[a][b], turn[b][a]) = (cosine, cosine, sine, -sine);
    turn
}

/// Everything that an energy can name, with derivatives.
pub(crate) struct Measures {
    pub(crate) t: Dual,
    pub(crate) x: Vec<Dual>,
    pub(crate) phi: Square<Dual>,
    pub(crate) green: Square<Dual>,
    pub(crate) finger: Square<Dual>,
    pub(crate) det: Dual,
    /// `q_a`; what stretches cost only where an energy names them.
    pub(crate) log_stretches: Vec<Dual>,
    pub(crate) fields: [Dual; 2],
}

impl Measures {
    pub(crate) fn at(place: &Place, stretched: bool) -> Self {
        let n = place.dim();
        let x: Vec<Dual> = (0..n).map(|i| Dual::coordinate(place.x[i], 1 + i)).collect();
        let phi = square(n, |i, a| Dual::coordinate(place.phi[i][a], 4 + n * i + a));
        let dot = |term: &dyn Fn(usize) -> Dual| (1..n).fold(term(0), |sum, k| sum.plus(&term(k)));
        let green = square(n, |a, b| dot(&|i| phi[i][a].times(&phi[i][b])));
        let finger = square(n, |i, j| dot(&|a| phi[i][a].times(&phi[j][a])));
        let log_stretches = match stretched {
            false => Vec::new(),
            true => {
                let principal = Principal::of(&place.phi);
                (0..n).map(|a| principal.logarithm(a, &phi)).collect()
            }
        };
        Self {
            t: Dual::coordinate(place.t, 0),
            det: determinant(&phi),
            fields: place.fields.map(Dual::constant),
            x,
            phi,
            green,
            finger,
            log_stretches,
        }
    }
}

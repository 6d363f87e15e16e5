//! `R_F` of the squared stretches of a placement, in straight-line code for any [`Scalar`]: the energy of a homogeneous ellipsoid
//! in its own gravity.
//!
//! It is a smooth function of `|phi|^2`, `|cof phi|^2` and `det phi` also where stretches coincide, of which each alone is none,
//! and duplication is written in these three. All slopes by them are negative, and so are all parts of each: nothing cancels, and
//! the derivative by each stretch keeps its digits for axes in proportions up to 1e8.

use core::array::from_fn;

use crate::scalar::Scalar;

type Rows<T> = [[T; 3]; 3];

/// The coefficients of the series of order seven, `1/10`, `1/14`, `1/24`, `3/44`, `5/208` and `3/104`, and a third, as sums of two
/// doubles.
const SERIES: [(f64, f64); 7] = [
    (0.1, -5.551115123125783e-18),
    (0.07142857142857142, 3.96508223080413e-18),
    (0.041666666666666664, 2.3129646346357427e-18),
    (0.06818181818181818, 5.046468293750712e-18),
    (0.02403846153846154, -1.3344026738283132e-18),
    (0.028846153846153848, -1.6012832085939759e-18),
    (0.3333333333333333, 1.850371707708594e-17),
];

/// Steps of Newton's iteration at each duplication. Eight of them bring the arguments so close to their mean that the series is
/// exact to 16 digits for axes in proportions up to 1e8, and to 31 digits up to a hundred.
const NEWTON: [usize; 8] = [7, 6, 6, 5, 5, 4, 4, 3];

/// `R_F(Q_1^2, Q_2^2, Q_3^2)`.
#[inline]
#[must_use]
pub fn ellipsoidal<T: Scalar>(phi: Rows<T>) -> T {
    let (phi, scale) = scaled(phi);
    let mut axes = Axes::of(&phi, &cofactors(&phi));
    for steps in NEWTON {
        axes = Duplication::new(axes, steps).next;
    }
    axes.series().0 * scale
}

/// The derivatives of [`ellipsoidal`] by the entries of `phi`.
#[inline]
#[must_use]
pub fn ellipsoidal_slopes<T: Scalar>(phi: Rows<T>) -> Rows<T> {
    let (phi, scale) = scaled(phi);
    let cofactors = cofactors(&phi);
    let mut axes = Axes::of(&phi, &cofactors);
    let duplications = NEWTON.map(|steps| {
        let duplication = Duplication::new(axes, steps);
        axes = duplication.next;
        duplication
    });
    let (_, last) = axes.series();
    let slopes = duplications.iter().rev().fold(last, |slopes, duplication| duplication.before(&slopes));
    let twice = number::<T>(2.0);
    from_fn(|i| {
        from_fn(|a| {
            let of_squares = slopes.first * phi[i][a] + slopes.second * crossed(&phi, &cofactors, i, a);
            (twice * of_squares + slopes.volume * cofactors[i][a]) * (scale * scale)
        })
    })
}

/// `Q_1^2 + Q_2^2 + Q_3^2`, `Q_1^2 Q_2^2 + ..` and `Q_1 Q_2 Q_3` of half axes; or the slopes of `R_F` by them.
#[derive(Clone, Copy)]
struct Axes<T> {
    first: T,
    second: T,
    volume: T,
}

impl<T: Scalar> Axes<T> {
    fn of(phi: &Rows<T>, cofactors: &Rows<T>) -> Self {
        let volume = (0..3).fold(T::zero(), |sum, a| phi[0][a].fma(cofactors[0][a], sum));
        Self { first: square(phi), second: square(cofactors), volume }
    }

    /// `R_F` of axes that are close to each other, and its slopes (NIST DLMF 19.36.1).
    fn series(&self) -> (T, Self) {
        let one = T::one();
        let over_mean = number::<T>(3.0) / self.first;
        let (cubed, root) = (over_mean * over_mean * over_mean, over_mean.sqrt());
        let (pairs, product) = (self.second * (over_mean * over_mean), self.volume * self.volume * cubed);
        // Of the relative distances from the mean, `1 - Q_a^2/mean`.
        let (e2, e3) = (pairs - number(3.0), pairs - number(2.0) - product);
        let [tenth, of_e3, of_e22, of_e23, of_e222, of_e33, third] =
            SERIES.map(|(hi, lo)| T::constant(hi, lo));
        let (e22, half) = (e2 * e2, number::<T>(0.5));
        let value = one - e2 * tenth + e3 * of_e3 + e22 * of_e22 - e2 * e3 * of_e23 - e22 * e2 * of_e222
            + e3 * e3 * of_e33
            + e22 * e3 * number(0.0625);
        let by_e2 = e2 * (of_e22 + of_e22) - tenth - e3 * of_e23 - e22 * (of_e222 * number(3.0))
            + e2 * e3 * number(0.125);
        let by_e3 = of_e3 - e2 * of_e23 + e3 * (of_e33 + of_e33) + e22 * number(0.0625);
        let both = by_e2 + by_e3;
        let by_mean = number::<T>(3.0) * product * by_e3 - value * half - number::<T>(2.0) * pairs * both;
        let slopes = Self {
            first: by_mean * root * over_mean * third,
            second: both * root * (over_mean * over_mean),
            volume: -(by_e3 * number(2.0) * self.volume * root * cubed),
        };
        (value * root, slopes)
    }
}

/// `Q_a^2 -> (Q_a^2 + lambda)/4`, which leaves `R_F` as it is, with `lambda = Q_1 Q_2 + Q_2 Q_3 + Q_3 Q_1`.
#[derive(Clone, Copy)]
struct Duplication<T> {
    axes: Axes<T>,
    lambda: T,
    /// `Q_1 + Q_2 + Q_3`
    sum: T,
    next: Axes<T>,
}

impl<T: Scalar> Duplication<T> {
    /// `lambda` is the solution of `lambda^2 = second + 2 volume sqrt(first + 2 lambda)`, from `sqrt(3 second)` above it, which is
    /// that of equal axes, and never the double of it.
    fn new(axes: Axes<T>, steps: usize) -> Self {
        let Axes { first, second, volume } = axes;
        let (two, three) = (number::<T>(2.0), number::<T>(3.0));
        let mut lambda = (three * second).sqrt();
        for _ in 0..steps {
            let sum = two.fma(lambda, first).sqrt();
            let defect = lambda.fma(lambda, -second) - two * volume * sum;
            lambda -= defect / (two * (lambda - volume / sum));
        }
        let cubic = lambda.fma(lambda.fma(first + lambda, second), volume * volume);
        let next = Axes {
            first: three.fma(lambda, first) * number(0.25),
            second: lambda.fma(two.fma(first, three * lambda), second) * number(0.0625),
            volume: cubic.sqrt() * number(0.125),
        };
        Self { axes, lambda, sum: two.fma(lambda, first).sqrt(), next }
    }

    /// Slopes by the axes, from those by the next ones.
    fn before(&self, next: &Axes<T>) -> Axes<T> {
        let Self { axes: Axes { first, second, volume }, lambda, sum, next: after } = *self;
        let (two, three) = (number::<T>(2.0), number::<T>(3.0));
        let of_cubic = next.volume / (number::<T>(128.0) * after.volume);
        let of_second = next.second * number(0.125);
        let of_lambda = next.first * number(0.75)
            + of_second * three.fma(lambda, first)
            + of_cubic * lambda.fma(two * first + three * lambda, second);
        let share = of_lambda / (two * (lambda - volume / sum));
        Axes {
            first: next.first * number(0.25)
                + of_second * lambda
                + of_cubic * lambda * lambda
                + share * volume / sum,
            second: next.second * number(0.0625) + of_cubic * lambda + share,
            volume: two * (of_cubic * volume + share * sum),
        }
    }
}

/// `phi/|phi|` and `1/|phi|`.
fn scaled<T: Scalar>(phi: Rows<T>) -> (Rows<T>, T) {
    let scale = T::one() / square(&phi).sqrt();
    (phi.map(|row| row.map(|entry| entry * scale)), scale)
}

fn square<T: Scalar>(rows: &Rows<T>) -> T {
    rows.as_flattened().iter().fold(T::zero(), |sum, entry| entry.fma(*entry, sum))
}

fn cofactors<T: Scalar>(phi: &Rows<T>) -> Rows<T> {
    from_fn(|i| {
        from_fn(|a| {
            let ([j, k], [b, c]) = (others(i), others(a));
            phi[j][b].fma(phi[k][c], -(phi[j][c] * phi[k][b]))
        })
    })
}

/// Half the derivative of `|cof phi|^2` by the entry `(i, a)`: a sum over cofactors of pairs of rows and columns.
fn crossed<T: Scalar>(phi: &Rows<T>, cofactors: &Rows<T>, i: usize, a: usize) -> T {
    let ([j, k], [b, c]) = (others(i), others(a));
    let along = phi[j][b].fma(cofactors[k][c], phi[k][c] * cofactors[j][b]);
    along - phi[j][c].fma(cofactors[k][b], phi[k][b] * cofactors[j][c])
}

fn others(i: usize) -> [usize; 2] {
    [(i + 1) % 3, (i + 2) % 3]
}

fn number<T: Scalar>(value: f64) -> T {
    T::constant(value, 0.0)
}

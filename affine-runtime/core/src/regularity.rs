//! Mass matrices that depend on the placement: is one regular, and of which signature?

use crate::error::{Error, IllPosed, Result};

/// A pivot below this part of the summands that it is a difference of has no digit left.
const LEAST_PIVOT: f64 = 64.0 * f64::EPSILON;

/// Signs and quality of the factorisation `K = L D L^T` of a mass matrix `K(phi)`.
///
/// `D` has as many negative entries as `K` has negative squares (Sylvester). It is the factorisation that the equations
/// of motion use, without exchange of rows: along a motion it fails exactly where an entry of `D` vanishes, which for a
/// positive definite `K` is where `K` becomes degenerate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regularity {
    /// Number of negative squares.
    pub negative: usize,
    /// The least `|D_k|` relative to the sizes of the summands that it is a difference of: 1 without any cancellation,
    /// 0 where `K` is degenerate; NaN where `K` is not finite.
    pub weakest: f64,
}

impl Regularity {
    /// That of the upper triangle of a `K x K` matrix, row after row, with the sizes of the summands of its diagonal
    /// entries; `M = K (K + 1)/2`.
    #[must_use]
    pub fn of<const K: usize, const M: usize>(upper: [f64; M], sizes: [f64; K]) -> Self {
        let at = |i: usize, j: usize| i * K - i * (i + 1) / 2 + j;
        let mut rest = upper;
        let mut sizes = sizes;
        let mut found = Self { negative: 0, weakest: 1.0 };
        for k in 0..K {
            let pivot = rest[at(k, k)];
            let weakest = if pivot == 0.0 { 0.0 } else { pivot.abs() / sizes[k] };
            found = found.and(Self { negative: usize::from(pivot < 0.0), weakest });
            for i in k + 1..K {
                let factor = rest[at(k, i)] / pivot;
                sizes[i] += (factor * rest[at(k, i)]).abs();
                for j in i..K {
                    rest[at(i, j)] -= factor * rest[at(k, j)];
                }
            }
        }
        found
    }

    /// That of a matrix of two blocks.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        // NaN stays, and so does 0: what follows it is divided by 0.
        let stays = self.weakest.is_nan() || self.weakest == 0.0 || self.weakest <= other.weakest;
        let weakest = if stays { self.weakest } else { other.weakest };
        Self { negative: self.negative + other.negative, weakest }
    }

    /// The momentum determines the velocity, to rounding.
    #[must_use]
    pub fn is_regular(&self) -> bool {
        self.weakest > LEAST_PIVOT
    }
}

/// Refuses a placement at which the mass matrix is degenerate, or not positive definite on demand; `None` is regular.
///
/// # Errors
/// [`Error::IllPosed`] with the weakest pivot, or with the number of negative squares.
pub fn regular(regularity: Option<Regularity>, positive: bool) -> Result<()> {
    let Some(found) = regularity else { return Ok(()) };
    if !found.is_regular() {
        return Err(Error::IllPosed(IllPosed {
            condition: "det K(phi) != 0",
            reason: "the mass matrix is degenerate at this placement, and the momentum does not determine the velocity; \
                     start from another placement, or change the coefficients",
            value: found.weakest,
            threshold: LEAST_PIVOT,
            velocity: None,
        }));
    }
    if positive && found.negative > 0 {
        return Err(Error::IllPosed(IllPosed {
            condition: "K(phi) > 0",
            reason: "`require(positive_definite)` asks for it, and the value is the number of negative squares at this \
                     placement; start from another placement, or change the coefficients",
            value: found.negative as f64,
            threshold: 0.0,
            velocity: None,
        }));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `diag(2, -1/2, 3)` after the shear `x -> x + y`, and its signature.
    #[test]
    fn signs_survive_a_shear() {
        let found = Regularity::of::<3, 6>([2.0, 2.0, 0.0, 1.5, 0.0, 3.0], [2.0, 1.5, 3.0]);
        assert_eq!(found.negative, 1);
        assert!((found.weakest - 0.5 / 3.5).abs() < 1e-15, "{found:?}");
    }

    #[test]
    fn a_degenerate_matrix_has_no_pivot_left() {
        // [[1, 3], [3, 9]]
        let found = Regularity::of::<2, 3>([1.0, 3.0, 9.0], [1.0, 9.0]);
        assert!(!found.is_regular() && found.weakest == 0.0);
        // A pivot before the last, and all of them.
        assert_eq!(Regularity::of::<2, 3>([0.0, 3.0, 9.0], [1.0, 9.0]).weakest, 0.0);
        assert_eq!(Regularity::of::<3, 6>([0.0; 6], [2.0; 3]).weakest, 0.0);
        assert_eq!(Regularity::of::<1, 1>([0.0], [0.0]).weakest, 0.0);
        // The first pivot is a difference that cancels.
        assert!(!Regularity::of::<1, 1>([1e-16], [2.0]).is_regular());
        assert!(!Regularity::of::<1, 1>([f64::NAN], [1.0]).is_regular());
        assert!(!Regularity::of::<2, 3>([f64::NAN, 0.0, 1.0], [1.0, 1.0]).is_regular());
    }

    #[test]
    fn blocks_add_their_signs() {
        let block = Regularity::of::<1, 1>([-1.0], [1.0]);
        let both = block.and(Regularity { negative: 1, weakest: 0.25 });
        assert_eq!(both, Regularity { negative: 2, weakest: 0.25 });
    }

    #[test]
    fn refusals_name_their_condition() {
        let refused = |found: Regularity, positive| match regular(Some(found), positive) {
            Err(Error::IllPosed(defect)) => Some(defect.condition),
            _ => None,
        };
        assert_eq!(refused(Regularity { negative: 0, weakest: 1e-17 }, false), Some("det K(phi) != 0"));
        assert_eq!(refused(Regularity { negative: 2, weakest: 0.5 }, true), Some("K(phi) > 0"));
        assert_eq!(refused(Regularity { negative: 2, weakest: 0.5 }, false), None);
        assert!(regular(None, true).is_ok());
    }
}

//! What vectors modulo a prime span, and what vanishes on all of them.

use super::evaluate::Field;
use super::rational::Rational;
use super::residue::Residue;
use super::ring::Ring;

/// Vectors of one length in reduced echelon form, each with the place of its leading 1.
#[derive(Clone, Debug, Default)]
pub struct Span(Vec<(usize, Vec<Residue>)>);

impl Span {
    /// Takes a vector in; `false` where it lies in the span already. With an entry of which nothing is known it may be any vector:
    /// then all are taken in.
    pub fn insert(&mut self, vector: &[Residue]) -> bool {
        if vector.contains(&Residue::UNKNOWN) {
            let before = self.dimension();
            for place in 0..vector.len() {
                let mut unit = vec![Residue::ZERO; vector.len()];
                unit[place] = Residue::from_rational(&Rational::ONE);
                self.insert(&unit);
            }
            return self.dimension() > before;
        }
        let mut vector = vector.to_vec();
        for (leading, row) in &self.0 {
            subtract(&mut vector, *leading, row);
        }
        let Some(leading) = vector.iter().position(|entry| entry.is_nonzero()) else { return false };
        let Some(scale) = vector[leading].recip() else { return false };
        vector.iter_mut().for_each(|entry| *entry = entry.mul(&scale));
        for (_, row) in &mut self.0 {
            subtract(row, leading, &vector);
        }
        self.0.push((leading, vector));
        true
    }

    /// Takes vectors in, one after the other.
    pub fn extend(&mut self, vectors: &[Vec<Residue>]) {
        for vector in vectors {
            self.insert(vector);
        }
    }

    /// How many of the vectors that were taken in do not follow from others.
    pub fn dimension(&self) -> usize {
        self.0.len()
    }

    /// A basis of the vectors of `length` entries whose scalar products with the span vanish: a unit vector for each place
    /// where all of the span is zero.
    pub fn annihilators(&self, length: usize) -> Vec<Vec<Residue>> {
        let is_free = |place: &usize| self.0.iter().all(|(leading, _)| leading != place);
        let annihilator = |free: usize| {
            let mut vector = vec![Residue::ZERO; length];
            vector[free] = Residue::from_rational(&Rational::ONE);
            for (leading, row) in &self.0 {
                vector[*leading].plus(&row[free], &Rational::MINUS_ONE);
            }
            vector
        };
        (0..length).filter(is_free).map(annihilator).collect()
    }
}

/// Takes off the multiple of a row that its leading 1 asks for.
fn subtract(vector: &mut [Residue], leading: usize, row: &[Residue]) {
    let factor = vector[leading];
    if !factor.is_nonzero() {
        return;
    }
    let factor = factor.mul(&Residue::from_rational(&Rational::MINUS_ONE));
    for (entry, above) in vector.iter_mut().zip(row) {
        *entry = entry.add(&factor.mul(above));
    }
}

/// The vector of small whole numbers without a common factor that a vector is a multiple of; `None` where none is found.
pub fn whole_multiple(vector: &[Residue]) -> Option<Vec<i64>> {
    let mut common = 1_i64;
    let mut fractions = Vec::with_capacity(vector.len());
    for entry in vector {
        let (above, below) = entry.small_fraction()?;
        common = common.checked_mul(below / greatest_divisor(common, below))?;
        fractions.push((above, below));
    }
    let whole = fractions.iter().map(|(above, below)| above.checked_mul(common / below));
    let whole: Vec<i64> = whole.collect::<Option<_>>()?;
    let divisor = whole.iter().fold(0, |divisor, entry| greatest_divisor(divisor, *entry));
    let first = whole.iter().find(|entry| **entry != 0)?;
    let divisor = divisor * first.signum();
    Some(whole.iter().map(|entry| entry / divisor).collect())
}

fn greatest_divisor(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { greatest_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vector(entries: &[(i64, i64)]) -> Vec<Residue> {
        let residue =
            |(above, below): &(i64, i64)| Rational::ratio(*above, *below).map(|r| Residue::from_rational(&r));
        entries.iter().filter_map(residue).collect()
    }

    #[test]
    fn annihilators_by_hand() {
        let mut span = Span::default();
        assert!(span.insert(&vector(&[(1, 1), (2, 1), (0, 1), (3, 1)])));
        assert!(span.insert(&vector(&[(1, 1), (1, 1), (0, 1), (1, 1)])));
        assert!(!span.insert(&vector(&[(3, 1), (5, 1), (0, 1), (7, 1)])), "the second and twice the first");
        assert_eq!(span.dimension(), 2);
        let found: Vec<_> = span.annihilators(4).iter().map(|v| whole_multiple(v)).collect();
        assert_eq!(found, [Some(vec![0, 0, 1, 0]), Some(vec![1, -2, 0, 1])]);
    }

    /// Names that differ in one letter have values that nothing ties to each other.
    #[test]
    fn samples_are_independent() {
        let mut span = Span::default();
        for point in 0..8 {
            let value = |name: &str| Residue::sample(&format!("{name} at point {point}"));
            assert!(
                span.insert(&["x_1", "x_2", "x_3", "p_1", "p_2", "p_3", "phi_11", "phi_12"].map(value)),
                "{point}"
            );
        }
    }

    #[test]
    fn nothing_vanishes_on_what_is_not_known() {
        let mut span = Span::default();
        assert!(span.insert(&[Residue::ZERO, Residue::UNKNOWN, Residue::ZERO]));
        assert!(span.annihilators(3).is_empty());
    }

    #[test]
    fn fractions_are_read_back() {
        let read = |entries: &[(i64, i64)]| whole_multiple(&vector(entries));
        assert_eq!(read(&[(-2, 3), (0, 1), (5, 6)]), Some(vec![4, 0, -5]));
        assert_eq!(read(&[(30_000, 1), (1, 29_999)]), Some(vec![30_000 * 29_999, 1]));
        assert_eq!(read(&[(1_000_003, 999_983)]), None, "as long as what stands for an irrational number");
        assert_eq!(whole_multiple(&[Residue::sample("a"), Residue::sample("b")]), None);
    }
}

//! Sums of entries in orthonormal bases, as sums of those in the bases that the user states the model in.
//!
//! An inertia is rational in orthonormal bases where the roots that lead there are not: what it conserves is seen there alone.

use crate::algebra::Rational;
use crate::algebra::evaluate::Field;
use crate::algebra::residue::Residue;
use crate::algebra::ring::transpose;
use crate::algebra::span::whole_multiple;
use crate::mechanics::metrics::Bases;

use super::candidate::{Candidate, Entry};

/// Bits to which numbers agree that are one: roots are correct to more than 106.
const AGREE: i64 = 90;

/// The sum in the user's bases; `None` where its factors have no ratios of small whole numbers.
pub(super) fn restated(bases: &Bases, entries: &[Entry]) -> Option<Vec<Entry>> {
    let mut sums: Vec<(Entry, Rational)> = Vec::new();
    for entry in entries {
        for (place, weight) in weights(bases, entry) {
            let weight = &weight * &Rational::from(entry.factor);
            match sums.iter_mut().find(|(known, _)| *known == place) {
                Some((_, sum)) => *sum = &*sum + &weight,
                None => sums.push((place, weight)),
            }
        }
    }
    let (_, largest) = sums.iter().max_by_key(|(_, weight)| weight.abs())?;
    let ratios = sums.iter().map(|(_, weight)| small(&weight.checked_div(largest)?));
    let ratios: Vec<Residue> =
        ratios.map(|ratio| Some(Residue::from_rational(&ratio?))).collect::<Option<_>>()?;
    let named = whole_multiple(&ratios)?.into_iter().zip(sums).filter(|(factor, _)| *factor != 0);
    Some(named.map(|(factor, (entry, _))| Entry { factor, ..entry }).collect())
}

/// The entries in the user's bases that an entry in orthonormal ones is a sum of, `m' = L m R`, and how often.
fn weights(Bases { space, body }: &Bases, entry: &Entry) -> Vec<(Entry, Rational)> {
    let (a, a_inverse, b, b_inverse) = (&space.matrix, &space.inverse, &body.matrix, &body.inverse);
    let one = || vec![vec![Rational::ONE]];
    let (left, right, is_skew) = match entry.of {
        Candidate::LinearMomentum => (transpose(a_inverse), one(), false),
        Candidate::ComovingLinearMomentum => (transpose(b_inverse), one(), false),
        Candidate::Spin | Candidate::OrbitalAngularMomentum | Candidate::TotalAngularMomentum => {
            (transpose(a_inverse), a_inverse.clone(), true)
        }
        Candidate::Vorticity => (b.clone(), transpose(b), true),
        Candidate::ComovingAffineSpin => (b.clone(), b_inverse.clone(), false),
        Candidate::CanonicalMomentum => (b.clone(), a_inverse.clone(), false),
        _ => (a.clone(), a_inverse.clone(), false),
    };
    let weight = |i: usize, j: usize| &left[entry.row - 1][i] * &right[j][entry.column - 1];
    let places = (0..left.len()).flat_map(|i| (0..right.len()).map(move |j| (i, j)));
    let places = places.filter(|(i, j)| !is_skew || i < j);
    let all = places.map(|(i, j)| {
        let weight = if is_skew { &weight(i, j) - &weight(j, i) } else { weight(i, j) };
        (Entry { factor: 1, of: entry.of, row: i + 1, column: j + 1 }, weight)
    });
    all.filter(|(_, weight)| !weight.is_zero()).collect()
}

/// The fraction of small numbers that a number of at most 1 is.
fn small(value: &Rational) -> Option<Rational> {
    let (about, _) = value.to_doubles();
    let near = |below: i64| {
        let above = about * below as f64;
        if (above - above.round()).abs() > 1e-9 {
            return None;
        }
        let fraction = Rational::ratio(above.round() as i64, below)?;
        let distance = value - &fraction;
        (distance.is_zero() || distance.binary_exponent() < -AGREE).then_some(fraction)
    };
    (1..=Residue::SMALL).find_map(near)
}

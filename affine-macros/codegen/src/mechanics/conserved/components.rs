//! Which combinations of entries of momenta are conserved where no momentum is as a whole.

use crate::algebra::evaluate::Field;
use crate::algebra::residue::Residue;
use crate::algebra::ring::dot;
use crate::algebra::span::{Span, whole_multiple};

use crate::mechanics::group_point::POINTS;
use crate::mechanics::metrics::Bases;

use super::candidate::{Candidate, Entry};
use super::momenta::{Combination, Factors, Layout, Momenta};
use super::restated::restated;

/// What is looked at together, in turn: a combination is listed by the first that name it. Translations and rotations of space
/// and of the body are looked at all together, affine momenta each for itself.
const TOGETHER: [&[Candidate]; 11] = [
    &[Candidate::LinearMomentum],
    &[Candidate::Spin],
    &[Candidate::OrbitalAngularMomentum],
    &[Candidate::TotalAngularMomentum],
    &[Candidate::Vorticity],
    &[Candidate::LinearMomentum, Candidate::Spin, Candidate::OrbitalAngularMomentum, Candidate::Vorticity],
    &[Candidate::AffineSpin],
    &[Candidate::TotalAffineMomentum],
    &[Candidate::ComovingAffineSpin],
    &[Candidate::CanonicalMomentum],
    &[Candidate::ComovingLinearMomentum],
];

/// Rates of the momenta of a motion: what they annihilate is conserved.
#[derive(Clone, Debug)]
pub(super) struct Rates {
    layout: Layout,
    /// By entries in the user's bases, and where these are not orthonormal by entries in orthonormal ones.
    together: [Vec<Together>; 2],
}

/// Entries of momenta that are looked at together, and the span of their rates.
#[derive(Clone, Debug)]
struct Together {
    entries: Vec<(Entry, Combination)>,
    rates: Span,
}

impl Rates {
    /// Of those of the momenta that exist, where nothing moves.
    pub(super) fn none(layout: Layout, exist: &[Candidate], are_orthonormal: bool) -> Self {
        let together = |layout: Layout| {
            TOGETHER.map(|momenta| {
                let momenta = momenta.iter().filter(|momentum| exist.contains(momentum));
                let entries = momenta.flat_map(|of| {
                    let entries = layout.entries(*of).into_iter();
                    entries.map(|((row, column), entry)| (Entry { factor: 1, of: *of, row, column }, entry))
                });
                Together { entries: entries.collect(), rates: Span::default() }
            })
        };
        let orthonormal = Layout { is_given: false, ..layout };
        let others = if are_orthonormal { Vec::new() } else { together(orthonormal).into() };
        Self { layout, together: [together(layout).into(), others] }
    }

    /// Those of a body whose centre moves?
    pub(super) fn moves(&self) -> bool {
        self.layout.moves
    }

    /// Takes rates in; `false` where they follow from those seen before.
    pub(super) fn see(&mut self, rates: &Momenta, factors: &Factors) -> bool {
        let mut is_new = false;
        for (together, rates) in self.together.iter_mut().zip([&rates.given(factors), rates]) {
            for Together { entries, rates: span } in together {
                if span.dimension() == entries.len() {
                    continue;
                }
                let rates: Vec<Residue> = entries.iter().map(|(_, entry)| rates.value(entry)).collect();
                is_new |= span.insert(&rates);
            }
        }
        is_new
    }

    /// The conserved combinations, without those that follow from others, vanish, or follow from momenta that are conserved as a
    /// whole. `bases` are those of metrics that are numbers. `values` gives the momenta at points where more ties them to each
    /// other than that `Sigma` and `Sigma_hat` have one trace.
    pub(super) fn components(
        &self,
        whole: &[Candidate],
        (factors, bases): (&Factors, Option<&Bases>),
        values: Option<&dyn Fn(usize) -> Momenta>,
    ) -> Vec<Vec<Entry>> {
        let unit = |place| Momenta::unit(self.layout, place);
        let orthonormal: Vec<Momenta> = (0..self.layout.len()).map(unit).collect();
        let given: Vec<Momenta> = orthonormal.iter().map(|unit| unit.given(factors)).collect();
        // Over orthonormal bases, where nothing stands in two places.
        let vector = |combination: &Combination| given.iter().map(|unit| unit.value(combination)).collect();
        let other =
            |combination: &Combination| orthonormal.iter().map(|unit| unit.value(combination)).collect();
        let whole = whole.iter().flat_map(|whole| self.layout.entries(*whole));
        let whole: Vec<Vec<Residue>> = whole.map(|(_, entry)| vector(&entry)).collect();
        let mut listed = Span::default();
        listed.insert(&vector(&self.layout.equal_traces()));
        listed.extend(&whole);
        let mut candidates: Vec<(Vec<Entry>, Vec<Residue>)> =
            self.together[0].iter().flat_map(|together| conserved(together, &vector)).collect();
        if let Some(bases) = bases {
            let others = self.together[1].iter().flat_map(|together| conserved(together, &other));
            candidates.extend(others.filter_map(|(sum, vector)| Some((restated(bases, &sum)?, vector))));
        }
        candidates.retain(|(_, vector)| listed.clone().insert(vector));
        if let Some(values) = values.filter(|_| !candidates.is_empty()) {
            let vectors: Vec<_> = candidates.iter().map(|(_, vector)| vector).chain(&whole).collect();
            listed.extend(&self.vanishing(&vectors, values));
        }
        candidates.retain(|(_, vector)| listed.insert(vector));
        candidates.into_iter().map(|(entries, _)| entries).collect()
    }

    /// Combinations of some vectors that are zero, by the momenta at points.
    fn vanishing(&self, vectors: &[&Vec<Residue>], values: &dyn Fn(usize) -> Momenta) -> Vec<Vec<Residue>> {
        let mut span = Span::default();
        until_nothing_is_new(|seed| {
            let momenta = values(seed);
            span.insert(
                &vectors.iter().map(|vector| dot(vector.iter().zip(momenta.list()))).collect::<Vec<_>>(),
            )
        });
        let combined = |factors: Vec<Residue>| {
            let mut sum = vec![Residue::ZERO; self.layout.len()];
            for (factor, vector) in factors.iter().zip(vectors) {
                sum.iter_mut().zip(*vector).for_each(|(sum, entry)| *sum = sum.add(&factor.mul(entry)));
            }
            sum
        };
        span.annihilators(vectors.len()).into_iter().map(combined).collect()
    }
}

/// A basis of the combinations of entries of some momenta that are conserved.
fn conserved(
    Together { entries, rates }: &Together,
    vector: &dyn Fn(&Combination) -> Vec<Residue>,
) -> Vec<(Vec<Entry>, Vec<Residue>)> {
    let combination = |factors: Vec<Residue>| {
        let factors = whole_multiple(&factors)?;
        let terms = || factors.iter().zip(entries).filter(|(factor, _)| **factor != 0);
        let scaled = |(factor, (_, entry)): (&i64, &(Entry, Combination))| -> Combination {
            entry.iter().map(|(own, place)| (factor * own, *place)).collect()
        };
        let vector = vector(&terms().flat_map(scaled).collect());
        Some((terms().map(|(factor, (entry, _))| Entry { factor: *factor, ..*entry }).collect(), vector))
    };
    rates.annihilators(entries.len()).into_iter().filter_map(combination).collect()
}

/// Asks at points modulo a prime, the first of which is 0, until as many as decide told nothing new one after another.
pub(super) fn until_nothing_is_new(mut tells_something: impl FnMut(usize) -> bool) {
    let mut told_nothing = 0;
    for seed in 0.. {
        told_nothing = if tells_something(seed) { 0 } else { told_nothing + 1 };
        if told_nothing == POINTS {
            break;
        }
    }
}

//! Convolutions side by side: products become lanes of vectors that the rows of histories hold ready.
//!
//! Products form a graph on their factors. A set of values with common partners is one vector, multiplied by each
//! partner in turn (a column of `phi` by the entries of `Omega`), or lane by lane by another vector (two columns in
//! `phi^T phi`). Vectors are chosen greedily by the products they cover; what is left over is gathered.

use super::recurrence::{Factor, Pass, Place, Series};
use super::rules::Product;
use crate::algebra::fault::never_missing;

/// Products in lanes.
pub(super) struct Packed {
    pub lanes: usize,
    pub row: Vec<Option<Series>>,
    pub vectors: usize,
    pub full: Vec<Pass>,
    pub inner: Vec<Pass>,
    /// Where each product is found, and whether it is subtracted there.
    pub places: Vec<(Place, bool)>,
}

/// How full multiplications have to be, round after round: widths of vectors, and least numbers of products.
const WAYS: [(usize, &[usize]); 3] = [(4, &[4, 3, 2]), (4, &[2]), (2, &[2])];

/// The cheapest of several greedy ways.
pub(super) fn pack(products: &[Product], kept: &[Series]) -> Packed {
    let packed = WAYS.map(|(lanes, fills)| pack_into(lanes, fills, products, kept));
    // For each order, a multiplication is done some ten times and a slot is filled once; vectors of four lanes take
    // one instruction where the target has them, and two elsewhere.
    let cost = |packed: &Packed| {
        (2 + packed.lanes) * 10 * (packed.full.len() + packed.inner.len()) + 6 * packed.row.len()
    };
    let [first, rest @ ..] = packed;
    rest.into_iter().fold(first, |best, other| if cost(&other) < cost(&best) { other } else { best })
}

fn pack_into(lanes: usize, fills: &[usize], products: &[Product], kept: &[Series]) -> Packed {
    let mut row = Row { lanes, vectors: Vec::new() };
    let mut drafts = [Vec::new(), Vec::new()];
    for (full, draft) in [(true, 0), (false, 1)] {
        let group: Vec<usize> = (0..products.len()).filter(|p| products[*p].full == full).collect();
        drafts[draft] = cover(products, &group, fills, &mut row);
    }
    let slots = row.slots(&drafts, products, kept);
    let mut places = vec![(Place { full: true, sum: 0, lane: 0 }, false); products.len()];
    let [full, inner] = [true, false].map(|full| {
        let draft = &drafts[usize::from(!full)];
        let merged = merge(draft, products);
        for (multiplication, (sum, negative)) in draft.iter().zip(&merged) {
            for (lane, product) in multiplication.products.iter().enumerate() {
                if let Some(product) = product {
                    places[*product] = (Place { full, sum: *sum, lane }, *negative);
                }
            }
        }
        let slot = |series: Series| {
            let slot = slots.iter().position(|s| *s == Some(series));
            never_missing(slot, "every factor of a convolution has a slot", 0)
        };
        let mut passes: Vec<Pass> = draft
            .iter()
            .zip(&merged)
            .map(|(m, (sum, negative))| Pass {
                sum: *sum,
                negative: *negative,
                left: m.left * lanes,
                right: match m.right {
                    Right::Vector(v) => Factor::Vector(v * lanes),
                    Right::Series(series) => Factor::Slot(slot(series)),
                },
            })
            .collect();
        passes.sort_by_key(|pass| pass.sum);
        passes
    });
    Packed { lanes, row: slots, vectors: row.vectors.len() * lanes, full, inner, places }
}

/// A multiplication of vectors.
struct Multiplication {
    left: usize,
    right: Right,
    /// The product in each lane.
    products: Vec<Option<usize>>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Right {
    Vector(usize),
    Series(Series),
}

/// The vectors chosen so far.
struct Row {
    lanes: usize,
    vectors: Vec<Vec<Series>>,
}

impl Row {
    /// The index of a vector, put there if it is new.
    fn vector(&mut self, series: Vec<Series>) -> usize {
        if let Some(known) = self.vectors.iter().position(|v| *v == series) {
            return known;
        }
        self.vectors.push(series);
        self.vectors.len() - 1
    }

    /// All vectors, filled up, and behind them what stands in none of them.
    fn slots(
        &self,
        drafts: &[Vec<Multiplication>; 2],
        products: &[Product],
        kept: &[Series],
    ) -> Vec<Option<Series>> {
        let mut slots: Vec<Option<Series>> = Vec::new();
        for vector in &self.vectors {
            slots.extend(vector.iter().map(|s| Some(*s)));
            slots.resize(slots.len().next_multiple_of(self.lanes), None);
        }
        let broadcast = drafts.iter().flatten().filter_map(|m| match m.right {
            Right::Series(series) => Some(series),
            Right::Vector(_) => None,
        });
        // The rules read both factors of inner products at order zero.
        let ends = products.iter().filter(|p| !p.full).flat_map(|p| p.factors);
        for series in broadcast.chain(ends).chain(kept.iter().copied()) {
            if !slots.contains(&Some(series)) {
                slots.push(Some(series));
            }
        }
        slots
    }
}

/// Multiplications that form all products of a group.
fn cover(products: &[Product], group: &[usize], fills: &[usize], row: &mut Row) -> Vec<Multiplication> {
    let mut open: Vec<usize> = group.to_vec();
    let mut chosen = Vec::new();
    for &fill in fills {
        // Vectors that stand there already may serve this group as well.
        for known in 0..row.vectors.len() {
            take(products, &mut open, row, (known, fill), &mut chosen);
        }
        while let Some(best) = best_vector(products, &open, fill, row) {
            let vector = row.vector(best);
            take(products, &mut open, row, (vector, fill), &mut chosen);
        }
    }
    gather(products, &open, row, &mut chosen);
    chosen
}

/// The product of two series, among the open ones.
fn find(products: &[Product], open: &[usize], a: Series, b: Series) -> Option<usize> {
    open.iter().copied().find(|p| {
        let [x, y] = products[*p].factors;
        (x, y) == (a, b) || (x, y) == (b, a)
    })
}

/// The products of the lanes of `vector` with one series, or with another vector.
fn lanes_with(
    products: &[Product],
    open: &[usize],
    vector: &[Series],
    partner: impl Fn(usize) -> Option<Series>,
) -> Vec<Option<usize>> {
    let mut taken: Vec<usize> = Vec::new();
    let mut lane = |(lane, series): (usize, &Series)| {
        let product = find(products, open, *series, partner(lane)?)?;
        // A square of two lanes is one product.
        (!taken.contains(&product)).then(|| taken.push(product))?;
        Some(product)
    };
    vector.iter().enumerate().map(&mut lane).collect()
}

/// Takes every multiplication by `vector` that forms at least `fill` open products.
fn take(
    products: &[Product],
    open: &mut Vec<usize>,
    row: &Row,
    (vector, fill): (usize, usize),
    chosen: &mut Vec<Multiplication>,
) {
    loop {
        let best = multiplications(products, open, row, vector)
            .into_iter()
            .max_by_key(|m| m.products.iter().flatten().count());
        match best {
            Some(best) if best.products.iter().flatten().count() >= fill => {
                open.retain(|p| !best.products.contains(&Some(*p)));
                chosen.push(best);
            }
            _ => return,
        }
    }
}

/// All multiplications by `vector`; of equals, the first come last, where `max_by_key` looks.
fn multiplications(products: &[Product], open: &[usize], row: &Row, vector: usize) -> Vec<Multiplication> {
    let own = &row.vectors[vector];
    let by_series = partners(products, open, own).into_iter().map(|series| Multiplication {
        left: vector,
        right: Right::Series(series),
        products: lanes_with(products, open, own, |_| Some(series)),
    });
    let by_vector = row.vectors.iter().enumerate().map(|(other, series)| Multiplication {
        left: vector,
        right: Right::Vector(other),
        products: lanes_with(products, open, own, |lane| series.get(lane).copied()),
    });
    let mut all: Vec<Multiplication> = by_series.chain(by_vector).collect();
    all.reverse();
    all
}

/// What the members of a vector are multiplied by.
fn partners(products: &[Product], open: &[usize], members: &[Series]) -> Vec<Series> {
    let mut found = Vec::new();
    for product in open {
        let [a, b] = products[*product].factors;
        for (own, other) in [(a, b), (b, a)] {
            if members.contains(&own) && !found.contains(&other) {
                found.push(other);
            }
        }
    }
    found
}

/// The new vector that saves most multiplications, if any does.
fn best_vector(products: &[Product], open: &[usize], fill: usize, row: &Row) -> Option<Vec<Series>> {
    let mut factors: Vec<Series> = open.iter().flat_map(|p| products[*p].factors).collect();
    factors.sort_unstable();
    factors.dedup();
    let neighbours: Vec<Vec<Series>> = factors
        .iter()
        .map(|f| {
            let mut partners = partners(products, open, &[*f]);
            partners.sort_unstable();
            partners
        })
        .collect();
    let mut candidates: Vec<Vec<Series>> = Vec::new();
    let mut propose = |set: Vec<Series>| {
        for chunk in set.chunks(row.lanes).filter(|chunk| chunk.len() >= fill) {
            if !candidates.iter().any(|known| known == chunk) {
                candidates.push(chunk.to_vec());
            }
        }
    };
    for (i, own) in neighbours.iter().enumerate() {
        propose(own.clone());
        for other in &neighbours[..i] {
            propose(own.iter().copied().filter(|s| other.contains(s)).collect());
        }
    }
    let saving = |candidate: &Vec<Series>| {
        let mut row = Row { lanes: row.lanes, vectors: row.vectors.clone() };
        let vector = row.vector(candidate.clone());
        let mut open = open.to_vec();
        let mut chosen = Vec::new();
        take(products, &mut open, &row, (vector, fill), &mut chosen);
        chosen.iter().map(|m| m.products.iter().flatten().count() - 1).sum::<usize>()
    };
    let best = candidates.into_iter().rev().max_by_key(saving)?;
    // A vector pays only if it serves more than once.
    (saving(&best) >= fill).then_some(best)
}

/// Products that share nothing, side by side in vectors of their own.
fn gather(products: &[Product], open: &[usize], row: &mut Row, chosen: &mut Vec<Multiplication>) {
    for chunk in open.chunks(row.lanes) {
        let left = row.vector(chunk.iter().map(|p| products[*p].factors[0]).collect());
        let right = match chunk {
            [only] if !products[*only].is_square() => Right::Series(products[*only].factors[1]),
            several => Right::Vector(row.vector(several.iter().map(|p| products[*p].factors[1]).collect())),
        };
        chosen.push(Multiplication { left, right, products: chunk.iter().copied().map(Some).collect() });
    }
}

/// The sum that each multiplication is added to, and whether it is subtracted: multiplications whose products belong
/// to the same sums, lane by lane, share one. Not so squares with others, of which only half the terms are formed.
fn merge(draft: &[Multiplication], products: &[Product]) -> Vec<(usize, bool)> {
    /// Lane by lane, the sum that is added to.
    type Home = Vec<Option<(usize, bool)>>;
    let home = |m: &Multiplication| -> Option<Home> {
        m.products
            .iter()
            .map(|product| match product {
                Some(product) => products[*product].sum.map(Some),
                None => Some(None),
            })
            .collect()
    };
    let mut homes: Vec<Option<(bool, Home)>> = Vec::new();
    let mut sums = Vec::with_capacity(draft.len());
    for multiplication in draft {
        let is_square = multiplication.right == Right::Vector(multiplication.left);
        let own = home(multiplication).map(|home| (is_square, home));
        let opposite = own.as_ref().map(|(is_square, own)| -> (bool, Home) {
            (*is_square, own.iter().map(|lane| lane.map(|(value, negative)| (value, !negative))).collect())
        });
        let known =
            |wanted: &Option<(bool, Home)>| homes.iter().position(|h| wanted.is_some() && h == wanted);
        sums.push(match (known(&own), known(&opposite)) {
            (Some(sum), _) => (sum, false),
            (None, Some(sum)) => (sum, true),
            (None, None) => {
                homes.push(own);
                (homes.len() - 1, false)
            }
        });
    }
    sums
}

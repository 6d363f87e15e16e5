//! The inverse of a symmetric matrix that depends on the placement: `L D L^T`, written out.
//!
//! Straight-line code cannot choose pivots while it runs. The order is fixed here, so that no pivot vanishes at a
//! generic placement, nor at `phi = 1` where that can be had; for a positive definite matrix the factorisation is
//! stable in any order (Higham, Accuracy and Stability of Numerical Algorithms, section 10.1). Of several such pivots the one
//! that mixes with the fewest others goes first, since all that it mixes with is mixed afterwards. That a pivot vanishes or
//! changes its sign along a motion is for the run to notice.

use crate::algebra::evaluate::Field;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{Square, components, pairing, table, upper};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::group_point::GroupPoint;
use crate::mechanics::metric::Definitions;
use crate::symbol::{Factor, Factorised, Quantity, Symbol};

/// A direction in the space that the matrix acts on: indices and weights.
type Direction = Vec<(usize, Rational)>;

/// The factorised matrix.
#[derive(Clone, Debug)]
pub struct Factorisation {
    blocks: Vec<Block>,
}

/// The part of the matrix on directions that the rest does not mix with.
#[derive(Clone, Debug)]
struct Block {
    basis: Vec<Direction>,
    form: Square<Polynomial>,
    /// Below the diagonal.
    lower: Square<Polynomial>,
    /// Reciprocals of the pivots.
    inverse_pivots: Vec<Polynomial>,
}

/// A block as it is factorised.
#[derive(Clone, Debug)]
pub struct SymmetricBlock {
    /// Its upper triangle, row after row.
    pub upper: Vec<Polynomial>,
    /// Number of rows.
    pub size: usize,
}

impl SymmetricBlock {
    /// Its diagonal.
    pub fn diagonal(&self) -> Vec<&Polynomial> {
        let mut at = 0;
        (0..self.size)
            .map(|row| {
                let entry = &self.upper[at];
                at += self.size - row;
                entry
            })
            .collect()
    }
}

impl Factorisation {
    /// Factorises `matrix`, whose entries are polynomials in `shared` quantities and coordinates, and adds the
    /// factors to them. `None` where it is singular at every placement.
    pub fn new(
        arena: &mut Arena,
        of: Factorised,
        matrix: &Square<Polynomial>,
        shared: &mut Definitions,
        chart: &Chart,
    ) -> Option<Self> {
        let mut points = [GroupPoint::first(arena, chart), GroupPoint::undeformed(arena, chart)];
        points.iter_mut().for_each(|point| point.define(arena, shared));
        let mut blocks: Vec<Block> = Vec::new();
        for members in components(matrix) {
            let (basis, form) = ordered(arena, matrix, &members, &points)?;
            let known = blocks.iter().find(|block| block.form == form).cloned();
            blocks.push(match known {
                Some(block) => Block { basis, ..block },
                None => {
                    let which = blocks.len();
                    factorised(arena, (of, which), basis, form, shared)?
                }
            });
        }
        Some(Self { blocks })
    }

    /// The blocks, each once.
    pub fn blocks(&self) -> Vec<(SymmetricBlock, usize)> {
        let mut list: Vec<(SymmetricBlock, usize)> = Vec::new();
        for block in &self.blocks {
            let size = block.form.len();
            let upper: Vec<Polynomial> = upper(size).map(|(i, j)| block.form[i][j].clone()).collect();
            match list.iter_mut().find(|(known, _)| known.upper == upper) {
                Some((_, count)) => *count += 1,
                None => list.push((SymmetricBlock { upper, size }, 1)),
            }
        }
        list
    }

    /// The solution for momenta as a numbered column of an inverse, with what leads there.
    pub fn column(
        &self,
        arena: &mut Arena,
        number: usize,
        momenta: &[Polynomial],
        shared: &mut Definitions,
    ) -> Vec<Expr> {
        let entry = |row: usize| Quantity::InverseColumn.at([row, number]);
        let solution: Vec<Expr> = (1..=momenta.len()).map(|row| arena.symbol(entry(row))).collect();
        self.solve(arena, Factorised::Column(number), momenta, &solution, shared);
        solution
    }

    /// Defines the symbols of `solution` as that of `matrix solution = right`, with what leads there.
    pub fn solve(
        &self,
        arena: &mut Arena,
        of: Factorised,
        right: &[Polynomial],
        solution: &[Expr],
        shared: &mut Definitions,
    ) {
        let mut sums = vec![Polynomial::zero(); right.len()];
        for (which, block) in self.blocks.iter().enumerate() {
            let along =
                |direction: &Direction| direction.iter().map(|(k, weight)| right[*k].scaled(weight)).sum();
            let right: Vec<Polynomial> = block.basis.iter().map(along).collect();
            let values = block.solve(arena, (of, which), &right, solution, shared);
            for (direction, value) in block.basis.iter().zip(&values) {
                direction.iter().for_each(|(k, weight)| sums[*k].add_scaled(value, weight));
            }
        }
        for (symbol, sum) in solution.iter().zip(sums) {
            if sum != Polynomial::atom(*symbol) {
                shared.push((*symbol, sum));
            }
        }
    }
}

impl Block {
    /// `L y = right`, `z = D^-1 y`, `L^T v = z`.
    fn solve(
        &self,
        arena: &mut Arena,
        (of, which): (Factorised, usize),
        right: &[Polynomial],
        solution: &[Expr],
        shared: &mut Definitions,
    ) -> Vec<Polynomial> {
        let size = right.len();
        let mut forward: Vec<Polynomial> = Vec::with_capacity(size);
        for k in 0..size {
            let mut value = right[k].clone();
            for (j, earlier) in forward.iter().enumerate() {
                value.add_product(&self.lower[k][j], earlier, &Rational::MINUS_ONE);
            }
            forward.push(quantity(
                arena,
                Symbol::Factor(Factor::Forward, of, which, vec![k + 1]),
                value,
                shared,
            ));
        }
        let mut values = vec![Polynomial::zero(); size];
        for k in (0..size).rev() {
            let mut value = forward[k].mul(&self.inverse_pivots[k]);
            for (j, later) in values.iter().enumerate().skip(k + 1) {
                value.add_product(&self.lower[j][k], later, &Rational::MINUS_ONE);
            }
            let own = match self.basis[k].as_slice() {
                // The direction of one entry alone has the value of that entry.
                [(place, _)] if self.is_alone(*place) => arena.as_symbol(solution[*place]).cloned(),
                _ => None,
            };
            let own = own.unwrap_or_else(|| Symbol::Factor(Factor::Backward, of, which, vec![k + 1]));
            values[k] = quantity(arena, own, value, shared);
        }
        values
    }

    /// Does only one direction of the basis contain the entry?
    fn is_alone(&self, place: usize) -> bool {
        self.basis.iter().flatten().filter(|(k, _)| *k == place).count() == 1
    }
}

/// A sum of several products gets a name; anything less stands for itself.
fn quantity(arena: &mut Arena, symbol: Symbol, value: Polynomial, shared: &mut Definitions) -> Polynomial {
    let short =
        value.terms().len() == 0 || (value.terms().len() == 1 && value.terms().all(|(m, _)| m.len() <= 1));
    if short {
        return value;
    }
    let symbol = arena.symbol(symbol);
    shared.push((symbol, value));
    Polynomial::atom(symbol)
}

/// A basis of a block in an order without vanishing pivots, and the form in it.
fn ordered(
    arena: &Arena,
    matrix: &Square<Polynomial>,
    members: &[usize],
    points: &[GroupPoint; 2],
) -> Option<(Vec<Direction>, Square<Polynomial>)> {
    let values = points
        .each_ref()
        .map(|point| -> Square<Residue> { table(matrix.len(), |k, l| point.evaluate(arena, &matrix[k][l])) });
    let mut open: Vec<Direction> = members.iter().map(|k| vec![(*k, Rational::ONE)]).collect();
    let mut basis: Vec<Direction> = Vec::new();
    while !open.is_empty() {
        let [generic, undeformed] = values.each_ref().map(|values| complement(values, &basis, &open));
        let places = || 0..open.len();
        let alive = |k: &usize| generic[*k][*k].is_nonzero();
        let both = |k: &usize| alive(k) && undeformed[*k][*k].is_nonzero();
        let mixed_with = |k: &usize| generic[*k].iter().filter(|entry| entry.is_nonzero()).count();
        let pairs = || places().flat_map(|k| (k + 1..open.len()).map(move |l| (k, l)));
        let product = |form: &Square<Residue>| pairs().find(|(k, l)| form[*k][*l].is_nonzero());
        // Where only mixed products are left, x y is made a square by x -> x + y.
        let [both, alive] =
            [places().filter(both).min_by_key(mixed_with), places().filter(alive).min_by_key(mixed_with)];
        match (both, product(&undeformed), alive, product(&generic)) {
            (Some(next), ..) | (None, None, Some(next), _) => basis.push(open.remove(next)),
            (None, Some((k, l)), ..) | (None, None, None, Some((k, l))) => {
                let other = open[l].clone();
                open[k].extend(other);
            }
            (None, None, None, None) => return None,
        }
    }
    let form = table(basis.len(), |k, l| pairing(matrix, &basis[k], &basis[l]));
    Some((basis, form))
}

/// The form on the open directions once those of the basis are eliminated, at a point.
fn complement(values: &Square<Residue>, basis: &[Direction], open: &[Direction]) -> Square<Residue> {
    let all: Vec<&Direction> = basis.iter().chain(open).collect();
    let mut form: Square<Residue> = table(all.len(), |k, l| pairing(values, all[k], all[l]));
    let minus = Residue::from_rational(&Rational::MINUS_ONE);
    for k in 0..basis.len() {
        let reciprocal = form[k][k].recip().unwrap_or(Residue::UNKNOWN);
        let row = form[k].clone();
        for target in form.iter_mut().skip(k + 1) {
            let factor = target[k].mul(&reciprocal).mul(&minus);
            target.iter_mut().zip(&row).for_each(|(entry, above)| *entry = entry.add(&factor.mul(above)));
        }
    }
    form.split_off(basis.len()).into_iter().map(|mut row| row.split_off(basis.len())).collect()
}

/// `L D L^T` of a form, column by column: `w_ij = K_ij - sum over k < j of l_ik w_jk`, `l_ij = w_ij/w_jj`.
fn factorised(
    arena: &mut Arena,
    (of, which): (Factorised, usize),
    basis: Vec<Direction>,
    form: Square<Polynomial>,
    shared: &mut Definitions,
) -> Option<Block> {
    let size = form.len();
    let mut work = vec![vec![Polynomial::zero(); size]; size];
    let mut lower = vec![vec![Polynomial::zero(); size]; size];
    let mut inverse_pivots = Vec::with_capacity(size);
    for j in 0..size {
        for i in j..size {
            let mut value = form[i][j].clone();
            for k in 0..j {
                value.add_product(&lower[i][k], &work[j][k], &Rational::MINUS_ONE);
            }
            let symbol = match i == j {
                true => Symbol::Factor(Factor::Pivot, of, which, vec![j + 1]),
                false => Symbol::Factor(Factor::Rest, of, which, vec![i + 1, j + 1]),
            };
            work[i][j] = quantity(arena, symbol, value, shared);
        }
        let pivot = work[j][j].expression(arena);
        let reciprocal = arena.pow(pivot, -1)?;
        let reciprocal = match arena.as_constant(reciprocal) {
            Some(number) => Polynomial::constant(number.clone()),
            None => {
                let symbol = arena.symbol(Symbol::Factor(Factor::InversePivot, of, which, vec![j + 1]));
                shared.push((symbol, Polynomial::normal_form(arena, reciprocal)));
                Polynomial::atom(symbol)
            }
        };
        for i in j + 1..size {
            let value = work[i][j].mul(&reciprocal);
            let symbol = Symbol::Factor(Factor::Lower, of, which, vec![i + 1, j + 1]);
            lower[i][j] = quantity(arena, symbol, value, shared);
        }
        inverse_pivots.push(reciprocal);
    }
    Some(Block { basis, form, lower, inverse_pivots })
}

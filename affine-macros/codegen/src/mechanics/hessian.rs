//! The Hessian of the kinetic energy on the velocity space, its invariant blocks and its exact inverse.

use crate::algebra::fault::never_missing;
use crate::algebra::linear::{self, Inertia};
use crate::algebra::ring::{Square, components, pairing, pairs, table};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::symbol::Quantity;

use super::direction::{BasisVector, Direction, entries, invariant};
use super::kinetic::Kinetic;
use super::metrics::Congruent;

/// The Hessian `d^2 T / dO_k dO_l` on the `n^2` entries of the affine velocity, row-major, split into the blocks
/// that do not mix.
#[derive(Clone, Debug)]
pub struct Hessian {
    /// The blocks; their basis vectors together span the velocity space, or the Lie algebra of a constraint.
    pub blocks: Vec<Block>,
    /// Entry `[k][l]`, a polynomial in the model's parameters.
    pub matrix: Vec<Vec<Polynomial>>,
    /// What entry `[k][l]` of the inverse is times, where the blocks are those of a [congruent](super::metrics::Congruent)
    /// form in rational bases.
    weights: Option<Vec<Vec<Rational>>>,
}

/// A block of the Hessian in a rational basis.
#[derive(Clone, Debug)]
pub struct Block {
    /// Basis vectors, each of `n^2` rational entries.
    pub basis: Vec<BasisVector>,
    /// The form on them.
    pub form: Vec<Vec<Polynomial>>,
    /// Their squares, `tr(O O^T)`.
    squares: Vec<Rational>,
    /// What they are in the user's bases, likewise places and weights.
    velocities: Vec<Vec<(usize, Rational)>>,
}

impl Block {
    /// The entries that its basis vectors start with: all of them, where these are single.
    pub(super) fn places(&self) -> Vec<usize> {
        self.basis.iter().filter_map(|vector| vector.entries.first()).map(|(k, _)| *k).collect()
    }

    /// The eigenvalue of a block of size one, with respect to the norm `tr(O O^T)`.
    pub fn eigenvalue(&self) -> Option<Polynomial> {
        let [square] = self.squares.as_slice() else { return None };
        Some(self.form[0][0].scaled(&square.recip()?))
    }

    /// The form as numbers, if it is numeric.
    pub fn numbers(&self) -> Option<linear::Square> {
        self.form.iter().map(|row| row.iter().map(Polynomial::as_constant).collect()).collect()
    }

    /// Inertia of a numeric block, its kernel as an affine velocity of `n^2` entries.
    pub fn inertia(&self, dim: usize) -> Option<Inertia> {
        let mut inertia = linear::inertia(&self.numbers()?);
        inertia.kernel = inertia.kernel.map(|kernel| self.velocity(dim, &kernel));
        Some(inertia)
    }

    /// The affine velocity of `n^2` entries with these components in the basis.
    pub fn velocity(&self, dim: usize, components: &[Rational]) -> Vec<Rational> {
        let mut direction = vec![Rational::ZERO; dim * dim];
        for (weight, velocity) in components.iter().zip(&self.velocities) {
            for (k, w) in velocity {
                direction[*k] = &direction[*k] + &(weight * w);
            }
        }
        direction
    }

    /// Writes the velocities of vectors in orthonormal bases in the user's.
    fn seen_from(&mut self, congruent: &Congruent) {
        let seen = |vector: &BasisVector| {
            let mut velocity = vec![Rational::ZERO; congruent.velocities.len()];
            for (k, w) in &vector.entries {
                let per_root = never_missing(
                    w.checked_div(&congruent.roots[*k]),
                    "a root of a positive number is not zero",
                    Rational::ZERO,
                );
                for (place, weight) in &congruent.velocities[*k] {
                    velocity[*place] = &velocity[*place] + &(&per_root * weight);
                }
            }
            velocity.into_iter().enumerate().filter(|(_, weight)| !weight.is_zero()).collect()
        };
        self.velocities = self.basis.iter().map(seen).collect();
    }

    /// The value of the form at these components, if it is numeric.
    pub fn square(&self, components: &[Rational]) -> Option<Rational> {
        let numbers = self.numbers()?;
        let term = |(k, l): (usize, usize)| &(&components[k] * &components[l]) * &numbers[k][l];
        Some(pairs(numbers.len()).map(term).fold(Rational::ZERO, |sum, term| &sum + &term))
    }
}

impl Hessian {
    /// The eigenvalues that decide whether a model with fields is well posed: condition, reason, value.
    pub fn eigenvalues(&self) -> Vec<(Direction, Polynomial)> {
        let mut list: Vec<(Direction, Polynomial)> = Vec::new();
        for block in &self.blocks {
            if let Some(value) = block.eigenvalue() {
                let kind = block.basis[0].kind;
                if value.as_constant().is_none() && !list.contains(&(kind, value.clone())) {
                    list.push((kind, value));
                }
            }
        }
        list
    }

    /// Is the energy zero for all velocities that are free?
    pub fn is_zero(&self) -> bool {
        self.blocks.iter().flat_map(|block| block.form.concat()).all(|entry| entry.is_zero())
    }

    /// The Hessian of the internal energy.
    pub fn new(kinetic: &Kinetic) -> Self {
        let matrix = kinetic.form();
        let bases = match kinetic.confined() {
            None => vec![entries(kinetic.dim.pow(2)), invariant(kinetic.dim)],
            Some(group) => group.bases(kinetic.dim, invariant(kinetic.dim)),
        };
        let blocks = bases.into_iter().map(|basis| blocks(&matrix, &basis));
        let blocks = blocks
            // Work of inverting; the invariant directions win a tie, since they name the eigenvalues, but not where
            // numbers are left to tell: in entries their eigenvalues are those of T.
            .min_by_key(|blocks| {
                let work: usize = blocks.iter().map(|b| b.basis.len().pow(3)).sum();
                let left = blocks.iter().any(|b| b.basis.len() > 1 && b.numbers().is_none());
                (work, (blocks[0].basis[0].kind == Direction::Entry) != left)
            });
        let blocks = never_missing(blocks, "velocities have a basis", Vec::new());
        let hessian = Self { blocks, matrix, weights: None };
        match &kinetic.congruent {
            Some(congruent) => hessian.decided_by(congruent, kinetic),
            None => hessian,
        }
    }

    /// With the blocks of the same form in rational bases, where what is decided about numbers is decided exactly. With
    /// fields it is left to `prepare()`, and an isotropic form has rational coefficients and eigenvalues in orthonormal
    /// bases too: these keep their blocks.
    fn decided_by(mut self, congruent: &Congruent, kinetic: &Kinetic) -> Self {
        let velocities: Vec<Expr> = kinetic.velocity.0.concat();
        let numeric =
            congruent.energy.terms().all(|(monomial, _)| monomial.iter().all(|e| velocities.contains(e)));
        let alone =
            |b: &Block| b.basis[0].kind != Direction::Entry && b.eigenvalue().is_some_and(|e| !e.is_zero());
        if !numeric || (congruent.exact && self.blocks.iter().all(alone)) {
            self.blocks.iter_mut().for_each(|block| block.seen_from(congruent));
            return self;
        }
        let form = congruent.energy.hessian(&velocities);
        let mut blocks = blocks(&form, &entries(form.len()));
        for block in &mut blocks {
            let places = block.places();
            block.squares = places.iter().map(|k| congruent.weights[*k][*k].clone()).collect();
            block.velocities = places.iter().map(|k| congruent.velocities[*k].clone()).collect();
        }
        Self { blocks, weights: Some(congruent.weights.clone()), ..self }
    }

    /// The inverse: entry `[k][l]` is a polynomial in parameters, reciprocals of eigenvalues, and symbols for
    /// the inverse blocks that only numbers can give. `None` where the form is degenerate. Under a constraint it is the
    /// inverse of the form on the Lie algebra, from momenta that act on it to velocities in it.
    pub fn inverse(&self, arena: &mut Arena) -> Option<Inverse> {
        let n2 = self.matrix.len();
        let mut result =
            Inverse { matrix: vec![vec![Polynomial::zero(); n2]; n2], numeric_blocks: Vec::new() };
        for block in &self.blocks {
            let inverse = result.invert(arena, block)?;
            for (row, left) in inverse.iter().zip(&block.basis) {
                for (value, right) in row.iter().zip(&block.basis) {
                    for (k, wk) in &left.entries {
                        for (l, wl) in &right.entries {
                            let weight = self.weights.as_ref().map(|weights| &weights[*k][*l]);
                            let weight = weight.map_or(wk * wl, |weight| &(wk * wl) * weight);
                            result.matrix[*k][*l].add_scaled(value, &weight);
                        }
                    }
                }
            }
        }
        Some(result)
    }
}

/// The inverse of a Hessian.
#[derive(Clone, Debug)]
pub struct Inverse {
    /// Entry `[k][l]`.
    pub matrix: Vec<Vec<Polynomial>>,
    /// Blocks that mix directions and depend on fields: their inverses are computed when the model is prepared.
    pub numeric_blocks: Vec<NumericBlock>,
}

/// A symmetric block whose inverse is computed from the values of the fields.
#[derive(Clone, Debug)]
pub struct NumericBlock {
    /// What the form is written in, where it stands first: row-major places and weights, in the user's bases.
    pub basis: Vec<Vec<(usize, Rational)>>,
    /// The form, in parameters.
    pub form: Vec<Vec<Polynomial>>,
    /// Symbols of the inverse, row after row; symmetric.
    pub inverse: Vec<Vec<Expr>>,
}

impl NumericBlock {
    fn as_atoms(&self) -> Vec<Vec<Polynomial>> {
        Matrix(self.inverse.clone()).atoms()
    }
}

impl Inverse {
    fn invert(&mut self, arena: &mut Arena, block: &Block) -> Option<Vec<Vec<Polynomial>>> {
        if let Some(numbers) = block.numbers() {
            let inverse = linear::inverse(&numbers)?;
            return Some(
                inverse.into_iter().map(|row| row.into_iter().map(Polynomial::constant).collect()).collect(),
            );
        }
        if let [row] = block.form.as_slice() {
            let value = row[0].expression(arena);
            return Some(vec![vec![Polynomial::reciprocal(arena, value)?]]);
        }
        if let Some(known) = self.numeric_blocks.iter().find(|known| known.form == block.form) {
            return Some(known.as_atoms());
        }
        let b = self.numeric_blocks.len() + 1;
        let size = block.form.len();
        let inverse = Matrix::symmetric(arena, Quantity::InverseBlock.at([b]), size).0;
        self.numeric_blocks.push(NumericBlock {
            basis: block.velocities.clone(),
            form: block.form.clone(),
            inverse,
        });
        self.numeric_blocks.last().map(NumericBlock::as_atoms)
    }
}

/// The form in a basis, cut into its connected components.
pub(super) fn blocks(matrix: &Square<Polynomial>, basis: &[BasisVector]) -> Vec<Block> {
    let form: Square<Polynomial> =
        table(basis.len(), |i, j| pairing(matrix, &basis[i].entries, &basis[j].entries));
    let block = |members: Vec<usize>| Block {
        squares: members.iter().map(|i| basis[*i].square()).collect(),
        velocities: members.iter().map(|i| basis[*i].entries.clone()).collect(),
        basis: members.iter().map(|i| basis[*i].clone()).collect(),
        form: members.iter().map(|i| members.iter().map(|j| form[*i][*j].clone()).collect()).collect(),
    };
    components(&form).into_iter().map(block).collect()
}

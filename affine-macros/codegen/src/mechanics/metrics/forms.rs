//! Quadratic forms of velocities, from the bases that they are stated in to orthonormal ones.
//!
//! `J` of `1/2 tr(O J O^T)` has upper indices, (2.1), (4.17): `eta_KL Oh^K_A Oh^L_B J^AB`, and becomes `B J B^T`, or
//! `A J A^T` in space. `K` is contracted with the components of a velocity, whose metrics it does not read, and becomes
//! `M^T K M` with `O = M O'`.

use crate::algebra::fault::never_missing;
use crate::algebra::ring::{Square, product, table, transpose};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::term::{Coefficient, Frame, Term, TermKind};
use crate::symbol::Symbol;

use super::axes::{Axes, root_of_product};
use super::congruent::Congruent;
use super::{Bases, Metrics};

/// A matrix that is known when the model is prepared, as the bases are.
#[derive(Clone, Debug)]
pub struct Rebased {
    /// Its number, which its symbols bear.
    pub number: usize,
    /// What `prepare()` makes it from.
    pub source: Source,
}

/// What `prepare()` makes a matrix from.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// The matrix of a term, in orthonormal bases, from its entries in the user's, row after row.
    Form(TermKind, Vec<Expr>),
    /// `A^-1`.
    SpaceInverse,
    /// `B`.
    Body,
}

/// The bases that the two indices of an affine velocity belong to.
fn sides(frame: Frame, [space, body]: [&Axes; 2]) -> [&Axes; 2] {
    match frame {
        Frame::Body => [body, body],
        Frame::Space => [space, space],
        Frame::Flat => [space, body],
    }
}

/// A matrix or a tensor of a term of `frame`, in the bases of `axes`.
fn changed(term: &Term, frame: Frame, axes: [&Axes; 2], given: &Square<Polynomial>) -> Square<Polynomial> {
    let [left, right] = sides(frame, axes);
    let lifted = |rows: &[Vec<Rational>]| table(rows.len(), |i, j| Polynomial::constant(rows[i][j].clone()));
    let matrix = match term.kind.is_tensor() {
        false => lifted(&right.matrix),
        // O[A][B] = (L^-1)[A][a] O'[a][b] R[b][B]
        true => {
            let (n, l, r) = (left.matrix.len(), lifted(&left.inverse), lifted(&right.matrix));
            table(n * n, |k, whole| l[whole / n][k / n].mul(&r[k % n][whole % n]))
        }
    };
    product(&product(&matrix, given), &transpose(&matrix))
}

/// Terms with matrices, and the frames of their velocities.
fn matrices(terms: &[Term]) -> impl Iterator<Item = (usize, &Term, &Matrix, Frame)> {
    terms.iter().enumerate().filter_map(|(place, term)| match &term.value {
        Coefficient::Matrix(matrix) => Some((place, term, matrix, term.kind.internal_frame()?)),
        Coefficient::Scalar(_) => None,
    })
}

impl Metrics {
    /// The same terms in orthonormal bases. Where these follow from fields, the entries are those of matrices that
    /// `prepare()` computes, added to `rebased`.
    pub fn orthonormal(&self, arena: &mut Arena, terms: &[Term], rebased: &mut Vec<Rebased>) -> Vec<Term> {
        let mut changed = terms.to_vec();
        for (place, term, matrix, frame) in matrices(terms) {
            let given = matrix.normal_form(arena);
            let value = match self {
                Self::Known(bases) => bases.normalised(arena, term, frame, &given),
                Self::Given(metrics) => form_to_prepare(arena, metrics, (term, frame), &given, rebased),
            };
            changed[place].value = Coefficient::Matrix(value);
        }
        changed
    }

    /// The form of `kinetic`, stated as `terms` in the user's bases, in rational bases; `None` where it has no matrices,
    /// or where the bases follow from fields.
    pub fn congruent(&self, arena: &mut Arena, kinetic: &Kinetic, terms: &[Term]) -> Option<Congruent> {
        let Self::Known(bases) = self else { return None };
        matrices(terms).next()?;
        bases.congruent(arena, kinetic, terms)
    }
}

impl Metrics {
    /// `A^-1` and `B`; symbols for the entries that can differ from zero, where `prepare()` finds them.
    pub fn factors(&self, arena: &mut Arena, rebased: &mut Vec<Rebased>) -> [Matrix; 2] {
        let [space, body] = match self {
            Self::Known(bases) => {
                return [&bases.space.inverse, &bases.body.matrix].map(|rows| {
                    let mut constant = |entry: &Rational| arena.constant(entry.clone());
                    Matrix(rows.iter().map(|row| row.iter().map(&mut constant).collect()).collect())
                });
            }
            Self::Given(metrics) => patterns(arena, metrics),
        };
        [(&space.inverse, Source::SpaceInverse), (&body.matrix, Source::Body)].map(|(pattern, source)| {
            to_prepare(arena, source, (pattern.len(), &|i, j| pattern[i][j].is_zero()), rebased)
        })
    }
}

/// Where the factors of metrics that depend on fields can differ from zero.
fn patterns(arena: &mut Arena, metrics: &[Vec<Vec<Expr>>; 2]) -> [Axes; 2] {
    metrics.each_ref().map(|rows| Axes::pattern(&Matrix(rows.clone()).normal_form(arena)))
}

/// The matrix that `prepare()` makes from `source`, once: symbols for the entries that do not vanish.
fn to_prepare(
    arena: &mut Arena,
    source: Source,
    (size, vanishes): (usize, &dyn Fn(usize, usize) -> bool),
    rebased: &mut Vec<Rebased>,
) -> Matrix {
    let is_symmetric = matches!(source, Source::Form(..));
    let known = rebased.iter().find(|matrix| matrix.source == source).map(|matrix| matrix.number);
    let number = known.unwrap_or(rebased.len() + 1);
    if known.is_none() {
        rebased.push(Rebased { number, source });
    }
    Matrix(table(size, |i, j| {
        let (row, column) = if is_symmetric { (i.min(j), i.max(j)) } else { (i, j) };
        match vanishes(i, j) {
            true => arena.constant(Rational::ZERO),
            false => arena.symbol(Symbol::Prepared(number, row + 1, column + 1)),
        }
    }))
}

/// The same of a form, whose entries can differ from zero where they do so in some bases.
fn form_to_prepare(
    arena: &mut Arena,
    metrics: &[Vec<Vec<Expr>>; 2],
    (term, frame): (&Term, Frame),
    given: &Square<Polynomial>,
    rebased: &mut Vec<Rebased>,
) -> Matrix {
    let [space, body] = patterns(arena, metrics);
    let one = |entry: &Polynomial| {
        if entry.is_zero() { Polynomial::zero() } else { Polynomial::constant(Rational::ONE) }
    };
    let ones: Square<Polynomial> = given.iter().map(|row| row.iter().map(one).collect()).collect();
    let filled = changed(term, frame, [&space, &body], &ones);
    let entries = given.iter().flatten().map(|entry| entry.expression(arena)).collect();
    let source = Source::Form(term.kind, entries);
    to_prepare(arena, source, (given.len(), &|i, j| filled[i][j].is_zero()), rebased)
}

impl Bases {
    /// A matrix in orthonormal bases: entry by entry one root times the entry in the rational ones.
    fn normalised(&self, arena: &mut Arena, term: &Term, frame: Frame, given: &Square<Polynomial>) -> Matrix {
        let n = self.space.axes.squares.len();
        let rational = changed(term, frame, self.axes(), given);
        let scaled = |r: usize, s: usize| {
            let mut exponents = Exponents::new(n, frame);
            match term.kind.is_tensor() {
                true => [r, s].iter().for_each(|k| exponents.divide(*k)),
                // sqrt(d_r d_s)
                false => [r, s].iter().for_each(|k| exponents.add(1, *k, 1)),
            }
            self.root(&exponents).map_or_else(Polynomial::zero, |root| rational[r][s].scaled(&root))
        };
        let entry = |r: usize, s: usize| match rational[r][s].is_zero() {
            true => arena.constant(Rational::ZERO),
            false => scaled(r, s).expression(arena),
        };
        let size = given.len();
        Matrix(table(size, entry))
    }

    fn congruent(&self, arena: &mut Arena, kinetic: &Kinetic, terms: &[Term]) -> Option<Congruent> {
        let (n, frame) = (kinetic.dim, kinetic.frame);
        let [left, right] = sides(frame, self.axes());
        let internal = terms.iter().filter(|term| term.kind.translation_frame().is_none());
        let internal: Vec<Term> = internal.map(|term| self.rational(arena, term, frame)).collect();
        // d_a times the square of row a for J; K and the Casimirs are contracted without metrics.
        let energy =
            |scale: &dyn Fn(&Polynomial) -> Polynomial, wanted: &dyn Fn(&Term) -> bool, arena: &mut Arena| {
                let terms: Vec<Term> = internal.iter().filter(|term| wanted(term)).cloned().collect();
                scale(&Kinetic::in_frame(arena, n, frame, &terms, None).internal_energy())
            };
        let velocity = &kinetic.velocity.0;
        let row_of = |atom: &Expr| velocity.iter().position(|row| row.contains(atom));
        let by_rows = |energy: &Polynomial| {
            let mut sum = Polynomial::zero();
            for (monomial, c) in energy.terms() {
                let square =
                    monomial.iter().find_map(row_of).map_or(Rational::ONE, |a| left.squares[a].clone());
                sum.add_term(monomial.clone(), &(c * &square));
            }
            sum
        };
        let is_inertia = |term: &Term| term.kind.internal_frame().is_some() && !term.kind.is_tensor();
        let mut sum = energy(&by_rows, &is_inertia, arena);
        sum.add_scaled(&energy(&Polynomial::clone, &|term| !is_inertia(term), arena), &Rational::ONE);

        let product = |velocities: &[usize]| {
            let mut exponents = Exponents::new(n, frame);
            velocities.iter().for_each(|entry| exponents.multiply(*entry));
            self.root(&exponents)
        };
        let weights: Option<Square<Rational>> =
            (0..n * n).map(|k| (0..n * n).map(|l| product(&[k, l])).collect()).collect();
        let weights = weights?;
        let roots: Vec<Rational> = (0..n * n).map(|k| product(&[k])).collect::<Option<_>>()?;
        let entries = velocity.concat();
        let square = |k: usize, l: usize| &weights[k][k] * &weights[l][l];
        let exact = sum.terms().all(|(monomial, _)| {
            let places: Vec<usize> =
                monomial.iter().filter_map(|atom| entries.iter().position(|e| e == atom)).collect();
            matches!(places.as_slice(), [k, l] if &weights[*k][*l] * &weights[*k][*l] == square(*k, *l))
        });
        let velocities = (0..n * n).map(|k| {
            let whole = |place: usize| {
                let weight = &left.inverse[place / n][k / n] * &right.matrix[k % n][place % n];
                (!weight.is_zero()).then_some((place, weight))
            };
            (0..n * n).filter_map(whole).collect()
        });
        Some(Congruent { energy: sum, weights, roots, exact, velocities: velocities.collect() })
    }

    /// A term in the rational bases. The scalar of an inertia is `J = I eta^-1`.
    fn rational(&self, arena: &mut Arena, term: &Term, frame: Frame) -> Term {
        let [_, right] = sides(frame, self.axes());
        let value = match &term.value {
            Coefficient::Matrix(matrix) => {
                let given = matrix.normal_form(arena);
                let rational = changed(term, frame, self.axes(), &given);
                let rows = rational.iter().map(|row| row.iter().map(|e| e.expression(arena)).collect());
                Coefficient::Matrix(Matrix(rows.collect()))
            }
            Coefficient::Scalar(c) if term.kind.internal_frame().is_some() => {
                let scalar = Polynomial::normal_form(arena, *c);
                let zero = arena.constant(Rational::ZERO);
                let mut rows = vec![vec![zero; right.squares.len()]; right.squares.len()];
                for (k, square) in right.squares.iter().enumerate() {
                    let reciprocal =
                        never_missing(square.recip(), "a squared length is positive", Rational::ZERO);
                    rows[k][k] = scalar.scaled(&reciprocal).expression(arena);
                }
                Coefficient::Matrix(Matrix(rows))
            }
            Coefficient::Scalar(c) => Coefficient::Scalar(*c),
        };
        Term { kind: term.kind, value }
    }

    fn axes(&self) -> [&Axes; 2] {
        [&self.space.axes, &self.body.axes]
    }

    fn root(&self, exponents: &Exponents) -> Option<Rational> {
        let squares: Vec<&Rational> = self.axes().into_iter().flat_map(|axes| &axes.squares).collect();
        root_of_product(&squares, &exponents.of)
    }
}

/// Powers of the lengths of the basis vectors, those of space first.
struct Exponents {
    n: usize,
    /// Where the lengths of the first and of the second index start.
    offsets: [usize; 2],
    of: Vec<i32>,
}

impl Exponents {
    fn new(n: usize, frame: Frame) -> Self {
        let offsets = match frame {
            Frame::Body => [n, n],
            Frame::Space => [0, 0],
            Frame::Flat => [0, n],
        };
        Self { n, offsets, of: vec![0; 2 * n] }
    }

    /// Multiplies by the length to a power of the basis vector `index` of the first (0) or second (1) index.
    fn add(&mut self, which: usize, index: usize, power: i32) {
        self.of[self.offsets[which] + index] += power;
    }

    /// Multiplies by the `w` of an entry of the velocity.
    fn multiply(&mut self, entry: usize) {
        self.add(0, entry / self.n, 1);
        self.add(1, entry % self.n, -1);
    }

    /// Divides by the `w` of an entry of the velocity.
    fn divide(&mut self, entry: usize) {
        self.add(0, entry / self.n, -1);
        self.add(1, entry % self.n, 1);
    }
}

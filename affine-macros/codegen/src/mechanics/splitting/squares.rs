//! An anisotropic energy as a sum of squares, each with an exact flow.
//!
//! A quadratic form in the affine spin is `H = sum over k of d_k/2 <E_k, M>^2`: by completing squares (Lagrange; `L D L^T`) where
//! its coefficients are numbers, by its principal axes where the fields' values give them. `<E_k, M>` is conserved along the flow of its own square, which
//! is that of `<E_k, M>` at the rate `s = d_k <E_k, M>`,
//!
//! ```text
//! phi -> phi exp(t s E), M -> exp(-t s E) M exp(t s E)          or, in space, phi -> exp(t s E) phi, M -> exp(t s E) M exp(-t s E)
//! ```
//!
//! Where `E^2 = tr(E) E`, as for every square of `1/2 tr(X^T J^-1 X)`, whose `E` have rank one, the exponential is
//! `1 + g E` with `g = (exp(t s tr E) - 1)/tr E`, and `g = t s` for a shear. Squares whose momenta commute make one piece,
//! and shears whose products vanish one shear.

use crate::algebra::kernel::{Callee, Group};
use crate::algebra::ring::{self, table};
use crate::algebra::{Arena, Expr, Kernel, Polynomial, Rational};
use crate::mechanics::brackets::poisson;
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::equations::{Form, System, hamilton};
use crate::mechanics::hessian::{Block, blocks, entries};
use crate::mechanics::reduce::Reduction;

use super::flows::{confined, expanded, generator, turns_along, value_of};
use super::{Flow, Summand, over_the_state};

/// The time that a flow lasts.
pub const TIME_OF_FLOW: &str = "h";

/// The squares of an energy.
#[derive(Default)]
pub(super) struct Squares {
    /// Those with momenta that commute stand together.
    pub(super) groups: Vec<Vec<Square>>,
    /// What `prepare()` has to find first.
    pub(super) principal: Vec<Principal>,
}

/// `d/2 l^2`.
#[derive(Clone)]
pub(super) struct Square {
    /// `d`.
    weight: Polynomial,
    /// `l`, linear in the entries of the affine spin that determine the others.
    form: Polynomial,
    /// `l` of the projection of any affine spin.
    on_all: Polynomial,
    /// As text.
    name: String,
}

/// A symmetric form whose eigenvalues and eigenvectors are computed from the values of the fields.
#[derive(Clone, Debug)]
pub struct Principal {
    /// The form, in parameters.
    pub form: Vec<Vec<Polynomial>>,
    /// Symbols of the eigenvalues.
    pub values: Vec<Expr>,
    /// Symbols of the eigenvectors, one after the other.
    pub vectors: Vec<Vec<Expr>>,
}

impl Squares {
    /// The squares of a quadratic energy of a chart's affine spin; `None` where it is degenerate.
    pub(super) fn of(arena: &mut Arena, chart: &Chart, energy: &Polynomial) -> Option<Self> {
        let energy = energy.substitute(&|atom| value_of(&chart.dependent(), atom));
        let momenta: Vec<Coordinate> =
            chart.independent().into_iter().filter(|z| matches!(z, Coordinate::M(..))).collect();
        let symbols: Vec<Expr> = momenta.iter().map(|z| chart.symbol(*z)).collect();
        let form: Vec<Vec<Polynomial>> =
            energy.gradient(&symbols).iter().map(|slope| slope.gradient(&symbols)).collect();
        let mut squares = Self::default();
        for block in blocks(&form, entries(symbols.len())) {
            let of_block = squares.of_block(arena, &block)?;
            let places = block.basis.iter().filter_map(|vector| vector.entries.first());
            let places: Vec<usize> = places.map(|(k, _)| *k).collect();
            let atoms: Vec<Expr> = places.iter().map(|k| symbols[*k]).collect();
            for (k, (weight, row)) in of_block.into_iter().enumerate() {
                let (mut form, mut on_all) = (Polynomial::zero(), Polynomial::zero());
                for (c, place) in row.iter().zip(&places) {
                    form.add_product(c, &Polynomial::atom(symbols[*place]), &Rational::ONE);
                    on_all.add_product(c, &on_all_momenta(chart, momenta[*place]), &Rational::ONE);
                }
                let name = name(arena, &form, k + 1, &atoms);
                squares.place(chart, Square { weight, form, on_all, name });
            }
        }
        Some(squares)
    }

    /// Weights and rows of coefficients.
    fn of_block(&mut self, arena: &mut Arena, block: &Block) -> Option<Vec<(Polynomial, Vec<Polynomial>)>> {
        let fixed = |entry: &Polynomial| !entry.any_symbol(arena, &mut |_| true);
        if block.form.len() == 1 || block.form.iter().flatten().all(fixed) {
            return completed(arena, block.form.clone());
        }
        let known = self.principal.iter().position(|known| known.form == block.form);
        let known = known.unwrap_or_else(|| {
            self.principal.push(Principal::symbols(arena, self.principal.len() + 1, block.form.clone()));
            self.principal.len() - 1
        });
        self.principal.get(known).map(Principal::squares)
    }

    /// Puts a square beside others that it commutes with.
    fn place(&mut self, chart: &Chart, square: Square) {
        let commutes = |other: &Square| poisson(chart, &other.on_all, &square.on_all).is_zero();
        match self.groups.iter_mut().find(|group| group.iter().all(commutes)) {
            Some(group) => group.push(square),
            None => self.groups.push(vec![square]),
        }
    }
}

impl Principal {
    fn symbols(arena: &mut Arena, b: usize, form: Vec<Vec<Polynomial>>) -> Self {
        let size = form.len();
        let values = (1..=size).map(|k| arena.symbol(&format!("square_{b}_{k}"))).collect();
        let mut vector = |k: usize| (1..=size).map(|i| arena.symbol(&format!("axis_{b}_{k}_{i}"))).collect();
        let vectors = (1..=size).map(&mut vector).collect();
        Self { form, values, vectors }
    }

    fn squares(&self) -> Vec<(Polynomial, Vec<Polynomial>)> {
        let atoms = |list: &Vec<Expr>| list.iter().map(|s| Polynomial::atom(*s)).collect();
        self.values.iter().map(|s| Polynomial::atom(*s)).zip(self.vectors.iter().map(atoms)).collect()
    }
}

/// An entry of the affine spin, under a constraint that of its projection.
fn on_all_momenta(chart: &Chart, entry: Coordinate) -> Polynomial {
    match (chart.confined, entry) {
        (Some(group), Coordinate::M(a, b)) => {
            group.projected(&table(chart.dim, |c, d| Polynomial::atom(chart.m.0[c][d])))[a][b].clone()
        }
        _ => Polynomial::atom(chart.symbol(entry)),
    }
}

/// Lagrange's reduction of a symmetric form: weights `d_k` and rows of `l_k` with `F = sum of d_k l_k^T l_k`.
fn completed(
    arena: &mut Arena,
    mut form: Vec<Vec<Polynomial>>,
) -> Option<Vec<(Polynomial, Vec<Polynomial>)>> {
    let size = form.len();
    let unit =
        |i: usize| (0..size).map(|j| Polynomial::constant(Rational::from(i64::from(i == j)))).collect();
    let mut rows: Vec<Vec<Polynomial>> = (0..size).map(unit).collect();
    let mut open: Vec<usize> = (0..size).collect();
    let mut squares = Vec::new();
    while !open.is_empty() {
        let k = match open.iter().find(|k| !form[**k][**k].is_zero()) {
            Some(k) => *k,
            None => square_of_a_product(&mut form, &mut rows, &open)?,
        };
        open.retain(|other| *other != k);
        let pivot = form[k][k].clone();
        let reciprocal = pivot.expression(arena);
        let reciprocal = arena.pow(reciprocal, -1)?;
        let reciprocal = Polynomial::normal_form(arena, reciprocal);
        let factors: Vec<(usize, Polynomial)> =
            open.iter().map(|j| (*j, form[k][*j].mul(&reciprocal))).filter(|(_, f)| !f.is_zero()).collect();
        for (j, factor) in &factors {
            for l in &open {
                let less = factor.mul(&form[k][*l]);
                form[*j][*l].add_scaled(&less, &Rational::MINUS_ONE);
            }
            let more: Vec<Polynomial> = rows[*j].iter().map(|c| c.mul(factor)).collect();
            rows[k].iter_mut().zip(&more).for_each(|(c, more)| c.add_scaled(more, &Rational::ONE));
        }
        squares.push((pivot, rows[k].clone()));
    }
    Some(squares)
}

/// Only products are left: `y_i y_j = ((y_i + y_j)^2 - (y_i - y_j)^2)/4`. The place of the sum.
fn square_of_a_product(
    form: &mut [Vec<Polynomial>],
    rows: &mut [Vec<Polynomial>],
    open: &[usize],
) -> Option<usize> {
    let pairs = open.iter().flat_map(|i| open.iter().map(move |j| (*i, *j)));
    let (i, j) = pairs.into_iter().find(|(i, j)| i != j && !form[*i][*j].is_zero())?;
    let half = Rational::ratio(1, 2)?;
    let combined = |one: &[Polynomial], other: &[Polynomial], sign: &Rational| -> Vec<Polynomial> {
        let pairs = one.iter().zip(other);
        pairs
            .map(|(a, b)| {
                let mut sum = a.clone();
                sum.add_scaled(b, sign);
                sum
            })
            .collect()
    };
    // y_i = (u + v)/2 and y_j = (u - v)/2, in the columns and then in the rows of the form.
    for row in form.iter_mut() {
        let (a, b) = (row[i].scaled(&half), row[j].scaled(&half));
        [row[i], row[j]] = [&Rational::ONE, &Rational::MINUS_ONE].map(|sign| {
            let mut sum = a.clone();
            sum.add_scaled(&b, sign);
            sum
        });
    }
    let (a, b): (Vec<_>, Vec<_>) = (
        form[i].iter().map(|c| c.scaled(&half)).collect(),
        form[j].iter().map(|c| c.scaled(&half)).collect(),
    );
    (form[i], form[j]) = (combined(&a, &b, &Rational::ONE), combined(&a, &b, &Rational::MINUS_ONE));
    let (a, b) = (rows[i].clone(), rows[j].clone());
    (rows[i], rows[j]) = (combined(&a, &b, &Rational::ONE), combined(&a, &b, &Rational::MINUS_ONE));
    Some(i)
}

/// The square as text: the `k`-th of a block of momenta where only the fields' values tell which.
fn name(arena: &mut Arena, form: &Polynomial, k: usize, block: &[Expr]) -> String {
    let known = |atom: Expr| block.contains(&atom);
    if form.mentions(|atom| !known(atom)) {
        let names: Vec<&str> = block.iter().filter_map(|atom| arena.name(*atom)).collect();
        return format!("square {k} of {}", names.join(", "));
    }
    let form = form.expression(arena);
    let text = arena.text(form);
    if arena.name(form).is_some() { format!("{text}^2") } else { format!("({text})^2") }
}

/// The flow of one momentum `l` at a rate `s`: `phi' = s phi E` or `s E phi`.
struct Turn {
    /// The symbol of `s`, and its value.
    rate: (Expr, Polynomial),
    /// `E`, with the sign of its flow.
    direction: ring::Square<Polynomial>,
    /// Does it stand on the right?
    right: bool,
}

/// The piece of squares that commute.
pub(super) fn piece(
    arena: &mut Arena,
    reduction: &Reduction,
    group: &[Square],
) -> Option<(Vec<Summand>, Vec<Flow>)> {
    let turns = group.iter().enumerate();
    let turns = turns.map(|(k, square)| Turn::of(arena, reduction, square, k + 1));
    let turns: Vec<Turn> = turns.collect::<Option<_>>()?;
    let flows = match turns.iter().all(|one| turns.iter().all(|other| one.vanishes_times(other))) {
        true => vec![sheared(arena, reduction, &turns)?],
        false => turns.iter().map(|turn| turn.flow(arena, reduction)).collect::<Option<_>>()?,
    };
    let summands = group.iter().map(Square::summand).collect::<Option<_>>()?;
    Some((summands, flows))
}

impl Square {
    fn summand(&self) -> Option<Summand> {
        let half = Rational::ratio(1, 2)?;
        let energy = self.weight.mul(&self.on_all.mul(&self.on_all)).scaled(&half);
        Some(Summand { name: self.name.clone(), energy: Some(energy), system: System::default() })
    }
}

impl Turn {
    /// Of the `k`-th square of a piece; `None` where its equations are no exponential.
    fn of(arena: &mut Arena, reduction: &Reduction, square: &Square, k: usize) -> Option<Self> {
        let chart = &reduction.chart;
        let system = expanded(hamilton(arena, chart, &square.on_all, Form::Expanded));
        let system = over_the_state(arena, reduction, system)?;
        let (direction, right) = generator(chart, &system)?;
        let rate = (arena.symbol(&format!("rate_{k}")), square.weight.mul(&square.form));
        turns_along(chart, &system, &direction, right).then_some(Self { rate, direction, right })
    }

    fn vanishes_times(&self, other: &Self) -> bool {
        ring::product(&self.direction, &other.direction).iter().flatten().all(Polynomial::is_zero)
    }

    /// Has `E` one entry alone?
    fn is_along_an_axis(&self) -> bool {
        self.direction.iter().flatten().filter(|entry| !entry.is_zero()).count() == 1
    }

    /// `s E`.
    fn generator(&self) -> ring::Square<Polynomial> {
        times(&self.direction, &Polynomial::atom(self.rate.0))
    }

    /// `tr E`, where `E^2 = tr(E) E`.
    fn trace(&self) -> Option<Polynomial> {
        let mut trace = Polynomial::zero();
        (0..self.direction.len()).for_each(|a| trace.add_scaled(&self.direction[a][a], &Rational::ONE));
        (ring::product(&self.direction, &self.direction) == times(&self.direction, &trace)).then_some(trace)
    }

    fn flow(&self, arena: &mut Arena, reduction: &Reduction) -> Option<Flow> {
        let (shared, generator) = (vec![self.rate.clone()], self.generator());
        let Some(trace) = self.trace() else {
            return Some(Flow::Exponential { shared, generator, right: self.right, turns_momentum: true });
        };
        let [growth, decay] = ["growth", "decay"].map(|name| arena.symbol(name));
        let h = Polynomial::atom(arena.symbol(TIME_OF_FLOW));
        let kernel = Kernel {
            callee: Callee::Elongation,
            arguments: [h, trace.mul(&Polynomial::atom(self.rate.0))].map(Group::Scalar).to_vec(),
            results: [growth, decay].map(Group::Scalar).to_vec(),
        };
        let s = Polynomial::atom(self.rate.0);
        let [growth, decay] = [growth, decay].map(|factor| s.mul(&Polynomial::atom(factor)));
        let product = match self.is_along_an_axis().then(|| trace.as_constant()?.recip()).flatten() {
            // 1 + g tr E and 1 + d tr E are reciprocals: rounded, their product would move the momentum that is
            // conserved. Beside a small trace the sum would lose digits.
            Some(reciprocal) => {
                let mut product = growth.scaled(&-&reciprocal);
                product.add_scaled(&decay, &-&reciprocal);
                product
            }
            None => growth.mul(&decay),
        };
        let rates = rises(&reduction.chart, &self.direction, self.right, &[growth, decay, product]);
        let system = System { shared, kernels: vec![kernel], rates, work: None };
        over_the_state(arena, reduction, confined(&reduction.chart, system)).map(Flow::Rise)
    }
}

/// The flow of momenta whose `E` have no products: `exp(Y) = 1 + Y`.
fn sheared(arena: &mut Arena, reduction: &Reduction, turns: &[Turn]) -> Option<Flow> {
    let generator = turns.iter().map(Turn::generator).reduce(|sum, y| ring::sum(&sum, &y))?;
    let h = Polynomial::atom(arena.symbol(TIME_OF_FLOW));
    let (back, square) = (h.scaled(&Rational::MINUS_ONE), h.mul(&h).scaled(&Rational::MINUS_ONE));
    let rates = rises(&reduction.chart, &generator, turns.first()?.right, &[h, back, square]);
    let shared = turns.iter().map(|turn| turn.rate.clone()).collect();
    let system = System { shared, rates, ..System::default() };
    over_the_state(arena, reduction, confined(&reduction.chart, system)).map(Flow::Rise)
}

/// The increments of `phi` and `M` by `1 + g E` and its inverse `1 + d E`, given `g`, `d` and `g d`.
fn rises(
    chart: &Chart,
    e: &ring::Square<Polynomial>,
    right: bool,
    [growth, decay, product]: &[Polynomial; 3],
) -> Vec<(Coordinate, Expr, Polynomial)> {
    let matrix = |entries: &[Vec<Expr>]| table(chart.dim, |a, b| Polynomial::atom(entries[a][b]));
    let (phi, m) = (matrix(&chart.phi.0), matrix(&chart.m.0));
    let (after, before) = if right { (growth, decay) } else { (decay, growth) };
    let placed = if right { ring::product(&phi, e) } else { ring::product(e, &phi) };
    let (m_e, e_m) = (ring::product(&m, e), ring::product(e, &m));
    let both = ring::product(e, &m_e);
    let mut rates = Vec::new();
    for (a, b) in (0..chart.dim).flat_map(|a| (0..chart.dim).map(move |b| (a, b))) {
        let mut turned = m_e[a][b].mul(after);
        turned.add_product(&e_m[a][b], before, &Rational::ONE);
        turned.add_product(&both[a][b], product, &Rational::ONE);
        for (z, rise) in [(Coordinate::Phi(a, b), placed[a][b].mul(growth)), (Coordinate::M(a, b), turned)] {
            if !rise.is_zero() {
                rates.push((z, chart.symbol(z), rise));
            }
        }
    }
    rates
}

fn times(matrix: &ring::Square<Polynomial>, factor: &Polynomial) -> ring::Square<Polynomial> {
    table(matrix.len(), |a, b| matrix[a][b].mul(factor))
}

//! Matrices of coefficients: which name each has, and what it is.

use super::field::{self, field_of};
use super::matrix_name::MatrixName;
use super::names::{Named, Notation};
use super::sentence::Sentence;
use crate::algebra::ring::pairs;
use crate::algebra::{Arena, Expr, Matrix, Polynomial};
use crate::mechanics::forces::Forces;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::metrics::{Rebased, Source};
use crate::mechanics::term::{Coefficient, Frame, Term};
use crate::symbol::Symbol;

/// What a matrix is a coefficient of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Energy,
    Friction,
}

impl Notation<'_> {
    /// Names for the matrices of all forms.
    pub(super) fn name_matrices(&mut self, arena: &mut Arena, energies: &[Kinetic], forces: &Forces) {
        let friction = forces.dissipation.iter().flat_map(|dissipation| &dissipation.parts);
        let forms: Vec<(Form, &Kinetic)> = energies
            .iter()
            .map(|energy| (Form::Energy, energy))
            .chain(friction.map(|part| (Form::Friction, &part.form)))
            .collect();
        let all: Vec<(Form, &Term, &Vec<Vec<Expr>>)> = forms
            .iter()
            .flat_map(|(form, kinetic)| kinetic.terms.iter().map(move |term| (*form, term)))
            .filter_map(|(form, term)| match &term.value {
                Coefficient::Matrix(matrix) => Some((form, term, &matrix.0)),
                Coefficient::Scalar(_) => None,
            })
            .collect();
        for (form, term, rows) in &all {
            let alone = !all.iter().any(|(other, another, matrix)| {
                other == form
                    && another.kind.is_tensor() == term.kind.is_tensor()
                    && matrix != rows
                    && field_of(arena, &self.as_given(arena, matrix)).is_none()
            });
            if self.matrix(rows).is_none() {
                let named = self.named(arena, (*form, alone), term, rows);
                self.matrices.push(named);
            }
        }
    }

    fn matrix(&self, rows: &[Vec<Expr>]) -> Option<&Named> {
        self.matrices.iter().find(|named| named.rows == rows)
    }

    /// The name of the matrix of a term; of one that has none its rows.
    pub(in crate::mechanics) fn matrix_name(&self, arena: &mut Arena, rows: &[Vec<Expr>]) -> MatrixName {
        if let Some(named) = self.matrix(rows) {
            return named.name.clone();
        }
        let literal = self.literal(arena, rows);
        MatrixName::new(self.text(arena, &literal), self.latex(arena, &literal), false)
    }

    /// What the matrices of terms are, where they are no fields.
    pub(in crate::mechanics) fn matrices_in<'t>(
        &self,
        terms: impl IntoIterator<Item = &'t Term>,
    ) -> Vec<Sentence> {
        let mut list: Vec<Sentence> = Vec::new();
        for term in terms {
            let Coefficient::Matrix(matrix) = &term.value else { continue };
            let definition = self.matrix(&matrix.0).and_then(|named| named.definition.as_ref());
            list.extend(definition.filter(|definition| !list.contains(definition)).cloned());
        }
        list
    }

    /// The matrix that `prepare()` carries to orthonormal bases, where it is one.
    fn carried(&self, arena: &Arena, rows: &[Vec<Expr>]) -> Option<&'_ Rebased> {
        let number = rows.iter().flatten().find_map(|entry| match arena.as_symbol(*entry) {
            Some(Symbol::Prepared(number, ..)) => Some(*number),
            _ => None,
        })?;
        self.rebased.iter().find(|matrix| matrix.number == number)
    }

    /// Its rows as the user gave them.
    fn as_given(&self, arena: &Arena, rows: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
        match self.carried(arena, rows).map(|matrix| &matrix.source) {
            Some(Source::Form(_, entries)) => entries.chunks(rows.len()).map(<[Expr]>::to_vec).collect(),
            _ => rows.to_vec(),
        }
    }

    fn named(
        &self,
        arena: &mut Arena,
        (form, alone): (Form, bool),
        term: &Term,
        rows: &[Vec<Expr>],
    ) -> Named {
        let given = self.as_given(arena, rows);
        let carried = self.carried(arena, rows).map(|matrix| matrix.number);
        // What is carried into other bases is no longer the field, and has a name of its own.
        if let Some(name) = field_of(arena, &given).filter(|_| carried.is_none()) {
            let name = field::matrix(name);
            return Named { rows: rows.to_vec(), name, definition: None, carried };
        }
        let frame = match term.kind.internal_frame() {
            _ if alone => None,
            Some(Frame::Body) => Some("body"),
            Some(Frame::Space) => Some("space"),
            Some(Frame::Flat) => Some("flat"),
            None => None,
        };
        let letter = if term.kind.is_tensor() { "K" } else { "J" };
        let friction = (form == Form::Friction).then_some("R");
        let upright = frame.map(|frame| format!("\\mathrm{{{frame}}}"));
        let text: Vec<&str> = friction.into_iter().chain(frame).collect();
        let latex: Vec<&str> = friction.into_iter().chain(upright.as_deref()).collect();
        let name = match text.is_empty() {
            true => MatrixName::new(letter, letter, true),
            false => MatrixName::new(
                format!("{letter}_{}", text.join("_")),
                format!("{letter}_{{{}}}", latex.join(",")),
                false,
            ),
        };
        let literal = self.literal(arena, &given);
        let value = if carried.is_some() { Sentence::InGivenBases(Box::new(literal)) } else { literal };
        let definition = value.of(Sentence::Matrix(name.clone()));
        Named { rows: rows.to_vec(), name, definition: Some(definition), carried }
    }

    /// The rows of a matrix, or a field, or its diagonal.
    pub(super) fn literal(&self, arena: &mut Arena, rows: &[Vec<Expr>]) -> Sentence {
        if let Some(name) = field_of(arena, rows) {
            return Sentence::Matrix(field::matrix(name));
        }
        let zero = |e: &Expr| arena.as_constant(*e).is_some_and(|value| value.is_zero());
        if pairs(rows.len()).all(|(i, j)| i == j || zero(&rows[i][j])) {
            let diagonal = rows.iter().enumerate().map(|(i, row)| self.scalar(arena, row[i]));
            return Sentence::Diagonal(diagonal.collect());
        }
        let mut row = |row: &Vec<Expr>| row.iter().map(|entry| self.scalar(arena, *entry)).collect();
        Sentence::Rows(rows.iter().map(&mut row).collect())
    }

    /// The matrix of which this symmetric block is the part on some rows that the others do not mix with, and these rows.
    pub(super) fn containing(
        &self,
        arena: &mut Arena,
        block: &[Vec<Polynomial>],
    ) -> Option<(&Named, Vec<usize>)> {
        self.matrices.iter().find_map(|named| {
            let matrix = Matrix(named.rows.clone()).normal_form(arena);
            Some((named, rows_of(&matrix, block)?))
        })
    }
}

/// The rows on which a matrix is a block, in the order of the block.
fn rows_of(matrix: &[Vec<Polynomial>], block: &[Vec<Polynomial>]) -> Option<Vec<usize>> {
    let rows = continued(matrix, block, &[])?;
    let apart = |r: usize| rows.contains(&r) || rows.iter().all(|s| matrix[r][*s].is_zero());
    (0..matrix.len()).all(apart).then_some(rows)
}

/// These rows and those that come after them.
fn continued(matrix: &[Vec<Polynomial>], block: &[Vec<Polynomial>], rows: &[usize]) -> Option<Vec<usize>> {
    let Some(values) = block.get(rows.len()) else { return Some(rows.to_vec()) };
    let fits = |r: &usize| {
        !rows.contains(r)
            && matrix[*r][*r] == values[rows.len()]
            && rows.iter().zip(values).all(|(s, value)| matrix[*r][*s] == *value)
    };
    (0..matrix.len()).filter(fits).find_map(|r| continued(matrix, block, &[rows, &[r]].concat()))
}

//! The kinetic energy, term by term, in the velocity of its frame.

use crate::algebra::ring::{Square, pairs, table};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};

use super::constraint::Constraint;
use super::metrics::Congruent;
use super::term::{Coefficient, Frame, Pattern, Term, TermKind};

/// A kinetic energy with constant coefficients in one internal and at most one translational frame.
#[derive(Clone, Debug)]
pub struct Kinetic {
    /// Dimension of space.
    pub dim: usize,
    /// The group that the motion is confined to; `None` for GL+(n).
    pub constraint: Option<Constraint>,
    /// Frame of the internal motion.
    pub frame: Frame,
    /// The affine velocity of that frame, as symbols.
    pub velocity: Matrix,
    /// The terms as given.
    pub terms: Vec<Term>,
    /// Energy of each internal term, with its place among those of the whole energy, of which this may be a part.
    pub internal: Vec<(usize, Polynomial)>,
    /// Frame and mass of the translational term, with its place as in `internal`.
    pub translation: Option<Translation>,
    /// The internal energy in rational bases, where metrics make its coefficients irrational.
    pub congruent: Option<Congruent>,
}

/// The translational term `m/2 |v|^2` in the frame of `v`.
#[derive(Clone, Copy, Debug)]
pub struct Translation {
    /// `Body`: `v = phi^-1 x_dot`; `Space`: `v = x_dot`.
    pub frame: Frame,
    /// `m`.
    pub mass: Expr,
    /// Place among the terms of the whole energy.
    pub place: usize,
}

impl Kinetic {
    /// Is the energy that of positive masses alone, `1/2 tr(phi_dot J phi_dot^T)` (2.1)? Every other one may be
    /// indefinite.
    pub fn is_dalembert(&self) -> bool {
        self.frame == Frame::Flat
            && !self.terms.is_empty()
            && self
                .terms
                .iter()
                .all(|term| term.kind == TermKind::Dalembert || term.kind.translation_frame().is_some())
    }

    /// Has the internal energy the [weight](super::weight) `D^2`? No term in an affine velocity stands beside it then: they
    /// have no common frame.
    pub fn is_weighted(&self) -> bool {
        self.constraint == Some(Constraint::Conformal)
            && self.terms.iter().any(|term| term.kind == TermKind::Dalembert)
    }

    /// The constraint, where velocities and momenta are projected for it. With `phi_dot` and `Pi` they are not, since
    /// the tangent space turns with `phi`: there it acts through its multiplier.
    pub fn confined(&self) -> Option<Constraint> {
        self.constraint.filter(|_| self.frame != Frame::Flat)
    }

    /// Writes the terms in their common frame; the places of two terms that have none, otherwise.
    ///
    /// # Errors
    /// The places of the first two terms whose coefficients cannot be constant together.
    pub fn new(arena: &mut Arena, dim: usize, terms: &[Term]) -> Result<Self, (usize, usize)> {
        Self::under(arena, dim, terms, None)
    }

    /// The same of a motion confined to a group, each term in the [form](Constraint::form_of) that it has there.
    ///
    /// # Errors
    /// As [`Kinetic::new`].
    pub fn under(
        arena: &mut Arena,
        dim: usize,
        terms: &[Term],
        constraint: Option<Constraint>,
    ) -> Result<Self, (usize, usize)> {
        let form = |kind: TermKind| constraint.map_or(kind, |group| group.form_of(kind));
        let translation = common(terms, |kind| form(kind).translation_frame())?;
        let fixed = common(terms, |kind| form(kind).internal_frame())?;
        // The Casimir terms alone live in both affine frames; the one of the translation makes it shortest.
        let frame = fixed.or(translation).map_or(Frame::Body, |(frame, _)| frame);
        if let (Frame::Flat, Some((_, flat))) = (frame, fixed)
            && let Some(affine) = terms
                .iter()
                .position(|t| t.kind.internal_frame().is_none() && t.kind.translation_frame().is_none())
        {
            return Err((flat.min(affine), flat.max(affine)));
        }
        Ok(Self::in_frame(arena, dim, frame, terms, constraint))
    }

    /// Writes terms that have constant coefficients in `frame`, under the constraint if there is one, in the velocity of
    /// that frame.
    pub(super) fn in_frame(
        arena: &mut Arena,
        dim: usize,
        frame: Frame,
        terms: &[Term],
        constraint: Option<Constraint>,
    ) -> Self {
        let form = |kind: TermKind| constraint.map_or(kind, |group| group.form_of(kind));
        let velocity = Matrix::symbols(arena, frame.velocity(), dim);
        let mut kinetic = Self {
            dim,
            constraint,
            frame,
            velocity,
            terms: terms.to_vec(),
            internal: Vec::new(),
            translation: None,
            congruent: None,
        };
        for (place, term) in terms.iter().enumerate() {
            match (form(term.kind).translation_frame(), &term.value) {
                (Some(frame), Coefficient::Scalar(mass)) => {
                    kinetic.translation = Some(Translation { frame, mass: *mass, place });
                }
                _ => {
                    let energy = internal_energy(arena, &kinetic.velocity, term);
                    kinetic.internal.push((place, energy));
                }
            }
        }
        kinetic
    }

    /// One of its internal terms, by its place and energy, without the others.
    pub fn only(&self, place: usize, energy: &Polynomial) -> Self {
        Self { internal: vec![(place, energy.clone())], ..self.clone() }
    }

    /// The internal energy `T_int`.
    pub fn internal_energy(&self) -> Polynomial {
        self.internal.iter().map(|(_, energy)| energy).sum()
    }

    /// `(dT_int/dO)^T`
    pub fn momentum(&self) -> Square<Polynomial> {
        let energy = self.internal_energy();
        table(self.dim, |a, b| energy.derivative(self.velocity.0[b][a]))
    }

    /// `d^2 T_int / dO_k dO_l` on the entries of the velocity, row-major.
    pub fn form(&self) -> Square<Polynomial> {
        self.internal_energy().hessian(&self.velocity.0.concat())
    }
}

/// The one frame that `frame` gives for the terms, with the place of the first term that asks for it.
fn common(
    terms: &[Term],
    frame: impl Fn(TermKind) -> Option<Frame>,
) -> Result<Option<(Frame, usize)>, (usize, usize)> {
    let mut found: Option<(Frame, usize)> = None;
    for (place, term) in terms.iter().enumerate() {
        match (found, frame(term.kind)) {
            (None, Some(this)) => found = Some((this, place)),
            (Some((first, at)), Some(this)) if this != first => return Err((at, place)),
            _ => {}
        }
    }
    Ok(found)
}

/// The energy of an internal term at the affine velocity `o` of its frame.
fn internal_energy(arena: &mut Arena, o: &Matrix, term: &Term) -> Polynomial {
    let n = o.dim();
    let half = Rational::HALF;
    let pairs = || pairs(n);
    let mut energy = Polynomial::zero();
    let mut add = |left: Expr, coefficient: &Polynomial, right: Expr| {
        energy.add_product(coefficient, &Polynomial::monomial([left, right]), &half);
    };
    match &term.value {
        Coefficient::Scalar(c) => {
            let c = Polynomial::normal_form(arena, *c);
            for (a, b) in pairs() {
                match term.kind.pattern() {
                    Pattern::TraceOfSquare => add(o.0[a][b], &c, o.0[b][a]),
                    Pattern::SquareOfTrace => add(o.0[a][a], &c, o.0[b][b]),
                    Pattern::Rows | Pattern::Pairs | Pattern::Centre => add(o.0[a][b], &c, o.0[a][b]),
                }
            }
        }
        Coefficient::Matrix(k) => {
            // J acts on the second index, K on both.
            let both = term.kind.is_tensor();
            for (r, row) in k.0.iter().enumerate() {
                for (s, entry) in row.iter().enumerate() {
                    let entry = Polynomial::normal_form(arena, *entry);
                    if both {
                        add(o.0[r / n][r % n], &entry, o.0[s / n][s % n]);
                    } else {
                        (0..n).for_each(|i| add(o.0[i][r], &entry, o.0[i][s]));
                    }
                }
            }
        }
    }
    energy
}

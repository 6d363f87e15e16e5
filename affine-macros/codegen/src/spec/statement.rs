//! A model as the attribute and the struct below it state it.

use super::custom::{Custom, SelfGravity};
use super::expression::Expression;
use super::item::Item;
use super::momentum_side::MomentumKind;
use super::names::{Claim, Named, PlacementGroup, Requirement};
use super::spanned::Spanned;
use crate::diagnostics::Region;
use crate::symbol::{Asked, Capability, Constraint, TermKind};

/// A model as stated by the attribute and the struct below it.
pub struct Spec {
    /// The user's struct.
    pub item: Item,
    /// `dim`: n, not yet known to be 2 or 3 before the checks.
    pub dim: Spanned<usize>,
    /// `symmetry(space = ..., body = ...)`; without it nothing is claimed.
    pub symmetry: Option<Symmetry>,
    /// The terms of `kinetic(...)`, in the user's order, each kind at most once; none beside `hamiltonian(...)`.
    pub kinetic: Vec<Term>,
    /// The terms of `hamiltonian(...)`, likewise, where it stands instead of `kinetic(...)`.
    pub hamiltonian: Option<Vec<Term<MomentumKind>>>,
    /// The key `kinetic` or `hamiltonian`.
    pub kinetic_key: Region,
    /// `metrics(space = g, body = eta)`, in this order.
    pub metrics: [Option<Metric>; 2],
    /// `constraint = ...`.
    pub constraint: Option<Spanned<Constraint>>,
    /// `potential = ...`.
    pub potential: Option<Potential>,
    /// The summands `custom(...)` of `potential` and `forces`, in the user's order.
    pub customs: Vec<Custom>,
    /// The summands `self_gravity(k)` of `potential`.
    pub self_gravity: Vec<SelfGravity>,
    /// The terms of `dissipation(...)`, in the user's order, each kind at most once.
    pub dissipation: Vec<Term>,
    /// `group = ...`; GL(n, R) without it.
    pub group: Option<Spanned<PlacementGroup>>,
    /// `require(...)`.
    pub require: Vec<Spanned<Requirement>>,
    /// `emit(...)`.
    pub emit: Vec<Spanned<Capability>>,
    /// `crate = ...`: the runtime, where it has another name than `affine_runtime`.
    pub runtime: Option<syn::Path>,
}

/// A claim about the kinetic energy: a lower bound of its symmetry group.
#[derive(Clone, Copy, Debug)]
pub struct Symmetry {
    /// Left action, phi -> L phi; [`Claim::None`] at the key `symmetry` if omitted.
    pub space: Spanned<Claim>,
    /// Right action, phi -> phi R; likewise.
    pub body: Spanned<Claim>,
}

/// One summand of the kinetic energy, of the Hamiltonian or of the dissipation.
#[derive(Clone, Debug)]
pub struct Term<K = TermKind> {
    /// Its kind, at its name.
    pub kind: Spanned<K>,
    /// Its coefficients.
    pub value: Value,
    /// The place of the value.
    pub span: Region,
}

/// A constant metric.
#[derive(Clone, Debug)]
pub struct Metric {
    /// `space` or `body`.
    pub side: &'static str,
    /// `g` or `eta`; a scalar is that multiple of the identity.
    pub value: Value,
    /// The place of the value.
    pub span: Region,
}

impl Metric {
    /// The paper's letters.
    pub fn letters(&self) -> &'static str {
        if self.side == "space" { "g" } else { "eta" }
    }
}

/// The potential energy U(t, x, phi).
#[derive(Clone, Debug)]
#[must_use]
pub struct Potential {
    /// The key `potential`.
    pub key: Region,
    /// U, with every named potential written out.
    pub energy: Expression,
    /// The place of the value.
    pub span: Region,
}

/// The coefficients of a term.
#[derive(Clone, Debug)]
pub enum Value {
    /// `a + 1/2`.
    Scalar(Expression),
    /// `diag(a, b, c)`.
    Diagonal(Vec<Expression>),
    /// `[[a, b], [c, d]]`; the rows may still differ in length before the checks.
    Matrix(Vec<Vec<Expression>>),
}

impl Value {
    /// All expressions, row by row.
    pub fn expressions(&self) -> impl Iterator<Item = &Expression> {
        let (flat, rows): (&[Expression], &[Vec<Expression>]) = match self {
            Self::Scalar(one) => (std::slice::from_ref(one), &[]),
            Self::Diagonal(entries) => (entries, &[]),
            Self::Matrix(rows) => (&[], rows),
        };
        flat.iter().chain(rows.iter().flatten())
    }

    /// What it is, in words.
    pub fn shape(&self) -> &'static str {
        match self {
            Self::Scalar(_) => "a scalar",
            Self::Diagonal(_) => "a diagonal matrix",
            Self::Matrix(_) => "a matrix",
        }
    }
}

impl Spec {
    /// What is asked for besides the equations.
    pub fn asked(&self) -> Asked {
        self.emit.iter().map(|capability| capability.value).collect()
    }

    /// Where a capability is asked for, if it is.
    pub fn emitted(&self, capability: Capability) -> Option<Region> {
        self.emit.iter().find(|asked| asked.value == capability).map(|asked| asked.span)
    }

    /// Where something is required, if it is.
    pub fn required(&self, requirement: Requirement) -> Option<Region> {
        self.require.iter().find(|required| required.value == requirement).map(|required| required.span)
    }

    /// The terms of all quadratic forms: the kinetic energy, then the dissipation.
    pub fn forms(&self) -> impl Iterator<Item = &Term> {
        self.kinetic.iter().chain(&self.dissipation)
    }

    /// The term of a kind.
    pub fn term(&self, kind: TermKind) -> Option<&Term> {
        self.kinetic.iter().find(|term| term.kind.value == kind)
    }

    /// Every coefficient of the kinetic energy, of the Hamiltonian and of the dissipation, every entry of the metrics, and the
    /// strengths of self-gravity.
    pub fn coefficients(&self) -> impl Iterator<Item = &Expression> {
        let stated = self.hamiltonian.iter().flatten().flat_map(|term| term.value.expressions());
        let metrics = self.metrics.iter().flatten().flat_map(|metric| metric.value.expressions());
        let strengths = self.self_gravity.iter().map(|gravity| &gravity.strength);
        self.forms().flat_map(|term| term.value.expressions()).chain(stated).chain(metrics).chain(strengths)
    }

    /// The name and the place of the first translation term, on either side.
    pub fn translation(&self) -> Option<(&'static str, Region)> {
        let kinetic = self.kinetic.iter().find(|term| term.kind.value.is_translation());
        let kinetic = kinetic.map(|term| (term.kind.value.name(), term.kind.span));
        let mut stated = self.hamiltonian.iter().flatten().filter(|term| term.kind.value.is_translation());
        kinetic.or_else(|| stated.next().map(|term| (term.kind.value.name(), term.kind.span)))
    }
}

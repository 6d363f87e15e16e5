//! What is known of a model in words and numbers.

use crate::constraint::Constraint;
use crate::quantity::{Group, Word};

/// What was derived about a model; made by the macro alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Description {
    /// Name of the user's type.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
    pub name: Word,
    /// The kinetic energy.
    pub kinetic_energy: Formula,
    /// The Hamiltonian.
    pub hamiltonian: Formula,
    /// Hamilton's equations in the model's frames.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::list"))]
    pub equations: &'static [Formula],
    /// The reduced equations.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::list"))]
    pub reduced_equations: &'static [Formula],
    /// Numbers of positive and negative directions of the kinetic metric, internal and translational; `None`
    /// where they depend on the fields' values.
    pub signature: Option<(usize, usize)>,
    /// What every motion conserves.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::list"))]
    pub conserved: &'static [Conserved],
    /// What motions with `p = 0` conserve; the same list for a model without translation.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::list"))]
    pub conserved_at_rest: &'static [Conserved],
    /// Components of the plain array, group after group.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::list"))]
    pub full: &'static [Group],
    /// Components of the reduced state, group after group.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::list"))]
    pub reduced: &'static [Group],
    /// Operations of Hamilton's equations.
    pub full_operations: Operations,
    /// Operations of the reduced equations.
    pub reduced_operations: Operations,
    /// The group to which the motion is confined; `None` for all of GL+(n).
    pub constraint: Option<Constraint>,
    /// Are the reduced equations `q'' = f(t, q)`, as `emit(nystrom)` integrates them?
    pub second_order: bool,
    /// Are the reduced equations operations alone, as `emit(taylor)` takes their series?
    pub series: bool,
    /// Does the dilatation move along a closed form of its own among the pieces that `emit(splitting)` integrates by?
    #[cfg_attr(feature = "serde", serde(default))]
    pub dilates: bool,
    /// Functions of the state that keep their sign where the potential has a value; empty where that is everywhere.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::list"))]
    pub domain: &'static [Guard],
    /// A function of the user's is part of the potential: that it has no value is seen by its energy alone.
    pub custom_potential: bool,
    /// Parts of the potential with an angle that the time turns, as written: `cos(w*t)`. [`Model::domain`](crate::Model::domain) gives the angles.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::words"))]
    pub angles: &'static [&'static str],
    /// What was taken out of the state.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::list"))]
    pub left_out: &'static [LeftOut],
}

impl Description {
    /// What is true of a model of which nothing else is said.
    #[doc(hidden)]
    pub const PLAIN: Self = Self {
        name: "",
        kinetic_energy: Formula::plain(""),
        hamiltonian: Formula::plain(""),
        equations: &[],
        reduced_equations: &[],
        signature: None,
        conserved: &[],
        conserved_at_rest: &[],
        full: &[],
        reduced: &[],
        full_operations: Operations::NONE,
        reduced_operations: Operations::NONE,
        constraint: None,
        second_order: false,
        series: true,
        dilates: false,
        domain: &[],
        custom_potential: false,
        angles: &[],
        left_out: &[],
    };
}

/// Something that is not integrated, and in which runs it is not.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LeftOut {
    /// What it is and why, in words.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
    pub what: Word,
    /// The runs.
    pub scope: Scope,
}

/// The runs that leave something out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Scope {
    /// Every run of the model.
    Model,
    /// Those by the reduced equations, [`Model::reduced_equations`](crate::Model::reduced_equations).
    Reduction,
    /// Those by methods that integrate what the reduced state carries along, see [`Model::renewed`](crate::Model::renewed).
    Carried,
    /// Those in closed form.
    ClosedForm,
}

impl Scope {
    /// Something that these runs do without.
    #[doc(hidden)]
    #[must_use]
    pub const fn without(self, what: Word) -> LeftOut {
        LeftOut { what, scope: self }
    }
}

/// A part of a potential that has a value only where a function of the state keeps its sign. The values of these functions
/// are those of [`Model::domain`](crate::Model::domain).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Guard {
    /// The part, as written: `ln(q)`, `1/x[1]`.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
    pub part: Word,
    /// The function, as written: `q`, `x[1]`.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
    pub argument: Word,
    /// The signs that it may have.
    pub bound: Bound,
}

/// The signs that a function of the state may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Bound {
    /// Above zero: the argument of a logarithm.
    Positive,
    /// Zero or above: the argument of a root.
    NotNegative,
    /// The sign that it has at the start: a divisor.
    NotZero,
}

/// A formula as text, and as LaTeX where a model or a report asks for it.
///
/// Fields have the names that they have in the struct. One that is written like a symbol of the mechanics stands as
/// `self.name`, in LaTeX in typewriter.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Formula {
    /// Plain text.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
    pub text: Word,
    /// LaTeX, without delimiters; of models with `emit(latex)`, and of all where `affine_runtime` has the feature `report`.
    #[cfg_attr(feature = "serde", serde(default, deserialize_with = "crate::interned::optional_word"))]
    pub latex: Option<Word>,
}

impl Formula {
    /// A formula that has no LaTeX.
    #[must_use]
    pub const fn plain(text: Word) -> Self {
        Self { text, latex: None }
    }
}

/// Numbers of arithmetic operations of straight-line code; a multiply-add counts as both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Operations {
    /// Multiplications.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Divisions.
    pub div: usize,
    /// Square and cube roots.
    pub sqrt: usize,
    /// Exponentials, hyperbolic and trigonometric functions.
    pub exp: usize,
    /// Logarithms.
    pub ln: usize,
}

impl Operations {
    /// No operation of any kind.
    pub const NONE: Self = Self::arithmetic(0, 0, 0);

    /// So many multiplications, additions and divisions, and nothing else.
    #[must_use]
    pub const fn arithmetic(mul: usize, add: usize, div: usize) -> Self {
        Self { mul, add, div, sqrt: 0, exp: 0, ln: 0 }
    }
}

/// A quantity that a model may conserve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Conserved {
    /// Energy `H`.
    Energy,
    /// Linear momentum `p`.
    LinearMomentum,
    /// Co-moving linear momentum `p_hat = phi^T p`.
    ComovingLinearMomentum,
    /// Orbital angular momentum `x p^T - p x^T`.
    OrbitalAngularMomentum,
    /// Total affine momentum `I(O) = x p^T + Sigma`.
    TotalAffineMomentum,
    /// Total angular momentum `I(O) - I(O)^T`.
    TotalAngularMomentum,
    /// Spatial affine spin `Sigma`.
    AffineSpin,
    /// Traceless part of `Sigma`.
    Deviator,
    /// Spin `S = Sigma - Sigma^T`.
    Spin,
    /// `|S|^2 = -tr(S^2)/2`.
    SpinNorm,
    /// Co-moving affine spin `Sigma_hat`.
    ComovingAffineSpin,
    /// Traceless part of `Sigma_hat`.
    ComovingDeviator,
    /// Vorticity `Sigma_hat - Sigma_hat^T`.
    Vorticity,
    /// `|Vort|^2 = -tr(Vort^2)/2`.
    VorticityNorm,
    /// Canonical momentum `Pi`.
    CanonicalMomentum,
    /// Casimir `C(1) = tr Sigma`, the dilatational momentum.
    Casimir1,
    /// Casimir `C(2) = tr Sigma^2`.
    Casimir2,
    /// Casimir `C(3) = tr Sigma^3`; only for `n = 3`.
    Casimir3,
    /// `tr sigma^2` of the traceless part.
    DeviatorCasimir2,
    /// `tr sigma^3` of the traceless part; only for `n = 3`.
    DeviatorCasimir3,
    /// Entries of momenta that are not conserved as a whole: `Vort_12`, `p_1`, `S_12 - 2*S_13`.
    Component(Component),
}

/// A sum of multiples of entries of momenta in the bases that the user states the model in, as [`Conserved::of`] has them.
///
/// A model lists the sums over `p`, `S`, `x p^T - p x^T` and `Vort`, and over the entries of each affine momentum, that it
/// conserves: a basis, without what follows from momenta that are conserved as a whole. Sums whose factors depend on the fields
/// or the metrics of the model, or have ratios of numbers above 32768, are not listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Component {
    /// The formula.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::word"))]
    pub symbol: Word,
    /// The multiples of entries of momenta whose sum it is.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::interned::list"))]
    pub entries: &'static [Entry],
}

/// A multiple of an entry of a momentum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Entry {
    /// How often it is taken.
    pub factor: i64,
    /// The momentum: a vector, a matrix, or a skew matrix.
    pub of: Conserved,
    /// The row, from 1.
    pub row: usize,
    /// The column, from 1; 1 of a vector. Of a skew matrix it is the larger of both.
    pub column: usize,
}

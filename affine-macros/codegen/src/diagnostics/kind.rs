//! The mistakes, one variant each, with the data that their messages need.

use std::fmt;

/// A mistake in a model, as the user should hear of it; `Display` is the full message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Diagnostic {
    // ---- the notation ----
    /// Something other than a name stands where a list expects `key = value`, `key(...)` or a name.
    ExpectedKey {
        /// The list: `affine_model`, `kinetic`, ...
        list: &'static str,
        /// What stands there.
        found: String,
    },
    /// Something stands between a name and the comma that ends its item.
    MalformedItem {
        /// The list.
        list: &'static str,
        /// What stands there.
        found: String,
    },
    /// A key or term that does not exist.
    UnknownKey {
        /// The list it stands in.
        list: &'static str,
        /// The user's key.
        found: String,
        /// The key probably meant.
        nearest: Option<&'static str>,
        /// All keys of the list.
        known: Vec<&'static str>,
    },
    /// A term of `kinetic(...)` in `hamiltonian(...)`, or the other way round, or such a one in `dissipation(...)`.
    OtherSide {
        /// The list it stands in.
        list: &'static str,
        /// The term.
        key: &'static str,
        /// The list it belongs to.
        other: &'static str,
    },
    /// `kinetic(...)` beside `hamiltonian(...)`.
    TwoStatements,
    /// A key given twice.
    RepeatedKey {
        /// The list it stands in.
        list: &'static str,
        /// The key.
        key: &'static str,
    },
    /// A key that every model needs.
    MissingKey {
        /// The key.
        key: &'static str,
        /// What it states.
        states: &'static str,
        /// How it may look.
        example: &'static str,
    },
    /// A key without `= value`.
    ExpectedValue {
        /// The key.
        key: &'static str,
        /// How it may look.
        example: &'static str,
    },
    /// A key without its parenthesised list.
    ExpectedList {
        /// The key.
        key: &'static str,
        /// How it may look.
        example: &'static str,
    },
    /// `key()`.
    EmptyList {
        /// The key.
        key: &'static str,
        /// How it may look.
        example: &'static str,
    },
    /// A claim, requirement or capability that does not exist.
    UnknownName {
        /// What is named: `claim`, `requirement`, `capability`.
        role: &'static str,
        /// The user's name.
        found: String,
        /// The name probably meant.
        nearest: Option<&'static str>,
        /// All names of this role.
        known: Vec<&'static str>,
    },
    /// A capability beside something that it does not exist for.
    CapabilityBeside {
        /// The capability.
        capability: &'static str,
        /// The other thing.
        beside: &'static str,
    },
    /// `emit(balance)` for a model other than d'Alembert's.
    BalanceBeside {
        /// A term or a key that makes it another.
        part: String,
    },
    /// `emit(splitting)` for a Hamiltonian without pieces whose flows are known.
    NoExactPieces {
        /// What stands against it.
        beside: String,
        /// The reason.
        why: String,
    },
    /// A capability that this version does not have.
    UnavailableCapability {
        /// The capability.
        capability: &'static str,
        /// What it will give.
        gives: &'static str,
    },
    /// `two_polar` for a model that rotations of space or body change.
    NotDoublyIsotropic {
        /// What they change: a term, or the potential.
        part: String,
        /// `space` or `body`.
        side: &'static str,
        /// The rotation or reflection.
        transformation: String,
    },
    /// A part that U(n) does not have.
    UnitaryTerm {
        /// A term, `potential`, or a capability.
        part: &'static str,
    },
    /// `two_polar` for a model with what the lattice does not have.
    LatticeWithout {
        /// What the model has.
        part: String,
        /// What the lattice has not.
        lacks: &'static str,
    },
    /// A dimension other than the literals 2 and 3.
    Dimension {
        /// What is written.
        found: String,
    },
    /// `crate = ...` is not a path.
    RuntimePath {
        /// What is written.
        found: String,
    },
    /// An enum, union or tuple struct.
    ItemKind {
        /// What the item is: `an enum`, ...
        found: &'static str,
    },
    /// An item that is no data type, or that the parser cannot read.
    UnreadableItem {
        /// What the parser says.
        problem: String,
    },

    // ---- expressions ----
    /// A token that does not fit.
    UnexpectedToken {
        /// The token.
        found: String,
        /// What fits there.
        expected: &'static str,
    },
    /// An expression, or an operand, that is missing.
    MissingOperand,
    /// `**`.
    DoubleStar,
    /// `0.2f64`, `2a`.
    NumberSuffix {
        /// The number before the suffix.
        number: String,
        /// The suffix.
        suffix: String,
    },
    /// A literal that is no decimal number: `"0.2"`, `0x10`.
    NotANumber {
        /// The literal.
        literal: String,
    },
    /// A number beyond the range of the machine numbers.
    NumberRange {
        /// The literal.
        literal: String,
    },
    /// `f(...)` or `f[...]` in a coefficient.
    FunctionCall {
        /// What stands before the bracket.
        name: String,
    },
    /// An expression with more operators, or deeper brackets, than the macro accepts.
    ExpressionSize {
        /// The limit that is exceeded.
        limit: &'static str,
    },
    /// `[1, 2]`, `[[1, 2], 3]`.
    FlatMatrix,
    /// A name that is neither a field nor a symbol.
    UnknownSymbol {
        /// The name.
        name: String,
        /// The name probably meant.
        nearest: Option<String>,
        /// The names in scope.
        scope: Vec<String>,
    },
    /// A field in an expression that is not an `f64`.
    FieldType {
        /// The field.
        field: String,
        /// Its type.
        ty: String,
    },
    /// A field named as a symbol of the specification language.
    HiddenSymbol {
        /// The name.
        name: &'static str,
        /// What the symbol means.
        meaning: &'static str,
        /// Where it means that: `in every expression`, `in a potential`.
        place: &'static str,
    },
    /// An exponent that is no integer known when the model is compiled.
    Exponent {
        /// The exponent.
        exponent: String,
    },
    /// Powers of a degree that no coefficient needs.
    Degree {
        /// The degree.
        degree: u64,
        /// The largest accepted.
        limit: u64,
    },
    /// A divisor, or the base of a negative power, that is exactly zero.
    DivisionByZero {
        /// The divisor.
        divisor: String,
    },

    // ---- the potential ----
    /// `f(...)` with a name that is no function.
    UnknownFunction {
        /// The name.
        name: String,
        /// The function probably meant.
        nearest: Option<&'static str>,
        /// Everything that can be applied.
        known: Vec<&'static str>,
    },
    /// A function with too few or too many arguments.
    ArgumentCount {
        /// The function.
        name: &'static str,
        /// Its parameters.
        parameters: &'static [&'static str],
        /// How many arguments there are.
        found: usize,
    },
    /// Something in `tr(...)` or `norm(...)` that has no trace or norm.
    Argument {
        /// `tr` or `norm`.
        name: &'static str,
        /// What stands in the brackets.
        found: String,
    },
    /// `a[1]` for an `a` without indices.
    NotIndexed {
        /// The name.
        name: String,
    },
    /// `G[1]`, `x[i]`: other than the literal indices due.
    Indices {
        /// The form as written.
        written: String,
        /// What is due: `a row and a column`.
        indices: &'static str,
        /// How it may look.
        example: String,
    },
    /// An index below 1 or above n.
    IndexRange {
        /// The form: `G[1,4]`, `I3`.
        written: String,
        /// The index.
        index: usize,
        /// The dimension.
        n: usize,
    },
    /// A matrix or a vector where a number should stand.
    NotScalar {
        /// The name.
        name: String,
        /// `a matrix`, `a vector`.
        meaning: &'static str,
        /// What to write.
        instead: &'static str,
    },
    /// The place of the centre in a model without translation.
    FixedCentre {
        /// The form: `x[1]`, `norm(x)`.
        form: String,
    },
    /// `abs(...)` of what changes its sign.
    NotSmooth {
        /// Its argument.
        argument: String,
    },
    /// A root, a logarithm or a quotient where two stretches coincide.
    Coincidence {
        /// The form: `sqrt(d^2)`.
        written: String,
        /// What vanishes: `d^2`.
        argument: String,
        /// The stretches.
        stretches: (usize, usize),
    },
    /// A potential that changes when two stretches are exchanged.
    NotSymmetric {
        /// The potential.
        energy: String,
        /// The stretches.
        stretches: (usize, usize),
    },
    /// `pairs(f(d))` with `f(d) != f(-d)`.
    OddDifference {
        /// `f(d)`.
        function: String,
    },
    /// `d` outside `pairs(...)`.
    LooseDifference,
    /// A logarithm or a root of a number that is not positive.
    Domain {
        /// The function.
        function: &'static str,
        /// Its argument as written.
        argument: String,
        /// Its value.
        value: String,
    },
    /// An exponent in a potential that is no integer known when the model is compiled.
    PotentialExponent {
        /// The base.
        base: String,
        /// The exponent.
        exponent: String,
        /// The same power through a root or a logarithm.
        instead: String,
    },

    // ---- terms ----
    /// A scalar where a matrix is due, or the other way round.
    TermShape {
        /// The term.
        term: &'static str,
        /// What is written.
        found: &'static str,
        /// What the term takes.
        takes: String,
        /// What to write.
        instead: &'static str,
    },
    /// A matrix of the wrong size.
    MatrixSize {
        /// The term.
        term: &'static str,
        /// What is counted: `rows`, `entries in row 2`, `diagonal entries`.
        counted: String,
        /// How many there are.
        found: usize,
        /// How many are due.
        expected: usize,
        /// Where that number comes from: `n^2 = 9`.
        because: String,
    },
    /// A tensor entry that contains a field.
    TensorEntry {
        /// The term.
        term: &'static str,
        /// The entry.
        entry: String,
    },
    /// `K[(A,B),(C,D)] != K[(C,D),(A,B)]`.
    TensorNotSymmetric {
        /// The term.
        term: &'static str,
        /// The first bi-index, 1-based: `(1,2)`.
        first: String,
        /// The second bi-index.
        second: String,
        /// The value at (first, second).
        value: String,
        /// The value at (second, first).
        transposed: String,
    },
    /// `J[A,B] != J[B,A]`.
    InertiaNotSymmetric {
        /// The term.
        term: &'static str,
        /// The row, 1-based.
        row: usize,
        /// The column, 1-based.
        column: usize,
        /// The value at (row, column).
        value: String,
        /// The value at (column, row).
        transposed: String,
    },
    /// `J` is not positive definite.
    InertiaNotPositive {
        /// The term.
        term: &'static str,
        /// What shows it: `its leading 2 x 2 minor is -3`.
        defect: String,
    },
    /// A translation coefficient that is exactly zero.
    ZeroMass {
        /// The term.
        term: &'static str,
        /// The coefficient as written.
        coefficient: String,
    },
    /// A negative mass beside a d'Alembert energy.
    NegativeMass {
        /// The translation term.
        term: &'static str,
        /// The coefficient as written.
        coefficient: String,
        /// Its value.
        value: String,
    },
    /// An inverse mass that is exactly zero.
    ZeroInverseMass {
        /// The translation term of `hamiltonian(...)`.
        term: &'static str,
        /// The coefficient as written.
        coefficient: String,
    },
    /// `casimir3` for n = 2.
    PlanarCasimir3,
    /// Two terms whose sum has a mass matrix that depends on the placement.
    MixedFrames {
        /// One term.
        first: &'static str,
        /// The velocity in which it has constant coefficients.
        first_velocity: &'static str,
        /// The other term.
        second: &'static str,
        /// The velocity in which that one has constant coefficients.
        second_velocity: &'static str,
    },
    /// Only translation terms, or none.
    NoKineticEnergy,

    // ---- the metrics ----
    /// An entry of a metric that contains a field.
    MetricEntry {
        /// `space` or `body`.
        side: &'static str,
        /// The entry.
        entry: String,
    },
    /// `g_ij != g_ji`.
    MetricNotSymmetric {
        /// `space` or `body`.
        side: &'static str,
        /// The row, 1-based.
        row: usize,
        /// The column, 1-based.
        column: usize,
        /// The value at (row, column).
        value: String,
        /// The value at (column, row).
        transposed: String,
    },
    /// A metric that is not positive definite.
    MetricNotPositive {
        /// `space` or `body`.
        side: &'static str,
        /// What shows it: `g[2,2] = -1`.
        defect: String,
    },
    /// A matrix or tensor beside a metric.
    MetricTerm {
        /// The term.
        term: &'static str,
    },
    /// A form of potentials that depends on the bases.
    MetricForm {
        /// The form: `G[1,2]`, `x[1]`, `tr(phi)`.
        form: String,
    },
    // ---- the constraint ----
    /// A sum of energies of different frames beside a key that does not go with it.
    SumBeside {
        /// The other key.
        key: &'static str,
    },
    /// A dissipation, or a force or potential of a field, beside something that does not go with it.
    ForceBeside {
        /// The part of the model, as written.
        force: String,
        /// The other thing.
        key: &'static str,
    },
    /// A constraint beside a key that does not go with it.
    ConstraintBeside {
        /// The other key.
        key: &'static str,
    },
    /// A term that is zero wherever the constraint holds.
    VanishingTerm {
        /// The term.
        term: &'static str,
        /// The constraint.
        constraint: &'static str,
        /// What velocities are under it: `traceless`, `skew`.
        velocities: &'static str,
    },
    /// An energy in `phi_dot` whose mass matrix depends on the placement under the constraint.
    ConstrainedMassMatrix {
        /// The term.
        term: &'static str,
        /// The constraint.
        constraint: &'static str,
        /// The group: `phi = e^q R with a rotation R`.
        group: &'static str,
    },
    /// A potential that is constant, or has no value, wherever the constraint holds.
    ConstrainedPotential {
        /// `is constant`, `has no value`.
        defect: &'static str,
        /// The constraint.
        constraint: &'static str,
        /// The group: `det phi = 1`.
        group: &'static str,
    },

    // ---- the quadratic form ----
    /// The isotropic form vanishes on some directions.
    Degenerate {
        /// The eigenvalue: `I + A + n B`.
        eigenvalue: String,
        /// The same in the user's numbers: `1 + 2 + 3*(-1)`.
        numbers: String,
        /// The directions.
        directions: Directions,
    },
    /// A stated Hamiltonian whose velocity vanishes on some momenta.
    DegenerateHamiltonian {
        /// The eigenvalue: `2 vorticity_squared - casimir2`.
        eigenvalue: String,
        /// The same in the user's numbers: `2*0.1 - 0.2`.
        numbers: String,
        /// The momenta.
        directions: Directions,
    },
    /// A tensor, or a sum of terms with one, that has a kernel.
    DegenerateTensor {
        /// The terms: `body_tensor`, `body_tensor + casimir2`.
        terms: String,
        /// The velocity in which the form is constant: `Oh`, `Om`, `phi_dot`.
        velocity: &'static str,
        /// A velocity on which it vanishes.
        kernel: String,
    },
    /// A sum of terms of different frames that is degenerate at every placement.
    DegenerateSum {
        /// The terms, joined by `+`.
        terms: String,
    },
    /// `require(positive_definite)` fails.
    NotPositiveDefinite {
        /// What shows it, in the user's numbers: `I - A = 1 - 2 is negative`.
        defect: String,
    },
    /// A claimed symmetry that a term does not have.
    ClaimBroken {
        /// `space` or `body`.
        side: &'static str,
        /// The claim: `affine` or `metric`.
        claim: &'static str,
        /// The group: `GL(3)`, `O(2)`.
        group: String,
        /// The term that breaks it.
        term: &'static str,
        /// The transformation under which it changes: `the generator E[1,2]`, `the reflection diag(-1, 1)`.
        transformation: String,
    },
    /// An affine claim on both sides beside a translation term.
    AffineTranslation {
        /// The translation term.
        term: &'static str,
    },

    // ---- the forces ----
    /// `custom(...)` that does not say what the field computes, or something else in its place.
    MalformedCustom {
        /// `potential` or `forces`.
        key: &'static str,
        /// What stands there.
        found: String,
        /// What it takes besides the field.
        takes: &'static str,
        /// How it may look.
        example: &'static str,
    },
    /// `custom(...)` of something that is no field.
    UnknownField {
        /// The name.
        name: String,
        /// The field probably meant.
        nearest: Option<String>,
        /// The fields.
        fields: Vec<String>,
    },
    /// A force on a centre that stands still.
    FixedCentreForce {
        /// The translation term, or `custom(..)`.
        term: String,
        /// The key it stands in.
        key: &'static str,
    },
    /// A dissipation function that is negative at some velocity.
    NegativeDissipation {
        /// What shows it, in the user's numbers: `I - A = 0.1 - 0.2 = -1/10 on skew velocities (rotation)`.
        defect: String,
    },
}

/// The invariant parts of an affine velocity `O` under rotations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Directions {
    /// `(O + O^T)/2 - (tr O/n) 1`.
    SymmetricTraceless,
    /// `(O - O^T)/2`.
    Skew,
    /// `(tr O/n) 1`.
    Trace,
}

impl fmt::Display for Directions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::SymmetricTraceless => "symmetric traceless velocities (shear)",
            Self::Skew => "skew velocities (rotation)",
            Self::Trace => "multiples of the identity (dilatation)",
        })
    }
}

/// Writes `name` and `NAMES` from one list; the match has no wildcard, so that a variant without a name does
/// not compile.
macro_rules! names {
    ($($variant:ident => $name:literal,)*) => {
        impl Diagnostic {
            /// The names of all mistakes, in the order of the variants.
            pub const NAMES: &[&str] = &[$($name),*];

            /// The stable short name of the mistake, which also ends the first line of its message.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => $name,)*
                }
            }
        }
    };
}

names! {
    ExpectedKey => "expected-key",
    MalformedItem => "malformed-item",
    UnknownKey => "unknown-key",
    OtherSide => "other-side",
    TwoStatements => "two-statements",
    RepeatedKey => "repeated-key",
    MissingKey => "missing-key",
    ExpectedValue => "expected-value",
    ExpectedList => "expected-list",
    EmptyList => "empty-list",
    UnknownName => "unknown-name",
    CapabilityBeside => "capability-beside",
    BalanceBeside => "balance-beside",
    NoExactPieces => "no-exact-pieces",
    UnavailableCapability => "unavailable-capability",
    NotDoublyIsotropic => "not-doubly-isotropic",
    UnitaryTerm => "unitary-term",
    LatticeWithout => "lattice-without",
    Dimension => "dimension",
    RuntimePath => "runtime-path",
    ItemKind => "item-kind",
    UnreadableItem => "unreadable-item",
    UnexpectedToken => "unexpected-token",
    MissingOperand => "missing-operand",
    DoubleStar => "double-star",
    NumberSuffix => "number-suffix",
    NotANumber => "not-a-number",
    NumberRange => "number-range",
    FunctionCall => "function-call",
    ExpressionSize => "expression-size",
    FlatMatrix => "flat-matrix",
    UnknownSymbol => "unknown-symbol",
    FieldType => "field-type",
    HiddenSymbol => "hidden-symbol",
    Exponent => "exponent",
    Degree => "degree",
    DivisionByZero => "division-by-zero",
    UnknownFunction => "unknown-function",
    ArgumentCount => "argument-count",
    Argument => "argument",
    NotIndexed => "not-indexed",
    Indices => "indices",
    IndexRange => "index-range",
    NotScalar => "not-scalar",
    FixedCentre => "fixed-centre",
    NotSmooth => "not-smooth",
    Coincidence => "coincidence",
    NotSymmetric => "not-symmetric",
    OddDifference => "odd-difference",
    LooseDifference => "loose-difference",
    Domain => "domain",
    PotentialExponent => "potential-exponent",
    TermShape => "term-shape",
    MatrixSize => "matrix-size",
    TensorEntry => "tensor-entry",
    TensorNotSymmetric => "tensor-not-symmetric",
    InertiaNotSymmetric => "inertia-not-symmetric",
    InertiaNotPositive => "inertia-not-positive",
    ZeroMass => "zero-mass",
    NegativeMass => "negative-mass",
    ZeroInverseMass => "zero-inverse-mass",
    PlanarCasimir3 => "planar-casimir3",
    MixedFrames => "mixed-frames",
    NoKineticEnergy => "no-kinetic-energy",
    MetricEntry => "metric-entry",
    MetricNotSymmetric => "metric-not-symmetric",
    MetricNotPositive => "metric-not-positive",
    MetricTerm => "metric-term",
    MetricForm => "metric-form",
    ForceBeside => "force-beside",
    ConstraintBeside => "constraint-beside",
    SumBeside => "sum-beside",
    VanishingTerm => "vanishing-term",
    ConstrainedMassMatrix => "constrained-mass-matrix",
    ConstrainedPotential => "constrained-potential",
    Degenerate => "degenerate",
    DegenerateHamiltonian => "degenerate-hamiltonian",
    DegenerateTensor => "degenerate-tensor",
    DegenerateSum => "degenerate-sum",
    NotPositiveDefinite => "not-positive-definite",
    ClaimBroken => "claim-broken",
    AffineTranslation => "affine-translation",
    MalformedCustom => "malformed-custom",
    UnknownField => "unknown-field",
    FixedCentreForce => "fixed-centre-force",
    NegativeDissipation => "negative-dissipation",
}

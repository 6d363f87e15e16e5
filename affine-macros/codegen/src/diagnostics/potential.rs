//! Mistakes in potentials.

use super::message::{Text, listed, suggestion, text};
use super::names::names;

/// A mistake in a potential.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PotentialMistake {
    /// `f(...)` with a name that is no function.
    UnknownFunction {
        /// The name.
        name: String,
        /// The function probably meant.
        nearest: Option<&'static str>,
        /// How a function with this name elsewhere is written here.
        familiar: Option<&'static str>,
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
    /// `2*self_gravity(k)`, or a function of it.
    SummandByItself {
        /// The energy.
        name: &'static str,
    },
    /// `self_gravity(k)` in the plane.
    GravityInThePlane,
    /// Something in `norm(...)` other than `x`.
    Argument {
        /// What stands in the brackets.
        found: String,
    },
    /// A part of a trace that is no polynomial in matrices, or a transpose anywhere.
    Traced {
        /// The part.
        written: String,
        /// What is wrong with it.
        part: TracedPart,
    },
    /// `a[1]` for an `a` without indices.
    NotIndexed {
        /// The name before the brackets.
        name: String,
        /// How a quantity with this name in textbooks is written here.
        familiar: Option<&'static str>,
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
    /// `abs(...)` of what changes its sign, or the root of a square.
    NotSmooth {
        /// The form: `abs(q)`.
        written: String,
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
        /// The same power through a root or a logarithm, where there is one.
        instead: Option<String>,
    },
}

/// What stands in a trace and is no polynomial in matrices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TracedPart {
    /// `sqrt(G)`.
    Function,
    /// `1/G`.
    Divisor,
    /// `phi^T`.
    Transpose,
    /// `G^0.5`.
    Exponent,
    /// `G^-2`, `(G - 1)^-1`, or `G^-1` beside other factors.
    Inverse,
    /// `phi^-1`.
    InversePlacement,
}

impl TracedPart {
    fn text(self, written: &str) -> Text {
        const WHY: &str = "the trace is taken of sums, products and whole powers of `G`, `Ct` and `phi`, where a number stands \
                           for that multiple of the identity";
        match self {
            Self::Function => text(
                format!("`{written}` is a function of a matrix"),
                WHY,
                "write the sum over the stretches: tr(ln(G)) is `2*ln(det)`; for n = 2 tr(ln(G)^2) is `4*(q1^2 + q2^2)` and tr(sqrt(G)) \
                 is `Q1 + Q2`",
            ),
            Self::Divisor => text(
                format!("the divisor `{written}` is a matrix"),
                WHY,
                "divide by a number; an inverse is a power, as in `tr(G^-1)`",
            ),
            Self::Transpose => text(
                format!("`{written}` is a transpose, which has no notation here"),
                "`G = phi^T phi` and `Ct = phi phi^T` are the products of the placement, the deformation gradient, with its transpose",
                "write `G` for `phi^T*phi` and `Ct` for `phi*phi^T`",
            ),
            Self::Exponent => text(
                format!("the exponent of `{written}` is not a whole number in digits, of at most 16"),
                WHY,
                "write a digit, as in `G^2`; tr(G^a) is `Q1^(2*a) + Q2^(2*a)` for n = 2, for a number `a`",
            ),
            Self::Inverse => text(
                format!("`{written}` has an inverse other than `G^-1` or `Ct^-1` by itself"),
                "tr(G^-1) is a function of the invariants, `I1/I2` for n = 2 and `I2/I3` for n = 3; products with an inverse are \
                 not expanded",
                "write `tr(G^-1)` as a summand or factor; tr(G^-2) is `tr(G^-1)^2 - 2/I2` for n = 2 and `tr(G^-1)^2 - 2*I1/I3` \
                 for n = 3",
            ),
            Self::InversePlacement => text(
                format!("`{written}` is an inverse of `phi`, which has no notation here"),
                "by Cayley and Hamilton tr(phi^-1) is a function of tr(phi), tr(phi^2) and det phi; tr(G^-1) is another quantity",
                "for tr(phi^-1) write `tr(phi)/det` for n = 2 and `(tr(phi)^2 - tr(phi^2))/(2*det)` for n = 3",
            ),
        }
    }
}

names! { PotentialMistake
    UnknownFunction => "unknown-function",
    ArgumentCount => "argument-count",
    SummandByItself => "summand-by-itself",
    GravityInThePlane => "gravity-in-the-plane",
    Argument => "argument",
    Traced => "traced",
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
}

impl PotentialMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::UnknownFunction { name, nearest, familiar, known } => text(
                format!("there is no function `{name}`"),
                format!("a potential can use {}", listed(known)),
                familiar.map_or_else(
                    || suggestion(*nearest, "use one of these; a product has its sign, as in `a*(b + c)`"),
                    str::to_owned,
                ),
            ),
            Self::ArgumentCount { name, parameters, found } => text(
                format!("`{name}` has {}", arguments(*found)),
                format!("`{name}` takes {}", arguments(parameters.len())),
                format!("write `{name}({})`", parameters.join(", ")),
            ),
            Self::SummandByItself { name } => text(
                format!("`{name}(k)` within an expression"),
                "it is computed by an iteration, and is a summand of the potential by itself",
                format!("write `+ {name}(k)`, with its factor and its sign in `k`"),
            ),
            Self::GravityInThePlane => text(
                "`self_gravity(k)` is the energy of a body in space",
                "in the plane the gravity of a disc and that of a cylinder are different",
                "write `k/2*ln(tr(G) + 2*det)` for an infinite elliptic cylinder, of which `k = G m^2` for a mass `m` per length",
            ),
            Self::Argument { found } => text(
                format!("`norm({found})` is not defined"),
                "the norm is that of the place of the centre, `x`",
                "write `norm(x)`; the norm of a matrix is the root of a trace, `sqrt(tr(G))` that of `phi` and `sqrt(tr(G^2))` \
                 that of `G`",
            ),
            Self::Traced { written, part } => part.text(written),
            Self::NotIndexed { name, familiar } => text(
                format!("`{name}` has no indices"),
                "the matrices `G`, `Ct` and `phi` have entries, as in `G[1,2]`, and `x` has coordinates, as in `x[1]`",
                familiar.unwrap_or("index one of these, or remove the brackets; a field holds one number"),
            ),
            Self::Indices { written, indices, example } => text(
                format!("`{written}` does not name one number"),
                format!("it takes {indices} from 1 to n, in digits"),
                format!("write `{example}`"),
            ),
            Self::IndexRange { written, index, n } => text(
                format!("`{written}` does not exist: {index} is not between 1 and {n}"),
                format!("indices count from 1 to the dimension, n = {n}"),
                format!("write an index from 1 to {n}"),
            ),
            Self::NotScalar { name, meaning, instead } => text(
                format!("`{name}` is {meaning}, not a number"),
                "a potential energy is a number, and so is every part of it",
                format!("write {instead}"),
            ),
            Self::FixedCentre { form } => text(
                format!("`{form}` depends on the place of the body, but the model has no translation"),
                "without a translational kinetic energy the centre is fixed in space, and x is not part of the state",
                format!(
                    "add `space_translation = m` or `body_translation = m` to `kinetic(...)`, or remove `{form}`"
                ),
            ),
            Self::NotSmooth { written } => text(
                format!("`{written}` is not smooth where its argument is zero"),
                "the force is the derivative of the potential, and it or a derivative of it jumps there, where methods lose \
                 their order; `abs(a)` and `sqrt(a^2)` are the same function",
                "use a smooth function, as in `sqrt(a^2 + b^2)` with a constant b, or an even power, as in `a^2` or \
                 `abs(a)^2`",
            ),
            Self::Coincidence { written, argument, stretches: (a, b) } => text(
                format!("`{written}` is not smooth where the stretches Q{a} and Q{b} coincide"),
                format!(
                    "`{argument}` vanishes there, in particular for an undeformed body: a root has a kink, a \
                     logarithm and a quotient have a pole, or 0/0 where the quotient as a whole is smooth"
                ),
                "write a function that is smooth there, as `cosh(d)`, `d^2` or `sqrt(d^2 + b^2)` with a constant b",
            ),
            Self::NotSymmetric { energy, stretches: (a, b) } => text(
                format!("the potential changes when the stretches Q{a} and Q{b} are exchanged"),
                format!(
                    "stretches have no order of their own, so that `{energy}` is a function of phi only if every \
                     exchange of indices leaves it unchanged"
                ),
                "treat all stretches alike, as in `q1^4 + q2^4` for n = 2 or `pairs(d^2)`",
            ),
            Self::OddDifference { function } => text(
                format!("`{function}` changes with the sign of `d`"),
                "`pairs(f(d))` sums over pairs of stretches, whose order means nothing: d = q_a - q_b and its \
                 opposite belong to the same pair",
                "write an even function, as `d^2`, `cosh(d)` or `1/cosh(d)^2`",
            ),
            Self::LooseDifference => text(
                "`d` stands outside `pairs(...)`",
                "it is the difference q_a - q_b of the two log-stretches of a pair, and here there is no pair",
                "write `pairs(f(d))` for a sum over all pairs, or `q1 - q2` for one difference",
            ),
            Self::Domain { function, argument, value } => text(
                format!("`{function}({argument})` is taken of {value}, which is not positive"),
                "real logarithms exist for positive numbers only, and square roots are smooth only there",
                "write a positive argument",
            ),
            Self::PotentialExponent { base, exponent, instead } => text(
                format!("the exponent `{exponent}` of `{base}` is not an integer known at compile time"),
                "a real power with another exponent exists for a positive base only: a root or an exponential, \
                 written as such",
                match instead {
                    Some(instead) => format!("write `{instead}`"),
                    None => "write a positive base".to_owned(),
                },
            ),
        }
    }
}

/// `1 argument`, `2 arguments`.
fn arguments(count: usize) -> String {
    format!("{count} argument{}", if count == 1 { "" } else { "s" })
}

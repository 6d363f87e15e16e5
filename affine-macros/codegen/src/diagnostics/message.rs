//! The texts. Every message has three parts: what is wrong, why, and what to write instead.

use std::fmt;

use super::Diagnostic;

/// The three parts of a message.
struct Text {
    what: String,
    why: String,
    instead: String,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Text { what, why, instead } = self.text();
        write!(f, "{what} [{}]\nwhy: {why}\ninstead: {instead}", self.name())
    }
}

fn text(what: impl Into<String>, why: impl Into<String>, instead: impl Into<String>) -> Text {
    Text { what: what.into(), why: why.into(), instead: instead.into() }
}

/// `` `a`, `b` and `c` ``.
fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
        None => "none".to_owned(),
    }
}

/// The nearest known name, or else the advice to pick one.
fn suggestion(nearest: Option<&str>, otherwise: &str) -> String {
    nearest.map_or_else(|| otherwise.to_owned(), |name| format!("did you mean `{name}`?"))
}

impl Diagnostic {
    fn text(&self) -> Text {
        match self {
            Self::ExpectedKey { list, found } => text(
                format!("`{list}(...)` has {found} where a name should stand"),
                format!("the items of `{list}(...)` are separated by commas and each begins with a name"),
                "write `name = value`, `name(...)` or `name`, as the item asks",
            ),
            Self::MalformedItem { list, found } => text(
                format!("{found} does not belong to this item of `{list}(...)`"),
                "an item is `name = value`, `name(...)` or `name`, and ends with a comma",
                "put a comma or `=` before it, or remove it",
            ),
            Self::UnknownKey { list, found, nearest, known } => text(
                format!("`{list}(...)` has no item `{found}`"),
                format!("its items are {}", listed(known)),
                suggestion(*nearest, "use one of these, or remove it"),
            ),
            Self::OtherSide { list, key, other } => text(
                format!("`{key}` does not belong to `{list}(...)`"),
                match *list {
                    "kinetic" => format!(
                        "`{key}` is a function of the momentum, and `kinetic(...)` states T through velocities"
                    ),
                    "dissipation" => format!(
                        "`{key}` is a function of the momentum, and `dissipation(...)` states R through velocities"
                    ),
                    _ => format!(
                        "`{key}` is a form in the velocity, and `hamiltonian(...)` states H through momenta"
                    ),
                },
                match *list {
                    "dissipation" => format!("remove `{key}`, or state R through forms in the velocity"),
                    _ => format!(
                        "state all terms in `{other}(...)`, with the coefficients that they have there"
                    ),
                },
            ),
            Self::TwoStatements => text(
                "the kinetic energy is stated twice, in `kinetic(...)` and in `hamiltonian(...)`",
                "each determines the other: T by the velocities, H by the momenta",
                "keep one of them, and state all terms there",
            ),
            Self::RepeatedKey { list, key } => text(
                format!("`{key}` stands twice in `{list}(...)`"),
                "an item is given once; two values would contradict each other or hide a slip",
                "keep one of them; coefficients may be sums, as in `casimir2 = a + b`",
            ),
            Self::MissingKey { key, states, example } => text(
                format!("`affine_model(...)` lacks `{key}`"),
                format!("it states {states}, which has no default"),
                format!("add `{example}`"),
            ),
            Self::ExpectedValue { key, example } => text(
                format!("`{key}` has no value"),
                format!("`{key}` takes one value, after an equals sign"),
                format!("write `{example}`"),
            ),
            Self::ExpectedList { key, example } => text(
                format!("`{key}` has no list"),
                format!("`{key}` takes a list in parentheses, directly after the name"),
                format!("write `{example}`"),
            ),
            Self::EmptyList { key, example } => text(
                format!("`{key}()` is empty"),
                "an empty list states nothing",
                format!("write `{example}`, or remove `{key}`"),
            ),
            Self::UnknownName { role, found, nearest, known } => text(
                format!("there is no {role} `{found}`"),
                format!("the specification language has {}", listed(known)),
                match (nearest, known.as_slice()) {
                    (None, [only]) => format!("write `{only}`, or remove it"),
                    _ => suggestion(*nearest, "use one of these, or remove it"),
                },
            ),
            Self::CapabilityBeside { capability, beside } => text(
                format!("`emit({capability})` does not go with {beside} in this version"),
                "its recurrences follow from the operations of one autonomous right-hand side",
                format!(
                    "remove `{capability}` from `emit(...)`: Runge-Kutta and Gauss methods integrate the model"
                ),
            ),
            Self::BalanceBeside { part } => text(
                format!("`emit(balance)` is that of d'Alembert models, and does not go with {part}"),
                "the kinematical spin K = phi J phi_dot^T is the affine spin, and dK/dt = phi_dot J phi_dot^T + N (3.6), for \
                 the energy m/2 |x_dot|^2 + 1/2 tr(phi_dot J phi_dot^T) (2.1) of a motion on all of GL(n) alone",
                "remove `balance` from `emit(...)`, or state the energy by `dalembert` and `space_translation` alone",
            ),
            Self::NoExactPieces { beside, why } => text(
                format!("`emit(splitting)` does not go with {beside}"),
                why.clone(),
                "remove `splitting` from `emit(...)`: Gauss collocation is symmetric and integrates the model",
            ),
            Self::UnavailableCapability { capability, gives } => text(
                format!("the capability `{capability}` is not available in this version"),
                format!(
                    "it will give {gives}; this version emits the default, Hamilton's equations, `splitting`, `taylor`, \
                      `two_polar` and `lanes`"
                ),
                format!("remove `{capability}` from `emit(...)`"),
            ),
            Self::NotDoublyIsotropic { part, side, transformation } => text(
                format!("`two_polar` needs a doubly isotropic model, and {part} is not isotropic in {side}"),
                format!(
                    "{transformation} of {side} changes it: the motion of the stretches in phi = L D R^T then depends \
                     on the frames L and R, and (q, p, M, N) do not form a system of their own, (6.2) to (6.5)"
                ),
                format!(
                    "remove `two_polar` from `emit(...)`, or state a model that rotations of {side} do not change"
                ),
            ),
            Self::UnitaryTerm { part } => text(
                format!("`{part}` has no place beside `group = unitary`"),
                "on U(n) the energy is -A/2 tr Om^2 - B/2 (tr Om)^2 (89), which U(n) leaves unchanged from both sides; it is \
                 emitted as its lattice on the circle and nothing else",
                format!("remove `{part}`, and keep `casimir2` and `casimir1_squared`"),
            ),
            Self::LatticeWithout { part, lacks } => text(
                format!("`two_polar` with {part}: the lattice has no {lacks}"),
                "(q, p, M, N) of (6.2) to (6.5) describe the internal motion on GL(n) alone, of an energy in velocities, in \
                 orthonormal coordinates",
                format!("remove `two_polar` from `emit(...)`, or state a model without {part}"),
            ),
            Self::Dimension { found } => text(
                format!("`dim = {found}`: the dimension is 2 or 3"),
                "the equations are written out component by component for GL(2) and GL(3)",
                "write `dim = 2` or `dim = 3`, as a literal",
            ),
            Self::RuntimePath { found } => text(
                format!("`crate = {found}` is not a path"),
                "`crate` names the runtime crate where it was renamed or re-exported",
                "write a path such as `crate = ::my_crate::affine_runtime`",
            ),
            Self::ItemKind { found } => text(
                format!("`#[affine_model]` stands on {found}"),
                "the parameters of a model are the named fields of a struct; a model without parameters is a \
                 unit struct",
                "write `struct Model;` or `struct Model { a: f64, b: f64 }`",
            ),
            Self::UnreadableItem { problem } => text(
                format!("`#[affine_model]` cannot read this item: {problem}"),
                "the parameters of a model are the named fields of a struct; a model without parameters is a \
                 unit struct",
                "write `struct Model;` or `struct Model { a: f64, b: f64 }`",
            ),
            Self::UnexpectedToken { found, expected } => text(
                format!("{found} where {expected} should stand"),
                "expressions are made of decimal numbers, fields, `n`, the operators `+ - * / ^` and parentheses",
                format!("put {expected} before it, or remove it; a product has its sign, as in `2*a`"),
            ),
            Self::MissingOperand => text(
                "an expression ends where a number, a field or `(` should stand",
                "every operator needs its operands, and every place in a list its value",
                "write the missing value, or remove the operator or comma",
            ),
            Self::DoubleStar => text(
                "`**` is not an operator",
                "powers are written with `^`, which binds tighter than a minus sign: `-q^2` is `-(q^2)`",
                "write `a^2`",
            ),
            Self::NumberSuffix { number, suffix } => text(
                format!("the number `{number}{suffix}` has the suffix `{suffix}`"),
                "numbers are exact rationals (`0.2` is 1/5) and have no machine type; a product has its sign",
                if is_machine_type(suffix) {
                    format!("write `{number}`")
                } else {
                    format!("write `{number}*{suffix}`")
                },
            ),
            Self::NotANumber { literal } => text(
                format!("`{literal}` is not a decimal number"),
                "coefficients are exact rationals written in decimal, such as `2`, `0.2`, `1e-3` or `1/3`",
                "write a decimal number",
            ),
            Self::NumberRange { literal } => text(
                format!("the number `{literal}` is beyond the range of machine numbers"),
                "coefficients are rounded to f64 in the end, which spans about 1e-308 to 1e308",
                "choose units in which the coefficients are of moderate size",
            ),
            Self::FunctionCall { name } => text(
                format!("`{name}` is applied to brackets, but a coefficient has no functions and no indices"),
                "the coefficients of a kinetic energy are constants: arithmetic over numbers, fields and `n`",
                "compute the value and keep it in a field; a product has its sign, as in `a*(b + c)`",
            ),
            Self::ExpressionSize { limit } => text(
                format!("the expression has more than {limit}"),
                "the macro bounds what it works through, so that a slip cannot stall a build",
                "split it: compute a part and keep it in a field",
            ),
            Self::FlatMatrix => text(
                "a row of a matrix is not in brackets",
                "a matrix is an array of rows, and a row is an array of entries",
                "write `[[a, b], [c, d]]`, or `diag(a, d)`",
            ),
            Self::UnknownSymbol { name, nearest, scope } => text(
                format!("there is no field or symbol `{name}`"),
                format!("an expression can use {}", listed(scope)),
                suggestion(nearest.as_deref(), &format!("add a field `{name}: f64`")),
            ),
            Self::FieldType { field, ty } => text(
                format!("the field `{field}` has type `{ty}` and cannot stand in an expression"),
                "a coefficient is a real number; fields of other types are left alone",
                format!("write `{field}: f64` in the struct, spelled `f64` and not as an alias"),
            ),
            Self::HiddenSymbol { name, meaning, place } => text(
                format!("the field `{name}` hides the symbol `{name}`"),
                format!("`{name}` means {meaning} {place}"),
                "give the field another name",
            ),
            Self::Exponent { exponent } => text(
                format!("the exponent `{exponent}` is not an integer known at compile time"),
                "the inverse of a kinetic energy is derived exactly, in rational functions of the coefficients",
                "write an integer, as in `a^2` or `a^-1`; keep a root in a field of its own",
            ),
            Self::Degree { degree, limit } => text(
                format!("these powers have degree {degree}"),
                format!(
                    "the macro computes them exactly and stops at degree {limit}, so that a slip cannot stall a build"
                ),
                "write a lower power; a power of fields can be computed beforehand and kept in a field",
            ),
            Self::DivisionByZero { divisor } => text(
                format!("division by `{divisor}`, which is zero"),
                "a quotient by zero has no value; coefficients are exact, so that no rounding made this one vanish",
                "write a divisor that is not zero",
            ),
            Self::UnknownFunction { name, nearest, known } => text(
                format!("there is no function `{name}`"),
                format!("a potential can use {}", listed(known)),
                suggestion(*nearest, "use one of these; a product has its sign, as in `a*(b + c)`"),
            ),
            Self::ArgumentCount { name, parameters, found } => text(
                format!("`{name}` has {}", arguments(*found)),
                format!("`{name}` takes {}", arguments(parameters.len())),
                format!("write `{name}({})`", parameters.join(", ")),
            ),
            Self::Argument { name, found } => match *name {
                "norm" => text(
                    format!("`norm({found})` is not defined"),
                    "the norm is that of the place of the centre, `x`",
                    "write `norm(x)`; that of the placement is `sqrt(tr(G))`",
                ),
                _ => text(
                    format!("`{name}({found})` is not defined"),
                    "the trace is taken of one of the matrices `G`, `Ct` and `phi`, or of a product with `*`",
                    "write `tr(G)`, `tr(G*G)`, ...; sums and factors stand outside, as in `tr(G*G) - 2*tr(G) + n`",
                ),
            },
            Self::NotIndexed { name } => text(
                format!("`{name}` has no indices"),
                "the matrices `G`, `Ct` and `phi` have entries, as in `G[1,2]`, and `x` has coordinates, as in `x[1]`",
                "index one of these, or remove the brackets; a field holds one number",
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
            Self::NotSmooth { argument } => text(
                format!("`abs({argument})` is not smooth where its argument is zero"),
                "the force is the derivative of the potential, and it jumps there; `sqrt(a^2)` is the same function",
                "use a smooth function, as in `sqrt(a^2 + b^2)` with a constant b, or a power, as in `a^2` or \
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
                format!("write `{instead}`"),
            ),
            Self::TermShape { term, found, takes, instead } => {
                text(format!("`{term}` is given {found}"), format!("`{term}` takes {takes}"), *instead)
            }
            Self::MatrixSize { term, counted, found, expected, because } => text(
                format!("the matrix of `{term}` has {found} {counted}, not {expected}"),
                format!("its size follows from the dimension: {because}"),
                format!("write {expected} {counted}"),
            ),
            Self::TensorEntry { term, entry } => text(
                format!("the entry `{entry}` of `{term}` depends on a field"),
                "this version inverts the tensor exactly when the model is compiled, which needs numbers",
                "write numbers; isotropic energies with fields are `body_inertia`, `space_inertia`, `casimir2`, \
                 `casimir1_squared`",
            ),
            Self::TensorNotSymmetric { term, first, second, value, transposed } => text(
                format!(
                    "`{term}` is not symmetric: K[{first},{second}] = {value}, K[{second},{first}] = {transposed}"
                ),
                "in 1/2 K[(A,B),(C,D)] O[A,B] O[C,D] (4.1), (4.2) only the part symmetric under exchange of the \
                 pairs (A,B), (C,D) counts; row (A,B) is row n(A-1)+B, columns likewise",
                "write the same entry in both places; their mean gives the same energy",
            ),
            Self::InertiaNotSymmetric { term, row, column, value, transposed } => text(
                format!(
                    "the inertia of `{term}` is not symmetric: J[{row},{column}] = {value}, \
                     J[{column},{row}] = {transposed}"
                ),
                "T sees only the symmetric part of J (4.17), the integral of a a^T over the masses in (2.1)",
                "write the same entry in both places; their mean gives the same energy",
            ),
            Self::InertiaNotPositive { term, defect } => text(
                format!("the inertia of `{term}` is not positive definite: {defect}"),
                "J is the quadratic moment of positive masses, and H needs its inverse: \
                 Pi = J phi_dot^T (2.2)",
                "write a symmetric J whose leading minors are all positive; indefinite energies are stated with \
                 `casimir2`, `casimir1_squared`, `body_inertia`, `space_inertia`",
            ),
            Self::ZeroMass { term, coefficient } => text(
                format!("`{term} = {coefficient}` is zero"),
                "the momentum is the mass times the velocity (4.6), (4.8) and does not determine it",
                format!("write a mass that is not zero, or remove `{term}`: the body is then fixed in space"),
            ),
            Self::NegativeMass { term, coefficient, value } => text(
                format!("`{term} = {}` is negative", equated(coefficient, value)),
                "`dalembert` is the kinetic energy of positive masses (2.1), and these are the same masses",
                "write a positive mass",
            ),
            Self::ZeroInverseMass { term, coefficient } => text(
                format!("`{term} = {coefficient}` is zero"),
                "in `hamiltonian(...)` it is the inverse mass, the velocity is that times the momentum, and does not \
                 determine it",
                format!("write `{term} = 1/m`, or remove `{term}`: the body is then fixed in space"),
            ),
            Self::PlanarCasimir3 => text(
                "`casimir3` is for `dim = 3`",
                "for n = 2, tr X^3 = (3 tr X tr X^2 - (tr X)^3)/2 (Cayley and Hamilton) is no invariant of its own",
                "remove `casimir3`, or write `dim = 3`",
            ),
            Self::MixedFrames { first, first_velocity, second, second_velocity } => text(
                format!("`{first}` and `{second}` do not go together in this version"),
                format!(
                    "`{first}` is a constant form in {first_velocity}, `{second}` in {second_velocity}: \
                     their sum has a mass matrix that depends on phi"
                ),
                format!("keep `{first}` or `{second}`"),
            ),
            Self::NoKineticEnergy => text(
                "there is no kinetic energy of the internal motion",
                "without a term in phi_dot the Legendre transformation has no inverse: Sigma = (dT/dOm)^T = 0",
                "add `casimir2`, `body_inertia`, `space_inertia`, `dalembert`, `body_tensor`, `space_tensor` or `flat_tensor`",
            ),
            Self::MetricEntry { side, entry } => text(
                format!("the entry `{entry}` of the metric `{side}` depends on a field"),
                "this version finds the orthonormal bases when the model is compiled, which needs numbers",
                "write numbers",
            ),
            Self::MetricNotSymmetric { side, row, column, value, transposed } => text(
                format!(
                    "the metric `{side}` is not symmetric: its entry ({row},{column}) is {value}, \
                     ({column},{row}) is {transposed}"
                ),
                "a metric is a scalar product, g(u, v) = g(v, u)",
                "write the same entry in both places",
            ),
            Self::MetricNotPositive { side, defect } => text(
                format!("the metric `{side}` is not positive definite: {defect}"),
                "a metric gives every vector but zero a positive length, and has an orthonormal basis only then",
                "write a symmetric matrix whose leading minors are all positive",
            ),
            Self::MetricTerm { term } => text(
                format!("`{term}` with a matrix does not go with `metrics(...)` in this version"),
                "equations stand in orthonormal bases of the metrics, in which its entries are in general irrational",
                "write a scalar, or state the model in orthonormal bases and leave out `metrics(...)`",
            ),
            Self::MetricForm { form } => text(
                format!("`{form}` does not go with `metrics(...)` in this version"),
                "equations stand in orthonormal bases of the metrics, and this form depends on the bases",
                "write the potential through `q`, `det`, `I1..In`, `norm(x)` and traces of powers of `G` or of `Ct`",
            ),
            Self::SumBeside { key } => text(
                format!("`{key}` does not go with terms of different frames in this version"),
                "their sum has a mass matrix that depends on phi, and is derived on all of GL(n) in orthonormal bases",
                format!("keep the terms of one frame, or remove `{key}`"),
            ),
            Self::ForceBeside { force, key } => text(
                format!("`{force}` does not go with {key} in this version"),
                match *key {
                    "`constraint = isochoric` of `dalembert`" => {
                        "there a multiplier keeps the constraint, in a method whose kicks do not depend on the velocity: \
                         only potentials go with it"
                    }
                    "`metrics(...)`" => {
                        "velocities and placements would reach it in other bases than those that points stand in"
                    }
                    "`casimir3`" => {
                        "what it leaves conserved is decided for velocities that are linear in the momenta"
                    }
                    "`group = unitary`" => "the lattice of U(n) is that of the Casimir terms alone",
                    "terms of different frames" => {
                        "what it leaves conserved is decided for a mass matrix that is constant in one frame"
                    }
                    _ => "what is emitted there is derived from T and from potentials that are formulas",
                },
                "remove one of the two",
            ),
            Self::ConstraintBeside { key } => text(
                format!("`constraint` does not go with `{key}` in this version"),
                match *key {
                    "metrics(...)" => {
                        "the group of a constraint is that of orthonormal bases, and points stand in others"
                    }
                    _ => "under a constraint momenta are restricted, and T is known only from velocities",
                },
                match *key {
                    "metrics(...)" => "state the model in orthonormal bases and leave out `metrics(...)`",
                    _ => "state the energy in `kinetic(...)`",
                },
            ),
            Self::VanishingTerm { term, constraint, velocities } => text(
                format!("`{term}` is zero under `constraint = {constraint}`"),
                format!("affine velocities are {velocities} there, and it is zero on all of them"),
                format!("remove `{term}` or the constraint"),
            ),
            Self::ConstrainedMassMatrix { term, constraint, group } => text(
                format!("`{term}` has no constant mass matrix under `constraint = {constraint}`"),
                format!(
                    "phi_dot = phi Oh with {group}: as a form of Oh it depends on phi; of the energies in phi_dot only \
                     `dalembert` goes with a constraint, of which at most D is left or a multiplier keeps det phi = 1"
                ),
                "write `dalembert`, or `body_tensor`, which is constant in Oh, or remove the constraint",
            ),
            Self::ConstrainedPotential { defect, constraint, group } => text(
                format!("this potential {defect} under `constraint = {constraint}`"),
                match *constraint {
                    "rigid" => format!("{group}: q = 0, det phi = 1, and G and Ct are the identity"),
                    "conformal" => format!("{group}: G and Ct are exp(2q) times the identity"),
                    _ => format!("{group}: q = 0 and D = 1"),
                },
                match *defect {
                    "is constant" => "remove the potential or the constraint",
                    _ => "write a potential that is finite there, or remove the constraint",
                },
            ),
            Self::Degenerate { eigenvalue, numbers, directions } => text(
                format!(
                    "the kinetic energy is degenerate: {} = 0 on {directions}",
                    equated(eigenvalue, numbers)
                ),
                format!(
                    "the Legendre transformation X = I O^T + A O + B tr(O) 1 (4.18), (4.20) has the eigenvalue \
                     {eigenvalue} there; the momentum does not determine the velocity"
                ),
                format!(
                    "change a coefficient so that {eigenvalue} is not zero; I is the sum of the inertias, \
                     A is `casimir2`, B is `casimir1_squared`"
                ),
            ),
            Self::DegenerateHamiltonian { eigenvalue, numbers, directions } => {
                let value = if numbers == "0" { eigenvalue.clone() } else { equated(eigenvalue, numbers) };
                let directions = directions.to_string().replace("velocities", "momenta");
                text(
                    format!("the Hamiltonian is degenerate: {value} = 0 on {directions}"),
                    format!(
                        "the velocity O = a X + b tr(X) 1 - c (X - X^T) has the eigenvalue {eigenvalue} there; it does \
                         not determine the momentum X"
                    ),
                    format!(
                        "change a coefficient so that {eigenvalue} is not zero; a is `casimir2`, b `casimir1_squared`, \
                         c `vorticity_squared` or `spin_squared`"
                    ),
                )
            }
            Self::DegenerateTensor { terms, velocity, kernel } => text(
                format!("the kinetic energy is degenerate: `{terms}` vanishes on {velocity} = {kernel}"),
                "the Legendre transformation X[B,A] = K[(A,B),(C,D)] O[C,D] (4.6), (4.8) gives zero momentum \
                 there; the momentum does not determine the velocity",
                "change a coefficient, or add a term that is not zero on this velocity",
            ),
            Self::DegenerateSum { terms } => text(
                format!("the kinetic energy `{terms}` is degenerate at every placement"),
                "its terms have constant coefficients in different velocities, so that the mass matrix over phi_dot \
                 depends on phi; its determinant is zero for all phi, and the momentum Pi = (dT/dphi_dot)^T does not \
                 determine the velocity",
                "add a term that is not zero on any velocity, such as `dalembert` or `body_inertia`",
            ),
            Self::NotPositiveDefinite { defect } => text(
                format!("the kinetic energy is not positive definite: {defect}"),
                "`require(positive_definite)` asks for T > 0 at every velocity that is not zero; an isotropic form has it iff \
                 I > |A| and I + A + n B > 0",
                "change the coefficients, or remove the requirement: indefinite energies are legitimate",
            ),
            Self::ClaimBroken { side, claim, group, term, transformation } => text(
                format!("`{term}` breaks the claim `{side} = {claim}`"),
                format!(
                    "the claim is that T is invariant under {group} acting {}, and T of `{term}` changes under \
                     {transformation}",
                    if *side == "space" { "in space, phi -> L phi" } else { "in the body, phi -> phi R" },
                ),
                format!(
                    "claim less, {}, or replace the term",
                    if *claim == "affine" {
                        format!("`{side} = metric` or `{side} = none`")
                    } else {
                        format!("`{side} = none`")
                    },
                ),
            ),
            Self::AffineTranslation { term } => text(
                format!("`{term}` cannot be affine in space and in the body at once"),
                "every form on the affine group that is invariant on both sides is degenerate (section 4, \
                 after (4.5)): a translational energy needs a metric on one side",
                format!("claim `metric` on one side, or remove `{term}`"),
            ),
            Self::MalformedCustom { key, found, takes, example } => text(
                format!("`{key}` has {found} where `custom(field, ..)` should say what a field computes"),
                format!("it is a summand by itself, and takes {takes}"),
                format!("write `{key} = {example}`"),
            ),
            Self::UnknownField { name, nearest, fields } => text(
                format!("there is no field `{name}`"),
                format!("`custom(field, ..)` calls a field of the struct, which has {}", listed(fields)),
                suggestion(
                    nearest.as_deref(),
                    "add the field, of a type that implements `affine_runtime::force::Force` or \
                     `affine_runtime::potential::Potential`",
                ),
            ),
            Self::FixedCentreForce { term, key } => text(
                format!("`{term}` in `{key}` acts on a centre that stands still"),
                "without a translational kinetic energy the centre is fixed in space: x_dot = 0, and p is not part of \
                 the state",
                format!(
                    "add `space_translation = m` or `body_translation = m` to `kinetic(...)`, or remove `{term}`"
                ),
            ),
            Self::NegativeDissipation { defect } => text(
                format!("the dissipation is negative: {defect}"),
                "the forces of R have the power -2 R; where R < 0 they would feed energy in. The terms of each frame \
                 count together; casimir terms count with those of the body, or else with those of space",
                "change a coefficient so that R >= 0 at every velocity; an isotropic R has it iff I >= |A| and \
                 I + A + n B >= 0, where I is the inertia, A is `casimir2`, B is `casimir1_squared`",
            ),
        }
    }
}

/// `1 argument`, `2 arguments`.
fn arguments(count: usize) -> String {
    format!("{count} argument{}", if count == 1 { "" } else { "s" })
}

/// Would a Rust programmer mean the type of the number, rather than a factor?
fn is_machine_type(suffix: &str) -> bool {
    let size = suffix.strip_prefix(['f', 'i', 'u']);
    size.is_some_and(|size| matches!(size, "8" | "16" | "32" | "64" | "128" | "size"))
}

/// `a = b`, or `a` alone where both are the same text.
fn equated(name: &str, value: &str) -> String {
    if name == value { name.to_owned() } else { format!("{name} = {value}") }
}

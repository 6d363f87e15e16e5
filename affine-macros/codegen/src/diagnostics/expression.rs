//! Mistakes in expressions of all kinds.

use super::message::{Text, listed, suggestion, text};
use super::names::names;

/// A mistake in an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExpressionMistake {
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
    /// `"2*q"`.
    Quoted {
        /// The literal.
        literal: String,
    },
    /// A number beyond the range of the machine numbers.
    NumberRange {
        /// The literal.
        literal: String,
    },
    /// A number of the equations that no double holds.
    ValueRange {
        /// What it comes from.
        expression: String,
        /// The number.
        number: String,
    },
    /// `a.powi(2)`, `self.a`.
    RustNotation {
        /// What stands there.
        written: String,
        /// What to write.
        instead: String,
    },
    /// `std::f64::consts::PI`.
    Path {
        /// The path.
        path: String,
        /// How a field may be called instead.
        field: String,
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
    /// `[[1, 2] [3, 4]]`.
    MissingComma,
    /// A name that is neither a field nor a symbol.
    UnknownSymbol {
        /// The name.
        name: String,
        /// The name probably meant.
        nearest: Option<String>,
        /// How a quantity with this name in textbooks is written here.
        familiar: Option<&'static str>,
        /// The names in scope.
        scope: Vec<String>,
    },
    /// A symbol of potentials where a constant stands.
    NotConstant {
        /// The symbol.
        name: &'static str,
        /// What it means.
        meaning: &'static str,
    },
    /// `if`, `match`.
    Branch {
        /// The word.
        word: String,
    },
    /// A field in an expression that is not an `f64`.
    FieldType {
        /// The field.
        field: String,
        /// Its type.
        ty: String,
        /// It is a square matrix of doubles.
        is_matrix: bool,
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
        /// The degree, in digits.
        degree: String,
        /// The largest accepted.
        limit: u64,
    },
    /// A divisor, or the base of a negative power, that is exactly zero.
    DivisionByZero {
        /// The divisor.
        divisor: String,
    },
}

names! { ExpressionMistake
    UnexpectedToken => "unexpected-token",
    MissingOperand => "missing-operand",
    DoubleStar => "double-star",
    NumberSuffix => "number-suffix",
    NotANumber => "not-a-number",
    Quoted => "quoted",
    NumberRange => "number-range",
    ValueRange => "value-range",
    RustNotation => "rust-notation",
    Path => "path",
    FunctionCall => "function-call",
    ExpressionSize => "expression-size",
    FlatMatrix => "flat-matrix",
    MissingComma => "missing-comma",
    UnknownSymbol => "unknown-symbol",
    NotConstant => "not-constant",
    Branch => "branch",
    FieldType => "field-type",
    HiddenSymbol => "hidden-symbol",
    Exponent => "exponent",
    Degree => "degree",
    DivisionByZero => "division-by-zero",
}

impl ExpressionMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::UnexpectedToken { found, expected } => text(
                format!("{found} where {expected} should stand"),
                "expressions are made of decimal numbers, fields, `n`, the operators `+ - * / ^` and parentheses",
                match found.as_str() {
                    "`:`" => "write `tr(A*B)` for the contraction of two symmetric tensors".to_owned(),
                    _ => {
                        format!("put {expected} before it, or remove it; a product has its sign, as in `2*a`")
                    }
                },
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
            Self::Quoted { literal } => text(
                format!("`{literal}` is a text in quotes"),
                "expressions stand in the attribute as they are: numbers, names, operators and brackets",
                "write the expression without quotes",
            ),
            Self::NumberRange { literal } => text(
                format!("the number `{literal}` is beyond the range of machine numbers"),
                "coefficients are rounded to f64 in the end, which spans about 1e-308 to 1e308",
                "choose units in which the coefficients are of moderate size",
            ),
            Self::ValueRange { expression, number } => text(
                format!(
                    "`{expression}` brings the number {number} into the equations, which no double holds"
                ),
                "numbers are exact until they are rounded to f64 in the end, which holds 2.3e-308 to 1.7e308: beyond, they \
                 are infinite, lose their digits or vanish, with the terms that they belong to",
                "choose units in which coefficients, their squares and their quotients are of moderate size",
            ),
            Self::RustNotation { written, instead } => text(
                format!("`{written}` is notation of Rust, and expressions are formulas"),
                "powers are written with `^`, functions stand before their argument, and fields have their bare names",
                instead,
            ),
            Self::Path { path, field } => text(
                format!("`{path}` is a path, where a number or a field of the struct should stand"),
                "coefficients are exact, and the macro does not see the values of items elsewhere in the program",
                format!("write the number in digits, or add a field `{field}: f64` and write `{field}`"),
            ),
            Self::FunctionCall { name } => text(
                format!("`{name}` is applied to brackets, but a coefficient has no functions and no indices"),
                "the coefficients of a kinetic energy are constants: arithmetic over numbers, fields and `n`",
                "compute the value and keep it in a field; a product has its sign, as in `a*(b + c)`",
            ),
            Self::ExpressionSize { limit } => text(
                format!("the expression has more than {limit}"),
                "the macro bounds what it works through, so that a slip cannot stall a build",
                "split it: keep a constant part in a field; a longer potential is one of a field, `custom(field, general)`",
            ),
            Self::FlatMatrix => text(
                "a row of a matrix is not in brackets",
                "a matrix is an array of rows, and a row is an array of entries",
                "write `[[a, b], [c, d]]`, or `diag(a, d)`",
            ),
            Self::MissingComma => text(
                "a comma is missing before this row of a matrix",
                "a matrix is an array of rows, and commas stand between them",
                "put a comma before it, as in `[[a, b], [c, d]]`",
            ),
            Self::UnknownSymbol { name, nearest, familiar, scope } => {
                let field = match syn::parse_str::<syn::Ident>(name) {
                    Ok(_) => format!("add a field `{name}: f64`"),
                    Err(_) => {
                        format!("write a number, or a field of another name: `{name}` is a keyword of Rust")
                    }
                };
                text(
                    format!("there is no field or symbol `{name}`"),
                    format!("an expression can use {}", listed(scope)),
                    match familiar {
                        Some(familiar) => format!("{familiar}; or {field}"),
                        None => suggestion(nearest.as_deref(), &field),
                    },
                )
            }
            Self::NotConstant { name, meaning } => text(
                format!("`{name}` is {meaning}, and here a constant stands"),
                "a coefficient is the same at every time and wherever the body is: arithmetic over numbers, fields and `n`",
                "write a number, or a field of another name; what changes on the way belongs in `potential`, or in a force \
                 that a field computes, `forces = custom(..)`",
            ),
            Self::Branch { word } => text(
                format!("`{word}` is a branch, and an expression has none"),
                "equations are derived from the expression, exactly, and a force would jump at the branch",
                "write a smooth function, or keep what branches in a field: a number, or a potential that it computes, \
                 `custom(field, general)`",
            ),
            Self::FieldType { field, ty, is_matrix: true } => text(
                format!("the field `{field}` has type `{ty}` and cannot stand in an expression"),
                "an expression is a real number, and a field of matrix type stands alone, as in `body_inertia = j`",
                format!(
                    "write `{field}` alone where a matrix belongs, with factors and summands in its entries; \
                     `{field}: f64` where a number belongs"
                ),
            ),
            Self::FieldType { field, ty, is_matrix: false } => text(
                format!("the field `{field}` has type `{ty}` and cannot stand in an expression"),
                "an expression is a real number; a field of matrix type stands alone, as in `body_inertia = j`, and fields \
                 of other types are left alone",
                format!(
                    "write `{field}: f64` in the struct, spelled `f64` and not as an alias, or a matrix type written out, \
                     as `Matrix3<f64>`"
                ),
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
                "a quotient by zero has no value; expressions are exact, so that no rounding made this one vanish",
                "write a divisor that is not zero",
            ),
        }
    }
}

/// Would a Rust programmer mean the type of the number, rather than a factor?
fn is_machine_type(suffix: &str) -> bool {
    let size = suffix.strip_prefix(['f', 'i', 'u']);
    size.is_some_and(|size| matches!(size, "8" | "16" | "32" | "64" | "128" | "size"))
}

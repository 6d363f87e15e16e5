//! Mistakes of notation: keys, lists, values, and the item below the attribute.

use super::message::{Text, listed, suggestion, text};
use super::names::names;

/// What is meant by a token that stands where it should not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meant {
    /// `key: value`.
    Equals,
    /// `key: (...)`, where a list follows.
    Nothing,
    /// `key{...}`, `key[...]`.
    RoundBrackets,
    /// `key = value; ...`.
    Comma,
    /// No way to tell.
    Unclear,
}

impl Meant {
    /// What a message advises to write in place of the token.
    fn instead(self) -> &'static str {
        match self {
            Self::Equals => "write `=` for it",
            Self::Nothing => "remove it: the list stands directly after the name, in round brackets",
            Self::RoundBrackets => "write round brackets for it, as in `name(...)`",
            Self::Comma => "write a comma for it",
            Self::Unclear => "put a comma or `=` before it, or remove it",
        }
    }
}

/// A mistake of notation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotationMistake {
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
        /// What is meant by it.
        meant: Meant,
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
        example: String,
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
    /// A dimension other than the literals 2 and 3.
    Dimension {
        /// The dimension as it is written.
        found: String,
    },
    /// `crate = ...` is not a path.
    RuntimePath {
        /// The value of `crate` as it is written.
        found: String,
    },
    /// An enum, union or tuple struct.
    ItemKind {
        /// What the item is: `an enum`, ...
        found: &'static str,
    },
    /// The attribute on an item that has it already.
    RepeatedAttribute,
    /// An item that is no data type, or that the parser cannot read.
    UnreadableItem {
        /// What the parser says.
        problem: String,
    },
}

names! { NotationMistake
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
    Dimension => "dimension",
    RuntimePath => "runtime-path",
    ItemKind => "item-kind",
    RepeatedAttribute => "repeated-attribute",
    UnreadableItem => "unreadable-item",
}

impl NotationMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::ExpectedKey { list, found } => text(
                format!("`{list}(...)` has {found} where a name should stand"),
                format!("the items of `{list}(...)` are separated by commas and each begins with a name"),
                "write `name = value`, `name(...)` or `name`, as the item asks",
            ),
            Self::MalformedItem { list, found, meant } => text(
                format!("{found} does not belong to this item of `{list}(...)`"),
                "an item is `name = value`, `name(...)` or `name`, and ends with a comma",
                meant.instead(),
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
                match *list {
                    "kinetic" | "hamiltonian" | "dissipation" => {
                        "keep one of them; coefficients may be sums, as in `casimir2 = a + b`"
                    }
                    _ => "keep one of them",
                },
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
            Self::RepeatedAttribute => text(
                "`#[affine_model]` stands on this struct twice",
                "a struct is one model, and has its methods once",
                "write one of them, with all items, or a struct for each",
            ),
            Self::UnreadableItem { problem } => text(
                format!("`#[affine_model]` cannot read this item: {problem}"),
                "the parameters of a model are the named fields of a struct; a model without parameters is a \
                 unit struct",
                "write `struct Model;` or `struct Model { a: f64, b: f64 }`",
            ),
        }
    }
}

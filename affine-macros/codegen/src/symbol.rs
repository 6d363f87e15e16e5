//! Symbols of formulas and programs. What a symbol is, is decided by its type; its name is made of that, in one place.

mod capability;
mod constraint;
mod quantity;
mod term;

use std::fmt::{Display, Formatter, Result};

pub use capability::{Asked, Capability};
pub use constraint::Constraint;
pub use quantity::Quantity;
pub use term::{Frame, Pattern, TermKind};

/// An indeterminate; indices count from 1.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[must_use]
pub enum Symbol {
    /// A field of the user's struct that is a number.
    Field(String),
    /// An entry of a field that is a matrix: the field, row and column.
    Entry(String, usize, usize),
    /// An entry of a matrix that `prepare()` makes: the number of the matrix, row and column.
    Prepared(usize, usize, usize),
    /// A value that the derivation has no word for, by its formula: up to the last operand, and this.
    Formula(String, Option<Box<Symbol>>),
    /// A part of a value, or of no value that has a name, and which one.
    Part(Option<Box<Symbol>>, usize),
    /// A value by its place in its program.
    Step(usize),
    /// A component of a quantity, or all of it.
    Component(Quantity, Vec<usize>),
    /// Something else about another symbol.
    About(Aspect, Box<Symbol>),
    /// A number of the factorisation `L diag(d) L^T` of one block of a matrix, or of a solution by it.
    Factor(Factor, Factorised, usize, Vec<usize>),
}

/// What a symbol says about another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Aspect {
    /// The rate of the symbol.
    Rate,
    /// The change of the symbol beside a neighbouring motion.
    Change,
    /// The component after a turn.
    Turned,
    /// The component in the bases of the user, where the model has others.
    Given,
    /// The part of a momentum that the energies in the body have.
    InTheBody,
    /// The part of a momentum that the energies in space have.
    InSpace,
    /// The part of a momentum that the energies in `phi_dot` have.
    InPlacement,
    /// Half the sum of two entries of a matrix that mirror each other.
    Symmetric,
    /// The difference of two entries of a matrix that mirror each other.
    Skew,
}

/// The numbers of a factorisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Factor {
    /// `d_k`
    Pivot,
    /// `1/d_k`
    InversePivot,
    /// Entries of `L`.
    Lower,
    /// Entries of `diag(d) L^T`.
    Rest,
    /// The solution of `L y = b`.
    Forward,
    /// The solution of `L^T z = y/d`.
    Backward,
}

/// What is factorised, or solved for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Factorised {
    /// The mass matrix of the internal motion.
    Internal,
    /// The mass matrix of the centre of mass.
    Centre,
    /// The internal mass matrix, solved for a column of its inverse.
    Column(usize),
}

impl Symbol {
    /// Of a quantity the component with these indices behind its own; any other symbol as it is.
    pub fn at<const N: usize>(&self, indices: [usize; N]) -> Self {
        match self {
            Self::Component(quantity, own) => Self::Component(*quantity, [own, &indices[..]].concat()),
            other => other.clone(),
        }
    }

    /// The component of another quantity with the same indices; any other symbol as it is.
    pub fn of(self, quantity: Quantity) -> Self {
        match self {
            Self::Component(_, indices) => Self::Component(quantity, indices),
            other => other,
        }
    }

    /// What is to be said about it.
    pub fn seen(self, aspect: Aspect) -> Self {
        Self::About(aspect, Box::new(self))
    }

    /// The symbol that it is a power of, and the exponent.
    pub fn power(&self) -> Option<(Self, i32)> {
        match self {
            Self::Component(quantity, indices) => {
                let (base, exponent) = quantity.power()?;
                Some((Self::Component(base, indices.clone()), exponent))
            }
            Self::Factor(Factor::InversePivot, of @ Factorised::Centre, block, indices) => {
                Some((Self::Factor(Factor::Pivot, *of, *block, indices.clone()), -1))
            }
            _ => None,
        }
    }

    /// Its indices; none where it is no component of something.
    pub fn indices(&self) -> &[usize] {
        match self {
            Self::Component(_, indices) | Self::Factor(.., indices) => indices,
            Self::About(_, of) | Self::Formula(_, Some(of)) => of.indices(),
            _ => &[],
        }
    }

    /// The same with other indices, where it has some.
    pub fn with_indices(&self, indices: &[usize]) -> Self {
        match self {
            Self::Component(quantity, _) => Self::Component(*quantity, indices.to_vec()),
            Self::Factor(factor, of, block, _) => Self::Factor(*factor, *of, *block, indices.to_vec()),
            Self::About(aspect, of) => of.with_indices(indices).seen(*aspect),
            Self::Formula(formula, Some(last)) => {
                Self::Formula(formula.clone(), Some(Box::new(last.with_indices(indices))))
            }
            other => other.clone(),
        }
    }

    /// The quantity that it is, or is a component of.
    pub fn quantity(&self) -> Option<Quantity> {
        match self {
            Self::Component(quantity, _) => Some(*quantity),
            _ => None,
        }
    }

    /// Is it a parameter of the model: a field, or what `prepare()` makes of fields?
    pub fn is_parameter(&self) -> bool {
        matches!(self, Self::Field(_) | Self::Entry(..) | Self::Prepared(..))
    }
}

impl Quantity {
    /// The component with these indices.
    pub fn at<const N: usize>(self, indices: [usize; N]) -> Symbol {
        Symbol::Component(self, indices.to_vec())
    }
}

impl From<Quantity> for Symbol {
    fn from(quantity: Quantity) -> Self {
        Self::Component(quantity, Vec::new())
    }
}

/// The one name of a symbol: an identifier, but for fields.
impl Display for Symbol {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Field(name) => write!(f, "self.{name}"),
            Self::Entry(name, row, column) => write!(f, "self.{name}[{row},{column}]"),
            Self::Prepared(matrix, row, column) => write!(f, "self.{matrix}[{row},{column}]"),
            Self::Formula(formula, last) => {
                f.write_str(formula)?;
                last.iter().try_for_each(|last| write!(f, "_{last}"))
            }
            Self::Part(whole, number) => {
                f.write_str("part")?;
                whole.iter().try_for_each(|whole| write!(f, "_of_{whole}"))?;
                if *number == 1 { Ok(()) } else { write!(f, "_{number}") }
            }
            Self::Step(place) => write!(f, "v{place}"),
            Self::Component(quantity, indices) => component(f, *quantity, "", indices),
            Self::About(aspect, of) => about(f, *aspect, of),
            Self::Factor(factor, of, block, indices) => {
                write!(f, "{}_", factor.stem())?;
                match of {
                    Factorised::Internal => {}
                    Factorised::Centre => f.write_str("centre_")?,
                    Factorised::Column(column) => write!(f, "{column}_")?,
                }
                // Blocks are lettered.
                let letter = u8::try_from(*block).map_or('z', |block| (b'a' + block) as char);
                write!(f, "{letter}_")?;
                indices.iter().try_for_each(|index| write!(f, "{index}"))
            }
        }
    }
}

fn component(f: &mut Formatter<'_>, quantity: Quantity, half: &str, indices: &[usize]) -> Result {
    write!(f, "{}{half}", quantity.stem())?;
    for (k, index) in indices.iter().enumerate() {
        let gap = if k == 0 || k <= quantity.numbers() { "_" } else { "" };
        write!(f, "{gap}{index}")?;
    }
    Ok(())
}

fn about(f: &mut Formatter<'_>, aspect: Aspect, of: &Symbol) -> Result {
    let before = match (aspect, of) {
        (Aspect::Symmetric, Symbol::Component(quantity, indices)) => {
            return component(f, *quantity, "_sym", indices);
        }
        (Aspect::Skew, Symbol::Component(quantity, indices)) => {
            return component(f, *quantity, "_skew", indices);
        }
        (Aspect::Symmetric, _) => "sym",
        (Aspect::Skew, _) => "skew",
        (Aspect::Rate, _) => "d",
        (Aspect::Change, _) => "change",
        (Aspect::Turned, _) => "turned",
        (Aspect::Given, _) => "given",
        (Aspect::InTheBody, _) => "body",
        (Aspect::InSpace, _) => "space",
        (Aspect::InPlacement, _) => "flat",
    };
    write!(f, "{before}_{of}")
}

impl Factor {
    fn stem(self) -> &'static str {
        match self {
            Self::Pivot => "pivot",
            Self::InversePivot => "inverse_pivot",
            Self::Lower => "lower",
            Self::Rest => "rest",
            Self::Forward => "forward",
            Self::Backward => "backward",
        }
    }
}

//! Straight lines of matrices and runtime functions: the way from a phase point to the state that is integrated, and back.

use crate::symbol::{Quantity, Symbol};

/// A variable on the way, or a constant of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Word {
    /// The time of the start.
    Start,
    /// The time since then.
    Elapsed,
    /// The place of the centre of mass.
    Position,
    /// That at the start.
    StartPosition,
    /// The velocity of the centre of mass.
    Drift,
    /// `p`, the linear momentum of the phase point.
    LinearMomentum,
    /// The affine momentum of the chart that the state is in.
    Momentum,
    /// The rotation that turns space.
    Turn,
    /// `phi`, turned back and spread again as the statements go on.
    Placement,
    /// The affine spin whose skew part turns the body.
    Spin,
    /// The skew part of that spin.
    Skew,
    /// The generator of a rotation; on the way back, the rotation.
    Rotation,
    /// `q`.
    MeanLogStretch,
    /// The motion of `q`.
    Dilatation,
    /// The momentum of `q`.
    DilatationalMomentum,
    /// Components that are constants.
    Fixed,
}

impl Word {
    /// Its name in code.
    pub fn name(self) -> &'static str {
        match self {
            Self::Start => "t0",
            Self::Elapsed => "elapsed",
            Self::Position => "x",
            Self::StartPosition => "x0",
            Self::Drift => "drift",
            Self::LinearMomentum => "p",
            Self::Momentum => "momentum",
            Self::Turn => "turn",
            Self::Placement => "phi",
            Self::Spin => "spin",
            Self::Skew => "skew",
            Self::Rotation => "whirl",
            Self::MeanLogStretch => "q",
            Self::Dilatation => "dilatation",
            Self::DilatationalMomentum => "dilatational_momentum",
            Self::Fixed => "fixed",
        }
    }
}

/// A number, a vector or a matrix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Tensor {
    /// A part of the phase point.
    OfPoint(Quantity),
    /// A variable that a statement before has bound.
    Variable(Word),
    /// A constant of the trajectory.
    Constant(Word),
    /// The time.
    Time,
    /// What a program of the model gives for a quantity.
    Factor(Quantity),
    /// What the program of the dilatation gives.
    OfDilatation,
    /// Components, as a list.
    List(Vec<Symbol>),
    /// A vector by its components.
    Vector(Vec<Symbol>),
    /// A matrix by its entries.
    Matrix(Vec<Vec<Symbol>>),
    /// `-(a + b + ..)`.
    NegativeSum(Vec<Symbol>),
    /// `a + b`.
    Plus(Box<[Tensor; 2]>),
    /// `a - b`.
    Minus(Box<[Tensor; 2]>),
    /// `a b`.
    Times(Box<[Tensor; 2]>),
    /// `a^T b`.
    TransposedTimes(Box<[Tensor; 2]>),
    /// `a^T`.
    Transpose(Box<Tensor>),
    /// A multiple by what a program of the model gives.
    Scaled(Box<Tensor>, Quantity),
    /// A function of the runtime.
    Applied(MatrixFunction, Vec<Tensor>),
}

/// The functions of the runtime on the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MatrixFunction {
    /// `p -> R` with `R p` along the first axis.
    Turn,
    /// `p, I(O) -> R`, and `(R I(O) R^T)_13 = 0`.
    TurnOfBoth,
    /// The total affine momentum of the phase point.
    TotalMomentum,
    /// The projection on the algebra of the constraint, where there is one.
    Projected,
    /// `phi -> q`.
    MeanLogStretch,
    /// `phi -> 1/D`.
    InverseDilatation,
    /// `phi -> phi/D`.
    Isochoric,
    /// `Sigma, 1/alpha ->` the parts of the traceless `Sigma/alpha`.
    ShearAndTurn,
    /// And back, with the trace.
    FromShearAndTurn,
    /// The exponential of a skew matrix.
    Exponential,
    /// The inverse.
    Inverse,
    /// The trace.
    Trace,
    /// The exponential of a number.
    Exp,
    /// `t0, q, p, ..` -> the motion of a dilatation.
    Dilatation(DilatationalMotion),
    /// A motion of a dilatation, the time -> `q` and its momentum.
    DilatationAt,
}

/// A closed form of `q'' = -U_dil'(q)/m`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DilatationalMotion {
    /// Without a force: `q` is linear in time.
    Free,
    /// Under a force that is linear in `q`.
    Harmonic,
    /// Under a force that is a hyperbolic sine of `q`.
    Hyperbolic,
}

/// A statement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Statement {
    /// A variable is a value.
    Named(Word, Tensor),
    /// Two variables are a pair of values.
    Pair([Word; 2], Tensor),
    /// A symbol is a value.
    Symbol(Symbol, Tensor),
    /// Symbols are the entries of a list.
    Listed(Vec<Symbol>, Tensor),
    /// Symbols are the components of a vector.
    Components(Vec<Symbol>, Tensor),
    /// Symbols are the entries of a matrix.
    Entries(Vec<Vec<Symbol>>, Tensor),
    /// The entries of the affine momentum that are linear in others are known.
    Dependent,
}

/// What one trajectory conserves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constant {
    /// Its name.
    pub name: Word,
    /// What it is made of.
    pub extent: Extent,
    /// What it is, in words.
    pub meaning: String,
    /// What it is at the start, where no variable of its name is.
    pub start: Option<Tensor>,
}

/// What a constant is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// A number.
    Number,
    /// A vector.
    Vector,
    /// A matrix.
    Matrix,
    /// A list of this length.
    List(usize),
    /// A motion that no equation reads.
    Dilatation,
}

/// The way from a phase point to a state and back.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[must_use]
pub struct Passage {
    /// From a phase point to the components of the state.
    pub inward: Vec<Statement>,
    /// What is kept beside the state.
    pub constants: Vec<Constant>,
    /// From the components of the state to the parts of a phase point.
    pub outward: Vec<Statement>,
    /// The affine momentum of the phase point: what it is, and its value.
    pub momentum: Option<(Quantity, Tensor)>,
    /// Position and linear momentum of the phase point, where it has any.
    pub centre: Option<[Tensor; 2]>,
    /// What the state carries along, from the rest of it.
    pub renewed: Vec<Statement>,
}

impl Passage {
    /// Components of the affine momentum that are constants, while others are state.
    pub fn fixed(&self) -> Vec<Symbol> {
        let starts = self.constants.iter().filter_map(|constant| constant.start.as_ref());
        let lists = starts.filter_map(|start| match start {
            Tensor::List(symbols) => Some(symbols.clone()),
            _ => None,
        });
        lists.flatten().collect()
    }
}

impl Tensor {
    /// `self other`.
    pub fn times(self, other: Self) -> Self {
        Self::Times(Box::new([self, other]))
    }

    /// `self^T other`.
    pub fn transposed_times(self, other: Self) -> Self {
        Self::TransposedTimes(Box::new([self, other]))
    }

    /// `self^T`.
    pub fn transposed(self) -> Self {
        Self::Transpose(Box::new(self))
    }

    /// `self - other`.
    pub fn minus(self, other: Self) -> Self {
        Self::Minus(Box::new([self, other]))
    }

    /// `self + other`.
    pub fn plus(self, other: Self) -> Self {
        Self::Plus(Box::new([self, other]))
    }

    /// A function of it.
    pub fn under(self, function: MatrixFunction) -> Self {
        Self::Applied(function, vec![self])
    }

    /// Is this anywhere in it?
    pub fn any(&self, is_it: &mut dyn FnMut(&Self) -> bool) -> bool {
        if is_it(self) {
            return true;
        }
        match self {
            Self::Plus(both) | Self::Minus(both) | Self::Times(both) | Self::TransposedTimes(both) => {
                both.iter().any(|one| one.any(is_it))
            }
            Self::Transpose(of) | Self::Scaled(of, _) => of.any(is_it),
            Self::Applied(_, arguments) => arguments.iter().any(|one| one.any(is_it)),
            _ => false,
        }
    }
}

impl Statement {
    /// What is bound.
    pub fn value(&self) -> Option<&Tensor> {
        match self {
            Self::Named(_, value)
            | Self::Pair(_, value)
            | Self::Symbol(_, value)
            | Self::Listed(_, value)
            | Self::Components(_, value)
            | Self::Entries(_, value) => Some(value),
            Self::Dependent => None,
        }
    }
}

impl Constant {
    /// One that a variable of its name is at the start.
    pub fn new(name: Word, extent: Extent, meaning: impl Into<String>) -> Self {
        Self { name, extent, meaning: meaning.into(), start: None }
    }

    /// One that is something else at the start.
    pub fn starting(self, value: Tensor) -> Self {
        Self { start: Some(value), ..self }
    }
}

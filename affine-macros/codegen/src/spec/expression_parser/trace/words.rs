//! Polynomials in matrices: words with numbers and scalars before them.

use proc_macro2::Ident;

use crate::algebra::Rational;
use crate::diagnostics::Region;
use crate::spec::{Expression, ExpressionKind, MatrixName, Operator};

/// Summands of a polynomial: textbooks have a handful, and the sixth power of a sum of two tensors has 64.
const MOST_SUMMANDS: usize = 64;

/// A matrix, or its inverse, as a factor.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Letter {
    pub(super) matrix: MatrixName,
    pub(super) is_inverse: bool,
}

/// `number * scalars * word`.
#[derive(Clone)]
struct Summand {
    number: Rational,
    /// Their indices in the list of [`Scalars`], in order.
    scalars: Vec<usize>,
    word: Vec<Letter>,
}

/// A sum of words; numbers and scalars commute with matrices, which do not commute with each other.
#[derive(Clone)]
pub(super) struct Words {
    /// None of them where they are too many.
    summands: Vec<Summand>,
    /// Are they too many?
    pub(super) is_long: bool,
    /// Does an inverse stand in it?
    pub(super) inverts: bool,
    /// The degree in matrices, numbers and scalars, which bounds the length of words and the digits of numbers.
    pub(super) degree: u64,
}

/// The parts of a trace that are no matrices, each once.
#[derive(Default)]
pub(super) struct Scalars(Vec<(String, Expression)>);

impl Scalars {
    /// The words of a scalar: the empty one, the identity, with the scalar before it.
    pub(super) fn words(&mut self, scalar: &Expression) -> Words {
        let text = scalar.to_string();
        let known = self.0.iter().position(|(one, _)| *one == text);
        let index = known.unwrap_or(self.0.len());
        if known.is_none() {
            self.0.push((text, scalar.clone()));
        }
        Words::one(Summand { number: Rational::ONE, scalars: vec![index], word: Vec::new() })
    }
}

impl Words {
    fn one(summand: Summand) -> Self {
        let inverts = summand.word.iter().any(|letter| letter.is_inverse);
        Self { summands: vec![summand], is_long: false, inverts, degree: 1 }
    }

    /// That multiple of the identity.
    pub(super) fn number(number: Rational) -> Self {
        Self::one(Summand { number, scalars: Vec::new(), word: Vec::new() })
    }

    /// A single letter.
    pub(super) fn letter(letter: Letter) -> Self {
        Self::one(Summand { number: Rational::ONE, scalars: Vec::new(), word: vec![letter] })
    }

    /// The letter, if there is nothing else.
    pub(super) fn as_letter(&self) -> Option<Letter> {
        match self.summands.as_slice() {
            [Summand { number, scalars, word }]
                if number.is_one() && scalars.is_empty() && word.len() == 1 =>
            {
                word.first().copied()
            }
            _ => None,
        }
    }

    /// Every number with the other sign.
    pub(super) fn negated(mut self) -> Self {
        self.summands.iter_mut().for_each(|summand| summand.number = -&summand.number);
        self
    }

    /// The sum.
    pub(super) fn sum(mut self, other: Self) -> Self {
        self.degree = self.degree.max(other.degree);
        self.is_long |= other.is_long;
        self.inverts |= other.inverts;
        other.summands.into_iter().for_each(|summand| self.add(summand));
        self.bounded()
    }

    /// The product.
    pub(super) fn product(&self, other: &Self) -> Self {
        let mut product = Self {
            summands: Vec::new(),
            is_long: self.is_long || other.is_long,
            inverts: self.inverts || other.inverts,
            degree: self.degree.saturating_add(other.degree),
        };
        for left in &self.summands {
            other.summands.iter().for_each(|right| product.add(left.times(right)));
            product = product.bounded();
        }
        product
    }

    /// A power.
    pub(super) fn power(&self, exponent: u32) -> Self {
        let power = (0..exponent).fold(Self::number(Rational::ONE), |power, _| power.product(self));
        Self { degree: self.degree.saturating_mul(u64::from(exponent)).max(1), ..power }
    }

    fn bounded(mut self) -> Self {
        self.is_long |= self.summands.len() > MOST_SUMMANDS;
        if self.is_long {
            self.summands.clear();
        }
        self
    }

    /// Is the trace of each word a number, or an invariant that potentials have a name for? And likewise if there is one word
    /// alone, nothing is to be gained from how it was written.
    pub(super) fn is_of_invariants(&self) -> bool {
        self.summands.len() == 1 || self.summands.iter().all(|summand| is_invariant(&summand.word))
    }

    /// How many factors all words have.
    pub(super) fn factors(&self) -> usize {
        self.summands.iter().map(|summand| summand.word.len()).sum()
    }

    /// Adds a summand, to its like if there is one.
    fn add(&mut self, summand: Summand) {
        let alike = |one: &&mut Summand| one.scalars == summand.scalars && one.word == summand.word;
        match self.summands.iter_mut().find(alike) {
            Some(like) => like.number = &like.number + &summand.number,
            None => self.summands.push(summand),
        }
    }

    /// The trace, summand by summand; `None` where an inverse does not stand alone.
    pub(super) fn trace(&self, scalars: &Scalars, span: Region) -> Option<Expression> {
        let mut sum: Option<Expression> = None;
        for summand in &self.summands {
            let (sign, trace) = summand.trace(scalars, span)?;
            sum = Some(match (sum, sign) {
                (None, Operator::Subtract) => {
                    Expression { kind: ExpressionKind::Negate(Box::new(trace)), span }
                }
                (None, _) => trace,
                (Some(sum), sign) => sign.apply(sum, trace),
            });
        }
        sum.map(|sum| Expression { kind: sum.kind, span })
    }
}

impl Summand {
    fn times(&self, other: &Self) -> Self {
        let mut scalars = [self.scalars.as_slice(), &other.scalars].concat();
        scalars.sort_unstable();
        let mut word = self.word.clone();
        for letter in &other.word {
            let is_opposite =
                |last: &Letter| last.matrix == letter.matrix && last.is_inverse != letter.is_inverse;
            if word.last().is_some_and(is_opposite) {
                word.pop();
            } else {
                word.push(*letter);
            }
        }
        Self { number: &self.number * &other.number, scalars, word }
    }

    /// The trace without its sign, and the sign.
    fn trace(&self, scalars: &Scalars, span: Region) -> Option<(Operator, Expression)> {
        let place = |kind| Expression { kind, span };
        let is_negative = self.number.is_negative();
        let size = if is_negative { -&self.number } else { self.number.clone() };
        let trace = place(trace_of_word(&self.word, span)?);
        let mut factors: Vec<Expression> = Vec::new();
        if size != Rational::ONE {
            factors.push(place(ExpressionKind::Number(size)));
        }
        factors.extend(self.scalars.iter().map(|index| scalars.0[*index].1.clone()));
        factors.push(trace);
        let product = factors.into_iter().reduce(|left, right| Operator::Multiply.apply(left, right))?;
        Some((if is_negative { Operator::Subtract } else { Operator::Add }, product))
    }
}

/// `tr 1`, `tr phi`, and `tr G^k` up to `k = 3`.
fn is_invariant(word: &[Letter]) -> bool {
    let alike = word.windows(2).all(|pair| pair[0] == pair[1] && pair[0].matrix != MatrixName::Placement);
    alike && word.len() <= 3
}

/// `tr 1 = n`.
fn trace_of_word(word: &[Letter], span: Region) -> Option<ExpressionKind> {
    match word {
        [] => Some(ExpressionKind::Symbol(Ident::new("n", span.start))),
        [Letter { matrix, is_inverse: true }] => Some(ExpressionKind::InverseTrace(*matrix)),
        letters => {
            let matrix = |letter: &Letter| (!letter.is_inverse).then_some(letter.matrix);
            letters.iter().map(matrix).collect::<Option<Vec<_>>>().map(ExpressionKind::Trace)
        }
    }
}

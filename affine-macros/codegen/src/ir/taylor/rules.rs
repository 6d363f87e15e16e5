//! Rules for coefficients: what moves, what is ready, which products there are.

use crate::algebra::Function;
use crate::symbol::{Quantity, Symbol};

use super::super::{Op, Program, Value};
use super::companions::companion_of;
use super::quotients::is_quotient;
use super::recurrence::{Place, Rule, Series, Term};

/// A convolution to be formed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Product {
    /// The factors.
    pub factors: [Series; 2],
    /// Both factors are ready.
    pub full: bool,
    /// The sum it is a term of, and its sign there: negative? `None` where a function reads it.
    pub sum: Option<(Value, bool)>,
}

impl Product {
    pub(super) fn is_square(&self) -> bool {
        self.factors[0] == self.factors[1]
    }
}

/// A rule whose convolutions have no place yet.
enum Outline {
    Sum(Vec<(bool, Part)>),
    /// `products` are indices.
    Quotient {
        numerator: Option<Value>,
        denominator: Value,
        product: usize,
    },
    Function {
        function: Function,
        argument: Value,
        companion: Option<Value>,
        products: Vec<usize>,
    },
    Time,
}

#[derive(Clone, Copy)]
enum Part {
    Term(Term),
    Product(usize),
}

/// How a value reads another one, or two.
#[derive(Clone, Copy)]
enum Summand {
    Value(Value),
    Scaled(Value, Value),
    Divided(Value, Value),
    Product(Value, Value),
}

/// All rules, before the convolutions are put into lanes.
pub(super) struct Draft {
    pub moving: Vec<bool>,
    pub ready: Vec<bool>,
    pub products: Vec<Product>,
    outlines: Vec<(Value, Outline)>,
    /// Read at order zero by rules, whether or not by a convolution.
    kept: Vec<Series>,
}

impl Draft {
    pub(super) fn of(program: &Program, states: &[Symbol]) -> Self {
        let reader = Reader::new(program, states);
        let mut draft = Self {
            ready: vec![false; program.steps.len()],
            moving: reader.moving.clone(),
            products: Vec::new(),
            outlines: Vec::new(),
            kept: Vec::new(),
        };
        for value in 0..program.steps.len() {
            if !reader.needed[value] || !reader.moving[value] {
                continue;
            }
            match program.steps[value] {
                Op::Input(ref name) if is_time(name) => draft.outlines.push((value, Outline::Time)),
                Op::Input(_) => draft.ready[value] = true,
                Op::Div(a, b) if reader.moving[b] => draft.quotient(value, (a, b)),
                Op::Call(function, argument) => {
                    draft.function(value, function, argument, companion_of(program, value));
                }
                _ if reader.absorbed[value] => {}
                _ => draft.sum(value, &reader),
            }
        }
        draft
    }

    /// Series that a row keeps although no convolution reads them.
    pub(super) fn kept(&self) -> &[Series] {
        &self.kept
    }

    /// The rules with the places of their convolutions.
    pub(super) fn rules(&self, places: &[(Place, bool)]) -> Vec<(Value, Rule)> {
        let rule = |outline: &Outline| match outline {
            Outline::Sum(parts) => Rule::Sum(self.terms(parts, places)),
            Outline::Quotient { numerator, denominator, product } => {
                Rule::Quotient { numerator: *numerator, denominator: *denominator, inner: places[*product].0 }
            }
            Outline::Function { function, argument, companion, products } => Rule::Function {
                function: *function,
                argument: *argument,
                companion: *companion,
                inner: products.iter().map(|p| places[*p].0).collect(),
            },
            Outline::Time => Rule::Time,
        };
        self.outlines.iter().map(|(value, outline)| (*value, rule(outline))).collect()
    }

    /// Products that share a lane are one term.
    fn terms(&self, parts: &[(bool, Part)], places: &[(Place, bool)]) -> Vec<(bool, Term)> {
        let mut terms: Vec<(bool, Term)> = Vec::new();
        for &(negative, part) in parts {
            match part {
                Part::Term(term) => terms.push((negative, term)),
                Part::Product(index) => {
                    let (place, subtracted) = places[index];
                    let lane = Term::Lane(place);
                    if !terms.iter().any(|(_, term)| *term == lane) {
                        terms.push((negative != subtracted, lane));
                    }
                }
            }
        }
        for &(negative, part) in parts {
            if let Part::Product(index) = part
                && !self.products[index].full
            {
                let [a, b] = self.products[index].factors;
                terms.push((negative, Term::Ends(a.value, b.value)));
            }
        }
        terms
    }

    fn product(&mut self, factors: [Series; 2], sum: Option<(Value, bool)>) -> usize {
        let full = sum.is_some() && factors.iter().all(|f| !f.rate && self.ready[f.value]);
        self.products.push(Product { factors, full, sum });
        self.products.len() - 1
    }

    fn sum(&mut self, value: Value, reader: &Reader) {
        let mut summands = Vec::new();
        reader.flatten(value, false, &mut summands);
        let mut parts = Vec::with_capacity(summands.len());
        let mut ready = true;
        for (negative, summand) in summands {
            let part = match summand {
                Summand::Value(v) => Part::Term(Term::Value(v)),
                Summand::Scaled(c, v) if reader.is_quotient(c) => Part::Term(Term::Over(v, c)),
                Summand::Scaled(c, v) => Part::Term(Term::Scaled(c, v)),
                Summand::Divided(v, c) => Part::Term(Term::Divided(v, c)),
                Summand::Product(a, b) => {
                    let factors = [Series::of(a), Series::of(b)];
                    Part::Product(self.product(factors, Some((value, negative))))
                }
            };
            ready &= match part {
                Part::Term(Term::Value(v) | Term::Scaled(_, v) | Term::Divided(v, _) | Term::Over(v, _)) => {
                    self.ready[v]
                }
                _ => false,
            };
            parts.push((negative, part));
        }
        self.ready[value] = ready;
        self.outlines.push((value, Outline::Sum(parts)));
    }

    fn quotient(&mut self, value: Value, (numerator, denominator): (Value, Value)) {
        let product = self.product([Series::of(denominator), Series::of(value)], None);
        let numerator = self.moving[numerator].then_some(numerator);
        self.outlines.push((value, Outline::Quotient { numerator, denominator, product }));
    }

    /// The convolutions of the differential equations: `y' = y u'` for the exponential, and so on.
    fn function(&mut self, value: Value, function: Function, argument: Value, companion: Option<Value>) {
        let (y, u) = (Series::of(value), Series::of(argument));
        let pairs = match (function, companion) {
            (Function::Exp, _) => vec![[Series::rate(argument), y]],
            (Function::Ln, _) => vec![[Series::rate(value), u]],
            (Function::Sqrt, _) => vec![[y, y]],
            (Function::Cbrt | Function::InverseCbrt, _) => vec![[u, y], [u, Series::rate(value)]],
            (_, Some(other)) => vec![[Series::rate(argument), Series::of(other)]],
            // |u| has the sign of u_0 throughout.
            (_, None) => {
                self.kept.extend([u, y]);
                Vec::new()
            }
        };
        let products = pairs.into_iter().map(|factors| self.product(factors, None)).collect();
        self.outlines.push((value, Outline::Function { function, argument, companion, products }));
    }
}

/// Which values are read, and how.
struct Reader<'a> {
    program: &'a Program,
    moving: Vec<bool>,
    needed: Vec<bool>,
    /// Read once, as a summand: part of the sum that reads it.
    absorbed: Vec<bool>,
}

impl<'a> Reader<'a> {
    fn new(program: &'a Program, states: &[Symbol]) -> Self {
        let count = program.steps.len();
        let moving = program.depending(|input| states.contains(input) || is_time(input));
        let mut reader = Self { program, moving, needed: needed(program), absorbed: vec![false; count] };
        let (mut reads, mut summand_only) = (vec![0; count], vec![true; count]);
        for (_, output) in &program.outputs {
            summand_only[*output] = false;
        }
        for value in (0..count).filter(|v| reader.needed[*v]) {
            if let Some(other) = companion_of(program, value) {
                summand_only[other] = false;
            }
        }
        for value in (0..count).filter(|v| reader.needed[*v]) {
            if !reader.moving[value] {
                continue;
            }
            match program.steps[value] {
                Op::Call(_, a) => summand_only[a] = false,
                Op::Div(a, b) if reader.moving[b] => {
                    summand_only[a] = false;
                    summand_only[b] = false;
                }
                Op::Neg(_) => {}
                _ => {
                    for (_, summand) in reader.summands(value) {
                        match summand {
                            Summand::Value(v) => reads[v] += 1,
                            Summand::Scaled(_, v) | Summand::Divided(v, _) => summand_only[v] = false,
                            Summand::Product(a, b) => {
                                summand_only[a] = false;
                                summand_only[b] = false;
                            }
                        }
                    }
                }
            }
        }
        // A change of sign is read through, unless something needs it as it is.
        for value in 0..count {
            if matches!(program.steps[value], Op::Neg(_)) && !summand_only[value] {
                for (_, summand) in reader.summands(value) {
                    if let Summand::Value(v) = summand {
                        reads[v] += 1;
                    }
                }
            }
        }
        for value in 0..count {
            let adds = match program.steps[value] {
                Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::MulAdd(..) => true,
                Op::Div(_, b) => !reader.moving[b],
                _ => false,
            };
            let sign = matches!(program.steps[value], Op::Neg(_)) && summand_only[value];
            reader.absorbed[value] = sign || adds && summand_only[value] && reads[value] == 1;
        }
        reader
    }

    /// A number, products with which are rounded by way of a quotient.
    fn is_quotient(&self, value: Value) -> bool {
        matches!(&self.program.steps[value], Op::Constant(number) if is_quotient(number))
    }

    /// The value behind changes of sign.
    fn resolve(&self, mut value: Value) -> (bool, Value) {
        let mut negative = false;
        while let Op::Neg(inner) = self.program.steps[value] {
            (negative, value) = (!negative, inner);
        }
        (negative, value)
    }

    /// A value as a sum, one operation deep; what does not move has no coefficients beyond order zero.
    fn summands(&self, value: Value) -> Vec<(bool, Summand)> {
        let signed = |v: Value, flip: bool| {
            let (negative, v) = self.resolve(v);
            self.moving[v].then_some((negative != flip, Summand::Value(v)))
        };
        let product = |a: Value, b: Value| match (self.moving[a], self.moving[b]) {
            (false, false) => None,
            (true, false) => {
                let (negative, a) = self.resolve(a);
                Some((negative, Summand::Scaled(b, a)))
            }
            (false, true) => {
                let (negative, b) = self.resolve(b);
                Some((negative, Summand::Scaled(a, b)))
            }
            (true, true) => {
                let ((one, a), (other, b)) = (self.resolve(a), self.resolve(b));
                Some((one != other, Summand::Product(a, b)))
            }
        };
        let summands = match self.program.steps[value] {
            Op::Neg(a) => [signed(a, true), None],
            Op::Add(a, b) => [signed(a, false), signed(b, false)],
            Op::Sub(a, b) => [signed(a, false), signed(b, true)],
            Op::Mul(a, b) => [product(a, b), None],
            Op::MulAdd(a, b, c) => [product(a, b), signed(c, false)],
            Op::Div(a, b) => {
                let (negative, a) = self.resolve(a);
                [Some((negative, Summand::Divided(a, b))), None]
            }
            Op::Input(_) | Op::Constant(_) | Op::Call(..) => [None, None],
        };
        summands.into_iter().flatten().collect()
    }

    /// A value as a sum of values that are not absorbed.
    fn flatten(&self, value: Value, flip: bool, sum: &mut Vec<(bool, Summand)>) {
        for (negative, summand) in self.summands(value) {
            match summand {
                Summand::Value(v) if self.absorbed[v] => self.flatten(v, negative != flip, sum),
                other => sum.push((negative != flip, other)),
            }
        }
    }
}

/// It moves at the rate 1, without being state.
fn is_time(name: &Symbol) -> bool {
    name.quantity() == Some(Quantity::Time)
}

/// What the results need, companions included.
fn needed(program: &Program) -> Vec<bool> {
    let mut needed = vec![false; program.steps.len()];
    let mut open: Vec<Value> = program.outputs.iter().map(|(_, v)| *v).collect();
    while let Some(value) = open.pop() {
        if !std::mem::replace(&mut needed[value], true) {
            open.extend(program.steps[value].operands());
            open.extend(companion_of(program, value));
        }
    }
    needed
}

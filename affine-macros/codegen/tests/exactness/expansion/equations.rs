//! Equations at a point: a system by its definition, a program step by step.

use std::cell::RefCell;
use std::collections::HashMap;

use affine_codegen::algebra::evaluate::{Field, evaluate_polynomial};
use affine_codegen::algebra::kernel::{Asked, Callee, Group};
use affine_codegen::algebra::{Arena, Expr, Function, Polynomial};
use affine_codegen::ir::Program;
use affine_codegen::mechanics::equations::System;
use affine_codegen::symbol::Symbol;

use super::number::{Jet, Number, Table};

/// Numbers by name.
pub(super) type Named = HashMap<String, Number>;

/// The value of a polynomial in symbols with known values.
pub(super) fn value(arena: &Arena, polynomial: &Polynomial, inputs: &Named) -> Option<Number> {
    evaluate_polynomial(arena, polynomial, &|symbol| inputs.get(&symbol.to_string()).copied())
}

/// A system at a point; definitions and calls are evaluated where something needs them.
pub(super) struct AtPoint<'a> {
    arena: &'a Arena,
    system: &'a System,
    stretches: &'a [Number],
    known: RefCell<Named>,
}

impl<'a> AtPoint<'a> {
    pub(super) fn new(arena: &'a Arena, system: &'a System, inputs: &Named, stretches: &'a [Number]) -> Self {
        Self { arena, system, stretches, known: RefCell::new(inputs.clone()) }
    }

    /// The rates by the names of the coordinates, and that of the work; `None` where a function has no value here.
    pub(super) fn rates(&self) -> Option<Named> {
        let rates = self.system.rates.iter().map(|(_, symbol, rate)| (*symbol, rate));
        let work = self.system.work.iter().map(|(symbol, power)| (*symbol, power));
        rates.chain(work).map(|(symbol, rate)| Some((self.name(symbol), self.of(rate)?))).collect()
    }

    pub(super) fn of(&self, polynomial: &Polynomial) -> Option<Number> {
        evaluate_polynomial(self.arena, polynomial, &|symbol| self.symbol(&symbol.to_string()))
    }

    fn name(&self, symbol: Expr) -> String {
        self.arena.symbol_name(symbol)
    }

    fn symbol(&self, name: &str) -> Option<Number> {
        if let Some(known) = self.known.borrow().get(name) {
            return Some(*known);
        }
        let is_it = |symbol: Expr| self.arena.symbol_name(symbol) == name;
        let value = match self.system.shared.iter().find(|(symbol, _)| is_it(*symbol)) {
            Some((_, definition)) => self.of(definition)?,
            None => {
                self.call(&is_it).unwrap_or_else(|| panic!("{name} is read and not defined"))?;
                self.known.borrow()[name]
            }
        };
        self.known.borrow_mut().insert(name.to_owned(), value);
        Some(value)
    }

    /// Calls what provides a symbol.
    fn call(&self, provided: &impl Fn(Expr) -> bool) -> Option<Option<()>> {
        let kernel = self.system.kernels.iter().find(|kernel| kernel.outputs().any(provided))?;
        let arguments: Option<Vec<Number>> = kernel.inputs().map(|p| self.of(p)).collect();
        let Some(arguments) = arguments else { return Some(None) };
        let results = called(kernel.callee, &arguments, self.stretches, &kernel.results);
        let Some(results) = results else { return Some(None) };
        let named = kernel.outputs().zip(results).map(|(symbol, value)| (self.name(symbol), value));
        self.known.borrow_mut().extend(named);
        Some(Some(()))
    }
}

/// What a runtime function gives.
fn called(
    callee: Callee,
    arguments: &[Number],
    stretches: &[Number],
    results: &[Group<Expr>],
) -> Option<Vec<Number>> {
    let n = stretches.len();
    let square =
        |entries: &[Number]| Table::constant(&entries.chunks(n).map(<[_]>::to_vec).collect::<Vec<_>>());
    match callee {
        Callee::Stretches => principal(&square(arguments), stretches),
        Callee::LogStretches => {
            let mut results = principal(&square(arguments), stretches)?;
            let logarithms: Option<Vec<Number>> =
                stretches.iter().map(|stretch| stretch.apply(Function::Ln)).collect();
            results.splice(n..n, logarithms?);
            Some(results)
        }
        Callee::Custom(place, Asked::Slopes(class, moves)) => {
            let (x, phi) = arguments.split_at(n);
            Some(slopes(place, class, if moves { x } else { &[] }, &square(phi)))
        }
        // Any isotropic function.
        Callee::EllipsoidalSlopes => Some(slopes(0, 0, &[], &square(arguments)).split_off(n)),
        // Any function of its arguments.
        Callee::Custom(place, Asked::Force(..)) => {
            let count = results.iter().map(|group| group.entries().len()).sum();
            Some((0..count).map(|k| any(place, k, arguments)).collect())
        }
        other => panic!("{other:?} in a system"),
    }
}

/// A function of the arguments, one for each of two numbers.
fn any(place: usize, k: usize, arguments: &[Number]) -> Number {
    let words = arguments.iter().map(|argument| argument.word());
    Number::hash(&[place as u64, k as u64].into_iter().chain(words).collect::<Vec<u64>>())
}

/// `Q`, `W = phi R` and the principal axes `R`, each up to its sign.
fn principal(phi: &Table, stretches: &[Number]) -> Option<Vec<Number>> {
    let n = phi.size();
    let green = &phi.transpose() * phi;
    let mut axes = Vec::new();
    for stretch in stretches {
        let square = Jet::constant(*stretch * *stretch);
        let form = &green - &Table::identity(n).scaled(square);
        let [a, b] = [&form.0[0], &form.0[n - 1]];
        // Orthogonal to the rows of a matrix of rank n - 1.
        let axis = match n {
            2 => vec![Jet::constant(Number::ZERO) - a[1], a[0]],
            _ => (0..3).map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]).collect(),
        };
        let square = axis.iter().fold(Number::ZERO, |sum, x| sum + x.value * x.value);
        let length = square.root()?.inverse();
        axes.push(axis.iter().map(|x| x.value * length).collect::<Vec<_>>());
    }
    let axes = Table::constant(&axes).transpose();
    let stretched = phi * &axes;
    Some([stretches.to_vec(), stretched.values().concat(), axes.values().concat()].concat())
}

/// `dU/dx` and `dU/dphi` of a potential of a class: `phi S` with a symmetric `S` of `G`, or `S phi` with one of `Ct`; of a
/// function of invariants `S = a 1 + b G`.
fn slopes(place: usize, class: u8, at: &[Number], phi: &Table) -> Vec<Number> {
    let n = phi.size();
    let green = &phi.transpose() * phi;
    let finger = phi * &phi.transpose();
    let seen = match class {
        0 => vec![green.trace().value, (&green * &green).trace().value],
        1 => green.values().concat(),
        2 => finger.values().concat(),
        _ => phi.values().concat(),
    };
    let seen = [at, &seen].concat();
    let entry = |i: usize, j: usize| Jet::constant(any(place, n * i + j, &seen));
    let symmetric = || Table::new(n, |i, j| entry(i.min(j), i.max(j)));
    let along_phi = match class {
        0 => phi * &(&Table::identity(n).scaled(entry(0, 0)) + &green.scaled(entry(0, 1))),
        1 => phi * &symmetric(),
        2 => &symmetric() * phi,
        _ => Table::new(n, entry),
    };
    let along_x = (0..n).map(|i| any(place, n * n + i, &seen));
    along_x.chain(along_phi.values().concat()).collect()
}

/// The results of a program by name; `None` where a function has no value.
pub(super) fn run(program: &Program, inputs: &Named) -> Option<Named> {
    let read = |symbol: &Symbol| {
        let value = inputs.get(&symbol.to_string()).copied();
        Some(value.unwrap_or_else(|| panic!("{symbol} is read and not known")))
    };
    let results = program.run::<Number>(&read)?;
    Some(program.results().map(Symbol::to_string).zip(results).collect())
}

//! From derived systems to the shortest straight-line programs.

use rustc_hash::FxHashSet;

use crate::algebra::bind::Constants;
use crate::algebra::definitions::needed;
use crate::algebra::factor::{First, complete_sums, factored, number_of_all, scale_atoms};
use crate::algebra::fault::never_missing;
use crate::algebra::products::share_products;
use crate::algebra::{Arena, Expr, Kernel, Polynomial};
use crate::ir::Program;
use crate::ir::build::{Builder, Ways};
use crate::ir::inverse_root::with_inverse_roots;
use crate::ir::quotient::with_quotients;
use crate::symbol::Symbol;

/// Named polynomials in the order of their results, with quantities they share.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Shared quantities; each may use others of the list.
    pub shared: Vec<(Expr, Polynomial)>,
    /// Calls of runtime functions, whose results are shared quantities too.
    pub kernels: Vec<Kernel>,
    /// The polynomials of the results, by name.
    pub results: Vec<(Symbol, Polynomial)>,
}

impl Batch {
    /// Without the shared quantities that no result needs.
    pub fn pruned(self, arena: &Arena) -> Self {
        let Self { shared, results, kernels } = self;
        let inputs = kernels.iter().flat_map(Kernel::inputs);
        let needed = needed(arena, &shared, results.iter().map(|(_, p)| p).chain(inputs));
        let kept = shared.iter().filter(|(symbol, _)| needed.contains(symbol)).cloned().collect();
        Self { shared: kept, results, kernels }
    }
}

/// A program for the batch: slow coefficients become `constants`, the rest is factored.
pub fn straight_line(
    arena: &mut Arena,
    batch: &Batch,
    constants: &mut Constants,
    varies: &impl Fn(Expr) -> bool,
) -> Program {
    let mut shared: FxHashSet<Expr> = batch.shared.iter().map(|(s, _)| *s).collect();
    shared.extend(batch.kernels.iter().flat_map(Kernel::outputs));
    let moving = |atom: Expr| varies(atom) || shared.contains(&atom);
    let mut polynomials: Vec<Polynomial> =
        batch.shared.iter().map(|(_, p)| p).chain(batch.results.iter().map(|(_, p)| p)).cloned().collect();
    polynomials.extend(batch.kernels.iter().flat_map(Kernel::inputs).cloned());
    for polynomial in &mut polynomials {
        *polynomial = constants.bind_inside(arena, polynomial, &moving);
    }
    let composite = composite_atoms(arena, &polynomials, &moving);
    let moving = |atom: Expr| varies(atom) || shared.contains(&atom) || composite.contains(&atom);
    let sums = complete_sums(arena, &mut polynomials, &moving);
    shared.extend(sums.iter().map(|(s, _)| *s));
    let moving = |atom: Expr| varies(atom) || shared.contains(&atom) || composite.contains(&atom);
    for polynomial in &mut polynomials {
        *polynomial = constants.bind(arena, polynomial, &moving);
    }
    let scaled = scale_atoms(arena, &mut polynomials, &moving);
    let mut sharing = polynomials.clone();
    let products = share_products(arena, &mut sharing);
    let nameless = [&sums, &scaled, &products].into_iter().flatten().map(|(symbol, _)| *symbol);
    let nameless: Vec<Expr> = nameless.collect();
    let named: Vec<_> = sums.into_iter().chain(scaled).collect();
    let mut programs = ways(arena, &Forms::new(batch, &polynomials, named.clone()));
    if !products.is_empty() {
        let named = named.into_iter().chain(products).collect();
        programs.extend(ways(arena, &Forms::new(batch, &sharing, named)));
    }
    shortest(programs).named_by_formulas(&nameless.iter().map(|s| arena.symbol_of(*s)).collect())
}

/// What a program computes, in the forms that are to be factored.
struct Forms<'a> {
    definitions: Vec<(Expr, Polynomial)>,
    calls: Vec<Kernel>,
    results: Vec<(&'a Symbol, Polynomial)>,
}

impl<'a> Forms<'a> {
    /// The polynomials of a batch, its shared quantities before its results and these before the arguments of its calls, with
    /// the definitions of what was named on the way.
    fn new(batch: &'a Batch, polynomials: &[Polynomial], named: Vec<(Expr, Polynomial)>) -> Self {
        let mut forms = polynomials.iter().cloned();
        let mut definitions = named;
        definitions.extend(batch.shared.iter().map(|(symbol, _)| *symbol).zip(forms.by_ref()));
        let results = batch.results.iter().map(|(name, _)| name).zip(forms.by_ref()).collect();
        let mut argument =
            |p: &Polynomial| never_missing(forms.next(), "every argument of a call has its form", p.clone());
        let calls = batch.kernels.iter().map(|kernel| kernel.with_arguments(&mut argument)).collect();
        Self { definitions, calls, results }
    }

    /// One program of them, and whether it has powers.
    fn built(&self, arena: &mut Arena, mut builder: Builder, first: First) -> (bool, Program) {
        define(arena, &mut builder, (self.definitions.clone(), self.calls.clone()), first);
        for (name, form) in &self.results {
            let value = factored(arena, form, first);
            builder.output(arena, (*name).clone(), value);
        }
        (builder.has_powers(), with_quotients(&with_inverse_roots(&builder.finish())))
    }

    fn has_numbers(&self) -> bool {
        let mut forms = self.definitions.iter().map(|(_, form)| form);
        forms.any(|p| number_of_all(p).is_some())
            || self.results.iter().any(|(_, p)| number_of_all(p).is_some())
    }
}

/// Programs for the same forms.
fn ways(arena: &mut Arena, forms: &Forms) -> Vec<Program> {
    let (has_powers, program) = forms.built(arena, Builder::new(), First::Atom);
    let mut ways = Vec::new();
    let steps_through_powers = Ways { steps_through_powers: true, ..Ways::default() };
    if has_powers {
        ways.push(forms.built(arena, Builder::by(steps_through_powers), First::Atom).1);
    }
    if program.operations().div > 1 {
        let inverts = Ways { inverts_divisors: true, ..Ways::default() };
        ways.push(forms.built(arena, Builder::by(inverts), First::Atom).1);
        let inverts = Ways { inverts_divisors: true, ..steps_through_powers };
        ways.push(forms.built(arena, Builder::by(inverts), First::Atom).1);
    }
    ways.push(program);
    if forms.has_numbers() {
        ways.push(forms.built(arena, Builder::new(), First::Number).1);
    }
    ways
}

/// The shortest of some programs, the first of several.
fn shortest(programs: Vec<Program>) -> Program {
    let shortest = programs.into_iter().min_by_key(|program| program.operations().weight());
    never_missing(shortest, "there is one way to write a program", Program::default())
}

/// Definitions and calls in an order in which each uses only what is there already.
fn define(
    arena: &mut Arena,
    builder: &mut Builder,
    (mut open, mut calls): (Vec<(Expr, Polynomial)>, Vec<Kernel>),
    first: First,
) {
    let mut pending: FxHashSet<Expr> = open.iter().map(|(symbol, _)| *symbol).collect();
    pending.extend(calls.iter().flat_map(Kernel::outputs));
    loop {
        let known = |p: &Polynomial| !p.any_symbol(arena, &mut |s| pending.contains(&s));
        if let Some(ready) = open.iter().position(|(_, p)| known(p)) {
            let (symbol, polynomial) = open.remove(ready);
            let value = factored(arena, &polynomial, first);
            builder.define(arena, symbol, value);
            pending.remove(&symbol);
        } else if let Some(ready) = calls.iter().position(|call| call.inputs().all(known)) {
            let call = calls.remove(ready);
            let arguments: Vec<_> =
                call.arguments.iter().map(|group| group.map(|p| factored(arena, p, first))).collect();
            builder.call(arena, call.callee, &arguments, &call.results);
            for symbol in call.outputs() {
                pending.remove(&symbol);
            }
        } else {
            break;
        }
    }
}

/// The functions and reciprocals of something that varies.
fn composite_atoms(
    arena: &Arena,
    polynomials: &[Polynomial],
    varies: &impl Fn(Expr) -> bool,
) -> FxHashSet<Expr> {
    let atoms = polynomials.iter().flat_map(|p| p.terms().flat_map(|(monomial, _)| monomial.iter().copied()));
    atoms
        .filter(|atom| arena.as_symbol(*atom).is_none() && arena.any_symbol(*atom, &mut |s| varies(s)))
        .collect()
}

//! Sums that stand in powers and functions: multiplied out, `(tr G - 3)^8` is a difference of numbers that are larger by many
//! orders. Products of several sums keep them where they would have many terms.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::algebra::arena::Node;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::symbol::Quantity;

/// Sums with the symbols that stand for them.
#[derive(Default)]
pub(super) struct Sums {
    /// In the order in which they are computed.
    known: Vec<(Expr, Expr)>,
    /// Does a factor that is a sum of functions stay one? `1 - tanh^2` is small where both are not.
    functions: bool,
}

impl Sums {
    /// Of slopes, in which the slopes of functions are factors.
    pub(super) fn of_slopes() -> Self {
        Self { functions: true, ..Self::default() }
    }

    /// The expression with symbols for the sums that it raises to a power, wherever they stand in it.
    pub(super) fn named(&mut self, arena: &mut Arena, expr: Expr) -> Expr {
        let mut found = Found::default();
        self.find(arena, expr, &mut found);
        if found.raised.is_empty() && self.known.is_empty() {
            return expr;
        }
        self.replaced(arena, expr, &found.raised, &mut FxHashMap::default())
    }

    /// The symbols with their sums multiplied out.
    pub(super) fn forms(&self, arena: &mut Arena) -> Vec<(Expr, Polynomial)> {
        self.known.iter().map(|(symbol, sum)| (*symbol, Polynomial::normal_form(arena, *sum))).collect()
    }

    /// The symbols, and the sums in terms of those before.
    pub(super) fn known(&self) -> &[(Expr, Expr)] {
        &self.known
    }

    /// Sums to any power but the first, those in functions, and factors that stay.
    fn find(&self, arena: &Arena, expr: Expr, found: &mut Found) {
        if !found.seen.insert(expr) {
            return;
        }
        match arena.node(expr) {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Function(_, argument) => {
                found.keep(arena, *argument);
                self.find(arena, *argument, found);
            }
            Node::Sum(_, terms) => {
                let all = terms.iter().all(|(term, _)| sums_in(arena, *term).next().is_some());
                if all && found.sizes.of(arena, expr) > SHORT {
                    found.raised.extend(terms.iter().flat_map(|(term, _)| sums_in(arena, *term)));
                }
                terms.iter().for_each(|(term, _)| self.find(arena, *term, found));
            }
            Node::Product(factors) => {
                let sizes = factors.iter().map(|(base, _)| terms(arena, *base));
                let many = sizes.fold(1, |product: usize, size| product.saturating_mul(size)) > FEW_TERMS;
                for (base, exponent) in factors {
                    if many || *exponent != 1 || self.functions && is_of_functions(arena, *base) {
                        found.keep(arena, *base);
                    }
                }
                factors.iter().for_each(|(base, _)| self.find(arena, *base, found));
            }
        }
    }

    fn replaced(
        &mut self,
        arena: &mut Arena,
        expr: Expr,
        raised: &FxHashSet<Expr>,
        done: &mut FxHashMap<Expr, Expr>,
    ) -> Expr {
        if let Some(done) = done.get(&expr) {
            return *done;
        }
        let rebuilt = arena.rebuilt(expr, &mut |arena, part| self.replaced(arena, part, raised, done));
        let named = match arena.node(rebuilt) {
            Node::Sum(..) => self.name_of(arena, rebuilt, raised.contains(&expr)),
            _ => rebuilt,
        };
        done.insert(expr, named);
        named
    }

    /// The symbol of a sum that has one or is to have one.
    fn name_of(&mut self, arena: &mut Arena, sum: Expr, wanted: bool) -> Expr {
        let known = self.known.iter().find(|(_, known)| *known == sum).map(|(symbol, _)| *symbol);
        if known.is_some() || !wanted {
            return known.unwrap_or(sum);
        }
        let symbol = arena.symbol(Quantity::Raised.at([self.known.len() + 1]));
        self.known.push((symbol, sum));
        symbol
    }
}

/// What is found in an expression.
#[derive(Default)]
struct Found {
    seen: FxHashSet<Expr>,
    sizes: Sizes,
    /// Sums that are to be named.
    raised: FxHashSet<Expr>,
}

/// The factors of a product that are sums.
fn sums_in(arena: &Arena, product: Expr) -> impl Iterator<Item = Expr> {
    let factors = match arena.node(product) {
        Node::Product(factors) => factors.as_slice(),
        _ => &[],
    };
    factors.iter().map(|(base, _)| *base).filter(|base| terms(arena, *base) > 1)
}

impl Found {
    fn keep(&mut self, arena: &Arena, of: Expr) {
        if terms(arena, of) > 1 {
            self.raised.insert(of);
        }
    }
}

/// Products of sums are multiplied out up to so many terms.
const FEW_TERMS: usize = 32;

/// A sum of products of sums, as an entry of a product of matrices is, is multiplied out up to so many terms.
const SHORT: u32 = 8;

/// Has the sum a term with a function in it?
fn is_of_functions(arena: &Arena, expr: Expr) -> bool {
    let is_function = |node: Expr| matches!(arena.node(node), Node::Function(..));
    let in_product = |term: Expr| match arena.node(term) {
        Node::Product(factors) => factors.iter().any(|(base, _)| is_function(*base)),
        _ => is_function(term),
    };
    matches!(arena.node(expr), Node::Sum(_, terms) if terms.iter().any(|(term, _)| in_product(*term)))
}

/// How many terms expressions have at most once they are multiplied out; functions and divisors are one.
#[derive(Default)]
pub(super) struct Sizes(FxHashMap<Expr, u32>);

impl Sizes {
    pub(super) fn of(&mut self, arena: &Arena, expr: Expr) -> u32 {
        if let Some(known) = self.0.get(&expr) {
            return *known;
        }
        let size = match arena.node(expr) {
            Node::Constant(_) | Node::Symbol(_) | Node::Function(..) => return 1,
            Node::Sum(constant, terms) => terms
                .iter()
                .map(|(term, _)| self.of(arena, *term))
                .fold(u32::from(!constant.is_zero()), u32::saturating_add),
            Node::Product(factors) => factors
                .iter()
                .map(|(base, exponent)| {
                    self.of(arena, *base).saturating_pow((*exponent).max(0).unsigned_abs())
                })
                .fold(1, u32::saturating_mul),
        };
        self.0.insert(expr, size);
        size
    }

    /// The same of the largest part, those in functions and divisors among them.
    pub(super) fn of_largest_part(&mut self, arena: &Arena, expr: Expr) -> u32 {
        let (mut open, mut seen, mut largest) = (vec![expr], FxHashSet::default(), 0);
        while let Some(part) = open.pop() {
            if seen.insert(part) {
                largest = largest.max(self.of(arena, part));
                open.extend(arena.parts(part));
            }
        }
        largest
    }
}

/// How many terms a sum has; anything else is one.
fn terms(arena: &Arena, expr: Expr) -> usize {
    match arena.node(expr) {
        Node::Sum(constant, terms) => terms.len() + usize::from(!constant.is_zero()),
        _ => 1,
    }
}

//! Which sums are counted from the undeformed state, `tr G = n + (tr G - n)`.
//!
//! Where the numbers of a sum cancel there, its digits are in the differences. Any other sum is as good there as it stands, and better
//! in a small body: its differences are about `-n`, and few of their digits are left once `n` is added.

use rustc_hash::FxHashMap;

use crate::algebra::polynomial::Monomial;
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::metric::Definitions;
use crate::symbol::Quantity;

use super::base::Base;
use super::rewriting::about_undeformed;
use super::sums::Sums;

/// A sum cancels where its terms are together larger by more than this: five bits.
const MOST_LOST: i64 = 32;

/// Functions about the undeformed state, multiplied out, and the sums that they raise to powers.
pub(super) struct Forms {
    pub(super) values: Vec<Polynomial>,
    pub(super) sums: Definitions,
}

impl Forms {
    pub(super) fn new(arena: &mut Arena, values: &[Expr]) -> Self {
        let mut sums = Sums::default();
        let mut named = |value: &Expr| {
            let shifted = about_undeformed(arena, *value);
            sums.named(arena, shifted)
        };
        let named: Vec<Expr> = values.iter().map(&mut named).collect();
        let sums = sums.forms(arena);
        Self { values: named.into_iter().map(|value| Polynomial::normal_form(arena, value)).collect(), sums }
    }

    /// The same as they are computed near the undeformed state.
    pub(super) fn counted(&self, arena: &Arena, counting: &Counting) -> Self {
        let near = |form: &Polynomial| counting.counted(arena, form).unwrap_or_else(|| form.clone());
        Self {
            values: self.values.iter().map(near).collect(),
            sums: self.sums.iter().map(|(symbol, form)| (*symbol, near(form))).collect(),
        }
    }

    /// Do they lose their digits in small bodies as they are computed there?
    pub(super) fn lose_small(&self, arena: &Arena, counting: &Counting) -> bool {
        let mut all = self.values.iter().chain(self.sums.iter().map(|(_, form)| form));
        all.any(|form| counting.loses_small(arena, form))
    }
}

/// Symbols with their values at `phi = 1` taken out.
pub(super) struct Counting {
    /// Each as its value there and differences.
    moved: Definitions,
    /// Base functions that are not zero at `phi = 1`.
    at_rest: Numbers,
    /// What the differences are where the body vanishes.
    vanished: Numbers,
}

/// The number that each of some symbols stands for.
type Numbers = FxHashMap<Expr, Rational>;

impl Counting {
    /// Symbols as polynomials in differences, each of which is `vanished` at `phi = 0`.
    pub(super) fn new(arena: &mut Arena, n: usize, moved: Definitions, vanished: &Rational) -> Self {
        let traces = Base::TRACES.map(|trace| (trace, Rational::whole(n)));
        let diagonal = |a: usize| [Base::Placement(a, a), Base::Green(a, a), Base::Finger(a, a)];
        let ones = (0..n).flat_map(diagonal).map(|base| (base, Rational::ONE));
        let at_rest =
            traces.into_iter().chain(ones).map(|(base, value)| (base.symbol(arena), value)).collect();
        let differences = moved.iter().flat_map(|(_, form)| form.atoms());
        let vanished = differences.map(|symbol| (*symbol, vanished.clone())).collect();
        Self { moved, at_rest, vanished }
    }

    /// Does the sum lose digits in small bodies where it is counted?
    fn loses_small(&self, arena: &Arena, form: &Polynomial) -> bool {
        let lost = |form: Polynomial| Parts::new(&form, &self.vanished).any_cancels();
        self.counted(arena, form).is_some_and(lost)
    }

    /// The sum through the differences where its numbers cancel at `phi = 1`, for some values of the fields at least.
    fn counted(&self, arena: &Arena, form: &Polynomial) -> Option<Polynomial> {
        let parts = Parts::new(form, &self.at_rest);
        let cancels = parts.any_cancels() || parts.constants(arena) > 1;
        cancels.then(|| form.substitute(&listed(&self.moved)))
    }
}

/// A sum by what stands beside some numbers in its terms: the sum of these, and of their sizes.
struct Parts(FxHashMap<Monomial, [Rational; 2]>);

impl Parts {
    /// With numbers for some symbols.
    fn new(form: &Polynomial, numbers: &Numbers) -> Self {
        let mut parts: FxHashMap<Monomial, [Rational; 2]> = FxHashMap::default();
        for (monomial, c) in form.terms() {
            let (mut number, mut beside) = (c.clone(), Monomial::new());
            for atom in monomial {
                match numbers.get(atom) {
                    Some(value) => number = &number * value,
                    None => beside.push(*atom),
                }
            }
            let [sum, size] = parts.entry(beside).or_insert([Rational::ZERO, Rational::ZERO]);
            *sum = &*sum + &number;
            *size = &*size + &number.abs();
        }
        Self(parts)
    }

    /// A part may be of any size beside the others, since fields are.
    fn any_cancels(&self) -> bool {
        self.0.values().any(|[sum, size]| *size > &sum.abs() * &Rational::from(MOST_LOST))
    }

    /// How many do not move with the body, as those of sums with a name may: together they may cancel.
    fn constants(&self, arena: &Arena) -> usize {
        let moves = |of: Expr| !arena.is_parameter(of) && arena.quantity(of) != Some(Quantity::Raised);
        let is_constant =
            |beside: &&Monomial| !beside.iter().any(|atom| arena.any_symbol(*atom, &mut |of| moves(of)));
        self.0.keys().filter(is_constant).count()
    }
}

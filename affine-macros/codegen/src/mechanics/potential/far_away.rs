//! The value of a potential far from the undeformed state: `phi = D Psi` with `det Psi = 1`, where tensors are powers of
//! `D` times those of `Psi`, and what is of degree 0 knows nothing of `D`.

use crate::algebra::arena::Node;
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::mechanics::charts::Chart;

use super::base::Base;
use super::rewriting::{exponential_of_dilatation, multiple_of_logarithm};
use super::tensors::{finger, green};
use super::{DILATATION, Potential};

impl Potential {
    /// `U` for evaluation far from the undeformed state, with what it shares; `q`, `q_a` and `D` are inputs. `None` where
    /// [`energy_at_a_point`](Self::energy_at_a_point) is as good there: it is not with exponentials of logarithms, nor with
    /// logarithms that `q` is the opposite of.
    pub fn energy_far_away(
        &self,
        arena: &mut Arena,
        chart: &Chart,
    ) -> Option<(Polynomial, Vec<(Expr, Polynomial)>)> {
        let q = Base::MeanLogStretch.symbol(arena);
        let exponential =
            |function, of: Expr| function == Function::Exp && multiple_of_logarithm(arena, of).is_some();
        let logarithm = |function, _| function == Function::Ln;
        let differs = applies(arena, self.energy, &exponential)
            || applies(arena, self.energy, &logarithm)
                && arena.any_symbol(self.energy, &mut |symbol| symbol == q);
        if !differs {
            return None;
        }
        let d = arena.symbol(DILATATION);
        let energy = exponential_of_dilatation(arena, self.energy);
        let scaled = scaled_bases(arena, self.dim, d);
        let energy = arena.substitute(energy, &|symbol| {
            scaled.iter().find(|(known, _)| *known == symbol).map(|(_, value)| *value)
        })?;
        let energy = without_cancelling_powers(arena, energy, d);
        let value = Polynomial::normal_form(arena, energy);
        Some((cancelled(arena, &value, d), definitions(arena, chart, d)))
    }
}

/// Does it contain a function of an argument that is `wanted`?
fn applies(arena: &Arena, expr: Expr, wanted: &dyn Fn(Function, Expr) -> bool) -> bool {
    match arena.node(expr) {
        Node::Constant(_) | Node::Symbol(_) => false,
        Node::Sum(_, terms) => terms.iter().any(|(term, _)| applies(arena, *term, wanted)),
        Node::Product(factors) => factors.iter().any(|(base, _)| applies(arena, *base, wanted)),
        Node::Function(function, argument) => {
            wanted(*function, *argument) || applies(arena, *argument, wanted)
        }
    }
}

/// Base functions as powers of `D` times those of `Psi`, under names of their own.
fn scaled_bases(arena: &mut Arena, n: usize, d: Expr) -> Vec<(Expr, Expr)> {
    let mut list = Vec::new();
    for base in Base::all(n) {
        let degree = match base {
            Base::MeanLogStretch | Base::LogStretch(_) | Base::Position(_) => continue,
            Base::Placement(..) => 1,
            Base::Trace | Base::Green(..) | Base::Finger(..) => 2,
            Base::TraceOfSquare => 4,
        };
        let symbol = base.symbol(arena);
        let own = isochoric(arena, base);
        // A symbol is not the number zero.
        list.extend(arena.product(&[(d, degree), (own, 1)]).map(|value| (symbol, value)));
    }
    list
}

/// The symbol of a base function of `Psi`.
fn isochoric(arena: &mut Arena, base: Base) -> Expr {
    let symbol = base.symbol(arena);
    let name = arena.name(symbol).unwrap_or_default().to_owned();
    match base {
        Base::Placement(i, a) => Matrix::symbols(arena, "psi", i.max(a) + 1).0[i][a],
        _ => arena.symbol(&format!("isochoric_{name}")),
    }
}

/// The expression with powers of `D` collected, in the arguments of functions too.
fn without_cancelling_powers(arena: &mut Arena, expr: Expr, d: Expr) -> Expr {
    let parts = |arena: &mut Arena, e: Expr| without_cancelling_powers(arena, e, d);
    let rebuilt = match arena.node(expr).clone() {
        Node::Constant(_) | Node::Symbol(_) => return expr,
        Node::Function(function, argument) => {
            let argument = parts(arena, argument);
            return match function {
                Function::Ln => logarithm(arena, argument, d),
                _ => arena.apply(function, argument),
            };
        }
        Node::Sum(constant, terms) => {
            let mut summands = vec![(arena.constant(constant), Rational::ONE)];
            for (term, c) in terms {
                summands.push((parts(arena, term), c));
            }
            arena.linear(&summands)
        }
        Node::Product(factors) => {
            let mut product = Vec::with_capacity(factors.len());
            for (base, exponent) in factors {
                product.push((parts(arena, base), exponent));
            }
            // The bases keep their values, and were not the number zero.
            arena.product(&product).unwrap_or(expr)
        }
    };
    let form = Polynomial::normal_form(arena, rebuilt);
    cancelled(arena, &form, d).expression(arena)
}

/// `ln(D^k u) = k q + ln u`.
fn logarithm(arena: &mut Arena, argument: Expr, d: Expr) -> Expr {
    let power = match arena.node(argument) {
        Node::Product(factors) => factors.iter().find(|(base, _)| *base == d).map_or(0, |(_, k)| *k),
        _ => 0,
    };
    let rest = arena.product(&[(argument, 1), (d, -power)]).unwrap_or(argument);
    let (q, rest) = (Base::MeanLogStretch.symbol(arena), arena.apply(Function::Ln, rest));
    arena.linear(&[(q, Rational::from(i64::from(power))), (rest, Rational::ONE)])
}

/// The polynomial without products of `D` and `1/D`, which are atoms of their own.
fn cancelled(arena: &mut Arena, form: &Polynomial, d: Expr) -> Polynomial {
    let inverse = arena.pow(d, -1).unwrap_or(d);
    let mut result = Polynomial::zero();
    for (monomial, c) in form.terms() {
        let count = |atom: Expr| monomial.iter().filter(|a| **a == atom).count();
        let power = count(d).min(count(inverse));
        let mut left = [power, power];
        let kept = monomial.iter().copied().filter(|atom| {
            let which = [d, inverse].iter().position(|known| known == atom);
            let Some(left) = which.map(|k| &mut left[k]) else { return true };
            let keep = *left == 0;
            *left = left.saturating_sub(1);
            keep
        });
        result.add_term(kept.collect(), c);
    }
    result
}

/// `Psi`, its tensors and traces; what is not used goes later.
fn definitions(arena: &mut Arena, chart: &Chart, d: Expr) -> Vec<(Expr, Polynomial)> {
    let n = chart.dim;
    let inverse = arena.pow(d, -1).unwrap_or(d);
    let psi = Matrix::symbols(arena, "psi", n).0;
    let mut list = Vec::new();
    for (i, a) in (0..n).flat_map(|i| (0..n).map(move |a| (i, a))) {
        list.push((psi[i][a], Polynomial::term(vec![inverse, chart.phi.0[i][a]], Rational::ONE)));
    }
    let psi: Vec<Vec<Polynomial>> =
        psi.iter().map(|row| row.iter().copied().map(Polynomial::atom).collect()).collect();
    let (mut trace, mut of_square) = (Polynomial::zero(), Polynomial::zero());
    for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (a, b))) {
        let [of_green, of_finger] = [Base::Green(a, b), Base::Finger(a, b)].map(|base| isochoric(arena, base));
        if a <= b {
            list.push((of_green, green(&psi, a, b)));
            list.push((of_finger, finger(&psi, a, b)));
        }
        of_square.add_term(vec![of_green, of_green], &Rational::ONE);
        if a == b {
            trace.add_term(vec![of_green], &Rational::ONE);
        }
    }
    list.push((isochoric(arena, Base::Trace), trace));
    list.push((isochoric(arena, Base::TraceOfSquare), of_square));
    list
}

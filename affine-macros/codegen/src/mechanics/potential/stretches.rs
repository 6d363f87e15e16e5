//! Functions of the single stretches: a canonical form, in which equal functions are equal and what is symmetric is
//! written through `q`, `tr G` and `tr G^2`.
//!
//! A term is `c q_1^k_1 ... Q_1^l_1 ... (other factors)`: products and powers of exponentials are one exponential for each
//! stretch, `Q_a = exp(q_a)`. Symmetric functions of the stretches that are smooth in the `q_a` are smooth functions of
//! the placement, also where stretches coincide (Ball, Duke Math. J. 51 (1984) 699).

mod canonical;
mod form;
mod symmetric;

use crate::algebra::arena::Node;
use crate::algebra::ring::above_diagonal;
use crate::algebra::{Arena, Expr, Function, Rational};

use super::base::{Base, log_stretches};
use form::Form;

/// The function in canonical form.
pub fn canonical(arena: &mut Arena, n: usize, energy: Expr) -> Expr {
    // What is written through traces may cancel further.
    (0..3).fold(energy, |energy, _| {
        let form = Form::of(arena, n, energy);
        symmetric::through_traces(arena, n, form).expression(arena, n)
    })
}

/// Does it need the single stretches?
pub fn is_stretched(arena: &mut Arena, n: usize, energy: Expr) -> bool {
    let stretches = log_stretches(arena, n);
    arena.any_symbol(energy, &mut |symbol| stretches.contains(&symbol))
}

/// The function with two stretches exchanged, counted from 0; `None` where that divides by zero.
pub fn exchanged(arena: &mut Arena, n: usize, energy: Expr, a: usize, b: usize) -> Option<Expr> {
    let q = log_stretches(arena, n);
    arena.substitute(energy, &|symbol| match symbol {
        _ if symbol == q[a] => Some(q[b]),
        _ if symbol == q[b] => Some(q[a]),
        _ => None,
    })
}

/// Does a function vanish wherever two stretches, counted from 0, coincide? `q` and the traces of `G` are what they are in
/// terms of the stretches.
pub fn vanishes_at_coincidence(arena: &mut Arena, n: usize, function: Expr, a: usize, b: usize) -> bool {
    let q = log_stretches(arena, n);
    let [mean, trace, of_square, of_cube] =
        [Base::MeanLogStretch, Base::Trace, Base::TraceOfSquare, Base::TraceOfCube]
            .map(|base| base.symbol(arena));
    let stretches: Vec<Expr> = (0..n).map(|c| if c == b { q[a] } else { q[c] }).collect();
    let nth = Rational::one_over(n);
    let sum = |arena: &mut Arena, power: i64| {
        let terms: Vec<(Expr, Rational)> = stretches
            .iter()
            .map(|q| {
                let argument = arena.scale(*q, &Rational::from(power));
                (arena.apply(Function::Exp, argument), Rational::ONE)
            })
            .collect();
        arena.linear(&terms)
    };
    let traces = [sum(arena, 2), sum(arena, 4), sum(arena, 6)];
    let means: Vec<(Expr, Rational)> = stretches.iter().map(|q| (*q, nth.clone())).collect();
    let means = arena.linear(&means);
    let at_coincidence = arena.substitute(function, &|symbol| match symbol {
        _ if symbol == mean => Some(means),
        _ if symbol == trace => Some(traces[0]),
        _ if symbol == of_square => Some(traces[1]),
        _ if symbol == of_cube => Some(traces[2]),
        _ if symbol == q[b] => Some(q[a]),
        _ => None,
    });
    at_coincidence.is_none_or(|value| Form::of(arena, n, value).is_zero())
}

/// The first argument of a root, a logarithm or a quotient in `energy` that vanishes where two stretches coincide.
pub fn singular_at_coincidence(arena: &mut Arena, n: usize, energy: Expr) -> Option<(Expr, (usize, usize))> {
    let vanishing = |arena: &mut Arena, argument: Expr| {
        let pairs = above_diagonal(n);
        pairs.into_iter().find(|(a, b)| vanishes_at_coincidence(arena, n, argument, *a, *b))
    };
    let mut pending = vec![energy];
    while let Some(expr) = pending.pop() {
        let singular = match arena.node(expr).clone() {
            Node::Product(factors) => {
                factors.into_iter().filter(|(_, k)| *k < 0).map(|(base, _)| base).collect()
            }
            Node::Function(Function::Sqrt | Function::Ln, argument) => vec![argument],
            _ => Vec::new(),
        };
        for part in singular {
            if let Some(pair) = vanishing(arena, part) {
                return Some((part, pair));
            }
        }
        pending.extend(arena.parts(expr));
    }
    None
}

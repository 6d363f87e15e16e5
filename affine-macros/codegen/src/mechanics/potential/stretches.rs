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
use crate::algebra::fault::never_missing;
use crate::algebra::ring::{Square, above_diagonal, pairs, table, upper};
use crate::algebra::substitute::listed;
use crate::algebra::vanishing::is_zero;
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
    arena.substitute(energy, &listed(&[(q[a], q[b]), (q[b], q[a])]))
}

/// Does a function vanish everywhere, or wherever two stretches, counted from 0, coincide, or has it no value there? `q` and the
/// traces of `G` are what they are in terms of the stretches; and so are the entries of `phi`, `G` and `Ct`, but where stretches
/// coincide, for what vanishes with some entry there may stand in a function that no stretch needs.
pub fn vanishes(arena: &mut Arena, n: usize, function: Expr, coincidence: Option<(usize, usize)>) -> bool {
    let q = log_stretches(arena, n);
    let mut stretches = q.clone();
    if let Some((a, b)) = coincidence {
        stretches[b] = stretches[a];
    }
    let means: Vec<_> = stretches.iter().map(|q| (*q, Rational::one_over(n))).collect();
    let mut values: Vec<(Expr, Expr)> = q.into_iter().zip(stretches.iter().copied()).collect();
    values.push((Base::MeanLogStretch.symbol(arena), arena.linear(&means)));
    for trace in Base::TRACES {
        let mut power = |q: &Expr| {
            let argument = arena.scale(*q, &Rational::whole(trace.degree()));
            (arena.apply(Function::Exp, argument), Rational::ONE)
        };
        let powers: Vec<_> = stretches.iter().map(&mut power).collect();
        values.push((trace.symbol(arena), arena.linear(&powers)));
    }
    if coincidence.is_none() {
        values.extend(entries(arena, &stretches));
    }
    let value = arena.substitute(function, &listed(&values));
    value.is_none_or(|value| is_zero(arena, value) != Some(false))
}

/// The entries of `phi = L D R^T`, `G` and `Ct`, for two rotations about axes and by angles that nobody writes.
fn entries(arena: &mut Arena, stretches: &[Expr]) -> Vec<(Expr, Expr)> {
    let n = stretches.len();
    let [left, right] = [[1009, 137, 59, 211], [997, -71, 311, 83]].map(|quaternion| rotation(n, quaternion));
    let mut of = |base: Base, rows: [&[Rational]; 2], power: usize| {
        let mut summand = |(a, q): (usize, &Expr)| {
            let argument = arena.scale(*q, &Rational::whole(power));
            (arena.apply(Function::Exp, argument), &rows[0][a] * &rows[1][a])
        };
        let summands: Vec<_> = stretches.iter().enumerate().map(&mut summand).collect();
        (base.symbol(arena), arena.linear(&summands))
    };
    let mut entries: Vec<_> =
        pairs(n).map(|(i, a)| of(Base::Placement(i, a), [&left[i], &right[a]], 1)).collect();
    for (a, b) in upper(n) {
        entries.push(of(Base::Green(a, b), [&right[a], &right[b]], 2));
        entries.push(of(Base::Finger(a, b), [&left[a], &left[b]], 2));
    }
    entries
}

/// The rotation of a quaternion, in the plane about the third axis (Euler, Rodrigues).
fn rotation(n: usize, [a, b, c, d]: [i64; 4]) -> Square<Rational> {
    let [b, c] = if n == 2 { [0, 0] } else { [b, c] };
    let part = |number: i64| {
        never_missing(
            Rational::ratio(number, a * a + b * b + c * c + d * d),
            "a quaternion has a length",
            Rational::ZERO,
        )
    };
    let rows = [
        [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
        [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
        [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
    ];
    table(n, |i, j| part(rows[i][j]))
}

/// The first argument of a root, a logarithm or a quotient in `energy` that vanishes where two stretches coincide.
pub fn singular_at_coincidence(arena: &mut Arena, n: usize, energy: Expr) -> Option<(Expr, (usize, usize))> {
    let vanishing = |arena: &mut Arena, argument: Expr| {
        let pairs = above_diagonal(n);
        pairs.into_iter().find(|pair| vanishes(arena, n, argument, Some(*pair)))
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

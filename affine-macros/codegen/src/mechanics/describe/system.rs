//! Systems component by component.

use super::Formula;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::mechanics::equations::System;
use crate::mechanics::notation::{latex, plain};

/// Shared quantities and rates of a system, component by component; what is a rate itself is written there.
pub fn system(arena: &mut Arena, system: &System) -> Vec<Formula> {
    let value_of_rate = |rate: &Polynomial| {
        system.shared.iter().find(|(s, _)| *rate == Polynomial::atom(*s)).map(|(_, value)| value.clone())
    };
    let is_rate = |s: Expr| system.rates.iter().any(|(_, _, rate)| *rate == Polynomial::atom(s));
    let shared = system.shared.iter().filter(|(s, _)| !is_rate(*s)).map(|(s, p)| (*s, p.clone(), false));
    let rates =
        system.rates.iter().map(|(_, s, p)| (*s, value_of_rate(p).unwrap_or_else(|| p.clone()), true));
    let work = system.work.iter().map(|(s, p)| (*s, p.clone(), true));
    let equations: Vec<(Expr, Polynomial, bool)> = shared.chain(rates).chain(work).collect();
    equations
        .into_iter()
        .map(|(symbol, p, rate)| {
            let form = p.expression(arena);
            let (name, name_latex) = (plain(arena, symbol), latex(arena, symbol));
            let (left, left_latex) = if rate {
                (format!("d{name}/dt"), format!("\\dot{{{name_latex}}}"))
            } else {
                (name, name_latex)
            };
            Formula {
                text: format!("{left} = {}", plain(arena, form)),
                latex: format!("{left_latex} = {}", latex(arena, form)),
            }
        })
        .collect()
}

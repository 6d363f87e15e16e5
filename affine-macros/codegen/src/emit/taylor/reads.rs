//! What rules read.

use super::writer::Writer;
use crate::ir::taylor::{Rule, Term};
use crate::ir::{Op, Value};
use crate::symbol::Symbol;

/// The moving values of the present order that a rule reads.
pub(super) fn of(rule: &Rule) -> Vec<Value> {
    match rule {
        Rule::Sum(terms) => terms
            .iter()
            .flat_map(|(_, term)| match *term {
                Term::Value(v) | Term::Scaled(_, v) | Term::Divided(v, _) | Term::Over(v, _) => vec![v],
                Term::Ends(a, b) => vec![a, b],
                Term::Lane(_) => Vec::new(),
            })
            .collect(),
        Rule::Quotient { numerator, denominator, .. } => {
            numerator.iter().chain([denominator]).copied().collect()
        }
        Rule::Function { argument, .. } => vec![*argument],
        Rule::Time => Vec::new(),
    }
}

/// The values that do not move and that rules read.
pub(super) fn fixed(rules: &[&(Value, Rule)]) -> Vec<Value> {
    let mut fixed: Vec<Value> = Vec::new();
    for (_, rule) in rules {
        let Rule::Sum(terms) = rule else { continue };
        for (_, term) in terms {
            if let Term::Scaled(c, _) | Term::Divided(_, c) = term
                && !fixed.contains(c)
            {
                fixed.push(*c);
            }
        }
    }
    fixed
}

/// Is a coefficient of order zero read, or only those of the present order?
pub(super) fn first(rule: &Rule) -> bool {
    match rule {
        Rule::Sum(terms) => terms.iter().any(|(_, term)| matches!(term, Term::Ends(..))),
        Rule::Time => false,
        Rule::Quotient { .. } | Rule::Function { .. } => true,
    }
}

impl<'a> Writer<'a> {
    /// The rules of ready values that `wanted` ones are made of, in their order.
    pub(super) fn ready_rules(&self, wanted: &[Value]) -> Vec<&'a (Value, Rule)> {
        let mut open: Vec<Value> = wanted.to_vec();
        let mut rules = Vec::new();
        for entry in self.recurrence.rules.iter().rev() {
            let (value, rule) = entry;
            if self.recurrence.ready[*value] && open.contains(value) {
                open.extend(of(rule));
                rules.push(entry);
            }
        }
        rules.reverse();
        rules
    }

    /// The states among some values and what some rules read.
    pub(super) fn states_among(&self, values: &[Value], rules: &[&(Value, Rule)]) -> Vec<Symbol> {
        let read = values.iter().copied().chain(rules.iter().flat_map(|(_, rule)| of(rule)));
        let states = read.filter(|v| {
            self.recurrence.moving[*v] && matches!(self.recurrence.program.steps[*v], Op::Input(_))
        });
        states.map(|v| self.name(v)).collect()
    }
}

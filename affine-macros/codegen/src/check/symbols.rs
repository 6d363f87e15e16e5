//! Names in expressions.

use std::collections::HashSet;

use proc_macro2::Ident;
use quote::ToTokens;

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::spec::{Expression, ExpressionKind, SYMBOLS, Spec, Symbol, nearest};

/// A field named as a symbol would make every expression with that name ambiguous to its reader, whichever of
/// the two it meant. This holds for fields of all types.
pub(super) fn hidden(spec: &Spec, found: &mut Diagnostics) {
    for field in &spec.item.fields {
        if let Some((name, meaning)) = SYMBOLS.iter().find(|(name, _)| field.ident == name) {
            found.report(field.span, Diagnostic::HiddenSymbol { name, meaning });
        }
    }
}

/// Every name is `n` or a field of type `f64`: coefficients are real numbers. A name is reported once, where
/// it stands first.
pub(super) fn resolved(spec: &Spec, found: &mut Diagnostics) {
    let mut seen = HashSet::new();
    for expression in spec.kinetic.iter().flat_map(|term| term.value.expressions()) {
        visit(expression, &mut |name| {
            if let Some(mistake) = unresolved(spec, name)
                && seen.insert(name.to_string())
            {
                found.report(name.span(), mistake);
            }
        });
    }
}

fn unresolved(spec: &Spec, name: &Ident) -> Option<Diagnostic> {
    match spec.resolve(name) {
        Some(Symbol::Dimension) => None,
        Some(Symbol::Field(field)) if field.is_real() => None,
        Some(Symbol::Field(field)) => {
            let ty = field.ty.to_token_stream().to_string();
            Some(Diagnostic::FieldType { field: name.to_string(), ty })
        }
        None => {
            let reals = spec.item.fields.iter().filter(|field| field.is_real());
            let scope: Vec<String> = reals
                .map(|field| field.ident.to_string())
                .chain(SYMBOLS.iter().map(|(name, _)| (*name).to_owned()))
                .collect();
            let name = name.to_string();
            let nearest = nearest(&name, scope.iter().map(String::as_str)).map(str::to_owned);
            Some(Diagnostic::UnknownSymbol { name, nearest, scope })
        }
    }
}

/// Does the expression depend on a field?
pub(super) fn has_field(spec: &Spec, expression: &Expression) -> bool {
    let mut has = false;
    visit(expression, &mut |name| has |= matches!(spec.resolve(name), Some(Symbol::Field(_))));
    has
}

fn visit(expression: &Expression, found: &mut impl FnMut(&Ident)) {
    if let ExpressionKind::Symbol(name) = &expression.kind {
        found(name);
    }
    for operand in expression.operands() {
        visit(operand, found);
    }
}

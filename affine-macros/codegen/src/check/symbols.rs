//! Names in expressions.

use std::collections::HashSet;

use proc_macro2::Ident;
use quote::ToTokens;

use crate::diagnostics::{Diagnostics, ExpressionMistake};
use crate::spec::{
    Expression, ExpressionKind, POTENTIAL_SYMBOLS, SYMBOLS, Spec, Symbol, application, nearest, textbook,
};

/// A field named as a symbol would make every expression with that name ambiguous to its reader, whichever of
/// the two it meant. This holds for fields of all types; the symbols of potentials count where there is one.
pub(super) fn hidden(spec: &Spec, found: &mut Diagnostics) {
    for field in &spec.item.fields {
        let named = |symbols: &'static [(&'static str, &'static str)]| {
            symbols.iter().find(|(name, _)| field.ident == name)
        };
        let everywhere = named(&SYMBOLS).map(|symbol| (symbol, "in every expression"));
        let potential = || named(&POTENTIAL_SYMBOLS).map(|symbol| (symbol, "in a potential"));
        let hidden = everywhere.or_else(|| spec.potential.as_ref().and_then(|_| potential()));
        if let Some((&(name, meaning), place)) = hidden {
            found.report(field.span, ExpressionMistake::HiddenSymbol { name, meaning, place });
        }
    }
}

/// Every name in a coefficient is `n` or a field of type `f64`: coefficients are real numbers. In a potential
/// the state and the time have names too. A name is reported once, where it stands first.
pub(super) fn resolved(spec: &Spec, found: &mut Diagnostics) {
    let mut seen = HashSet::new();
    let mut report = |name: &Ident, mistake: Option<ExpressionMistake>| {
        if let Some(mistake) = mistake
            && seen.insert(name.to_string())
        {
            found.report(name.span(), mistake);
        }
    };
    for name in spec.coefficients().flat_map(names) {
        report(name, unresolved(spec, name, spec.resolve(name), &[]));
    }
    let Some(potential) = &spec.potential else { return };
    // The symbols that stand by themselves.
    let dimension = spec.dim.value;
    let numbered = [["I1", "I2", "I3"], ["q1", "q2", "q3"], ["Q1", "Q2", "Q3"]];
    let numbered = numbered.iter().flat_map(|names| names.iter().copied().take(dimension));
    let standing: Vec<&str> = ["q", "D", "det", "t"].into_iter().chain(numbered).collect();
    for name in names(&potential.energy) {
        report(name, unresolved(spec, name, spec.resolve_in_potential(name), &standing));
    }
}

fn unresolved(
    spec: &Spec,
    name: &Ident,
    meaning: Option<Symbol<'_>>,
    more: &[&str],
) -> Option<ExpressionMistake> {
    match meaning {
        Some(Symbol::Field(field)) if !field.is_real() => {
            let (ty, is_matrix) = (as_written(&field.ty), field.matrix().is_some());
            Some(ExpressionMistake::FieldType { field: name.to_string(), ty, is_matrix })
        }
        Some(_) => None,
        None => {
            let reals = spec.item.fields.iter().filter(|field| field.is_real());
            let scope: Vec<String> = reals
                .map(|field| field.ident.to_string())
                .chain(SYMBOLS.iter().map(|(name, _)| (*name).to_owned()))
                .chain(more.iter().map(|name| (*name).to_owned()))
                .collect();
            let in_potential = !more.is_empty();
            if let Some(&(name, meaning)) = POTENTIAL_SYMBOLS.iter().find(|(symbol, _)| name == symbol)
                && !in_potential
            {
                return Some(ExpressionMistake::NotConstant { name, meaning });
            }
            let name = name.to_string();
            let nearest = application(&name)
                .filter(|_| in_potential)
                .or_else(|| nearest(&name, scope.iter().map(String::as_str)).map(str::to_owned));
            let familiar = textbook::quantity(&name).filter(|_| in_potential);
            Some(ExpressionMistake::UnknownSymbol { name, nearest, familiar, scope })
        }
    }
}

/// The names in an expression, from left to right.
pub(super) fn names(expression: &Expression) -> Vec<&Ident> {
    match &expression.kind {
        ExpressionKind::Symbol(name) => vec![name],
        _ => expression.operands().into_iter().flat_map(names).collect(),
    }
}

/// A type without the spaces that tokens are printed with.
fn as_written(ty: &syn::Type) -> String {
    let spaced = ty.to_token_stream().to_string();
    [(" :: ", "::"), (":: ", "::"), (" < ", "<"), (" >", ">"), (" ;", ";"), (" ,", ",")]
        .into_iter()
        .fold(spaced, |text, (spaced, tight)| text.replace(spaced, tight))
}

//! Calls of runtime functions in emitted code: `let (results) = rt::function(arguments);`

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};

use super::pattern::{named, together};
use super::scope::Scope;
use crate::algebra::kernel::{Asked, Callee, Group};
use crate::symbol::Symbol;

/// The statement of a call. One group of results is bound by itself, several as a tuple. Fields of a model with metrics
/// are told what they are asked in the user's bases, by the change `change` to orthonormal ones. A call of a field stands
/// where the specification names it.
pub(super) fn statement(
    Scope { rt, rebased, places, .. }: &Scope,
    callee: Callee,
    mut arguments: Vec<TokenStream>,
    results: impl Iterator<Item = TokenStream>,
) -> TokenStream {
    let function = match callee {
        Callee::Stretches => quote!(#rt::principal_stretches),
        Callee::LogStretches => quote!(#rt::principal_log_stretches),
        Callee::Elongation => quote!(#rt::elongation),
        Callee::Turn => quote!(#rt::turning),
        Callee::Fading => quote!(#rt::fading),
        Callee::Ellipsoidal => quote!(#rt::ellipsoidal),
        Callee::EllipsoidalSlopes => quote!(#rt::ellipsoidal_slopes),
        Callee::Custom(k, asked) => {
            let field = format_ident!("custom_{k}");
            // A force is told of a motion as a whole.
            if matches!(asked, Asked::Force(..)) {
                arguments = vec![quote!((#(#arguments),*))];
            }
            arguments.insert(0, quote!(#field));
            let suffix = if *rebased { "_in" } else { "" };
            let at = k.checked_sub(1).and_then(|k| places.get(k).copied()).unwrap_or_else(Span::call_site);
            let rt = Ident::new(&rt.to_string(), at);
            if *rebased {
                arguments.insert(1, quote!(change));
            }
            match asked {
                Asked::Force(name, gyroscopic) => {
                    let function = format_ident!("{name}{suffix}", span = at);
                    quote_spanned!(at=> #rt::#function::<_, #gyroscopic, _, _>)
                }
                Asked::Energy(class, moves) => {
                    let class = Literal::u8_unsuffixed(class);
                    let function = format_ident!("potential_energy{suffix}", span = at);
                    quote_spanned!(at=> #rt::#function::<_, #class, #moves, _, _>)
                }
                Asked::Slopes(class, moves) => {
                    let class = Literal::u8_unsuffixed(class);
                    let function = format_ident!("potential_slopes{suffix}", span = at);
                    quote_spanned!(at=> #rt::#function::<_, #class, #moves, _, _>)
                }
            }
        }
    };
    let results = together(&results.collect::<Vec<_>>());
    quote!(let #results = #function(#(#arguments),*);)
}

/// A group as an expression or as a pattern.
pub(super) fn written<E>(group: &Group<E>, entry: impl Fn(&E) -> TokenStream) -> TokenStream {
    match group {
        Group::Scalar(one) => entry(one),
        Group::Vector(list) => {
            let entries = list.iter().map(entry);
            quote!([#(#entries),*])
        }
        Group::Matrix(rows) => {
            let rows = rows.iter().map(|row| {
                let entries = row.iter().map(&entry);
                quote!([#(#entries),*])
            });
            quote!([#(#rows),*])
        }
    }
}

/// The pattern of a group of results; what nothing reads is not bound.
pub(super) fn bound(group: &Group<Symbol>, read: &[&Symbol]) -> TokenStream {
    let is_read = |symbol: &Symbol| read.contains(&symbol);
    if !group.entries().into_iter().any(is_read) {
        return quote!(_);
    }
    written(group, |symbol| if is_read(symbol) { named(symbol) } else { quote!(_) })
}

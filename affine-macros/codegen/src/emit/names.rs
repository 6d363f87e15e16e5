//! Every name that emitted code introduces, chosen against the user's own.

use std::fmt::Debug;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::spec::Spec;

/// Names of one expansion.
pub(super) struct Names {
    /// The user's type.
    pub model: Ident,
    /// The type that implements the model traits: the user's own, or what `prepare()` returns.
    pub prepared: Ident,
    /// Constants of a trajectory.
    pub constants: Ident,
    /// The runtime's support module.
    pub rt: Ident,
    /// The scalar type parameter.
    pub scalar: Ident,
}

impl Names {
    pub(super) fn new(spec: &Spec, has_fields: bool) -> Self {
        let model = spec.item.ident.clone();
        let prepared = if has_fields { format_ident!("Prepared{}", model) } else { model.clone() };
        let taken = |name: &str| {
            model == name
                || spec.item.generics.params.iter().any(|p| match p {
                    syn::GenericParam::Type(t) => t.ident == name,
                    syn::GenericParam::Const(c) => c.ident == name,
                    syn::GenericParam::Lifetime(_) => false,
                })
        };
        let free = |wanted: &str| {
            let mut name = wanted.to_owned();
            while taken(&name) {
                name.push('_');
            }
            format_ident!("{name}")
        };
        Self {
            constants: format_ident!("{}Constants", model),
            rt: free("rt"),
            scalar: free("T"),
            model,
            prepared,
        }
    }
}

/// The path of the runtime.
pub(super) fn runtime(renamed: Option<&syn::Path>) -> TokenStream {
    match renamed {
        Some(path) => quote!(#path),
        None => quote!(::affine_runtime),
    }
}

/// The variant of the runtime that is called as one here.
pub(super) fn variant(of: impl Debug) -> Ident {
    format_ident!("{}", format!("{of:?}"))
}

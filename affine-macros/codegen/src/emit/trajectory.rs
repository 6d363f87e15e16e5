//! What is constant along one trajectory in emitted code, and its coefficients: the constants as far as the reduced equations
//! read them.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::passage::Extent;
use crate::symbol::Symbol;

use super::context::Context;
use super::number::number;
use super::passage::{value, variable};
use super::pattern::{pattern, reads};

/// A constant of a trajectory: a field of its struct.
pub(super) struct Kept {
    pub(super) name: Ident,
    pub(super) extent: Extent,
    doc: String,
    /// What it is at the start, unless a variable of its name is.
    start: Option<TokenStream>,
}

impl Kept {
    /// The field of the struct.
    pub(super) fn field(&self, context: &Context) -> TokenStream {
        let (rt, t, n) = (&context.names.rt, &context.names.scalar, context.dim());
        let (name, doc) = (&self.name, &self.doc);
        let of = match self.extent {
            Extent::Number => quote!(#t),
            Extent::Vector => quote!(#rt::Vector<#n, #t>),
            Extent::Matrix => quote!(#rt::Matrix<#n, #t>),
            Extent::List(size) => {
                let size = number(size);
                quote!([#t; #size])
            }
            Extent::Dilatation => quote!(#rt::Breathing<#t>),
        };
        quote!(#[doc = #doc] pub #name: #of,)
    }

    /// The field of the value that a trajectory starts with.
    fn at_the_start(&self) -> TokenStream {
        let name = &self.name;
        match &self.start {
            Some(value) => quote!(#name: #value),
            None => quote!(#name),
        }
    }
}

/// The constants of a trajectory that starts at `point` and has these coefficients.
pub(super) fn kept(context: &Context, coefficients: &[TokenStream]) -> Vec<Kept> {
    let constants = context.model.dynamics.passage.constants.iter().map(|constant| Kept {
        name: variable(constant.name),
        extent: constant.extent,
        doc: format!(" {}", constant.meaning),
        start: constant.start.as_ref().map(|start| value(context, start)),
    });
    let count = all(context).len();
    let coefficients = (count > 0).then(|| Kept {
        name: format_ident!("coefficients"),
        extent: Extent::List(count),
        doc: " Coefficients of the reduced equations.".to_owned(),
        start: Some(quote!([#(#coefficients),*])),
    });
    constants.chain(coefficients).collect()
}

/// The constants of a trajectory over a scalar as a type: nothing where a trajectory has none.
pub(super) fn constants(context: &Context, scalar: &Ident) -> TokenStream {
    let name = &context.names.constants;
    if kept(context, &[]).is_empty() { quote!(()) } else { quote!(#name<#scalar>) }
}

/// Those of the trajectory that starts at `point` and has these coefficients.
pub(super) fn at_the_start(context: &Context, coefficients: &[TokenStream]) -> TokenStream {
    let name = &context.names.constants;
    let fields: Vec<TokenStream> = kept(context, coefficients).iter().map(Kept::at_the_start).collect();
    if fields.is_empty() { quote!(()) } else { quote!(#name { #(#fields),* }) }
}

/// The coefficients of a trajectory: `k_1`, `k_2`, ..
pub(super) fn all(context: &Context) -> Vec<Symbol> {
    context.model.dynamics.trajectory.results().cloned().collect()
}

/// The statement that binds those of some inputs, and the name of the parameter that it takes them from.
pub(super) fn coefficients(context: &Context, used: &[Symbol]) -> (TokenStream, TokenStream) {
    let names = all(context);
    if !reads(used, &names) {
        return (TokenStream::new(), quote!(_constants));
    }
    let bound = pattern(&names, used);
    (quote!(let #bound = constants.coefficients;), quote!(constants))
}

//! `prepare()`: from values of the fields to a checked model with its coefficients.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::derive::{Condition, NumericBlock, Relation};
use crate::lower::FIELD;

use super::body::{Body, Number, Scope, body};
use super::{Context, number};
use crate::ir::Program;

/// What `prepare()` returns; nothing for a model without fields in its coefficients.
pub(super) fn prepared_type(context: &Context) -> TokenStream {
    if !context.has_fields {
        return TokenStream::new();
    }
    let (model, prepared) = (&context.names.model, &context.names.prepared);
    let visibility = &context.spec.item.visibility;
    let count = number(context.model.coefficients.outputs.len());
    let summary = format!(" [`{model}`] with values of its fields that make it well posed.");
    quote! {
        #[doc = #summary]
        ///
        /// Made by `prepare()`; holds the coefficients that the equations need, computed once.
        #[derive(
            ::core::clone::Clone,
            ::core::marker::Copy,
            ::core::fmt::Debug,
            ::core::cmp::PartialEq,
        )]
        #visibility struct #prepared {
            coefficients: [::core::primitive::f64; #count],
        }
    }
}

/// The method that makes it.
pub(super) fn method(context: &Context) -> TokenStream {
    if !context.has_fields {
        return TokenStream::new();
    }
    let (model, prepared, rt) = (&context.names.model, &context.names.prepared, &context.names.rt);
    let visibility = &context.spec.item.visibility;
    let (generics, types, clause) = context.spec.item.generics.split_for_impl();
    let conditions = conditions(context, rt);
    let blocks: TokenStream =
        context.model.numeric_blocks.iter().map(|block| numeric_block(block, rt)).collect();
    let Body { lets, results } = over_fields(rt, &context.model.coefficients);
    quote! {
        impl #generics #model #types #clause {
            /// Checks the values of the fields and computes the coefficients of the equations.
            ///
            /// # Errors
            /// `IllPosed` with the condition, its value and its threshold, where the Legendre transformation
            /// is degenerate to rounding, a required sign is missing, or a coefficient overflows.
            #visibility fn prepare(&self) -> #rt::Result<#prepared> {
                #conditions
                #blocks
                #lets
                let coefficients = #rt::finite([#(#results),*])?;
                ::core::result::Result::Ok(#prepared { coefficients })
            }
        }
    }
}

/// A program over the fields, and over inverse blocks computed before.
fn over_fields(rt: &Ident, program: &Program) -> Body {
    let input = |name: &str| match name.strip_prefix(FIELD) {
        Some(field) => {
            let field = format_ident!("{field}");
            quote!(self.#field)
        }
        None => {
            let name = format_ident!("{name}");
            quote!(#name)
        }
    };
    body(program, &Scope { number: Number::Double, input: &input, rt })
}

/// Eigenvalues share one threshold, a mass has its own.
fn conditions(context: &Context, rt: &Ident) -> TokenStream {
    let is_mass = |c: &&Condition| matches!(c.name, "m" | "1/m");
    let list = |conditions: Vec<&Condition>| {
        if conditions.is_empty() {
            return TokenStream::new();
        }
        let entries = conditions.iter().map(|c| condition(c, rt));
        quote!(#rt::well_posed(&[#(#entries),*])?;)
    };
    let eigenvalues = list(context.model.conditions.iter().filter(|c| !is_mass(c)).collect());
    let masses = list(context.model.conditions.iter().filter(is_mass).collect());
    quote!(#eigenvalues #masses)
}

fn condition(condition: &Condition, rt: &Ident) -> TokenStream {
    let positive = condition.positive;
    let text = format!("{} {} 0", condition.name, if positive { ">" } else { "!=" });
    let (given, sought) = match condition.relation {
        Relation::MomentumOfVelocity => ("velocity", "momentum"),
        Relation::VelocityOfMomentum => ("momentum", "velocity"),
    };
    let remedy = if positive {
        "choose fields that make it positive".to_owned()
    } else {
        format!("choose fields that keep it away from zero, or the {sought} does not determine the {given}")
    };
    let reason =
        format!("on {} the {sought} is {} times the {given}; {remedy}", condition.directions, condition.name);
    let Body { lets, results } = over_fields(rt, &condition.program);
    let (value, sizes) = results.split_first().map_or((quote!(0.0), &[][..]), |(v, s)| (v.clone(), s));
    quote! {
        {
            #lets
            #rt::Condition {
                condition: #text,
                reason: #reason,
                positive: #positive,
                value: #value,
                size: #rt::total_size([#(#sizes),*]),
            }
        }
    }
}

fn numeric_block(block: &NumericBlock, rt: &Ident) -> TokenStream {
    let Body { lets, results } = over_fields(rt, &block.program);
    let names = block.inverse.iter().map(|name| format_ident!("{name}"));
    let (size, positive) = (number(block.size), block.positive);
    let count = number(block.inverse.len());
    let (entries, terms) = results.split_at(block.inverse.len());
    quote! {
        let [#(#names),*]: [::core::primitive::f64; #count] = {
            #lets
            #rt::inverse_form::<#size, #count>([#(#entries),*], #rt::total_size([#(#terms),*]), #positive)?
        };
    }
}

//! `prepare()`: from values of the fields to a checked model with its coefficients.

mod conditions;
mod values;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote, quote_spanned};

use crate::derive::{ChangeOfBases, Step};
use crate::spec::Field;

use super::body::Body;
use super::context::Context;
use super::fields::{number_name, over_fields};
use super::metrics;
use super::number::number;
use conditions::{inverse, principal, semidefinite, semidefinite_form, well_posed};
use values::{finite_fields, matrices, numbers, of_fields, size, values};

/// What `prepare()` returns; nothing for a model without fields in its coefficients.
pub(super) fn prepared_type(context: &Context) -> TokenStream {
    if !context.has_fields {
        return TokenStream::new();
    }
    let (model, prepared) = (&context.names.model, &context.names.prepared);
    let visibility = &context.spec.item.visibility;
    let count = number(context.coefficients());
    let summary = format!(" [`{model}`] with values of its fields that make it well posed.");
    if !context.spec.customs.is_empty() {
        let generics = &context.spec.item.generics;
        let (parameters, types, clause) = generics.split_for_impl();
        let fields = called(context).map(|(name, field)| {
            let ty = &field.ty;
            quote!(#name: #ty,)
        });
        // A lifetime keeps the compiler from judging the bounds of types that have none of these.
        let given = clause.iter().flat_map(|clause| &clause.predicates);
        let copied = called(context).map(|(_, field)| {
            let ty = &field.ty;
            quote!(for<'never> #ty: ::core::marker::Copy,)
        });
        return quote! {
            #[doc = #summary]
            ///
            /// Made by `prepare()`; holds the coefficients that the equations need, computed once, and the fields
            /// that they call.
            #[derive(::core::clone::Clone)]
            #visibility struct #prepared #generics #clause {
                coefficients: [::core::primitive::f64; #count],
                #(#fields)*
                model: ::core::marker::PhantomData<fn() -> #model #types>,
            }
            /// Where the fields that it holds can be copied.
            impl #parameters ::core::marker::Copy for #prepared #types
            where
                #(#given,)*
                for<'never> Self: ::core::clone::Clone,
                #(#copied)*
            {
            }
        };
    }
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

/// The fields that the equations call: the name in the prepared model, and the field.
fn called<'a>(context: &'a Context) -> impl Iterator<Item = (Ident, &'a Field)> {
    context.spec.customs.iter().enumerate().filter_map(|(k, custom)| {
        let field = context.spec.item.fields.iter().find(|field| field.ident == custom.field)?;
        // The compiler says there what the type lacks.
        Some((format_ident!("custom_{}", k + 1, span = field.ident.span()), field))
    })
}

/// `prepare()`, and the coefficients as a function of the fields.
pub(super) fn method(context: &Context) -> TokenStream {
    if !context.has_fields {
        return as_it_is(context);
    }
    let (prepared, rt, n) = (&context.names.prepared, &context.names.rt, context.dim());
    let (model, visibility) = (&context.names.model, &context.spec.item.visibility);
    let (generics, types, clause) = context.spec.item.generics.split_for_impl();
    let clones = called(context).map(|(name, field)| {
        let field = &field.ident;
        let clone = quote_spanned!(field.span()=> ::core::clone::Clone::clone(&self.#field));
        quote!(, #name: #clone)
    });
    let marker = (!context.spec.customs.is_empty()).then(|| quote!(, model: ::core::marker::PhantomData));
    let of = (!context.spec.customs.is_empty()).then(|| quote!(#types));
    let function = coefficients(context);
    // Nothing but the lattice is emitted of a model on U(n), which has no phase points.
    let (values, fields) = match context.spec.group {
        Some(_) => (values(context), None),
        None => (quote!(#rt::Fields::<#n>::values(self)), Some(of_fields(context))),
    };
    quote! {
        impl #generics #model #types #clause {
            /// Checks the values of the fields and computes the coefficients of the equations.
            ///
            /// # Errors
            /// `FieldNotFinite` with the field; `IllPosed` with the condition, its value and its threshold, where the
            /// Legendre transformation is degenerate to rounding, a required sign is missing, or a coefficient overflows.
            #visibility fn prepare(&self) -> #rt::Result<#prepared #of> {
                let coefficients = coefficients_of(&#values)?;
                ::core::result::Result::Ok(#prepared { coefficients #(#clones)* #marker })
            }
        }
        #fields
        #function
    }
}

/// The coefficients of the equations as a function of the values of the fields.
fn coefficients(context: &Context) -> TokenStream {
    let (names, rt, t) = (context.names, &context.names.rt, &context.names.scalar);
    let (fields, count) = (number(size(context)), number(context.coefficients()));
    let read = numbers(context);
    let bound: Vec<Ident> = read.iter().map(|field| number_name(&field.ident)).collect();
    let rest = context.spec.matrix_fields().next().is_some().then(|| quote!(, ..));
    let bound = (!bound.is_empty()).then(|| quote!(let [#(#bound),* #rest] = *values;));
    let (finite, matrices) = (finite_fields(context), matrices(context));
    let steps: TokenStream = context.model.prepared.steps.iter().map(|one| step(context, one)).collect();
    let Body { lets, results } = over_fields(names, &context.model.prepared.coefficients);
    let all = match context.model.metrics {
        Some(ChangeOfBases::Prepared) => quote! {
            let coefficients = #rt::finite([#(#results),*])?;
            ::core::result::Result::Ok(#rt::beside_bases(coefficients, &bases))
        },
        _ => quote!(#rt::finite([#(#results),*])),
    };
    quote! {
        /// The coefficients of the equations, from values of the fields.
        fn coefficients_of<#t: #rt::Real>(values: &[#t; #fields]) -> #rt::Result<[#t; #count]> {
            #bound
            #finite
            #matrices
            #steps
            #lets
            #all
        }
    }
}

fn step(context: &Context, step: &Step) -> TokenStream {
    match step {
        Step::Bases(entries) => metrics::found(context, entries),
        Step::Rebased(matrix) => metrics::rebased(context, matrix),
        Step::WellPosed(conditions) => well_posed(context.names, conditions),
        Step::Inverse(block) => inverse(context, block),
        Step::PrincipalAxes(form) => principal(context.names, form),
        Step::Semidefinite(conditions) => semidefinite(context.names, conditions),
        Step::SemidefiniteForm(block) => semidefinite_form(context.names, block),
    }
}

/// The method of a model that is prepared as it stands.
fn as_it_is(context: &Context) -> TokenStream {
    let (model, rt) = (&context.names.model, &context.names.rt);
    let visibility = &context.spec.item.visibility;
    let (generics, types, clause) = context.spec.item.generics.split_for_impl();
    quote! {
        impl #generics #model #types #clause {
            /// The model itself, for programs that prepare whatever model they are given: no field decides anything.
            ///
            /// # Errors
            /// None.
            #[allow(dead_code)]
            #visibility fn prepare(self) -> #rt::Result<Self> {
                ::core::result::Result::Ok(self)
            }
        }
    }
}

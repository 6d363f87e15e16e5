//! `prepare()`: from values of the fields to a checked model with its coefficients.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::derive::splitting::PrincipalProgram;
use crate::derive::{Condition, Damping, Factor, NumericBlock, Relation, Written};
use crate::spec::{Field, Storage};
use crate::symbol::Symbol;

use super::body::Body;
use super::context::Context;
use super::fields::{bare, matrix_name, over_fields};
use super::metrics;
use super::number::{double, number};
use super::pattern::{ident, identifiers, table};

/// What `prepare()` returns; nothing for a model without fields in its coefficients.
pub(super) fn prepared_type(context: &Context) -> TokenStream {
    if !context.has_fields {
        return TokenStream::new();
    }
    let (model, prepared) = (&context.names.model, &context.names.prepared);
    let visibility = &context.spec.item.visibility;
    let count = number(context.model.coefficients.outputs.len());
    let (bases, _) = metrics::prepared(context);
    let summary = format!(" [`{model}`] with values of its fields that make it well posed.");
    if !context.spec.customs.is_empty() {
        let generics = &context.spec.item.generics;
        let (_, types, clause) = generics.split_for_impl();
        let fields = called(context).map(|(name, field)| {
            let ty = &field.ty;
            quote!(#name: #ty,)
        });
        return quote! {
            #[doc = #summary]
            ///
            /// Made by `prepare()`; holds the coefficients that the equations need, computed once, and the fields
            /// that they call.
            #[derive(::core::clone::Clone)]
            #visibility struct #prepared #generics #clause {
                coefficients: [::core::primitive::f64; #count],
                #bases
                #(#fields)*
                model: ::core::marker::PhantomData<fn() -> #model #types>,
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
            #bases
        }
    }
}

/// The fields that the equations call: the name in the prepared model, and the field.
fn called<'a>(context: &'a Context) -> impl Iterator<Item = (Ident, &'a Field)> {
    context.spec.customs.iter().enumerate().filter_map(|(k, custom)| {
        let field = context.spec.item.fields.iter().find(|field| field.ident == custom.field)?;
        Some((format_ident!("custom_{}", k + 1), field))
    })
}

/// `prepare()`.
pub(super) fn method(context: &Context) -> TokenStream {
    if !context.has_fields {
        return as_it_is(context);
    }
    let (model, prepared, rt) = (&context.names.model, &context.names.prepared, &context.names.rt);
    let visibility = &context.spec.item.visibility;
    let (generics, types, clause) = context.spec.item.generics.split_for_impl();
    let matrices = matrices(context, rt);
    let conditions = conditions(context, rt);
    let (_, bases) = metrics::prepared(context);
    let rebased = metrics::rebased(context);
    let clones = called(context).map(|(name, field)| {
        let field = &field.ident;
        quote!(, #name: ::core::clone::Clone::clone(&self.#field))
    });
    let named_bases = (!bases.is_empty()).then(|| quote!(, bases));
    let marker = (!context.spec.customs.is_empty()).then(|| quote!(, model: ::core::marker::PhantomData));
    let fields: Vec<TokenStream> = named_bases.into_iter().chain(clones).chain(marker).collect();
    let of = (!context.spec.customs.is_empty()).then(|| quote!(#types));
    let blocks: TokenStream =
        context.model.numeric_blocks.iter().map(|block| numeric_block(context, block, rt)).collect();
    let axes = context.model.splitting.iter().flat_map(|split| &split.principal);
    let axes: TokenStream = axes.map(|form| principal(rt, form)).collect();
    let damping = damping(&context.model.damping, rt);
    // What is carried to orthonormal bases is looked at in them.
    let (first, last) = if rebased.is_empty() { (None, Some(&bases)) } else { (Some(&bases), None) };
    let Body { lets, results } = over_fields(rt, &context.model.coefficients);
    let finite = finite_fields(context, rt);
    quote! {
        impl #generics #model #types #clause {
            /// Checks the values of the fields and computes the coefficients of the equations.
            ///
            /// # Errors
            /// `FieldNotFinite` with the field; `IllPosed` with the condition, its value and its threshold, where the
            /// Legendre transformation is degenerate to rounding, a required sign is missing, or a coefficient overflows.
            #visibility fn prepare(&self) -> #rt::Result<#prepared #of> {
                #finite
                #matrices
                #first
                #rebased
                #conditions
                #blocks
                #axes
                #damping
                #last
                #lets
                let coefficients = #rt::finite([#(#results),*])?;
                ::core::result::Result::Ok(#prepared { coefficients #(#fields)* })
            }
        }
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

/// The fields that are numbers and that the model reads, each with its name, are finite.
fn finite_fields(context: &Context, rt: &Ident) -> TokenStream {
    let read = context.model.symbols();
    let fields = context.spec.item.fields.iter().map(|field| &field.ident);
    let named = fields.filter(|field| read.contains(&&Symbol::Field(field.to_string()))).map(|field| {
        let name = bare(field);
        quote!((#name, self.#field))
    });
    let named: Vec<TokenStream> = named.collect();
    if named.is_empty() {
        return TokenStream::new();
    }
    quote!(#rt::finite_fields(&[#(#named),*])?;)
}

/// The symmetric parts of the fields of matrix type.
fn matrices(context: &Context, rt: &Ident) -> TokenStream {
    let matrices = context.spec.matrix_fields().map(|(field, size, storage)| {
        let (field, local) = (&field.ident, matrix_name(&field.ident));
        let rows = match storage {
            Storage::Rows => quote!(self.#field),
            Storage::Matrix => quote! {
                ::core::array::from_fn(|a| ::core::array::from_fn(|b| self.#field[(a, b)]))
            },
        };
        let name = bare(field);
        let condition = format!("{name} = {name}^T");
        let reason = format!(
            "the value is the largest difference of two entries of `{name}` whose places are exchanged, and its \
             symmetric part alone has a meaning; give a symmetric matrix"
        );
        let size = number(size);
        quote!(let #local = #rt::symmetric_part::<#size>(#name, #rows, #condition, #reason)?;)
    });
    matrices.collect()
}

/// Eigenvalues share one threshold, a mass has its own.
fn conditions(context: &Context, rt: &Ident) -> TokenStream {
    let is_mass = |c: &&Condition| matches!(c.factor, Factor::Mass(_));
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
    let text = format!("{} {} 0", condition.factor.name(), if positive { ">" } else { "!=" });
    let (given, sought) = match condition.relation {
        Relation::MomentumOfVelocity => ("velocity", "momentum"),
        Relation::VelocityOfMomentum => ("momentum", "velocity"),
    };
    let remedy = if positive {
        "choose fields that make it positive".to_owned()
    } else {
        format!("choose fields that keep it away from zero, or the {sought} does not determine the {given}")
    };
    let reason = format!(
        "on {} the {sought} is {} times the {given}; {remedy}",
        condition.directions,
        condition.factor.name()
    );
    held(condition, &text, &reason, rt)
}

/// What the dissipation must not be: negative.
fn damping(damping: &Damping, rt: &Ident) -> TokenStream {
    let entries: Vec<TokenStream> = damping
        .conditions
        .iter()
        .map(|condition| {
            let text = format!("{} >= 0", condition.factor.name());
            let reason = format!(
                "on {} the dissipation function R is half of {} times the square of the velocity; where R < 0 its \
                 forces would feed energy in",
                condition.directions, condition.factor.name(),
            );
            held(condition, &text, &reason, rt)
        })
        .collect();
    let conditions = (!entries.is_empty()).then(|| quote!(#rt::semidefinite(&[#(#entries),*])?;));
    let blocks = damping.blocks.iter().map(|block| {
        let Body { lets, results } = over_fields(rt, &block.program);
        let (size, count) = (block.size, block.size * (block.size + 1) / 2);
        let (entries, terms) = results.split_at(count);
        let (size, count) = (number(size), number(count));
        quote! {
            {
                #lets
                #rt::semidefinite_form::<#size, #count>([#(#entries),*], #rt::total_size([#(#terms),*]))?;
            }
        }
    });
    quote!(#conditions #(#blocks)*)
}

/// A condition with the program of its value and of the sizes that rounding errors are measured by.
fn held(condition: &Condition, text: &str, reason: &str, rt: &Ident) -> TokenStream {
    let positive = condition.positive;
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

fn numeric_block(context: &Context, block: &NumericBlock, rt: &Ident) -> TokenStream {
    let Body { lets, results } = over_fields(rt, &block.program);
    let names = block.inverse.iter().map(ident);
    let (dim, size, positive) = (context.dim(), number(block.size), block.positive);
    let count = number(block.inverse.len());
    let (entries, terms) = results.split_at(block.inverse.len());
    let basis = block.basis.iter().map(|vector| {
        let entries = vector.iter().map(|(place, weight)| {
            let (place, weight) = (number(*place), double(weight.to_doubles().0));
            quote!((#place, #weight))
        });
        quote!(&[#(#entries),*])
    });
    let inverse = quote! {
        #rt::inverse_form::<#dim, #size, #count>(
            [#(#entries),*],
            #rt::total_size([#(#terms),*]),
            #positive,
            [#(#basis),*],
        )
    };
    let inverse = metrics::told_in_given_bases(context, inverse);
    quote! {
        let [#(#names),*]: [::core::primitive::f64; #count] = {
            #lets
            #inverse?
        };
    }
}

/// Eigenvalues and eigenvectors of a form.
fn principal(rt: &Ident, form: &PrincipalProgram) -> TokenStream {
    let Body { lets, results } = over_fields(rt, &form.program);
    let (size, count) = (number(form.values.len()), number(results.len()));
    let values = identifiers(&form.values);
    let vectors = table(&form.vectors);
    quote! {
        let ([#(#values),*], #vectors) = {
            #lets
            #rt::principal_axes::<#size, #count>([#(#results),*])
        };
    }
}

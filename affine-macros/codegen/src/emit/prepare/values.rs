//! The values of the fields: numbers, then the entries of matrices.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::derive::Written;
use crate::emit::context::Context;
use crate::emit::fields::{bare, matrix_name, number_name};
use crate::emit::number::number;
use crate::spec::{Field, Storage};
use crate::symbol::Symbol;

/// What the coefficients are computed from, for programs that give other values to it.
pub(super) fn of_fields(context: &Context) -> TokenStream {
    let (model, prepared, rt) = (&context.names.model, &context.names.prepared, &context.names.rt);
    let (generics, types, clause) = context.spec.item.generics.split_for_impl();
    let of = (!context.spec.customs.is_empty()).then(|| quote!(#types));
    let (t, n, size) = (&context.names.scalar, context.dim(), number(size(context)));
    let count = number(context.coefficients());
    let field = |field: &Field, rows: usize| {
        let (name, rows) = (bare(&field.ident), number(rows));
        quote!(#rt::Field { name: #name, rows: #rows })
    };
    let listed = numbers(context).into_iter().map(|number| field(number, 1));
    let listed = listed.chain(context.spec.matrix_fields().map(|(matrix, size, _)| field(matrix, size)));
    let values = values(context);
    quote! {
        impl #generics #rt::Fields<#n> for #model #types #clause {
            type Prepared = #prepared #of;
            const FIELDS: &'static [#rt::Field] = &[#(#listed),*];
            type Values<#t: #rt::Scalar> = [#t; #size];

            fn values(&self) -> [#rt::f64; #size] {
                #values
            }

            fn coefficients_of<#t: #rt::Real>(values: &[#t; #size]) -> #rt::Result<[#t; #count]> {
                coefficients_of(values)
            }
        }
    }
}

/// Number of the values of all fields.
pub(super) fn size(context: &Context) -> usize {
    let entries = context.spec.matrix_fields().map(|(_, size, _)| size.pow(2));
    numbers(context).len() + entries.sum::<usize>()
}

/// The fields that are numbers and that the model reads.
pub(super) fn numbers<'a>(context: &Context<'a>) -> Vec<&'a Field> {
    let read = context.model.symbols();
    let is_read = |field: &&Field| read.contains(&&Symbol::Field(field.ident.to_string()));
    context.spec.item.fields.iter().filter(is_read).collect()
}

/// The values of the fields: the numbers, then the entries of matrices.
pub(super) fn values(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let numbers = numbers(context);
    let numbers: Vec<&Ident> = numbers.iter().map(|field| &field.ident).collect();
    let matrices: Vec<TokenStream> = context
        .spec
        .matrix_fields()
        .map(|(Field { ident, .. }, size, storage)| match storage {
            Storage::Rows => quote!(self.#ident.as_flattened()),
            Storage::Matrix => {
                let size = number(size);
                quote!(#rt::table::<_, #size>(|row, column| self.#ident[(row, column)]).as_flattened())
            }
        })
        .collect();
    match matrices.as_slice() {
        [] => quote!([#(self.#numbers),*]),
        _ => quote!(#rt::joined([&[#(self.#numbers),*], #(#matrices),*])),
    }
}

/// The fields that are numbers, each with its name, are finite.
pub(super) fn finite_fields(context: &Context) -> Option<TokenStream> {
    let rt = &context.names.rt;
    let named: Vec<TokenStream> = numbers(context)
        .into_iter()
        .map(|field| {
            let (name, value) = (bare(&field.ident), number_name(&field.ident));
            quote!((#name, #value))
        })
        .collect();
    (!named.is_empty()).then(|| quote!(#rt::finite_fields(&[#(#named),*])?;))
}

/// The symmetric parts of the fields of matrix type.
pub(super) fn matrices(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let mut first = numbers(context).len();
    let matrices = context.spec.matrix_fields().map(|(field, size, _)| {
        let (name, local, place) = (bare(&field.ident), matrix_name(&field.ident), number(first));
        first += size.pow(2);
        let condition = format!("{name} = {name}^T");
        let reason = format!(
            "the value is the largest difference of two entries of `{name}` whose places are exchanged, and its \
             symmetric part alone has a meaning; give a symmetric matrix"
        );
        let size = number(size);
        quote! {
            let #local =
                #rt::symmetric_part::<#size, _>(#name, #rt::square(values, #place), #condition, #reason)?;
        }
    });
    matrices.collect()
}

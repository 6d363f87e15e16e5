//! Changes of bases at the edges: points have the user's coordinates, equations those of orthonormal bases.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::{ChangeOfBases, GivenMatrix, GivenSource, Step};

use super::body::Body;
use super::context::Context;
use super::fields::{matrix_name, over_fields};
use super::number::{exact_table, number};
use super::pattern::in_rows;
use crate::ir::Program;
use crate::symbol::Frame;

/// The bases as a function of the scalar, where they are known, and the methods of the trait that tell of them.
pub(super) fn bases(context: &Context) -> (TokenStream, TokenStream) {
    let (rt, t, n) = (&context.names.rt, &context.names.scalar, context.dim());
    let method = |bases: TokenStream| {
        quote! {
            fn bases(&self) -> ::core::option::Option<#rt::Bases<#n>> {
                ::core::option::Option::Some(#bases)
            }
        }
    };
    let bases = match &context.model.metrics {
        None => return (TokenStream::new(), TokenStream::new()),
        Some(ChangeOfBases::Prepared) => {
            return (TokenStream::new(), method(quote!(#rt::bases_beside(&self.coefficients))));
        }
        Some(ChangeOfBases::Known(bases)) => bases,
    };
    let [a, a_inverse, b, b_inverse] =
        [&bases.space.matrix, &bases.space.inverse, &bases.body.matrix, &bases.body.inverse]
            .map(|rows| exact_table(t, rows));
    // Fields are called over every number that equations are evaluated in.
    let number = if context.spec.customs.is_empty() { quote!(Real) } else { quote!(Scalar) };
    let function = quote! {
        fn bases<#t: #rt::#number>() -> #rt::Bases<#n, #t> {
            #rt::Bases {
                    space: #rt::matrix(#a),
                    space_inverse: #rt::matrix(#a_inverse),
                    body: #rt::matrix(#b),
                    body_inverse: #rt::matrix(#b_inverse),
                }
        }
    };
    let method = method(quote!(bases()));
    // Numbers are known better than as doubles.
    let methods = quote! {
        #method
        fn orthonormal<#t: #rt::Real>(
            &self,
            point: &Self::Point<#t>,
        ) -> <Self::Point<#t> as #rt::Phase<#n, #t>>::InOrthonormal {
            #rt::Phase::in_orthonormal(point, ::core::option::Option::Some(&bases()))
        }
    };
    (function, methods)
}

/// What linters would say of the expansion, where the user cannot mend it: differences in lists seem to lack a comma where the
/// attribute has several lines, and roots of numbers, in bases that are known, may be near to constants.
pub(super) fn lints(context: &Context) -> TokenStream {
    match context.model.metrics {
        Some(ChangeOfBases::Known(_)) => {
            quote!(#[allow(clippy::possible_missing_comma, clippy::approx_constant)])
        }
        _ => quote!(#[allow(clippy::possible_missing_comma)]),
    }
}

/// The statement that finds the bases from the entries of `g` and `eta`.
pub(super) fn found(context: &Context, [space, body]: &[Program; 2]) -> TokenStream {
    let (rt, n) = (&context.names.rt, context.dim());
    let orthonormal = |name: &str, program: &Program| {
        let Body { lets, results } = over_fields(context.names, program);
        let rows = in_rows(&results, context.model.dim);
        let condition = format!("{name} > 0");
        let bases = quote!(#rt::orthonormal::<#n, _>(#rows, #condition)?);
        if lets.is_empty() { bases } else { quote!({ #lets #bases }) }
    };
    let (space, body) = (orthonormal("g", space), orthonormal("eta", body));
    quote!(let bases = #rt::Bases::of_factors(#space, #body);)
}

/// The statement that carries an inertia or a tensor to the bases, which are found before.
pub(super) fn rebased(context: &Context, matrix: &GivenMatrix) -> TokenStream {
    let (rt, n) = (&context.names.rt, context.dim());
    let local = matrix_name(matrix.number);
    let (entries, frame, tensor) = match &matrix.source {
        GivenSource::Form { entries, frame, tensor } => (entries, *frame, *tensor),
        GivenSource::SpaceInverse => return quote!(let #local = #rt::rows(&bases.space_inverse);),
        GivenSource::Body => return quote!(let #local = #rt::rows(&bases.body);),
    };
    let Body { lets, results } = over_fields(context.names, entries);
    let size = if tensor { context.model.dim.pow(2) } else { context.model.dim };
    let entries = in_rows(&results, size);
    let value = match (tensor, frame) {
        (false, Frame::Space) => quote!(#rt::rebased_inertia::<#n, _>(&bases.space, #entries)),
        (false, _) => quote!(#rt::rebased_inertia::<#n, _>(&bases.body, #entries)),
        (true, frame) => {
            let (factors, size) = (factors(frame), number(size));
            quote!(#rt::rebased_tensor::<#n, #size, _>(#factors, #entries))
        }
    };
    quote!(let #local = { #lets #value };)
}

/// `L` and `R` of `O = L O' R`, from an affine velocity in orthonormal bases to one in the user's.
fn factors(frame: Frame) -> TokenStream {
    match frame {
        Frame::Body => quote!(&bases.body_inverse, &bases.body),
        Frame::Space => quote!(&bases.space_inverse, &bases.space),
        Frame::Flat => quote!(&bases.space_inverse, &bases.body),
    }
}

/// A result whose error has a velocity in orthonormal bases that it found before.
pub(super) fn told_in_given_bases(context: &Context, result: TokenStream) -> TokenStream {
    let rt = &context.names.rt;
    let is_carried = |step: &Step| matches!(step, Step::Rebased(_));
    match context.model.prepared.steps.iter().any(is_carried) {
        true => {
            let factors = factors(context.model.frame);
            quote!(#rt::told_in_given_bases(#factors, #result))
        }
        false => result,
    }
}

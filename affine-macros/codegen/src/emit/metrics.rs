//! Changes of bases at the edges: points have the user's coordinates, equations those of orthonormal bases.

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::Rational;
use crate::derive::ChangeOfBases;

use super::body::{Body, exact};
use super::prepare::over_fields;
use super::{Context, runtime};
use crate::ir::Program;

/// The bases as a function of the scalar, where they are known, and the method of the trait that tells of them.
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
        Some(ChangeOfBases::Prepared(_)) => return (TokenStream::new(), method(quote!(self.bases))),
        Some(ChangeOfBases::Known(bases)) => bases,
    };
    let matrix = |rows: &Vec<Vec<Rational>>| {
        let rows = rows.iter().map(|row| {
            let entries = row.iter().map(|entry| exact(t, entry));
            quote!([#(#entries),*])
        });
        quote!(#rt::matrix([#(#rows),*]))
    };
    let [a, a_inverse, b, b_inverse] =
        [&bases.space.matrix, &bases.space.inverse, &bases.body.matrix, &bases.body.inverse].map(matrix);
    let function = quote! {
        #[allow(clippy::approx_constant)]
        fn bases<#t: #rt::Real>() -> #rt::Bases<#n, #t> {
            #rt::Bases { space: #a, space_inverse: #a_inverse, body: #b, body_inverse: #b_inverse }
        }
    };
    (function, method(quote!(bases())))
}

/// The bases in the prepared model, and the statement of `prepare()` that finds them.
pub(super) fn prepared(context: &Context) -> (TokenStream, TokenStream) {
    let Some(ChangeOfBases::Prepared([space, body])) = &context.model.metrics else {
        return (TokenStream::new(), TokenStream::new());
    };
    let (rt, n) = (&context.names.rt, context.dim());
    let orthonormal = |name: &str, program: &Program| {
        let Body { lets, results } = over_fields(rt, program);
        let rows = results.chunks(context.model.dim).map(|row| quote!([#(#row),*]));
        let condition = format!("{name} > 0");
        quote!({ #lets #rt::orthonormal::<#n>([#(#rows),*], #condition)? })
    };
    let (space, body) = (orthonormal("g", space), orthonormal("eta", body));
    let runtime = runtime(context.spec.runtime.as_ref());
    (
        quote!(bases: #runtime::__private::Bases<#n>,),
        quote!(let bases = #rt::Bases::of_factors(#space, #body);),
    )
}

impl Context<'_> {
    /// The bases over a scalar, or over the one that is asked for where they stand.
    pub(super) fn bases(&self, scalar: Option<&TokenStream>) -> TokenStream {
        let of = scalar.map(|scalar| quote!(::<#scalar>));
        match self.model.metrics {
            Some(ChangeOfBases::Prepared(_)) => quote!(self.bases.over #of ()),
            _ => quote!(bases #of ()),
        }
    }

    /// Puts `point`, a reference, in orthonormal bases.
    pub(super) fn inward(&self) -> TokenStream {
        let rt = &self.names.rt;
        let bases = self.bases(None);
        self.with_metrics(quote!(let point = &#rt::Phase::rebased(point, &#bases);))
    }

    /// A point in the user's bases.
    pub(super) fn outward(&self, scalar: &TokenStream, point: TokenStream) -> TokenStream {
        let (rt, bases) = (&self.names.rt, self.bases(Some(scalar)));
        match self.model.metrics {
            Some(_) => quote!(#rt::Phase::rebased(&#point, &#bases.reversed())),
            None => point,
        }
    }

    /// Statements for a model with metrics.
    pub(super) fn with_metrics(&self, statements: TokenStream) -> TokenStream {
        if self.model.metrics.is_some() { statements } else { TokenStream::new() }
    }
}

//! Changes of bases at the edges: points have the user's coordinates, equations those of orthonormal bases.

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::Rational;
use crate::mechanics::metrics::Metrics;

use super::Context;
use super::body::exact;

/// The bases as a function of the scalar, and the method of the trait that tells of them.
pub(super) fn bases(context: &Context) -> (TokenStream, TokenStream) {
    let Some(Metrics { space, body }) = &context.model.metrics else {
        return (TokenStream::new(), TokenStream::new());
    };
    let (rt, t, n) = (&context.names.rt, &context.names.scalar, context.dim());
    let matrix = |rows: &Vec<Vec<Rational>>| {
        let rows = rows.iter().map(|row| {
            let entries = row.iter().map(|entry| exact(t, entry));
            quote!([#(#entries),*])
        });
        quote!(#rt::matrix([#(#rows),*]))
    };
    let [a, a_inverse, b, b_inverse] =
        [&space.matrix, &space.inverse, &body.matrix, &body.inverse].map(matrix);
    let function = quote! {
        #[allow(clippy::approx_constant)]
        fn bases<#t: #rt::Real>() -> #rt::Bases<#n, #t> {
            #rt::Bases { space: #a, space_inverse: #a_inverse, body: #b, body_inverse: #b_inverse }
        }
    };
    let method = quote! {
        fn bases(&self) -> ::core::option::Option<#rt::Bases<#n>> {
            ::core::option::Option::Some(bases())
        }
    };
    (function, method)
}

impl Context<'_> {
    /// Puts `point`, a reference, in orthonormal bases.
    pub(super) fn inward(&self) -> TokenStream {
        let rt = &self.names.rt;
        self.with_metrics(quote!(let point = &#rt::Phase::rebased(point, &bases());))
    }

    /// A point in the user's bases.
    pub(super) fn outward(&self, scalar: &TokenStream, point: TokenStream) -> TokenStream {
        let rt = &self.names.rt;
        match self.model.metrics {
            Some(_) => quote!(#rt::Phase::rebased(&#point, &bases::<#scalar>().reversed())),
            None => point,
        }
    }

    /// Statements for a model with metrics.
    pub(super) fn with_metrics(&self, statements: TokenStream) -> TokenStream {
        if self.model.metrics.is_some() { statements } else { TokenStream::new() }
    }
}

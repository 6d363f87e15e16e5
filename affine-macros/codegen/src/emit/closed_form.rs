//! Closed forms of geodesics.

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::passage::Word;
use crate::symbol::{Frame, Quantity};

use super::body::Body;
use super::context::{Coefficients, Context};
use super::number::Number;
use super::point::own_spin;

/// `geodesic`: the closed form where the model and the scene have one. The trait says that there is none.
pub(super) fn geodesic(context: &Context) -> TokenStream {
    let (rt, n) = (&context.names.rt, context.dim());
    let drifts = context.model.dynamics.passage.constants.iter().any(|constant| constant.name == Word::Drift);
    let f64 = quote!(#rt::f64);
    let none = quote!(::core::option::Option::None);
    let Some((_, needs_rest)) = context.model.dynamics.closed_form else { return TokenStream::new() };
    let rest = needs_rest.then(|| {
        quote! {
            if #rt::Phase::p(point) != #rt::Vector::<#n>::zeros() {
                return #none;
            }
        }
    });
    let drift = match (&context.model.point.mass, drifts) {
        (Some(program), true) => {
            let p = quote!(#rt::Phase::p(point));
            let (lets, drift) = context.times(p, (program, Quantity::InverseMass), Number::Double);
            quote!(#lets let drift = #drift;)
        }
        _ => quote!(let drift = #rt::Vector::<#n>::zeros();),
    };
    let is_always = (!needs_rest).then(|| {
        quote!(
            const IS_GEODESIC: ::core::primitive::bool = true;
        )
    });
    let straight = context.model.frame == Frame::Flat;
    let spin = own_spin(context);
    let typed = context.bases(Some(&f64), Coefficients::Own);
    let velocity = match context.model.metrics {
        None => quote!(#rt::Model::velocity(self, point)),
        Some(_) => quote!(#typed.velocity(&#rt::Model::velocity(self, stated))),
    };
    let stated = (context.model.metrics.is_some() && straight).then(|| quote!(let stated = point;));
    // A straight line reads the velocity alone, and the momentum of a free centre.
    let inward = (!straight || drifts).then(|| context.inward(Coefficients::Own));
    let collapse = straight.then(|| {
        quote! {
            fn collapse(
                &self,
                geodesic: &#rt::Geodesic<#n>,
                t_end: #f64,
                start: &#rt::Matrix<#n>,
            ) -> ::core::option::Option<#f64> {
                geodesic.collapse(t_end, start)
            }
        }
    });
    let on_geodesic = context.with_metrics(quote! {
        fn on_geodesic(
            &self,
            geodesic: &#rt::Geodesic<#n>,
            t: #f64,
            start: &Self::Point<#f64>,
        ) -> Self::Point<#f64> {
            let start = #rt::Model::orthonormal(self, start);
            #rt::Phase::from_orthonormal(&geodesic.point(t, &start), &#typed)
        }
    });
    let motion = match (context.model.frame, &context.model.point.isotropic) {
        (Frame::Flat, _) | (_, None) => quote! {
            let motion = #rt::Orbit::straight(#velocity.phi_dot);
        },
        (frame, Some(program)) => {
            let Body { lets, results } = context.double(program);
            let make = match frame {
                Frame::Body => quote!(body),
                _ => quote!(space),
            };
            let (quadratic, cubic) = results.split_at(3.min(results.len()));
            let squared = cubic.first().map(|casimir3| quote!(.with_square(&#spin, #casimir3)));
            quote!(#lets let motion = #rt::Orbit::#make(&#spin, [#(#quadratic),*])#squared;)
        }
    };
    quote! {
        #is_always

        fn geodesic(&self, t0: #f64, point: &Self::Point<#f64>) -> ::core::option::Option<#rt::Geodesic<#n>> {
            #stated
            #inward
            #rest
            #drift
            #motion
            ::core::option::Option::Some(#rt::Geodesic { t0, motion, drift })
        }

        #on_geodesic
        #collapse
    }
}

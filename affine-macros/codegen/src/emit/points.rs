//! Constructors of phase points: inherent methods, so that a model without translation has no `x` to give.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::kinetic::Frame;

use super::body::Body;
use super::{Context, inputs, mixed, pattern, quantities};

/// `at_momentum` and `at_velocity`.
pub(super) fn inherent(context: &Context) -> TokenStream {
    let (prepared, rt, n) = (&context.names.prepared, &context.names.rt, context.dim());
    let visibility = &context.spec.item.visibility;
    let (generics, types, clause) = context.generics();
    let point = context.point(&quote!(#rt::f64));
    let legendre = legendre(context);
    let momentum_of_centre = momentum_of_centre(context);
    let moving = context.model.translation.is_some();
    let (x, p, x_dot, centre) = match moving {
        false => (quote!(), quote!(), quote!(), quote!(#rt::Pinned)),
        true => (
            quote!(x: #rt::Vector<#n>,),
            quote!(p: #rt::Vector<#n>,),
            quote!(x_dot: #rt::Vector<#n>,),
            quote!(#rt::Centre { x, p }),
        ),
    };
    let (q, v, m) = match moving {
        false => ("`phi`", "`phi_dot`", "the affine spin"),
        true => ("`(x, phi)`", "`(x_dot, phi_dot)`", "`p` and the affine spin"),
    };
    let refusal = mixed::refusal(context);
    let checked_point = mixed::regular(context, quote!(#rt::phase_point(phi, spin, #centre)));
    let quantities = quantities::inherent(context);
    let at_momentum = format!(
        " The phase point at the placement {q} with {m}: `Spatial(sigma)`, `Comoving(sigma_hat)` or `TwoPoint(pi)`."
    );
    let at_velocity = format!(
        " The phase point at the placement {q} with the velocity {v}: the Legendre transformation \
         `X = (dT/dO)^T` (4.6), (4.8)."
    );
    let errors = |of: &str| {
        format!(
            " `Placement` unless `phi` is finite with a positive determinant, `NotFinite` for a {of}{refusal}."
        )
    };
    let (momentum_errors, velocity_errors) = (errors("momentum"), errors("velocity"));
    quote! {
        impl #generics #prepared #types #clause {
            #[doc = #at_momentum]
            ///
            /// # Errors
            #[doc = #momentum_errors]
            #visibility fn at_momentum(
                &self,
                #x
                phi: #rt::Matrix<#n>,
                #p
                spin: impl #rt::Momentum<#n, #rt::f64>,
            ) -> #rt::Result<#point> {
                #checked_point
            }

            #[doc = #at_velocity]
            ///
            /// # Errors
            #[doc = #velocity_errors]
            #visibility fn at_velocity(
                &self,
                #x
                phi: #rt::Matrix<#n>,
                #x_dot
                phi_dot: #rt::Matrix<#n>,
            ) -> #rt::Result<#point> {
                #legendre
                #momentum_of_centre
                #checked_point
            }

            #quantities
        }
    }
}

/// `O -> X` in the model's frame.
fn legendre(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let components = components(context.model.frame.velocity_name(), context.model.dim);
    let used = inputs(&context.model.legendre);
    let rows = components.iter().map(|row| pattern(row, &used));
    let Body { lets, results } = context.double(&context.model.legendre);
    let rows_out = results.chunks(context.model.dim).map(|row| quote!([#(#row),*]));
    let velocity = affine_velocity(context, &quote!(&phi));
    let wrapper = wrapper(context);
    let placement = mixed::placement(context, &context.model.legendre, &quote!(&phi));
    quote! {
        let [#(#rows),*] = #rt::rows(&#velocity);
        #placement
        #lets
        let spin = #wrapper(#rt::matrix([#(#rows_out),*]));
    }
}

/// The affine velocity of the model's frame from a reference to `phi` and `phi_dot`.
pub(super) fn affine_velocity(context: &Context, phi: &TokenStream) -> TokenStream {
    let rt = &context.names.rt;
    match context.model.frame {
        Frame::Body => quote!((#rt::inverse(#phi) * phi_dot)),
        Frame::Space => quote!((phi_dot * #rt::inverse(#phi))),
        Frame::Flat => quote!(phi_dot),
    }
}

/// Wrapper of matrices that hold the model's affine spin.
pub(super) fn wrapper(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    match context.model.frame {
        Frame::Body => quote!(#rt::Comoving),
        Frame::Space => quote!(#rt::Spatial),
        Frame::Flat => quote!(#rt::TwoPoint),
    }
}

/// `p = m x_dot` or `p = m C x_dot`, (4.7).
fn momentum_of_centre(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let Some(program) = &context.model.mass else { return mixed::momentum_of_centre(context) };
    let body = context.double(&program.only("mass"));
    let (lets, mass) = (&body.lets, body.result());
    let p = match context.model.translation {
        Some(Frame::Body) => quote! {
            let to_body = #rt::inverse(&phi);
            let p = to_body.tr_mul(&(to_body * x_dot)) * mass;
        },
        _ => quote!(let p = x_dot * mass;),
    };
    quote!(#lets let mass = #mass; #p)
}

/// Names of the entries of a matrix, row by row.
pub(super) fn components(stem: &str, n: usize) -> Vec<Vec<String>> {
    (1..=n).map(|i| (1..=n).map(|j| format!("{stem}_{i}{j}")).collect()).collect()
}

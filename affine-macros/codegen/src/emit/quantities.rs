//! Quantities that are emitted when asked for, as inherent methods.

use proc_macro2::TokenStream;
use quote::quote;

use crate::ir::Program;

use super::body::Body;
use super::dynamics::bind_point;
use super::{Context, mixed, number};

/// `metric`, `inverse_metric`, `acceleration`, as far as asked for.
pub(super) fn inherent(context: &Context) -> TokenStream {
    let metric = metric(context);
    let acceleration = acceleration(context);
    quote!(#metric #acceleration)
}

fn metric(context: &Context) -> TokenStream {
    let Some(metric) = &context.model.metric else { return TokenStream::new() };
    let (rt, n, size) = (&context.names.rt, context.dim(), number(metric.size));
    let visibility = &context.spec.item.visibility;
    let moving = metric.size > context.model.dim * context.model.dim;
    let order = match moving {
        true => " Rows and columns: the components of `x_dot`, then the entries of `phi_dot` row by row.",
        false => " Rows and columns: the entries of `phi_dot` row by row.",
    };
    let inverse_order = match moving {
        true => " Rows and columns: the components of `p`, then the entries of `Pi^T` row by row.",
        false => " Rows and columns: the entries of `Pi^T` row by row.",
    };
    let square = |program: &Program| {
        let placement = mixed::placement(context, program, &quote!(phi));
        let Body { lets, results } = context.double(program);
        let rows = results.chunks(metric.size).map(|row| quote!([#(#row),*]));
        let reads = !placement.is_empty();
        (quote!(#placement #lets #rt::matrix([#(#rows),*])), if reads { quote!(phi) } else { quote!(_phi) })
    };
    let ((entries, phi), (inverse, inverse_phi)) = (square(&metric.entries), square(&metric.inverse));
    quote! {
        /// The configuration metric `Gamma(phi)`, twice the kinetic energy as a form in the velocities.
        ///
        #[doc = #order]
        #visibility fn metric(&self, #phi: &#rt::Matrix<#n>) -> #rt::Matrix<#size> {
            #entries
        }

        /// The inverse of the configuration metric, twice the kinetic energy as a form in the momenta.
        ///
        #[doc = #inverse_order]
        #visibility fn inverse_metric(&self, #inverse_phi: &#rt::Matrix<#n>) -> #rt::Matrix<#size> {
            #inverse
        }
    }
}

fn acceleration(context: &Context) -> TokenStream {
    let Some(program) = &context.model.acceleration else { return TokenStream::new() };
    let (rt, n) = (&context.names.rt, context.dim());
    let visibility = &context.spec.item.visibility;
    let point = context.point(&quote!(#rt::f64));
    let bound = bind_point(context, program);
    let Body { lets, results } = context.double(program);
    let point_name = if bound.is_empty() { quote!(_point) } else { quote!(point) };
    quote! {
        /// The acceleration `d^2 x/dt^2` of the centre of mass along the motion through `point`: the derivative of
        /// `dx/dt` along Hamilton's equations (section 4).
        #visibility fn acceleration(&self, #point_name: &#point) -> #rt::Vector<#n> {
            #bound
            #lets
            #rt::vector([#(#results),*])
        }
    }
}

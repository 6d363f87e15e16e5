//! Quantities that are emitted when asked for, as inherent methods.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::derive::BalancedQuantities;
use crate::ir::Program;
use crate::symbol::{Frame, Quantity};

use super::body::Body;
use super::context::{Coefficients, Context};
use super::number::{Number, number};
use super::pattern::{ident, in_rows, time};
use super::point::{at_point, placement, wrapper};

/// `metric`, `inverse_metric`, `acceleration`, `balance`, `centre_balance`, as far as asked for.
pub(super) fn inherent(context: &Context) -> TokenStream {
    let metric = metric(context);
    let acceleration = acceleration(context);
    let balance = balance(context);
    quote!(#metric #acceleration #balance)
}

fn metric(context: &Context) -> TokenStream {
    let Some(metric) = &context.model.quantities.metric else { return TokenStream::new() };
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
    let bases = context.bases(Some(&quote!(#rt::f64)), Coefficients::Own);
    let square = |program: &Program, carried: &str| {
        let placement = placement(context, program, &quote!(phi));
        let Body { lets, results } = context.double(program);
        let rows = in_rows(&results, metric.size);
        let reads = placement.is_some();
        let (mut inward, mut form) = (TokenStream::new(), quote!(#rt::matrix(#rows)));
        if context.model.metrics.is_some() {
            let carried = format_ident!("{carried}");
            inward = if reads { quote!(let phi = &#bases.placement(phi);) } else { TokenStream::new() };
            form = quote!(#rt::#carried::<#n, #size>(&#bases, #form));
        }
        (quote!(#inward #placement #lets #form), if reads { quote!(phi) } else { quote!(_phi) })
    };
    let ((entries, phi), (inverse, inverse_phi)) =
        (square(&metric.entries, "form_in_given_bases"), square(&metric.inverse, "inverse_in_given_bases"));
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
    let Some(program) = &context.model.quantities.acceleration else { return TokenStream::new() };
    let (rt, n) = (&context.names.rt, context.dim());
    let visibility = &context.spec.item.visibility;
    let point = context.point(&quote!(#rt::f64));
    let (Body { lets, results }, reads) = at_point(context, program, Number::Double);
    let point_name = if reads { quote!(point) } else { quote!(_point) };
    let at = program.reads_time().then(|| quote!(t: #rt::f64,));
    let inward = if reads { context.inward(Coefficients::Own) } else { TokenStream::new() };
    let acceleration = quote!(#rt::vector([#(#results),*]));
    let bases = context.bases(Some(&quote!(#rt::f64)), Coefficients::Own);
    let acceleration = match context.model.metrics {
        Some(_) => quote!(#bases.space_inverse * #acceleration),
        None => acceleration,
    };
    quote! {
        /// The acceleration `d^2 x/dt^2` of the centre of mass along the motion through `point`: the derivative of
        /// `dx/dt` along Hamilton's equations (section 4).
        #visibility fn acceleration(&self, #at #point_name: &#point) -> #rt::Vector<#n> {
            #inward
            #lets
            #acceleration
        }
    }
}

fn balance(context: &Context) -> TokenStream {
    let Some(balance) = &context.model.quantities.balance else { return TokenStream::new() };
    let (rt, n, dim) = (&context.names.rt, context.dim(), context.model.dim);
    let visibility = &context.spec.item.visibility;
    let point = context.point(&quote!(#rt::f64));
    let matrix = |entries: &[TokenStream]| {
        let rows = in_rows(entries, dim);
        quote!(#rt::matrix(#rows))
    };
    let fields = |quantities: &[(Quantity, Frame)], results: &[TokenStream], size: usize| {
        let value = |entries: &[TokenStream]| {
            if size == dim { quote!(#rt::vector([#(#entries),*])) } else { matrix(entries) }
        };
        let field = |((of, frame), entries): (&(Quantity, Frame), &[TokenStream])| {
            let (name, wrapper, value) = (ident(&(*of).into()), wrapper(context, *frame), value(entries));
            quote!(#name: #wrapper(#value))
        };
        let fields = quantities.iter().zip(results.chunks(size)).map(field);
        quote!(#(#fields),*)
    };
    let method = |BalancedQuantities { quantities, program }: &BalancedQuantities, size: usize| {
        let time = time(program);
        let (Body { lets, results }, _) = at_point(context, program, Number::Double);
        let fields = fields(quantities, &results, size);
        (quote!(&self, #time: #rt::f64, point: &#point), lets, fields)
    };
    let (arguments, body, fields) = method(&balance.internal, dim * dim);
    let centre = balance.centre.as_ref().map(|balanced| {
        let (arguments, body, fields) = method(balanced, dim);
        quote! {
            /// Both sides of the balance of the momentum of the centre of mass, `dk/dt = F`,
            /// `dk_hat/dt = -K_hat^T J^-1 k_hat + F_hat` (3.3), (3.9).
            #visibility fn centre_balance(#arguments) -> #rt::CentreBalance<#n> {
                #body
                #rt::CentreBalance { #fields }
            }
        }
    });
    quote! {
        /// Both sides of the balance of the kinematical spin `K = phi J phi_dot^T`, `dK/dt = phi_dot J phi_dot^T + N`,
        /// `dK_hat/dt = -K_hat J^-1 K_hat + N_hat` (3.6), (3.8), (3.9).
        #visibility fn balance(#arguments) -> #rt::Balance<#n> {
            #body
            #rt::Balance { #fields }
        }
        #centre
    }
}

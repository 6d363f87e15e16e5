//! Constructors that do not compile when called: a bound that nothing meets says why.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::context::Context;

/// `at_velocity` of a model whose velocities do not determine the momentum.
pub(super) fn without_velocity(context: &Context, point: &TokenStream) -> TokenStream {
    let why = Why {
        bound: "VelocityDeterminesMomentum",
        doc: "with `C(3)` in `H` the velocity is quadratic in the momentum, and neither determines it nor reaches every \
              value; `at_momentum` makes the points",
    };
    at_velocity(context, &why, point)
}

/// Both constructors of a struct whose fields are still to be looked at.
pub(super) fn unprepared(context: &Context) -> TokenStream {
    if !context.has_fields {
        return TokenStream::new();
    }
    let (model, rt, n) = (&context.names.model, &context.names.rt, context.dim());
    let (generics, types, clause) = context.spec.item.generics.split_for_impl();
    let point = quote!(<Self as #rt::Model<#n>>::Point<#rt::f64>);
    let why = Why {
        bound: "IsPrepared",
        doc: "the fields become coefficients by `prepare()?`, and its result makes the points",
    };
    let (at_velocity, at_momentum) = (at_velocity(context, &why, &point), at_momentum(context, &why, &point));
    quote! {
        impl #generics #rt::Unprepared<#n> for #model #types #clause {}

        impl #generics #model #types #clause {
            #at_momentum

            #at_velocity
        }
    }
}

/// Why a constructor cannot be called.
struct Why {
    /// The trait of what the type lacks.
    bound: &'static str,
    /// The reason in its documentation.
    doc: &'static str,
}

fn at_velocity(context: &Context, why: &Why, point: &TokenStream) -> TokenStream {
    let (rt, n) = (&context.names.rt, context.dim());
    constructor(context, why, "at_velocity", "_x_dot", &quote!(_phi_dot: #rt::Matrix<#n>), point)
}

fn at_momentum(context: &Context, why: &Why, point: &TokenStream) -> TokenStream {
    let (rt, n) = (&context.names.rt, context.dim());
    constructor(context, why, "at_momentum", "_p", &quote!(_spin: impl #rt::Momentum<#n, #rt::f64>), point)
}

/// Its first vector is the position; `second` is the other one of the centre, `last` what moves the body.
fn constructor(
    context: &Context,
    Why { bound, doc }: &Why,
    name: &str,
    second: &str,
    last: &TokenStream,
    point: &TokenStream,
) -> TokenStream {
    let (rt, n) = (&context.names.rt, context.dim());
    let visibility = &context.spec.item.visibility;
    let [name, bound] = [name, bound].map(|name| format_ident!("{name}"));
    let doc = format!(" Does not compile when called: {doc}.");
    let of_centre = |name: &str| {
        let name = format_ident!("{name}");
        context.model.translation.map(|_| quote!(#name: impl #rt::OfCentre<#n>,))
    };
    let (x, second) = (of_centre("_x"), of_centre(second));
    // A lifetime keeps the compiler from judging the bound before the method is called.
    quote! {
        #[doc = #doc]
        ///
        /// # Errors
        /// None: it cannot be called.
        #[allow(dead_code)]
        #visibility fn #name(&self, #x _phi: #rt::Matrix<#n>, #second #last) -> #rt::Result<#point>
        where
            for<'never> Self: #rt::#bound,
        {
            #rt::#bound::never(self)
        }
    }
}

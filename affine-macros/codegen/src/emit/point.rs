//! A phase point in emitted code: its components bound to names, its matrices in the words of the runtime.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::derive::{Components, VolumeMeasure};
use crate::ir::Program;
use crate::symbol::{Quantity, Symbol};

use super::context::Context;
use super::pattern::{components, contains, pattern, reads};

/// The model's own affine spin of `point`, as a matrix.
pub(super) fn own_spin(context: &Context) -> TokenStream {
    spin(context, context.model.spin())
}

/// These components of the affine spin of `point`, as a matrix.
pub(super) fn spin(context: &Context, components: Components) -> TokenStream {
    let rt = &context.names.rt;
    match components {
        Components::Comoving => quote!(#rt::Phase::sigma_hat(point).0.0),
        Components::Spatial => quote!(#rt::Phase::sigma(point).0.0),
        Components::TwoPoint => quote!(#rt::Phase::pi(point).0.0),
    }
}

/// The affine velocity of the model's frame from a reference to `phi` and `phi_dot`.
pub(super) fn affine_velocity(context: &Context, phi: &TokenStream) -> TokenStream {
    let rt = &context.names.rt;
    match context.model.spin() {
        Components::Comoving => quote!((#rt::inverse(#phi) * phi_dot)),
        Components::Spatial => quote!((phi_dot * #rt::inverse(#phi))),
        Components::TwoPoint => quote!(phi_dot),
    }
}

/// Wrapper of a vector or a matrix of these components.
pub(super) fn wrapper(context: &Context, components: Components) -> TokenStream {
    let rt = &context.names.rt;
    match components {
        Components::Comoving => quote!(#rt::Comoving),
        Components::Spatial => quote!(#rt::Spatial),
        Components::TwoPoint => quote!(#rt::TwoPoint),
    }
}

/// A momentum, projected under a constraint.
pub(super) fn projected(context: &Context, momentum: TokenStream) -> TokenStream {
    let rt = &context.names.rt;
    match context.constraint().filter(|_| context.model.projected) {
        Some(group) => quote!(#rt::projected(#group, &(#momentum))),
        None => momentum,
    }
}

/// `let` statements that bind the components of `point` that a program reads.
pub(super) fn bind_point(context: &Context, program: &Program) -> TokenStream {
    bind_components(context, &program.inputs())
}

/// `let` statements that bind these components of `point`.
pub(super) fn bind_components(context: &Context, used: &[impl AsRef<str>]) -> TokenStream {
    let rt = &context.names.rt;
    let spin = own_spin(context);
    let mut lets = TokenStream::new();
    for (group, symbols) in &context.model.full.groups {
        let names: Vec<String> = symbols.iter().map(Symbol::to_string).collect();
        if !reads(used, &names) {
            continue;
        }
        let value = match *group {
            Quantity::Position => quote!(#rt::components(&#rt::Phase::x(point))),
            Quantity::Placement => quote!(#rt::rows(#rt::Phase::phi(point))),
            Quantity::LinearMomentum => quote!(#rt::components(&#rt::Phase::p(point))),
            Quantity::ComovingLinearMomentum => quote!(#rt::components(&#rt::Phase::p_hat(point).0.0)),
            _ => quote!(#rt::rows(&#spin)),
        };
        lets.extend(bind_group(context, *group, &names, used, &value));
    }
    lets
}

/// Binds the components of a vector or a matrix that are both in a group of the array and used.
fn bind_group(
    context: &Context,
    group: Quantity,
    names: &[String],
    used: &[impl AsRef<str>],
    value: &TokenStream,
) -> TokenStream {
    let stem = match group {
        Quantity::Position | Quantity::LinearMomentum | Quantity::ComovingLinearMomentum => {
            let bound = pattern(names, used);
            return quote!(let #bound = #value;);
        }
        Quantity::Placement => "phi",
        _ => context.model.spin_name(),
    };
    let used: Vec<&str> = used.iter().map(AsRef::as_ref).filter(|name| contains(names, name)).collect();
    let rows = components(stem, context.model.dim);
    let rows = rows.iter().map(|row| pattern(row, &used));
    quote!(let [#(#rows),*] = #value;)
}

/// A statement that binds the entries of `phi` that a program reads; nothing where it reads none.
pub(super) fn placement(context: &Context, program: &Program, phi: &TokenStream) -> TokenStream {
    let (rt, used) = (&context.names.rt, program.inputs());
    let names = components("phi", context.model.dim);
    if !reads(&used, &names.concat()) {
        return TokenStream::new();
    }
    let rows = names.iter().map(|row| pattern(row, &used));
    quote!(let [#(#rows),*] = #rt::rows(#phi);)
}

/// `let` statements for the functions of the placement of `point` that a program reads: `q`, `D` and `q_a`.
pub(super) fn at_placement(context: &Context, program: &Program) -> TokenStream {
    let rt = &context.names.rt;
    let used = program.inputs();
    let [mean, dilatation] = [VolumeMeasure::MeanLogStretch, VolumeMeasure::Dilatation].map(|measure| {
        let is_read = contains(&used, measure.quantity().stem());
        is_read.then(|| bind_measure(context, measure, &quote!(#rt::Phase::phi(point))))
    });
    let names: Vec<String> = (1..=context.model.dim).map(|a| format!("q_{a}")).collect();
    let stretches = reads(&used, &names).then(|| {
        let bound = pattern(&names, &used);
        quote!(let #bound = #rt::log_stretches(#rt::Phase::phi(point));)
    });
    quote! {
        #mean
        #dilatation
        #stretches
    }
}

/// The statement that binds a function of `det phi`.
pub(super) fn bind_measure(context: &Context, measure: VolumeMeasure, phi: &TokenStream) -> TokenStream {
    let (rt, t, symbol) =
        (&context.names.rt, &context.names.scalar, format_ident!("{}", measure.quantity().stem()));
    let value = match measure {
        VolumeMeasure::MeanLogStretch => quote!(#rt::mean_log_stretch(#phi)),
        VolumeMeasure::Dilatation => quote!(#rt::dilatation(#phi)),
        VolumeMeasure::InverseDilatation => quote!(#t::one() / #rt::dilatation(#phi)),
    };
    quote!(let #symbol = #value;)
}

//! A phase point in emitted code: its components bound to names, its matrices in the words of the runtime.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::{Components, VolumeMeasure};
use crate::ir::Program;
use crate::symbol::{Quantity, Symbol};

use super::context::Context;
use super::pattern::{components, entries, ident, pattern, reads, table_pattern};

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
    match context.constraint() {
        Some(group) => quote!(#rt::projected(#group, &(#momentum))),
        None => momentum,
    }
}

/// `let` statements that bind the components of `point` that a program reads.
pub(super) fn bind_point(context: &Context, program: &Program) -> TokenStream {
    bind_components(context, &program.inputs())
}

/// `let` statements that bind these components of `point`.
pub(super) fn bind_components(context: &Context, used: &[Symbol]) -> TokenStream {
    let rt = &context.names.rt;
    let spin = own_spin(context);
    let mut lets = TokenStream::new();
    for (group, symbols) in &context.model.dynamics.full.groups {
        if !reads(used, symbols) {
            continue;
        }
        let value = match *group {
            Quantity::Position => quote!(#rt::components(&#rt::Phase::x(point))),
            Quantity::Placement => quote!(#rt::rows(#rt::Phase::phi(point))),
            Quantity::LinearMomentum => quote!(#rt::components(&#rt::Phase::p(point))),
            Quantity::ComovingLinearMomentum => quote!(#rt::components(&#rt::Phase::p_hat(point).0.0)),
            _ => quote!(#rt::rows(&#spin)),
        };
        lets.extend(bind_group(context, *group, symbols, used, &value));
    }
    lets
}

/// Binds the components of a vector or a matrix that are both in a group of the array and used.
fn bind_group(
    context: &Context,
    group: Quantity,
    symbols: &[Symbol],
    used: &[Symbol],
    value: &TokenStream,
) -> TokenStream {
    let bound = match group {
        Quantity::Position | Quantity::LinearMomentum | Quantity::ComovingLinearMomentum => {
            pattern(symbols, used)
        }
        _ => {
            let used: Vec<Symbol> = used.iter().filter(|symbol| symbols.contains(symbol)).cloned().collect();
            table_pattern(&entries(group, context.model.dim), &used)
        }
    };
    quote!(let #bound = #value;)
}

/// A statement that binds the entries of `phi` that a program reads; nothing where it reads none.
pub(super) fn placement(context: &Context, program: &Program, phi: &TokenStream) -> TokenStream {
    let (rt, used) = (&context.names.rt, program.inputs());
    let entries = entries(Quantity::Placement, context.model.dim);
    if !reads(&used, &entries.concat()) {
        return TokenStream::new();
    }
    let bound = table_pattern(&entries, &used);
    quote!(let #bound = #rt::rows(#phi);)
}

/// `let` statements for the functions of the placement of `point` that a program reads: `q`, `D` and `q_a`.
pub(super) fn at_placement(context: &Context, program: &Program) -> TokenStream {
    let rt = &context.names.rt;
    let used = program.inputs();
    let [mean, dilatation] = [VolumeMeasure::MeanLogStretch, VolumeMeasure::Dilatation].map(|measure| {
        let is_read = used.contains(&measure.quantity().into());
        is_read.then(|| bind_measure(context, measure, &quote!(#rt::Phase::phi(point))))
    });
    let log_stretches = components(Quantity::LogStretches, context.model.dim);
    let stretches = reads(&used, &log_stretches).then(|| {
        let bound = pattern(&log_stretches, &used);
        quote!(let #bound = #rt::log_stretches(#rt::Phase::phi(point));)
    });
    quote! {
        #mean
        #dilatation
        #stretches
    }
}

/// The statement that binds a function of `det phi`.
fn bind_measure(context: &Context, measure: VolumeMeasure, phi: &TokenStream) -> TokenStream {
    let (rt, symbol) = (&context.names.rt, ident(&measure.quantity().into()));
    let value = match measure {
        VolumeMeasure::MeanLogStretch => quote!(#rt::mean_log_stretch(#phi)),
        VolumeMeasure::Dilatation => quote!(#rt::dilatation(#phi)),
    };
    quote!(let #symbol = #value;)
}

//! A phase point in emitted code: its components bound to names, its matrices in the words of the runtime.

use proc_macro2::TokenStream;
use quote::quote;

use crate::ir::Program;
use crate::symbol::{Frame, Quantity, Symbol};

use super::body::Body;
use super::context::{Coefficients, Context};
use super::number::Number;
use super::pattern::{bound_entries, components, entries, ident, pattern, reads, table_pattern};

/// The model's own affine spin of `point`, as a matrix.
pub(super) fn own_spin(context: &Context) -> TokenStream {
    spin(context, context.model.frame)
}

/// The affine spin of `point` in the components of a frame, as a matrix.
pub(super) fn spin(context: &Context, frame: Frame) -> TokenStream {
    let rt = &context.names.rt;
    match frame {
        Frame::Body => quote!(#rt::Phase::sigma_hat(point).0.0),
        Frame::Space => quote!(#rt::Phase::sigma(point).0.0),
        Frame::Flat => quote!(#rt::Phase::pi(point).0.0),
    }
}

/// What programs read of a placement that moves.
pub(super) struct Moving {
    /// `let` statements for it, and for `phi_inverse` where that is needed.
    pub(super) lets: TokenStream,
    /// Is `phi` among it?
    pub(super) reads_phi: bool,
}

/// What programs read of the placement that `phi` points at, which moves with `phi_dot` and `x_dot`. The momentum of a mass in the
/// body needs `phi_inverse`, whatever they read.
pub(super) fn moving(
    context: &Context,
    programs: &[&Program],
    phi: &TokenStream,
    x_dot: &TokenStream,
) -> Moving {
    let (rt, n) = (&context.names.rt, context.model.dim);
    let used: Vec<Symbol> = programs.iter().flat_map(|program| program.inputs()).collect();
    let matrix = |of: Quantity, value: TokenStream| bind_matrix(context, &entries(of, n), &used, &value);
    let vector = |of: Quantity, value: TokenStream| {
        let components = components(of, n);
        let bound = pattern(&components, &used);
        reads(&used, &components).then(|| quote!(let #bound = #rt::components(#value);))
    };
    let through_inverse = [
        matrix(Quantity::ComovingAffineVelocity, quote!(&(phi_inverse * phi_dot))),
        matrix(Quantity::AffineVelocity, quote!(&(phi_dot * phi_inverse))),
        matrix(Quantity::InversePlacement, quote!(&phi_inverse)),
        vector(Quantity::ComovingCentreVelocity, quote!(&(phi_inverse * #x_dot))),
    ];
    let given = [
        matrix(Quantity::PlacementVelocity, quote!(&phi_dot)),
        vector(Quantity::CentreVelocity, quote!(&#x_dot)),
    ];
    let placement = matrix(Quantity::Placement, phi.clone());
    let inverts =
        context.model.translation == Some(Frame::Body) || through_inverse.iter().any(Option::is_some);
    let inverse = inverts.then(|| quote!(let phi_inverse = #rt::inverse(#phi);));
    let lets = quote!(#inverse #(#through_inverse)* #(#given)* #placement);
    Moving { lets, reads_phi: inverts || placement.is_some() }
}

/// What is computed at `point`: in another way far from the undeformed state, where there is one.
pub(super) fn by_distance(
    context: &Context,
    near: TokenStream,
    far_away: Option<TokenStream>,
) -> TokenStream {
    let (rt, Some(far_away)) = (&context.names.rt, far_away) else { return near };
    quote! {
        if #rt::far_from_undeformed(#rt::Phase::phi(point)) {
            #far_away
        } else {
            #near
        }
    }
}

/// Wrapper of a vector or a matrix in the components of a frame.
pub(super) fn wrapper(context: &Context, frame: Frame) -> TokenStream {
    let rt = &context.names.rt;
    match frame {
        Frame::Body => quote!(#rt::Comoving),
        Frame::Space => quote!(#rt::Spatial),
        Frame::Flat => quote!(#rt::TwoPoint),
    }
}

/// The phase point of `phi` and a momentum, or why it is none: under a constraint both have to obey it.
pub(super) fn phase_point(context: &Context, momentum: &TokenStream, centre: &TokenStream) -> TokenStream {
    let rt = &context.names.rt;
    match context.constraint() {
        None => quote!(#rt::phase_point(phi, #momentum, #centre)),
        Some(group) => quote!(#rt::confined_point(#group, phi, #momentum, #centre)),
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

/// A program at `point`, after the statements that bind what it reads there. And does it read anything?
pub(super) fn at_point(context: &Context, program: &Program, number: Number) -> (Body, bool) {
    let common = context.common.as_ref();
    let called = common.and_then(|function| function.called_by(program, true));
    let bound = match (common, &called) {
        (Some(function), Some((_, rest))) => {
            let read = [&rest.inputs(), function.numbers()].concat();
            bind_components(context, &read, |group| function.takes(group))
        }
        _ => bind_components(context, &program.inputs(), |_| false),
    };
    let placed = at_placement(context, program);
    let reads = !(bound.is_empty() && placed.is_empty());
    let Body { lets, results } = context.calling(program, called, number, Coefficients::of(number));
    (Body { lets: quote!(#bound #placed #lets), results }, reads)
}

/// `let` statements that bind these components of `point`, and these matrices of it as rows.
pub(super) fn bind_components(
    context: &Context,
    used: &[Symbol],
    in_rows: impl Fn(Quantity) -> bool,
) -> TokenStream {
    let bind = |(group, symbols): &(Quantity, Vec<Symbol>)| {
        let (name, value) = (Symbol::from(*group), group_of_point(context, *group));
        let used: Vec<Symbol> = used.iter().filter(|symbol| symbols.contains(symbol)).cloned().collect();
        let rows = entries(*group, context.model.dim);
        if in_rows(*group) {
            let (bound, name) = (bound_entries(&name, &rows, &used), ident(&name));
            return quote!(let #name = #value; #bound);
        }
        let bound = if is_vector(*group) { pattern(symbols, &used) } else { table_pattern(&rows, &used) };
        if used.is_empty() { TokenStream::new() } else { quote!(let #bound = #value;) }
    };
    context.model.dynamics.full.groups.iter().map(bind).collect()
}

/// Is a group of the array a vector? The others are matrices.
pub(super) fn is_vector(group: Quantity) -> bool {
    matches!(group, Quantity::Position | Quantity::LinearMomentum | Quantity::ComovingLinearMomentum)
}

/// The components of a vector of `point`, or the rows of a matrix.
pub(super) fn group_of_point(context: &Context, group: Quantity) -> TokenStream {
    let rt = &context.names.rt;
    match group {
        Quantity::Position => quote!(#rt::components(&#rt::Phase::x(point))),
        Quantity::Placement => quote!(#rt::rows(#rt::Phase::phi(point))),
        Quantity::LinearMomentum => quote!(#rt::components(&#rt::Phase::p(point))),
        Quantity::ComovingLinearMomentum => quote!(#rt::components(&#rt::Phase::p_hat(point).0.0)),
        _ => {
            let spin = own_spin(context);
            quote!(#rt::rows(&#spin))
        }
    }
}

/// A statement that binds the entries of `phi` that a program reads; nothing where it reads none.
pub(super) fn placement(context: &Context, program: &Program, phi: &TokenStream) -> Option<TokenStream> {
    let entries = entries(Quantity::Placement, context.model.dim);
    bind_matrix(context, &entries, &program.inputs(), phi)
}

/// A statement that binds the entries of the matrix that `value` points at, as far as they are used; nothing where none is.
pub(super) fn bind_matrix(
    context: &Context,
    entries: &[Vec<Symbol>],
    used: &[Symbol],
    value: &TokenStream,
) -> Option<TokenStream> {
    let (rt, bound) = (&context.names.rt, table_pattern(entries, used));
    reads(used, &entries.concat()).then(|| quote!(let #bound = #rt::rows(#value);))
}

/// `let` statements for the functions of the placement of `point` that a program reads: `q`, `D` and `q_a`.
fn at_placement(context: &Context, program: &Program) -> TokenStream {
    let rt = &context.names.rt;
    let used = program.inputs();
    let phi = quote!(#rt::Phase::phi(point));
    let measures =
        [(Quantity::MeanLogStretch, quote!(mean_log_stretch)), (Quantity::Dilatation, quote!(dilatation))];
    let measures = measures.into_iter().filter_map(|(of, function)| {
        let symbol = of.into();
        let name = ident(&symbol);
        used.contains(&symbol).then(|| quote!(let #name = #rt::#function(#phi);))
    });
    let log_stretches = components(Quantity::LogStretches, context.model.dim);
    let stretches = reads(&used, &log_stretches).then(|| {
        let bound = pattern(&log_stretches, &used);
        quote!(let #bound = #rt::log_stretches(#phi);)
    });
    quote! {
        #(#measures)*
        #stretches
    }
}

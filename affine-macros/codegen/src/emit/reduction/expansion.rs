//! The phase point of a reduced state.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::{AffineMomentum, Components, Trajectory};
use crate::emit::context::{Coefficients, Context};
use crate::emit::parametric::Evaluation;
use crate::emit::pattern::{components, entries, identifiers, pattern, table};
use crate::emit::point::{projected, wrapper};
use crate::emit::separated;
use crate::symbol::{Quantity, Symbol};

/// `expand`: what moves in closed form is put back, and space turned back.
pub(super) fn expand(context: &Context, parts: &Trajectory) -> TokenStream {
    let (rt, t, n) = (&context.names.rt, &context.names.scalar, context.model.dim);
    let all = context.model.dynamics.reduced.symbols();
    // No phase point holds the work, and 1/D and q follow from phi.
    let follows = [Quantity::InverseDilatation, Quantity::MeanLogStretch, Quantity::Work].map(Symbol::from);
    let needed: Vec<Symbol> = all.iter().filter(|symbol| !follows.contains(symbol)).cloned().collect();
    let bound = pattern(&all, &needed);
    let mut lets = quote!(let #bound = *reduced;);
    let rows = |of: Quantity| {
        let rows = table(&entries(of, n));
        quote!(#rt::matrix(#rows))
    };
    let back = |value: TokenStream| {
        if parts.turn { quote!(constants.turn.tr_mul(&#value)) } else { value }
    };
    if parts.dilatation.is_some() {
        lets.extend(separated::placement(context));
    } else {
        let phi = back(rows(Quantity::Placement));
        lets.extend(quote!(let phi = #phi;));
    }
    if parts.origin {
        lets.extend(quote!(let elapsed = t - constants.t0;));
    }
    if parts.placed {
        let x = identifiers(&components(Quantity::Position, n));
        let x = back(quote!(#rt::vector([#(#x),*])));
        lets.extend(quote!(let x = #x;));
    } else if parts.drift {
        lets.extend(quote!(let x = constants.x0 + constants.drift * elapsed;));
    }
    let p = if parts.pushed { quote!(p) } else { quote!(constants.p) };
    if parts.pushed {
        let of = if parts.comoving { Quantity::ComovingLinearMomentum } else { Quantity::LinearMomentum };
        let components = identifiers(&components(of, n));
        let components = quote!(#rt::vector([#(#components),*]));
        lets.extend(match parts.comoving {
            true => quote!(let p = #rt::inverse(&phi).tr_mul(&#components);),
            false => quote!(let p = #components;),
        });
    }
    lets.extend(match parts.dilatation {
        Some(_) => separated::momentum(context, &parts.fixed),
        None => expanded_momentum(context, parts, &rows(parts.momentum_entries)),
    });
    let spin = match (parts.rotation, parts.momentum) {
        (Some(Components::Comoving), AffineMomentum::Spin(Components::Comoving)) => {
            quote!(#rt::Comoving(whirl.tr_mul(&momentum) * whirl))
        }
        (Some(Components::Spatial), AffineMomentum::Spin(Components::Spatial)) => {
            quote!(#rt::Spatial(whirl * momentum * whirl.transpose()))
        }
        (_, AffineMomentum::Total) => {
            let spin = projected(context, quote!(momentum - x * #p.transpose()));
            quote!(#rt::Spatial(#spin))
        }
        (_, AffineMomentum::Spin(components)) => {
            let wrapper = wrapper(context, components);
            quote!(#wrapper(momentum))
        }
    };
    if let Some(side) = parts.rotation {
        lets.extend(quote!(let whirl = #rt::skew_exponential(&(constants.whirl * elapsed));));
        lets.extend(match side {
            Components::Comoving => quote!(let phi = phi * whirl;),
            _ => quote!(let phi = whirl * phi;),
        });
    }
    let centre = match (parts.pushed, parts.linear) {
        (true, _) => quote!(#rt::Centre { x, p }),
        (false, true) => quote!(#rt::Centre { x, p: constants.p }),
        (false, false) => quote!(#rt::Pinned),
    };
    let time = if parts.origin || parts.dilatation.is_some() { quote!(t) } else { quote!(_t) };
    let reads = parts.origin
        || parts.dilatation.is_some()
        || parts.turn
        || parts.linear
        || parts.conserved
        || !parts.fixed.is_empty();
    let constants = if reads { quote!(constants) } else { quote!(_constants) };
    let point = quote!(#rt::point(phi, #spin, #centre));
    let point = context.outward(&quote!(#t), point, Coefficients::Given);
    // The parts of a momentum whose trace moves apart are velocities: `1/alpha` takes them back.
    let scale = context.model.point.isotropic.as_ref().filter(|_| parts.dilatation.is_some());
    let scale = scale.map(|program| program.only(&Quantity::InverseAlpha.into()));
    let Evaluation { name, parameter } = Evaluation::of_points(context, "expand", scale.as_slice());
    quote! {
        fn #name<#t: #rt::Real>(
            &self,
            #parameter
            #time: #t,
            #constants: &Self::Constants<#t>,
            reduced: &Self::Reduced<#t>,
        ) -> Self::Point<#t> {
            #lets
            #point
        }
    }
}

/// The affine momentum of the chart, back from turned space.
fn expanded_momentum(context: &Context, parts: &Trajectory, rows: &TokenStream) -> TokenStream {
    if parts.conserved {
        return quote!(let momentum = constants.momentum;);
    }
    let mut lets = TokenStream::new();
    if !parts.fixed.is_empty() {
        let fixed = identifiers(&parts.fixed);
        lets.extend(quote!(let [#(#fixed),*] = constants.fixed;));
    }
    lets.extend(context.dependent(&context.model.dynamics.reduced));
    let momentum = match (parts.turn, parts.momentum) {
        (false, _) | (_, AffineMomentum::Spin(Components::Comoving)) => quote!(#rows),
        (true, AffineMomentum::Spin(Components::TwoPoint)) => quote!(#rows * constants.turn),
        (true, _) => quote!(constants.turn.tr_mul(&#rows) * constants.turn),
    };
    lets.extend(quote!(let momentum = #momentum;));
    lets
}

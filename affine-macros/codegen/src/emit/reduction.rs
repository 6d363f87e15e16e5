//! Reduction, reduced equations and expansion.

mod carried;
mod expansion;
mod plain;

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::{AffineMomentum, Components, Trajectory};
use crate::ir::Program;
use crate::symbol::Quantity;

use super::body::Body;
use super::context::{Coefficients, Context};
use super::number::Number;
use super::parametric::{Evaluation, Method, asks_again, equations_head};
use super::pattern::{components, entries, identifiers, pattern, reads, table_pattern, time};
use super::point::{projected, spin};
use super::separated;
use super::trajectory::{self, Constant};

/// The constants of a trajectory as a struct.
pub(super) fn constants_type(context: &Context) -> TokenStream {
    let (name, t) = (&context.names.constants, &context.names.scalar);
    let constants = trajectory::constants(context, &Trajectory::of(context.model), &[]);
    let fields: TokenStream = constants.iter().map(|constant| constant.field(context)).collect();
    let visibility = &context.spec.item.visibility;
    let doc = format!(" What one trajectory of [`{}`] conserves.", context.names.model);
    let marker = (fields.is_empty()).then(|| quote!(scalar: ::core::marker::PhantomData<#t>));
    quote! {
        #[doc = #doc]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #visibility struct #name<#t> { #fields #marker }
    }
}

/// `reduce`, `reduced_equations`, `expand`, `renewed`.
pub(super) fn methods(context: &Context) -> [Method; 4] {
    let parts = Trajectory::of(context.model);
    let is_plain = plain::is_plain(context, &parts);
    let (reduce, equations, expand) = match is_plain {
        true => (plain::reduce(context, &parts), plain::equations(context), plain::expand(context)),
        false => {
            (reduce(context, &parts), reduced_equations(context, &parts), expansion::expand(context, &parts))
        }
    };
    let renewed = (!is_plain && !parts.carried.is_empty()).then(|| carried::renewed(context, &parts.carried));
    let equations =
        if asks_again(context) { Method::Evaluation(equations) } else { Method::Other(equations) };
    let renewed = Method::Other(renewed.unwrap_or_default());
    [Method::Evaluation(reduce), equations, Method::Evaluation(expand), renewed]
}

/// The affine momentum of the reduced chart at `point`.
fn chart_momentum(context: &Context, parts: &Trajectory) -> TokenStream {
    let rt = &context.names.rt;
    match parts.momentum {
        AffineMomentum::Spin(components) => spin(context, components),
        AffineMomentum::Total => projected(context, quote!(#rt::total_affine_momentum(point))),
    }
}

fn reduce(context: &Context, parts: &Trajectory) -> TokenStream {
    let (rt, t, constants) = (&context.names.rt, &context.names.scalar, &context.names.constants);
    let momentum = chart_momentum(context, parts);
    let mut lets = TokenStream::new();
    if parts.linear || parts.pushed && !parts.comoving {
        lets.extend(quote!(let p = #rt::Phase::p(point);));
    }
    lets.extend(quote!(let momentum = #momentum;));
    if parts.turn {
        lets.extend(match (parts.momentum, parts.conserved) {
            (AffineMomentum::Total, true) => {
                quote!(let turn = #rt::turn(&p, ::core::option::Option::Some(&momentum));)
            }
            _ => quote!(let turn = #rt::turn(&p, ::core::option::Option::None);),
        });
    }
    lets.extend(match parts.dilatation {
        Some(motion) => separated::split(context, motion),
        None => bind_state(context, parts),
    });
    lets.extend(carried::computed(context, &parts.carried, &quote!(#rt::Phase::phi(point))));
    let body = context.generic(&context.model.dynamics.trajectory, Coefficients::Given);
    let (coefficients, results) = (body.lets, body.results);
    let whirl = whirl(context, parts);
    let reduced = &context.model.dynamics.reduced;
    let work = reduced.has(Quantity::Work).then(|| quote!(let work = #t::zero();));
    let state = identifiers(&reduced.symbols());
    let kept = trajectory::constants(context, parts, &results);
    let mut fields: TokenStream = kept.iter().map(Constant::at_the_start).collect();
    if fields.is_empty() {
        fields = quote!(scalar: ::core::marker::PhantomData);
    }
    let origin = if parts.origin || parts.dilatation.is_some() { quote!(t0) } else { quote!(_t0) };
    let inward = context.inward(Coefficients::Given);
    let Evaluation { name, parameter } = Evaluation::of_points(context, "reduce", &programs(context, parts));
    quote! {
        fn #name<#t: #rt::Real>(
            &self,
            #parameter
            #origin: #t,
            point: &Self::Point<#t>,
        ) -> (Self::Reduced<#t>, Self::Constants<#t>) {
            #inward
            #lets
            #coefficients
            #whirl
            #work
            ([#(#state),*], #constants { #fields })
        }
    }
}

/// What `reduce` evaluates.
fn programs(context: &Context, parts: &Trajectory) -> Vec<Program> {
    let model = context.model;
    let of = |program: &Option<Program>, factor: Quantity, wanted: bool| {
        program.as_ref().filter(|_| wanted).map(|program| program.only(&factor.into()))
    };
    let dilates = parts.dilatation.is_some();
    [
        Some(model.dynamics.trajectory.clone()),
        of(&model.point.isotropic, Quantity::InverseMu, parts.rotation.is_some()),
        of(&model.point.isotropic, Quantity::InverseAlpha, dilates),
        of(&model.point.mass, Quantity::InverseMass, parts.drift),
        model.dynamics.dilatation.clone().filter(|_| dilates),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Components of state and momenta in turned space, as variables.
fn bind_state(context: &Context, parts: &Trajectory) -> TokenStream {
    let (rt, n) = (&context.names.rt, context.model.dim);
    let mut used = context.model.dynamics.reduced.symbols();
    used.extend(context.model.dynamics.trajectory.inputs());
    used.extend(parts.fixed.clone());
    let turned = |value: TokenStream| if parts.turn { quote!((turn * #value)) } else { value };
    let mut lets = TokenStream::new();
    if parts.placed {
        let momentum = match parts.comoving {
            true => (Quantity::ComovingLinearMomentum, quote!(#rt::Phase::p_hat(point).0.0)),
            false => (Quantity::LinearMomentum, turned(quote!(p))),
        };
        for (of, value) in [(Quantity::Position, turned(quote!(#rt::Phase::x(point)))), momentum] {
            let names = components(of, n);
            if reads(&used, &names) {
                let bound = pattern(&names, &used);
                lets.extend(quote!(let #bound = #rt::components(&#value);));
            }
        }
    }
    let phi = turned(quote!(#rt::Phase::phi(point)));
    let phi_rows = table_pattern(&entries(Quantity::Placement, n), &used);
    lets.extend(if parts.turn {
        quote!(let #phi_rows = #rt::rows(&#phi);)
    } else {
        quote!(let #phi_rows = #rt::rows(#phi);)
    });
    let names = entries(parts.momentum_entries, n);
    if reads(&used, &names.concat()) {
        let rows = table_pattern(&names, &used);
        let value = match (parts.turn, parts.momentum) {
            (false, _) | (_, AffineMomentum::Spin(Components::Comoving)) => quote!(momentum),
            (true, AffineMomentum::Spin(Components::TwoPoint)) => quote!((momentum * turn.transpose())),
            (true, _) => quote!((turn * momentum * turn.transpose())),
        };
        lets.extend(quote!(let #rows = #rt::rows(&#value);));
    }
    lets
}

/// Generators of what moves in closed form: `-W/mu`, `p/m`.
fn whirl(context: &Context, parts: &Trajectory) -> TokenStream {
    let t = &context.names.scalar;
    let mut lets = TokenStream::new();
    if let (Some(side), Some(program)) = (parts.rotation, &context.model.point.isotropic) {
        let spin = spin(context, side);
        let (inner, whirl) = context.times(quote!(skew), (program, Quantity::InverseMu), Number::Generic(t));
        lets.extend(quote!(#inner let spin = #spin; let skew = spin.transpose() - spin; let whirl = #whirl;));
    }
    if let (true, Some(program)) = (parts.drift, &context.model.point.mass) {
        let (inner, drift) = context.times(quote!(p), (program, Quantity::InverseMass), Number::Generic(t));
        lets.extend(quote!(#inner let drift = #drift;));
    }
    lets
}

fn reduced_equations(context: &Context, parts: &Trajectory) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let program = &context.model.dynamics.reduced.program;
    let used = program.inputs();
    let all = context.model.dynamics.reduced.symbols();
    let bound = pattern(&all, &used);
    let coefficients = pattern(&trajectory::all(context), &used);
    let read = (parts.coefficients > 0).then(|| quote!(let #coefficients = constants.coefficients;));
    let constants = if parts.coefficients > 0 { quote!(constants) } else { quote!(_constants) };
    let reads_state = reads(&used, &all);
    let state = if reads_state { quote!(reduced) } else { quote!(_reduced) };
    let bind = reads_state.then(|| quote!(let #bound = *reduced;));
    let Body { lets, results } = context.generic(program, Coefficients::Given);
    let time = time(program);
    let inline = context.inline();
    let (name, parameter) = equations_head(context);
    quote! {
        #inline
        fn #name<#t: #rt::Scalar>(
            &self,
            #parameter
            #time: #t,
            #constants: &Self::Constants<#t>,
            #state: &Self::Reduced<#t>,
        ) -> Self::Reduced<#t> {
            #read
            #bind
            #lets
            [#(#results),*]
        }
    }
}

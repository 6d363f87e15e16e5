//! A derived model as Rust items; no algebra here.

mod body;
mod capability;
mod closed_form;
mod common;
mod constructors;
mod context;
mod description;
mod domain;
mod dynamics;
mod expression;
mod fields;
mod forces;
mod groups;
mod kernel;
mod lanes;
mod metrics;
mod mixed;
mod names;
mod number;
mod packed;
mod parametric;
mod passage;
mod pattern;
mod point;
mod prepare;
mod quantities;
mod reduction;
mod refused;
mod scope;
mod second_order;
mod splitting;
mod tangent;
mod taylor;
mod trajectory;
mod two_polar;
mod unconstrained;

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::{ChangeOfBases, Equations, Model};
use crate::spec::Spec;

use common::Function;
use context::Context;
use names::{Names, runtime};
use number::number;
use parametric::Method;

/// The user's item and everything that belongs to it.
pub fn emit(spec: &Spec, model: &Model) -> TokenStream {
    let bases_of_fields = matches!(model.metrics, Some(ChangeOfBases::Prepared));
    let has_fields = !model.prepared.coefficients.outputs.is_empty() || bases_of_fields;
    let names = Names::new(spec, has_fields);
    let runtime = runtime(spec.runtime.as_ref());
    let context = Context { spec, model, names: &names, has_fields, common: Function::of(model) };
    let rt = &names.rt;
    let prepared_type = prepare::prepared_type(&context);
    let prepare = prepare::method(&context);
    // Nothing but the lattice is emitted of a model on U(n), which has no phase points.
    let (docs, lints, items) = match spec.group {
        Some(_) => (Vec::new(), None, two_polar::lattice_of_circle(&context)),
        None => (description::docs(&context), Some(metrics::lints(&context)), items(&context)),
    };
    let item = spec.item.documented(&docs);
    let allowed = spec.item.allowed();
    let allowed_of_prepared = has_fields.then_some(&allowed);
    quote! {
        #item
        #allowed_of_prepared
        #prepared_type
        #allowed
        #lints
        const _: () = {
            use #runtime::__private as #rt;
            #prepare
            #items
        };
    }
}

/// What belongs to a model of phase points, in the order in which it is read.
fn items(context: &Context) -> TokenStream {
    let (parametric, implementation) = model_impl(context);
    let items = [
        refused::unprepared(context),
        metrics::bases(context).0,
        reduction::constants_type(context),
        context.function().unwrap_or_default(),
        implementation,
        parametric,
        constructors::inherent(context),
        splitting::splitting_impl(context),
        second_order::implementation(context),
        two_polar::implementations(context),
        taylor::taylor_impl(context),
        tangent::implementation(context),
        lanes::implementation(context),
        packed::implementation(context),
        unconstrained::implementation(context),
    ];
    items.into_iter().collect()
}

/// The implementations of the traits of models: of those with coefficients as an argument, and of all.
fn model_impl(context: &Context) -> (TokenStream, TokenStream) {
    let Names { prepared, rt, scalar, .. } = context.names;
    let (generics, types, clause) = context.generics();
    let n = context.dim();
    let size =
        |equations: &Equations| number(equations.groups.iter().map(|(_, components)| components.len()).sum());
    let (full, reduced) = (size(&context.model.dynamics.full), size(&context.model.dynamics.reduced));
    let point = context.point(&quote!(#scalar));
    let constants = trajectory::constants(context, scalar);
    let description = description::constant(context);
    let geodesic = closed_form::geodesic(context);
    let (_, bases) = metrics::bases(context);
    let hooks = capability::hooks(context);
    let others = quote!(#geodesic #hooks);
    let methods = dynamics::methods(context).into_iter().chain(reduction::methods(context)).chain([
        Method::Other(others),
        Method::Evaluation(forces::power(context)),
        Method::Other(domain::values(context)),
    ]);
    let (parametric, methods) = parametric::divided(context, methods);
    let implementation = quote! {
        impl #generics #rt::Model<#n> for #prepared #types #clause {
            const DESCRIPTION: #rt::Description = #description;
            type Point<#scalar: #rt::Real> = #point;
            type Full<#scalar: #rt::Scalar> = [#scalar; #full];
            type Reduced<#scalar: #rt::Scalar> = [#scalar; #reduced];
            type Constants<#scalar: #rt::Scalar> = #constants;
            #bases
            #methods
        }
    };
    (parametric, implementation)
}

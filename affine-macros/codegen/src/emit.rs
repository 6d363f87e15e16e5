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
    let bases_of_fields = matches!(model.prepared.metrics, Some(ChangeOfBases::Prepared(_)));
    let has_fields = !model.prepared.coefficients.outputs.is_empty() || bases_of_fields;
    let names = Names::new(spec, has_fields);
    let runtime = runtime(spec.runtime.as_ref());
    let context = Context { spec, model, names: &names, has_fields, common: Function::of(model) };
    let rt = &names.rt;
    let prepared_type = prepare::prepared_type(&context);
    let prepare = prepare::method(&context);
    if spec.group.is_some() {
        let item = spec.item.documented(&[]);
        let lattice = two_polar::lattice_of_circle(&context);
        return quote! {
            #item
            #prepared_type
            const _: () = {
                use #runtime::__private as #rt;
                #prepare
                #lattice
            };
        };
    }
    let item = spec.item.documented(&description::docs(&context));
    let constants = reduction::constants_type(&context);
    let function = context.function();
    let (parametric, implementation) = model_impl(&context);
    let constructors = constructors::inherent(&context);
    let unprepared = refused::unprepared(&context);
    let two_polar = two_polar::implementations(&context);
    let (bases, _) = metrics::bases(&context);
    let splitting = splitting::splitting_impl(&context);
    let second_order = second_order::implementation(&context);
    let tangent = tangent::implementation(&context);
    let taylor = taylor::taylor_impl(&context);
    let lanes = lanes::implementation(&context);
    let packed = packed::implementation(&context);
    let unconstrained = unconstrained::implementation(&context);
    let lints = metrics::lints(&context);
    quote! {
        #item
        #prepared_type
        #lints
        const _: () = {
            use #runtime::__private as #rt;
            #prepare
            #unprepared
            #bases
            #constants
            #function
            #implementation
            #parametric
            #constructors
            #splitting
            #second_order
            #two_polar
            #taylor
            #tangent
            #lanes
            #packed
            #unconstrained
        };
    }
}

/// The implementations of the traits of models: of those with coefficients as an argument, and of all.
fn model_impl(context: &Context) -> (TokenStream, TokenStream) {
    let Names { prepared, rt, constants, scalar, .. } = context.names;
    let (generics, types, clause) = context.generics();
    let n = context.dim();
    let size =
        |equations: &Equations| number(equations.groups.iter().map(|(_, components)| components.len()).sum());
    let (full, reduced) = (size(&context.model.dynamics.full), size(&context.model.dynamics.reduced));
    let point = context.point(&quote!(#scalar));
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
            type Constants<#scalar: #rt::Scalar> = #constants<#scalar>;
            #bases
            #methods
        }
    };
    (parametric, implementation)
}

//! The two-polar form.

mod pieces;
mod ratios;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::derive::TwoPolar;
use crate::ir::Program;
use crate::symbol::Symbol;

use super::body::Body;
use super::context::{Coefficients, Context};
use super::description;
use super::groups::groups;
use super::names::variant;
use super::number::number;
use super::pattern::{held, pattern};
use super::point::{own_spin, phase_point, wrapper};

/// The implementations of the lattice traits, where they were asked for.
pub(super) fn implementations(context: &Context) -> TokenStream {
    let Some(form) = &context.model.methods.two_polar else { return TokenStream::new() };
    let lattice = lattice(context, form);
    let conversions = conversions(context);
    let ratios = ratios::implementation(context, form);
    quote!(#lattice #conversions #ratios)
}

/// The lattice of U(n), which has no real phase points to convert to.
pub(super) fn lattice_of_circle(context: &Context) -> TokenStream {
    context.model.methods.two_polar.as_ref().map(|form| lattice(context, form)).unwrap_or_default()
}

fn lattice(context: &Context, form: &TwoPolar) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let state: Vec<Symbol> = form.state.iter().flat_map(|(_, names)| names.clone()).collect();
    let frames = form.frames.iter().flat_map(|(_, names)| names.clone());
    let framed: Vec<Symbol> = state.iter().cloned().chain(frames).collect();
    let (size, framed_size, constants) =
        (number(state.len()), number(framed.len()), number(form.couplings.len()));
    let description = description(context, form);
    let docs = docs(form);
    let function = |program: &Program, variables: &[Symbol]| {
        let used = program.inputs();
        let (couplings, _) = held(&form.couplings, &used, "couplings");
        let bound = pattern(variables, &used);
        let body = context.generic(program, Coefficients::Own);
        let lets = &body.lets;
        (quote!(#couplings let #bound = *state; #lets), body)
    };
    let (rates, Body { results: rate_results, .. }) = function(&form.rates, &state);
    let (framed_rates, Body { results: framed_results, .. }) = function(&form.framed, &framed);
    let energy = |program: &Program| {
        let (lets, body) = function(program, &state);
        let value = body.result();
        quote!(#lets #value)
    };
    let near = energy(&form.energy);
    let energy = match &form.energy_far_away {
        None => near,
        Some(program) => {
            let (far_away, n) = (energy(program), context.dim());
            quote!(if #rt::far_on_axes::<#n, Self, #t>(state) { #far_away } else { #near })
        }
    };
    let (_, couplings) = held(&form.couplings, &[], "couplings");
    let pieces = pieces::implementation(context, form, &framed);
    let items = quote! {
        const LATTICE: #rt::LatticeDescription = #description;
        type Places<#t: #rt::Scalar> = [#t; #size];
        type Framed<#t: #rt::Scalar> = [#t; #framed_size];
        type Couplings<#t: #rt::Scalar> = [#t; #constants];

        fn lattice_hamiltonian<#t: #rt::Real>(
            &self,
            #couplings: &Self::Couplings<#t>,
            state: &Self::Places<#t>,
        ) -> #t {
            #energy
        }

        #[inline]
        fn lattice_equations<#t: #rt::Scalar>(
            &self,
            #couplings: &Self::Couplings<#t>,
            state: &Self::Places<#t>,
        ) -> Self::Places<#t> {
            #rates
            [#(#rate_results),*]
        }

        #[inline]
        fn framed_equations<#t: #rt::Scalar>(
            &self,
            #couplings: &Self::Couplings<#t>,
            state: &Self::Framed<#t>,
        ) -> Self::Framed<#t> {
            #framed_rates
            [#(#framed_results),*]
        }
    };
    let form = context.implementation("LatticeForm", &items);
    quote!(#pieces #(#[doc = #docs])* #form)
}

fn conversions(context: &Context) -> TokenStream {
    let (rt, n) = (&context.names.rt, context.dim());
    let (frame, spin, wrap) = (context.frame(), own_spin(context), wrapper(context, context.model.frame));
    let f64 = quote!(#rt::f64);
    let centre = match context.model.translation {
        None => quote!(#rt::Pinned),
        Some(_) => {
            let zero = quote!(#rt::Vector::<#n>::zeros());
            quote!(#rt::Centre { x: #zero, p: #zero })
        }
    };
    let some = quote!(::core::option::Option::Some);
    let isotropic = match &context.model.point.isotropic {
        None => quote!(::core::option::Option::None),
        Some(program) => {
            let Body { lets, results } = context.double(program);
            let side = variant(context.model.frame);
            let [inverse_alpha, inverse_beta, inverse_mu] = &results[..] else { return TokenStream::new() };
            quote! {
                #lets
                #some(#rt::Isotropic {
                    inverse_alpha: #inverse_alpha,
                    inverse_beta: #inverse_beta,
                    inverse_mu: #inverse_mu,
                    side: #rt::MetricSide::#side,
                })
            }
        }
    };
    let point = phase_point(context, &quote!(#wrap(spin)), &centre);
    let items = quote! {
        fn lattice(&self, point: &Self::Point<#f64>) -> #rt::Result<#rt::Lattice<#n>> {
            #rt::lattice_of::<#n, #frame>(#rt::Phase::phi(point), &#spin, ::core::option::Option::None)
        }

        fn lattice_after(
            &self,
            point: &Self::Point<#f64>,
            before: &#rt::Lattice<#n>,
        ) -> #rt::Result<#rt::Lattice<#n>> {
            #rt::lattice_of::<#n, #frame>(#rt::Phase::phi(point), &#spin, #some(before))
        }

        fn at_lattice(&self, lattice: &#rt::Lattice<#n>) -> #rt::Result<Self::Point<#f64>> {
            let (phi, spin) = #rt::placement_and_spin::<#n, #frame>(lattice)?;
            #point
        }

        fn isotropic(&self) -> ::core::option::Option<#rt::Isotropic> {
            #isotropic
        }
    };
    context.implementation("TwoPolarForm", &items)
}

fn docs(form: &TwoPolar) -> Vec<String> {
    let mut lines = vec![
        format!("`{}`", form.formulas.0.text),
        String::new(),
        format!("Equations of the lattice, {}:", description::counts(form.rates.operations())),
        "```text".to_owned(),
    ];
    lines.extend(form.formulas.1.iter().map(|formula| formula.text.clone()));
    lines.push("```".to_owned());
    lines.into_iter().map(description::indented).collect()
}

fn description(context: &Context, form: &TwoPolar) -> TokenStream {
    let rt = &context.names.rt;
    let (hamiltonian, equations) = &form.formulas;
    let hamiltonian = description::formula(context, &hamiltonian.text, hamiltonian.latex.as_deref());
    let equations = equations.iter().map(|f| description::formula(context, &f.text, f.latex.as_deref()));
    let variables = variant(form.places);
    let potential = match (context.model.description.has_forces, form.dilatation_only) {
        (false, _) => format_ident!("None"),
        (true, true) => format_ident!("Dilatation"),
        (true, false) => format_ident!("Stretches"),
    };
    let state = groups(context, &form.state);
    let framed = groups(context, &[form.state.as_slice(), &form.frames].concat());
    let operations = description::operations(context, form.rates.operations());
    quote! {
        #rt::LatticeDescription {
            variables: #rt::Variables::#variables,
            potential: #rt::PotentialClass::#potential,
            hamiltonian: #hamiltonian,
            equations: &[#(#equations),*],
            state: #state,
            framed: #framed,
            operations: #operations,
        }
    }
}

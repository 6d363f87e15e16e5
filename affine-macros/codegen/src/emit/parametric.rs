//! A model with fields as a function of its coefficients: what energies, equations and reductions read is given to them.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::ir::Program;

use super::context::{Context, coefficient_index};
use super::number::number;

/// How a method begins that coefficients are given to.
pub(super) struct Evaluation {
    /// The name of the method.
    pub(super) name: Ident,
    /// Its parameter for coefficients; nothing for a model without fields.
    pub(super) parameter: Option<TokenStream>,
}

impl Evaluation {
    /// A method of this name in the model trait, which evaluates these programs.
    pub(super) fn of<'p>(
        context: &Context,
        name: &str,
        programs: impl IntoIterator<Item = &'p Program>,
    ) -> Self {
        let reads = |program: &Program| {
            let in_bases = context.has_prepared_bases() && calls_fields(program);
            in_bases || program.symbols().any(|symbol| coefficient_index(symbol).is_some())
        };
        Self::reading(context, name, programs.into_iter().any(reads))
    }

    /// The same of a method that takes points, which stand in the user's bases.
    pub(super) fn of_points<'p>(
        context: &Context,
        name: &str,
        programs: impl IntoIterator<Item = &'p Program>,
    ) -> Self {
        match context.has_prepared_bases() {
            true => Self::reading(context, name, true),
            false => Self::of(context, name, programs),
        }
    }

    /// A method of this name in the model trait, and whether it reads coefficients.
    pub(super) fn reading(context: &Context, name: &str, reads: bool) -> Self {
        if !context.has_fields {
            return Self { name: format_ident!("{name}"), parameter: None };
        }
        let (t, count) = (&context.names.scalar, number(context.coefficients()));
        let parameter = if reads { quote!(coefficients) } else { quote!(_coefficients) };
        Self { name: format_ident!("{name}_with"), parameter: Some(quote!(#parameter: &[#t; #count],)) }
    }
}

/// Methods of a model.
pub(super) enum Method {
    /// Coefficients are given to them, where the model has fields.
    Evaluation(TokenStream),
    /// They read none, or those that the model has.
    Other(TokenStream),
}

/// What a model with fields has of its coefficients, and the methods of every model.
pub(super) fn divided(
    context: &Context,
    methods: impl Iterator<Item = Method>,
) -> (TokenStream, TokenStream) {
    let (mut evaluations, mut others) = (TokenStream::new(), TokenStream::new());
    for method in methods {
        match method {
            Method::Evaluation(method) if context.has_fields => evaluations.extend(method),
            Method::Evaluation(method) | Method::Other(method) => others.extend(method),
        }
    }
    if !context.has_fields {
        return (TokenStream::new(), others);
    }
    let (prepared, rt, t) = (&context.names.prepared, &context.names.rt, &context.names.scalar);
    let (generics, types, clause) = context.generics();
    let (n, count) = (context.dim(), number(context.coefficients()));
    let implementation = quote! {
        impl #generics #rt::Parametric<#n> for #prepared #types #clause {
            type Coefficients<#t: #rt::Scalar> = [#t; #count];

            #[inline]
            fn coefficients<#t: #rt::Scalar>(&self) -> [#t; #count] {
                self.coefficients.map(|coefficient| #t::constant(coefficient, 0.0))
            }
            #evaluations
        }
    };
    let own = with_own(context);
    (implementation, quote!(#own #others))
}

/// The methods of the model trait, by those that coefficients are given to.
fn with_own(context: &Context) -> TokenStream {
    let (rt, t, n, inline) = (&context.names.rt, &context.names.scalar, context.dim(), context.inline());
    let own = quote!(::core::borrow::Borrow::borrow(&#t::of_doubles(&self.coefficients)));
    let power = context.model.point.power.is_some().then(|| {
        quote! {
            fn power<#t: #rt::Real>(&self, t: #t, point: &Self::Point<#t>) -> #t {
                #rt::Parametric::power_with(self, #own, t, point)
            }
        }
    });
    let flat = context.has_prepared_bases().then(|| {
        quote! {
            fn flatten<#t: #rt::Real>(&self, point: &Self::Point<#t>) -> Self::Full<#t> {
                #rt::Parametric::flatten_with(self, #own, point)
            }
            fn unflatten<#t: #rt::Real>(&self, full: &Self::Full<#t>) -> Self::Point<#t> {
                #rt::Parametric::unflatten_with(self, #own, full)
            }
        }
    });
    let reduced = asks_again(context).then(|| {
        quote! {
            #inline
            fn reduced_equations<#t: #rt::Scalar>(
                &self,
                t: #t,
                constants: &Self::Constants<#t>,
                reduced: &Self::Reduced<#t>,
            ) -> Self::Reduced<#t> {
                #rt::Parametric::reduced_equations_with(self, #own, t, constants, reduced)
            }
        }
    });
    quote! {
        fn velocity<#t: #rt::Real>(&self, point: &Self::Point<#t>) -> #rt::Velocity<#n, #t> {
            #rt::Parametric::velocity_with(self, #own, point)
        }
        fn kinetic_energy<#t: #rt::Real>(&self, phi: &#rt::Matrix<#n, #t>, velocity: &#rt::Velocity<#n, #t>) -> #t {
            #rt::Parametric::kinetic_energy_with(self, #own, phi, velocity)
        }
        fn hamiltonian<#t: #rt::Real>(&self, t: #t, point: &Self::Point<#t>) -> #t {
            #rt::Parametric::hamiltonian_with(self, #own, t, point)
        }
        #power
        #flat
        #inline
        fn hamilton_equations<#t: #rt::Scalar>(&self, t: #t, full: &Self::Full<#t>) -> Self::Full<#t> {
            #rt::Parametric::hamilton_equations_with(self, #own, t, full)
        }
        fn reduce<#t: #rt::Real>(
            &self,
            t0: #t,
            point: &Self::Point<#t>,
        ) -> (Self::Reduced<#t>, Self::Constants<#t>) {
            #rt::Parametric::reduce_with(self, #own, t0, point)
        }
        #reduced
        fn expand<#t: #rt::Real>(
            &self,
            t: #t,
            constants: &Self::Constants<#t>,
            reduced: &Self::Reduced<#t>,
        ) -> Self::Point<#t> {
            #rt::Parametric::expand_with(self, #own, t, constants, reduced)
        }
    }
}

/// Do reduced equations read coefficients, besides those of their trajectory? Fields that they call stand in the user's bases.
pub(super) fn asks_again(context: &Context) -> bool {
    context.has_prepared_bases() && calls_fields(&context.model.dynamics.reduced.program)
}

/// Does a program call fields of the user's?
pub(super) fn calls_fields(program: &Program) -> bool {
    program.calls.iter().any(|call| call.field().is_some())
}

/// Name and first parameter of the reduced equations.
pub(super) fn equations_head(context: &Context) -> (Ident, Option<TokenStream>) {
    if !asks_again(context) {
        return (format_ident!("reduced_equations"), None);
    }
    let Evaluation { name, parameter } = Evaluation::reading(context, "reduced_equations", true);
    (name, parameter)
}

//! The state `Psi, sigma/alpha` of a reduction that takes the dilatation out.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::DilatationalMotion;
use crate::symbol::{Quantity, Symbol};

use super::context::{Coefficients, Context};
use super::pattern::{entries, ident, identifiers, table, table_pattern};

/// `Psi`, the parts of `sigma/alpha` and the closed form of the dilatation at `point`.
pub(super) fn split(context: &Context, motion: DilatationalMotion) -> TokenStream {
    let rt = &context.names.rt;
    let n = context.model.dim;
    let used = [context.model.dynamics.reduced.symbols(), context.model.dynamics.fixed.clone()].concat();
    let psi = table_pattern(&entries(Quantity::IsochoricPlacement, n), &used);
    let parts = table_pattern(&shear_and_turn(n), &used);
    let (inverse_alpha, inverse_alpha_lets) = inverse_alpha(context);
    let dilatation = dilatation(context, motion);
    quote! {
        let phi = #rt::Phase::phi(point);
        let q = #rt::mean_log_stretch(phi);
        #dilatation
        let #psi = #rt::rows(&#rt::isochoric_part(phi));
        #inverse_alpha_lets
        let #parts = #rt::shear_and_turn(&momentum, #inverse_alpha);
    }
}

/// `phi = e^q Psi`.
pub(super) fn placement(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let rows = table(&entries(Quantity::IsochoricPlacement, context.model.dim));
    quote! {
        let (q, dilatational_momentum) = constants.dilatation.at(t);
        let phi = #rt::matrix(#rows) * #rt::Scalar::exp(q);
    }
}

/// `Sigma = alpha O + (p/n) 1`.
pub(super) fn momentum(context: &Context, fixed: &[Symbol]) -> TokenStream {
    let rt = &context.names.rt;
    let n = context.model.dim;
    let constants = (!fixed.is_empty()).then(|| {
        let names = identifiers(fixed);
        quote!(let [#(#names),*] = constants.fixed;)
    });
    let diagonal = |a: usize| ident(&Quantity::Shear.at([a, a]));
    let last = diagonal(n);
    let above = (1..n).map(diagonal);
    let rows = table(&shear_and_turn(n));
    let (inverse_alpha, inverse_alpha_lets) = inverse_alpha(context);
    quote! {
        #constants
        let #last = -(#(#above)+*);
        #inverse_alpha_lets
        let momentum = #rt::from_shear_and_turn(#rows, #inverse_alpha, dilatational_momentum);
    }
}

/// Symmetric part on and above the diagonal, skew part below it.
fn shear_and_turn(n: usize) -> Vec<Vec<Symbol>> {
    let name = |a: usize, b: usize| match a <= b {
        true => Quantity::Shear.at([a, b]),
        false => Quantity::Turn.at([b, a]),
    };
    (1..=n).map(|a| (1..=n).map(|b| name(a, b)).collect()).collect()
}

fn inverse_alpha(context: &Context) -> (TokenStream, TokenStream) {
    match &context.model.point.isotropic {
        Some(program) => {
            let body = context.generic(&program.only(&Quantity::InverseAlpha.into()), Coefficients::Given);
            (body.result(), body.lets)
        }
        None => (TokenStream::new(), TokenStream::new()),
    }
}

fn dilatation(context: &Context, motion: DilatationalMotion) -> TokenStream {
    let rt = &context.names.rt;
    let Some(program) = &context.model.dynamics.dilatation else { return TokenStream::new() };
    let body = context.generic(program, Coefficients::Given);
    let (lets, values) = (&body.lets, &body.results);
    let path = closed_form(motion);
    quote! {
        #lets
        let dilatation = #rt::Breathing::#path(t0, q, momentum.trace(), #(#values),*);
    }
}

/// The constructor of the closed form.
pub(super) fn closed_form(motion: DilatationalMotion) -> TokenStream {
    match motion {
        DilatationalMotion::Free => quote!(free),
        DilatationalMotion::Harmonic => quote!(harmonic),
        DilatationalMotion::Hyperbolic => quote!(hyperbolic),
    }
}

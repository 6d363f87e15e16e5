//! The state `Psi, sigma/alpha` of a reduction that takes the dilatation out.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::derive::DilatationalMotion;

use super::context::Context;
use super::pattern::{components, identifiers, pattern};

/// `Psi`, the parts of `sigma/alpha` and the closed form of the dilatation at `point`.
pub(super) fn split(context: &Context, motion: DilatationalMotion) -> TokenStream {
    let rt = &context.names.rt;
    let n = context.model.dim;
    let used = [context.model.reduced.names(), context.model.fixed.clone()].concat();
    let psi = components("psi", n).into_iter().map(|row| pattern(&row, &used));
    let parts = part_names(n).into_iter().map(|row| pattern(&row, &used));
    let (inverse_alpha, inverse_alpha_lets) = inverse_alpha(context);
    let dilatation = dilatation(context, motion);
    quote! {
        let phi = #rt::Phase::phi(point);
        let q = #rt::mean_log_stretch(phi);
        #dilatation
        let [#(#psi),*] = #rt::rows(&#rt::isochoric_part(phi));
        #inverse_alpha_lets
        let [#(#parts),*] = #rt::shear_and_turn(&momentum, #inverse_alpha);
    }
}

/// `phi = e^q Psi`.
pub(super) fn placement(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let rows = components("psi", context.model.dim).into_iter().map(|row| {
        let row = identifiers(&row);
        quote!([#(#row),*])
    });
    quote! {
        let (q, dilatational_momentum) = constants.dilatation.at(t);
        let phi = #rt::matrix([#(#rows),*]) * #rt::Scalar::exp(q);
    }
}

/// `Sigma = alpha O + (p/n) 1`.
pub(super) fn momentum(context: &Context, fixed: &[String]) -> TokenStream {
    let rt = &context.names.rt;
    let n = context.model.dim;
    let constants = (!fixed.is_empty()).then(|| {
        let names = identifiers(fixed);
        quote!(let [#(#names),*] = constants.fixed;)
    });
    let last = format_ident!("shear_{n}{n}");
    let above: Vec<Ident> = (1..n).map(|a| format_ident!("shear_{a}{a}")).collect();
    let rows = part_names(n).into_iter().map(|row| {
        let row = identifiers(&row);
        quote!([#(#row),*])
    });
    let (inverse_alpha, inverse_alpha_lets) = inverse_alpha(context);
    quote! {
        #constants
        let #last = -(#(#above)+*);
        #inverse_alpha_lets
        let momentum = #rt::from_shear_and_turn([#(#rows),*], #inverse_alpha, dilatational_momentum);
    }
}

/// Symmetric part on and above the diagonal, skew part below it.
fn part_names(n: usize) -> Vec<Vec<String>> {
    let name = |a: usize, b: usize| if a <= b { format!("shear_{a}{b}") } else { format!("turn_{b}{a}") };
    (1..=n).map(|a| (1..=n).map(|b| name(a, b)).collect()).collect()
}

fn inverse_alpha(context: &Context) -> (TokenStream, TokenStream) {
    match &context.model.isotropic {
        Some(program) => {
            let body = context.generic(&program.only("inverse_alpha"));
            (body.result(), body.lets)
        }
        None => (TokenStream::new(), TokenStream::new()),
    }
}

fn dilatation(context: &Context, motion: DilatationalMotion) -> TokenStream {
    let rt = &context.names.rt;
    let Some(program) = &context.model.dilatation else { return TokenStream::new() };
    let body = context.generic(program);
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

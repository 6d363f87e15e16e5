//! `emit(two_polar, splitting)`: the exact flows of the lattice's pieces.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::derive::{PieceProgram, TwoPolar};
use crate::emit::body::Body;
use crate::emit::context::{Coefficients, Context};
use crate::emit::names::variant;
use crate::emit::pattern::{bound, pattern};
use crate::emit::splitting::{added_at, as_factors, chosen, place};
use crate::symbol::{Quantity, Symbol};

/// The implementation of the capability over the state with frames, whose components are named.
pub(super) fn implementation(context: &Context, form: &TwoPolar, framed: &[Symbol]) -> TokenStream {
    let Some(pieces) = &form.pieces else { return TokenStream::new() };
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let names = pieces.list.iter().map(|piece| &piece.name);
    let nystrom = pieces.nystrom;
    let flows: Vec<TokenStream> =
        pieces.list.iter().map(|piece| flow(context, form, piece, framed)).collect();
    let chosen = chosen(&flows);
    let is_read = |symbol: &Symbol| pieces.list.iter().any(|piece| piece.program.inputs().contains(symbol));
    let couplings = if form.couplings.iter().any(is_read) { quote!(couplings) } else { quote!(_couplings) };
    let turning = turning(context);
    let items = quote! {
        const PIECES: &'static [&'static ::core::primitive::str] = &[#(#names),*];
        const NYSTROM: ::core::primitive::bool = #nystrom;
        #turning

        #[inline]
        fn lattice_flow<#t: #rt::Real>(
            &self,
            piece: #rt::usize,
            h: #t,
            #couplings: &Self::Couplings<#t>,
            state: &mut Self::Framed<#t>,
            carry: &mut Self::Framed<#t>,
        ) {
            #chosen
        }
    };
    context.implementation("LatticePieces", &items)
}

/// `1/mu` and the side of the rotation that is no piece.
fn turning(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let side = variant(context.model.frame);
    // On U(n) there is none, and no coefficient of it is computed.
    let program = match (&context.model.point.isotropic, &context.spec.group) {
        (Some(program), None) => program,
        _ => return TokenStream::new(),
    };
    let body = context.double(&program.only(&Quantity::InverseMu.into()));
    let (lets, inverse_mu) = (&body.lets, body.result());
    let f64 = quote!(#rt::f64);
    quote! {
        fn turning(&self) -> ::core::option::Option<(#f64, #rt::MetricSide)> {
            #lets
            ::core::option::Option::Some((#inverse_mu, #rt::MetricSide::#side))
        }
    }
}

fn flow(context: &Context, form: &TwoPolar, piece: &PieceProgram, framed: &[Symbol]) -> TokenStream {
    let rt = &context.names.rt;
    let used = piece.program.inputs();
    let (couplings, _) = bound(&form.couplings, &used, "couplings");
    let state = pattern(framed, &used);
    let Body { lets, results } = context.generic(&piece.program, Coefficients::Own);
    let (only, results) = as_factors(results);
    let place = |name: &Symbol| place(framed, name);
    let rises = piece.shifted.iter().zip(&results);
    let rises = rises.map(|(name, rate)| added_at(context, &place(name), quote!(h * #rate)));
    let angular = results.iter().skip(piece.shifted.len());
    let turns = piece.turned.iter().zip(angular).enumerate().map(|(k, (planes, angular))| {
        let rotation = format_ident!("rotation_{}", k + 1);
        let planes = planes.iter().map(|(z, y)| {
            let (z, y) = (place(z), place(y));
            quote!(#rt::turned(state, carry, (#z, #y), #rotation);)
        });
        quote! {
            let #rotation = #rt::rotation(h * #angular);
            #(#planes)*
        }
    });
    quote! {
        let #state = *state;
        #couplings
        #lets
        #only
        #(#rises)*
        #(#turns)*
    }
}

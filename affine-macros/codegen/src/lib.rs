//! Symbolic mechanics behind `#[affine_model(...)]`.
//!
//! The order of the modules is the order of the passes and of permission: the front half (`diagnostics`,
//! `spec`, `check`) never emits, the back half never fails. `algebra` and `ir` know neither Rust syntax nor
//! mechanics, `mechanics` never sees tokens, `emit` does no algebra.

pub mod diagnostics;

pub mod spec;

pub mod check;

pub mod lower;

pub mod algebra;

pub mod mechanics;

pub mod ir;

pub mod optimise;

pub mod derive;

pub mod emit;

pub mod stub;

use proc_macro2::TokenStream;

use diagnostics::{Rejected, gate};

/// The expansion of `#[affine_model(args)] item`: parse, gate, check, gate, derive, optimise, emit.
#[must_use]
pub fn expand(args: TokenStream, item: TokenStream) -> TokenStream {
    match model(args.clone(), item.clone()) {
        Ok(tokens) => tokens,
        Err(rejected) => stub::stub(args, &item, &rejected),
    }
}

fn model(args: TokenStream, item: TokenStream) -> Result<TokenStream, Rejected> {
    let spec = gate(|found| spec::parse(args, item, found))?;
    gate(|found| check::as_written(&spec, found))?;
    let energy = gate(|found| check::energy(&spec, found))?;
    // Past the second gate nothing can fail: a form that passed has an invertible Legendre transformation.
    let positive = spec.require.iter().any(|r| r.value == spec::Requirement::PositiveDefinite);
    let tokens = derive::derive(energy, positive).map(|model| emit::emit(&spec, &model.with(&spec.emit)));
    Ok(tokens.unwrap_or(spec.item.tokens))
}

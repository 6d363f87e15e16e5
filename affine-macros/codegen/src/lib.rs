//! Symbolic mechanics behind `#[affine_model(...)]`.
//!
//! The front half (`diagnostics`, `spec`, `check`) never emits, the back half never fails, but for the size of the numbers
//! that it derives (`range`). `algebra` and `ir` know neither Rust syntax nor mechanics, `mechanics` never sees tokens,
//! `emit` does no algebra. Which module may use which stands in `ARCHITECTURE.md`, and a test reads it.

pub mod symbol;

pub mod diagnostics;

pub mod spec;

pub mod check;

pub mod lower;

pub mod algebra;

pub mod mechanics;

pub mod ir;

pub mod optimise;

pub mod derive;

pub mod range;

pub mod emit;

pub mod stub;

use proc_macro2::{Span, TokenStream};

use algebra::fault;
use diagnostics::{FaultMistake, Rejected, gate};
use spec::{Capability, Spanned};

/// The expansion of `#[affine_model(args)] item`, of a refused model its reasons and a stand-in.
pub fn expand(args: TokenStream, item: TokenStream) -> TokenStream {
    expanded(args, item, &[])
}

/// The same where reports show the formulas of every model: in LaTeX, as `emit(latex)` asks for.
pub fn expand_for_reports(args: TokenStream, item: TokenStream) -> TokenStream {
    expanded(args, item, &[Capability::Latex])
}

fn expanded(args: TokenStream, item: TokenStream, besides: &[Capability]) -> TokenStream {
    match without_fault(|| road(args.clone(), item.clone(), besides)) {
        Ok(tokens) => tokens,
        Err(rejected) => stub::stub(args, &item, &rejected),
    }
}

/// The model of `#[affine_model(args)] item`: parse, gate, check, gate, derive, optimise, gate, emit.
///
/// # Errors
/// [`Rejected`] with the reasons, where the model is refused.
pub fn model(args: TokenStream, item: TokenStream) -> Result<TokenStream, Rejected> {
    without_fault(|| road(args, item, &[]))
}

/// What an expansion gives, unless what cannot happen happened on its way.
///
/// # Errors
/// [`Rejected`] with the reasons of the expansion, then with the fault, to which they may be due.
pub fn without_fault<T>(expansion: impl FnOnce() -> Result<T, Rejected>) -> Result<T, Rejected> {
    let (result, fault) = fault::watch(expansion);
    let told = gate(|found| match fault {
        None => Ok(()),
        Some(fault) => {
            let mistake = FaultMistake::Impossible { belief: fault.belief, place: fault.place() };
            Err(found.report(Span::call_site(), mistake))
        }
    });
    match (result, told) {
        (Err(own), Err(fault)) => Err(own.and(fault)),
        (result, told) => told.and(result),
    }
}

/// With what is emitted besides what the specification asks for.
fn road(args: TokenStream, item: TokenStream, besides: &[Capability]) -> Result<TokenStream, Rejected> {
    let mut spec = gate(|found| spec::parse(args, item, found))?;
    spec.emit.extend(besides.iter().map(|value| Spanned { value: *value, span: Span::call_site().into() }));
    gate(|found| check::as_written(&spec, found))?;
    let energy = gate(|found| check::energy(&spec, found))?;
    // Past the second gate no derivation can fail: a form that passed has an invertible Legendre transformation.
    let positive = spec.require.iter().any(|r| r.value == spec::Requirement::PositiveDefinite);
    let Some(model) = derive::derive(energy, positive) else { return Ok(spec.item.documented(&[])) };
    gate(|found| range::representable(&spec, &model, found))?;
    Ok(emit::emit(&spec, &model))
}

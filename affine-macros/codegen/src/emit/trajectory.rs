//! The coefficients that one trajectory has in emitted code: its constants as far as the reduced equations read them.

use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::pattern::{pattern, reads};

/// Names of the coefficients of a trajectory: `k_1`, `k_2`, ..
pub(super) fn coefficient_names(context: &Context) -> Vec<String> {
    (1..=context.model.trajectory.outputs.len()).map(|k| format!("k_{k}")).collect()
}

/// The statement that binds those of some inputs, and the name of the parameter that it takes them from.
pub(super) fn coefficients(context: &Context, used: &[impl AsRef<str>]) -> (TokenStream, TokenStream) {
    let names = coefficient_names(context);
    if !reads(used, &names) {
        return (TokenStream::new(), quote!(_constants));
    }
    let bound = pattern(&names, used);
    (quote!(let #bound = constants.coefficients;), quote!(constants))
}

//! The attribute `#[affine_model(...)]`: kinetic energies of affinely-rigid bodies turned into Hamilton equations.

use proc_macro::TokenStream;

/// States the kinetic energy of an affinely-rigid body and derives everything else.
#[proc_macro_attribute]
pub fn affine_model(args: TokenStream, item: TokenStream) -> TokenStream {
    affine_codegen::expand(args.into(), item.into()).into()
}

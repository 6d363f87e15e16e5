//! The attribute `#[affine_model(...)]`: kinetic energies of affinely-rigid bodies turned into Hamilton equations.

use proc_macro::TokenStream;

#[doc = include_str!("../docs/attribute.md")]
#[proc_macro_attribute]
pub fn affine_model(args: TokenStream, item: TokenStream) -> TokenStream {
    let expand = match cfg!(feature = "latex") {
        true => affine_codegen::expand_for_reports,
        false => affine_codegen::expand,
    };
    expand(args.into(), item.into()).into()
}

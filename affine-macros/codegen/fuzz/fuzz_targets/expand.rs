//! Whatever stands in the attribute and below it: items that parse, or errors, and no panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use proc_macro2::TokenStream;

/// The item below the attribute where the input names none.
const ITEM: &str = "pub struct Model { pub a: f64, pub b: f64 }";

fuzz_target!(|input: &str| {
    // The lexer keeps all source text it has seen.
    proc_macro2::extra::invalidate_current_thread_spans();
    let (args, item) = input.split_once('\n').unwrap_or((input, ITEM));
    let (Ok(args), Ok(item)) = (args.parse::<TokenStream>(), item.parse::<TokenStream>()) else { return };
    let expansion = affine_codegen::expand(args, item.clone());
    // What is no item itself is given back beside the error.
    if syn::parse2::<syn::File>(item).is_ok() {
        assert!(syn::parse2::<syn::File>(expansion).is_ok(), "the expansion is no list of items");
    }
});

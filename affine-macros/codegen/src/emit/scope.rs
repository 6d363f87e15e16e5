//! What surrounds a program in emitted code.

use proc_macro2::{Ident, Span, TokenStream};

use super::number::Number;
use crate::symbol::Symbol;

/// How a body names its surroundings.
pub(super) struct Scope<'a> {
    /// Type of the numbers.
    pub number: Number<'a>,
    /// Expression of an input.
    pub input: &'a dyn Fn(&Symbol) -> TokenStream,
    /// Have the fields that it calls other bases than its equations?
    pub rebased: bool,
    /// Where the specification names these fields.
    pub places: &'a [Span],
    /// The runtime's support module.
    pub rt: &'a Ident,
}

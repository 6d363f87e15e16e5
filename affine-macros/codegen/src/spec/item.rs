//! The struct below the attribute.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote};
use syn::{Attribute, Data, DeriveInput, Fields, Generics, Type};

use super::entries::{placed, shortened};
use crate::diagnostics::{Diagnostics, NotationMistake, Region, Reported};

/// The user's struct.
pub struct Item {
    /// The attributes below ours, documentation among them.
    attributes: Vec<Attribute>,
    /// The struct without them, as written.
    declaration: TokenStream,
    /// The visibility, of tokens of the attribute.
    pub visibility: TokenStream,
    /// The name.
    pub ident: Ident,
    /// The generics, with the where clause.
    pub generics: Generics,
    /// The named fields; none for a unit struct.
    pub fields: Vec<Field>,
    /// Is the model that is derived for it another than the user's? Then its formulas are not documented.
    pub stands_in: bool,
}

impl Item {
    /// The item that was read, of whose fields some are taken.
    pub(crate) fn new(mut input: DeriveInput, fields: Vec<Field>, stands_in: bool) -> Self {
        let attributes = std::mem::take(&mut input.attrs);
        let declaration = input.to_token_stream();
        let DeriveInput { vis, ident, generics, .. } = input;
        // Where a macro writes the struct, lints take what begins with a token of that macro for the user's own, and say of a
        // constructor that it is never called.
        let visibility = placed(vis.into_token_stream(), Span::call_site());
        Self { attributes, declaration, visibility, ident, generics, fields, stands_in }
    }

    /// The struct as written, with lines of documentation below its own.
    pub fn documented(&self, lines: &[String]) -> TokenStream {
        let Self { attributes, declaration, .. } = self;
        // An empty line: what the user wrote is a paragraph of its own.
        let lines = if self.stands_in { &[] } else { lines };
        let gap = (!lines.is_empty()).then(|| quote!(#[doc = ""]));
        quote!(#(#attributes)* #gap #(#[doc = #lines])* #declaration)
    }

    /// Attributes of what belongs to the struct: lints that the user allows there, and the use of a struct that is deprecated.
    pub fn allowed(&self) -> TokenStream {
        let allowed = self.attributes.iter().filter_map(|attribute| {
            let path = attribute.path();
            let is_allowed = || path.is_ident("allow").then(|| quote!(#attribute));
            path.is_ident("deprecated").then(|| quote!(#[allow(deprecated)])).or_else(is_allowed)
        });
        allowed.collect()
    }
}

/// A named field.
pub struct Field {
    /// The name.
    pub ident: Ident,
    /// The type.
    pub ty: Type,
    /// The place of the name.
    pub span: Region,
}

impl Field {
    /// Written as `f64`, also with its full path: what expressions may use. An alias cannot be seen through.
    pub fn is_real(&self) -> bool {
        matches!(written(&self.ty), Type::Path(path) if path.qself.is_none() && is_f64(&path.path))
    }
}

/// The type without parentheses, and without the invisible group in which a `macro_rules!` fragment arrives.
pub(super) fn written(mut ty: &Type) -> &Type {
    loop {
        match ty {
            Type::Group(group) => ty = &group.elem,
            Type::Paren(paren) => ty = &paren.elem,
            _ => return ty,
        }
    }
}

pub(super) fn is_f64(path: &syn::Path) -> bool {
    let path = path.to_token_stream().to_string().replace(' ', "");
    path == "f64" || ["core::primitive::f64", "std::primitive::f64"].contains(&path.trim_start_matches("::"))
}

pub(super) fn parse(item: TokenStream, found: &mut Diagnostics) -> Result<Item, Reported> {
    let input: DeriveInput = syn::parse2(item).map_err(|error| {
        found.report(error.span(), NotationMistake::UnreadableItem { problem: shortened(&error.to_string()) })
    })?;
    if let Some(again) = repeated(&input) {
        return Err(found.report(again.span(), NotationMistake::RepeatedAttribute));
    }
    let fields = match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Unit => Vec::new(),
            Fields::Named(named) => named.named.iter().cloned().filter_map(field).collect(),
            Fields::Unnamed(_) => return Err(refused(&input.ident, "a tuple struct", found)),
        },
        Data::Enum(_) => return Err(refused(&input.ident, "an enum", found)),
        Data::Union(_) => return Err(refused(&input.ident, "a union", found)),
    };
    Ok(Item::new(input, fields, false))
}

/// The name of our attribute below itself, with any path before it.
pub(crate) fn repeated(input: &DeriveInput) -> Option<&Ident> {
    let names = input.attrs.iter().filter_map(|attribute| Some(&attribute.path().segments.last()?.ident));
    names.into_iter().find(|name| *name == "affine_model")
}

fn field(field: syn::Field) -> Option<Field> {
    let ident = field.ident?;
    let span = ident.span().into();
    Some(Field { ident, ty: field.ty, span })
}

/// Parameters need names to be used in expressions, and one kinetic energy belongs to one type: no tuple
/// structs, no enums, no unions.
fn refused(name: &Ident, kind: &'static str, found: &mut Diagnostics) -> Reported {
    found.report(name.span(), NotationMistake::ItemKind { found: kind })
}

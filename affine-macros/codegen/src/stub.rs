//! What a refused model expands to: the reasons, and a stand-in that has what the user's code goes on to call.

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::quote;
use syn::{Data, DeriveInput};

use crate::diagnostics::{Rejected, gate};
use crate::spec::{self, Field, Item, Spec};
use crate::{check, derive, emit};

/// The user's item with the reasons for its refusal. Where the item can be read, it gets the methods of a
/// well-posed model of the same dimension, with translation, potential, capabilities and fields as written, so that its uses
/// raise no errors of their own.
pub fn stub(args: TokenStream, item: &TokenStream, rejected: &Rejected) -> TokenStream {
    let errors = rejected.compile_errors();
    let item = stand_in(args, item).unwrap_or_else(|| item.clone());
    quote!(#item #errors)
}

fn stand_in(args: TokenStream, item: &TokenStream) -> Option<TokenStream> {
    let input: DeriveInput = syn::parse2(item.clone()).ok()?;
    if spec::repeated(&input).is_some() {
        // The other one makes the model, or the stand-in.
        return None;
    }
    let outline = Outline::of(args)?;
    let field = parameter(&input.data, &outline);
    let mut spec = outline.well_posed(field.as_ref().map(|field| &field.ident))?;
    spec.item = Item::new(input, field.into_iter().collect(), true);
    let form = gate(|found| check::energy(&spec, found)).ok()?;
    Some(emit::emit(&spec, &derive::derive(form, false)?))
}

/// A field that coefficients name.
fn parameter(data: &Data, outline: &Outline) -> Option<Field> {
    let Data::Struct(data) = data else { return None };
    let named = data.fields.iter().filter_map(|field| {
        let ident = field.ident.clone()?;
        Some(Field { span: ident.span().into(), ident, ty: field.ty.clone() })
    });
    let coefficient = |field: &Field| field.is_real() && outline.names.contains(&field.ident);
    named.filter(coefficient).find(|field| field.ident != "n")
}

/// What brings methods and traits of its own, and goes with the energy of every stand-in.
const CAPABILITIES: [&str; 6] = ["splitting", "taylor", "tangent", "lanes", "two_polar", "metric"];

/// What can be told of a specification that may not parse.
struct Outline {
    dim: usize,
    potential: bool,
    names: Vec<Ident>,
    runtime: Option<syn::Path>,
}

impl Outline {
    /// `None` where the runtime is not known.
    fn of(args: TokenStream) -> Option<Self> {
        let dim = if value_of("dim", &args).to_string() == "2" { 2 } else { 3 };
        let runtime = value_of("crate", &args);
        let runtime = if runtime.is_empty() { None } else { Some(syn::parse2(runtime).ok()?) };
        let potential = !value_of("potential", &args).is_empty();
        let mut names = Vec::new();
        collect_names(args, &mut names);
        Some(Self { dim, potential, names, runtime })
    }

    /// A well-posed model that looks alike from outside.
    fn well_posed(&self, field: Option<&Ident>) -> Option<Spec> {
        let dim = proc_macro2::Literal::usize_unsuffixed(self.dim);
        let coefficient = field.map_or_else(|| quote!(1), |field| quote!(#field));
        let moving = self.names.iter().any(|name| name == "body_translation" || name == "space_translation");
        // The one that goes with every capability below.
        let translation = moving.then(|| quote!(, space_translation = 1));
        let potential = self.potential.then(|| quote!(, potential = q^2));
        let runtime = self.runtime.as_ref().map(|path| quote!(, crate = #path));
        let capabilities = CAPABILITIES.iter().filter_map(|key| self.names.iter().find(|name| name == key));
        let capabilities: Vec<&Ident> = capabilities.collect();
        let emit = (!capabilities.is_empty()).then(|| quote!(, emit(#(#capabilities),*)));
        let args =
            quote!(dim = #dim, kinetic(casimir2 = #coefficient #translation) #potential #emit #runtime);
        gate(|found| {
            spec::parse(
                args,
                quote!(
                    struct StandIn;
                ),
                found,
            )
        })
        .ok()
    }
}

/// What stands between `key =` and the next comma; nothing where the key is missing.
fn value_of(key: &str, args: &TokenStream) -> TokenStream {
    let is_key = |token: &TokenTree| matches!(token, TokenTree::Ident(name) if name == key);
    let is_comma = |token: &TokenTree| matches!(token, TokenTree::Punct(punct) if punct.as_char() == ',');
    args.clone()
        .into_iter()
        .skip_while(|token| !is_key(token))
        .skip(2)
        .take_while(|token| !is_comma(token))
        .collect()
}

fn collect_names(tokens: TokenStream, names: &mut Vec<Ident>) {
    for token in tokens {
        match token {
            TokenTree::Ident(name) => names.push(name),
            TokenTree::Group(group) => collect_names(group.stream(), names),
            _ => {}
        }
    }
}

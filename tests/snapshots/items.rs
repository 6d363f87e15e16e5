//! The items of an expansion: implementations and what they hold, structs and their fields.

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Expr, ImplItem, Item, Stmt};

/// An item, as what every model that has it calls it, and how long it is.
pub(crate) struct Emitted {
    /// `impl Model: fn reduce`, without dimensions, parameters and the name of the model.
    pub(crate) shape: String,
    /// Lines of its code, pretty-printed.
    pub(crate) lines: usize,
}

/// All items, those in the block of a `const _` among them.
pub(crate) fn all(file: &syn::File) -> Vec<Item> {
    let mut items = Vec::new();
    for item in &file.items {
        match item {
            Item::Const(constant) => {
                let Expr::Block(block) = &*constant.expr else { panic!("a constant without a block") };
                items.extend(block.block.stmts.iter().map(|statement| match statement {
                    Stmt::Item(item) => item.clone(),
                    _ => panic!("a statement between items"),
                }));
            }
            _ => items.push(item.clone()),
        }
    }
    items
}

/// The struct of the model is the first item.
fn model(file: &syn::File) -> String {
    match file.items.first() {
        Some(Item::Struct(model)) => model.ident.to_string(),
        _ => panic!("an expansion begins with the struct"),
    }
}

/// What every model of this shape is given.
pub(crate) fn of(file: &syn::File) -> Vec<Emitted> {
    let model = model(file);
    let rename = |name: String| name.replace(&model, "Model");
    let mut found = Vec::new();
    for item in all(file) {
        match item {
            Item::Impl(block) => {
                let of =
                    block.trait_.as_ref().map_or_else(String::new, |(path, ..)| format!(" {}", last(path)));
                let on = match &*block.self_ty {
                    syn::Type::Path(path) => rename(last(&path.path)),
                    other => other.to_token_stream().to_string(),
                };
                let head = match (of.as_str(), on.as_str()) {
                    (trait_, "Model") => format!("impl{trait_}"),
                    (trait_, on) => format!("impl{trait_} for {on}"),
                };
                let empty = syn::ItemImpl { items: Vec::new(), attrs: Vec::new(), ..block.clone() };
                let members = block.items.into_iter().map(|member| {
                    let name = member_name(&member);
                    let alone = syn::ItemImpl { items: vec![member], ..empty.clone() };
                    Emitted { shape: format!("{head}: {name}"), lines: lines(&Item::Impl(alone)) - 2 }
                });
                found.extend(members);
            }
            Item::Struct(item) => {
                let name = rename(item.ident.to_string());
                // What the user wrote is the user's.
                if name != "Model" {
                    let fields = item.fields.iter().filter_map(|field| field.ident.as_ref());
                    found.extend(
                        fields.map(|field| Emitted { shape: format!("struct {name}: {field}"), lines: 1 }),
                    );
                }
            }
            Item::Fn(item) => {
                let shape = format!("fn {}", item.sig.ident);
                found.push(Emitted { shape, lines: lines(&Item::Fn(item)) });
            }
            Item::Use(_) => {}
            other => found.push(Emitted { shape: first_words(&other), lines: lines(&other) }),
        }
    }
    found
}

/// The last segment of a path.
fn last(path: &syn::Path) -> String {
    path.segments.last().expect("a path").ident.to_string()
}

/// Keyword and name.
fn member_name(member: &ImplItem) -> String {
    match member {
        ImplItem::Fn(function) => format!("fn {}", function.sig.ident),
        ImplItem::Const(constant) => format!("const {}", constant.ident),
        ImplItem::Type(alias) => format!("type {}", alias.ident),
        _ => panic!("a member of another kind"),
    }
}

/// The first two tokens of an item that is neither a type nor an implementation.
fn first_words(item: &Item) -> String {
    let words: TokenStream = item.to_token_stream().into_iter().take(2).collect();
    words.to_string()
}

fn lines(item: &Item) -> usize {
    let file = syn::parse2(item.to_token_stream()).expect("an item");
    prettyplease::unparse(&file).lines().count()
}

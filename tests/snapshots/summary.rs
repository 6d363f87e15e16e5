//! What tells a model from others of the same shape: its documentation, its reduced equations, and how long each item is.

use std::fmt::Write;

use quote::ToTokens;
use syn::{Attribute, Expr, ExprStruct, FieldValue, ImplItem, Item, ItemImpl, Member, Stmt};

use crate::items;

/// The struct where it has fields, documentation, reduced equations, and lines of each item.
pub(crate) fn of(file: &syn::File) -> String {
    let blocks = items::all(file).into_iter().filter_map(|item| match item {
        Item::Impl(block) => Some(block),
        _ => None,
    });
    let described: String = blocks.map(|block| described(&block)).collect();
    assert!(!described.is_empty(), "a model is documented");
    let mut text = model(&file.items) + &described;
    let mut heads: Vec<(String, String)> = Vec::new();
    for item in items::of(file) {
        let (head, name) = item.shape.split_once(": ").unwrap_or(("free", &item.shape));
        let word =
            if head.starts_with("struct") { name.to_owned() } else { format!("{name} {}", item.lines) };
        match heads.iter_mut().find(|(known, _)| known == head) {
            Some((_, words)) => *words += &format!(", {word}"),
            None => heads.push((head.to_owned(), word)),
        }
    }
    for (head, words) in heads {
        writeln!(text, "{head}: {words}").expect("a string can be written");
    }
    text
}

/// The struct where it has fields, and its documentation.
fn model(items: &[Item]) -> String {
    let [Item::Struct(model), ..] = items else { return String::new() };
    let bare = syn::ItemStruct { attrs: Vec::new(), ..model.clone() };
    let file = syn::parse2(bare.to_token_stream()).expect("a struct");
    let fields = if model.fields.is_empty() { String::new() } else { prettyplease::unparse(&file) };
    // The gap is below what the user wrote.
    let gap = model.attrs.iter().position(|line| documentation(line).is_some_and(|line| line.is_empty()));
    fields + &documented(&model.attrs[gap.unwrap_or(0)..])
}

/// The lines of a documentation, the heading of what the description goes on with last.
fn documented(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter_map(documentation);
    let (heading, lines): (Vec<String>, Vec<String>) = lines
        .filter(|line| !line.is_empty() && !line.starts_with("```"))
        .partition(|line| line.ends_with("`DESCRIPTION.reduced_equations`."));
    lines.iter().chain(&heading).map(|line| format!("{line}\n")).collect()
}

/// The documentation of an implementation, and what the description of a model says besides.
fn described(block: &ItemImpl) -> String {
    let text = documented(&block.attrs);
    let constant = block.items.iter().find_map(|item| match item {
        ImplItem::Const(constant) if constant.ident == "DESCRIPTION" => Some(&constant.expr),
        _ => None,
    });
    text + &constant.map(|description| undocumented(literal(description))).unwrap_or_default()
}

/// What the documentation leaves to the description.
fn undocumented(description: &ExprStruct) -> String {
    let field = |name: &str| {
        let is_named = |field: &&FieldValue| matches!(&field.member, Member::Named(known) if known == name);
        // What is not said is empty.
        description.fields.iter().find(is_named).map(|field| elements(&field.expr)).unwrap_or_default()
    };
    let mut text = String::new();
    for equation in field("reduced_equations") {
        // Where they are Hamilton's equations, they are shared with these.
        let text_alone = equation.split('"').nth(1).unwrap_or(&equation);
        writeln!(text, "- {text_alone}").expect("a string can be written");
    }
    let facts = ["full", "reduced", "domain", "angles"].map(|name| {
        let values: Vec<String> = field(name)
            .iter()
            .map(|value| value.replace(' ', "").replace("rt::", "").replace("Group::new(Quantity::", "("))
            .collect();
        format!("{name}: {}", values.join(" "))
    });
    text + &facts.join(", ") + "\n"
}

/// The struct literal at the end of a block.
fn literal(expression: &Expr) -> &ExprStruct {
    match expression {
        Expr::Struct(literal) => literal,
        Expr::Block(block) => match block.block.stmts.last() {
            Some(Stmt::Expr(last, None)) => literal(last),
            _ => panic!("a block without a value"),
        },
        _ => panic!("neither a block nor a struct literal"),
    }
}

/// The elements of a slice, or the value itself.
fn elements(expression: &Expr) -> Vec<String> {
    match expression {
        Expr::Reference(reference) => elements(&reference.expr),
        Expr::Array(array) => {
            array.elems.iter().map(|element| element.to_token_stream().to_string()).collect()
        }
        other => vec![other.to_token_stream().to_string()],
    }
}

fn documentation(attribute: &Attribute) -> Option<String> {
    let pair = attribute.meta.require_name_value().ok().filter(|pair| pair.path.is_ident("doc"))?;
    let Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(line), .. }) = &pair.value else { return None };
    Some(line.value().trim().to_owned())
}

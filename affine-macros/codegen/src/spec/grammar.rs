//! The arguments of the attribute.

use proc_macro2::{Group, Span, TokenStream, TokenTree};
use syn::parse::Parser;

use super::custom::{self, Custom, SelfGravity, Summand};
use super::entries::{Body, Entry, List, Piece, describe, shortened, unwrapped};
use super::expression_parser::{self, Language};
use super::item::Item;
use super::keys::{Key, Keyword, Side};
use super::momentum_side::{self, MomentumKind};
use super::names::{Claim, Named, nearest};
use super::spanned::Spanned;
use super::statement::{Metric, Potential, Spec, Symmetry, Term};
use super::value;
use crate::diagnostics::{Diagnostics, Meant, NotationMistake, Reported};
use crate::symbol::TermKind;

/// The specification of an item.
pub(super) fn parse(
    args: TokenStream,
    item: Result<Item, Reported>,
    found: &mut Diagnostics,
) -> Result<Spec, Reported> {
    let here = Span::call_site();
    let entries: Vec<Entry<Key>> = List { name: "affine_model", found }.entries(args, here, &[]);
    let (mut dim, mut symmetry, mut kinetic, mut runtime) = (None, None, None, None);
    let (mut hamiltonian, mut potential, mut metrics) = (None, None, [None, None]);
    let (mut require, mut emit) = (Vec::new(), Vec::new());
    let (mut constraint, mut group) = (None, None);
    let (mut dissipation, mut customs, mut self_gravity) = (Vec::new(), Vec::new(), Vec::new());
    for entry in entries {
        let at = entry.at;
        match entry.key {
            Key::Dim => dim = Some(dimension(expect_value(entry, found), found)),
            Key::Symmetry => symmetry = sides(expect_list(entry, found), at, found),
            Key::Kinetic => {
                let list = expect_list(entry, found);
                let terms = terms::<_, MomentumKind>(("kinetic", TermKind::example), list, at, found);
                kinetic = Some((at, terms));
            }
            Key::Hamiltonian => {
                let list = expect_list(entry, found);
                let terms = terms::<_, TermKind>(("hamiltonian", momentum_side::example), list, at, found);
                hamiltonian = Some((at, terms));
            }
            Key::Metrics => metrics = both_metrics(expect_list(entry, found), found),
            Key::Constraint => {
                let piece = expect_value(entry, found).ok();
                constraint = piece.and_then(|piece| member("constraint", piece, found));
            }
            Key::Potential => {
                let parts = (&mut customs, &mut self_gravity);
                potential = energy(expect_value(entry, found), at, parts, found);
            }
            Key::Forces => forces(expect_value(entry, found), &mut customs, found),
            Key::Dissipation => {
                let list = expect_list(entry, found);
                let terms = terms::<_, MomentumKind>(("dissipation", TermKind::example), list, at, found);
                dissipation = terms.map_or_else(|_| Vec::new(), |terms| terms.value);
            }
            Key::Group => {
                let piece = expect_value(entry, found).ok();
                group = piece.and_then(|piece| member("group", piece, found));
            }
            Key::Require => require = members("requirement", expect_list(entry, found), found),
            Key::Emit => emit = members("capability", expect_list(entry, found), found),
            Key::Crate => runtime = path(expect_value(entry, found), found),
        }
    }
    let dim = dim.unwrap_or_else(|| Err(missing(Key::Dim, "the dimension of space and body", here, found)));
    let stated = match (kinetic, hamiltonian) {
        (None, None) => Err(missing(Key::Kinetic, "the kinetic energy", here, found)),
        (Some((_, terms)), None) => terms.map(|terms| (terms.value, None, terms.span)),
        (None, Some((_, terms))) => terms.map(|terms| (Vec::new(), Some(terms.value), terms.span)),
        (Some(_), Some((at, _))) => Err(found.report(at, NotationMistake::TwoStatements)),
    };
    let (item, dim, (kinetic, hamiltonian, kinetic_key)) = (item?, dim?, stated?);
    Ok(Spec {
        item,
        dim,
        symmetry,
        kinetic,
        hamiltonian,
        kinetic_key,
        metrics,
        constraint,
        group,
        potential,
        customs,
        self_gravity,
        dissipation,
        require,
        emit,
        runtime,
    })
}

fn missing(key: Key, states: &'static str, at: Span, found: &mut Diagnostics) -> Reported {
    found.report(at, NotationMistake::MissingKey { key: key.name(), states, example: key.example() })
}

/// The value of an entry; a missing one is reported, with how the entry may look.
fn expected<K: Keyword>(entry: Entry<K>, example: &str, found: &mut Diagnostics) -> Result<Piece, Reported> {
    match entry.body {
        Body::Value(piece) if !piece.tokens.is_empty() => Ok(piece),
        Body::Refused(reported) => Err(reported),
        _ => {
            let (key, example) = (entry.key.name(), example.to_owned());
            Err(found.report(entry.at, NotationMistake::ExpectedValue { key, example }))
        }
    }
}

/// The same of a key of the attribute.
fn expect_value(entry: Entry<Key>, found: &mut Diagnostics) -> Result<Piece, Reported> {
    let example = entry.key.example();
    expected(entry, example, found)
}

/// The list of an entry; a missing or empty one is reported.
fn expect_list(entry: Entry<Key>, found: &mut Diagnostics) -> Result<Group, Reported> {
    let (key, example) = (entry.key.name(), entry.key.example());
    match entry.body {
        // An empty sum is a model without kinetic energy, which a rule of its own refuses.
        Body::List(group) if !group.stream().is_empty() || entry.key == Key::Kinetic => Ok(group),
        Body::Refused(reported) => Err(reported),
        Body::List(_) => Err(found.report(entry.at, NotationMistake::EmptyList { key, example })),
        _ => Err(found.report(entry.at, NotationMistake::ExpectedList { key, example })),
    }
}

/// `dim`: any whole number here, so that the rule about 2 and 3 has one place.
fn dimension(piece: Result<Piece, Reported>, found: &mut Diagnostics) -> Result<Spanned<usize>, Reported> {
    let Piece { tokens, at } = piece?;
    let text = unwrapped(tokens).into_iter().collect::<TokenStream>().to_string();
    match text.parse() {
        Ok(value) => Ok(Spanned { value, span: at }),
        Err(_) => Err(found.report(at, NotationMistake::Dimension { found: shortened(&text) })),
    }
}

/// `symmetry(...)`; an omitted side claims nothing.
fn sides(list: Result<Group, Reported>, key: Span, found: &mut Diagnostics) -> Option<Symmetry> {
    let list = list.ok()?;
    let unclaimed = Spanned { value: Claim::None, span: key.into() };
    let mut symmetry = Symmetry { space: unclaimed, body: unclaimed };
    for entry in (List { name: "symmetry", found }).entries(list.stream(), list.span_close(), &[]) {
        let (side, example) = match entry.key {
            Side::Space => (&mut symmetry.space, "space = affine"),
            Side::Body => (&mut symmetry.body, "body = metric"),
        };
        let claim = expected(entry, example, found).ok().and_then(|piece| member("claim", piece, found));
        *side = claim.unwrap_or(*side);
    }
    Some(symmetry)
}

/// `kinetic(...)`, `hamiltonian(...)` and `dissipation(...)`, with the values that terms may have; `Other` are those of the other
/// side.
fn terms<K: Keyword, Other: Named>(
    (name, example): (&'static str, fn(K) -> &'static str),
    list: Result<Group, Reported>,
    key: Span,
    found: &mut Diagnostics,
) -> Result<Spanned<Vec<Term<K>>>, Reported> {
    let list = list?;
    let mut elsewhere = Other::names();
    elsewhere.retain(|name| K::named(name).is_none());
    let mut terms = Vec::new();
    let entries = List { name, found }.entries::<K>(list.stream(), list.span_close(), &elsewhere);
    for entry in entries {
        let kind = Spanned { value: entry.key, span: entry.at.into() };
        let example = format!("{} = {}", entry.key.name(), example(entry.key));
        let Ok(piece) = expected(entry, &example, found) else { continue };
        let span = piece.at;
        if let Ok(value) = value::parse(piece, found) {
            terms.push(Term { kind, value, span });
        }
    }
    Ok(Spanned { value: terms, span: key.into() })
}

/// `metrics(...)`; an omitted side is the identity.
fn both_metrics(list: Result<Group, Reported>, found: &mut Diagnostics) -> [Option<Metric>; 2] {
    let mut metrics = [None, None];
    let Ok(list) = list else { return metrics };
    for entry in (List { name: "metrics", found }).entries(list.stream(), list.span_close(), &[]) {
        let (place, example) = match entry.key {
            Side::Space => (0, "space = diag(1, 1, 2)"),
            Side::Body => (1, "body = [[2, 1, 0], [1, 2, 0], [0, 0, 1]]"),
        };
        let side = entry.key.name();
        let Ok(piece) = expected(entry, example, found) else { continue };
        let span = piece.at;
        metrics[place] = value::parse(piece, found).ok().map(|value| Metric { side, value, span });
    }
    metrics
}

/// `potential = ...`.
fn energy(
    piece: Result<Piece, Reported>,
    key: Span,
    (customs, self_gravity): (&mut Vec<Custom>, &mut Vec<SelfGravity>),
    found: &mut Diagnostics,
) -> Option<Potential> {
    let (summands, rest) = custom::taken(piece.ok()?, custom::Place::Potential, found);
    for summand in summands {
        match summand {
            Summand::Field(custom) => customs.push(custom),
            Summand::SelfGravity(gravity) => self_gravity.push(gravity),
        }
    }
    let Piece { tokens, at } = rest?;
    let energy = expression_parser::parse(tokens, at, Language::Potential(&[]), found).ok()?;
    Some(Potential { key: key.into(), energy, span: at })
}

/// `forces = ...`.
fn forces(piece: Result<Piece, Reported>, customs: &mut Vec<Custom>, found: &mut Diagnostics) {
    let Ok(piece) = piece else { return };
    let (summands, rest) = custom::taken(piece, custom::Place::Forces, found);
    customs.extend(summands.into_iter().filter_map(|summand| match summand {
        Summand::Field(custom) => Some(custom),
        Summand::SelfGravity(_) => None,
    }));
    custom::only(rest, custom::Place::Forces, found);
}

/// `require(...)` and `emit(...)`: names and nothing else.
fn members<T: Named + PartialEq>(
    role: &'static str,
    list: Result<Group, Reported>,
    found: &mut Diagnostics,
) -> Vec<Spanned<T>> {
    let Ok(list) = list else { return Vec::new() };
    let mut members: Vec<Spanned<T>> = Vec::new();
    let name = if role == "capability" { Key::Emit.name() } else { Key::Require.name() };
    for Piece { tokens, at } in (List { name, found }).items(list.stream(), list.span_close()) {
        if let [TokenTree::Ident(first), second @ TokenTree::Ident(_), ..] = tokens.as_slice()
            && T::named(&first.to_string()).is_some()
        {
            List { name, found }.malformed(second, Meant::Unclear);
            continue;
        }
        let Some(member) = member::<T>(role, Piece { tokens, at }, found) else { continue };
        if members.iter().any(|earlier| earlier.value == member.value) {
            found.report(at, NotationMistake::RepeatedKey { list: name, key: member.value.name() });
        } else {
            members.push(member);
        }
    }
    members
}

/// One name out of a closed set.
fn member<T: Named>(role: &'static str, piece: Piece, found: &mut Diagnostics) -> Option<Spanned<T>> {
    let Piece { tokens, at } = piece;
    let tokens = unwrapped(tokens);
    if let [TokenTree::Ident(name)] = tokens.as_slice()
        && let Some(value) = T::named(&name.to_string())
    {
        return Some(Spanned { value, span: at });
    }
    let written = match tokens.as_slice() {
        [one] => describe(one).trim_matches('`').to_owned(),
        _ => shortened(&tokens.into_iter().collect::<TokenStream>().to_string()),
    };
    let nearest = nearest(&written, T::names());
    found.report(at, NotationMistake::UnknownName { role, found: written, nearest, known: T::names() });
    None
}

/// `crate = path`.
fn path(piece: Result<Piece, Reported>, found: &mut Diagnostics) -> Option<syn::Path> {
    let Piece { tokens, at } = piece.ok()?;
    let tokens: TokenStream = unwrapped(tokens).into_iter().collect();
    match syn::Path::parse_mod_style.parse2(tokens.clone()) {
        Ok(path) => Some(path),
        Err(_) => {
            found.report(at, NotationMistake::RuntimePath { found: shortened(&tokens.to_string()) });
            None
        }
    }
}

//! The arguments of the attribute.

use proc_macro2::{Group, Ident, Span, TokenStream, TokenTree};
use syn::parse::Parser;

use super::custom::{self, Custom, SelfGravity, Summand};
use super::entries::{Body, Entry, Piece, describe, entries, items, malformed, shortened, unwrapped};
use super::expression_parser::{self, Language};
use super::item::Item;
use super::keys::{Key, Keyword, Side};
use super::momentum_side::{self, MomentumKind};
use super::names::{Claim, Named, nearest};
use super::spanned::Spanned;
use super::statement::{Metric, Potential, Spec, Symmetry, Term};
use super::value;
use crate::diagnostics::{Diagnostics, Meant, NotationMistake, Region, Reported};
use crate::symbol::TermKind;

/// Terms that `hamiltonian(...)` has, and `kinetic(...)` and `dissipation(...)` have not.
const MOMENTUM_TERMS: [&str; 3] = ["vorticity_squared", "spin_squared", "casimir3"];

/// Terms that `kinetic(...)` has and `hamiltonian(...)` has not.
const VELOCITY_TERMS: [&str; 6] =
    ["body_inertia", "space_inertia", "dalembert", "body_tensor", "space_tensor", "flat_tensor"];

/// The specification of an item.
pub(super) fn parse(
    args: TokenStream,
    item: Result<Item, Reported>,
    found: &mut Diagnostics,
) -> Result<Spec, Reported> {
    let here = Span::call_site();
    let entries: Vec<Entry<Key>> = entries("affine_model", args, here, &[], found);
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
                kinetic = Some((at, terms(KINETIC, expect_list(entry, found), at, found)));
            }
            Key::Hamiltonian => {
                hamiltonian = Some((at, terms(HAMILTONIAN, expect_list(entry, found), at, found)));
            }
            Key::Metrics => metrics = both_metrics(expect_list(entry, found), found),
            Key::Constraint => {
                let piece = expect_value(entry, found).ok();
                constraint = piece.and_then(|Piece { tokens, at }| member("constraint", tokens, at, found));
            }
            Key::Potential => {
                let parts = (&mut customs, &mut self_gravity);
                potential = energy(expect_value(entry, found), at, parts, found);
            }
            Key::Forces => forces(expect_value(entry, found), &mut customs, found),
            Key::Dissipation => {
                let terms = terms(DISSIPATION, expect_list(entry, found), at, found);
                dissipation = terms.map_or_else(|_| Vec::new(), |terms| terms.value);
            }
            Key::Group => {
                group = expect_value(entry, found)
                    .ok()
                    .and_then(|Piece { tokens, at }| member("group", tokens, at, found));
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

/// The value of an entry; a missing one is reported.
fn expect_value(entry: Entry<Key>, found: &mut Diagnostics) -> Result<Piece, Reported> {
    match entry.body {
        Body::Value(piece) if !piece.tokens.is_empty() => Ok(piece),
        Body::Refused(reported) => Err(reported),
        _ => {
            let mistake = NotationMistake::ExpectedValue {
                key: entry.key.name(),
                example: entry.key.example().to_owned(),
            };
            Err(found.report(entry.at, mistake))
        }
    }
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
    for entry in entries::<Side>("symmetry", list.stream(), list.span_close(), &[], found) {
        let claim = claim(&entry, found);
        match (entry.key, claim) {
            (Side::Space, Some(claim)) => symmetry.space = claim,
            (Side::Body, Some(claim)) => symmetry.body = claim,
            (_, None) => {}
        }
    }
    Some(symmetry)
}

fn claim(entry: &Entry<Side>, found: &mut Diagnostics) -> Option<Spanned<Claim>> {
    let piece = match &entry.body {
        Body::Value(piece) if !piece.tokens.is_empty() => piece,
        Body::Refused(_) => return None,
        _ => {
            let (key, example) = match entry.key {
                Side::Space => ("space", "space = affine"),
                Side::Body => ("body", "body = metric"),
            };
            found.report(entry.at, NotationMistake::ExpectedValue { key, example: example.to_owned() });
            return None;
        }
    };
    member("claim", piece.tokens.clone(), piece.at, found)
}

/// A list of terms: its key, the terms that belong to the other side, and a value that a term may have.
struct TermList<K> {
    name: &'static str,
    elsewhere: &'static [&'static str],
    example: fn(K) -> &'static str,
}

const KINETIC: TermList<TermKind> =
    TermList { name: "kinetic", elsewhere: &MOMENTUM_TERMS, example: TermKind::example };
const HAMILTONIAN: TermList<MomentumKind> =
    TermList { name: "hamiltonian", elsewhere: &VELOCITY_TERMS, example: momentum_side::example };
const DISSIPATION: TermList<TermKind> = TermList { name: "dissipation", ..KINETIC };

/// `kinetic(...)`, `hamiltonian(...)` and `dissipation(...)`.
fn terms<K: Keyword>(
    side: TermList<K>,
    list: Result<Group, Reported>,
    key: Span,
    found: &mut Diagnostics,
) -> Result<Spanned<Vec<Term<K>>>, Reported> {
    let list = list?;
    let mut terms = Vec::new();
    for entry in entries::<K>(side.name, list.stream(), list.span_close(), side.elsewhere, found) {
        let kind = Spanned { value: entry.key, span: entry.at.into() };
        match entry.body {
            Body::Value(piece) if !piece.tokens.is_empty() => {
                let span = piece.at;
                if let Ok(value) = value::parse(piece, found) {
                    terms.push(Term { kind, value, span });
                }
            }
            Body::Refused(_) => {}
            _ => {
                let mistake = NotationMistake::ExpectedValue {
                    key: entry.key.name(),
                    example: format!("{} = {}", entry.key.name(), (side.example)(entry.key)),
                };
                found.report(entry.at, mistake);
            }
        }
    }
    Ok(Spanned { value: terms, span: key.into() })
}

/// `metrics(...)`; an omitted side is the identity.
fn both_metrics(list: Result<Group, Reported>, found: &mut Diagnostics) -> [Option<Metric>; 2] {
    let mut metrics = [None, None];
    let Ok(list) = list else { return metrics };
    for entry in entries::<Side>("metrics", list.stream(), list.span_close(), &[], found) {
        let (place, example) = match entry.key {
            Side::Space => (0, "space = diag(1, 1, 2)"),
            Side::Body => (1, "body = [[2, 1, 0], [1, 2, 0], [0, 0, 1]]"),
        };
        let side = entry.key.name();
        match entry.body {
            Body::Value(piece) if !piece.tokens.is_empty() => {
                let span = piece.at;
                metrics[place] = value::parse(piece, found).ok().map(|value| Metric { side, value, span });
            }
            Body::Refused(_) => {}
            _ => {
                found.report(
                    entry.at,
                    NotationMistake::ExpectedValue { key: side, example: example.to_owned() },
                );
            }
        }
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
    for Piece { tokens, at } in items(name, list.stream(), list.span_close(), found) {
        if let [TokenTree::Ident(first), second @ TokenTree::Ident(_), ..] = tokens.as_slice()
            && T::named(&first.to_string()).is_some()
        {
            malformed(name, second, Meant::Unclear, found);
            continue;
        }
        let Some(member) = member::<T>(role, tokens, at, found) else { continue };
        if members.iter().any(|earlier| earlier.value == member.value) {
            found.report(at, NotationMistake::RepeatedKey { list: name, key: member.value.name() });
        } else {
            members.push(member);
        }
    }
    members
}

/// One name out of a closed set.
fn member<T: Named>(
    role: &'static str,
    tokens: Vec<TokenTree>,
    at: Region,
    found: &mut Diagnostics,
) -> Option<Spanned<T>> {
    let tokens = unwrapped(tokens);
    let name: Option<&Ident> = match tokens.as_slice() {
        [TokenTree::Ident(name)] => Some(name),
        _ => None,
    };
    if let Some(value) = name.and_then(|name| T::named(&name.to_string())) {
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

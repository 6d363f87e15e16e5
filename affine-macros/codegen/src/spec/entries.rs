//! Comma-separated lists of names, `key = value` and `key(...)`.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};

use super::names::{Named, nearest};
use crate::diagnostics::{Diagnostics, NotationMistake, Region, Reported};

/// The tokens between two commas.
pub(super) struct Piece {
    pub(super) tokens: Vec<TokenTree>,
    /// The tokens, or the comma or bracket that follows where there are none.
    pub(super) at: Region,
}

/// An item of a list that begins with a known name.
pub(super) struct Entry<K> {
    pub(super) key: K,
    pub(super) at: Span,
    pub(super) body: Body,
}

/// What follows the name of an entry.
pub(super) enum Body {
    Nothing,
    Value(Piece),
    List(Group),
    /// Refused already; kept so that its key does not count as missing.
    Refused(Reported),
}

/// From the first to the last token.
pub(super) fn extent(tokens: &TokenStream) -> Option<Region> {
    region(&tokens.clone().into_iter().collect::<Vec<_>>())
}

pub(super) fn region(tokens: &[TokenTree]) -> Option<Region> {
    Some(Region { start: tokens.first()?.span(), end: tokens.last()?.span() })
}

/// The pieces between top-level commas; a comma at the end adds none. `end` is what closes the list.
pub(super) fn pieces(tokens: TokenStream, end: Span) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut open = Vec::new();
    let mut close = |tokens: Vec<TokenTree>, end: Span| {
        let at = region(&tokens).unwrap_or_else(|| end.into());
        pieces.push(Piece { tokens, at });
    };
    for token in tokens {
        match token {
            TokenTree::Punct(punct) if punct.as_char() == ',' => {
                close(std::mem::take(&mut open), punct.span())
            }
            token => open.push(token),
        }
    }
    if !open.is_empty() {
        close(open, end);
    }
    pieces
}

/// A token in a message; brackets are not spelled out.
pub(super) fn describe(token: &TokenTree) -> String {
    match token {
        TokenTree::Group(group) => match group.delimiter() {
            Delimiter::Parenthesis => "`(...)`".to_owned(),
            Delimiter::Bracket => "`[...]`".to_owned(),
            Delimiter::Brace => "`{...}`".to_owned(),
            Delimiter::None => "a macro's fragment".to_owned(),
        },
        token => format!("`{}`", shortened(&token.to_string())),
    }
}

/// A text in a message, cut where it is long.
pub(super) fn shortened(text: &str) -> String {
    const LONGEST: usize = 60;
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    text.chars().take(LONGEST).chain("...".chars()).collect()
}

/// Tokens that a `macro_rules!` fragment wraps in an invisible group, without it.
pub(super) fn unwrapped(mut tokens: Vec<TokenTree>) -> Vec<TokenTree> {
    while let [TokenTree::Group(group)] = tokens.as_slice()
        && group.delimiter() == Delimiter::None
    {
        tokens = group.stream().into_iter().collect();
    }
    tokens
}

/// The entries of a list whose keys are the names of `K`; `elsewhere` are the terms of the other side. Whatever is not an
/// entry with a known key, or repeats one, is reported; where the key meant is plain, a refused entry stands for it.
pub(super) fn entries<K: Named + PartialEq>(
    list: &'static str,
    tokens: TokenStream,
    end: Span,
    elsewhere: &[&'static str],
    found: &mut Diagnostics,
) -> Vec<Entry<K>> {
    let mut entries: Vec<Entry<K>> = Vec::new();
    for piece in pieces(tokens, end)
        .into_iter()
        .flat_map(|piece| separated::<K>(list, piece, found))
        .collect::<Vec<_>>()
    {
        let Some(entry) = entry(list, piece, elsewhere, found) else { continue };
        match entries.iter_mut().find(|earlier: &&mut Entry<K>| earlier.key == entry.key) {
            None => entries.push(entry),
            Some(earlier) if matches!(earlier.body, Body::Refused(_)) => *earlier = entry,
            Some(_) if matches!(entry.body, Body::Refused(_)) => {}
            Some(_) => {
                found.report(entry.at, NotationMistake::RepeatedKey { list, key: entry.key.name() });
            }
        }
    }
    entries
}

/// The items of a piece in which a comma is missing: the next known key, with `=` or a list after it, stands where an
/// operator or the end should.
fn separated<K: Named>(list: &'static str, piece: Piece, found: &mut Diagnostics) -> Vec<Piece> {
    let tokens = unwrapped(piece.tokens);
    let begins = |i: usize| {
        let follows = !matches!(tokens[i - 1], TokenTree::Punct(_));
        let named = matches!(&tokens[i], TokenTree::Ident(name) if K::named(&name.to_string()).is_some());
        let stated = match tokens.get(i + 1) {
            Some(TokenTree::Punct(punct)) => punct.as_char() == '=',
            Some(TokenTree::Group(group)) => group.delimiter() == Delimiter::Parenthesis,
            _ => false,
        };
        follows && named && stated
    };
    let starts: Vec<usize> = (1..tokens.len()).filter(|i| begins(*i)).collect();
    for start in &starts {
        malformed(list, &tokens[*start], found);
    }
    let ends = starts.iter().copied().chain([tokens.len()]);
    let parts = [0].into_iter().chain(starts.iter().copied()).zip(ends);
    parts
        .map(|(start, end)| {
            let tokens = tokens[start..end].to_vec();
            let at = region(&tokens).unwrap_or(piece.at);
            Piece { tokens, at }
        })
        .collect()
}

fn entry<K: Named>(
    list: &'static str,
    piece: Piece,
    elsewhere: &[&'static str],
    found: &mut Diagnostics,
) -> Option<Entry<K>> {
    let mut tokens = unwrapped(piece.tokens).into_iter();
    let name = match tokens.next() {
        Some(TokenTree::Ident(name)) => name,
        other => {
            let (at, text) = match &other {
                Some(token) => (token.span().into(), describe(token)),
                None => (piece.at, "a comma".to_owned()),
            };
            found.report(at, NotationMistake::ExpectedKey { list, found: text });
            return None;
        }
    };
    let at = name.span();
    match K::named(&name.to_string()) {
        Some(key) => Some(Entry { key, at, body: body(list, tokens, found) }),
        None => {
            let (meant, reported) = unknown(list, &name, elsewhere, found);
            meant.map(|key| Entry { key, at, body: Body::Refused(reported) })
        }
    }
}

/// What follows the name of an entry.
fn body(list: &'static str, mut tokens: impl Iterator<Item = TokenTree>, found: &mut Diagnostics) -> Body {
    let body = match tokens.next() {
        None => Body::Nothing,
        Some(TokenTree::Punct(equals)) if equals.as_char() == '=' => {
            let tokens: Vec<TokenTree> = tokens.by_ref().collect();
            let at = region(&tokens).unwrap_or_else(|| equals.span().into());
            Body::Value(Piece { tokens, at })
        }
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis => Body::List(group),
        Some(other) => return Body::Refused(malformed(list, &other, found)),
    };
    match tokens.next() {
        None => body,
        Some(extra) => Body::Refused(malformed(list, &extra, found)),
    }
}

fn malformed(list: &'static str, token: &TokenTree, found: &mut Diagnostics) -> Reported {
    found.report(token.span(), NotationMistake::MalformedItem { list, found: describe(token) })
}

/// Reports a name that is no key. A term of the other side is told apart from a slip; for a slip, the key probably
/// meant.
fn unknown<K: Named>(
    list: &'static str,
    name: &Ident,
    elsewhere: &[&'static str],
    found: &mut Diagnostics,
) -> (Option<K>, Reported) {
    let text = name.to_string();
    if let Some(key) = elsewhere.iter().find(|key| **key == text) {
        let mistake = match list {
            "hamiltonian" => NotationMistake::OtherSide { list, key, other: "kinetic" },
            _ => NotationMistake::OtherSide { list, key, other: "hamiltonian" },
        };
        return (None, found.report(name.span(), mistake));
    }
    let nearest = nearest(&text, K::names());
    let mistake = NotationMistake::UnknownKey { list, nearest, found: shortened(&text), known: K::names() };
    (nearest.and_then(K::named), found.report(name.span(), mistake))
}

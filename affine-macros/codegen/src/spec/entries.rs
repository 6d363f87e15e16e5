//! Comma-separated lists of names, `key = value` and `key(...)`.

use proc_macro2::{Delimiter, Group, Ident, Punct, Spacing, Span, TokenStream, TokenTree};

use super::keys::Keyword;
use super::names::{Named, nearest};
use crate::diagnostics::{Diagnostics, Meant, NotationMistake, Region, Reported};

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

/// The items of a list, which a semicolon separates as well, once it is reported.
pub(super) fn items(
    list: &'static str,
    tokens: TokenStream,
    end: Span,
    found: &mut Diagnostics,
) -> Vec<Piece> {
    let with_comma = |token: TokenTree| {
        if !is_punct(&token, ';') {
            return token;
        }
        malformed(list, &token, Meant::Comma, found);
        let mut comma = Punct::new(',', Spacing::Alone);
        comma.set_span(token.span());
        comma.into()
    };
    pieces(tokens.into_iter().map(with_comma).collect(), end)
}

fn is_punct(token: &TokenTree, symbol: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == symbol)
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

/// The tokens at another place.
pub(super) fn placed(tokens: TokenStream, at: Span) -> TokenStream {
    tokens
        .into_iter()
        .map(|mut token| {
            if let TokenTree::Group(group) = &token {
                token = Group::new(group.delimiter(), placed(group.stream(), at)).into();
            }
            token.set_span(at);
            token
        })
        .collect()
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
pub(super) fn entries<K: Keyword>(
    list: &'static str,
    tokens: TokenStream,
    end: Span,
    elsewhere: &[&'static str],
    found: &mut Diagnostics,
) -> Vec<Entry<K>> {
    let mut entries: Vec<Entry<K>> = Vec::new();
    for piece in items(list, tokens, end, found)
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
        malformed(list, &tokens[*start], Meant::Unclear, found);
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

fn entry<K: Keyword>(
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
        Some(key) => Some(Entry { key, at, body: body(list, key, tokens, found) }),
        None => {
            let (meant, reported) = unknown(list, &name, elsewhere, found);
            meant.map(|key| Entry { key, at, body: Body::Refused(reported) })
        }
    }
}

/// What follows the name of an entry.
fn body<K: Keyword>(
    list: &'static str,
    key: K,
    mut tokens: impl Iterator<Item = TokenTree>,
    found: &mut Diagnostics,
) -> Body {
    let body = match tokens.next() {
        None => Body::Nothing,
        Some(TokenTree::Punct(equals)) if equals.as_char() == '=' => {
            let tokens: Vec<TokenTree> = tokens.by_ref().collect();
            let at = region(&tokens).unwrap_or_else(|| equals.span().into());
            Body::Value(Piece { tokens, at })
        }
        Some(TokenTree::Group(group)) if may_be_list(key, &group) => Body::List(group),
        Some(other) => {
            return Body::Refused(malformed(list, &other, meant(key, &other, tokens.next()), found));
        }
    };
    match tokens.next() {
        None => body,
        Some(extra) => Body::Refused(malformed(list, &extra, Meant::Unclear, found)),
    }
}

/// Round brackets; and braces after a key that takes a value, which both lack.
fn may_be_list<K: Keyword>(key: K, group: &Group) -> bool {
    match group.delimiter() {
        Delimiter::Parenthesis => true,
        Delimiter::Brace => !key.takes_list(),
        Delimiter::Bracket | Delimiter::None => false,
    }
}

/// What is meant by a token that stands directly after a key, before another.
fn meant<K: Keyword>(key: K, token: &TokenTree, next: Option<TokenTree>) -> Meant {
    match token {
        _ if is_punct(token, ':') => match next {
            Some(TokenTree::Group(_)) if key.takes_list() => Meant::Nothing,
            _ => Meant::Equals,
        },
        TokenTree::Group(_) if key.takes_list() => Meant::RoundBrackets,
        _ => Meant::Unclear,
    }
}

/// Reports a token that does not belong to its item.
pub(super) fn malformed(
    list: &'static str,
    token: &TokenTree,
    meant: Meant,
    found: &mut Diagnostics,
) -> Reported {
    found.report(token.span(), NotationMistake::MalformedItem { list, found: describe(token), meant })
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

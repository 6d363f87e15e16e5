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

/// A list that is read: its name, and where mistakes in it are reported.
pub(super) struct List<'a> {
    pub(super) name: &'static str,
    pub(super) found: &'a mut Diagnostics,
}

impl List<'_> {
    /// The items of the list, which a semicolon separates as well, once it is reported.
    pub(super) fn items(&mut self, tokens: TokenStream, end: Span) -> Vec<Piece> {
        let with_comma = |token: TokenTree| {
            if !is_punct(&token, ';') {
                return token;
            }
            self.malformed(&token, Meant::Comma);
            let mut comma = Punct::new(',', Spacing::Alone);
            comma.set_span(token.span());
            comma.into()
        };
        pieces(tokens.into_iter().map(with_comma).collect(), end)
    }

    /// The entries of the list, whose keys are the names of `K`; `elsewhere` are the terms of the other side. Whatever is not an
    /// entry with a known key, or repeats one, is reported; where the key meant is plain, a refused entry stands for it.
    pub(super) fn entries<K: Keyword>(
        mut self,
        tokens: TokenStream,
        end: Span,
        elsewhere: &[&'static str],
    ) -> Vec<Entry<K>> {
        let mut entries: Vec<Entry<K>> = Vec::new();
        let items = self.items(tokens, end).into_iter();
        let pieces: Vec<Piece> = items.flat_map(|piece| self.separated::<K>(piece)).collect();
        for piece in pieces {
            let Some(entry) = self.entry(piece, elsewhere) else { continue };
            match entries.iter_mut().find(|earlier: &&mut Entry<K>| earlier.key == entry.key) {
                None => entries.push(entry),
                Some(earlier) if matches!(earlier.body, Body::Refused(_)) => *earlier = entry,
                Some(_) if matches!(entry.body, Body::Refused(_)) => {}
                Some(_) => {
                    let mistake = NotationMistake::RepeatedKey { list: self.name, key: entry.key.name() };
                    self.found.report(entry.at, mistake);
                }
            }
        }
        entries
    }

    /// The items of a piece in which a comma is missing: the next known key, with `=` or a list after it, stands where an
    /// operator or the end should.
    fn separated<K: Named>(&mut self, piece: Piece) -> Vec<Piece> {
        let tokens = unwrapped(piece.tokens);
        let begins = |i: &usize| {
            let follows = !matches!(tokens[i - 1], TokenTree::Punct(_));
            let named =
                matches!(&tokens[*i], TokenTree::Ident(name) if K::named(&name.to_string()).is_some());
            let stated = match tokens.get(i + 1) {
                Some(TokenTree::Punct(punct)) => punct.as_char() == '=',
                Some(TokenTree::Group(group)) => group.delimiter() == Delimiter::Parenthesis,
                _ => false,
            };
            follows && named && stated
        };
        let mut ends: Vec<usize> = (1..tokens.len()).filter(begins).collect();
        for start in &ends {
            self.malformed(&tokens[*start], Meant::Unclear);
        }
        ends.push(tokens.len());
        let mut start = 0;
        let part = |end| {
            let tokens = tokens[std::mem::replace(&mut start, end)..end].to_vec();
            let at = region(&tokens).unwrap_or(piece.at);
            Piece { tokens, at }
        };
        ends.into_iter().map(part).collect()
    }

    fn entry<K: Keyword>(&mut self, piece: Piece, elsewhere: &[&'static str]) -> Option<Entry<K>> {
        let mut tokens = unwrapped(piece.tokens).into_iter();
        let name = match tokens.next() {
            Some(TokenTree::Ident(name)) => name,
            other => {
                let (at, found) = match &other {
                    Some(token) => (token.span().into(), describe(token)),
                    None => (piece.at, "a comma".to_owned()),
                };
                self.found.report(at, NotationMistake::ExpectedKey { list: self.name, found });
                return None;
            }
        };
        let at = name.span();
        match K::named(&name.to_string()) {
            Some(key) => Some(Entry { key, at, body: self.body(key, tokens) }),
            None => {
                let (meant, reported) = self.unknown(&name, elsewhere);
                meant.map(|key| Entry { key, at, body: Body::Refused(reported) })
            }
        }
    }

    /// What follows the name of an entry.
    fn body<K: Keyword>(&mut self, key: K, mut tokens: impl Iterator<Item = TokenTree>) -> Body {
        let body = match tokens.next() {
            None => Body::Nothing,
            Some(TokenTree::Punct(equals)) if equals.as_char() == '=' => {
                let tokens: Vec<TokenTree> = tokens.by_ref().collect();
                let at = region(&tokens).unwrap_or_else(|| equals.span().into());
                Body::Value(Piece { tokens, at })
            }
            Some(TokenTree::Group(group)) if may_be_list(key, &group) => Body::List(group),
            Some(other) => return Body::Refused(self.malformed(&other, meant(key, &other, tokens.next()))),
        };
        match tokens.next() {
            None => body,
            Some(extra) => Body::Refused(self.malformed(&extra, Meant::Unclear)),
        }
    }

    /// Reports a token that does not belong to its item.
    pub(super) fn malformed(&mut self, token: &TokenTree, meant: Meant) -> Reported {
        let mistake = NotationMistake::MalformedItem { list: self.name, found: describe(token), meant };
        self.found.report(token.span(), mistake)
    }

    /// Reports a name that is no key. A term of the other side is told apart from a slip; for a slip, the key probably
    /// meant.
    fn unknown<K: Named>(&mut self, name: &Ident, elsewhere: &[&'static str]) -> (Option<K>, Reported) {
        let (list, text) = (self.name, name.to_string());
        if let Some(key) = elsewhere.iter().find(|key| **key == text) {
            let other = if list == "hamiltonian" { "kinetic" } else { "hamiltonian" };
            return (None, self.found.report(name.span(), NotationMistake::OtherSide { list, key, other }));
        }
        let nearest = nearest(&text, K::names());
        let mistake =
            NotationMistake::UnknownKey { list, nearest, found: shortened(&text), known: K::names() };
        (nearest.and_then(K::named), self.found.report(name.span(), mistake))
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

//! The paths in a source file.

use std::str::FromStr;

use proc_macro2::{Delimiter, LexError, TokenStream, TokenTree};

/// What a source file says of modules.
#[derive(Debug, Default)]
pub(crate) struct Source {
    /// The modules that it declares in files of their own.
    pub(crate) children: Vec<String>,
    /// What it imports, under the names that it gives it.
    pub(crate) imports: Vec<Import>,
    /// The paths that it uses, from `crate`, `self`, `super` or a child. What it only passes on is not used.
    pub(crate) paths: Vec<Vec<String>>,
}

/// One name of a `use` item.
#[derive(Debug)]
pub(crate) struct Import {
    pub(crate) name: String,
    pub(crate) path: Vec<String>,
}

impl Source {
    pub(crate) fn of(text: &str) -> Result<Self, LexError> {
        let mut source = Self::default();
        let tokens: Vec<TokenTree> = TokenStream::from_str(text)?.into_iter().collect();
        source.declared(&tokens);
        source.walk(&tokens, 0);
        Ok(source)
    }

    /// The modules in files of their own, before any path is read.
    fn declared(&mut self, tokens: &[TokenTree]) {
        for (k, window) in tokens.windows(3).enumerate() {
            if is_word(&window[0], "mod") && is_sign(&window[2], ';') && !is_test(&tokens[..k]) {
                self.children.extend(word(&window[1]));
            }
        }
    }

    /// Reads tokens within so many modules of the file itself.
    fn walk(&mut self, tokens: &[TokenTree], inline: usize) {
        let mut k = 0;
        while k < tokens.len() {
            if is_word(&tokens[k], "mod")
                && let Some(TokenTree::Group(group)) = tokens.get(k + 2)
            {
                if !is_test(&tokens[..k]) {
                    self.walk(&list(group.stream()), inline + 1);
                }
                k += 3;
            } else if is_word(&tokens[k], "use") && starts_an_item(tokens, k) {
                let end =
                    tokens[k..].iter().position(|token| is_sign(token, ';')).map_or(tokens.len(), |n| k + n);
                self.used(&tokens[k + 1..end], is_public(&tokens[..k]), inline);
                k = end + 1;
            } else if let TokenTree::Group(group) = &tokens[k] {
                self.walk(&list(group.stream()), inline);
                k += 1;
            } else {
                k += self.path(&tokens[k..], &tokens[..k], inline);
            }
        }
    }

    /// A path that starts here, if one does; how many tokens it takes.
    fn path(&mut self, tokens: &[TokenTree], before: &[TokenTree], inline: usize) -> usize {
        let Some(first) = word(&tokens[0]) else { return 1 };
        let starts = ["crate", "self", "super"].contains(&first.as_str()) || self.children.contains(&first);
        let goes_on = match before {
            [.., one, two] if is_sign(two, ':') => is_sign(one, ':'),
            [.., last] => is_sign(last, '.') || is_sign(last, '#'),
            [] => false,
        };
        if !starts || goes_on {
            return 1;
        }
        let mut path = vec![first];
        let mut taken = 1;
        while let [TokenTree::Punct(one), TokenTree::Punct(two), next, ..] = &tokens[taken..]
            && (one.as_char(), two.as_char()) == (':', ':')
            && let Some(name) = word(next)
        {
            path.push(name);
            taken += 3;
        }
        if path.len() > 1 {
            self.paths.extend(outside(path, inline));
        }
        taken
    }

    /// A `use` item.
    fn used(&mut self, tokens: &[TokenTree], is_public: bool, inline: usize) {
        for (path, name) in leaves(tokens, &[]) {
            let Some(path) = outside(path, inline) else { continue };
            if !is_public {
                self.paths.push(path.clone());
            }
            if inline == 0 {
                self.imports.push(Import { name, path });
            }
        }
    }
}

/// A path as it reads outside of so many modules of the file itself; `None` of what stays within these.
fn outside(mut path: Vec<String>, inline: usize) -> Option<Vec<String>> {
    for _ in 0..inline {
        match path.first().map(String::as_str) {
            Some("super") => {
                path.remove(0);
            }
            Some("crate") => break,
            _ => return None,
        }
    }
    if inline > 0 && path.first().is_some_and(|name| !["crate", "super"].contains(&name.as_str())) {
        path.insert(0, "self".to_owned());
    }
    (!path.is_empty()).then_some(path)
}

/// The paths of a tree of imports with the names that they get; of `*` the module.
fn leaves(tokens: &[TokenTree], before: &[String]) -> Vec<(Vec<String>, String)> {
    let mut path = before.to_vec();
    let mut k = 0;
    while k < tokens.len() {
        match &tokens[k] {
            TokenTree::Ident(name) if name == "as" => {
                let alias = tokens.get(k + 1).and_then(word).unwrap_or_default();
                return vec![(path, alias)];
            }
            TokenTree::Ident(name) => path.push(name.to_string()),
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                let inner = list(group.stream());
                let parts = inner.split(|token| is_sign(token, ','));
                return parts.filter(|part| !part.is_empty()).flat_map(|part| leaves(part, &path)).collect();
            }
            _ => {}
        }
        k += 1;
    }
    // `charts::{self}` is `charts`.
    if path.len() > 1 && path.last().is_some_and(|name| name == "self") {
        path.pop();
    }
    let name = path.last().cloned().unwrap_or_default();
    vec![(path, name)]
}

fn list(stream: TokenStream) -> Vec<TokenTree> {
    stream.into_iter().collect()
}

fn word(token: &TokenTree) -> Option<String> {
    match token {
        TokenTree::Ident(name) => Some(name.to_string()),
        _ => None,
    }
}

fn is_word(token: &TokenTree, wanted: &str) -> bool {
    matches!(token, TokenTree::Ident(name) if name == wanted)
}

fn is_sign(token: &TokenTree, wanted: char) -> bool {
    matches!(token, TokenTree::Punct(sign) if sign.as_char() == wanted)
}

/// Is `use` the first word of an item, and no part of another?
fn starts_an_item(tokens: &[TokenTree], k: usize) -> bool {
    tokens[k + 1..].iter().any(|token| is_sign(token, ';'))
}

/// Is what follows these tokens passed on?
fn is_public(before: &[TokenTree]) -> bool {
    match before {
        [.., last] if is_word(last, "pub") => true,
        [.., word, TokenTree::Group(group)] => {
            is_word(word, "pub") && group.delimiter() == Delimiter::Parenthesis
        }
        _ => false,
    }
}

/// Is what follows these tokens compiled for tests alone?
fn is_test(before: &[TokenTree]) -> bool {
    let attribute = before.iter().rev().find_map(|token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket => {
            Some(Some(group.stream().to_string()))
        }
        TokenTree::Punct(sign) if sign.as_char() == ';' => Some(None),
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(None),
        _ => None,
    });
    attribute.flatten().is_some_and(|text| text.replace(' ', "").starts_with("cfg(test"))
}

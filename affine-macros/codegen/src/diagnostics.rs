//! Everything the macro can refuse, and the only way out for a refusal.
//!
//! A pass gets a [`Diagnostics`] bag from [`gate`] and nowhere else, so no bag can be filled and forgotten.
//! [`Diagnostics::report`] returns a [`Reported`], which only it can make: a pass that gives up can prove that
//! it said why.

mod capability;
mod constraint;
mod expression;
mod fault;
mod force;
mod form;
mod kind;
mod message;
mod metric;
mod names;
mod notation;
mod potential;
mod term;
mod together;

use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

pub use capability::CapabilityMistake;
pub use constraint::ConstraintMistake;
pub use expression::ExpressionMistake;
pub use fault::FaultMistake;
pub use force::ForceMistake;
pub use form::{Directions, FormMistake};
pub use kind::Diagnostic;
pub use metric::MetricMistake;
pub use notation::{Meant, NotationMistake};
pub use potential::{PotentialMistake, TracedPart};
pub use term::TermMistake;
pub use together::TogetherMistake;

/// A stretch of the user's source, from the first to the last token.
///
/// Two spans, because stable Rust joins spans only where an error is shown: the compiler underlines from the
/// first token of an expansion to its last.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    /// The first token.
    pub start: Span,
    /// The last token.
    pub end: Span,
}

impl Region {
    /// From the start of one region to the end of another.
    pub fn to(self, last: impl Into<Region>) -> Self {
        Self { start: self.start, end: last.into().end }
    }
}

impl From<Span> for Region {
    fn from(span: Span) -> Self {
        Self { start: span, end: span }
    }
}

/// Proof that a diagnostic was reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reported(());

/// The mistakes that one pass finds.
pub struct Diagnostics {
    found: Vec<(Region, Diagnostic)>,
}

impl Diagnostics {
    /// Records a mistake; the pass goes on and may find more.
    pub fn report(&mut self, at: impl Into<Region>, mistake: impl Into<Diagnostic>) -> Reported {
        self.found.push((at.into(), mistake.into()));
        Reported(())
    }

    /// `Err` once anything was reported: for the end of a pass, and before a rule that relies on earlier ones.
    ///
    /// # Errors
    /// [`Reported`] if the bag is not empty.
    pub fn verdict(&self) -> Result<(), Reported> {
        if self.found.is_empty() { Ok(()) } else { Err(Reported(())) }
    }
}

/// Runs a pass and lets its result through only if it reported nothing.
///
/// # Errors
/// [`Rejected`] with everything the pass reported.
pub fn gate<T>(pass: impl FnOnce(&mut Diagnostics) -> Result<T, Reported>) -> Result<T, Rejected> {
    let mut bag = Diagnostics { found: Vec::new() };
    match pass(&mut bag) {
        Ok(value) if bag.found.is_empty() => Ok(value),
        _ => Err(Rejected { found: bag.found }),
    }
}

/// A model that was refused, with every reason.
#[derive(Debug)]
#[must_use]
pub struct Rejected {
    found: Vec<(Region, Diagnostic)>,
}

impl Rejected {
    /// The reasons, in the order in which they were found.
    pub fn diagnostics(&self) -> impl Iterator<Item = &Diagnostic> {
        self.found.iter().map(|(_, diagnostic)| diagnostic)
    }

    /// These reasons, and those of another refusal after them.
    pub fn and(mut self, other: Self) -> Self {
        self.found.extend(other.found);
        self
    }

    /// One `::core::compile_error! { "..." }` for each reason, where the mistake is.
    pub fn compile_errors(&self) -> TokenStream {
        self.found.iter().flat_map(|(at, diagnostic)| compile_error(*at, &diagnostic.to_string())).collect()
    }
}

fn compile_error(at: Region, message: &str) -> [TokenTree; 8] {
    let punct = |symbol, spacing| {
        let mut punct = Punct::new(symbol, spacing);
        punct.set_span(at.start);
        TokenTree::Punct(punct)
    };
    let ident = |name| TokenTree::Ident(Ident::new(name, at.start));
    let mut text = Literal::string(message);
    text.set_span(at.end);
    let mut body = Group::new(Delimiter::Brace, TokenTree::Literal(text).into());
    body.set_span(at.end);
    [
        punct(':', Spacing::Joint),
        punct(':', Spacing::Alone),
        ident("core"),
        punct(':', Spacing::Joint),
        punct(':', Spacing::Alone),
        ident("compile_error"),
        punct('!', Spacing::Alone),
        TokenTree::Group(body),
    ]
}

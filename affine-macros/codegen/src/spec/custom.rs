//! Summands that are no formulas: `custom(field, ..)`, a field whose type computes a potential or a force, and
//! `self_gravity(k)`.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenTree};

use super::entries::{Piece, pieces, region, shortened, unwrapped};
use super::expression::Expression;
use super::expression_parser::{self, Language};
use super::names::{Named, named, set_of_names};
use super::spanned::Spanned;
use crate::diagnostics::{Diagnostics, ForceMistake, PotentialMistake, Region};

/// The energy of a homogeneous ellipsoid in its own gravity, by name.
pub(super) const SELF_GRAVITY: &str = "self_gravity";

/// A field that computes a potential or a force.
#[derive(Clone, Debug)]
pub struct Custom {
    /// The field.
    pub field: Ident,
    /// What it computes.
    pub role: Spanned<Role>,
    /// What more is said of it.
    pub mark: Option<Mark>,
    /// `custom(...)`.
    pub span: Region,
}

/// A summand `self_gravity(k)`: `-3/5 k R_F(Q_1^2, Q_2^2, Q_3^2)`, the energy of a homogeneous ellipsoid in its own gravity.
#[derive(Clone, Debug)]
pub struct SelfGravity {
    /// `k = G m^2/r`, with the mass and the radius of the ball at `phi = 1`.
    pub strength: Expression,
    /// `self_gravity(k)`.
    pub span: Region,
}

set_of_names! {
    /// What a field computes.
    pub enum Role {
        /// The force `Q` on `Sigma`.
        Spatial = "spatial",
        /// The force `Q_hat` on `Sigma_hat`.
        Comoving = "comoving",
        /// The force `Q_tr` on `p`.
        Translation = "translation",
        /// A potential with `U(A phi B) = U(phi)` for all rotations `A`, `B`.
        Isotropic = "isotropic",
        /// A potential that is a function of `G = phi^T phi`.
        Green = "green",
        /// A potential that is a function of `Ct = phi phi^T`.
        Finger = "finger",
        /// Any other potential.
        General = "general",
    }
}

set_of_names! {
    /// What may be said of what a field computes.
    pub enum Mark {
        /// A force that has no power.
        Gyroscopic = "gyroscopic",
        /// A potential that depends on `x`; a force that depends on the time, `x` and `phi` alone.
        Position = "position",
    }
}

impl Role {
    /// A force rather than a potential?
    pub fn is_force(self) -> bool {
        matches!(self, Self::Spatial | Self::Comoving | Self::Translation)
    }
}

/// Which key `custom(...)` stands in.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Potential,
    Forces,
}

impl Place {
    /// How it may look, of a field.
    fn example(self, field: Option<&Ident>) -> String {
        let (name, role) = match self {
            Self::Potential => ("gravity", "isotropic"),
            Self::Forces => ("wind", "spatial"),
        };
        format!("custom({}, {role})", field.map_or_else(|| name.to_owned(), Ident::to_string))
    }

    fn takes(self) -> &'static str {
        match self {
            Self::Potential => {
                "the class of the potential, `isotropic`, `green` (a function of G), `finger` (of Ct) or `general`, \
                 and `position` where it depends on x"
            }
            Self::Forces => {
                "the form of the force, `spatial` (Q), `comoving` (Q_hat) or `translation` (Q_tr), and `gyroscopic` \
                 where it has no power or `position` where it depends on no velocity"
            }
        }
    }

    /// What may be said beside the role.
    fn takes_mark(self, mark: Mark) -> bool {
        self == Self::Forces || mark == Mark::Position
    }
}

/// A summand that is no formula.
pub(super) enum Summand {
    /// `custom(...)`.
    Field(Custom),
    /// `self_gravity(k)`, among potentials.
    SelfGravity(SelfGravity),
}

/// Takes the summands that are no formulas out of a sum; what is left of it.
pub(super) fn taken(piece: Piece, place: Place, found: &mut Diagnostics) -> (Vec<Summand>, Option<Piece>) {
    let (mut taken, mut rest) = (Vec::new(), Vec::new());
    let tokens = unwrapped(piece.tokens);
    // A sign after an operator belongs to what follows it.
    let is_operator = |token: &TokenTree| matches!(token, TokenTree::Punct(_));
    for signed in tokens.chunk_by(|before, after| is_operator(before) || !is_sign(after, "+-")) {
        let summand = match signed {
            [plus, summand @ ..] if is_sign(plus, "+") => summand,
            _ => signed,
        };
        match summand {
            [TokenTree::Ident(name), TokenTree::Group(group)]
                if name == "custom" && group.delimiter() == Delimiter::Parenthesis =>
            {
                let at = Region { start: name.span(), end: group.span() };
                let list = pieces(group.stream(), group.span_close());
                taken.extend(custom(list, at, place, found).map(Summand::Field));
            }
            [TokenTree::Ident(name), TokenTree::Group(group)]
                if name == SELF_GRAVITY
                    && group.delimiter() == Delimiter::Parenthesis
                    && place == Place::Potential =>
            {
                taken.extend(self_gravity(name.span(), group, found).map(Summand::SelfGravity));
            }
            _ => rest.extend_from_slice(if rest.is_empty() { summand } else { signed }),
        }
    }
    let rest = region(&rest).map(|at| Piece { tokens: rest, at });
    (taken, rest)
}

fn is_sign(token: &TokenTree, signs: &str) -> bool {
    matches!(token, TokenTree::Punct(sign) if signs.contains(sign.as_char()))
}

/// The strength of a body's gravity on itself.
fn self_gravity(name: Span, group: &Group, found: &mut Diagnostics) -> Option<SelfGravity> {
    let span = Region { start: name, end: group.span_close() };
    let arguments: Result<[Piece; 1], _> = pieces(group.stream(), group.span_close()).try_into();
    match arguments {
        Ok([Piece { tokens, at }]) => {
            let strength = expression_parser::parse(tokens, at, Language::Coefficient, found).ok()?;
            Some(SelfGravity { strength, span })
        }
        Err(arguments) => {
            let (name, parameters, count) = (SELF_GRAVITY, &["k"], arguments.len());
            found.report(span, PotentialMistake::ArgumentCount { name, parameters, found: count });
            None
        }
    }
}

/// The field and what is said of it.
fn custom(list: Vec<Piece>, at: Region, place: Place, found: &mut Diagnostics) -> Option<Custom> {
    let mut names: Vec<(Ident, Region)> = Vec::new();
    for Piece { tokens, at } in list {
        match unwrapped(tokens).as_slice() {
            [TokenTree::Ident(name)] => names.push((name.clone(), at)),
            other => {
                let text = other.iter().cloned().collect::<proc_macro2::TokenStream>().to_string();
                found.report(at, malformed(place, format!("`{}`", shortened(&text)), None));
                return None;
            }
        }
    }
    let mut names = names.into_iter();
    let (field, _) = names.next().or_else(|| {
        found.report(at, malformed(place, "no field".to_owned(), None));
        None
    })?;
    let (mut role, mut mark) = (None, None);
    for (name, at) in names {
        let text = name.to_string();
        let named = Role::named(&text).filter(|role| role.is_force() == (place == Place::Forces));
        let said = Mark::named(&text).filter(|mark| place.takes_mark(*mark));
        match named {
            Some(value) if role.is_none() => role = Some(Spanned { value, span: at }),
            None if mark.is_none() && said.is_some() => mark = said,
            _ => {
                found.report(at, malformed(place, format!("`{text}`"), Some(&field)));
                return None;
            }
        }
    }
    let Some(role) = role else {
        found.report(at, malformed(place, "the field alone".to_owned(), Some(&field)));
        return None;
    };
    Some(Custom { field, role, mark, span: at })
}

/// A force that is no `custom(...)`.
pub(super) fn only(rest: Option<Piece>, place: Place, found: &mut Diagnostics) {
    if let Some(Piece { tokens, at }) = rest {
        let text = tokens.into_iter().collect::<proc_macro2::TokenStream>().to_string();
        found.report(at, malformed(place, format!("`{}`", shortened(&text)), None));
    }
}

/// `2*custom(..)`.
pub(super) fn within_an_expression() -> ForceMistake {
    malformed(Place::Potential, "`custom(..)` within an expression".to_owned(), None)
}

fn malformed(place: Place, found: String, field: Option<&Ident>) -> ForceMistake {
    ForceMistake::MalformedCustom {
        key: if place == Place::Potential { "potential" } else { "forces" },
        found,
        takes: place.takes(),
        example: place.example(field),
    }
}

//! The names of the specification language, and how a misspelt one finds its neighbour.

use crate::symbol::{Capability, Constraint, TermKind};

/// A closed set of names.
pub trait Named: Copy + 'static {
    /// All members, in the order in which messages list them.
    const ALL: &'static [Self];

    /// The name as written by the user.
    fn name(self) -> &'static str;

    /// The member of a name.
    fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|member| member.name() == name)
    }

    /// All names.
    fn names() -> Vec<&'static str> {
        Self::ALL.iter().map(|member| member.name()).collect()
    }
}

/// The names of the members of a set, in the order in which messages list them.
macro_rules! named {
    ($set:ty { $($member:ident: $name:literal),* $(,)? }) => {
        impl Named for $set {
            const ALL: &'static [Self] = &[$(Self::$member),*];

            fn name(self) -> &'static str {
                match self {
                    $(Self::$member => $name,)*
                }
            }
        }
    };
}
pub(super) use named;

/// A closed set of names, each member with its own.
macro_rules! set_of_names {
    ($(#[$about:meta])* $seen:vis enum $set:ident { $($(#[$of:meta])* $member:ident = $name:literal,)* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $seen enum $set {
            $($(#[$of])* $member,)*
        }

        named!($set { $($member: $name),* });
    };
}
pub(super) use set_of_names;

set_of_names! {
    /// A group claimed to leave the kinetic energy unchanged, on one side.
    pub enum Claim {
        /// GL(n).
        Affine = "affine",
        /// O(n).
        Metric = "metric",
        /// No claim.
        None = "none",
    }
}

set_of_names! {
    /// A group in place of GL(n, R) as the space of placements.
    pub enum PlacementGroup {
        /// U(n), the compact real form of GL(n, C).
        Unitary = "unitary",
    }
}

named!(Constraint { Isochoric: "isochoric", Rigid: "rigid", Conformal: "conformal" });

impl Constraint {
    /// The group by its equation, as the end of a sentence.
    pub fn group(self) -> &'static str {
        match self {
            Self::Isochoric => "det phi = 1",
            Self::Rigid => "phi^T phi = 1",
            Self::Conformal => "phi = e^q R with a rotation R",
        }
    }

    /// What affine velocities are.
    pub fn velocities(self) -> &'static str {
        match self {
            Self::Isochoric => "traceless",
            Self::Rigid => "skew",
            Self::Conformal => "skew up to multiples of the identity",
        }
    }
}

set_of_names! {
    /// A condition that the user wants enforced.
    pub enum Requirement {
        /// T > 0 at every velocity that is not zero.
        PositiveDefinite = "positive_definite",
    }
}

named!(Capability {
    Splitting: "splitting",
    Taylor: "taylor",
    Nystrom: "nystrom",
    TwoPolar: "two_polar",
    Ratios: "ratios",
    Tangent: "tangent",
    Lanes: "lanes",
    Metric: "metric",
    Acceleration: "acceleration",
    Balance: "balance",
    Latex: "latex",
});

impl Named for TermKind {
    const ALL: &'static [Self] = &TermKind::ALL;

    fn name(self) -> &'static str {
        TermKind::name(self)
    }
}

/// The candidate that is probably meant by `name`: the only one whose first words it is, as `vorticity` of
/// `vorticity_squared`; else the nearest, if it is near enough: an edit distance of at most a third of the longer name's
/// length.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let candidates: Vec<&str> = candidates.into_iter().collect();
    let begins = |candidate: &&str| candidate.strip_prefix(name).is_some_and(|rest| rest.starts_with('_'));
    let mut longer = candidates.iter().copied().filter(begins);
    if let (Some(only), None) = (longer.next(), longer.next()) {
        return Some(only);
    }
    let near = |candidate: &'a str| {
        let distance = edit_distance(&name.to_lowercase(), &candidate.to_lowercase());
        let longest = name.chars().count().max(candidate.chars().count());
        (3 * distance <= longest).then_some((distance, candidate))
    };
    candidates.into_iter().filter_map(near).min_by_key(|(distance, _)| *distance).map(|(_, name)| name)
}

/// Least number of insertions, deletions, substitutions and exchanges of neighbours (optimal string alignment).
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let substituted = above[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = substituted.min(above[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(before[j - 2] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

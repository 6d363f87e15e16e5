//! Every mistake has a short name that stays.

/// Writes `name` and `NAMES` from one list; the match has no wildcard, so that a variant without a name does
/// not compile.
macro_rules! names {
    ($mistake:ident $($variant:ident => $name:literal,)*) => {
        impl $mistake {
            /// The names, in the order of the variants.
            pub(super) const NAMES: &[&str] = &[$($name),*];

            /// The stable short name.
            pub(super) fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => $name,)*
                }
            }
        }
    };
}

pub(super) use names;

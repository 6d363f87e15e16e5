//! Coefficients as they were published.

/// Rows of pairs (stage, coefficient), stages counted from 1 as in the literature; what is not listed is zero.
/// For the tests the same rows again, as they are written here: decimals, or fractions.
macro_rules! rows {
    ($($(#[$doc:meta])* $name:ident: $len:literal = [$(($stage:literal, $value:expr),)*];)*) => {
        $(
            $(#[$doc])*
            #[allow(clippy::excessive_precision, reason = "the published digits, for the exact tests")]
            pub(super) const $name: [(usize, f64); $len] = [$(($stage, $value)),*];
        )*

        /// Every row as published: name, and pairs (stage, number).
        #[cfg(test)]
        const PUBLISHED: &[(&str, &[(usize, &str)])] =
            &[$((stringify!($name), &[$(($stage, stringify!($value))),*])),*];
    };
}

pub(super) use rows;

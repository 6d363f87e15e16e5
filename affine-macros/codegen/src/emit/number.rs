//! Numbers as Rust: exact ones over a scalar, doubles, counts.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::Rational;
use crate::algebra::fault::never_missing;
use crate::ir::naming::of_number;

/// What a body computes with.
#[derive(Clone, Copy)]
pub(super) enum Number<'a> {
    /// A type parameter.
    Generic(&'a Ident),
    /// Doubles.
    Double,
}

impl Number<'_> {
    /// The number, to double-double precision where it is generic.
    pub(super) fn exact(self, number: &Rational) -> TokenStream {
        match self {
            Self::Generic(scalar) if number.is_zero() => quote!(#scalar::zero()),
            Self::Generic(scalar) if number.is_one() => quote!(#scalar::one()),
            Self::Generic(scalar) => exact(scalar, number),
            Self::Double => literal(number.to_doubles().0, "f64"),
        }
    }

    /// The double that `value` is.
    pub(super) fn of_double(self, value: TokenStream) -> TokenStream {
        match self {
            Self::Generic(scalar) => quote!(#scalar::constant(#value, 0.0)),
            Self::Double => value,
        }
    }
}

/// A number to double-double precision.
fn exact(scalar: &Ident, number: &Rational) -> TokenStream {
    let (hi, lo) = number.to_doubles();
    let (hi, lo) = (literal(hi, ""), literal(lo, ""));
    quote!(#scalar::constant(#hi, #lo))
}

/// Rows of numbers to double-double precision.
pub(super) fn exact_table(scalar: &Ident, rows: &[Vec<Rational>]) -> TokenStream {
    let rows = rows.iter().map(|row| {
        let entries = row.iter().map(|entry| exact(scalar, entry));
        quote!([#(#entries),*])
    });
    quote!([#(#rows),*])
}

/// The name of a number; `roots` counts those that have no short one.
pub(super) fn name_of(number: &Rational, roots: &mut usize) -> Ident {
    match of_number(number) {
        Some(name) => format_ident!("{name}"),
        None => {
            *roots += 1;
            format_ident!("root{roots}")
        }
    }
}

/// A double.
pub(super) fn double(value: f64) -> TokenStream {
    literal(value, "")
}

/// A double with an exponent where that is shorter.
fn literal(value: f64, suffix: &str) -> TokenStream {
    let size = value.abs();
    let plain = size == 0.0 || (1e-4..1e16).contains(&size);
    let digits = if plain { format!("{size:?}") } else { format!("{size:e}") };
    let digits = format!("{digits}{suffix}").parse().ok();
    let digits = never_missing(digits, "both forms of a double are literals of Rust", TokenStream::new());
    if value.is_sign_negative() { quote!(-#digits) } else { quote!(#digits) }
}

/// A count as people write it.
pub(super) fn number(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}

//! Coefficients as one value: in lanes, in double-doubles, with derivatives with respect to fields.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod derivatives;
mod extrema;
mod lanes;
mod models;
mod numbers;
mod rates;

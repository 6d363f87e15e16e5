//! Exact and symbolic mathematics; knows neither Rust syntax nor mechanics.

pub mod arena;
pub mod evaluate;
pub mod linear;
pub mod polynomial;
pub mod rational;

pub use arena::{Arena, Expr};
pub use polynomial::Polynomial;
pub use rational::Rational;

//! Exact and symbolic mathematics; knows neither Rust syntax nor mechanics.

pub mod arena;
pub mod bind;
pub mod definitions;
mod derivative;
pub mod division;
pub mod evaluate;
pub mod factor;
pub mod fault;
mod fold;
pub mod function;
pub mod kernel;
pub mod lagrange;
pub mod linear;
pub mod matrix;
pub mod passage;
pub mod polynomial;
pub mod products;
pub mod rational;
pub mod residue;
pub mod ring;
pub mod root;
pub mod span;
pub mod substitute;
pub mod text;
pub mod vanishing;
pub mod work;

pub use arena::{Arena, Expr};
pub use function::Function;
pub use kernel::Kernel;
pub use matrix::Matrix;
pub use polynomial::Polynomial;
pub use rational::Rational;

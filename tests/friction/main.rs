//! Stiff friction: the motions of viscous bodies against references of 25 digits, by the method that runs choose.

mod models;
mod motions;
mod scenes;

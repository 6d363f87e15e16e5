//! Forces that no potential has, against the oracle: the derivative of the dissipation function by dual numbers along
//! the canonical velocities, whatever the frames in which the energies are stated.

mod combined;
mod custom;
mod dissipation;
mod prepare;

//! Mechanics of an affinely-rigid body in exact rational arithmetic: what generated code is compared with.
//!
//! Two things are taken as given: the kinetic energy `T(phi; x_dot, phi_dot)` on the velocity side, term by term
//! ([`Term`]), and the canonical bracket `{F, G} = dF/dq dG/dp - dF/dp dG/dq` with `q = (x, phi)` and the pairing
//! `<Pi, phi_dot> = tr(Pi phi_dot)`. No Legendre transformation, no Hamiltonian and no balance law is written down:
//!
//! * mass matrix `M` of `T` by polarisation, `v = M^-1 P` and `H = P^T M^-1 P / 2` by exact elimination;
//! * `dH/dP = v` and `dH/dq = -dT/dq` at fixed `v`, the latter by dual numbers through `T` itself;
//! * `{F, H}` as the derivative of `F` along the canonical vector field, by dual numbers through `F` itself.
//!
//! A potential adds forces to the vector field ([`Motion::under`]). Its gradient comes from the plain definition of the
//! potential by forward differentiation in `f64`, since elementary functions have no exact values; it is then taken as
//! an exact number.
//!
//! So "conserved" means exactly 0 without potential, and the only other rounding is the last step to `f64`. Every finite `f64` is a rational
//! number: a point given in floating point is taken at its word.
//!
//! ```
//! use affine_oracle::{Kinetic, Observable, Random, Term, rational};
//!
//! # fn main() -> Result<(), affine_oracle::Error> {
//! let missile = Kinetic::new(3, vec![
//!     Term::body_inertia(3, rational(1, 1)),
//!     Term::Casimir2(rational(1, 5)),
//!     Term::BodyTranslation(rational(1, 1)),
//! ])?;
//! let motion = missile.motion(&Random::new(1).state(3))?;
//! assert!(motion.bracket(Observable::TotalAffineMomentum)?.is_zero());
//! assert!(!motion.bracket(Observable::AffineSpin)?.is_zero());
//! # Ok(())
//! # }
//! ```

mod differential;
mod error;
mod kinetic;
mod linear;
mod matrix;
mod motion;
mod observable;
mod potential;
mod random;
mod ring;
mod state;
mod stretches;

pub use differential::Differential;
pub use error::Error;
pub use kinetic::{Kinetic, Term};
pub use linear::Signature;
pub use matrix::Matrix;
pub use motion::{Expected, Motion};
pub use num_rational::BigRational as Rational;
pub use observable::Observable;
pub use potential::{Place, Slopes};
pub use random::{Isotropic, Random};
pub use ring::{Dual, Ring, exact, rational, rounded};
pub use state::State;

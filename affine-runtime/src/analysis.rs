//! Where motions rest, turn, branch and diverge.
//!
//! | you want | call |
//! |---|---|
//! | the derivative of the equations of motion | [`JacobianMatrix`] |

mod elimination;
mod jacobian;
mod rates;
mod tape;

pub use jacobian::JacobianMatrix;

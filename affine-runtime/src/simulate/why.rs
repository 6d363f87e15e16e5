//! Which method ran, and what was left out.

use core::fmt;

use super::Method;
use super::trajectory::{Computation, Trajectory};
use crate::model::Description;
use crate::state::Phase;

/// Why a trajectory was computed the way it was; displays as text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Why {
    description: Description,
    computation: Computation,
}

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// Which method ran and why, what the derivation of the model left out, and what the start let the run leave
    /// out.
    #[must_use]
    pub fn why(&self) -> Why {
        Why { description: self.description, computation: self.computation }
    }
}

impl Why {
    fn method(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Computation { asked, method, tolerance, closed_form_exists, .. } = self.computation;
        match method {
            Method::ClosedForm if asked == Method::ClosedForm => {
                writeln!(f, "closed form, as asked for: exact up to rounding, no steps")
            }
            Method::ClosedForm => {
                writeln!(f, "closed form: this model has one from this start; exact up to rounding, no steps")
            }
            Method::RungeKutta8 | Method::Automatic => {
                write!(f, "Runge-Kutta of order 8, relative error {tolerance:e} per step: ")?;
                match (asked, closed_form_exists) {
                    (Method::RungeKutta8, true) => {
                        writeln!(f, "as asked for; Method::Automatic would take the closed form")
                    }
                    (Method::RungeKutta8, false) => writeln!(f, "as asked for; there is no closed form"),
                    _ => writeln!(f, "the model has no closed form from this start"),
                }
            }
        }
    }

    fn scene(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Computation { method, no_whirl, at_rest, .. } = self.computation;
        let translates = self.description.full.iter().any(|group| group.name == "p" || group.name == "p_hat");
        if at_rest && translates {
            writeln!(f, "left out of this run: p = 0, the centre of mass exerts nothing on the placement")?;
        }
        if no_whirl && method == Method::ClosedForm {
            writeln!(f, "left out of this run: the skew factor, which is 1 without vorticity or spin")?;
        }
        Ok(())
    }
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.description.name)?;
        self.method(f)?;
        for left_out in self.description.left_out {
            writeln!(f, "left out of the model: {left_out}")?;
        }
        self.scene(f)
    }
}

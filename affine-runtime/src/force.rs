//! Forces of a type of your own, see [`Force`], and whether they are what they say.

mod at_point;

use core::fmt;

pub use affine_core::force::*;
pub use at_point::{AtPoint, PointForce};

/// A force that is said to be gyroscopic and has power.
#[derive(Clone, Copy, PartialEq)]
pub struct HasPower<const N: usize> {
    /// The time, placement and velocities at which it has power.
    pub motion: Motion<N>,
    /// The power there.
    pub power: f64,
    /// `|Q| |Omega|`, which the power is held against.
    pub scale: f64,
}

impl<const N: usize> fmt::Display for HasPower<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the force is said to be gyroscopic, but has the power {:e} (of {:e}) at {:?}",
            self.power, self.scale, self.motion
        )
    }
}

impl<const N: usize> fmt::Debug for HasPower<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<const N: usize> core::error::Error for HasPower<N> {}

/// Holds a force that says it is gyroscopic against its power at the given motions; see
/// [`motions`](crate::sampling::motions) for some.
///
/// # Errors
/// [`HasPower`] at the first motion along which the power is more than rounding, 1e-12 of `|Q| |Omega|`.
pub fn check<const N: usize, F: Force<N>>(
    force: &F,
    motions: impl IntoIterator<Item = Motion<N>>,
) -> Result<(), HasPower<N>> {
    if !F::GYROSCOPIC {
        return Ok(());
    }
    for motion in motions {
        let (power, scale) = F::Form::power(&force.force(&motion), &motion);
        // NaN is no zero.
        let vanishes = power.abs() <= 1e-12 * scale;
        if !vanishes {
            return Err(HasPower { motion, power, scale });
        }
    }
    Ok(())
}

//! Typed errors.

#[cfg(feature = "std")]
mod setting;
#[cfg(feature = "std")]
mod stop;
pub(crate) mod time;
#[cfg(feature = "std")]
mod written;

use core::fmt;

use crate::constraint::Constraint;

#[cfg(feature = "std")]
pub use setting::Setting;
#[cfg(feature = "std")]
pub use stop::{Callback, Reason, Stop};

/// Result of fallible runtime calls.
pub type Result<T> = core::result::Result<T, Error>;

/// `Debug` as it is displayed: a `main` that returns an error prints that.
macro_rules! debug_as_displayed {
    ($([$($generics:tt)*] $error:ty),*) => {$(
        impl<$($generics)*> core::fmt::Debug for $error {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                core::fmt::Display::fmt(self, f)
            }
        }
    )*};
}
#[cfg(feature = "std")]
pub(crate) use debug_as_displayed;

debug_as_displayed!([] Error, [] IllPosed);

/// What can be wrong with a model's numbers, a phase point or a setting.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A condition of well-posedness fails for the values of the model's fields.
    IllPosed(IllPosed),
    /// A field that coefficients of the model are computed from is NaN or infinite.
    FieldNotFinite {
        /// Its name.
        field: &'static str,
        /// Row and column from 1, of a field of matrix type.
        entry: Option<(usize, usize)>,
        /// Its value.
        value: f64,
    },
    /// The placement is not finite or does not preserve orientation.
    Placement {
        /// `det phi`; NaN where an entry of `phi` is not finite.
        determinant: f64,
    },
    /// A position, velocity or momentum is not finite.
    NotFinite {
        /// The quantity, as the paper names it.
        quantity: &'static str,
    },
    /// Two stretches of a lattice are equal: its variables do not determine the momentum there.
    CoincidentStretches,
    /// A placement, velocity or momentum violates the constraint of the model by more than rounding.
    OffConstraint {
        /// The constraint.
        constraint: Constraint,
        /// The quantity, as the paper names it.
        quantity: &'static str,
        /// Its distance from what the constraint allows, in the Frobenius norm; `|det phi - 1|` for an isochoric
        /// placement.
        defect: f64,
        /// The largest distance that is taken for rounding.
        threshold: f64,
    },
    /// A simulation did not reach its end, or could not begin.
    #[cfg(feature = "std")]
    Stopped(Stop),
    /// A work-precision report has nothing to hold its results against.
    #[cfg(feature = "std")]
    NoReference {
        /// Name of the model.
        model: &'static str,
    },
    /// Two columns of a table have one name, by which files and programs ask for them.
    #[cfg(feature = "std")]
    RepeatedColumn {
        /// The name that both have.
        name: String,
    },
    /// A file cannot be written.
    #[cfg(feature = "std")]
    File {
        /// The file.
        path: std::path::PathBuf,
        /// The kind of failure.
        kind: std::io::ErrorKind,
    },
}

/// A condition on the kinetic energy or the dissipation that fails.
#[derive(Clone, PartialEq)]
pub struct IllPosed {
    /// The condition, in the model's own parameters: `I + A != 0`.
    pub condition: &'static str,
    /// What fails where the condition does, with the equation.
    pub reason: &'static str,
    /// The value that should not vanish (or should be positive).
    pub value: f64,
    /// The threshold it is held against.
    pub threshold: f64,
    /// A velocity of unit size on which it is that value, for forms that are looked at in numbers.
    pub velocity: Option<UnitVelocity>,
}

/// An affine velocity of the energy's frame: `Oh`, `Om` or `phi_dot`, `n x n`, in the user's bases, to seven digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitVelocity {
    dim: usize,
    entries: [f32; 9],
}

impl UnitVelocity {
    /// With these entries, row after row; at most three rows.
    pub(crate) fn new(dim: usize, entry: impl Fn(usize) -> f64) -> Self {
        Self { dim, entries: core::array::from_fn(|k| if k < dim * dim { entry(k) as f32 } else { 0.0 }) }
    }

    /// The rows.
    pub fn rows(&self) -> impl Iterator<Item = &[f32]> {
        self.entries.chunks(self.dim).take(self.dim)
    }
}

impl fmt::Display for UnitVelocity {
    /// `[[1.000, 0.000], [0.000, -1.000]]`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("[")?;
        for (i, row) in self.rows().enumerate() {
            f.write_str(if i == 0 { "[" } else { ", [" })?;
            for (j, entry) in row.iter().enumerate() {
                // No sign where nothing is left.
                let entry = if entry.abs() < 5e-4 { 0.0 } else { *entry };
                write!(f, "{}{entry:.3}", if j == 0 { "" } else { ", " })?;
            }
            f.write_str("]")?;
        }
        f.write_str("]")
    }
}

#[cfg(feature = "std")]
impl From<Stop> for Error {
    fn from(stop: Stop) -> Self {
        Error::Stopped(stop)
    }
}

/// As of a run that did not begin: an ensemble is refused in the same words.
#[cfg(feature = "std")]
impl From<Setting> for Error {
    fn from(setting: Setting) -> Self {
        Stop { reason: setting.into(), t: 0.0, steps: 0 }.into()
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::IllPosed(defect) => defect.fmt(f),
            Error::FieldNotFinite { field, entry, value } => {
                write!(f, "the field `{field}` ")?;
                entry.map_or(Ok(()), |(row, column)| write!(f, "has in row {row}, column {column} an entry that "))?;
                write!(f, "is {value}: the coefficients of the equations are computed from it; give a finite number")
            }
            Error::Placement { determinant } => write!(
                f,
                "det phi = {determinant:e}: a placement has finite entries and a positive determinant, since the \
                 configuration space is GL+(n); start from a placement that keeps orientation"
            ),
            Error::NotFinite { quantity } => {
                write!(
                    f,
                    "{quantity} is not finite, as given or as computed from what was given: give finite numbers, \
                     momenta and velocities that doubles can hold"
                )
            }
            Error::CoincidentStretches => f.write_str(
                "two stretches are equal, where (q, p, M, N) do not determine the momentum: M vanishes with their \
                 difference; give the phase point itself",
            ),
            Error::OffConstraint { constraint, quantity, defect, threshold } => write!(
                f,
                "{quantity} violates the {constraint} constraint by {defect:e} (threshold {threshold:e}): {}",
                constraint.asks()
            ),
            #[cfg(feature = "std")]
            Error::Stopped(stop) => stop.fmt(f),
            #[cfg(feature = "std")]
            Error::NoReference { model } => write!(
                f,
                "no reference for {model}: it has no closed form from this start, and its equations in double-double \
                 arithmetic did not reach the end in 100000 steps of order 20; give the phase point at the end with `.against(point)`, or a shorter interval"
            ),
            #[cfg(feature = "std")]
            Error::RepeatedColumn { name } => written::repeated(f, name),
            #[cfg(feature = "std")]
            Error::File { path, kind } => written::unwritten(f, path, *kind),
        }
    }
}

impl fmt::Display for IllPosed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the model is ill-posed: {} fails with the value {:e} (threshold {:e}): {}",
            self.condition, self.value, self.threshold, self.reason
        )?;
        self.velocity.map_or(Ok(()), |velocity| write!(f, "; the velocity is {velocity}"))
    }
}

impl core::error::Error for Error {}
impl core::error::Error for IllPosed {}

impl From<IllPosed> for Error {
    fn from(defect: IllPosed) -> Self {
        Error::IllPosed(defect)
    }
}

//! Pictures without the feature that draws them: calls do not compile, and the compiler names the feature.

use std::path::Path;

use crate::error::Result;
use crate::simulate::Trajectory;
use crate::state::Phase;

/// What pictures ask for in vain without the feature; nothing implements it.
#[diagnostic::on_unimplemented(
    message = "a trajectory has no pictures without the feature `report` of `affine-runtime`",
    label = "the feature `report` is off",
    note = "add it in Cargo.toml: `affine-runtime = {{ version = \"..\", features = [\"report\"] }}`"
)]
pub trait Pictures {
    /// What follows from it.
    fn never<T>(&self) -> T;
}

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// Does not compile without the feature `report`.
    pub fn to_svg(&self) -> String
    where
        Self: Pictures,
    {
        self.never()
    }

    /// Does not compile without the feature `report`.
    ///
    /// # Errors
    /// None: it cannot be called.
    pub fn save_svg(&self, _path: impl AsRef<Path>) -> Result<()>
    where
        Self: Pictures,
    {
        self.never()
    }

    /// Does not compile without the feature `report`.
    pub fn page(&self)
    where
        Self: Pictures,
    {
        self.never()
    }

    /// Does not compile without the feature `report`.
    pub fn to_html(&self) -> String
    where
        Self: Pictures,
    {
        self.never()
    }

    /// Does not compile without the feature `report`.
    ///
    /// # Errors
    /// None: it cannot be called.
    pub fn save_html(&self, _path: impl AsRef<Path>) -> Result<()>
    where
        Self: Pictures,
    {
        self.never()
    }
}

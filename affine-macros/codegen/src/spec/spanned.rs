//! What the user wrote, with where it stands.

use crate::diagnostics::Region;

/// Something with its place in the source.
#[derive(Clone, Copy, Debug)]
pub struct Spanned<T> {
    /// What the user wrote, read.
    pub value: T,
    /// Its place in the source.
    pub span: Region,
}

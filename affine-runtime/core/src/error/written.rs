//! Words about tables and files.

use core::fmt;
use std::io::ErrorKind;
use std::path::Path;

/// Two columns have one name.
pub(super) fn repeated(f: &mut fmt::Formatter<'_>, name: &str) -> fmt::Result {
    write!(
        f,
        "two columns of the table are called `{name}`: give each a name of its own; a table of bodies has `body`, `t` and the \
         numbers of the phase point, such as `phi11`, besides the names that it is given"
    )
}

/// A file is not written.
pub(super) fn unwritten(f: &mut fmt::Formatter<'_>, path: &Path, kind: ErrorKind) -> fmt::Result {
    let path = path.display();
    match kind {
        ErrorKind::InvalidData => write!(
            f,
            "cannot write {path}: the format does not hold it; glTF has numbers of single precision, where a unit of time is a \
             second, shapes with points, and at most 4 GiB: choose other units, another shape or fewer outputs"
        ),
        kind => write!(f, "cannot write {path}: {kind}; check the folder, its permissions and its space"),
    }
}

//! Files of tables.

use std::fs::File;
use std::io::{self, BufWriter, Seek, Write};
use std::path::Path;

use super::table::Table;
use crate::error::{Error, Result};

/// The format of a file of a [`Table`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// Comma-separated values, [`Table::csv`].
    Csv,
    /// An archive of NumPy arrays, [`Table::npz`].
    #[cfg(feature = "npy")]
    Npz,
    /// Apache Parquet, [`Table::parquet`].
    #[cfg(feature = "parquet")]
    Parquet,
}

impl Format {
    /// How names of such files end.
    pub(super) fn ending(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            #[cfg(feature = "npy")]
            Self::Npz => "npz",
            #[cfg(feature = "parquet")]
            Self::Parquet => "parquet",
        }
    }

    /// Writes a table.
    pub(super) fn write(self, table: &Table, writer: impl Write + Seek + Send) -> io::Result<()> {
        match self {
            Self::Csv => table.csv(writer),
            #[cfg(feature = "npy")]
            Self::Npz => table.npz(writer),
            #[cfg(feature = "parquet")]
            Self::Parquet => table.parquet(writer),
        }
    }
}

impl Table {
    /// Writes the table to a file.
    ///
    /// # Errors
    /// [`Error::File`] with path and kind of the failure.
    pub fn save(&self, path: impl AsRef<Path>, format: Format) -> Result<()> {
        let path = path.as_ref();
        let written = File::create(path).and_then(|file| format.write(self, BufWriter::new(file)));
        written.map_err(|error| failed(path, &error))
    }
}

pub(super) fn failed(path: &Path, error: &io::Error) -> Error {
    Error::File { path: path.to_path_buf(), kind: error.kind() }
}

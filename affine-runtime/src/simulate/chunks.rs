//! Folders into which a run or an ensemble is written as it goes: files of rows, and a manifest of what is there.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Cursor, Write};
use std::path::{Path, PathBuf};

use super::format::{Format, failed};
use super::table::Table;
use crate::error::{Result, Setting};

/// A folder into which chunks are written. Its manifest begins with a line about the run; the lines of a chunk end with one that
/// begins with a mark.
pub(super) struct Folder {
    path: PathBuf,
    manifest: File,
}

impl Folder {
    /// A new one, or one that the same run has begun to fill, with the lines of the chunks that are there: what was under way when that
    /// ended is forgotten.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File); [`Setting::Checkpoint`] for a folder of another run.
    pub(super) fn open(
        path: &Path,
        run: &str,
        mark: &str,
        model: &'static str,
    ) -> Result<(Self, Vec<String>)> {
        let place = path.join("manifest.txt");
        let opened = fs::create_dir_all(path).and_then(|()| match fs::read(&place) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
            read => read,
        });
        let bytes = opened.map_err(|error| failed(&place, &error))?;
        // What is no text was not written here.
        let text = String::from_utf8(bytes).map_err(|_| Setting::Checkpoint { model })?;
        // A line that has no end was under way, but for the first, which a manifest is made with.
        let mut lines = text.split_inclusive('\n').filter_map(|line| line.strip_suffix('\n'));
        if !text.is_empty() && lines.next() != Some(run) {
            return Err(Setting::Checkpoint { model }.into());
        }
        let mut there: Vec<String> = lines.map(str::to_owned).collect();
        there.truncate(there.iter().rposition(|line| line.starts_with(mark)).map_or(0, |last| last + 1));
        let kept = [run].into_iter().chain(there.iter().map(String::as_str));
        let kept: String = kept.flat_map(|line| [line, "\n"]).collect();
        let begun =
            written(&place, kept.as_bytes()).and_then(|()| OpenOptions::new().append(true).open(&place));
        let manifest = begun.map_err(|error| failed(&place, &error))?;
        Ok((Self { path: path.to_path_buf(), manifest }, there))
    }

    /// Writes a file of rows, `name` with an ending, which has its name once it is whole.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File).
    pub(super) fn write(&self, name: &str, table: &Table, format: Format) -> Result<String> {
        let name = format!("{name}.{}", format.ending());
        let mut bytes = Cursor::new(Vec::new());
        let rows = format.write(table, &mut bytes);
        self.put(&name, rows.map(|()| bytes.into_inner())).map(|()| name)
    }

    /// Writes these bytes to a file.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File).
    pub(super) fn put(&self, name: &str, bytes: io::Result<Vec<u8>>) -> Result<()> {
        let place = self.path.join(name);
        bytes.and_then(|bytes| written(&place, &bytes)).map_err(|error| failed(&place, &error))
    }

    /// Writes lines about what is there.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File).
    pub(super) fn note(&mut self, lines: &str) -> Result<()> {
        let noted = self.manifest.write_all(lines.as_bytes()).and_then(|()| self.manifest.sync_data());
        noted.map_err(|error| failed(&self.path.join("manifest.txt"), &error))
    }
}

/// Writes a file under another name, and then gives it its own.
fn written(place: &Path, text: &[u8]) -> io::Result<()> {
    let part = place.with_extension("part");
    let mut file = File::create(&part)?;
    file.write_all(text)?;
    file.sync_data()?;
    fs::rename(part, place)
}

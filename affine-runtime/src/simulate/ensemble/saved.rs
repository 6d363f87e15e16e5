//! Ensembles that are written as they go: a file for each chunk of bodies, and a manifest of what is there.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::Ensemble;
use super::asked::Member;
use crate::capability::InLanes;
use crate::error::{Error, Result, Setting};
use crate::lanes::Widest;
use crate::model::{Handle, Model};
use crate::simulate::motion::PointOf;
use crate::simulate::table::Table;

impl<'a, const N: usize, H: Handle<N> + 'a> Ensemble<'a, N, H> {
    /// Runs the ensemble and writes the outputs of its bodies, or their ends where there are no outputs, into a folder as they
    /// come: a CSV file for each `chunk` of bodies, with the columns of [`Table::of_bodies`] and the values of a function of
    /// the number under `names`, and `manifest.txt`, a line for each file with its first and last body and its rows, and for each
    /// body that stopped with the reason.
    ///
    /// A run that is ended from outside loses the chunk under way at most: the same call goes on after the chunks that the
    /// manifest names, and gives the same bytes. Starts, models and events have to be the same; settings and shard are compared.
    ///
    /// # Errors
    /// [`Error::File`]; [`Setting::Checkpoint`] for a folder of another run; a [`Setting`] that makes no sense.
    pub fn save(
        self,
        folder: impl AsRef<Path>,
        chunk: usize,
        names: &[&str],
        values: impl Fn(u64) -> Vec<f64>,
    ) -> Result<()>
    where
        H: Sync,
        H::Model: InLanes<N>,
        PointOf<N, H>: Send + Sync,
    {
        let Self { plan, shard: (k, of), .. } = &self;
        let model = H::Model::DESCRIPTION.name;
        let run =
            format!("bodies of {model}, shard {k} of {of}, {chunk} a file, {plan:?}, columns {names:?}");
        let mut folder = Folder::open(folder.as_ref(), &run, model)?;
        let mut table = Table::of_bodies::<N, H::Model>(names);
        let end = plan.t_end.unwrap_or(f64::NAN);
        let rest = folder.next..u64::MAX;
        let add = |outputs: &mut Vec<_>, t, point: &PointOf<N, H>| outputs.push((t, *point));
        self.numbers(rest).chunks::<Widest, _, Error>(chunk.max(1), &|_, _| Vec::new(), &add, |bodies| {
            table.clear();
            for body in &bodies {
                let ends = body.end.iter().filter(|_| body.folded.is_empty()).map(|point| (end, *point));
                for (t, point) in body.folded.iter().copied().chain(ends) {
                    table.push::<N, H::Model>(body.number, &values(body.number), t, &point);
                }
            }
            folder.write(&bodies, &table)
        })
    }
}

/// A folder into which chunks are written.
pub(super) struct Folder {
    path: PathBuf,
    manifest: File,
    /// Number of the first body that is not there.
    pub(super) next: u64,
}

impl Folder {
    /// A new one, or one that the same run has begun to fill: what was under way when that ended is forgotten.
    ///
    /// # Errors
    /// [`Error::File`]; [`Setting::Checkpoint`] for a folder of another run.
    pub(super) fn open(path: &Path, run: &str, model: &'static str) -> Result<Self> {
        let place = path.join("manifest.txt");
        let opened = fs::create_dir_all(path).and_then(|()| match fs::read_to_string(&place) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(String::new()),
            read => read,
        });
        let text = opened.map_err(|error| failed(&place, &error))?;
        // A line that has no end was under way.
        let whole: Vec<&str> = text.split_inclusive('\n').filter(|line| line.ends_with('\n')).collect();
        if whole.first().is_some_and(|first| first.trim_end() != run) {
            return Err(Setting::Checkpoint { model }.into());
        }
        let last = whole.iter().rposition(|line| line.starts_with("chunk "));
        let number = last.and_then(|last| whole[last].split(' ').nth(3)?.parse::<u64>().ok());
        let kept = last.map_or_else(|| format!("{run}\n"), |last| whole[..=last].concat());
        let begun =
            written(&place, kept.as_bytes()).and_then(|()| OpenOptions::new().append(true).open(&place));
        let manifest = begun.map_err(|error| failed(&place, &error))?;
        Ok(Self { path: path.to_path_buf(), manifest, next: number.map_or(0, |last| last + 1) })
    }

    /// Writes a chunk, and then what of it is there: its file, first and last body and number of rows, and the bodies that
    /// stopped, with the reason. A file has its name once it is whole.
    pub(super) fn write<P, A>(&mut self, bodies: &[Member<P, A>], table: &Table) -> Result<()> {
        let (Some(first), Some(last)) = (bodies.first(), bodies.last()) else { return Ok(()) };
        let name = format!("chunk-{:012}.csv", first.number);
        let place = self.path.join(&name);
        let mut lines = String::new();
        for body in bodies {
            if let Err(stop) = &body.end {
                lines += &format!("stopped {} at {:e}: {}\n", body.number, stop.t, stop.reason);
            }
        }
        lines += &format!("chunk {name} {} {} {}\n", first.number, last.number, table.len());
        let mut text = Vec::new();
        let done = table.csv(&mut text).and_then(|()| written(&place, &text)).and_then(|()| {
            self.manifest.write_all(lines.as_bytes())?;
            self.manifest.sync_data()
        });
        done.map_err(|error| failed(&place, &error))
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

fn failed(path: &Path, error: &io::Error) -> Error {
    Error::File { path: path.to_path_buf(), kind: error.kind() }
}

//! Runs that are written as they go.

use core::cell::Cell;
use core::ops::ControlFlow;
use std::path::Path;
use std::rc::Rc;

use super::checkpoint::Checkpoint;
use super::chunks::Folder;
use super::fingerprint::fingerprint;
use super::format::Format;
use super::run::Run;
use super::simulation::Simulation;
use super::table::Table;
use super::trajectory::Trajectory;
use crate::error::{Callback, Reason, Result, Setting};
use crate::model::Model;
use crate::state::Phase;

/// The state of a run that has come to its end.
const ENDED: &str = "state ended";

impl<const N: usize, M: Model<N>> Simulation<'_, N, M> {
    /// Runs the simulation and writes its outputs into a folder as they come: a file for each `chunk` of them, at least one, with the columns of
    /// [`Trajectory::table`] and what `about` notes of the table as a whole, a file of its events, [`Trajectory::events_csv`], where there are some, each under the number of its first row or event, and `manifest.txt`, which
    /// names these files, and has the state from which the run goes on after each. Memory holds one chunk.
    ///
    /// A run that is ended from outside loses the chunk under way at most: the same call goes on after the chunks that the manifest
    /// names, and gives the same bytes, as [`resume`](Self::resume) does. One that a callback or the largest number of steps ends
    /// loses nothing: its last chunk has fewer outputs, the same call goes on behind it, and the rows of all chunks are the
    /// same. `max_steps` may be raised.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File); [`Setting::Checkpoint`] for a folder of another run, and for a stiff run of Gauss
    /// collocation, which has no [checkpoints](Trajectory::checkpoint); [`Error::Stopped`](crate::Error::Stopped) for a run that
    /// does not reach its end, whose outputs up to there are written.
    pub fn save(
        mut self,
        folder: impl AsRef<Path>,
        (format, chunk): (Format, usize),
        about: impl Fn(&mut Table),
    ) -> Result<()> {
        self.settings.checked(&M::DESCRIPTION)?;
        let (model, moving) = (M::DESCRIPTION.name, self.moving());
        let events: Vec<&'static str> = self.settings.events.iter().map(|event| event.name).collect();
        let known = fingerprint(&moving, &self.settings, &events);
        let run = format!("run, {chunk} a file in {format:?}, {known}");
        let (folder, there) = Folder::open(folder.as_ref(), &run, "state ", model)?;
        let [rows, events] = ["chunk ", "events "].map(|kind| listed(&there, kind));
        let mut chunks = Chunks { folder, format, about: &about, rows, events };
        match there.last().map(String::as_str) {
            Some(ENDED) => return Ok(()),
            Some(state) => self.settings.checkpoint = Some(Checkpoint::of_line(known, state, model)?),
            None => {}
        }
        // Outputs until the chunk is full; none where the callback of the user ends the run.
        let left = Rc::new(Cell::new(Some(chunk)));
        let (mut observe, filling) = (self.settings.observe.take(), Rc::clone(&left));
        self.settings.observe = Some(Box::new(move |t, point| {
            let flow = observe.as_mut().map_or(ControlFlow::Continue(()), |observe| observe(t, point));
            filling.set(filling.get().filter(|_| flow.is_continue()).map(|left| left.saturating_sub(1)));
            if filling.get() == Some(0) { ControlFlow::Break(()) } else { flow }
        }));
        let mut run = Run { model: &moving, settings: self.settings };
        loop {
            left.set(Some(chunk));
            let (stop, trajectory) = match run.outcome() {
                Ok(trajectory) => return chunks.write(&trajectory, Some(ENDED)),
                Err(halt) => (halt.stop, halt.trajectory),
            };
            let state = trajectory.checkpoint.as_deref().map(Checkpoint::line);
            chunks.write(&trajectory, state.as_deref())?;
            if !(left.get() == Some(0) && stop.reason == Reason::Interrupted(Callback::Observer)) {
                return Err(stop.into());
            }
            run.settings.checkpoint = trajectory.checkpoint.map(|checkpoint| *checkpoint);
            if run.settings.checkpoint.is_none() {
                return Err(Setting::Checkpoint { model }.into());
            }
        }
    }
}

/// How many rows there are in the files of a kind: the last number of each of their lines.
fn listed(there: &[String], kind: &str) -> u64 {
    let lines = there.iter().filter(|line| line.starts_with(kind));
    lines.filter_map(|line| line.rsplit(' ').next()?.parse::<u64>().ok()).fold(0, u64::saturating_add)
}

/// The chunks of a run.
struct Chunks<'a> {
    folder: Folder,
    format: Format,
    about: &'a dyn Fn(&mut Table),
    /// Outputs that are there: the number of the next one.
    rows: u64,
    /// Events that are there.
    events: u64,
}

impl Chunks<'_> {
    /// Writes what is recorded, and the state from which the run goes on.
    fn write<const N: usize, P: Phase<N>>(
        &mut self,
        trajectory: &Trajectory<N, P>,
        state: Option<&str>,
    ) -> Result<()> {
        let (mut table, mut lines) = (trajectory.table(), Vec::new());
        (self.about)(&mut table);
        // A run without outputs has the names of its columns, once it does not go on.
        let (rows, is_last) = (self.rows, state.is_none_or(|state| state == ENDED));
        if !table.is_empty() || rows == 0 && is_last {
            let name = self.folder.write(&format!("chunk-{rows:012}"), &table, self.format)?;
            lines.push(format!("chunk {name} {rows} {}", table.len()));
        }
        // Between two outputs a run may be interrupted several times: their number does not tell files of events apart.
        let events = trajectory.events().len();
        if events > 0 {
            let name = format!("events-{:012}.csv", self.events);
            let mut text = Vec::new();
            let written = trajectory.events_csv(&mut text);
            self.folder.put(&name, written.map(|()| text))?;
            lines.push(format!("events {name} {events}"));
        }
        lines.extend(state.map(str::to_owned));
        self.rows += table.len() as u64;
        self.events += events as u64;
        self.folder.note(&(lines.join("\n") + "\n"))
    }
}

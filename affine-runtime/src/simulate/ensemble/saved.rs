//! Ensembles that are written as they go.

use std::path::Path;

use super::Ensemble;
use crate::capability::InLanes;
use crate::error::{Error, Result};
use crate::lanes::F64x8;
use crate::model::{Handle, Model};
use crate::simulate::chunks::Folder;
use crate::simulate::format::Format;
use crate::simulate::motion::PointOf;
use crate::simulate::table::Table;

impl<'a, const N: usize, H: Handle<N> + 'a> Ensemble<'a, N, H> {
    /// Runs the ensemble and writes the outputs of its bodies, or their ends where there are no outputs, into a folder as they
    /// come: a file for each `chunk` of bodies, with the columns of [`Table::of_bodies`] and the values of a function of
    /// the number under `names`, and `manifest.txt`, a line for each file with its first and last body and its rows, and for each
    /// body that stopped with the reason.
    ///
    /// A run that is ended from outside loses the chunk under way at most: the same call goes on after the chunks that the
    /// manifest names, and gives the same bytes. Starts, models and events have to be the same; settings, shard and numbers are compared.
    ///
    /// # Errors
    /// [`Error::File`]; [`Error::RepeatedColumn`]; [`Setting::Checkpoint`](crate::simulate::Setting::Checkpoint) for a folder of
    /// another run; a [`Setting`](crate::simulate::Setting) that makes no sense.
    pub fn save(
        self,
        folder: impl AsRef<Path>,
        (format, chunk): (Format, usize),
        names: &[&str],
        values: impl Fn(u64) -> Vec<f64>,
    ) -> Result<()>
    where
        H: Sync,
        H::Model: InLanes<N>,
        PointOf<N, H>: Send + Sync,
    {
        let Self { plan, chosen, .. } = &self;
        let model = H::Model::DESCRIPTION.name;
        let run = format!(
            "bodies of {model}, chosen by {chosen:?}, {chunk} a file in {format:?}, {plan:?}, columns {names:?}"
        );
        let mut table = Table::of_bodies::<N, H::Model>(names)?;
        // Nothing is written of what would not run: the manifest is of these settings.
        self.checked()?;
        let (mut folder, there) = Folder::open(folder.as_ref(), &run, "chunk ", model)?;
        table.note("method", "RungeKutta8; bodies apart by closed forms, or Radau where friction is stiff");
        table.note("tolerance", plan.tolerance);
        let last = there.last().and_then(|line| line.split(' ').nth(3)?.parse::<u64>().ok());
        let rest = last.map_or(0, |last| last + 1)..u64::MAX;
        let expected = self.expected_outputs();
        let add = |outputs: &mut Vec<_>, t, point: &PointOf<N, H>| outputs.push((t, *point));
        let begin = |_, _: &H| Vec::with_capacity(expected);
        self.numbers(rest).chunks::<F64x8, _, Error>(chunk.max(1), &begin, &add, |parts| {
            let bodies = || parts.iter().flatten();
            let (Some(first), Some(last)) = (bodies().next(), bodies().next_back()) else { return Ok(()) };
            let mut lines = String::new();
            table.clear();
            for body in bodies() {
                let ends = body.end.iter().filter(|_| body.folded.is_empty()).map(|point| (body.t, *point));
                for (t, point) in body.folded.iter().copied().chain(ends) {
                    table.push::<N, H::Model>(body.number, &values(body.number), t, &point);
                }
                if let Err(stop) = &body.end {
                    lines += &format!("stopped {} at {:e}: {}\n", body.number, stop.t, stop.reason);
                }
            }
            let name = folder.write(&format!("chunk-{:012}", first.number), &table, format)?;
            lines += &format!("chunk {name} {} {} {}\n", first.number, last.number, table.len());
            folder.note(&lines)
        })
    }
}

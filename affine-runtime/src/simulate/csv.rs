//! Trajectories as comma-separated values.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use csv::Writer;

use super::trajectory::Trajectory;
use crate::error::{Error, Result};
use crate::frames::Matrix;
use crate::model::Quantity;
use crate::state::Phase;

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// Writes the outputs to a file, as [`csv`](Self::csv) does.
    ///
    /// # Errors
    /// [`Error::File`] with path and kind of the failure.
    pub fn save_csv(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let written = File::create(path).and_then(|file| self.csv(file));
        written.map_err(|error| Error::File { path: path.to_path_buf(), kind: error.kind() })
    }

    /// Writes a line of names, then a line per output: `t`, `x1`.. and `p1`.. where the model has translation,
    /// `phi11`, `phi12`.. row by row, and the model's momentum likewise (`Sigma`, `Sigma_hat` or `Pi`, which has
    /// the body index first). Numbers are the shortest decimals that read back as the same doubles.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn csv(&self, writer: impl Write) -> io::Result<()> {
        let columns = Columns::<N, P>::of(self);
        let mut lines = Writer::from_writer(writer);
        lines.write_record(core::iter::once("t".to_owned()).chain(columns.names()))?;
        for (t, point) in self.iter() {
            lines.write_record(core::iter::once(number(t)).chain(columns.values(point)))?;
        }
        lines.flush()
    }

    /// Writes the events likewise, a line per event: `event`, its name, `rising`, `true` or `false`, and then the columns of
    /// [`csv`](Self::csv).
    ///
    /// # Errors
    /// Those of the writer.
    pub fn events_csv(&self, writer: impl Write) -> io::Result<()> {
        let columns = Columns::<N, P>::of(self);
        let mut lines = Writer::from_writer(writer);
        let head = ["event", "rising", "t"].map(str::to_owned);
        lines.write_record(head.into_iter().chain(columns.names()))?;
        for event in self.events() {
            let head = [event.name.to_owned(), event.rising.to_string(), number(event.t)];
            lines.write_record(head.into_iter().chain(columns.values(&event.point)))?;
        }
        lines.flush()
    }
}

/// The shortest decimals that read back as the same double.
fn number(value: f64) -> String {
    format!("{value:e}")
}

/// What a line holds besides the time.
struct Columns<const N: usize, P> {
    translation: bool,
    momentum: (&'static str, fn(&P) -> Matrix<N>),
}

impl<const N: usize, P: Phase<N>> Columns<N, P> {
    fn of(trajectory: &Trajectory<N, P>) -> Self {
        let stored = |quantity| trajectory.description.full.iter().any(|group| group.quantity == quantity);
        let momentum: (&'static str, fn(&P) -> Matrix<N>) = if stored(Quantity::AffineSpin) {
            ("Sigma", |point| point.sigma().0.0)
        } else if stored(Quantity::ComovingAffineSpin) {
            ("Sigma_hat", |point| point.sigma_hat().0.0)
        } else {
            ("Pi", |point| point.pi().0.0)
        };
        Self { translation: stored(Quantity::Position), momentum }
    }

    fn names(&self) -> Vec<String> {
        let vector = |name: &str| (1..=N).map(|a| format!("{name}{a}")).collect::<Vec<_>>();
        let matrix = |name: &str| {
            let indices = (0..N * N).map(|k| (k / N + 1, k % N + 1));
            indices.map(|(a, b)| format!("{name}{a}{b}")).collect::<Vec<_>>()
        };
        let momentum = matrix(self.momentum.0);
        match self.translation {
            true => [vector("x"), matrix("phi"), vector("p"), momentum].concat(),
            false => [matrix("phi"), momentum].concat(),
        }
    }

    fn values(&self, point: &P) -> Vec<String> {
        let rows = |m: Matrix<N>| (0..N * N).map(move |k| number(m[(k / N, k % N)]));
        let mut values = Vec::with_capacity(2 * N * (N + 1));
        if self.translation {
            values.extend(point.x().iter().copied().map(number));
        }
        values.extend(rows(*point.phi()));
        if self.translation {
            values.extend(point.p().iter().copied().map(number));
        }
        values.extend(rows((self.momentum.1)(point)));
        values
    }
}

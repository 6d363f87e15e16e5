//! Columns of numbers under names: what leaves the program.

use core::fmt;

use super::trajectory::Trajectory;
use crate::error::{Error, Result};
use crate::frames::Matrix;
use crate::model::{Conserved, Description, Model, Quantity};
use crate::parametric::Fields;
use crate::state::Phase;

/// Columns of numbers under names, the same in every file that is written of them: of the outputs of a run,
/// [`Trajectory::table`], or of the bodies of an ensemble, [`of_bodies`](Self::of_bodies).
///
/// | name | column |
/// |---|---|
/// | `body` | number of the body in its ensemble |
/// | `t` | time |
/// | `x1`.., `p1`.. | centre and its momentum, where the model has translation |
/// | `phi11`, `phi12`.. | placement, row by row |
/// | `Sigma11`.., `Sigma_hat11`.. or `Pi11`.. | the model's momentum likewise; `Pi` has the body index first |
/// | `energy`, `work` | `H`, and the work of the forces that no potential has |
/// | `spin12`, `second_Casimir`.. | entries of what is conserved, by its name |
/// | `drift_energy`, `drift_spin`.. | how far that is from where it was at the start, by its norm |
///
/// With `metrics(...)` all but the norms stands in the bases that the user states the model in, as points do; the entries of what
/// is conserved are those of [`Conserved::of`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Table {
    about: Vec<(String, String)>,
    names: Vec<String>,
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    columns: Vec<Vec<f64>>,
}

impl Table {
    fn under(description: &Description, names: Vec<String>) -> Self {
        let about = [
            ("model", description.name),
            ("kinetic_energy", description.kinetic_energy.text),
            ("hamiltonian", description.hamiltonian.text),
        ];
        Self {
            about: about.map(|(key, text)| (key.to_owned(), text.to_owned())).to_vec(),
            columns: names.iter().map(|_| Vec::new()).collect(),
            names,
        }
    }

    /// A table of phase points of the bodies of an ensemble, without rows: `body`, a column for each name, `t`, and the
    /// columns of the point.
    ///
    /// # Errors
    /// [`Error::RepeatedColumn`] for a name that is given twice, or that another column has.
    pub fn of_bodies<const N: usize, M: Model<N>>(names: &[&str]) -> Result<Self> {
        let names = ["body"].iter().chain(names).chain(&["t"]).map(|name| (*name).to_owned());
        let names = names.chain(Columns::<N, M::Point<f64>>::of(&M::DESCRIPTION).names());
        let names: Vec<String> = names.collect();
        match (1..names.len()).find(|k| names[..*k].contains(&names[*k])) {
            Some(repeated) => Err(Error::RepeatedColumn { name: names[repeated].clone() }),
            None => Ok(Self::under(&M::DESCRIPTION, names)),
        }
    }

    /// Adds a row to a table [of bodies](Self::of_bodies): number, a value for each name, time and point. What is missing of
    /// the values is NaN, and what is too many is left out.
    pub fn push<const N: usize, M: Model<N>>(
        &mut self,
        body: u64,
        values: &[f64],
        t: f64,
        point: &M::Point<f64>,
    ) {
        let of_point = Columns::<N, M::Point<f64>>::of(&M::DESCRIPTION).values(point);
        let named = self.names.len() - 2 - of_point.len().min(self.names.len() - 2);
        let values = values.iter().copied().chain(core::iter::repeat(f64::NAN)).take(named);
        let row = core::iter::once(body as f64).chain(values).chain([t]).chain(of_point);
        self.add(row);
    }

    fn add(&mut self, row: impl Iterator<Item = f64>) {
        self.columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
    }

    /// What is known of the table as a whole, by keys: `model`, `kinetic_energy` and `hamiltonian` as the model has them, of a run
    /// `method` and `tolerance`, and what [`note`](Self::note) and [`note_fields`](Self::note_fields) have added.
    #[must_use]
    pub fn about(&self) -> &[(String, String)] {
        &self.about
    }

    /// Adds to what is known of the table as a whole, or says it anew: the value of a field, say.
    pub fn note(&mut self, key: &str, value: impl fmt::Display) {
        let value = value.to_string();
        match self.about.iter_mut().find(|(own, _)| own == key) {
            Some((_, own)) => *own = value,
            None => self.about.push((key.to_owned(), value)),
        }
    }

    /// Adds the values of the fields of a model, each under `field_` and its name, entries of a matrix with their row and column: what
    /// a run does not keep of its model. `run.table()` of `Body { c: 0.5 }.prepare()?` and `table.note_fields(&Body { c: 0.5 })`
    /// have `field_c`, 0.5.
    pub fn note_fields<const N: usize, F: Fields<N>>(&mut self, fields: &F) {
        let values = fields.values();
        let mut values = values.as_ref().iter();
        for field in F::FIELDS {
            for entry in 0..field.rows * field.rows {
                let place = (entry / field.rows + 1, entry % field.rows + 1);
                let place = if field.rows == 1 { String::new() } else { format!("{}{}", place.0, place.1) };
                let value = values.next().copied().unwrap_or(f64::NAN);
                self.note(&format!("field_{}{place}", field.name), value);
            }
        }
    }

    /// The names of the columns.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// A column, by its name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let (_, column) = self.columns().find(|(own, _)| *own == name)?;
        Some(column)
    }

    /// The columns with their names.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.names.iter().map(String::as_str).zip(self.columns.iter().map(Vec::as_slice))
    }

    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// There are no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The numbers of a row.
    pub(super) fn row(&self, row: usize) -> impl Iterator<Item = f64> {
        self.columns.iter().map(move |column| column.get(row).copied().unwrap_or(f64::NAN))
    }

    /// Leaves the names alone.
    pub fn clear(&mut self) {
        self.columns.iter_mut().for_each(Vec::clear);
    }
}

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// The outputs as columns: time, point, energies, what is conserved, and its drift.
    #[must_use]
    pub fn table(&self) -> Table {
        let columns = Columns::<N, P>::of(self.description);
        let is_balanced = self.description.reduced.iter().any(|group| group.quantity == Quantity::Work);
        let conserved = self.quantities();
        let start = self.start.1;
        let mut names = vec!["t".to_owned()];
        names.extend(columns.names());
        names.push("energy".to_owned());
        names.extend(is_balanced.then(|| "work".to_owned()));
        names.extend(conserved.iter().flat_map(|quantity| self.names_of(*quantity)));
        names.extend(conserved.iter().map(|quantity| format!("drift_{}", name(*quantity))));
        let mut table = Table::under(self.description, names);
        table.note("method", format_args!("{:?}", self.computation.method));
        table.note("tolerance", self.computation.tolerance);
        for (k, (t, point)) in self.iter().enumerate() {
            let energy = self.energies.outputs.get(k).copied().unwrap_or(f64::NAN);
            let work = is_balanced.then(|| self.energies.work.get(k).copied().unwrap_or(f64::NAN));
            let values = conserved.iter().flat_map(|quantity| {
                let value = quantity.of(point, self.bases.as_deref());
                value.iter().flat_map(|value| value.as_slice().to_vec()).collect::<Vec<_>>()
            });
            let drifts = conserved.iter().map(|quantity| {
                match self.value(*quantity, point).zip(self.value(*quantity, &start)) {
                    Some((value, at_start)) => value.distance(&at_start),
                    None => (energy - self.energies.start).abs(),
                }
            });
            let head = core::iter::once(t).chain(columns.values(point)).chain([energy]).chain(work);
            table.add(head.chain(values).chain(drifts));
        }
        table
    }

    /// The start as arguments of `at_momentum`: what each is called, and its numbers, of matrices row by row.
    #[cfg(feature = "report")]
    pub(crate) fn start_as_arguments(&self) -> Vec<(&'static str, Vec<f64>)> {
        let columns = Columns::<N, P>::of(self.description);
        let names = match columns.translation {
            true => vec!["x", "phi", "p", columns.momentum.0],
            false => vec!["phi", columns.momentum.0],
        };
        let mut values = columns.values(&self.start.1).into_iter();
        let mut argument = |name: &'static str| {
            let length = if matches!(name, "x" | "p") { N } else { N * N };
            (name, values.by_ref().take(length).collect())
        };
        names.into_iter().map(&mut argument).collect()
    }

    /// The columns of a conserved quantity.
    fn names_of(&self, quantity: Conserved) -> Vec<String> {
        let own = name(quantity);
        let Some(value) = quantity.of(&self.start.1, self.bases.as_deref()) else { return Vec::new() };
        let is_vector = matches!(quantity, Conserved::LinearMomentum | Conserved::ComovingLinearMomentum);
        match value.as_slice().len() {
            // One entry of a skew matrix has its indices all the same.
            1 if !matches!(quantity, Conserved::Spin | Conserved::Vorticity) => vec![own],
            len if is_vector => (1..=len).map(|a| format!("{own}{a}")).collect(),
            len => {
                let entries = (0..N * N).map(|k| (k / N + 1, k % N + 1));
                let entries = entries.filter(|(a, b)| len == N * N || a < b);
                entries.map(|(a, b)| format!("{own}{a}{b}")).collect()
            }
        }
    }
}

/// The name of a quantity, as one word.
fn name(quantity: Conserved) -> String {
    quantity.name().replace([' ', '-'], "_")
}

/// The columns of a phase point.
pub(super) struct Columns<const N: usize, P> {
    translation: bool,
    momentum: (&'static str, fn(&P) -> Matrix<N>),
}

impl<const N: usize, P: Phase<N>> Columns<N, P> {
    pub(super) fn of(description: &Description) -> Self {
        let stored = |quantity| description.full.iter().any(|group| group.quantity == quantity);
        let momentum: (&'static str, fn(&P) -> Matrix<N>) = if stored(Quantity::AffineSpin) {
            ("Sigma", |point| point.sigma().0.0)
        } else if stored(Quantity::ComovingAffineSpin) {
            ("Sigma_hat", |point| point.sigma_hat().0.0)
        } else {
            ("Pi", |point| point.pi().0.0)
        };
        Self { translation: stored(Quantity::Position), momentum }
    }

    pub(super) fn names(&self) -> Vec<String> {
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

    pub(super) fn values(&self, point: &P) -> Vec<f64> {
        let rows = |m: Matrix<N>| (0..N * N).map(move |k| m[(k / N, k % N)]);
        let (x, p, moving) = (point.x(), point.p(), if self.translation { N } else { 0 });
        let placed = x.iter().take(moving).copied().chain(rows(*point.phi()));
        placed.chain(p.iter().take(moving).copied()).chain(rows((self.momentum.1)(point))).collect()
    }
}

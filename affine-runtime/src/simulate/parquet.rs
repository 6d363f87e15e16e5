//! Tables as files in the columnar format Apache Parquet, which pandas, Polars and DuckDB read.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{Repetition, Type as Physical};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::table::Table;

/// Rows that stand together in a file, and are in memory together where it is read by parts.
const TOGETHER: usize = 1 << 20;

impl Table {
    /// Writes the columns as Parquet, doubles under their names, with what is [known of the table](Self::about) as metadata of the
    /// file: `pandas.read_parquet(path)` gives the table, `pyarrow.parquet.read_metadata(path).metadata` the rest. The same table
    /// gives the same bytes.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn parquet(&self, writer: impl Write + Send) -> io::Result<()> {
        self.written(writer).map_err(|error| match error {
            ParquetError::External(error) => match error.downcast::<io::Error>() {
                Ok(error) => *error,
                Err(error) => io::Error::other(error),
            },
            error => io::Error::other(error),
        })
    }

    fn written(&self, writer: impl Write + Send) -> core::result::Result<(), ParquetError> {
        let double = |name: &String| {
            let column = Type::primitive_type_builder(name, Physical::DOUBLE);
            column.with_repetition(Repetition::REQUIRED).build().map(Arc::new)
        };
        let columns = self.names().iter().map(double).collect::<core::result::Result<Vec<_>, _>>()?;
        let schema = Type::group_type_builder("table").with_fields(columns).build()?;
        let about = self.about().iter().map(|(key, text)| KeyValue::new(key.clone(), text.clone())).collect();
        // Doubles as they are: few of them are there twice.
        let properties = WriterProperties::builder().set_dictionary_enabled(false);
        let properties = properties.set_key_value_metadata(Some(about)).build();
        let mut file = SerializedFileWriter::new(writer, Arc::new(schema), Arc::new(properties))?;
        for start in (0..self.len()).step_by(TOGETHER) {
            let mut rows = file.next_row_group()?;
            for (_, column) in self.columns() {
                let end = column.len().min(start + TOGETHER);
                let missing = || ParquetError::General("a column without a place in the file".to_owned());
                let mut own = rows.next_column()?.ok_or_else(missing)?;
                own.typed::<DoubleType>().write_batch(&column[start..end], None, None)?;
                own.close()?;
            }
            rows.close()?;
        }
        file.close().map(drop)
    }
}

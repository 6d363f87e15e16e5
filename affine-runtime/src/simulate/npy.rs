//! Tables as arrays of NumPy.

use std::io::{self, Seek, Write};

use npyz::WriterBuilder;
use npyz::npz::file_name_from_array_name;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::table::Table;

impl Table {
    /// Writes the columns as a `.npz` archive, an array of doubles for each name: `numpy.load` gives them by their names, and
    /// `pandas.DataFrame(dict(numpy.load(path)))` the table.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn npz(&self, writer: impl Write + Seek) -> io::Result<()> {
        let mut archive = ZipWriter::new(writer);
        // As the columns are: nothing is compressed, and files of the same numbers have the same bytes.
        let options = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
        for (name, column) in self.columns() {
            archive.start_file(file_name_from_array_name(name), options.large_file(true))?;
            let array = npyz::WriteOptions::new().default_dtype().shape(&[column.len() as u64]);
            let mut array = array.writer(&mut archive).begin_nd()?;
            array.extend(column.iter().copied())?;
            array.finish()?;
        }
        archive.finish()?.flush()
    }
}

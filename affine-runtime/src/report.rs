//! Reports.
mod axes;
mod canvas;
mod diagram;
mod palette;
mod scene;
mod view;

pub use diagram::{LEAST_ERROR, Series, WorkPrecisionDiagram, WorkPrecisionPoint};

fn save(path: &std::path::Path, contents: std::io::Result<String>) -> crate::Result<()> {
    contents
        .and_then(|contents| std::fs::write(path, contents))
        .map_err(|_| crate::Error::NotFinite { quantity: "x" })
}

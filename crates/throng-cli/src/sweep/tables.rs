//! The tables of a sweep.

use crate::failure::Failure;
use crate::files::{distinct, is};
use std::path::{Path, PathBuf};
use throng_record::sweep::{Plan, ResultTable, Row, collect};
use throng_record::{Output, OutputError};

/// Writes a table.
type WriteTable = fn(&ResultTable, Output) -> Result<(), OutputError>;

/// The tables, which get their names when they are complete.
pub struct Tables(Vec<(Output, WriteTable)>);

impl Tables {
    /// Creates the files.
    ///
    /// # Errors
    /// The kind of a table does not follow from its name, or a file cannot be created.
    pub fn create(paths: &[PathBuf]) -> Result<Self, Failure> {
        paths.iter().for_each(Output::remove_leftovers);
        let table = |path: &PathBuf| Ok::<_, Failure>((Output::create(path)?, format(path)?));
        Ok(Self(paths.iter().map(table).collect::<Result<_, _>>()?))
    }

    /// Writes the rows and completes the files.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(self, plan: &Plan, rows: Vec<Row>) -> Result<(), Failure> {
        let table = collect(plan, rows);
        Ok(self.0.into_iter().try_for_each(|(output, write)| write(&table, output))?)
    }
}

/// Checks the names of tables.
///
/// # Errors
/// A name is given twice, or the kind of a table does not follow from its name.
pub fn check(paths: &[PathBuf]) -> Result<(), Failure> {
    distinct(paths)?;
    paths.iter().try_for_each(|path| format(path).map(drop))
}

fn format(path: &Path) -> Result<WriteTable, Failure> {
    let formats: [(&str, WriteTable); 3] =
        [("parquet", ResultTable::write_parquet), ("csv", ResultTable::write_csv), ("json", ResultTable::write_json)];
    let format = formats.into_iter().find(|(ending, _)| is(path, ending)).map(|(_, write)| write);
    format.ok_or_else(|| {
        let text = format!("{}: cannot tell what to write from this name", path.display());
        Failure::hint(text, "end it in .parquet, .csv or .json")
    })
}

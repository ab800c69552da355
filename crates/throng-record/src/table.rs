//! Figures as a table of numbers.

use crate::{Output, OutputError};
use std::io::Write;

/// A table of numbers: named columns of equal length. Unknown values are NaN, and empty in a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The names of the columns.
    pub names: Vec<String>,
    /// The values of the columns.
    pub columns: Vec<Vec<f64>>,
}

impl Table {
    /// Adds a column.
    pub fn push(&mut self, name: impl Into<String>, values: Vec<f64>) {
        self.names.push(name.into());
        self.columns.push(values);
    }

    /// Writes the table as comma-separated values under a line of names.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("figures.csv");
    /// use throng_record::{Output, Table};
    /// let mut table = Table::default();
    /// table.push("time", vec![0.0, 0.5]);
    /// table.push("speed", vec![1.25, f64::NAN]);
    /// table.write_csv(Output::create(&path)?)?;
    /// assert_eq!(std::fs::read_to_string(&path)?, "time,speed\n0,1.25\n0.5,\n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn write_csv(&self, mut output: Output) -> Result<(), OutputError> {
        output.put((self.names.join(",") + "\n").as_bytes())?;
        for row in 0..self.columns.first().map_or(0, Vec::len) {
            for (k, column) in self.columns.iter().enumerate() {
                let comma = if k > 0 { "," } else { "" };
                let value = column[row];
                let wrote =
                    if value.is_finite() { write!(output, "{comma}{value}") } else { write!(output, "{comma}") };
                wrote.map_err(|error| output.error(error))?;
            }
            output.put(b"\n")?;
        }
        output.finish()
    }
}

//! The table of all results.

use super::{Plan, Row};
use crate::{Cell, Output, OutputError};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// The results of a plan's runs: one row a run, in the order of their numbers. Columns are those of all rows: the
/// number, the scene, the parameters, the seed and the results. A value that a row does not have is unknown.
#[derive(Clone, Debug, Default)]
pub struct ResultTable {
    columns: Vec<ResultColumn>,
    rows: usize,
}

/// A column and the values that are known, by row.
#[derive(Clone, Debug)]
pub(crate) struct ResultColumn {
    pub name: String,
    pub cells: Vec<Option<Cell>>,
}

/// Returns the table of rows of a plan, in any order.
pub fn collect(plan: &Plan, rows: impl IntoIterator<Item = Row>) -> ResultTable {
    let mut rows: Vec<Row> = rows.into_iter().collect();
    rows.sort_by_key(|row| row.index);
    // the columns that every plan has, even without rows
    let mut table = ResultTable::default();
    let mut places = BTreeMap::new();
    let first = plan.run(0).map(|run| Row::of(&run, Vec::new()));
    let names: Vec<String> = first.iter().flat_map(Row::cells).map(|(name, _)| name.to_owned()).collect();
    for name in names {
        table.column(&name, &mut places);
    }
    for row in rows {
        for (name, cell) in row.cells() {
            let place = table.column(name, &mut places);
            let column = &mut table.columns[place].cells;
            column.resize(table.rows, None);
            column.push(Some(cell));
        }
        table.rows += 1;
    }
    table.columns.iter_mut().for_each(|column| column.cells.resize(table.rows, None));
    table
}

impl ResultTable {
    /// Returns the position of a column, which is added if it is new.
    fn column(&mut self, name: &str, places: &mut BTreeMap<String, usize>) -> usize {
        if let Some(&place) = places.get(name) {
            return place;
        }
        places.insert(name.to_owned(), self.columns.len());
        self.columns.push(ResultColumn { name: name.to_owned(), cells: Vec::new() });
        self.columns.len() - 1
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the names of the columns.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|column| column.name.as_str())
    }

    /// Returns a value; `None` if the row does not have it.
    pub fn cell(&self, row: usize, column: &str) -> Option<&Cell> {
        self.columns.iter().find(|other| other.name == column)?.cells.get(row)?.as_ref()
    }

    /// Writes the table as Apache Parquet: whole numbers of 64 bits, doubles, truths and texts, each of which may be
    /// null. Equal tables are equal bytes.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    #[cfg(feature = "parquet")]
    pub fn write_parquet(&self, output: Output) -> Result<(), OutputError> {
        crate::formats::parquet::write_results(output, &self.columns)
    }

    /// Writes the table as comma-separated values under a line of names.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn write_csv(&self, mut output: Output) -> Result<(), OutputError> {
        let line = |cells: Vec<String>| cells.join(",") + "\n";
        output.put(line(self.names().map(quoted).collect()).as_bytes())?;
        for row in 0..self.rows {
            let cell = |column: &ResultColumn| {
                column.cells[row].as_ref().map_or_else(String::new, |cell| quoted(&cell.text()))
            };
            output.put(line(self.columns.iter().map(cell).collect()).as_bytes())?;
        }
        output.finish()
    }

    /// Writes the table as JSON: a list of objects, one a row.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn write_json(&self, mut output: Output) -> Result<(), OutputError> {
        output.put(b"[")?;
        for row in 0..self.rows {
            let comma = if row > 0 { ",\n" } else { "\n" };
            output.put(format!("{comma}{}", self.row(row)).as_bytes())?;
        }
        output.put(b"\n]\n")?;
        output.finish()
    }

    /// Returns a row as a JSON object.
    fn row(&self, row: usize) -> Value {
        let cell = |column: &ResultColumn| column.cells[row].as_ref().map_or(Value::Null, Cell::json);
        Value::Object(Map::from_iter(self.columns.iter().map(|column| (column.name.clone(), cell(column)))))
    }
}

/// Returns a text as a value of CSV.
fn quoted(text: &str) -> String {
    match text.contains(['"', ',', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

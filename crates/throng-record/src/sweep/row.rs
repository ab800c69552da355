//! Rows of results.

use super::SweepRun;
use crate::Cell;

/// The result of a run: a row of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The number of the run, from 0.
    pub index: usize,
    /// The name of the scene, as in the plan.
    pub scene: String,
    /// The parameters that vary.
    pub parameters: Vec<Parameter>,
    /// The seed.
    pub seed: u64,
    /// The results by the names of columns: `error` first, and nothing else if the run could not be made.
    pub results: Vec<(String, Cell)>,
}

/// A parameter of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The name of the column.
    pub column: String,
    /// The value.
    pub cell: Cell,
}

impl Row {
    /// Returns the row of a run with these results.
    pub fn of(run: &SweepRun, results: Vec<(String, Cell)>) -> Self {
        let (scene, parameters) = (run.scene.name.clone(), run.parameters());
        Self { index: run.index, scene, parameters, seed: run.seed(), results }
    }

    /// Returns why the run could not be made; `None` if it was made.
    pub fn error(&self) -> Option<&str> {
        match self.results.first() {
            Some((_, Cell::Text(error))) => error.as_deref(),
            _ => None,
        }
    }

    /// Returns the cells of the row, with the names of their columns.
    pub fn cells(&self) -> impl Iterator<Item = (&str, Cell)> {
        let first = [("index", self.index.into()), ("scene", Cell::Text(Some(self.scene.clone())))];
        let parameters = self.parameters.iter().map(|parameter| (parameter.column.as_str(), parameter.cell.clone()));
        let results = self.results.iter().map(|(name, cell)| (name.as_str(), cell.clone()));
        first.into_iter().chain(parameters).chain([("seed", Cell::from(self.seed))]).chain(results)
    }
}

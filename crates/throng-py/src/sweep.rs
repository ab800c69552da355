//! Sweeps: the runs of a plan, one at a time, for any scheduler.

use crate::error::{FileError, scene_error};
use crate::threads::Threads;
use pyo3::exceptions::{PyIndexError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use throng_record::sweep::{FileFingerprints, Fingerprint, ResultTable, Row, RunFolder, SweepRun, collect, run_one};
use throng_record::{Cell, Output, OutputError};
use throng_scene::Plugins;

/// The runs of a sweep.
#[pyclass(frozen, module = "throng_sim._throng")]
pub struct Plan {
    plan: throng_record::sweep::Plan,
    files: FileFingerprints,
    stopped: AtomicBool,
}

#[pymethods]
impl Plan {
    /// Reads the text of a plan. Names of files in it are relative to `folder`.
    #[staticmethod]
    fn parse(py: Python<'_>, name: &str, text: &str, folder: PathBuf) -> PyResult<Self> {
        let plan = throng_record::sweep::Plan::parse(name, text, folder, &Plugins::new());
        Ok(Self {
            plan: plan.map_err(|error| scene_error(py, &error))?,
            files: FileFingerprints::default(),
            stopped: AtomicBool::new(false),
        })
    }

    fn __len__(&self) -> usize {
        self.plan.len()
    }

    /// The title of the plan.
    #[getter]
    fn title(&self) -> &str {
        &self.plan.title
    }

    /// The numbers of the runs that have no results in a folder.
    fn missing(&self, py: Python<'_>, folder: PathBuf) -> Vec<usize> {
        let folder = RunFolder::at(folder);
        py.detach(|| {
            let kept = |run: &SweepRun| folder.row(run, Fingerprint::of(run, &self.files)).is_some();
            self.plan.runs().filter(|run| !kept(run)).map(|run| run.index).collect()
        })
    }

    /// Makes a run on one thread and returns its results as JSON.
    fn make(&self, py: Python<'_>, index: usize) -> PyResult<String> {
        let run = self.run(index)?;
        let goes_on = || !self.stopped.load(Ordering::Relaxed);
        let threads = Threads::new(1).start()?;
        let made = py.detach(|| threads.install(|| run_one(&run, goes_on)));
        let Some(row) = made else { return Err(PyRuntimeError::new_err("the run was stopped")) };
        serde_json::to_string(&row.results).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// Ends the runs that are being made, after a step.
    fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    /// Keeps the results of a run in a folder.
    fn keep(&self, index: usize, results: &str, folder: PathBuf) -> PyResult<()> {
        let run = self.run(index)?;
        let folder = RunFolder::create(folder).map_err(|error| file_error(&error))?;
        let row = row(&run, results)?;
        folder.keep(&row, Fingerprint::of(&run, &self.files)).map_err(|error| file_error(&error))
    }

    /// Writes the table of the results in a folder. Returns the number of runs with results there, and the number of
    /// those that could not be made.
    fn write(&self, py: Python<'_>, folder: PathBuf, paths: Vec<PathBuf>) -> PyResult<(usize, usize)> {
        let folder = RunFolder::at(folder);
        let rows: Vec<Row> = py.detach(|| {
            self.plan.runs().filter_map(|run| folder.row(&run, Fingerprint::of(&run, &self.files))).collect()
        });
        let failed = rows.iter().filter(|row| row.error().is_some()).count();
        let count = rows.len();
        let table = collect(&self.plan, rows);
        paths.iter().try_for_each(|path| write(&table, path))?;
        Ok((count, failed))
    }
}

impl Plan {
    fn run(&self, index: usize) -> PyResult<SweepRun<'_>> {
        let count = self.plan.len();
        self.plan
            .run(index)
            .ok_or_else(|| PyIndexError::new_err(format!("there is no run {index}: the plan has {count}")))
    }
}

fn row(run: &SweepRun, results: &str) -> PyResult<Row> {
    let results: Vec<(String, Cell)> = serde_json::from_str(results)
        .map_err(|error| PyValueError::new_err(format!("these are not the results of a run: {error}")))?;
    Ok(Row::of(run, results))
}

fn write(table: &ResultTable, path: &Path) -> PyResult<()> {
    let output = || Output::create(path).map_err(|error| file_error(&error));
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let written = match ending.as_deref() {
        Some("parquet") => table.write_parquet(output()?),
        Some("csv") => table.write_csv(output()?),
        Some("json") => table.write_json(output()?),
        _ => {
            let text = format!("{}: a table of results ends in .parquet, .csv or .json", path.display());
            return Err(PyValueError::new_err(text));
        }
    };
    written.map_err(|error| file_error(&error))
}

fn file_error(error: &OutputError) -> PyErr {
    FileError::new_err(error.to_string())
}

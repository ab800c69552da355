//! Errors of the engine as Python exceptions.

use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

create_exception!(
    throng_sim,
    SceneError,
    PyValueError,
    "An error in a scene: where it is, what it is, and how to fix it."
);
create_exception!(throng_sim, WorldError, PyValueError, "A value that a world refuses.");
create_exception!(throng_sim, FileError, PyRuntimeError, "A file that cannot be written.");

/// Returns an error in a scene as an exception with the attributes `kind`, `what`, `file`, `line`, `column` and `hint`.
pub fn scene_error(py: Python<'_>, error: &throng_scene::Error) -> PyErr {
    let raised = SceneError::new_err(error.to_string());
    let value = raised.value(py);
    let set = || -> PyResult<()> {
        value.setattr("kind", format!("{:?}", error.kind))?;
        value.setattr("what", &error.message)?;
        value.setattr("file", error.file.as_deref())?;
        value.setattr("line", error.at.map(|(line, _)| line))?;
        value.setattr("column", error.at.map(|(_, column)| column))?;
        value.setattr("hint", error.hint.as_deref())
    };
    match set() {
        Ok(()) => raised,
        Err(other) => other,
    }
}

/// Returns an error of a world as an exception.
pub fn world_error(error: &throng::Error) -> PyErr {
    WorldError::new_err(error.to_string())
}

//! The bodies of people: joints, skeletons, meshes, colours.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use throng_figure::{Build, Joint, Level, Look, Mesh, Region, Skeleton};

const LEVELS: [(&str, Level); 4] =
    [("fine", Level::Fine), ("medium", Level::Medium), ("coarse", Level::Coarse), ("blocks", Level::Blocks)];

/// Returns the names of the builds.
#[pyfunction]
pub fn builds() -> Vec<&'static str> {
    Build::ALL.map(Build::name).to_vec()
}

/// Returns the names of the joints, and the number of the parent of each; -1 for the hips.
#[pyfunction]
pub fn joints() -> (Vec<&'static str>, Vec<i64>) {
    let parent = |joint: Joint| joint.parent().map_or(-1, |parent| parent.index() as i64);
    (Joint::ALL.map(Joint::name).to_vec(), Joint::ALL.map(parent).to_vec())
}

/// Returns the offsets of the joints of a build from their parents at rest, for a height of 1 m: of the hips, from the
/// ground.
#[pyfunction]
pub fn skeleton<'py>(py: Python<'py>, build: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let skeleton = Skeleton::scaled(build_of(build)?, 1.0);
    table(py, Joint::ALL.iter().flat_map(|&joint| skeleton.offset(joint).to_array()), 3)
}

/// Returns the mesh of a build of height 1 m at a level of detail.
#[pyfunction]
pub fn mesh<'py>(py: Python<'py>, build: &str, level: &str) -> PyResult<Bound<'py, PyDict>> {
    let mesh = Mesh::new(build_of(build)?, level_of(level)?);
    let out = PyDict::new(py);
    out.set_item("positions", table(py, mesh.positions.iter().flat_map(|point| point.to_array()), 3)?)?;
    out.set_item("normals", table(py, mesh.normals.iter().flat_map(|normal| normal.to_array()), 3)?)?;
    out.set_item("joints", table(py, mesh.joints.iter().flatten().copied(), 4)?)?;
    out.set_item("weights", table(py, mesh.weights.iter().flatten().copied(), 4)?)?;
    out.set_item("triangles", table(py, mesh.triangles.iter().flatten().copied(), 3)?)?;
    out.set_item("regions", PyArray1::from_iter(py, mesh.regions.iter().map(|&region| region as u8)))?;
    Ok(out)
}

/// Returns the names of the regions.
#[pyfunction]
pub fn regions() -> Vec<&'static str> {
    Region::ALL.map(Region::name).to_vec()
}

/// Returns the numbers of the regions that a look wears.
#[pyfunction]
pub fn look_worn(look: u8) -> Vec<u32> {
    // a vector of u8 becomes `bytes` in Python
    Look::new(look).worn().into_iter().map(|region| region as u32).collect()
}

/// Returns the colours of a look, a row for each region (sRGB, 0 to 255); black for what it does not wear.
#[pyfunction]
pub fn look_colors<'py>(py: Python<'py>, look: u8) -> PyResult<Bound<'py, PyArray2<u8>>> {
    let look = Look::new(look);
    table(py, Region::ALL.iter().flat_map(|&region| look.colour(region).unwrap_or_default()), 3)
}

/// Returns an array with `columns` columns.
fn table<T: numpy::Element>(
    py: Python<'_>,
    values: impl Iterator<Item = T>,
    columns: usize,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let values = PyArray1::from_iter(py, values);
    let rows = values.len()? / columns;
    values.reshape([rows, columns])
}

fn build_of(name: &str) -> PyResult<Build> {
    Build::named(name).ok_or_else(|| unknown("build", name, &builds()))
}

fn level_of(name: &str) -> PyResult<Level> {
    let found = LEVELS.into_iter().find(|(known, _)| *known == name);
    found.map(|(_, level)| level).ok_or_else(|| unknown("level", name, &LEVELS.map(|(known, _)| known)))
}

fn unknown(what: &str, name: &str, known: &[&str]) -> PyErr {
    PyValueError::new_err(format!("`{name}` is no {what}: give {}", known.join(", ")))
}

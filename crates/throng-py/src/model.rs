//! Local models in Python: they get the agents as arrays and return velocities.

use glam::Vec2;
use numpy::ndarray::Array2;
use numpy::{Element, PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::ThreadId;
use throng::avoid::{AvoidanceInput, Crowd, CrowdArrays, CrowdModel, LocalModel, Workspace};

/// What a world and its Python model tell each other during a step.
#[derive(Default)]
pub struct Calls {
    /// The thread that is inside of the model.
    pub inside: Mutex<Option<ThreadId>>,
    /// The exception that the model raised. The model is not called again until a step has reported it.
    pub raised: Mutex<Option<PyErr>>,
}

impl Calls {
    /// Whether this thread is inside of the model.
    pub fn is_inside(&self) -> bool {
        *lock(&self.inside) == Some(std::thread::current().id())
    }

    /// Whether the model has raised an exception.
    pub fn has_raised(&self) -> bool {
        lock(&self.raised).is_some()
    }

    /// Takes the exception that the model raised.
    pub fn take(&self) -> Option<PyErr> {
        lock(&self.raised).take()
    }
}

/// Locks a mutex that is held for an instant only.
pub fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A function of a [`View`], which returns velocities, an array of `float64` with two columns: one reference for a world and its groups, so that Python can
/// collect a world that its own model refers to. `None` after that.
pub type Function = Arc<Mutex<Option<Py<PyAny>>>>;

/// A local model in Python.
pub struct PythonModel {
    pub function: Function,
    /// Metres in which an agent sees walls, from its body.
    pub sees: f32,
    pub calls: Arc<Calls>,
}

impl std::fmt::Debug for PythonModel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PythonModel").field("sees", &self.sees).finish_non_exhaustive()
    }
}

impl LocalModel for PythonModel {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        view.preferred
    }

    fn together(&self) -> Option<&dyn CrowdModel> {
        Some(self)
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius + self.sees
    }
}

impl CrowdModel for PythonModel {
    fn choose(&self, crowd: &mut Crowd<'_>) {
        if self.calls.has_raised() {
            return;
        }
        Python::attach(|py| {
            *lock(&self.calls.inside) = Some(std::thread::current().id());
            let called = self.call(py, crowd);
            *lock(&self.calls.inside) = None;
            match called {
                Ok(velocities) => {
                    velocities.into_iter().enumerate().for_each(|(k, velocity)| crowd.set_horizontal(k, velocity));
                }
                Err(error) => *lock(&self.calls.raised) = Some(error),
            }
        });
    }
}

impl PythonModel {
    fn call(&self, py: Python<'_>, crowd: &Crowd<'_>) -> PyResult<Vec<Vec2>> {
        let function = lock(&self.function).as_ref().map(|function| function.clone_ref(py));
        let Some(function) = function else { return Err(PyRuntimeError::new_err("the world has been collected")) };
        let view = Bound::new(py, View::new(py, crowd)?)?;
        let returned: PyReadonlyArray2<'_, f64> = function.bind(py).call1((&view,))?.extract()?;
        let rows = returned.as_array();
        if rows.dim() != (crowd.len(), 2) {
            return Err(PyValueError::new_err(format!(
                "the shape is {:?}, but must be ({}, 2)",
                rows.dim(),
                crowd.len()
            )));
        }
        Ok(rows.rows().into_iter().map(|row| Vec2::new(row[0] as f32, row[1] as f32)).collect())
    }
}

/// What the agents of a model see at the start of a sub-step. Each array has a row for each agent. `near_start[k]` to
/// `near_start[k + 1]` are the rows of the neighbours of agent `k`, nearest first; likewise for the walls.
#[pyclass(frozen, get_all, module = "throng_sim._throng")]
pub struct View {
    /// Time at the start of the step, seconds.
    time: f64,
    /// Duration of the sub-step, seconds.
    dt: f32,
    /// Numbers of the agents.
    ids: Py<PyArray1<u32>>,
    /// World coordinates, metres.
    positions: Py<PyArray2<f64>>,
    /// Velocities, m/s.
    velocities: Py<PyArray2<f32>>,
    /// Preferred velocities, m/s.
    preferred: Py<PyArray2<f32>>,
    /// Radii of the bodies, metres.
    radii: Py<PyArray1<f32>>,
    /// Top speeds, m/s.
    max_speeds: Py<PyArray1<f32>>,
    /// Headings, radians counter-clockwise from +x.
    headings: Py<PyArray1<f32>>,
    /// The first neighbour of each agent, and the end.
    near_start: Py<PyArray1<i64>>,
    /// Numbers of the neighbours.
    near_ids: Py<PyArray1<u32>>,
    /// Their centres, from that of the agent, metres.
    near_offsets: Py<PyArray2<f32>>,
    /// Their velocities, m/s.
    near_velocities: Py<PyArray2<f32>>,
    /// Sums of both radii, metres.
    near_radii: Py<PyArray1<f32>>,
    /// The agent's share of the avoidance, 0 to 1.
    near_shares: Py<PyArray1<f32>>,
    /// The first wall of each agent, and the end.
    wall_start: Py<PyArray1<i64>>,
    /// Both ends of the walls, from the centre of the agent, metres: x, y, x, y.
    walls: Py<PyArray2<f32>>,
}

impl View {
    fn new(py: Python<'_>, crowd: &Crowd<'_>) -> PyResult<Self> {
        let arrays = CrowdArrays::of(crowd);
        Ok(Self {
            time: arrays.time,
            dt: arrays.seconds,
            ids: list(py, arrays.numbers),
            positions: array2(py, arrays.positions.iter().flat_map(|at| at.to_array()).collect(), 2)?,
            velocities: table(py, &arrays.velocities)?,
            preferred: table(py, &arrays.preferred)?,
            radii: list(py, arrays.radii),
            max_speeds: list(py, arrays.max_speeds),
            headings: list(py, arrays.headings),
            near_start: list(py, arrays.near_start),
            near_ids: list(py, arrays.near_numbers),
            near_offsets: table(py, &arrays.near_offsets)?,
            near_velocities: table(py, &arrays.near_velocities)?,
            near_radii: list(py, arrays.near_radii),
            near_shares: list(py, arrays.near_shares),
            wall_start: list(py, arrays.wall_start),
            walls: array2(py, arrays.walls.into_iter().flatten().collect(), 4)?,
        })
    }
}

/// Returns an array with one dimension.
pub fn list<T: Element>(py: Python<'_>, values: Vec<T>) -> Py<PyArray1<T>> {
    PyArray1::from_vec(py, values).unbind()
}

/// Returns an array with two columns.
fn table(py: Python<'_>, rows: &[Vec2]) -> PyResult<Py<PyArray2<f32>>> {
    array2(py, rows.iter().flat_map(|row| row.to_array()).collect(), 2)
}

/// Returns an array with this number of columns.
pub fn array2<T: Element>(py: Python<'_>, values: Vec<T>, columns: usize) -> PyResult<Py<PyArray2<T>>> {
    let shape = (values.len() / columns, columns);
    let array = Array2::from_shape_vec(shape, values).map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(PyArray2::from_owned_array(py, array).unbind())
}

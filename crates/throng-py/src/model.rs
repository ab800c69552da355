//! Local models in Python: they get the agents as arrays and return velocities.

use glam::Vec2;
use numpy::ndarray::Array2;
use numpy::{Element, PyArray1, PyArray2, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::ThreadId;
use throng::avoid::{AvoidanceInput, Crowd, CrowdModel, LocalModel, Workspace};

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

/// A function of a [`View`], which returns velocities: one reference for a world and its groups, so that Python can
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
                    velocities.into_iter().enumerate().for_each(|(k, velocity)| {
                        let up = crowd.input(k).preferred_vertical_velocity;
                        crowd.set(k, velocity.extend(up));
                    });
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
        velocities(function.bind(py).call1((&view,))?.as_any(), crowd.len())
    }
}

/// Reads the velocities that a model returned for `count` agents.
fn velocities(returned: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<Vec2>> {
    let wanted = format!("an array of {count} by 2 numbers, a velocity in m/s for each agent of the view");
    let py = returned.py();
    if returned.is_none() {
        return Err(PyTypeError::new_err(format!("the model returned None; return {wanted}")));
    }
    let array = py.import("numpy")?.call_method1("asarray", (returned, "float64"));
    let array = array.map_err(|error| {
        let text = format!("the model returned {}; return {wanted}", kind(returned));
        let raised = PyTypeError::new_err(text);
        raised.set_cause(py, Some(error));
        raised
    })?;
    let array: PyReadonlyArray2<'_, f64> = match array.extract() {
        Ok(array) => array,
        Err(_) => {
            let shape = array.getattr("shape")?.str()?.to_string();
            return Err(PyValueError::new_err(format!(
                "the model returned an array of shape {shape}; return {wanted}"
            )));
        }
    };
    if array.shape() != [count, 2] {
        let shape = array.shape();
        let text = format!("the model returned an array of {} by {} numbers; return {wanted}", shape[0], shape[1]);
        return Err(PyValueError::new_err(text));
    }
    let all = array.as_array();
    if let Some(row) = all.rows().into_iter().position(|row| !row.iter().all(|number| number.is_finite())) {
        let text = format!(
            "the model returned [{}, {}] for row {row} of the view; velocities must be finite",
            all[[row, 0]],
            all[[row, 1]]
        );
        return Err(PyValueError::new_err(text));
    }
    Ok(all.rows().into_iter().map(|row| Vec2::new(row[0] as f32, row[1] as f32)).collect())
}

fn kind(object: &Bound<'_, PyAny>) -> String {
    object.get_type().name().map_or_else(|_| "an object".to_owned(), |name| format!("an object of type {name}"))
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
        let count = crowd.len();
        let mut near = Near::default();
        let mut agents: Vec<AgentRow> = Vec::with_capacity(count);
        let (mut walls, mut wall_start) = (Vec::new(), vec![0]);
        near.start.push(0);
        for k in 0..count {
            let input = crowd.input(k);
            near.ids.extend(crowd.neighbour_numbers(k));
            for other in input.neighbours {
                near.offsets.push(other.offset);
                near.velocities.push(other.velocity);
                near.radii.push(other.radii);
                near.shares.push(other.share);
            }
            near.start.push(near.ids.len() as i64);
            walls.extend(input.edges.iter().map(|edge| [edge.start.x, edge.start.y, edge.end.x, edge.end.y]));
            wall_start.push(walls.len() as i64);
            agents.push(AgentRow::of(&input));
        }
        let column = |read: fn(&AgentRow) -> f32| list(py, agents.iter().map(read).collect());
        let pairs = |read: fn(&AgentRow) -> Vec2| table(py, &agents.iter().map(read).collect::<Vec<_>>());
        Ok(Self {
            time: crowd.time(),
            dt: crowd.seconds(),
            ids: list(py, (0..count).map(|k| crowd.number(k)).collect()),
            positions: array2(py, (0..count).flat_map(|k| crowd.position(k).truncate().to_array()).collect(), 2)?,
            velocities: pairs(|agent| agent.velocity)?,
            preferred: pairs(|agent| agent.preferred)?,
            radii: column(|agent| agent.radius),
            max_speeds: column(|agent| agent.max_speed),
            headings: column(|agent| agent.heading),
            near_start: list(py, near.start),
            near_ids: list(py, near.ids),
            near_offsets: table(py, &near.offsets)?,
            near_velocities: table(py, &near.velocities)?,
            near_radii: list(py, near.radii),
            near_shares: list(py, near.shares),
            wall_start: list(py, wall_start),
            walls: array2(py, walls.into_iter().flatten().collect(), 4)?,
        })
    }
}

/// What is the same for all neighbours of an agent.
struct AgentRow {
    velocity: Vec2,
    preferred: Vec2,
    radius: f32,
    max_speed: f32,
    heading: f32,
}

impl AgentRow {
    fn of(input: &AvoidanceInput<'_>) -> Self {
        let &AvoidanceInput { velocity, preferred, radius, max_speed, heading, .. } = input;
        Self { velocity, preferred, radius, max_speed, heading }
    }
}

#[derive(Default)]
struct Near {
    start: Vec<i64>,
    ids: Vec<u32>,
    offsets: Vec<Vec2>,
    velocities: Vec<Vec2>,
    radii: Vec<f32>,
    shares: Vec<f32>,
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

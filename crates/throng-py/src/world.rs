//! Worlds: state as arrays, steps without the global lock, changes.

use crate::error::{scene_error, world_error};
use crate::inner::{Arrays, Inner, ModelOptions};
use crate::live::Live;
use crate::model::{Calls, array2, list, lock};
use crate::neighbours::nearest;
use crate::place;
use glam::{DVec2, Vec2};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyRuntimeError, PyValueError};
use pyo3::gc::{PyTraverseError, PyVisit};
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use pyo3::types::PyBytes;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use throng::{Agent, AgentId, EventKind};
use throng_draw::{Figure, Style, Theme};
use throng_record::{Frame, moment, summary_cells};
use throng_scene::{Expectations, Scene as Described};

/// A world: agents that move, made from a scene.
#[pyclass(frozen, module = "throng_sim._throng")]
pub struct World {
    inner: Mutex<Inner>,
    calls: Arc<Calls>,
}

/// An event: seconds, the number of the agent, and what happened.
type EventRow = (f64, u32, &'static str);

/// Neighbours of all agents: where those of each begin, their rows, and their distances.
type Lists = (Py<PyArray1<i64>>, Py<PyArray1<i64>>, Py<PyArray1<f64>>);

impl World {
    pub fn of(py: Python<'_>, scene: &Described, threads: usize) -> PyResult<Self> {
        let inner = py.detach(|| Inner::new(scene, threads)).map_err(|error| scene_error(py, &error))?;
        Ok(Self::with(inner))
    }

    fn with(inner: Inner) -> Self {
        Self { calls: inner.calls.clone(), inner: Mutex::new(inner) }
    }

    /// Waits until no other thread uses the world.
    pub fn lock(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Inner>> {
        if self.calls.is_inside() {
            let text = "the world is making a step: a model reads its view, not the world";
            return Err(PyRuntimeError::new_err(text));
        }
        Ok(self.inner.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner))
    }

    fn read<P: crate::live::Property>(
        &self,
        py: Python<'_>,
        of: impl FnOnce(&mut Arrays) -> &mut Live<P>,
    ) -> PyResult<Py<PyAny>> {
        let mut inner = self.lock(py)?;
        let Inner { world, present, arrays, .. } = &mut *inner;
        of(arrays).get(py, world, present)
    }
}

#[pymethods]
impl World {
    /// Centres, world coordinates in metres: (n, 2) float64.
    #[getter]
    fn positions(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.positions)
    }

    /// Heights of the centres above the ground, metres: (n,) float32.
    #[getter]
    fn altitudes(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.altitudes)
    }

    /// Velocities along the ground, m/s: (n, 2) float32.
    #[getter]
    fn velocities(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.velocities)
    }

    /// Velocities upwards, m/s: (n,) float32.
    #[getter]
    fn vertical_velocities(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.vertical_velocities)
    }

    /// Directions of the bodies, radians counter-clockwise from +x: (n,) float32.
    #[getter]
    fn headings(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.headings)
    }

    /// Radii of the bodies, metres: (n,) float32.
    #[getter]
    fn radii(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.radii)
    }

    /// Preferred speeds, m/s: (n,) float32.
    #[getter]
    fn preferred_speeds(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.speeds)
    }

    /// Top speeds, m/s: (n,) float32.
    #[getter]
    fn max_speeds(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.max_speeds)
    }

    /// The nearest point of each agent's goal, world coordinates: (n, 2) float64. NaN: it has none.
    fn targets(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let inner = self.lock(py)?;
        let agents = inner.present.ids.iter().filter_map(|&id| inner.world.agent(id));
        let targets = agents.map(|agent| {
            let from = agent.position().truncate();
            agent.goal().map_or(DVec2::NAN, |goal| place::nearest(goal, from)).to_array()
        });
        array2(py, targets.flatten().collect(), 2)
    }

    /// The ends of all walls, x, y, x, y in world coordinates: (m, 4) float64. A disc is a polygon of 32 walls.
    fn walls(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let walls = place::walls(self.lock(py)?.world.place());
        array2(py, walls.into_iter().flatten().collect(), 4)
    }

    /// Where the agents are on their trips, as numbers of `Status`: (n,) uint8.
    #[getter]
    fn status(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.status)
    }

    /// Indices into `group_names`: (n,) uint32.
    #[getter]
    fn groups(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.groups)
    }

    /// The numbers of the agents that are present, rising: (n,) uint32. All arrays have this order.
    #[getter]
    fn ids(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.read(py, |arrays| &mut arrays.ids)
    }

    /// Velocities that agents prefer, m/s, for the program to write: (n, 2) float64. NaN: the agent decides itself.
    #[getter]
    fn preferred(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let mut inner = self.lock(py)?;
        let Inner { world, present, arrays, .. } = &mut *inner;
        arrays.preferred.get(py, world, present)
    }

    /// The points to which agents go, for the program to write: (n, 2) float64. NaN: the agent has no goal that is a
    /// point.
    #[getter]
    fn goals(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let mut inner = self.lock(py)?;
        let Inner { world, present, arrays, .. } = &mut *inner;
        arrays.goals.get(py, world, present)
    }

    /// The names of the groups.
    #[getter]
    fn group_names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.lock(py)?.built.groups.iter().map(|group| group.name.clone()).collect())
    }

    /// Seconds since the start.
    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.lock(py)?.world.time())
    }

    /// Seconds of a step.
    #[getter]
    fn dt(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.lock(py)?.world.settings().step)
    }

    /// Lower left and upper right corner of the scene, metres.
    #[getter]
    fn bounds(&self, py: Python<'_>) -> PyResult<[[f64; 2]; 2]> {
        Ok(self.lock(py)?.built.bounds.map(|corner| corner.to_array()))
    }

    /// Notes about the scene, a sentence each.
    #[getter]
    fn notes(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.lock(py)?.built.notes.clone())
    }

    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.lock(py)?.present.ids.len())
    }

    /// Makes `n` steps. Ctrl-C ends it after a whole step.
    #[pyo3(signature = (n=1))]
    fn step(&self, py: Python<'_>, n: u64) -> PyResult<()> {
        self.lock(py)?.go(py, n, |_| false, |_| ())
    }

    /// Makes steps until the scene is over, or until `until` seconds.
    #[pyo3(signature = (until=None))]
    fn advance(&self, py: Python<'_>, until: Option<f64>) -> PyResult<()> {
        self.lock(py)?.go(py, u64::MAX, |inner| inner.is_at_end(until), |_| ())
    }

    /// Whether `advance` would make no step.
    #[pyo3(signature = (until=None))]
    fn is_at_end(&self, py: Python<'_>, until: Option<f64>) -> PyResult<bool> {
        Ok(self.lock(py)?.is_at_end(until))
    }

    /// What happened in the last call that made steps.
    fn event_rows(&self, py: Python<'_>) -> PyResult<Vec<EventRow>> {
        let name = |kind: EventKind| match kind {
            EventKind::Entered => "entered",
            EventKind::Replanned => "replanned",
            EventKind::Stuck => "stuck",
            EventKind::Stranded => "stranded",
            EventKind::Arrived => "arrived",
            EventKind::Left => "left",
            _ => "other",
        };
        Ok(self.lock(py)?.events.iter().map(|&(time, number, kind)| (time, number, name(kind))).collect())
    }

    /// Statistics of the run so far, as JSON.
    fn summary_json(&self, py: Python<'_>) -> PyResult<String> {
        let summary = self.lock(py)?.world.summary();
        let counted = [("sub_steps", summary.sub_steps.into()), ("agent_steps", summary.agent_steps.into())];
        let walls = [("least_wall_separation", summary.least_wall_separation.into())];
        let all = summary_cells(&summary).into_iter().chain(counted).chain(walls);
        json(&all.map(|(name, cell)| (name.to_owned(), cell.json())).collect::<serde_json::Map<_, _>>())
    }

    /// The checks of the scene's expectations, as JSON.
    fn expectations_json(&self, py: Python<'_>) -> PyResult<String> {
        let inner = self.lock(py)?;
        json(&inner.watch.verdict(&inner.world))
    }

    /// A hash of the whole state.
    #[pyo3(name = "hash")]
    fn state_hash(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.lock(py)?.world.state_hash())
    }

    /// Adds agents like those of a group at places. Returns their numbers.
    #[pyo3(signature = (group, at, goals=None, headings=None, velocities=None))]
    fn add_agents<'py>(
        &self,
        py: Python<'py>,
        group: &str,
        at: PyReadonlyArray2<'py, f64>,
        goals: Option<PyReadonlyArray2<'py, f64>>,
        headings: Option<PyReadonlyArray1<'py, f64>>,
        velocities: Option<PyReadonlyArray2<'py, f64>>,
    ) -> PyResult<Vec<u32>> {
        let mut inner = self.lock(py)?;
        inner.obey(py)?;
        let group = inner.group(group)?;
        let at = points(&at, "at")?;
        let goals = goals.map(|goals| rows_of(&goals, "goals", at.len())).transpose()?;
        let velocities = velocities.map(|all| rows_of(&all, "velocities", at.len())).transpose()?;
        let headings: Option<Vec<f64>> = headings.map(|all| all.as_array().to_vec());
        if let Some(headings) = headings.as_ref().filter(|headings| headings.len() != at.len()) {
            let text = format!("`headings` has {} numbers for {} agents", headings.len(), at.len());
            return Err(PyValueError::new_err(text));
        }
        let mut numbers = vec![];
        let mut result = Ok(());
        for (k, &at) in at.iter().enumerate() {
            let mut agent = Agent { number: None, user_data: 0, ..inner.patterns[group].clone() };
            agent.position = at.extend(agent.position.z);
            agent.heading = headings.as_ref().map(|headings| headings[k] as f32);
            agent.velocity = velocities.as_ref().map_or(Vec2::ZERO, |velocities| velocities[k].as_vec2());
            if let Some(goals) = &goals {
                agent.goal = Some(throng::Goal::from(throng::Position::from(goals[k])));
            }
            match inner.world.add_agent(agent) {
                Ok(id) => numbers.extend(inner.world.agent(id).map(|agent| agent.number())),
                Err(error) => {
                    result = Err(world_error(&error));
                    break;
                }
            }
        }
        inner.changed(py)?;
        result.map(|()| numbers)
    }

    /// Removes agents by their numbers.
    fn remove_agents(&self, py: Python<'_>, numbers: Vec<u32>) -> PyResult<()> {
        let mut inner = self.lock(py)?;
        inner.obey(py)?;
        let ids: Vec<AgentId> = numbers.iter().map(|&number| inner.id(number)).collect::<PyResult<_>>()?;
        ids.into_iter().for_each(|id| {
            inner.world.remove_agent(id);
        });
        inner.changed(py)
    }

    /// Moves an agent.
    fn set_position(&self, py: Python<'_>, number: u32, x: f64, y: f64) -> PyResult<()> {
        let mut inner = self.lock(py)?;
        let id = inner.id(number)?;
        inner.world.set_position(id, [x, y]).map_err(|error| world_error(&error))?;
        inner.changed(py)
    }

    /// Sets the velocity of an agent.
    fn set_velocity(&self, py: Python<'_>, number: u32, x: f32, y: f32) -> PyResult<()> {
        let mut inner = self.lock(py)?;
        let id = inner.id(number)?;
        inner.world.set_velocity(id, Vec2::new(x, y).extend(0.0)).map_err(|error| world_error(&error))?;
        inner.changed(py)
    }

    /// Changes a value of the scene while the world runs. Returns whether it could: a change of more than the
    /// properties of groups needs a new world.
    fn tune(&self, py: Python<'_>, path: &str, value: &str) -> PyResult<bool> {
        let mut inner = self.lock(py)?;
        let mut scene = inner.scene.clone();
        scene.set(path, value).map_err(|error| scene_error(py, &error))?;
        let Inner { world, built, scene: before, .. } = &mut *inner;
        let tuned = scene.tune(before, world, built).map_err(|error| scene_error(py, &error))?;
        if tuned {
            inner.scene = scene;
            inner.bind()?;
        }
        inner.changed(py)?;
        Ok(tuned)
    }

    /// Gives all agents a local model in Python.
    #[pyo3(signature = (function, sees=2.0, reach=None, neighbors=None))]
    fn set_model(
        &self,
        py: Python<'_>,
        function: Py<PyAny>,
        sees: f32,
        reach: Option<f32>,
        neighbors: Option<usize>,
    ) -> PyResult<()> {
        let mut inner = self.lock(py)?;
        inner.model = Some((Arc::new(Mutex::new(Some(function))), ModelOptions { sees, reach, neighbors }));
        inner.bind()
    }

    /// Returns the neighbours of all agents: those within `distance` metres, at most `k`, nearest first.
    #[pyo3(signature = (k=10, distance=f64::INFINITY))]
    fn neighbor_lists(&self, py: Python<'_>, k: usize, distance: f64) -> PyResult<Lists> {
        if distance.is_nan() || distance <= 0.0 {
            return Err(PyValueError::new_err(format!("distance is {distance}, but must be more than 0 m")));
        }
        let inner = self.lock(py)?;
        let origin = inner.world.settings().origin;
        let places: Vec<[f64; 2]> = inner
            .present
            .rows(&inner.world)
            .map(|row| (inner.world.relative_columns().position[row].as_dvec2() + origin).to_array())
            .collect();
        let (start, rows, distances) = py.detach(|| nearest(&places, k, distance));
        Ok((list(py, start), list(py, rows), list(py, distances)))
    }

    /// Draws the velocity space of an agent as SVG.
    #[pyo3(signature = (number, width=900, height=700, dark=false))]
    fn explain_svg(&self, py: Python<'_>, number: u32, width: u32, height: u32, dark: bool) -> PyResult<String> {
        let inner = self.lock(py)?;
        let id = inner.id(number)?;
        let Some(why) = inner.world.explain(id) else { return Err(PyIndexError::new_err("the agent has left")) };
        let mut frame = Frame::default();
        moment::capture(&inner.world, &mut frame);
        let theme = if dark { Theme::dark() } else { Theme::light() };
        let style = Style { width, height, theme, ..Style::default() };
        let setting = moment::setting(&inner.world, &inner.built, &inner.scene.title);
        let figure = Figure::explain(&setting, &frame, &why, &style);
        figure.map(|figure| figure.svg()).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The whole state, for `load`.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.lock(py)?.world.save()))
    }

    /// Goes back to a state that `save` returned, of a world of the same scene.
    fn load(&self, py: Python<'_>, state: &[u8]) -> PyResult<()> {
        let mut inner = self.lock(py)?;
        inner.world.load(state).map_err(|error| world_error(&error))?;
        inner.watch = Expectations::new(&inner.scene.expect, &inner.world, &inner.built);
        inner.bind()?;
        inner.arrays.preferred.forget();
        inner.arrays.goals.forget();
        inner.changed(py)
    }

    /// Returns an equal world, which goes its own way.
    fn clone(&self, py: Python<'_>) -> PyResult<Self> {
        let mut inner = self.lock(py)?;
        inner.obey(py)?;
        Ok(Self::with(inner.twin(py)?))
    }

    /// The text of the scene as it is now.
    fn scene_toml(&self, py: Python<'_>) -> PyResult<String> {
        self.lock(py)?.scene.to_toml().map_err(|error| scene_error(py, &error))
    }

    /// Shows the collector the model, unless another thread uses the world: the world is then not garbage.
    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        let Ok(inner) = self.inner.try_lock() else { return Ok(()) };
        let Some((function, _)) = &inner.model else { return Ok(()) };
        let Ok(function) = function.try_lock() else { return Ok(()) };
        function.as_ref().map_or(Ok(()), |function| visit.call(function))
    }

    fn __clear__(&self) {
        if let Ok(inner) = self.inner.try_lock() {
            let held = inner.model.as_ref().and_then(|(function, _)| lock(function).take());
            drop(inner);
            drop(held);
        }
    }

    /// The number of threads of a step.
    #[getter]
    fn threads(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.lock(py)?.threads.count())
    }
}

fn json(value: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_string(value).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Reads points from an array of two columns.
fn points(array: &PyReadonlyArray2<'_, f64>, name: &str) -> PyResult<Vec<DVec2>> {
    let shape = array.shape();
    if shape[1] != 2 {
        let text = format!("`{name}` has {} columns, but needs two: x and y", shape[1]);
        return Err(PyValueError::new_err(text));
    }
    Ok(array.as_array().rows().into_iter().map(|row| DVec2::new(row[0], row[1])).collect())
}

/// Reads points, one for each of `count` agents.
fn rows_of(array: &PyReadonlyArray2<'_, f64>, name: &str, count: usize) -> PyResult<Vec<DVec2>> {
    let points = points(array, name)?;
    if points.len() != count {
        let text = format!("`{name}` has {} rows for {count} agents", points.len());
        return Err(PyValueError::new_err(text));
    }
    Ok(points)
}

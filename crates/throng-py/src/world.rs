//! Worlds: state as arrays, steps without the global lock, changes.

use crate::error::{scene_error, world_error};
use crate::live::{
    Altitudes, Groups, Headings, Live, MaxSpeeds, Numbers, Positions, PreferredSpeeds, Present, Radii, Statuses,
    Velocities, VerticalVelocities,
};
use crate::model::{Calls, Function, PythonModel, array2, list, lock};
use crate::place;
use crate::threads::Threads;
use crate::writable::{Goals, Preferred, Writable};
use glam::{DVec2, Vec2};
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyRuntimeError, PyValueError};
use pyo3::gc::{PyTraverseError, PyVisit};
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use pyo3::types::PyBytes;
use std::num::NonZero;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use throng::{Agent, AgentId, EventKind};
use throng_draw::{Figure, Style, Theme};
use throng_record::{Frame, moment};
use throng_scene::{Built, Expectations, Scene as Described};

/// Time between two looks for Ctrl-C.
const PATIENCE: Duration = Duration::from_millis(50);

/// A world and what its Python program holds of it.
pub struct Inner {
    pub world: throng::World,
    pub built: Built,
    pub scene: Described,
    pub watch: Expectations,
    pub threads: Threads,
    present: Present,
    /// An agent of each group as it was at the start, for new ones.
    patterns: Vec<Agent>,
    model: Option<(Function, ModelOptions)>,
    calls: Arc<Calls>,
    arrays: Arrays,
    events: Vec<(f64, u32, EventKind)>,
}

/// What a Python model asks of the engine.
#[derive(Clone, Copy)]
pub struct ModelOptions {
    sees: f32,
    reach: Option<f32>,
    neighbors: Option<usize>,
}

#[derive(Default)]
struct Arrays {
    positions: Live<Positions>,
    altitudes: Live<Altitudes>,
    velocities: Live<Velocities>,
    vertical_velocities: Live<VerticalVelocities>,
    headings: Live<Headings>,
    radii: Live<Radii>,
    speeds: Live<PreferredSpeeds>,
    max_speeds: Live<MaxSpeeds>,
    status: Live<Statuses>,
    groups: Live<Groups>,
    ids: Live<Numbers>,
    preferred: Writable<Preferred>,
    goals: Writable<Goals>,
}

/// Calls a function for each array that follows the steps.
macro_rules! each_live {
    ($arrays:expr, |$array:ident| $work:expr) => {{
        let Arrays { positions, altitudes, velocities, vertical_velocities, headings, .. } = $arrays;
        each_live!(@ |$array| $work, positions altitudes velocities vertical_velocities headings);
        let Arrays { radii, speeds, max_speeds, status, groups, ids, .. } = $arrays;
        each_live!(@ |$array| $work, radii speeds max_speeds status groups ids);
    }};
    (@ |$array:ident| $work:expr, $($name:ident)*) => { $({ let $array = $name; $work; })* };
}

impl Inner {
    fn new(scene: &Described, threads: usize) -> Result<Self, throng_scene::Error> {
        let (world, built) = scene.build()?;
        let watch = Expectations::new(&scene.expect, &world, &built);
        let plan = |group: usize| world.agents().find(|agent| agent.group() == built.groups[group].id);
        let patterns = (0..built.groups.len())
            .map(|group| {
                let id = built.groups[group].id;
                plan(group).map_or_else(|| Agent { group: id, ..Agent::default() }, |agent| agent.to_agent())
            })
            .collect();
        let mut present = Present::default();
        present.find(&world);
        Ok(Self {
            watch,
            patterns,
            present,
            world,
            built,
            scene: scene.clone(),
            threads: Threads::new(threads),
            model: None,
            calls: Arc::default(),
            arrays: Arrays::default(),
            events: vec![],
        })
    }

    /// Gives all groups the Python model.
    fn bind(&mut self) -> PyResult<()> {
        let Some((function, options)) = &self.model else { return Ok(()) };
        let calls = self.calls.clone();
        let model = Arc::new(PythonModel { function: function.clone(), sees: options.sees, calls });
        for built in &self.built.groups {
            let mut group = self.world.group(built.id).clone();
            group.model = model.clone();
            group.neighbour_distance = options.reach.unwrap_or(group.neighbour_distance);
            group.neighbours = options.neighbors.unwrap_or(group.neighbours);
            self.world.set_group(built.id, group).map_err(|error| world_error(&error))?;
        }
        Ok(())
    }

    /// Finds the agents that are present, after a change.
    fn changed(&mut self, py: Python<'_>) -> PyResult<()> {
        let before = self.present.numbers.clone();
        if self.present.find(&self.world) {
            each_live!(&mut self.arrays, |array| array.release());
            self.arrays.preferred.carry_over(py, &before, &self.present)?;
            self.arrays.goals.carry_over(py, &before, &self.present)?;
        }
        let Self { world, present, arrays, .. } = self;
        each_live!(&mut *arrays, |array| array.write(py, world, present)?);
        arrays.goals.refresh(py, world, present)
    }

    /// Makes a step.
    fn one_step(&mut self) {
        self.world.step();
        self.watch.step(&self.world);
        let events = self.world.events().iter().map(|event| (event.time, event.number, event.kind));
        self.events.extend(events);
    }

    /// Makes at most `most` steps, and stops after [`PATIENCE`] or when `ends`. Returns the number of steps.
    fn steps(
        &mut self,
        most: u64,
        ends: impl Fn(&Self) -> bool + Send + Sync,
        mut after: impl FnMut(&Self) + Send,
    ) -> PyResult<u64> {
        let begin = Instant::now();
        let mut threads = std::mem::replace(&mut self.threads, Threads::new(1));
        let made = threads.run(|| {
            let mut made = 0;
            while made < most && !ends(self) {
                self.one_step();
                after(self);
                made += 1;
                if begin.elapsed() > PATIENCE || self.calls.has_raised() {
                    break;
                }
            }
            made
        });
        self.threads = threads;
        made
    }

    /// Makes steps until `ends`, at most `most`. Calls `after` after each.
    pub fn go(
        &mut self,
        py: Python<'_>,
        most: u64,
        ends: impl Fn(&Self) -> bool + Send + Sync,
        mut after: impl FnMut(&Self) + Send,
    ) -> PyResult<()> {
        self.events.clear();
        self.obey(py)?;
        let mut left = most;
        let result = loop {
            let made = py.detach(|| self.steps(left, &ends, &mut after));
            let made = match made {
                Ok(made) => made,
                Err(error) => break Err(error),
            };
            left -= made;
            if let Some(error) = self.calls.take() {
                break Err(error);
            }
            if left == 0 || ends(self) {
                break Ok(());
            }
            if let Err(error) = py.check_signals() {
                break Err(error);
            }
        };
        self.changed(py)?;
        result
    }

    /// Whether the scene is over, or `until` seconds have passed.
    pub fn is_at_end(&self, until: Option<f64>) -> bool {
        match until {
            Some(until) => self.world.time() + 0.5 * self.world.settings().step >= until,
            None => self.scene.time.over(&self.world),
        }
    }

    /// Gives the world what the program wrote into arrays.
    fn obey(&mut self, py: Python<'_>) -> PyResult<()> {
        let Self { world, present, arrays, .. } = self;
        arrays.preferred.obey(py, world, present)?;
        arrays.goals.obey(py, world, present)
    }

    fn id(&self, number: u32) -> PyResult<AgentId> {
        let found = self.present.index(number).map(|index| self.present.ids[index]);
        found.ok_or_else(|| PyIndexError::new_err(format!("agent {number} is not present; `ids` has those that are")))
    }

    fn group(&self, group: &str) -> PyResult<usize> {
        let names = || self.built.groups.iter().map(|group| group.name.as_str());
        let by_number = || group.parse().ok().filter(|&k: &usize| k < self.built.groups.len());
        names().position(|name| name == group).or_else(by_number).ok_or_else(|| {
            let all: Vec<&str> = names().collect();
            PyValueError::new_err(format!("there is no group `{group}`; there are: {}", all.join(", ")))
        })
    }

    fn twin(&self, py: Python<'_>) -> PyResult<Self> {
        let mut twin = Self {
            world: self.world.clone(),
            built: self.built.clone(),
            scene: self.scene.clone(),
            watch: self.watch.clone(),
            threads: Threads::new(self.threads.count()),
            present: Present::default(),
            patterns: self.patterns.clone(),
            model: self.model.as_ref().map(|(function, options)| {
                let own = lock(function).as_ref().map(|function| function.clone_ref(py));
                (Arc::new(Mutex::new(own)), *options)
            }),
            calls: Arc::default(),
            arrays: Arrays::default(),
            events: self.events.clone(),
        };
        twin.present.find(&twin.world);
        twin.bind()?;
        Ok(twin)
    }
}

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
        json(&self.lock(py)?.world.summary())
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

/// Returns the neighbours of all places: the start of each list and the end, the rows, and the distances.
fn nearest(places: &[[f64; 2]], k: usize, distance: f64) -> (Vec<i64>, Vec<i64>, Vec<f64>) {
    let (mut start, mut rows, mut distances) = (vec![0], vec![], vec![]);
    let most = NonZero::new(k.saturating_add(1).min(places.len().max(1))).unwrap_or(NonZero::<usize>::MIN);
    let Ok(tree) = ImmutableKdTree::<f64, 2>::new_from_slice(places) else {
        return (vec![0; places.len() + 1], rows, distances);
    };
    for (own, place) in places.iter().enumerate() {
        let found = tree.query(place).nearest_n::<SquaredEuclidean<f64>>(most).execute();
        let mut found: Vec<(f64, i64)> = found.iter().map(|near| (near.distance, i64::from(near.item))).collect();
        found.retain(|&(squared, _)| squared <= distance * distance);
        // equal distances in the order of rows
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let others = found.into_iter().filter(|&(_, row)| row != own as i64).take(k);
        for (squared, row) in others {
            rows.push(row);
            distances.push(squared.sqrt());
        }
        start.push(rows.len() as i64);
    }
    (start, rows, distances)
}

/// Threads that step several worlds side by side.
#[pyclass(frozen, module = "throng_sim._throng")]
pub struct Stepper {
    threads: Mutex<Threads>,
}

#[pymethods]
impl Stepper {
    /// Prepares this number of threads; 0 stands for the number of cores.
    #[new]
    #[pyo3(signature = (threads=0))]
    fn new(threads: usize) -> Self {
        Self { threads: Mutex::new(Threads::new(threads)) }
    }

    /// Makes `n` steps of each world. Each gets the same bits as alone.
    #[pyo3(signature = (worlds, n=1))]
    fn step(&self, py: Python<'_>, worlds: Vec<Py<World>>, n: u64) -> PyResult<()> {
        use rayon::prelude::*;
        let mut guards = vec![];
        for (k, world) in worlds.iter().enumerate() {
            if worlds[..k].iter().any(|other| other.is(world)) {
                return Err(PyValueError::new_err(format!("world {k} is given twice")));
            }
            let mut guard = world.get().lock(py)?;
            guard.events.clear();
            guard.obey(py)?;
            guards.push(guard);
        }
        let mut inners: Vec<&mut Inner> = guards.iter_mut().map(|guard| &mut **guard).collect();
        let mut threads = self.threads.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner);
        let threads = &mut *threads;
        let made: Vec<PyResult<()>> = py.detach(|| {
            threads.run(|| {
                let steps = |inner: &mut &mut Inner| {
                    for _ in 0..n {
                        inner.one_step();
                    }
                    inner.calls.take().map_or(Ok(()), Err)
                };
                inners.par_iter_mut().map(steps).collect()
            })
        })?;
        for inner in &mut inners {
            inner.changed(py)?;
        }
        made.into_iter().collect()
    }
}

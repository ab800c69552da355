//! Trajectories of files and recordings: states and poses of agents at any time.

use crate::place::{Corners, numbers, outline, rings};
use crate::track::{Agent, Moment, State};
use numpy::{Element, PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::PathBuf;
use throng_figure::{JOINTS, Person};
use throng_record::{Reading, Setting, Trajectories as Tracks};

/// Positions and rotations, as arrays.
type Placed<'py, T> = (Bound<'py, PyArrayDyn<f64>>, Bound<'py, PyArrayDyn<T>>);

/// What agents did.
#[pyclass(frozen, module = "throng_sim._throng")]
pub struct Trajectories {
    setting: Setting,
    notes: Vec<String>,
    times: Vec<f64>,
    /// By number.
    agents: Vec<Agent>,
}

#[pymethods]
impl Trajectories {
    /// Reads a file of trajectories. `frame_rate` and `unit` (metres) override those of the file.
    #[staticmethod]
    #[pyo3(signature = (path, frame_rate=None, unit=None))]
    fn read(py: Python<'_>, path: PathBuf, frame_rate: Option<f64>, unit: Option<f64>) -> PyResult<Self> {
        for (name, number) in [("frame_rate", frame_rate), ("unit", unit)] {
            if number.is_some_and(|number| !(number > 0.0 && number.is_finite())) {
                return Err(PyValueError::new_err(format!("{name} must be more than 0")));
            }
        }
        let read = py.detach(|| Tracks::read_as(&path, &Reading { rate: frame_rate, unit }));
        let Tracks { setting, spots, notes, .. } = read.map_err(|error| PyValueError::new_err(error.to_string()))?;
        if spots.is_empty() {
            let text = format!("{}: the file has no agents; give a file with at least one position", path.display());
            return Err(PyValueError::new_err(text));
        }
        let states = spots.iter().map(|spot| State {
            number: spot.number,
            group: spot.group,
            radius: spot.radius,
            time: spot.time,
            place: spot.place,
            heading: spot.heading.into(),
        });
        Ok(py.detach(|| Self::new(setting, notes, states)))
    }

    /// The title of the scene.
    #[getter]
    fn title(&self) -> &str {
        &self.setting.title
    }

    /// What the reader changed or found.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    /// The names of the groups.
    #[getter]
    fn group_names(&self) -> Vec<String> {
        let last = self.agents.iter().map(|agent| agent.group + 1).max().unwrap_or(0);
        let count = last.max(self.setting.groups.len() as u32);
        (0..count).map(|group| self.setting.group_name(group).into_owned()).collect()
    }

    fn __len__(&self) -> usize {
        self.agents.len()
    }

    /// The times of the samples, seconds.
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.times)
    }

    /// The numbers of the agents.
    fn ids<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        PyArray1::from_iter(py, self.agents.iter().map(|agent| agent.number))
    }

    /// The groups of the agents, indices into `group_names`.
    fn groups<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        PyArray1::from_iter(py, self.agents.iter().map(|agent| agent.group))
    }

    /// The radii of the agents, metres.
    fn radii<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f32>> {
        PyArray1::from_iter(py, self.agents.iter().map(|agent| agent.radius))
    }

    /// The times of the first and the last sample of each agent, seconds.
    fn spans<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let spans = self.agents.iter().flat_map(|agent| agent.span());
        array(py, spans.collect(), &[self.agents.len(), 2])
    }

    /// The builds of the agents that are people: `None` for others.
    fn builds(&self) -> Vec<Option<&'static str>> {
        self.agents.iter().map(|agent| agent.person.map(|person| person.build.name())).collect()
    }

    /// The heights of people, metres: NaN for other agents.
    fn heights<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let height = |agent: &Agent| agent.person.map_or(f64::NAN, |person| person.height);
        PyArray1::from_iter(py, self.agents.iter().map(height))
    }

    /// The numbers of the looks of people.
    fn looks<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        PyArray1::from_iter(py, self.agents.iter().map(|agent| agent.person.map_or(0, |person| person.look)))
    }

    /// Whether agents fly.
    #[getter]
    fn in_space(&self) -> bool {
        self.setting.in_space
    }

    /// Corners of the walkable areas and of their holes, metres.
    fn walkable(&self) -> Vec<Vec<Corners>> {
        rings(&self.setting.walkable)
    }

    /// The obstacles: their corners (metres), and whether they are closed polygons or thin walls.
    fn obstacles(&self) -> Vec<(Corners, bool)> {
        let corners = |(points, closed): (Vec<_>, bool)| (numbers(&points), closed);
        self.setting.obstacles.iter().map(|obstacle| corners(outline(obstacle))).collect()
    }

    /// Positions, (n, t, 3), and headings, (n, t), of agents, by their numbers, at times: NaN before the first and after
    /// the last sample of an agent.
    fn states<'py>(&self, py: Python<'py>, ids: Vec<u32>, times: Vec<f64>) -> PyResult<Placed<'py, f64>> {
        let agents = ids.iter().map(|&id| self.agent(id)).collect::<PyResult<Vec<_>>>()?;
        let (mut places, mut headings) = (vec![], vec![]);
        for agent in agents {
            for &time in &times {
                let Moment { place, heading, .. } = agent.at(time);
                places.extend(place.to_array());
                headings.push(heading);
            }
        }
        let shape = [ids.len(), times.len()];
        Ok((array(py, places, &[shape[0], shape[1], 3])?, array(py, headings, &shape)?))
    }

    /// Poses of people, by their numbers, at times: positions of the hips, (n, t, 3), and rotations of the joints
    /// against their parents, (n, t, 19, 4), as w, x, y, z. NaN while a person is not there.
    ///
    /// With `world`: positions, (n, t, 19, 3), and rotations of all joints in the world.
    #[pyo3(signature = (ids, times, world=false))]
    fn poses<'py>(&self, py: Python<'py>, ids: Vec<u32>, times: Vec<f64>, world: bool) -> PyResult<Placed<'py, f32>> {
        let people = ids.iter().map(|&id| self.person(id)).collect::<PyResult<Vec<_>>>()?;
        let rows = |&(agent, person): &(&Agent, Person)| agent.poses(&person, &times, world);
        let rows = py.detach(|| people.par_iter().map(rows).collect::<Result<Vec<_>, _>>());
        let rows = rows.map_err(|error: throng_figure::Error| PyValueError::new_err(error.to_string()))?;
        let (mut places, mut turns) = (vec![], vec![]);
        for (place, turn) in rows {
            places.extend(place);
            turns.extend(turn);
        }
        let shape = [ids.len(), times.len(), JOINTS];
        let (place, turn) = ([shape.as_slice(), &[3]].concat(), [shape.as_slice(), &[4]].concat());
        let place = if world { place } else { vec![shape[0], shape[1], 3] };
        Ok((array(py, places, &place)?, array(py, turns, &turn)?))
    }
}

impl Trajectories {
    /// Returns trajectories of states, those of an agent in the order of time.
    pub fn new(mut setting: Setting, notes: Vec<String>, states: impl Iterator<Item = State>) -> Self {
        let mut agents: BTreeMap<u32, Agent> = BTreeMap::new();
        let mut times: Vec<f64> = vec![];
        for State { number, group, radius, time, place, heading } in states {
            setting.in_space |= place.z != 0.0;
            times.push(time);
            let agent = agents.entry(number).or_insert_with(|| Agent::new(number, group, radius));
            agent.track.push(Moment { time, place, heading });
        }
        times.sort_by(f64::total_cmp);
        times.dedup();
        let mut agents: Vec<Agent> = agents.into_values().collect();
        if !setting.in_space {
            agents.iter_mut().for_each(|agent| agent.person = Person::of_agent(agent.number, agent.radius));
        }
        Self { setting, notes, times, agents }
    }

    fn agent(&self, id: u32) -> PyResult<&Agent> {
        let found = self.agents.binary_search_by_key(&id, |agent| agent.number).ok();
        let agent = found.map(|at| &self.agents[at]);
        agent.ok_or_else(|| PyValueError::new_err(format!("{id} is not the number of an agent")))
    }

    fn person(&self, id: u32) -> PyResult<(&Agent, Person)> {
        let agent = self.agent(id)?;
        let person = agent.person.map(|person| (agent, person));
        person.ok_or_else(|| PyValueError::new_err(format!("{id} is not the number of a person")))
    }
}

fn array<'py, T: Element>(py: Python<'py>, values: Vec<T>, shape: &[usize]) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    PyArray1::from_vec(py, values).reshape(shape.to_vec())
}

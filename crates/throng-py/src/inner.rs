//! What a world of Python is made of.

use crate::error::world_error;
use crate::live::{
    Altitudes, Groups, Headings, Live, MaxSpeeds, Numbers, Positions, PreferredSpeeds, Present, Radii, Statuses,
    Velocities, VerticalVelocities,
};
use crate::model::{Calls, Function, PythonModel, lock};
use crate::threads::Threads;
use crate::writable::{Goals, Preferred, Writable};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use throng::{Agent, AgentId, EventKind};
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
    pub present: Present,
    /// An agent of each group as it was at the start, for new ones.
    pub patterns: Vec<Agent>,
    pub model: Option<(Function, ModelOptions)>,
    pub calls: Arc<Calls>,
    pub arrays: Arrays,
    pub events: Vec<(f64, u32, EventKind)>,
}

/// What a Python model asks of the engine.
#[derive(Clone, Copy)]
pub struct ModelOptions {
    pub sees: f32,
    pub reach: Option<f32>,
    pub neighbors: Option<usize>,
}

/// The arrays that Python holds.
#[derive(Default)]
pub struct Arrays {
    pub positions: Live<Positions>,
    pub altitudes: Live<Altitudes>,
    pub velocities: Live<Velocities>,
    pub vertical_velocities: Live<VerticalVelocities>,
    pub headings: Live<Headings>,
    pub radii: Live<Radii>,
    pub speeds: Live<PreferredSpeeds>,
    pub max_speeds: Live<MaxSpeeds>,
    pub status: Live<Statuses>,
    pub groups: Live<Groups>,
    pub ids: Live<Numbers>,
    pub preferred: Writable<Preferred>,
    pub goals: Writable<Goals>,
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
    pub fn new(scene: &Described, threads: usize) -> Result<Self, throng_scene::Error> {
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
    pub fn bind(&mut self) -> PyResult<()> {
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
    pub fn changed(&mut self, py: Python<'_>) -> PyResult<()> {
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
    pub fn one_step(&mut self) {
        self.world.step();
        self.watch.step(&self.world);
        let events = self.world.events().iter().map(|event| (event.time, event.number, event.kind));
        self.events.extend(events);
    }

    /// Makes at most `most` steps, and stops after [`PATIENCE`] or when `ends`. Returns the number of steps.
    pub fn steps(
        &mut self,
        most: u64,
        ends: impl Fn(&Self) -> bool + Send + Sync,
        mut after: impl FnMut(&Self) + Send,
    ) -> PyResult<u64> {
        let begin = Instant::now();
        let threads = self.threads.start()?;
        Ok(threads.install(|| {
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
        }))
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
    pub fn obey(&mut self, py: Python<'_>) -> PyResult<()> {
        let Self { world, present, arrays, .. } = self;
        arrays.preferred.obey(py, world, present)?;
        arrays.goals.obey(py, world, present)
    }

    pub fn id(&self, number: u32) -> PyResult<AgentId> {
        let found = self.present.index(number).map(|index| self.present.ids[index]);
        found.ok_or_else(|| PyIndexError::new_err(format!("agent {number} is not present; `ids` has those that are")))
    }

    pub fn group(&self, group: &str) -> PyResult<usize> {
        let names = || self.built.groups.iter().map(|group| group.name.as_str());
        let by_number = || group.parse().ok().filter(|&k: &usize| k < self.built.groups.len());
        names().position(|name| name == group).or_else(by_number).ok_or_else(|| {
            let all: Vec<&str> = names().collect();
            PyValueError::new_err(format!("there is no group `{group}`; there are: {}", all.join(", ")))
        })
    }

    pub fn twin(&self, py: Python<'_>) -> PyResult<Self> {
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

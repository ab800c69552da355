//! Arrays that the program writes and the world obeys at its next step.

use crate::error::WorldError;
use crate::live::Present;
use crate::model::array2;
use glam::DVec2;
use numpy::{PyArray2, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use throng::{AgentId, Error, Goal, JourneyId, World};

/// A pair of numbers of an agent that the program can set. NaN stands for none.
pub trait Command {
    /// The name of the array.
    const NAME: &'static str;
    /// Returns what the agent has now.
    fn read(world: &World, id: AgentId) -> [f64; 2];
    /// Sets it; `None` for none.
    fn set(world: &mut World, id: AgentId, value: Option<DVec2>) -> Result<(), Error>;
}

/// Preferred velocities, m/s.
pub struct Preferred;

impl Command for Preferred {
    const NAME: &'static str = "preferred";

    fn read(world: &World, id: AgentId) -> [f64; 2] {
        let commanded = world.row(id).and_then(|row| world.relative_columns().commanded[row]);
        commanded.map_or([f64::NAN; 2], |velocity| velocity.truncate().as_dvec2().to_array())
    }

    fn set(world: &mut World, id: AgentId, value: Option<DVec2>) -> Result<(), Error> {
        world.set_preferred_velocity(id, value.map(|velocity| velocity.as_vec2().extend(0.0)))
    }
}

/// Goals that are points, world coordinates.
pub struct Goals;

impl Command for Goals {
    const NAME: &'static str = "goals";

    fn read(world: &World, id: AgentId) -> [f64; 2] {
        match world.agent(id).and_then(|agent| agent.goal()) {
            Some(Goal::Point { at, .. }) => at.to_array(),
            Some(Goal::Air { at, .. }) => at.truncate().to_array(),
            _ => [f64::NAN; 2],
        }
    }

    fn set(world: &mut World, id: AgentId, value: Option<DVec2>) -> Result<(), Error> {
        match value {
            Some(point) => world.set_goal(id, point),
            None => world.set_journey(id, JourneyId::STAY),
        }
    }
}

/// An array that the program writes.
pub struct Writable<C: Command> {
    array: Option<Py<PyArray2<f64>>>,
    /// What the world has obeyed, or what it told.
    known: Vec<[f64; 2]>,
    command: std::marker::PhantomData<C>,
}

impl<C: Command> Default for Writable<C> {
    fn default() -> Self {
        Self { array: None, known: vec![], command: std::marker::PhantomData }
    }
}

impl<C: Command> Writable<C> {
    /// Returns the array.
    pub fn get(&mut self, py: Python<'_>, world: &World, present: &Present) -> PyResult<Py<PyArray2<f64>>> {
        if let Some(array) = &self.array {
            return Ok(array.clone_ref(py));
        }
        self.known = present.ids.iter().map(|&id| C::read(world, id)).collect();
        let array = array2(py, self.known.concat(), 2)?;
        self.array = Some(array.clone_ref(py));
        Ok(array)
    }

    /// Sets what the program has changed since the last time.
    pub fn obey(&mut self, py: Python<'_>, world: &mut World, present: &Present) -> PyResult<()> {
        let Some(array) = &self.array else { return Ok(()) };
        let wanted = rows(array.bind(py))?;
        for (k, &wanted) in wanted.iter().enumerate() {
            if same(wanted, self.known[k]) {
                continue;
            }
            let number = present.numbers[k];
            let value = match wanted.map(f64::is_nan) {
                [true, true] => None,
                [false, false] => Some(DVec2::from_array(wanted)),
                _ => {
                    let text = format!("`{}` has NaN in one of two numbers for agent {number}", C::NAME);
                    return Err(PyValueError::new_err(text));
                }
            };
            let set = C::set(world, present.ids[k], value);
            set.map_err(|error| WorldError::new_err(format!("`{}` of agent {number}: {error}", C::NAME)))?;
            self.known[k] = wanted;
        }
        Ok(())
    }

    /// Writes what has changed in the world into the array, except where the program has written since.
    pub fn refresh(&mut self, py: Python<'_>, world: &World, present: &Present) -> PyResult<()> {
        let Some(array) = &self.array else { return Ok(()) };
        let mut array = array.bind(py).try_readwrite()?;
        let mut rows = array.as_array_mut();
        for (k, &id) in present.ids.iter().enumerate() {
            let now = C::read(world, id);
            if !same(now, self.known[k]) && same([rows[[k, 0]], rows[[k, 1]]], self.known[k]) {
                (rows[[k, 0]], rows[[k, 1]]) = (now[0], now[1]);
                self.known[k] = now;
            }
        }
        Ok(())
    }

    /// Makes an array for the agents that are present now. Agents that were in the old array keep their rows.
    pub fn carry_over(&mut self, py: Python<'_>, before: &[u32], present: &Present) -> PyResult<()> {
        let Some(array) = self.array.take() else { return Ok(()) };
        let wanted = rows(array.bind(py))?;
        let row = |number: &u32| before.binary_search(number).ok();
        let none = [f64::NAN; 2];
        let carried = |of: &[[f64; 2]]| -> Vec<[f64; 2]> {
            present.numbers.iter().map(|number| row(number).map_or(none, |k| of[k])).collect()
        };
        let array = array2(py, carried(&wanted).concat(), 2)?;
        self.known = carried(&self.known);
        self.array = Some(array);
        Ok(())
    }

    /// Leaves the array to the program: the world has another state.
    pub fn forget(&mut self) {
        self.array = None;
    }
}

/// Returns the rows of an array.
fn rows(array: &Bound<'_, PyArray2<f64>>) -> PyResult<Vec<[f64; 2]>> {
    let array = array.try_readonly()?;
    Ok(array.as_array().rows().into_iter().map(|row| [row[0], row[1]]).collect())
}

/// Whether two pairs are the same; NaN is NaN.
fn same(a: [f64; 2], b: [f64; 2]) -> bool {
    (0..2).all(|k| a[k] == b[k] || (a[k].is_nan() && b[k].is_nan()))
}

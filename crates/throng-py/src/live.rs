//! Arrays of the state of agents, which follow the steps of a world.

use glam::DVec2;
use numpy::ndarray::{ArrayViewMut, IxDyn};
use numpy::{Element, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;
use throng::agent::Columns;
use throng::{AgentId, World};

/// The agents of a world that are present, in the order of their numbers.
#[derive(Default)]
pub struct Present {
    /// Their ids.
    pub ids: Vec<AgentId>,
    /// Their numbers.
    pub numbers: Vec<u32>,
}

impl Present {
    /// Finds the agents that are present now. Returns whether others were present before.
    pub fn find(&mut self, world: &World) -> bool {
        let agents = world.relative_columns();
        let is_same = self.ids.len() == agents.len() && self.ids.iter().all(|&id| world.row(id).is_some());
        if is_same {
            return false;
        }
        let mut all: Vec<(u32, AgentId)> = (0..agents.len()).map(|row| (agents.number[row], world.id(row))).collect();
        all.sort_unstable_by_key(|&(number, _)| number);
        (self.numbers, self.ids) = all.into_iter().unzip();
        true
    }

    /// Returns the position of an agent in the arrays.
    pub fn index(&self, number: u32) -> Option<usize> {
        self.numbers.binary_search(&number).ok()
    }

    /// Returns the row of each agent.
    pub fn rows<'a>(&'a self, world: &'a World) -> impl Iterator<Item = usize> + 'a {
        // all are present, as `find` has seen
        self.ids.iter().filter_map(|&id| world.row(id))
    }
}

/// A property of an agent that an array holds.
pub trait Property {
    /// The numbers of the array.
    type Item: Element + Copy + Default;
    /// The numbers for each agent; 0 stands for one, in an array of one dimension.
    const WIDTH: usize;
    /// Reads the property of an agent.
    fn read(agents: &Columns, origin: DVec2, row: usize, out: &mut [Self::Item]);
}

/// Declares properties.
macro_rules! properties {
    ($($(#[$about:meta])* $name:ident[$width:literal]: $item:ty = |$agents:ident, $origin:pat_param, $row:ident| $value:expr;)*) => { $(
        $(#[$about])*
        pub struct $name;

        impl Property for $name {
            type Item = $item;
            const WIDTH: usize = $width;

            fn read($agents: &Columns, $origin: DVec2, $row: usize, out: &mut [$item]) {
                out.copy_from_slice(&$value);
            }
        }
    )* };
}

properties! {
    /// World coordinates, metres.
    Positions[2]: f64 = |agents, origin, row| (agents.position[row].as_dvec2() + origin).to_array();
    /// Metres above the ground.
    Altitudes[0]: f32 = |agents, _, row| [agents.altitude[row]];
    /// Metres a second.
    Velocities[2]: f32 = |agents, _, row| agents.velocity[row].to_array();
    /// Metres a second, upwards.
    VerticalVelocities[0]: f32 = |agents, _, row| [agents.vertical_velocity[row]];
    /// Radians counter-clockwise from +x.
    Headings[0]: f32 = |agents, _, row| [agents.heading[row]];
    /// Metres.
    Radii[0]: f32 = |agents, _, row| [agents.radius[row]];
    /// Metres a second.
    PreferredSpeeds[0]: f32 = |agents, _, row| [agents.preferred_speed[row]];
    /// Metres a second.
    MaxSpeeds[0]: f32 = |agents, _, row| [agents.max_speed[row]];
    /// The number of the status in [`Status`](throng::Status).
    Statuses[0]: u8 = |agents, _, row| [agents.status[row] as u8];
    /// The index of the group in the scene.
    Groups[0]: u32 = |agents, _, row| [(agents.group[row].index() as u32).saturating_sub(1)];
    /// The number.
    Numbers[0]: u32 = |agents, _, row| [agents.number[row]];
}

/// An array of a property. It is made when it is first read, and is the same object, written anew after each change, while
/// the same agents are present.
pub struct Live<P: Property> {
    array: Option<Made<P::Item>>,
}

struct Made<T> {
    /// The array with the memory.
    owner: Py<PyArrayDyn<T>>,
    /// A view of it that cannot be written.
    shown: Py<PyAny>,
}

impl<P: Property> Default for Live<P> {
    fn default() -> Self {
        Self { array: None }
    }
}

impl<P: Property> Live<P> {
    /// Returns the array, current.
    pub fn get(&mut self, py: Python<'_>, world: &World, present: &Present) -> PyResult<Py<PyAny>> {
        if let Some(made) = &self.array {
            return Ok(made.shown.clone_ref(py));
        }
        let dims: Vec<usize> = [present.ids.len()].into_iter().chain((P::WIDTH > 0).then_some(P::WIDTH)).collect();
        let owner = PyArrayDyn::<P::Item>::zeros(py, IxDyn(&dims), false);
        let shown = owner.call_method0("view")?;
        shown.getattr("flags")?.setattr("writeable", false)?;
        self.array = Some(Made { owner: owner.unbind(), shown: shown.clone().unbind() });
        self.write(py, world, present)?;
        Ok(shown.unbind())
    }

    /// Writes the array after a change, if there is one.
    pub fn write(&self, py: Python<'_>, world: &World, present: &Present) -> PyResult<()> {
        let Some(made) = &self.array else { return Ok(()) };
        let mut owner = made.owner.bind(py).try_readwrite()?;
        let mut all: ArrayViewMut<'_, P::Item, IxDyn> = owner.as_array_mut();
        let (agents, origin) = (world.relative_columns(), world.settings().origin);
        let Some(out) = all.as_slice_mut() else { unreachable!("the array is contiguous") };
        for (row, out) in present.rows(world).zip(out.chunks_exact_mut(P::WIDTH.max(1))) {
            P::read(agents, origin, row, out);
        }
        Ok(())
    }

    /// Leaves the array to the program as it is: other agents are present now.
    pub fn release(&mut self) {
        self.array = None;
    }
}

//! Agents with the neighbour search over all agents within a distance, instead of the nearest few: their neighbours,
//! and the forces of flocks.

use super::{State, World};
use crate::agent::Group;
use crate::parallel;
use crate::perceive::CellLattice;
use crate::simd::LANES;
use crate::steer::{Behaviour, Bird, Birds, Flock, FlockTileScratch, Flocking, SteeringNeighbour, TraceRecorder};
use glam::Vec3;
use std::ops::Range;

/// The data of all agents, for agents that search for all neighbours within a distance.
#[derive(Clone, Debug, Default)]
pub(super) struct Flocks {
    lattice: CellLattice,
    birds: Birds,
    /// Forces of the birds of a flock, in the order of the lattice; zero for other agents.
    forces: Vec<Vec3>,
    scratch: Vec<FlockingScratch>,
    /// Distance within which the separation of two agents is measured, metres.
    close: f32,
    /// Rows of the pairs to be measured, each pair once.
    close_pairs: Vec<(u32, u32)>,
}

/// Scratch memory of a thread.
#[derive(Clone, Debug, Default)]
struct FlockingScratch {
    pack: FlockTileScratch,
    neighbours: Vec<SteeringNeighbour>,
}

impl Flocks {
    /// Returns the rows of the pairs to be measured after motion.
    pub fn close_pairs(&self) -> &[(u32, u32)] {
        &self.close_pairs
    }

    /// Returns the force of a row that is a bird of a flock.
    pub fn force(&self, row: usize) -> Vec3 {
        self.forces[self.lattice.places()[row] as usize]
    }

    /// Returns the rows in the order of the lattice.
    pub fn order(&self) -> &[u32] {
        self.lattice.order()
    }

    /// Records that the rows have been sorted into that order.
    pub fn rows_are_in_order(&mut self) {
        self.lattice.rows_are_in_order();
    }
}

impl World {
    /// Sorts all agents into the lattice, if a group searches for all neighbours within a distance.
    pub(super) fn rebuild_lattice(&mut self, seconds: f32) {
        let looking = self.state.groups_in_use().filter(|group| group.neighbours == Group::ALL_NEIGHBOURS);
        let reach = looking.map(|group| group.neighbour_distance).fold(0.0, f32::max);
        let mut flocks = std::mem::take(&mut self.step.flocks);
        flocks.close_pairs.clear();
        if reach > 0.0 {
            flocks.close = self.state.close_enough_to_measure(seconds);
            let world = &*self;
            flocks.lattice.rebuild(|row| world.state.place_in_space(row), &world.state.agents.number, reach);
        }
        self.step.flocks = flocks;
    }

    /// Gathers the bird data of all agents.
    fn note_birds(&mut self) {
        let mut flocks = std::mem::take(&mut self.step.flocks);
        let Birds { all, forward: [x, y, z], radius } = &mut flocks.birds;
        all.resize(self.state.agents.len(), Bird::default());
        for column in [&mut *x, &mut *y, &mut *z] {
            column.resize(self.state.agents.len() + LANES, 0.0);
        }
        *radius = self.state.agents.radius.uniform();
        let (world, order) = (&*self, flocks.lattice.order());
        let columns = (&mut x[..order.len()], &mut y[..order.len()], &mut z[..order.len()]);
        parallel::ranges((&mut all[..], columns), |places, (birds, (x, y, z))| {
            for (at, (&row, bird)) in order[places].iter().zip(birds).enumerate() {
                let row = row as usize;
                let forward = world.state.forward(row);
                [x[at], y[at], z[at]] = forward.to_array();
                let (group, radius) = (world.state.agents.group[row].index() as u32, world.state.agents.radius[row]);
                *bird = Bird { position: world.state.place_in_space(row), forward, group, radius };
            }
        });
        self.step.flocks = flocks;
    }

    /// Computes the forces of the birds of flocks, and finds the pairs that are close enough to be measured.
    pub(super) fn flock(&mut self, seconds: f32, now: f64) {
        if !self.state.any_looks_at_all() {
            return;
        }
        self.note_birds();
        let mut forces = std::mem::take(&mut self.step.flocks.forces);
        let mut scratch = std::mem::take(&mut self.step.flocks.scratch);
        forces.resize(self.state.agents.len(), Vec3::ZERO);
        let world = &*self;
        parallel::ranges_with(&mut forces[..], &mut scratch, |scratch, places, forces| {
            for (index, group) in world.state.local_groups.iter().enumerate().filter(|&(index, _)| world.state.groups_with_agents[index]) {
                if group.neighbours == Group::ALL_NEIGHBOURS {
                    world.flock_of_group(index, places.clone(), scratch, forces, (seconds, now));
                }
            }
        });
        let Self { state: State { agents, .. }, step } = self;
        let Flocks { lattice, close_pairs, .. } = &mut step.flocks;
        let rows = |(a, b): (u32, u32)| (lattice.order()[a as usize], lattice.order()[b as usize]);
        let pairs = scratch.iter_mut().flat_map(|scratch| scratch.pack.take_close()).map(rows);
        close_pairs.extend(pairs.filter(|&(a, b)| agents.number[a as usize] < agents.number[b as usize]));
        (step.flocks.forces, step.flocks.scratch) = (forces, scratch);
    }

    /// As [`flock`](Self::flock), for the agents of a group in a range of the lattice's order.
    fn flock_of_group(
        &self,
        index: usize,
        places: Range<usize>,
        FlockingScratch { pack, neighbours }: &mut FlockingScratch,
        forces: &mut [Vec3],
        (seconds, now): (f32, f64),
    ) {
        let (group, Flocks { lattice, birds, close, .. }) = (&self.state.local_groups[index], &self.step.flocks);
        let close = close.min(group.neighbour_distance);
        let flocking = group.steering.as_ref().and_then(|steering| steering.as_flocking());
        let mut force = |place: usize, flocking: &Flocking| {
            let row = lattice.order()[place] as usize;
            let view = self.steering_view(row, seconds, now, neighbours);
            flocking.steer(&view, &mut [], &mut TraceRecorder::default()).unwrap_or_default().force
        };
        let level = self.state.instructions.level().filter(|_| self.state.agents.all_avoid());
        if let (Some(level), Some(flocking)) = (level, flocking) {
            let flock = Flock {
                flocking,
                vehicle: &group.vehicle,
                group: index as u32,
                range: group.neighbour_distance,
                close,
                lattice,
                birds,
            };
            return flock.forces(level, places, pack, forces, |place| force(place, flocking));
        }
        for (place, out) in places.zip(forces).filter(|(place, _)| birds.all[*place].group as usize == index) {
            lattice.within(birds.all[place].position, close, |other, _| {
                if other != place {
                    pack.note_close(place, other);
                }
            });
            if let Some(flocking) = flocking {
                *out = force(place, flocking);
            }
        }
    }

    /// Adds all agents within the distance to `neighbours`, if the agent's group searches for all.
    pub(super) fn look_at_all(&self, row: usize, neighbours: &mut Vec<SteeringNeighbour>) {
        let (agents, Flocks { lattice, birds, .. }) = (&self.state.agents, &self.step.flocks);
        let group = &self.state.local_groups[agents.group[row].index()];
        if group.neighbours != Group::ALL_NEIGHBOURS {
            return;
        }
        lattice.within(self.state.place_in_space(row), group.neighbour_distance, |place, offset| {
            let other = lattice.order()[place] as usize;
            if other != row && agents.avoids(row, other) {
                neighbours.push(SteeringNeighbour {
                    offset,
                    velocity: agents.velocity[other].extend(agents.vertical_velocity[other]),
                    forward: birds.all[place].forward,
                    radius: agents.radius[other],
                    number: agents.number[other],
                    group: agents.group[other].index(),
                });
            }
        });
        // birds are many, and their forces do not depend on the order
        if group.steering.as_ref().is_none_or(|steering| steering.as_flocking().is_none()) {
            let distance = |other: &SteeringNeighbour| other.offset.length_squared();
            neighbours.sort_unstable_by(|a, b| distance(a).total_cmp(&distance(b)).then(a.number.cmp(&b.number)));
        }
    }
}

impl State {
    /// Whether any group searches for all neighbours within a distance.
    pub(crate) fn any_looks_at_all(&self) -> bool {
        self.groups_in_use().any(|group| group.neighbours == Group::ALL_NEIGHBOURS)
    }

    /// Whether an agent is a bird: it steers by a plain [`Flocking`] behaviour, with all neighbours within a distance.
    pub(crate) fn is_bird(&self, row: usize) -> bool {
        let group = &self.local_groups[self.agents.group[row].index()];
        group.neighbours == Group::ALL_NEIGHBOURS
            && group.steering.as_ref().is_some_and(|all| all.as_flocking().is_some())
    }

    /// Whether no group searches for the nearest few neighbours.
    pub(crate) fn none_counts_the_nearest(&self) -> bool {
        self.groups_in_use().all(|group| group.nearest() == 0)
    }
}

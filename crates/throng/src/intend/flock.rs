//! Agents with the neighbour search over all agents within a distance, instead of the nearest few: their neighbours,
//! and the forces of flocks.

use super::steering::{Behaving, SteeringIndex};
use crate::agent::{ColumnValue, Columns, Group};
use crate::halo::FarQuestions;
use crate::motion::Vehicle;
use crate::parallel;
use crate::perceive::{CellLattice, Perceived};
use crate::simd::LANES;
use crate::steer::{Bird, Birds, FlockBatch, SteeringNeighbour, TraceRecorder};
use crate::world::State;
use glam::Vec3;
use std::ops::Range;

/// The data of all agents, for agents that search for all neighbours within a distance.
#[derive(Clone, Debug, Default)]
pub(super) struct Flocks {
    pub birds: Birds,
    /// Forces of the birds of a flock, in the order of the lattice; zero for other agents.
    pub forces: Vec<Vec3>,
    /// The vehicle of all agents of each group that searches for all neighbours; `None` if they differ or have none.
    vehicles: Vec<Option<Vehicle>>,
    scratch: Vec<FlockingScratch>,
    /// Rows of the pairs to be measured, each pair once.
    close_pairs: Vec<(u32, u32)>,
}

/// Scratch memory of a thread.
#[derive(Clone, Debug, Default)]
struct FlockingScratch {
    runs: Vec<Range<usize>>,
    /// Places of pairs of close agents.
    close_pairs: Vec<(u32, u32)>,
    neighbours: Vec<SteeringNeighbour>,
}

impl Flocks {
    /// Returns the rows of the pairs to be measured after motion.
    pub fn close_pairs(&self) -> &[(u32, u32)] {
        &self.close_pairs
    }

    /// Forgets the pairs to be measured.
    pub fn clear(&mut self) {
        self.close_pairs.clear();
    }

    /// Computes the forces of the birds of flocks, and finds the pairs that are close enough to be measured.
    pub fn run(
        &mut self,
        state: &State,
        seen: Perceived<'_>,
        index: (&SteeringIndex, Option<&FarQuestions>),
        seconds: f32,
        now: f64,
    ) {
        if !state.any_looks_at_all() {
            return;
        }
        self.note_birds(state, seen.lattice);
        let Self { birds, forces, vehicles, scratch, close_pairs } = self;
        let groups = || state.local_groups.iter().zip(&state.groups_with_agents).enumerate();
        let looks_at_all = |group: &Group, in_use: bool| in_use && group.looks_at_all();
        vehicles.clear();
        vehicles.extend(groups().map(|(index, (group, &in_use))| {
            looks_at_all(group, in_use).then(|| state.vehicle_of_all(index)).flatten()
        }));
        forces.resize(state.agents.len(), Vec3::ZERO);
        let flocking = Behaving::new(state, seen, index, (birds, &[]));
        parallel::ranges_with(&mut forces[..], scratch, |scratch, places, forces| {
            for (index, _) in groups().filter(|(_, (group, in_use))| looks_at_all(group, **in_use)) {
                let of = (index, vehicles[index].as_ref());
                flocking.flock_of_group(of, places.clone(), scratch, forces, (seen.close, seconds, now));
            }
        });
        let order = seen.lattice.order();
        let rows = |(a, b): (u32, u32)| (order[a as usize], order[b as usize]);
        let pairs = scratch.iter_mut().flat_map(|scratch| scratch.close_pairs.drain(..)).map(rows);
        let number = |row: u32| state.agents.number[row as usize];
        // a pair counts in the world of its agent with the lower number
        let counts = |&(a, b): &(u32, u32)| number(a) < number(b) && state.own().contains(&(a as usize));
        close_pairs.extend(pairs.filter(counts));
    }

    /// Gathers the bird data of all agents.
    fn note_birds(&mut self, state: &State, lattice: &CellLattice) {
        let Birds { all, forward: [x, y, z], radius } = &mut self.birds;
        all.resize(state.agents.len(), Bird::default());
        for column in [&mut *x, &mut *y, &mut *z] {
            column.resize(state.agents.len() + LANES, 0.0);
        }
        *radius = state.agents.radius.uniform();
        let order = lattice.order();
        let columns = (&mut x[..order.len()], &mut y[..order.len()], &mut z[..order.len()]);
        parallel::ranges((&mut all[..], columns), |places, (birds, (x, y, z))| {
            for (at, (&row, bird)) in order[places].iter().zip(birds).enumerate() {
                let row = row as usize;
                let forward = state.forward(row);
                [x[at], y[at], z[at]] = forward.to_array();
                let (group, radius) = (state.agents.group[row].index() as u32, state.agents.radius[row]);
                *bird = Bird { position: state.place_in_space(row), forward, group, radius };
            }
        });
    }
}

impl Behaving<'_> {
    /// Returns the force of a row that is a bird of a flock.
    pub fn force(&self, row: usize) -> Vec3 {
        self.forces[self.lattice.places()[row] as usize]
    }

    /// Computes the forces of the birds of flocks, for the agents of a group in a range of the lattice's order.
    fn flock_of_group(
        &self,
        (index, vehicle): (usize, Option<&Vehicle>),
        places: Range<usize>,
        FlockingScratch { runs, close_pairs, neighbours }: &mut FlockingScratch,
        forces: &mut [Vec3],
        (close, seconds, now): (f32, f32, f64),
    ) {
        let (group, Self { lattice, birds, .. }) = (&self.state.local_groups[index], *self);
        let close = close.min(group.neighbour_distance);
        let steering = group.guidance.behaviour.as_ref().filter(|_| group.is_flock());
        let mut force = |place: usize| {
            let row = lattice.order()[place] as usize;
            let view = self.view(row, seconds, now, neighbours);
            let steering = steering.and_then(|steering| steering.steer(&view, &mut [], &mut TraceRecorder::default()));
            steering.unwrap_or_default().force
        };
        let level = self.state.instructions.level().filter(|_| self.state.agents.all_avoid());
        if let (Some(level), Some(steering), Some(vehicle)) = (level, steering, vehicle) {
            let mut batch = FlockBatch {
                level,
                vehicle,
                group: index as u32,
                range: group.neighbour_distance,
                close,
                lattice,
                birds,
                places: places.clone(),
                runs,
                close_pairs,
                forces,
                one: &mut force,
                is_done: false,
            };
            steering.steer_flock(&mut batch);
            if batch.is_done {
                return;
            }
        }
        for (place, out) in places.zip(forces).filter(|(place, _)| birds.all[*place].group as usize == index) {
            lattice.within(birds.all[place].position, close, |other, _| {
                if other != place {
                    close_pairs.push((place as u32, other as u32));
                }
            });
            if steering.is_some() {
                *out = force(place);
            }
        }
    }

    /// Adds all agents within the distance to `neighbours`, if the agent's group searches for all.
    pub fn look_at_all(&self, row: usize, neighbours: &mut Vec<SteeringNeighbour>) {
        let (agents, Self { lattice, birds, .. }) = (&self.state.agents, *self);
        let group = &self.state.local_groups[agents.group[row].index()];
        if !group.looks_at_all() {
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
        if !group.is_flock() {
            let distance = |other: &SteeringNeighbour| other.offset.length_squared();
            neighbours.sort_unstable_by(|a, b| distance(a).total_cmp(&distance(b)).then(a.number.cmp(&b.number)));
        }
    }
}

impl State {
    /// Whether any group searches for all neighbours within a distance.
    pub(crate) fn any_looks_at_all(&self) -> bool {
        self.groups_in_use().any(Group::looks_at_all)
    }

    /// Returns the vehicle of all agents of a group; `None` if they differ or have none.
    fn vehicle_of_all(&self, group: usize) -> Option<Vehicle> {
        let Columns { vehicle, group: groups, .. } = &self.agents;
        vehicle.uniform().unwrap_or_else(|| {
            let mut all = (0..self.agents.len()).filter(|&row| groups[row].index() == group).map(|row| vehicle[row]);
            let first = all.next()?;
            first.filter(|_| all.all(|other| other.same(first)))
        })
    }

    /// Whether no group searches for the nearest few neighbours.
    pub(crate) fn none_counts_the_nearest(&self) -> bool {
        self.groups_in_use().all(|group| group.nearest() == 0)
    }
}

impl Group {
    /// Whether the forces of its agents are those of a flock, which are computed before the vehicles step.
    pub(super) fn is_flock(&self) -> bool {
        self.looks_at_all()
            && self.guidance.behaviour.as_ref().is_some_and(|steering| steering.is_flock() && steering.words() == 0)
    }
}

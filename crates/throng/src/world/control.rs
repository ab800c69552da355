//! Control by the program while the world runs: goals, preferred velocities and places of agents, and user data.

use super::build::{check_altitude, direction};
use super::{State, World};
use crate::agent::{AgentId, JourneyId, ProgressMark, Rounding, Status};
use crate::halo::Alone;
use crate::navigate::{Goal, Journey, PathRequest, Stop};
use crate::{Error, Position};
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Journeys to a single goal that the world has made for agents: equal goals share one, and one that no agent uses is used
/// again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct OwnJourneys {
    /// By the bits of the goal.
    by_goal: BTreeMap<Vec<u8>, JourneyId>,
    unused: Vec<JourneyId>,
    /// At this many the unused ones are looked for.
    full: usize,
}

/// The least number of journeys at which the unused ones are looked for.
const FEW: usize = 64;

impl World {
    /// Turns agents to the beginning of their paths: around walls to the first corner, otherwise straight to the goal.
    /// Agents keep their headings if they have been removed, have no goal, or cannot reach it, and if they are not
    /// discs, because a turned body might not fit. Call it at the start: agents added without a heading face their
    /// goals, even through walls.
    pub fn face_ways(&mut self, agents: &[AgentId]) {
        let leg = |row: usize| self.state.first_leg(self.state.agents.journey[row], self.state.world_place(row));
        let rows = agents.iter().filter_map(|&id| self.state.row(id)).filter(|&row| self.state.agents.is_disc(row));
        let mut ways: Vec<PathRequest> = rows.filter_map(|row| self.state.ask_way(row, leg(row)?)).collect();
        self.state.prepare_meshes(&ways, &mut Alone);
        self.state.meshes.find(&self.state.goals, &mut ways);
        for way in ways {
            let Some(Ok((path, _))) = way.found else { continue };
            if let Some(heading) = path.corners.iter().find_map(|&corner| direction(corner - way.from)) {
                self.state.agents.heading[way.row] = heading;
            }
        }
    }

    /// Sends an agent to another goal: a place, or a [`Goal`]. Its journey ends; its trip goes on.
    ///
    /// ```
    /// use throng::{Agent, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let id = world.add_agent(Agent::at([0.0, 0.0]).goal([5.0, 0.0]))?;
    /// world.step();
    /// world.set_goal(id, [0.0, 5.0])?;
    /// while !world.finished() {
    ///     world.step();
    /// }
    /// assert!(world.position(id).is_some_and(|at| at.y > 4.5));
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`add_goal`](Self::add_goal), and [`Error::Gone`] for an agent that has been removed; the world is unchanged.
    pub fn set_goal(&mut self, id: AgentId, goal: impl Into<Goal>) -> Result<(), Error> {
        let row = self.state.row(id).ok_or(Error::Gone)?;
        let journey = self.state.own_journey(goal.into())?;
        self.begin_journey(row, journey);
        Ok(())
    }

    /// Sends an agent on another journey, from its first stop. Its trip goes on.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a journey that does not exist, [`Error::Gone`] for an agent that has been removed.
    pub fn set_journey(&mut self, id: AgentId, journey: JourneyId) -> Result<(), Error> {
        let row = self.state.row(id).ok_or(Error::Gone)?;
        super::build::known("journey", journey.index(), self.state.journeys.len())?;
        self.begin_journey(row, journey);
        Ok(())
    }

    /// Gives an agent a preferred velocity, m/s, in place of the one from its goal, field or behaviour. `None` returns
    /// the control to the engine. The local model and the guard keep the agent safe as before, and its motor limits the
    /// motion: a vehicle steers towards the velocity.
    ///
    /// ```
    /// use glam::Vec3;
    /// use throng::{Agent, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let id = world.add_agent(Agent::at([0.0, 0.0]))?;
    /// world.set_preferred_velocity(id, Vec3::Y)?;
    /// for _ in 0..120 {
    ///     world.step();
    /// }
    /// assert!(world.position(id).is_some_and(|at| at.y > 1.5));
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Limit`] for a velocity that is not finite, [`Error::Gone`] for an agent that has been removed.
    pub fn set_preferred_velocity(&mut self, id: AgentId, velocity: impl Into<Option<Vec3>>) -> Result<(), Error> {
        let (row, velocity) = (self.state.row(id).ok_or(Error::Gone)?, velocity.into());
        Error::unless_finite("preferred velocity", f64::from(velocity.unwrap_or_default().element_sum()))?;
        self.state.agents.commanded.set(row, velocity);
        self.state.update_status_without_stops(row);
        self.step.wake();
        Ok(())
    }

    /// Moves an agent to another place, as the program's own physics does. It keeps its velocity, goal and trip. Its
    /// route stays while it leads on from there, and is planned anew otherwise. The agent may overlap other agents there: the pair is separated smoothly, and
    /// [`is_free`](Self::is_free) tells beforehand.
    ///
    /// # Errors
    /// [`Error::Limit`] for a place out of range, [`Error::NoRoom`] for a body that would stand in something solid,
    /// [`Error::Gone`] for an agent that has been removed; the world is unchanged.
    pub fn set_position(&mut self, id: AgentId, place: impl Into<Position>) -> Result<(), Error> {
        let (row, Position(place)) = (self.state.row(id).ok_or(Error::Gone)?, place.into());
        self.state.check_position("position", place.truncate())?;
        check_altitude("altitude", place.z)?;
        let there = crate::Agent { position: place, ..self.state.to_agent(row) };
        if let Some(why) = self.state.no_room_for(&there) {
            return Err(Error::NoRoom { at: there.position.truncate(), radius: there.radius, why });
        }
        self.state.agents.position[row] = (there.position.truncate() - self.state.settings.origin).as_vec2();
        self.state.agents.rounding.set(row, Rounding::NONE);
        self.state.agents.altitude.set(row, there.position.z as f32);
        self.state.revive(row);
        self.step.wake();
        Ok(())
    }

    /// Stores a number of the program with an agent: an index into its own tables, for example. The engine does not use it.
    ///
    /// # Errors
    /// [`Error::Gone`] for an agent that has been removed.
    pub fn set_user_data(&mut self, id: AgentId, data: u64) -> Result<(), Error> {
        let row = self.state.row(id).ok_or(Error::Gone)?;
        self.state.agents.user_data.set(row, data);
        Ok(())
    }

    /// Begins a journey, from where the agent is.
    fn begin_journey(&mut self, row: usize, journey: JourneyId) {
        self.state.agents.journey.set(row, journey);
        self.state.agents.travel[row].begin(0);
        self.state.agents.progress_mark[row] = ProgressMark::default();
        self.state.agents.arrived.set(row, f64::INFINITY);
        self.state.unstrand(row);
        let status = self.state.first_status(row);
        self.state.agents.status[row] = status;
        if status == Status::Arrived {
            self.state.agents.arrived.set(row, self.state.time());
        }
        self.step.wake();
    }
}

impl State {
    /// Returns the journey to a single goal.
    pub(crate) fn own_journey(&mut self, goal: Goal) -> Result<JourneyId, Error> {
        self.check_goal(&goal)?;
        let key = key(&goal);
        if let Some(&journey) = self.own_journeys.by_goal.get(&key) {
            return Ok(journey);
        }
        if self.own_journeys.by_goal.len() >= self.own_journeys.full.max(FEW) {
            self.find_unused_journeys();
        }
        let journey = match self.own_journeys.unused.pop() {
            Some(journey) => {
                let single = &self.journeys[journey.index()];
                let id = single.stops[0].goal;
                self.goals[id.index()] = goal;
                self.legs.update(journey, single, &self.goals);
                self.meshes.forget(id);
                journey
            }
            None => {
                let goal = self.add_goal(goal)?;
                self.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })?
            }
        };
        self.own_journeys.by_goal.insert(key, journey);
        Ok(journey)
    }

    /// Lets journeys that no agent uses be used again.
    fn find_unused_journeys(&mut self) {
        let mut used = vec![false; self.journeys.len()];
        self.agents.journey.values().iter().for_each(|journey| used[journey.index()] = true);
        self.schedule.agents().for_each(|agent| used[agent.journey.index()] = true);
        let own = &mut self.own_journeys;
        let (kept, unused) = std::mem::take(&mut own.by_goal).into_iter().partition(|(_, id)| used[id.index()]);
        own.by_goal = kept;
        let unused: BTreeMap<Vec<u8>, JourneyId> = unused;
        own.unused.extend(unused.into_values());
        own.full = 2 * own.by_goal.len();
    }

    /// Lets a stranded agent walk again: the goal may be reachable from where it is now.
    pub(crate) fn revive(&mut self, row: usize) {
        if self.agents.status[row] == Status::Stranded {
            self.agents.status[row] = Status::Walking;
            self.unstrand(row);
        }
    }

    /// Takes an agent off the list of agents that cannot reach their goals.
    pub(crate) fn unstrand(&mut self, row: usize) {
        let number = self.agents.number[row];
        self.stranded.retain(|&(stranded, _)| stranded != number);
    }

    /// Returns the goal of an agent with a journey that was made for this goal alone.
    pub(crate) fn own_goal(&self, row: usize) -> Option<Goal> {
        let journey = self.agents.journey[row];
        let goal = &self.goals[self.journeys[journey.index()].stops.first()?.goal.index()];
        (self.own_journeys.by_goal.get(&key(goal)) == Some(&journey)).then(|| goal.clone())
    }
}

/// Returns the bits of a goal.
fn key(goal: &Goal) -> Vec<u8> {
    // writing to memory cannot fail, and all types are serialisable
    postcard::to_stdvec(goal).unwrap_or_default()
}

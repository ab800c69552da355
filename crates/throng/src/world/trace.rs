//! Traces: for requested agents, the reasons of their motion in every step, as data that pictures can draw.

use super::World;
use crate::agent::Memory;
use crate::steer::{SteeringReason, TraceEntry};
use glam::Vec3;
use std::f32::consts::PI;

/// The agents to trace.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum TraceRequest {
    /// No agent: tracing costs nothing.
    #[default]
    None,
    /// Every agent.
    All,
    /// The agents with these numbers.
    Numbers(Vec<u32>),
}

impl TraceRequest {
    /// Whether the agent with this number is traced.
    pub fn holds(&self, number: u32) -> bool {
        match self {
            Self::None => false,
            Self::All => true,
            Self::Numbers(numbers) => numbers.contains(&number),
        }
    }

    pub(super) fn any(&self) -> bool {
        *self != Self::None
    }
}

/// The trace of an agent: its preferred velocity and the reasons. Metres and seconds; places are in local coordinates, as
/// in [`World::relative_columns`].
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// The agent's own number.
    pub number: u32,
    /// Steering force divided by mass, m/s²; zero for an agent that does not steer.
    pub steering: Vec3,
    /// Preferred velocity, m/s.
    pub preferred: Vec3,
    /// The reasons: for an agent that steers, what its behaviour recorded; for other agents, the path and the
    /// neighbours.
    pub entries: Vec<TraceEntry>,
}

impl World {
    /// Records traces of the requested agents in every step from now on. Nothing else changes.
    ///
    /// ```
    /// use glam::Vec3;
    /// use throng::steer::{SteeringReason, Seek, Target};
    /// use throng::{Agent, TraceRequest, Group, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let seek = Seek { target: Target::Point(Vec3::X * 9.0) };
    /// let group = world.add_group(Group { steering: Some(seek.into()), ..Group::default() })?;
    /// world.add_agent(Agent { group, number: Some(7), ..Agent::default() })?;
    /// world.request_traces(TraceRequest::All);
    /// world.step();
    /// let trace = &world.relative_traces()[0];
    /// assert_eq!((trace.number, trace.entries[0].reason), (7, SteeringReason::Aim(Vec3::X * 9.0)));
    /// assert!(trace.steering.x > 0.0 && trace.preferred.x > 0.0);
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn request_traces(&mut self, request: TraceRequest) {
        self.state.traced = request;
        self.step.traces.clear();
    }

    /// Returns the traces of the last sub-step for the [requested](Self::request_traces) agents, by number.
    pub fn relative_traces(&self) -> &[Trace] {
        &self.step.traces
    }

    /// Records the traces of the sub-step that ends at `now`. `memory` holds what behaviours remembered before the
    /// sub-step.
    pub(super) fn account(&mut self, memory: Option<Memory>, seconds: f32, now: f64) {
        let Some(memory) = memory else { return };
        let after = std::mem::replace(&mut self.state.agents.memory, memory);
        let requested = (0..self.state.agents.len()).filter(|&row| self.state.traced.holds(self.state.agents.number[row]));
        let mut traces: Vec<Trace> = requested.map(|row| self.account_of(row, seconds, now)).collect();
        traces.sort_unstable_by_key(|trace| trace.number);
        (self.step.traces, self.state.agents.memory) = (traces, after);
    }

    fn account_of(&self, row: usize, seconds: f32, now: f64) -> Trace {
        let (said, entries) = self.steering_reasons(row, seconds, now);
        let mass = self.state.local_groups[self.state.agents.group[row].index()].vehicle.mass;
        Trace {
            number: self.state.agents.number[row],
            steering: said.map_or(Vec3::ZERO, |steering| steering.force / mass),
            preferred: self.step.preferred.at(row),
            entries: if self.state.steering(row).is_some() { entries } else { self.route_trace(row) },
        }
    }

    /// Returns the path and the neighbours of an agent that follows its journey.
    fn route_trace(&self, row: usize) -> Vec<TraceEntry> {
        let agents = &self.state.agents;
        let altitude = agents.altitude[row];
        let local = |corner: glam::DVec2| (corner - self.state.settings.origin).as_vec2().extend(altitude);
        let corners = agents.travel[row].route().into_iter().flat_map(|route| route.corners());
        let via = corners.map(|corner| SteeringReason::Via(local(corner)));
        let aim = self.state.steering_goal(row).map(SteeringReason::Aim);
        let distance = self.state.local_groups[agents.group[row].index()].neighbour_distance;
        let looks = SteeringReason::Looks { distance, angle: PI };
        let seen = self.neighbours(row).iter().map(|&other| SteeringReason::Regards(agents.number[other as usize]));
        let reasons = via.chain(aim).chain([looks]).chain(seen);
        reasons.map(|reason| TraceEntry { depth: 0, reason }).collect()
    }
}

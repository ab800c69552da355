//! Traces: for requested agents, the reasons of their motion in every step, as data that pictures can draw.

use super::Velocities;
use super::steering::Behaving;
use crate::steer::{SteeringReason, TraceEntry};
use crate::world::State;
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

    pub(crate) fn any(&self) -> bool {
        *self != Self::None
    }
}

/// The trace of an agent: its preferred velocity and the reasons. Metres and seconds; places are in local coordinates, as
/// in [`World::relative_columns`](crate::World::relative_columns).
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

impl Behaving<'_> {
    /// Returns the traces of all requested agents in the sub-step that ends at `now`, by number. The memory of behaviours
    /// must be as it was before the sub-step.
    pub fn traces(&self, preferred: &Velocities, seconds: f32, now: f64) -> Vec<Trace> {
        let State { agents, traced, .. } = self.state;
        let requested = (0..agents.len()).filter(|&row| traced.holds(agents.number[row]));
        let mut traces: Vec<Trace> = requested.map(|row| self.trace(row, preferred, seconds, now)).collect();
        traces.sort_unstable_by_key(|trace| trace.number);
        traces
    }

    fn trace(&self, row: usize, preferred: &Velocities, seconds: f32, now: f64) -> Trace {
        let (said, entries) = self.reasons(row, seconds, now);
        let mass = self.state.vehicle(row).map_or(1.0, |vehicle| vehicle.mass);
        Trace {
            number: self.state.agents.number[row],
            steering: said.map_or(Vec3::ZERO, |steering| steering.force / mass),
            preferred: preferred.at(row),
            entries: if self.state.behaviour(row).is_some() { entries } else { self.route_trace(row) },
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
        let seen = self.near.of(row).iter().map(|&other| SteeringReason::Regards(agents.number[other as usize]));
        let reasons = via.chain(aim).chain([looks]).chain(seen);
        reasons.map(|reason| TraceEntry { depth: 0, reason }).collect()
    }
}

//! The next sub-step of one agent, with its reasons, as data.

use super::{State, World};
use crate::agent::AgentId;
use crate::avoid::{
    AvoidanceNeighbour, AvoidanceReason, Cause, NearDisc, NearEdge, Visibility, Workspace, time_to_segment,
};
use crate::intend::TraceRequest;
use crate::moving::velocity;
use crate::navigate::Surroundings;
use crate::steer::TraceEntry;
use crate::step::Pipeline;
use glam::{DVec2, Vec2};

/// The motion of one agent in the next sub-step, and the reasons for it. Metres, seconds, radians; velocities along the
/// ground in m/s.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// The agent's own number.
    pub number: u32,
    /// Seconds since the start.
    pub time: f64,
    /// Seconds of the sub-step.
    pub seconds: f32,
    /// The local model and its parameters, in its debug format.
    pub model: String,
    /// Centre of the body, world coordinates.
    pub position: DVec2,
    /// Radius of the body.
    pub radius: f32,
    /// Direction of the body, counter-clockwise from +x.
    pub heading: f32,
    /// Maximum speed.
    pub max_speed: f32,
    /// Maximum acceleration; infinite for no limit.
    pub max_acceleration: f32,
    /// Present velocity.
    pub velocity: Vec2,
    /// Preferred velocity.
    pub preferred: Vec2,
    /// The velocity that the local model is to approach: the preferred velocity as far as the [relaxation
    /// time](crate::Group::relaxation_time) permits in this sub-step.
    pub relaxed: Vec2,
    /// The neighbours that it takes into account, nearest first.
    pub neighbours: Vec<ConsideredAgent>,
    /// Wall edges that it takes into account, nearest first.
    pub edges: Vec<NearEdge>,
    /// Solid discs that it takes into account, nearest first.
    pub discs: Vec<NearDisc>,
    /// The reasons for the preferred velocity of an agent that steers; empty for other agents.
    pub steering: Vec<TraceEntry>,
    /// The reasons for the chosen velocity, as the local model gives them. Their causes are indices into the lists
    /// above.
    pub reasons: Vec<AvoidanceReason>,
    /// The velocity that the local model chooses.
    pub chosen: Vec2,
    /// The chosen velocity within the limits of the body: acceleration, speed and turning.
    pub limited: Vec2,
    /// The limited velocity after the guard: the velocity that the agent will have.
    pub guarded: Vec2,
}

/// A neighbour that an agent takes into account.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConsideredAgent {
    /// Number of the neighbour.
    pub number: u32,
    /// Radius of its body.
    pub radius: f32,
    /// Its velocity.
    pub velocity: Vec2,
    /// What the local model knows of it. If the neighbour has the right of way, part of its preferred change of
    /// velocity is added to its velocity.
    pub seen: AvoidanceNeighbour,
}

/// Distance from the edge of a region within which a velocity counts as on the edge, m/s.
const ON_EDGE: f32 = 2e-3;

impl World {
    /// Returns the motion of an agent in the next sub-step, and the reasons for it; `None` if the agent does not exist.
    /// The world is unchanged: a clone makes the sub-step.
    ///
    /// ```
    /// use glam::{DVec3, Vec2};
    /// use throng::{Agent, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let id = world.add_agent(Agent::default())?;
    /// let velocity = Vec2::new(-1.0, 0.0);
    /// world.add_agent(Agent { position: DVec3::new(2.0, 0.0, 0.0), velocity, number: Some(7), ..Agent::default() })?;
    /// let why = world.explain(id).expect("it is there");
    /// assert_eq!((why.preferred, why.neighbours[0].number), (Vec2::ZERO, 7));
    /// assert!((why.collision(why.preferred).expect("it is in the way").0 - 1.733).abs() < 1e-3);
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn explain(&self, id: AgentId) -> Option<Explanation> {
        let number = self.state.agents.number[self.state.row(id)?];
        self.explain_all(&TraceRequest::Numbers(vec![number])).pop()
    }

    /// Returns the motions of several agents in the next sub-step, and the reasons, by number. The world is unchanged: a
    /// clone makes the sub-step, once for all agents.
    pub fn explain_all(&self, request: &TraceRequest) -> Vec<Explanation> {
        if !request.any() {
            return Vec::new();
        }
        let Self { mut state, mut step } = self.clone();
        let (memory, draws) = (state.agents.memory.clone(), state.tally.sub_steps);
        let of = step.decide(&mut state);
        // `decide` has changed the memory of behaviours and the counter of random draws
        (state.agents.memory, state.tally.sub_steps) = (memory, draws);
        let seen = step.perceive.result();
        let explain = |row: usize| {
            let (_, steering) = step.intend.steering(&state, seen).reasons(row, of.seconds, of.now);
            Explanation { steering, ..explanation(&state, &step, row, of.seconds) }
        };
        let requested = (0..state.agents.len()).filter(|&row| request.holds(state.agents.number[row]));
        let mut all: Vec<Explanation> = requested.map(explain).collect();
        all.sort_unstable_by_key(|why| why.number);
        all
    }
}

/// Returns the explanation of the motion that has been decided for a row, but not made yet.
fn explanation(state: &State, step: &Pipeline, row: usize, seconds: f32) -> Explanation {
    let (agents, model, seen) = (&state.agents, state.model(row), step.perceive.result());
    let around = Surroundings { state, near: seen.near, shown: step.navigate.shown() };
    let (preferred, chosen) = (step.intend.preferred(), step.avoid.chosen());
    let avoiding = step.avoid.avoiding(around, seen.grid, preferred);
    let (mut sight, mut workspace) = (Visibility::default(), Workspace::default());
    let view = avoiding.view(row, seconds, &mut sight);
    let unlimited = avoiding.chosen_velocity(row, &view, &mut workspace).truncate();
    let reasons = model.explain(&view, &mut workspace);
    let see = |(&other, &seen): (&u32, &AvoidanceNeighbour)| {
        let other = other as usize;
        let (number, radius, velocity) = (agents.number[other], agents.radius[other], agents.velocity[other]);
        ConsideredAgent { number, radius, velocity, seen }
    };
    let certain = step.guard.certain_place(state, chosen, &step.sleep, row, seconds);
    let wish = chosen.at(row);
    let way = wish * seconds + agents.rounding[row].0.extend(-0.0);
    Explanation {
        number: agents.number[row],
        time: state.time(),
        seconds,
        model: format!("{model:?}"),
        position: state.world_position(row),
        radius: agents.radius[row],
        heading: agents.heading[row],
        max_speed: agents.max_speed[row],
        max_acceleration: agents.max_acceleration[row],
        velocity: agents.velocity[row],
        preferred: preferred.ground[row],
        relaxed: view.preferred,
        steering: Vec::new(),
        reasons,
        chosen: unlimited,
        limited: chosen.ground[row],
        guarded: velocity(state.place_in_space(row), certain, (wish, way), seconds).0.truncate(),
        neighbours: sight.rows.iter().zip(&sight.neighbours).map(see).collect(),
        edges: sight.edges,
        discs: sight.discs,
    }
}

impl Explanation {
    /// Returns the time, seconds, and the cause of the first collision at `velocity` if all other agents keep their
    /// velocities; `None` if there is no collision. Bodies have the sizes that the local model uses.
    pub fn collision(&self, velocity: Vec2) -> Option<(f32, Cause)> {
        let neighbours = self
            .neighbours
            .iter()
            .enumerate()
            .map(|(i, other)| (other.seen.time_to_collision(velocity - other.velocity), Cause::Neighbour(i)));
        let edges = self
            .edges
            .iter()
            .enumerate()
            .map(|(i, near)| (time_to_segment(near.start, near.end, velocity, self.radius), Cause::Edge(i)));
        let discs = self.discs.iter().enumerate().map(|(i, near)| {
            let radii = near.disc.radius as f32 + self.radius;
            (near.outline.time_to_collision(near.offset, velocity, radii), Cause::Disc(i))
        });
        let first = neighbours.chain(edges).chain(discs).min_by(|a, b| a.0.total_cmp(&b.0));
        first.filter(|(time, _)| time.is_finite())
    }

    /// Returns the causes that limit a velocity, each once, with the violation, m/s: 0 for a velocity on the edge of
    /// what the cause permits, more for a velocity beyond it. The greatest violation comes first.
    pub fn held_by(&self, velocity: Vec2) -> Vec<(Cause, f32)> {
        let mut held: Vec<(Cause, f32)> = Vec::new();
        for reason in &self.reasons {
            let Some((cause, depth)) = reason.depth(velocity) else { continue };
            match held.iter_mut().find(|(other, _)| *other == cause) {
                Some((_, deepest)) => *deepest = deepest.max(depth),
                None if depth >= -ON_EDGE => held.push((cause, depth)),
                None => {}
            }
        }
        held.iter_mut().for_each(|(_, depth)| *depth = if *depth <= ON_EDGE { 0.0 } else { *depth });
        held.sort_by(|a, b| b.1.total_cmp(&a.1));
        held
    }
}

impl AvoidanceReason {
    /// Returns how deep a velocity lies in the region that the reason forbids, m/s, at most 0 outside, and the cause;
    /// `None` for a reason that forbids no region.
    pub fn depth(&self, velocity: Vec2) -> Option<(Cause, f32)> {
        match *self {
            Self::Permits(cause, line) => Some((cause, line.violation(velocity))),
            Self::Forbids(cause, region) => Some((cause, region.depth(velocity))),
            Self::Push(..) | Self::Candidate { .. } => None,
        }
    }
}

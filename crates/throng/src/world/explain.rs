//! Why somebody goes where they go: the next sub-step of one agent, as data.

use super::World;
use super::avoid::Sight;
use crate::agent::AgentId;
use crate::avoid::{Cause, NearDisc, NearEdge, Neighbour, Reason, Workspace, time_to_segment};
use crate::steer::Told;
use glam::{DVec2, Vec2};

/// What would happen to one agent in the next sub-step, and why. Metres, seconds, radians; velocities along the ground
/// in m/s.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// The agent's own number.
    pub number: u32,
    /// Seconds since the start.
    pub time: f64,
    /// Seconds of the sub-step.
    pub seconds: f32,
    /// The local model and its parameters, as it writes itself for debugging.
    pub model: String,
    /// Centre of the body, world coordinates.
    pub position: DVec2,
    /// Radius of the body.
    pub radius: f32,
    /// Direction of the body, counter-clockwise from +x.
    pub heading: f32,
    /// Speed it never exceeds.
    pub max_speed: f32,
    /// Greatest change of velocity a second; infinite for none.
    pub max_acceleration: f32,
    /// The velocity it has.
    pub velocity: Vec2,
    /// The velocity it would like.
    pub preferred: Vec2,
    /// What the model is asked for: how far it comes to that in this sub-step, by its
    /// [relaxation time](crate::Group::relaxation_time).
    pub relaxed: Vec2,
    /// Whom it takes into account, nearest first.
    pub neighbours: Vec<Seen>,
    /// Wall edges in view, nearest first.
    pub edges: Vec<NearEdge>,
    /// Solid discs in view, nearest first.
    pub discs: Vec<NearDisc>,
    /// What led to the preferred velocity, of who steers.
    pub steering: Vec<Told>,
    /// What led to the velocity that the model chooses, as the model says; causes are indices into the lists above.
    pub reasons: Vec<Reason>,
    /// The velocity that the model chooses.
    pub chosen: Vec2,
    /// What the body can do of it: its acceleration, speed and turning are limited.
    pub limited: Vec2,
    /// What the guard leaves of that: the velocity it will have.
    pub guarded: Vec2,
}

/// Somebody whom an agent takes into account.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// The other's own number.
    pub number: u32,
    /// Radius of its body.
    pub radius: f32,
    /// Its velocity.
    pub velocity: Vec2,
    /// What the model sees of it. Who has the right of way is seen with part of the velocity that it would like.
    pub seen: Neighbour,
}

/// How near to the edge of a region a velocity counts as on it, m/s.
const ON_EDGE: f32 = 2e-3;

impl World {
    /// What would happen to an agent in the next sub-step, and why; `None` if it is not there. The world stays as it is:
    /// a clone makes the sub-step.
    ///
    /// ```
    /// use glam::{DVec2, Vec2};
    /// use throng::{Agent, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let id = world.add_agent(Agent::default())?;
    /// let velocity = Vec2::new(-1.0, 0.0);
    /// world.add_agent(Agent { position: DVec2::new(2.0, 0.0), velocity, number: Some(7), ..Agent::default() })?;
    /// let why = world.explain(id).expect("it is there");
    /// assert_eq!((why.preferred, why.neighbours[0].number), (Vec2::ZERO, 7));
    /// assert!((why.collision(why.preferred).expect("it is in the way").0 - 1.733).abs() < 1e-3);
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn explain(&self, id: AgentId) -> Option<Explanation> {
        self.row(id)?;
        let mut world = self.clone();
        world.enter();
        let parts = world.sub_steps();
        let seconds = world.seconds(parts);
        let now = world.time() + f64::from(seconds);
        let (memory, draws) = (world.agents.memory.clone(), world.tally.sub_steps);
        world.step.rest.end();
        world.decide(true, seconds, now, |_| ());
        // deciding has changed what is remembered, and what would be drawn by chance
        (world.agents.memory, world.tally.sub_steps) = (memory, draws);
        let row = world.row(id)?;
        let (_, steering) = world.steering_reasons(row, seconds, now);
        Some(Explanation { steering, ..world.explanation(row, seconds) })
    }

    /// Explains what has been decided for a row, but not yet done.
    fn explanation(&self, row: usize, seconds: f32) -> Explanation {
        let (agents, model) = (&self.agents, self.model(row));
        let (mut sight, mut workspace) = (Sight::default(), Workspace::default());
        let view = self.view(row, seconds, &mut sight);
        let chosen = self.chosen_velocity(row, &view, &mut workspace).truncate();
        let reasons = model.explain(&view, &mut workspace);
        let see = |(&other, &seen): (&u32, &Neighbour)| {
            let other = other as usize;
            let (number, radius, velocity) = (agents.number[other], agents.radius[other], agents.velocity[other]);
            Seen { number, radius, velocity, seen }
        };
        Explanation {
            number: agents.number[row],
            time: self.time(),
            seconds,
            model: format!("{model:?}"),
            position: self.world_position(row),
            radius: agents.radius[row],
            heading: agents.heading[row],
            max_speed: agents.max_speed[row],
            max_acceleration: agents.max_acceleration[row],
            velocity: agents.velocity[row],
            preferred: self.step.preferred.ground[row],
            relaxed: view.preferred,
            steering: Vec::new(),
            reasons,
            chosen,
            limited: self.step.wishes.ground[row],
            guarded: self.certain_velocity(row, seconds).truncate(),
            neighbours: sight.rows.iter().zip(&sight.neighbours).map(see).collect(),
            edges: sight.edges,
            discs: sight.discs,
        }
    }
}

impl Explanation {
    /// When, in seconds, and with what the body first collides at `velocity` if everybody else keeps theirs; `None`: never.
    /// Bodies are as large as the model sees them.
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

    /// What a velocity is held by: the causes of the reasons that it is on the edge of, and of those that it violates, by
    /// how much, m/s. Each once, the most violated first.
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

impl Reason {
    /// How deep a velocity lies in what this forbids, m/s, at most 0 outside, and the cause; `None` for what forbids none.
    pub fn depth(&self, velocity: Vec2) -> Option<(Cause, f32)> {
        match *self {
            Self::Permits(cause, line) => Some((cause, line.violation(velocity))),
            Self::Forbids(cause, region) => Some((cause, region.depth(velocity))),
            Self::Push(..) | Self::Candidate { .. } => None,
        }
    }
}

//! Observations of all agents at one moment, of a world or of a trajectory file.

use glam::{DVec2, Vec2};
use throng::{Status, World};

/// All agents at one moment.
#[derive(Clone, Debug, Default)]
pub struct Observed {
    /// Number of steps.
    pub step: u64,
    /// Simulation time, seconds.
    pub time: f64,
    /// Length of a step, seconds.
    pub period: f64,
    /// World coordinates of the origin of positions.
    pub origin: DVec2,
    /// Number of agents that have arrived.
    pub arrived: usize,
    /// Share of agent-steps so far that the guard changed. NaN if unknown.
    pub guarded: f64,
    /// The agents present.
    pub beings: Vec<AgentMoment>,
}

/// An agent at one moment.
#[derive(Clone, Copy, Debug)]
pub struct AgentMoment {
    /// The number of the agent.
    pub number: u32,
    /// Position relative to [`Observed::origin`], metres.
    pub position: Vec2,
    /// Height above the ground, metres.
    pub altitude: f32,
    /// Radius of the bounding circle of the body, metres.
    pub radius: f32,
    /// Speed, m/s.
    pub speed: f32,
    /// Total turning of the heading since the agent entered, radians.
    pub turned: f64,
    /// Whether the agent is walking to its goal.
    pub walking: bool,
}

impl From<&World> for Observed {
    fn from(world: &World) -> Self {
        let (agents, settings, summary) = (world.relative_columns(), world.settings(), world.summary());
        let being = |row: usize| AgentMoment {
            number: agents.number[row],
            position: agents.position[row],
            altitude: agents.altitude[row],
            radius: agents.body(row).bounding_radius(),
            speed: agents.speed(row),
            turned: agents.trip(row).turned,
            walking: agents.status[row] == Status::Walking,
        };
        Self {
            step: world.steps(),
            time: world.time(),
            period: settings.step,
            origin: settings.origin,
            arrived: summary.arrived,
            guarded: summary.guard_share,
            beings: (0..agents.len()).map(being).collect(),
        }
    }
}

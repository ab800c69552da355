//! What figures are measured of: everybody at one moment, of a world or of a file.

use glam::{DVec2, Vec2};
use throng::{Status, World};

/// Everybody at one moment.
#[derive(Clone, Debug, Default)]
pub struct Observed {
    /// Steps made.
    pub step: u64,
    /// Seconds since the start.
    pub time: f64,
    /// Seconds of a step.
    pub period: f64,
    /// World coordinates of what places are relative to.
    pub origin: DVec2,
    /// How many have arrived so far.
    pub arrived: usize,
    /// Share of all moves so far that the guard changed; not a number where nobody knows.
    pub guarded: f64,
    /// Everybody who is there.
    pub beings: Vec<Being>,
}

/// Somebody at one moment.
#[derive(Clone, Copy, Debug)]
pub struct Being {
    /// Its number.
    pub number: u32,
    /// Where it is, relative to [`Observed::origin`], and how high, metres.
    pub position: Vec2,
    /// Metres above the ground.
    pub altitude: f32,
    /// Radius of the circle round its body, metres.
    pub radius: f32,
    /// m/s.
    pub speed: f32,
    /// How far its heading has turned since it came, radians.
    pub turned: f64,
    /// Whether it is on its way.
    pub walking: bool,
}

impl From<&World> for Observed {
    fn from(world: &World) -> Self {
        let (agents, settings, summary) = (world.agents(), world.settings(), world.summary());
        let being = |row: usize| Being {
            number: agents.number[row],
            position: agents.position[row],
            altitude: agents.altitude[row],
            radius: agents.body(row).bound(),
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

//! A crowd as arrays.

use super::Crowd;
use glam::{DVec2, Vec2};

/// What the agents of a crowd see, as arrays: for models that work on arrays, in other languages or other processes.
///
/// The arrays of agents have a value for each agent of the crowd, in its order. The neighbours of agent `k` are the rows
/// `near_start[k]` to `near_start[k + 1]` of the arrays of neighbours, nearest first; likewise for walls.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CrowdArrays {
    /// The time at the start of the step, seconds.
    pub time: f64,
    /// The duration of the sub-step, seconds.
    pub seconds: f32,
    /// The numbers of the agents.
    pub numbers: Vec<u32>,
    /// Their centres, world coordinates, metres.
    pub positions: Vec<DVec2>,
    /// Their velocities, m/s.
    pub velocities: Vec<Vec2>,
    /// The velocities they prefer, m/s.
    pub preferred: Vec<Vec2>,
    /// The radii of their bodies, metres.
    pub radii: Vec<f32>,
    /// Their top speeds, m/s.
    pub max_speeds: Vec<f32>,
    /// Their headings, radians counter-clockwise from +x.
    pub headings: Vec<f32>,
    /// The first neighbour of each agent, and the end.
    pub near_start: Vec<i64>,
    /// The numbers of the neighbours.
    pub near_numbers: Vec<u32>,
    /// Their centres, from that of the agent, metres.
    pub near_offsets: Vec<Vec2>,
    /// Their velocities, m/s.
    pub near_velocities: Vec<Vec2>,
    /// The sums of both radii, metres.
    pub near_radii: Vec<f32>,
    /// The agent's share of the avoidance, 0 to 1.
    pub near_shares: Vec<f32>,
    /// The first wall of each agent, and the end.
    pub wall_start: Vec<i64>,
    /// Both ends of the walls, from the centre of the agent, metres: x, y, x, y.
    pub walls: Vec<[f32; 4]>,
}

impl CrowdArrays {
    /// Gathers what the agents of a crowd see.
    #[must_use]
    pub fn of(crowd: &Crowd<'_>) -> Self {
        let mut arrays = Self {
            time: crowd.time(),
            seconds: crowd.seconds(),
            near_start: vec![0],
            wall_start: vec![0],
            ..Self::default()
        };
        for k in 0..crowd.len() {
            let input = crowd.input(k);
            arrays.numbers.push(crowd.number(k));
            arrays.positions.push(crowd.position(k).truncate());
            arrays.velocities.push(input.velocity);
            arrays.preferred.push(input.preferred);
            arrays.radii.push(input.radius);
            arrays.max_speeds.push(input.max_speed);
            arrays.headings.push(input.heading);
            arrays.near_numbers.extend(crowd.neighbour_numbers(k));
            for other in input.neighbours {
                arrays.near_offsets.push(other.offset);
                arrays.near_velocities.push(other.velocity);
                arrays.near_radii.push(other.radii);
                arrays.near_shares.push(other.share);
            }
            arrays.near_start.push(arrays.near_numbers.len() as i64);
            arrays.walls.extend(input.edges.iter().map(|edge| [edge.start.x, edge.start.y, edge.end.x, edge.end.y]));
            arrays.wall_start.push(arrays.walls.len() as i64);
        }
        arrays
    }
}

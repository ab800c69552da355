//! Recorded people as moments to draw: between their rows too.

use super::Cast;
use crate::pedestrian::{Border, Walk, velocities};
use crate::{Body, Frame};
use glam::{DVec2, Vec2};
use throng::Status;

/// Directions of motion that are slower say nothing, m/s.
const STANDS: f64 = 0.1;

/// How recorded people are seen.
#[derive(Debug)]
pub struct Seen<'a> {
    cast: &'a Cast,
    /// Velocities at every row of every walk, and which way each faces there.
    motion: Vec<Vec<[DVec2; 2]>>,
}

impl<'a> Seen<'a> {
    /// Of everybody. Who stands faces where they last went.
    pub fn new(cast: &'a Cast) -> Self {
        let motion = |walk: &Walk| {
            let velocities: Vec<DVec2> =
                velocities(walk, cast.rows, Border::OneSided).into_iter().map(Option::unwrap_or_default).collect();
            let moves = |velocity: &&DVec2| velocity.length() > STANDS;
            let mut facing = velocities.iter().find(moves).map_or(DVec2::X, |velocity| velocity.normalize());
            let row = |velocity: &DVec2| {
                if moves(&velocity) {
                    facing = velocity.normalize();
                }
                [*velocity, facing]
            };
            velocities.iter().map(row).collect()
        };
        Self { cast, motion: cast.people.walks.iter().map(motion).collect() }
    }

    /// Makes `frame` show who was there at a time; between two rows, on the straight way from one to the other.
    pub fn capture(&self, time: f64, frame: &mut Frame) {
        frame.bodies.clear();
        let walks = &self.cast.people.walks;
        frame.time = time;
        frame.total = walks.len();
        frame.arrived = walks.iter().filter(|walk| walk.times.last().is_some_and(|&last| last < time)).count();
        let there = walks.iter().enumerate().filter_map(|(index, walk)| {
            let (row, share) = walk.row_at(time)?;
            let here = self.body(index, row);
            Some(if share > 0.0 { here.between(&self.body(index, row + 1), share) } else { here })
        });
        frame.bodies.extend(there);
    }

    /// Somebody at one of their rows.
    fn body(&self, index: usize, row: usize) -> Body {
        let (walk, [velocity, facing]) = (&self.cast.people.walks[index], self.motion[index][row].map(|v| v.as_vec2()));
        Body {
            number: walk.number,
            group: 0,
            goal: None,
            position: walk.places[row],
            altitude: 0.0,
            velocity,
            climb: 0.0,
            heading: facing.y.atan2(facing.x),
            basis: None,
            radius: walk.radius as f32,
            core: Vec2::ZERO,
            preferred_speed: self.cast.walkers[index].speed as f32,
            status: Status::Walking,
        }
    }
}

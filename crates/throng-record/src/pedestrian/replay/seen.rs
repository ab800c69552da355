//! Recorded pedestrians as frames, also between rows.

use super::RecordedPeople;
use crate::pedestrian::{Border, Walk, velocities};
use crate::{Body, Frame};
use glam::{DVec2, Vec2};
use throng::Status;

/// Speed below which a direction of motion is unknown, m/s.
const STANDS: f64 = 0.1;

/// The states of recorded pedestrians.
#[derive(Debug)]
pub struct Seen<'a> {
    cast: &'a RecordedPeople,
    /// Velocity and facing direction at every row of every walk.
    motion: Vec<Vec<[DVec2; 2]>>,
}

impl<'a> Seen<'a> {
    /// Computes the states. A standing pedestrian faces its last direction of motion.
    pub fn new(cast: &'a RecordedPeople) -> Self {
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

    /// Sets `frame` to the pedestrians at a time, interpolated linearly between rows.
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

    /// Returns a pedestrian at a row.
    fn body(&self, index: usize, row: usize) -> Body {
        let (walk, [velocity, facing]) = (&self.cast.people.walks[index], self.motion[index][row].map(|v| v.as_vec2()));
        Body {
            number: walk.number,
            group: 0,
            goal: None,
            position: walk.places[row],
            altitude: 0.0,
            velocity,
            vertical_velocity: 0.0,
            heading: facing.y.atan2(facing.x),
            basis: None,
            radius: walk.radius as f32,
            core: Vec2::ZERO,
            preferred_speed: self.cast.walkers[index].speed as f32,
            status: Status::Walking,
        }
    }
}

//! The stored state of an agent: whole multiples of small units, and the prediction of the next state.

use crate::Body;
use crate::trajectories::Sample;
use glam::{DVec3, Vec3};
use std::f32::consts::TAU;
use throng::Status;

/// Steps per metre, of positions and radii.
const METRE: f64 = 1e4;
/// Steps per m/s.
const SPEED: f64 = 1e3;
/// Steps per turn.
const TURN: i64 = 8192;
/// Greatest absolute value of positions and velocities, in steps: all smaller values are exact in `f64`.
const FARTHEST: f64 = (1u64 << 50) as f64;

/// Number of values. Positions come last, because velocities predict them.
pub(super) const COLUMNS: usize = 10;

const GROUP: usize = 0;
const STATUS: usize = 1;
const RADIUS: usize = 2;
const HEADING: usize = 3;
/// Followed by the two other axes.
const VX: usize = 4;
/// Followed by the two other axes.
const X: usize = 7;

const STATES: [Status; 4] = [Status::Walking, Status::Waiting, Status::Arrived, Status::Stranded];

/// An agent in a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct RecState {
    pub(super) number: u32,
    pub(super) values: [i64; COLUMNS],
}

impl RecState {
    /// Rounds a body's state to steps.
    pub(super) fn of(body: &Body) -> Self {
        let status = STATES.iter().position(|&status| status == body.status).unwrap_or(0);
        let heading = (body.heading.rem_euclid(TAU) / TAU * TURN as f32).round() as i64;
        let [vx, vy] = body.velocity.to_array();
        let velocity = [vx, vy, body.vertical_velocity].map(|v| steps(f64::from(v), SPEED));
        let place = body.center().to_array().map(|x| steps(x, METRE));
        let mut values = [0; COLUMNS];
        values[GROUP] = i64::from(body.group);
        values[STATUS] = status as i64;
        values[RADIUS] = steps(f64::from(body.shape().clearance_radius()), METRE);
        values[HEADING] = turned(heading);
        values[VX..X].copy_from_slice(&velocity);
        values[X..].copy_from_slice(&place);
        Self { number: body.number, values }
    }

    /// Returns the sample of the state; `None` if the state is invalid.
    pub(super) fn spot(&self, time: f64) -> Option<Sample> {
        let value = |column: usize, unit: f64| self.values[column] as f64 / unit;
        let single = |column: usize, unit: f64| value(column, unit) as f32;
        Some(Sample {
            number: self.number,
            group: self.values[GROUP].try_into().ok()?,
            time,
            place: DVec3::from([0, 1, 2].map(|axis| value(X + axis, METRE))),
            velocity: Vec3::from([0, 1, 2].map(|axis| single(VX + axis, SPEED))),
            heading: single(HEADING, TURN as f64) * TAU,
            radius: single(RADIUS, METRE),
            status: *usize::try_from(self.values[STATUS]).ok().and_then(|at| STATES.get(at))?,
        })
    }

    /// Returns the difference of a column from its prediction. `before` is the state `seconds` ago. All columns but the
    /// position are predicted to be unchanged; the current velocity predicts the position.
    pub(super) fn news(&self, column: usize, before: &Self, seconds: f64) -> i64 {
        let news = self.values[column].wrapping_sub(self.expected(column, before, seconds));
        if column == HEADING { turned(news) } else { news }
    }

    /// Sets a column from [`news`](Self::news); the columns come in order.
    pub(super) fn learn(&mut self, column: usize, news: i64, before: &Self, seconds: f64) {
        let value = self.expected(column, before, seconds).wrapping_add(news);
        self.values[column] = if column == HEADING { turned(value) } else { value };
    }

    fn expected(&self, column: usize, before: &Self, seconds: f64) -> i64 {
        let moved = match column {
            X.. => (self.values[column - X + VX] as f64 * (seconds * (METRE / SPEED))).round() as i64,
            _ => 0,
        };
        before.values[column].wrapping_add(moved)
    }
}

/// Rounds to the nearest step; NaN becomes 0.
fn steps(value: f64, unit: f64) -> i64 {
    (value * unit).round().clamp(-FARTHEST, FARTHEST) as i64
}

/// Returns the same direction within half a turn to either side.
fn turned(heading: i64) -> i64 {
    (heading.wrapping_add(TURN / 2)).rem_euclid(TURN) - TURN / 2
}

//! Statistics of an agent's trip.

use super::{Columns, Status};
use serde::{Deserialize, Serialize};

/// Statistics of the trip of an agent so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TripStatistics {
    /// Time at which it entered, seconds.
    pub entered: f64,
    /// Time at which it first reached the end of its journey, seconds.
    pub arrived: Option<f64>,
    /// Distance walked or flown, metres.
    pub walked: f64,
    /// Sum of the turns of its heading, either way, radians.
    pub turned: f64,
    /// Sum of the turns of its direction of motion, either way, radians. Unlike the heading, the direction of motion is
    /// not smoothed.
    pub course_turned: f64,
    /// Seconds for which it has walked.
    pub on_way: f64,
    /// Length of the shortest path of the legs begun so far, metres.
    pub shortest: f64,
}

impl Columns {
    /// Returns the statistics of an agent's trip so far.
    pub fn trip(&self, row: usize) -> TripStatistics {
        let arrived = self.arrived[row];
        TripStatistics {
            entered: self.entered[row],
            arrived: arrived.is_finite().then_some(arrived),
            walked: self.walked[row],
            turned: self.turned[row],
            course_turned: self.course_turned[row],
            on_way: self.on_way[row],
            shortest: self.shortest[row],
        }
    }

    /// Adds seconds to the walking time of agents that walk.
    pub(crate) fn pass(&mut self, seconds: f32) {
        let seconds = f64::from(seconds);
        let walks = |status: &Status| *status == Status::Walking;
        // no early end, so that compilers use SIMD
        if self.status.iter().fold(true, |all, status| all & walks(status)) {
            self.on_way.values_mut().iter_mut().for_each(|time| *time += seconds);
            return;
        }
        for row in (0..self.len()).filter(|&row| walks(&self.status[row])) {
            self.on_way.set(row, self.on_way[row] + seconds);
        }
    }
}

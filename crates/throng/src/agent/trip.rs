//! What an agent has done so far.

use super::{Columns, Status};
use serde::{Deserialize, Serialize};

/// What one agent has done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Trip {
    /// Time it entered, seconds.
    pub entered: f64,
    /// Time it first came to the end of its journey.
    pub arrived: Option<f64>,
    /// Metres walked or flown.
    pub walked: f64,
    /// Radians its heading has turned, either way.
    pub turned: f64,
    /// Radians the direction of its motion has turned, either way: unlike the heading it is not smoothed.
    pub course_turned: f64,
    /// Seconds it has been on its way.
    pub on_way: f64,
    /// Metres of the shortest way of the legs begun so far.
    pub shortest: f64,
}

impl Columns {
    /// What an agent has done so far.
    pub fn trip(&self, row: usize) -> Trip {
        let arrived = self.arrived[row];
        Trip {
            entered: self.entered[row],
            arrived: arrived.is_finite().then_some(arrived),
            walked: self.walked[row],
            turned: self.turned[row],
            course_turned: self.course_turned[row],
            on_way: self.on_way[row],
            shortest: self.shortest[row],
        }
    }

    /// Notes that those on their way have been so for some seconds more.
    pub(crate) fn pass(&mut self, seconds: f32) {
        let seconds = f64::from(seconds);
        let walks = |status: &Status| *status == Status::Walking;
        if self.status.iter().all(walks) {
            self.on_way.values_mut().iter_mut().for_each(|time| *time += seconds);
            return;
        }
        for row in (0..self.len()).filter(|&row| walks(&self.status[row])) {
            self.on_way.set(row, self.on_way[row] + seconds);
        }
    }
}

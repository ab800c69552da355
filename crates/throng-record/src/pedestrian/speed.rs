//! Velocities and accelerations over an interval of frames.

use super::people::{People, Walk};
use glam::DVec2;

/// The velocity at the ends of a walk, where too few rows come before or after.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Border {
    /// No velocity.
    Exclude,
    /// The velocity over fewer rows, as many before as after.
    Adaptive,
    /// The velocity over the rows on the other side alone.
    OneSided,
}

/// Returns velocities at every row of a walk, m/s: the displacement from `n` rows before to `n` rows after, over the
/// time between them. `None` where rows are missing. Equals PedPy's `compute_individual_speed` with the frame step `n`.
///
/// ```
/// use throng_record::pedestrian::{Border, Walk, velocities};
/// let places = [0.0, 1.0, 3.0].map(|x| glam::DVec2::X * x).to_vec();
/// let walk = Walk { number: 1, radius: 0.2, times: vec![0.0, 1.0, 2.0], places };
/// let speeds = |border| velocities(&walk, 1, border).into_iter().map(|v| v.map(|v| v.x)).collect::<Vec<_>>();
/// assert_eq!(speeds(Border::Exclude), [None, Some(1.5), None]);
/// assert_eq!(speeds(Border::OneSided), [Some(1.0), Some(1.5), Some(2.0)]);
/// ```
pub fn velocities(walk: &Walk, n: usize, border: Border) -> Vec<Option<DVec2>> {
    let last = walk.times.len().saturating_sub(1);
    let between = |from: usize, to: usize| {
        let seconds = walk.times[to] - walk.times[from];
        (seconds > 0.0).then(|| (walk.places[to] - walk.places[from]) / seconds)
    };
    let velocity = |row: usize| {
        let (before, after) = (row >= n, row + n <= last);
        match border {
            _ if before && after => between(row - n, row + n),
            Border::Exclude => None,
            Border::Adaptive => {
                let room = row.min(last - row);
                between(row - room, row + room)
            }
            Border::OneSided if before => between(row - n, row),
            Border::OneSided if after => between(row, row + n),
            Border::OneSided => None,
        }
    };
    (0..walk.times.len()).map(velocity).collect()
}

/// Returns accelerations at every row, m/s²: the change from the velocity of the `n` rows before to that of the `n`
/// rows after, over half the time. `None` at the ends. Equals PedPy's `compute_individual_acceleration`, which assigns
/// them to the row `n` frames later.
pub fn accelerations(walk: &Walk, n: usize) -> Vec<Option<DVec2>> {
    let acceleration = |row: usize| {
        let (before, after) = (row.checked_sub(n)?, row + n);
        let (times, places) = (&walk.times, &walk.places);
        let (early, late) = (times[row] - times[before], times.get(after)? - times[row]);
        let change = (places[after] - places[row]) / late - (places[row] - places[before]) / early;
        Some(change / (0.5 * (early + late)))
    };
    (0..walk.times.len()).map(acceleration).collect()
}

/// The velocities of all pedestrians at every row, as [`velocities`] computes them.
#[derive(Clone, Debug, PartialEq)]
pub struct Velocities(Vec<Vec<Option<DVec2>>>);

impl Velocities {
    /// Computes the velocities of all walks.
    pub fn of(people: &People, n: usize, border: Border) -> Self {
        Self(people.walks.iter().map(|walk| velocities(walk, n, border)).collect())
    }

    /// Returns the velocity at a row.
    pub fn at(&self, here: super::PersonRow) -> Option<DVec2> {
        self.0[here.walk][here.row]
    }

    /// Returns the velocities by walk.
    pub fn walks(&self) -> &[Vec<Option<DVec2>>] {
        &self.0
    }
}

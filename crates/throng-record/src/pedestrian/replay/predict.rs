//! Displacement of predicted from recorded positions after a time.

use super::{RecordedPeople, Replay, ReplayScene, Replayed};
use crate::pedestrian::Walk;
use glam::DVec2;
use throng::{Error, World};

/// The predictors: the replay; constant velocity; straight lines to the pauses and the goal at preferred speed. The
/// last two ignore other pedestrians and walls: they are the baseline of a model.
pub const PREDICTORS: [&str; 3] = ["replay", "constant velocity", "straight to the goal"];

/// Rounding error of times, seconds.
const ROUNDING: f64 = 1e-9;

/// The error of a prediction of a pedestrian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictionSample {
    /// The pedestrian: index into the walks of the [`RecordedPeople`].
    pub walk: usize,
    /// Average displacement, by predictor: the mean distance to the recorded positions over all rows up to the horizon,
    /// metres.
    pub average: [f64; 3],
    /// Final displacement, by predictor: the distance at the horizon, metres.
    pub last: [f64; 3],
}

impl PredictionSample {
    /// Computes the errors for a pedestrian from a time on over `horizon` seconds; `None` if the recording of the
    /// pedestrian ends earlier.
    fn of(cast: &RecordedPeople, index: usize, from: f64, horizon: f64, replayed: &Replayed) -> Option<Self> {
        let (walk, walker) = (&cast.people.walks[index], &cast.walkers[index]);
        let end = from + horizon;
        let (start, there) = (walk.at(from)?, walk.at(end)?);
        let row = walk.times.partition_point(|&time| time <= from + ROUNDING) - 1;
        let velocity = cast.velocity(index, row);
        let predicted = |time: f64| {
            let since = time - from;
            let straight = walker.straight(start, from, time);
            [replayed.held(index, time).unwrap_or(start), start + velocity * since, straight]
        };
        let off = |time: f64, place: DVec2| predicted(time).map(|there| there.distance(place));
        let rows = walk.times.iter().zip(&walk.places).skip(row + 1).take_while(|(time, _)| **time <= end + ROUNDING);
        let (mut sum, mut count) = ([0.0; 3], 0u32);
        for (&time, &place) in rows {
            let off = off(time, place);
            sum = std::array::from_fn(|k| sum[k] + off[k]);
            count += 1;
        }
        let last = off(end, there);
        let average = if count > 0 { sum.map(|sum| sum / f64::from(count)) } else { last };
        Some(Self { walk: index, average, last })
    }
}

impl Replayed {
    /// Returns the position of a pedestrian; after it has left, the position where it left. `None` before it enters.
    fn held(&self, index: usize, time: f64) -> Option<DVec2> {
        let walk = &self.walks[index];
        walk.at(time).or_else(|| {
            let (&last, &place) = walk.times.last().zip(walk.places.last()).filter(|(last, _)| **last <= time)?;
            let Some((left, there)) = self.left[index] else { return Some(place) };
            // between its last row and its exit, it moves along a straight line
            let share = if left > last { ((time - last) / (left - last)).min(1.0) } else { 1.0 };
            Some(place.lerp(there, share))
        })
    }
}

/// Returns the errors of all replayed pedestrians `horizon` seconds after they entered; without a horizon, at their
/// last recorded times.
pub fn from_entry(cast: &RecordedPeople, replayed: &Replayed, horizon: Option<f64>) -> Vec<PredictionSample> {
    let sample = |(index, walk): (usize, &Walk)| {
        let from = *walk.times.first()?;
        let whole = cast.people.walks[index].times.last()? - from;
        PredictionSample::of(cast, index, from, horizon.unwrap_or(whole), replayed)
    };
    replayed.walks.iter().enumerate().filter_map(sample).collect()
}

/// Predicts the pedestrians that are present at a time, a row of the recording, for each of these horizons (seconds).
/// All of them start at their recorded positions with their velocities so far, and no others enter. Pedestrians without
/// a velocity so far are present, but are not predicted. `world` comes from [`ReplayScene::world`].
///
/// # Errors
/// The world rejects an agent.
pub fn predict(
    stage: &ReplayScene,
    cast: &RecordedPeople,
    world: World,
    start: f64,
    horizons: &[f64],
) -> Result<Vec<Vec<PredictionSample>>, Error> {
    let end = start + horizons.iter().copied().fold(0.0, f64::max);
    let moments = cast.people.moments.iter().map(|moment| moment.time);
    let mut times: Vec<f64> = moments.filter(|time| (start - ROUNDING..end).contains(time)).collect();
    times.extend(horizons.iter().map(|horizon| start + horizon));
    times.sort_by(f64::total_cmp);
    times.dedup();
    let mut replay = Replay::restart(stage, cast, world, start, times)?;
    while replay.time() < end - ROUNDING && !replay.is_over() {
        replay.step()?;
    }
    let replayed = replay.finish();
    let known = |(index, _): &(usize, &Walk)| {
        let row = cast.people.walks[*index].row_at(start);
        row.is_some_and(|(row, _)| cast.has_past(row))
    };
    let there = replayed.walks.iter().enumerate().filter(|(_, walk)| !walk.times.is_empty()).filter(known);
    let there: Vec<usize> = there.map(|(index, _)| index).collect();
    let of = |&horizon: &f64| {
        there.iter().filter_map(|&index| PredictionSample::of(cast, index, start, horizon, &replayed)).collect()
    };
    Ok(horizons.iter().map(of).collect())
}

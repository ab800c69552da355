//! How far people are from where they were recorded, so many seconds later.

use super::{Cast, Replay, Replayed, Stage};
use crate::pedestrian::Walk;
use glam::DVec2;
use throng::{Error, World};

/// What people are predicted by: the replay; going on with the velocity at the beginning; going straight to the goal at preferred speed,
/// by way of the pauses. The last two know nothing of others, nor of walls: what a model is worth is what it adds to them.
pub const PREDICTORS: [&str; 3] = ["replay", "constant velocity", "straight to the goal"];

/// Rounding of times, seconds.
const ROUNDING: f64 = 1e-9;

/// How far one prediction of one person is off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Whose: index into the walks of the [`Cast`].
    pub walk: usize,
    /// Average displacement, by predictor: the mean distance to where one was recorded over all rows up to the horizon, metres.
    pub average: [f64; 3],
    /// Final displacement, by predictor: the distance at the horizon, metres.
    pub last: [f64; 3],
}

impl Sample {
    /// Of somebody from a time on over `horizon` seconds; `None` where they were not recorded for so long.
    fn of(cast: &Cast, index: usize, from: f64, horizon: f64, replayed: &Replayed) -> Option<Self> {
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
    /// Where somebody is; who has left is where they did. `None` before they came.
    fn held(&self, index: usize, time: f64) -> Option<DVec2> {
        let walk = &self.walks[index];
        walk.at(time).or_else(|| {
            let (&last, &place) = walk.times.last().zip(walk.places.last()).filter(|(last, _)| **last <= time)?;
            let Some((left, there)) = self.left[index] else { return Some(place) };
            // from the last row they went on to where they left
            let share = if left > last { ((time - last) / (left - last)).min(1.0) } else { 1.0 };
            Some(place.lerp(there, share))
        })
    }
}

/// Everybody who was replayed, `horizon` seconds after they entered; `None` for the horizon: when they were recorded last.
pub fn from_entry(cast: &Cast, replayed: &Replayed, horizon: Option<f64>) -> Vec<Sample> {
    let sample = |(index, walk): (usize, &Walk)| {
        let from = *walk.times.first()?;
        let whole = cast.people.walks[index].times.last()? - from;
        Sample::of(cast, index, from, horizon.unwrap_or(whole), replayed)
    };
    replayed.walks.iter().enumerate().filter_map(sample).collect()
}

/// Predicts those who are there at a time, a row of the recording, for each of these horizons (seconds): everybody begins where they
/// were recorded then, with their velocity so far, and nobody else comes. Who has been there for too short a time to have a velocity is
/// there too, but not predicted. `world` is [`Stage::world`]'s.
///
/// # Errors
/// What the world refuses.
pub fn predict(
    stage: &Stage,
    cast: &Cast,
    world: World,
    start: f64,
    horizons: &[f64],
) -> Result<Vec<Vec<Sample>>, Error> {
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
    let of =
        |&horizon: &f64| there.iter().filter_map(|&index| Sample::of(cast, index, start, horizon, &replayed)).collect();
    Ok(horizons.iter().map(of).collect())
}

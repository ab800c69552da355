//! Checks whether the velocities that a file states agree with its positions and times.

use crate::formats::Reading;
use crate::pedestrian::median;
use crate::trajectories::Sample;
use std::collections::BTreeMap;

/// Greatest relative difference of stated velocities and displacements that agree.
const TOLERANCE: f64 = 0.2;
/// Speeds below this count as noise, m/s. `STEADY` is the greatest relative change of a velocity from row to row.
const SLOWEST: f32 = 0.2;
const STEADY: f32 = 0.2;
/// Least number of pairs of rows for a statement.
const FEWEST: usize = 10;

/// Returns the median ratio of the speed that a file states to that of the displacement, over all pairs of consecutive
/// rows of an agent that moves steadily. Returns `None` for too few pairs. `spots` are sorted by time. If times are
/// frame numbers, the ratio is the frame rate, frames per second.
pub(crate) fn stated_over_displaced(spots: &[Sample]) -> Option<f64> {
    let mut last: BTreeMap<u32, &Sample> = BTreeMap::new();
    let mut ratios = Vec::new();
    for spot in spots {
        let Some(before) = last.insert(spot.number, spot) else { continue };
        let [a, b] = [before.velocity, spot.velocity];
        let moves = a.length().min(b.length()) > SLOWEST && a.distance(b) < STEADY * a.length();
        let seconds = spot.time - before.time;
        if moves && seconds > 0.0 {
            ratios.push(f64::from((a + b).length()) * 0.5 * seconds / spot.place.distance(before.place));
        }
    }
    (ratios.len() >= FEWEST).then(|| median(ratios))
}

/// Returns a message if the velocities of a file contradict its positions and times by more than a fifth.
pub(crate) fn contradiction(spots: &[Sample], reading: &Reading) -> Option<String> {
    let ratio = stated_over_displaced(spots)?;
    if ratio.max(1.0 / ratio) <= 1.0 + TOLERANCE {
        return None;
    }
    let found = format!("the velocities that the file states are {ratio:.2} times those of its places and times");
    Some(match reading.rate {
        Some(rate) => format!("{found}: at --frame-rate {} they would agree, not at {rate}", rounded(rate * ratio)),
        None => format!("{found}: one of the three has another unit than is taken (--frame-rate, --unit)"),
    })
}

/// Rounds a rate to the nearest half frame per second.
pub(crate) fn rounded(rate: f64) -> f64 {
    0.5 * (2.0 * rate).round()
}

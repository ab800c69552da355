//! Whether the velocities that a file states agree with its places and times.

use crate::formats::Reading;
use crate::pedestrian::median;
use crate::tracks::Spot;
use std::collections::BTreeMap;

/// Stated velocities and displacements that differ by more than this part contradict each other.
const TOLERANCE: f64 = 0.2;
/// Slower motion is noise, and so are velocities that change by more than this part from row to row.
const SLOWEST: f32 = 0.2;
const STEADY: f32 = 0.2;
/// Fewer pairs of rows than this say nothing.
const FEWEST: usize = 10;

/// The median ratio of the speed that a file states to that of the displacement, over all pairs of consecutive rows of one agent that moves
/// steadily; `None` where there are too few of them. `spots` are by time. Where times count frames, it is frames a second.
pub(crate) fn stated_over_displaced(spots: &[Spot]) -> Option<f64> {
    let mut last: BTreeMap<u32, &Spot> = BTreeMap::new();
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

/// What to tell of a file whose velocities contradict its places and times by more than a fifth.
pub(crate) fn contradiction(spots: &[Spot], reading: &Reading) -> Option<String> {
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

/// A rate to the next half frame a second.
pub(crate) fn rounded(rate: f64) -> f64 {
    0.5 * (2.0 * rate).round()
}

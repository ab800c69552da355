//! The places and times at which recorded pedestrians stand voluntarily.

use super::recorded::STAYS;
use crate::pedestrian::{People, Walk};
use glam::DVec2;

/// Least duration of a pause, seconds.
const SHORTEST: f64 = 1.0;
/// Distance from its start at which a pause ends and the next one starts, metres.
const DRIFT: f64 = 0.5;
/// A standing pedestrian with at least [`CROWD`] others within [`CLOSE`] metres, in the mean over its pause, waits in a
/// jam. In the recordings of docs/replay.md this holds for 97 and 91 % of the standing time before bottlenecks, for 3 %
/// on the campus, and for none in the streets.
const CLOSE: f64 = 1.0;
const CROWD: f64 = 4.0;

/// A pause of a recorded pedestrian, which stands at a place until a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pause {
    /// The mean position of its rows, metres.
    pub place: DVec2,
    /// The time of its first row, seconds.
    pub from: f64,
    /// The time of its last row, seconds.
    pub until: f64,
}

/// Returns the pauses of every walk, in order. A pause is a run of rows slower than 0.2 m/s over at least 1 s. Standing
/// in a jam is not a pause. Standing up to the last row is not a pause either: that place is the goal. `speeds` are
/// those of every row of every walk, m/s.
pub(super) fn pauses(people: &People, speeds: &[Vec<f64>]) -> Vec<Vec<Pause>> {
    let crowd = crowding(people, speeds);
    let of_walk = |(walk, (speeds, crowd)): (&Walk, (&Vec<f64>, &Vec<u32>))| {
        let mut pauses = Vec::new();
        let mut begin = 0;
        while begin < speeds.len() {
            let near = |&row: &usize| speeds[row] < STAYS && walk.places[row].distance(walk.places[begin]) < DRIFT;
            let count = (begin..speeds.len()).take_while(near).count();
            let end = begin + count.max(1);
            let ends_before_the_last_row = end < speeds.len();
            let (from, until) = (walk.times[begin], walk.times[end - 1]);
            let mean = |sum: f64| sum / (end - begin) as f64;
            let others = mean(crowd[begin..end].iter().copied().map(f64::from).sum());
            if until - from >= SHORTEST && ends_before_the_last_row && others < CROWD {
                let sum: DVec2 = walk.places[begin..end].iter().sum();
                pauses.push(Pause { place: sum / (end - begin) as f64, from, until });
            }
            begin = end;
        }
        pauses
    };
    people.walks.iter().zip(speeds.iter().zip(&crowd)).map(of_walk).collect()
}

/// Returns the number of others within 1 m of every standing pedestrian, by walk and row; 0 at rows of walking.
fn crowding(people: &People, speeds: &[Vec<f64>]) -> Vec<Vec<u32>> {
    let mut counts: Vec<Vec<u32>> = speeds.iter().map(|rows| vec![0; rows.len()]).collect();
    for moment in &people.moments {
        let mut here: Vec<_> = moment.here.iter().map(|&here| (people.place(here), here)).collect();
        here.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.1.walk.cmp(&b.1.walk)));
        for (k, &(place, one)) in here.iter().enumerate() {
            let reached = here[k + 1..].iter().take_while(|(other, _)| other.x - place.x < CLOSE);
            for &(_, other) in reached.filter(|(other, _)| other.distance(place) < CLOSE) {
                for at in [one, other] {
                    counts[at.walk][at.row] += u32::from(speeds[at.walk][at.row] < STAYS);
                }
            }
        }
    }
    counts
}

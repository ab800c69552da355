//! Crossings of a line: N(t) and flows.

use super::people::{People, Walk};
use glam::DVec2;

/// A line at which pedestrians are counted, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The start.
    pub from: DVec2,
    /// The end.
    pub to: DVec2,
}

/// The first crossing of a pedestrian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The number of the pedestrian.
    pub number: u32,
    /// The first time beyond the line, seconds.
    pub time: f64,
    /// Whether the pedestrian crosses from right to left, seen along the line.
    pub leftwards: bool,
    /// The place of the crossing as a fraction of the line, 0 to 1.
    pub share: f64,
}

/// Distance within which a point is on the line, and not beyond it yet, metres.
const ON: f64 = 1e-5;
/// Fraction of the crossings at either end that is left out.
const TAIL: f64 = 0.05;

impl Line {
    /// Returns the length, metres.
    pub fn length(&self) -> f64 {
        self.from.distance(self.to)
    }

    /// Returns the first crossing of every pedestrian that crosses the line, by time, then by number. If a step ends on
    /// the line, the crossing is that of the next step. Equals PedPy's `compute_n_t`.
    pub fn crossings(&self, people: &People) -> Vec<Crossing> {
        let mut all: Vec<Crossing> = people.walks.iter().filter_map(|walk| self.first(walk)).collect();
        all.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.number.cmp(&b.number)));
        all
    }

    fn first(&self, walk: &Walk) -> Option<Crossing> {
        let crosses = |pair: &[DVec2]| self.meets(pair[0], pair[1]) && self.distance(pair[1]) >= ON;
        let step = walk.places.windows(2).position(crosses)?;
        let (start, line) = (walk.places[step], self.to - self.from);
        let way = walk.places[step + 1] - start;
        let turn = line.perp_dot(way);
        let leftwards = turn > 0.0;
        // for motion along the line, the crossing is at the end of the step
        let share = if turn == 0.0 {
            (start + way - self.from).dot(line) / line.length_squared()
        } else {
            (start - self.from).perp_dot(way) / turn
        };
        Some(Crossing { number: walk.number, time: walk.times[step + 1], leftwards, share: share.clamp(0.0, 1.0) })
    }

    /// Whether the line and the segment from `a` to `b` have a common point.
    fn meets(&self, a: DVec2, b: DVec2) -> bool {
        let side = |from: DVec2, to: DVec2, of: DVec2| (to - from).perp_dot(of - from);
        let (p, q) = (side(self.from, self.to, a), side(self.from, self.to, b));
        let (r, s) = (side(a, b, self.from), side(a, b, self.to));
        if p == 0.0 && q == 0.0 {
            // collinear
            return self.distance(a) == 0.0 || self.distance(b) == 0.0;
        }
        p * q <= 0.0 && r * s <= 0.0
    }

    fn distance(&self, place: DVec2) -> f64 {
        let along = self.to - self.from;
        let share = ((place - self.from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        place.distance(self.from + share * along)
    }
}

/// Returns the number of crossings up to and including a time: N(t).
pub fn count(crossings: &[Crossing], time: f64) -> usize {
    crossings.partition_point(|crossing| crossing.time <= time)
}

/// Returns the mean flow, pedestrians per second: the number of crossings after the first one over the time from the
/// first to the last; NaN for fewer than two crossings.
pub fn flow(crossings: &[Crossing]) -> f64 {
    match crossings {
        [first, .., last] => (crossings.len() - 1) as f64 / (last.time - first.time),
        _ => f64::NAN,
    }
}

/// Returns the mean flow without the first and the last twentieth of the crossings, at which the flow builds up and
/// fades.
pub fn steady_flow(crossings: &[Crossing]) -> f64 {
    let n = crossings.len();
    let first = (TAIL * n as f64) as usize;
    // `last` is exclusive
    let last = (((1.0 - TAIL) * n as f64) as usize).max(first);
    flow(crossings.get(first..last).unwrap_or_default())
}

/// Returns the flows in windows of `window` seconds from the first crossing on, pedestrians per second. The flow of a
/// window is its number of crossings over the time from the last crossing before it to its own last crossing. Equals
/// PedPy's `compute_flow`. `interval` is the time between frames, `end` the last time.
pub fn flows(crossings: &[Crossing], window: f64, interval: f64, end: f64) -> Vec<f64> {
    let Some(first) = crossings.first().filter(|_| window > 0.0) else { return Vec::new() };
    let (mut before, mut since) = (0, first.time);
    let mut out = Vec::new();
    // half a frame, so that no crossing is counted twice by rounding
    let half = 0.5 * interval;
    for k in 1.. {
        let time = first.time + f64::from(k) * window;
        if time >= end - half {
            break;
        }
        let crossed = count(crossings, time + half);
        if crossed > before {
            let last = crossings[crossed - 1].time + interval;
            out.push((crossed - before) as f64 / (last - since));
            (before, since) = (crossed, last);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walk(number: u32, places: &[(f64, f64)]) -> Walk {
        let times = (0..places.len()).map(|k| k as f64 * 0.5).collect();
        Walk { number, radius: 0.2, times, places: places.iter().map(|&at| at.into()).collect() }
    }

    #[test]
    fn a_crossing_is_complete_beyond_the_line() {
        let line = Line { from: DVec2::new(0.0, -1.0), to: DVec2::new(0.0, 1.0) };
        let walks = vec![
            walk(1, &[(-1.0, 0.0), (-0.1, 0.0), (0.1, 0.0), (-0.1, 0.0)]),
            walk(2, &[(1.0, 0.5), (0.0, 0.5), (0.0, 0.6), (-1.0, 0.6)]),
            walk(3, &[(-1.0, 1.1), (1.0, 1.1)]),
            walk(4, &[(-1.0, 1.0), (1.0, 1.0)]),
            walk(5, &[(0.0, -3.0), (0.0, 3.0)]),
            walk(6, &[(0.0, 0.0)]),
        ];
        let people = People { walks, moments: vec![] };
        let shares: Vec<f64> = line.crossings(&people).iter().map(|at| at.share).collect();
        assert_eq!(shares, [1.0, 0.5, 0.8]);
        let found: Vec<_> = line.crossings(&people).iter().map(|at| (at.number, at.time, at.leftwards)).collect();
        assert_eq!(found, [(4, 0.5, false), (1, 1.0, false), (2, 1.5, true)]);
    }

    #[test]
    fn flows_are_crossings_over_time() {
        let crossing = |k: u32| Crossing { number: k, time: 3.0 + 0.25 * f64::from(k), leftwards: true, share: 0.5 };
        let all: Vec<_> = (0..101).map(crossing).collect();
        assert_eq!((flow(&all), steady_flow(&all), count(&all, 4.0)), (4.0, 4.0, 5));
        assert!(flow(&all[..1]).is_nan() && steady_flow(&[]).is_nan() && flows(&[], 1.0, 0.1, 9.0).is_empty());
        let windows = flows(&all, 5.0, 0.25, 28.0);
        assert!(windows.len() == 4 && windows.iter().all(|flow| (flow - 4.0).abs() < 1e-9), "{windows:?}");
    }
}

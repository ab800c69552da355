//! A trajectory with a known future.

use super::{Ahead, Motion, Sample};
use crate::gait::FASTEST_TURN;
use crate::math::{direction, wrapped};
use glam::DVec2;

/// Duration of a cell of the time grid, s.
pub(crate) const CELL: f64 = 0.02;
/// Deviations of the smoothing filters, s.
const OF_POSITION: f64 = 0.12;
const OF_VELOCITY: f64 = 0.16;
const OF_HEADING: f64 = 0.14;
const OF_TURN: f64 = 0.05;
/// The weight of the heading of a person that stands, as a speed, m/s.
const STANDING: f64 = 0.1;
/// Duration over which the velocity at an end is measured, s. The path goes on with it beyond that end.
const OF_END: f64 = 0.3;

/// Numbers at the points of a uniform time grid, interpolated by cubics that have no kinks.
#[derive(Debug, Clone, Default)]
pub(crate) struct Column(pub Vec<f64>);

/// A place in a grid, and the weights of the four numbers about it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    index: usize,
    weights: [f64; 4],
}

impl Column {
    /// Returns the value at a place.
    pub fn at(&self, place: Place) -> f64 {
        let four = &self.0[place.index..place.index + 4];
        let w = place.weights;
        four[0] * w[0] + four[1] * w[1] + four[2] * w[2] + four[3] * w[3]
    }

    /// Returns the derivative per second, on the same grid.
    pub fn slope(&self) -> Column {
        let last = self.0.len() - 1;
        Column(
            (0..=last)
                .map(|i| {
                    let (before, after) = (i.saturating_sub(1), (i + 1).min(last));
                    (self.0[after] - self.0[before]) / ((after - before).max(1) as f64 * CELL)
                })
                .collect(),
        )
    }
}

/// Returns the mean of the values about each, with the weights of a normal distribution of this deviation (s).
pub(crate) fn gauss(values: &[f64], deviation: f64) -> Vec<f64> {
    let reach = libm::ceil(3.0 * deviation / CELL) as i64;
    let weights: Vec<f64> = (-reach..=reach)
        .map(|k| {
            let x = k as f64 * CELL / deviation;
            libm::exp(-0.5 * x * x)
        })
        .collect();
    let sum: f64 = weights.iter().sum();
    let last = values.len() as i64 - 1;
    (0..=last)
        .map(|i| {
            let total: f64 = weights.iter().zip(i - reach..).map(|(w, k)| w * values[k.clamp(0, last) as usize]).sum();
            total / sum
        })
        .collect()
}

/// Returns headings as a person turns: smoothed, and no faster than a person can turn. Headings of a person that hardly moves
/// have less weight: directions of motion that were measured say little there.
fn turned(headings: &[f64], speeds: impl Iterator<Item = f64>) -> Vec<f64> {
    let ways: Vec<DVec2> = headings.iter().zip(speeds).map(|(&at, speed)| direction(at) * (speed + STANDING)).collect();
    let [x, y] = [0, 1].map(|axis| gauss(&ways.iter().map(|way| way[axis]).collect::<Vec<_>>(), OF_HEADING));
    let mut last = headings[0];
    let smooth = x.iter().zip(&y).map(|(&x, &y)| {
        last += if x == 0.0 && y == 0.0 { 0.0 } else { wrapped(libm::atan2(y, x) - last) };
        last
    });
    let smooth: Vec<f64> = smooth.collect();
    // a turn that takes longer begins earlier and ends later
    let mut after = smooth.clone();
    (1..after.len()).for_each(|at| after[at] = near(after[at - 1], after[at]));
    let mut before = smooth;
    (1..before.len()).rev().for_each(|at| before[at - 1] = near(before[at], before[at - 1]));
    let both: Vec<f64> = after.iter().zip(&before).map(|(after, before)| (after + before) / 2.0).collect();
    gauss(&both, OF_TURN)
}

/// Returns the heading nearest to `to` that a person can have a cell of the grid after or before `from`.
fn near(from: f64, to: f64) -> f64 {
    from + (to - from).clamp(-FASTEST_TURN * CELL, FASTEST_TURN * CELL)
}

/// The smoothed motion along samples, on a grid that begins before the first and ends after the last.
#[derive(Debug, Clone)]
pub(crate) struct Recorded {
    /// Time of the first point of the grid, s.
    pub start: f64,
    x: Column,
    y: Column,
    velocity_x: Column,
    velocity_y: Column,
    heading: Column,
    turning: Column,
}

impl Recorded {
    /// Returns the motion along samples, of which there is at least one, in the order of time. The grid reaches
    /// `margin` (s) beyond both ends.
    pub fn new(samples: &[Sample], margin: f64) -> Recorded {
        let (first, last) = (samples[0], samples[samples.len() - 1]);
        let start = first.time - margin;
        let points = libm::ceil((last.time + margin - start) / CELL) as usize + 4;
        let inner = samples.iter().find(|s| s.time >= first.time + OF_END).unwrap_or(&last);
        let before = mean_velocity(first, *inner);
        let inner = samples.iter().rev().find(|s| s.time <= last.time - OF_END).unwrap_or(&first);
        let after = mean_velocity(*inner, last);
        // headings without jumps
        let mut headings = vec![first.heading];
        for pair in samples.windows(2) {
            headings.push(headings[headings.len() - 1] + wrapped(pair[1].heading - pair[0].heading));
        }
        let (mut x, mut y, mut heading) = (Vec::new(), Vec::new(), Vec::new());
        let mut next = 0;
        for point in 0..points {
            let time = start + point as f64 * CELL;
            while next < samples.len() && samples[next].time <= time {
                next += 1;
            }
            let (position, angle) = if next == 0 {
                (first.position + before * (time - first.time), headings[0])
            } else if next == samples.len() {
                (last.position + after * (time - last.time), headings[next - 1])
            } else {
                let (a, b) = (samples[next - 1], samples[next]);
                let share = (time - a.time) / (b.time - a.time);
                let angle = headings[next - 1] + (headings[next] - headings[next - 1]) * share;
                (a.position + (b.position - a.position) * share, angle)
            };
            x.push(position.x);
            y.push(position.y);
            heading.push(angle);
        }
        let [x, y] = [x, y].map(|values| Column(gauss(&values, OF_POSITION)));
        let [velocity_x, velocity_y] = [&x, &y].map(|values| Column(gauss(&values.slope().0, OF_VELOCITY)));
        let speeds = velocity_x.0.iter().zip(&velocity_y.0).map(|(&x, &y)| DVec2::new(x, y).length());
        let heading = Column(turned(&heading, speeds));
        let turning = heading.slope();
        Recorded { start, x, y, velocity_x, velocity_y, heading, turning }
    }

    /// Returns the number of points of the grid.
    pub fn points(&self) -> usize {
        self.x.0.len()
    }

    /// Returns the time of a point of the grid, s.
    pub fn time(&self, point: usize) -> f64 {
        self.start + point as f64 * CELL
    }

    /// Returns the place of a time in the grid. Times beyond the grid are those of its ends.
    pub fn place(&self, time: f64) -> Place {
        let cells = ((time - self.start) / CELL).clamp(1.0, (self.points() - 3) as f64);
        let index = cells as usize;
        let s = cells - index as f64;
        // the cubic B-spline: curvature is continuous
        let r = 1.0 - s;
        let weights = [
            r * r * r / 6.0,
            (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
            (4.0 - 6.0 * r * r + 3.0 * r * r * r) / 6.0,
            s * s * s / 6.0,
        ];
        Place { index: index - 1, weights }
    }

    /// Returns the motion at a place.
    pub fn motion(&self, place: Place) -> Motion {
        Motion {
            position: DVec2::new(self.x.at(place), self.y.at(place)),
            velocity: DVec2::new(self.velocity_x.at(place), self.velocity_y.at(place)),
            heading: self.heading.at(place),
            turning: self.turning.at(place),
        }
    }
}

impl Ahead for Recorded {
    fn at(&self, time: f64) -> Motion {
        self.motion(self.place(time))
    }
}

fn mean_velocity(a: Sample, b: Sample) -> DVec2 {
    if b.time > a.time { (b.position - a.position) / (b.time - a.time) } else { DVec2::ZERO }
}

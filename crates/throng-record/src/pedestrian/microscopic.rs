//! Microscopic figures of interacting pedestrians, sampled every 0.4 s, by which models are compared with recordings.
//!
//! All figures are computed from positions every 0.4 s, interpolated linearly between rows, and the velocities from
//! each to the next. Sway of steps and tracking noise therefore have the same weight in every recording and in every
//! replay of it.

use super::contact::time_to_collision;
use super::people::{People, Walk, median};
use glam::DVec2;
use throng::random::SplitMix64;

/// Interval of samples, seconds.
const EVERY: f64 = 0.4;
/// Speed below which a pedestrian stands, m/s.
const STANDS: f64 = 0.2;
/// Sum of the radii of two pedestrians, metres: the same for all, so that models with different bodies are comparable.
const RADII: f64 = 0.4;
/// Head-on pairs: the time before their least distance at which they are classified, seconds; the least speed of both,
/// m/s; the greatest cosine between their velocities; the greatest distance at which they would pass at constant
/// velocities, metres.
const BEFORE: f64 = 3.0;
const FASTEST_STROLL: f64 = 0.5;
const AGAINST: f64 = -0.7;
const MISS: f64 = 0.6;
/// Number of times to collision at which g is computed: every 0.4 s, from 0.4 to 4 s.
const BINS: usize = 10;
/// Times to collision of pairs that hardly interact, seconds: g is normalised to 1 there.
const FREE: std::ops::Range<f64> = 5.0..10.0;
/// Number of pairs of positions at different times, which represent pedestrians without interaction.
const SHUFFLED: u64 = 1 << 20;

/// Figures of pedestrians sampled every 0.4 s. Unknown values are NaN.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Microscopic {
    /// Fraction of samples slower than 0.2 m/s.
    pub standing: f64,
    /// Standard deviation of a pedestrian's speed while walking: the median over pedestrians, m/s.
    pub speed_deviation: f64,
    /// Absolute change of the direction of motion while walking: the median, degrees per second.
    pub turning: f64,
    /// Magnitude of accelerations: the median and the 99th percentile, m/s².
    pub acceleration: [f64; 2],
    /// Number of head-on pairs: 3 s before their least distance, both walked at 0.5 m/s or faster, in opposite
    /// directions (cosine below -0.7), and would have passed each other within 0.6 m.
    pub head_on: usize,
    /// Least distance of the centres of those pairs: the median and the 5th percentile, metres.
    pub passing: [f64; 2],
    /// g of the time to collision, every 0.4 s from 0.4 to 4 s (I. Karamouzas, B. Skinner, S. J. Guy, *Universal power
    /// law governing pedestrian interactions*, Physical Review Letters 113, 238701, 2014): the frequency of a time to
    /// collision over its frequency in pairs of pedestrians at different times, which do not interact; normalised to 1
    /// for times of 5 to 10 s together. Discs have a radius of 0.2 m.
    pub interaction: Vec<f64>,
}

/// A pedestrian sampled every 0.4 s.
struct SampledPerson {
    /// Index of the first sample since the start.
    first: usize,
    places: Vec<DVec2>,
    /// Velocities from each position to the next.
    velocities: Vec<DVec2>,
}

impl SampledPerson {
    /// Samples a walk; `None` for fewer than two samples.
    fn of(walk: &Walk, start: f64) -> Option<Self> {
        let first = ((walk.times.first()? - start) / EVERY - 1e-6).ceil().max(0.0);
        let places = (first as usize..).map_while(|k| walk.at(start + EVERY * k as f64));
        let places: Vec<DVec2> = places.collect();
        let velocities = places.windows(2).map(|pair| (pair[1] - pair[0]) / EVERY).collect();
        (places.len() > 1).then_some(Self { first: first as usize, places, velocities })
    }
}

impl Microscopic {
    /// Computes the figures. `start` is the first sampling time: that of the recording, for replays too, so that both
    /// are sampled alike.
    pub fn of(people: &People, start: f64) -> Self {
        let all: Vec<SampledPerson> = people.walks.iter().filter_map(|walk| SampledPerson::of(walk, start)).collect();
        let speeds = || all.iter().flat_map(|one| &one.velocities).map(|velocity| velocity.length());
        let (mut turning, mut accelerations, mut deviations) = (Vec::new(), Vec::new(), Vec::new());
        for one in &all {
            for pair in one.velocities.windows(2) {
                accelerations.push(pair[0].distance(pair[1]) / EVERY);
                if pair[0].length().min(pair[1].length()) >= STANDS {
                    turning.push(pair[0].angle_to(pair[1]).abs().to_degrees() / EVERY);
                }
            }
            let own = one.velocities.iter().map(|velocity| velocity.length()).filter(|speed| *speed >= STANDS);
            deviations.extend(deviation(&own.collect::<Vec<f64>>()));
        }
        let head_on = head_on(people);
        Self {
            standing: speeds().filter(|speed| *speed < STANDS).count() as f64 / speeds().count() as f64,
            speed_deviation: median(deviations),
            turning: median(turning),
            acceleration: [0.5, 0.99].map(|part| quantile(&mut accelerations, part)),
            head_on: head_on.len(),
            passing: [0.5, 0.05].map(|part| quantile(&mut head_on.clone(), part)),
            interaction: interaction(&all),
        }
    }

    /// Returns the root mean square difference of g to that of another recording, over the times at which both are
    /// known; NaN if there are none.
    pub fn interaction_off(&self, other: &Self) -> f64 {
        let squares = self.interaction.iter().zip(&other.interaction).map(|(a, b)| (a - b).powi(2));
        let (sum, count) =
            squares.filter(|square| square.is_finite()).fold((0.0, 0u32), |(sum, n), one| (sum + one, n + 1));
        (sum / f64::from(count)).sqrt()
    }
}

/// Returns the population standard deviation; `None` for fewer than three values.
fn deviation(values: &[f64]) -> Option<f64> {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
    (values.len() > 2).then(|| square.sqrt())
}

/// Returns a quantile, interpolated linearly; NaN for no values.
fn quantile(values: &mut [f64], part: f64) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let rank = part * values.len().saturating_sub(1) as f64;
    let at = |rank: f64| values.get(rank as usize).copied().unwrap_or(f64::NAN);
    at(rank.floor()) + rank.fract() * (at(rank.ceil()) - at(rank.floor()))
}

/// Returns the least distances of head-on pairs.
fn head_on(people: &People) -> Vec<f64> {
    let span = |walk: &Walk| walk.times.first().copied().zip(walk.times.last().copied());
    let mut walks: Vec<(f64, f64, &Walk)> =
        people.walks.iter().filter_map(|walk| span(walk).map(|(from, to)| (from, to, walk))).collect();
    walks.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.number.cmp(&b.2.number)));
    let mut found = Vec::new();
    for (k, &(_, end, a)) in walks.iter().enumerate() {
        for &(from, to, b) in walks[k + 1..].iter().take_while(|(from, ..)| *from < end) {
            found.extend(passing(a, b, from, to.min(end)));
        }
    }
    found
}

/// Returns the least distance of two pedestrians between two times, if they were a head-on pair.
fn passing(a: &Walk, b: &Walk, from: f64, to: f64) -> Option<f64> {
    let apart = |time: f64| Some(b.at(time)? - a.at(time)?);
    let times = (0..).map(|k| from + EVERY * f64::from(k)).take_while(|time| *time <= to);
    let offsets: Vec<(f64, DVec2)> = times.filter_map(|time| Some((time, apart(time)?))).collect();
    // the least distance within each interval of linear motion
    let nearest = offsets.windows(2).map(|pair| {
        let [(time, from), (_, to)] = [pair[0], pair[1]];
        let way = to - from;
        let share = (-from.dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        ((from + share * way).length(), time + share * EVERY)
    });
    let (least, time) = nearest.min_by(|one, other| one.0.total_cmp(&other.0))?;
    let before = time - BEFORE;
    let velocity = |walk: &Walk| Some((walk.at(before + EVERY)? - walk.at(before)?) / EVERY);
    let ([va, vb], offset) = ([velocity(a)?, velocity(b)?], apart(before)?);
    let strolls = va.length().min(vb.length()) >= FASTEST_STROLL;
    if !strolls || before < from || va.dot(vb) > AGAINST * va.length() * vb.length() {
        return None;
    }
    let closing = vb - va;
    let until = -offset.dot(closing) / closing.length_squared();
    (until > 0.0 && (offset + until * closing).length() < MISS).then_some(least)
}

/// Computes g of the time to collision.
fn interaction(all: &[SampledPerson]) -> Vec<f64> {
    let end = all.iter().map(|one| one.first + one.velocities.len()).max().unwrap_or(0);
    let mut moments: Vec<Vec<(usize, DVec2, DVec2)>> = vec![Vec::new(); end];
    for (index, one) in all.iter().enumerate() {
        for (k, (place, velocity)) in one.places.iter().zip(&one.velocities).enumerate() {
            moments[one.first + k].push((index, *place, *velocity));
        }
    }
    let (mut real, mut shuffled) = (Histogram::default(), Histogram::default());
    for here in &moments {
        for (k, one) in here.iter().enumerate() {
            here[k + 1..].iter().for_each(|other| real.add(one.1 - other.1, one.2 - other.2));
        }
    }
    let samples = moments.concat();
    let mut rng = SplitMix64(0);
    for _ in 0..if samples.len() > 1 { SHUFFLED } else { 0 } {
        let [one, other] = [(); 2].map(|()| samples[rng.below(samples.len())]);
        if one.0 != other.0 {
            shuffled.add(one.1 - other.1, one.2 - other.2);
        }
    }
    let share = |histogram: &Histogram, bin: usize| histogram.bins[bin] as f64 / histogram.free as f64;
    (0..BINS).map(|bin| share(&real, bin) / share(&shuffled, bin)).collect()
}

/// A histogram of times to collision.
#[derive(Default)]
struct Histogram {
    /// Counts around 0.4 s and its multiples.
    bins: [u64; BINS],
    /// Count of pairs that hardly interact.
    free: u64,
}

impl Histogram {
    /// Adds a pair, given its relative position and velocity.
    fn add(&mut self, apart: DVec2, velocity: DVec2) {
        let Some(time) = time_to_collision(apart, velocity, RADII) else { return };
        let bin = (time / EVERY - 0.5).floor();
        if (0.0..BINS as f64).contains(&bin) {
            self.bins[bin as usize] += 1;
        }
        self.free += u64::from(FREE.contains(&time));
    }
}

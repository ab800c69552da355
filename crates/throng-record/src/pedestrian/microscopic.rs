//! How people move next to each other, sampled every 0.4 s: figures by which a model of pedestrians is judged beside recorded people.
//!
//! All of them are taken of places every 0.4 s, straight between rows, and of the velocities from each to the next, so that the sway of
//! steps and the noise of tracking weigh the same in every recording and in every replay of it.

use super::contact::time_to_collision;
use super::people::{People, Walk, median};
use glam::DVec2;

/// Time from sample to sample, seconds.
const EVERY: f64 = 0.4;
/// A slower person stands, m/s.
const STANDS: f64 = 0.2;
/// Sum of the radii of two people, metres: the same for all, so that models with other bodies compare.
const RADII: f64 = 0.4;
/// Head-on pairs: so long before they are nearest, seconds; both at least so fast, m/s; cosine between their velocities at most; and the
/// distance at which they would miss each other if they went on, metres.
const BEFORE: f64 = 3.0;
const FASTEST_STROLL: f64 = 0.5;
const AGAINST: f64 = -0.7;
const MISS: f64 = 0.6;
/// How many times to collision g has: every 0.4 s, from 0.4 to 4 s.
const BINS: usize = 10;
/// Pairs that touch so much later hardly interact: there g is 1, seconds.
const FREE: std::ops::Range<f64> = 5.0..10.0;
/// How many pairs of places at different times stand for people that do not interact.
const SHUFFLED: u64 = 1 << 20;

/// Figures of people sampled every 0.4 s. What is not known is not a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Microscopic {
    /// Share of samples slower than 0.2 m/s.
    pub standing: f64,
    /// Standard deviation of a person's own speed while it walks: the median over people, m/s.
    pub speed_deviation: f64,
    /// Turning of directions of motion while walking: the median, degrees a second.
    pub turning: f64,
    /// Magnitude of accelerations: the median, and what 99 % are below, m/s².
    pub acceleration: [f64; 2],
    /// How many pairs were head on: 3 s before they were nearest, both walked at 0.5 m/s or faster, against each other (cosine below -0.7),
    /// and would have missed each other by less than 0.6 m.
    pub head_on: usize,
    /// Least distance of centres of those pairs: the median, and what 5 % are below, metres.
    pub passing: [f64; 2],
    /// g of the time to collision, by time, every 0.4 s from 0.4 to 4 s (I. Karamouzas, B. Skinner, S. J. Guy, *Universal power law
    /// governing pedestrian interactions*, Physical Review Letters 113, 238701, 2014): how often pairs have it, over how often pairs of
    /// people at different times have it, which do not interact; 1 for those of 5 to 10 s together. Discs of 0.2 m.
    pub interaction: Vec<f64>,
}

/// A person every 0.4 s.
struct Sampled {
    /// Samples since the start.
    first: usize,
    places: Vec<DVec2>,
    /// From each place to the next.
    velocities: Vec<DVec2>,
}

impl Sampled {
    /// `None` of a person that was there for less than two samples.
    fn of(walk: &Walk, start: f64) -> Option<Self> {
        let first = ((walk.times.first()? - start) / EVERY - 1e-6).ceil().max(0.0);
        let places = (first as usize..).map_while(|k| walk.at(start + EVERY * k as f64));
        let places: Vec<DVec2> = places.collect();
        let velocities = places.windows(2).map(|pair| (pair[1] - pair[0]) / EVERY).collect();
        (places.len() > 1).then_some(Self { first: first as usize, places, velocities })
    }
}

impl Microscopic {
    /// Of people, sampled from a time on, which is the first of the recording (also for replayed people, so that both are sampled alike).
    pub fn of(people: &People, start: f64) -> Self {
        let all: Vec<Sampled> = people.walks.iter().filter_map(|walk| Sampled::of(walk, start)).collect();
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

    /// Root of the mean square of the difference of g from that of others, over the times at which both are known; not a number for none.
    pub fn interaction_off(&self, other: &Self) -> f64 {
        let squares = self.interaction.iter().zip(&other.interaction).map(|(a, b)| (a - b).powi(2));
        let (sum, count) =
            squares.filter(|square| square.is_finite()).fold((0.0, 0u32), |(sum, n), one| (sum + one, n + 1));
        (sum / f64::from(count)).sqrt()
    }
}

/// Standard deviation of the whole; of three values at least.
fn deviation(values: &[f64]) -> Option<f64> {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
    (values.len() > 2).then(|| square.sqrt())
}

/// The value that this part of all is below, between two in proportion; not a number for none.
fn quantile(values: &mut [f64], part: f64) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let rank = part * values.len().saturating_sub(1) as f64;
    let at = |rank: f64| values.get(rank as usize).copied().unwrap_or(f64::NAN);
    at(rank.floor()) + rank.fract() * (at(rank.ceil()) - at(rank.floor()))
}

/// The least distances of pairs that were head on.
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

/// The least distance of two that are both there from a time to another, if they were head on.
fn passing(a: &Walk, b: &Walk, from: f64, to: f64) -> Option<f64> {
    let apart = |time: f64| Some(b.at(time)? - a.at(time)?);
    let times = (0..).map(|k| from + EVERY * f64::from(k)).take_while(|time| *time <= to);
    let offsets: Vec<(f64, DVec2)> = times.filter_map(|time| Some((time, apart(time)?))).collect();
    // the nearest on the straight way from each to the next
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

/// g of the time to collision.
fn interaction(all: &[Sampled]) -> Vec<f64> {
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
    let count = samples.len() as u64;
    for pair in 0..if count > 1 { SHUFFLED } else { 0 } {
        let [one, other] = [2 * pair, 2 * pair + 1].map(|draw| samples[(mixed(draw) % count) as usize]);
        if one.0 != other.0 {
            shuffled.add(one.1 - other.1, one.2 - other.2);
        }
    }
    let share = |histogram: &Histogram, bin: usize| histogram.bins[bin] as f64 / histogram.free as f64;
    (0..BINS).map(|bin| share(&real, bin) / share(&shuffled, bin)).collect()
}

/// How often times to collision come.
#[derive(Default)]
struct Histogram {
    /// Around 0.4 s and its multiples.
    bins: [u64; BINS],
    /// Those of pairs that hardly interact.
    free: u64,
}

impl Histogram {
    /// A pair: where one is and how it moves, seen from the other.
    fn add(&mut self, apart: DVec2, velocity: DVec2) {
        let Some(time) = time_to_collision(apart, velocity, RADII) else { return };
        let bin = (time / EVERY - 0.5).floor();
        if (0.0..BINS as f64).contains(&bin) {
            self.bins[bin as usize] += 1;
        }
        self.free += u64::from(FREE.contains(&time));
    }
}

/// The bits of a number, mixed (splitmix64): draws that are the same everywhere.
fn mixed(index: u64) -> u64 {
    let mut bits = index.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

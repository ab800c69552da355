//! What is measured of a world, now and then.

use std::collections::HashMap;
use throng::{Status, World};

/// A figure of a moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// How many have arrived.
    Arrived,
    /// The least distance of two centres over the sum of their radii, now.
    Separation,
    /// Mean speed of those on their way.
    Speed,
    /// Mean turning of the headings of those on their way.
    Turning,
    /// Share of all moves so far that the guard changed.
    Guarded,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Arrived, Self::Separation, Self::Speed, Self::Turning, Self::Guarded];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Arrived => "arrived",
            Self::Separation => "least separation",
            Self::Speed => "mean speed",
            Self::Turning => "heading change",
            Self::Guarded => "guard acted",
        }
    }

    /// Its unit; empty where it has none.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Arrived => "agents",
            Self::Separation => "",
            Self::Speed => "m/s",
            Self::Turning => "°/s",
            Self::Guarded => "%",
        }
    }

    /// What it is, in a line.
    pub fn says(self) -> &'static str {
        match self {
            Self::Arrived => "agents at the end of their journeys",
            Self::Separation => {
                "least distance of two centres over the sum of their radii, at this moment; 1: they touch"
            }
            Self::Speed => "mean speed of those on their way",
            Self::Turning => "mean turning of the headings of those on their way",
            Self::Guarded => "share of agent-steps so far that the guard changed by more than a hundredth",
        }
    }
}

/// The figures of a world now, where `before` is how far everybody had turned a step ago.
pub(super) fn measure(world: &World, before: &[(u32, f64)]) -> [f32; Quantity::ALL.len()] {
    let agents = world.agents();
    let walking = || (0..agents.len()).filter(|&row| agents.status[row] == Status::Walking);
    let before: HashMap<u32, f64> = before.iter().copied().collect();
    let turns = walking().filter_map(|row| Some(agents.trip(row).turned - before.get(&agents.number[row])?));
    let summary = world.summary();
    Quantity::ALL.map(|quantity| match quantity {
        Quantity::Arrived => summary.arrived as f32,
        Quantity::Separation => least_separation(world),
        Quantity::Speed => mean(walking().map(|row| f64::from(agents.speed(row)))),
        Quantity::Turning => mean(turns.clone()).to_degrees() / world.settings().step as f32,
        Quantity::Guarded => 100.0 * summary.guard_share as f32,
    })
}

/// How far everybody has turned so far, by number.
pub(super) fn turned(world: &World) -> impl Iterator<Item = (u32, f64)> {
    let agents = world.agents();
    (0..agents.len()).map(|row| (agents.number[row], agents.trip(row).turned))
}

/// Not a number for none.
fn mean(values: impl Iterator<Item = f64>) -> f32 {
    let (sum, count) = values.fold((0.0, 0_u32), |(sum, count), value| (sum + value, count + 1));
    (sum / f64::from(count)) as f32
}

/// The least distance of two centres over the sum of their radii: along x, only those are looked at who can be nearer than the
/// nearest so far.
fn least_separation(world: &World) -> f32 {
    let agents = world.agents();
    let center = |row: usize| agents.position[row].extend(agents.altitude[row]);
    let mut all: Vec<(glam::Vec3, f32)> =
        (0..agents.len()).map(|row| (center(row), agents.body(row).bound())).collect();
    all.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    let largest = all.iter().map(|&(_, radius)| radius).fold(0.0, f32::max);
    let mut least = f32::INFINITY;
    for (k, &(at, radius)) in all.iter().enumerate() {
        for &(other, wide) in &all[k + 1..] {
            if other.x - at.x > least * (radius + largest) {
                break;
            }
            least = least.min(at.distance(other) / (radius + wide));
        }
    }
    if least.is_finite() { least } else { f32::NAN }
}

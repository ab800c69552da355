//! Sampled quantities of a run.

use super::observed::Observed;
use std::collections::HashMap;

/// A quantity at one moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Number of agents that have arrived.
    Arrived,
    /// The least separation: distance of two centres over the sum of their radii.
    Separation,
    /// Mean speed of the walking agents.
    Speed,
    /// Mean turning rate of the headings of the walking agents.
    Turning,
    /// Share of agent-steps so far that the guard changed.
    Guarded,
}

impl Quantity {
    /// All quantities.
    pub const ALL: [Self; 5] = [Self::Arrived, Self::Separation, Self::Speed, Self::Turning, Self::Guarded];

    /// Returns the label.
    pub fn label(self) -> &'static str {
        match self {
            Self::Arrived => "arrived",
            Self::Separation => "least separation",
            Self::Speed => "mean speed",
            Self::Turning => "heading change",
            Self::Guarded => "guard acted",
        }
    }

    /// Returns the unit, empty for a dimensionless quantity.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Arrived => "agents",
            Self::Separation => "",
            Self::Speed => "m/s",
            Self::Turning => "°/s",
            Self::Guarded => "%",
        }
    }

    /// Returns the definition in one line.
    pub fn says(self) -> &'static str {
        match self {
            Self::Arrived => "agents at the end of their journeys",
            Self::Separation => {
                "least distance of two centres over the sum of their radii, at this moment; 1: they touch"
            }
            Self::Speed => "mean speed of the walking agents",
            Self::Turning => "mean turning rate of the headings of the walking agents",
            Self::Guarded => "share of agent-steps so far that the guard changed by more than a hundredth",
        }
    }
}

/// Measures all quantities. `before` holds the total turning of the agents one step ago.
pub(super) fn measure(now: &Observed, before: &[(u32, f64)]) -> [f32; Quantity::ALL.len()] {
    let walking = || now.beings.iter().filter(|being| being.walking);
    let before: HashMap<u32, f64> = before.iter().copied().collect();
    let turns = walking().filter_map(|being| Some(being.turned - before.get(&being.number)?));
    Quantity::ALL.map(|quantity| match quantity {
        Quantity::Arrived => now.arrived as f32,
        Quantity::Separation => least_separation(now),
        Quantity::Speed => mean(walking().map(|being| f64::from(being.speed))),
        Quantity::Turning => mean(turns.clone()).to_degrees() / now.period as f32,
        Quantity::Guarded => 100.0 * now.guarded as f32,
    })
}

/// Returns the total turning of each agent, by number.
pub(super) fn turned(now: &Observed) -> impl Iterator<Item = (u32, f64)> {
    now.beings.iter().map(|being| (being.number, being.turned))
}

/// Returns the mean, NaN for no values.
fn mean(values: impl Iterator<Item = f64>) -> f32 {
    let (sum, count) = values.fold((0.0, 0_u32), |(sum, count), value| (sum + value, count + 1));
    (sum / f64::from(count)) as f32
}

/// Returns the least separation. Sweeps along x and compares only pairs that can be closer than the least separation so
/// far.
fn least_separation(now: &Observed) -> f32 {
    let mut all: Vec<(glam::Vec3, f32)> =
        now.beings.iter().map(|being| (being.position.extend(being.altitude), being.radius)).collect();
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

//! What a standing person does: shifts of weight, glances, breath.

use crate::math::{floor, mix, smooth, uniform};
use std::f64::consts::TAU;

/// Returns to which side the weight of a standing person is, at a time: -1 (right) to 1 (left).
pub(crate) fn weight(seed: u64, time: f64) -> f64 {
    let period = 6.0 + 8.0 * uniform(seed, 1, 20);
    steps(seed, 21, time / period + uniform(seed, 2, 20), 0.9 / period)
}

/// Returns by how much a standing person looks to the left, at a time: -1 to 1.
pub(crate) fn glance(seed: u64, time: f64) -> f64 {
    let period = 3.0 + 5.0 * uniform(seed, 3, 20);
    let side = steps(seed, 22, time / period + uniform(seed, 4, 20), 0.5 / period);
    side * side * side
}

/// Returns how far the chest of a person is filled with breath, at a time: -1 to 1, every 4 s.
pub(crate) fn breath(seed: u64, time: f64) -> f64 {
    libm::sin(TAU * (0.25 * time + uniform(seed, 5, 20)))
}

/// Returns a number in -1..=1 that is constant within a slot, and goes to that of the next slot within a share of the
/// slot.
fn steps(seed: u64, purpose: u64, slots: f64, share: f64) -> f64 {
    let slot = floor(slots);
    let value = |slot: f64| 2.0 * uniform(seed, slot as i64 as u64, purpose) - 1.0;
    mix(value(slot - 1.0), value(slot), smooth((slots - slot) / share))
}

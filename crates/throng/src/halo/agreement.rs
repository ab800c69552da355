//! Values that all worlds of a division know.

use crate::perceive::Extent;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What single worlds tell all others, by a kind and a number.
pub(crate) type Told = BTreeMap<(u8, u32), Vec<u8>>;

/// Values that all worlds of a division [agree](super::Halo::agree) on. The merged values do not depend on the order in
/// which they are merged: they are least and greatest values, flags, sums of whole numbers, and what
/// single worlds tell by keys of their own.
///
/// ```
/// use throng::halo::Agreement;
/// let (mut one, other) = (Agreement::default(), Agreement::default());
/// one.merge(&other);
/// assert_eq!(one, other);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Agreement {
    /// Length of the longest sub-step in which no agent moves too far, seconds.
    pub(crate) longest_sub_step: f32,
    pub(crate) least_radius: f32,
    /// Greatest bounding radius, maximum speed, half length of a core, and range in which an agent reads others.
    pub(crate) bound: f32,
    pub(crate) speed: f32,
    pub(crate) core: f32,
    pub(crate) range: f32,
    /// Whether any world says so.
    pub(crate) any: bool,
    /// The same, for a list of questions.
    pub(crate) flags: Vec<bool>,
    /// Changes of counts, by index.
    pub(crate) counts: BTreeMap<u32, i64>,
    /// What single worlds tell all others, by a kind and a number. Worlds that tell of the same number tell the same.
    pub(crate) told: Told,
    /// The least and the greatest of a value that should be the same in all worlds.
    pub(crate) same: Option<(u64, u64)>,
    /// Lower and upper ends of a box.
    pub(crate) low: [f64; 2],
    pub(crate) high: [f64; 2],
    /// Box around agents in space, and their number.
    pub(crate) extent: Option<Extent>,
}

impl Default for Agreement {
    /// Values that change nothing when merged.
    fn default() -> Self {
        Self {
            longest_sub_step: f32::INFINITY,
            least_radius: f32::INFINITY,
            bound: 0.0,
            speed: 0.0,
            core: 0.0,
            range: 0.0,
            any: false,
            flags: Vec::new(),
            counts: BTreeMap::new(),
            told: BTreeMap::new(),
            same: None,
            low: [f64::INFINITY; 2],
            high: [f64::NEG_INFINITY; 2],
            extent: None,
        }
    }
}

impl Agreement {
    /// Merges the values of another world into these.
    pub fn merge(&mut self, other: &Self) {
        self.longest_sub_step = self.longest_sub_step.min(other.longest_sub_step);
        self.least_radius = self.least_radius.min(other.least_radius);
        self.bound = self.bound.max(other.bound);
        self.speed = self.speed.max(other.speed);
        self.core = self.core.max(other.core);
        self.range = self.range.max(other.range);
        self.any |= other.any;
        self.flags.resize(self.flags.len().max(other.flags.len()), false);
        self.flags.iter_mut().zip(&other.flags).for_each(|(own, other)| *own |= other);
        for (&index, change) in &other.counts {
            *self.counts.entry(index).or_default() += change;
        }
        self.told.extend(other.told.iter().map(|(&key, told)| (key, told.clone())));
        self.same = match (self.same, other.same) {
            (Some(own), Some(other)) => Some((own.0.min(other.0), own.1.max(other.1))),
            (own, other) => own.or(other),
        };
        for axis in 0..2 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
        self.extent = match (self.extent, other.extent) {
            (Some(own), Some(other)) => Some(own.merged(&other)),
            (own, other) => own.or(other),
        };
    }
}

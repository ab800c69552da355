//! Clamping that spreads to bodies of other worlds.

use super::BodyPose;
use super::certify::RowRange;
use crate::parallel::WORD;
use glam::Vec2;

/// The bodies elsewhere, while clamping spreads.
pub(crate) trait Spreading {
    /// Returns the number of rounds after which the rows of bodies elsewhere must be renewed.
    fn rounds(&self) -> usize;

    /// Whether clamping goes on. `spreads` tells whether the last of the rounds clamped an own row. If it goes on, the
    /// rows of bodies elsewhere are those of their worlds.
    fn go_on(&mut self, spreads: bool, clamping: &mut Clamping<'_>) -> bool;
}

/// There are no bodies elsewhere.
pub(super) struct Nowhere;

impl Spreading for Nowhere {
    fn rounds(&self) -> usize {
        usize::MAX
    }

    fn go_on(&mut self, _: bool, _: &mut Clamping<'_>) -> bool {
        false
    }
}

/// The targets of all rows, and which rows are clamped.
pub(crate) struct Clamping<'a> {
    pub(super) parts: &'a mut [RowRange],
    pub(super) targets: &'a mut [BodyPose],
}

impl Clamping<'_> {
    /// Returns the target of a row and whether it is clamped, as words.
    pub fn words(&self, row: usize) -> [u32; 5] {
        let BodyPose { position, altitude, heading } = self.targets[row];
        let clamped = self.parts[row / WORD].clamped >> (row % WORD) & 1;
        [position.x.to_bits(), position.y.to_bits(), altitude.to_bits(), heading.to_bits(), clamped as u32]
    }

    /// Sets the target of a row and whether it is clamped.
    pub fn set_words(&mut self, row: usize, [x, y, altitude, heading, clamped]: [u32; 5]) {
        let position = Vec2::new(f32::from_bits(x), f32::from_bits(y));
        let (altitude, heading) = (f32::from_bits(altitude), f32::from_bits(heading));
        self.targets[row] = BodyPose { position, altitude, heading };
        let part = &mut self.parts[row / WORD].clamped;
        *part = *part & !(1 << (row % WORD)) | u64::from(clamped) << (row % WORD);
    }
}

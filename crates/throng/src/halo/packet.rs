//! Packets of values.

use serde::{Deserialize, Serialize};

pub(super) const BROKEN: &str = "a packet of another world has arrived damaged";

/// Adds a value to a packet.
pub(crate) fn write(packet: &mut Vec<u8>, value: &impl Serialize) {
    // writing to memory cannot fail, and all types are serialisable
    *packet = postcard::to_extend(value, std::mem::take(packet)).unwrap_or_default();
}

/// Returns the values of a packet.
pub(crate) fn read<T: for<'de> Deserialize<'de>>(packet: &[u8]) -> impl Iterator<Item = T> {
    let mut left = packet;
    std::iter::from_fn(move || {
        if left.is_empty() {
            return None;
        }
        let (value, rest) = postcard::take_from_bytes(left).expect(BROKEN);
        left = rest;
        Some(value)
    })
}

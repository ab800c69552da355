//! Packets of values.

use serde::{Deserialize, Serialize};

pub(crate) const BROKEN: &str = "a packet of another world has arrived damaged";

/// Adds a value to a packet.
pub(crate) fn write(packet: &mut Vec<u8>, value: &impl Serialize) {
    // writing to memory cannot fail, and all types are serialisable
    *packet = postcard::to_extend(value, std::mem::take(packet)).unwrap_or_default();
}

/// Adds words to a packet.
pub(super) fn push_words<const N: usize>(packet: &mut Vec<u8>, words: [u32; N]) {
    packet.extend_from_slice(words.map(u32::to_le_bytes).as_flattened());
}

/// Returns the words of a packet, `N` at a time.
pub(super) fn words<const N: usize>(packet: &[u8]) -> impl Iterator<Item = [u32; N]> {
    let (words, rest) = packet.as_chunks::<4>().0.as_chunks::<N>();
    assert!(rest.is_empty() && packet.len().is_multiple_of(4), "{BROKEN}");
    words.iter().map(|words| words.map(u32::from_le_bytes))
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

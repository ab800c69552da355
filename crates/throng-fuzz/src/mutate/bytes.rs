//! Changes of bytes without regard to their format.

use crate::rng::Rng;

/// Texts that are written in place of numbers.
const TEXTS: [&str; 12] =
    ["nan", "inf", "-1", "0", "1e308", "-1e-320", "99999999999999999999", "", "\n", "\"", "4294967295", "0x1p3"];
/// Binary numbers that are written in place of numbers.
const WORDS: [u64; 10] = [
    0,
    1,
    u64::MAX,
    u64::MAX / 2,
    1 << 31,
    u32::MAX as u64,
    1 << 40,
    0x7ff0_0000_0000_0000,
    0x7ff8_0000_0000_0000,
    0x7f80_0000,
];

/// Changes a single place.
pub(super) fn change(bytes: &mut Vec<u8>, other: &[u8], rng: &mut Rng) {
    let (at, length) = (rng.below(bytes.len()), 1 + rng.below(40));
    let end = (at + length).min(bytes.len());
    match rng.below(9) {
        0 => bytes.truncate(at),
        1 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << rng.below(8)),
        2 => drop(bytes.splice(at..end, rng.pick(&TEXTS).bytes())),
        3 => drop(bytes.drain(at..end)),
        4 => {
            let again = bytes[at..end].to_vec();
            let to = rng.below(bytes.len());
            drop(bytes.splice(to..to, again));
        }
        5 => {
            let word = rng.pick(&WORDS);
            let size = [1, 2, 4, 8][rng.below(4)];
            let word = if rng.below(4) == 0 { word.to_be_bytes() } else { word.to_le_bytes() };
            bytes.iter_mut().skip(at).take(size).zip(word).for_each(|(byte, new)| *byte = new);
        }
        6 => bytes.iter_mut().skip(at).take(length).for_each(|byte| *byte = rng.next() as u8),
        7 => bytes
            .iter_mut()
            .skip(at)
            .take(1)
            .for_each(|byte| *byte = byte.wrapping_add(rng.below(9) as u8).wrapping_sub(4)),
        _ => {
            bytes.truncate(at);
            bytes.extend_from_slice(&other[rng.below(other.len())..]);
        }
    }
}

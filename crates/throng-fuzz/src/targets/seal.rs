//! Corrects checksums, so that readers do not stop at them.

/// Corrects the records of a `.rec`: after 8 bytes, each follows its length and its checksum.
pub(super) fn rec(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = word(bytes, at).map(|word| u32::from_le_bytes(word) as usize) {
        let Some(record) = at.checked_add(8).zip(at.checked_add(8 + length)).and_then(|(a, b)| bytes.get(a..b)) else {
            return;
        };
        let sum = crc32fast::hash(record).to_le_bytes();
        bytes[at + 4..at + 8].copy_from_slice(&sum);
        at += 8 + length;
    }
}

/// Corrects the chunks of a PNG: after 8 bytes, each consists of length, name, bytes, and the checksum of the last two.
pub(super) fn png(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = word(bytes, at).map(|word| u32::from_be_bytes(word) as usize) {
        let end = at + 8 + length;
        let Some(chunk) = bytes.get(at + 4..end) else { return };
        let sum = crc32fast::hash(chunk).to_be_bytes();
        let Some(place) = bytes.get_mut(end..end + 4) else { return };
        place.copy_from_slice(&sum);
        at = end + 4;
    }
}

fn word(bytes: &[u8], at: usize) -> Option<[u8; 4]> {
    bytes.get(at..at.checked_add(4)?)?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use crate::{Target, corpus};

    #[test]
    fn correct_checksums_do_not_change() {
        for name in ["rec", "picture"] {
            let target = Target::named(name).unwrap();
            for sample in corpus::of(target).unwrap().iter().filter(|sample| !sample.name.starts_with("found-")) {
                let mut sealed = sample.bytes.clone();
                (target.seal.unwrap())(&mut sealed);
                assert_eq!(sealed, sample.bytes, "{name}/{}", sample.name);
                let middle = sealed.len() / 2;
                sealed[middle] ^= 1;
                let broken = sealed.clone();
                (target.seal.unwrap())(&mut sealed);
                assert_ne!(sealed, broken, "{name}/{}", sample.name);
            }
        }
    }
}

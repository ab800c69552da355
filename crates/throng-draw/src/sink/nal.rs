//! The NAL units of an H.264 stream (ITU-T H.264, annex B and section 7.3.1).

/// The types of units: key frame, sequence parameter set, picture parameter set.
pub(super) const IDR: u8 = 5;
pub(super) const SPS: u8 = 7;
pub(super) const PPS: u8 = 8;

/// Returns the type of a unit; 0 for an empty unit.
pub(super) fn kind(unit: &[u8]) -> u8 {
    unit.first().map_or(0, |b| b & 0x1f)
}

/// Returns the units between the start codes of a byte stream.
pub(super) fn units(stream: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut rest = after_start(stream);
    std::iter::from_fn(move || {
        let here = rest?;
        let end = here.windows(3).position(|w| w == [0, 0, 1]).unwrap_or(here.len());
        rest = after_start(&here[end..]);
        // Zeros before a start code belong to the start code.
        let unit = &here[..end];
        let trailing = unit.iter().rev().take_while(|&&b| b == 0).count();
        Some(&unit[..unit.len() - trailing])
    })
    .filter(|unit| !unit.is_empty())
}

/// Returns the bytes after the first start code.
fn after_start(stream: &[u8]) -> Option<&[u8]> {
    stream.windows(3).position(|w| w == [0, 0, 1]).map(|at| &stream[at + 3..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_is_split_at_its_start_codes() {
        let stream = [0, 0, 0, 1, 0x67, 1, 2, 0, 0, 0, 1, 0x68, 3, 0, 0, 1, 0x65, 4, 0, 5];
        let units: Vec<_> = units(&stream).collect();
        assert_eq!(units, [&[0x67, 1, 2][..], &[0x68, 3], &[0x65, 4, 0, 5]]);
        assert_eq!(units.iter().map(|u| kind(u)).collect::<Vec<_>>(), [SPS, PPS, IDR]);
        assert_eq!(super::units(&[1, 2, 3]).count(), 0);
    }
}

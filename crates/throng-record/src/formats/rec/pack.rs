//! Packs whole numbers into as few bits as they need: runs of 64 numbers, each with the width of its largest.

/// Numbers per run.
const RUN: usize = 64;

/// Appends numbers. For each run: a byte with the bits per number, then the numbers, lowest bits first, padded to a
/// whole byte. Signs are folded (zigzag): 0, -1, 1, -2, 2.
pub(super) fn pack(values: &[i64], out: &mut Vec<u8>) {
    for run in values.chunks(RUN) {
        let width = 64 - run.iter().fold(0, |bits, &value| bits | turns(value)).leading_zeros();
        out.push(width as u8);
        let (mut bits, mut filled) = (0u128, 0);
        for &value in run {
            bits |= u128::from(turns(value)) << filled;
            filled += width;
            while filled >= 8 {
                out.push(bits as u8);
                bits >>= 8;
                filled -= 8;
            }
        }
        if filled > 0 {
            out.push(bits as u8);
        }
    }
}

fn turns(value: i64) -> u64 {
    ((value << 1) ^ (value >> 63)).cast_unsigned()
}

/// Bytes that are taken from the front; the methods return `None` if there are too few.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest<'a>(pub(super) &'a [u8]);

impl<'a> Rest<'a> {
    pub(super) fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    pub(super) fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    /// Unpacks `count` numbers that [`pack`] wrote.
    pub(super) fn unpack(&mut self, count: usize, out: &mut Vec<i64>) -> Option<()> {
        out.clear();
        // a run takes at least a byte
        if count.div_ceil(RUN) > self.0.len() {
            return None;
        }
        while out.len() < count {
            let run = RUN.min(count - out.len());
            let [width] = self.array()?;
            if width > 64 {
                return None;
            }
            let width = u32::from(width);
            let mut bytes = self.take((run * width as usize).div_ceil(8))?.iter();
            let mask = ((1u128 << width) - 1) as u64;
            let (mut bits, mut filled) = (0u128, 0);
            for _ in 0..run {
                while filled < width {
                    bits |= u128::from(*bytes.next()?) << filled;
                    filled += 8;
                }
                let turns = bits as u64 & mask;
                out.push((turns >> 1).cast_signed() ^ -(turns & 1).cast_signed());
                bits >>= width;
                filled -= width;
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn numbers_come_back(values: Vec<i64>, small in proptest::collection::vec(-3..4i64, 0..300)) {
            for values in [values, small] {
                let (mut bytes, mut back) = (Vec::new(), Vec::new());
                pack(&values, &mut bytes);
                let mut rest = Rest(&bytes);
                prop_assert!(rest.unpack(values.len(), &mut back).is_some() && rest.0.is_empty());
                prop_assert_eq!(&back, &values);
                for end in 0..bytes.len() {
                    prop_assert!(Rest(&bytes[..end]).unpack(values.len(), &mut back).is_none());
                }
            }
        }
    }

    #[test]
    fn what_does_not_change_takes_nearly_nothing() {
        let mut bytes = Vec::new();
        pack(&[0; 640], &mut bytes);
        assert_eq!(bytes, [0; 10]);
        bytes.clear();
        pack(&[0, -1, 1, -2, i64::MIN, i64::MAX], &mut bytes);
        assert_eq!((bytes[0], bytes.len()), (64, 49));
        assert!(Rest(&[0]).unpack(usize::MAX, &mut Vec::new()).is_none());
        assert!(Rest(&[65; 99]).unpack(2, &mut Vec::new()).is_none());
    }
}

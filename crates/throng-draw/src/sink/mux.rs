//! An MP4 file with one H.264 track: the boxes before the pictures (ISO/IEC 14496-12 and 14496-15).

/// Ticks per second; at all usual rates, a frame is a whole number of ticks.
pub(super) const TIMESCALE: u32 = 90_000;

/// The properties of the track.
#[derive(Clone, Debug, Default)]
pub(super) struct Mp4Track {
    pub width: u16,
    pub height: u16,
    /// The display time of a picture, ticks.
    pub ticks: u32,
    /// The size of each picture, bytes.
    pub sizes: Vec<u32>,
    /// The indices of key frames, from 0.
    pub keys: Vec<u32>,
    /// The sequence parameter set.
    pub sps: Vec<u8>,
    /// The picture parameter set.
    pub pps: Vec<u8>,
}

/// Returns everything before the pictures, including the index, so that playback can start before the file is complete.
/// The pictures follow without separators.
pub(super) fn head(track: &Mp4Track) -> Vec<u8> {
    let mut out = Boxes::default();
    out.boxed(b"ftyp", |out| {
        out.bytes(b"isom");
        out.u32(0x200);
        [b"isom", b"iso2", b"avc1", b"mp41"].into_iter().for_each(|brand| out.bytes(brand));
    });
    let payload: u64 = track.sizes.iter().map(|&s| u64::from(s)).sum();
    // The offsets of the pictures depend on the length of the index, which depends only on the width of the offsets.
    let before = out.0.len() as u64;
    let wide = payload > u64::from(u32::MAX) - (1 << 30);
    let length = moov(track, 0, wide).len() as u64;
    let start = before + length + if wide { 16 } else { 8 };
    out.bytes(&moov(track, start, wide));
    if wide {
        out.u32(1);
        out.bytes(b"mdat");
        out.u64(payload + 16);
    } else {
        out.u32(payload as u32 + 8);
        out.bytes(b"mdat");
    }
    out.0
}

fn moov(track: &Mp4Track, start: u64, wide: bool) -> Vec<u8> {
    let mut out = Boxes::default();
    let duration = track.sizes.len() as u64 * u64::from(track.ticks);
    out.boxed(b"moov", |out| {
        out.timed(b"mvhd", 0, duration, |out, duration| {
            out.u32(TIMESCALE);
            duration(out);
            out.u32(0x0001_0000); // rate 1
            out.u16(0x0100); // volume 1
            out.zeros(10);
            out.matrix();
            out.zeros(24);
            out.u32(2); // next track
        });
        out.boxed(b"trak", |out| {
            // Enabled, in the movie, in the preview.
            out.timed(b"tkhd", 7, duration, |out, duration| {
                out.u32(1); // track
                out.zeros(4);
                duration(out);
                out.zeros(16);
                out.matrix();
                out.u32(u32::from(track.width) << 16);
                out.u32(u32::from(track.height) << 16);
            });
            out.boxed(b"mdia", |out| {
                out.timed(b"mdhd", 0, duration, |out, duration| {
                    out.u32(TIMESCALE);
                    duration(out);
                    out.u16(0x55c4); // language undetermined
                    out.u16(0);
                });
                out.full(b"hdlr", 0, |out| {
                    out.zeros(4);
                    out.bytes(b"vide");
                    out.zeros(12);
                    out.bytes(b"throng\0");
                });
                out.boxed(b"minf", |out| {
                    out.full(b"vmhd", 1, |out| out.zeros(8));
                    out.boxed(b"dinf", |out| {
                        out.full(b"dref", 0, |out| {
                            out.u32(1);
                            out.full(b"url ", 1, |_| {}); // in this file
                        });
                    });
                    out.boxed(b"stbl", |out| samples(out, track, start, wide));
                });
            });
        });
    });
    out.0
}

fn samples(out: &mut Boxes, track: &Mp4Track, start: u64, wide: bool) {
    let count = track.sizes.len() as u32;
    out.full(b"stsd", 0, |out| {
        out.u32(1);
        out.boxed(b"avc1", |out| sample_entry(out, track));
    });
    out.full(b"stts", 0, |out| [1, count, track.ticks].into_iter().for_each(|n| out.u32(n)));
    out.full(b"stss", 0, |out| {
        out.u32(track.keys.len() as u32);
        track.keys.iter().for_each(|&key| out.u32(key + 1));
    });
    // Chunks of about one second, for players that read chunk by chunk.
    let each = (TIMESCALE / track.ticks.max(1)).max(1);
    let (whole, rest) = (count / each, count % each);
    out.full(b"stsc", 0, |out| {
        let runs = [(1, each, whole > 0), (whole + 1, rest, rest > 0)];
        out.u32(runs.iter().filter(|r| r.2).count() as u32);
        for (first, samples, _) in runs.into_iter().filter(|r| r.2) {
            [first, samples, 1].into_iter().for_each(|n| out.u32(n));
        }
    });
    out.full(b"stsz", 0, |out| {
        out.u32(0);
        out.u32(count);
        track.sizes.iter().for_each(|&size| out.u32(size));
    });
    out.full(if wide { b"co64" } else { b"stco" }, 0, |out| {
        out.u32(count.div_ceil(each));
        let mut at = start;
        for chunk in track.sizes.chunks(each as usize) {
            if wide {
                out.u64(at)
            } else {
                out.u32(at as u32)
            }
            at += chunk.iter().map(|&s| u64::from(s)).sum::<u64>();
        }
    });
}

fn sample_entry(out: &mut Boxes, track: &Mp4Track) {
    out.zeros(6);
    out.u16(1); // data reference
    out.zeros(16);
    out.u16(track.width);
    out.u16(track.height);
    out.u32(0x0048_0000); // 72 dots per inch, horizontally and vertically
    out.u32(0x0048_0000);
    out.zeros(4);
    out.u16(1); // one frame per sample
    out.zeros(32); // name of the compressor
    out.u16(24); // depth
    out.u16(0xffff);
    out.boxed(b"avcC", |out| {
        let profile = track.sps.get(1..4).unwrap_or(&[66, 0, 30]);
        out.bytes(&[1]);
        out.bytes(profile);
        out.bytes(&[0xff]); // lengths of four bytes
        out.bytes(&[0xe1]); // one set of sequence parameters
        out.u16(track.sps.len() as u16);
        out.bytes(&track.sps);
        out.bytes(&[1]);
        out.u16(track.pps.len() as u16);
        out.bytes(&track.pps);
    });
    out.boxed(b"colr", |out| {
        out.bytes(b"nclx");
        // BT.709 primaries, transfer and matrix, studio range.
        [1, 1, 1].into_iter().for_each(|n| out.u16(n));
        out.bytes(&[0]);
    });
    out.boxed(b"pasp", |out| [1, 1].into_iter().for_each(|n| out.u32(n)));
}

/// A buffer of boxes.
#[derive(Debug, Default)]
struct Boxes(Vec<u8>);

impl Boxes {
    fn bytes(&mut self, bytes: &[u8]) {
        self.0.extend_from_slice(bytes);
    }

    fn u16(&mut self, n: u16) {
        self.bytes(&n.to_be_bytes());
    }

    fn u32(&mut self, n: u32) {
        self.bytes(&n.to_be_bytes());
    }

    fn u64(&mut self, n: u64) {
        self.bytes(&n.to_be_bytes());
    }

    fn zeros(&mut self, n: usize) {
        self.0.resize(self.0.len() + n, 0);
    }

    /// Writes the identity matrix.
    fn matrix(&mut self) {
        [0x10000, 0, 0, 0, 0x10000, 0, 0, 0, 0x4000_0000].into_iter().for_each(|n| self.u32(n));
    }

    /// Writes a box: its length, its name and its content.
    fn boxed(&mut self, name: &[u8; 4], content: impl FnOnce(&mut Self)) {
        let at = self.0.len();
        self.u32(0);
        self.bytes(name);
        content(self);
        let length = (self.0.len() - at) as u32;
        self.0[at..at + 4].copy_from_slice(&length.to_be_bytes());
    }

    /// Writes a box with version 0 and flags.
    fn full(&mut self, name: &[u8; 4], flags: u32, content: impl FnOnce(&mut Self)) {
        self.boxed(name, |out| {
            out.u32(flags);
            content(out);
        });
    }

    /// Writes a box with a duration: version 0, or version 1 if the duration does not fit into 32 bits. Creation times
    /// are left at 0, so that the same film gives the same file.
    fn timed(&mut self, name: &[u8; 4], flags: u32, ticks: u64, content: impl FnOnce(&mut Self, &dyn Fn(&mut Self))) {
        let long = ticks > u64::from(u32::MAX);
        self.full(name, flags | u32::from(long) << 24, |out| {
            out.zeros(if long { 16 } else { 8 });
            content(out, &|out| if long { out.u64(ticks) } else { out.u32(ticks as u32) });
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(frames: u32, size: u32) -> Mp4Track {
        Mp4Track {
            width: 640,
            height: 480,
            ticks: 3600,
            sizes: vec![size; frames as usize],
            keys: vec![0],
            sps: vec![0x67, 66, 0, 30],
            pps: vec![0x68],
        }
    }

    fn find(bytes: &[u8], name: &[u8]) -> Option<usize> {
        bytes.windows(4).position(|w| w == name)
    }

    fn u32_at(bytes: &[u8], at: usize) -> u32 {
        u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap())
    }

    #[test]
    fn the_first_chunk_is_where_the_head_ends() {
        let head = head(&track(60, 100));
        let stco = find(&head, b"stco").unwrap();
        assert_eq!(u32_at(&head, stco + 8), 3, "60 pictures at 25 per second are three chunks");
        assert_eq!(u32_at(&head, stco + 12) as usize, head.len());
        assert_eq!(u32_at(&head, stco + 16) as usize, head.len() + 2500);
    }

    #[test]
    fn a_film_of_many_gigabytes_has_wide_offsets() {
        let head = head(&track(3, 2_000_000_000));
        assert!(find(&head, b"stco").is_none());
        let co64 = find(&head, b"co64").unwrap();
        assert_eq!(u32_at(&head, co64 + 16) as usize, head.len());
        let mdat = find(&head, b"mdat").unwrap();
        assert_eq!(u64::from_be_bytes(head[mdat + 4..mdat + 12].try_into().unwrap()), 6_000_000_016);
    }

    #[test]
    fn a_film_of_many_hours_has_a_wide_duration() {
        let head = head(&Mp4Track { ticks: 90_000, ..track(50_000, 1) });
        let mvhd = find(&head, b"mvhd").unwrap();
        assert_eq!(head[mvhd + 4], 1);
        assert_eq!(u64::from_be_bytes(head[mvhd + 28..mvhd + 36].try_into().unwrap()), 4_500_000_000);
    }
}

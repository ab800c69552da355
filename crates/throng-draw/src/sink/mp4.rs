//! Video as an MP4 file: H.264 by openh264.

use super::mux::{TIMESCALE, Track, head};
use super::yuv::Yuv;
use super::{FrameSink, SameSize, check_rate, nal};
use crate::{Error, Image};
use openh264::OpenH264API;
use openh264::encoder::{
    BitRate, Complexity, Encoder, EncoderConfig, FrameRate, IntraFramePeriod, QpRange, RateControlMode, UsageType,
    VuiConfig,
};
use openh264::formats::YUVSlices;
use std::fs::File;
use std::io::{Read, Seek, Write};
use std::path::Path;
use throng_record::{Output, OutputError};

/// How coarse every picture is (H.264 quantisation parameter, 0 to 51): thin type and small discs stay sharp. The
/// encoder holds to it in its buffer-based mode only; with rate control off it takes 26, whatever it is told.
const QUALITY: QpRange = QpRange::new(22, 22);
/// Seconds from one picture that can be decoded by itself to the next: how finely a player can seek.
const KEY_SECONDS: f64 = 4.0;

/// Writes an MP4 file with H.264 video, ready to be played while it loads.
///
/// Pictures go to an unnamed file next to the result as they are encoded, and behind the finished index at the end;
/// in memory are four bytes a picture. At most 3840 by 2160 pixels; odd sizes grow by a pixel.
pub struct Mp4Sink {
    output: Output,
    rate: f64,
    /// Made with the first picture, whose size it needs.
    encoder: Option<Encoder>,
    yuv: Yuv,
    size: SameSize,
    track: Track,
    /// The encoded pictures.
    spool: std::io::BufWriter<File>,
    stream: Vec<u8>,
    sample: Vec<u8>,
}

impl Mp4Sink {
    /// Begins `path`, at `rate` pictures a second.
    ///
    /// # Errors
    /// The folder is missing or cannot be written to, or the rate is no rate.
    pub fn create(path: impl AsRef<Path>, rate: f64) -> Result<Self, Error> {
        check_rate(rate)?;
        let path = path.as_ref();
        let output = Output::create(path)?;
        let folder = output.temporary_path().parent().unwrap_or(Path::new(".")).to_path_buf();
        let spool = tempfile::tempfile_in(folder).map_err(|source| output.error(source))?;
        let ticks = (f64::from(TIMESCALE) / rate).round().max(1.0) as u32;
        Ok(Self {
            size: SameSize::new(path),
            output,
            rate,
            encoder: None,
            yuv: Yuv::default(),
            track: Track { ticks, ..Track::default() },
            spool: std::io::BufWriter::with_capacity(1 << 16, spool),
            stream: Vec::new(),
            sample: Vec::new(),
        })
    }

    /// Turns the encoder's stream into a sample: parameters go to the index, units get their length in front.
    fn sort_units(&mut self) {
        self.sample.clear();
        for unit in nal::units(&self.stream) {
            match nal::kind(unit) {
                nal::SPS => self.track.sps = unit.to_vec(),
                nal::PPS => self.track.pps = unit.to_vec(),
                kind => {
                    if kind == nal::IDR {
                        let index = self.track.sizes.len() as u32;
                        if self.track.keys.last() != Some(&index) {
                            self.track.keys.push(index);
                        }
                    }
                    self.sample.extend_from_slice(&(unit.len() as u32).to_be_bytes());
                    self.sample.extend_from_slice(unit);
                }
            }
        }
    }
}

/// An encoder for pictures of so many pixels.
fn encoder(pixels: usize, rate: f64) -> Result<Encoder, openh264::Error> {
    // Quality is set by the quantisation; the bit rate only chooses the level that the stream asks of a player.
    let bits = (pixels as f64 * rate * 0.25).clamp(2e5, 5e7) as u32;
    let config = EncoderConfig::new()
        .skip_frames(false)
        .max_frame_rate(FrameRate::from_hz(rate as f32))
        .rate_control_mode(RateControlMode::Bufferbased)
        .qp(QUALITY)
        .bitrate(BitRate::from_bps(bits))
        .adaptive_quantization(false)
        .background_detection(false)
        .scene_change_detect(false)
        .usage_type(UsageType::CameraVideoRealTime)
        .complexity(Complexity::Low)
        .intra_frame_period(IntraFramePeriod::from_num_frames((rate * KEY_SECONDS).round().max(1.0) as u32))
        // One thread: the same pictures are the same file on any machine.
        .num_threads(1)
        .vui(VuiConfig::bt709());
    Encoder::with_api_config(OpenH264API::from_source(), config)
}

impl FrameSink for Mp4Sink {
    fn push(&mut self, image: &Image) -> Result<(), Error> {
        let (width, height) = (image.width(), image.height());
        if self.size.check(image)? && (width.max(height) > 3840 || width.min(height) > 2160) {
            return Err(Error::Size { width, height, limit: "at most 3840 by 2160 for .mp4" });
        }
        self.yuv.read(image);
        let (w, h) = (self.yuv.width, self.yuv.height);
        (self.track.width, self.track.height) = (w as u16, h as u16);
        let planes = YUVSlices::new((&self.yuv.y, &self.yuv.u, &self.yuv.v), (w, h), (w, w / 2, w / 2));
        let path = self.output.path();
        let fail = |e: openh264::Error| Error::encoder(path, "openh264", e);
        let encoder = match &mut self.encoder {
            Some(encoder) => encoder,
            none => none.insert(encoder(w * h, self.rate).map_err(fail)?),
        };
        let encoded = encoder.encode(&planes).map_err(fail)?;
        self.stream.clear();
        encoded.write_vec(&mut self.stream);
        self.sort_units();
        if self.sample.is_empty() {
            return Err(Error::encoder(self.output.path(), "openh264", "it left a picture out"));
        }
        self.spool.write_all(&self.sample).map_err(|source| self.output.error(source))?;
        self.track.sizes.push(self.sample.len() as u32);
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), Error> {
        self.size.known()?;
        let Self { mut output, spool, track, .. } = *self;
        let path = output.path().to_path_buf();
        let fail = |source| OutputError::new(&path, source);
        let mut spool = spool.into_inner().map_err(|e| fail(e.into_error()))?;
        spool.rewind().map_err(fail)?;
        output.put(&head(&track))?;
        let mut buffer = vec![0; 1 << 18];
        loop {
            match spool.read(&mut buffer).map_err(fail)? {
                0 => break,
                n => output.put(&buffer[..n])?,
            }
        }
        Ok(output.finish()?)
    }
}

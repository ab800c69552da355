//! Video as an MP4 file: H.264 by openh264.

use super::mux::{Mp4Track, TIMESCALE, head};
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

/// The H.264 quantisation parameter of all pictures (0 to 51), which keeps thin type and small discs sharp. The encoder
/// respects it only in its buffer-based mode; with rate control off it always uses 26.
const QUALITY: QpRange = QpRange::new(22, 22);
/// The time between key frames, seconds, which limits how finely a player can seek.
const KEY_SECONDS: f64 = 4.0;

/// Writes an MP4 file with H.264 video. The index comes first, so that playback can start while the file loads.
///
/// Encoded pictures go to an unnamed temporary file beside the result, and are appended to the finished index at the
/// end. Memory use is four bytes per picture. The maximum size is 3840 by 2160 pixels; odd sizes grow by one pixel.
pub struct Mp4Sink {
    output: Output,
    rate: f64,
    /// Created with the first picture, because it needs the size.
    encoder: Option<Encoder>,
    yuv: Yuv,
    size: SameSize,
    track: Mp4Track,
    /// The encoded pictures.
    spool: std::io::BufWriter<File>,
    stream: Vec<u8>,
    sample: Vec<u8>,
}

impl Mp4Sink {
    /// Creates `path` with `rate` pictures per second.
    ///
    /// # Errors
    /// The folder does not exist or is not writable, or the rate is outside its limits.
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
            track: Mp4Track { ticks, ..Mp4Track::default() },
            spool: std::io::BufWriter::with_capacity(1 << 16, spool),
            stream: Vec::new(),
            sample: Vec::new(),
        })
    }

    /// Turns the encoder's stream into a sample: parameter sets go to the index, units get a length prefix.
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

/// Creates an encoder for pictures of `pixels` pixels.
fn encoder(pixels: usize, rate: f64) -> Result<Encoder, openh264::Error> {
    // The quantisation determines the quality; the bit rate only determines the level of the stream.
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
        // One thread: the same pictures give the same file on any machine.
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
            return Err(Error::encoder(self.output.path(), "openh264", "the encoder dropped a picture"));
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

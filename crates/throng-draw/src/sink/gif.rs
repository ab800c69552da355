//! A looping animation as a GIF file.

use super::quantize::Counter;
use super::{FrameSink, SameSize, check_rate};
use crate::{Error, Image};
use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use throng_record::{Output, OutputError};

/// The shortest display time that browsers respect, hundredths of a second; shorter times become a tenth of a second.
const LEAST_DELAY: u64 = 2;
/// The palette index for unchanged pixels in pictures after the first.
const CLEAR: u8 = 255;

/// Writes a GIF file that loops endlessly.
///
/// A picture holds only the rectangle that differs from the previous one, with up to 255 colours of its own. GIF times
/// are hundredths of a second, and browsers show at most 50 pictures per second. At higher rates pictures are dropped;
/// at other rates display times are rounded so that the film keeps its duration.
pub struct GifSink {
    /// The output, until the encoder takes it with the first picture.
    output: Option<Output>,
    encoder: Option<Encoder<Output>>,
    path: PathBuf,
    rate: f64,
    size: SameSize,
    /// The number of pushed pictures.
    count: u64,
    /// The start of the last written picture, hundredths of a second.
    shown: u64,
    last: Option<Image>,
    /// The picture that waits for the start of the next picture, which determines its display time.
    waiting: Option<Frame<'static>>,
    counter: Counter,
}

impl GifSink {
    /// Creates `path` with `rate` pictures per second.
    ///
    /// # Errors
    /// The folder does not exist or is not writable, or the rate is outside its limits.
    pub fn create(path: impl AsRef<Path>, rate: f64) -> Result<Self, Error> {
        check_rate(rate)?;
        Self::new(Output::create(path)?, rate)
    }

    /// Creates a sink that writes to `output` with `rate` pictures per second.
    ///
    /// # Errors
    /// The rate is outside its limits.
    pub fn new(output: Output, rate: f64) -> Result<Self, Error> {
        check_rate(rate)?;
        let path = output.path().to_path_buf();
        Ok(Self {
            output: Some(output),
            encoder: None,
            size: SameSize::new(&path),
            path,
            rate,
            count: 0,
            shown: 0,
            last: None,
            waiting: None,
            counter: Counter::new(),
        })
    }

    /// Returns the start of picture `index`, hundredths of a second.
    fn begin(&self, index: u64) -> u64 {
        (index as f64 * 100.0 / self.rate).round() as u64
    }

    fn fail(&self, error: EncodingError) -> Error {
        match error {
            EncodingError::Io(source) => OutputError::new(&self.path, source).into(),
            other => Error::encoder(&self.path, "the GIF encoder", other),
        }
    }

    /// Writes the waiting picture, displayed until `end`.
    fn write_waiting(&mut self, end: u64) -> Result<(), Error> {
        let Some(mut frame) = self.waiting.take() else { return Ok(()) };
        frame.delay = (end - self.shown).clamp(LEAST_DELAY, u64::from(u16::MAX)) as u16;
        let result = match &mut self.encoder {
            Some(encoder) => encoder.write_frame(&frame),
            None => Ok(()),
        };
        result.map_err(|e| self.fail(e))
    }

    /// Returns the difference to the previous picture.
    fn difference(&mut self, image: &Image) -> Frame<'static> {
        let width = image.width() as usize;
        let (left, top, right, bottom) = match &self.last {
            Some(last) => changed(last, image),
            None => (0, 0, width, image.height() as usize),
        };
        let row = |image: &'_ Image, y: usize| -> Vec<[u8; 3]> {
            let bytes = &image.data()[(y * width + left) * 4..(y * width + right) * 4];
            bytes.chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect()
        };
        let mut pixels: Vec<Option<[u8; 3]>> = Vec::with_capacity((right - left) * (bottom - top));
        for y in top..bottom {
            let new = row(image, y);
            match &self.last {
                Some(last) => {
                    pixels.extend(new.iter().zip(row(last, y)).map(|(&new, old)| (new != old).then_some(new)));
                }
                None => pixels.extend(new.into_iter().map(Some)),
            }
        }
        pixels.iter().flatten().for_each(|&color| self.counter.add(color));
        let mut palette = self.counter.palette(usize::from(CLEAR));
        // The table must include the index of unchanged pixels.
        palette.resize(256 * 3, 0);
        let buffer: Vec<u8> = pixels.iter().map(|p| p.map_or(CLEAR, |color| self.counter.index(color))).collect();
        Frame {
            dispose: DisposalMethod::Keep,
            transparent: Some(CLEAR),
            left: left as u16,
            top: top as u16,
            width: (right - left) as u16,
            height: (bottom - top) as u16,
            palette: Some(palette),
            buffer: Cow::Owned(buffer),
            ..Frame::default()
        }
    }
}

/// Returns the smallest rectangle that holds all differing pixels, at least one pixel: left, top, right, bottom.
fn changed(a: &Image, b: &Image) -> (usize, usize, usize, usize) {
    let width = a.width() as usize;
    let (mut left, mut right, mut top, mut bottom) = (width, 0, usize::MAX, 0);
    let rows = a.data().chunks_exact(width * 4).zip(b.data().chunks_exact(width * 4));
    for (y, (a, b)) in rows.enumerate().filter(|(_, (a, b))| a != b) {
        let mut differ = (0..width).filter(|&x| a[x * 4..x * 4 + 4] != b[x * 4..x * 4 + 4]);
        let first = differ.next().unwrap_or(0);
        let last = differ.next_back().unwrap_or(first);
        (left, right) = (left.min(first), right.max(last + 1));
        (top, bottom) = (top.min(y), y + 1);
    }
    if bottom == 0 { (0, 0, 1, 1) } else { (left, top, right, bottom) }
}

impl FrameSink for GifSink {
    fn push(&mut self, image: &Image) -> Result<(), Error> {
        if self.size.check(image)? {
            let (width, height) = (image.width() as u16, image.height() as u16);
            let output = self.output.take().expect("the output is taken once, by the first picture");
            let mut encoder = Encoder::new(output, width, height, &[]).map_err(|e| self.fail(e))?;
            encoder.set_repeat(Repeat::Infinite).map_err(|e| self.fail(e))?;
            self.encoder = Some(encoder);
        }
        let begin = self.begin(self.count);
        self.count += 1;
        if self.waiting.is_some() {
            if begin - self.shown < LEAST_DELAY {
                return Ok(());
            }
            self.write_waiting(begin)?;
        }
        self.shown = begin;
        self.waiting = Some(self.difference(image));
        match &mut self.last {
            Some(last) => last.copy_from(image),
            last => *last = Some(image.clone()),
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<(), Error> {
        self.size.known()?;
        self.write_waiting(self.begin(self.count))?;
        let encoder = self.encoder.take().expect("there was a picture");
        let output = encoder.into_inner().map_err(|e| self.fail(e))?;
        Ok(output.finish()?)
    }
}

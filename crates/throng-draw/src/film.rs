//! Films: a painter and a sink in one.

use crate::exposure::between;
use crate::picture::Picture;
use crate::sheet::SheetPainter;
use crate::sink::{Ahead, FrameSink, Kind, sink};
use crate::{Error, MotionBlur, Projection, Sheet, Style};
use std::path::{Path, PathBuf};
use throng_record::{Frame, Output};

/// The moment that a single picture (`.png`, `.svg`) shows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Still {
    /// The last moment.
    #[default]
    Last,
    /// The moment with this index, from 0; the last if there are fewer.
    Index(usize),
    /// The first moment at or after this time, seconds; the last if there is none.
    Time(f64),
}

/// Makes a picture or a video of a recording; the name of the file determines its kind ([`Kind`]).
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("film.gif");
/// use throng_draw::{Film, Style};
/// use throng_record::{Frame, Setting};
/// let mut film = Film::create(&path, &Setting::default(), &Style::default(), 25.0)?;
/// for k in 0..3 {
///     film.push(&Frame { time: f64::from(k) / 25.0, ..Frame::default() })?;
/// }
/// film.finish()?;
/// assert!(path.exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Film {
    path: PathBuf,
    sheet: Sheet,
    style: Style,
    painter: Option<SheetPainter>,
    target: Target,
    count: usize,
}

enum Target {
    /// All moments are painted.
    Moving(Box<dyn FrameSink>),
    /// All pictures are exposed to the motion between the moments.
    Exposed(Box<dyn FrameSink>, Shutter),
    /// One moment is painted.
    Still { which: Still, kind: Kind, picture: Option<Picture>, last: Vec<Frame>, output: Output },
}

/// The state of a film with motion blur.
struct Shutter {
    blur: MotionBlur,
    /// The number of samples of a picture.
    count: u32,
    /// The time of the first picture, seconds.
    start: f64,
    /// The last moment.
    before: Vec<Frame>,
    /// The picture that is exposed, and the number of its samples so far.
    picture: u64,
    sample: u32,
    /// The frames of the last sample.
    last: Vec<Frame>,
}

impl Shutter {
    /// Exposes pictures up to a moment.
    fn expose(&mut self, frames: &[&Frame], painter: &mut SheetPainter, sink: &mut dyn FrameSink) -> Result<(), Error> {
        let now = latest(frames.iter().copied());
        if self.before.is_empty() {
            self.start = now;
        }
        while !self.before.is_empty() {
            let time = self.blur.time(self.start, self.picture, (self.sample, self.count));
            if time > now {
                break;
            }
            let pairs = self.before.iter().zip(frames);
            self.last = pairs.map(|(before, now)| between(before, now, time)).collect();
            self.take(painter, sink)?;
        }
        self.before.resize_with(frames.len(), Frame::default);
        self.before.iter_mut().zip(frames).for_each(|(before, now)| before.clone_from(now));
        Ok(())
    }

    /// Adds the frames of a sample, and writes the picture if it is complete.
    fn take(&mut self, painter: &mut SheetPainter, sink: &mut dyn FrameSink) -> Result<(), Error> {
        painter.expose(&self.last);
        self.sample += 1;
        if self.sample >= self.count {
            (self.sample, self.picture) = (0, self.picture + 1);
            sink.push(painter.develop(&self.last))?;
        }
        Ok(())
    }

    /// Completes the last picture: at the end everything stands still. A film of one moment has one picture.
    fn end(&mut self, painter: &mut SheetPainter, sink: &mut dyn FrameSink) -> Result<(), Error> {
        while self.sample > 0 || self.picture == 0 {
            self.last.clone_from(&self.before);
            self.take(painter, sink)?;
        }
        Ok(())
    }
}

/// Returns the time of the latest frame.
fn latest<'a>(frames: impl Iterator<Item = &'a Frame>) -> f64 {
    frames.map(|frame| frame.time).fold(f64::NEG_INFINITY, f64::max)
}

impl Film {
    /// Creates `path` with `rate` moments per second. The view is fitted to the first pushed moment, unless the style
    /// has one. A single picture shows the last moment; see [`still`](Self::still). `sheet` is a [`Sheet`] of several
    /// recordings, or the setting of one recording.
    ///
    /// # Errors
    /// The ending of the name is unknown, the folder does not exist or is not writable, the rate or the size of the
    /// picture is outside its limits, or ffmpeg is needed and not found.
    pub fn create(path: impl AsRef<Path>, sheet: impl Into<Sheet>, style: &Style, rate: f64) -> Result<Self, Error> {
        let path = path.as_ref();
        Error::check_size(style.width, style.height)?;
        let kind = Kind::of(path)?;
        if !matches!(kind, Kind::Png | Kind::Svg) {
            return Self::new(path, sink(path, rate)?, sheet, style);
        }
        let output = Output::create(path)?;
        let target = Target::Still { which: Still::Last, kind, picture: None, last: Vec::new(), output };
        Ok(Self { path: path.into(), sheet: sheet.into(), style: style.clone(), painter: None, target, count: 0 })
    }

    /// Creates a film that writes to a sink; messages name it `path`.
    ///
    /// # Errors
    /// The size of the picture is outside its limits.
    pub fn new(
        path: impl AsRef<Path>,
        sink: Box<dyn FrameSink>,
        sheet: impl Into<Sheet>,
        style: &Style,
    ) -> Result<Self, Error> {
        Error::check_size(style.width, style.height)?;
        let sink = Box::new(Ahead::start(sink));
        let sheet: Sheet = sheet.into();
        let is_space = sheet.panels.iter().any(|setting| style.projection(setting) == Projection::Perspective);
        let projection = if is_space { Projection::Perspective } else { Projection::Plan };
        let shutter = |blur: MotionBlur| Shutter {
            blur,
            count: blur.count(projection),
            start: 0.0,
            before: Vec::new(),
            picture: 0,
            sample: 0,
            last: Vec::new(),
        };
        let target = match style.blur {
            Some(blur) => Target::Exposed(sink, shutter(blur)),
            None => Target::Moving(sink),
        };
        let path = path.as_ref().to_path_buf();
        Ok(Self { path, sheet, style: style.clone(), painter: None, target, count: 0 })
    }

    /// Chooses the moment that a single picture shows. Has no effect on a video.
    #[must_use]
    pub fn still(mut self, moment: Still) -> Self {
        if let Target::Still { which, .. } = &mut self.target {
            *which = moment;
        }
        self
    }

    /// Fits the view to a moment of each panel, without showing it. Has no effect once a moment has been pushed.
    ///
    /// # Errors
    /// The size of a panel is outside its limits.
    pub fn fit_to(&mut self, frames: &[&Frame]) -> Result<(), Error> {
        if self.painter.is_none() {
            self.painter = Some(SheetPainter::new(&self.sheet, &self.style, frames)?);
        }
        Ok(())
    }

    /// Returns the number of pushed moments.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Appends a moment of a single recording.
    ///
    /// # Errors
    /// Those of [`push_all`](Self::push_all).
    pub fn push(&mut self, frame: &Frame) -> Result<(), Error> {
        self.push_all(&[frame])
    }

    /// Appends a moment of each panel, in their order. The time of the picture is the latest of the frames: for a
    /// recording that has ended, pass its last frame again.
    ///
    /// # Errors
    /// The moment cannot be written or encoded.
    pub fn push_all(&mut self, frames: &[&Frame]) -> Result<(), Error> {
        let painter = match &mut self.painter {
            Some(painter) => painter,
            none => none.insert(SheetPainter::new(&self.sheet, &self.style, frames)?),
        };
        let index = self.count;
        self.count += 1;
        match &mut self.target {
            Target::Moving(sink) => sink.push(painter.paint(frames)),
            Target::Exposed(sink, shutter) => shutter.expose(frames, painter, &mut **sink),
            Target::Still { picture: Some(_), .. } => Ok(()),
            Target::Still { which, kind, picture, last, .. } => {
                let now = match *which {
                    Still::Last => false,
                    Still::Index(wanted) => index == wanted,
                    Still::Time(wanted) => frames.iter().any(|frame| frame.time >= wanted),
                };
                if now {
                    *picture = Some(picture_of(painter, *kind, frames));
                } else {
                    painter.follow(frames);
                    keep(last, frames);
                }
                Ok(())
            }
        }
    }

    /// Passes a moment between two pictures: trails, footfalls and wheels follow it, and motion blur shows it. Moments
    /// before the first picture have no effect.
    ///
    /// # Errors
    /// A picture cannot be written or encoded.
    pub fn follow_all(&mut self, frames: &[&Frame]) -> Result<(), Error> {
        let Some(painter) = &mut self.painter else { return Ok(()) };
        match &mut self.target {
            Target::Moving(_) => painter.follow(frames),
            Target::Exposed(sink, shutter) => shutter.expose(frames, painter, &mut **sink)?,
            Target::Still { picture: Some(_), .. } => {}
            Target::Still { last, .. } => {
                painter.follow(frames);
                keep(last, frames);
            }
        }
        Ok(())
    }

    /// Completes the file and renames it to its final name.
    ///
    /// # Errors
    /// The file cannot be written, or no moment was pushed.
    pub fn finish(self) -> Result<(), Error> {
        let Some(mut painter) = self.painter else { return Err(Error::Empty { path: self.path }) };
        let (kind, picture, last, output) = match self.target {
            Target::Moving(sink) => return sink.finish(),
            Target::Exposed(mut sink, mut shutter) => {
                shutter.end(&mut painter, &mut *sink)?;
                return sink.finish();
            }
            Target::Still { kind, picture, last, output, .. } => (kind, picture, last, output),
        };
        let picture = picture.unwrap_or_else(|| picture_of(&mut painter, kind, &last.iter().collect::<Vec<_>>()));
        picture.write(output)
    }
}

/// Makes `last` a copy of the frames.
fn keep(last: &mut Vec<Frame>, frames: &[&Frame]) {
    last.resize_with(frames.len(), Frame::default);
    last.iter_mut().zip(frames).for_each(|(last, frame)| last.clone_from(frame));
}

fn picture_of(painter: &mut SheetPainter, kind: Kind, frames: &[&Frame]) -> Picture {
    match kind {
        Kind::Svg => Picture::Vector(painter.svg(frames)),
        _ => Picture::Pixels(painter.paint(frames).clone()),
    }
}

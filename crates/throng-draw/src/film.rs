//! Films: a painter and a sink in one.

use crate::picture::Picture;
use crate::sheet::SheetPainter;
use crate::sink::{Ahead, FrameSink, Kind, sink};
use crate::{Error, Sheet, Style};
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
    /// One moment is painted.
    Still { which: Still, kind: Kind, picture: Option<Picture>, last: Vec<Frame>, output: Output },
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
        let target = Target::Moving(Box::new(Ahead::start(sink)));
        let path = path.as_ref().to_path_buf();
        Ok(Self { path, sheet: sheet.into(), style: style.clone(), painter: None, target, count: 0 })
    }

    /// Chooses the moment that a single picture shows. Has no effect on a video.
    #[must_use]
    pub fn still(mut self, moment: Still) -> Self {
        if let Target::Still { which, .. } = &mut self.target {
            *which = moment;
        }
        self
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
                    last.resize_with(frames.len(), Frame::default);
                    last.iter_mut().zip(frames).for_each(|(last, frame)| last.clone_from(frame));
                }
                Ok(())
            }
        }
    }

    /// Completes the file and renames it to its final name.
    ///
    /// # Errors
    /// The file cannot be written, or no moment was pushed.
    pub fn finish(self) -> Result<(), Error> {
        let Some(mut painter) = self.painter else { return Err(Error::Empty { path: self.path }) };
        let (kind, picture, last, output) = match self.target {
            Target::Moving(sink) => return sink.finish(),
            Target::Still { kind, picture, last, output, .. } => (kind, picture, last, output),
        };
        let picture = picture.unwrap_or_else(|| picture_of(&mut painter, kind, &last.iter().collect::<Vec<_>>()));
        picture.write(output)
    }
}

fn picture_of(painter: &mut SheetPainter, kind: Kind, frames: &[&Frame]) -> Picture {
    match kind {
        Kind::Svg => Picture::Vector(painter.svg(frames)),
        _ => Picture::Pixels(painter.paint(frames).clone()),
    }
}

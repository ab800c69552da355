//! Outputs for pictures: a sink for each kind of file.

mod ahead;
mod folder;
mod gif;
#[cfg(feature = "video")]
mod mp4;
#[cfg(feature = "video")]
mod mux;
#[cfg(feature = "video")]
mod nal;
mod pipe;
mod png;
mod quantize;
#[cfg(feature = "video")]
mod yuv;

pub use ahead::Ahead;
pub use folder::FolderSink;
pub use gif::GifSink;
#[cfg(feature = "video")]
pub use mp4::Mp4Sink;
pub use pipe::PipeSink;
pub use png::{PngSink, write_png};
pub(crate) use png::{encode_png, png_bytes};

use crate::{Error, Image};
use std::path::{Path, PathBuf};

/// Receives the pictures of a film in order.
///
/// No file has the name of the result before [`finish`](Self::finish); a sink that is dropped unfinished leaves no
/// file. After an error a sink can only be dropped, which [`Film`](crate::Film) ensures. The memory that a sink needs
/// does not grow with the length of the film.
pub trait FrameSink: Send {
    /// Appends a picture.
    ///
    /// # Errors
    /// The picture cannot be written or encoded, or its size differs from that of the first.
    fn push(&mut self, image: &Image) -> Result<(), Error>;

    /// Completes the result and renames it to its final name.
    ///
    /// # Errors
    /// The result cannot be written, or no picture was pushed.
    fn finish(self: Box<Self>) -> Result<(), Error>;
}

/// The kinds of output, by the name of the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Kind {
    /// `.mp4`: H.264 video, encoded by openh264; without the feature `video`, by the program ffmpeg.
    Mp4,
    /// `.gif`: a looping animation.
    Gif,
    /// `.png`: one picture.
    Png,
    /// `.svg`: one vector picture.
    Svg,
    /// A folder of numbered PNG files: an existing folder, or a name that ends in `/`.
    Folder,
    /// Any other video, through the program ffmpeg.
    Pipe,
}

/// The endings of videos that ffmpeg writes.
const PIPED: [&str; 14] =
    ["avi", "mkv", "webm", "mov", "m4v", "mpg", "mpeg", "ogv", "ts", "flv", "wmv", "3gp", "mxf", "apng"];

impl Kind {
    /// Returns the kind of output for `path`.
    ///
    /// # Errors
    /// [`Error::Extension`] if the kind does not follow from the name.
    pub fn of(path: &Path) -> Result<Self, Error> {
        let slash = path.as_os_str().as_encoded_bytes().last().is_some_and(|&b| b == b'/' || b == b'\\');
        if slash || path.is_dir() {
            return Ok(Self::Folder);
        }
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        match extension.as_str() {
            "mp4" => Ok(Self::Mp4),
            "gif" => Ok(Self::Gif),
            "png" => Ok(Self::Png),
            "svg" => Ok(Self::Svg),
            other if PIPED.contains(&other) => Ok(Self::Pipe),
            _ => Err(Error::Extension { path: path.to_path_buf() }),
        }
    }
}

/// Creates the sink for `path` by its ending, with `rate` pictures per second. `.svg` is not a sequence of pictures:
/// see [`Film`](crate::Film).
///
/// # Errors
/// The ending is unknown, the folder does not exist or is not writable, the rate is outside its limits, or ffmpeg is
/// needed and not found.
pub fn sink(path: impl AsRef<Path>, rate: f64) -> Result<Box<dyn FrameSink>, Error> {
    let path = path.as_ref();
    Ok(match Kind::of(path)? {
        #[cfg(feature = "video")]
        Kind::Mp4 => Box::new(Mp4Sink::create(path, rate)?),
        Kind::Gif => Box::new(GifSink::create(path, rate)?),
        Kind::Png => Box::new(PngSink::create(path)?),
        Kind::Folder => Box::new(FolderSink::create(path)?),
        #[cfg(not(feature = "video"))]
        Kind::Mp4 => Box::new(PipeSink::create(path, rate)?),
        Kind::Pipe => Box::new(PipeSink::create(path, rate)?),
        Kind::Svg => return Err(Error::Extension { path: path.to_path_buf() }),
    })
}

/// Checks that all pictures have the size of the first.
#[derive(Debug)]
struct SameSize {
    path: PathBuf,
    size: Option<(u32, u32)>,
}

impl SameSize {
    fn new(path: &Path) -> Self {
        Self { path: path.to_path_buf(), size: None }
    }

    /// Checks the size of a picture. Returns whether it is the first.
    fn check(&mut self, image: &Image) -> Result<bool, Error> {
        let (width, height) = (image.width(), image.height());
        let first = self.size.is_none();
        if *self.size.get_or_insert((width, height)) != (width, height) {
            return Err(Error::SizeChanged { path: self.path.clone(), width, height });
        }
        Ok(first)
    }

    /// Returns the size; an error if there was no picture.
    fn known(&self) -> Result<(u32, u32), Error> {
        self.size.ok_or_else(|| Error::Empty { path: self.path.clone() })
    }
}

fn check_rate(rate: f64) -> Result<(), Error> {
    if (0.001..=1000.0).contains(&rate) { Ok(()) } else { Err(Error::Rate(rate)) }
}

//! Errors of pictures and video.

use std::path::{Path, PathBuf};
use throng_record::OutputError;

/// An error that prevents a picture or video.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The size of the picture is outside its limits.
    #[error("the picture is {width} by {height} pixels, but must be {limit}")]
    Size {
        /// The width.
        width: u32,
        /// The height.
        height: u32,
        /// The limits, in words.
        limit: &'static str,
    },
    /// A picture has another size than the previous one.
    #[error("{}: a picture of {width} by {height} pixels follows one of another size", path.display())]
    SizeChanged {
        /// The file.
        path: PathBuf,
        /// The new width.
        width: u32,
        /// The new height.
        height: u32,
    },
    /// The rate is not a valid number of frames per second.
    #[error("the rate is {0} frames per second, but must be between 0.001 and 1000")]
    Rate(f64),
    /// The kind of file does not follow from the name.
    #[error(
        "{}: cannot tell what to write from this name; end it in .mp4, .gif, .png, .svg, .avi, .mkv, .webm or .mov, \
         or in / for a folder of PNG files", path.display()
    )]
    Extension {
        /// The file.
        path: PathBuf,
    },
    /// The data is not a font.
    #[error("{name}: this is not a TrueType or OpenType font")]
    Typeface {
        /// The name of the font.
        name: String,
    },
    /// The name of the file does not end like a single picture.
    #[error("{}: a figure is one picture; end the name in .png or .svg", path.display())]
    Still {
        /// The file.
        path: PathBuf,
    },
    /// No frame was pushed.
    #[error("{}: there is no frame to write", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// The film has ended with an earlier error.
    #[error("nothing more can be written after an error")]
    Ended,
    /// The program ffmpeg, which this kind of file needs, was not found.
    #[error(
        "cannot write {}: this kind of video needs the program ffmpeg, which was not found; install it, or write \
         .mp4 or .gif, which need nothing", path.display()
    )]
    NoFfmpeg {
        /// The file.
        path: PathBuf,
    },
    /// The encoder reports an error.
    #[error("cannot write {}: {encoder} says: {message}", path.display())]
    Encoder {
        /// The file.
        path: PathBuf,
        /// The encoder.
        encoder: &'static str,
        /// The encoder's message.
        message: String,
    },
}

impl Error {
    pub(crate) fn check_size(width: u32, height: u32) -> Result<(), Self> {
        let limits = 16..=16384;
        if limits.contains(&width) && limits.contains(&height) {
            return Ok(());
        }
        Err(Self::Size { width, height, limit: "between 16 and 16384 on each side" })
    }

    pub(crate) fn encoder(path: &Path, encoder: &'static str, message: impl ToString) -> Self {
        Self::Encoder { path: path.to_path_buf(), encoder, message: message.to_string() }
    }
}

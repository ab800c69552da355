//! A finished still and its file.

use crate::sink::encode_png;
use crate::{Error, Image};
use throng_record::Output;

/// A finished still.
pub(crate) enum Picture {
    Pixels(Image),
    Vector(String),
}

impl Picture {
    /// Writes the still and completes the file.
    pub(crate) fn write(self, mut output: Output) -> Result<(), Error> {
        match self {
            Self::Pixels(image) => encode_png(output, &image),
            Self::Vector(text) => {
                output.put(text.as_bytes())?;
                Ok(output.finish()?)
            }
        }
    }
}

//! One picture as a PNG file.

use super::FrameSink;
use crate::{Error, Image};
use std::io::Write;
use std::path::Path;
use throng_record::Output;

/// Writes a picture as a PNG file.
///
/// # Errors
/// The file cannot be written.
pub fn write_png(path: impl AsRef<Path>, image: &Image) -> Result<(), Error> {
    encode_png(Output::create(path)?, image)
}

/// Writes `image` to `output` and completes it.
pub(crate) fn encode_png(output: Output, image: &Image) -> Result<(), Error> {
    encode(output, image, png::Compression::Balanced)
}

/// Writes `image` and completes the file.
pub(super) fn encode(mut output: Output, image: &Image, compression: png::Compression) -> Result<(), Error> {
    let result = encode_to(&mut output, image, compression);
    match result {
        Ok(()) => Ok(output.finish()?),
        Err(png::EncodingError::IoError(source)) => Err(output.error(source).into()),
        Err(other) => Err(Error::encoder(output.path(), "the PNG encoder", other)),
    }
}

fn encode_to(output: &mut impl Write, image: &Image, compression: png::Compression) -> Result<(), png::EncodingError> {
    // Pictures of worlds are opaque and need no alpha channel.
    let rgb: Vec<u8> = image.data().chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    encode_as(output, image, (png::ColorType::Rgb, &rgb), compression)
}

/// Returns a picture with its opacity as the bytes of a PNG file.
pub(crate) fn png_bytes(image: &Image) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode_as(&mut bytes, image, (png::ColorType::Rgba, image.data()), png::Compression::Balanced)
        .expect("the number of bytes matches the size, and writing to memory does not fail");
    bytes
}

fn encode_as(
    output: &mut impl Write,
    image: &Image,
    (color, data): (png::ColorType, &[u8]),
    compression: png::Compression,
) -> Result<(), png::EncodingError> {
    let mut encoder = png::Encoder::new(output, image.width(), image.height());
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(compression);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(data)?;
    writer.finish()
}

/// Keeps the last picture and writes it as a PNG file.
#[derive(Debug)]
pub struct PngSink {
    output: Output,
    last: Option<Image>,
}

impl PngSink {
    /// Creates `path`.
    ///
    /// # Errors
    /// The folder does not exist or is not writable.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, Error> {
        Ok(Self { output: Output::create(path)?, last: None })
    }
}

impl FrameSink for PngSink {
    fn push(&mut self, image: &Image) -> Result<(), Error> {
        match &mut self.last {
            Some(last) if (last.width(), last.height()) == (image.width(), image.height()) => last.copy_from(image),
            last => *last = Some(image.clone()),
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), Error> {
        let Some(image) = &self.last else {
            return Err(Error::Empty { path: self.output.path().to_path_buf() });
        };
        encode_png(self.output, image)
    }
}

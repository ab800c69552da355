//! Textures.

use super::data::{Data, embedded, number};
use std::borrow::Cow;
use std::io::Cursor;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::{bytestream::ZCursor, colorspace::ColorSpace, options::DecoderOptions};

/// A picture.
#[derive(Debug)]
pub(super) struct Texture {
    width: usize,
    height: usize,
    /// Bytes of a pixel.
    parts: usize,
    bytes: Vec<u8>,
}

impl Texture {
    /// Returns an image of a file, with at most `most` pixels; `None` if it is no PNG, JPEG or WebP, or not in the file.
    pub fn of(data: &Data, image: usize, most: usize) -> Result<Option<Self>, String> {
        let Some(said) = data.root.images.get(image) else { return Err("it does not exist".to_owned()) };
        let view = number(&said["bufferView"]).map(|at| data.view(at));
        let bytes: Cow<[u8]> = match view {
            Some(view) => Cow::Borrowed(view?.0),
            None => match said["uri"].as_str().and_then(embedded) {
                Some(bytes) => Cow::Owned(bytes),
                None => return Ok(None),
            },
        };
        Self::decoded(&bytes, most)
    }

    /// Returns a picture with at most `most` pixels; `None` if it is no PNG, JPEG or WebP.
    fn decoded(bytes: &[u8], most: usize) -> Result<Option<Self>, String> {
        let (name, picture) = match bytes {
            [0x89, b'P', b'N', b'G', ..] => ("PNG", png(bytes, most)),
            [0xff, 0xd8, 0xff, ..] => ("JPEG", jpeg(bytes, most)),
            [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => ("WebP", webp(bytes, most)),
            _ => return Ok(None),
        };
        match picture {
            Ok(picture) => Ok(Some(picture)),
            Err(Flaw::Damaged(why)) => Err(format!("the {name} is damaged: {why}")),
            Err(Flaw::Large) => {
                let most = super::materials::MOST_PIXELS >> 20;
                Err(format!("the textures have more than {most} million pixels; export smaller ones"))
            }
        }
    }

    /// Returns the number of pixels.
    pub fn pixels(&self) -> usize {
        self.width * self.height
    }

    /// Returns the colour at a place: 0 to 1 from the left and from the top; beyond, the texture repeats.
    pub fn at(&self, place: [f32; 2]) -> [u8; 3] {
        let [column, row] = [(place[0], self.width), (place[1], self.height)].map(|(share, size)| {
            let share = share - libm::floorf(share);
            ((share * size as f32) as usize).min(size.saturating_sub(1))
        });
        let pixel = (row * self.width + column) * self.parts;
        let part = |k: usize| self.bytes.get(pixel + k).copied().unwrap_or(255);
        // grey has one part, or two with its opacity
        if self.parts < 3 { [part(0); 3] } else { [part(0), part(1), part(2)] }
    }
}

/// Why a picture is not read.
enum Flaw {
    Damaged(String),
    Large,
}

impl Flaw {
    fn damaged(why: impl ToString) -> Self {
        Self::Damaged(why.to_string())
    }
}

/// Returns the number of pixels, if it is at most `most`.
fn pixels([width, height]: [usize; 2], most: usize) -> Result<usize, Flaw> {
    width.checked_mul(height).filter(|&pixels| pixels <= most).ok_or(Flaw::Large)
}

fn png(bytes: &[u8], most: usize) -> Result<Texture, Flaw> {
    let limits = png::Limits { bytes: 4 * most + (1 << 20) };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(Flaw::damaged)?;
    let [width, height] = [reader.info().width, reader.info().height].map(|side| side as usize);
    pixels([width, height], most)?;
    let mut bytes = vec![0; reader.output_buffer_size().unwrap_or(0)];
    let frame = reader.next_frame(&mut bytes).map_err(Flaw::damaged)?;
    Ok(Texture { width, height, parts: frame.color_type.samples(), bytes })
}

fn jpeg(bytes: &[u8], most: usize) -> Result<Texture, Flaw> {
    const PARTS: usize = 3;
    // without the instructions of some processors: colours are the same bits on all machines
    let options = DecoderOptions::new_safe().jpeg_set_out_colorspace(ColorSpace::RGB);
    // the number of pixels is limited, not the sides
    let options = options.set_max_width(usize::from(u16::MAX)).set_max_height(usize::from(u16::MAX));
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(Flaw::damaged)?;
    let (width, height) = decoder.dimensions().unwrap_or_default();
    let mut bytes = vec![0; PARTS * pixels([width, height], most)?];
    decoder.decode_into(&mut bytes).map_err(Flaw::damaged)?;
    Ok(Texture { width, height, parts: PARTS, bytes })
}

fn webp(bytes: &[u8], most: usize) -> Result<Texture, Flaw> {
    let mut decoder = image_webp::WebPDecoder::new(Cursor::new(bytes)).map_err(Flaw::damaged)?;
    let (width, height) = decoder.dimensions();
    let (width, height) = (width as usize, height as usize);
    let parts = if decoder.has_alpha() { 4 } else { 3 };
    let mut bytes = vec![0; parts * pixels([width, height], most)?];
    decoder.set_memory_limit(4 * most + (1 << 20));
    decoder.read_image(&mut bytes).map_err(Flaw::damaged)?;
    Ok(Texture { width, height, parts, bytes })
}

#[cfg(test)]
mod tests;

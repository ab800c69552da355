//! Textures.

use super::data::{Data, embedded, number};
use std::borrow::Cow;
use std::io::Cursor;

/// A picture.
pub(super) struct Texture {
    width: usize,
    height: usize,
    /// Bytes of a pixel.
    parts: usize,
    bytes: Vec<u8>,
}

impl Texture {
    /// Returns an image of a file, with at most `most` pixels; `None` if it is no PNG or not in the file.
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
        if !bytes.starts_with(b"\x89PNG") {
            return Ok(None);
        }
        let wrong = |error: png::DecodingError| format!("the PNG is damaged: {error}");
        let limits = png::Limits { bytes: 4 * most + (1 << 20) };
        let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().map_err(wrong)?;
        let info = reader.info();
        let (width, height) = (info.width as usize, info.height as usize);
        if width.saturating_mul(height) > most {
            return Err(format!(
                "the textures have more than {} million pixels; export smaller ones",
                super::materials::MOST_PIXELS >> 20
            ));
        }
        let mut bytes = vec![0; reader.output_buffer_size().unwrap_or(0)];
        let frame = reader.next_frame(&mut bytes).map_err(wrong)?;
        Ok(Some(Self { width, height, parts: frame.color_type.samples(), bytes }))
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

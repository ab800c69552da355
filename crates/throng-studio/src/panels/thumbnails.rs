//! The gallery's pictures, unpacked when they are first looked at.

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};
use std::collections::BTreeMap;

/// Every picture: the name of its scene, and its file.
const FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/thumbnails.rs"));

/// Pictures that have been looked at.
#[derive(Default)]
pub struct Thumbnails {
    textures: BTreeMap<&'static str, Option<TextureHandle>>,
}

impl Thumbnails {
    /// The picture of a scene; `None` if there is none.
    pub fn of(&mut self, name: &'static str, ctx: &Context) -> Option<&TextureHandle> {
        let unpack = || Some(ctx.load_texture(name, image(name)?, TextureOptions::LINEAR));
        self.textures.entry(name).or_insert_with(unpack).as_ref()
    }
}

fn image(name: &str) -> Option<ColorImage> {
    let at = FILES.binary_search_by_key(&name, |(known, _)| known).ok()?;
    let mut decoder = png::Decoder::new(std::io::Cursor::new(FILES[at].1));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().ok()?;
    let mut pixels = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut pixels).ok()?;
    let size = [info.width as usize, info.height as usize];
    match info.color_type {
        png::ColorType::Rgb => Some(ColorImage::from_rgb(size, &pixels[..info.buffer_size()])),
        png::ColorType::Rgba => Some(ColorImage::from_rgba_unmultiplied(size, &pixels[..info.buffer_size()])),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_of_the_gallery_has_a_picture() {
        let missing: Vec<_> = throng_scene::gallery::names().filter(|name| image(name).is_none()).collect();
        assert!(missing.is_empty(), "cargo run -p throng-studio --example thumbnails -- {}", missing.join(" "));
    }
}

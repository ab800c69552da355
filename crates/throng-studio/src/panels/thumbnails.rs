//! The gallery's pictures, unpacked when they are first looked at; scenes of plug-ins have theirs drawn then.

use crate::document::Document;
use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};
use std::collections::BTreeMap;
use std::sync::Arc;
use throng_draw::{Painter, Style};
use throng_record::{Frame, moment};
use throng_scene::{Plugins, caught, gallery};

/// Every picture: the name of its scene, and its file.
const FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/thumbnails.rs"));

/// Pixels of a picture that is drawn: those of the files.
const SIZE: (u32, u32) = (216, 144);

/// Pictures that have been looked at.
#[derive(Default)]
pub struct Thumbnails {
    textures: BTreeMap<String, Option<TextureHandle>>,
}

impl Thumbnails {
    /// The picture of a scene; `None` if there is none.
    pub fn of(&mut self, name: &str, plugins: &Arc<Plugins>, ctx: &Context) -> Option<&TextureHandle> {
        if !self.textures.contains_key(name) {
            let own = plugins.text(name) != gallery::text(name);
            let image = if own { beginning(name, plugins) } else { image(name) };
            let texture = image.map(|image| ctx.load_texture(name, image, TextureOptions::LINEAR));
            self.textures.insert(name.to_owned(), texture);
        }
        self.textures.get(name)?.as_ref()
    }
}

/// A scene as it begins; `None` if it does not.
fn beginning(name: &str, plugins: &Arc<Plugins>) -> Option<ColorImage> {
    let document = Document::named(name, plugins)?;
    let scene = document.scene().ok()?;
    let (world, built) = caught(|| scene.build()).ok()?.ok()?;
    let mut frame = Frame::default();
    moment::capture(&world, &mut frame);
    let (width, height) = SIZE;
    let style = Style { width, height, legend: false, ..Style::said(scene) };
    let mut painter = Painter::new(&moment::setting(&world, &built, name), &style, &frame).ok()?;
    let size = [width as usize, height as usize];
    Some(ColorImage::from_rgba_premultiplied(size, painter.paint(&frame).data()))
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
        let missing: Vec<_> = gallery::names().filter(|name| image(name).is_none()).collect();
        assert!(missing.is_empty(), "cargo run -p throng-studio --example thumbnails -- {}", missing.join(" "));
    }
}

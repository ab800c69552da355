//! The gallery's pictures, unpacked when they are first looked at.

use eframe::egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};
use std::collections::BTreeMap;
use throng_draw::{Color, Theme};

/// Every picture: the name of its scene, and its file.
const FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/thumbnails.rs"));

/// Pictures that have been looked at.
#[derive(Default)]
pub struct Thumbnails {
    textures: BTreeMap<(&'static str, bool), Option<TextureHandle>>,
}

impl Thumbnails {
    /// The picture of a scene, for panels as dark as these; `None` if there is none.
    pub fn of(&mut self, name: &'static str, ctx: &Context) -> Option<&TextureHandle> {
        let dark = ctx.global_style().visuals.dark_mode;
        let unpack = || {
            let mut image = image(name)?;
            if dark {
                image.pixels.iter_mut().for_each(|pixel| *pixel = darkened(*pixel));
            }
            Some(ctx.load_texture(name, image, TextureOptions::LINEAR))
        };
        self.textures.entry((name, dark)).or_insert_with(unpack).as_ref()
    }
}

/// A colour of pictures on light ground as one of those on dark ground: as far from the ground to the type, with its own hue.
fn darkened(color: Color32) -> Color32 {
    let channels = |color: Color| [color.r, color.g, color.b].map(f32::from);
    let luma = |[r, g, b]: [f32; 3]| 0.299 * r + 0.587 * g + 0.114 * b;
    let [light, dark] = [Theme::light(), Theme::dark()].map(|theme| [channels(theme.ground), channels(theme.text)]);
    let from = [color.r(), color.g(), color.b()].map(f32::from);
    let part = (luma(from) - luma(light[0])) / (luma(light[1]) - luma(light[0]));
    let gray = |[ground, text]: [[f32; 3]; 2], k: usize| ground[k] + (text[k] - ground[k]) * part;
    // a cast keeps within 0 to 255
    let [r, g, b] = [0, 1, 2].map(|k| (from[k] - gray(light, k) + gray(dark, k)).round() as u8);
    Color32::from_rgb(r, g, b)
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
    fn light_ground_becomes_dark_ground_and_blue_stays_blue() {
        let (light, dark) = (Theme::light(), Theme::dark());
        for (from, to) in [(light.ground, dark.ground), (light.text, dark.text)] {
            let got = darkened(crate::style::color(from));
            let off = [(got.r(), to.r), (got.g(), to.g), (got.b(), to.b)].map(|(a, b)| a.abs_diff(b));
            assert!(off.into_iter().all(|off| off < 2), "{from:?} became {got:?}, not {to:?}");
        }
        let blue = darkened(crate::style::color(throng_draw::PALETTE[0]));
        assert!(blue.b() > blue.g() && blue.g() > blue.r());
    }

    #[test]
    fn every_scene_of_the_gallery_has_a_picture() {
        let missing: Vec<_> = throng_scene::gallery::names().filter(|name| image(name).is_none()).collect();
        assert!(missing.is_empty(), "cargo run -p throng-studio --example thumbnails -- {}", missing.join(" "));
    }
}

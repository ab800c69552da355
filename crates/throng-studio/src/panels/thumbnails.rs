//! The thumbnails of the gallery. They are fetched when they first become visible. Thumbnails of plug-in scenes are
//! rendered instead.

use crate::document::Document;
use eframe::egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use throng_draw::{Color, Painter, Style, Theme};
use throng_record::{Frame, moment};
use throng_scene::{Plugins, caught, gallery};

/// The size of a rendered thumbnail, pixels, equal to the size of the files.
const SIZE: (u32, u32) = (216, 144);

/// The thumbnails that have been visible.
#[derive(Default)]
pub struct Thumbnails {
    pictures: [BTreeMap<String, Thumbnail>; 2],
}

enum Thumbnail {
    /// The file is being fetched.
    Coming(Receiver<Vec<u8>>),
    /// The texture, or `None` if the scene has no thumbnail.
    Here(Option<TextureHandle>),
}

impl Thumbnails {
    /// Returns the thumbnail of a scene in the theme of the panels, `None` if there is none or not yet.
    pub fn of(&mut self, name: &str, plugins: &Arc<Plugins>, ctx: &Context) -> Option<&TextureHandle> {
        let dark = ctx.global_style().visuals.dark_mode;
        let pictures = &mut self.pictures[usize::from(dark)];
        let texture = |mut image: ColorImage| {
            if dark {
                image.pixels.iter_mut().for_each(|pixel| *pixel = darkened(*pixel));
            }
            ctx.load_texture(name, image, TextureOptions::LINEAR)
        };
        if !pictures.contains_key(name) {
            let own = plugins.text(name) != gallery::text(name);
            let picture = if own {
                Thumbnail::Here(beginning(name, plugins).map(texture))
            } else {
                Thumbnail::Coming(crate::outside::thumbnail(name, ctx))
            };
            pictures.insert(name.to_owned(), picture);
        }
        let picture = pictures.get_mut(name)?;
        if let Thumbnail::Coming(coming) = picture
            && let Ok(file) = coming.try_recv()
        {
            *picture = Thumbnail::Here(image(&file).map(texture));
        }
        match picture {
            Thumbnail::Here(texture) => texture.as_ref(),
            Thumbnail::Coming(_) => None,
        }
    }
}

/// Maps a colour of the light theme to the dark theme. The hue stays, and the luma keeps its relative position between
/// ground and text.
fn darkened(color: Color32) -> Color32 {
    let channels = |color: Color| [color.r, color.g, color.b].map(f32::from);
    let luma = |[r, g, b]: [f32; 3]| 0.299 * r + 0.587 * g + 0.114 * b;
    let [light, dark] = [Theme::light(), Theme::dark()].map(|theme| [channels(theme.ground), channels(theme.text)]);
    let from = [color.r(), color.g(), color.b()].map(f32::from);
    let part = (luma(from) - luma(light[0])) / (luma(light[1]) - luma(light[0]));
    let gray = |[ground, text]: [[f32; 3]; 2], k: usize| ground[k] + (text[k] - ground[k]) * part;
    // the cast saturates to 0..=255
    let [r, g, b] = [0, 1, 2].map(|k| (from[k] - gray(light, k) + gray(dark, k)).round() as u8);
    Color32::from_rgb(r, g, b)
}

/// Renders the first moment of a scene, `None` if it cannot be built.
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

fn image(file: &[u8]) -> Option<ColorImage> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(file));
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
        let there = |name: &str| image(&crate::outside::thumbnail(name, &Context::default()).try_recv().ok()?);
        let missing: Vec<_> = gallery::names().filter(|name| there(name).is_none()).collect();
        assert!(missing.is_empty(), "cargo run -p throng-studio --example thumbnails -- {}", missing.join(" "));
    }
}

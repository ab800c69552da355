//! Where fields are to be seen: on the ground, not under what stands on it.

use crate::text::Type;
use crate::{Camera, Color, Image, Theme, place, raster};
use glam::Vec2;
use throng_record::Setting;

/// Black and white.
const FREE: Color = Color::rgb(0xff_ffff);
const TAKEN: Color = Color::rgb(0);

/// A bit for each pixel.
#[derive(Clone, Debug)]
pub(super) struct Mask {
    width: usize,
    height: usize,
    free: Vec<bool>,
}

impl Mask {
    /// The pixels that show the floor of a place, and nothing solid.
    pub fn new((width, height): (u32, u32), setting: &Setting, camera: &Camera, unit: f32) -> Self {
        // the place itself, in two colours
        let theme = Theme { ground: FREE, obstacle: TAKEN, edge: TAKEN, ..Theme::light() };
        let mut image = Image::new(width, height, if setting.walkable.is_empty() { FREE } else { TAKEN });
        let mut marks = place::floor(setting, &theme, camera, unit);
        marks.extend(place::solids(setting, &theme, camera, unit));
        raster::draw(&mut image, &mut Type::new(), &marks);
        let free = image.data().chunks_exact(4).map(|pixel| pixel[0] >= 128).collect();
        Self { width: width as usize, height: height as usize, free }
    }

    /// Whether a field is to be seen at a pixel; beyond the picture it is not.
    pub fn at(&self, pixel: Vec2) -> bool {
        // `as` takes what is below zero to zero, where the comparison has it
        let (x, y) = (pixel.x as usize, pixel.y as usize);
        pixel.x >= 0.0 && pixel.y >= 0.0 && x < self.width && y < self.height && self.free[y * self.width + x]
    }
}

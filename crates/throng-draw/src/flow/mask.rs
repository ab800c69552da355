//! The mask of fields: the ground without the solids on it.

use crate::text::{Type, Typeface};
use crate::{Camera, Color, Image, Theme, place, raster};
use glam::Vec2;
use throng_record::Setting;

/// Black and white.
const FREE: Color = Color::rgb(0xff_ffff);
const TAKEN: Color = Color::rgb(0);

/// One bit per pixel.
#[derive(Clone, Debug)]
pub(super) struct Mask {
    width: usize,
    height: usize,
    free: Vec<bool>,
    /// `free` and its neighbouring pixels. Layers that fill these pixels leave no gap at the antialiased rims of
    /// solids.
    rims: Vec<bool>,
}

impl Mask {
    /// Marks the pixels that show the floor of a place without solids.
    pub fn new((width, height): (u32, u32), setting: &Setting, camera: &Camera, unit: f32) -> Self {
        // The place itself, drawn in two colours.
        let theme = Theme { ground: FREE, obstacle: TAKEN, edge: TAKEN, ..Theme::light() };
        let mut image = Image::new(width, height, if setting.walkable.is_empty() { FREE } else { TAKEN });
        let mut marks = place::floor(setting, &theme, camera, unit);
        marks.extend(place::solids(setting, &theme, camera, unit));
        raster::draw(&mut image, &mut Type::of(&Typeface::default()), &marks);
        let free: Vec<bool> = image.data().chunks_exact(4).map(|pixel| pixel[0] >= 128).collect();
        let (width, height) = (width as usize, height as usize);
        let mut rims = free.clone();
        for (row, near) in rims.chunks_exact_mut(width).enumerate() {
            for (column, near) in near.iter_mut().enumerate().filter(|(_, near)| !**near) {
                let (rows, columns) = (row.saturating_sub(1)..=row + 1, column.saturating_sub(1)..=column + 1);
                let rows = rows.filter(|&row| row < height);
                *near = rows
                    .flat_map(|row| columns.clone().filter(|&x| x < width).map(move |x| row * width + x))
                    .any(|at| free[at]);
            }
        }
        Self { width, height, free, rims }
    }

    /// Whether a field is visible at a pixel; false outside the picture.
    pub fn at(&self, pixel: Vec2) -> bool {
        self.index(pixel).is_some_and(|index| self.free[index])
    }

    /// Whether layers that fill pixels cover this pixel.
    pub fn fills(&self, pixel: Vec2) -> bool {
        self.index(pixel).is_some_and(|index| self.rims[index])
    }

    fn index(&self, pixel: Vec2) -> Option<usize> {
        // `as` maps negative numbers to 0; the comparison excludes them.
        let (x, y) = (pixel.x as usize, pixel.y as usize);
        (pixel.x >= 0.0 && pixel.y >= 0.0 && x < self.width && y < self.height).then(|| y * self.width + x)
    }
}

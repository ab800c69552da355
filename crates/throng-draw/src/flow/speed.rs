//! The speed of a field as a tone.

use super::Lay;
use crate::primitive::Primitive;
use crate::{Color, Image, Theme};
use glam::Vec2;

/// The stops of the ramp above the ground's own colour, slow to fast, on light and on dark ground. Lightness changes in
/// one direction, so that the ramp is readable without colour vision.
const ON_LIGHT: [Color; 3] = [Color::rgb(0xd0e4e0), Color::rgb(0x96c6cd), Color::rgb(0x5796b3)];
const ON_DARK: [Color; 3] = [Color::rgb(0x26474f), Color::rgb(0x357d7c), Color::rgb(0x8fc99b)];

/// Returns the tone of a speed relative to the fastest, 0 to 1.
pub(super) fn tone(part: f32, theme: &Theme) -> Color {
    let stops = if theme.is_dark() { ON_DARK } else { ON_LIGHT };
    let all = [theme.ground, stops[0], stops[1], stops[2]];
    let t = part.clamp(0.0, 1.0) * (all.len() - 1) as f32;
    let k = (t as usize).min(all.len() - 2);
    all[k].mix(all[k + 1], t - k as f32)
}

/// Returns the tones of all pixels.
pub(super) fn speed(lay: &Lay<'_>) -> Primitive {
    const STEPS: usize = 256;
    let tones: Vec<Color> = (0..STEPS).map(|k| tone(k as f32 / (STEPS - 1) as f32, lay.theme)).collect();
    let strength = lay.style.strength().min(1.0);
    let (width, height) = (lay.canvas.size.x as u32, lay.canvas.size.y as u32);
    let mut image = Image::new(width, height, lay.theme.ground.alpha(0.0));
    for (index, pixel) in image.data_mut().chunks_exact_mut(4).enumerate() {
        let (x, y) = (index % width as usize, index / width as usize);
        let at = Vec2::new(x as f32, y as f32) + 0.5;
        let flow = lay.grid.at(at);
        if flow != Vec2::ZERO && lay.canvas.free.fills(at) {
            let Color { r, g, b, .. } = tones[(lay.part(flow) * (STEPS - 1) as f32) as usize];
            // Where two fields overlap, both stay visible.
            let share = if lay.turn.0 > 0 { 0.5 } else { 1.0 };
            pixel.copy_from_slice(&[r, g, b, (255.0 * strength * share) as u8]);
        }
    }
    Primitive::Pixels(image)
}

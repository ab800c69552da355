//! From linear light to the bytes of a picture.

use glam::Vec3;

/// The table from linear light to bytes has 256 steps for each doubling of the light, from 2⁻¹² to 2⁶: a step is the upper
/// bits of a number.
const DROPPED: u32 = 23 - 8;
const FIRST: u32 = (127 - 12) << 8;
const STEPS: usize = (6 + 12) << 8;

/// Returns the linear light of a colour in sRGB, `0xRRGGBB`.
///
/// ```
/// assert_eq!(throng_render::linear(0xff0000).x, 1.0);
/// assert!((throng_render::linear(0x808080).y - 0.216).abs() < 1e-3);
/// ```
pub fn linear(srgb: u32) -> Vec3 {
    let channel = |shift: u32| {
        let value = ((srgb >> shift) & 255) as f32 / 255.0;
        if value <= 0.04045 { value / 12.92 } else { libm::powf((value + 0.055) / 1.055, 2.4) }
    };
    Vec3::new(channel(16), channel(8), channel(0))
}

/// The conversion of linear light to bytes: exposure, a curve that keeps bright light apart, sRGB.
pub struct Tone {
    exposure: f32,
    bytes: Vec<u8>,
}

impl Tone {
    pub fn new(exposure: f32) -> Self {
        let byte = |step: usize| {
            let light = f32::from_bits((step as u32 + FIRST) << DROPPED | 1 << (DROPPED - 1));
            let value = curve(light);
            let srgb = if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * libm::powf(value, 1.0 / 2.4) - 0.055 };
            (srgb * 255.0 + 0.5) as u8
        };
        Self { exposure, bytes: (0..STEPS).map(byte).collect() }
    }

    /// Returns the bytes of a pixel, RGBA.
    pub fn pixel(&self, light: Vec3) -> [u8; 4] {
        let byte = |light: f32| {
            let bits = (light * self.exposure).max(0.0).to_bits() >> DROPPED;
            self.bytes[(bits.saturating_sub(FIRST) as usize).min(STEPS - 1)]
        };
        [byte(light.x), byte(light.y), byte(light.z), 255]
    }
}

/// The share of the curve that is a straight line.
const STRAIGHT: f32 = 0.55;

/// Returns light compressed to 0 to 1: unchanged up to `STRAIGHT`, and from there ever less, as film does (the
/// shoulder of ACES, without its darkening of shadows and its change of hues).
fn curve(light: f32) -> f32 {
    let light = light.max(0.0);
    if light <= STRAIGHT {
        return light;
    }
    let over = (light - STRAIGHT) / (1.0 - STRAIGHT);
    (STRAIGHT + (1.0 - STRAIGHT) * over / (1.0 + over)).min(1.0)
}

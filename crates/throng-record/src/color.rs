//! Colours that distinguish groups in pictures and in files.

/// The colours of groups and goals, in order: red, green and blue, sRGB. Their hues follow Okabe and Ito (2008), "Color
/// universal design". They are less saturated and spread in lightness, so that colour-blind viewers can distinguish
/// them.
pub const PALETTE: [[u8; 3]; 8] = [
    [0x38, 0x66, 0xb6], // blue
    [0xe3, 0x8c, 0x2e], // orange
    [0x21, 0xae, 0x76], // bluish green
    [0xaa, 0x65, 0x91], // reddish purple
    [0x9a, 0xb6, 0xe2], // sky blue
    [0x3e, 0x37, 0x49], // slate
    [0xda, 0xdc, 0x6e], // yellow
    [0xb6, 0x4c, 0x23], // vermilion
];

/// Returns the colour of the group or goal `index`: the palette, then the palette again in three paler rounds.
pub fn palette(index: usize) -> [u8; 3] {
    let pale = 0.25 * (index / PALETTE.len()).min(3) as f32;
    PALETTE[index % PALETTE.len()].map(|c| (f32::from(c) + (255.0 - f32::from(c)) * pale + 0.5) as u8)
}

/// Returns the same colour as linear light, 0 to 1, the unit of materials.
#[cfg(any(feature = "glb", feature = "usda"))]
pub(crate) fn linear(index: usize) -> [f32; 3] {
    palette(index).map(light)
}

/// Returns the linear light, 0 to 1, of a part of a colour (sRGB).
#[cfg(any(feature = "glb", feature = "usda"))]
pub(crate) fn light(part: u8) -> f32 {
    let part = f32::from(part) / 255.0;
    if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
}

/// Returns the part of a colour (sRGB) of linear light, 0 to 1.
#[cfg(feature = "glb")]
pub(crate) fn part(light: f32) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let part = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * libm::powf(light, 1.0 / 2.4) - 0.055 };
    (part * 255.0).round() as u8
}

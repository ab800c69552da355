//! Lamps at night: a pool of light on the ground below each, and a glow around it.

use super::Lens;
use super::light::light_of;
use crate::Color;
use crate::primitive::Primitive;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use throng_render::{Area, Material, Picture};

/// The colours of the light and of the bulb.
const LIGHT: Color = Color::rgb(0xff_d894);
const BULB: Color = Color::rgb(0xff_f6de);
/// The radius of the bulb, metres.
const RADIUS: f64 = 0.13;
/// The number of discs of a pool and of a glow, and the number of corners of a disc.
const DISCS: usize = 64;
const ROUND: usize = 48;
/// The opacity of the light straight below a lamp, and the radius of a pool, in heights of the lamp.
const POOL: f64 = 0.45;
const REACH: f64 = 1.7;
/// The opacity of the glow at the bulb, and its radius, in radii of the bulb.
const GLOW: f64 = 0.75;
const HALO: f64 = 16.0;

/// Returns the radii of discs from the largest to the smallest, as shares of the largest, and their opacities. One on the
/// other they have the opacity `light` of their radius.
fn discs(light: impl Fn(f64) -> f64) -> impl Iterator<Item = (f64, f32)> {
    let rim = light(1.0);
    let whole = move |share: f64| (light(share) - rim).max(0.0);
    // the light changes most in the middle, where discs are closest
    let share = |k: f64| (1.0 - k / DISCS as f64).powi(2);
    (0..DISCS).map(move |k| {
        let [outer, inner] = [k, k + 1].map(|k| whole(share(k as f64)));
        (share(k as f64 + 0.5), ((inner - outer) / (1.0 - outer)) as f32)
    })
}

/// Returns the pools of light on the ground. The light of a point falls on flat ground with the cube of the cosine of its
/// angle.
pub(super) fn pools(lamps: &[DVec3]) -> impl Iterator<Item = Area> {
    lamps.iter().filter(|lamp| lamp.is_finite() && lamp.z > 0.0).flat_map(|lamp| {
        let light = |share: f64| POOL / (1.0 + (share * REACH).powi(2)).powf(1.5);
        discs(light).map(|(share, opacity)| {
            let out = |k: usize| DVec2::from_angle(k as f64 * TAU / ROUND as f64) * (share * REACH * lamp.z);
            let ring = (0..ROUND).map(|k| lamp.truncate() + out(k)).collect();
            Area::new(&[ring], Material { opacity, ..Material::plain(light_of(LIGHT)) })
        })
    })
}

/// Returns the glows and the bulbs of the lamps that nothing hides.
pub(super) fn glows(lamps: &[DVec3], lens: &Lens, picture: &Picture) -> Vec<Primitive> {
    let glow = |lamp: &DVec3| {
        // the bulb does not hide itself
        let front = *lamp + (lens.eye - *lamp).normalize_or_zero() * (1.2 * RADIUS);
        let center = lens.pixel(*lamp).filter(|_| !picture.hides(front))?;
        let radius = (RADIUS * lens.scale(*lamp)) as f32;
        let light = |share: f64| GLOW / (1.0 + (share * HALO / 3.0).powi(2));
        let halo = discs(light).map(move |(share, opacity)| {
            let radius = radius * (share * HALO) as f32;
            Primitive::Disc { center, radius, fill: LIGHT.alpha(opacity) }
        });
        Some(halo.chain([Primitive::Disc { center, radius, fill: BULB }]))
    };
    lamps.iter().filter_map(glow).flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn discs_add_up_to_the_light_less_that_at_the_rim() {
        let light = |share: f64| 0.8 / (1.0 + 9.0 * share * share);
        for at in [0.05, 0.3, 0.6, 0.95] {
            let under = discs(light).filter(|(share, _)| *share > at);
            let clear: f64 = under.map(|(_, opacity)| 1.0 - f64::from(opacity)).product();
            assert!((1.0 - clear - (light(at) - light(1.0))).abs() < 0.02, "{} at {at}", 1.0 - clear);
        }
    }
}

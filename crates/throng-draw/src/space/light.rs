//! The light of pictures in perspective.

use crate::{Color, Style};
use glam::{DVec3, Vec3};
use throng_render::{Haze, Light, Sky, linear};

/// The angle from the direction of the viewpoint to the sun, which is to the left and behind the viewpoint, radians.
const ASIDE: f64 = -0.75;
/// The height of the sun above the horizon, radians: over people, because long shadows show steps; and over agents that
/// fly, because their shadows are then almost straight below them.
const AFTERNOON: f32 = 0.72;
const NOON: f32 = 1.2;
/// The distance of the haze, in distances of the farthest things.
const HAZE: f64 = 4.5;
/// The colours of the horizon and of the zenith, relative to the ground outside.
const HORIZON: Vec3 = Vec3::new(0.97, 1.0, 1.03);
const ZENITH: Vec3 = Vec3::new(0.5, 0.68, 0.95);

/// Where the sun is in pictures in perspective.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sun {
    /// The direction to the sun, seen from above, degrees from the axis x, counter-clockwise; `None` for the direction to
    /// the left behind the viewpoint.
    pub azimuth: Option<f64>,
    /// The height of the sun above the horizon, degrees; `None` for 41, or 69 if agents fly.
    pub height: Option<f64>,
}

/// Returns a colour as linear light.
pub(super) fn light_of(color: Color) -> Vec3 {
    linear(u32::from_be_bytes([0, color.r, color.g, color.b]))
}

/// Returns the light for a view in the direction `out` from the target to the viewpoint, of things up to `far` metres
/// away. Lit ground has the colour of the theme.
pub(super) fn light(style: &Style, out: DVec3, far: f64, flies: bool) -> Light {
    let usual = Light::default();
    let azimuth = style.sun.azimuth.map_or_else(|| libm::atan2(out.y, out.x) + ASIDE, f64::to_radians) as f32;
    let usual_height = if flies { NOON } else { AFTERNOON };
    let elevation = style.sun.height.map_or(usual_height, |height| height.to_radians() as f32);
    let sun = throng_render::Sun { azimuth, elevation, ..usual.sun };
    let ground = sun.color * sun.direction().z + usual.sky.light;
    let horizon = light_of(style.theme.outside) * HORIZON * ground.y;
    let sky = Sky { horizon, zenith: horizon * ZENITH, ..usual.sky };
    Light { sun, sky, haze: Haze { distance: style.haze.unwrap_or(HAZE * far) as f32 }, exposure: 1.0 / ground.y }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_is_where_the_scene_says() {
        let out = DVec3::new(0.0, -9.0, 4.0);
        let with = |sun: Sun, haze: Option<f64>| light(&Style { sun, haze, ..Style::default() }, out, 20.0, false);
        let usual = with(Sun::default(), None);
        assert!((usual.sun.elevation, usual.haze.distance) == (AFTERNOON, 90.0));
        let sun = Sun { azimuth: Some(90.0), height: Some(30.0) };
        let said = with(sun, Some(50.0));
        assert!(said.sun.direction().distance(Vec3::new(0.0, 0.75_f32.sqrt(), 0.5)) < 1e-6);
        assert_eq!(said.haze.distance, 50.0);
        let [low, high] = [&said, &usual]
            .map(|light| light.exposure * (light.sun.color * light.sun.direction().z + light.sky.light).y);
        assert!((low - high).abs() < 1e-6, "lit ground has its colour at any time of day");
    }
}

//! The light of pictures in perspective.

use crate::{Color, Theme};
use glam::{DVec3, Vec3};
use throng_render::{Haze, Light, Sky, Sun, linear};

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

/// Returns a colour as linear light.
pub(super) fn light_of(color: Color) -> Vec3 {
    linear(u32::from_be_bytes([0, color.r, color.g, color.b]))
}

/// Returns the light for a view in the direction `out` from the target to the viewpoint, of things up to `far` metres
/// away. Lit ground has the colour of the theme.
pub(super) fn light(theme: &Theme, out: DVec3, far: f64, flies: bool) -> Light {
    let usual = Light::default();
    let azimuth = (libm::atan2(out.y, out.x) + ASIDE) as f32;
    let sun = Sun { azimuth, elevation: if flies { NOON } else { AFTERNOON }, ..usual.sun };
    let ground = sun.color * sun.direction().z + usual.sky.light;
    let horizon = light_of(theme.outside) * HORIZON * ground.y;
    let sky = Sky { horizon, zenith: horizon * ZENITH, ..usual.sky };
    Light { sun, sky, haze: Haze { distance: (HAZE * far) as f32 }, exposure: 1.0 / ground.y }
}

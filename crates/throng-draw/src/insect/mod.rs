//! Insects: a thin body between two translucent, beating wings, in any projection. The wings of large insects are blurred
//! fans, as eyes and cameras see them.

mod streak;

pub(crate) use streak::{lay, streak};

use crate::Color;
use crate::flow::lot;
use crate::image::{Image, blend};
use crate::look::Coat;
use crate::projector::Projector;
use glam::{DVec2, Vec2, Vec3};
use std::f32::consts::{PI, TAU};
use throng::motion::Basis;
use throng_record::Body;

/// Coordinates (forward, to the side, up) in radii of the body: head, tail, root of the wings, and tip of a level wing.
const HEAD: f32 = 1.0;
const TAIL: f32 = -1.15;
const ROOT: f32 = 0.25;
const TIP: Vec2 = Vec2::new(-0.25, 1.5);
/// Half the width of a wing and of the body, in radii.
const CHORD: f32 = 0.46;
const WAIST: f32 = 0.17;
/// The amplitude of wing beats, radians; the mean frequency, 1/s; and the relative spread of frequencies.
const BEAT: f32 = 0.95;
const RATE: f32 = 9.0;
const OWN: f32 = 0.3;
/// The angle above level about which wings beat, radians.
const RAISED: f32 = 0.15;
/// The opacity of a wing; of the parts of a blurred wing together; and of the place of a blurred wing at the moment.
const OPACITY: f32 = 0.5;
const BLURRED: f32 = 0.75;
const GLINT: f32 = 0.14;
/// The parts of a blurred wing, at equal times from the lowest to the highest angle.
const PARTS: usize = 7;
/// The radii between which wings blur in perspective, pixels.
const BLUR: [f32; 2] = [5.0, 8.0];
/// The least radius of insects, in units of the layout.
const LEAST_RADIUS: f32 = 2.4;
/// With more insects than this, each is drawn smaller and paler.
const MANY: f32 = 500.0;

/// How insects are drawn in a swarm, by the size of the swarm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crowd {
    /// The least radius, pixels.
    pub least: f32,
    /// The factor of the opacity of streaks and shadows, 0 to 1.
    pub left: f32,
}

impl Crowd {
    /// Returns the values for `count` insects.
    pub fn of(count: usize, unit: f32) -> Self {
        let share = (MANY / count as f32).min(1.0);
        Self { least: LEAST_RADIUS * unit * share.powf(0.25).max(0.45), left: share.sqrt().max(0.15) }
    }
}

/// An insect, in pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Insect {
    pub head: Vec2,
    pub tail: Vec2,
    /// The root of the wings.
    pub root: Vec2,
    pub wings: Vec<Wing>,
    /// Half the width of the body.
    pub waist: f32,
    pub body: Color,
}

/// A wing at a moment of its beat, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wing {
    pub tip: Vec2,
    /// Half the width.
    pub chord: f32,
    /// The colour, with its opacity.
    pub color: Color,
}

/// Returns the angle of an insect's wings above level at a time, radians. Frequencies differ between insects.
fn beat(number: u32, time: f64) -> f32 {
    let rate = RATE * (1.0 + OWN * (lot(number, 1) - 0.5));
    // Only the fraction of a turn is kept, so that long times keep their precision.
    let turns = (time * f64::from(rate) + f64::from(lot(number, 2))).fract() as f32;
    RAISED + BEAT * (TAU * turns).sin()
}

impl Insect {
    /// Returns a body as an insect, enlarged by `growth`; `None` if it is not visible.
    pub fn of(body: &Body, growth: f32, coat: Coat, projector: &Projector, time: f64) -> Option<Self> {
        let upright = || Basis::facing(DVec2::from_angle(f64::from(body.heading)).as_vec2().extend(0.0));
        let basis = body.basis.unwrap_or_else(upright);
        let (center, size) = (body.center(), body.radius * growth);
        let pixel = |local: Vec3| {
            let offset = basis.forward * local.x + basis.side * local.y + basis.up * local.z;
            projector.pixel(center + (offset * size).as_dvec3()).filter(|pixel| pixel.is_finite())
        };
        let scale = size * projector.scale(center) as f32;
        let sight = projector.sight(center).as_vec3();
        let color = coat.fill.mix(coat.rim, 0.12);
        let wing = |aside: f32, angle: f32, opacity: f32| {
            let (sin, cos) = angle.sin_cos();
            let tip = pixel(Vec3::new(TIP.x, aside * TIP.y * cos, TIP.y * sin))?;
            // A wing seen edge-on is thin.
            let normal = basis.up * cos - basis.side * (aside * sin);
            let chord = CHORD * scale * (0.3 + 0.7 * normal.dot(sight).abs());
            Some(Wing { tip, chord, color: color.alpha(opacity) })
        };
        let now = beat(body.number, time);
        // a plan is a diagram, in which wings beat visibly
        let space = matches!(projector, Projector::Perspective(_));
        let blur = if space { ((scale - BLUR[0]) / (BLUR[1] - BLUR[0])).clamp(0.0, 1.0) } else { 0.0 };
        let sides = |angle: f32, opacity: f32| [1.0, -1.0].map(|aside| wing(aside, angle, opacity));
        let mut wings: Vec<Option<Wing>> = Vec::new();
        if blur > 0.0 {
            // several thin parts cover as much as one of this opacity
            let thin = 1.0 - libm::powf(1.0 - BLURRED * blur, 1.0 / PARTS as f32);
            for part in 0..PARTS {
                let share = part as f32 / (PARTS - 1) as f32 - 0.5;
                wings.extend(sides(RAISED + BEAT * libm::sinf(PI * share), thin));
            }
        }
        wings.extend(sides(now, OPACITY + (GLINT - OPACITY) * blur));
        Some(Self {
            head: pixel(Vec3::X * HEAD)?,
            tail: pixel(Vec3::X * TAIL)?,
            root: pixel(Vec3::X * ROOT)?,
            wings: wings.into_iter().collect::<Option<_>>()?,
            waist: WAIST * scale,
            body: coat.fill.mix(coat.rim, 0.55),
        })
    }

    /// Draws the insect on a picture.
    pub fn draw(&self, image: &mut Image) {
        let points = || [self.head, self.tail, self.root].into_iter().chain(self.wings.iter().map(|wing| wing.tip));
        let reach = self.wings.iter().map(|wing| wing.chord).fold(self.waist, f32::max) + 1.0;
        let low = points().fold(Vec2::INFINITY, Vec2::min) - reach;
        let high = points().fold(Vec2::NEG_INFINITY, Vec2::max) + reach;
        let (width, height) = (image.width() as usize, image.height() as usize);
        // `as` maps negative numbers to 0.
        let (columns, rows) =
            (low.x as usize..(high.x as usize + 1).min(width), low.y as usize..(high.y as usize + 1).min(height));
        if !(low.is_finite() && high.is_finite()) || columns.is_empty() || rows.is_empty() {
            return;
        }
        let blade = |wing: &Wing| (Blade::new(self.root, wing.tip, wing.chord), wing.color);
        let wings: Vec<(Blade, Color)> = self.wings.iter().map(blade).collect();
        let body = [self.body.r, self.body.g, self.body.b];
        let trunk = Blade::new(self.tail, self.head, self.waist);
        for y in rows {
            let first = (y * width + columns.start) * 4;
            let row = &mut image.data_mut()[first..first + columns.len() * 4];
            for (x, pixel) in columns.clone().zip(row.chunks_exact_mut(4)) {
                let at = Vec2::new(x as f32, y as f32) + 0.5;
                for (blade, color) in &wings {
                    let cover = blade.leaf(at);
                    if cover > 0.0 {
                        let wing = [color.r, color.g, color.b];
                        blend(&mut pixel[..3], wing, (cover * f32::from(color.a) + 0.5) as u32);
                    }
                }
                let cover = trunk.rod(at);
                if cover > 0.0 {
                    blend(&mut pixel[..3], body, (cover * f32::from(self.body.a) * (256.0 / 255.0) + 0.5) as u32);
                }
            }
        }
    }
}

/// A line segment with a width.
#[derive(Clone, Copy, Debug)]
struct Blade {
    from: Vec2,
    along: Vec2,
    /// 1 over the squared length; 0 for a segment without length.
    unit: f32,
    half: f32,
}

impl Blade {
    fn new(from: Vec2, to: Vec2, half: f32) -> Self {
        let along = to - from;
        let length2 = along.length_squared();
        Self { from, along, unit: if length2 > 1e-6 { 1.0 / length2 } else { 0.0 }, half }
    }

    /// Returns the position of a pixel along the segment, 0 to 1, and its distance from the segment.
    fn place(&self, at: Vec2) -> (f32, f32) {
        let offset = at - self.from;
        let part = (offset.dot(self.along) * self.unit).clamp(0.0, 1.0);
        (part, (offset - self.along * part).length())
    }

    /// Returns the coverage of a pixel by a rod of constant width with round ends. Rods thinner than a pixel cover
    /// less.
    fn rod(&self, at: Vec2) -> f32 {
        let (_, off) = self.place(at);
        let half = self.half.max(0.55);
        (half + 0.5 - off).clamp(0.0, 1.0)
    }

    /// Returns the coverage of a pixel by a leaf: thin at the root, widest beyond the middle.
    fn leaf(&self, at: Vec2) -> f32 {
        let (part, off) = self.place(at);
        let half = (self.half * (part * (2.6 - 1.9 * part * part)).max(0.0)).max(0.3);
        (half + 0.5 - off).clamp(0.0, 1.0).min(2.0 * half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wing_beats_are_reproducible_and_out_of_step() {
        for number in [0, 7, 90_000] {
            let angles: Vec<f32> = (0..100).map(|k| beat(number, f64::from(k) * 0.013)).collect();
            let (low, high) = angles.iter().fold((1.0f32, 0.0f32), |(low, high), &a| (low.min(a), high.max(a)));
            assert!(low < -0.7 && high > 1.0, "{low} to {high}");
            assert_eq!(beat(number, 1e6), beat(number, 1e6));
        }
        let phases: Vec<f32> = (0..200).map(|number| beat(number, 3.0)).collect();
        let up = phases.iter().filter(|angle| **angle > 0.15).count();
        assert!((70..130).contains(&up), "{up} of 200 wings are up");
    }
}

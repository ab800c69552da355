//! Where agents have been: the last seconds of each, and the layer they are drawn on.

use crate::Color;
use crate::image::{Image, blend};
use glam::{DVec2, Vec2};
use std::collections::{BTreeMap, VecDeque};
use throng_record::Frame;

/// An agent that is further away than this from where it just was has been moved, metres.
const JUMP: f64 = 3.0;

/// The last seconds of one agent.
#[derive(Clone, Debug, Default)]
pub(crate) struct Track {
    /// When and where, oldest first.
    pub points: VecDeque<(f64, DVec2)>,
    /// Its colour when it was last seen.
    pub color: Option<Color>,
    /// Its radius, metres.
    pub radius: f32,
}

/// The last seconds of everybody, by number.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trails {
    pub tracks: BTreeMap<u32, Track>,
    last: f64,
}

impl Trails {
    /// Remembers where everybody is. Points nearer together than `spacing` metres are one; what is older than
    /// `seconds` is forgotten. Time that runs backwards starts anew.
    pub(crate) fn follow(&mut self, frame: &Frame, seconds: f64, spacing: f64, colors: impl Fn(usize) -> Color) {
        if frame.time < self.last {
            self.tracks.clear();
        }
        self.last = frame.time;
        if seconds <= 0.0 {
            return;
        }
        for (k, body) in frame.bodies.iter().enumerate() {
            if !body.position.is_finite() {
                continue;
            }
            let track = self.tracks.entry(body.number).or_default();
            (track.color, track.radius) = (Some(colors(k)), body.radius);
            let points = &mut track.points;
            if points.back().is_some_and(|p| p.1.distance(body.position) > JUMP.max(10.0 * spacing)) {
                points.clear();
            }
            // The newest point moves along until it is far enough from the one before it.
            let n = points.len();
            if n >= 2 && points[n - 2].1.distance(body.position) < spacing {
                points[n - 1] = (frame.time, body.position);
            } else {
                points.push_back((frame.time, body.position));
            }
        }
        let oldest = frame.time - seconds;
        self.tracks.retain(|_, track| {
            // One point older than the trail stays, so that its tail shrinks smoothly.
            while track.points.len() > 1 && track.points[1].0 <= oldest {
                track.points.pop_front();
            }
            track.points.back().is_some_and(|p| p.0 > oldest)
        });
    }
}

/// How far along its fading a point of age `age` is: 1 new, 0 gone.
pub(crate) fn freshness(age: f64, seconds: f64) -> f32 {
    let left = (1.0 - age / seconds).clamp(0.0, 1.0) as f32;
    left * left.sqrt()
}

/// A layer that keeps, for each pixel, the strongest trail over it: crossings and joints do not add up.
#[derive(Clone, Debug)]
pub(crate) struct TrailLayer {
    width: i32,
    height: i32,
    /// Opacity in the top byte, then red, green, blue.
    pixels: Vec<u32>,
    /// Rows that something was drawn on.
    rows: std::ops::Range<usize>,
}

impl TrailLayer {
    pub(crate) fn new(width: u32, height: u32) -> Self {
        let pixels = vec![0; width as usize * height as usize];
        Self { width: width as i32, height: height as i32, pixels, rows: 0..0 }
    }

    /// A piece of a trail between two pixels, with half widths and opacities (0 to 1) at its ends.
    pub(crate) fn piece(&mut self, a: (Vec2, f32, f32), b: (Vec2, f32, f32), color: Color) {
        let along = b.0 - a.0;
        let length2 = along.length_squared();
        let reach = a.1.max(b.1) + 0.5;
        let (low, high) = (a.0.min(b.0) - reach, a.0.max(b.0) + reach);
        if !(length2.is_finite() && low.is_finite()) || length2 == 0.0 {
            return;
        }
        let y0 = ((low.y - 0.5).ceil().max(0.0)) as i32;
        let y1 = ((high.y - 0.5).floor().min((self.height - 1) as f32)) as i32;
        let x0 = ((low.x - 0.5).ceil().max(0.0)) as i32;
        let x1 = ((high.x - 0.5).floor().min((self.width - 1) as f32)) as i32;
        if y0 > y1 || x0 > x1 {
            return;
        }
        self.rows = if self.rows.is_empty() {
            y0 as usize..y1 as usize + 1
        } else {
            self.rows.start.min(y0 as usize)..self.rows.end.max(y1 as usize + 1)
        };
        let rgb = u32::from(color.r) << 16 | u32::from(color.g) << 8 | u32::from(color.b);
        for y in y0..=y1 {
            let row = (y * self.width) as usize;
            for x in x0..=x1 {
                let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - a.0;
                let t = (p.dot(along) / length2).clamp(0.0, 1.0);
                let half = a.1 + (b.1 - a.1) * t;
                let cover = (half + 0.5 - p.distance(along * t)).clamp(0.0, 1.0).min(2.0 * half);
                let opacity = (cover * (a.2 + (b.2 - a.2) * t) * 255.0) as u32;
                let pixel = &mut self.pixels[row + x as usize];
                if opacity > *pixel >> 24 {
                    *pixel = opacity << 24 | rgb;
                }
            }
        }
    }

    /// Lays the layer over the picture and clears it.
    pub(crate) fn lay(&mut self, image: &mut Image) {
        let width = self.width as usize;
        let span = self.rows.start * width..self.rows.end * width;
        let under = &mut image.data_mut()[span.start * 4..span.end * 4];
        for (pixel, trail) in under.chunks_exact_mut(4).zip(&mut self.pixels[span]) {
            if *trail != 0 {
                let [opacity, r, g, b] = trail.to_be_bytes();
                blend(pixel, [r, g, b], u32::from(opacity) + u32::from(opacity >> 7));
                *trail = 0;
            }
        }
        self.rows = 0..0;
    }
}

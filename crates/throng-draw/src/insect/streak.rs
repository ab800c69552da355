//! Streaks: motion blur of a body while the shutter is open.

use super::Crowd;
use crate::Color;
use crate::image::{Image, blend};
use crate::projector::Projector;
use crate::trail::{AgentTrail, End, Trail};
use glam::DVec3;
use throng_record::Body;

/// The outer fading distance of a streak relative to its half width, and the least fading distance, pixels.
const SOFT: f32 = 1.6;
const LEAST: f32 = 1.0;

/// The light of the newest end of a streak, and its half width relative to the radius of the body.
const LIGHT: f32 = 0.42;
const HALF: f32 = 0.42;

/// Returns the recorded way of a body as a streak that fades towards its older end. Without recorded points, the way
/// follows from the velocity. `(now, seconds)` are the time and the exposure time.
pub(crate) fn streak(
    track: &AgentTrail,
    body: &Body,
    color: Color,
    projector: &Projector,
    (now, seconds): (f64, f64),
    crowd: Crowd,
) -> Option<Trail> {
    let end = |(time, point): (f64, DVec3)| {
        let fresh = (1.0 - (now - time) / seconds).clamp(0.0, 1.0) as f32;
        let radius = (f64::from(body.radius) * projector.scale(point)).max(f64::from(crowd.least)) as f32;
        let opacity = LIGHT * crowd.left.sqrt() * fresh * (1.0 - projector.haze(point));
        Some(End { at: projector.pixel(point)?, half: HALF * radius * (0.4 + 0.6 * fresh), opacity })
    };
    let ends: Option<Vec<End>> = if track.points.len() > 1 {
        // The oldest end is the position at which the shutter opened.
        let opened = now - seconds;
        let cut = |k: usize| {
            let (time, point) = track.points[k];
            match track.points.get(k + 1) {
                Some(&(next, to)) if time < opened && next > time => {
                    (opened, point.lerp(to, (opened - time) / (next - time)))
                }
                _ => (time, point),
            }
        };
        (0..track.points.len()).map(cut).map(end).collect()
    } else {
        let (place, way) = (body.center(), body.velocity.extend(body.vertical_velocity).as_dvec3() * seconds);
        [(now - seconds, place - way), (now, place)].into_iter().map(end).collect()
    };
    Some(Trail { ends: ends?, color })
}

/// A layer in which streaks add up.
#[derive(Clone, Debug)]
pub(crate) struct StreakLayer {
    width: usize,
    height: usize,
    /// Red, green and blue, each multiplied by the light, followed by the light.
    film: Vec<[f32; 4]>,
    /// The rows with any light.
    rows: std::ops::Range<usize>,
}

/// Draws streaks on a picture.
pub(crate) fn lay(streaks: &[Trail], image: &mut Image) {
    let mut layer = StreakLayer::new(image.width(), image.height());
    streaks.iter().for_each(|streak| layer.draw(streak));
    layer.lay(image);
}

impl StreakLayer {
    pub fn new(width: u32, height: u32) -> Self {
        let (width, height) = (width as usize, height as usize);
        Self { width, height, film: vec![[0.0; 4]; width * height], rows: 0..0 }
    }

    /// Adds a streak.
    pub fn draw(&mut self, streak: &Trail) {
        let color = [streak.color.r, streak.color.g, streak.color.b].map(f32::from);
        for pair in streak.ends.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let along = b.at - a.at;
            let length2 = along.length_squared();
            let reach = (a.half.max(b.half) * SOFT).max(LEAST);
            let (low, high) = (a.at.min(b.at) - reach, a.at.max(b.at) + reach);
            if !(length2.is_finite() && low.is_finite()) || length2 == 0.0 {
                continue;
            }
            // `as` maps negative numbers to 0.
            let rows = low.y as usize..((high.y.max(-1.0) + 1.0) as usize).min(self.height);
            let columns = low.x as usize..((high.x.max(-1.0) + 1.0) as usize).min(self.width);
            if rows.is_empty() || columns.is_empty() {
                continue;
            }
            let known = if self.rows.is_empty() { rows.clone() } else { self.rows.clone() };
            self.rows = known.start.min(rows.start)..known.end.max(rows.end);
            let unit = along / length2;
            for y in rows {
                let dy = y as f32 + 0.5 - a.at.y;
                let first = y * self.width + columns.start;
                for (x, film) in columns.clone().zip(&mut self.film[first..first + columns.len()]) {
                    let dx = x as f32 + 0.5 - a.at.x;
                    let part = dx * unit.x + dy * unit.y;
                    // Segments meet end to end: pixels beyond an end belong to the next segment.
                    if !(0.0..1.0).contains(&part) {
                        continue;
                    }
                    let off2 = (dx - along.x * part).powi(2) + (dy - along.y * part).powi(2);
                    let wide = ((a.half + (b.half - a.half) * part) * SOFT).max(LEAST);
                    let left = 1.0 - off2 / (wide * wide);
                    if left > 0.0 {
                        let light = left * left * (a.opacity + (b.opacity - a.opacity) * part);
                        *film = [
                            film[0] + light * color[0],
                            film[1] + light * color[1],
                            film[2] + light * color[2],
                            film[3] + light,
                        ];
                    }
                }
            }
        }
    }

    /// Draws the layer on a picture; the coverage saturates with increasing light.
    pub fn lay(self, image: &mut Image) {
        let span = self.rows.start * self.width..self.rows.end * self.width;
        let under = &mut image.data_mut()[span.start * 4..span.end * 4];
        for (pixel, [r, g, b, light]) in under.chunks_exact_mut(4).zip(&self.film[span]) {
            if *light > 0.0 {
                let color = [r, g, b].map(|channel| (channel / light) as u8);
                // An approximation of 1 - exp(-x), within 0.03.
                let cover = 1.0 - 1.0 / (1.0 + light + 0.5 * light * light);
                blend(&mut pixel[..3], color, (cover * 256.0) as u32);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    fn streak(from: (f32, f32), to: (f32, f32), opacity: f32) -> Trail {
        let end = |at: (f32, f32), opacity| End { at: Vec2::from(at), half: 1.5, opacity };
        Trail { ends: vec![end(from, 0.0), end(to, opacity)], color: Color::rgb(0) }
    }

    fn shade(streaks: &[Trail], x: u32) -> u8 {
        let mut image = Image::new(60, 20, Color::rgb(0xff_ffff));
        lay(streaks, &mut image);
        image.pixel(x, 10).r
    }

    #[test]
    fn streaks_fade_to_their_tails_and_add_up() {
        let one = streak((5.0, 10.5), (50.0, 10.5), 0.5);
        let along: Vec<u8> = [8, 20, 30, 40, 48].map(|x| shade(std::slice::from_ref(&one), x)).to_vec();
        assert!(along.is_sorted_by(|a, b| a > b), "{along:?}");
        let many: Vec<u8> = (1..6).map(|count| shade(&vec![one.clone(); count], 40)).collect();
        assert!(many.is_sorted_by(|a, b| a > b) && many[4] < 90, "{many:?}");
    }

    #[test]
    fn segments_of_one_streak_meet_without_a_seam() {
        let whole = streak((5.0, 10.5), (50.0, 10.5), 0.6);
        let end = |k: usize| End { at: Vec2::new(5.0 + 9.0 * k as f32, 10.5), half: 1.5, opacity: 0.12 * k as f32 };
        let pieces = Trail { ends: (0..6).map(end).collect(), color: Color::rgb(0) };
        for x in 6..49 {
            let (a, b) = (shade(std::slice::from_ref(&whole), x), shade(std::slice::from_ref(&pieces), x));
            assert!(a.abs_diff(b) <= 1, "{a} and {b} at {x}");
        }
    }
}

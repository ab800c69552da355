//! Trails: the last seconds of each agent, and the layer they are drawn in.

use crate::Color;
use crate::image::{Image, blend};
use crate::projector::Projector;
use glam::{DVec3, Vec2};
use std::collections::{BTreeMap, VecDeque};
use throng_record::{Body, Frame};

/// The distance between two moments above which an agent counts as relocated, metres.
const JUMP: f64 = 3.0;

/// The opacity of a trail at the agent.
const OPACITY: f32 = 0.5;
/// Half the width of a trail at the agent, in radii of the body.
const HALF_WIDTH: f32 = 0.42;

/// The last seconds of an agent.
#[derive(Clone, Debug, Default)]
pub struct AgentTrail {
    /// Times and positions, oldest first.
    pub points: VecDeque<(f64, DVec3)>,
    /// The colour at the last moment.
    pub color: Option<Color>,
    /// The radius, metres.
    pub radius: f32,
}

/// The last seconds of all agents, by number.
#[derive(Clone, Debug, Default)]
pub struct Trails {
    /// The tracks of the agents.
    pub tracks: BTreeMap<u32, AgentTrail>,
    last: f64,
}

impl Trails {
    /// Returns the time of the last moment, seconds; 0 if there is none.
    pub fn last(&self) -> f64 {
        self.last
    }

    /// Adds the positions of a moment, for agents with a colour. Points nearer together than `spacing` metres are
    /// merged; points older than `seconds` are dropped. If time runs backwards, points after the moment are dropped.
    pub fn follow(&mut self, frame: &Frame, seconds: f64, spacing: f64, colors: impl Fn(&Body) -> Option<Color>) {
        if frame.time < self.last {
            for track in self.tracks.values_mut() {
                track.points.retain(|point| point.0 < frame.time);
            }
        }
        self.last = frame.time;
        if seconds <= 0.0 {
            return;
        }
        for body in frame.bodies.iter().filter(|body| body.position.is_finite()) {
            let Some(color) = colors(body) else { continue };
            let place = body.center();
            let track = self.tracks.entry(body.number).or_default();
            (track.color, track.radius) = (Some(color), body.shape().clearance_radius());
            let points = &mut track.points;
            if points.back().is_some_and(|p| p.1.distance(place) > JUMP.max(10.0 * spacing)) {
                points.clear();
            }
            // The newest point moves along until it is far enough from the previous one.
            let n = points.len();
            if n >= 2 && points[n - 2].1.distance(place) < spacing {
                points[n - 1] = (frame.time, place);
            } else {
                points.push_back((frame.time, place));
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

impl AgentTrail {
    /// Returns the whole seconds within the trail and the places at these times.
    pub(crate) fn seconds(&self) -> impl Iterator<Item = (i64, DVec3)> {
        let pairs = self.points.iter().zip(self.points.iter().skip(1));
        pairs.flat_map(|(&(from, a), &(to, b))| {
            let within = (from.floor() as i64 + 1)..=(to.floor() as i64);
            within.map(move |second| (second, a.lerp(b, (second as f64 - from) / (to - from))))
        })
    }

    /// Returns the trail as it looks at `now` if it fades within `seconds`: positions from the oldest to the newest,
    /// half the width (metres), and the opacity.
    pub fn fading(&self, now: f64, seconds: f64) -> impl Iterator<Item = (DVec3, f32, f32)> {
        self.points.iter().map(move |&(time, place)| {
            let fresh = freshness(now - time, seconds);
            (place, self.radius * HALF_WIDTH * (0.35 + 0.65 * fresh), OPACITY * fresh)
        })
    }
}

/// Returns the remaining strength of a point of age `age`: 1 for a new point, 0 for a faded one.
fn freshness(age: f64, seconds: f64) -> f32 {
    let left = (1.0 - age / seconds).clamp(0.0, 1.0) as f32;
    left * left.sqrt()
}

/// The settings for drawing trails.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Brush {
    pub projector: Projector,
    pub seconds: f64,
}

impl Brush {
    /// Returns the trail, oldest end first; several parts if some of it is behind the viewpoint.
    pub(crate) fn trails(&self, track: &AgentTrail, color: Color, now: f64) -> Vec<Trail> {
        let end = |&(time, point): &(f64, DVec3)| {
            let half = ((f64::from(track.radius) * self.projector.scale(point)) as f32 * HALF_WIDTH).max(0.6);
            let fresh = freshness(now - time, self.seconds);
            let opacity = OPACITY * fresh * (1.0 - self.projector.haze(point));
            Some(End { at: self.projector.pixel(point)?, half: half * (0.35 + 0.65 * fresh), opacity })
        };
        Trail::parts(track.points.iter().map(end), color)
    }
}

/// A layer that keeps the strongest trail over each pixel, so that crossings and joints do not add up.
#[derive(Clone, Debug)]
pub(crate) struct TrailLayer {
    width: usize,
    height: usize,
    /// Opacity, 0 to 1.
    opacity: Vec<f32>,
    color: Vec<u32>,
    /// The middle of each column.
    middles: Vec<f32>,
    /// The rows with any drawing.
    rows: std::ops::Range<usize>,
}

/// A trail as a sequence of ends of its segments.
#[derive(Clone, Debug, PartialEq)]
pub struct Trail {
    pub ends: Vec<End>,
    pub color: Color,
}

impl Trail {
    /// Splits a trail at its invisible ends.
    pub(crate) fn parts(ends: impl IntoIterator<Item = Option<End>>, color: Color) -> Vec<Self> {
        let ends: Vec<Option<End>> = ends.into_iter().collect();
        let parts = ends.split(|end| end.is_none()).filter(|part| part.len() > 1);
        parts.map(|part| Self { ends: part.iter().copied().flatten().collect(), color }).collect()
    }
}

/// An end of a segment of a trail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The position, pixels.
    pub at: Vec2,
    /// Half the width, pixels.
    pub half: f32,
    /// The opacity, 0 to 1.
    pub opacity: f32,
}

impl TrailLayer {
    pub(crate) fn new(width: u32, height: u32) -> Self {
        let (width, height) = (width as usize, height as usize);
        Self {
            width,
            height,
            opacity: vec![0.0; width * height],
            color: vec![0; width * height],
            middles: (0..width).map(|x| x as f32 + 0.5).collect(),
            rows: 0..0,
        }
    }

    /// Draws all segments of a trail.
    pub(crate) fn draw(&mut self, trail: &Trail) {
        trail.ends.windows(2).for_each(|ends| self.piece(ends[0], ends[1], trail.color));
    }

    fn piece(&mut self, a: End, b: End, color: Color) {
        let along = b.at - a.at;
        let length2 = along.length_squared();
        let reach = a.half.max(b.half) + 0.5;
        let (low, high) = (a.at.min(b.at) - reach, a.at.max(b.at) + reach);
        if !(length2.is_finite() && low.is_finite()) || length2 == 0.0 {
            return;
        }
        let span = |low: f32, high: f32, end: usize| {
            // The cast maps negative numbers to 0.
            ((low - 0.5).ceil() as usize)..((high + 0.5).floor().max(0.0) as usize).min(end)
        };
        let (rows, columns) = (span(low.y, high.y, self.height), span(low.x, high.x, self.width));
        if rows.is_empty() || columns.is_empty() {
            return;
        }
        self.rows = if self.rows.is_empty() {
            rows.clone()
        } else {
            self.rows.start.min(rows.start)..self.rows.end.max(rows.end)
        };
        let rgb = u32::from_be_bytes([0, color.r, color.g, color.b]);
        let unit = along / length2;
        let (widen, fade) = (b.half - a.half, b.opacity - a.opacity);
        for y in rows {
            let dy = y as f32 + 0.5 - a.at.y;
            let (first, last) = (y * self.width + columns.start, y * self.width + columns.end);
            let opacities = &mut self.opacity[first..last];
            let colors = &mut self.color[first..last];
            // Without branches, so that the compiler vectorises the loop.
            for ((opacity, color), middle) in opacities.iter_mut().zip(colors).zip(&self.middles[columns.clone()]) {
                let dx = middle - a.at.x;
                let t = (dx * unit.x + dy * unit.y).clamp(0.0, 1.0);
                let (ex, ey) = (dx - along.x * t, dy - along.y * t);
                let half = a.half + widen * t;
                let cover = (half + 0.5 - (ex * ex + ey * ey).sqrt()).clamp(0.0, 1.0).min(2.0 * half);
                let new = cover * (a.opacity + fade * t);
                let stronger = new > *opacity;
                *opacity = if stronger { new } else { *opacity };
                *color = if stronger { rgb } else { *color };
            }
        }
    }

    /// Draws the layer on a picture and clears it.
    pub(crate) fn lay(&mut self, image: &mut Image) {
        let span = self.rows.start * self.width..self.rows.end * self.width;
        let under = &mut image.data_mut()[span.start * 4..span.end * 4];
        let trails = self.opacity[span.clone()].iter_mut().zip(&self.color[span]);
        for (pixel, (opacity, color)) in under.chunks_exact_mut(4).zip(trails) {
            if *opacity > 0.0 {
                let [_, r, g, b] = color.to_be_bytes();
                blend(pixel, [r, g, b], (*opacity * 256.0) as u32);
                *opacity = 0.0;
            }
        }
        self.rows = 0..0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    const INK: Color = Color::rgb(0);
    const PAPER: Color = Color::rgb(0xffffff);

    fn moment(time: f64, at: Option<DVec2>) -> Frame {
        let body = |position| Body {
            number: 3,
            group: 0,
            goal: None,
            position,
            velocity: Vec2::ZERO,
            altitude: 0.0,
            basis: None,
            vertical_velocity: 0.0,
            heading: 0.0,
            radius: 0.2,
            core: Vec2::ZERO,
            preferred_speed: 1.0,
            status: throng::Status::Walking,
        };
        Frame { time, bodies: at.map(body).into_iter().collect(), total: 1, ..Frame::default() }
    }

    #[test]
    fn trails_of_absent_agents_are_dropped_after_their_time() {
        let mut trails = Trails::default();
        for k in 0..50 {
            let time = f64::from(k) * 0.1;
            trails.follow(&moment(time, Some(DVec2::new(time, 0.0))), 1.5, 0.1, |_| Some(INK));
            let points = trails.tracks[&3].points.len();
            assert!(points <= 18, "{points} points");
        }
        trails.follow(&moment(6.0, None), 1.5, 0.1, |_| Some(INK));
        assert_eq!(trails.tracks.len(), 1, "the trail outlives the agent");
        trails.follow(&moment(6.5, None), 1.5, 0.1, |_| Some(INK));
        assert!(trails.tracks.is_empty());
    }

    #[test]
    fn an_agent_that_is_moved_leaves_no_trail_across() {
        let mut trails = Trails::default();
        trails.follow(&moment(0.0, Some(DVec2::ZERO)), 1.5, 0.1, |_| Some(INK));
        trails.follow(&moment(0.1, Some(DVec2::new(50.0, 0.0))), 1.5, 0.1, |_| Some(INK));
        assert_eq!(trails.tracks[&3].points.len(), 1);
    }

    #[test]
    fn backward_time_drops_what_was_later() {
        let mut trails = Trails::default();
        trails.follow(&moment(5.0, Some(DVec2::ZERO)), 1.5, 0.1, |_| Some(INK));
        trails.follow(&moment(1.0, Some(DVec2::ONE)), 1.5, 0.1, |_| Some(INK));
        assert_eq!(trails.tracks[&3].points, [(1.0, DVec2::ONE.extend(0.0))]);
    }

    #[test]
    fn overlapping_segments_are_no_darker_than_one() {
        let end = |x: f32| End { at: Vec2::new(x, 10.0), half: 3.0, opacity: 0.5 };
        let mut layer = TrailLayer::new(40, 20);
        let mut image = Image::new(40, 20, PAPER);
        layer.piece(end(5.0), end(20.0), INK);
        layer.piece(end(20.0), end(35.0), INK);
        layer.piece(end(12.0), end(-30.0), INK);
        layer.lay(&mut image);
        for x in [6, 15, 19, 20, 21, 30] {
            let shade = image.pixel(x, 9).r;
            assert!((126..=129).contains(&shade), "{shade} at {x}");
        }
        let mut clean = Image::new(40, 20, PAPER);
        layer.lay(&mut clean);
        assert_eq!(clean, Image::new(40, 20, PAPER), "the layer is empty again");
    }
}

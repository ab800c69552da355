//! A viewpoint that moves.

use super::extent::{Extent, people};
use super::{Followed, Lens, Motion, Sight, Viewpoint, keys};
use crate::exposure::is_moved;
use glam::{DVec2, DVec3, Vec2};
use throng_record::{Body, Frame};

/// The default elevation of the viewpoint above the ground, and its azimuth from +x, radians.
const ELEVATION: f64 = 0.36;
const AZIMUTH: f64 = -2.0;
/// The number of iterations that centre things in the picture.
const CENTERING: usize = 8;
/// The rates at which a viewpoint approaches its place behind a followed agent, beside an agent, and before a crowd, 1/s.
const CHASING: f64 = 7.0;
const BESIDE: f64 = 1.0;
const FRAMING: f64 = 2.0;
/// The least distance of the viewpoint from a crowd, metres, and over the radius of the largest agent: people, and what is
/// larger, are no nearer than 6 m; insects of 1 cm are as near as 0.5 m.
const NEAREST: f64 = 6.0;
const NEAREST_PER_RADIUS: f64 = 50.0;

/// A moving viewpoint.
#[derive(Clone, Debug)]
pub(crate) struct Rig {
    /// Where it starts.
    start: Sight,
    motion: Motion,
    /// The vertical field of view, degrees.
    angle: f64,
    window: Window,
    reach: f64,
    /// Where it is, and since when.
    now: Option<(Sight, f64)>,
    /// The agents at that time, of a viewpoint before a crowd.
    seen: Vec<Body>,
}

/// The part of the picture that things are to fill.
#[derive(Clone, Copy, Debug)]
struct Window {
    /// The height of the whole picture, pixels.
    height: f64,
    /// The pixel in the middle of the part, and half of its size.
    anchor: Vec2,
    half: DVec2,
}

impl Window {
    /// Returns the focal length, pixels, for a vertical field of view, degrees.
    fn focal(&self, angle: f64) -> f64 {
        0.5 * self.height / (0.5 * angle.to_radians()).tan()
    }

    /// Returns the viewpoint in the direction `out` from which points fill the window; `target`: what it looks at, if
    /// that is given.
    fn fit(&self, points: &[DVec3], out: DVec3, focal: f64, target: Option<DVec3>) -> Option<Sight> {
        let right = DVec3::Z.cross(out).try_normalize().unwrap_or(DVec3::X);
        let up = out.cross(right);
        let first = points.first()?;
        let mut middle = target.unwrap_or(*first);
        let mut distance = 0.0;
        let slopes = (self.half / focal).max(DVec2::splat(1e-3));
        for _ in 0..if target.is_none() { CENTERING } else { 1 } {
            let offsets = || points.iter().map(|&point| point - middle);
            let aside = |offset: DVec3| DVec2::new(offset.dot(right), offset.dot(up));
            // A point fits if its lateral offset over its depth is within the edges of the window.
            let least = |offset: DVec3| (aside(offset).abs() / slopes).max_element() + offset.dot(out);
            distance = offsets().map(least).fold(1e-3, f64::max);
            let seen = offsets().map(|offset| aside(offset) / (distance - offset.dot(out)).max(1e-6));
            let (low, high) =
                seen.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
            if target.is_none() {
                let shift = (low + high) * 0.5 * distance;
                middle += right * shift.x + up * shift.y;
            }
        }
        Some(Sight { eye: middle + out * distance, target: middle })
    }
}

impl Rig {
    /// Creates the viewpoint of a picture `height` pixels high. The scene lies between the pixels `low` and `high`.
    pub(crate) fn new(viewpoint: &Viewpoint, extent: &Extent, height: u32, (low, high): (Vec2, Vec2)) -> Self {
        let half = ((high - low).as_dvec2() * 0.5).max(DVec2::ONE);
        let window = Window { height: height.into(), anchor: (low + high) * 0.5, half };
        let focal = window.focal(viewpoint.field_of_view);
        let out = DVec2::from_angle(AZIMUTH).extend(0.0) * ELEVATION.cos() + DVec3::Z * ELEVATION.sin();
        let target = viewpoint.target.unwrap_or_else(|| extent.middle());
        let start = match viewpoint.eye {
            Some(eye) => Sight { eye, target },
            None => {
                let turns = matches!(viewpoint.motion, Motion::Orbit(_));
                let points = extent.points(turns);
                // A viewpoint that turns looks at the middle of its circle.
                let target = if turns { Some(target) } else { viewpoint.target };
                window
                    .fit(&points, out, focal, target)
                    .unwrap_or(Sight { eye: target.unwrap_or_default() + out, target: target.unwrap_or_default() })
            }
        };
        Self {
            start,
            motion: viewpoint.motion.clone(),
            angle: viewpoint.field_of_view,
            window,
            reach: extent.reach(),
            now: None,
            seen: Vec::new(),
        }
    }

    /// Returns the point in the middle of the picture.
    pub(crate) fn middle(&self) -> DVec3 {
        self.now.map_or(self.start.target, |(sight, _)| sight.target)
    }

    /// Moves the viewpoint to its place at the time of a frame.
    pub(crate) fn turn(&mut self, frame: &Frame) -> Lens {
        let (sight, angle) = self.sight(frame);
        self.lens(sight, angle)
    }

    /// Whether the viewpoint stays where it is.
    pub(super) fn is_still(&self) -> bool {
        self.motion == Motion::Still
    }

    /// Moves the viewpoint to its place at the time of a frame. Returns it with the vertical field of view, degrees.
    pub(super) fn sight(&mut self, frame: &Frame) -> (Sight, f64) {
        let Sight { eye, target } = self.start;
        let (wanted, rate) = match &self.motion {
            Motion::Still => (None, 0.0),
            Motion::Orbit(rate) => {
                let turn = DVec2::from_angle(rate.to_radians() * frame.time);
                let from = eye - target;
                let eye = target + turn.rotate(from.truncate()).extend(from.z);
                (Some(Sight { eye, target }), f64::INFINITY)
            }
            Motion::Keys(keys) => match keys::at(keys, frame.time, self.angle) {
                Some((sight, angle)) => {
                    self.now = Some((sight, frame.time));
                    return (sight, angle);
                }
                None => (None, 0.0),
            },
            Motion::Follow(follow) => {
                let from = self.now.map_or(eye, |(sight, _)| sight.eye);
                let found = frame.bodies.binary_search_by_key(&follow.number, |body| body.number).ok();
                let followed = found.map(|at| Followed::from(&frame.bodies[at]));
                (followed.map(|followed| follow.chase.sight(&followed, follow.aside, from)), CHASING)
            }
            Motion::Beside(number) => {
                let found = frame.bodies.binary_search_by_key(number, |body| body.number).ok();
                let center = found.map(|at| frame.bodies[at].center());
                (center.map(|center| Sight { eye: center + eye - target, target: center }), BESIDE)
            }
            Motion::Crowd => {
                if self.cuts(frame) {
                    self.now = None;
                }
                self.seen.clone_from(&frame.bodies);
                // The viewpoint lags behind: it aims at where people are, and at where they will be when it is there.
                let points: Vec<DVec3> = people(frame, 0.0).chain(people(frame, 1.0 / FRAMING)).collect();
                let out = (eye - target).normalize_or(DVec3::Z);
                let fit = self.window.fit(&points, out, self.window.focal(self.angle), None);
                let largest = frame.bodies.iter().map(|body| body.shape().bounding_radius()).fold(0.0, f32::max);
                let nearest = NEAREST.min(NEAREST_PER_RADIUS * f64::from(largest));
                let far = |sight: Sight| {
                    let distance = sight.eye.distance(sight.target).max(nearest);
                    Sight { eye: sight.target + out * distance, ..sight }
                };
                (fit.map(far), FRAMING)
            }
        };
        if let Some(wanted) = wanted {
            let (sight, since) = self.now.get_or_insert((wanted, frame.time));
            sight.approach(wanted, frame.time - *since, rate);
            *since = frame.time;
        }
        (self.now.map_or(self.start, |(sight, _)| sight), self.angle)
    }

    /// Whether an agent has been moved elsewhere, out of the picture.
    fn cuts(&self, frame: &Frame) -> bool {
        let Some((sight, since)) = self.now else { return false };
        let (lens, half) = (self.lens(sight, self.angle), self.window.half.as_vec2());
        frame.bodies.iter().any(|body| {
            let before = self.seen.binary_search_by_key(&body.number, |body| body.number).ok();
            let moved = before.is_some_and(|at| is_moved(&self.seen[at], body, frame.time - since));
            let shown = |pixel: Vec2| (pixel - self.window.anchor).abs().cmple(half).all();
            moved && !lens.pixel(body.center()).is_some_and(shown)
        })
    }

    fn lens(&self, Sight { eye, target }: Sight, angle: f64) -> Lens {
        Lens::new(eye, target, self.window.focal(angle), self.window.anchor, self.reach)
    }
}

#[cfg(test)]
mod tests;

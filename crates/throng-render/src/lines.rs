//! Lines that have a width in the picture.

use crate::geometry::{Guard, ground};
use crate::raster::{Cover, Plane};
use crate::view::SUB;
use crate::{Line, LineEnd, View};
use glam::{IVec2, Vec2, Vec3};

/// How much farther than its width a corner may reach at a bend.
const MITRE: f32 = 2.0;

/// The greatest width of a line, pixels.
const WIDEST: f32 = 4096.0;

/// The strokes of lines in the picture.
#[derive(Default)]
pub(crate) struct Strokes {
    pub covers: Vec<Cover>,
    pub all: Vec<Stroke>,
}

/// A part of a line in the picture.
pub(crate) struct Stroke {
    /// The number of its line.
    pub line: u32,
    pub color: Vec3,
    /// The opacity.
    pub opacity: Plane,
}

/// An end in the picture.
#[derive(Clone, Copy)]
struct End {
    pixel: Vec2,
    near: f32,
    half: f32,
    opacity: f32,
}

impl Strokes {
    pub fn new(lines: &[Line], view: &View, size: [u32; 2]) -> Self {
        let guard = Guard::new(view, size);
        let mut strokes = Self::default();
        for (number, line) in lines.iter().enumerate() {
            strokes.line(line, number as u32, view, &guard);
        }
        strokes
    }

    fn line(&mut self, line: &Line, number: u32, view: &View, guard: &Guard) {
        let turned = |end: &LineEnd| view.turned(view.relative(if line.flat { end.at.with_z(0.0) } else { end.at }));
        let places: Vec<Vec3> = line.ends.iter().map(turned).collect();
        let end = |k: usize| guard.holds(places[k]).then(|| End::new(view, places[k], &line.ends[k]));
        // The direction across the line at each of its ends, where both parts are in the picture.
        let across = |k: usize| {
            let (Some(before), Some(here), Some(after)) = (end(k.checked_sub(1)?), end(k), end(k + 1)) else {
                return None;
            };
            let [a, b] =
                [here.pixel - before.pixel, after.pixel - here.pixel].map(|way| way.normalize_or_zero().perp());
            let middle = (a + b).try_normalize()?;
            Some(middle * (1.0 / middle.dot(a).max(1.0 / MITRE)))
        };
        let inner: Vec<Option<Vec2>> =
            (0..places.len()).map(|k| if k == 0 || k + 1 == places.len() { None } else { across(k) }).collect();
        for k in 1..places.len() {
            let ends = [(places[k - 1], &line.ends[k - 1]), (places[k], &line.ends[k])];
            let (parts, sides) = match (guard.holds(places[k - 1]), guard.holds(places[k])) {
                (true, true) => ([0.0, 1.0], [inner[k - 1], inner[k]]),
                _ => match guard.part(places[k - 1], places[k]) {
                    Some(parts) => (parts, [None; 2]),
                    None => continue,
                },
            };
            let ends = parts.map(|part| {
                let mix = |a: f32, b: f32| a + (b - a) * part;
                let (from, to) = (ends[0].1, ends[1].1);
                let (width, opacity) = (mix(from.width, to.width), mix(from.opacity, to.opacity));
                End::new(view, ends[0].0.lerp(ends[1].0, part), &LineEnd { at: from.at, width, opacity })
            });
            self.part(ends, sides, (line, number), view);
        }
    }

    fn part(&mut self, ends: [End; 2], sides: [Option<Vec2>; 2], (line, number): (&Line, u32), view: &View) {
        let [from, to] = ends;
        let way = to.pixel - from.pixel;
        let length = way.length();
        // NaN has no length either.
        if length.is_nan() || length < 1e-3 {
            return;
        }
        let own = way.perp() / length;
        let corners = [(from, sides[0]), (to, sides[1])].map(|(end, side)| {
            let side = side.unwrap_or(own) * end.half;
            [end.pixel + side, end.pixel - side].map(|pixel| (pixel * SUB as f32).round().as_ivec2())
        });
        let along = |a: f32, b: f32| {
            let step = way * ((b - a) / (length * length));
            Plane { at: a - step.dot(from.pixel), step }
        };
        let (near, limits) = if line.flat {
            (ground(view), [0.0, f32::INFINITY])
        } else {
            (along(from.near, to.near), [from.near.min(to.near), from.near.max(to.near)])
        };
        let id = self.all.len() as u32;
        let [[a, b], [c, d]]: [[IVec2; 2]; 2] = corners;
        self.covers.extend([[a, b, d], [a, d, c]].into_iter().filter_map(|face| Cover::new(face, near, limits, id)));
        self.all.push(Stroke { line: number, color: line.color, opacity: along(from.opacity, to.opacity) });
    }
}

impl End {
    /// Creates an end at a place in the axes of the picture. A line thinner than a pixel is as much fainter.
    fn new(view: &View, place: Vec3, end: &LineEnd) -> Self {
        let near = 1.0 / place.z;
        let pixel = view.centre + Vec2::new(place.x, -place.y) * (view.focal * near);
        // NaN is no width
        let width = if end.width > 0.0 { end.width.min(WIDEST) } else { 0.0 };
        Self { pixel, near, half: 0.5 * width.max(1.0), opacity: end.opacity * width.min(1.0) }
    }
}

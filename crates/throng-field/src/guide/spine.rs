//! Smooth curves that keep a distance from obstacles.

use super::voxels::Voxels;
use glam::Vec3;
use throng::Error;

/// How a route is smoothed. With its ends fixed, the sum over its samples of `stiffness |q(k+1) - 2 q(k) + q(k-1)|^2 +
/// tension |q(k+1) - q(k)|^2 + keep_off max(0, distance - d(q(k)))^2` is minimised, where `d` is the distance from
/// obstacles. Wang et al. 2014 minimise an energy but do not give its terms; this one is similar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoothing {
    /// Approximate distance between samples, metres. Limit: > 0; at most 100,000 samples.
    pub spacing: f32,
    /// Weight of bends. Limit: >= 0.
    pub stiffness: f32,
    /// Weight of length. Limit: >= 0.
    pub tension: f32,
    /// Weight of being closer than `distance` to obstacles. Limit: >= 0.
    pub keep_off: f32,
    /// Distance to keep from obstacles where there is room, metres, from the centre of a body. Limit: >= 0.
    pub distance: f32,
    /// Number of times that every sample is moved. Limit: at most 10,000.
    pub rounds: u32,
}

impl Default for Smoothing {
    fn default() -> Self {
        Self { spacing: 0.25, stiffness: 1.0, tension: 0.5, keep_off: 10.0, distance: 0.5, rounds: 100 }
    }
}

/// Maximum number of samples of a route.
const MOST: f32 = 100_000.0;
/// Number of times that a shift which goes too far is halved.
const HALVED: usize = 6;
/// Shift, in parts of the spacing, below which the smoothing has converged.
const STILL: f32 = 1e-5;

/// A smooth curve through space.
#[derive(Clone, Debug, PartialEq)]
pub struct Spine {
    points: Vec<Vec3>,
    clearance: f32,
}

impl Spine {
    /// Smooths a route. All parts of the route must be at least a body's radius from obstacles; the result is too.
    pub(super) fn new(space: &Voxels, way: &[Vec3], smoothing: Smoothing) -> Result<Self, Error> {
        smoothing.check()?;
        let length: f32 = way.windows(2).map(|ends| ends[0].distance(ends[1])).sum();
        if length / smoothing.spacing > MOST {
            let why = format!("{length} m in pieces of {} m are more than {MOST} samples", smoothing.spacing);
            return Err(Error::Shape { what: "the smooth way".into(), why });
        }
        let mut points = samples(way, smoothing.spacing);
        // where the samples cut corners of the route: use shorter pieces
        for halved in 1..HALVED as i32 {
            let clear = |ends: &[Vec3]| space.is_clear(ends[0], ends[1], 0.999 * space.radius);
            if points.windows(2).all(clear) {
                break;
            }
            points = samples(way, smoothing.spacing * 0.5f32.powi(halved));
        }
        for _ in 0..smoothing.rounds {
            let mut moved = 0.0f32;
            for index in 1..points.len().saturating_sub(1) {
                let shift = smoothing.downhill(space, &points, index);
                moved = moved.max(shifted(space, &mut points, index, shift, smoothing.distance));
            }
            if moved < STILL * smoothing.spacing {
                break;
            }
        }
        // samples that are still too close although there is room
        for _ in 0..HALVED {
            for index in 1..points.len().saturating_sub(1) {
                let near = space.nearest(points[index]);
                let lacks = smoothing.distance * 1.001 - near.distance;
                if lacks > 0.0 {
                    shifted(space, &mut points, index, near.normal * lacks, smoothing.distance);
                }
            }
        }
        let clearance = points.iter().map(|&at| space.nearest(at).distance).fold(f32::INFINITY, f32::min);
        Ok(Self { points, clearance })
    }

    /// Returns the samples, from the start to the target.
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// Returns the minimum distance of the samples from obstacles, metres. It is less than requested only where there
    /// is no room, or at the ends.
    pub fn clearance(&self) -> f32 {
        self.clearance
    }

    /// Returns the length, metres.
    pub fn length(&self) -> f32 {
        self.points.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
    }

    /// Returns the nearest point of the curve to a place, and the direction of the curve there. The search goes from
    /// piece `from` to neighbouring pieces as long as they are nearer.
    pub(super) fn nearest_from(&self, place: Vec3, mut from: usize) -> (Vec3, Vec3) {
        let last = self.points.len() - 2;
        let on = |segment: usize| {
            let (a, b) = (self.points[segment], self.points[segment + 1]);
            let along = b - a;
            let part = ((place - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            // a piece without length: its start
            let part = if part.is_nan() { 0.0 } else { part };
            (a + along * part, part)
        };
        let far = |segment: usize| on(segment).0.distance_squared(place);
        let mut best = far(from);
        loop {
            let beside = [from.saturating_sub(1), (from + 1).min(last)].map(|segment| (far(segment), segment));
            let nearer = if beside[1].0 < beside[0].0 { beside[1] } else { beside[0] };
            if nearer.0 >= best {
                break;
            }
            (best, from) = nearer;
        }
        let (nearest, part) = on(from);
        // the direction turns evenly between samples
        let way = |segment: usize| (self.points[segment + 1] - self.points[segment]).normalize_or_zero();
        let other = if part < 0.5 { from.saturating_sub(1) } else { (from + 1).min(last) };
        let own = 1.0 - (part - 0.5).abs();
        (nearest, (way(from) * own + way(other) * (1.0 - own)).normalize_or_zero())
    }

    /// Returns the index of the piece that is nearest to a place, and its distance.
    pub(super) fn piece(&self, place: Vec3) -> (usize, f32) {
        let far = |ends: &[Vec3]| {
            let along = ends[1] - ends[0];
            let part = ((place - ends[0]).dot(along) / along.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
            (ends[0] + along * part).distance(place)
        };
        let all = self.points.windows(2).map(far).enumerate();
        all.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, f32::INFINITY))
    }
}

/// Returns the ends of even pieces, about as long as `spacing`, of a route: at least two pieces.
fn samples(way: &[Vec3], spacing: f32) -> Vec<Vec3> {
    let mut ends = Vec::with_capacity(way.len());
    let mut length = 0.0;
    for pair in way.windows(2) {
        length += pair[0].distance(pair[1]);
        ends.push(length);
    }
    let pieces = (length / spacing).round().max(2.0);
    let place = |piece: usize| {
        let at = length * piece as f32 / pieces;
        let segment = ends.partition_point(|&end| end < at).min(ends.len() - 1);
        let (from, to) = (way[segment], way[segment + 1]);
        to + (from - to).normalize_or_zero() * (ends[segment] - at).max(0.0)
    };
    let mut samples: Vec<Vec3> = (0..pieces as usize).map(place).collect();
    samples.extend(way.last());
    samples
}

/// Moves a sample by a shift, or by a half, a quarter and so on of it, and returns the distance moved. The sample does
/// not move where a body has no room there or on the way to a neighbouring sample, nor closer to obstacles than
/// `distance` or than it already is.
fn shifted(space: &Voxels, points: &mut [Vec3], index: usize, shift: Vec3, distance: f32) -> f32 {
    let from = points[index];
    let before = space.nearest(from).distance;
    let mut shift = shift;
    for _ in 0..HALVED {
        let to = from + shift;
        let after = space.nearest(to).distance;
        let keeps = after >= before.min(distance) && after >= space.radius && space.cell_at(to).is_some();
        let clear = |other: Vec3| space.is_clear(to, other, 0.999 * space.radius);
        if keeps && clear(points[index - 1]) && clear(points[index + 1]) {
            points[index] = to;
            return shift.length();
        }
        shift *= 0.5;
    }
    0.0
}

impl Smoothing {
    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("spacing of the samples of a way", self.spacing)?;
        let limit = "at least 0 and finite";
        let all = [
            ("stiffness of a way", self.stiffness),
            ("tension of a way", self.tension),
            ("weight of keeping off obstacles", self.keep_off),
            ("distance that a way keeps", self.distance),
        ];
        for (what, value) in all {
            Error::unless(value >= 0.0 && value.is_finite(), what, value, limit)?;
        }
        Error::unless(self.rounds <= 10_000, "rounds of smoothing", self.rounds, "at most 10,000")
    }

    /// Returns the shift to the minimum of the energy if only this sample moves and the nearest surface is flat.
    fn downhill(&self, space: &Voxels, points: &[Vec3], index: usize) -> Vec3 {
        let at = |offset: isize| index.checked_add_signed(offset).and_then(|index| points.get(index)).copied();
        let here = points[index];
        let (mut slope, mut bend) = (Vec3::ZERO, 0.0);
        // each second difference that the sample is part of, with the sample's coefficient in it
        for (middle, weight) in [(-1, 1.0), (0, -2.0), (1, 1.0)] {
            if let (Some(a), Some(b), Some(c)) = (at(middle - 1), at(middle), at(middle + 1)) {
                slope += (a - 2.0 * b + c) * (weight * self.stiffness);
                bend += weight * weight * self.stiffness;
            }
        }
        if let (Some(a), Some(c)) = (at(-1), at(1)) {
            slope += (2.0 * here - a - c) * self.tension;
            bend += 2.0 * self.tension;
        }
        let near = space.nearest(here);
        if near.distance < self.distance {
            slope -= near.normal * (self.keep_off * (self.distance - near.distance));
            bend += self.keep_off;
        }
        if bend > 0.0 { -slope / bend } else { Vec3::ZERO }
    }
}

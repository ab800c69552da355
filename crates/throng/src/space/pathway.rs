//! Paths to follow: a spine with a width. Reynolds, *Steering Behaviors for Autonomous Characters* (GDC 1999), "path
//! following". The queries are those of OpenSteer's `Pathway`.

use crate::error::Error;
use crate::parameters::parameters;
use crate::space::surface::{Bounds, Bvh};
use glam::Vec3;

/// A polyline with a radius for each of its segments, open or cyclic. Everything within the radius of a segment is on
/// the path.
///
/// A place on the path is given by its distance along the path from the first point, metres. On a cyclic path every
/// number is such a distance, including negative numbers and those of further laps. On an open path a number beyond an
/// end means that end.
///
/// ```
/// use glam::Vec3;
/// use throng::space::{Pathway, PathDirection};
///
/// let corners = [Vec3::ZERO, Vec3::X * 10.0, Vec3::new(10.0, 5.0, 0.0)];
/// let path = Pathway::new(&corners, 1.0, false)?;
/// let near = path.nearest(Vec3::new(4.0, 3.0, 0.0));
/// assert_eq!((near.point, near.along, near.outside), (Vec3::X * 4.0, 4.0, 2.0));
/// assert_eq!(path.at(12.0), Vec3::new(10.0, 2.0, 0.0));
/// // at a bend the tangent depends on the direction of travel
/// assert_eq!(path.tangent_at(10.0, PathDirection::Forward), Vec3::Y);
/// assert_eq!(path.tangent_at(10.0, PathDirection::Backward), -Vec3::X);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Pathway {
    segments: Vec<Segment>,
    cyclic: bool,
    length: f32,
    /// A hierarchy over the segments with their radii.
    bvh: Bvh,
}

/// A straight segment of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Where it starts, metres.
    pub start: Vec3,
    /// Where it ends, metres.
    pub end: Vec3,
    /// Unit vector from start to end.
    pub tangent: Vec3,
    /// Radius of the path around it, metres.
    pub radius: f32,
    /// Distance along the path to its start, metres.
    pub along: f32,
    /// Its length, metres.
    pub length: f32,
}

/// The place on a path that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnPath {
    /// The place on the spine.
    pub point: Vec3,
    /// Unit vector along the path there, in the order of its points.
    pub tangent: Vec3,
    /// How far outside of the path the point is, metres; negative within the radius of the spine.
    pub outside: f32,
    /// Distance along the path to the place, metres: from 0 to the length of the path.
    pub along: f32,
    /// Index of the segment it is on.
    pub segment: usize,
}

/// The direction of motion along a path.
#[parameters]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PathDirection {
    /// In the order of its points.
    #[default]
    Forward,
    /// Against the order of its points.
    Backward,
}

impl PathDirection {
    /// Returns the factor for distances travelled: 1 forward, -1 backward.
    pub fn sign(self) -> f32 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
        }
    }
}

impl Segment {
    /// Returns the distance from the start, metres, of the point nearest to `p` between the distances `from` and `to`.
    fn nearest(&self, p: Vec3, from: f32, to: f32) -> f32 {
        (p - self.start).dot(self.tangent).clamp(from, to)
    }

    /// Returns the point at a distance from the start.
    fn at(&self, distance: f32) -> Vec3 {
        if distance < self.length { self.start + self.tangent * distance } else { self.end }
    }
}

impl Pathway {
    /// Returns a path through these points, metres, with one radius. A cyclic path continues from the last point to the
    /// first.
    ///
    /// # Errors
    /// [`Error::Limit`] if a point is not finite, or the radius negative or not finite; [`Error::Shape`] if there are
    /// fewer than two points (three if it is cyclic), or two consecutive points are the same.
    pub fn new(points: &[Vec3], radius: f32, cyclic: bool) -> Result<Self, Error> {
        let segments = if cyclic { points.len() } else { points.len().saturating_sub(1) };
        Self::with_radii(points, &vec![radius; segments], cyclic)
    }

    /// Returns a path through these points, metres, with a radius for each segment: one less than points, or as many if
    /// the path is cyclic.
    ///
    /// # Errors
    /// Those of [`Pathway::new`], and [`Error::Shape`] if there are not as many radii as segments.
    pub fn with_radii(points: &[Vec3], radii: &[f32], cyclic: bool) -> Result<Self, Error> {
        let fail = |why: String| Err(Error::Shape { what: "a path".into(), why });
        let n = points.len();
        let (least, count) = if cyclic { (3, n) } else { (2, n.saturating_sub(1)) };
        if n < least {
            return fail(format!("it has {n} points, but needs at least {least}"));
        }
        if radii.len() != count {
            return fail(format!("it has {} radii for {count} segments", radii.len()));
        }
        for x in points.iter().flat_map(|point| point.to_array()) {
            Error::unless_finite("a coordinate of a path", x.into())?;
        }
        let mut segments = Vec::with_capacity(count);
        let mut along = 0.0f64;
        for (i, &radius) in radii.iter().enumerate() {
            Error::unless(radius >= 0.0 && radius.is_finite(), "a radius of a path", radius, "at least 0 and finite")?;
            let (start, end) = (points[i], points[(i + 1) % n]);
            let length = start.as_dvec3().distance(end.as_dvec3());
            let tangent = (end.as_dvec3() - start.as_dvec3()).normalize_or_zero().as_vec3();
            if length as f32 == 0.0 {
                return fail(format!("its points {i} and {} are the same: leave one of them out", (i + 1) % n));
            }
            segments.push(Segment { start, end, tangent, radius, along: along as f32, length: length as f32 });
            along += length;
        }
        let tube = |segment: &Segment| Bounds::around([segment.start, segment.end]).grown(segment.radius);
        let bvh = Bvh::new(&segments.iter().map(tube).collect::<Vec<_>>());
        Ok(Self { segments, cyclic, length: along as f32, bvh })
    }

    /// Whether the path is cyclic.
    pub fn is_cyclic(&self) -> bool {
        self.cyclic
    }

    /// Returns the length, metres. A cyclic path includes the segment from the last point to the first.
    pub fn length(&self) -> f32 {
        self.length
    }

    /// Returns the segments in order.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Returns the place on the path at which `point` is least outside: the smallest distance less the radius there.
    pub fn nearest(&self, point: Vec3) -> OnPath {
        let look = |index: u32| {
            let near = self.on_segment(point, index as usize, 0.0, f32::INFINITY);
            (near.outside, near)
        };
        let nearest = self.bvh.nearest(point, look).map(|found| found.1);
        nearest.unwrap_or_else(|| self.on_segment(point, 0, 0.0, f32::INFINITY))
    }

    /// Returns the same among the places within `reach` metres along the path from a known place, for agents that
    /// follow the path: where it approaches or crosses itself they stay on their branch. Visits only the segments
    /// within reach.
    pub fn nearest_near(&self, point: Vec3, along: f32, reach: f32) -> OnPath {
        // a cyclic path is searched once at most
        let reach = reach.clamp(0.0, if self.cyclic { 0.5 * self.length } else { f32::INFINITY });
        let along = self.within(along);
        let (mut index, mut best) = (self.segment_at(along - reach), None::<OnPath>);
        // distances along a cyclic path, unrolled from the lap before
        let mut lap = if self.cyclic && along - reach < 0.0 { -self.length } else { 0.0 };
        loop {
            let start = self.segments[index].along + lap;
            if start > along + reach && best.is_some() {
                break;
            }
            let near = self.on_segment(point, index, along - reach - start, along + reach - start);
            if best.is_none_or(|best| near.outside < best.outside) {
                best = Some(near);
            }
            index += 1;
            if index == self.segments.len() {
                if !self.cyclic || lap > 0.0 {
                    break;
                }
                (index, lap) = (0, lap + self.length);
            }
        }
        best.unwrap_or_else(|| self.nearest(point))
    }

    /// Returns the point at a distance along the path.
    pub fn at(&self, along: f32) -> Vec3 {
        let along = self.within(along);
        let segment = &self.segments[self.segment_at(along)];
        segment.at(along - segment.along)
    }

    /// Returns the unit vector of travel at a distance along the path. At a bend it is that of the segment ahead.
    pub fn tangent_at(&self, along: f32, direction: PathDirection) -> Vec3 {
        self.segments[self.segment_ahead(along, direction)].tangent * direction.sign()
    }

    /// Returns the radius at a distance along the path, metres. Where it changes it is that of the segment ahead.
    pub fn radius_at(&self, along: f32, direction: PathDirection) -> f32 {
        self.segments[self.segment_ahead(along, direction)].radius
    }

    /// Returns an equivalent distance along the path between 0 and its length.
    fn within(&self, along: f32) -> f32 {
        let along = if self.cyclic { along.rem_euclid(self.length) } else { along };
        along.clamp(0.0, self.length)
    }

    /// Returns the segment at a distance along the path; at a point between two segments, the later one.
    fn segment_at(&self, along: f32) -> usize {
        let along = self.within(along);
        self.segments.partition_point(|segment| segment.along <= along).saturating_sub(1)
    }

    fn segment_ahead(&self, along: f32, direction: PathDirection) -> usize {
        let along = self.within(along);
        let segment = self.segment_at(along);
        match direction {
            PathDirection::Backward if self.segments[segment].along == along => match segment {
                0 if self.cyclic => self.segments.len() - 1,
                0 => 0,
                _ => segment - 1,
            },
            PathDirection::Forward if self.cyclic && along == self.length => 0,
            _ => segment,
        }
    }

    /// Returns the place on a segment nearest to a point, between two distances from its start.
    fn on_segment(&self, point: Vec3, index: usize, from: f32, to: f32) -> OnPath {
        let segment = &self.segments[index];
        // limits that are NaN have no effect
        let limits = [from, to].map(|limit| limit.max(0.0).min(segment.length));
        let distance = segment.nearest(point, limits[0], limits[1]);
        let on = segment.at(distance);
        OnPath {
            point: on,
            tangent: segment.tangent,
            outside: point.distance(on) - segment.radius,
            along: (segment.along + distance).min(self.length),
            segment: index,
        }
    }
}

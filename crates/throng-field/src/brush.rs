//! Brushes that make a field: strokes, stamps and the eraser. All of them produce or remove [anchors](Anchor).

use super::{Anchor, Critical};
use glam::DVec2;
use throng::Error;

/// Maximum number of anchors of a stroke.
const MOST: usize = 100_000;

/// A stroke of the brush: the field leads along it.
///
/// ```
/// use glam::DVec2;
/// use throng_field::{Anchors, Sketch, Stroke};
/// let points = vec![DVec2::ZERO, DVec2::new(20.0, 0.0), DVec2::new(20.0, 15.0)];
/// let stroke = Stroke { points, speed: 1.3, ..Stroke::default() };
/// let field = Anchors::new(&stroke.anchors()?, Sketch { fade: Some(4.0), ..Sketch::default() })?;
/// assert!(field.at(DVec2::new(8.0, 0.5)).distance(DVec2::X * 1.3) < 0.1);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// The line of the stroke, metres from the origin: at least two points that differ.
    pub points: Vec<DVec2>,
    /// Speed of the field along the line, m/s. Limit: finite; below zero, against it.
    pub speed: f64,
    /// Distance between the anchors, metres; it is rounded so that the anchors are equally spaced. Limit: > 0.
    pub spacing: f64,
    /// See [`Anchor::stretch`].
    pub stretch: f64,
}

impl Default for Stroke {
    /// No points, 1.3 m/s, an anchor every 2 m.
    fn default() -> Self {
        Self { points: Vec::new(), speed: 1.3, spacing: 2.0, stretch: 1.0 }
    }
}

impl Stroke {
    /// Returns the anchors from the first point to the last. The velocity of each points from the previous anchor to
    /// the next.
    ///
    /// # Errors
    /// Values out of their limits; a line without length; more than 100,000 anchors.
    pub fn anchors(&self) -> Result<Vec<Anchor>, Error> {
        Error::unless_finite("speed of a stroke", self.speed)?;
        Error::unless(self.spacing > 0.0, "spacing of a stroke", self.spacing, "greater than 0")?;
        for point in &self.points {
            Error::unless_finite("point of a stroke", point.element_sum())?;
        }
        let lengths = self.points.windows(2).map(|pair| pair[0].distance(pair[1]));
        let ends: Vec<f64> = lengths.scan(0.0, |sum, length| Some(*sum + length).inspect(|end| *sum = *end)).collect();
        let length = ends.last().copied().filter(|&length| length > 0.0).ok_or_else(|| Error::Shape {
            what: "a stroke".into(),
            why: "it has no length: draw it through two points that differ".into(),
        })?;
        let parts = (length / self.spacing).round().max(1.0);
        Error::unless(parts < MOST as f64, "number of anchors of a stroke", parts, "at most 100000: space them wider")?;
        let place = |part: usize| {
            let at = length * part as f64 / parts;
            let segment = ends.partition_point(|&end| end < at).min(ends.len() - 1);
            let (from, to) = (self.points[segment], self.points[segment + 1]);
            let left = ends[segment] - at;
            to + (from - to).normalize_or_zero() * left.max(0.0)
        };
        let last = parts as usize;
        let anchor = |part: usize| {
            let along = place((part + 1).min(last)) - place(part.saturating_sub(1));
            let velocity = along.normalize_or_zero() * self.speed;
            Anchor { place: place(part), velocity, stretch: self.stretch }
        };
        Ok((0..=last).map(anchor).collect())
    }
}

/// A stamp: anchors on a circle and in its centre that make a [critical point](super::CriticalPoint) there.
///
/// ```
/// use glam::DVec2;
/// use throng_field::{Anchors, Critical, Sketch, Stamp};
/// let square = Stamp { place: DVec2::new(5.0, 5.0), kind: Critical::Center, radius: 4.0, speed: 1.0 };
/// let field = Anchors::new(&square.anchors()?, Sketch::default())?;
/// assert!(field.at(DVec2::new(9.0, 5.0)).distance(DVec2::Y) < 1e-9, "counter-clockwise");
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stamp {
    /// The centre, metres from the origin.
    pub place: DVec2,
    /// The kind of the critical point. At a saddle the field leads away along x and towards the centre along y.
    pub kind: Critical,
    /// Radius of the circle, metres. Limit: > 0.
    pub radius: f64,
    /// Speed of the field on the circle, m/s. Below zero the field is reversed: a centre turns clockwise, a sink
    /// becomes a source. Limit: finite.
    pub speed: f64,
}

impl Stamp {
    /// Returns the anchors: the centre, then eight on the circle, counter-clockwise from +x.
    ///
    /// # Errors
    /// Values out of their limits.
    pub fn anchors(&self) -> Result<[Anchor; 9], Error> {
        let Self { place, kind, radius, speed } = *self;
        Error::unless_finite("place of a stamp", place.element_sum())?;
        Error::unless_finite("speed of a stamp", speed)?;
        Error::unless(radius > 0.0 && radius.is_finite(), "radius of a stamp", radius, "greater than 0 and finite")?;
        let on_circle = |index: usize| {
            let out = DVec2::from_angle(index as f64 * std::f64::consts::FRAC_PI_4);
            let way = match kind {
                Critical::Center => out.perp(),
                Critical::Source => out,
                Critical::Sink => -out,
                Critical::Saddle => out * DVec2::new(1.0, -1.0),
            };
            Anchor::new(place + out * radius, way * speed)
        };
        let middle = Anchor::new(place, DVec2::ZERO);
        Ok(std::array::from_fn(|index| index.checked_sub(1).map_or(middle, on_circle)))
    }
}

/// Removes the anchors within a radius (metres) of a place and returns how many it removed.
pub fn erase(anchors: &mut Vec<Anchor>, place: DVec2, radius: f64) -> usize {
    let before = anchors.len();
    anchors.retain(|anchor| anchor.place.distance(place) > radius);
    before - anchors.len()
}

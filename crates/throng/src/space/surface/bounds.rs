//! Axis-aligned bounding boxes.

use super::Sweep;
use glam::Vec3;

/// An axis-aligned bounding box, metres. It is infinite where its contents are.
///
/// ```
/// use glam::Vec3;
/// use throng::space::surface::Bounds;
///
/// let bounds = Bounds::around([Vec3::ZERO, Vec3::new(2.0, 4.0, 0.0)]);
/// assert_eq!(bounds.center(), Vec3::new(1.0, 2.0, 0.0));
/// assert_eq!(bounds.distance(Vec3::new(1.0, 7.0, 4.0)), 5.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner where all coordinates are least.
    pub low: Vec3,
    /// The corner where all coordinates are greatest.
    pub high: Vec3,
}

impl Bounds {
    /// The empty box: the neutral element of [`Bounds::union`].
    pub const EMPTY: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    /// All of space.
    pub const EVERYWHERE: Self = Self { low: Vec3::NEG_INFINITY, high: Vec3::INFINITY };

    /// Returns the smallest box that contains these points.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Self { low: b.low.min(p), high: b.high.max(p) })
    }

    /// Returns the smallest box that contains both boxes.
    pub fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Returns this box, enlarged on every side by a margin in metres.
    pub fn grown(self, margin: f32) -> Self {
        Self { low: self.low - margin, high: self.high + margin }
    }

    /// Returns the corners. Some coordinates of an infinite box are infinite.
    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            let pick = |axis: usize| if i >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] };
            Vec3::new(pick(0), pick(1), pick(2))
        })
    }

    /// Returns the centre of the part of the box within 10⁹ m of the origin along each axis.
    pub fn center(&self) -> Vec3 {
        const FAR: f32 = 1e9;
        (self.low.max(Vec3::splat(-FAR)) + self.high.min(Vec3::splat(FAR))) * 0.5
    }

    /// Whether the box is finite on every side and not empty.
    pub fn is_finite(&self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// Whether a point is in the box, sides included.
    pub fn contains(&self, point: Vec3) -> bool {
        self.low.cmple(point).all() && point.cmple(self.high).all()
    }

    /// Returns the distance of a point from the box, metres; 0 inside.
    pub fn distance(&self, point: Vec3) -> f32 {
        (self.low - point).max(point - self.high).max(Vec3::ZERO).length()
    }

    /// Returns a lower bound of the distance that a ball moves before it touches what is in the box; `None` if it never
    /// does. The ball is replaced by its bounding box, so near corners the bound is low.
    pub fn entry(&self, sweep: &Sweep) -> Option<f32> {
        let (mut enter, mut leave) = (0.0f32, sweep.reach);
        let grown = self.grown(sweep.radius);
        for axis in 0..3 {
            let (origin, direction) = (sweep.origin[axis], sweep.direction[axis]);
            let (low, high) = (grown.low[axis] - origin, grown.high[axis] - origin);
            if direction == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
            } else {
                let (near, far) = if direction > 0.0 { (low, high) } else { (high, low) };
                enter = enter.max(near / direction);
                leave = leave.min(far / direction);
            }
        }
        // slightly more, so that rounding does not lose contacts at the very side of the box
        (enter <= leave * (1.0 + 1e-5) + 1e-5).then_some(enter)
    }
}

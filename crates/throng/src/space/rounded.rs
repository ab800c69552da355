//! Rounded rectangles, the shapes of bodies: the points within a radius of a *core*. The core of a disc is a point,
//! that of a capsule a segment.

use glam::{DVec2, Vec2};

/// A rectangle in the plane, metres. With width 0 it is a segment, with length and width 0 a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Core {
    /// Its centre.
    pub center: DVec2,
    /// Unit vector along its length.
    pub along: DVec2,
    /// Half its length and half its width. Limit: >= 0.
    pub half: DVec2,
}

/// The separation of two cores.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoreSeparation {
    /// Their distance; if they overlap, the negative length of the shortest translation that separates them.
    pub distance: f64,
    /// Unit vector along which the distance is measured, from the first to the second.
    pub normal: DVec2,
}

/// Cores closer than this, metres, count as overlapping: the line between their nearest points is not reliable.
const CONTACT: f64 = 1e-9;

impl Core {
    /// Returns a core with these half extents at `center`, turned to `heading` (radians counter-clockwise from +x).
    pub fn new(center: DVec2, heading: f32, half: Vec2) -> Self {
        let (sin, cos) = libm::sincos(f64::from(heading));
        Self { center, along: DVec2::new(cos, sin), half: half.as_dvec2() }
    }

    /// Returns a core of length and width 0.
    pub fn point(center: DVec2) -> Self {
        Self { center, along: DVec2::X, half: DVec2::ZERO }
    }

    /// Returns a core of width 0.
    pub fn segment(start: DVec2, end: DVec2) -> Self {
        let along = (end - start).normalize_or(DVec2::X);
        Self { center: start.midpoint(end), along, half: DVec2::new(0.5 * start.distance(end), 0.0) }
    }

    /// Returns the corners, counter-clockwise.
    pub fn corners(&self) -> [DVec2; 4] {
        let (x, y) = (self.along * self.half.x, self.along.perp() * self.half.y);
        [x + y, y - x, -x - y, x - y].map(|corner| self.center + corner)
    }

    /// Returns the point of the core nearest to `p`.
    pub fn nearest(&self, p: DVec2) -> DVec2 {
        let (x, y) = (self.along, self.along.perp());
        let offset = p - self.center;
        let within = DVec2::new(offset.dot(x), offset.dot(y)).clamp(-self.half, self.half);
        self.center + x * within.x + y * within.y
    }

    /// Returns the extent of the core from its centre along a unit vector.
    pub fn extent(&self, normal: DVec2) -> f64 {
        self.half.x * normal.dot(self.along).abs() + self.half.y * normal.perp_dot(self.along).abs()
    }

    /// Returns the gap between this core and another along a unit vector from this to the other: at most their
    /// distance.
    pub fn gap_along(&self, other: &Self, normal: DVec2) -> f64 {
        normal.dot(other.center - self.center) - self.extent(normal) - other.extent(normal)
    }

    /// Returns the gap along the axis of either core along which it is widest: at most their distance. The cores overlap
    /// if it is negative.
    pub fn widest_gap(&self, other: &Self) -> CoreSeparation {
        let offset = other.center - self.center;
        let axes = [self.along, self.along.perp(), other.along, other.along.perp()].map(|axis| {
            let normal = if axis.dot(offset) < 0.0 { -axis } else { axis };
            CoreSeparation { distance: self.gap_along(other, normal), normal }
        });
        axes.into_iter().reduce(|a, b| if b.distance > a.distance { b } else { a }).unwrap_or(axes[0])
    }

    /// Returns the separation of two cores. Exchanging the cores reverses the normal exactly.
    pub fn separation(&self, other: &Self) -> CoreSeparation {
        let key = |core: &Self| [core.center, core.along, core.half].map(|v| [v.x, v.y]);
        if key(other) < key(self) {
            let CoreSeparation { distance, normal } = other.separation(self);
            return CoreSeparation { distance, normal: -normal };
        }
        // separating axes: rectangles overlap if no side of either separates them
        let widest = self.widest_gap(other);
        if widest.distance <= CONTACT {
            return widest;
        }
        // a corner of one core is nearest to the other
        let own = self.corners().map(|corner| other.nearest(corner) - corner);
        let theirs = other.corners().map(|corner| corner - self.nearest(corner));
        let between = own.into_iter().chain(theirs).min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let between = between.unwrap_or(other.center - self.center);
        CoreSeparation { distance: between.length(), normal: between.normalize_or(widest.normal) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn core() -> impl Strategy<Value = Core> {
        let extent = prop_oneof![Just(0.0f32), 0.0625f32..1.5];
        let extents = (extent.clone(), extent).prop_map(|(x, y)| Vec2::new(x, y));
        (-2.0..2.0, -2.0..2.0, -4.0f32..4.0, extents)
            .prop_map(|(x, y, heading, half)| Core::new(DVec2::new(x, y), heading, half))
    }

    /// Returns dense samples of the boundary.
    fn boundary(core: &Core) -> Vec<DVec2> {
        let corners = core.corners();
        let side = |i: usize| (0..=60).map(move |k| corners[i].lerp(corners[(i + 1) % 4], f64::from(k) / 60.0));
        (0..4).flat_map(side).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn the_separation_is_that_of_the_nearest_points(a in core(), b in core()) {
            let CoreSeparation { distance, normal } = a.separation(&b);
            let back = b.separation(&a);
            prop_assert_eq!((back.distance, back.normal), (distance, -normal));
            prop_assert!((a.gap_along(&b, normal) - distance).abs() < 1e-7, "the gap along the normal is the distance");
            let (of_a, of_b) = (boundary(&a), boundary(&b));
            let pairs = of_a.iter().flat_map(|p| of_b.iter().map(move |q| p.distance(*q)));
            let sampled = pairs.fold(f64::INFINITY, f64::min);
            if distance > 0.0 {
                prop_assert!(distance <= sampled + 1e-9 && distance >= sampled - 0.03, "{distance} {sampled}");
            } else {
                let inside = |core: &Core, p: DVec2| core.nearest(p).distance(p) < 1e-9;
                let crossed = sampled < 0.05;
                let within = of_a.iter().any(|&p| inside(&b, p)) || of_b.iter().any(|&p| inside(&a, p));
                prop_assert!(crossed || within, "{a:?} {b:?} do not overlap");
            }
        }

        /// If the cores overlap, no translation shorter than the depth separates them, and one of that length does.
        #[test]
        fn the_depth_is_the_least_shift_that_parts(a in core(), b in core()) {
            // near each other: most overlap
            let b = Core { center: a.center + (b.center - a.center) * 0.3, ..b };
            let CoreSeparation { distance, normal } = a.separation(&b);
            prop_assume!(distance < -1e-3);
            let moved = |shift: DVec2| Core { center: b.center + shift, ..b };
            prop_assert!(a.separation(&moved(normal * -distance * 1.0001)).distance > 0.0);
            for k in 0..64 {
                let shift = DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 64.0) * -distance * 0.999;
                prop_assert!(a.separation(&moved(shift)).distance <= CONTACT);
            }
        }
    }
}

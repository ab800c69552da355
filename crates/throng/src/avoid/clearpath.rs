//! The velocity closest to the preferred one outside all forbidden regions, by looking at every place where it can lie:
//! Guy et al., ClearPath: highly parallel collision avoidance for multi-agent simulation, SCA 2009, section 4.
//!
//! The free velocities have straight boundaries: legs of cones and lines. The closest free one is the preferred velocity
//! itself, or its projection on a boundary, or a crossing of two boundaries, or of one and the circle of greatest speed.

use super::Line;
use glam::Vec2;

/// Velocities that are forbidden.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Forbidden {
    /// A cone.
    Cone {
        /// Its tip.
        apex: Vec2,
        /// Unit vector along its right leg.
        right: Vec2,
        /// Unit vector along its left leg.
        left: Vec2,
    },
    /// What is right of a line.
    RightOf(Line),
}

/// How deep within a region counts as outside, m/s.
const TOUCH: f32 = 1e-4;

impl Forbidden {
    /// How deep `v` lies within, at most zero outside. m/s
    pub fn depth(&self, v: Vec2) -> f32 {
        match *self {
            Self::Cone { apex, right, left } => {
                let v = v - apex;
                right.perp_dot(v).min(v.perp_dot(left))
            }
            Self::RightOf(line) => line.violation(v),
        }
    }

    /// Its boundaries: a point, a unit vector, and whether it ends at the point.
    fn boundaries(&self) -> impl Iterator<Item = (Vec2, Vec2, bool)> {
        let (first, second) = match *self {
            Self::Cone { apex, right, left } => ((apex, right, true), Some((apex, left, true))),
            Self::RightOf(line) => ((line.point, line.direction, false), None),
        };
        std::iter::once(first).chain(second)
    }
}

/// The velocity within `max_speed` closest to `preferred` that is in none of the regions. Where every one is in some,
/// the one whose first region in the list comes last: put what matters most first.
pub fn closest_outside(regions: &[Forbidden], max_speed: f32, preferred: Vec2) -> Vec2 {
    let preferred = preferred.clamp_length_max(max_speed);
    let mut best = (0, f32::INFINITY, Vec2::ZERO);
    let mut consider = |v: Vec2| {
        if v.length_squared() > max_speed * max_speed * 1.0001 {
            return;
        }
        let distance = v.distance_squared(preferred);
        if best.0 == regions.len() && distance >= best.1 {
            return;
        }
        let clear = regions.iter().position(|region| region.depth(v) > TOUCH).unwrap_or(regions.len());
        if clear > best.0 || clear == best.0 && distance < best.1 {
            best = (clear, distance, v);
        }
    };
    consider(preferred);
    consider(Vec2::ZERO);
    for (i, region) in regions.iter().enumerate() {
        for (point, along, ends) in region.boundaries() {
            let reach = |t: f32| !ends || t >= 0.0;
            let nearest = (preferred - point).dot(along);
            consider(point + along * if ends { nearest.max(0.0) } else { nearest });
            // crossings with the circle of greatest speed
            let middle = point.dot(along);
            let root = middle * middle - point.length_squared() + max_speed * max_speed;
            if root >= 0.0 {
                for t in [-middle - root.sqrt(), -middle + root.sqrt()] {
                    if reach(t) {
                        consider(point + along * t);
                    }
                }
            }
            for other in &regions[..i] {
                for (origin, across, stops) in other.boundaries() {
                    let sine = along.perp_dot(across);
                    if sine.abs() < 1e-6 {
                        continue;
                    }
                    let t = (origin - point).perp_dot(across) / sine;
                    let u = (origin - point).perp_dot(along) / sine;
                    if reach(t) && (!stops || u >= 0.0) {
                        consider(point + along * t);
                    }
                }
            }
        }
    }
    best.2
}

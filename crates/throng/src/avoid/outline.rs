//! Bodies that are no discs, as models see them: a point against a rounded convex polygon, the Minkowski difference of the
//! two cores. A body collides when the point, which moves with the relative velocity, comes within the sum of the radii
//! of the polygon.

use super::Neighbour;
use super::collision::{time_to_disc, time_to_segment};
use super::obstacle_lines::tangents;
use crate::space::Core;
use glam::{DVec2, Vec2};
use std::cmp::Ordering;

/// A convex polygon of at most eight corners, counter-clockwise; one corner at zero for two discs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    corners: [Vec2; 8],
    count: u8,
}

/// Corners nearer to each other than this, metres, are one.
const SAME: f64 = 1e-6;

impl Outline {
    /// Two discs.
    pub const POINT: Self = Self { corners: [Vec2::ZERO; 8], count: 1 };

    /// The differences of points of `other` and points of `own`, seen from that of the centres.
    pub fn between(own: &Core, other: &Core) -> Self {
        let sides = [own, other].map(|core| [core.along * core.half.x, core.along.perp() * core.half.y]);
        // halves of both cores' sides in the order of their directions: half of the way round, the rest is opposite
        let mut halves = [DVec2::ZERO; 4];
        let mut count = 0;
        for &side in sides.as_flattened() {
            if side.length() > SAME {
                halves[count] = if side.y < 0.0 || side.y == 0.0 && side.x < 0.0 { -side } else { side };
                count += 1;
            }
        }
        let sides = &mut halves[..count];
        // parallel ones stay as they are, however sorts are done
        sides.sort_by(|a, b| 0.0f64.partial_cmp(&a.perp_dot(*b)).unwrap_or(Ordering::Equal));
        let mut outline = Self::POINT;
        let mut at = -sides.iter().sum::<DVec2>();
        outline.corners[0] = at.as_vec2();
        for (k, side) in sides.iter().enumerate() {
            at += 2.0 * *side;
            outline.corners[k + 1] = at.as_vec2();
        }
        // the corner opposite the first is there already
        for k in 1..sides.len() {
            outline.corners[sides.len() + k] = -outline.corners[k];
        }
        outline.count = (2 * sides.len()).max(1) as u8;
        outline
    }

    /// Its corners.
    pub fn corners(&self) -> &[Vec2] {
        &self.corners[..usize::from(self.count)]
    }

    /// Whether it is that of two discs.
    pub fn is_point(&self) -> bool {
        self.count == 1
    }

    /// Its sides: start, and unit vector out of the polygon across it.
    fn sides(&self) -> impl Iterator<Item = (Vec2, Vec2)> {
        let corners = self.corners();
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(&a, &b)| (a, -(b - a).perp().normalize_or_zero()))
    }

    /// Seconds until a point that moves with `velocity` comes within `radii` of the polygon at `offset`; infinite if it
    /// never does. Who is already within and comes nearer collides now.
    pub fn time_to_collision(&self, offset: Vec2, velocity: Vec2, radii: f32) -> f32 {
        if self.is_point() {
            return time_to_disc(offset, velocity, radii);
        }
        let (distance, normal) = self.boundary(offset, Vec2::ZERO, 1.0, radii, None);
        if distance <= 0.0 {
            return if velocity.dot(normal) < 0.0 { 0.0 } else { f32::INFINITY };
        }
        let corners = self.corners();
        let next = corners.iter().cycle().skip(1);
        let sides = corners.iter().zip(next);
        sides.map(|(&a, &b)| time_to_segment(offset + a, offset + b, velocity, radii)).fold(f32::INFINITY, f32::min)
    }

    /// Unit vectors from the origin along the tangents to the rounded polygon at `offset`: left and right. The origin
    /// must be outside of it.
    pub fn tangents(&self, offset: Vec2, radii: f32) -> (Vec2, Vec2) {
        if self.is_point() {
            return tangents(offset, radii);
        }
        let both = self.corners().iter().map(|&corner| tangents(offset + corner, radii));
        both.reduce(|(left, right), (other_left, other_right)| {
            let leftmost = if left.perp_dot(other_left) > 0.0 { other_left } else { left };
            (leftmost, if right.perp_dot(other_right) < 0.0 { other_right } else { right })
        })
        .unwrap_or((Vec2::X, Vec2::X))
    }

    /// Whether the origin is within `radii` of the polygon at `offset`.
    pub fn touches(&self, offset: Vec2, radii: f32) -> bool {
        if self.is_point() {
            return offset.length_squared() <= radii * radii;
        }
        self.boundary(offset, Vec2::ZERO, 1.0, radii, None).0 <= 0.0
    }

    /// How far a velocity is outside of what leads into the rounded polygon within `time` seconds, negative inside, and
    /// the unit normal of the boundary where it is nearest. With the tangents given: what leads into it at any moment
    /// until then, the truncated velocity obstacle; without: at that very moment.
    ///
    /// Both are convex, so the distance is the greatest, over the directions `n` in which the boundary faces, of
    /// `n . v` less the farthest that the set reaches along `n`. The truncated obstacle faces only where `n` points along
    /// neither leg, and reaches there as far as the polygon at the end of the time. The greatest is found at a side, at
    /// a leg, or on the line to a corner.
    pub fn boundary(
        &self,
        offset: Vec2,
        velocity: Vec2,
        time: f32,
        radii: f32,
        legs: Option<(Vec2, Vec2)>,
    ) -> (f32, Vec2) {
        let corners = self.corners().iter().map(|&corner| (offset + corner) / time);
        let within = |normal: Vec2| {
            legs.is_none_or(|(left, right)| normal.dot(left) <= TURNED_AWAY && normal.dot(right) <= TURNED_AWAY)
        };
        let legs = legs.map(|(left, right)| [left.perp(), -right.perp()]);
        let sides = self.sides().map(|(_, normal)| normal);
        let lines = corners.clone().map(|corner| (velocity - corner).normalize_or_zero());
        let normals = legs.into_iter().flatten().chain(sides.chain(lines).filter(|&normal| within(normal)));
        let depth =
            |normal: Vec2| corners.clone().map(|corner| normal.dot(velocity - corner)).fold(f32::INFINITY, f32::min);
        let normals = normals.filter(|&normal| normal != Vec2::ZERO).map(|normal| (depth(normal), normal));
        let nearest = normals.reduce(|a, b| if b.0 > a.0 { b } else { a }).unwrap_or((0.0, Vec2::ZERO));
        (nearest.0 - radii / time, nearest.1)
    }
}

impl Default for Outline {
    fn default() -> Self {
        Self::POINT
    }
}

impl Neighbour {
    /// Seconds until the two collide if they keep this relative velocity, own less the neighbour's; infinite if they
    /// never do. Who already touches and comes nearer collides now.
    pub fn time_to_collision(&self, relative: Vec2) -> f32 {
        self.outline.time_to_collision(self.offset, relative, self.radii)
    }

    /// Whether the two touch or overlap.
    pub fn touches(&self) -> bool {
        self.outline.touches(self.offset, self.radii)
    }

    /// Unit vectors along the legs of the velocity obstacle: left and right. The two must not touch.
    pub fn legs(&self) -> (Vec2, Vec2) {
        self.outline.tangents(self.offset, self.radii)
    }

    /// The least change of a relative velocity to the boundary of those that lead to a collision within `horizon`
    /// seconds, and the unit normal out of them there; of two who touch, of those that leave them so after `recovery`.
    pub(super) fn change(&self, relative: Vec2, horizon: f32, recovery: f32) -> (Vec2, Vec2) {
        let touches = self.touches();
        let legs = (!touches).then(|| self.legs());
        let time = if touches { recovery } else { horizon };
        let (distance, normal) = self.outline.boundary(self.offset, relative, time, self.radii, legs);
        let normal = if normal == Vec2::ZERO { self.aside } else { normal };
        (normal * -distance, normal)
    }
}

/// Cosine up to which a normal counts as across a leg or turned away from it.
const TURNED_AWAY: f32 = 1e-6;

//! Bodies that are not discs, as models see them: a point and a rounded convex polygon, the Minkowski difference of the
//! two cores. The bodies collide when the point, which moves with the relative velocity, comes within the sum of the
//! radii of the polygon.

use super::AvoidanceNeighbour;
use super::obstacle_lines::tangents;
use crate::space::Core;
use crate::space::{time_to_disc, time_to_segment};
use glam::{DVec2, Vec2};
use std::cmp::Ordering;

/// A convex polygon of at most eight corners, counter-clockwise. For two discs it is one corner at zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    corners: [Vec2; 8],
    count: u8,
}

/// Corners closer than this, metres, count as one.
const SAME: f64 = 1e-6;

impl Outline {
    /// The outline of two discs.
    pub const POINT: Self = Self { corners: [Vec2::ZERO; 8], count: 1 };

    /// Returns the differences of points of `other` and points of `own`, relative to the difference of the centres.
    pub fn between(own: &Core, other: &Core) -> Self {
        let sides = [own, other].map(|core| [core.along * core.half.x, core.along.perp() * core.half.y]);
        // half sides of both cores, ordered by direction over half a turn; the other half is opposite
        let mut halves = [DVec2::ZERO; 4];
        let mut count = 0;
        for &side in sides.as_flattened() {
            if side.length() > SAME {
                halves[count] = if side.y < 0.0 || side.y == 0.0 && side.x < 0.0 { -side } else { side };
                count += 1;
            }
        }
        let sides = &mut halves[..count];
        // parallel sides keep their order in any stable sort
        sides.sort_by(|a, b| 0.0f64.partial_cmp(&a.perp_dot(*b)).unwrap_or(Ordering::Equal));
        let mut outline = Self::POINT;
        let mut at = -sides.iter().sum::<DVec2>();
        outline.corners[0] = at.as_vec2();
        for (k, side) in sides.iter().enumerate() {
            at += 2.0 * *side;
            outline.corners[k + 1] = at.as_vec2();
        }
        // the corner opposite the first is in the list already
        for k in 1..sides.len() {
            outline.corners[sides.len() + k] = -outline.corners[k];
        }
        outline.count = (2 * sides.len()).max(1) as u8;
        outline
    }

    /// Returns the corners.
    pub fn corners(&self) -> &[Vec2] {
        &self.corners[..usize::from(self.count)]
    }

    /// Whether this is the outline of two discs.
    pub fn is_point(&self) -> bool {
        self.count == 1
    }

    /// Returns the sides: the start, and the unit normal out of the polygon.
    fn sides(&self) -> impl Iterator<Item = (Vec2, Vec2)> {
        let corners = self.corners();
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(&a, &b)| (a, -(b - a).perp().normalize_or_zero()))
    }

    /// Returns the seconds until a point that moves with `velocity` comes within `radii` of the polygon at `offset`;
    /// infinite if it never does. A point that is already within and comes nearer collides now.
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

    /// Returns unit vectors from the origin along the tangents to the rounded polygon at `offset`: left and right. The
    /// origin must be outside of the rounded polygon.
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

    /// Returns the signed distance of a velocity from the velocities that lead into the rounded polygon (negative
    /// inside), and the unit normal at the nearest point of their boundary. With the tangents in `legs` these are the
    /// velocities that lead into it at any time up to `time` seconds, the truncated velocity obstacle. Without, those
    /// that lead into it at that time exactly.
    ///
    /// Both sets are convex, so the distance is the maximum, over the directions `n` of outward normals, of `n . v`
    /// less the extent of the set along `n`. The truncated obstacle has only normals that point along neither leg.
    /// Along these its extent is that of the polygon at the end of the time. The maximum is found at a side, at a leg,
    /// or on the line to a corner.
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

impl AvoidanceNeighbour {
    /// Returns the seconds until the two collide if they keep this relative velocity, the agent's less the neighbour's;
    /// infinite if they never do. Two that touch and come nearer collide now.
    pub fn time_to_collision(&self, relative: Vec2) -> f32 {
        self.outline.time_to_collision(self.offset, relative, self.radii)
    }

    /// Whether the two touch or overlap.
    pub fn touches(&self) -> bool {
        self.outline.touches(self.offset, self.radii)
    }

    /// Returns unit vectors along the legs of the velocity obstacle: left and right. The two must not touch.
    pub fn legs(&self) -> (Vec2, Vec2) {
        self.outline.tangents(self.offset, self.radii)
    }

    /// Returns the smallest change of a relative velocity to the boundary of the velocities that lead to a collision
    /// within `horizon` seconds, and the outward unit normal there. For two that touch, the velocities in question are
    /// those with which they still touch after `recovery` seconds.
    pub(super) fn change(&self, relative: Vec2, horizon: f32, recovery: f32) -> (Vec2, Vec2) {
        let touches = self.touches();
        let legs = (!touches).then(|| self.legs());
        let time = if touches { recovery } else { horizon };
        let (distance, normal) = self.outline.boundary(self.offset, relative, time, self.radii, legs);
        let normal = if normal == Vec2::ZERO { self.aside } else { normal };
        (normal * -distance, normal)
    }
}

/// Greatest cosine at which a normal counts as across a leg or turned away from it.
const TURNED_AWAY: f32 = 1e-6;

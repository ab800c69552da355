//! Half-planes of wall edges, as in RVO2 (`Agent::computeNewVelocity`): an edge forbids the velocities that lead the
//! body to the edge within the time horizon, a truncated cone between the tangents at its ends. Standing still is
//! always permitted.

use super::half_plane::HalfPlane;
use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Cause, NearEdge, Workspace};
use crate::motion::followable;
use glam::Vec2;

const EPSILON: f32 = 1e-5;

impl Workspace {
    /// Collects the half-planes that walls permit to a body of `radius`, and those of the velocities that the body can
    /// follow, with the cause of each. All of them permit standing still.
    pub fn permit(&mut self, view: &AvoidanceInput<'_>, radius: f32, horizon: f32) {
        let Self { lines, causes, .. } = self;
        lines.clear();
        causes.clear();
        let mut push = |lines: &mut Vec<HalfPlane>, cause: Cause, line: HalfPlane| {
            lines.push(line);
            causes.push(cause);
        };
        for (index, near) in view.edges.iter().enumerate() {
            if !covered(lines, near, radius, horizon)
                && let Some(line) = of_edge(near, view.velocity, radius, horizon)
            {
                push(lines, Cause::Edge(index), line);
            }
        }
        for (index, near) in view.discs.iter().enumerate() {
            let disc = AvoidanceNeighbour::resting(near.offset, near.disc.radius as f32 + radius);
            let disc = AvoidanceNeighbour { outline: near.outline, ..disc };
            push(lines, Cause::Disc(index), disc.half_plane(view.velocity, horizon, view.step));
        }
        if view.tracking_error > 0.0 {
            let corners = followable(view.tracking_error, view.heading, view.max_speed, view.max_turn_rate);
            for side in corners.windows(2) {
                if let Some(direction) = (side[1] - side[0]).try_normalize() {
                    push(lines, Cause::Body, HalfPlane { point: side[0], direction });
                }
            }
        }
    }
}

impl Workspace {
    /// Returns the half-planes as reasons: first those collected by [`permit`](Self::permit), then one per neighbour.
    pub fn permissions(&self) -> Vec<AvoidanceReason> {
        let neighbours = (0..).map(Cause::Neighbour);
        let causes = self.causes.iter().copied().chain(neighbours);
        causes.zip(&self.lines).map(|(cause, &line)| AvoidanceReason::Permits(cause, line)).collect()
    }
}

/// Whether a line in the list already forbids everything that this edge would forbid.
fn covered(lines: &[HalfPlane], near: &NearEdge, radius: f32, horizon: f32) -> bool {
    lines.iter().any(|line| {
        [near.start, near.end].into_iter().all(|end| line.violation(end / horizon) >= radius / horizon - EPSILON)
    })
}

/// Returns the half-plane through zero that forbids moving towards `offset`.
fn facing(offset: Vec2) -> Option<HalfPlane> {
    let direction = offset.perp().normalize_or_zero();
    Some(HalfPlane { point: Vec2::ZERO, direction })
}

/// Returns unit vectors from the origin along the tangents to the disc at `offset`: left and right.
pub(super) fn tangents(offset: Vec2, radius: f32) -> (Vec2, Vec2) {
    let distance_squared = offset.length_squared();
    let leg = (distance_squared - radius * radius).max(0.0).sqrt();
    let left = Vec2::new(offset.x * leg - offset.y * radius, offset.x * radius + offset.y * leg);
    let right = Vec2::new(offset.x * leg + offset.y * radius, offset.y * leg - offset.x * radius);
    (left / distance_squared, right / distance_squared)
}

fn of_edge(near: &NearEdge, velocity: Vec2, radius: f32, horizon: f32) -> Option<HalfPlane> {
    let edge = &near.edge;
    let (start, end) = (near.start, near.end);
    let along = end - start;
    // seen from the solid side, another edge is in front
    if along.perp_dot(-start) > 0.0 {
        return None;
    }
    let radius_squared = radius * radius;
    let s = -start.dot(along) / along.length_squared();
    let off_line = (start + along * s).length_squared();

    // the body touches the edge
    if s < 0.0 && start.length_squared() <= radius_squared {
        return if edge.convex_start { facing(start) } else { None };
    }
    if s > 1.0 && end.length_squared() <= radius_squared {
        // this corner is the start of the next edge too, which handles it unless it faces away
        return if edge.convex_end && end.perp_dot(edge.next) >= 0.0 { facing(end) } else { None };
    }
    if (0.0..=1.0).contains(&s) && off_line <= radius_squared {
        return Some(HalfPlane { point: Vec2::ZERO, direction: -edge.direction });
    }

    // the legs; an edge seen lengthwise has one visible corner
    let oblique = off_line <= radius_squared;
    let (left_corner, right_corner) = match (oblique, s < 0.0) {
        (true, true) => (start, start),
        (true, false) => (end, end),
        (false, _) => (start, end),
    };
    let one_corner = oblique;
    if one_corner && !(if s < 0.0 { edge.convex_start } else { edge.convex_end }) {
        return None;
    }
    let at_start = left_corner == start;
    let at_end = right_corner == end;
    let left_convex = if at_start { edge.convex_start } else { edge.convex_end };
    let right_convex = if at_end { edge.convex_end } else { edge.convex_start };
    let mut left = if left_convex { tangents(left_corner, radius).0 } else { -edge.direction };
    let mut right = if right_convex { tangents(right_corner, radius).1 } else { edge.direction };

    // a leg that would lead into the neighbouring edge is left to that edge
    let before_left = if at_start { edge.previous } else { edge.direction };
    let after_right = if at_end { edge.next } else { edge.direction };
    let mut left_foreign = false;
    let mut right_foreign = false;
    if left_convex && left.perp_dot(-before_left) >= 0.0 {
        left = -before_left;
        left_foreign = true;
    }
    if right_convex && right.perp_dot(after_right) <= 0.0 {
        right = after_right;
        right_foreign = true;
    }

    let (left_cut, right_cut) = (left_corner / horizon, right_corner / horizon);
    let rounding = radius / horizon;
    let from_left = velocity - left_cut;
    let from_right = velocity - right_cut;
    let cut = right_cut - left_cut;
    let t = if one_corner { 0.5 } else { from_left.dot(cut) / cut.length_squared() };
    let t_left = from_left.dot(left);
    let t_right = from_right.dot(right);

    let round = |cut: Vec2, from: Vec2| {
        let normal = from.normalize_or(-cut.normalize_or(Vec2::X));
        Some(HalfPlane { point: cut + normal * rounding, direction: Vec2::new(normal.y, -normal.x) })
    };
    if (t < 0.0 && t_left < 0.0) || (one_corner && t_left < 0.0 && t_right < 0.0) {
        return round(left_cut, from_left);
    }
    if t > 1.0 && t_right < 0.0 {
        return round(right_cut, from_right);
    }

    let to_cut = if !(0.0..=1.0).contains(&t) || one_corner {
        f32::INFINITY
    } else {
        velocity.distance_squared(left_cut + cut * t)
    };
    let to_left = if t_left < 0.0 { f32::INFINITY } else { velocity.distance_squared(left_cut + left * t_left) };
    let to_right = if t_right < 0.0 { f32::INFINITY } else { velocity.distance_squared(right_cut + right * t_right) };
    let along_side =
        |corner: Vec2, direction: Vec2| Some(HalfPlane { point: corner + direction.perp() * rounding, direction });
    if to_cut <= to_left && to_cut <= to_right {
        along_side(left_cut, -edge.direction)
    } else if to_left <= to_right {
        if left_foreign { None } else { along_side(left_cut, left) }
    } else if right_foreign {
        None
    } else {
        along_side(right_cut, -right)
    }
}

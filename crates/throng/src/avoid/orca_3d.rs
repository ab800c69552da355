//! Optimal reciprocal collision avoidance in space: van den Berg, Guy, Lin, Manocha, Reciprocal n-body collision
//! avoidance, ISRR 2009 (section 4, in three dimensions), as in RVO2-3D.
//!
//! As [`Orca`](super::Orca), with half-spaces: the velocities that lead to a collision within the time horizon are a
//! cone with a rounded tip about the line to the neighbour. Walls stand upright and are taken to be infinitely high.
//! Each permits the half-space in front of its point nearest to the body.

use super::half_space::{HalfSpace, closest_velocity_in_space, least_violation_in_space};
use super::{AvoidanceInput, AvoidanceNeighbour, LocalModel, Workspace};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::{Vec2, Vec3};

/// Optimal reciprocal collision avoidance in space, for agents that fly.
///
/// ```
/// use throng::avoid::Orca3d;
/// let drones = Orca3d { vertical_scale: 2.0, ..Orca3d::default() };
/// ```
#[parameters(name = "orca_3d")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orca3d {
    /// Seconds ahead for which a velocity must be safe from other agents.
    #[parameter(default = 2.0, unit = "s", above = 0)]
    pub time_horizon: f32,
    /// Seconds ahead for which a velocity must be safe from obstacles.
    #[parameter(default = 0.7, unit = "s", above = 0)]
    pub time_horizon_obstacles: f32,
    /// Factor by which bodies are taken to be taller than they are: above 1 agents prefer to avoid sideways.
    #[parameter(default = 1.0, least = 1, most = 10)]
    pub vertical_scale: f32,
}

impl LocalModel for Orca3d {
    /// Returns the horizontal part of [`velocity_in_space`](Self::velocity_in_space).
    fn velocity(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec2 {
        self.velocity_in_space(view, workspace).truncate()
    }

    fn velocity_in_space(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec3 {
        // shrinking the vertical axis turns the stretched bodies into spheres
        let shrink = Vec3::new(1.0, 1.0, 1.0 / self.vertical_scale);
        let velocity = view.velocity.extend(view.vertical_velocity) * shrink;
        let Workspace { planes, fallback_planes, .. } = workspace;
        planes.clear();
        for near in view.edges {
            let nearest = nearest_on_edge(near.start, near.end);
            planes.push(wall(nearest, view.radius, self.time_horizon_obstacles));
        }
        for near in view.discs {
            let nearest = near.offset - near.offset.normalize_or(Vec2::X) * near.disc.radius as f32;
            planes.push(wall(nearest, view.radius, self.time_horizon_obstacles));
        }
        let hard = planes.len();
        planes.extend(view.neighbours.iter().map(|other| {
            let offset = other.offset.extend(other.above) * shrink;
            let theirs = other.velocity.extend(other.vertical_velocity) * shrink;
            let HalfSpace { point, normal } = plane(velocity, offset, theirs, other, self.time_horizon, view.step);
            // the same half-space in unscaled space
            HalfSpace { point: point / shrink, normal: (normal * shrink).normalize() }
        }));
        let preferred = view.preferred.extend(view.preferred_vertical_velocity);
        closest_velocity_in_space(planes, view.max_speed, preferred)
            .unwrap_or_else(|failed| least_violation_in_space(planes, hard, view.max_speed, failed, fallback_planes))
    }

    fn looks_in_space(&self) -> bool {
        true
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.time_horizon_obstacles * max_speed + radius
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// Returns the point of an edge nearest to the origin.
fn nearest_on_edge(start: Vec2, end: Vec2) -> Vec2 {
    let along = end - start;
    start + along * (-start.dot(along) / along.length_squared()).clamp(0.0, 1.0)
}

/// Returns the half-space that a wall with this nearest point permits: the body does not reach the wall within the
/// horizon, or comes no nearer if it touches the wall.
fn wall(nearest: Vec2, radius: f32, horizon: f32) -> HalfSpace {
    let distance = nearest.length();
    let normal = (-nearest).normalize_or(Vec2::X);
    let point = normal * -((distance - radius).max(0.0) / horizon);
    HalfSpace { point: point.extend(0.0), normal: normal.extend(0.0) }
}

/// Seconds over which an overlap, or a margin that is used up, is restored.
const RECOVERY: f32 = 0.25;

/// Returns the half-space that a neighbour permits to an agent of the given velocity.
fn plane(velocity: Vec3, offset: Vec3, theirs: Vec3, other: &AvoidanceNeighbour, horizon: f32, step: f32) -> HalfSpace {
    let radii = other.radii;
    let relative = velocity - theirs;
    let distance_squared = offset.length_squared();
    let out_of = |horizon: f32| {
        let w = relative - offset / horizon;
        let length = w.length();
        let normal = if length > 1e-6 { w / length } else { other.aside.extend(0.0) };
        (normal * (radii / horizon - length), normal)
    };
    let (change, normal) = if distance_squared <= radii * radii {
        // too close: move apart within the recovery time
        out_of(step.max(RECOVERY))
    } else {
        let w = relative - offset / horizon;
        let along = w.dot(offset);
        if along < 0.0 && along * along > radii * radii * w.length_squared() {
            // nearest on the rounded tip
            out_of(horizon)
        } else {
            // nearest on the cone, on its side in the plane through its axis and the relative velocity
            let distance = distance_squared.sqrt();
            let (axis, sine) = (offset / distance, radii / distance);
            let cosine = (1.0 - sine * sine).max(0.0).sqrt();
            let ahead = relative.dot(axis);
            let aside = relative - axis * ahead;
            let (aside, off) = (aside.try_normalize(), aside.length());
            let normal = aside.unwrap_or_else(|| axis.any_orthonormal_vector()) * cosine - axis * sine;
            (normal * (ahead * sine - off * cosine), normal)
        }
    };
    let part = if change.dot(normal) > 0.0 { other.share } else { other.room };
    HalfSpace { point: velocity + change * part, normal }
}

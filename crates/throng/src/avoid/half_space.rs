//! Half-spaces of permitted velocities, and the velocity in all of them that is closest to the preferred one: the
//! counterpart of [`half_plane`](super::half_plane) in space, by incremental linear programming.

use glam::Vec3;

/// A half-space of permitted velocities: those on a plane or on the side of its normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// A point of the plane.
    pub point: Vec3,
    /// Its unit normal.
    pub normal: Vec3,
}

impl HalfSpace {
    /// Returns how far `v` lies on the forbidden side, m/s; negative on the permitted side.
    pub fn violation(&self, v: Vec3) -> f32 {
        (self.point - v).dot(self.normal)
    }
}

/// Two planes closer to parallel than this (sine of the angle) count as parallel.
const PARALLEL: f32 = 1e-4;

/// The objective of an optimisation.
#[derive(Clone, Copy)]
enum Objective3d {
    /// As close to this velocity as possible.
    Point(Vec3),
    /// As far in this unit direction as possible.
    Direction(Vec3),
}

/// Returns the line in which two planes intersect; `None` if they are parallel.
fn meet(plane: &HalfSpace, other: &HalfSpace) -> Option<(Vec3, Vec3)> {
    let along = other.normal.cross(plane.normal);
    let along = along.try_normalize().filter(|_| along.length() > PARALLEL)?;
    // across the line, within the plane
    let across = along.cross(plane.normal);
    let point = plane.point + across * ((other.point - plane.point).dot(other.normal) / across.dot(other.normal));
    Some((point, along))
}

/// Returns the best point on a line within the sphere of speeds and the planes.
fn on_line((point, along): (Vec3, Vec3), planes: &[HalfSpace], speed: f32, aim: Objective3d) -> Option<Vec3> {
    let middle = point.dot(along);
    let discriminant = middle * middle + speed * speed - point.length_squared();
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let (mut low, mut high) = (-middle - root, -middle + root);
    for plane in planes {
        let (numerator, denominator) = (plane.violation(point), along.dot(plane.normal));
        if denominator.abs() <= PARALLEL {
            if numerator > 0.0 {
                return None;
            }
            continue;
        }
        let t = numerator / denominator;
        if denominator > 0.0 {
            low = low.max(t);
        } else {
            high = high.min(t);
        }
        if low > high {
            return None;
        }
    }
    let t = match aim {
        Objective3d::Direction(aim) if aim.dot(along) > 0.0 => high,
        Objective3d::Direction(_) => low,
        Objective3d::Point(aim) => along.dot(aim - point).clamp(low, high),
    };
    Some(point + along * t)
}

/// Returns the best point on plane `i` within the sphere of speeds and the planes before it.
fn on_plane(planes: &[HalfSpace], i: usize, speed: f32, aim: Objective3d) -> Option<Vec3> {
    let plane = planes[i];
    let distance = plane.point.dot(plane.normal);
    if distance.abs() > speed {
        return None;
    }
    // the circle in which the plane cuts the sphere
    let center = plane.normal * distance;
    let radius = (speed * speed - distance * distance).sqrt();
    let mut v = match aim {
        Objective3d::Direction(aim) => center + aim.reject_from_normalized(plane.normal).normalize_or_zero() * radius,
        Objective3d::Point(aim) => center + (aim.reject_from_normalized(plane.normal)).clamp_length_max(radius),
    };
    for (j, other) in planes[..i].iter().enumerate() {
        if other.violation(v) > 0.0 {
            v = on_line(meet(&plane, other)?, &planes[..j], speed, aim)?;
        }
    }
    Some(v)
}

/// Returns the best velocity, or the index of the plane that made the problem infeasible and the best velocity before
/// it.
fn within_planes(planes: &[HalfSpace], speed: f32, aim: Objective3d) -> Result<Vec3, (usize, Vec3)> {
    let mut v = match aim {
        Objective3d::Direction(aim) => aim * speed,
        Objective3d::Point(aim) => aim.clamp_length_max(speed),
    };
    for (i, plane) in planes.iter().enumerate() {
        if plane.violation(v) > 0.0 {
            v = on_plane(planes, i, speed, aim).ok_or((i, v))?;
        }
    }
    Ok(v)
}

/// Returns the velocity closest to `preferred`, no faster than `speed`, that all planes permit.
///
/// # Errors
/// If there is none: the index of the first plane that cannot be satisfied together with those before it, and the best
/// velocity without that plane.
pub fn closest_velocity_in_space(planes: &[HalfSpace], speed: f32, preferred: Vec3) -> Result<Vec3, (usize, Vec3)> {
    within_planes(planes, speed, Objective3d::Point(preferred))
}

/// Returns the velocity, no faster than `speed`, that minimises the greatest violation of the planes from `hard` on.
/// The first `hard` planes are satisfied. `failed` and `best` are the error of [`closest_velocity_in_space`].
pub fn least_violation_in_space(
    planes: &[HalfSpace],
    hard: usize,
    speed: f32,
    (failed, best): (usize, Vec3),
    workspace: &mut Vec<HalfSpace>,
) -> Vec3 {
    let mut v = best;
    let mut violation = 0.0;
    for i in failed..planes.len() {
        let plane = planes[i];
        if plane.violation(v) <= violation {
            continue;
        }
        workspace.clear();
        workspace.extend_from_slice(&planes[..hard.min(i)]);
        for other in &planes[hard.min(i)..i] {
            // a point at which both are violated equally
            let point = match meet(&plane, other) {
                Some((point, _)) => point,
                None if plane.normal.dot(other.normal) > 0.0 => continue,
                None => (plane.point + other.point) * 0.5,
            };
            workspace.push(HalfSpace { point, normal: (other.normal - plane.normal).normalize_or_zero() });
        }
        // this fails only because of rounding: then the velocity so far is as good
        if let Ok(better) = within_planes(workspace, speed, Objective3d::Direction(plane.normal)) {
            v = better;
        }
        violation = plane.violation(v);
    }
    v
}

//! Half-spaces of permitted velocities, and the velocity in all of them that is closest to the preferred one: what
//! [`half_plane`](super::half_plane) does, one dimension up, by incremental linear programming.

use glam::Vec3;

/// A half-space of permitted velocities: what lies on the plane or where its normal points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// A point of the plane.
    pub point: Vec3,
    /// Its unit normal.
    pub normal: Vec3,
}

impl Plane {
    /// How far `v` lies on the forbidden side, negative on the permitted one. m/s
    pub fn violation(&self, v: Vec3) -> f32 {
        (self.point - v).dot(self.normal)
    }
}

/// Two planes closer to parallel than this (sine of the angle) count as parallel.
const PARALLEL: f32 = 1e-4;

/// What an optimum is sought for.
#[derive(Clone, Copy)]
enum Aim {
    /// As close to this velocity as possible.
    Point(Vec3),
    /// As far in this unit direction as possible.
    Direction(Vec3),
}

/// The line in which a plane meets another; none for planes that are parallel.
fn meet(plane: &Plane, other: &Plane) -> Option<(Vec3, Vec3)> {
    let along = other.normal.cross(plane.normal);
    let along = along.try_normalize().filter(|_| along.length() > PARALLEL)?;
    // across the line, within the plane
    let across = along.cross(plane.normal);
    let point = plane.point + across * ((other.point - plane.point).dot(other.normal) / across.dot(other.normal));
    Some((point, along))
}

/// The best point on a line within the sphere of speeds and the planes.
fn on_line((point, along): (Vec3, Vec3), planes: &[Plane], speed: f32, aim: Aim) -> Option<Vec3> {
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
        Aim::Direction(aim) if aim.dot(along) > 0.0 => high,
        Aim::Direction(_) => low,
        Aim::Point(aim) => along.dot(aim - point).clamp(low, high),
    };
    Some(point + along * t)
}

/// The best point on plane `i` within the sphere of speeds and the planes before it.
fn on_plane(planes: &[Plane], i: usize, speed: f32, aim: Aim) -> Option<Vec3> {
    let plane = planes[i];
    let distance = plane.point.dot(plane.normal);
    if distance.abs() > speed {
        return None;
    }
    // the circle in which the plane cuts the sphere
    let center = plane.normal * distance;
    let radius = (speed * speed - distance * distance).sqrt();
    let mut v = match aim {
        Aim::Direction(aim) => center + aim.reject_from_normalized(plane.normal).normalize_or_zero() * radius,
        Aim::Point(aim) => center + (aim.reject_from_normalized(plane.normal)).clamp_length_max(radius),
    };
    for (j, other) in planes[..i].iter().enumerate() {
        if other.violation(v) > 0.0 {
            v = on_line(meet(&plane, other)?, &planes[..j], speed, aim)?;
        }
    }
    Some(v)
}

/// The best velocity, or the index of the plane that made it impossible and the best before that.
fn within_planes(planes: &[Plane], speed: f32, aim: Aim) -> Result<Vec3, (usize, Vec3)> {
    let mut v = match aim {
        Aim::Direction(aim) => aim * speed,
        Aim::Point(aim) => aim.clamp_length_max(speed),
    };
    for (i, plane) in planes.iter().enumerate() {
        if plane.violation(v) > 0.0 {
            v = on_plane(planes, i, speed, aim).ok_or((i, v))?;
        }
    }
    Ok(v)
}

/// The velocity closest to `preferred`, no faster than `speed`, that all planes permit.
///
/// # Errors
/// If there is none: the index of the first plane that cannot be kept together with those before it, and the best
/// velocity without it.
pub fn closest_velocity_in_space(planes: &[Plane], speed: f32, preferred: Vec3) -> Result<Vec3, (usize, Vec3)> {
    within_planes(planes, speed, Aim::Point(preferred))
}

/// The velocity, no faster than `speed`, whose greatest violation of the planes from `hard` on is least, while the
/// first `hard` planes are kept. `failed` and `best` are what [`closest_velocity_in_space`] found.
pub fn least_violation_in_space(
    planes: &[Plane],
    hard: usize,
    speed: f32,
    (failed, best): (usize, Vec3),
    workspace: &mut Vec<Plane>,
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
            // where both are violated alike
            let point = match meet(&plane, other) {
                Some((point, _)) => point,
                None if plane.normal.dot(other.normal) > 0.0 => continue,
                None => (plane.point + other.point) * 0.5,
            };
            workspace.push(Plane { point, normal: (other.normal - plane.normal).normalize_or_zero() });
        }
        // fails by rounding only: then the velocity so far is as good
        if let Ok(better) = within_planes(workspace, speed, Aim::Direction(plane.normal)) {
            v = better;
        }
        violation = plane.violation(v);
    }
    v
}

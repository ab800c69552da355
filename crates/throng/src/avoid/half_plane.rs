//! Half-planes of permitted velocities, and the velocity in all of them that is closest to the preferred one.
//!
//! Incremental linear programming in the plane (de Berg et al., Computational Geometry, ch. 4), as used by van den
//! Berg, Guy, Lin, Manocha (Reciprocal n-body collision avoidance, ISRR 2009, section 5): [`closest_velocity`] if all
//! constraints can be satisfied, else [`least_violation`].

use glam::Vec2;

/// A half-plane of permitted velocities: those on a line or to its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfPlane {
    /// A point of the line.
    pub point: Vec2,
    /// Its unit direction.
    pub direction: Vec2,
}

impl HalfPlane {
    /// Returns how far `v` lies on the forbidden side, m/s; negative on the permitted side.
    pub fn violation(&self, v: Vec2) -> f32 {
        self.direction.perp_dot(self.point - v)
    }
}

/// Two lines closer to parallel than this (sine of the angle) count as parallel.
pub(super) const PARALLEL: f32 = 1e-5;

/// The objective of an optimisation.
#[derive(Clone, Copy)]
enum Objective2d {
    /// As close to this velocity as possible.
    Point(Vec2),
    /// As far in this unit direction as possible.
    Direction(Vec2),
}

/// Returns the best point on line `i` within the disc and the lines before it.
fn on_line(lines: &[HalfPlane], i: usize, speed: f32, aim: Objective2d) -> Option<Vec2> {
    let HalfPlane { point, direction } = lines[i];
    let along = point.dot(direction);
    let discriminant = along * along + speed * speed - point.length_squared();
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let (mut low, mut high) = (-along - root, -along + root);
    for other in &lines[..i] {
        let denominator = direction.perp_dot(other.direction);
        let numerator = other.direction.perp_dot(point - other.point);
        if denominator.abs() <= PARALLEL {
            if numerator < 0.0 {
                return None;
            }
            continue;
        }
        let t = numerator / denominator;
        if denominator >= 0.0 {
            high = high.min(t);
        } else {
            low = low.max(t);
        }
        if low > high {
            return None;
        }
    }
    let t = match aim {
        Objective2d::Direction(aim) => {
            if aim.dot(direction) > 0.0 {
                high
            } else {
                low
            }
        }
        Objective2d::Point(aim) => direction.dot(aim - point).clamp(low, high),
    };
    Some(point + direction * t)
}

/// Returns the best velocity, or the index of the line that made the problem infeasible and the best velocity before
/// it.
fn within_lines(lines: &[HalfPlane], speed: f32, aim: Objective2d) -> Result<Vec2, (usize, Vec2)> {
    let mut v = match aim {
        Objective2d::Direction(aim) => aim * speed,
        Objective2d::Point(aim) => aim.clamp_length_max(speed),
    };
    for (i, line) in lines.iter().enumerate() {
        if line.violation(v) > 0.0 {
            v = on_line(lines, i, speed, aim).ok_or((i, v))?;
        }
    }
    Ok(v)
}

/// Returns the velocity closest to `preferred`, no faster than `speed`, that all lines permit.
///
/// # Errors
/// If there is none: the index of the first line that cannot be satisfied together with those before it, and the best
/// velocity without that line.
pub fn closest_velocity(lines: &[HalfPlane], speed: f32, preferred: Vec2) -> Result<Vec2, (usize, Vec2)> {
    within_lines(lines, speed, Objective2d::Point(preferred))
}

/// Returns the velocity, no faster than `speed`, that minimises the greatest violation of the lines from `hard` on. The
/// first `hard` lines are satisfied. `failed` and `best` are the error of [`closest_velocity`].
pub fn least_violation(
    lines: &[HalfPlane],
    hard: usize,
    speed: f32,
    (failed, best): (usize, Vec2),
    workspace: &mut Vec<HalfPlane>,
) -> Vec2 {
    let mut v = best;
    let mut violation = 0.0;
    for i in failed..lines.len() {
        let line = lines[i];
        if line.violation(v) <= violation {
            continue;
        }
        workspace.clear();
        workspace.extend_from_slice(&lines[..hard.min(i)]);
        for other in &lines[hard.min(i)..i] {
            // the line on which both are violated equally
            let sine = line.direction.perp_dot(other.direction);
            let point = if sine.abs() <= PARALLEL {
                if line.direction.dot(other.direction) > 0.0 {
                    continue;
                }
                (line.point + other.point) * 0.5
            } else {
                line.point + line.direction * (other.direction.perp_dot(line.point - other.point) / sine)
            };
            let direction = (other.direction - line.direction).normalize_or_zero();
            workspace.push(HalfPlane { point, direction });
        }
        // this fails only because of rounding: then the velocity so far is as good
        if let Ok(better) = within_lines(workspace, speed, Objective2d::Direction(line.direction.perp())) {
            v = better;
        }
        violation = line.violation(v);
    }
    v
}

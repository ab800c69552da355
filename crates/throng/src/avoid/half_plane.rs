//! Half-planes of permitted velocities, and the velocity in all of them that is closest to the preferred one.
//!
//! Incremental linear programming in the plane (de Berg et al., Computational Geometry, ch. 4), as van den Berg,
//! Guy, Lin, Manocha use it (Reciprocal n-body collision avoidance, ISRR 2009, section 5): [`closest_velocity`]
//! while all can be kept, else [`least_violation`].

use glam::Vec2;

/// A half-plane of permitted velocities: what lies on the line or to its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// A point of the line.
    pub point: Vec2,
    /// Its unit direction.
    pub direction: Vec2,
}

impl Line {
    /// How far `v` lies on the forbidden side, negative on the permitted one. m/s
    pub fn violation(&self, v: Vec2) -> f32 {
        self.direction.perp_dot(self.point - v)
    }
}

/// Two lines closer to parallel than this (sine of the angle) count as parallel.
pub(super) const PARALLEL: f32 = 1e-5;

/// What an optimum is sought for.
#[derive(Clone, Copy)]
enum Aim {
    /// As close to this velocity as possible.
    Point(Vec2),
    /// As far in this unit direction as possible.
    Direction(Vec2),
}

/// The best point on line `i` within the disc and lines before it.
fn on_line(lines: &[Line], i: usize, speed: f32, aim: Aim) -> Option<Vec2> {
    let Line { point, direction } = lines[i];
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
        Aim::Direction(aim) => {
            if aim.dot(direction) > 0.0 {
                high
            } else {
                low
            }
        }
        Aim::Point(aim) => direction.dot(aim - point).clamp(low, high),
    };
    Some(point + direction * t)
}

/// The best velocity, or the index of the line that made it impossible and the best before that.
fn within_lines(lines: &[Line], speed: f32, aim: Aim) -> Result<Vec2, (usize, Vec2)> {
    let mut v = match aim {
        Aim::Direction(aim) => aim * speed,
        Aim::Point(aim) => aim.clamp_length_max(speed),
    };
    for (i, line) in lines.iter().enumerate() {
        if line.violation(v) > 0.0 {
            v = on_line(lines, i, speed, aim).ok_or((i, v))?;
        }
    }
    Ok(v)
}

/// The velocity closest to `preferred`, no faster than `speed`, that all lines permit.
///
/// # Errors
/// If there is none: the index of the first line that cannot be kept together with those before it, and the best
/// velocity without it.
pub fn closest_velocity(lines: &[Line], speed: f32, preferred: Vec2) -> Result<Vec2, (usize, Vec2)> {
    within_lines(lines, speed, Aim::Point(preferred))
}

/// The velocity, no faster than `speed`, whose greatest violation of the lines from `hard` on is least, while the
/// first `hard` lines are kept. `failed` and `best` are what [`closest_velocity`] found.
pub fn least_violation(
    lines: &[Line],
    hard: usize,
    speed: f32,
    (failed, best): (usize, Vec2),
    workspace: &mut Vec<Line>,
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
            // where both are violated alike
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
            workspace.push(Line { point, direction });
        }
        // fails by rounding only: then the velocity so far is as good
        if let Ok(better) = within_lines(workspace, speed, Aim::Direction(line.direction.perp())) {
            v = better;
        }
        violation = line.violation(v);
    }
    v
}

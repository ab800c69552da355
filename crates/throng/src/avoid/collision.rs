//! When a body that keeps its velocity touches another, or a wall: the measure of all models that search velocities
//! (MODELS 1.1, 1.2).

use super::View;
use glam::Vec2;

/// Seconds until a point that moves with `velocity` comes within `radii` of `offset`; infinite if it never does. Who is
/// already within and comes nearer collides now.
///
/// ```
/// use throng::avoid::time_to_disc;
/// # use glam::Vec2;
/// assert_eq!(time_to_disc(Vec2::new(3.0, 0.0), Vec2::new(2.0, 0.0), 1.0), 1.0);
/// assert_eq!(time_to_disc(Vec2::new(3.0, 0.0), Vec2::new(-2.0, 0.0), 1.0), f32::INFINITY);
/// ```
pub fn time_to_disc(offset: Vec2, velocity: Vec2, radii: f32) -> f32 {
    let approach = offset.dot(velocity);
    let gap = offset.length_squared() - radii * radii;
    if approach <= 0.0 {
        return f32::INFINITY;
    }
    if gap <= 0.0 {
        return 0.0;
    }
    let discriminant = approach * approach - velocity.length_squared() * gap;
    // gap / (b + root) is (b - root) / a without the cancellation
    if discriminant < 0.0 { f32::INFINITY } else { gap / (approach + discriminant.sqrt()) }
}

/// Seconds until a point that moves with `velocity` comes within `radius` of the segment from `start` to `end`;
/// infinite if it never does. Who is already within and comes nearer collides now.
pub fn time_to_segment(start: Vec2, end: Vec2, velocity: Vec2, radius: f32) -> f32 {
    let along = end - start;
    let length = along.length();
    if length <= 0.0 {
        return time_to_disc(start, velocity, radius);
    }
    let along = along / length;
    // the side: distance of the line, and how fast it is approached
    let distance = along.perp_dot(start);
    let approach = along.perp_dot(velocity) * distance.signum();
    let gap = distance.abs() - radius;
    if approach <= 0.0 {
        let ends = || time_to_disc(start, velocity, radius).min(time_to_disc(end, velocity, radius));
        return if gap > 0.0 { f32::INFINITY } else { ends() };
    }
    // where it comes within the radius of the line: beyond an end, only that end is in the way
    let time = (gap / approach).max(0.0);
    match along.dot(velocity * time - start) {
        reached if reached < 0.0 => time_to_disc(start, velocity, radius),
        reached if reached > length => time_to_disc(end, velocity, radius),
        _ => time,
    }
}

impl View<'_> {
    /// Seconds until a body of `radius` that keeps `velocity` touches a wall in view; infinite if it never does.
    pub(super) fn time_to_walls(&self, velocity: Vec2, radius: f32) -> f32 {
        let edges = self.edges.iter().map(|near| time_to_segment(near.start, near.end, velocity, radius));
        let discs = self
            .discs
            .iter()
            .map(|near| near.outline.time_to_collision(near.offset, velocity, near.disc.radius as f32 + radius));
        edges.chain(discs).fold(f32::INFINITY, f32::min)
    }
}

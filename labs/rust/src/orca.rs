//! The local model `my_orca`: van den Berg, Guy, Lin, Manocha, Reciprocal n-body collision avoidance, ISRR 2009.

use super::half_plane::half_plane;
use glam::Vec2;
use throng::Error;
use throng::avoid::{AvoidanceInput, AvoidanceReason, Cause, LocalModel, Workspace, closest_velocity};
use throng::parameters::{Value, parameters};

/// The nearest velocity that all neighbours permit.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MyOrca {
    /// Seconds ahead for which a velocity must be safe.
    #[parameter(default = 2.0, unit = "s", above = 0)]
    pub time_horizon: f32,
}

impl LocalModel for MyOrca {
    fn velocity(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec2 {
        let lines = &mut workspace.lines;
        lines.clear();
        lines.extend(view.neighbours.iter().map(|other| half_plane(view.velocity, other, self.time_horizon)));
        // where nothing is permitted, the best velocity so far
        closest_velocity(lines, view.max_speed, view.preferred).unwrap_or_else(|(_, best)| best)
    }

    fn is_random(&self) -> bool {
        false
    }

    fn explain(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec<AvoidanceReason> {
        let permits = |(index, other)| {
            AvoidanceReason::Permits(Cause::Neighbour(index), half_plane(view.velocity, other, self.time_horizon))
        };
        view.neighbours.iter().enumerate().map(permits).collect()
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng::avoid::{AvoidanceNeighbour, Outline};

    /// A thousand pairs of discs that do not overlap.
    #[test]
    fn half_planes_are_those_of_the_engine() {
        let mut state = 1u64;
        let mut random = |low: f32, high: f32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * (state >> 40) as f32 / (1u64 << 24) as f32
        };
        for case in 0..1000 {
            let radii = random(0.3, 1.0);
            let offset = Vec2::from_angle(random(-3.2, 3.2)) * radii * random(1.1, 8.0);
            let [velocity, theirs] = [0; 2].map(|_| Vec2::new(random(-2.0, 2.0), random(-2.0, 2.0)));
            let other = AvoidanceNeighbour {
                offset,
                radii,
                velocity: theirs,
                above: 0.0,
                vertical_velocity: 0.0,
                preferred: Vec2::ZERO,
                outline: Outline::POINT,
                share: 0.5,
                room: 0.5,
                aside: Vec2::X,
            };
            let (mine, exact) = (half_plane(velocity, &other, 2.0), other.half_plane(velocity, 2.0, 0.02));
            let agrees = mine.direction.distance(exact.direction) < 1e-3 && exact.violation(mine.point).abs() < 1e-3;
            assert!(agrees, "pair {case}: {other:?} and velocity {velocity} give {mine:?}, but must give {exact:?}");
        }
    }
}

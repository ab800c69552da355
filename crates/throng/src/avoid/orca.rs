//! Optimal reciprocal collision avoidance: van den Berg, Guy, Lin, Manocha, Reciprocal n-body collision avoidance,
//! ISRR 2009 (STAR 70, 2011).
//!
//! Each neighbour forbids the relative velocities that lead to a collision within the time horizon: a cone with a
//! rounded tip. The smallest change of relative velocity out of the cone, split by shares, gives a half-plane of
//! permitted velocities for each of the two agents. The velocity closest to the preferred one within all half-planes is
//! chosen. Walls are never violated. If neighbours leave no velocity, the greatest violation is minimised.

use super::half_plane::{HalfPlane, closest_velocity, least_violation};
use super::{
    AvoidanceBatch, AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, LocalModel, Workspace, obstacle_lines,
    orca_simd, turning,
};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::Vec2;
use std::any::Any;

/// The velocity from which an agent's half-planes are built: the velocity that other agents assume for the agent while
/// they choose (the paper's optimisation velocity, section 4.2).
#[parameters]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BuiltFrom {
    /// The present velocity: the compromise of the paper and of RVO2.
    #[default]
    Current,
    /// The preferred velocity: better where there is room, but in a dense crowd often no velocity is permitted.
    Preferred,
    /// Zero: some velocity is always permitted, but a dense crowd stands still.
    Zero,
}

/// Optimal reciprocal collision avoidance (van den Berg, Guy, Lin, Manocha, 2011): the nearest velocity that all
/// neighbours permit if they do their share of the avoidance. The default.
///
/// ```
/// use throng::avoid::Orca;
/// let careful = Orca { time_horizon: 4.0, ..Orca::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orca {
    /// Seconds ahead for which a velocity must be safe from other agents.
    #[parameter(default = 1.0, unit = "s", above = 0)]
    pub time_horizon: f32,
    /// Seconds ahead for which a velocity must be safe from obstacles.
    #[parameter(default = 0.7, unit = "s", above = 0)]
    pub time_horizon_obstacles: f32,
    /// Cost of a change of speed relative to a turn: above 1 agents prefer to turn, below 1 they prefer to brake.
    #[parameter(default = 1.0, least = 0.1, most = 10)]
    pub turning_bias: f32,
    /// The velocity from which half-planes are built.
    pub built_from: BuiltFrom,
}

/// Seconds over which an overlap, or a margin that is used up, is restored. A shorter time pushes abruptly.
pub(super) const RECOVERY: f32 = 0.25;

/// Fraction by which a body is enlarged at walls: enough to make corrections by the guard unnecessary.
const WALL_MARGIN: f32 = 0.01;

impl LocalModel for Orca {
    fn velocity(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec2 {
        let hard = self.permit(view, workspace);
        let Workspace { lines, fallback, .. } = workspace;
        if self.turning_bias == 1.0 {
            optimum(lines, hard, view.max_speed, view.preferred, fallback)
        } else {
            turning::optimum(lines, hard, view.max_speed, view.preferred, self.turning_bias, fallback)
        }
    }

    fn velocities(&self, batch: &mut AvoidanceBatch<'_>) {
        if self.turning_bias == 1.0 && self.built_from == BuiltFrom::Current {
            batch.with_simd(
                |input, lane, view, workspace| input.permit(lane, self.permit_walls(view, workspace)),
                |input, workspace| orca_simd::choose_many(self, input, workspace),
            );
        }
    }

    fn is_same(&self, other: &dyn LocalModel) -> bool {
        (other as &dyn Any).downcast_ref() == Some(self)
    }

    fn is_random(&self) -> bool {
        false
    }

    fn explain(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec<AvoidanceReason> {
        self.permit(view, workspace);
        workspace.permissions()
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.time_horizon_obstacles * max_speed + radius * (1.0 + WALL_MARGIN)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl Orca {
    /// Collects the half-planes of walls and of the body.
    pub(crate) fn permit_walls<'a>(&self, view: &AvoidanceInput<'_>, workspace: &'a mut Workspace) -> &'a [HalfPlane] {
        workspace.permit(view, view.radius * (1.0 + WALL_MARGIN), self.time_horizon_obstacles);
        &workspace.lines
    }

    /// Collects the half-planes of walls and of the body, then those of neighbours. Returns the number of the former.
    fn permit(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> usize {
        let of = |current: Vec2, preferred: Vec2| match self.built_from {
            BuiltFrom::Current => current,
            BuiltFrom::Preferred => preferred,
            BuiltFrom::Zero => Vec2::ZERO,
        };
        let velocity = of(view.velocity, view.preferred);
        let hard = self.permit_walls(view, workspace).len();
        let lines = &mut workspace.lines;
        lines.extend(view.neighbours.iter().map(|n| {
            let other = AvoidanceNeighbour { velocity: of(n.velocity, n.preferred), ..*n };
            other.half_plane(velocity, self.time_horizon, view.step)
        }));
        hard
    }
}

/// Returns the velocity closest to the preferred one that all half-planes permit. If there is none, the first `hard`
/// half-planes are satisfied and the greatest violation of the remaining ones is minimised.
pub(super) fn optimum(
    lines: &[HalfPlane],
    hard: usize,
    speed: f32,
    preferred: Vec2,
    fallback: &mut Vec<HalfPlane>,
) -> Vec2 {
    closest_velocity(lines, speed, preferred)
        .unwrap_or_else(|failed| least_violation(lines, hard, speed, failed, fallback))
}

impl AvoidanceNeighbour {
    /// Returns the half-plane of ORCA: the velocities that this neighbour permits to an agent of the given velocity, for
    /// `horizon` seconds. If the bodies touch already, the overlap ends within the step, or a quarter of a second.
    pub fn half_plane(&self, velocity: Vec2, horizon: f32, step: f32) -> HalfPlane {
        let AvoidanceNeighbour { offset, radii, .. } = *self;
        let relative = velocity - self.velocity;
        let distance_squared = offset.length_squared();
        let (change, normal) = if !self.outline.is_point() {
            self.change(relative, horizon, step.max(RECOVERY))
        } else if distance_squared > radii * radii {
            let w = relative - offset / horizon;
            let along = w.dot(offset);
            if along < 0.0 && along * along > radii * radii * w.length_squared() {
                // nearest on the rounded tip
                let length = w.length();
                let normal = w / length;
                (normal * (radii / horizon - length), normal)
            } else {
                // nearest on a leg
                let (left, right) = obstacle_lines::tangents(offset, radii);
                let direction = if offset.perp_dot(w) > 0.0 { left } else { -right };
                (direction * relative.dot(direction) - relative, direction.perp())
            }
        } else {
            // too close: move apart within the recovery time
            let time = step.max(RECOVERY);
            let w = relative - offset / time;
            let length = w.length();
            let normal = if length > 1e-6 { w / length } else { self.aside };
            (normal * (radii / time - length), normal)
        };
        let part = if change.dot(normal) > 0.0 { self.share } else { self.room };
        HalfPlane { point: velocity + change * part, direction: Vec2::new(normal.y, -normal.x) }
    }
}

//! Acceleration-velocity obstacles: van den Berg, Snape, Guy, Manocha, Reciprocal collision avoidance with
//! acceleration-velocity obstacles, ICRA 2011.
//!
//! A body does not reach a new velocity at once but approaches it: v(t) = new - exp(-t / delay) (new - v). The new
//! relative velocities that lead to a collision at a time t are a disc. Those that lead to a collision within the time
//! horizon are the union of such discs. As in [`Orca`](super::Orca), the smallest change out of the union (here: out of
//! its convex hull) is shared and gives a half-plane. The model returns the velocity that the body has after the step.

use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, HalfPlane, LocalModel, Workspace, orca};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::Vec2;

/// Acceleration-velocity obstacles (van den Berg, Snape, Guy, Manocha, 2011): ORCA for bodies that reach a new velocity
/// with a delay.
///
/// ```
/// use throng::avoid::Avo;
/// let sluggish = Avo { delay: 0.6, ..Avo::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Avo {
    /// Seconds ahead for which a velocity must be safe from other agents.
    #[parameter(default = 2.0, unit = "s", above = 0)]
    pub time_horizon: f32,
    /// Seconds ahead for which a velocity must be safe from obstacles.
    #[parameter(default = 0.7, unit = "s", above = 0)]
    pub time_horizon_obstacles: f32,
    /// Seconds in which a body completes all but a third of a change of velocity.
    #[parameter(default = 0.25, unit = "s", above = 0, most = 10)]
    pub delay: f32,
}

impl LocalModel for Avo {
    fn velocity(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec2 {
        let hard = self.permit(view, workspace);
        let Workspace { lines, fallback, .. } = workspace;
        let new = orca::optimum(lines, hard, view.max_speed, view.preferred, fallback);
        view.velocity + (new - view.velocity) * (1.0 - libm::expf(-view.step / self.delay))
    }

    fn relaxes(&self) -> bool {
        true
    }

    fn explain(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec<AvoidanceReason> {
        self.permit(view, workspace);
        workspace.permissions()
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.time_horizon_obstacles * max_speed + radius
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl Avo {
    fn permit(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> usize {
        workspace.permit(view, view.radius, self.time_horizon_obstacles);
        let lines = &mut workspace.lines;
        let hard = lines.len();
        lines.extend(view.neighbours.iter().map(|n| line(view.velocity, n, self.time_horizon, self.delay, view.step)));
        hard
    }
}

/// Number of times at which the obstacle is sampled.
const MOMENTS: usize = 24;
const LANES: usize = 8;
/// Number of directions sampled for the smallest change, before refinement.
const DIRECTIONS: usize = 16;

/// Returns the half-plane of new velocities that one neighbour permits to an agent of the given velocity. Both approach
/// their new velocities with the time constant `delay`, seconds.
pub fn line(velocity: Vec2, other: &AvoidanceNeighbour, horizon: f32, delay: f32, step: f32) -> HalfPlane {
    let AvoidanceNeighbour { offset, radii, .. } = *other;
    // for bodies that are not discs the delay is ignored
    if other.touches() || !other.outline.is_point() {
        return other.half_plane(velocity, horizon, step);
    }
    let relative = velocity - other.velocity;
    // columns, so that several times are evaluated together
    let (mut x, mut y, mut radius) = ([0.0; MOMENTS], [0.0; MOMENTS], [0.0; MOMENTS]);
    for i in 0..MOMENTS {
        // samples are denser where the discs change fast
        let part = (i + 1) as f32 / MOMENTS as f32;
        let time = horizon * part * part;
        let lag = delay * (libm::expf(-time / delay) - 1.0);
        // a speed above ten thousand times the distance per second is out of range, and not precise
        let reach = (time + lag).max(1e-4);
        let center = (offset + relative * lag) / reach;
        (x[i], y[i], radius[i]) = (center.x, center.y, radii / reach);
    }
    // distance out of all discs in a direction
    let out = |normal: Vec2| {
        let reach: [f32; MOMENTS] = std::array::from_fn(|i| x[i] * normal.x + y[i] * normal.y + radius[i]);
        let mut farthest = [f32::NEG_INFINITY; LANES];
        for reach in reach.chunks_exact(LANES) {
            for (most, &reach) in farthest.iter_mut().zip(reach) {
                *most = if reach > *most { reach } else { *most };
            }
        }
        farthest.into_iter().fold(f32::NEG_INFINITY, f32::max) - relative.dot(normal)
    };
    let direction = |angle: f32| {
        let (sin, cos) = libm::sincosf(angle);
        Vec2::new(cos, sin)
    };
    let around = std::f32::consts::TAU / DIRECTIONS as f32;
    let mut best = (0.0, f32::INFINITY);
    for i in 0..DIRECTIONS {
        let angle = i as f32 * around;
        let change = out(direction(angle));
        if change < best.1 {
            best = (angle, change);
        }
    }
    // the minimum lies between the neighbours of the best direction
    let mut width = around;
    for _ in 0..10 {
        width *= 0.5;
        for angle in [best.0 - width, best.0 + width] {
            let change = out(direction(angle));
            if change < best.1 {
                best = (angle, change);
            }
        }
    }
    let normal = direction(best.0);
    let part = if best.1 > 0.0 { other.share } else { other.room };
    HalfPlane { point: velocity + normal * (best.1 * part), direction: Vec2::new(normal.y, -normal.x) }
}

//! Reciprocal velocity obstacles: van den Berg, Lin, Manocha, Reciprocal velocity obstacles for real-time multi-agent
//! navigation, ICRA 2008.
//!
//! Each of two agents takes its share of the avoidance. A velocity v is judged by the relative velocity that both would
//! have if the neighbour did the same: v / share + (1 - 1 / share) times the present velocity, less the neighbour's.
//! The velocity of least penalty is chosen: weight / time to collision + distance from the preferred velocity (section
//! V), so that there is one in any crowd. Walls do not avoid: all of the avoidance falls on the agent.

use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Cause, Forbidden, LocalModel, Workspace, sampling};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::Vec2;

/// Reciprocal velocity obstacles (van den Berg, Lin, Manocha, 2008): the velocity of least penalty for the time to a
/// collision and the distance from the preferred velocity.
///
/// ```
/// use throng::avoid::Rvo;
/// let shy = Rvo { weight: 2.0, ..Rvo::default() };
/// // the search of the authors' library
/// let drawn = Rvo { candidates: 250, braking: true, ..Rvo::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rvo {
    /// Weight of the time to a collision against the distance from the preferred velocity, metres: with a small weight
    /// agents come nearer to each other.
    #[parameter(default = 1.0, unit = "m", above = 0)]
    pub weight: f32,
    /// The part of the avoidance that an agent does if both agents have the same right of way (the paper's alpha).
    #[parameter(default = 0.5, least = 0.1, most = 1)]
    pub responsibility: f32,
    /// Seconds ahead beyond which collisions with other agents do not count.
    #[parameter(default = 5.0, unit = "s", above = 0)]
    pub time_horizon: f32,
    /// Seconds ahead beyond which collisions with obstacles do not count.
    #[parameter(default = 0.7, unit = "s", above = 0)]
    pub time_horizon_obstacles: f32,
    /// Obstacles count only if braking does not suffice, as in the authors' library; `time_horizon_obstacles` has no
    /// effect then.
    pub braking: bool,
    /// Only velocities that can be reached within a step are candidates, as in the paper.
    pub kinodynamic: bool,
    /// Number of random candidate velocities in each step, as in the authors' library (250). 0: a pattern that is
    /// refined replaces them.
    #[parameter(most = 100000)]
    pub candidates: u32,
}

/// The least share: with a share of 0 an agent would not see the neighbour.
const LEAST_SHARE: f32 = 0.1;

impl LocalModel for Rvo {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        self.choose(view, None)
    }

    fn explain(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec<AvoidanceReason> {
        let cones = view.neighbours.iter().enumerate().map(|(index, other)| {
            let other = AvoidanceNeighbour { share: self.share(other), ..*other };
            match Forbidden::truncated(view.velocity, &other, self.time_horizon, view.step) {
                Forbidden::RightOf(line) => AvoidanceReason::Permits(Cause::Neighbour(index), line),
                cone => AvoidanceReason::Forbids(Cause::Neighbour(index), cone),
            }
        });
        let mut reasons: Vec<AvoidanceReason> = cones.collect();
        let mut candidates = Vec::new();
        self.choose(view, Some(&mut candidates));
        reasons.extend(candidates);
        reasons
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        // the braking distance depends on the acceleration, which is not known here: this covers bodies that brake
        // slowly
        let seconds = if self.braking { BRAKING_TIME } else { self.time_horizon_obstacles };
        seconds * max_speed + radius
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// Seconds of braking from top speed for which walls are considered.
const BRAKING_TIME: f32 = 2.0;

impl Rvo {
    fn share(&self, other: &AvoidanceNeighbour) -> f32 {
        (other.share + self.responsibility - 0.5).clamp(LEAST_SHARE, 1.0)
    }

    /// Returns the velocity of least penalty. Adds all velocities that were evaluated to `tried`, if given.
    fn choose(&self, view: &AvoidanceInput<'_>, mut tried: Option<&mut Vec<AvoidanceReason>>) -> Vec2 {
        let reach = view.max_acceleration * view.step;
        let reachable = |v: Vec2| {
            let v = if self.kinodynamic { view.velocity + (v - view.velocity).clamp_length_max(reach) } else { v };
            v.clamp_length_max(view.max_speed)
        };
        let overlaps = view.neighbours.iter().any(|n| is_overlap(view, n));
        sampling::cheapest(self.candidates, view, |chosen, best| {
            let velocity = reachable(chosen);
            let enough = if tried.is_some() { f32::INFINITY } else { best };
            let cost = if overlaps { self.leaving(view, velocity) } else { self.penalty(view, velocity, enough) };
            if let Some(tried) = &mut tried {
                tried.push(AvoidanceReason::Candidate { velocity, cost });
            }
            (velocity, cost)
        })
    }

    fn judged(&self, view: &AvoidanceInput<'_>, other: &AvoidanceNeighbour, v: Vec2) -> Vec2 {
        let share = self.share(other);
        v / share + view.velocity * (1.0 - 1.0 / share) - other.velocity
    }

    /// Returns the cost of a velocity. A cost of at least `enough` may be underestimated, but not below `enough`.
    fn penalty(&self, view: &AvoidanceInput<'_>, v: Vec2, enough: f32) -> f32 {
        let distance = v.distance(view.preferred);
        if distance >= enough {
            return distance;
        }
        let penalty = |time: f32, horizon: f32| if time < horizon { self.weight / time.max(1e-3) } else { 0.0 };
        let wall_horizon = if self.braking {
            // a wall counts only if the body would reach it before it could stop
            view.step.max(v.length() / view.max_acceleration)
        } else {
            self.time_horizon_obstacles
        };
        let mut most = penalty(view.time_to_walls(v, view.radius), wall_horizon);
        for other in view.neighbours {
            if distance + most >= enough {
                break;
            }
            most = most.max(penalty(other.time_to_collision(self.judged(view, other, v)), self.time_horizon));
        }
        distance + most
    }

    /// Returns the cost of a velocity for an agent that overlaps neighbours: how soon it ends the overlaps. Other
    /// neighbours are ignored, as in the authors' library.
    fn leaving(&self, view: &AvoidanceInput<'_>, v: Vec2) -> f32 {
        let overlapped = view.neighbours.iter().filter(|n| is_overlap(view, n));
        let steps = overlapped.map(|n| (time_to_leave(n, self.judged(view, n, v)) / view.step).ceil());
        steps.fold(0.0, f32::max) + v.length_squared() / (view.max_speed * view.max_speed)
    }
}

/// Whether discs overlap, without margins.
fn is_overlap(view: &AvoidanceInput<'_>, other: &AvoidanceNeighbour) -> bool {
    let radii = other.radii / view.margin;
    other.outline.is_point() && other.offset.length_squared() < radii * radii * 0.999
}

/// Returns the seconds until an overlap ends; 1e4 if it does not end.
fn time_to_leave(other: &AvoidanceNeighbour, velocity: Vec2) -> f32 {
    let approach = other.offset.dot(velocity);
    let speed_squared = velocity.length_squared();
    let gap = other.offset.length_squared() - other.radii * other.radii;
    let discriminant = (approach * approach - speed_squared * gap).max(0.0);
    if speed_squared > 1e-8 { ((approach + discriminant.sqrt()) / speed_squared).min(1e4) } else { 1e4 }
}

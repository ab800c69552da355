//! Reciprocal velocity obstacles: van den Berg, Lin, Manocha, Reciprocal velocity obstacles for real-time multi-agent
//! navigation, ICRA 2008.
//!
//! Each of two takes its share of the avoiding: a velocity v is judged by what both would have if the other did the
//! same, v / share + (1 - 1 / share) of the present one. The velocity of least penalty is taken: weight / time to
//! collision + distance from the preferred one (section V), so that there is one in any crowd. Walls do nothing: all
//! of the avoiding falls on the agent.

use super::sampling::{self, Search};
use super::{Cause, Forbidden, LocalModel, Neighbour, Reason, View, Workspace};
use crate::Error;
use glam::Vec2;

/// Reciprocal velocity obstacles.
///
/// ```
/// use throng::avoid::{Rvo, Search};
/// let shy = Rvo { weight: 2.0, ..Rvo::default() };
/// // as the authors' library searches
/// let drawn = Rvo { search: Search::Random { candidates: 250 }, time_horizon_obstacles: None, ..Rvo::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rvo {
    /// Weight of the time to a collision against the distance from the preferred velocity, metres: small is aggressive,
    /// large is shy. Limit: > 0.
    pub weight: f32,
    /// The part of the avoiding that is done where both have the same right of way, the paper's alpha. Both of a pair
    /// together should have 1. Limit: 0.1 to 1.
    pub responsibility: f32,
    /// Collisions farther ahead count for nothing, seconds; infinite in the paper. Limit: > 0.
    pub time_horizon: f32,
    /// Seconds ahead for which a velocity must be safe from walls. `None`: a wall counts only if the body could not
    /// brake in time, as in the authors' library. Limit: > 0.
    pub time_horizon_obstacles: Option<f32>,
    /// Whether only velocities are tried that can be reached within a step, as in the paper. Else the best velocity is
    /// sought, and the body changes towards it as fast as it can, as in the authors' library.
    pub kinodynamic: bool,
    /// Which velocities are tried.
    pub search: Search,
}

impl Default for Rvo {
    fn default() -> Self {
        Self {
            weight: 1.0,
            responsibility: 0.5,
            time_horizon: 5.0,
            time_horizon_obstacles: Some(0.7),
            kinodynamic: false,
            search: Search::Adaptive,
        }
    }
}

/// The least share: with none at all an agent would not see the other.
const LEAST_SHARE: f32 = 0.1;

impl LocalModel for Rvo {
    fn velocity(&self, view: &View<'_>, _: &mut Workspace) -> Vec2 {
        self.choose(view, None)
    }

    fn explain(&self, view: &View<'_>, _: &mut Workspace) -> Vec<Reason> {
        let cones = view.neighbours.iter().enumerate().map(|(index, other)| {
            let other = Neighbour { share: self.share(other), ..*other };
            match Forbidden::truncated(view.velocity, &other, self.time_horizon, view.step) {
                Forbidden::RightOf(line) => Reason::Permits(Cause::Neighbour(index), line),
                cone => Reason::Forbids(Cause::Neighbour(index), cone),
            }
        });
        let mut reasons: Vec<Reason> = cones.collect();
        let mut candidates = Vec::new();
        self.choose(view, Some(&mut candidates));
        reasons.extend(candidates);
        reasons
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        // how far a body gets while it brakes depends on its acceleration; who brakes slowly looks this far
        self.time_horizon_obstacles.unwrap_or(BRAKING_TIME) * max_speed + radius
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("weight", self.weight)?;
        let alpha = self.responsibility;
        Error::unless((LEAST_SHARE..=1.0).contains(&alpha), "responsibility", alpha, "from 0.1 to 1")?;
        let horizon = self.time_horizon;
        Error::unless(horizon > 0.0, "time horizon", horizon, "greater than 0")?;
        Error::unless_positive("time horizon of obstacles", self.time_horizon_obstacles.unwrap_or(1.0))?;
        self.search.check()
    }
}

/// Seconds of braking, from top speed, for which walls are looked at.
const BRAKING_TIME: f32 = 2.0;

impl Rvo {
    fn share(&self, other: &Neighbour) -> f32 {
        (other.share + self.responsibility - 0.5).clamp(LEAST_SHARE, 1.0)
    }

    /// The velocity of least penalty; notes all that were tried, if asked to.
    fn choose(&self, view: &View<'_>, mut tried: Option<&mut Vec<Reason>>) -> Vec2 {
        let reach = view.max_acceleration * view.step;
        let reachable = |v: Vec2| {
            let v = if self.kinodynamic { view.velocity + (v - view.velocity).clamp_length_max(reach) } else { v };
            v.clamp_length_max(view.max_speed)
        };
        let overlaps = view.neighbours.iter().any(|n| is_overlap(view, n));
        sampling::cheapest(self.search, view, |wish, best| {
            let velocity = reachable(wish);
            let enough = if tried.is_some() { f32::INFINITY } else { best };
            let cost = if overlaps { self.leaving(view, velocity) } else { self.penalty(view, velocity, enough) };
            if let Some(tried) = &mut tried {
                tried.push(Reason::Candidate { velocity, cost });
            }
            (velocity, cost)
        })
    }

    fn judged(&self, view: &View<'_>, other: &Neighbour, v: Vec2) -> Vec2 {
        let share = self.share(other);
        v / share + view.velocity * (1.0 - 1.0 / share) - other.velocity
    }

    /// What a velocity costs; if that is not less than `enough`, no less than it.
    fn penalty(&self, view: &View<'_>, v: Vec2, enough: f32) -> f32 {
        let distance = v.distance(view.preferred);
        if distance >= enough {
            return distance;
        }
        let penalty = |time: f32, horizon: f32| if time < horizon { self.weight / time.max(1e-3) } else { 0.0 };
        let wall_horizon = self.time_horizon_obstacles.unwrap_or_else(|| {
            // a wall that is reached later than the body stands is no wall yet
            view.step.max(v.length() / view.max_acceleration)
        });
        let mut most = penalty(view.time_to_walls(v, view.radius), wall_horizon);
        for other in view.neighbours {
            if distance + most >= enough {
                break;
            }
            most = most.max(penalty(other.time_to_collision(self.judged(view, other, v)), self.time_horizon));
        }
        distance + most
    }

    /// What a velocity costs one who overlaps others: only those count, and how soon it is out (the authors' library).
    fn leaving(&self, view: &View<'_>, v: Vec2) -> f32 {
        let overlapped = view.neighbours.iter().filter(|n| is_overlap(view, n));
        let steps = overlapped.map(|n| (time_to_leave(n, self.judged(view, n, v)) / view.step).ceil());
        steps.fold(0.0, f32::max) + v.length_squared() / (view.max_speed * view.max_speed)
    }
}

/// Whether discs overlap, margins left aside.
fn is_overlap(view: &View<'_>, other: &Neighbour) -> bool {
    let radii = other.radii / view.margin;
    other.outline.is_point() && other.offset.length_squared() < radii * radii * 0.999
}

/// Seconds until an overlap ends; many if it does not.
fn time_to_leave(other: &Neighbour, velocity: Vec2) -> f32 {
    let approach = other.offset.dot(velocity);
    let speed_squared = velocity.length_squared();
    let gap = other.offset.length_squared() - other.radii * other.radii;
    let discriminant = (approach * approach - speed_squared * gap).max(0.0);
    if speed_squared > 1e-8 { ((approach + discriminant.sqrt()) / speed_squared).min(1e4) } else { 1e4 }
}

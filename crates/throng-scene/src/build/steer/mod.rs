//! From what a scene says of steering to behaviours.
//!
//! A behaviour is made by its own `impl Make`; what is wrong with it, the behaviour itself says (`Behaviour::check`).

mod around;
mod check;
mod combine;
mod custom;
mod group;
mod place;
mod single;
mod slip;
mod swarm;
mod takeoff;
mod target;
mod vehicle;

pub(super) use around::Around;
pub(super) use check::check_steering;
pub(super) use target::in_world;
pub(super) use vehicle::{vehicle, wrap_around};

use super::flow::Flows;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::steer::Steer;
use crate::scene::{Cast, Group, Scene};
use throng::steer::Branch;

/// What behaviours are made with.
pub(super) struct Making<'a> {
    pub scene: &'a Scene,
    /// Whom behaviours can name, and what places are relative to.
    pub cast: &'a Cast<'a>,
    /// The names of the figures of the rules.
    pub figures: &'a [String],
    /// Surfaces, paths and what is solid.
    pub around: &'a Around<'a>,
    /// Fields.
    pub flows: &'a Flows<'a>,
    /// The group whose behaviour it is, by its position.
    pub group: usize,
}

/// What behaviours are made from.
trait Make {
    /// The behaviour; `at` leads to what is said of it.
    fn make(&self, making: &Making, at: &Path) -> Result<Branch, Problem>;
}

impl Making<'_> {
    /// What the group steers by.
    pub fn steering(&self) -> Result<Option<Branch>, Problem> {
        let Some(steer) = &self.scene.groups[self.group].steer else { return Ok(None) };
        let path = Path::of("group").index(self.group).key("steer");
        self.branch(steer, &path).map(Some).map_err(|mut problem| {
            let name = Group::name_at(&self.scene.groups[self.group].name, self.group);
            problem.message = format!("group `{name}`: {}", problem.message);
            problem
        })
    }

    fn branch(&self, steer: &Steer, at: &Path) -> Result<Branch, Problem> {
        let (key, made): (&str, &dyn Make) = match steer {
            Steer::Seek(of) => ("seek", of),
            Steer::Flee(of) => ("flee", of),
            Steer::Arrive(of) => ("arrive", of),
            Steer::Pursue(of) => ("pursue", of),
            Steer::Evade(of) => ("evade", of),
            Steer::OffsetPursuit(of) => ("offset_pursuit", of),
            Steer::Shadow(of) => ("shadow", of),
            Steer::Interpose(of) => ("interpose", of),
            Steer::KeepStation(of) => ("keep_station", of),
            Steer::Dock(of) => ("dock", of),
            Steer::Takeoff(of) => ("takeoff", of),
            Steer::Wander(of) => ("wander", of),
            Steer::FractalWander(of) => ("fractal_wander", of),
            Steer::Explore(of) => ("explore", of),
            Steer::Forage(of) => ("forage", of),
            Steer::Face(of) => ("face", of),
            Steer::MatchOrientation(of) => ("match_orientation", of),
            Steer::LookWhereYouGo(of) => ("look_where_you_go", of),
            Steer::Fear(of) => ("fear", of),
            Steer::HeadFor(of) => ("head_for", of),
            Steer::ConstantForce(of) => ("constant_force", of),
            Steer::EvadeAll(of) => ("evade_all", of),
            Steer::SlipThrough(of) => ("slip_through", of),
            Steer::FollowFlow(of) => ("follow_flow", of),
            Steer::MoveForward(of) => ("move_forward", of),
            Steer::TargetSpeed(of) => ("target_speed", of),
            Steer::Tether(of) => ("tether", of),
            Steer::Separation(of) => ("separation", of),
            Steer::Alignment(of) => ("alignment", of),
            Steer::Cohesion(of) => ("cohesion", of),
            Steer::MatchVelocity(of) => ("match_velocity", of),
            Steer::Flocking(of) => ("flocking", of),
            Steer::Boids(of) => ("boids", of),
            Steer::AvoidNeighbours(of) => ("avoid_neighbours", of),
            Steer::CloseAvoidance(of) => ("close_avoidance", of),
            Steer::UnalignedAvoidance(of) => ("unaligned_avoidance", of),
            Steer::Queue(of) => ("queue", of),
            Steer::FollowLeader(of) => ("follow_leader", of),
            Steer::KeepFormation(of) => ("keep_formation", of),
            Steer::AvoidObstacles(of) => ("avoid_obstacles", of),
            Steer::AvoidMap(of) => ("avoid_map", of),
            Steer::Whiskers(of) => ("whiskers", of),
            Steer::Contain(of) => ("contain", of),
            Steer::FollowPath(of) => ("follow_path", of),
            Steer::StayOnPath(of) => ("stay_on_path", of),
            Steer::FollowWall(of) => ("follow_wall", of),
            Steer::Hide(of) => ("hide", of),
            Steer::CrowdPath(of) => ("crowd_path", of),
            Steer::QueueAtDoor(of) => ("queue_at_door", of),
            Steer::Swarm(of) => ("swarm", of),
            Steer::WeightedSum(of) => ("weighted_sum", of),
            Steer::RunningSum(of) => ("running_sum", of),
            Steer::Priority(of) => ("priority", of),
            Steer::Dithering(of) => ("dithering", of),
            Steer::Allocation(of) => ("allocation", of),
            Steer::ContextSteering(of) => ("context_steering", of),
            Steer::Switch(of) => ("switch", of),
            Steer::Amortised(of) => ("amortised", of),
            Steer::Hold(of) => ("hold", of),
            Steer::Irregular(of) => ("irregular", of),
            Steer::Limited(of) => ("limited", of),
            Steer::StopAndWait(of) => ("stop_and_wait", of),
            Steer::Custom(of) => ("custom", of),
        };
        let at = at.key(key);
        let branch = made.make(self, &at)?;
        branch.check().map_err(|error| refused(&at, &error))?;
        Ok(branch)
    }
}

/// What the library says is wrong. Most of its words for a parameter are the key, and lead to it.
pub(super) fn refused(at: &Path, error: &throng::Error) -> Problem {
    match error {
        throng::Error::Limit { what, value, limit } => {
            // the library computes in f32, and so many digits have a meaning
            let message = format!("{what} is {}, but must be {limit}", *value as f32);
            Problem::new(&at.key(&what.replace(' ', "_")), Kind::OutOfRange, message)
        }
        error => Problem::new(at, Kind::Geometry, error.to_string()),
    }
}

/// A number of the library's: as said, or its default.
fn or(said: Option<f64>, standard: f32) -> f32 {
    said.map_or(standard, |said| said as f32)
}

/// An angle of the library's: as said in degrees, or its default.
fn angle(said: Option<f64>, standard: f32) -> f32 {
    said.map_or(standard, |said| said.to_radians() as f32)
}

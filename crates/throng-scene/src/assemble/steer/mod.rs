//! Builds behaviours from the steering of a scene.
//!
//! Each behaviour has its own `impl Make`. The behaviour checks itself (`Behaviour::check`).

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
use crate::scene::{Group, Scene, SceneNames};
use throng::steer::BoxedBehaviour;

/// The input for building behaviours.
pub(super) struct BehaviourContext<'a> {
    pub scene: &'a Scene,
    /// The names that behaviours can refer to, and the origin of coordinates.
    pub cast: &'a SceneNames<'a>,
    /// The names of the figures of the rules.
    pub figures: &'a [String],
    /// Surfaces, paths and obstacles.
    pub around: &'a Around<'a>,
    /// Fields.
    pub flows: &'a Flows<'a>,
    /// The group of the behaviour, by its position.
    pub group: usize,
}

/// A description from which a behaviour is built.
trait BuildBehaviour {
    /// Builds the behaviour; `at` is the path to its description.
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem>;
}

impl BehaviourContext<'_> {
    /// Returns the behaviour of the group.
    pub fn steering(&self) -> Result<Option<BoxedBehaviour>, Problem> {
        let Some(steer) = &self.scene.groups[self.group].steer else { return Ok(None) };
        let path = Path::of("group").index(self.group).key("steer");
        self.branch(steer, &path).map(Some).map_err(|mut problem| {
            let name = Group::name_at(&self.scene.groups[self.group].name, self.group);
            problem.message = format!("group `{name}`: {}", problem.message);
            problem
        })
    }

    fn branch(&self, steer: &Steer, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let (key, made): (&str, &dyn BuildBehaviour) = match steer {
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

/// Converts an error of the library. Most of its names of parameters are the keys, and lead to them.
pub(super) fn refused(at: &Path, error: &throng::Error) -> Problem {
    match error {
        throng::Error::Limit { what, value, limit } => {
            // the library computes in f32: further digits have no meaning
            let message = format!("{what} is {}, but must be {limit}", *value as f32);
            Problem::new(&at.key(&what.replace(' ', "_")), Kind::OutOfRange, message)
        }
        error => Problem::new(at, Kind::Geometry, error.to_string()),
    }
}

/// Returns a given number in f32, or the library's default.
fn or(said: Option<f64>, standard: f32) -> f32 {
    said.map_or(standard, |said| said as f32)
}

/// Returns a given angle in radians, or the library's default.
fn angle(said: Option<f64>, standard: f32) -> f32 {
    said.map_or(standard, |said| said.to_radians() as f32)
}

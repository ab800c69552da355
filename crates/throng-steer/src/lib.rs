//! Steering: the aims of an agent, as forces. Reynolds' behaviours, one in each file, and ways to combine them; flocks and
//! [swarms](swarm).
//!
//! Craig Reynolds, Flocks, herds, and schools, SIGGRAPH 1987; Steering behaviors for autonomous characters, GDC 1999;
//! and the additions of OpenSteer, gdx-ai, yuka and UnitySteer.
//!
//! A [`Behaviour`](throng::steer::Behaviour) of the engine sees one agent and its surroundings and returns a force. Ways to
//! combine behaviours are behaviours too, and take any other behaviours as parts. These behaviours use nothing of the
//! engine that a behaviour of a program's own cannot use.
//!
//! ```
//! use glam::Vec3;
//! use throng::motion::{Motion, Vehicle};
//! use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
//! use throng_steer::Arrive;
//!
//! let behaviour = Arrive::new(Target::Point(Vec3::new(3.0, 4.0, 0.0)));
//! let (vehicle, mut motion) = (Vehicle::default(), Motion::default());
//! let mut memory = vec![0.0; behaviour.memory()];
//! for step in 0..500 {
//!     let view = SteeringInput { motion, vehicle, time: f64::from(step) * 0.02, seconds: 0.02, ..SteeringInput::default() };
//!     let steering = behaviour.steer(&view, &mut memory, &mut TraceRecorder::default()).unwrap_or_default();
//!     vehicle.step(&mut motion, steering, 0.02);
//! }
//! assert!(motion.position.distance(Vec3::new(3.0, 4.0, 0.0)) < 0.02 && motion.speed() < 0.01);
//! ```

mod approach;
mod combine;
mod group;
mod noise;
mod place;
mod prediction;
mod single;
pub mod swarm;

pub use combine::*;
pub use group::*;
pub use noise::Noise;
pub use place::*;
pub use prediction::Prediction;
pub use single::*;

use throng::Error;
use throng::parameters::Parameters;
use throng::steer::BoxedBehaviour;

/// A collection of behaviours by name.
pub trait Behaviours {
    /// Adds a behaviour, or parameters from which a behaviour is made. Its name is [`Parameters::NAME`].
    fn add<P: Parameters + TryInto<BoxedBehaviour, Error: Into<Error>> + 'static>(&mut self);

    /// Adds parameters from which a behaviour is made for a group.
    fn add_for_group<P: ForGroup + 'static>(&mut self);
}

/// Parameters from which a behaviour is made for a group of agents.
pub trait ForGroup: Parameters {
    /// Makes the behaviour.
    ///
    /// # Errors
    /// The agents of the group cannot do what the parameters ask for.
    fn for_group(self, group: &GroupFacts) -> Result<BoxedBehaviour, Error>;
}

/// What a behaviour can depend on when it is made for a group.
#[derive(Clone, Copy, Debug)]
pub struct GroupFacts {
    /// The maximum speed of the slowest agent, m/s.
    pub max_speed: f32,
    /// The number of agents.
    pub agents: usize,
}

/// Adds the behaviours of this crate to a collection.
pub fn register(behaviours: &mut impl Behaviours) {
    behaviours.add::<Seek>();
    behaviours.add::<Flee>();
    behaviours.add::<Arrive>();
    behaviours.add::<Pursue>();
    behaviours.add::<Evade>();
    behaviours.add::<OffsetPursuit>();
    behaviours.add::<Shadow>();
    behaviours.add::<Interpose>();
    behaviours.add::<KeepStation>();
    behaviours.add::<Dock>();
    behaviours.add_for_group::<Takeoff>();
    behaviours.add::<Wander>();
    behaviours.add::<FractalWander>();
    behaviours.add::<Explore>();
    behaviours.add::<Forage>();
    behaviours.add::<Face>();
    behaviours.add::<MatchOrientation>();
    behaviours.add::<LookWhereYouGo>();
    behaviours.add::<Fear>();
    behaviours.add::<HeadFor>();
    behaviours.add::<ConstantForce>();
    behaviours.add::<EvadeAll>();
    behaviours.add::<SlipThrough>();
    behaviours.add::<FollowFlow>();
    behaviours.add::<MoveForward>();
    behaviours.add::<TargetSpeed>();
    behaviours.add::<Tether>();
    behaviours.add::<Separation>();
    behaviours.add::<Alignment>();
    behaviours.add::<Cohesion>();
    behaviours.add::<MatchVelocity>();
    behaviours.add::<Flocking>();
    behaviours.add::<Boids>();
    behaviours.add::<AvoidNeighbours>();
    behaviours.add::<CloseAvoidance>();
    behaviours.add::<UnalignedAvoidance>();
    behaviours.add::<Queue>();
    behaviours.add::<FollowLeader>();
    behaviours.add_for_group::<KeepFormation>();
    behaviours.add::<AvoidObstacles>();
    behaviours.add::<AvoidMap>();
    behaviours.add::<Whiskers>();
    behaviours.add::<Contain>();
    behaviours.add::<FollowPath>();
    behaviours.add::<StayOnPath>();
    behaviours.add::<FollowWall>();
    behaviours.add::<Hide>();
    behaviours.add::<CrowdPath>();
    behaviours.add::<QueueAtDoor>();
    behaviours.add::<swarm::Swarm>();
    behaviours.add::<WeightedSum>();
    behaviours.add::<RunningSum>();
    behaviours.add::<Priority>();
    behaviours.add::<Dithering>();
    behaviours.add::<Allocation>();
    behaviours.add::<ContextSteering>();
    behaviours.add::<Switch>();
    behaviours.add::<Amortised>();
    behaviours.add::<Hold>();
    behaviours.add::<Irregular>();
    behaviours.add::<Limited>();
    behaviours.add::<StopAndWait>();
}

/// The page about behaviours that users write: its example is a test.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/behaviours.md")]
struct BehavioursPage;

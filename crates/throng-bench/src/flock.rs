//! The birds of a flock: plain data for any simulator.

use crate::Dice;
use glam::{DVec2, DVec3};
use throng::motion::{Locomotion, Vehicle};
use throng::{Agent, Error, Group, Settings, SubSteps, World};
use throng_steer::Flocking;

/// A bird of a [`Flock`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bird {
    /// Initial position, metres.
    pub position: DVec3,
    /// Initial heading along the ground, radians.
    pub heading: f64,
}

/// The birds of a work: OpenSteer's boids. They separate from neighbours within 5 m, align with those within 7.5 m, and
/// cohere with those within 9 m, at top speeds of 9 m/s.
#[derive(Clone, Debug, PartialEq)]
pub struct Flock {
    /// The birds, in the order in which they are added.
    pub birds: Vec<Bird>,
}

impl Flock {
    /// Radius of all birds, metres.
    pub const RADIUS: f64 = 0.5;
    /// Greatest speed, m/s.
    pub const MAX_SPEED: f64 = 9.0;
    /// Initial speed, m/s.
    pub const START_SPEED: f64 = 2.7;
    /// Greatest force, newtons.
    pub const MAX_FORCE: f64 = 27.0;
    /// Range of the neighbour search, metres.
    pub const NEIGHBOUR_DISTANCE: f64 = 9.0;
    /// Length of a step, seconds.
    pub const STEP: f64 = 1.0 / 30.0;

    /// Creates `count` birds in a sphere of this radius, metres, above the ground, with random headings.
    pub(crate) fn in_sphere(count: usize, radius: f64) -> Self {
        let mut rng = Dice::new(9);
        let bird = |_| {
            let middle = DVec3::Z * (radius + 100.0);
            Bird { position: rng.in_sphere(radius) + middle, heading: rng.between(-3.1, 3.1) }
        };
        Self { birds: (0..count).map(bird).collect() }
    }

    /// Returns a world of this flock, with or without the guard. Steps are not divided.
    ///
    /// # Errors
    /// The errors of [`World::add_agent`].
    pub fn world(&self, guard: bool) -> Result<World, Error> {
        let mut world =
            World::new(Settings { step: Self::STEP, sub_steps: SubSteps::Fixed(1), ..Settings::default() })?;
        let vehicle = Vehicle {
            max_force: Self::MAX_FORCE as f32,
            max_speed: Self::MAX_SPEED as f32,
            locomotion: Locomotion::Banking,
            ..Vehicle::default()
        };
        let group = world.add_group(Group {
            neighbours: Group::ALL_NEIGHBOURS,
            neighbour_distance: Self::NEIGHBOUR_DISTANCE as f32,
            guard,
            ..Group::steered(Flocking::default())
        })?;
        world.reserve(self.birds.len());
        for &Bird { position, heading } in &self.birds {
            world.add_agent(Agent {
                position: DVec2::new(position.x, position.y).extend(position.z),
                velocity: (DVec2::from_angle(heading) * Self::START_SPEED).as_vec2(),
                heading: Some(heading as f32),
                group,
                radius: Self::RADIUS as f32,
                preferred_speed: Self::MAX_SPEED as f32,
                motor: vehicle.into(),
                ..Agent::default()
            })?;
        }
        Ok(world)
    }
}

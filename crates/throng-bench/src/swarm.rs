//! Insects of a swarm: plain data for any simulator.

use crate::Dice;
use glam::{DVec3, Vec3};
use throng::steer::Target;
use throng::steer::swarm::{Aggregate, Apart, Swarm, midge};
use throng::{Agent, Error, Group, Settings, SubSteps, World};

/// The insects of a work: midges with a noise for each, drawn to the middle of where they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Insects {
    /// Where they are, in the order in which they are added, metres.
    pub places: Vec<DVec3>,
    /// Whether they keep apart; else they see nobody.
    pub apart: bool,
    /// How far their places reach, metres.
    radius: f64,
}

impl Insects {
    /// Radius of everybody, metres.
    pub const RADIUS: f64 = 0.005;
    /// Within what distance they keep apart, metres.
    pub const APART: f64 = 0.06;
    /// Seconds of a step.
    pub const STEP: f64 = 1.0 / 60.0;

    /// So many to the cubic metre, in a sphere that they do not leave.
    pub(crate) fn in_sphere(count: usize, density: f64, apart: bool) -> Self {
        let mut dice = Dice(9);
        let radius = (0.75 / std::f64::consts::PI * count as f64 / density).cbrt();
        let middle = DVec3::Z * (radius + 10.0);
        Self { places: (0..count).map(|_| dice.in_sphere(radius) + middle).collect(), apart, radius }
    }

    /// A world of them, with or without the guard. Steps are not divided.
    ///
    /// # Errors
    /// Those of [`World::add_agent`].
    pub fn world(&self, guard: bool) -> Result<World, Error> {
        let mut world =
            World::new(Settings { step: Self::STEP, sub_steps: SubSteps::Fixed(1), ..Settings::default() })?;
        let middle = Target::Point(Vec3::Z * (self.radius + 10.0) as f32);
        let aggregate = Aggregate { beyond: self.radius as f32, ..Aggregate::from(middle) };
        let distance = if self.apart { Self::APART as f32 } else { 0.0 };
        let swarm = Swarm { apart: Apart { distance, speed: 1.0 }, ..Swarm::default() }.with(aggregate);
        let vehicle = midge();
        let group = world.add_group(Group { guard, ..swarm.group(vehicle) })?;
        world.reserve(self.places.len());
        for &place in &self.places {
            world.add_agent(Agent {
                position: place.truncate(),
                altitude: place.z as f32,
                group,
                radius: Self::RADIUS as f32,
                preferred_speed: vehicle.max_speed,
                max_speed: vehicle.max_speed,
                max_acceleration: f32::INFINITY,
                ..Agent::default()
            })?;
        }
        Ok(world)
    }
}

//! The insects of a swarm: plain data for any simulator.

use crate::Dice;
use glam::{DVec3, Vec3};
use throng::steer::Target;
use throng::{Agent, Error, Group, Settings, SubSteps, World};
use throng_steer::swarm::{Aggregate, Swarm, SwarmSpacing, midge};

/// The insects of a work: midges with independent noise, attracted to the middle of the swarm.
#[derive(Clone, Debug, PartialEq)]
pub struct Insects {
    /// Initial positions, in the order in which they are added, metres.
    pub places: Vec<DVec3>,
    /// Whether they keep apart; else they have no neighbours.
    pub apart: bool,
    /// Radius of the swarm, metres.
    radius: f64,
}

impl Insects {
    /// Radius of all insects, metres.
    pub const RADIUS: f64 = 0.005;
    /// Distance within which they keep apart, metres.
    pub const APART: f64 = 0.06;
    /// Length of a step, seconds.
    pub const STEP: f64 = 1.0 / 60.0;

    /// Creates `count` insects, `density` per cubic metre, in a sphere that they do not leave.
    pub(crate) fn in_sphere(count: usize, density: f64, apart: bool) -> Self {
        let mut rng = Dice::new(9);
        let radius = (0.75 / std::f64::consts::PI * count as f64 / density).cbrt();
        let middle = DVec3::Z * (radius + 10.0);
        Self { places: (0..count).map(|_| rng.in_sphere(radius) + middle).collect(), apart, radius }
    }

    /// Returns a world of the insects, with or without the guard. Steps are not divided.
    ///
    /// # Errors
    /// The errors of [`World::add_agent`].
    pub fn world(&self, guard: bool) -> Result<World, Error> {
        let mut world =
            World::new(Settings { step: Self::STEP, sub_steps: SubSteps::Fixed(1), ..Settings::default() })?;
        let middle = Target::Point(Vec3::Z * (self.radius + 10.0) as f32);
        let aggregate = Aggregate { beyond: self.radius as f32, ..Aggregate::new(middle) };
        let distance = if self.apart { Self::APART as f32 } else { 0.0 };
        let swarm = Swarm { apart: SwarmSpacing { distance, speed: 1.0 }, ..Swarm::default() }.with(aggregate);
        let vehicle = midge();
        let group = world.add_group(Group { guard, ..swarm.group() })?;
        world.reserve(self.places.len());
        for &place in &self.places {
            world.add_agent(Agent {
                position: place,
                group,
                radius: Self::RADIUS as f32,
                preferred_speed: vehicle.max_speed,
                motor: vehicle.into(),
                ..Agent::default()
            })?;
        }
        Ok(world)
    }
}

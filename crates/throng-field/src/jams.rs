//! Flows to goals that lead round jams.

use super::goal::{Density, ToGoal};
use glam::{DVec2, Vec2, Vec3};
use std::sync::Arc;
use throng::Error;
use throng::field::{Adaptive, Field};

/// A flow to a goal that leads round jams. At a fixed interval it measures the density of the agents; where the density
/// is high, ground costs more. Earlier densities count too, so a route that has just become free does not attract all
/// agents at once.
///
/// ```
/// use glam::DVec2;
/// use std::sync::Arc;
/// use throng::agent::Guidance;
/// use throng::field::Governed;
/// use throng_field::{Destination, RoundJams, Terrain, TerrainSettings, ToGoal};
/// use throng::{Agent, Group, Settings, World};
/// let mut world = World::new(Settings { step: 0.1, ..Settings::default() })?;
/// let survey = TerrainSettings { low: DVec2::splat(-12.0), high: DVec2::splat(12.0), ..TerrainSettings::default() };
/// let ground = Terrain::of_place(world.place(), DVec2::ZERO, survey)?;
/// let to = Destination::Point { at: DVec2::X * 9.0, tolerance: 0.2 };
/// let flow = RoundJams::new(ToGoal::new(Arc::new(ground), vec![to], 1.3)?);
/// let guidance = Guidance::JOURNEY.governed(Governed::new(flow, 1.0));
/// let group = world.add_group(Group { guidance, ..Group::default() })?;
/// // ten agents block the direct route
/// for y in -5..5 {
///     world.add_agent(Agent::at([0.0, 0.5 * f64::from(y)]))?;
/// }
/// let walker = world.add_agent(Agent::at([-6.0, 0.0]).group(group))?;
/// let mut farthest = 0.0f64;
/// while world.time() < 15.0 {
///     world.step();
///     farthest = farthest.max(world.position(walker).map_or(0.0, |at| at.y.abs()));
/// }
/// assert!(world.position(walker).unwrap().truncate().distance(DVec2::X * 9.0) < 0.5 && farthest > 2.5);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct RoundJams {
    /// The flow without the cost of crowds.
    pub flow: ToGoal,
    /// Density at which ground costs twice as much, agents a square metre. Limit: > 0.
    pub weary: f32,
    /// Radius over which an agent's density is spread, metres. Limit: > 0.
    pub radius: f64,
    /// Seconds between two measurements. Limit: > 0.
    pub interval: f64,
    /// Weight of the newest measurement; the rest is the previous value. Limit: > 0, at most 1.
    pub part: f32,
}

impl RoundJams {
    /// Creates it with these values: 1 agent a square metre makes ground twice as expensive, agents count over 1.5 m,
    /// two measurements a second, each with a weight of one half.
    pub fn new(flow: ToGoal) -> Self {
        Self { flow, weary: 1.0, radius: 1.5, interval: 0.5, part: 0.5 }
    }
}

impl Field for RoundJams {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        self.flow.velocity(place, time)
    }

    fn row(&self, row: (DVec2, f64), from: usize, time: f64, out: &mut [Vec2]) {
        self.flow.row(row, from, time, out);
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        Some(self)
    }
}

impl Adaptive for RoundJams {
    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("density at which ground costs twice as much", self.weary)?;
        let positive = |what, value: f64| {
            Error::unless(value > 0.0 && value.is_finite(), what, value, "greater than 0 and finite")
        };
        positive("radius of a density", self.radius)?;
        positive("interval of a field", self.interval)?;
        Error::unless(self.part > 0.0 && self.part <= 1.0, "part of a density", self.part, "greater than 0, at most 1")
    }

    fn interval(&self) -> f64 {
        self.interval
    }

    fn memory(&self) -> Vec<f32> {
        vec![0.0; self.flow.lengths().len()]
    }

    fn notice(&self, memory: &mut [f32], people: &[Vec2]) {
        // the limits have been checked
        let Ok(now) = Density::of(self.flow.terrain(), people.iter().copied(), self.radius) else { return };
        now.lead(memory, self.part);
    }

    fn adapted(&self, memory: &[f32]) -> Arc<dyn Field> {
        match self.flow.with_density(memory, self.weary) {
            Ok(flow) => Arc::new(flow),
            Err(_) => Arc::new(self.flow.clone()),
        }
    }
}

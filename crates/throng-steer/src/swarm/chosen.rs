//! The guides of a swarm as files choose them.

use super::sedation::InSmoke;
use super::{Aggregate, Align, Attack, Escape, Flow, Guide, HeightBand, Migrate, Phototaxis, Sedation, Zones};
use std::sync::Arc;
use throng::Error;
use throng::parameters::parameters;

/// A guide of an insect.
#[parameters]
enum SwarmGuide {
    /// Follows a field: wind, a path to a goal.
    Flow(Flow),
    /// Gathers at a marker.
    Aggregate(Aggregate),
    /// Flies to a light, and around it.
    Phototaxis(Phototaxis),
    /// Is sedated by smoke.
    Sedation(InSmoke),
    /// Attacks a target.
    Attack(Attack),
    /// Migrates along a path.
    Migrate(Migrate),
    /// Matches the velocity of near agents.
    Align(Align),
    /// Stays between two heights.
    HeightBand(HeightBand),
    /// Flees from a predator.
    Escape(Escape),
    /// Zones of repulsion, alignment and attraction.
    Zones(Zones),
}

impl TryFrom<SwarmGuide> for Arc<dyn Guide> {
    type Error = Error;

    fn try_from(chosen: SwarmGuide) -> Result<Self, Error> {
        Ok(match chosen {
            SwarmGuide::Flow(guide) => Arc::new(guide),
            SwarmGuide::Aggregate(guide) => Arc::new(guide),
            SwarmGuide::Phototaxis(guide) => Arc::new(guide),
            SwarmGuide::Sedation(guide) => Arc::new(Sedation::try_from(guide)?),
            SwarmGuide::Attack(guide) => Arc::new(guide),
            SwarmGuide::Migrate(guide) => Arc::new(guide),
            SwarmGuide::Align(guide) => Arc::new(guide),
            SwarmGuide::HeightBand(guide) => Arc::new(guide),
            SwarmGuide::Escape(guide) => Arc::new(guide),
            SwarmGuide::Zones(guide) => Arc::new(guide),
        })
    }
}

/// A guide.
#[parameters]
struct ChosenGuide(#[parameter(from = SwarmGuide)] Arc<dyn Guide>);

/// Guides.
#[parameters]
pub(super) struct ChosenGuides(Vec<ChosenGuide>);

impl From<ChosenGuides> for Vec<Arc<dyn Guide>> {
    fn from(ChosenGuides(guides): ChosenGuides) -> Self {
        guides.into_iter().map(|ChosenGuide(guide)| guide).collect()
    }
}

//! Behaviours among neighbours: formations.

use super::super::limits::{Limit, check_some};
use super::single::SLOWING_DISTANCE;
use super::{BehaviourContext, BuildBehaviour, or};
use crate::file::{Path, Problem};
use crate::scene::steer::*;
use throng::parameters::Angle;
use throng::steer::BoxedBehaviour;
use throng_steer::Neighbourhood;

impl BehaviourContext<'_> {
    /// Returns the neighbourhood of a behaviour, with the behaviour's defaults.
    pub(super) fn near(
        &self,
        said: &Option<Near>,
        standard: Neighbourhood,
        at: &Path,
    ) -> Result<Neighbourhood, Problem> {
        let Some(said) = said else { return Ok(standard) };
        check_some(&at.key("angle"), said.angle, Limit::Between(0.0, 180.0))?;
        Ok(Neighbourhood {
            distance: or(said.distance, standard.distance),
            angle: said.angle.map_or(standard.angle, Angle::degrees),
            always: or(said.always, standard.always),
            most: said.most.map_or(standard.most, |most| most as usize),
            groups: self.groups(said.groups.as_ref(), &at.key("groups"))?,
        })
    }
}

impl BuildBehaviour for KeepFormation {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::KeepFormation {
            leader: making.target(&self.leader, &at.key("leader"))?,
            pattern: match self.pattern {
                Pattern::Line => throng_steer::Pattern::Line,
                Pattern::Column => throng_steer::Pattern::Column,
                Pattern::Wedge => throng_steer::Pattern::Wedge,
                Pattern::Circle => throng_steer::Pattern::Circle,
                Pattern::Grid => throng_steer::Pattern::Grid,
            },
            count: self.count.map_or(making.cast.named[making.group].1.len(), |count| count as usize),
            spacing: self.spacing as f32,
            slowing_distance: or(self.slowing_distance, SLOWING_DISTANCE),
        }
        .into())
    }
}

//! Behaviours among neighbours: flocks, queues, followers, formations.

use super::super::limits::{Limit, check_some};
use super::single::SLOWING_DISTANCE;
use super::{BehaviourContext, BuildBehaviour, angle, or};
use crate::file::{Path, Problem};
use crate::scene::steer::*;
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
            angle: angle(said.angle, standard.angle),
            always: or(said.always, standard.always),
            most: said.most.map_or(standard.most, |most| most as usize),
            groups: self.groups(said.groups.as_ref(), &at.key("groups"))?,
        })
    }
}

impl BuildBehaviour for Separation {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::Separation::default();
        Ok(throng_steer::Separation {
            near: making.near(&self.near, standard.near, &at.key("near"))?,
            falloff: self.falloff.map_or(standard.falloff, |falloff| match falloff {
                Falloff::Inverse => throng_steer::Falloff::Inverse,
                Falloff::InverseSquare => throng_steer::Falloff::InverseSquare,
            }),
            full: or(self.full, standard.full),
        }
        .into())
    }
}

impl BuildBehaviour for Alignment {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::Alignment::default();
        let near = making.near(&self.near, standard.near, &at.key("near"))?;
        Ok(throng_steer::Alignment { near, full: or(self.full, standard.full) }.into())
    }
}

impl BuildBehaviour for Cohesion {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::Cohesion::default();
        let near = making.near(&self.near, standard.near, &at.key("near"))?;
        Ok(throng_steer::Cohesion { near, full: or(self.full, standard.full) }.into())
    }
}

impl BuildBehaviour for MatchVelocity {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::MatchVelocity { near: making.near(&self.near, Neighbourhood::default(), &at.key("near"))? }
            .into())
    }
}

impl BuildBehaviour for Flocking {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::Flocking::default();
        Ok(throng_steer::Flocking {
            separation: rule(&self.separation, standard.separation, &at.key("separation"))?,
            alignment: rule(&self.alignment, standard.alignment, &at.key("alignment"))?,
            cohesion: rule(&self.cohesion, standard.cohesion, &at.key("cohesion"))?,
            always: or(self.always, standard.always),
            groups: match &self.groups {
                None => standard.groups,
                groups => making.groups(groups.as_ref(), &at.key("groups"))?,
            },
        }
        .into())
    }
}

fn rule(said: &Option<Rule>, standard: throng_steer::Rule, at: &Path) -> Result<throng_steer::Rule, Problem> {
    let Some(said) = said else { return Ok(standard) };
    check_some(&at.key("angle"), said.angle, Limit::Between(0.0, 180.0))?;
    check_some(&at.key("distance"), said.distance, Limit::Positive)?;
    check_some(&at.key("weight"), said.weight, Limit::NotNegative)?;
    Ok(throng_steer::Rule {
        weight: or(said.weight, standard.weight),
        distance: or(said.distance, standard.distance),
        angle: angle(said.angle, standard.angle),
    })
}

impl BuildBehaviour for Boids {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::Boids::default();
        let said = self.strengths.clone().unwrap_or_default();
        let mut strengths = standard.strengths;
        let keys = ["avoid", "matching", "center", "migrate"];
        let all = [said.avoid, said.matching, said.center, said.migrate];
        for ((key, said), strength) in keys.into_iter().zip(all).zip(&mut strengths) {
            check_some(&at.key("strengths").key(key), said, Limit::Between(0.0, 1.0))?;
            *strength = or(said, *strength);
        }
        let migration = self.migration.as_ref().map(|target| making.target(target, &at.key("migration")));
        Ok(throng_steer::Boids {
            near: making.near(&self.near, standard.near, &at.key("near"))?,
            forward: or(self.forward, standard.forward),
            avoidance: or(self.avoidance, standard.avoidance),
            strengths,
            migration: migration.transpose()?,
        }
        .into())
    }
}

impl BuildBehaviour for AvoidNeighbours {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::AvoidNeighbours::default();
        let groups = making.groups(self.groups.as_ref(), &at.key("groups"))?;
        Ok(throng_steer::AvoidNeighbours { groups, horizon: or(self.horizon, standard.horizon) }.into())
    }
}

impl BuildBehaviour for CloseAvoidance {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::CloseAvoidance::default();
        let groups = making.groups(self.groups.as_ref(), &at.key("groups"))?;
        Ok(throng_steer::CloseAvoidance { groups, gap: or(self.gap, standard.gap) }.into())
    }
}

impl BuildBehaviour for UnalignedAvoidance {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::UnalignedAvoidance::default();
        Ok(throng_steer::UnalignedAvoidance {
            groups: making.groups(self.groups.as_ref(), &at.key("groups"))?,
            horizon: or(self.horizon, standard.horizon),
            gap: or(self.gap, standard.gap),
        }
        .into())
    }
}

impl BuildBehaviour for Queue {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::Queue::new(making.branch(&self.of, &at.key("of"))?);
        Ok(throng_steer::Queue {
            groups: making.groups(self.groups.as_ref(), &at.key("groups"))?,
            distance: or(self.distance, standard.distance),
            width: or(self.width, standard.width),
            gap: or(self.gap, standard.gap),
            headway: or(self.headway, standard.headway),
            ..standard
        }
        .into())
    }
}

impl BuildBehaviour for FollowLeader {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::FollowLeader::from(making.target(&self.leader, &at.key("leader"))?);
        Ok(throng_steer::FollowLeader {
            single_file: self.single_file.unwrap_or(standard.single_file),
            gap: or(self.gap, standard.gap),
            free: or(self.free, standard.free),
            width: or(self.width, standard.width),
            slowing_distance: or(self.slowing_distance, standard.slowing_distance),
            spacing: or(self.spacing, standard.spacing),
            ..standard
        }
        .into())
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

//! Moving past agents that are in the way.

use super::{BehaviourContext, BuildBehaviour, angle, or};
use crate::file::{Path, Problem};
use crate::scene::steer::*;
use throng::steer::BoxedBehaviour;

impl BehaviourContext<'_> {
    fn evade_all(&self, said: &EvadeAll, at: &Path) -> Result<throng_steer::EvadeAll, Problem> {
        let standard = throng_steer::EvadeAll::default();
        Ok(throng_steer::EvadeAll {
            groups: said
                .groups
                .as_ref()
                .map_or(Ok(standard.groups), |groups| self.groups(Some(groups), &at.key("groups")))?,
            ahead: or(said.ahead, standard.ahead),
            near: or(said.near, standard.near),
            behind: or(said.behind, standard.behind),
        })
    }
}

impl BuildBehaviour for EvadeAll {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        making.evade_all(self, at).map(BoxedBehaviour::from)
    }
}

impl BuildBehaviour for SlipThrough {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::SlipThrough::from(making.target(&self.target, &at.key("target"))?);
        let evade = self.evade.as_ref().map(|said| making.evade_all(said, &at.key("evade"))).transpose()?;
        Ok(throng_steer::SlipThrough {
            evade: evade.unwrap_or(standard.evade),
            ahead: or(self.ahead, standard.ahead),
            width: or(self.width, standard.width),
            turn: angle(self.turn, standard.turn),
            ..standard
        }
        .into())
    }
}

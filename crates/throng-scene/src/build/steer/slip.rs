//! Past others who are in the way.

use super::{Make, Making, angle, or};
use crate::file::{Path, Problem};
use crate::scene::steer::*;
use throng::steer::{self, Branch};

impl Making<'_> {
    fn evade_all(&self, said: &EvadeAll, at: &Path) -> Result<steer::EvadeAll, Problem> {
        let standard = steer::EvadeAll::default();
        Ok(steer::EvadeAll {
            who: said.who.as_ref().map_or(Ok(standard.who), |who| self.who(Some(who), &at.key("who")))?,
            ahead: or(said.ahead, standard.ahead),
            near: or(said.near, standard.near),
            behind: or(said.behind, standard.behind),
        })
    }
}

impl Make for EvadeAll {
    fn make(&self, making: &Making, at: &Path) -> Result<Branch, Problem> {
        making.evade_all(self, at).map(Branch::from)
    }
}

impl Make for SlipThrough {
    fn make(&self, making: &Making, at: &Path) -> Result<Branch, Problem> {
        let standard = steer::SlipThrough::from(making.target(&self.target, &at.key("target"))?);
        let evade = self.evade.as_ref().map(|said| making.evade_all(said, &at.key("evade"))).transpose()?;
        Ok(steer::SlipThrough {
            evade: evade.unwrap_or(standard.evade),
            ahead: or(self.ahead, standard.ahead),
            width: or(self.width, standard.width),
            turn: angle(self.turn, standard.turn),
            ..standard
        }
        .into())
    }
}

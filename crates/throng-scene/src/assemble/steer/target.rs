//! Places, agents and groups that behaviours refer to.

use super::super::limits::{HIGHEST, Limit, check};
use super::BehaviourContext;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::scene::steer::{GroupFilter, Member, Position, Target};
use glam::Vec3;
use std::ops::Range;
use throng::GroupId;

/// Returns the position in the world of the group or mover at a position of the scene: after the world's default group.
pub(in crate::assemble) fn in_world(position: usize) -> usize {
    GroupId::DEFAULT.index() + 1 + position
}

impl BehaviourContext<'_> {
    /// Returns a place of the scene in the world.
    pub fn place(&self, place: Position, at: &Path) -> Result<Vec3, Problem> {
        let [x, y, z] = place.0;
        check(&at.index(2), z, Limit::Between(0.0, HIGHEST))?;
        Ok((DVec2::new(x, y) - self.cast.origin).as_vec2().extend(z as f32))
    }

    /// Returns the target of a behaviour.
    pub fn target(&self, target: &Target, at: &Path) -> Result<throng::steer::Target, Problem> {
        Ok(match target {
            Target::At(place) => throng::steer::Target::Point(self.place(*place, at)?),
            Target::Goal => throng::steer::Target::Goal,
            Target::Agent(member) => throng::steer::Target::Agent(self.member(member, at)?),
            Target::Nearest(groups) => throng::steer::Target::Nearest(self.groups(Some(groups), &at.key("nearest"))?),
        })
    }

    /// Returns the filter of the agents that count; all agents by default.
    pub fn groups(&self, groups: Option<&GroupFilter>, at: &Path) -> Result<throng::steer::GroupFilter, Problem> {
        Ok(match groups {
            None | Some(GroupFilter::All) => throng::steer::GroupFilter::All,
            Some(GroupFilter::Own) => throng::steer::GroupFilter::OwnGroup,
            Some(GroupFilter::Others) => throng::steer::GroupFilter::OtherGroups,
            Some(GroupFilter::Group(name)) => throng::steer::GroupFilter::Group(in_world(self.named(name, at)?.0)),
        })
    }

    /// Returns the number of an agent.
    fn member(&self, member: &Member, at: &Path) -> Result<u32, Problem> {
        let name = &member.group;
        let (_, numbers) = self.named(name, &at.key("group"))?;
        let number = u32::try_from(member.agent).ok().and_then(|k| numbers.start.checked_add(k));
        number.filter(|number| numbers.contains(number)).ok_or_else(|| {
            let message = format!("there is no agent {} in `{name}`", member.agent);
            let hint = match numbers.len() {
                1 => "it has one agent, 0".to_owned(),
                count => format!("it has {count} agents, 0 to {}", count - 1),
            };
            Problem::new(&at.key("agent"), Kind::OutOfRange, message).hint(hint)
        })
    }

    /// Returns the group or mover with a name: its position, and the numbers of its agents.
    fn named(&self, name: &str, at: &Path) -> Result<(usize, &Range<u32>), Problem> {
        self.cast.find(name).map_err(|_| {
            let names: Vec<&str> = self.cast.named.iter().map(|(name, _)| *name).collect();
            let message = format!("there is no group `{name}`");
            Problem::new(at, Kind::UnknownKey, message).hint(format!("there is: {}", names.join(", ")))
        })
    }
}

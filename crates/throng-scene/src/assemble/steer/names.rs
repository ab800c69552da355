//! What the names in a scene stand for, for the behaviours of a group.

use super::super::limits::{HIGHEST, Limit, check};
use super::super::motor::least_top_speed;
use super::super::rules::no_figure;
use super::BehaviourContext;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::registry::{Flow, Names, Steer};
use crate::scene::SceneNames;
use crate::scene::flow::Map;
use crate::scene::steer::{GroupFilter, Member, ObstacleNames, Position, Target};
use glam::Vec3;
use std::ops::Range;
use std::sync::Arc;
use throng::GroupId;
use throng::field::{FactorMap, Field};
use throng::space::Pathway;
use throng::space::surface::{Barrier, Surface};
use throng::steer::{self, Barriers, BoxedBehaviour};
use throng_steer::GroupFacts;

/// Returns the position in the world of the group or mover at a position of the scene: after the world's default group.
pub(in crate::assemble) fn in_world(position: usize) -> usize {
    GroupId::DEFAULT.index() + 1 + position
}

impl Names for BehaviourContext<'_> {
    fn group(&self, _: &Path) -> Result<GroupFacts, Problem> {
        let max_speed = least_top_speed(&self.scene.groups[self.group]);
        Ok(GroupFacts { max_speed, agents: self.cast.named[self.group].1.len() })
    }

    fn place(&self, place: Position, at: &Path) -> Result<Vec3, Problem> {
        let [x, y, z] = place.0;
        check(&at.index(2), z, Limit::Between(0.0, HIGHEST))?;
        Ok((DVec2::new(x, y) - self.cast.origin).as_vec2().extend(z as f32))
    }

    fn target(&self, target: &Target, at: &Path) -> Result<steer::Target, Problem> {
        Ok(match target {
            Target::At(place) => steer::Target::Point(self.place(*place, at)?),
            Target::Goal => steer::Target::Goal,
            Target::Agent(member) => steer::Target::Agent(self.member(member, at)?),
            Target::Nearest(groups) => steer::Target::Nearest(self.groups(groups, &at.key("nearest"))?),
        })
    }

    fn groups(&self, groups: &GroupFilter, at: &Path) -> Result<steer::GroupFilter, Problem> {
        Ok(match groups {
            GroupFilter::All => steer::GroupFilter::All,
            GroupFilter::Own => steer::GroupFilter::OwnGroup,
            GroupFilter::Others => steer::GroupFilter::OtherGroups,
            GroupFilter::Group(name) => steer::GroupFilter::Group(in_world(self.named(name, at)?.0)),
        })
    }

    fn obstacles(&self, names: &ObstacleNames, at: &Path) -> Result<Barriers, Problem> {
        self.around.sides(names, at, "leave it out, or name what counts")
    }

    fn surface(&self, name: &str, at: &Path) -> Result<Barrier<Arc<dyn Surface>>, Problem> {
        self.around.surface(name, at)
    }

    fn path(&self, name: &str, at: &Path) -> Result<Arc<Pathway>, Problem> {
        self.around.path(name, at)
    }

    fn figure(&self, name: &str, at: &Path) -> Result<usize, Problem> {
        let index = self.figures.iter().position(|known| known == name);
        index.ok_or_else(|| no_figure(self.scene, at, name, self.figures))
    }

    fn field(&self, flow: &Flow, at: &Path) -> Result<Arc<dyn Field>, Problem> {
        self.flows.of_group(self.group).field(flow, at)
    }

    fn map(&self, map: &Map, at: &Path) -> Result<Arc<dyn FactorMap>, Problem> {
        self.flows.of_group(self.group).map(map, at)
    }

    fn behaviour(&self, steer: &Steer, at: &Path) -> Result<BoxedBehaviour, Problem> {
        self.scene.plugins.behaviours.make(steer, self, at)
    }

    fn names(&self, _: &Path) -> Result<&SceneNames<'_>, Problem> {
        Ok(self.cast)
    }
}

impl BehaviourContext<'_> {
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
            Problem::no_such(at, "group", name, &names, || "add one with this name: [[group]]".to_owned())
        })
    }
}

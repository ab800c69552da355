//! What the names in a scene stand for, for the behaviours of a group.

use super::super::rules::no_figure;
use super::{BehaviourContext, vehicle};
use crate::file::{Path, Problem};
use crate::registry::{Flow, Names, Steer};
use crate::scene::SceneNames;
use crate::scene::steer::{GroupFilter, ObstacleNames, Position, Target};
use glam::Vec3;
use std::sync::Arc;
use throng::field::Field;
use throng::space::Pathway;
use throng::space::surface::{Barrier, Surface};
use throng::steer::{self, Barriers, BoxedBehaviour};
use throng_steer::GroupFacts;

impl Names for BehaviourContext<'_> {
    fn group(&self, _: &Path) -> Result<GroupFacts, Problem> {
        let vehicle = vehicle(&self.scene.groups[self.group]);
        Ok(GroupFacts { vehicle, agents: self.cast.named[self.group].1.len() })
    }

    fn place(&self, place: Position, at: &Path) -> Result<Vec3, Problem> {
        self.place(place, at)
    }

    fn target(&self, target: &Target, at: &Path) -> Result<steer::Target, Problem> {
        self.target(target, at)
    }

    fn groups(&self, groups: &GroupFilter, at: &Path) -> Result<steer::GroupFilter, Problem> {
        self.groups(Some(groups), at)
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
        Ok(self.flows.make(flow, at.clone(), self.group)?.field)
    }

    fn behaviour(&self, steer: &Steer, at: &Path) -> Result<BoxedBehaviour, Problem> {
        self.scene.plugins.behaviours.make(steer, self, at)
    }

    fn names(&self, _: &Path) -> Result<&SceneNames<'_>, Problem> {
        Ok(self.cast)
    }
}

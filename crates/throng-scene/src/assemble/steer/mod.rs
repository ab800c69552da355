//! Builds behaviours from the steering of a scene: what the names in it stand for.

mod around;
mod check;
mod names;

pub(super) use around::Around;
pub(super) use check::check_steering;
pub(super) use names::in_world;

use super::flow::Flows;
use crate::file::{Path, Problem};
pub(super) use crate::registry::refused;
use crate::scene::{Group, Scene, SceneNames};
use throng::steer::{Barriers, BoxedBehaviour};

/// The input for building behaviours.
pub(crate) struct BehaviourContext<'a> {
    pub(super) scene: &'a Scene,
    /// The names that behaviours can refer to, and the origin of coordinates.
    pub(super) cast: &'a SceneNames<'a>,
    /// The names of the figures of the rules.
    pub(super) figures: &'a [String],
    /// Surfaces, paths and obstacles.
    pub(super) around: &'a Around<'a>,
    /// Fields.
    pub(super) flows: &'a Flows<'a>,
    /// The group of the behaviour, by its position.
    pub(super) group: usize,
}

impl BehaviourContext<'_> {
    /// Returns the behaviour of the group.
    pub fn steering(&self) -> Result<Option<BoxedBehaviour>, Problem> {
        let Some(steer) = &self.scene.groups[self.group].steer else { return Ok(None) };
        let path = Path::of("group").index(self.group).key("steer");
        self.scene.plugins.behaviours.make(steer, self, &path).map(Some).map_err(|mut problem| {
            let name = Group::name_at(&self.scene.groups[self.group].name, self.group);
            problem.message = format!("group `{name}`: {}", problem.message);
            problem
        })
    }

    /// Returns what is solid to the group.
    pub fn solid(&self) -> Result<Barriers, Problem> {
        let at = Path::of("group").index(self.group).key("solid");
        let what = self.scene.groups[self.group].solid.as_ref();
        what.map_or(Ok(Barriers::default()), |what| self.around.sides(what, &at, "leave out `solid` for nothing"))
    }
}

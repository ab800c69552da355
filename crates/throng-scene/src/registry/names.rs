//! What names in scene files stand for.

use super::{Flow, Steer};
use crate::file::{Path, Problem};
use crate::scene::SceneNames;
use crate::scene::flow::Map;
use crate::scene::steer::{GroupFilter, ObstacleNames, Position, Target};
use glam::Vec3;
use std::sync::Arc;
use throng::field::{FactorMap, Field};
use throng::space::Pathway;
use throng::space::surface::{Barrier, Surface};
use throng::steer::{self, Barriers, BoxedBehaviour};
use throng_steer::GroupFacts;

/// The names in a scene, and what the scene has under them. `at` is the path to what the scene says.
pub(crate) trait Names {
    /// Returns what the behaviour of a group can depend on.
    fn group(&self, at: &Path) -> Result<GroupFacts, Problem>;
    /// Returns a place in the coordinates of behaviours.
    fn place(&self, place: Position, at: &Path) -> Result<Vec3, Problem>;
    fn target(&self, target: &Target, at: &Path) -> Result<steer::Target, Problem>;
    fn groups(&self, groups: &GroupFilter, at: &Path) -> Result<steer::GroupFilter, Problem>;
    fn obstacles(&self, names: &ObstacleNames, at: &Path) -> Result<Barriers, Problem>;
    fn surface(&self, name: &str, at: &Path) -> Result<Barrier<Arc<dyn Surface>>, Problem>;
    fn path(&self, name: &str, at: &Path) -> Result<Arc<Pathway>, Problem>;
    fn figure(&self, name: &str, at: &Path) -> Result<usize, Problem>;
    fn field(&self, flow: &Flow, at: &Path) -> Result<Arc<dyn Field>, Problem>;
    fn map(&self, map: &Map, at: &Path) -> Result<Arc<dyn FactorMap>, Problem>;
    fn behaviour(&self, steer: &Steer, at: &Path) -> Result<BoxedBehaviour, Problem>;
    /// Returns the names that a behaviour of a plug-in can ask for.
    fn names(&self, at: &Path) -> Result<&SceneNames<'_>, Problem>;
}

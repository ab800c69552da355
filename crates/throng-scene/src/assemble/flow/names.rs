//! What the names in a scene stand for, for its fields.

use super::FieldSite;
use crate::assemble::limits::{Limit, check};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::registry::{Flow, Names, Steer};
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

impl Names for FieldSite<'_> {
    fn group(&self, at: &Path) -> Result<GroupFacts, Problem> {
        Err(agents(at))
    }

    fn place(&self, Position([x, y, z]): Position, at: &Path) -> Result<Vec3, Problem> {
        check(&at.index(2), z, Limit::Finite)?;
        Ok(self.context(at).place_at(at, [x, y])?.as_vec2().extend(z as f32))
    }

    fn obstacles(&self, names: &ObstacleNames, at: &Path) -> Result<Barriers, Problem> {
        self.check_stays(at, "leave out `walls` in fields of `around`")?;
        self.flows.around.sides(names, at, "leave out `walls` for no walls")
    }

    fn surface(&self, name: &str, at: &Path) -> Result<Barrier<Arc<dyn Surface>>, Problem> {
        self.flows.around.surface(name, at)
    }

    fn path(&self, name: &str, at: &Path) -> Result<Arc<Pathway>, Problem> {
        self.flows.around.path(name, at)
    }

    fn field(&self, flow: &Flow, at: &Path) -> Result<Arc<dyn Field>, Problem> {
        self.flows.scene.plugins.fields.make(flow, &self.context(at))
    }

    fn map(&self, map: &Map, at: &Path) -> Result<Arc<dyn FactorMap>, Problem> {
        Ok(self.context(at).map(map)?)
    }

    fn target(&self, _: &Target, at: &Path) -> Result<steer::Target, Problem> {
        Err(agents(at))
    }

    fn groups(&self, _: &GroupFilter, at: &Path) -> Result<steer::GroupFilter, Problem> {
        Err(agents(at))
    }

    fn figure(&self, _: &str, at: &Path) -> Result<usize, Problem> {
        Err(agents(at))
    }

    fn behaviour(&self, _: &Steer, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Err(agents(at))
    }

    fn names(&self, at: &Path) -> Result<&SceneNames<'_>, Problem> {
        Err(agents(at))
    }
}

/// Returns the error for a parameter of a field that names agents or what agents do.
fn agents(at: &Path) -> Problem {
    Problem::new(at, Kind::Conflict, "a field has no parameters of this kind: only behaviours have them")
}

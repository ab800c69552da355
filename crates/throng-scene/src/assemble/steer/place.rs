//! Obstacles by name.

use super::BehaviourContext;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::registry::Names;
use crate::scene::steer::ObstacleNames;
use std::sync::Arc;
use throng::space::Pathway;
use throng::steer::Barriers;

impl BehaviourContext<'_> {
    /// Returns the obstacles of a behaviour; everything by default.
    pub(super) fn barriers(&self, what: &Option<ObstacleNames>, at: &Path) -> Result<Barriers, Problem> {
        let what = what.clone().unwrap_or_default();
        self.around.sides(&what, &at.key("obstacles"), "leave out `obstacles` for everything")
    }

    /// Returns what is solid to the group.
    pub fn solid(&self) -> Result<Barriers, Problem> {
        let at = Path::of("group").index(self.group).key("solid");
        let what = self.scene.groups[self.group].solid.as_ref();
        what.map_or(Ok(Barriers::default()), |what| self.around.sides(what, &at, "leave out `solid` for nothing"))
    }

    pub(super) fn path(&self, name: &str, at: &Path) -> Result<Arc<Pathway>, Problem> {
        Names::path(self, name, &at.key("path"))
    }
}

/// Returns the error for an unknown name.
pub(super) fn unknown(at: &Path, what: &str, name: &str, known: &[&str]) -> Problem {
    let problem = Problem::new(at, Kind::UnknownKey, format!("there is no {what} `{name}`"));
    match known {
        [] => problem.hint(format!("add one with this name: [[{}]]", what.split(' ').next().unwrap_or(what))),
        known => problem.hint(format!("there is: {}", known.join(", "))),
    }
}

//! Behaviours of plug-ins.

use super::{BehaviourContext, BuildBehaviour};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::games;
use crate::scene::steer::Custom;
use throng::steer::BoxedBehaviour;

impl BuildBehaviour for Custom {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let own = &making.scene.plugins.behaviours;
        let games = games::behaviours();
        let Some(behaviours) = [own, &games].into_iter().find(|all| all.names().any(|name| name == self.name)) else {
            return Err(unknown(self, at, &own.names().collect::<Vec<_>>()));
        };
        let inside = at.name(&self.name);
        if !self.parameters.is_empty() && behaviours.schema(&self.name).is_none() {
            return Err(without(self, at));
        }
        let made = behaviours.make(&self.name, &self.parameters, making.cast);
        let what = format!("behaviour `{}`", self.name);
        made.ok_or_else(|| unknown(self, at, &[]))?.map_err(|unmade| unmade.at(at, &inside, &what))
    }
}

/// Returns the error for an unknown behaviour.
fn unknown(said: &Custom, at: &Path, known: &[&str]) -> Problem {
    let hint = match known {
        [] => "programs add behaviours to a scene by `Scene::plugins`; this one has added none".to_owned(),
        _ => format!("this program has added: {}", known.join(", ")),
    };
    Problem::new(at, Kind::UnknownKey, format!("there is no behaviour `{}`", said.name)).hint(hint)
}

/// Returns the error for parameters of a behaviour without parameters.
fn without(said: &Custom, at: &Path) -> Problem {
    let Custom { name, .. } = said;
    let problem = Problem::new(at, Kind::UnknownKey, format!("the behaviour `{name}` has no parameters"));
    problem.hint(format!("leave them out: custom = \"{name}\""))
}

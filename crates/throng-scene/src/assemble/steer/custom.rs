//! Behaviours of plug-ins.

use super::super::limits::{Limit, check};
use super::{BehaviourContext, BuildBehaviour};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::games;
use crate::registry::Unmade;
use crate::scene::steer::Custom;
use serde_json::Value;
use throng::steer::BoxedBehaviour;

impl BuildBehaviour for Custom {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let own = &making.scene.plugins.behaviours;
        let games = games::behaviours();
        let Some(behaviours) = [own, &games].into_iter().find(|all| all.names().any(|name| name == self.name)) else {
            return Err(unknown(self, at, &own.names().collect::<Vec<_>>()));
        };
        let inside = at.name(&self.name);
        match behaviours.schema(&self.name) {
            Some(schema) => self.check(&schema, &inside)?,
            None if self.parameters.is_empty() => {}
            None => return Err(without(self, at)),
        }
        let made = behaviours.make(&self.name, &self.parameters, making.cast);
        let what = format!("behaviour `{}`", self.name);
        made.ok_or_else(|| unknown(self, at, &[]))?.map_err(|unmade| unmade.at(at, &inside, &what))
    }
}

impl Custom {
    /// Checks that the behaviour has the given parameters, and that they are within their limits.
    fn check(&self, schema: &Value, at_all: &Path) -> Result<(), Problem> {
        let Some(known) = schema["properties"].as_object() else { return Ok(()) };
        for (key, said) in &self.parameters {
            let at = at_all.name(key);
            let Some(property) = known.get(key) else {
                let keys = known.keys().cloned().collect();
                return Err(Unmade::Unknown(key.clone(), keys).at(&at, at_all, ""));
            };
            let number = said.as_float().or_else(|| said.as_integer().map(|whole| whole as f64));
            let limit = match (property["minimum"].as_f64(), property["maximum"].as_f64()) {
                (Some(low), Some(high)) => Limit::Between(low, high),
                (Some(low), None) => Limit::AtLeast(low),
                (None, Some(high)) => Limit::AtMost(high),
                (None, None) => continue,
            };
            number.map_or(Ok(()), |number| check(&at, number, limit))?;
        }
        Ok(())
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

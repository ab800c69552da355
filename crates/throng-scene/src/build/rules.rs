//! The rules of a scene's game.

use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::Scene;
use std::sync::Arc;
use throng::{Rules, World};

/// The rules that a scene names, if it names any.
pub(super) fn find(scene: &Scene) -> Result<Option<&Arc<dyn Rules>>, Problem> {
    let Some(name) = &scene.rules else { return Ok(None) };
    scene.rulebook.get(name).map(Some).ok_or_else(|| {
        let known: Vec<&str> = scene.rulebook.names().collect();
        let problem = Problem::new(&Path::of("rules"), Kind::UnknownKey, format!("there are no rules `{name}`"));
        problem.hint(format!("there are: {}; programs add theirs to Scene::rulebook", known.join(", ")))
    })
}

/// Lets the game begin, if there is one.
pub(super) fn begin(scene: &Scene, world: &mut World) -> Result<(), Problem> {
    let Some(rules) = find(scene)? else { return Ok(()) };
    world.set_rules(rules.clone()).map_err(|error| {
        let name = scene.rules.as_deref().unwrap_or_default();
        Problem::new(&Path::of("rules"), Kind::World, format!("the rules `{name}` do not fit the scene: {error}"))
    })
}

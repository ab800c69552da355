//! The rules of a scene's game.

use super::limits::{Limit, check, check_some};
use super::plan::Plan;
use super::world::Built;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::{Cast, FigureExpect, Scene};
use throng::World;

/// Lets the game begin, if there is one; and is there what is expected of it?
pub(super) fn begin(scene: &Scene, plan: &Plan, built: &Built, world: &mut World) -> Result<(), Problem> {
    if let Some(name) = &scene.rules {
        let named: Vec<_> = built.groups.iter().map(|group| (group.name.as_str(), group.numbers.clone())).collect();
        let paths: Vec<_> = scene.paths.iter().map(|path| path.name.as_str()).zip(plan.paths.iter().cloned()).collect();
        let cast = Cast { origin: plan.settings.origin, obstacles: &plan.obstacles, named: &named, paths: &paths };
        let made = scene.rulebook.make(name, &cast).ok_or_else(|| unknown(scene, name))?;
        made.and_then(|rules| world.set_rules(rules)).map_err(|error| {
            let message = format!("the rules `{name}` do not fit the scene: {error}");
            Problem::new(&Path::of("rules"), Kind::World, message)
        })?;
    }
    let path = Path::of("expect");
    let figures = scene.expect.figure.iter().enumerate();
    figures
        .map(|(i, said)| (path.key("figure").index(i), said))
        .try_for_each(|(path, said)| figure(scene, world, &path, said))
}

fn unknown(scene: &Scene, name: &str) -> Problem {
    let known: Vec<&str> = scene.rulebook.names().collect();
    let problem = Problem::new(&Path::of("rules"), Kind::UnknownKey, format!("there are no rules `{name}`"));
    problem.hint(format!("there are: {}; programs add theirs to Scene::rulebook", known.join(", ")))
}

/// Checks what is expected of a figure.
fn figure(scene: &Scene, world: &World, path: &Path, said: &FigureExpect) -> Result<(), Problem> {
    check_some(&path.key("at_least"), said.at_least, Limit::Finite)?;
    check_some(&path.key("at_most"), said.at_most, Limit::Finite)?;
    check(&path.key("after"), said.after, Limit::NotNegative)?;
    if world.figure(&said.of).is_some() {
        return Ok(());
    }
    let known: Vec<&str> = world.figures().map(|(name, _)| name).collect();
    let problem = Problem::new(&path.key("of"), Kind::UnknownKey, format!("there is no figure `{}`", said.of));
    Err(match (&scene.rules, known.is_empty()) {
        (None, _) => problem.hint("figures are kept by rules: say which, rules = \"NAME\""),
        (Some(rules), true) => problem.hint(format!("the rules `{rules}` keep none")),
        (Some(rules), false) => problem.hint(format!("the rules `{rules}` keep: {}", known.join(", "))),
    })
}

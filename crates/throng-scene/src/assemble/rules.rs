//! The rules of a scene's game.

use super::intervene::{Intervening, Interventions};
use super::limits::{Limit, check, check_some};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::{FigureExpect, Scene, SceneNames};
use std::sync::Arc;
use throng::{Rules, World};

/// Returns the rules of the scene's game, if it has rules.
pub(super) fn make(scene: &Scene, cast: &SceneNames) -> Result<Option<Arc<dyn Rules>>, Problem> {
    let Some(name) = &scene.rules else { return Ok(None) };
    let made = scene.plugins.rules.make(name, cast).ok_or_else(|| unknown(scene, name))?;
    let made =
        made.map_err(|says| Problem::new(&Path::of("rules"), Kind::Panic, format!("a plug-in panicked: {says}")))?;
    made.map(Some).map_err(|error| unfit(scene, &error))
}

/// Gives the world its rules and interventions, and checks that the figures of `[expect]` exist.
pub(super) fn begin(
    scene: &Scene,
    game: Option<Arc<dyn Rules>>,
    interventions: &Interventions,
    world: &mut World,
) -> Result<(), Problem> {
    let rules = match (game, interventions.made().is_empty()) {
        (game, true) => game,
        (game, false) => Some(Arc::new(Intervening { game, interventions: interventions.clone() }) as Arc<dyn Rules>),
    };
    if let Some(rules) = rules {
        world.set_rules(rules).map_err(|error| unfit(scene, &error))?;
    }
    let at_start = interventions.act(world);
    at_start.map_err(|error| Problem::new(&Path::of("intervention"), Kind::World, error.to_string()))?;
    let path = Path::of("expect");
    let figures = scene.expect.figure.iter().enumerate();
    figures
        .map(|(i, said)| (path.key("figure").index(i), said))
        .try_for_each(|(path, said)| figure(scene, world, &path, said))
}

fn unknown(scene: &Scene, name: &str) -> Problem {
    let known: Vec<&str> = scene.plugins.rules.names().collect();
    let problem = Problem::new(&Path::of("rules"), Kind::UnknownKey, format!("there are no rules `{name}`"));
    problem.hint(format!("there are: {}; programs add theirs to Scene::plugins", known.join(", ")))
}

fn unfit(scene: &Scene, error: &throng::Error) -> Problem {
    let name = scene.rules.as_deref().unwrap_or_default();
    let message = format!("the rules `{name}` do not fit the scene: {error}");
    Problem::new(&Path::of("rules"), Kind::World, message)
}

/// Checks the expectation of a figure.
fn figure(scene: &Scene, world: &World, path: &Path, said: &FigureExpect) -> Result<(), Problem> {
    check_some(&path.key("at_least"), said.at_least, Limit::Finite)?;
    check_some(&path.key("at_most"), said.at_most, Limit::Finite)?;
    check(&path.key("after"), said.after, Limit::NotNegative)?;
    if world.figure(&said.of).is_some() {
        return Ok(());
    }
    let known: Vec<String> = world.figures().map(|(name, _)| name.to_owned()).collect();
    Err(no_figure(scene, &path.key("of"), &said.of, &known))
}

/// Returns the error for an unknown figure.
pub(super) fn no_figure(scene: &Scene, at: &Path, name: &str, known: &[String]) -> Problem {
    let problem = Problem::new(at, Kind::UnknownKey, format!("there is no figure `{name}`"));
    match (&scene.rules, known.is_empty()) {
        (None, _) => problem.hint("figures are kept by rules: say which, rules = \"NAME\""),
        (Some(rules), true) => problem.hint(format!("the rules `{rules}` keep none")),
        (Some(rules), false) => problem.hint(format!("the rules `{rules}` keep: {}", known.join(", "))),
    }
}

//! Checks what a scene file says to viewers: the lengths of its texts, and whether its sliders and presets fit the scene.

use super::about;
use super::document::Document;
use super::path::{Path, Problem};
use super::presets::{with_changes, with_number};
use crate::error::{Error, Kind};
use crate::scene::{AboutPreset, AboutSlider, LONGEST, Scene};

/// The maximum number of characters of a name and of a unit.
const LONGEST_NAME: usize = 40;
const LONGEST_UNIT: usize = 12;
/// The maximum number of sliders and of presets. Each is tried when the file is read.
const MOST: usize = 8;

impl Scene {
    /// Checks what the file of the scene says to viewers: the lengths of its texts, and that its sliders and presets fit
    /// it. [`Scene::load`] and the gallery check this. [`Scene::parse`] does not, so that an editor can remove what a
    /// slider names.
    ///
    /// # Errors
    /// A text is empty or too long, two names are equal, there are too many sliders or presets, the scene cannot have a
    /// number at the path of a slider, or a preset gives no scene. The error has file, line, column and a hint.
    pub fn check_about(&self) -> Result<(), Error> {
        let Some(document) = &self.origin.document else { return Ok(()) };
        check(self, document).map_err(|problem| self.explain(problem))
    }
}

fn check(scene: &Scene, document: &Document) -> Result<(), Problem> {
    let path = Path::of("about");
    scene.about.texts().try_for_each(|(key, text)| check_text(&path.key(key), text, LONGEST))?;
    let (sliders, presets) = (&scene.about.sliders, &scene.about.presets);
    check_names(&path.key("slider"), sliders.iter().map(|slider| slider.name.as_str()))?;
    check_names(&path.key("preset"), presets.iter().map(|preset| preset.name.as_str()))?;
    for (i, slider) in sliders.iter().enumerate() {
        check_slider(&path.key("slider").index(i), slider, document)?;
    }
    presets
        .iter()
        .enumerate()
        .try_for_each(|(i, preset)| check_preset(&path.key("preset").index(i).key("with"), preset, document))
}

/// Checks that a text has one line with something on it, and is not too long.
fn check_text(path: &Path, text: &str, longest: usize) -> Result<(), Problem> {
    let count = text.chars().count();
    let message = if text.trim().is_empty() {
        format!("{path} is empty")
    } else if count > longest {
        format!("{path} has {count} characters, but may have at most {longest}")
    } else if let Some(control) = text.chars().find(|c| c.is_control()) {
        format!("{path} has the control character {}", control.escape_debug())
    } else {
        return Ok(());
    };
    let hint = format!("write one line of 1 to {longest} characters, or leave the key out");
    Err(Problem::new(path, Kind::OutOfRange, message).hint(hint))
}

/// Checks the names of a list: each has its own.
fn check_names<'a>(list: &Path, names: impl Iterator<Item = &'a str>) -> Result<(), Problem> {
    let mut seen: Vec<&str> = Vec::new();
    for (i, name) in names.enumerate() {
        if i == MOST {
            let message = format!("there are more than {MOST} tables `[[{list}]]`");
            return Err(Problem::new(&list.index(i), Kind::Count, message).hint("keep those that show most"));
        }
        let path = list.index(i).key("name");
        check_text(&path, name, LONGEST_NAME)?;
        if let Some(first) = seen.iter().position(|known| *known == name) {
            let message = format!("entries {} and {} of `{list}` are both named `{name}`", first + 1, i + 1);
            return Err(Problem::new(&path, Kind::Conflict, message).hint("give each a name of its own"));
        }
        seen.push(name);
    }
    Ok(())
}

fn check_slider(at: &Path, slider: &AboutSlider, document: &Document) -> Result<(), Problem> {
    let AboutSlider { path, min, max, unit, .. } = slider;
    unit.as_ref().map_or(Ok(()), |unit| check_text(&at.key("unit"), unit, LONGEST_UNIT))?;
    let now = document.number(path).map_err(|error| problem(&at.key("path"), error))?;
    if now.is_none() && !about::is_known(path) {
        let problem = Problem::new(&at.key("path"), Kind::UnknownKey, format!("there is no number at `{path}`"));
        return Err(problem.hint("write the path of a number as for --set: group.walkers.body.radius"));
    }
    for (key, number) in [("min", min), ("max", max)] {
        if !number.is_finite() {
            let message = format!("{} is {number}, but must be a finite number", at.key(key));
            return Err(Problem::new(&at.key(key), Kind::OutOfRange, message));
        }
        check_change(&with_number(document, path, *number)).map_err(|error| problem(&at.key(key), error))?;
    }
    if min < max {
        return Ok(());
    }
    let message = format!("{} is {max}, but must be more than min, {min}", at.key("max"));
    Err(Problem::new(&at.key("max"), Kind::OutOfRange, message).hint("give the least value as `min`"))
}

fn check_preset(with: &Path, preset: &AboutPreset, document: &Document) -> Result<(), Problem> {
    if preset.with.is_empty() {
        let problem = Problem::new(with, Kind::MissingKey, format!("the preset `{}` changes nothing", preset.name));
        return Err(problem.hint("give it a path and a value: with = { \"body.radius\" = 0.3 }"));
    }
    with_changes(document, preset)
        .try_for_each(|(path, changed)| check_change(&changed).map_err(|error| problem(&with.name(path), error)))
}

/// Checks that a changed document is a scene.
fn check_change(document: &Document) -> Result<(), Error> {
    document.read::<Scene>()?.check_keys()
}

/// Returns the problem of a path or value with this error of the changed scene.
fn problem(at: &Path, error: Error) -> Problem {
    let problem = Problem::new(at, error.kind, error.message);
    Problem { hint: error.hint, ..problem }
}

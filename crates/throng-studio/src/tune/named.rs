//! The sliders that a scene names itself (`about.slider`), and its presets.

use super::about::About;
use super::section::{Parameter, ParameterKind, Section};
use crate::document::Edit;
use throng_scene::{AboutPreset, AboutSlider, Scene};
use toml_edit::Value;

/// Returns the section of the sliders that the scene names. A slider of a number that the text leaves out has the default
/// of the sections of the `groups`; without one, it is not shown.
pub fn named(scene: &Scene, text: &Edit, groups: &[Section]) -> Section {
    let sliders = scene.about.sliders.iter();
    let parameters = sliders.filter_map(|slider| parameter(scene, text, groups, slider)).collect();
    Section { name: "try".into(), about: "The sliders that the scene names.".into(), parameters, ..Section::default() }
}

fn parameter(scene: &Scene, text: &Edit, groups: &[Section], slider: &AboutSlider) -> Option<Parameter> {
    let AboutSlider { name, path, min, max, unit } = slider;
    let paths = edit_paths(scene, path);
    let default = || groups.iter().find_map(|group| group.number(paths.first()?));
    let given = scene.number(path).ok().flatten();
    let value = given.or_else(default)?;
    let whole = given.is_some() && paths.iter().all(|path| text.value(path).is_some_and(Value::is_integer));
    let about = About { text: path.clone(), unit: unit.clone(), low: Some(*min), high: Some(*max), ..About::default() };
    let kind = ParameterKind::Number { value, low: min.min(value), high: max.max(value), whole };
    Some(Parameter { path: path.clone(), name: name.clone(), about, given: given.is_some(), acts: true, kind })
}

/// Returns the paths in the text for a path as for `--set`: names of groups, obstacles and movers become positions, and a
/// key of all groups becomes a path for each.
pub fn edit_paths(scene: &Scene, path: &str) -> Vec<String> {
    let keys: Vec<&str> = path.split('.').map(str::trim).collect();
    let (list, names): (&str, Vec<&str>) = match keys[0] {
        "group" | "groups" => ("group", scene.groups.iter().map(|group| group.name.as_str()).collect()),
        "obstacle" | "obstacles" => ("obstacle", scene.obstacles.iter().map(|one| one.name.as_str()).collect()),
        "mover" | "movers" => ("mover", scene.movers.iter().map(|mover| mover.name.as_str()).collect()),
        key if throng_scene::schema()["properties"].get(key).is_some() => return vec![keys.join(".")],
        _ => return (0..scene.groups.len()).map(|k| format!("group.{k}.{}", keys.join("."))).collect(),
    };
    let [_, which, below @ ..] = &keys[..] else { return vec![keys.join(".")] };
    // sliders of groups name them by their positions
    let named = which.parse::<usize>().is_err().then(|| names.iter().position(|name| name == which)).flatten();
    let position = named.map_or_else(|| (*which).to_owned(), |position| position.to_string());
    let mut path = vec![list, position.as_str()];
    path.extend(below);
    vec![path.join(".")]
}

/// Makes the changes of a preset.
///
/// # Errors
/// A path does not fit the text.
pub fn apply_preset(edit: &mut Edit, scene: &Scene, preset: &AboutPreset) -> Result<(), String> {
    for (path, value) in &preset.with {
        let value = value.to_string().parse::<Value>().map_err(|error| format!("{path}: {error}"))?;
        for path in edit_paths(scene, path) {
            // a value replaces a table only after that is gone
            if edit.has(&path) && edit.value(&path).is_none() {
                edit.remove(&path)?;
            }
            edit.set(&path, value.clone())?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use crate::tune::Tunable;
    use throng_scene::{Plugins, gallery};

    #[test]
    fn the_sliders_of_a_scene_have_its_values() {
        let document = Document::gallery("columns").unwrap();
        let section = named(document.scene().unwrap(), &Edit::new(document.text()).unwrap(), &[]);
        let found: Vec<(&str, &ParameterKind)> =
            section.parameters.iter().map(|parameter| (parameter.name.as_str(), &parameter.kind)).collect();
        let people = ParameterKind::Number { value: 10.0, low: 2.0, high: 20.0, whole: true };
        assert_eq!(found[0], ("people in a column", &people));
        assert!(matches!(found[1], ("body radius", ParameterKind::Number { value: 0.2, whole: false, .. })));
    }

    #[test]
    fn paths_of_set_become_paths_of_the_text() {
        let scene = gallery::scene("box").unwrap();
        for (path, expected) in [
            ("time.step", "time.step"),
            ("body.radius", "group.0.body.radius"),
            ("group.walkers.count", "group.0.count"),
            ("groups.0.count", "group.0.count"),
            ("obstacle.lower.shape.rectangle.size.1", "obstacle.2.shape.rectangle.size.1"),
        ] {
            assert_eq!(edit_paths(&scene, path), [expected]);
        }
        let both = edit_paths(&gallery::scene("crossing").unwrap(), "speed.preferred");
        assert_eq!(both, ["group.0.speed.preferred", "group.1.speed.preferred"]);
    }

    /// Sliders are shown in each scene, and presets give the scenes that the program makes of them.
    #[test]
    fn every_preset_of_the_gallery_gives_the_scene_of_the_program() {
        for name in gallery::names() {
            let document = Document::gallery(name).unwrap();
            let scene = document.scene().unwrap();
            let groups = Tunable::new(&Plugins::new()).groups(&document);
            let section = named(scene, &Edit::new(document.text()).unwrap(), &groups);
            assert_eq!(section.parameters.len(), scene.about.sliders.len(), "{name}: {:?}", section.parameters);
            for preset in &scene.about.presets {
                let made = document.preview(|edit| apply_preset(edit, scene, preset));
                let made = made.unwrap_or_else(|error| panic!("{name}: {}: {error}", preset.name));
                assert_eq!(*made, scene.with_preset(&preset.name).unwrap(), "{name}: {}", preset.name);
            }
        }
    }
}

//! The parameters of the look of pictures and films: the `[view]` of the scene, and the colours and shapes of groups.

use super::Tunable;
use super::section::{self, Parameter, ParameterKind, Section};
use crate::document::{Document, Edit};
use serde_json::{Value, json};
use throng_draw::{Color, Style};
use throng_scene::Scene;

/// Keys of `[view]` with tools of their own, and keys of single pictures.
const NOT_TUNED: [&str; 7] = ["min", "max", "camera", "lines", "moment", "size", "fps"];
/// Sliders of which neither the limits nor the value say the range: the least and the greatest value, and the first one.
const SLIDERS: [(&str, f64, f64, f64); 3] =
    [("azimuth", -180.0, 180.0, -160.0), ("height", 3.0, 90.0, 41.0), ("haze", 5.0, 500.0, 100.0)];
/// The projection of a scene that gives none.
const AUTOMATIC: &str = "automatic";
/// Keys of groups about their look.
const OF_GROUPS: [&str; 2] = ["colour", "mark"];

impl Tunable {
    /// Returns a section for the light, one for the colours and drawings, and one for each group. Returns none if the text
    /// is invalid.
    pub fn look(&self, document: &Document) -> Vec<Section> {
        let (Ok(scene), Ok(text)) = (document.scene(), Edit::new(document.text())) else { return Vec::new() };
        let style = Style::said(scene);
        let mut said = serde_json::to_value(&scene.view).unwrap_or_default();
        // elements of lists have names of their own
        said.as_object_mut().into_iter().for_each(|said| said.retain(|key, _| !NOT_TUNED.contains(&key.as_str())));
        complete(&mut said, "projection", json!("plan"));
        complete(&mut said, "sun", json!({}));
        let switches = [("goals", style.goals), ("people", style.people), ("field", false), ("annotate", false)];
        for (key, value) in switches {
            complete(&mut said, key, json!(value));
        }
        complete(&mut said, "trails", json!(style.trails));
        let mut view = section::of(&self.schema, &self.schema["$defs"]["View"], &said, "view", "pictures and films");
        view.leave_out(&NOT_TUNED);
        let theme = &style.theme;
        for (key, color) in [("background", theme.outside), ("ground", theme.ground), ("obstacles", theme.obstacle)] {
            view.parameters.iter_mut().for_each(|parameter| fill(parameter, key, color));
        }
        view.given(&|path| text.has(path));
        range(&mut view);
        for parameter in
            view.parameters.iter_mut().filter(|parameter| parameter.name == "projection" && !parameter.given)
        {
            if let ParameterKind::Choice { value, .. } = &mut parameter.kind {
                *value = AUTOMATIC.into();
            }
        }
        std::iter::once(view).chain(self.looks_of_groups(scene, &text, &style)).collect()
    }

    fn looks_of_groups(&self, scene: &Scene, text: &Edit, style: &Style) -> Vec<Section> {
        let of = |(k, group): (usize, &throng_scene::Group)| {
            let mut said = serde_json::to_value(scene.table_of(group)).unwrap_or_default();
            said.as_object_mut().into_iter().for_each(|keys| keys.retain(|key, _| OF_GROUPS.contains(&key.as_str())));
            complete(&mut said, "mark", json!("body"));
            let name = if group.name.is_empty() { format!("group {}", k + 1) } else { group.name.clone() };
            let mut section =
                section::of(&self.schema, &self.schema["$defs"]["Group"], &said, &format!("group.{k}"), &name);
            section.parameters.retain(|parameter| OF_GROUPS.contains(&parameter.name.as_str()));
            section.sections.clear();
            section.parameters.iter_mut().for_each(|parameter| fill(parameter, "colour", style.theme.group(k)));
            section.given(&|path| text.has(path));
            section
        };
        scene.groups.iter().enumerate().map(of).collect()
    }
}

/// Adds a value that the scene leaves out.
fn complete(said: &mut Value, key: &str, value: Value) {
    said.as_object_mut().into_iter().for_each(|said| _ = said.entry(key).or_insert(value.clone()));
}

/// Gives sliders their ranges.
fn range(section: &mut Section) {
    section.sections.iter_mut().for_each(range);
    for parameter in &mut section.parameters {
        let Some((_, least, greatest, usual)) = SLIDERS.iter().find(|(name, ..)| *name == parameter.name) else {
            continue;
        };
        match &mut parameter.kind {
            ParameterKind::Number { value, low, high, .. } => (*low, *high) = (least.min(*value), greatest.max(*value)),
            ParameterKind::Unset { first, .. } => *first = *usual,
            _ => {}
        }
    }
}

/// Gives a colour that the scene leaves out.
fn fill(parameter: &mut Parameter, key: &str, color: Color) {
    if let ParameterKind::Colour { value } = &mut parameter.kind
        && parameter.name == key
    {
        value.get_or_insert([color.r, color.g, color.b]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng_scene::{Plugins, gallery};

    fn all(sections: &[Section]) -> Vec<&Parameter> {
        sections.iter().flat_map(|section| section.parameters.iter().chain(all(&section.sections))).collect()
    }

    #[test]
    fn every_scene_has_its_look_and_keys_have_lines() {
        let tunable = Tunable::new(&Plugins::new());
        for name in gallery::names() {
            let sections = tunable.look(&Document::gallery(name).unwrap());
            let found = all(&sections);
            let paths = [
                "background",
                "ground",
                "obstacles",
                "trails",
                "goals",
                "people",
                "sun.azimuth",
                "sun.height",
                "haze",
                "projection",
            ];
            for path in paths
                .map(|key| format!("view.{key}"))
                .into_iter()
                .chain(["group.0.colour".into(), "group.0.mark".into()])
            {
                assert!(found.iter().any(|parameter| parameter.path == path), "{name}: {path}: {found:#?}");
            }
            assert!(found.iter().all(|parameter| !parameter.about.text.is_empty()), "{name}");
            assert!(found.iter().all(|parameter| !parameter.path.starts_with("view.size")), "{name}");
        }
    }
}

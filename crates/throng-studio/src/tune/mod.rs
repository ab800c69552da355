//! Tunable parameters of the groups: the numbers, switches and choices of the schema of scene files.
//!
//! The schema provides keys, types, limits and doc lines. The scene provides the values. Every key of a group in the
//! schema is tunable, without a separate list.

mod about;
mod idle;
mod look;
mod named;
mod schema;
mod section;

pub use about::About;
pub use named::{apply_preset, edit_paths};
pub use section::{Parameter, ParameterKind, Section};

use crate::document::{Document, Edit};
use serde_json::Value;
use throng_scene::Plugins;

/// Keys of a group that are not tuned: keys that define where and when agents start and where they go, and keys of
/// drawing.
const NOT_TUNED: [&str; 13] = [
    "name",
    "count",
    "place",
    "goal",
    "source",
    "wait",
    "altitude",
    "heading",
    "start_speed",
    "layers",
    "avoids",
    "colour",
    "mark",
];

/// The schema of scene files.
#[derive(Clone, Debug)]
pub struct Tunable {
    schema: Value,
}

impl Tunable {
    /// Reads the schema with these plug-ins.
    pub fn new(plugins: &Plugins) -> Self {
        Self { schema: plugins.schema() }
    }

    /// Returns the section of the sliders that the scene names, if it names any, and then a section for each group. Returns
    /// none if the text is invalid.
    pub fn sections(&self, document: &Document) -> Vec<Section> {
        let (Ok(scene), Ok(text)) = (document.scene(), Edit::new(document.text())) else { return Vec::new() };
        let groups = self.groups(document);
        let named = Some(named::named(scene, &text, &groups)).filter(|section| !section.is_empty());
        named.into_iter().chain(groups).collect()
    }

    /// Returns a section for each group of the scene. Returns none if the text is invalid.
    pub fn groups(&self, document: &Document) -> Vec<Section> {
        let (Ok(scene), Ok(text)) = (document.scene(), Edit::new(document.text())) else { return Vec::new() };
        let of = |(k, group): (usize, &throng_scene::Group)| {
            let mut said = serde_json::to_value(scene.table_of(group)).unwrap_or_default();
            let idle = idle::complete(&mut said, group);
            let name = if group.name.is_empty() { format!("group {}", k + 1) } else { group.name.clone() };
            let mut section =
                section::of(&self.schema, &self.schema["$defs"]["Group"], &said, &format!("group.{k}"), &name);
            section.leave_out(&NOT_TUNED);
            section.leave_out(&group.moved_by().keys_of_others().collect::<Vec<_>>());
            section.given(&|path| text.has(path));
            section.without_effect(&idle);
            section
        };
        scene.groups.iter().enumerate().map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng_scene::{Models, gallery};

    fn all<'a>(section: &'a Section, found: &mut Vec<&'a Parameter>) {
        found.extend(&section.parameters);
        section.sections.iter().for_each(|inner| all(inner, found));
    }

    fn parameters(sections: &[Section]) -> Vec<&Parameter> {
        let mut found = Vec::new();
        sections.iter().for_each(|section| all(section, &mut found));
        found
    }

    #[test]
    fn a_ring_of_people_has_its_parameters() {
        let document = Document::gallery("circle").unwrap();
        let sections = Tunable::new(&Plugins::new()).groups(&document);
        let found = parameters(&sections);
        let of =
            |path: &str| *found.iter().find(|parameter| parameter.path == path).unwrap_or_else(|| panic!("{path}"));
        let horizon = of("group.0.avoid.orca.time_horizon");
        assert_eq!(horizon.about.unit.as_deref(), Some("s"));
        assert!(matches!(horizon.kind, ParameterKind::Number { value: 2.0, whole: false, .. }), "{horizon:?}");

        assert!(matches!(of("group.0.avoid.orca.neighbours").kind, ParameterKind::Number { whole: true, .. }));
        assert!(matches!(of("group.0.guard").kind, ParameterKind::Switch { .. }));
        assert!(found.iter().all(|parameter| !parameter.path.contains("place") && !parameter.path.contains("goal")));
        let ParameterKind::Choice { value, options } = &of("group.0.avoid").kind else { panic!("a choice of models") };
        let names: Vec<&str> = options.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(value, "orca");
        assert_eq!(names, Models::default().names().collect::<Vec<_>>());
        assert!(options.iter().all(|(_, about)| about.len() > 10), "{options:?}");
    }

    /// A slider for a key of another motor could only give an error.
    #[test]
    fn only_the_limits_of_the_motor_are_tuned() {
        for (scene, has, has_not) in [("wander", "vehicle", "speed"), ("circle", "speed", "vehicle")] {
            let sections = Tunable::new(&Plugins::new()).groups(&Document::gallery(scene).unwrap());
            let names: Vec<&str> = sections[0].sections.iter().map(|section| section.name.as_str()).collect();
            assert!(names.contains(&has) && !names.contains(&has_not), "{scene}: {names:?}");
        }
    }

    /// A key that the file leaves out has its default, pale, and can be set.
    #[test]
    fn defaults_are_shown_and_can_be_set() {
        let tunable = Tunable::new(&Plugins::new());
        let mut document = Document::gallery("boids").unwrap();
        let sections = tunable.groups(&document);
        let value = |path: &str| {
            let found = parameters(&sections).into_iter().find(|parameter| parameter.path == path).cloned();
            let found = found.unwrap_or_else(|| panic!("{path}"));
            let ParameterKind::Number { value, .. } = found.kind else { panic!("{found:?}") };
            (found.given, found.name, value)
        };
        assert_eq!(value("group.0.steer.boids.strengths.matching"), (false, "matching".into(), 0.8));
        let unset = |path: &str| parameters(&sections).into_iter().find(|of| of.path == path).map(|of| of.kind.clone());
        let turns = ParameterKind::Unset { says: "no limit".into(), first: 180.0, whole: false };
        assert_eq!(unset("group.0.vehicle.turn_rate"), Some(turns));
        assert_eq!(value("group.0.vehicle.mass"), (false, "mass".into(), 1.0));
        assert_eq!(value("group.0.steer.boids.migration.2"), (true, "migration z".into(), 20.0));
        document.set("group.0.steer.boids.strengths.matching", 0.3).unwrap();
        assert!(document.text().contains("strengths.matching = 0.3"), "{}", document.text());
    }

    #[test]
    fn speeds_have_units() {
        let tunable = Tunable::new(&Plugins::new());
        for name in ["circle", "boids", "vehicle"] {
            let sections = tunable.groups(&Document::gallery(name).unwrap());
            for path in ["speed.preferred", "speed.max", "vehicle.max_speed"] {
                for parameter in parameters(&sections).into_iter().filter(|of| of.path.ends_with(path)) {
                    assert_eq!(parameter.about.unit.as_deref(), Some("m/s"), "{name}: {parameter:?}");
                }
            }
        }
    }

    /// Every default of the gallery can be written into its file, and the scene can still be built.
    #[test]
    fn every_default_of_the_gallery_can_be_set() {
        let tunable = Tunable::new(&Plugins::new());
        for name in ["boids", "circle", "pedestrians", "vehicle", "robots", "boids-in-box", "wander", "crossing"] {
            let document = Document::gallery(name).unwrap();
            for parameter in parameters(&tunable.groups(&document)) {
                let ParameterKind::Number { value, whole, .. } = parameter.kind else { continue };
                let set = |edit: &mut Edit| match whole {
                    true => edit.set(&parameter.path, value as i64),
                    false => edit.set(&parameter.path, value),
                };
                assert!(document.tried(set).is_ok(), "{name}: {parameter:?}: {:?}", document.tried(set).err());
            }
        }
    }

    #[test]
    fn keys_without_effect_are_hidden_or_marked() {
        let tunable = Tunable::new(&Plugins::new());
        let has = |document: &Document, key: &str| {
            let sections = tunable.groups(document);
            parameters(&sections).into_iter().find(|parameter| parameter.name == key).map(|found| found.acts)
        };
        let mut document = Document::gallery("circle").unwrap();
        assert_eq!((has(&document, "time_gap"), has(&document, "keep_right")), (None, Some(true)));
        document.set("group.0.time_gap", 1.0).unwrap();
        assert_eq!(has(&document, "time_gap"), Some(false));
        let side = |name: &str| {
            let sections = tunable.groups(&Document::gallery(name).unwrap());
            let found = parameters(&sections).into_iter().find(|parameter| parameter.name == "keep_right").cloned();
            found.map(|found| found.kind)
        };
        assert!(matches!(side("circle"), Some(ParameterKind::Number { value: 8.0, .. })));
        assert!(
            matches!(side("bottleneck"), Some(ParameterKind::Number { value: 20.0, .. })),
            "{:?}",
            side("bottleneck")
        );
        assert_eq!(has(&Document::gallery("bottleneck").unwrap(), "time_gap"), Some(true));
        assert_eq!(has(&Document::gallery("boids").unwrap(), "personal_space"), None);
    }

    /// Folds of combined behaviours are named by what they do.
    #[test]
    fn folds_have_names() {
        fn names(section: &Section, found: &mut Vec<String>) {
            found.push(section.name.clone());
            section.sections.iter().for_each(|inner| names(inner, found));
        }
        let tunable = Tunable::new(&Plugins::new());
        for scene in gallery::names() {
            let mut found = Vec::new();
            let sections = tunable.groups(&Document::gallery(scene).unwrap());
            sections.iter().for_each(|section| names(section, &mut found));
            let bad = |name: &&String| name.starts_with("of ") || *name == "of" || name.starts_with("migration");
            assert_eq!(found.iter().find(bad), None, "{scene}: {found:?}");
            if scene == "boids-in-box" {
                for name in ["avoid_obstacles", "flocking", "limited", "tether"] {
                    assert!(found.iter().any(|found| found == name), "{name}: {found:?}");
                }
            }
        }
    }

    /// Sets every number of every scene to its own value, and checks that the scene stays equal.
    #[test]
    fn every_parameter_of_the_gallery_can_be_set() {
        let tunable = Tunable::new(&Plugins::new());
        for name in gallery::names() {
            let mut document = Document::gallery(name).unwrap();
            let scene = document.scene().unwrap().clone();
            let sections = tunable.groups(&document);
            let found = parameters(&sections);
            assert!(found.len() >= 5 * scene.groups.len(), "{name}: {}", found.len());
            for parameter in found {
                assert!(!parameter.about.text.is_empty(), "{name}: {}", parameter.path);
                let ParameterKind::Number { value, low, high, whole } = parameter.kind else { continue };
                assert!(low < high && value.is_finite(), "{name}: {parameter:?}");
                if parameter.given {
                    let set = if whole {
                        document.set(&parameter.path, value as i64)
                    } else {
                        document.set(&parameter.path, value)
                    };
                    assert_eq!(set, Ok(()), "{name}: {}", parameter.path);
                }
            }
            assert_eq!(document.scene().unwrap(), &scene, "{name}");
        }
    }
}

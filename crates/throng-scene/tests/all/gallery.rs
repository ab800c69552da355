//! Every scene of the gallery is a complete example: it parses, builds, has expectations, and survives a round trip.

use throng_scene::{Expect, Scene, gallery, schema};

#[test]
fn every_scene_builds_and_expects_something() {
    for name in gallery::names() {
        let scene = gallery::scene(name).unwrap_or_else(|error| panic!("{error}"));
        let (_, built) = scene.build().unwrap_or_else(|error| panic!("{error}"));
        assert!(built.agents > 0, "{name}");
        let steers = scene.groups.iter().any(|group| group.steer.is_some());
        assert_ne!(scene.expect, Expect::default(), "{name}");
        assert!(steers || scene.expect.arrived.is_some() && scene.expect.within.is_some(), "{name}");
        assert!(scene.expect.within <= Some(scene.time.limit), "{name}");
        assert_eq!(gallery::title(name), Some(scene.title.as_str()));
    }
}

#[test]
fn every_scene_survives_a_round_trip() {
    for name in gallery::names() {
        let scene = gallery::scene(name).unwrap();
        let text = scene.to_toml().unwrap();
        let again: Scene = text.parse().unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
        assert_eq!(scene, again, "{name}");
    }
}

#[test]
fn every_scene_fits_the_schema() {
    let validator = jsonschema::validator_for(&schema()).unwrap();
    let check = |name: &str, text: &str| {
        let value: serde_json::Value = toml::from_str(text).unwrap();
        let errors: Vec<String> =
            validator.iter_errors(&value).map(|e| format!("{} at {}", e, e.instance_path())).collect();
        assert!(errors.is_empty(), "{name}: {errors:?}");
    };
    for name in gallery::names() {
        check(name, gallery::text(name).unwrap());
        check(name, &gallery::scene(name).unwrap().to_toml().unwrap());
    }
    let wrong: serde_json::Value = toml::from_str("[[group]]\nplace.rnig = { radius = 7 }").unwrap();
    assert!(!validator.is_valid(&wrong));
}

#[test]
fn the_folder_and_the_registry_agree() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
    let mut files: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .filter_map(|entry| entry.unwrap().file_name().to_str()?.strip_suffix(".toml").map(str::to_owned))
        .collect();
    files.sort();
    let mut names: Vec<&str> = gallery::names().collect();
    names.sort_unstable();
    assert_eq!(files, names);
}

#[test]
fn every_scene_is_in_one_group() {
    let grouped: Vec<&str> = gallery::groups().flat_map(|(_, names)| names).collect();
    assert_eq!(grouped, gallery::names().collect::<Vec<_>>());
    let steering = gallery::groups().find(|(group, _)| *group == "steering").unwrap().1;
    for name in steering {
        let scene = gallery::scene(name).unwrap();
        assert!(scene.groups.iter().any(|group| group.steer.is_some()), "{name}");
    }
}

#[test]
fn the_labs_scenes_have_the_labs_numbers() {
    for (name, agents) in [("columns", 20), ("circle", 36), ("box", 36), ("pillars", 36)] {
        let plan = gallery::scene(name).unwrap().plan().unwrap();
        assert_eq!(plan.agents.len(), agents, "{name}");
        assert_eq!(plan.settings.step, 0.04);
        for planned in &plan.agents {
            assert_eq!(planned.agent.radius, 0.2);
            assert_eq!((planned.agent.preferred_speed, planned.agent.motor.max_speed()), (1.5, 1.5));
        }
        for goal in &plan.goals {
            assert!(matches!(goal, throng::Goal::Point { tolerance, .. } if *tolerance == 0.1), "{name}: {goal:?}");
        }
    }
}

#[test]
fn an_unknown_scene_is_named_with_the_nearest() {
    let message = gallery::scene("circel").unwrap_err().to_string();
    assert!(
        message
            .starts_with("there is no scene `circel`\n  hint: did you mean `circle`? the gallery has: columns, circle"),
        "{message}"
    );
}

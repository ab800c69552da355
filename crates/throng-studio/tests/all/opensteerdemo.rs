//! Checks the keys and scenes on the page about OpenSteerDemo.

use throng_scene::gallery;
use throng_studio::direct::Tool;
use throng_studio::keys::KEYS;

const PAGE: &str = include_str!("../../../../docs/opensteerdemo.md");

/// Returns the cells of all columns with this name, of all tables.
fn column(name: &str) -> Vec<&'static str> {
    let mut position = None;
    let mut found = Vec::new();
    for line in PAGE.lines() {
        let Some(row) = line.strip_prefix('|').and_then(|row| row.strip_suffix('|')) else {
            position = None;
            continue;
        };
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        match position {
            None => position = Some(cells.iter().position(|cell| *cell == name)),
            Some(Some(at)) if !cells[at].starts_with("---") => found.push(cells[at]),
            Some(_) => {}
        }
    }
    found
}

#[test]
fn its_keys_are_the_studios() {
    let known: Vec<&str> =
        KEYS.iter().map(|(_, _, _, key, _)| *key).chain(Tool::all().map(|tool| tool.says().1)).collect();
    let cells = column("key here");
    assert!(cells.len() > 20, "{cells:?}");
    for key in cells.iter().flat_map(|cell| cell.split(", ")).filter(|key| *key != "–") {
        assert!(known.contains(&key), "there is no key {key}");
    }
}

#[test]
fn its_scenes_are_the_gallerys() {
    let cells = column("scene");
    let scenes: Vec<&str> = cells.iter().flat_map(|cell| cell.split('`').skip(1).step_by(2)).collect();
    assert_eq!(scenes.len(), 17, "nine plug-ins, one of them with nine scenes: {scenes:?}");
    for scene in scenes {
        assert!(gallery::text(scene).is_some(), "there is no scene {scene}");
    }
}

/// Groups that a key can add an agent to state their count.
#[test]
fn groups_that_can_have_more_say_how_many() {
    for name in ["pedestrians", "boids-open", "boids-in-box"] {
        assert!(gallery::scene(name).unwrap().groups[0].count.is_some(), "{name}");
    }
}

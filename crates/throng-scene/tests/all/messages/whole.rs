//! Conflicts between values, and missing files.

use super::{group, message};
use throng_scene::{Kind, Scene};

#[test]
fn a_missing_floor_plan_is_named_at_its_line() {
    let (kind, text) = message(&("walkable.file = \"nowhere.wkt\"\n".to_owned() + &group("place.point = [0, 0]")));
    assert_eq!(kind, Kind::File);
    assert!(
        text.starts_with("a.toml:1:17: there is no file nowhere.wkt\n  1 | walkable.file = \"nowhere.wkt\"\n"),
        "{text}"
    );
}

#[test]
fn a_missing_scene_file_gets_the_nearest_name() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("circle.toml"), "").unwrap();
    let error = Scene::load(folder.path().join("cirle.toml")).unwrap_err();
    assert_eq!(error.kind, Kind::File);
    assert!(error.hint.as_deref().is_some_and(|hint| hint.contains("circle.toml?")), "{error}");
}

#[test]
fn things_that_do_not_go_together_are_named() {
    let (kind, text) = message(&group("count = 5\nplace.points = [[0, 0]]"));
    assert_eq!(
        (kind, text.lines().next()),
        (Kind::Conflict, Some("a.toml:5:9: group `walkers`: count is 5, but its place has 1 spots"))
    );
    let (kind, _) = message(&group("place.point = [0, 0]\nsource = { rate = 1, interval = 1, end = 5 }"));
    assert_eq!(kind, Kind::Conflict);
    let (kind, _) = message(&group("place = { point = [0, 0], points = [] }"));
    assert_eq!(kind, Kind::Conflict);
    let twice = group("place.point = [0, 0]") + "[[group]]\nname = \"walkers\"\nplace.point = [3, 0]\n";
    let (kind, text) = message(&twice);
    assert_eq!(
        (kind, text.lines().next()),
        (Kind::Conflict, Some("a.toml:7:8: groups 1 and 2 are both named `walkers`"))
    );
}

#[test]
fn scenes_made_in_code_get_messages_without_places() {
    let error = Scene::default().build().unwrap_err();
    assert_eq!(error.at, None);
    assert!(error.to_string().starts_with("the scene has no agents"));
}

#[test]
fn what_is_wrong_with_a_mover_is_said_where_it_is() {
    let scene = |mover: &str| {
        format!("[[group]]\nplace.point = [9, 9]\n\n[[mover]]\nbody.rectangle = {{ length = 1, width = 0.1 }}\n{mover}")
    };
    for (mover, line, part) in [
        ("script = []", 6, "at least 1"),
        ("script = [{ time = 0, at = [0, 0] }]\nrepeat = true", 6, "at least 2"),
        ("script = [{ time = 1, at = [0, 0] }, { time = 1, at = [1, 0] }]", 6, "the entry before is at 1"),
        ("script = [{ time = 0, at = [0, 0] }]\nmax_speed = 0", 7, "more than 0"),
        ("script = [{ time = 0, at = [9, 9] }]", 4, "overlap at the start"),
    ] {
        let scene: Scene = scene(mover).parse().unwrap();
        let error = scene.build().unwrap_err();
        let text = error.to_string();
        assert!(text.contains(part) && text.contains(&format!(":{line}:")), "{mover}: {text}");
    }
}

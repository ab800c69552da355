//! The levels of a mesh: listed with heights and areas, and chosen by their numbers.

use throng_scene::import::plan::{PlanOptions, from_text, ground, load};
use throng_scene::{Kind, Scene};

/// Adds a rectangle at a height, y up; `corner` is its corner with the least coordinates.
fn floor(text: &mut String, corner: [f64; 2], size: [f64; 2], height: f64) {
    let [x, y] = corner;
    for [right, up] in [[0.0, 0.0], [size[0], 0.0], size, [0.0, size[1]]] {
        *text += &format!("v {} {height} {}\n", x + right, -(y + up));
    }
    *text += "f -4 -3 -2 -1\n";
}

/// Returns three storeys, the highest first in the file, and a table on the lowest.
fn building() -> String {
    let mut text = String::new();
    floor(&mut text, [0.0, 0.0], [5.0, 5.0], 6.0);
    floor(&mut text, [0.0, 0.0], [20.0, 10.0], 0.0);
    floor(&mut text, [0.0, 0.0], [10.0, 10.0], 3.0);
    floor(&mut text, [15.0, 5.0], [1.0, 1.0], 0.8);
    text
}

fn asked(level: Option<u64>) -> PlanOptions {
    PlanOptions { exit: Some([1.0, 1.0, 2.0, 2.0]), people: Some(3), level, ..PlanOptions::default() }
}

#[test]
fn levels_are_listed_and_chosen_by_their_numbers() {
    let size = |level| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        std::fs::write(&path, building()).unwrap();
        let ground = ground(path, &asked(level)).unwrap();
        let area = |ring: &Vec<glam::DVec2>| {
            let next = ring.iter().cycle().skip(1);
            (ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() * 0.5).abs()
        };
        ground.areas.iter().map(|one| area(&one.outer) - one.holes.iter().map(area).sum::<f64>()).sum::<f64>()
    };
    let is = |level, expected: f64| assert!((size(level) - expected).abs() < 1e-4, "{level:?}: {}", size(level));
    // the table is cut out of the lowest level
    is(None, 199.0);
    is(Some(1), 199.0);
    is(Some(2), 100.0);
    is(Some(3), 25.0);
    let notes = from_text("a.obj", &building(), &asked(None)).unwrap().notes.join("\n");
    let list = "levels 1 (at 0.0 m, 200.0 m²), 2 (at 3.0 m, 100.0 m²), 3 (at 6.0 m, 25.0 m²)";
    assert!(notes.contains(&format!("{list}: level 1, the largest, is taken; --level N")), "{notes}");
    let notes = from_text("a.obj", &building(), &asked(Some(2))).unwrap().notes.join("\n");
    assert!(notes.contains(&format!("{list}: level 2 is taken")), "{notes}");
}

#[test]
fn a_missing_level_is_an_error() {
    for level in [0, 4, u64::MAX] {
        let error = from_text("a.obj", &building(), &asked(Some(level))).unwrap_err();
        assert_eq!((error.kind, error.message), (Kind::OutOfRange, format!("this mesh has no level {level}")));
        assert!(error.hint.is_some_and(|hint| hint.starts_with("it has levels 1 (at 0.0 m, 200.0 m²), 2")));
    }
    let error = from_text("a.wkt", "POLYGON ((0 0, 9 0, 9 9, 0 0))", &asked(Some(1))).unwrap_err();
    assert!(error.message.contains("this plan has no levels to choose from"), "{error}");
}

#[test]
fn a_scene_says_which_level_it_is_on() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.obj"), building()).unwrap();
    let path = folder.path().join("a.toml");
    let people = "[[group]]\ncount = 5\nplace.walkable = {}\n";
    std::fs::write(&path, format!("walkable.file = {{ name = \"a.obj\", level = 3 }}\n{people}")).unwrap();
    let scene = Scene::load(&path).unwrap();
    assert!(scene.plan().unwrap().walkable[0].outer.iter().all(|p| p.max_element() < 5.001));
    assert_eq!(scene.to_toml().unwrap().parse::<Scene>().unwrap(), scene);
    // the same as with the option
    let asked = load(folder.path().join("a.obj"), &asked(Some(3))).unwrap().scene;
    assert_eq!(asked.plan().unwrap().walkable[0].outer.len(), 4);
}

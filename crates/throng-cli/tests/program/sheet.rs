//! `throng sheet`: stills of many scenes in one picture.

use crate::shared::{WALK, call, folder, names, stderr};
use std::path::Path;

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

/// Returns the value of `key` in each line that starts with `tag`.
fn values<'a>(svg: &'a str, tag: &str, key: &str) -> Vec<&'a str> {
    let key = format!(" {key}=\"");
    let lines = svg.lines().filter(|line| line.starts_with(tag));
    lines.map(|line| line.split_once(&key).unwrap().1.split('"').next().unwrap()).collect()
}

#[test]
fn three_scenes_have_three_panels_of_one_size_with_their_names() {
    let folder = folder();
    std::fs::write(folder.path().join("walk.toml"), WALK).unwrap();
    call(folder.path(), "sheet circle walk.toml sphere --at 2 --width 900 -o a.svg").success();
    assert_eq!(names(folder.path()), ["a.svg", "walk.toml"]);
    let svg = read(folder.path(), "a.svg");
    let panels = "<svg x=";
    assert_eq!(values(&svg, panels, "width"), ["277"; 3], "three side by side");
    assert_eq!(values(&svg, panels, "height"), ["207"; 3], "aspect ratio 4:3");
    assert!(values(&svg, panels, "y").iter().all(|y| *y == values(&svg, panels, "y")[0]));
    let texts: Vec<&str> = svg.lines().filter(|line| line.starts_with("<text")).collect();
    assert_eq!(texts.len(), 6, "one name and one time per panel, and no other text: {texts:?}");
    for name in ["circle", "walk", "sphere"] {
        assert!(texts.iter().any(|text| text.contains(&format!(">{name}</text>"))), "{name}: {texts:?}");
    }
    assert_eq!(texts.iter().filter(|text| text.contains(">2 s</text>")).count(), 3, "{texts:?}");
}

#[test]
fn a_group_shows_all_its_scenes_under_its_name() {
    let folder = folder();
    call(folder.path(), "sheet air bodies --columns 2 --width 400 --at 1 -o a.svg").success();
    let svg = read(folder.path(), "a.svg");
    assert_eq!(svg.matches("<svg x=").count(), 6);
    for name in ["air", "sphere", "drones", "street", "bodies", "mixed-sizes", "vehicle", "sliding-door"] {
        assert!(svg.contains(&format!(">{name}</text>")), "{name}");
    }
}

#[test]
fn the_scene_defines_the_moment_of_its_panel() {
    let folder = folder();
    let moments = [("key", "view.moment = 3.0"), ("third", "expect.within = 6.0"), ("end", "time.limit = 1.0")];
    for (name, line) in moments {
        std::fs::write(folder.path().join(format!("{name}.toml")), format!("{line}\n{WALK}")).unwrap();
    }
    call(folder.path(), "sheet key.toml third.toml -o a.svg").success();
    let svg = read(folder.path(), "a.svg");
    assert!(svg.contains(">3 s</text>") && svg.contains(">2 s</text>"), "{svg}");
    call(folder.path(), "sheet end.toml --at 5 -o b.svg").success();
    assert!(read(folder.path(), "b.svg").contains(">1 s</text>"), "no run continues after its end");
}

#[test]
fn sheets_are_the_same_for_any_number_of_threads() {
    let folder = folder();
    for threads in [1, 3] {
        let options = format!("--threads {threads} --at 3 --width 600 -q");
        for ending in ["png", "svg"] {
            call(folder.path(), &format!("sheet doorway flocking circle {options} -o {threads}.{ending}")).success();
        }
    }
    for ending in ["png", "svg"] {
        let bytes = |threads: usize| std::fs::read(folder.path().join(format!("{threads}.{ending}"))).unwrap();
        assert!(bytes(1) == bytes(3), "{ending}");
    }
}

#[test]
fn errors_appear_before_anything_runs() {
    let folder = folder();
    let message = |arguments: &str| stderr(&call(folder.path(), arguments).code(2));
    let unknown = message("sheet circle wals");
    assert!(unknown.contains("there is no scene `wals`") && unknown.contains("groups: labs, meetings"), "{unknown}");
    assert!(unknown.contains("columns, circle, box"), "{unknown}");
    assert!(message("sheet -o a.mp4").contains("end the name in .png or .svg"));
    assert!(message("sheet -o nowhere/a.png").contains("nowhere"));
    assert!(message("sheet labs --columns 5 --width 60").contains("pixels, but must be"));
    assert!(names(folder.path()).is_empty());
}

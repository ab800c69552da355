//! Tests of edits, their layout, and refused edits.

use super::*;
use crate::document::number;
use throng_scene::gallery;

const SCENE: &str = "\
# Two of them.
title = \"Two\"   # so called

[[group]]       # the first
name = \"a\"
place.points = [[0, 0], [2, 0.50]]   # metres
body = { radius = 0.2 }

[expect]
within = 9.0 # s
";

fn document() -> Document {
    Document::new("two", SCENE)
}

#[test]
fn comments_and_layout_stay() {
    let mut document = document();
    document.set("group.0.place.points.1", Array::from_iter([2.0, 0.75])).unwrap();
    assert_eq!(document.text(), SCENE.replace("0.50", "0.75"), "the 2 is written as it was");
    document.set("expect.within", 12.5).unwrap();
    assert_eq!(document.text(), SCENE.replace("0.50", "0.75").replace("9.0", "12.5"));
    assert!(document.undo() && document.undo() && !document.undo());
    assert_eq!(document.text(), SCENE, "a change is a step");
}

#[test]
fn tables_on_the_way_are_made() {
    let mut document = document();
    document.set("group.0.goal.point.at", Array::from_iter([9.0, 1.0])).unwrap();
    document.set("group.0.body.capsule", InlineTable::new()).unwrap_err();
    document.set("time.limit", 30.0).unwrap();
    document.set("group.0.speed.max", 2.0).unwrap();
    let text = document.text();
    assert!(text.contains("goal.point.at = [9.0, 1.0]\nspeed.max = 2.0\n"), "{text}");
    assert!(text.contains("so called\ntime.limit = 30.0\n"), "{text}");
    assert_eq!(document.scene().unwrap().time.limit, 30.0);
}

#[test]
fn inline_tables_and_lists_grow_and_shrink() {
    let mut edit = Edit::new(SCENE).unwrap();
    edit.set("group.0.body.capsule.length", 1.0).unwrap();
    edit.remove("group.0.body.radius").unwrap();
    edit.push("group.0.place.points", Array::from_iter([4, 4])).unwrap();
    edit.remove("group.0.place.points.0").unwrap();
    let text = edit.text();
    assert!(text.contains("body = { capsule.length = 1.0 }\n"), "{text}");
    assert!(text.contains("place.points = [[2, 0.50], [4, 4]]   # metres\n"), "{text}");
    assert_eq!((edit.remove("group.0.place.points"), edit.has("group.0.place")), (Ok(true), false));
    assert_eq!(edit.remove("group.7.place"), Ok(false));
}

#[test]
fn lists_of_tables_are_made_before_the_groups() {
    let mut document = document();
    let wall: Value = "{ name = \"w\", shape.wall = [[0, 5], [5, 5]] }".parse().unwrap();
    assert!(document.change(|edit| edit.push("obstacle", wall.clone()).map(drop)).is_ok());
    assert!(document.change(|edit| edit.push("obstacle", wall).map(drop)).is_ok());
    let (first, _) = document.text().split_once("[[group]]").unwrap();
    assert_eq!(first.matches("\n[[obstacle]]\nname = \"w\"\nshape.wall = [[0, 5], [5, 5]]\n").count(), 2, "{first}");
    assert_eq!(document.scene().unwrap().obstacles.len(), 2);
}

#[test]
fn what_is_no_scene_is_refused_in_words() {
    let mut document = document();
    for (path, says) in [
        ("group.0.nmae", "nmae"),
        ("group.5.name", "nothing at `5`"),
        ("group.0.name.x", "no table"),
        ("group", "is a table"),
    ] {
        let refused = document.set(path, "x").unwrap_err();
        assert!(refused.contains(says), "{path}: {refused}");
    }
    assert!(document.change(|edit| edit.push("title", 3).map(drop)).unwrap_err().contains("no list"));
    assert!(document.text() == SCENE && !document.undo());
}

/// Collects the path of every simple value of a text. No path leads into a key with dots, as presets have.
fn leaves(item: &Item, path: &str, found: &mut Vec<String>) {
    let further = |step: &str| if path.is_empty() { step.to_owned() } else { format!("{path}.{step}") };
    if let Some(table) = item.as_table_like() {
        let keys = table.iter().filter(|(key, _)| !key.contains('.'));
        keys.for_each(|(key, item)| leaves(item, &further(key), found));
    } else if let Item::ArrayOfTables(tables) = item {
        let tables = tables.iter().cloned().map(Item::Table).enumerate();
        tables.for_each(|(k, item)| leaves(&item, &further(&k.to_string()), found));
    } else if let Some(array) = item.as_array() {
        let values = array.iter().cloned().map(Item::Value).enumerate();
        values.for_each(|(k, item)| leaves(&item, &further(&k.to_string()), found));
    } else {
        found.push(path.to_owned());
    }
}

#[test]
fn every_value_of_the_gallery_can_be_set_to_itself() {
    for name in gallery::names() {
        let text = gallery::text(name).unwrap();
        let mut edit = Edit::new(text).unwrap();
        let mut paths = Vec::new();
        leaves(edit.0.as_item(), "", &mut paths);
        assert!(paths.len() > 5, "{name}");
        for path in paths {
            let value = edit.value(&path).unwrap().clone();
            let plain = number(&value).map_or(value, Value::from);
            edit.set(&path, plain).unwrap();
        }
        assert_eq!(edit.text(), text, "{name}");
    }
}

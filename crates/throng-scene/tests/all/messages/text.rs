//! Mistakes in the text: keys, choices, types, missing keys.

use super::{assert_message, group, message};
use throng_scene::Kind;

#[test]
fn an_unknown_key_is_named_with_the_nearest() {
    assert_message(
        &group("count = 3\nplace.ring = { radus = 7.0 }"),
        Kind::UnknownKey,
        r"
a.toml:6:16: there is no key `radus` here
  6 | place.ring = { radus = 7.0 }
    |                ^^^^^
  hint: did you mean `radius`? the keys here are: center, radius, start",
    );
    assert_message(
        &group("count = 3\ndetour = false"),
        Kind::UnknownKey,
        r"
a.toml:6:1: there is no key `detour` here
  6 | detour = false
    | ^^^^^^
  hint: `look_ahead` does what it did, and is on unless it says false: leave `detour` out",
    );
    assert_message(
        "tiem = { step = 0.04 }",
        Kind::UnknownKey,
        r"
a.toml:1:1: there is no key `tiem` here
  1 | tiem = { step = 0.04 }
    | ^^^^
  hint: did you mean `time`? the keys here are: title, about, seed, time, walkable, obstacle, surface, path, field, group, mover, intervention, rules, view, expect",
    );
}

#[test]
fn an_unknown_choice_is_named_with_the_others() {
    assert_message(
        &group("count = 3\nplace.circle = { radius = 7.0 }"),
        Kind::UnknownKey,
        r"
a.toml:6:7: group `walkers`: `circle` is not one of the choices here
  6 | place.circle = { radius = 7.0 }
    |       ^^^^^^
  hint: the choices here are: point, points, line, ring, sphere, grid, disc, rectangle, polygon, walkable",
    );
}

#[test]
fn an_unknown_choice_inside_a_choice_is_shown() {
    assert_message(
        &group("place.point = [0, 0]\ngoal.area = { dsic = { center = [5, 0], radius = 1 } }"),
        Kind::UnknownKey,
        r"
a.toml:6:15: `dsic` is not one of the choices here
  6 | goal.area = { dsic = { center = [5, 0], radius = 1 } }
    |               ^^^^
  hint: did you mean `disc`? the choices here are: disc, rectangle, polygon",
    );
    assert_message(
        &group("place.point = [0, 0]\ngoal.journey = [{ goal.point = { at = [5, 0], tolernace = 1 } }]"),
        Kind::UnknownKey,
        r"
a.toml:6:47: there is no key `tolernace` here
  6 | goal.journey = [{ goal.point = { at = [5, 0], tolernace = 1 } }]
    |                                               ^^^^^^^^^
  hint: did you mean `tolerance`? the keys here are: at, tolerance",
    );
    let sketch = "flow.sketch = { stamps = [{ at = [0, 0], kind = \"vortx\", radius = 3 }] }";
    let (kind, text) = message(&format!("{}\n[[field]]\nname = \"f\"\n{sketch}", group("place.point = [0, 0]")));
    assert_eq!(kind, Kind::UnknownKey);
    assert!(text.contains(":49: field `f`: `vortx` is not one of the choices here"), "{text}");
}

#[test]
fn a_text_is_no_choice() {
    assert_message(
        &group("place.point = [0, 0]\ngoal = \"opposite\""),
        Kind::WrongType,
        r#"
a.toml:6:8: this is the wrong type: the text "opposite", but should be a choice, as in `goal.point = [5, 0]`
  6 | goal = "opposite"
    |        ^^^^^^^^^^
  hint: `goal`: Where the agents go. Without it, they stay."#,
    );
}

#[test]
fn a_missing_key_is_named() {
    assert_message(
        &group("count = 3\nplace.ring = {}"),
        Kind::MissingKey,
        r"
a.toml:6:14: the key `radius` is missing here
  6 | place.ring = {}
    |              ^^
  hint: add `radius` to this table",
    );
    assert_message(
        &group("place.ring = { radius = 7 }"),
        Kind::MissingKey,
        r"
a.toml:3:1: group `walkers`: the key `count` is missing
  3 | [[group]]
    | ^^^^^^^^^
  hint: say how many agents: count = 36",
    );
}

#[test]
fn a_wrong_type_says_what_belongs_there() {
    assert_message(
        &group("count = 3\nplace.ring = { radius = \"seven\" }"),
        Kind::WrongType,
        r#"
a.toml:6:25: this is the wrong type: the text "seven", but should be a number
  6 | place.ring = { radius = "seven" }
    |                         ^^^^^^^
  hint: `radius`: Its radius. Limit: > 0."#,
    );
    assert_message(
        &group("count = -3\nplace.point = [0, 0]"),
        Kind::OutOfRange,
        r"
a.toml:5:9: this value cannot be: the whole number -3, but should be a whole number that is not negative
  5 | count = -3
    |         ^^
  hint: `count`: The number of agents. Without it, as many as the place or the sources define. Limit: 1 to 20,000,000.",
    );
    assert_message(
        &group("place.sphere = { center = [0, 0, 9, 1], radius = 2 }"),
        Kind::WrongType,
        r"
a.toml:5:27: this has the wrong number of entries: 4, but should be three numbers, [x, y, z]
  5 | place.sphere = { center = [0, 0, 9, 1], radius = 2 }
    |                           ^^^^^^^^^^^^
  hint: `center`: Its centre. Limit of z: at least `radius`, so that all of it is above the ground.",
    );
    assert_message(
        &group("place.sphere = { center = [0, 0], radius = 2 }"),
        Kind::WrongType,
        r"
a.toml:5:27: this has the wrong number of entries: 2, but should be three numbers, [x, y, z]
  5 | place.sphere = { center = [0, 0], radius = 2 }
    |                           ^^^^^^
  hint: `center`: Its centre. Limit of z: at least `radius`, so that all of it is above the ground.",
    );
    assert_message(
        &group("place.point = [0, 0, 0]"),
        Kind::WrongType,
        r"
a.toml:5:15: this has the wrong number of entries: 3, but should be two numbers, [x, y]
  5 | place.point = [0, 0, 0]
    |               ^^^^^^^^^
  hint: `point`: One position: for a single agent, or for a source.",
    );
    assert_message(
        "time.sub_steps = \"often\"",
        Kind::OutOfRange,
        r#"
a.toml:1:18: this value cannot be: the text "often", but should be "auto" or a whole number from 1 to 1000
  1 | time.sub_steps = "often"
    |                  ^^^^^^^
  hint: `sub_steps`: How a step is divided: `"auto"`, or a number of parts."#,
    );
}

#[test]
fn text_that_is_not_toml_is_shown() {
    let (kind, message) = message("title = \"t\"\nseed == 3");
    assert_eq!(kind, Kind::Syntax);
    assert!(message.starts_with("a.toml:2:7: this is not TOML: "), "{message}");
    assert!(message.contains("2 | seed == 3\n    |       ^"), "{message}");
}

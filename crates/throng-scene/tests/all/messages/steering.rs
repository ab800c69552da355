//! Mistakes in steering: behaviours, targets, states, surfaces and paths.

use super::{assert_message, steers};
use throng_scene::Kind;

#[test]
fn a_wrong_behaviour_is_named_with_its_place() {
    // the hint lists every behaviour of the schema
    let schema = throng_scene::schema();
    let choices = schema["$defs"]["Steer"]["oneOf"].as_array().unwrap();
    let keys: Vec<&str> = choices.iter().map(|choice| choice["required"][0].as_str().unwrap()).collect();
    assert!(keys.len() > 50 && keys[0] == "seek");
    assert_message(
        &steers("steer.sek = { target = \"goal\" }"),
        Kind::UnknownKey,
        &format!(
            "a.toml:6:7: group `walkers`: `sek` is not one of the choices here\n  6 | steer.sek = {{ target = \"goal\" }}\n    |       ^^^\n  \
             hint: did you mean `seek`? the choices here are: {}",
            keys.join(", ")
        ),
    );
    assert_message(
        &steers("steer.priority = [{ wander = {} }, { arrive = { target = [0, 0], slowing_distance = -1 } }]"),
        Kind::OutOfRange,
        r"
a.toml:6:85: group `walkers`: steer.priority[1].arrive.slowing_distance is -1, but must be 0 or more
  6 | … { target = [0, 0], slowing_distance = -1 } }]
    |                                         ^^
  hint: `slowing_distance`: Distance at which it starts to slow down, metres. Limit: >= 0. Default: 1.",
    );
    assert_message(
        &steers("steer.weighted_sum = [{ weight = -1, of.wander = {} }]"),
        Kind::OutOfRange,
        r"
a.toml:6:34: group `walkers`: steer.weighted_sum[0].weight is -1, but must be 0 or more
  6 | steer.weighted_sum = [{ weight = -1, of.wander = {} }]
    |                                  ^^
  hint: `weight`: Factor of its force. Limit: >= 0. Default: 1.",
    );
    assert_message(
        &steers("steer.cohesion = { near.angle = 270 }"),
        Kind::OutOfRange,
        r"
a.toml:6:33: group `walkers`: steer.cohesion.near.angle is 270, but must be from 0 to 180
  6 | steer.cohesion = { near.angle = 270 }
    |                                 ^^^
  hint: `angle`: Half the angle of view, degrees from straight ahead; 180: all round. Limit: 0 to 180. Default: 180.",
    );
    assert_message(
        &steers("steer.wander = { rate = inf }"),
        Kind::OutOfRange,
        r"
a.toml:6:25: group `walkers`: steer.wander.rate is inf, but must be a finite number of at most 100,000,000 in size
  6 | steer.wander = { rate = inf }
    |                         ^^^
  hint: `rate`: Rate of change of the side, degrees per square root of a second. Limit: >= 0. Default: 57.29578.",
    );
}

#[test]
fn what_cannot_be_is_named() {
    assert_message(
        &steers("steer.takeoff = { from = [0, 0], to = [9, 0], rise = 3 }"),
        Kind::Geometry,
        r"
a.toml:6:17: group `walkers`: a leap: an agent that rises at 3 m/s and runs at 1.8 m/s at most cannot leap there: set a greater rise, or a `to` nearer to `from`, not above it
  6 | steer.takeoff = { from = [0, 0], to = [9, 0], rise = 3 }
    |                 ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^",
    );
    assert_message(
        &steers("steer.avoid_map = { min = [0, 0], max = [9e4, 9e4], of.wander = {} }"),
        Kind::Geometry,
        r"
a.toml:6:19: group `walkers`: the map: 90000 by 90000 cells; there must be 1 to 1000000 in all: set min and max, corners, or a greater cell
  6 | steer.avoid_map = { min = [0, 0], max = [9e4, 9e4], of.wander = {} }
    |                   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^",
    );
    assert_message(
        &steers("steer.context_steering = { of = [{ of.wander = {} }], directions = 3 }"),
        Kind::OutOfRange,
        r"
a.toml:6:68: group `walkers`: steer.context_steering.directions is 3, but must be from 4 to 64
  6 | steer.context_steering = { of = [{ of.wander = {} }], directions = 3 }
    |                                                                    ^
  hint: `directions`: Number of directions in the horizontal plane; agents that fly evaluate as many again above and below it. Limit: 4 to 64. Default: 16.",
    );
}

#[test]
fn a_wrong_target_is_named_with_what_there_is() {
    assert_message(
        &steers("steer.seek = { target = \"home\" }"),
        Kind::OutOfRange,
        r#"
a.toml:6:25: group `walkers`: this value cannot be: the text "home", but should be [x, y], [x, y, z], "goal", { group = "name", agent = 0 } or { nearest = "others" }
  6 | steer.seek = { target = "home" }
    |                         ^^^^^^
  hint: `target`: The target."#,
    );
    assert_message(
        &steers("steer.seek = { target = [1, 2, 3, 4] }"),
        Kind::WrongType,
        r"
a.toml:6:25: group `walkers`: this has the wrong number of entries: 4, but should be [x, y] or [x, y, z]
  6 | steer.seek = { target = [1, 2, 3, 4] }
    |                         ^^^^^^^^^^^^
  hint: `target`: The target.",
    );
    assert_message(
        &steers("steer.seek = { target = { group = \"wolf\" } }"),
        Kind::UnknownKey,
        r#"
a.toml:6:35: group `walkers`: there is no group `wolf`
  6 | steer.seek = { target = { group = "wolf" } }
    |                                   ^^^^^^
  hint: there is: walkers"#,
    );
    assert_message(
        &steers("steer.seek = { target = { group = \"walkers\", agent = 1 } }"),
        Kind::OutOfRange,
        r#"
a.toml:6:54: group `walkers`: there is no agent 1 in `walkers`
  6 | steer.seek = { target = { group = "walkers", agent = 1 } }
    |                                                      ^
  hint: it has one agent, 0"#,
    );
}

#[test]
fn a_wrong_state_is_named() {
    assert_message(
        &steers(
            "steer.switch = { first = \"a\", states.a = { of.wander = {}, exits = [{ to = \"b\", when.after = 1 }] } }",
        ),
        Kind::UnknownKey,
        r#"
a.toml:6:76: group `walkers`: there is no state `b`
  6 | steer.switch = { first = "a", states.a = { of.wander = {}, exits = [{ to = "b", when.after = 1 }] } }
    |                                                                            ^^^
  hint: there is: a"#,
    );
}

#[test]
fn what_walks_and_what_steers_is_said_once() {
    assert_message(
        &steers("motor = \"holonomic\"\nvehicle.mass = 2"),
        Kind::Conflict,
        r#"
a.toml:7:16: group `walkers`: the agents have a holonomic motor, which has no `vehicle`
  7 | vehicle.mass = 2
    |                ^
  hint: leave it out, or set motor = "vehicle""#,
    );
    assert_message(
        &steers("steer.wander = {}\nspeed.max = 2"),
        Kind::Conflict,
        r"
a.toml:7:13: group `walkers`: the agents have a vehicle, which has no `speed`
  7 | speed.max = 2
    |             ^
  hint: set vehicle.max_speed instead",
    );
    assert_message(
        &steers("steer.wander = {}\nvehicle = { min_speed = 2, max_speed = 1 }"),
        Kind::OutOfRange,
        r"
a.toml:7:25: min_speed is 2, but must be from 0 to max_speed
  7 | vehicle = { min_speed = 2, max_speed = 1 }
    |                         ^
  hint: `min_speed`: The least speed, m/s. Limit: 0 to `max_speed`. Default: 0.",
    );
}

#[test]
fn a_wrong_surface_or_path_is_named() {
    let scene = |what: &str| format!("{what}\n\n[[group]]\nplace.point = [0, 0]\n");
    assert_message(
        &scene("[[surface]]\nname = \"ball\"\nshape.sphere = { radius = -2 }"),
        Kind::OutOfRange,
        r"
a.toml:3:16: surface `ball`: the radius of a sphere is -2, but must be greater than 0 and finite
  3 | shape.sphere = { radius = -2 }
    |                ^^^^^^^^^^^^^^^",
    );
    assert_message(
        &scene("[[surface]]\nname = \"roof\"\nshape.mesh.file = \"roof.obj\""),
        Kind::File,
        r#"
a.toml:3:19: surface `roof`: there is no file roof.obj
  3 | shape.mesh.file = "roof.obj"
    |                   ^^^^^^^^^^
  hint: relative names refer to the scene file's folder"#,
    );
    assert_message(
        &scene("[[path]]\nname = \"round\"\npoints = [[0, 0], [1, 0]]"),
        Kind::Conflict,
        r"
a.toml:1:1: path `round`: there is no radius
  1 | [[path]]
    | ^^^^^^^^
  hint: give `radius = 1.0`, or `radii` with one for each segment",
    );
    assert_message(
        &scene("[[path]]\nname = \"round\"\npoints = [[0, 0], [0, 0]]\nradius = 1"),
        Kind::Geometry,
        r"
a.toml:1:1: path `round`: a path: its points 0 and 1 are the same: leave one of them out
  1 | [[path]]
    | ^^^^^^^^",
    );
}

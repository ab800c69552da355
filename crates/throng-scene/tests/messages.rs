//! Every mistake gets a message with its place and its mend.

use throng_scene::{Kind, Scene};

/// A scene of one group; `line` is line 5, in the group's table.
fn group(line: &str) -> String {
    format!("title = \"t\"\n\n[[group]]\nname = \"walkers\"\n{line}\n")
}

/// The message of a scene that must fail.
fn message(text: &str) -> (Kind, String) {
    let error = match Scene::parse("a.toml", text) {
        Err(error) => error,
        Ok(scene) => scene.build().map(|_| ()).unwrap_err(),
    };
    (error.kind, error.to_string())
}

#[track_caller]
fn assert_message(text: &str, kind: Kind, expected: &str) {
    let (found, message) = message(text);
    assert_eq!(message, expected.trim_matches('\n'), "\n--- found:\n{message}\n---");
    assert_eq!(found, kind);
}

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
        "tiem = { step = 0.04 }",
        Kind::UnknownKey,
        r"
a.toml:1:1: there is no key `tiem` here
  1 | tiem = { step = 0.04 }
    | ^^^^
  hint: did you mean `time`? the keys here are: title, description, seed, time, walkable, obstacle, surface, path, group, mover, rules, view, expect",
    );
}

#[test]
fn an_unknown_choice_is_named_with_the_others() {
    assert_message(
        &group("count = 3\nplace.circle = { radius = 7.0 }"),
        Kind::UnknownKey,
        r"
a.toml:6:7: `circle` is not one of the choices here
  6 | place.circle = { radius = 7.0 }
    |       ^^^^^^
  hint: the choices here are: point, points, line, ring, sphere, grid, disc, rectangle, polygon, walkable",
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
    |                         ^^^^^^^"#,
    );
    assert_message(
        &group("count = -3\nplace.point = [0, 0]"),
        Kind::OutOfRange,
        r"
a.toml:5:9: this value cannot be: the whole number -3, but should be a whole number that is not negative
  5 | count = -3
    |         ^^",
    );
    assert_message(
        &group("place.sphere = { center = [0, 0, 9, 1], radius = 2 }"),
        Kind::WrongType,
        r"
a.toml:5:27: this has the wrong number of entries: 4, but should be three numbers, [x, y, z]
  5 | place.sphere = { center = [0, 0, 9, 1], radius = 2 }
    |                           ^^^^^^^^^^^^",
    );
    assert_message(
        &group("place.sphere = { center = [0, 0], radius = 2 }"),
        Kind::WrongType,
        r"
a.toml:5:27: this has the wrong number of entries: 2, but should be three numbers, [x, y, z]
  5 | place.sphere = { center = [0, 0], radius = 2 }
    |                           ^^^^^^",
    );
    assert_message(
        &group("place.point = [0, 0, 0]"),
        Kind::WrongType,
        r"
a.toml:5:15: this has the wrong number of entries: 3, but should be two numbers, [x, y]
  5 | place.point = [0, 0, 0]
    |               ^^^^^^^^^",
    );
    assert_message(
        "time.sub_steps = \"often\"",
        Kind::OutOfRange,
        r#"
a.toml:1:18: this value cannot be: the text "often", but should be "auto" or a whole number from 1 to 1000
  1 | time.sub_steps = "often"
    |                  ^^^^^^^"#,
    );
}

#[test]
fn text_that_is_not_toml_is_shown() {
    let (kind, message) = message("title = \"t\"\nseed == 3");
    assert_eq!(kind, Kind::Syntax);
    assert!(message.starts_with("a.toml:2:7: this is not TOML: "), "{message}");
    assert!(message.contains("2 | seed == 3\n    |       ^"), "{message}");
}

#[test]
fn numbers_out_of_range_are_named_with_their_limits() {
    assert_message(
        &group("place.point = [0, 0]\nbody = { radius = -0.2 }"),
        Kind::OutOfRange,
        r"
a.toml:6:19: group `walkers`: body.radius is -0.2, but must be more than 0 and at most 1000
  6 | body = { radius = -0.2 }
    |                   ^^^^",
    );
    assert_message(
        &group("place.point = [nan, 0]"),
        Kind::OutOfRange,
        r"
a.toml:5:16: group `walkers`: place.point[0] is NaN, but must be a finite number of at most 100,000,000 in size
  5 | place.point = [nan, 0]
    |                ^^^",
    );
    assert_message(
        "time.step = inf",
        Kind::OutOfRange,
        r"
a.toml:1:13: time.step is inf, but must be more than 0 and at most 10
  1 | time.step = inf
    |             ^^^",
    );
    assert_message(
        &group("place.point = [0, 0]\nspeed = { preferred = 1.5, max = 1.2 }"),
        Kind::OutOfRange,
        r"
a.toml:6:34: group `walkers`: speed.max is 1.2, but speed.preferred is 1.5
  6 | speed = { preferred = 1.5, max = 1.2 }
    |                                  ^^^
  hint: the greatest speed must be at least the preferred one",
    );
    assert_message(
        &group("place.point = [0, 0]\nbody.radius.normal = { mean = 0.2, deviation = 0.1 }"),
        Kind::OutOfRange,
        r"
a.toml:6:22: group `walkers`: body.radius.normal can give -0.10000000000000003 to 0.5, but must be more than 0 and at most 1000
  6 | body.radius.normal = { mean = 0.2, deviation = 0.1 }
    |                      ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  hint: without `min` and `max` it reaches three deviations to each side: set them",
    );
}

#[test]
fn those_who_fly_stay_above_the_ground() {
    let count = |text: &str| group(&format!("count = 2\n{text}"));
    assert_message(
        &count("place.sphere = { center = [0, 0, 3], radius = 4 }"),
        Kind::OutOfRange,
        r"
a.toml:6:47: group `walkers`: place.sphere.radius is 4, but must be more than 0 and at most 3
  6 | place.sphere = { center = [0, 0, 3], radius = 4 }
    |                                               ^
  hint: all of the sphere must be above the ground: put its center higher, or make it smaller",
    );
    assert_message(
        &count("place.line = { from = [0, 0], to = [3, 0] }\naltitude = 3\ngoal.shift = { by = [9, 0], rise = -4 }"),
        Kind::OutOfRange,
        r"
a.toml:8:14: the goal of agent 0 is -1 m above the ground, but must be from 0 to 20000
  8 | goal.shift = { by = [9, 0], rise = -4 }
    |              ^^^^^^^^^^^^^^^^^^^^^^^^^^",
    );
    assert_message(
        &count("place.line = { from = [0, 0], to = [3, 0] }\nbody.capsule = { length = 2, width = 1 }\naltitude = 3"),
        Kind::Conflict,
        r"
a.toml:8:12: group `walkers`: only bodies that are discs have an altitude: others stand upright without end
  8 | altitude = 3
    |            ^
  hint: leave altitude away",
    );
    assert_message(
        &count("place.sphere = { center = [0, 0, 9], radius = 4 }\naltitude = { uniform = [-1, 3] }"),
        Kind::OutOfRange,
        r"
a.toml:7:25: group `walkers`: altitude.uniform[0] is -1, but must be from 0 to 20000
  7 | altitude = { uniform = [-1, 3] }
    |                         ^^",
    );
}

#[test]
fn agents_that_overlap_are_both_named() {
    assert_message(
        &group("place.points = [[0, 0], [5, 0], [5, 0]]"),
        Kind::Overlap,
        r"
a.toml:5:16: agent 1 of group `walkers` and agent 2 of group `walkers` start at one place, (5, 0)
  5 | place.points = [[0, 0], [5, 0], [5, 0]]
    |                ^^^^^^^^^^^^^^^^^^^^^^^^
  hint: move them apart, make the place larger, or use a smaller body.radius",
    );
    let two = group("place.point = [0, 0]") + "[[group]]\nname = \"others\"\nplace.point = [0.3, 0]\n";
    assert_message(
        &two,
        Kind::Overlap,
        r"
a.toml:8:15: agent 0 of group `walkers` and agent 0 of group `others` overlap: their centres are 0.3 m apart, their bodies need 0.4 m
  8 | place.point = [0.3, 0]
    |               ^^^^^^^^
  hint: move them apart, make the place larger, or use a smaller body.radius",
    );
}

const ROOM: &str = "walkable.rectangle = { center = [0, 0], size = [10, 10] }\n";

#[test]
fn agents_in_walls_are_named_with_the_distance_to_move() {
    assert_message(
        &(ROOM.to_owned() + &group("place.point = [4.9, 0]")),
        Kind::InWall,
        r"
a.toml:6:15: agent 0 of group `walkers` starts in a wall: (4.9, 0) is 0.1 m from it, the body's radius is 0.2
  6 | place.point = [4.9, 0]
    |               ^^^^^^^^
  hint: move it 0.101 m away from the wall",
    );
    assert_message(
        &(ROOM.to_owned() + &group("place.point = [6, 0]")),
        Kind::InWall,
        r"
a.toml:6:15: agent 0 of group `walkers` starts off the walkable ground, at (6, 0)
  6 | place.point = [6, 0]
    |               ^^^^^^
  hint: move it onto the ground",
    );
    let pillar = "[[obstacle]]\nname = \"pillar\"\nshape.circle = { center = [0, 0], radius = 1 }\n";
    assert_message(
        &(pillar.to_owned() + "[[group]]\nplace.point = [0.5, 0]\n"),
        Kind::InWall,
        r"
a.toml:5:15: agent 0 of group `group-1` starts inside obstacle `pillar`, at (0.5, 0)
  5 | place.point = [0.5, 0]
    |               ^^^^^^^^
  hint: move it, or the obstacle",
    );
}

#[test]
fn goals_in_walls_are_named() {
    let pillar = "[[obstacle]]\nname = \"pillar\"\nshape.circle = { center = [0, 0], radius = 1 }\n";
    assert_message(
        &(pillar.to_owned() + "[[group]]\nplace.point = [5, 0]\ngoal.point = [0, 0.5]\n"),
        Kind::GoalInWall,
        r"
a.toml:6:14: the goal, (0, 0.5), is inside obstacle `pillar`
  6 | goal.point = [0, 0.5]
    |              ^^^^^^^^
  hint: move the goal to where somebody can stand",
    );
    assert_message(
        &(pillar.to_owned() + "[[group]]\nplace.point = [5, 0]\ngoal.point = [0, 1.05]\n"),
        Kind::GoalInWall,
        r"
a.toml:6:14: the goal, (0, 1.05), is 0.05 m from obstacle `pillar`: a body of radius 0.2 cannot come within 0.1 m of it
  6 | goal.point = [0, 1.05]
    |              ^^^^^^^^^
  hint: move the goal away from the wall, or give it a larger tolerance",
    );
    let exit = |x: f64| {
        let exit = format!("place.point = [0, 0]\ngoal.exit.rectangle = {{ center = [{x}, 0], size = [0.2, 1] }}");
        ROOM.to_owned() + &group(&exit)
    };
    let (kind, text) = message(&exit(5.0));
    assert_eq!(kind, Kind::GoalInWall);
    assert!(
        text.starts_with("a.toml:7:23: the exit lies so near the walls that a body of radius 0.2 cannot"),
        "{text}"
    );
    let (_, text) = message(&exit(7.0));
    assert!(text.starts_with("a.toml:7:23: the exit lies in a wall or off the walkable ground"), "{text}");
}

#[test]
fn a_polygon_that_crosses_itself_is_shown_where() {
    assert_message(
        "[[obstacle]]\nshape.polygon = [[0, 0], [2, 2], [2, 0], [0, 2]]\n",
        Kind::Count,
        r"
a.toml:1:1: the scene has no agents
  1 | [[obstacle]]
    | ^
  hint: add a [[group]] with a `count` of at least 1 and a `place`",
    );
    assert_message(
        "[[group]]\nplace.point = [9, 9]\n[[obstacle]]\nshape.polygon = [[0, 0], [2, 2], [2, 0], [0, 2]]\n",
        Kind::Geometry,
        r"
a.toml:4:17: obstacle 1 crosses itself at (1, 1): the edge from (0, 0) to (2, 2) and that from (2, 0) to (0, 2)
  4 | shape.polygon = [[0, 0], [2, 2], [2, 0], [0, 2]]
    |                 ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  hint: list the corners in order round the outline, as one would walk it",
    );
}

#[test]
fn too_many_agents_are_refused_before_they_take_memory() {
    assert_message(
        &group("place.grid = { columns = 100_000, rows = 10_000, spacing = 1 }"),
        Kind::Count,
        r"
a.toml:3:1: 1000000000 agents are more than the limit of 20000000 (MAX_AGENTS)
  3 | [[group]]
    | ^^^^^^^^^
  hint: use fewer agents, or several scenes",
    );
    let (kind, text) = message(&group("count = 1_000_000_000\nplace.ring = { radius = 7 }"));
    assert_eq!(kind, Kind::Count);
    assert!(text.starts_with("a.toml:5:9: 1000000000 agents are more than"), "{text}");
    let (kind, _) = message(&group("count = 0\nplace.ring = { radius = 7 }"));
    assert_eq!(kind, Kind::Count);
    let (kind, _) = message(&group("place.point = [0, 0]\nsource = { rate = 1e9, end = 1e7 }"));
    assert_eq!(kind, Kind::Count);
}

#[test]
fn agents_that_do_not_fit_are_counted() {
    let (kind, text) = message(&group("count = 100\nplace.disc = { radius = 1.0 }"));
    assert_eq!(kind, Kind::NoRoom);
    assert!(text.starts_with("a.toml:6:14: group `walkers`: only ") && text.contains(" of 100 agents fit"), "{text}");
}

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

/// A scene of one group at a point; `line` is line 6.
fn steers(line: &str) -> String {
    group(&format!("place.point = [0, 0]\n{line}"))
}

#[test]
fn a_wrong_behaviour_is_named_with_its_place() {
    assert_message(
        &steers("steer.sek = { target = \"goal\" }"),
        Kind::UnknownKey,
        &format!(
            "a.toml:6:7: `sek` is not one of the choices here\n  6 | steer.sek = {{ target = \"goal\" }}\n    |       ^^^\n  \
             hint: did you mean `seek`? the choices here are: {}",
            "seek, flee, arrive, pursue, evade, offset_pursuit, shadow, interpose, keep_station, dock, wander, fractal_wander, \
             explore, forage, face, look_where_you_go, fear, head_for, constant_force, evade_all, slip_through, follow_flow, move_forward, target_speed, tether, separation, \
             alignment, cohesion, match_velocity, flocking, boids, avoid_neighbours, close_avoidance, unaligned_avoidance, \
             queue, follow_leader, keep_formation, weighted_sum, running_sum, priority, dithering, allocation, switch, \
             amortised, hold, irregular, limited, stop_and_wait, custom"
        ),
    );
    assert_message(
        &steers("steer.priority = [{ wander = {} }, { arrive = { target = [0, 0], slowing_distance = -1 } }]"),
        Kind::OutOfRange,
        r"
a.toml:6:85: group `walkers`: slowing distance is -1, but must be 0 or more
  6 | … { target = [0, 0], slowing_distance = -1 } }]
    |                                         ^^",
    );
    assert_message(
        &steers("steer.weighted_sum = [{ weight = -1, of.wander = {} }]"),
        Kind::OutOfRange,
        r"
a.toml:6:34: group `walkers`: steer.weighted_sum[0].weight is -1, but must be 0 or more
  6 | steer.weighted_sum = [{ weight = -1, of.wander = {} }]
    |                                  ^^",
    );
    assert_message(
        &steers("steer.cohesion = { near.angle = 270 }"),
        Kind::OutOfRange,
        r"
a.toml:6:33: group `walkers`: steer.cohesion.near.angle is 270, but must be from 0 to 180
  6 | steer.cohesion = { near.angle = 270 }
    |                                 ^^^",
    );
    assert_message(
        &steers("steer.wander = { rate = inf }"),
        Kind::OutOfRange,
        r"
a.toml:6:25: group `walkers`: steer.wander.rate is inf, but must be a finite number of at most 100,000,000 in size
  6 | steer.wander = { rate = inf }
    |                         ^^^",
    );
}

#[test]
fn a_wrong_target_is_named_with_what_there_is() {
    assert_message(
        &steers("steer.seek = { target = \"home\" }"),
        Kind::OutOfRange,
        r#"
a.toml:6:25: this value cannot be: the text "home", but should be [x, y], [x, y, z], "goal", { group = "name", agent = 0 } or { nearest = "others" }
  6 | steer.seek = { target = "home" }
    |                         ^^^^^^"#,
    );
    assert_message(
        &steers("steer.seek = { target = [1, 2, 3, 4] }"),
        Kind::WrongType,
        r"
a.toml:6:25: this has the wrong number of entries: 4, but should be [x, y] or [x, y, z]
  6 | steer.seek = { target = [1, 2, 3, 4] }
    |                         ^^^^^^^^^^^^",
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
        &steers("vehicle.mass = 2"),
        Kind::Conflict,
        r"
a.toml:6:16: group `walkers`: only those who steer have a vehicle
  6 | vehicle.mass = 2
    |                ^
  hint: say what they steer by: steer.wander = {}",
    );
    assert_message(
        &steers("steer.wander = {}\nspeed.max = 2"),
        Kind::Conflict,
        r"
a.toml:7:13: group `walkers`: speed is for those who walk; those who steer move as their vehicles can
  7 | speed.max = 2
    |             ^
  hint: set vehicle.max_speed instead",
    );
    assert_message(
        &steers("steer.wander = {}\nvehicle = { min_speed = 2, max_speed = 1 }"),
        Kind::OutOfRange,
        r"
a.toml:7:11: group `walkers`: least speed is 2, but must be from 0 to the top speed
  7 | vehicle = { min_speed = 2, max_speed = 1 }
    |           ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^",
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
  hint: relative names start from the scene file's folder"#,
    );
    assert_message(
        &scene("[[path]]\nname = \"round\"\npoints = [[0, 0], [1, 0]]"),
        Kind::Conflict,
        r"
a.toml:1:1: path `round`: there is no radius
  1 | [[path]]
    | ^^^^^^^^
  hint: say `radius = 1.0`, or `radii` with one for each segment",
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

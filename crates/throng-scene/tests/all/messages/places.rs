//! Places where no agent can be, and places without room.

use super::{assert_message, group, message};
use throng_scene::Kind;

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
    let two = group("place.point = [0, 0]") + "[[group]]\nname = \"others\"\nplace.point = [0.2, 0]\n";
    assert_message(
        &two,
        Kind::Overlap,
        r"
a.toml:8:15: agent 0 of group `walkers` and agent 0 of group `others` overlap: their centres are 0.2 m apart, their bodies need 0.26 m
  8 | place.point = [0.2, 0]
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
a.toml:6:15: agent 0 of group `walkers` starts in a wall: (4.9, 0) is 0.1 m from it, the body's radius is 0.13
  6 | place.point = [4.9, 0]
    |               ^^^^^^^^
  hint: move it 0.031 m away from the wall",
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
  hint: move the goal to where an agent can stand",
    );
    assert_message(
        &(pillar.to_owned() + "[[group]]\nplace.point = [5, 0]\ngoal.point = [0, 1.02]\n"),
        Kind::GoalInWall,
        r"
a.toml:6:14: the goal, (0, 1.02), is 0.02 m from obstacle `pillar`: a body of radius 0.13 cannot come within 0.1 m of it
  6 | goal.point = [0, 1.02]
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
        text.starts_with("a.toml:7:23: the exit lies so near the walls that a body of radius 0.13 cannot"),
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
  hint: list the corners in order along the outline",
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

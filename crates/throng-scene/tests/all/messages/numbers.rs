//! Numbers out of range.

use super::{assert_message, group};
use throng_scene::Kind;

#[test]
fn numbers_out_of_range_are_named_with_their_limits() {
    assert_message(
        &group("place.point = [0, 0]\nbody = { radius = -0.2 }"),
        Kind::OutOfRange,
        r"
a.toml:6:19: group `walkers`: body.radius is -0.2, but must be more than 0 and at most 1000
  6 | body = { radius = -0.2 }
    |                   ^^^^
  hint: `radius`: A disc of this radius, metres. Limit: > 0, at most 1000.",
    );
    assert_message(
        &group("place.point = [nan, 0]"),
        Kind::OutOfRange,
        r"
a.toml:5:16: group `walkers`: place.point[0] is NaN, but must be a finite number of at most 100,000,000 in size
  5 | place.point = [nan, 0]
    |                ^^^
  hint: `point`: One position: for a single agent, or for a source.",
    );
    assert_message(
        "time.step = inf",
        Kind::OutOfRange,
        r"
a.toml:1:13: time.step is inf, but must be from 0.00001 to 10
  1 | time.step = inf
    |             ^^^
  hint: `step`: Seconds from one output to the next. Limit: 0.00001 to 10. Default: 0.04.",
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
fn agents_that_fly_stay_above_the_ground() {
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
    |              ^^^^^^^^^^^^^^^^^^^^^^^^^^
  hint: `shift`: For each agent, its start shifted by a vector.",
    );
    assert_message(
        &count("place.line = { from = [0, 0], to = [3, 0] }\nbody.capsule = { length = 2, width = 1 }\naltitude = 3"),
        Kind::Conflict,
        r"
a.toml:8:12: group `walkers`: only discs have an altitude: other bodies reach up without end
  8 | altitude = 3
    |            ^
  hint: leave out `altitude`",
    );
    assert_message(
        &count("place.sphere = { center = [0, 0, 9], radius = 4 }\naltitude = { uniform = [-1, 3] }"),
        Kind::OutOfRange,
        r"
a.toml:7:25: group `walkers`: altitude.uniform[0] is -1, but must be from 0 to 20000
  7 | altitude = { uniform = [-1, 3] }
    |                         ^^
  hint: `uniform`: Uniformly distributed between two bounds, the lower first.",
    );
}

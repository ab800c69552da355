//! Every scene of the gallery meets its `[expect]`: as it is, and with other seeds.

use std::ops::Range;
use std::sync::Mutex;
use throng_scene::{Arrived, As, Expectations, Outcome, Scene, Shape, Until, gallery};

/// Runs a scene to its end.
fn run(scene: &Scene) -> Outcome {
    let (mut world, built) = scene.build().unwrap_or_else(|error| panic!("{error}"));
    let mut watch = Expectations::new(&scene.expect, &world, &built);
    while !scene.time.over(&world) {
        world.step();
        watch.step(&world);
    }
    watch.verdict(&world)
}

/// Runs a scene with some seeds, counted from its own. Returns the failures.
fn failures(name: &str, seeds: Range<u64>) -> Vec<String> {
    let scene = gallery::scene(name).unwrap_or_else(|error| panic!("{error}"));
    let run = |seed| (seed, run(&Scene { seed, ..scene.clone() }));
    seeds
        .map(|k| run(scene.seed + k))
        .filter(|(_, verdict)| !verdict.passed)
        .map(|(seed, verdict)| format!("{name} with seed {seed}:\n{verdict}\n"))
        .collect()
}

/// Runs all scenes but [`LONG`] with some seeds each, counted from their own.
fn every_scene_passes(seeds: Range<u64>) {
    // from the end of the list: the longest scenes first
    let names: Vec<&str> = gallery::names().filter(|name| !LONG.contains(name)).collect();
    let (queue, failed) = (Mutex::new(names), Mutex::new(vec![]));
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().unwrap().pop();
                    let Some(name) = next else { break };
                    let found = failures(name, seeds.clone());
                    failed.lock().unwrap().extend(found);
                }
            });
        }
    });
    let failed = failed.into_inner().unwrap();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn every_scene_shows_what_it_expects() {
    every_scene_passes(0..1);
}

#[test]
#[ignore = "slow: minutes"]
fn slow_every_scene_shows_what_it_expects_with_other_seeds() {
    every_scene_passes(1..3);
}

/// The scenes that take as long as all other scenes together.
const LONG: [&str; 2] = ["ring-1000", "rvo2-sphere"];

#[test]
#[ignore = "slow: a minute"]
fn slow_the_longest_scenes_show_what_they_expect() {
    let failed: Vec<String> = LONG.into_iter().flat_map(|name| failures(name, 0..1)).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn every_scene_says_what_the_project_promises() {
    for name in gallery::names() {
        let scene = gallery::scene(name).unwrap();
        // the labs' own algorithm guarantees nothing, nor do groups that only steer
        if scene.plan().unwrap().groups.iter().any(|group| !group.guard) {
            continue;
        }
        let expect = scene.expect;
        assert!(expect.least_separation >= Some(0.9999), "{name}");
        assert!(!scene.surfaces.is_empty() || expect.least_wall_separation >= Some(0.9999), "{name}");
        // agents of a game, or that steer along paths or in flocks, have no goal
        let goes_nowhere = scene.groups.iter().all(|group| group.steer.is_some() && group.goal.is_none());
        // nor have agents that a field alone guides
        let is_led = scene.groups.iter().any(|group| group.field.is_some() && group.goal.is_none());
        // and where people enter until the end, the last ones are still on their way
        let enters = scene.time.until == Until::Limit && scene.groups.iter().any(|group| !group.source.is_empty());
        if scene.rules.is_some() || goes_nowhere || is_led || enters {
            continue;
        }
        assert_eq!(expect.arrived, Some(Arrived::All), "{name}");
        assert!(expect.heading_change.is_some_and(|most| most <= 30.0), "{name}");
        assert!(expect.within.is_some(), "{name}");
    }
}

/// The seed labs used the circle around the bounding box of every obstacle.
#[test]
fn the_labs_way_with_obstacles_works_too() {
    for name in ["box", "pillars"] {
        let mut scene = gallery::scene(name).unwrap();
        scene.obstacles.iter_mut().for_each(|obstacle| obstacle.solid_as = As::Circle);
        let solid = scene.plan().unwrap().obstacles;
        for (obstacle, solid) in scene.obstacles.iter().zip(&solid) {
            let throng::Obstacle::Circle { radius, .. } = solid else { panic!("{name}: {solid:?}") };
            let round = match &obstacle.shape {
                Shape::Rectangle(r) => 0.5 * r.size[0].hypot(r.size[1]),
                Shape::Circle(circle) => circle.radius,
                other => panic!("{name}: {other:?}"),
            };
            assert!((radius - round).abs() < 1e-12, "{name}: {radius} {round}");
        }
        let verdict = run(&scene);
        assert!(verdict.passed, "{name}:\n{verdict}");
    }
}

const WALK: &str = "[[group]]\nplace.point = [0, 0]\nheading = 90\nlook_ahead = false\ngoal.exit.disc = { center = [5, 0], radius = 1 }\n\
                    source = { count = 2, rate = 1 }\n";

fn verdict(expect: &str) -> Outcome {
    run(&format!("{WALK}[expect]\n{expect}").parse().unwrap_or_else(|error| panic!("{error}")))
}

#[test]
fn agents_that_leave_and_agents_that_enter_later_count() {
    let checks = verdict("within = 10").checks;
    let shown: Vec<String> = checks.iter().map(ToString::to_string).collect();
    assert_eq!(shown[0], "arrived passed: expected 2, found 2");
    assert!(shown[1].starts_with("within passed: expected 10, found 4"), "{}", shown[1]);
    assert!(!verdict("within = 3").passed, "the second agent enters after a second");
    assert!(verdict("arrived = 1\nwithin = 4").passed);
    assert!(verdict("arrived = 0.5\nwithin = 4").passed);
    assert!(!verdict("arrived = 3").passed);
}

#[test]
fn whether_a_crowd_comes_to_rest_is_judged_at_the_end() {
    let walk = |limit: f64, bound: f64| {
        let scene = format!(
            "time = {{ step = 0.04, until = \"limit\", limit = {limit:?} }}\n[[group]]\nplace.point = [0, 0]\n\
             goal.point = [4, 0]\n[expect]\nfinal_speed = {bound:?}\n"
        );
        run(&scene.parse().unwrap_or_else(|error| panic!("{error}")))
    };
    assert!(!walk(2.0, 0.5).passed, "the agents still walk");
    assert!(walk(2.0, 1.31).passed);
    assert!(walk(10.0, 0.001).passed, "the agents have arrived");
}

#[test]
fn every_bound_can_fail() {
    let failing = [
        "least_separation = 5",
        "heading_change = 0.001", // all agents keep a little to the right
        "mean_speed = 1.31",
        "flow = [{ from = [2, -1], to = [2, 1], at_least = 1.1 }]",
        "distance = [{ to = [9, 0], at_least = 6, when = \"always\" }]",
        "speed = [{ at_least = 1.2, when = \"always\" }]", // they start from rest
        "order = [{ at_most = 0.9, when = \"ever\" }]",
    ];
    for expect in failing {
        let verdict = verdict(expect);
        assert!(!verdict.passed && verdict.checks.len() == 1, "{verdict}");
    }
    // no agent came near a wall: the bound holds
    assert!(verdict("least_wall_separation = 4").passed);
    assert!(verdict("flow = [{ from = [2, -1], to = [2, 1], at_least = 0.9, at_most = 1.1 }]").passed);
    assert_eq!(verdict(""), Outcome { passed: true, checks: vec![] });
}

#[test]
fn what_groups_show_is_judged_agent_by_agent() {
    let scene = |expect: &str| {
        let text = format!(
            "time = {{ step = 0.1, until = \"limit\", limit = 10 }}\n\
             [[group]]\nname = \"pair\"\nplace.points = [[0, 0], [10, 0]]\ngoal.shift.by = [0, 6]\n\
             [[group]]\nname = \"post\"\nplace.point = [0, 3]\nguard = false\navoid.none = {{}}\n\
             [expect]\n{expect}\n"
        );
        run(&text.parse().unwrap_or_else(|error| panic!("{error}")))
    };
    let holds = |expect: &str| scene(expect).passed;
    // the farther agent of the pair, at the end: [10, 6] from [0, 3]
    assert!(holds("distance = [{ of = \"pair\", to = \"post\", at_most = 10.6 }]"));
    assert!(!holds("distance = [{ of = \"pair\", to = \"post\", at_most = 10.3 }]"));
    // each agent at its nearest: the agent at 10
    assert!(holds("distance = [{ of = \"pair\", to = [0, 3], at_most = 10.4, when = \"ever\" }]"));
    assert!(!holds("distance = [{ of = \"pair\", to = [0, 3], at_most = 9.5, when = \"ever\" }]"));
    assert!(holds("distance = [{ of = \"pair\", to = \"pair\", at_least = 9.0, when = \"always\" }]"));
    assert!(holds("speed = [{ of = \"pair\", at_most = 0.01 }, { of = \"pair\", at_least = 1.0, when = \"ever\" }]"));
    assert!(holds("order = [{ of = \"pair\", at_least = 0.95 }]"), "both agents moved in the same direction");
    let verdict = scene("distance = [{ of = \"pair\", to = [0, 3, 4], at_least = 5 }]");
    assert_eq!(verdict.checks[0].name, "distance.0.at_least");
}

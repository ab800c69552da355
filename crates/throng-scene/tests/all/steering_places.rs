//! Steering around walls and along paths in scenes becomes the library's behaviours.

use glam::{DVec2, Vec2, Vec3};
use std::sync::Arc;
use throng::parameters::Angle;
use throng::space::surface::{Barrier, Surface};
use throng::space::{PathDirection, Pathway, Raster};
use throng::steer::{Barriers, BoxedBehaviour, Target};
use throng_scene::{Kind, Plan, Scene};
use throng_steer::Whisker;

const PLACE: &str = r#"
[walkable.polygon]
outer = [[90, 40], [110, 40], [110, 60], [90, 60]]
holes = [[[104, 44], [106, 44], [106, 46], [104, 46]]]

[[obstacle]]
name = "pillar"
shape.circle = { center = [95, 55], radius = 1 }

[[obstacle]]
shape.wall = [[92, 42], [95, 42]]

[[surface]]
name = "dome"
shape.sphere = { radius = 8 }
at = [100, 50]
seen_from = "inside"

[[path]]
name = "beat"
points = [[95, 45], [105, 50], [95, 50]]
radius = 1

[[group]]
place.point = [100, 50]
"#;

fn scene(steer: &str) -> Scene {
    format!("{PLACE}steer.{steer}\n").parse().unwrap_or_else(|error| panic!("{steer}: {error}"))
}

fn plan(scene: &Scene) -> Plan {
    scene.plan().unwrap_or_else(|error| panic!("{error}"))
}

type Side = Barrier<Arc<dyn Surface>>;

/// Returns the edges of the ground, the obstacles, the surfaces.
fn sides() -> (Vec<Side>, Vec<Side>, Vec<Side>) {
    let plan = plan(&scene("wander = {}"));
    let origin = plan.settings.origin;
    assert_eq!(origin, DVec2::new(100.0, 50.0));
    let obstacles = plan.obstacles.iter().map(|obstacle| Barrier::of_obstacle(obstacle, origin).unwrap());
    (Barrier::of_ground(&plan.walkable, origin).unwrap(), obstacles.collect(), plan.surfaces)
}

fn everything() -> Barriers {
    let (edges, obstacles, surfaces) = sides();
    Barriers([edges, obstacles, surfaces].concat())
}

#[track_caller]
fn assert_steers(said: &str, expected: impl Into<BoxedBehaviour>) {
    let scene = scene(said);
    let branch = plan(&scene).groups[0].guidance.behaviour.clone().expect("it steers");
    assert_eq!(format!("{branch:?}"), format!("{:?}", expected.into()), "{said}");
    let text = scene.to_toml().unwrap();
    assert_eq!(text.parse::<Scene>().unwrap(), scene, "{text}");
}

fn beat() -> Pathway {
    Pathway::new(&[Vec3::new(-5.0, -5.0, 0.0), Vec3::new(5.0, 0.0, 0.0), Vec3::new(-5.0, 0.0, 0.0)], 1.0, false)
        .unwrap()
}

#[test]
fn what_is_not_said_is_the_librarys_default() {
    assert_steers("avoid_obstacles = {}", throng_steer::AvoidObstacles::from(everything()));
    assert_steers(
        "whiskers = {}",
        throng_steer::Whiskers { obstacles: everything(), ..throng_steer::Whiskers::default() },
    );
    assert_steers("follow_wall = {}", throng_steer::FollowWall::from(everything()));
    assert_steers(
        "hide = { from = \"goal\" }",
        throng_steer::Hide { obstacles: everything(), ..throng_steer::Hide::new(Target::Goal) },
    );
    let dome = sides().2.remove(0);
    assert_steers("contain = { surface = \"dome\" }", throng_steer::Contain::on_side(dome.surface, dome.seen_from));
    assert_steers("follow_path = { path = \"beat\" }", throng_steer::FollowPath::new(beat()));
    assert_steers("stay_on_path = { path = \"beat\" }", throng_steer::StayOnPath::new(beat()));
    assert_steers("crowd_path = { path = \"beat\" }", throng_steer::CrowdPath::new(beat()));
    let door = Target::Point(Vec3::X);
    assert_steers(
        "queue_at_door = { door = [101, 50] }",
        throng_steer::QueueAtDoor { obstacles: everything(), ..throng_steer::QueueAtDoor::new(door) },
    );
}

/// The map is solid within half a cell of the ground's edges, the pillar and the wall; the dome is a container.
#[test]
fn a_map_has_what_is_solid_or_beyond_a_cage() {
    let near = |low: Vec2, high: Vec2, at: Vec2| at.distance(at.clamp(low, high)) < 0.5;
    let solid = |at: Vec2| {
        let square = near(Vec2::new(4.0, -6.0), Vec2::new(6.0, -4.0), at);
        let wall = near(Vec2::new(-8.0, -8.0), Vec2::new(-5.0, -8.0), at);
        square || wall || at.distance(Vec2::new(-5.0, 5.0)) < 1.5 || at.abs().max_element() > 9.5 || at.length() > 7.5
    };
    let map = Raster::of(Vec2::splat(-10.75), Vec2::splat(11.25), 1.0, solid).unwrap();
    let drive = throng_steer::DriveByMap::new(Arc::new(map), throng_steer::Wander::default());
    let corners = "min = [89.25, 39.25], max = [111.25, 61.25]";
    assert_steers(&format!("avoid_map = {{ {corners}, of.wander = {{}} }}"), drive.clone());
    assert_steers(
        &format!("avoid_map = {{ {corners}, horizon = 3, margin = 0.5, curved = false, of.wander = {{}} }}"),
        throng_steer::DriveByMap { horizon: 3.0, margin: 0.5, curved: false, ..drive },
    );
}

#[test]
fn what_is_said_is_so() {
    let (edges, obstacles, surfaces) = sides();
    let east = Target::Point(Vec3::X);
    assert_steers(
        "avoid_obstacles = { obstacles = \"pillar\", towards = [101, 50], horizon = 3, gap = 0.5, keeps = 0 }",
        throng_steer::AvoidObstacles {
            towards: east,
            horizon: 3.0,
            gap: 0.5,
            keeps: 0.0,
            ..Barriers(vec![obstacles[0].clone()]).into()
        },
    );
    assert_steers(
        "whiskers = { obstacles = [\"dome\", \"pillar\"], rays = [{ length = 2, beside = 0.2 }, { length = 1, angle = 90 }], clearance = 0.5 }",
        throng_steer::Whiskers {
            obstacles: Barriers(vec![surfaces[0].clone(), obstacles[0].clone()]),
            rays: vec![
                Whisker { beside: 0.2, ..Whisker::new(2.0) },
                Whisker { angle: Angle::degrees(90.0), ..Whisker::new(1.0) },
            ],
            clearance: 0.5,
        },
    );
    assert_steers(
        "contain = { surface = \"dome\", horizon = 2, angle = 90, gap = 0.3 }",
        throng_steer::Contain {
            horizon: 2.0,
            angle: Angle::degrees(90.0),
            gap: 0.3,
            ..throng_steer::Contain::on_side(surfaces[0].surface.clone(), surfaces[0].seen_from)
        },
    );
    let back = throng_steer::FollowPath {
        direction: PathDirection::Backward,
        horizon: 2.0,
        slowing_distance: 3.0,
        inner: 0.5,
        ..throng_steer::FollowPath::new(beat())
    };
    assert_steers(
        "follow_path = { path = \"beat\", direction = \"backward\", horizon = 2, slowing_distance = 3, inner = 0.5 }",
        back,
    );
    assert_steers(
        "stay_on_path = { path = \"beat\", horizon = 0 }",
        throng_steer::StayOnPath { path: Arc::new(beat()), horizon: 0.0 },
    );
    let solid = Barriers([edges, obstacles].concat());
    assert_steers(
        "follow_wall = { obstacles = \"obstacles\", offset = 0.5, horizon = 1, range = 2 }",
        throng_steer::FollowWall { obstacles: solid.clone(), offset: 0.5, horizon: 1.0, range: 2.0 },
    );
    assert_steers(
        "hide = { from = [101, 50], obstacles = \"obstacles\", gap = 1, range = 9, slowing_distance = 2 }",
        throng_steer::Hide {
            obstacles: solid.clone(),
            gap: 1.0,
            range: 9.0,
            slowing_distance: 2.0,
            ..throng_steer::Hide::new(east)
        },
    );
    assert_steers(
        "crowd_path = { path = \"beat\", direction = \"backward\", horizon = 1 }",
        throng_steer::CrowdPath { path: Arc::new(beat()), direction: PathDirection::Backward, horizon: 1.0 },
    );
    assert_steers(
        "queue_at_door = { goal = [101, 50], door = \"goal\", obstacles = \"obstacles\" }",
        throng_steer::QueueAtDoor { goal: east, door: Target::Goal, obstacles: solid },
    );
}

#[test]
fn mistakes_are_named() {
    for (said, kind, message, hint) in [
        (
            "avoid_obstacles = { obstacles = \"dom\" }",
            Kind::UnknownKey,
            "there is no surface or obstacle `dom`",
            "there is: dome, pillar",
        ),
        (
            "hide = { from = \"goal\", obstacles = [\"pillar\", \"oak\"] }",
            Kind::UnknownKey,
            "no surface or obstacle `oak`",
            "dome, pillar",
        ),
        (
            "follow_wall = { obstacles = [] }",
            Kind::MissingKey,
            "this list of names is empty",
            "leave it out, or name what counts",
        ),
        ("contain = { surface = \"pillar\" }", Kind::UnknownKey, "there is no surface `pillar`", "there is: dome"),
        ("follow_path = { path = \"round\" }", Kind::UnknownKey, "there is no path `round`", "there is: beat"),
        ("avoid_obstacles = { gap = -1 }", Kind::OutOfRange, "gap is -1, but must be 0 or more", ""),
        ("avoid_obstacles = { keeps = -1 }", Kind::OutOfRange, "keeps is -1, but must be 0 or more", ""),
        ("avoid_obstacles = { horizon = 0 }", Kind::OutOfRange, "horizon is 0", ""),
        ("whiskers = { rays = [{ length = 0 }] }", Kind::OutOfRange, "length is 0, but must be more than 0", ""),
        ("whiskers = { rays = [{ length = 1, angle = 200 }] }", Kind::OutOfRange, "must be from -180 to 180", ""),
        ("contain = { surface = \"dome\", angle = 200 }", Kind::OutOfRange, "must be from 0 to 180", ""),
        ("follow_path = { path = \"beat\", horizon = 0 }", Kind::OutOfRange, "horizon is 0", ""),
        ("crowd_path = { path = \"beat\", horizon = 0 }", Kind::OutOfRange, "horizon is 0", ""),
        ("stay_on_path = { path = \"beat\", horizon = -1 }", Kind::OutOfRange, "horizon is -1", ""),
        ("follow_wall = { offset = 0 }", Kind::OutOfRange, "offset is 0", ""),
        ("hide = { from = \"goal\", range = 0 }", Kind::OutOfRange, "range is 0", ""),
        (
            "wander = {}\nsolid = [\"dome\", \"oak\"]",
            Kind::UnknownKey,
            "there is no surface or obstacle `oak`",
            "there is: dome, pillar",
        ),
        ("wander = {}\nsolid = []", Kind::MissingKey, "this list of names is empty", "leave out `solid` for nothing"),
        ("wander = {}\nwrap_around = { radius = 0 }", Kind::OutOfRange, "radius is 0", ""),
        (
            "wander = {}\nwrap_around = { center = [0, 0, -5], radius = 9 }",
            Kind::OutOfRange,
            "must be from 0 to 20000",
            "",
        ),
    ] {
        let error = scene(said).plan().expect_err(said);
        let text = error.to_string();
        assert_eq!(error.kind, kind, "{said}: {text}");
        assert!(text.contains(message), "{said}: {text}");
        assert!(error.hint.unwrap_or_default().contains(hint), "{said}: {text}");
        assert!(error.line.is_some(), "{said}: {text}");
    }
    let named: Scene = PLACE.replace("\"dome\"", "\"everything\"").parse().unwrap();
    assert!(named.plan().unwrap_err().to_string().contains("the name `everything` means something else"));
}

#[test]
fn solids_keep_agents_out() {
    let scene = |solid: &str| -> Scene {
        format!(
            "time = {{ step = 0.1, until = \"limit\", limit = 9 }}\n[[surface]]\nname = \"ball\"\nshape.sphere = {{ radius = 1 }}\n\
             at = [104, 50]\n[[surface]]\nname = \"cage\"\nshape.sphere = {{ radius = 9 }}\nat = [100, 50]\n\
             seen_from = \"inside\"\n[[obstacle]]\nname = \"post\"\nshape.circle = {{ center = [100, 57], radius = 0.5 }}\n\
             [[group]]\nplace.point = [100, 50]\nheading = 0\nbody.radius = 0.25\nvehicle.max_speed = 2\n\
             steer.move_forward = {{ part = 1 }}\n{solid}"
        )
        .parse()
        .unwrap()
    };
    let solids = |said: &str| scene(said).plan().unwrap().groups[0].solid.0.len();
    let all = ["", "solid = \"ball\"", "solid = [\"ball\", \"cage\", \"post\"]", "solid = \"everything\""];
    assert_eq!(all.map(solids), [0, 1, 3, 3]);
    let run = |said: &str| {
        let (mut world, _) = scene(said).build().unwrap();
        (0..90).for_each(|_| world.step());
        let x = f64::from(world.relative_columns().position[0].x) + world.settings().origin.x;
        (x, world.summary())
    };
    let (free, summary) = run("");
    assert!(free > 110.0 && summary.least_wall_separation.is_infinite(), "{free}: {summary:?}");
    let (held, summary) = run("solid = [\"ball\", \"cage\"]");
    assert!(held < 109.0 - 0.25 + 1e-4 && summary.overlaps == 0, "{held}: {summary:?}");
    assert!((0.9999..1.1).contains(&summary.least_wall_separation), "{summary:?}");
}

#[test]
fn an_agent_that_leaves_the_ball_enters_on_the_other_side() {
    let steers = "vehicle = { max_speed = 2 }\nsteer.move_forward = { part = 1 }\n";
    let walks = "speed = { preferred = 2, max = 2 }\ngoal.point = [120, 50]\n";
    let solid = "solid = \"ball\"\n[[surface]]\nname = \"ball\"\nshape.sphere = { radius = 1 }\nat = [101, 53]\n";
    for said in [steers.to_owned(), format!("{steers}guard = true\n"), walks.to_owned(), format!("{steers}{solid}")] {
        let scene: Scene = format!(
            "time = {{ step = 0.1, until = \"limit\", limit = 9 }}\n[[group]]\nplace.point = [100, 50]\nheading = 0\n\
             wrap_around = {{ center = [101, 50], radius = 4 }}\n{said}"
        )
        .parse()
        .unwrap();
        let (mut world, _) = scene.build().unwrap();
        let (mut before, mut jumps) = (100.0, 0);
        for _ in 0..120 {
            world.step();
            let x = world.relative_columns().position[0].x as f64 + world.settings().origin.x;
            assert!((97.0 - 1e-5..=105.0 + 1e-5).contains(&x), "{x}: {said}");
            let went = x - before;
            if went < 0.0 {
                assert!((7.7..=8.1).contains(&-went), "by a diameter, less what it walked: {went}");
                jumps += 1;
            }
            before = x;
            assert!(
                (world.relative_columns().velocity[0].x - 2.0).abs() < 0.01 || world.time() < 3.0,
                "as if nothing had happened: {said}"
            );
        }
        assert!((2..=3).contains(&jumps), "{jumps} times in 24 m: {said}");
    }
}

#[test]
fn distances_to_surfaces_and_paths_are_measured() {
    let scene: Scene = format!(
        "time = {{ until = \"limit\", limit = 1 }}\n{PLACE}vehicle.max_speed = 1\nsteer.arrive = {{ target = [101, 50] }}\n\
         [expect]\ndistance = [\n\
         {{ to = \"dome\", at_least = 6.9, at_most = 8.1, when = \"always\" }},\n\
         {{ to = \"dome\", at_least = 8.1 }},\n\
         {{ to = \"beat\", at_most = 0.01, when = \"always\" }},\n]\n"
    )
    .parse()
    .unwrap();
    let (mut world, built) = scene.build().unwrap();
    let mut watch = throng_scene::Expectations::new(&scene.expect, &world, &built);
    while !scene.time.over(&world) {
        world.step();
        watch.step(&world);
    }
    let verdict = watch.verdict(&world);
    let passed: Vec<bool> = verdict.checks.iter().map(|check| check.passed).collect();
    assert_eq!(passed, [true, true, false, true], "{verdict}");
}

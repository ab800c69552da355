//! Changes of running scenes: what they do, and that a run with the same changes gives the same bits.

use throng::World;
use throng_scene::{
    AddAgents, Change, Intervention, Interventions, Led, NewGoal, Obstacle, Push, Scene, Shape, gallery,
};

const HALL: &str = r#"
[time]
step = 0.05
limit = 60

[[obstacle]]
shape.wall = [[5, -4], [5, 4]]

[[group]]
name = "people"
count = 12
place.grid = { center = [0, 0], rows = 4, columns = 3, spacing = 1 }
goal.point = [10, 0]
"#;

fn made(time: f64, change: Change) -> Intervention {
    Intervention { time, change }
}

/// Steps a world and makes interventions as they come, as a user does. Returns the hash after each step.
fn intervened(scene: &Scene, made: &[Intervention], steps: usize) -> Vec<u64> {
    let (mut world, built) = scene.build().unwrap();
    let mut record = Interventions::default();
    let hashes = (0..steps).map(|_| {
        world.step();
        let known = made.iter().filter(|made| made.time <= world.time() + 1e-9).cloned().collect();
        record = built.interventions.with(scene, known).unwrap();
        let _ = record.act(&mut world);
        world.state_hash()
    });
    hashes.collect()
}

/// Runs a scene. Every third run goes on from a saved state, in another world. Returns the hash after each step.
fn run(scene: &Scene, steps: usize, saves: bool) -> Vec<u64> {
    let (mut world, _) = scene.build().unwrap();
    let hashes = (0..steps).map(|k| {
        if saves && k % 7 == 3 {
            let bytes = world.save();
            world = scene.build().unwrap().0;
            world.load(&bytes).unwrap();
        }
        world.step();
        world.state_hash()
    });
    hashes.collect()
}

/// Returns a random number from 0 to 1 (a linear congruential generator).
fn draw(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1u64 << 53) as f64
}

fn random_changes(scene: &Scene, seed: u64) -> Vec<Intervention> {
    let mut state = seed;
    let (group, dt) = (scene.build().unwrap().1.groups[0].name.clone(), scene.time.step);
    let mut all: Vec<Intervention> = (0..8)
        .map(|k| {
            let mut at = || [12.0 * draw(&mut state) - 6.0, 12.0 * draw(&mut state) - 6.0];
            let (from, to) = (at(), at());
            let path: Vec<_> = (0..9).map(|i| [from[0] + 0.1 * f64::from(i), from[1]]).collect();
            let change = match k {
                0 => Change::Add(AddAgents { group: group.clone(), count: 5, at: from, radius: None }),
                1 => Change::Remove(2),
                2 => Change::Grab(Led { agent: 1, path }),
                3 => Change::Lead(Led { agent: 3, path }),
                4 => Change::Push(Push { path, radius: 2.0 }),
                5 => Change::Goal(NewGoal { group: group.clone(), point: to }),
                6 => Change::Obstacle(Obstacle::from(Shape::Wall(vec![from, to]))),
                _ => Change::Open(0),
            };
            made(dt * (1.0 + (draw(&mut state) * 50.0).floor()), change)
        })
        .collect();
    all.sort_by(|a, b| a.time.total_cmp(&b.time));
    // a door opens after it was added
    if let Some(k) = all.iter().position(|made| made.change == Change::Open(0)) {
        let door = all.remove(k);
        all.push(made(dt * 55.0, door.change));
        all.push(made(dt * 60.0, Change::Close(0)));
    }
    all
}

#[test]
fn a_run_with_the_recorded_interventions_gives_the_bits_of_the_live_run() {
    for name in ["circle", "crossing", "boids", "soccer", "bottleneck"] {
        for seed in 1..=3 {
            let scene = gallery::scene(name).unwrap();
            let record = random_changes(&scene, seed);
            let live = intervened(&scene, &record, 80);
            let replay = Scene { interventions: record, ..scene.clone() };
            assert_eq!(run(&replay, 80, false), live, "{name} {seed}");
            assert_eq!(run(&replay, 80, true), live, "{name} {seed}, from saved states");
            assert_ne!(run(&scene, 80, false), live, "{name} {seed}");
            // the text of the scene holds them
            let text = toml::to_string(&replay).unwrap();
            assert_eq!(Scene::parse("again.toml", &text).unwrap().interventions, replay.interventions);
        }
    }
}

fn hall(made: Vec<Intervention>) -> Scene {
    Scene { interventions: made, ..Scene::parse("hall.toml", HALL).unwrap() }
}

fn after(scene: &Scene, seconds: f64) -> World {
    let (mut world, _) = scene.build().unwrap();
    while world.time() < seconds {
        world.step();
    }
    world
}

fn beyond(world: &World, x: f64) -> usize {
    world.agents().filter(|agent| agent.position().x > x).count()
}

#[test]
fn walls_hold_people_and_doors_let_them_pass() {
    let closed = Shape::Wall(vec![[3.0, -30.0], [3.0, 30.0]]);
    let wall = || made(0.5, Change::Obstacle(closed.clone().into()));
    assert_eq!(beyond(&after(&hall(vec![]), 14.0), 5.0), 12);
    assert_eq!(beyond(&after(&hall(vec![wall()]), 14.0), 3.0), 0);
    // the wall that was added is obstacle 1
    let opened = after(&hall(vec![wall(), made(6.0, Change::Open(1))]), 24.0);
    assert_eq!((beyond(&opened, 5.0), opened.place().obstacles().count()), (12, 1));
    let again = after(&hall(vec![wall(), made(0.6, Change::Open(1)), made(0.8, Change::Close(1))]), 14.0);
    assert_eq!((beyond(&again, 3.0), again.place().obstacles().count()), (0, 2));
}

#[test]
fn agents_are_added_moved_led_and_driven_away() {
    let add = Change::Add(AddAgents { group: "people".into(), count: 100, at: [-12.0, 0.0], radius: None });
    let world = after(&hall(vec![made(1.0, add)]), 1.0);
    assert_eq!((world.agents().len(), world.overlapping().len()), (112, 0));
    assert_eq!(world.agents().filter(|agent| agent.position().x < -6.0).count(), 100);

    let path = vec![[-3.0, -3.0]; 20];
    let world = after(&hall(vec![made(1.0, Change::Grab(Led { agent: 5, path }))]), 1.5);
    let grabbed = world.agents().find(|agent| agent.number() == 5).unwrap().position();
    assert!((grabbed - glam::dvec3(-3.0, -3.0, 0.0)).length() < 1e-5, "{grabbed}");

    let path = vec![[-6.0, 3.0]; 200];
    let world = after(&hall(vec![made(1.0, Change::Lead(Led { agent: 5, path }))]), 9.0);
    let led = world.agents().find(|agent| agent.number() == 5).unwrap().position();
    assert!((led - glam::dvec3(-6.0, 3.0, 0.0)).length() < 0.3, "{led}");
    let world = after(&hall(vec![made(1.0, Change::Lead(Led { agent: 5, path: vec![[-6.0, 3.0]; 20] }))]), 20.0);
    assert_eq!(beyond(&world, 5.0), 12, "an agent that is no longer led walks to its goal");

    let push = Change::Push(Push { path: vec![[0.0, 0.0]; 60], radius: 3.0 });
    let world = after(&hall(vec![made(0.0, push)]), 3.0);
    let near = world.agents().filter(|agent| agent.position().length() < 2.5).count();
    assert_eq!(near, 0);
    assert_eq!(world.overlapping().len(), 0);

    let world = after(
        &hall(vec![
            made(0.0, Change::Remove(0)),
            made(1.0, Change::Goal(NewGoal { group: "people".into(), point: [-9.0, 0.0] })),
        ]),
        25.0,
    );
    assert_eq!(world.agents().filter(|agent| agent.position().x < -7.0).count(), 11);
}

#[test]
fn wrong_interventions_are_named_with_their_place() {
    let says = |text: &str| {
        let scene = Scene::parse("hall.toml", format!("{HALL}\n[[intervention]]\n{text}\n"));
        scene.and_then(|scene| scene.build().map(drop)).unwrap_err().to_string()
    };
    for (text, wanted) in [
        ("time = -1\nchange.open = 0", "time is -1"),
        ("time = 1\nchange.open = 1", "there is no obstacle 1"),
        ("time = 1\nchange.goal = { group = \"pepole\", point = [0, 0] }", "there is no group `pepole`"),
        ("time = 1\nchange.add = { group = \"people\", count = 0, at = [0, 0] }", "count is 0"),
        ("time = 1\nchange.grab = { agent = 1, path = [] }", "the path has no point"),
        ("time = 1\nchange.push = { path = [[0, 0]], radius = 0 }", "radius is 0"),
        ("time = 1\nchange.obstacle = { shape.polygon = [[0, 0], [1, 0]] }", "2 corners"),
        ("time = 0\nchange.obstacle = { shape.circle = { center = [0, 0], radius = 3 } }", "inside"),
        ("time = 1\nchange.fly = 2", "fly"),
    ] {
        let error = says(text);
        assert!(error.contains(wanted) && error.contains("hall.toml"), "{text}\n{error}");
    }
}

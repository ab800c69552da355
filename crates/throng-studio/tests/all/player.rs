//! The player: a step has the same state whichever way it is reached.

use glam::Vec3;
use std::sync::Arc;
use std::time::{Duration, Instant};
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
use throng_scene::{Scene, gallery};
use throng_studio::play::{Command, Engine, RunMoment, Speed, ThreadedEngine, Trouble};

fn load(name: &str, run: bool) -> Command {
    Command::Load { name: name.into(), scene: Arc::new(gallery::scene(name).unwrap()), run }
}

/// Works until nothing is left to do.
fn settle(engine: &mut Engine) -> Arc<RunMoment> {
    while engine.idle().is_some() {
        engine.work(Duration::from_millis(50));
    }
    engine.work(Duration::from_millis(50));
    engine.shown().unwrap()
}

fn at(engine: &mut Engine, step: u64) -> u64 {
    engine.command(Command::Seek(step));
    let shown = settle(engine);
    assert_eq!((shown.step, shown.playing), (step, false));
    assert_eq!(shown.frame.time, shown.step as f64 * shown.scene.time.step, "the frame is that of the step");
    shown.hash
}

#[test]
fn every_way_to_a_step_gives_the_same_state() {
    for name in ["circle", "boids", "capture-the-flag"] {
        let scene = gallery::scene(name).unwrap();
        let (mut world, _) = scene.build().unwrap();
        let hashes: Vec<u64> = (0..=100)
            .map(|k| {
                if k > 0 {
                    world.step()
                }
                world.state_hash()
            })
            .collect();
        let mut engine = Engine::default();
        engine.command(load(name, false));
        for step in [100, 99, 37, 38, 0, 64, 3, 100] {
            assert_eq!(at(&mut engine, step), hashes[step as usize], "{name} at {step}");
        }
        engine.command(Command::Back);
        assert_eq!(settle(&mut engine).hash, hashes[99], "{name} after one step back");
        engine.command(Command::Step);
        assert_eq!(settle(&mut engine).hash, hashes[100], "{name} after one step forward");
        engine.command(Command::Restart);
        assert_eq!(settle(&mut engine).hash, hashes[0], "{name} after a restart");
    }
}

/// The wake of a step, published while the engine works for at most `budget` at a time.
fn wake(step: u64, budget: Duration) -> Vec<(f64, Vec<glam::DVec2>)> {
    let mut engine = Engine::default();
    engine.command(load("circle", false));
    engine.command(Command::Seek(step));
    while engine.idle().is_some() {
        engine.work(budget);
        let shown = engine.shown().unwrap();
        assert_eq!(shown.arriving, shown.step < step, "step {}", shown.step);
        assert!(!shown.arriving || shown.wake.is_empty(), "step {} of {step}", shown.step);
    }
    let shown = engine.shown().unwrap();
    assert!(shown.wake.last().is_some_and(|last| Arc::ptr_eq(last, &shown.frame)));
    shown.wake.iter().map(|frame| (frame.time, frame.bodies.iter().map(|body| body.position).collect())).collect()
}

#[test]
fn the_way_to_a_step_does_not_depend_on_the_speed_of_the_machine() {
    let (mut world, _) = gallery::scene("circle").unwrap().build().unwrap();
    let fast = wake(300, Duration::from_secs(100));
    assert_eq!(fast, wake(300, Duration::from_micros(50)), "in small parts");
    // ten seconds, and the step itself
    assert_eq!(fast.len(), 251);
    let mut frame = throng_record::Frame::default();
    for step in 1..=300 {
        world.step();
        if let Some((time, positions)) = (step >= 50).then(|| &fast[step - 50]) {
            throng_record::moment::capture(&world, &mut frame);
            assert_eq!(*time, frame.time);
            assert!(frame.bodies.iter().map(|body| body.position).eq(positions.iter().copied()), "step {step}");
        }
    }
}

#[test]
fn an_explanation_does_not_change_the_run() {
    let mut engine = Engine::default();
    engine.command(load("circle", false));
    let plain = at(&mut engine, 60);
    engine.command(Command::Explain(Some(4)));
    engine.command(Command::Restart);
    assert_eq!(at(&mut engine, 60), plain);
    let shown = engine.shown().unwrap();
    assert_eq!(shown.explanation.as_ref().map(|why| why.number), Some(4));
    assert_eq!(shown.frame.accounts.len(), 1);
}

#[test]
fn circle_runs_to_its_end_and_begins_again() {
    let mut engine = Engine::default();
    engine.command(Command::Speed(Speed::Fastest));
    engine.command(load("circle", true));
    let shown = settle(&mut engine);
    assert_eq!((shown.frame.arrived, shown.over, shown.playing), (36, true, false));
    let run = shown.run;
    engine.command(Command::Run);
    let shown = engine.shown().unwrap();
    assert!(shown.run > run && shown.playing && shown.step == 0);
}

#[test]
fn another_seed_is_another_run() {
    let mut engine = Engine::default();
    engine.command(load("boids", false));
    let first = at(&mut engine, 5);
    engine.command(Command::Seed(77));
    assert_ne!(at(&mut engine, 5), first);
    assert_eq!(engine.shown().unwrap().seed, 77);
}

#[test]
fn a_scene_that_cannot_be_built_leaves_the_one_before() {
    let mut engine = Engine::default();
    engine.command(load("circle", false));
    let text = gallery::text("circle").unwrap().replace("count = 36", "count = 3600");
    let scene = Arc::new(Scene::parse("crowded.toml", text).unwrap());
    engine.command(Command::Load { name: "crowded".into(), scene, run: true });
    assert!(matches!(engine.trouble(), Some(Trouble::Scene(error)) if error.at.is_some()), "{:?}", engine.trouble());
    let shown = engine.shown().unwrap();
    assert_eq!((&*shown.name, shown.playing), ("circle", false));
    assert_eq!(at(&mut engine, 10), engine.shown().unwrap().hash);
}

/// A behaviour that panics beyond x = 1 m.
#[derive(Debug)]
struct Faulty;

impl Behaviour for Faulty {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        assert!(view.position().x < 1.0, "a metre is enough");
        Some(view.reach(Vec3::X * view.vehicle.max_speed))
    }
}

#[test]
fn a_panic_in_a_scene_is_told() {
    let text = "[[group]]\nplace.point = [0, 0]\nvehicle = { kind = \"level\", max_speed = 2.0 }\nsteer.faulty = {}\n";
    let mut scene: Scene = text.parse().unwrap();
    scene.plugins.behaviours.add("faulty", |_| Ok(Faulty.into()));
    let mut engine = Engine::default();
    engine.command(Command::Load { name: "faulty".into(), scene: Arc::new(scene), run: false });
    engine.command(Command::Seek(500));
    let shown = settle(&mut engine);
    assert!(shown.step < 500 && !shown.playing);
    assert!(matches!(engine.trouble(), Some(Trouble::Panic(says)) if says.contains("a metre is enough")));
    engine.command(load("circle", false));
    assert_eq!(engine.trouble(), None);
    assert_eq!(at(&mut engine, 5), { engine.shown().unwrap().hash });
}

#[test]
fn a_thread_plays_while_the_window_waits_for_nothing() {
    let mut player = ThreadedEngine::start(|| ()).unwrap();
    assert!(player.shown().is_none());
    player.command(load("circle", true));
    let begin = Instant::now();
    while player.shown().is_none_or(|shown| shown.step < 5) {
        assert!(begin.elapsed() < Duration::from_secs(30), "it does not play");
        std::thread::sleep(Duration::from_millis(5));
    }
    player.command(Command::Pause);
    player.command(Command::Seek(500));
    while player.shown().is_none_or(|shown| shown.step != 500) {
        assert!(begin.elapsed() < Duration::from_secs(30), "it does not reach the step");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// A tuned run continues from its current state, like a world of the new scene that loads this state. Another place
/// starts a new run.
#[test]
fn a_run_goes_on_as_another_scene_says() {
    let scene = Arc::new(gallery::scene("circle").unwrap());
    let change = |scene: &Scene| Command::Change { name: "circle".into(), scene: Arc::new(scene.clone()) };
    let mut engine = Engine::default();
    engine.command(load("circle", false));
    at(&mut engine, 50);
    let mut other = Scene::clone(&scene);
    other.groups[0].avoid = Some(toml::from_str("hrvo = {}").unwrap());
    engine.command(change(&other));
    let (mut world, _) = scene.build().unwrap();
    (0..50).for_each(|_| world.step());
    let (mut expected, _) = other.build().unwrap();
    expected.load(&world.save()).unwrap();
    for step in 51..120 {
        expected.step();
        assert_eq!(at(&mut engine, step), expected.state_hash(), "at {step}");
    }
    assert_eq!(at(&mut engine, 16), {
        let (mut world, _) = scene.build().unwrap();
        (0..16).for_each(|_| world.step());
        world.state_hash()
    });
    other.groups[0].count = Some(12);
    engine.command(change(&other));
    let shown = settle(&mut engine);
    assert_eq!((shown.step, shown.frame.total), (0, 12));
}

/// Where the user wants no restarts, a change that the run cannot follow waits for one.
#[test]
fn a_change_waits_for_a_restart() {
    let mut engine = Engine::default();
    engine.command(load("circle", false));
    let hash = at(&mut engine, 50);
    engine.command(Command::Restarts(false));
    let mut other = gallery::scene("circle").unwrap();
    other.groups[0].count = Some(12);
    engine.command(Command::Change { name: "circle".into(), scene: Arc::new(other) });
    let shown = settle(&mut engine);
    assert_eq!((shown.step, shown.frame.total, shown.hash, shown.waits), (50, 36, hash, true));
    engine.command(Command::Step);
    assert_eq!(settle(&mut engine).step, 51, "the run goes on");
    engine.command(Command::Restart);
    let shown = settle(&mut engine);
    assert_eq!((shown.step, shown.frame.total, shown.waits), (0, 12, false));
}

/// States saved before the behaviours changed cannot be loaded. Loadable states remain reachable.
#[test]
fn going_back_beyond_other_behaviours_stays_where_it_is() {
    let mut scene = gallery::scene("wander").unwrap();
    let mut engine = Engine::default();
    engine.command(load("wander", false));
    at(&mut engine, 30);
    scene.groups[0].steer = Some(toml::from_str("seek = { target = [0.0, 0.0] }").unwrap());
    engine.command(Command::Change { name: "wander".into(), scene: Arc::new(scene) });
    engine.command(Command::Step);
    assert_eq!(settle(&mut engine).step, 31);
    engine.command(Command::Seek(3));
    let shown = settle(&mut engine);
    assert!(shown.step >= 3 && engine.trouble().is_none(), "{}", shown.step);
    engine.command(Command::Step);
    settle(&mut engine);
}

/// Of two runs, each ends at the step at which it ends alone.
#[test]
fn two_runs_side_by_side_end_as_they_end_alone() {
    let scene = gallery::scene("circle").unwrap();
    let end = |scene: Scene| {
        let mut engine = Engine::default();
        engine.command(Command::Speed(Speed::Fastest));
        engine.command(Command::Load { name: "circle".into(), scene: Arc::new(scene), run: true });
        let shown = settle(&mut engine);
        (shown.step, shown.hash)
    };
    for model in ["hrvo", "rvo"] {
        let alone = [end(scene.clone()), end(scene.with_model(&model.parse().unwrap()).unwrap())];
        assert_ne!(alone[0].0, alone[1].0);
        let mut engine = Engine::default();
        engine.command(Command::Speed(Speed::Fastest));
        engine.command(Command::Beside(model.parse().ok()));
        engine.command(load("circle", true));
        let shown = settle(&mut engine);
        let beside = shown.beside.as_ref().unwrap();
        assert_eq!([(shown.step, shown.hash), (beside.step, beside.hash)], alone, "{model}");
        assert!(shown.over && beside.over && !shown.playing);
        engine.command(Command::Seek(100_000));
        let shown = settle(&mut engine);
        assert_eq!([shown.step, shown.beside.as_ref().unwrap().step], [alone[0].0, alone[1].0]);
        assert_eq!(at(&mut engine, 50), settle(&mut engine).hash);
        assert_eq!(settle(&mut engine).beside.as_ref().unwrap().step, 50);
    }
}

/// Two models on one clock: each run is as if it were alone, whichever way a step is reached.
#[test]
fn what_is_beside_is_at_the_same_step() {
    let scene = gallery::scene("circle").unwrap().with_model(&"hrvo".parse().unwrap()).unwrap();
    let mut engine = Engine::default();
    engine.command(load("circle", false));
    let own = at(&mut engine, 40);
    engine.command(Command::Beside("hrvo".parse().ok()));
    for step in [40, 90, 12, 55] {
        at(&mut engine, step);
        let shown = engine.shown().unwrap();
        let beside = shown.beside.as_ref().unwrap();
        let (mut alone, _) = scene.build().unwrap();
        (0..step).for_each(|_| alone.step());
        assert_eq!((beside.step, beside.hash), (step, alone.state_hash()));
        assert_eq!(beside.frame.time, shown.frame.time);
        assert_ne!(beside.hash, shown.hash);
    }
    assert_eq!(at(&mut engine, 40), own, "the second model does not change the run");
    engine.command(Command::Beside(None));
    assert!(settle(&mut engine).beside.is_none());
}

//! Games: scenes with rules in Rust.

use throng::motion::Motor;
use throng::{Error as WorldError, Rules, World};
use throng_scene::{Expectations, Kind, Scene, gallery};

const GAMES: [&str; 4] = ["multiple-pursuit", "soccer", "capture-the-flag", "map-drive"];

fn game(name: &str) -> Scene {
    gallery::scene(name).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_game_is_the_same_kind_of_game_with_any_step() {
    for name in GAMES {
        for part in [0.5, 1.0, 1.5] {
            let mut scene = game(name);
            scene.time.step *= part;
            let (mut world, built) = scene.build().unwrap();
            let mut watch = Expectations::new(&scene.expect, &world, &built);
            while !scene.time.over(&world) {
                world.step();
                watch.step(&world);
            }
            let verdict = watch.verdict(&world);
            assert!(verdict.passed, "{name}, step {} s:\n{verdict}", scene.time.step);
            assert_eq!(world.refused(), None, "{name}");
        }
    }
}

#[test]
fn a_game_that_is_loaded_goes_on_with_the_same_bits() {
    for name in GAMES {
        let scene = game(name);
        let (mut original, _) = scene.build().unwrap();
        (0..400).for_each(|_| original.step());
        let (mut loaded, _) = scene.build().unwrap();
        loaded.load(&original.save()).unwrap();
        for step in 0..400 {
            original.step();
            loaded.step();
            assert_eq!(loaded.state_hash(), original.state_hash(), "{name}, {step} steps after loading");
        }
        assert_eq!(loaded.standing(), original.standing());
        // a world that is built again starts from the beginning
        let (again, _) = scene.build().unwrap();
        let (first, _) = scene.build().unwrap();
        assert_eq!(again.state_hash(), first.state_hash());
    }
}

/// The numbers of OpenSteerDemo's plug-ins.
#[test]
fn the_games_have_opensteers_numbers() {
    let vehicle = |name: &str, group: usize| {
        let plan = game(name).plan().unwrap();
        let agent = plan.agents.iter().find(|planned| planned.group == group).unwrap();
        let Motor::Vehicle(vehicle) = agent.agent.motor else { panic!("{name}: group {group} has no vehicle") };
        (vehicle.max_speed, vehicle.max_force)
    };
    let count = |name: &str, group: usize| {
        game(name).plan().unwrap().agents.iter().filter(|agent| agent.group == group).count()
    };
    assert_eq!((vehicle("multiple-pursuit", 0), vehicle("multiple-pursuit", 1)), ((3.0, 5.0), (3.0, 5.0)));
    assert_eq!((count("multiple-pursuit", 0), count("multiple-pursuit", 1)), (1, 30));
    assert_eq!((vehicle("soccer", 0).0, vehicle("soccer", 2).0), (10.0, 9.0));
    assert_eq!([0, 1, 2].map(|group| count("soccer", group)), [8, 8, 1]);
    assert_eq!((vehicle("capture-the-flag", 0), vehicle("capture-the-flag", 1)), ((3.0, 3.0), (3.0, 3.0)));
    assert_eq!([0, 1].map(|group| count("capture-the-flag", group)), [1, 4]);
    assert_eq!(game("capture-the-flag").obstacles.len(), 40);
    assert_eq!(
        (vehicle("map-drive", 0), game("map-drive").plan().unwrap().paths[0].segments().len()),
        ((20.0, 8.0), 9)
    );
    assert_eq!((count("low-speed-turn", 0), vehicle("low-speed-turn", 0)), (1, (1.5, 0.3)));
    let speeds: Vec<f32> =
        game("low-speed-turn").plan().unwrap().agents.iter().map(|agent| agent.agent.velocity.y).collect();
    assert!(speeds.iter().zip(0..5).all(|(speed, k)| (speed - 0.15 * k as f32).abs() < 1e-6), "{speeds:?}");
    assert_eq!(vehicle("one-turning", 0), (5.0, 0.3));
}

/// Counts steps.
#[derive(Debug)]
struct Clock(f64);

impl Rules for Clock {
    fn figures(&self) -> Vec<String> {
        vec!["ticks".into()]
    }

    fn act(&self, _: &mut World, figures: &mut [f64]) -> Result<(), WorldError> {
        figures[0] += self.0;
        Ok(())
    }
}

const PLAIN: &str = "rules = \"clock\"\n[[group]]\nname = \"they\"\nplace.point = [0, 0]\nsteer.wander = {}\n[expect]\nfigure = [{ of = \"ticks\", at_least = 4, at_most = 6 }]\n";

#[test]
fn a_program_brings_rules_of_its_own_and_expects_what_they_count() {
    for (each, passes) in [(0.3, false), (0.5, true), (0.7, false)] {
        let mut scene: Scene = PLAIN.parse().unwrap();
        scene.plugins.rules.add("clock", move |cast| {
            assert!(cast.group("they").is_ok() && cast.barriers().is_ok());
            Ok(Clock(each))
        });
        // the rules stay with the scene
        scene.set("seed", "5").unwrap();
        let (mut world, built) = scene.build().unwrap();
        let mut watch = Expectations::new(&scene.expect, &world, &built);
        for _ in 0..10 {
            world.step();
            watch.step(&world);
        }
        let verdict = watch.verdict(&world);
        assert_eq!(verdict.passed, passes, "{verdict}");
        assert_eq!(verdict.checks[0].name, "figure.0.at_least");
        assert_eq!(scene.to_toml().unwrap().parse::<Scene>().unwrap(), scene);
    }
}

#[test]
fn behaviours_change_when_a_figure_does() {
    let switch = "switch = { first = \"wait\", states = { go.of.target_speed.speed = 1, wait = { of.target_speed.speed = 0, \
                  exits = [{ to = \"go\", when.figure = { of = \"ticks\", at_least = 3 } }] } } }";
    let mut scene: Scene = PLAIN.replace("wander = {}", switch).parse().unwrap();
    scene.plugins.rules.add("clock", |_| Ok(Clock(1.0)));
    assert_eq!(scene.to_toml().unwrap().parse::<Scene>().unwrap(), scene);
    let (mut world, _) = scene.build().unwrap();
    let went: Vec<bool> = (0..5)
        .map(|_| {
            world.step();
            world.relative_columns().velocity[0].length() > 0.0
        })
        .collect();
    assert_eq!(went, [false, false, false, true, true], "after three");
}

#[test]
fn what_is_wrong_with_a_game_is_named() {
    let error = |text: &str, clock: bool| {
        let mut scene: Scene = text.parse().unwrap();
        if clock {
            scene.plugins.rules.add("clock", |_| Ok(Clock(1.0)));
        }
        scene.build().map(|_| ()).unwrap_err()
    };
    let unknown = error(PLAIN, false);
    assert_eq!((unknown.kind, unknown.at), (Kind::UnknownKey, Some((1, 9))));
    assert!(
        unknown.to_string().contains("there are no rules `clock`") && unknown.to_string().contains("soccer"),
        "{unknown}"
    );
    let figure = error(&PLAIN.replace("\"ticks\"", "\"tocks\""), true);
    assert!(
        figure.to_string().contains("there is no figure `tocks`") && figure.to_string().contains("keep: ticks"),
        "{figure}"
    );
    let exits = "switch = { first = \"a\", states.a = { of.wander = {}, exits = [{ to = \"a\", when.figure = { of = \"tocks\" } }] } }";
    let condition = error(&PLAIN.replace("wander = {}", exits), true);
    assert!(condition.to_string().contains("group `they`: there is no figure `tocks`"), "{condition}");
    let none = error(&PLAIN.replace("rules = \"clock\"\n", ""), true);
    assert!(none.to_string().contains("rules = \"NAME\""), "{none}");
    for (name, misses) in [("soccer", "there is no group `red`"), ("map-drive", "path `route`")] {
        let misfit = error(&PLAIN.replace("clock", name), false);
        assert_eq!(misfit.kind, Kind::World);
        assert!(misfit.to_string().contains(misses), "{misfit}");
    }
    let player = error(&PLAIN.replace("wander = {}", "capture-defender = {}"), true);
    assert!(player.to_string().contains("behaviour `capture-defender`: there is no group `seeker`"), "{player}");
    for (key, wrong) in
        [("start_speed = 2", "start_speed without a heading"), ("heading = 0\nstart_speed = -1", "0 to 1000")]
    {
        let error = error(&PLAIN.replace("steer.wander", &format!("{key}\nsteer.wander")), true);
        assert!(error.to_string().contains(wrong), "{error}");
    }
    let line = error(&PLAIN.replace("[expect]", "[view]\nlines = [[[0, 0]]]\n[expect]"), true);
    assert!(line.to_string().contains("a line with 1 point"), "{line}");
}

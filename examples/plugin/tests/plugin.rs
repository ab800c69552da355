//! Tests of the plug-in without a window.

use glam::DVec3;
use my_plugin::{Around, Spiral, Weave, plugins};
use throng::parameters::Angle;
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
use throng_scene::{AgentStart, Expectations, GoalRule, Placement, Purpose, Random};

#[test]
fn weaving_leans_to_both_sides_by_no_more_than_the_angle() {
    let weave = Weave { angle: Angle::degrees(30.0), period: 2.0 };
    let view = SteeringInput { seconds: 0.05, ..SteeringInput::default() };
    let mut memory = [0.25];
    let sides: Vec<f32> = (0..40)
        .filter_map(|_| weave.steer(&view, &mut memory, &mut TraceRecorder::default()))
        .map(|steering| steering.force.y)
        .collect();
    assert!(sides.iter().any(|&side| side > 0.1) && sides.iter().any(|&side| side < -0.1), "{sides:?}");
    assert!((memory[0] - 1.25).abs() < 1e-4, "two seconds are one swing: {}", memory[0]);
}

#[test]
fn a_spiral_is_as_dense_as_a_square_grid_of_its_spacing() {
    let spiral = Spiral { center: [3.0, -2.0], spacing: 0.8 };
    let mut random = Random::new(1, 0, 0, Purpose::Place);
    let spots: Vec<DVec3> = (0..500).filter_map(|k| spiral.position(k, 500, &mut random)).collect();
    let center = spiral.center().unwrap();
    let within = |radius: f64| spots.iter().filter(|spot| spot.distance(center) < radius).count() as f64;
    for radius in [2.0, 5.0, 9.0] {
        let expected = std::f64::consts::PI * radius * radius / (0.8 * 0.8);
        assert!((within(radius) - expected).abs() <= 1.0, "{radius}: {} of {expected}", within(radius));
    }
}

#[test]
fn the_goals_around_a_place_are_evenly_spaced() {
    let around = Around { radius: 5.0, ..Around::default() };
    let goal = |k: usize| {
        let agent = AgentStart { k, n: 6, at: DVec3::ZERO, center: DVec3::new(1.0, 2.0, 0.0) };
        around.goal(&agent, &mut Random::new(1, 0, k as u64, Purpose::Goal)).stops[0].0.middle()
    };
    // the sides of a hexagon are as long as its radius
    for k in 0..6 {
        assert!((goal(k).distance(goal((k + 1) % 6)) - 5.0).abs() < 1e-9, "{k}");
        assert!((goal(k).distance(glam::DVec2::new(1.0, 2.0)) - 5.0).abs() < 1e-9, "{k}");
    }
}

#[test]
fn the_scenes_show_what_they_should() {
    for name in ["crossroads", "seeds", "skaters", "sunflower"] {
        let scene = plugins().open(name).unwrap();
        let (mut world, built) = scene.build().unwrap();
        let mut watch = Expectations::new(&scene.expect, &world, &built);
        for _ in 0..1000 {
            world.step();
            watch.step(&world);
        }
        let verdict = watch.verdict(&world);
        assert!(verdict.passed, "{name}: {verdict}");
    }
}

#[test]
fn the_page_shows_this_plug_in() {
    let page = include_str!("../../../docs/plugins.md");
    for file in [
        include_str!("../src/main.rs"),
        include_str!("../src/lib.rs"),
        include_str!("../src/brake.rs"),
        include_str!("../src/weave.rs"),
        include_str!("../src/spiral.rs"),
        include_str!("../src/around.rs"),
        include_str!("../Cargo.toml"),
    ] {
        // the page shows the file from its first line after the comments
        let code: Vec<&str> = file
            .lines()
            .skip_while(|line| line.starts_with("//!") || line.starts_with('#') || line.is_empty())
            .collect();
        assert!(page.contains(&code.join("\n")), "docs/plugins.md does not show\n{}", code.join("\n"));
    }
    for command in include_str!("../README.md").lines().filter(|line| line.starts_with("cargo ")) {
        assert!(page.contains(command), "docs/plugins.md does not have `{command}`");
    }
}

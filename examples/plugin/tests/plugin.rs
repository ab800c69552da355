//! Tests of the plug-in without a window.

use my_plugin::{Weave, plugins};
use throng::parameters::Angle;
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
use throng_scene::Expectations;

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
fn the_scenes_show_what_they_should() {
    for name in ["crossroads", "skaters", "sunflower"] {
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

//! The behaviour of docs/behaviours.md in a scene: it runs, and the page shows it. The page itself is a test of
//! throng-steer.

use throng::motion::Steering;
use throng::parameters::parameters;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};
use throng_scene::{Plugins, Scene};

/// Flies to a light, rests near it, and sets out again.
#[parameters]
#[derive(Debug)]
struct Moth {
    /// The light.
    #[parameter(required)]
    light: Target,
    /// Seconds of rest.
    #[parameter(default = 2.0, unit = "s", least = 0)]
    rest: f32,
}

impl Behaviour for Moth {
    fn memory(&self) -> usize {
        1 // remaining seconds of rest
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        memory[0] -= view.seconds;
        if memory[0] > 0.0 {
            return None;
        }
        let light = self.light.find(view)?.position;
        if view.to(light).length() < 1.0 {
            memory[0] = self.rest * (0.5 + view.rng.draw(0));
        }
        why.note(|| SteeringReason::Aim(light));
        view.go(view.to(light))
    }
}

#[test]
fn the_scene_of_the_page_runs() -> Result<(), throng_scene::Error> {
    let mut scene: Scene = r#"
        [[group]]
        place.point = [0, 0]
        vehicle.max_speed = 1.5
        steer.priority = [{ close_avoidance = {} }, { moth = { light = [9, 0] } }, { wander = {} }]
    "#
    .parse()?;
    Plugins::new().behaviour::<Moth>().equip(&mut scene);
    let (mut world, _) = scene.build()?;
    (0..100).for_each(|_| world.step());
    assert!(world.agents().next().expect("the agent is present").position().x > 3.0);
    Ok(())
}

#[test]
fn the_page_shows_this_behaviour() {
    let page = include_str!("../../../../../docs/behaviours.md");
    super::assert_shown(page, "```rust,ignore\n", 1, include_str!("behaviour.rs"));
}

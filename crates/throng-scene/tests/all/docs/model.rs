//! The local model of docs/write-a-model.md: it runs, and the page shows it.

use glam::Vec2;
use std::sync::Arc;
use throng::avoid::{AvoidanceInput, LocalModel, Workspace};
use throng::parameters::{Value, parameters};
use throng::{Agent, Error, Group, Settings, World};

/// Keeps its direction, and brakes for the first agent that it would meet.
#[parameters]
#[derive(Clone, Copy, Debug)]
struct Brake {
    /// Seconds ahead within which it brakes.
    #[parameter(default = 2.0, unit = "s", above = 0)]
    horizon: f32,
}

impl LocalModel for Brake {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        let preferred = view.preferred.clamp_length_max(view.max_speed);
        let seconds = view.neighbours.iter().map(|other| other.time_to_collision(preferred - other.velocity));
        preferred * (seconds.fold(f32::INFINITY, f32::min) / self.horizon).min(1.0)
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

#[test]
fn the_model_of_the_page_runs() -> Result<(), Error> {
    // two agents cross; the guard keeps them apart if the model does not
    let mut world = World::new(Settings { step: 0.04, ..Settings::default() })?;
    let group = world.add_group(Group { model: Arc::new(Brake { horizon: 1.5 }), ..Group::default() })?;
    for (from, to) in [([-5.0, 0.0], [5.0, 0.0]), ([0.0, -4.0], [0.0, 6.0])] {
        world.add_agent(Agent::at(from).goal(to).group(group))?;
    }
    while !world.finished() && world.time() < 60.0 {
        world.step();
    }
    assert_eq!((world.summary().arrived, world.summary().overlaps), (2, 0));
    Ok(())
}

#[test]
fn the_scene_of_the_page_runs() -> Result<(), throng_scene::Error> {
    let mut scene: throng_scene::Scene = r#"
        [[group]]
        count = 12
        place.ring = { radius = 5 }
        goal.opposite = {}
        avoid.brake = { horizon = 1.5 }
    "#
    .parse()?;
    throng_scene::Plugins::new().model::<Brake>().equip(&mut scene);
    let (mut world, _) = scene.build()?;
    (0..500).for_each(|_| world.step());
    assert_eq!(world.summary().overlaps, 0);
    Ok(())
}

#[test]
fn the_page_shows_this_model() {
    let page = include_str!("../../../../../docs/write-a-model.md");
    super::assert_shown(page, "```rust\n", 2, include_str!("model.rs"));
}

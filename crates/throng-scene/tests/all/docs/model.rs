//! The local model of docs/write-a-model.md: it runs, and the page shows it.

use glam::Vec2;
use std::sync::Arc;
use throng::avoid::{AvoidanceInput, LocalModel, Workspace, time_to_disc};
use throng::{Agent, Error, Group, Settings, World};

/// Brakes so that the first collision on the preferred path is at least `horizon` seconds away.
#[derive(Debug)]
struct Brake {
    /// Seconds. Limit: > 0.
    horizon: f32,
}

impl LocalModel for Brake {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        let preferred = view.preferred.clamp_length_max(view.max_speed);
        let meets = |n: &throng::avoid::AvoidanceNeighbour| time_to_disc(n.offset, preferred - n.velocity, n.radii);
        let first = view.neighbours.iter().map(meets).fold(f32::INFINITY, f32::min);
        preferred * (first / self.horizon).min(1.0)
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }

    fn check(&self) -> Result<(), Error> {
        match self.horizon > 0.0 {
            true => Ok(()),
            false => Err(Error::Limit { what: "horizon", value: f64::from(self.horizon), limit: "> 0 s" }),
        }
    }
}

#[test]
fn the_model_of_the_page_runs() -> Result<(), Error> {
    // two agents cross; the guard keeps them apart if the model does not
    let mut world = World::new(Settings { step: 0.04, ..Settings::default() })?;
    let group = world.add_group(Group { model: Arc::new(Brake { horizon: 2.0 }), ..Group::default() })?;
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
fn the_page_shows_this_model() {
    let page = include_str!("../../../../../docs/write-a-model.md");
    let code = page.split("```rust\n").nth(1).and_then(|rest| rest.split("```").next()).expect("the page has the code");
    let file = include_str!("model.rs");
    let lines: Vec<&str> = file.lines().map(str::trim).collect();
    for line in code.lines().map(str::trim) {
        assert!(lines.contains(&line), "docs/write-a-model.md has a line that is not in this file: {line}");
    }
}

//! The reference work, by throng and the simulators of the same kind.

use crate::bevy::BevyOrca;
use crate::contest::{self, Contestant, Outcome, Turn};
use crate::dodgy::Dodgy;
use crate::python::Python;
use glam::DVec2;
use std::error::Error;
use std::path::Path;
use throng::World;
use throng_bench::clock::thread_time;
use throng_bench::{Crowd, lap, work};

/// Number of warm-up steps.
pub const WARM_UP: u32 = 20;

/// Measures a crossing with `agents` agents.
///
/// # Errors
/// The work cannot be built, or Python does not answer.
pub fn measure(name: &str, agents: usize, repeat: u32, python: Option<&Path>) -> Result<Vec<Outcome>, Box<dyn Error>> {
    let work = work(name).ok_or("no such work")?;
    let crowd = work.crowd(agents).expect("a work of pedestrians");
    let mut contestants: Vec<Box<dyn Contestant>> = vec![
        Box::new(Throng::new("throng", work.world(agents, false)?)),
        Box::new(Throng::new("throng with its guard", work.world(agents, true)?)),
        Box::new(Dodgy::new(&crowd)),
        Box::new(BevyOrca::new(&crowd)),
    ];
    if let Some(python) = python {
        let people: Vec<String> = crowd
            .people
            .iter()
            .map(|person| format!("{} {} {}", person.position.x, person.position.y, person.preferred_speed))
            .collect();
        let goals: Vec<String> = crowd
            .people
            .iter()
            .map(|person| {
                let goal = goal(&crowd, person.way);
                format!("{} {}", goal.x, goal.y)
            })
            .collect();
        let numbers = [crowd.step, crowd.radius].map(|number| number.to_string());
        let script = include_str!("../scripts/rvo2.py");
        contestants.push(Box::new(Python::start(python, "pyrvo", script, &numbers, &[&people, &goals, &[]])?));
    }
    let steps = (1_000_000 / agents.max(1)).clamp(10, 100) as u32;
    contest::measure(contestants, steps, repeat)
}

/// Returns the goal of a way that has a single goal.
pub fn goal(crowd: &Crowd, way: Option<usize>) -> DVec2 {
    way.map_or(DVec2::ZERO, |way| crowd.goals[crowd.ways[way][0]])
}

/// throng itself, without threads.
pub struct Throng {
    name: &'static str,
    warm: World,
    world: World,
}

impl Throng {
    /// Creates the contestant and warms its world up.
    pub fn new(name: &'static str, mut warm: World) -> Self {
        lap(&mut warm, WARM_UP, || true);
        let world = warm.clone();
        Self { name, warm, world }
    }
}

impl Contestant for Throng {
    fn name(&self) -> String {
        self.name.into()
    }

    fn restart(&mut self) -> Result<(), Box<dyn Error>> {
        self.world = self.warm.clone();
        Ok(())
    }

    fn steps(&mut self, count: u32) -> Result<Turn, Box<dyn Error>> {
        let agent_steps = self.world.summary().agent_steps;
        let begin = thread_time();
        for _ in 0..count {
            self.world.step();
        }
        Ok(Turn {
            agent_steps: self.world.summary().agent_steps - agent_steps,
            cpu: thread_time() - begin,
            seconds: f64::from(count) * self.world.settings().step,
        })
    }
}

//! dodgy_2d, through the interface that its page recommends: its users find the neighbours, here with a plain grid.

use crate::contest::{Contestant, Turn};
use crate::crossing::{WARM_UP, goal};
use crate::grid::Grid;
use dodgy_2d::{Agent, AvoidanceOptions, Vec2};
use std::borrow::Cow;
use std::error::Error;
use throng_bench::Crowd;

/// A crowd of dodgy_2d's agents.
pub struct Dodgy {
    step: f32,
    goals: Vec<(Vec2, f32)>,
    warm: Vec<Agent>,
    agents: Vec<Agent>,
    grid: Grid,
    velocities: Vec<Vec2>,
}

impl Dodgy {
    /// Creates the crowd and warms it up.
    pub fn new(crowd: &Crowd) -> Self {
        let vec = |p: glam::DVec2| Vec2::new(p.x as f32, p.y as f32);
        let agent = |position| Agent {
            position,
            velocity: Vec2::ZERO,
            radius: crowd.radius as f32,
            avoidance_responsibility: 1.0,
        };
        let mut all = Self {
            step: crowd.step as f32,
            goals: crowd
                .people
                .iter()
                .map(|person| (vec(goal(crowd, person.way)), person.preferred_speed as f32))
                .collect(),
            warm: vec![],
            agents: crowd.people.iter().map(|person| agent(vec(person.position))).collect(),
            grid: Grid::default(),
            velocities: vec![],
        };
        for _ in 0..WARM_UP {
            all.step();
        }
        all.warm = all.agents.clone();
        all
    }

    fn step(&mut self) {
        let options = AvoidanceOptions {
            obstacle_margin: 0.0,
            time_horizon: Crowd::TIME_HORIZON as f32,
            obstacle_time_horizon: Crowd::TIME_HORIZON as f32,
        };
        let agents = &self.agents;
        self.grid.rebuild(agents.iter().map(|agent| agent.position), Crowd::NEIGHBOUR_DISTANCE as f32);
        self.velocities.clear();
        let (mut found, mut neighbours) = (Vec::new(), Vec::new());
        for (k, agent) in agents.iter().enumerate() {
            self.grid.nearest(k, agent.position, Crowd::NEIGHBOURS, &mut found);
            neighbours.clear();
            neighbours.extend(found.iter().map(|near| Cow::Borrowed(&agents[near.1 as usize])));
            let (goal, speed) = self.goals[k];
            let preferred = (goal - agent.position).normalize_or_zero() * speed;
            self.velocities.push(agent.compute_avoiding_velocity(
                &neighbours,
                &[],
                preferred,
                Crowd::MAX_SPEED as f32,
                self.step,
                &options,
            ));
        }
        for (agent, velocity) in self.agents.iter_mut().zip(&self.velocities) {
            agent.velocity = *velocity;
            agent.position += *velocity * self.step;
        }
    }
}

impl Contestant for Dodgy {
    fn name(&self) -> String {
        "dodgy_2d 0.5.5 with a plain grid".into()
    }

    fn restart(&mut self) -> Result<(), Box<dyn Error>> {
        self.agents.clone_from(&self.warm);
        Ok(())
    }

    fn steps(&mut self, count: u32) -> Result<Turn, Box<dyn Error>> {
        Ok(Turn::of(count, self.agents.len(), self.step, || self.step()))
    }
}

//! Records a run of a scene.

use crate::pedestrian::{People, Walk};
use std::ops::Range;
use throng::{Status, Summary, Walkable, World};
use throng_scene::{Error, Scene};

/// The recording of a run.
#[derive(Clone, Debug)]
pub struct Run {
    /// The trajectories of all agents.
    pub people: People,
    /// The numbers of the agents of each group of the scene.
    pub groups: Vec<Range<u32>>,
    /// The ground.
    pub walkable: Vec<Walkable>,
    /// The summary of the world.
    pub summary: Summary,
    /// Number of agents that had not arrived at the end.
    pub left: usize,
}

impl Run {
    /// Runs a scene to its end and records it every `interval` seconds, rounded to whole steps. `goes_on` is called
    /// after every step; if it returns `false`, the run ends without a result.
    ///
    /// # Errors
    /// The scene cannot be built.
    pub fn of(scene: &Scene, interval: f64, mut goes_on: impl FnMut(&World) -> bool) -> Result<Option<Self>, Error> {
        let (mut world, built) = scene.build()?;
        let every = (interval / scene.time.step).round().max(1.0) as u64;
        let mut walks = AgentPaths::default();
        walks.push(&world);
        while !scene.time.over(&world) {
            world.step();
            if world.steps().is_multiple_of(every) {
                walks.push(&world);
            }
            if !goes_on(&world) {
                return Ok(None);
            }
        }
        let summary = world.summary();
        let left = summary.agents.saturating_sub(summary.arrived);
        let groups = built.groups.iter().map(|group| group.numbers.clone()).collect();
        Ok(Some(Self { people: walks.people(), groups, walkable: built.walkable, summary, left }))
    }

    /// Returns the group of an agent, by its number.
    pub fn group(&self, number: u32) -> usize {
        self.groups.iter().position(|numbers| numbers.contains(&number)).unwrap_or(0)
    }
}

/// Positions of all agents at recorded times, by number.
#[derive(Debug, Default)]
pub(crate) struct AgentPaths(Vec<Walk>);

impl AgentPaths {
    /// Adds the current positions.
    pub fn push(&mut self, world: &World) {
        let agents = world.relative_columns();
        for row in 0..agents.len() {
            let (number, id) = (agents.number[row], world.id(row));
            let Some(place) = world.position(id).filter(|_| agents.status[row] != Status::Stranded) else { continue };
            let index = number as usize;
            if self.0.len() <= index {
                let empty = |k: usize| Walk { number: k as u32, radius: 0.0, times: vec![], places: vec![] };
                self.0.extend((self.0.len()..=index).map(empty));
            }
            let walk = &mut self.0[index];
            walk.radius = f64::from(agents.radius[row]);
            walk.times.push(world.time());
            walk.places.push(place.truncate());
        }
    }

    pub fn people(self) -> People {
        People::new(self.0.into_iter().filter(|walk| !walk.times.is_empty()).collect())
    }
}

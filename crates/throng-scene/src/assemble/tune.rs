//! Changes the groups of a scene while its world runs.

use super::world::Built;
use crate::error::Error;
use crate::scene::{Group, Scene};
use throng::World;

impl Scene {
    /// Changes a world that was built from the scene `before` to this scene, if the two differ only in properties of
    /// groups - models, behaviours, interaction rules, fields, bodies, speeds, layers, colours - and in view and
    /// expectations. Returns whether they do. If not, the world is unchanged and the scene must be [built](Self::build)
    /// again.
    ///
    /// Positions and routes of the agents stay as they are, see [`World::set_group`] and [`World::adjust`].
    ///
    /// ```
    /// use throng_scene::{Avoid, Scene, gallery};
    ///
    /// let scene = gallery::scene("headon")?;
    /// let (mut world, mut built) = scene.build()?;
    /// world.step();
    /// let mut other = scene.clone();
    /// other.groups[0].avoid = Some(toml::from_str("hrvo = {}")?);
    /// assert!(other.tune(&scene, &mut world, &mut built)?);
    /// world.step();
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Scene::plan`], and errors of the world. After an error of the world, the world may have changed in
    /// part.
    pub fn tune(&self, before: &Self, world: &mut World, built: &mut Built) -> Result<bool, Error> {
        if before.groups.len() != self.groups.len() || before.with_the_groups_of(self) != *self {
            return Ok(false);
        }
        if self.has_the_world_of(before) {
            return Ok(true);
        }
        let plan = self.plan()?;
        let numbers = built.groups.iter().map(|group| group.numbers.len()).sum::<usize>();
        if plan.agents.len() != numbers || plan.groups.len() != built.groups.len() {
            return Ok(false);
        }
        for (k, group) in plan.groups.into_iter().enumerate().take(self.groups.len()) {
            let id = built.groups[k].id;
            world.set_group(id, group).map_err(|error| self.refused("group", Some(k), &error))?;
            built.groups[k].colour = self.groups[k].colour;
        }
        let agents = &plan.agents;
        let adjusted = world.adjust(|number, agent| {
            if let Some(planned) = agents.get(number as usize) {
                *agent = planned.agent.clone();
            }
        });
        adjusted.map_err(|error| self.refused("group", None, &error))?;
        (built.fields, built.notes) = (plan.fields, plan.notes);
        Ok(true)
    }

    /// Whether this scene and another differ at most in what has no effect on the world: title, view, expectations, and
    /// the words about the scene.
    pub fn has_the_world_of(&self, other: &Self) -> bool {
        let same = Self {
            title: self.title.clone(),
            about: self.about.clone(),
            view: self.view.clone(),
            expect: self.expect.clone(),
            ..other.clone()
        };
        same == *self
    }

    /// Returns this scene with everything of another scene that may differ.
    fn with_the_groups_of(&self, other: &Self) -> Self {
        let groups = self.groups.iter().zip(&other.groups).map(|(group, other)| Group {
            name: group.name.clone(),
            count: group.count,
            place: group.place.clone(),
            goal: group.goal.clone(),
            source: group.source.clone(),
            wait: group.wait,
            altitude: group.altitude,
            heading: group.heading,
            start_speed: group.start_speed,
            ..other.clone()
        });
        Self {
            groups: groups.collect(),
            title: other.title.clone(),
            about: other.about.clone(),
            fields: other.fields.clone(),
            view: other.view.clone(),
            expect: other.expect.clone(),
            origin: other.origin.clone(),
            ..self.clone()
        }
    }
}

//! Changing what a scene's groups are while its world runs.

use super::world::Built;
use crate::error::Error;
use crate::scene::{Group, Scene};
use throng::World;

impl Scene {
    /// Lets a world that was built of another scene go on as this one says, if they differ in nothing but what groups are -
    /// their models, behaviours, manners, fields, bodies, speeds, layers, colours - and in what is seen and expected of them.
    /// Whether they do: if not, nothing has changed, and the scene is to be [built](Self::build) anew.
    ///
    /// Where they are and where they go stays as it is, see [`World::set_group`] and [`World::adjust`].
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
    /// Those of [`Scene::plan`], and what the world itself refuses; then the world is partly as this scene says.
    pub fn tune(&self, before: &Self, world: &mut World, built: &mut Built) -> Result<bool, Error> {
        if before.groups.len() != self.groups.len() || before.with_the_groups_of(self) != *self {
            return Ok(false);
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

    /// This scene with whatever of another's may differ.
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
            description: other.description.clone(),
            fields: other.fields.clone(),
            view: other.view.clone(),
            expect: other.expect.clone(),
            origin: other.origin.clone(),
            ..self.clone()
        }
    }
}

//! The setting and the frames of a world.

use crate::frame::AdaptedField;
use crate::{Body, Flow, Frame, Setting};
use throng::World;
use throng::motion::Vehicle;

impl Setting {
    /// Returns the place, the groups with the fields that govern them, and the goals of a world as they are now. The
    /// geometry that only steering behaviours hold (shells and paths) is missing.
    ///
    /// ```
    /// use throng::{Settings, World};
    /// use throng_record::{Frame, Setting};
    /// let world = World::new(Settings::default())?;
    /// let (setting, frame) = (Setting::of(&world, "Empty"), Frame::of(&world));
    /// assert_eq!((setting.title.as_str(), frame.bodies.len()), ("Empty", 0));
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn of(world: &World, title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            walkable: world.place().areas.clone(),
            obstacles: world.place().obstacles().cloned().collect(),
            shells: Vec::new(),
            paths: Vec::new(),
            flows: Flow::all(world),
            groups: world.groups().iter().map(|group| group.name.clone()).collect(),
            characters: Vec::new(),
            walks: None,
            set: None,
            goals: world.goals().to_vec(),
            in_space: world.in_space(),
            origin: world.settings().origin,
        }
    }
}

impl Frame {
    /// Returns the agents of a world now.
    pub fn of(world: &World) -> Self {
        let mut frame = Self::default();
        frame.capture(world);
        frame
    }

    /// Sets the frame to `world` now and reuses the memory of the bodies.
    pub fn capture(&mut self, world: &World) {
        let (agents, origin) = (world.relative_columns(), world.settings().origin);
        let counts = world.counts();
        self.time = world.time();
        self.arrived = counts.arrived;
        self.total = counts.agents;
        self.standing = world.standing();
        self.accounts.clear();
        self.explanations.clear();
        self.accounts.extend_from_slice(world.relative_traces());
        self.fields.clear();
        let adapted = |group: usize| {
            let field = world.adapted_field(group)?.clone();
            Some(AdaptedField { group: group as u32, field })
        };
        self.fields.extend((0..world.groups().len()).filter_map(adapted));
        let body = |row: usize| Body {
            number: agents.number[row],
            group: agents.group[row].index() as u32,
            goal: world.goal_of(row).map(|goal| goal.index() as u32),
            position: agents.position[row].as_dvec2() + origin,
            altitude: agents.altitude[row],
            velocity: agents.velocity[row],
            vertical_velocity: agents.vertical_velocity[row],
            heading: agents.heading[row],
            basis: agents.vehicle[row].is_some_and(Vehicle::flies).then(|| agents.attitude[row].basis),
            radius: agents.radius[row],
            core: agents.core[row],
            preferred_speed: agents.preferred_speed[row],
            status: agents.status[row],
        };
        let places = places(&agents.number);
        self.bodies.truncate(places.len());
        if !places.is_empty() {
            self.bodies.resize_with(places.len(), || body(0));
        }
        for (row, place) in places.into_iter().enumerate() {
            self.bodies[place as usize] = body(row);
        }
    }
}

/// Returns the position of each row in the order of agent numbers. Rows lie in memory as the agents lie in space:
/// reading rows in order and writing to scattered places takes half the time of the opposite.
fn places(numbers: &[u32]) -> Vec<u32> {
    // number and row are packed, so that comparisons need no look-up
    let mut order: Vec<u64> = numbers.iter().zip(0..).map(|(&number, row)| u64::from(number) << 32 | row).collect();
    order.sort_unstable();
    let mut places = vec![0; numbers.len()];
    for (place, row) in (0..).zip(order) {
        places[row as u32 as usize] = place;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use throng::{Agent, Goal, Journey, Settings, Stop};

    #[test]
    fn a_frame_holds_all_agents_by_number_in_world_coordinates() {
        let origin = DVec2::new(1000.0, -500.0);
        let mut world = World::new(Settings { origin, ..Settings::default() }).unwrap();
        let goal = world.add_goal(Goal::Point { at: origin, tolerance: 0.1 }).unwrap();
        let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap();
        for number in [5, 2] {
            let position = origin + DVec2::new(f64::from(number), 0.25);
            world
                .add_agent(Agent { position: position.extend(0.0), journey, number: Some(number), ..Agent::default() })
                .unwrap();
        }
        let frame = Frame::of(&world);
        let seen: Vec<_> = frame.bodies.iter().map(|body| (body.number, body.position, body.goal)).collect();
        let at = |x: f64| DVec2::new(1000.0 + x, -499.75);
        assert_eq!(seen, [(2, at(2.0), Some(0)), (5, at(5.0), Some(0))]);
        assert_eq!((frame.total, frame.arrived), (2, 0));
        assert_eq!(Setting::of(&world, "x").goals.len(), 1);
    }
}

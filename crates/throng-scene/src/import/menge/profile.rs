//! Profiles: bodies, speeds, neighbour search.

use super::xml::{Xml, children};
use crate::error::{Error, Kind};
use crate::registry::Avoid;
use crate::scene::{Body, Group, Number, Speed};
use roxmltree::Node;
use throng::avoid::Orca;

/// The properties of a profile's agents.
#[derive(Clone, Debug)]
pub(super) struct Profile {
    pub name: String,
    radius: Number,
    preferred: Number,
    max: Number,
    acceleration: Number,
    neighbours: u32,
    neighbour_distance: f64,
    horizons: [f32; 2],
    priority: f64,
    /// The classes of obstacles that the agents avoid, one bit each.
    pub obstacles: u64,
}

impl Default for Profile {
    /// Returns Menge's defaults.
    fn default() -> Self {
        let orca = Orca::default();
        Self {
            name: String::new(),
            radius: 0.2.into(),
            preferred: 1.34.into(),
            max: 3.0.into(),
            acceleration: 6.0.into(),
            neighbours: 10,
            neighbour_distance: 5.0,
            horizons: [orca.time_horizon, orca.time_horizon_obstacles],
            priority: 0.0,
            obstacles: u64::MAX,
        }
    }
}

/// Reads all profiles of a scene, in order: a profile may inherit from earlier ones.
pub(super) fn all(xml: &Xml) -> Result<Vec<Profile>, Error> {
    let mut profiles: Vec<Profile> = vec![];
    for node in children(xml.document.root_element(), "AgentProfile") {
        let mut profile = match node.attribute("inherits") {
            None => Profile::default(),
            Some(name) => profiles.iter().find(|known| known.name == name).cloned().ok_or_else(|| {
                xml.wrong(
                    node,
                    Kind::UnknownKey,
                    format!("there is no profile `{name}` before this one to inherit from"),
                )
            })?,
        };
        profile.name = xml.text(node, "name")?.to_owned();
        for node in children(node, "Common") {
            profile.common(xml, node)?;
        }
        for node in children(node, "ORCA") {
            for (horizon, name) in profile.horizons.iter_mut().zip(["tau", "tauObst"]) {
                let said = xml.number(node, name)?.filter(|horizon| *horizon > 0.0);
                *horizon = said.map_or(*horizon, |seconds| seconds as f32);
            }
        }
        profiles.push(profile);
    }
    Ok(profiles)
}

impl Profile {
    fn common(&mut self, xml: &Xml, node: Node) -> Result<(), Error> {
        for (number, name) in self.numbers() {
            if let Some(said) = xml.number(node, name)? {
                *number = said.into();
            }
        }
        let whole = |name: &str| xml.number(node, name).map(|number| number.map(|number| number.clamp(0.0, 1e15)));
        self.neighbours = whole("max_neighbors")?.map_or(self.neighbours, |count| (count as u32).clamp(1, 1000));
        self.neighbour_distance = whole("neighbor_dist")?.filter(|far| *far > 0.0).unwrap_or(self.neighbour_distance);
        self.priority = xml.number(node, "priority")?.unwrap_or(self.priority);
        self.obstacles = whole("obstacleSet")?.map_or(self.obstacles, |bits| bits as u64);
        for property in children(node, "Property") {
            let name = xml.text(property, "name")?;
            if let Some((number, _)) = self.numbers().into_iter().find(|(_, known)| *known == name) {
                *number = xml.distribution(property)?;
            }
        }
        for (number, name) in self.numbers() {
            let least = if name == "pref_speed" { 0.0 } else { 1e-3 };
            if number.bounds()[0] < least {
                return Err(xml.wrong(node, Kind::OutOfRange, format!("`{name}` can be less than {least}")));
            }
        }
        Ok(())
    }

    /// Returns the numbers that may be drawn, with their names.
    fn numbers(&mut self) -> [(&mut Number, &'static str); 4] {
        [
            (&mut self.radius, "r"),
            (&mut self.preferred, "pref_speed"),
            (&mut self.max, "max_speed"),
            (&mut self.acceleration, "max_accel"),
        ]
    }

    /// Returns a group of agents with this profile.
    pub fn group(&self) -> Group {
        let [time_horizon, time_horizon_obstacles] = self.horizons;
        let avoid = Avoid::of(&Orca { time_horizon, time_horizon_obstacles, ..Orca::default() });
        Group {
            body: Body::Radius(self.radius),
            speed: Speed { preferred: self.preferred, max: Some(self.max) },
            acceleration: Some(self.acceleration),
            priority: self.priority,
            avoid: Some(avoid.with("neighbours", self.neighbours).with("neighbour_distance", self.neighbour_distance)),
            ..Group::default()
        }
    }
}

//! The topics of the gallery: its groups of scenes by what they teach.

use throng_scene::{Plugins, gallery};

/// A topic of the gallery.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Topic {
    /// The title.
    pub title: &'static str,
    /// What its scenes show.
    pub says: &'static str,
    /// The groups of the gallery.
    groups: &'static [&'static str],
    /// The scene that opens with the topic.
    pub first: &'static str,
}

/// All topics.
pub const TOPICS: [Topic; 6] = [
    Topic {
        title: "Steering",
        says: "seek, flee, follow, wander: one rule at a time",
        groups: &["steering"],
        first: "flock-pedestrians",
    },
    Topic {
        title: "Avoidance",
        says: "agents that meet and never touch",
        groups: &["labs", "meetings", "rvo2", "air"],
        first: "circle",
    },
    Topic {
        title: "Crowds",
        says: "doors, corridors, walls and vehicles",
        groups: &["walls", "bodies"],
        first: "bottleneck",
    },
    Topic { title: "Flocks", says: "birds that turn as a whole", groups: &["flocks"], first: "boids-in-box" },
    Topic { title: "Fields", says: "crowds led by sketched flows", groups: &["fields"], first: "field-strokes" },
    Topic { title: "Swarms", says: "insects with noise", groups: &["swarms"], first: "swarm-migration" },
];

impl Topic {
    /// Returns the scenes of the topic.
    pub fn scenes<'p>(&self, plugins: &'p Plugins) -> Vec<&'p str> {
        let groups = plugins.groups().into_iter().filter(|(group, _)| self.groups.contains(group));
        groups.flat_map(|(_, names)| names).collect()
    }
}

/// Returns the titles of all sections of the gallery, each with its scenes: scenes of plug-ins, topics, papers.
pub fn sections(plugins: &Plugins) -> Vec<(&str, Vec<&str>)> {
    let known = |group: &str| TOPICS.iter().any(|topic| topic.groups.contains(&group));
    let own = plugins.groups().into_iter().filter(|(group, _)| !known(group));
    let topics = TOPICS.iter().map(|topic| (topic.title, topic.scenes(plugins)));
    let papers = gallery::papers().iter().map(|&(name, _)| name).collect();
    own.chain(topics).chain([("Papers", papers)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_has_a_topic() {
        let plugins = Plugins::new();
        let mut scenes: Vec<&str> = TOPICS.iter().flat_map(|topic| topic.scenes(&plugins)).collect();
        let mut all: Vec<&str> = gallery::names().collect();
        scenes.sort_unstable();
        all.sort_unstable();
        assert_eq!(scenes, all);
        for topic in TOPICS {
            assert!(topic.scenes(&plugins).contains(&topic.first), "{}", topic.title);
        }
        let titles: Vec<&str> = sections(&plugins).into_iter().map(|(title, _)| title).collect();
        assert_eq!(titles, ["Steering", "Avoidance", "Crowds", "Flocks", "Fields", "Swarms", "Papers"]);
    }
}

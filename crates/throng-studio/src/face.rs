//! What is around the view.

use crate::panels::TOPICS;
use throng_scene::lessons;

/// The scene of the start page.
const START: &str = "street";

/// What is around the view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Face {
    /// All panels.
    #[default]
    Studio,
    /// A playing scene, and cards of the topics of the gallery.
    Start,
    /// The scenes of a topic, with the sliders and presets that they name.
    Topic(usize),
    /// A lesson beside the view, by position.
    Lesson(usize),
    /// Only the view, with large type and a large pointer.
    Present,
    /// Only the view. A click plays or pauses.
    Embed,
}

impl Face {
    /// Returns the face with a name of addresses: `studio`, `start`, `present`, `embed`, the title of one of [`TOPICS`]
    /// in lower case, or `lesson-` with the name of a [lesson](throng_scene::lessons).
    pub fn named(name: &str) -> Option<Self> {
        if let Some(name) = name.strip_prefix("lesson-") {
            return lessons::all().iter().position(|lesson| lesson.name == name).map(Self::Lesson);
        }
        Some(match name {
            "studio" => Self::Studio,
            "start" => Self::Start,
            "present" => Self::Present,
            "embed" => Self::Embed,
            _ => Self::Topic(TOPICS.iter().position(|topic| topic.title.to_lowercase() == name)?),
        })
    }

    /// Returns the scene that opens if no other is asked for, `None` for the scene opened last.
    pub fn scene(self) -> Option<&'static str> {
        match self {
            Self::Start => Some(START),
            Self::Topic(topic) => TOPICS.get(topic).map(|topic| topic.first),
            Self::Lesson(at) => lessons::all().get(at).map(|lesson| lesson.steps[0].scene.as_str()),
            Self::Studio | Self::Present | Self::Embed => None,
        }
    }

    /// Whether the tools of the mouse are offered.
    pub fn has_tools(self) -> bool {
        !matches!(self, Self::Present | Self::Embed)
    }

    /// Whether single keys are actions. Elsewhere they move the focus between cards and operate them.
    pub fn has_keys(self) -> bool {
        matches!(self, Self::Studio | Self::Present)
    }
}

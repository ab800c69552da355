//! Lessons: scenes in an order, with texts, questions and exercises, for teachers and for readers on their own.
//!
//! ```
//! use throng_scene::lessons;
//!
//! let lesson = lessons::named("boids").expect("there is a lesson on boids");
//! let question = lesson.steps.iter().find_map(|step| step.question.as_ref()).expect("it asks something");
//! assert!(question.answers.len() > question.right);
//! assert!(lesson.steps[0].scene()?.build().is_ok());
//! # Ok::<(), throng_scene::Error>(())
//! ```

use crate::error::{Error, Kind};
use crate::gallery;
use crate::scene::Scene;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// A lesson.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lesson {
    /// Its name.
    #[serde(skip)]
    pub name: &'static str,
    /// Its title.
    pub title: String,
    /// What it teaches, in one or two sentences.
    pub summary: String,
    /// Its steps, in order.
    #[serde(rename = "step")]
    pub steps: Vec<LessonStep>,
}

/// A step of a lesson: a scene, and what to say about it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LessonStep {
    /// Its title.
    pub title: String,
    /// The name of the scene in the gallery.
    pub scene: String,
    /// What readers are told.
    pub text: String,
    /// Changes of the scene: paths as for [`Scene::set`], and values.
    #[serde(default)]
    pub with: BTreeMap<String, toml::Value>,
    /// The local model of a second run beside the first.
    #[serde(default)]
    pub beside: Option<String>,
    /// A question before the answer is seen.
    #[serde(default)]
    pub question: Option<Question>,
    /// A task, which the expectations of the scene check.
    #[serde(default)]
    pub exercise: Option<Exercise>,
    /// A note for the lecturer.
    #[serde(default)]
    pub note: Option<String>,
}

/// A question: predict, then play.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// The time at which the scene pauses for the question, seconds.
    pub pause: f64,
    /// The question.
    pub ask: String,
    /// The answers to choose from.
    pub answers: Vec<String>,
    /// The index of the right answer.
    pub right: usize,
    /// Why it is right.
    pub because: String,
}

/// A task for readers. The scene of the step fails its [expectations](Scene::expect); that of the solution meets them.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exercise {
    /// What is to be done.
    pub task: String,
    /// A solution: further changes of the scene.
    pub solution: BTreeMap<String, toml::Value>,
}

impl LessonStep {
    /// Returns the scene of the step, with its changes.
    ///
    /// # Errors
    /// The scene or a path of a change does not exist.
    pub fn scene(&self) -> Result<Scene, Error> {
        changed(gallery::scene(&self.scene)?, &self.with)
    }

    /// Returns the scene of the step with the solution of its exercise.
    ///
    /// # Errors
    /// As [`scene`](Self::scene).
    pub fn solved(&self) -> Result<Scene, Error> {
        let none = BTreeMap::new();
        changed(self.scene()?, self.exercise.as_ref().map_or(&none, |exercise| &exercise.solution))
    }
}

fn changed(mut scene: Scene, with: &BTreeMap<String, toml::Value>) -> Result<Scene, Error> {
    with.iter().try_for_each(|(path, value)| scene.set(path, &value.to_string()))?;
    Ok(scene)
}

/// The texts of the lessons by name, in the order in which they build on each other.
const TEXTS: [(&str, &str); 6] = [
    ("boids", include_str!("../lessons/boids.toml")),
    ("steering", include_str!("../lessons/steering.toml")),
    ("avoidance", include_str!("../lessons/avoidance.toml")),
    ("fields", include_str!("../lessons/fields.toml")),
    ("swarms", include_str!("../lessons/swarms.toml")),
    ("people", include_str!("../lessons/people.toml")),
];

static LESSONS: LazyLock<Vec<Lesson>> = LazyLock::new(|| {
    let lessons = TEXTS.iter().filter_map(|&(name, text)| Some(Lesson { name, ..parse(text).ok()? }));
    lessons.collect()
});

/// Returns all lessons, in the order in which they build on each other.
pub fn all() -> &'static [Lesson] {
    &LESSONS
}

/// Returns a lesson by name.
pub fn named(name: &str) -> Option<&'static Lesson> {
    all().iter().find(|lesson| lesson.name == name)
}

/// Reads the text of a lesson.
fn parse(text: &str) -> Result<Lesson, Error> {
    toml::from_str(text).map_err(|error| Error::new(Kind::Syntax, error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_lesson_is_read() {
        for (name, text) in TEXTS {
            parse(text).unwrap_or_else(|error| panic!("{name}: {error}"));
        }
        assert_eq!(all().len(), TEXTS.len());
    }
}

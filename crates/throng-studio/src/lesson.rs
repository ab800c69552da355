//! A lesson under way: its step, the votes of a class, and the check of an exercise.

use crate::document::Document;
use crate::play::guarded;
use crate::tune::apply_preset;
use std::sync::Arc;
use std::time::Duration;
use throng::World;
use throng_scene::lessons::{self, Lesson, LessonStep};
use throng_scene::{AboutPreset, Expectations, Plugins, Scene};
use web_time::Instant;

/// A lesson under way.
#[derive(Debug, Default)]
pub struct Teaching {
    /// The lesson and its step, by position.
    at: Option<(usize, usize)>,
    /// The run before that of the step.
    before: u64,
    /// The votes for each answer.
    pub votes: Vec<u32>,
    /// Whether the scene has paused for the question.
    pub asked: bool,
    /// Whether the answer is shown.
    pub told: bool,
    /// The check of an exercise.
    pub check: Option<Check>,
    /// The model beside the scene that the user had before the lesson.
    pub own_beside: Option<String>,
}

impl Teaching {
    /// Begins a step. `run` is the number of the run that is shown until the scene of the step plays.
    pub fn begin(&mut self, at: (usize, usize), run: u64) {
        let own_beside = self.own_beside.take();
        *self = Self { at: Some(at), before: run, own_beside, ..Self::default() };
        let answers = self.step().and_then(|step| step.question.as_ref()).map_or(0, |question| question.answers.len());
        self.votes = vec![0; answers];
    }

    /// Returns the position of the step in a lesson, `None` if the lesson has not begun.
    pub fn position(&self, lesson: usize) -> Option<usize> {
        self.at.filter(|(at, _)| *at == lesson).map(|(_, step)| step)
    }

    /// Returns the step.
    pub fn step(&self) -> Option<&'static LessonStep> {
        let (lesson, step) = self.at?;
        lessons::all().get(lesson)?.steps.get(step)
    }

    /// Whether the scene is to pause for the question now.
    pub fn asks(&mut self, run: u64, time: f64) -> bool {
        let due = self.step().and_then(|step| step.question.as_ref()).is_some_and(|question| time >= question.pause);
        let asks = due && !self.asked && run != self.before;
        self.asked |= asks;
        asks
    }
}

/// Returns a lesson by position.
pub fn lesson(at: usize) -> Option<&'static Lesson> {
    lessons::all().get(at)
}

/// Returns the scene of a step as a document. Its changes count as saved.
///
/// # Errors
/// The step does not fit its scene.
pub fn document(step: &LessonStep, plugins: &Arc<Plugins>) -> Result<Document, String> {
    let mut document = Document::named(&step.scene, plugins).ok_or(format!("there is no scene {}", step.scene))?;
    let scene = document.scene().map_err(ToString::to_string)?.clone();
    let with = AboutPreset { name: step.title.clone(), with: step.with.clone() };
    document.change(|edit| apply_preset(edit, &scene, &with))?;
    Ok(Document::new(&step.scene, document.text()).with(plugins))
}

/// The check of a scene: a run of its own, in slices of time.
#[derive(Debug)]
pub enum Check {
    /// It runs.
    Running(Box<CheckRun>),
    /// The expectations, each with whether it is met.
    Done(Vec<(String, bool)>),
    /// The scene cannot be run.
    Wrong(String),
}

/// A run that is checked.
#[derive(Debug)]
pub struct CheckRun {
    scene: Arc<Scene>,
    world: World,
    expectations: Expectations,
}

impl CheckRun {
    /// Returns the part of the longest run that is done, 0 to 1.
    pub fn share(&self) -> f32 {
        (self.world.time() / self.scene.time.limit) as f32
    }
}

impl Check {
    /// Begins the check of a scene.
    pub fn new(scene: &Arc<Scene>) -> Self {
        match guarded(|| scene.build()) {
            Ok(Ok((world, built))) => {
                let expectations = Expectations::new(&scene.expect, &world, &built);
                Self::Running(Box::new(CheckRun { scene: scene.clone(), world, expectations }))
            }
            Ok(Err(error)) => Self::Wrong(error.to_string()),
            Err(trouble) => Self::Wrong(trouble.to_string()),
        }
    }

    /// Goes on for about `budget`. Returns whether it goes on further.
    pub fn work(&mut self, budget: Duration) -> bool {
        let Self::Running(run) = self else { return false };
        let begin = Instant::now();
        while !run.scene.time.over(&run.world) {
            if begin.elapsed() >= budget {
                return true;
            }
            if let Err(trouble) = guarded(|| run.world.step()) {
                *self = Self::Wrong(trouble.to_string());
                return false;
            }
            run.expectations.step(&run.world);
        }
        let outcome = run.expectations.verdict(&run.world);
        let say = |check: &throng_scene::Expectation| (says(check), check.passed);
        *self = Self::Done(outcome.checks.iter().map(say).collect());
        false
    }

    /// Whether everything that the scene expects is met.
    pub fn passed(&self) -> bool {
        matches!(self, Self::Done(checks) if checks.iter().all(|(_, passed)| *passed))
    }
}

fn says(check: &throng_scene::Expectation) -> String {
    let found = check.found.as_ref().map_or("nothing".into(), ToString::to_string);
    format!("{}: expected {}, found {found}", check.name.replace('_', " "), check.expected)
}

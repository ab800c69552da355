//! What is recorded: moments one after the other.

use crate::play::{Reel, Shown, guarded, title};
use std::sync::Arc;
use throng::World;
use throng_draw::Annotations;
use throng_record::{Frame, Setting, moment};
use throng_scene::Scene;

/// What a recording is made of.
#[derive(Clone, Debug)]
pub enum Subject {
    /// A scene, with what it is called.
    Scene(Arc<str>, Arc<Scene>),
    /// A film that is replayed.
    Film(Arc<Reel>),
}

impl Subject {
    /// What is shown.
    pub fn of(shown: &Shown) -> Self {
        match &shown.reel {
            Some(reel) => Self::Film(reel.clone()),
            None => Self::Scene(shown.name.clone(), shown.scene.clone()),
        }
    }

    /// Its moments, from the first; those who are annotated tell what they have in mind.
    ///
    /// # Errors
    /// The scene cannot be built; why.
    pub fn begin(&self, annotations: &Annotations) -> Result<Box<dyn Source>, String> {
        match self {
            Self::Film(reel) => Ok(Box::new(Replay { reel: reel.clone(), at: 0 })),
            Self::Scene(name, scene) => Ok(Box::new(Run::new(name, scene.clone(), annotations)?)),
        }
    }
}

/// Moments one after the other.
pub trait Source {
    /// What stays the same.
    fn setting(&self) -> &Setting;
    /// Seconds from a moment to the next.
    fn step(&self) -> f64;
    /// When this moment is, seconds.
    fn time(&self) -> f64;
    /// When the last moment is, at the latest, seconds.
    fn end(&self) -> f64;
    /// Whether this is the last one.
    fn over(&self) -> bool;
    /// Goes on to the next.
    ///
    /// # Errors
    /// Code of a scene panicked: what it said.
    fn advance(&mut self) -> Result<(), String>;
    /// Makes `frame` show this moment.
    fn capture(&self, frame: &mut Frame);
}

/// A scene from its start.
struct Run {
    scene: Arc<Scene>,
    world: World,
    setting: Setting,
}

impl Run {
    fn new(name: &str, scene: Arc<Scene>, annotations: &Annotations) -> Result<Self, String> {
        let built = guarded(|| scene.build()).map_err(|trouble| trouble.to_string())?;
        let (mut world, built) = built.map_err(|error| error.to_string())?;
        world.ask(annotations.asked());
        Ok(Self { setting: moment::setting(&world, &built, title(&scene, name)), world, scene })
    }
}

impl Source for Run {
    fn setting(&self) -> &Setting {
        &self.setting
    }

    fn step(&self) -> f64 {
        self.scene.time.step
    }

    fn time(&self) -> f64 {
        self.world.time()
    }

    fn end(&self) -> f64 {
        self.scene.time.limit
    }

    fn over(&self) -> bool {
        self.scene.time.over(&self.world)
    }

    fn advance(&mut self) -> Result<(), String> {
        guarded(|| self.world.step()).map_err(|trouble| trouble.to_string())
    }

    fn capture(&self, frame: &mut Frame) {
        moment::capture(&self.world, frame);
    }
}

/// A film from its first moment.
struct Replay {
    reel: Arc<Reel>,
    at: usize,
}

impl Source for Replay {
    fn setting(&self) -> &Setting {
        &self.reel.setting
    }

    fn step(&self) -> f64 {
        self.reel.scene.time.step
    }

    fn time(&self) -> f64 {
        self.reel.time(self.at)
    }

    fn end(&self) -> f64 {
        self.reel.time(self.reel.count())
    }

    fn over(&self) -> bool {
        self.at + 1 >= self.reel.count()
    }

    fn advance(&mut self) -> Result<(), String> {
        self.at += 1;
        Ok(())
    }

    fn capture(&self, frame: &mut Frame) {
        self.reel.capture(self.at, frame);
    }
}

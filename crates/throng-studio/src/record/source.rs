//! What is recorded: moments one after the other.

use crate::play::{Reel, Shown, guarded, models_of, title};
use std::sync::Arc;
use throng::World;
use throng_draw::{Annotations, Sheet};
use throng_record::{Frame, Setting, moment};
use throng_scene::Scene;

/// What a recording is made of.
#[derive(Clone, Debug)]
pub enum Subject {
    /// A scene, with what it is called.
    Scene(Arc<str>, Arc<Scene>),
    /// A film that is replayed.
    Film(Arc<Reel>),
    /// A scene by two models, side by side: what it is called, and each with what its models are called.
    Beside(Arc<str>, [(String, Arc<Scene>); 2]),
}

/// Which is recorded where a scene is shown by two models.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Which {
    /// Both, side by side.
    #[default]
    Both,
    /// The scene by its own model.
    Own,
    /// The one beside it.
    Other,
}

impl Subject {
    /// What is shown.
    pub fn of(shown: &Shown, which: Which) -> Self {
        let scene = |shown: &Shown| Self::Scene(shown.name.clone(), shown.scene.clone());
        match (&shown.reel, &shown.beside, which) {
            (Some(reel), ..) => Self::Film(reel.clone()),
            (None, Some(other), Which::Other) => scene(other),
            (None, Some(other), Which::Both) => {
                let both = [&shown.scene, &other.scene].map(|scene| (models_of(scene), scene.clone()));
                Self::Beside(shown.name.clone(), both)
            }
            _ => scene(shown),
        }
    }

    /// Its moments, from the first; those who are annotated tell what they have in mind.
    ///
    /// # Errors
    /// The scene cannot be built; why.
    pub fn begin(&self, annotations: &Annotations) -> Result<Vec<Box<dyn Source>>, String> {
        let run = |name: &str, scene: &Arc<Scene>| -> Result<Box<dyn Source>, String> {
            Ok(Box::new(Run::new(name, scene.clone(), annotations)?))
        };
        match self {
            Self::Film(reel) => Ok(vec![Box::new(Replay { reel: reel.clone(), at: 0 })]),
            Self::Scene(name, scene) => Ok(vec![run(name, scene)?]),
            Self::Beside(name, both) => both.iter().map(|(_, scene)| run(name, scene)).collect(),
        }
    }

    /// What pictures of several sources show, under the title of the scene if they have one at all.
    pub fn sheet(&self, sources: &[Box<dyn Source>], titled: bool) -> Option<Sheet> {
        let Self::Beside(_, both) = self else { return None };
        let panels = both
            .iter()
            .zip(sources)
            .map(|((models, _), source)| Setting { title: models.clone(), ..source.setting().clone() });
        let title = if titled { sources[0].setting().title.clone() } else { String::new() };
        Some(Sheet { title, panels: panels.collect(), columns: both.len() })
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

//! The sources of a recording: sequences of moments.

use crate::play::{Reel, RunMoment, guarded, models_of, title};
use std::sync::Arc;
use throng::{TraceRequest, World};
use throng_draw::{Annotations, Sheet};
use throng_record::{Frame, Setting, moment};
use throng_scene::Scene;

/// The subject of a recording.
#[derive(Clone, Debug)]
pub enum Subject {
    /// A scene and its name.
    Scene(Arc<str>, Arc<Scene>),
    /// Replayed trajectories.
    Film(Arc<Reel>),
    /// A scene with two models side by side: its name, and each scene with the names of its models.
    Beside(Arc<str>, [(String, Arc<Scene>); 2]),
}

/// The recorded model, where a scene runs with two models.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Which {
    /// Both, side by side.
    #[default]
    Both,
    /// The model of the scene.
    Own,
    /// The second model.
    Other,
}

impl Subject {
    /// Returns the subject of the displayed run.
    pub fn of(shown: &RunMoment, which: Which) -> Self {
        let scene = |shown: &RunMoment| Self::Scene(shown.name.clone(), shown.scene.clone());
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

    /// Starts the sources at their first moment. Annotated agents record their decision traces.
    ///
    /// # Errors
    /// The scene cannot be built.
    pub fn begin(&self, annotations: &Annotations) -> Result<Vec<Box<dyn Source>>, String> {
        let run = |name: &str, scene: &Arc<Scene>| -> Result<Box<dyn Source>, String> {
            Ok(Box::new(SceneRun::new(name, scene.clone(), annotations)?))
        };
        match self {
            Self::Film(reel) => Ok(vec![Box::new(FilmReplay { reel: reel.clone(), at: 0 })]),
            Self::Scene(name, scene) => Ok(vec![run(name, scene)?]),
            Self::Beside(name, both) => both.iter().map(|(_, scene)| run(name, scene)).collect(),
        }
    }

    /// Returns the sheet for several sources side by side, with the title of the scene if `titled`.
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

/// A sequence of moments.
pub trait Source {
    /// Returns the constant part.
    fn setting(&self) -> &Setting;
    /// Returns the time between moments, seconds.
    fn step(&self) -> f64;
    /// Returns the time of the current moment, seconds.
    fn time(&self) -> f64;
    /// Returns the latest possible time of the last moment, seconds.
    fn end(&self) -> f64;
    /// Whether the current moment is the last.
    fn over(&self) -> bool;
    /// Advances to the next moment.
    ///
    /// # Errors
    /// Code of the scene panicked, with its message.
    fn advance(&mut self) -> Result<(), String>;
    /// Writes the current moment into `frame`.
    fn capture(&self, frame: &mut Frame);
}

/// A scene that is run from its start.
struct SceneRun {
    scene: Arc<Scene>,
    world: World,
    setting: Setting,
    /// The agents of which the forbidden velocities are drawn.
    explained: TraceRequest,
}

impl SceneRun {
    fn new(name: &str, scene: Arc<Scene>, annotations: &Annotations) -> Result<Self, String> {
        let built = guarded(|| scene.build()).map_err(|trouble| trouble.to_string())?;
        let (mut world, built) = built.map_err(|error| error.to_string())?;
        world.request_traces(annotations.asked());
        let setting = moment::setting_with_files(&world, &built, &scene, title(&scene, name));
        let explained = annotations.explained();
        Ok(Self { setting: setting.map_err(|error| error.to_string())?, world, scene, explained })
    }
}

impl Source for SceneRun {
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
        moment::explain(&self.world, &self.explained, frame);
        moment::capture_obstacles(&self.world, &self.scene, &self.setting, frame);
    }
}

/// A replay from its first moment.
struct FilmReplay {
    reel: Arc<Reel>,
    at: usize,
}

impl Source for FilmReplay {
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

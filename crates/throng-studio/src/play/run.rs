//! Something being played: its moments, what they look like, and what was measured of them.

use super::live::Live;
use super::meter::Meter;
use super::reel::{Reel, Replay};
use super::series::Series;
use super::shown::{Cost, Trouble};
use super::stage::Stage;
use std::sync::Arc;
use throng_draw::WorldBox;
use throng_record::{Frame, Setting};
use throng_scene::Scene;

/// A scene or a film, at one of its moments, and what is to be seen of it.
pub(super) struct Run {
    pub name: Arc<str>,
    pub scene: Arc<Scene>,
    pub stage: Box<dyn Stage>,
    pub setting: Arc<Setting>,
    pub bounds: WorldBox,
    pub first: Arc<Frame>,
    pub before: Arc<Frame>,
    pub frame: Arc<Frame>,
    pub cost: Cost,
    pub series: Arc<Series>,
}

impl Run {
    /// Builds the scene's world.
    pub fn new(name: Arc<str>, scene: Arc<Scene>, meters: &Arc<[Meter]>) -> Result<Self, Trouble> {
        let (live, setting) = Live::new(scene.clone(), title(&scene, &name))?;
        let [min, max] = live.bounds();
        Ok(Self::of(name, scene, Box::new(live), Arc::new(setting), WorldBox { min, max }, meters))
    }

    /// A film, at its first moment.
    pub fn replay(reel: Arc<Reel>, meters: &Arc<[Meter]>) -> Self {
        let (name, scene, setting, bounds) =
            (reel.name.clone(), reel.scene.clone(), reel.setting.clone(), reel.bounds());
        Self::of(name, scene, Box::new(Replay::new(reel)), setting, bounds, meters)
    }

    fn of(
        name: Arc<str>,
        scene: Arc<Scene>,
        stage: Box<dyn Stage>,
        setting: Arc<Setting>,
        bounds: WorldBox,
        meters: &Arc<[Meter]>,
    ) -> Self {
        let mut frame = Frame::default();
        stage.capture(&mut frame);
        let frame = Arc::new(frame);
        // a film knows where everybody ever is, a scene where they are at first
        let around = if stage.reel().is_some() { None } else { WorldBox::of(&setting, &frame) };
        Self {
            bounds: around.unwrap_or(bounds),
            setting,
            first: frame.clone(),
            before: frame.clone(),
            frame,
            cost: Cost::default(),
            series: Arc::new(Series::new(&stage.observe(), meters)),
            name,
            scene,
            stage,
        }
    }

    /// Makes one step.
    pub fn step(&mut self) -> Result<(), Trouble> {
        if let Err(trouble) = self.stage.step(&mut self.cost) {
            self.stand();
            return Err(trouble);
        }
        if self.series.wants(self.stage.steps()) {
            Arc::make_mut(&mut self.series).see(&self.stage.observe());
        }
        Ok(())
    }

    /// Goes on as another scene says, if only its groups are others: whether it does.
    pub fn change(&mut self, scene: Arc<Scene>) -> Result<bool, Trouble> {
        let tuned = self.stage.tune(&scene, &self.scene, title(&scene, &self.name))?;
        let found = tuned.is_some();
        if let Some(setting) = tuned {
            (self.setting, self.scene) = (Arc::new(setting), scene);
            self.stage.capture(Arc::make_mut(&mut self.frame));
        }
        Ok(found)
    }

    /// Goes to the last state within reach of a step or of one before it.
    pub fn back_to(&mut self, step: u64) {
        self.stage.back_to(step);
        self.stand();
    }

    /// Shows where the stage stands after it has not gone on from what was shown.
    fn stand(&mut self) {
        Arc::make_mut(&mut self.series).back(&self.stage.observe());
        self.see();
        self.before = self.frame.clone();
    }

    /// What is there now is to be seen.
    pub fn see(&mut self) {
        let mut next = std::mem::replace(&mut self.before, self.frame.clone());
        // memory of moments that nobody looks at any more is used again
        self.stage.capture(Arc::make_mut(&mut next));
        self.frame = next;
    }
}

/// What the local models of a scene's groups are called.
pub(crate) fn models_of(scene: &Scene) -> String {
    let mut names: Vec<String> = Vec::new();
    for group in &scene.groups {
        let name = group.local_model().name();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names.join(", ")
}

/// What a scene of this name is called.
pub(crate) fn title<'a>(scene: &'a Scene, name: &'a str) -> &'a str {
    if scene.title.is_empty() { name } else { &scene.title }
}

//! A run: its current and previous frames, and its measurements.

use super::figures::Figures;
use super::intervened::Act;
use super::live::Live;
use super::meter::Meter;
use super::people::{People, PosesBetween};
use super::playable::Playable;
use super::reel::{Reel, ReelReplay};
use super::run_moment::{Cost, Trouble};
use super::series::Series;
use super::wake::Wake;
use std::sync::Arc;
use throng_draw::WorldBox;
use throng_record::{Frame, Setting};
use throng_scene::Scene;

/// A run of a scene or a trajectory file.
pub(super) struct PlayedRun {
    pub name: Arc<str>,
    pub scene: Arc<Scene>,
    pub stage: Box<dyn Playable>,
    pub setting: Arc<Setting>,
    pub bounds: WorldBox,
    pub first: Arc<Frame>,
    pub before: Arc<Frame>,
    pub frame: Arc<Frame>,
    pub cost: Cost,
    pub series: Arc<Series>,
    pub wake: Wake,
    /// The bodies of people from files, read once people are wanted.
    pub figures: Arc<Figures>,
    /// The people, if they are wanted.
    people: Option<People>,
}

impl PlayedRun {
    /// Builds the world of a scene.
    pub fn new(name: Arc<str>, scene: Arc<Scene>, meters: &Arc<[Meter]>) -> Result<Self, Trouble> {
        let (live, setting) = Live::new(scene.clone(), title(&scene, &name))?;
        let [min, max] = live.bounds();
        Ok(Self::of(name, scene, Box::new(live), Arc::new(setting), WorldBox { min, max }, meters))
    }

    /// Starts a replay at its first moment.
    pub fn replay(reel: Arc<Reel>, meters: &Arc<[Meter]>) -> Self {
        let (name, scene, setting, bounds) =
            (reel.name.clone(), reel.scene.clone(), reel.setting.clone(), reel.bounds());
        Self::of(name, scene, Box::new(ReelReplay::new(reel)), setting, bounds, meters)
    }

    fn of(
        name: Arc<str>,
        scene: Arc<Scene>,
        stage: Box<dyn Playable>,
        setting: Arc<Setting>,
        bounds: WorldBox,
        meters: &Arc<[Meter]>,
    ) -> Self {
        let mut frame = Frame::default();
        stage.capture(&mut frame);
        let frame = Arc::new(frame);
        // a trajectory file knows the positions at all moments, a scene only those at the start
        let around = if stage.reel().is_some() { None } else { WorldBox::of(&setting, &frame) };
        Self {
            bounds: around.unwrap_or(bounds),
            setting,
            first: frame.clone(),
            before: frame.clone(),
            frame,
            cost: Cost::default(),
            series: Arc::new(Series::new(&stage.observe(), meters)),
            wake: Wake::default(),
            figures: Arc::default(),
            people: None,
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

    /// Continues with another scene, if only its groups differ. Returns whether they alone differ.
    pub fn change(&mut self, scene: Arc<Scene>) -> Result<bool, Trouble> {
        let tuned = self.stage.tune(&scene, &self.scene, title(&scene, &self.name))?;
        let found = tuned.is_some();
        if let Some(setting) = tuned {
            (self.setting, self.scene) = (Arc::new(setting), scene);
            self.stage.capture(Arc::make_mut(&mut self.frame));
        }
        Ok(found)
    }

    /// Does what the user asks for at the current moment.
    pub fn intervene(&mut self, act: &Act) -> Result<(), Trouble> {
        self.stage.intervene(act)?;
        self.stage.capture(Arc::make_mut(&mut self.frame));
        self.look_round();
        Ok(())
    }

    /// Takes over the setting if an intervention has changed it.
    fn look_round(&mut self) {
        if let Some(setting) = self.stage.changed_setting(&self.setting) {
            self.setting = Arc::new(setting);
        }
    }

    /// Captures the current state, `ahead` steps before the step to reach. On the way to a step, only the last two states
    /// and those of the wake are captured.
    pub fn pass(&mut self, ahead: u64) {
        if ahead <= 1 {
            self.see();
            self.wake.pass(&self.frame, ahead);
        } else if ahead <= Wake::steps(self.scene.time.step, self.frame.bodies.len()) {
            let mut moment = Frame::default();
            self.stage.capture(&mut moment);
            self.wake.pass(&Arc::new(moment), ahead);
        }
    }

    /// Goes to the last reachable state at or before a step.
    pub fn back_to(&mut self, step: u64) {
        self.stage.back_to(step);
        self.wake = Wake::default();
        self.stand();
    }

    /// Captures the current state without a previous frame to interpolate from.
    fn stand(&mut self) {
        Arc::make_mut(&mut self.series).back(&self.stage.observe());
        self.see();
        self.before = self.frame.clone();
    }

    /// Captures the current state.
    pub fn see(&mut self) {
        let mut next = std::mem::replace(&mut self.before, self.frame.clone());
        // reuses the memory of the previous frame if no reader holds it
        self.stage.capture(Arc::make_mut(&mut next));
        self.frame = next;
        self.look_round();
        if let Some(people) = &mut self.people {
            people.see(&self.frame, &self.setting, self.scene.time.step);
        }
    }

    /// Returns the poses of people from the previous to the current state, if they are `wanted`. On the way to another
    /// state, in a `hurry`, they stand.
    pub fn poses(&mut self, wanted: bool, hurry: bool) -> PosesBetween {
        if !wanted {
            self.people = None;
            return PosesBetween::default();
        }
        if !self.figures.fit(&self.scene) {
            (self.figures, self.people) = (Arc::new(Figures::read(&self.scene)), None);
        }
        let people = self.people.get_or_insert_with(|| People::new(self.figures.clone()));
        people.poses(&self.frame, &self.setting, hurry)
    }
}

/// Returns the names of the local models of a scene's groups.
pub(crate) fn models_of(scene: &Scene) -> String {
    let mut names: Vec<String> = Vec::new();
    for group in &scene.groups {
        let name = group.local_model().name;
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names.join(", ")
}

/// Returns the title of a scene, or its name if it has no title.
pub(crate) fn title<'a>(scene: &'a Scene, name: &'a str) -> &'a str {
    if scene.title.is_empty() { name } else { &scene.title }
}

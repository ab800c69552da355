//! One scene being played: its world, what it looks like, and where it has been.

use super::history::History;
use super::meter::Meter;
use super::series::Series;
use super::shown::{Cost, Trouble};
use std::sync::Arc;
use throng::{Asked, Explanation, Stage, Summary, World};
use throng_draw::WorldBox;
use throng_record::{Frame, Setting, moment};
use throng_scene::{Built, Scene, caught};
use web_time::Instant;

/// Bytes of states that are kept to go back to.
const MEMORY: usize = 256 << 20;
/// How much of the cost of a step is the last one's.
const FRESH: f64 = 0.1;

/// A scene, its world, and what is to be seen of it.
pub(super) struct Run {
    pub name: Arc<str>,
    pub scene: Arc<Scene>,
    pub world: World,
    pub setting: Arc<Setting>,
    pub bounds: WorldBox,
    pub first: Arc<Frame>,
    pub before: Arc<Frame>,
    pub frame: Arc<Frame>,
    pub cost: Cost,
    pub history: History,
    built: Built,
    pub series: Arc<Series>,
    summary: (Instant, Arc<Summary>),
    /// Who is to explain itself, and what it said last, when.
    explained: Option<u32>,
    explanation: Option<(Instant, Arc<Explanation>)>,
}

impl Run {
    /// Builds the scene's world.
    pub fn new(name: Arc<str>, scene: Arc<Scene>, meters: &Arc<[Meter]>) -> Result<Self, Trouble> {
        let built = guarded(|| scene.build())?;
        let (world, built) = built.map_err(|error| Trouble::Scene(Box::new(error)))?;
        let title = if scene.title.is_empty() { &name } else { scene.title.as_str() };
        let setting = moment::setting(&world, &built, title);
        let mut frame = Frame::default();
        moment::capture(&world, &mut frame);
        let frame = Arc::new(frame);
        let [min, max] = built.bounds;
        let mut run = Self {
            bounds: WorldBox::of(&setting, &frame).unwrap_or(WorldBox { min, max }),
            setting: Arc::new(setting),
            first: frame.clone(),
            before: frame.clone(),
            frame,
            cost: Cost::default(),
            history: History::new(MEMORY),
            built,
            series: Arc::new(Series::new(&world, meters)),
            summary: (Instant::now(), Arc::new(world.summary())),
            explained: None,
            explanation: None,
            name,
            scene,
            world,
        };
        run.keep();
        Ok(run)
    }

    /// Whether the scene has ended.
    pub fn over(&self) -> bool {
        self.scene.time.over(&self.world)
    }

    /// Makes one step.
    pub fn step(&mut self) -> Result<(), Trouble> {
        let (begin, before) = (Instant::now(), self.world.steps());
        let (mut last, mut stages) = (begin, [0.0; 5]);
        let made = guarded(|| {
            self.world.step_in_stages(|stage: Stage| {
                let now = Instant::now();
                stages[stage as usize] += (now - last).as_secs_f64();
                last = now;
            });
        });
        if made.is_err() {
            self.mend(before);
        }
        made?;
        let share = if self.world.steps() == 1 { 1.0 } else { FRESH };
        let mix = |old: &mut f64, new: f64| *old += (new - *old) * share;
        self.cost.stages.iter_mut().zip(stages).for_each(|(old, new)| mix(old, new));
        mix(&mut self.cost.step, begin.elapsed().as_secs_f64());
        self.keep();
        if self.series.wants(&self.world) {
            Arc::make_mut(&mut self.series).see(&self.world);
        }
        Ok(())
    }

    /// Goes on as another scene says, if only its groups are others: whether it does.
    pub fn change(&mut self, scene: Arc<Scene>) -> Result<bool, Trouble> {
        let tuned = guarded(|| scene.tune(&self.scene, &mut self.world, &mut self.built))?;
        let tuned = tuned.map_err(|error| Trouble::Scene(Box::new(error)))?;
        if tuned {
            let title = if scene.title.is_empty() { &self.name } else { scene.title.as_str() };
            self.setting = Arc::new(moment::setting(&self.world, &self.built, title));
            self.scene = scene;
            moment::capture(&self.world, Arc::make_mut(&mut self.frame));
        }
        Ok(tuned)
    }

    /// Goes to the last state that is kept of a step or of one before it.
    pub fn back_to(&mut self, step: u64) {
        if let Some(state) = self.history.nearest(step) {
            // a state from before behaviours were changed cannot be gone back to
            if self.world.load(state).is_err() {
                self.history = History::new(MEMORY);
                self.keep();
            }
            Arc::make_mut(&mut self.series).back(&self.world);
            self.see();
            self.before = self.frame.clone();
        }
    }

    /// After a panic, which leaves a step half made: a new world, as it was at a step or, if it panics on the way there too,
    /// at the last state before that is kept.
    fn mend(&mut self, step: u64) {
        for goal in [step, 0] {
            let Ok(Ok((mut world, built))) = guarded(|| self.scene.build()) else { return };
            let kept = self.history.nearest(step).is_some_and(|state| world.load(state).is_ok());
            let goal = if kept { goal } else { 0 };
            if guarded(|| {
                while world.steps() < goal {
                    world.step()
                }
            })
            .is_ok()
            {
                (self.world, self.built) = (world, built);
                break;
            }
        }
        self.explain(self.explained);
        Arc::make_mut(&mut self.series).back(&self.world);
        self.see();
        self.before = self.frame.clone();
    }

    /// What is there now is to be seen.
    pub fn see(&mut self) {
        let mut next = std::mem::replace(&mut self.before, self.frame.clone());
        // memory of moments that nobody looks at any more is used again
        moment::capture(&self.world, Arc::make_mut(&mut next));
        self.frame = next;
    }

    /// How it went so far: counted anew where `fresh`, else now and then.
    pub fn summary(&mut self, fresh: bool) -> Arc<Summary> {
        if fresh || self.summary.0.elapsed().as_secs_f64() > 0.2 {
            self.summary = (Instant::now(), Arc::new(self.world.summary()));
        }
        self.summary.1.clone()
    }

    /// Lets an agent tell why it goes where it goes from now on.
    pub fn explain(&mut self, number: Option<u32>) {
        (self.explained, self.explanation) = (number, None);
        self.world.ask(number.map_or(Asked::Nobody, |number| Asked::Numbers(vec![number])));
    }

    /// Why the agent that is to tell goes where it goes: asked anew where `fresh`, else now and then.
    pub fn explanation(&mut self, fresh: bool) -> Option<Arc<Explanation>> {
        let number = self.explained?;
        let now = Instant::now();
        // a clone of the world makes a sub-step: a large one is asked less often
        let patience = 0.25 + 50.0 * self.cost.step;
        let old = self.explanation.as_ref().is_none_or(|(at, _)| (now - *at).as_secs_f64() > patience);
        if old || fresh {
            let row = (0..self.world.agents().len()).find(|&row| self.world.agents().number[row] == number);
            let why = row.and_then(|row| guarded(|| self.world.explain(self.world.id(row))).ok().flatten());
            self.explanation = why.map(|why| (now, Arc::new(why)));
        }
        self.explanation.as_ref().map(|(_, why)| why.clone())
    }

    fn keep(&mut self) {
        let step = self.world.steps();
        if self.history.wants(step) {
            self.history.push(step, self.world.save());
        }
    }
}

/// Runs code of a scene: a panic in it becomes what it says.
fn guarded<T>(code: impl FnOnce() -> T) -> Result<T, Trouble> {
    caught(code).map_err(Trouble::Panic)
}

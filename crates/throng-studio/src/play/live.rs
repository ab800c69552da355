//! A simulated world: its steps and its saved states.

use super::history::StateHistory;
use super::intervened::{Act, Intervened};
use super::observed::Observed;
use super::playable::Playable;
use super::run_moment::{Cost, Trouble};
use std::sync::Arc;
use throng::{Explanation, Stage as Part, Summary, TraceRequest, World};
use throng_draw::Annotations;
use throng_record::{Frame, Setting, moment};
use throng_scene::{Built, Intervention, Scene, caught};
use web_time::Instant;

/// The memory limit of saved states, bytes.
const MEMORY: usize = 256 << 20;
/// The weight of the last step in the smoothed cost.
const FRESH: f64 = 0.1;

/// A simulated world.
pub(super) struct Live {
    world: World,
    built: Built,
    scene: Arc<Scene>,
    history: StateHistory,
    /// What the user has done to it.
    intervened: Intervened,
    summary: (Instant, Arc<Summary>),
    /// The agent to explain, and the last explanation with its time.
    explained: Option<u32>,
    explanation: Option<(Instant, Arc<Explanation>)>,
}

impl Live {
    /// Builds the world of a scene. Returns it with its setting.
    pub fn new(scene: Arc<Scene>, title: &str) -> Result<(Self, Setting), Trouble> {
        let built = guarded(|| scene.build())?;
        let (world, built) = built.map_err(|error| Trouble::Scene(Box::new(error)))?;
        let setting = moment::setting(&world, &built, title);
        let mut live = Self {
            scene,
            history: StateHistory::new(MEMORY),
            intervened: Intervened::new(&built),
            summary: (Instant::now(), Arc::new(world.summary())),
            explained: None,
            explanation: None,
            built,
            world,
        };
        live.request_traces();
        live.keep();
        Ok((live, setting))
    }

    /// Returns the corners of the box around the scene and the agents at the start.
    pub fn bounds(&self) -> [glam::DVec2; 2] {
        self.built.bounds
    }

    /// Rebuilds the world after a panic, which leaves a step incomplete. The new world is at `step`, or, if the steps
    /// to it panic too, at the last saved state before it.
    fn mend(&mut self, step: u64) {
        for goal in [step, 0] {
            let Ok(Ok((mut world, built))) = guarded(|| self.scene.build()) else { return };
            let kept = self.history.nearest(step).is_some_and(|state| world.load(state).is_ok());
            let goal = if kept { goal } else { 0 };
            let (intervened, scene) = (&mut self.intervened, &self.scene);
            intervened.back();
            let again = || {
                (world.steps()..goal).for_each(|_| {
                    world.step();
                    intervened.step(&mut world, scene);
                })
            };
            if guarded(again).is_ok() {
                (self.world, self.built) = (world, built);
                break;
            }
        }
        self.explain(self.explained);
    }

    /// Requests the traces that the annotations of the scene need, and that of the agent to explain.
    fn request_traces(&mut self) {
        let request = match (Annotations::said(&self.scene).asked(), self.explained) {
            (TraceRequest::None, Some(number)) => TraceRequest::Numbers(vec![number]),
            (request, _) => request,
        };
        self.world.request_traces(request);
    }

    fn keep(&mut self) {
        let step = self.world.steps();
        if self.history.wants(step) {
            self.history.push(step, self.world.save());
        }
    }
}

impl Playable for Live {
    fn steps(&self) -> u64 {
        self.world.steps()
    }

    fn time(&self) -> f64 {
        self.world.time()
    }

    fn over(&self) -> bool {
        self.scene.time.over(&self.world)
    }

    fn step(&mut self, cost: &mut Cost) -> Result<(), Trouble> {
        let (begin, before) = (Instant::now(), self.world.steps());
        let (mut last, mut stages) = (begin, [0.0; 5]);
        let made = guarded(|| {
            self.world.step_in_stages(|stage: Part| {
                let now = Instant::now();
                stages[stage as usize] += (now - last).as_secs_f64();
                last = now;
            });
            self.intervened.step(&mut self.world, &self.scene);
        });
        if made.is_err() {
            self.mend(before);
        }
        made?;
        let share = if self.world.steps() == 1 { 1.0 } else { FRESH };
        let mix = |old: &mut f64, new: f64| *old += (new - *old) * share;
        cost.stages.iter_mut().zip(stages).for_each(|(old, new)| mix(old, new));
        mix(&mut cost.step, begin.elapsed().as_secs_f64());
        self.keep();
        Ok(())
    }

    fn back_to(&mut self, step: u64) {
        self.intervened.back();
        let Some(state) = self.history.nearest(step) else { return };
        // a state saved before the behaviours changed cannot be loaded
        if self.world.load(state).is_err() {
            self.history = StateHistory::new(MEMORY);
            self.keep();
        }
    }

    fn capture(&self, frame: &mut Frame) {
        moment::capture(&self.world, frame);
        frame.explanations = self.explanation.iter().map(|(_, why)| (**why).clone()).collect();
    }

    fn observe(&self) -> Observed {
        (&self.world).into()
    }

    fn summary(&mut self, fresh: bool) -> Arc<Summary> {
        if fresh || self.summary.0.elapsed().as_secs_f64() > 0.2 {
            self.summary = (Instant::now(), Arc::new(self.world.summary()));
        }
        self.summary.1.clone()
    }

    fn explain(&mut self, number: Option<u32>) {
        (self.explained, self.explanation) = (number, None);
        self.request_traces();
    }

    fn explanation(&mut self, fresh: bool, step: f64) -> Option<Arc<Explanation>> {
        let number = self.explained?;
        let now = Instant::now();
        // an explanation clones the world and makes a sub-step, so slow worlds are explained less often
        let patience = 0.25 + 50.0 * step;
        let old = self.explanation.as_ref().is_none_or(|(at, _)| (now - *at).as_secs_f64() > patience);
        if old || fresh {
            let row = (0..self.world.relative_columns().len())
                .find(|&row| self.world.relative_columns().number[row] == number);
            let why = row.and_then(|row| guarded(|| self.world.explain(self.world.id(row))).ok().flatten());
            self.explanation = why.map(|why| (now, Arc::new(why)));
        }
        self.explanation.as_ref().map(|(_, why)| why.clone())
    }

    fn intervene(&mut self, act: &Act) -> Result<(), Trouble> {
        let (world, scene) = (&mut self.world, &self.scene);
        guarded(|| self.intervened.act(act, world, scene))?.map_err(Trouble::Refused)?;
        // the states from here on are those without it
        self.history.forget_from(self.world.steps());
        self.keep();
        Ok(())
    }

    fn interventions(&self) -> Arc<[Intervention]> {
        self.intervened.made().clone()
    }

    fn changed_setting(&self, shown: &Setting) -> Option<Setting> {
        let intervened = !(self.scene.interventions.is_empty() && self.intervened.made().is_empty());
        let changed = intervened && !self.world.place().obstacles().eq(&shown.obstacles);
        changed.then(|| moment::setting(&self.world, &self.built, &shown.title))
    }

    fn tune(&mut self, new: &Arc<Scene>, old: &Scene, title: &str) -> Result<Option<Setting>, Trouble> {
        if self.intervened.explains(new, old) {
            // a world with these interventions among its rules goes on from the state
            let (mut live, _) = Self::new(new.clone(), title)?;
            if live.world.load(&self.world.save()).is_ok() {
                (self.world, self.built, self.scene) = (live.world, live.built, new.clone());
                self.intervened = Intervened::new(&self.built);
                self.request_traces();
                return Ok(Some(moment::setting(&self.world, &self.built, title)));
            }
        }
        let tuned = guarded(|| new.tune(old, &mut self.world, &mut self.built))?;
        let tuned = tuned.map_err(|error| Trouble::Scene(Box::new(error)))?;
        if tuned {
            self.scene = new.clone();
            self.request_traces();
        }
        Ok(tuned.then(|| moment::setting(&self.world, &self.built, title)))
    }

    fn hash(&self) -> u64 {
        self.world.state_hash()
    }

    fn kept(&self) -> usize {
        self.history.bytes()
    }
}

/// Runs code of a scene and turns a panic into an error.
pub(crate) fn guarded<T>(code: impl FnOnce() -> T) -> Result<T, Trouble> {
    caught(code).map_err(Trouble::Panic)
}

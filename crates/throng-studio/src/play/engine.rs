//! The engine of playback: it takes commands, makes the steps that are due, and publishes states.

use super::intervened::Act;
use super::meter::Meter;
use super::pace::{Pace, Speed};
use super::reel::{Film, Reel};
use super::run::PlayedRun;
use super::run_moment::{RunMoment, Trouble};
use std::sync::Arc;
use std::time::Duration;
use throng_scene::{Model, Scene};
use web_time::Instant;

/// A command for a player.
#[derive(Clone, Debug)]
pub enum Command {
    /// Loads a scene and shows its start, running or paused. If it cannot be built, the previous run continues.
    Load {
        /// The name.
        name: Arc<str>,
        /// The scene.
        scene: Arc<Scene>,
        /// Whether it starts running.
        run: bool,
    },
    /// Replaces the scene. If only groups changed, the run continues from its current state. Otherwise the new scene
    /// starts again.
    Change {
        /// The name.
        name: Arc<str>,
        /// The scene.
        scene: Arc<Scene>,
    },
    /// Replays a trajectory file from its start, running or paused. If it cannot be read, the previous run continues.
    Replay {
        /// The file.
        film: Film,
        /// Whether it starts running.
        run: bool,
    },
    /// Sets whether a change that the run cannot follow starts the scene again. Otherwise the run goes on with the scene
    /// as it was, and the change waits for [`Command::Restart`].
    Restarts(bool),
    /// Runs. After the end, starts again.
    Run,
    /// Pauses.
    Pause,
    /// Goes to a step, forward or back, and pauses there.
    Seek(u64),
    /// Makes one step and pauses.
    Step,
    /// Goes one step back and pauses.
    Back,
    /// Starts again.
    Restart,
    /// Starts again with another seed.
    Seed(u64),
    /// Sets the playback speed.
    Speed(Speed),
    /// Sets the agent to explain, by number.
    Explain(Option<u32>),
    /// Runs the scene with a second model on the same clock, or with one model only.
    Beside(Option<Model>),
    /// Sets the meters of this run and of later runs.
    Meters(Arc<[Meter]>),
    /// Sets whether people follow the agents, so that they can be drawn.
    People(bool),
    /// Changes the run at its current moment. It goes on, running or paused.
    Intervene(Act),
}

/// Plays scenes: give it a [`command`](Self::command), let it [`work`](Self::work), and read the published state
/// ([`shown`](Self::shown)).
pub struct Engine {
    run: Option<PlayedRun>,
    /// The same scene with a second model, on the same clock.
    beside: Option<PlayedRun>,
    model: Option<Model>,
    /// The number of the run: of all runs so far.
    number: u64,
    pace: Pace,
    playing: bool,
    /// The step to reach as fast as possible.
    goal: Option<u64>,
    explained: Option<u32>,
    meters: Arc<[Meter]>,
    people: bool,
    restarts: bool,
    /// The changed scene that waits for a restart.
    waiting: Option<Arc<Scene>>,
    trouble: Option<Trouble>,
}

impl Default for Engine {
    fn default() -> Self {
        Self {
            run: None,
            beside: None,
            model: None,
            number: 0,
            pace: Pace::new(Speed::Times(1.0), Instant::now()),
            playing: false,
            goal: None,
            explained: None,
            meters: Arc::from([]),
            people: false,
            restarts: true,
            waiting: None,
            trouble: None,
        }
    }
}

impl Engine {
    /// Executes a command.
    pub fn command(&mut self, command: Command) {
        match command {
            Command::Load { name, scene, run } => self.load(name, scene, run),
            Command::Replay { film, run } => match Reel::open(&film) {
                Ok(reel) => self.begin(PlayedRun::replay(Arc::new(reel), &self.meters), run),
                Err(says) => self.trouble = Some(Trouble::Film(says)),
            },
            Command::Change { name, scene } => self.change(name, scene),
            Command::Restarts(restarts) => self.restarts = restarts,
            Command::Run if self.over() => {
                self.restart(None);
                self.playing = true;
            }
            Command::Run => (self.playing, self.goal) = (self.run.is_some(), None),
            Command::Pause => (self.playing, self.goal) = (false, None),
            Command::Seek(step) => self.seek(step),
            Command::Step => self.seek(self.step() + 1),
            Command::Back => self.seek(self.step().saturating_sub(1)),
            Command::Restart => self.restart(None),
            Command::Seed(seed) => self.restart(Some(seed)),
            Command::Speed(speed) => self.pace = Pace::new(speed, Instant::now()),
            Command::Meters(meters) => {
                if let Some(run) = &mut self.run {
                    Arc::make_mut(&mut run.series).meter(&run.stage.observe(), &meters);
                }
                self.meters = meters;
            }
            Command::People(wanted) => self.people = wanted,
            Command::Intervene(act) => self.intervene(&act),
            Command::Explain(number) => {
                self.explained = number;
                self.run.iter_mut().chain(&mut self.beside).for_each(|run| run.stage.explain(number));
            }
            Command::Beside(model) => {
                self.model = model;
                self.put_beside();
            }
        }
    }

    fn load(&mut self, name: Arc<str>, scene: Arc<Scene>, go: bool) {
        match PlayedRun::new(name, scene, &self.meters) {
            Ok(run) => self.begin(run, go),
            Err(trouble) => self.trouble = Some(trouble),
        }
    }

    fn begin(&mut self, mut run: PlayedRun, go: bool) {
        self.waiting = None;
        run.stage.explain(self.explained);
        self.number += 1;
        (self.run, self.trouble, self.goal, self.playing) = (Some(run), None, None, go);
        self.put_beside();
    }

    fn intervene(&mut self, act: &Act) {
        let done = self.run.iter_mut().chain(&mut self.beside).try_for_each(|run| run.intervene(act));
        match done {
            Ok(()) if matches!(self.trouble, Some(Trouble::Refused(_))) => self.trouble = None,
            Ok(()) => {}
            Err(trouble) => self.trouble = Some(trouble),
        }
    }

    fn change(&mut self, name: Arc<str>, scene: Arc<Scene>) {
        let changed = self.run.as_mut().filter(|run| run.name == name).map(|run| run.change(scene.clone()));
        match changed {
            Some(Ok(true)) => {
                (self.trouble, self.waiting) = (None, None);
                self.put_beside();
            }
            Some(Err(trouble)) => self.trouble = Some(trouble),
            Some(Ok(false)) if !self.restarts && self.step() > 0 => self.waiting = Some(scene),
            Some(Ok(false)) | None => self.load(name, scene, self.playing),
        }
    }

    /// Starts the run with the second model. It catches up with the main run.
    fn put_beside(&mut self) {
        self.beside = None;
        let (Some(run), Some(model)) = (&self.run, &self.model) else { return };
        if run.stage.reel().is_some() {
            return;
        }
        let scene = run.scene.with_model(model).map_err(|error| Trouble::Scene(Box::new(error)));
        match scene.and_then(|scene| PlayedRun::new(run.name.clone(), Arc::new(scene), &self.meters)) {
            Ok(mut beside) => {
                beside.stage.explain(self.explained);
                self.beside = Some(beside);
            }
            Err(trouble) => self.trouble = Some(trouble),
        }
    }

    fn restart(&mut self, seed: Option<u64>) {
        let Some(run) = &self.run else { return };
        if let Some(reel) = run.stage.reel() {
            return self.begin(PlayedRun::replay(reel, &self.meters), self.playing);
        }
        let mut scene = self.waiting.take().unwrap_or_else(|| run.scene.clone());
        if let Some(seed) = seed.filter(|seed| *seed != scene.seed) {
            Arc::make_mut(&mut scene).seed = seed;
        }
        self.load(run.name.clone(), scene, self.playing);
    }

    fn seek(&mut self, step: u64) {
        self.playing = false;
        self.goal = Some(step);
        for run in self.run.iter_mut().chain(&mut self.beside).filter(|run| step < run.stage.steps()) {
            run.back_to(step);
            self.trouble = None;
        }
    }

    fn step(&self) -> u64 {
        self.run.as_ref().map_or(0, |run| run.stage.steps())
    }

    fn over(&self) -> bool {
        self.run.is_some() && self.runs().all(|run| run.stage.over())
    }

    /// Makes the steps that are due, until `budget` is used up. The last step may exceed the budget. Returns whether
    /// there is a new state to publish.
    pub fn work(&mut self, budget: Duration) -> bool {
        let begin = Instant::now();
        self.pace.pass(begin, self.playing);
        let mut made = 0;
        while begin.elapsed() < budget {
            let until = self.until();
            let Some(run) = self.next() else { break };
            if let Err(trouble) = run.step() {
                (self.trouble, self.playing, self.goal) = (Some(trouble), false, None);
                return true;
            }
            made += 1;
            run.pass(until.saturating_sub(run.stage.steps()));
        }
        for run in self.run.iter_mut().chain(&mut self.beside).filter(|run| run.frame.time != run.stage.time()) {
            run.see();
        }
        let (over, lagging) = (self.over(), self.lagging().is_some());
        let Some(run) = &mut self.run else { return false };
        if begin.elapsed() >= budget {
            self.pace.let_go(run.scene.time.step);
        }
        let usage = match self.pace.speed {
            Speed::Fastest => 1.0,
            Speed::Times(times) => {
                (run.cost.step + self.beside.as_ref().map_or(0.0, |run| run.cost.step)) * times / run.scene.time.step
            }
        };
        run.cost.usage = if self.playing { usage } else { 0.0 };
        let arrived = !lagging && self.goal.is_some();
        if arrived {
            self.goal = None;
            // a trajectory file, and a run beside another one, may end before the goal
            self.run.iter_mut().chain(&mut self.beside).for_each(|run| run.wake.arrive());
        }
        let ended = self.playing && over;
        if ended {
            self.playing = false;
        }
        made > 0 || arrived || ended
    }

    /// Returns the run that makes the next step, if one is due: a run that lags, or else the first that has not ended.
    fn next(&mut self) -> Option<&mut PlayedRun> {
        let at = match self.lagging() {
            Some(at) => at,
            None if self.playing && self.goal.is_none() => {
                let next = self.runs().position(|run| !run.stage.over())?;
                let step = self.run.as_ref()?.scene.time.step;
                self.pace.take(step).then_some(next)?
            }
            None => return None,
        };
        self.run.iter_mut().chain(&mut self.beside).nth(at)
    }

    /// Returns the step that all runs are to reach: the goal, or that of the run ahead.
    fn until(&self) -> u64 {
        self.goal.or_else(|| self.runs().map(|run| run.stage.steps()).max()).unwrap_or(0)
    }

    /// Returns the index of the run that is behind the step to reach, or behind the other run.
    fn lagging(&self) -> Option<usize> {
        let until = self.until();
        // of two runs each stays at its own end, and a trajectory file has a last moment
        let stays = |run: &PlayedRun| run.stage.over() && (self.beside.is_some() || run.stage.reel().is_some());
        self.runs().position(|run| run.stage.steps() < until && !stays(run))
    }

    /// Returns the runs, the main run first.
    fn runs(&self) -> impl Iterator<Item = &PlayedRun> {
        self.run.iter().chain(&self.beside)
    }

    /// Returns how long the engine has nothing to do, `None` until the next command.
    pub fn idle(&self) -> Option<Duration> {
        let run = self.run.as_ref()?;
        match (self.goal, self.playing) {
            (Some(_), _) => Some(Duration::ZERO),
            _ if self.lagging().is_some() => Some(Duration::ZERO),
            (None, true) => Some(self.pace.wait(run.scene.time.step)),
            (None, false) => None,
        }
    }

    /// Returns the current state, `None` before the first scene.
    pub fn shown(&mut self) -> Option<Arc<RunMoment>> {
        // a run on the way to a step shows states for a moment only
        let hurries = [self.lagging().is_some() || self.goal.is_some(), self.goal.is_some()];
        let [beside, main] = hurries.map(|hurry| (self.people, hurry));
        let now = (self.number, self.playing, self.pace);
        let beside = self.beside.as_mut().map(|run| Arc::new(Self::show(run, now, beside, None)));
        let run = self.run.as_mut()?;
        Some(Arc::new(RunMoment { waits: self.waiting.is_some(), ..Self::show(run, now, main, beside) }))
    }

    fn show(
        run: &mut PlayedRun,
        (number, playing, pace): (u64, bool, Pace),
        (people, hurry): (bool, bool),
        beside: Option<Arc<RunMoment>>,
    ) -> RunMoment {
        RunMoment {
            name: run.name.clone(),
            scene: run.scene.clone(),
            setting: run.setting.clone(),
            first: run.first.clone(),
            bounds: run.bounds,
            run: number,
            frame: run.frame.clone(),
            before: run.before.clone(),
            step: run.stage.steps(),
            seed: run.scene.seed,
            playing,
            over: run.stage.over(),
            cost: run.cost,
            series: run.series.clone(),
            summary: run.stage.summary(!playing),
            explanation: run.stage.explanation(!playing, run.cost.step),
            hash: run.stage.hash(),
            interventions: run.stage.interventions(),
            waits: false,
            kept: run.stage.kept(),
            reel: run.stage.reel(),
            pace,
            people: run.poses(people, hurry),
            figures: run.figures.clone(),
            arriving: hurry,
            wake: run.wake.moments().into(),
            beside,
        }
    }

    /// Returns the last error.
    pub fn trouble(&self) -> Option<Trouble> {
        self.trouble.clone()
    }
}

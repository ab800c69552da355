//! The engine of playback: it takes commands, makes the steps that are due, and publishes states.

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
}

/// Plays scenes: give it a [`command`](Self::command), let it [`work`](Self::work), and read the published state
/// ([`shown`](Self::shown)).
pub struct Engine {
    run: Option<PlayedRun>,
    /// The same scene with a second model, on the same clock.
    beside: Option<PlayedRun>,
    model: Option<Model>,
    /// The number of runs so far.
    runs: u64,
    pace: Pace,
    playing: bool,
    /// The step to reach as fast as possible.
    goal: Option<u64>,
    explained: Option<u32>,
    meters: Arc<[Meter]>,
    people: bool,
    trouble: Option<Trouble>,
}

impl Default for Engine {
    fn default() -> Self {
        Self {
            run: None,
            beside: None,
            model: None,
            runs: 0,
            pace: Pace::new(Speed::Times(1.0), Instant::now()),
            playing: false,
            goal: None,
            explained: None,
            meters: Arc::from([]),
            people: false,
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
        run.stage.explain(self.explained);
        self.runs += 1;
        (self.run, self.trouble, self.goal, self.playing) = (Some(run), None, None, go);
        self.put_beside();
    }

    fn change(&mut self, name: Arc<str>, scene: Arc<Scene>) {
        let changed = self.run.as_mut().filter(|run| run.name == name).map(|run| run.change(scene.clone()));
        match changed {
            Some(Ok(true)) => {
                self.trouble = None;
                self.put_beside();
            }
            Some(Err(trouble)) => self.trouble = Some(trouble),
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
        let mut scene = run.scene.clone();
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
        self.run.is_some() && self.run.iter().chain(&self.beside).all(|run| run.stage.over())
    }

    /// Makes the steps that are due, until `budget` is used up. The last step may exceed the budget. Returns whether
    /// there is a new state to publish.
    pub fn work(&mut self, budget: Duration) -> bool {
        let begin = Instant::now();
        self.pace.pass(begin, self.playing);
        let mut made = 0;
        while begin.elapsed() < budget && (self.lags() || self.due()) {
            let next = if self.lags() { &mut self.beside } else { &mut self.run };
            let Some(run) = next else { break };
            if let Err(trouble) = run.step() {
                (self.trouble, self.playing, self.goal) = (Some(trouble), false, None);
                return true;
            }
            made += 1;
            let step = run.stage.steps();
            // on the way to a step, only the last two states are captured
            if self.goal.is_none_or(|goal| step + 1 >= goal) {
                run.see();
            }
        }
        for run in self.run.iter_mut().chain(&mut self.beside).filter(|run| run.frame.time != run.stage.time()) {
            run.see();
        }
        let (over, lags) = (self.over(), self.lags());
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
        let last = run.stage.reel().is_some() && run.stage.over();
        let arrived = !lags && self.goal.is_some_and(|goal| last || run.stage.steps() >= goal);
        if arrived {
            self.goal = None;
        }
        let ended = self.playing && over;
        if ended {
            self.playing = false;
        }
        made > 0 || arrived || ended
    }

    /// Whether the run with the second model is behind.
    fn lags(&self) -> bool {
        self.beside.as_ref().is_some_and(|beside| beside.stage.steps() < self.step())
    }

    /// Whether the main run is to make a step now.
    fn due(&mut self) -> bool {
        let over = self.over();
        let Some(run) = &self.run else { return false };
        match self.goal {
            // a trajectory file has a last moment
            Some(goal) => run.stage.steps() < goal && !(run.stage.over() && run.stage.reel().is_some()),
            None => self.playing && !over && self.pace.take(run.scene.time.step),
        }
    }

    /// Returns how long the engine has nothing to do, `None` until the next command.
    pub fn idle(&self) -> Option<Duration> {
        let run = self.run.as_ref()?;
        match (self.goal, self.playing) {
            (Some(_), _) => Some(Duration::ZERO),
            _ if self.lags() => Some(Duration::ZERO),
            (None, true) => Some(self.pace.wait(run.scene.time.step)),
            (None, false) => None,
        }
    }

    /// Returns the current state, `None` before the first scene.
    pub fn shown(&mut self) -> Option<Arc<RunMoment>> {
        // a run on the way to a step shows states for a moment only
        let hurries = [self.lags() || self.goal.is_some(), self.goal.is_some()];
        let [beside, main] = hurries.map(|hurry| (self.people, hurry));
        let now = (self.runs, self.playing, self.pace);
        let beside = self.beside.as_mut().map(|run| Arc::new(Self::show(run, now, beside, None)));
        let run = self.run.as_mut()?;
        Some(Arc::new(Self::show(run, now, main, beside)))
    }

    fn show(
        run: &mut PlayedRun,
        (runs, playing, pace): (u64, bool, Pace),
        (people, hurry): (bool, bool),
        beside: Option<Arc<RunMoment>>,
    ) -> RunMoment {
        RunMoment {
            name: run.name.clone(),
            scene: run.scene.clone(),
            setting: run.setting.clone(),
            first: run.first.clone(),
            bounds: run.bounds,
            run: runs,
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
            kept: run.stage.kept(),
            reel: run.stage.reel(),
            pace,
            people: run.poses(people, hurry),
            beside,
        }
    }

    /// Returns the last error.
    pub fn trouble(&self) -> Option<Trouble> {
        self.trouble.clone()
    }
}

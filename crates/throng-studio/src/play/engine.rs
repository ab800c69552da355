//! What plays: it takes commands, makes the steps that are due, and tells what there is to see.

use super::meter::Meter;
use super::pace::{Pace, Speed};
use super::reel::{Film, Reel};
use super::run::Run;
use super::shown::{Shown, Trouble};
use std::sync::Arc;
use std::time::Duration;
use throng_scene::{Model, Scene};
use web_time::Instant;

/// What one can tell a player to do.
#[derive(Clone, Debug)]
pub enum Command {
    /// Plays another scene from its start, paused or not; if it cannot be built, the one before goes on.
    Load {
        /// What it is called.
        name: Arc<str>,
        /// The scene.
        scene: Arc<Scene>,
        /// Whether it begins to run.
        run: bool,
    },
    /// Lets the run go on as another scene says, if only its groups are others; else plays that from its start.
    Change {
        /// What it is called.
        name: Arc<str>,
        /// The scene.
        scene: Arc<Scene>,
    },
    /// Replays a file of trajectories from its start, paused or not; if it cannot be read, what was there before goes on.
    Replay {
        /// The file.
        film: Film,
        /// Whether it begins to run.
        run: bool,
    },
    /// Goes on; after the end, from the start.
    Run,
    /// Stops.
    Pause,
    /// Stops at a step, wherever it is: on from here, or back.
    Seek(u64),
    /// Stops a step later.
    Step,
    /// Stops a step earlier.
    Back,
    /// Begins again.
    Restart,
    /// Begins again with another seed.
    Seed(u64),
    /// Plays faster or slower.
    Speed(Speed),
    /// Which agent tells why it goes where it goes, by number.
    Explain(Option<u32>),
    /// Plays the scene with another model beside it, on the same clock; or nothing.
    Beside(Option<Model>),
    /// What measures parts of the ground, in this run and those after it.
    Meters(Arc<[Meter]>),
}

/// Plays scenes: [`command`](Self::command) it, let it [`work`](Self::work), and look at what is [`shown`](Self::shown).
pub struct Engine {
    run: Option<Run>,
    /// The same scene with another model, on the same clock.
    beside: Option<Run>,
    model: Option<Model>,
    /// How many runs have begun.
    runs: u64,
    pace: Pace,
    playing: bool,
    /// The step it is on its way to, however fast that goes.
    goal: Option<u64>,
    explained: Option<u32>,
    meters: Arc<[Meter]>,
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
            trouble: None,
        }
    }
}

impl Engine {
    /// Does what it is told.
    pub fn command(&mut self, command: Command) {
        match command {
            Command::Load { name, scene, run } => self.load(name, scene, run),
            Command::Replay { film, run } => match Reel::open(&film) {
                Ok(reel) => self.begin(Run::replay(Arc::new(reel), &self.meters), run),
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
        match Run::new(name, scene, &self.meters) {
            Ok(run) => self.begin(run, go),
            Err(trouble) => self.trouble = Some(trouble),
        }
    }

    fn begin(&mut self, mut run: Run, go: bool) {
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

    /// Begins to play the scene with the other model; it catches up.
    fn put_beside(&mut self) {
        self.beside = None;
        let (Some(run), Some(model)) = (&self.run, &self.model) else { return };
        if run.stage.reel().is_some() {
            return;
        }
        let scene = run.scene.with_model(model).map_err(|error| Trouble::Scene(Box::new(error)));
        match scene.and_then(|scene| Run::new(run.name.clone(), Arc::new(scene), &self.meters)) {
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
            return self.begin(Run::replay(reel, &self.meters), self.playing);
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

    /// Makes the steps that are due, for as long as `budget` at most, or until one more is made than fits; whether there is
    /// something new to see.
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
            // on the way to a step only the last two are looked at
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

    /// Whether what is beside is behind.
    fn lags(&self) -> bool {
        self.beside.as_ref().is_some_and(|beside| beside.stage.steps() < self.step())
    }

    /// Whether a step is to be made now.
    fn due(&mut self) -> bool {
        let over = self.over();
        let Some(run) = &self.run else { return false };
        match self.goal {
            // a film ends
            Some(goal) => run.stage.steps() < goal && !(run.stage.over() && run.stage.reel().is_some()),
            None => self.playing && !over && self.pace.take(run.scene.time.step),
        }
    }

    /// How long nothing is to be done; `None`: until the next command.
    pub fn idle(&self) -> Option<Duration> {
        let run = self.run.as_ref()?;
        match (self.goal, self.playing) {
            (Some(_), _) => Some(Duration::ZERO),
            _ if self.lags() => Some(Duration::ZERO),
            (None, true) => Some(self.pace.wait(run.scene.time.step)),
            (None, false) => None,
        }
    }

    /// What there is to see; `None` before the first scene.
    pub fn shown(&mut self) -> Option<Arc<Shown>> {
        let beside =
            self.beside.as_mut().map(|run| Arc::new(Self::show(run, (self.runs, self.playing, self.pace), None)));
        let run = self.run.as_mut()?;
        Some(Arc::new(Self::show(run, (self.runs, self.playing, self.pace), beside)))
    }

    fn show(run: &mut Run, (runs, playing, pace): (u64, bool, Pace), beside: Option<Arc<Shown>>) -> Shown {
        Shown {
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
            beside,
        }
    }

    /// What went wrong last.
    pub fn trouble(&self) -> Option<Trouble> {
        self.trouble.clone()
    }
}

//! The files of a replay: pictures of both, tables of the replayed.

use super::args::ReplayArgs;
use super::kinds::Kinds;
use super::stage;
use crate::failure::Failure;
use crate::files::{self, distinct, written};
use std::sync::Arc;
use throng_draw::Sheet;
use throng_draw::record::{Moment, Pace, Plan, Recorder};
use throng_record::pedestrian::replay::{Cast, Replay, Seen, Stage};
use throng_record::{Choice, Format, Frame, Pool, Setting};
use throng_scene::Scene;

/// All files. They get their names when they are complete; dropped before that, they leave nothing.
pub struct Outputs<'a> {
    films: Vec<Recorder>,
    tables: Vec<Recorder>,
    pace: Pace,
    frames: Pool<Frame>,
    seen: Seen<'a>,
    cast: &'a Cast,
    kinds: &'a Kinds,
    /// Time of the last picture.
    last: Option<f64>,
}

impl<'a> Outputs<'a> {
    /// Begins all files.
    ///
    /// # Errors
    /// A name does not say what to write or comes twice, or a file cannot be begun.
    pub fn create(
        args: &ReplayArgs,
        scene: &Scene,
        stage: &Stage,
        cast: &'a Cast,
        kinds: &'a Kinds,
    ) -> Result<Self, Failure> {
        distinct(&args.output)?;
        let panel = stage::style(args, scene, cast)?;
        let (style, columns) = args.film.look.side_by_side(panel, 2, stage::bounds(cast));
        let setting = |title: &str| Setting {
            title: title.to_owned(),
            walkable: stage.walkable.clone(),
            obstacles: stage.obstacles.clone(),
            groups: kinds.names.clone(),
            origin: stage.settings.origin,
            ..Setting::default()
        };
        let title = args.data.display().to_string();
        let (rate, still) = (args.film.rate(scene), args.film.still());
        let alone = setting(&title);
        let (speed_up, choice) = (args.film.speed_up, Choice::default());
        let plan = Plan { setting: &alone, style: &style, rate, speed_up, still, from: args.from, choice: &choice };
        let (mut films, mut tables) = (Vec::new(), Vec::new());
        for path in &args.output {
            if !path.is_dir() && Format::of(path).is_some_and(|format| format.is_written()) {
                tables.push(Recorder::create(path, &plan)?);
            } else {
                let panels = vec![setting("recorded"), setting(&args.stage.model)];
                let sheet = Sheet { title: title.clone(), panels, columns };
                films.push(Recorder::film(files::film(path, sheet, &style, rate, &written())?.still(still)));
            }
        }
        let pace = Pace::new(cast.people.moments[0].time, args.film.speed_up / rate);
        let (frames, seen) = (Pool::default(), Seen::new(cast));
        Ok(Self { films, tables, pace, frames, seen, cast, kinds, last: None })
    }

    /// Takes in the replay after a step (and before the first).
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push(&mut self, replay: &Replay) -> Result<(), Failure> {
        let (time, step) = (replay.time(), replay.world().settings().step);
        if !self.tables.is_empty() {
            let frames = vec![self.make(|_, frame| replay.capture(frame))];
            Recorder::push_all(&mut self.tables, &Moment { frames, pictures: 0, rows: true })?;
        }
        match self.pace.due(time, step) {
            0 => Ok(()),
            pictures => self.show(replay, pictures),
        }
    }

    fn show(&mut self, replay: &Replay, pictures: u64) -> Result<(), Failure> {
        let time = replay.time();
        self.last = Some(time);
        if !self.films.is_empty() {
            let recorded = self.make(|seen, frame| seen.capture(time, frame));
            let frames = vec![recorded, self.make(|_, frame| replay.capture(frame))];
            Recorder::push_all(&mut self.films, &Moment { frames, pictures, rows: false })?;
        }
        Ok(())
    }

    /// A moment in which everybody has the colour of their kind.
    fn make(&mut self, capture: impl FnOnce(&Seen, &mut Frame)) -> Arc<Frame> {
        let Self { frames, seen, cast, kinds, .. } = self;
        frames.make(|frame| {
            capture(seen, frame);
            frame.bodies.iter_mut().for_each(|body| body.group = kinds.find(cast, body.number));
        })
    }

    /// Shows the end, if no picture did yet, and completes all files.
    ///
    /// # Errors
    /// A file cannot be completed.
    pub fn finish(mut self, replay: &Replay) -> Result<(), Failure> {
        if self.last != Some(replay.time()) {
            self.show(replay, 1)?;
        }
        Ok(self.films.into_iter().chain(self.tables).try_for_each(Recorder::finish)?)
    }
}

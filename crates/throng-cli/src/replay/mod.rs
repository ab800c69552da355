//! `throng replay`: recorded people once more, by a model, beside what they did.

pub mod args;
mod json;
mod kinds;
mod outputs;
mod report;
mod stage;
mod table;
mod text;

use crate::failure::Failure;
use crate::files::is;
use crate::interrupt;
use crate::map::{Map, beside};
use crate::out::{Out, complain};
use crate::progress::Progress;
use crate::threads::{self, Workers};
use args::ReplayArgs;
use kinds::{Kinds, together};
use outputs::Outputs;
use report::{Predicted, Report};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use throng_record::pedestrian::People;
use throng_record::pedestrian::replay::{Cast, Replay, Replayed, Stage, predict};
use throng_record::{Output, Spot, Tracks};
use throng_scene::Scene;

/// Rounding of times, seconds.
const ROUNDING: f64 = 1e-9;

/// Replays recorded people, writes the files and the figures.
///
/// # Errors
/// The data, the map or the groups cannot be read, a file cannot be written, or it was interrupted.
pub fn replay(args: &ReplayArgs, out: &mut Out) -> Result<(), Failure> {
    let begin = Instant::now();
    if let Some(path) = args.table.as_ref().filter(|path| !is(path, "csv")) {
        let text = format!("--table {}: tables of people are .csv", path.display());
        return Err(Failure::hint(text, "end the name in .csv"));
    }
    let scene = stage::scene(args)?;
    let tracks = args.tracks.read(&args.data)?;
    let cast = cast(args, &tracks)?;
    let map = match args.stage.no_map {
        true => Map::default(),
        false => Map::read(&args.stage.map, &args.data, &tracks.setting, beside(&args.data, "map.xml"))?,
    };
    let stage = stage::stage(args, &scene, &cast, &map)?;
    let groups = together(&args.stage, &args.data)?;
    let kinds = Kinds::of(&tracks, &cast, groups.as_deref());
    drop(tracks);
    interrupt::watch();
    let replayed = threads::with(args.threads.count(), || walk(args, &scene, &stage, &cast, &kinds))?;
    let predicted = predictions(args, &stage, &cast)?;
    let report = Report::new(args, &stage, &cast, map.path, groups, replayed, predicted);
    if let Some(path) = &args.table {
        table::table(&report).write_csv(Output::create(path)?)?;
    }
    if args.json {
        out.line(format_args!("{}", json::of(&report, begin.elapsed())))?;
    } else if !args.quiet {
        out.text(text::of(&report).as_bytes())?;
    }
    out.flush()?;
    if report.interrupted {
        if !args.quiet {
            complain("interrupted; the figures and the files are complete up to there");
        }
        return Err(Failure::Interrupted);
    }
    Ok(())
}

/// Who was recorded.
fn cast(args: &ReplayArgs, tracks: &Tracks) -> Result<Cast, Failure> {
    let name = args.data.display();
    if tracks.spots.iter().any(|spot| spot.place.z != 0.0) {
        let text = format!("{name}: somebody is above the ground, and only people who walk are replayed");
        return Err(Failure::Error(text));
    }
    let until = args.until.unwrap_or(f64::INFINITY);
    if until <= args.from {
        let text = format!("--until {until}: it begins at {} s", args.from);
        return Err(Failure::hint(text, "give --until more than --from"));
    }
    let within = args.from - ROUNDING..=until + ROUNDING;
    let mut people = People::of(tracks, |spot: &Spot| within.contains(&spot.time));
    if let Some(radius) = args.stage.radius {
        people.walks.iter_mut().for_each(|walk| walk.radius = radius);
    }
    let cast = Cast::new(&people, args.stage.speed, args.figures.interval);
    if cast.people.walks.is_empty() {
        let to = args.until.map_or_else(|| "the end".to_owned(), |until| format!("{until} s"));
        let text = format!("{name}: nobody was seen twice from {} s to {to}", args.from);
        return Err(Failure::hint(text, "change --from and --until"));
    }
    Ok(cast)
}

/// Lets everybody walk, and writes the files.
fn walk(args: &ReplayArgs, scene: &Scene, stage: &Stage, cast: &Cast, kinds: &Kinds) -> Result<Replayed, Failure> {
    let times = cast.times();
    let (start, end) = (times[0], times[times.len() - 1]);
    let mut outputs = Outputs::create(args, scene, stage, cast, kinds)?;
    let refused = |error| refused(args, error);
    let mut replay = Replay::new(stage, cast, start, times).map_err(refused)?;
    let progress = Progress::new(args.quiet);
    outputs.push(&replay)?;
    while replay.time() < end - ROUNDING && !interrupt::asked() {
        replay.step().map_err(refused)?;
        outputs.push(&replay)?;
        progress.show((replay.time() - start) / (end - start), || {
            format!("{:.1} s, {} of {} gone", replay.time(), replay.gone(), cast.people.walks.len())
        });
    }
    progress.done();
    outputs.finish(&replay)?;
    Ok(replay.finish())
}

/// Begins anew so often, and looks ahead.
fn predictions(args: &ReplayArgs, stage: &Stage, cast: &Cast) -> Result<Option<Predicted>, Failure> {
    let every = args.figures.every;
    if every == 0.0 || interrupt::asked() {
        return Ok(None);
    }
    let mut starts: Vec<f64> = Vec::new();
    for time in cast.times() {
        if starts.last().is_none_or(|last| time >= last + every - ROUNDING) {
            starts.push(time);
        }
    }
    let (count, horizons) = (starts.len(), &args.figures.horizons);
    let workers = Workers::new(args.threads.count(), count)?;
    let world = stage.world().map_err(|error| refused(args, error))?;
    let (progress, done) = (Progress::new(args.quiet), AtomicUsize::new(0));
    let ahead = |start: f64| {
        if interrupt::asked() {
            return Ok(None);
        }
        let samples = predict(stage, cast, world.clone(), start, horizons)?;
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.show(done as f64 / count as f64, || format!("{done} of {count} predictions"));
        Ok(Some(samples))
    };
    let all: Result<Vec<_>, throng::Error> = workers.map(starts, ahead).into_iter().collect();
    progress.done();
    let all: Vec<_> = all.map_err(|error| refused(args, error))?.into_iter().flatten().collect();
    let mut samples = vec![Vec::new(); horizons.len()];
    let moments = all.len();
    for (all, more) in all.into_iter().flat_map(|one| one.into_iter().enumerate()) {
        samples[all].extend(more);
    }
    Ok(Some(Predicted { every, moments, samples }))
}

/// What the world refused.
fn refused(args: &ReplayArgs, error: throng::Error) -> Failure {
    Failure::Error(format!("{}: {error}", args.data.display()))
}

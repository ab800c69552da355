//! The setup of a replay: the recorded people, the ground they walk on, and the models.

use super::args::ReplayArgs;
use super::kinds::{Kinds, together};
use super::stage;
use crate::failure::Failure;
use crate::map::{Map, beside};
use crate::models::models;
use crate::tracks::limit;
use std::path::PathBuf;
use throng_record::pedestrian::replay::{RecordedPeople, ReplayScene};
use throng_record::pedestrian::{People, Walk};
use throng_record::{Sample, Setting, Trajectories};
use throng_scene::Scene;

/// The tolerance for rounded times, seconds.
pub const ROUNDING: f64 = 1e-9;

/// The setup of a replay.
pub struct Setup<'a> {
    /// The arguments.
    pub args: &'a ReplayArgs,
    /// The labels of the models.
    pub models: Vec<String>,
    /// The scene of the first model, with one person that stands for all people.
    pub scene: Scene,
    /// The ground and the agents, by model.
    pub stages: Vec<ReplayScene>,
    /// The recorded people.
    pub cast: RecordedPeople,
    /// The file of the map; `None` if the map is that of the recording.
    pub map: Option<PathBuf>,
    /// Notes on the recording, and on parts of the map that were left out or changed.
    pub notes: Vec<String>,
    /// The groups of people that walk together.
    pub groups: Option<Vec<Vec<u32>>>,
    /// The colour classes of people in pictures.
    pub kinds: Kinds,
}

impl<'a> Setup<'a> {
    /// Reads the recording, the map and the models.
    ///
    /// # Errors
    /// The data, the map or the groups cannot be read, or a model or a change is not valid.
    pub fn read(args: &'a ReplayArgs) -> Result<Self, Failure> {
        let models = models("--model", &args.stage.model)?;
        let scenes = models.iter().map(|model| stage::scene(args, model)).collect::<Result<Vec<_>, _>>()?;
        let tracks = args.tracks.read(&args.data, args.report.quiet)?;
        let cast = cast(args, &tracks)?;
        let map = match args.stage.no_map {
            true => Map::default(),
            false => Map::read(&args.stage.map, &args.data, &tracks.setting, beside(&args.data, "map.xml"))?,
        };
        let (times, step) = (cast.times(), scenes.first().map_or(1.0, |scene| scene.time.step));
        let within = [times[0], times[times.len() - 1]];
        let steps = (within[1] - within[0]) / step;
        limit(&args.data, "steps", steps, within, "choose a part with --from and --until, or a longer --step")?;
        let notes = tracks.notes.iter().chain(&map.notes).cloned().collect();
        let stages = scenes.iter().map(|scene| stage::stage(args, scene, &cast, &map)).collect::<Result<_, _>>()?;
        let groups = together(&args.stage, &args.data)?;
        let kinds = Kinds::of(&tracks, &cast, groups.as_deref());
        let models = models.iter().map(|model| model.label().to_owned()).collect();
        let scene = scenes.into_iter().next().unwrap_or_default();
        Ok(Self { args, models, scene, stages, cast, map: map.path, notes, groups, kinds })
    }

    /// Returns the place, under a title.
    pub fn setting(&self, title: &str) -> Setting {
        let stage = &self.stages[0];
        Setting {
            title: title.to_owned(),
            walkable: stage.walkable.clone(),
            obstacles: stage.obstacles.clone(),
            groups: self.kinds.names.clone(),
            origin: stage.settings.origin,
            ..Setting::default()
        }
    }

    /// Returns the times of the first and the last moment, seconds.
    pub fn span(&self) -> [f64; 2] {
        let moments = &self.cast.people.moments;
        [moments.first(), moments.last()].map(|moment| moment.map_or(f64::NAN, |moment| moment.time))
    }

    /// Returns the number of recorded people that walk through solids.
    pub fn through(&self) -> usize {
        let blocked = |way: &[glam::DVec2]| self.stages[0].blocks(way[0], way[1]);
        self.cast.people.walks.iter().filter(|walk: &&Walk| walk.places.windows(2).any(blocked)).count()
    }

    /// Converts an error of the world.
    pub fn refused(&self, error: throng::Error) -> Failure {
        Failure::Error(format!("{}: {error}", self.args.data.display()))
    }
}

/// Returns the recorded people within the chosen time.
fn cast(args: &ReplayArgs, tracks: &Trajectories) -> Result<RecordedPeople, Failure> {
    let name = args.data.display();
    if tracks.spots.iter().any(|spot| spot.place.z != 0.0) {
        let text = format!("{name}: a position is above the ground, but only walking people can be replayed");
        return Err(Failure::Error(text));
    }
    let until = args.until.unwrap_or(f64::INFINITY);
    if until <= args.from {
        let text = format!("--until {until}: the replay begins at {} s", args.from);
        return Err(Failure::hint(text, "give --until more than --from"));
    }
    let within = args.from - ROUNDING..=until + ROUNDING;
    let mut people = People::of(tracks, |spot: &Sample| within.contains(&spot.time));
    if let Some(radius) = args.stage.radius {
        people.walks.iter_mut().for_each(|walk| walk.radius = radius);
    }
    let cast = RecordedPeople::new(&people, args.stage.speed, args.figures.interval);
    if cast.people.walks.is_empty() {
        let to = args.until.map_or_else(|| "the end".to_owned(), |until| format!("{until} s"));
        let text = format!("{name}: no person has two samples from {} s to {to}", args.from);
        return Err(Failure::hint(text, "change --from and --until"));
    }
    Ok(if args.stage.no_pauses { cast.without_pauses() } else { cast })
}

//! A file of trajectories, in its place.

use super::args::RecordedArgs;
use crate::failure::Failure;
use crate::files::is;
use crate::map::Map;
use crate::source::Changes;
use glam::DVec2;
use std::path::PathBuf;
use throng_draw::WorldBox;
use throng_record::{Moments, Setting, Tracks, moment};
use throng_scene::Scene;
use throng_scene::import::plan::is_plan;

/// What was recorded.
pub struct Recording {
    /// The file it was read from.
    pub path: PathBuf,
    /// The stem of the names of files made from it.
    pub name: String,
    /// Who was where.
    pub moments: Moments,
    /// The scene of which the pictures are, if that is known.
    pub scene: Scene,
    /// What was found in the file, and what was left out of a floor plan, or changed.
    pub notes: Vec<String>,
}

impl Recording {
    /// Reads a file of trajectories and what is said of its place.
    ///
    /// # Errors
    /// A file cannot be read, or nobody is in it.
    pub fn open(args: &RecordedArgs) -> Result<Self, Failure> {
        let path = args.file.clone();
        let mut tracks = args.tracks.read(&path)?;
        if tracks.spots.is_empty() {
            let text = format!("{}: nobody is in it", path.display());
            return Err(Failure::hint(text, "give a file in which somebody is somewhere"));
        }
        let name = path.file_stem().map_or_else(|| "run".into(), |stem| stem.to_string_lossy().into_owned());
        if tracks.setting.title.is_empty() {
            tracks.setting.title.clone_from(&name);
        }
        let mut notes = std::mem::take(&mut tracks.notes);
        let (scene, moments) = match &args.map.map {
            // scenes have names and goals too
            Some(map) if !(is(map, "xml") || is_plan(map)) => {
                in_place(tracks, place(map, args.map.map_offset.unwrap_or_default())?)
            }
            _ => {
                let map = Map::read(&args.map, &path, &tracks.setting, None)?;
                (tracks.setting.walkable, tracks.setting.obstacles) = (map.walkable, map.obstacles);
                notes.extend(map.notes);
                (Scene::default(), Moments::of(tracks))
            }
        };
        Ok(Self { path, name, moments, scene, notes })
    }

    /// The corners of all there is to see.
    pub fn bounds(&self) -> [DVec2; 2] {
        let seen = WorldBox::of(&self.moments.setting, &self.moments.everybody());
        seen.map_or([DVec2::ZERO, DVec2::ONE], |seen| [seen.min, seen.max])
    }
}

/// The place of a scene, moved by `offset`.
fn place(map: &std::path::Path, offset: DVec2) -> Result<(Scene, Setting), Failure> {
    let loaded = Changes::default().load(map)?;
    let (world, built) = loaded.build()?;
    let mut setting = moment::setting(&world, &built, loaded.title());
    let mut map = Map { walkable: setting.walkable, obstacles: setting.obstacles, ..Map::default() };
    map.shift(offset);
    (setting.walkable, setting.obstacles) = (map.walkable, map.obstacles);
    setting.origin += offset;
    Ok((loaded.scene, setting))
}

/// Tracks in a place; one that has other groups gives its ground and obstacles only.
fn in_place(mut tracks: Tracks, (scene, setting): (Scene, Setting)) -> (Scene, Moments) {
    if tracks.put_into(&setting) {
        return (scene, Moments::of(tracks));
    }
    let Setting { title, groups, .. } = std::mem::take(&mut tracks.setting);
    let Setting { walkable, obstacles, shells, origin, .. } = setting;
    tracks.setting = Setting { title, groups, walkable, obstacles, shells, origin, ..Setting::default() };
    (Scene::default(), Moments::of(tracks))
}

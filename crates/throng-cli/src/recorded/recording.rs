//! A file of trajectories with its map.

use super::args::RecordedArgs;
use crate::failure::Failure;
use crate::files::is;
use crate::map::Map;
use crate::source::Changes;
use glam::DVec2;
use std::path::PathBuf;
use throng_draw::WorldBox;
use throng_record::{Moments, Setting, Trajectories};
use throng_scene::Scene;
use throng_scene::import::plan::is_plan;

/// A recording.
pub struct Recording {
    /// The file it was read from.
    pub path: PathBuf,
    /// The stem for the names of output files.
    pub name: String,
    /// The positions of people at all moments.
    pub moments: Moments,
    /// The scene of the map; the default scene if the map is not a scene.
    pub scene: Scene,
    /// Notes on the file, and on parts of a floor plan that were left out or changed.
    pub notes: Vec<String>,
}

impl Recording {
    /// Reads a file of trajectories and its map. If reading takes long, a line on standard error says so, unless
    /// `quiet`.
    ///
    /// # Errors
    /// A file cannot be read, or the file has no agents.
    pub fn open(args: &RecordedArgs, quiet: bool) -> Result<Self, Failure> {
        let path = args.file.clone();
        let mut tracks = args.tracks.read(&path, quiet)?;
        if tracks.spots.is_empty() {
            let text = format!("{}: the file has no agents", path.display());
            return Err(Failure::hint(text, "give a file with at least one position"));
        }
        let name = path.file_stem().map_or_else(|| "run".into(), |stem| stem.to_string_lossy().into_owned());
        if tracks.setting.title.is_empty() {
            tracks.setting.title.clone_from(&name);
        }
        let mut notes = std::mem::take(&mut tracks.notes);
        let (scene, moments) = match &args.map.map {
            // Scenes also have names and goals.
            Some(map) if !(is(map, "xml") || is_plan(map)) => {
                in_place(tracks, place(map, args.map.map_offset.unwrap_or_default(), quiet)?)
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

    /// Returns the corners of the box of everything that is drawn.
    pub fn bounds(&self) -> [DVec2; 2] {
        let seen = WorldBox::of(&self.moments.setting, &self.moments.all_bodies());
        seen.map_or([DVec2::ZERO, DVec2::ONE], |seen| [seen.min, seen.max])
    }
}

/// Returns a scene and its place, moved by `offset`.
fn place(map: &std::path::Path, offset: DVec2, quiet: bool) -> Result<(Scene, Setting), Failure> {
    let loaded = Changes::default().load(map)?;
    let (world, built) = loaded.build(quiet)?;
    let mut setting = loaded.setting(&world, &built)?;
    let mut map = Map { walkable: setting.walkable, obstacles: setting.obstacles, ..Map::default() };
    map.shift(offset);
    (setting.walkable, setting.obstacles) = (map.walkable, map.obstacles);
    setting.origin += offset;
    Ok((loaded.scene, setting))
}

/// Puts trajectories into the place of a scene. If the groups differ, the scene gives only its ground and obstacles.
fn in_place(mut tracks: Trajectories, (scene, setting): (Scene, Setting)) -> (Scene, Moments) {
    if tracks.put_into(&setting) {
        return (scene, Moments::of(tracks));
    }
    let Setting { title, groups, .. } = std::mem::take(&mut tracks.setting);
    let Setting { walkable, obstacles, shells, origin, .. } = setting;
    tracks.setting = Setting { title, groups, walkable, obstacles, shells, origin, ..Setting::default() };
    (Scene::default(), Moments::of(tracks))
}

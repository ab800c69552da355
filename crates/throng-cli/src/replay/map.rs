//! The walls of a replay, and who belongs together.

use super::args::StageArgs;
use crate::failure::Failure;
use crate::files::is;
use crate::source::PlanArgs;
use glam::DVec2;
use std::path::{Path, PathBuf};
use throng::{Obstacle, Walkable};
use throng_record::pedestrian::groups;
use throng_record::{Flaw, Setting, TracksError};
use throng_scene::import::plan::is_plan;

/// Where people can walk.
#[derive(Clone, Debug, Default)]
pub struct Map {
    /// The file it is from; none: the recording itself, or nowhere.
    pub path: Option<PathBuf>,
    /// Ground that can be walked on; none: everywhere.
    pub walkable: Vec<Walkable>,
    /// What is solid.
    pub obstacles: Vec<Obstacle>,
    /// What was left out of a floor plan, or changed.
    pub notes: Vec<String>,
}

impl Map {
    /// The map that is asked for; else that of the recording, else a `map.xml` beside it.
    ///
    /// # Errors
    /// It cannot be read, or an offset is given and there is none.
    pub fn read(args: &StageArgs, data: &Path, setting: &Setting) -> Result<Self, Failure> {
        let known = !(setting.walkable.is_empty() && setting.obstacles.is_empty());
        let beside = beside(data, "map.xml").filter(|_| !known);
        let mut map = match args.map.clone().or(beside) {
            _ if args.no_map => Self::default(),
            Some(path) => Self::of(path, &args.plan)?,
            None => {
                Self { walkable: setting.walkable.clone(), obstacles: setting.obstacles.clone(), ..Self::default() }
            }
        };
        if let Some(offset) = args.map_offset {
            if map.walkable.is_empty() && map.obstacles.is_empty() {
                let text = format!("--map-offset: {} has no map, and there is no map.xml beside it", data.display());
                return Err(Failure::hint(text, "say which map: --map FILE"));
            }
            map.shift(offset);
        }
        Ok(map)
    }

    /// That of a file.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn of(path: PathBuf, how: &PlanArgs) -> Result<Self, Failure> {
        let mut notes = Vec::new();
        let (walkable, obstacles) = if is(&path, "xml") {
            (Vec::new(), read(&path, throng_record::map)?)
        } else if is_plan(&path) {
            let ground = how.ground(&path)?;
            notes = ground.notes;
            (ground.areas, Vec::new())
        } else {
            let scene = throng_scene::open(&path)?.scene;
            scene.ground().map_err(|mut error| {
                error.file.get_or_insert_with(|| path.display().to_string().into());
                error
            })?
        };
        Ok(Self { path: Some(path), walkable, obstacles, notes })
    }

    /// Moves it, metres.
    pub fn shift(&mut self, by: DVec2) {
        let all = |points: &mut Vec<DVec2>| points.iter_mut().for_each(|point| *point += by);
        for area in &mut self.walkable {
            all(&mut area.outer);
            area.holes.iter_mut().for_each(all);
        }
        for obstacle in &mut self.obstacles {
            match obstacle {
                Obstacle::Circle { center, .. } => *center += by,
                Obstacle::Polygon { corners: points } | Obstacle::Wall { points } => all(points),
            }
        }
    }
}

/// Who belongs together: the groups that are asked for, else those of a `groups.txt` beside the recording.
///
/// # Errors
/// The file cannot be read.
pub fn together(args: &StageArgs, data: &Path) -> Result<Option<Vec<Vec<u32>>>, Failure> {
    let path = args.groups.clone().or_else(|| beside(data, "groups.txt"));
    path.map(|path| read(&path, groups)).transpose()
}

/// A file beside the recording, if it is there.
fn beside(data: &Path, name: &str) -> Option<PathBuf> {
    Some(data.with_file_name(name)).filter(|path| path.is_file())
}

/// Reads a small file whole.
fn read<T>(path: &Path, of: fn(&[u8]) -> Result<T, Flaw>) -> Result<T, Failure> {
    let bytes = std::fs::read(path).map_err(|source| TracksError::File { path: path.into(), source })?;
    Ok(of(&bytes).map_err(|flaw| TracksError::Content { path: path.into(), flaw })?)
}

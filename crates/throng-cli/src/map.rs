//! The ground where recorded people walked: `--map` and the files it reads.

use crate::failure::Failure;
use crate::files::is;
use crate::source::PlanArgs;
use clap::Args;
use glam::DVec2;
use std::path::{Path, PathBuf};
use throng::{Obstacle, Walkable};
use throng_record::{FormatFlaw, Setting, TrajectoriesError};
use throng_scene::import::plan::is_plan;

/// Options for the map of a recording.
#[derive(Args, Clone, Debug, Default)]
pub struct MapArgs {
    /// The map: OpenTraj's map.xml, a floor plan (see `throng run`), or the ground and obstacles of a scene [default:
    /// the map in the recording; `replay`: else a map.xml beside it]
    #[arg(long, value_name = "SCENE|FILE")]
    pub map: Option<PathBuf>,

    /// The position of the map's origin in the recording, metres
    #[arg(long, value_name = "X,Y", value_parser = parse_place, allow_hyphen_values = true)]
    pub map_offset: Option<DVec2>,

    /// How a floor plan is read.
    #[command(flatten)]
    pub plan: PlanArgs,
}

/// The ground where people can walk.
#[derive(Clone, Debug, Default)]
pub struct Map {
    /// The file that the map is from; `None` for the recording itself, or without a map.
    pub path: Option<PathBuf>,
    /// The walkable ground; empty if people can walk everywhere.
    pub walkable: Vec<Walkable>,
    /// The solid obstacles and walls.
    pub obstacles: Vec<Obstacle>,
    /// What was left out of a floor plan or changed in it.
    pub notes: Vec<String>,
}

impl Map {
    /// Returns the map of the options, else of the recording, else of the file `beside`.
    ///
    /// # Errors
    /// The map cannot be read, or an offset is given without a map.
    pub fn read(args: &MapArgs, data: &Path, setting: &Setting, beside: Option<PathBuf>) -> Result<Self, Failure> {
        let known = !(setting.walkable.is_empty() && setting.obstacles.is_empty());
        let mut map = match args.map.clone().or(beside.filter(|_| !known)) {
            Some(path) => Self::of(path, &args.plan)?,
            None => {
                Self { walkable: setting.walkable.clone(), obstacles: setting.obstacles.clone(), ..Self::default() }
            }
        };
        if let Some(offset) = args.map_offset {
            if map.walkable.is_empty() && map.obstacles.is_empty() {
                let text = format!("--map-offset: {} has no map", data.display());
                return Err(Failure::hint(text, "give a map: --map FILE"));
            }
            map.shift(offset);
        }
        Ok(map)
    }

    /// Returns the map of a file.
    ///
    /// # Errors
    /// The file cannot be read.
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

    /// Moves the map by an offset, metres.
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

/// Returns the path of a file beside the recording, if the file exists.
pub fn beside(data: &Path, name: &str) -> Option<PathBuf> {
    Some(data.with_file_name(name)).filter(|path| path.is_file())
}

/// Reads a small file and parses it.
///
/// # Errors
/// The file cannot be read or parsed.
pub fn read<T>(path: &Path, of: fn(&[u8]) -> Result<T, FormatFlaw>) -> Result<T, Failure> {
    let bytes = std::fs::read(path).map_err(|source| TrajectoriesError::File { path: path.into(), source })?;
    Ok(of(&bytes).map_err(|flaw| TrajectoriesError::Content { path: path.into(), flaw })?)
}

fn parse_place(text: &str) -> Result<DVec2, String> {
    let number = |text: &str| text.trim().parse().ok().filter(|x: &f64| x.is_finite());
    let place = text.split_once(',').and_then(|(x, y)| Some(DVec2::new(number(x)?, number(y)?)));
    place.ok_or_else(|| "write x,y in metres, such as 0,15".into())
}

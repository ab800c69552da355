//! A film of a run: trajectories read from a file, to be played again.

use super::observed::{Being, Observed};
use super::run::title;
use super::shown::{Cost, Trouble};
use super::stage::Stage;
use glam::DVec2;
use std::collections::HashMap;
use std::f32::consts::{PI, TAU};
use std::path::PathBuf;
use std::sync::Arc;
use throng::{Status, Summary};
use throng_draw::WorldBox;
use throng_record::{Frame, Moments, Reading, Setting, Spot, Tracks, moment};
use throng_scene::{Scene, caught};

/// A file of trajectories that can be replayed.
#[derive(Clone, Debug, Default)]
pub struct Film {
    /// Its name.
    pub path: PathBuf,
    /// What is in it, where that is in memory; else it is read.
    pub bytes: Option<Arc<[u8]>>,
    /// The scene that may be of the place, with its name: if it has the groups of the file, it is.
    pub place: Option<(Arc<str>, Arc<Scene>)>,
}

/// Who was where at every moment of a run, and what stayed the same.
#[derive(Debug)]
pub struct Reel {
    /// The stem of the file's name.
    pub name: Arc<str>,
    /// The scene that the place is of, if there is one; its clock is that of the file.
    pub scene: Arc<Scene>,
    /// The place, as far as it is known, and the names of the groups.
    pub setting: Arc<Setting>,
    moments: Moments,
    /// How far each spot's agent had turned by then, radians.
    turned: Vec<f32>,
}

impl Reel {
    /// Reads a file of trajectories.
    ///
    /// # Errors
    /// It cannot be read, is no such file, or nobody is in it; where, why, and what to do.
    pub fn open(film: &Film) -> Result<Self, String> {
        let path = &film.path;
        let tracks = film
            .bytes
            .as_ref()
            .map_or_else(|| Tracks::read(path), |bytes| Tracks::of_file(path, bytes, &Reading::default()));
        let tracks = tracks.map_err(|error| error.to_string())?;
        if tracks.spots.is_empty() {
            return Err(format!("{}: nobody is in it: there is nothing to replay", path.display()));
        }
        let name = path.file_stem().map_or_else(|| "film".into(), |stem| stem.to_string_lossy().into_owned());
        let place = film.place.as_ref().and_then(|(called, scene)| place(called, scene));
        Ok(Self::new(&name, tracks, place))
    }

    /// A film of tracks that are not empty, in a place if that has their groups.
    fn new(name: &str, mut tracks: Tracks, place: Option<(Scene, Setting)>) -> Self {
        let placed = place.filter(|(_, setting)| tracks.put_into(setting)).map(|(scene, _)| scene);
        let mut scene = placed.unwrap_or_else(|| {
            tracks.setting.title = name.into();
            Scene { title: name.into(), ..Scene::default() }
        });
        let moments = Moments::of(tracks);
        scene.time.step = moments.period();
        scene.time.limit = (moments.count().max(2) - 1) as f64 * scene.time.step;
        Self {
            name: name.into(),
            scene: Arc::new(scene),
            setting: Arc::new(moments.setting.clone()),
            turned: turned(moments.spots()),
            moments,
        }
    }

    /// How many moments there are, at least 1.
    pub fn count(&self) -> usize {
        self.moments.count()
    }

    /// When a moment was, seconds; of those after the last, when that was.
    pub fn time(&self, moment: usize) -> f64 {
        self.moments.time(moment)
    }

    /// Makes `frame` show a moment.
    pub fn capture(&self, moment: usize, frame: &mut Frame) {
        self.moments.capture(moment, frame);
    }

    /// The box that holds the place, and everybody at every moment.
    pub(super) fn bounds(&self) -> WorldBox {
        let one = WorldBox { min: DVec2::ZERO, max: DVec2::ONE };
        WorldBox::of(&self.setting, &self.moments.everybody()).unwrap_or(one)
    }

    fn observe(&self, moment: usize) -> Observed {
        let origin = self.setting.origin;
        let being = |index: usize| {
            let spot = &self.moments.spots()[index];
            Being {
                number: spot.number,
                position: (spot.place.truncate() - origin).as_vec2(),
                altitude: spot.place.z as f32,
                radius: spot.radius,
                speed: spot.velocity.length(),
                turned: self.turned[index].into(),
                walking: spot.status == Status::Walking,
            }
        };
        Observed {
            step: moment as u64,
            time: self.time(moment),
            period: self.scene.time.step,
            origin,
            arrived: self.moments.arrived(moment),
            guarded: f64::NAN,
            beings: self.moments.range(moment).map(being).collect(),
        }
    }
}

/// A scene, with its setting; `None` if it cannot be built.
fn place(name: &str, scene: &Scene) -> Option<(Scene, Setting)> {
    let (world, built) = caught(|| scene.build()).ok()?.ok()?;
    let setting = moment::setting(&world, &built, title(scene, name));
    Some((scene.clone(), setting))
}

/// Along all spots: how far everybody has turned by then, radians.
fn turned(spots: &[Spot]) -> Vec<f32> {
    let mut last: HashMap<u32, (f32, f32)> = HashMap::new();
    let turn = |spot: &Spot| {
        let (heading, so_far) = last.get(&spot.number).copied().unwrap_or((spot.heading, 0.0));
        let by = (spot.heading - heading + PI).rem_euclid(TAU) - PI;
        last.insert(spot.number, (spot.heading, so_far + by.abs()));
        so_far + by.abs()
    };
    spots.iter().map(turn).collect()
}

/// A film at one of its moments.
pub(super) struct Replay {
    reel: Arc<Reel>,
    at: usize,
}

impl Replay {
    /// At its first moment.
    pub fn new(reel: Arc<Reel>) -> Self {
        Self { reel, at: 0 }
    }
}

impl Stage for Replay {
    fn steps(&self) -> u64 {
        self.at as u64
    }

    fn time(&self) -> f64 {
        self.reel.time(self.at)
    }

    fn over(&self) -> bool {
        self.at + 1 >= self.reel.count()
    }

    fn step(&mut self, _: &mut Cost) -> Result<(), Trouble> {
        self.at = (self.at + 1).min(self.reel.count() - 1);
        Ok(())
    }

    fn back_to(&mut self, step: u64) {
        self.at = (step as usize).min(self.reel.count() - 1);
    }

    fn capture(&self, frame: &mut Frame) {
        self.reel.capture(self.at, frame);
    }

    fn observe(&self) -> Observed {
        self.reel.observe(self.at)
    }

    fn summary(&mut self, _: bool) -> Arc<Summary> {
        let moments = &self.reel.moments;
        let (agents, arrived) = (moments.total(), moments.arrived(self.at));
        Arc::new(Summary { agents, arrived, time: self.time(), ..Summary::default() })
    }

    fn reel(&self) -> Option<Arc<Reel>> {
        Some(self.reel.clone())
    }
}

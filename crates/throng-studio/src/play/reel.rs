//! Replay of trajectories read from a file.

use super::observed::{AgentMoment, Observed};
use super::playable::Playable;
use super::run::title;
use super::run_moment::{Cost, Trouble};
use glam::DVec2;
use std::collections::HashMap;
use std::f32::consts::{PI, TAU};
use std::path::PathBuf;
use std::sync::Arc;
use throng::{Status, Summary};
use throng_draw::WorldBox;
use throng_record::{Frame, Moments, Reading, Sample, Setting, Trajectories, moment};
use throng_scene::{Scene, caught};

/// A trajectory file to replay.
#[derive(Clone, Debug, Default)]
pub struct Film {
    /// The path.
    pub path: PathBuf,
    /// The content, if it is in memory. Otherwise the file is read.
    pub bytes: Option<Arc<[u8]>>,
    /// A scene with its name. It provides the surroundings if it has the groups of the file.
    pub place: Option<(Arc<str>, Arc<Scene>)>,
}

/// The trajectories of a run, and its setting.
#[derive(Debug)]
pub struct Reel {
    /// The stem of the file name.
    pub name: Arc<str>,
    /// The scene of the surroundings, or an empty scene. Its time step and limit are those of the file.
    pub scene: Arc<Scene>,
    /// The surroundings, as far as they are known, and the names of the groups.
    pub setting: Arc<Setting>,
    moments: Moments,
    /// The total turning of the agent up to each sample, radians.
    turned: Vec<f32>,
}

impl Reel {
    /// Reads a trajectory file.
    ///
    /// # Errors
    /// The file cannot be read, has no known format, or has no agents. The message names the position, the reason and
    /// the remedy.
    pub fn open(film: &Film) -> Result<Self, String> {
        let path = &film.path;
        let tracks = film
            .bytes
            .as_ref()
            .map_or_else(|| Trajectories::read(path), |bytes| Trajectories::of_file(path, bytes, &Reading::default()));
        let tracks = tracks.map_err(|error| error.to_string())?;
        if tracks.spots.is_empty() {
            return Err(format!("{}: the file has no agents: there is nothing to replay", path.display()));
        }
        let name = path.file_stem().map_or_else(|| "film".into(), |stem| stem.to_string_lossy().into_owned());
        let place = film.place.as_ref().and_then(|(called, scene)| place(called, scene));
        Ok(Self::new(&name, tracks, place))
    }

    /// Creates a reel of nonempty trajectories. `place` applies if it has their groups.
    fn new(name: &str, mut tracks: Trajectories, place: Option<(Scene, Setting)>) -> Self {
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

    /// Returns the number of moments, at least 1.
    pub fn count(&self) -> usize {
        self.moments.count()
    }

    /// Whether the file tells when agents arrive: some agent arrives, or has no samples up to the end.
    pub fn has_arrivals(&self) -> bool {
        self.moments.arrived(self.count()) > 0
    }

    /// Returns the time of a moment, seconds. Moments after the last have the time of the last.
    pub fn time(&self, moment: usize) -> f64 {
        self.moments.time(moment)
    }

    /// Writes a moment into `frame`.
    pub fn capture(&self, moment: usize, frame: &mut Frame) {
        self.moments.capture(moment, frame);
    }

    /// Returns the box around the surroundings and all positions at all moments.
    pub(super) fn bounds(&self) -> WorldBox {
        let one = WorldBox { min: DVec2::ZERO, max: DVec2::ONE };
        WorldBox::of(&self.setting, &self.moments.all_bodies()).unwrap_or(one)
    }

    fn observe(&self, moment: usize) -> Observed {
        let origin = self.setting.origin;
        let being = |index: usize| {
            let spot = &self.moments.spots()[index];
            AgentMoment {
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

/// Returns a scene with its setting, `None` if it cannot be built.
fn place(name: &str, scene: &Scene) -> Option<(Scene, Setting)> {
    let (world, built) = caught(|| scene.build()).ok()?.ok()?;
    let setting = moment::setting(&world, &built, title(scene, name));
    Some((scene.clone(), setting))
}

/// Returns the total turning of the agent up to each sample, radians.
fn turned(spots: &[Sample]) -> Vec<f32> {
    let mut last: HashMap<u32, (f32, f32)> = HashMap::new();
    let turn = |spot: &Sample| {
        let (heading, so_far) = last.get(&spot.number).copied().unwrap_or((spot.heading, 0.0));
        let by = (spot.heading - heading + PI).rem_euclid(TAU) - PI;
        last.insert(spot.number, (spot.heading, so_far + by.abs()));
        so_far + by.abs()
    };
    spots.iter().map(turn).collect()
}

/// A reel at one of its moments.
pub(super) struct ReelReplay {
    reel: Arc<Reel>,
    at: usize,
}

impl ReelReplay {
    /// Starts at the first moment.
    pub fn new(reel: Arc<Reel>) -> Self {
        Self { reel, at: 0 }
    }
}

impl Playable for ReelReplay {
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

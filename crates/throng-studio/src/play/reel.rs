//! A film of a run: trajectories read from a file, to be played again.

use super::observed::{Being, Observed};
use super::run::title;
use super::shown::{Cost, Trouble};
use super::stage::Stage;
use glam::DVec2;
use std::collections::HashMap;
use std::f32::consts::{PI, TAU};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use throng::{Status, Summary};
use throng_draw::WorldBox;
use throng_record::{Body, Frame, Reading, Setting, Spot, Tracks, moment};
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
    spots: Vec<Spot>,
    /// How far each spot's agent had turned by then, radians.
    turned: Vec<f32>,
    moments: Vec<Moment>,
    /// How many there are in all.
    total: usize,
    fastest: f32,
}

/// One moment.
#[derive(Clone, Debug)]
struct Moment {
    spots: Range<usize>,
    /// How many had come and gone, or had arrived.
    arrived: usize,
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
        let place = place.filter(|(_, setting)| group_of(&tracks, setting).is_some());
        Ok(Self::new(&name, tracks, place))
    }

    /// A film of tracks that are not empty, in a place.
    fn new(name: &str, mut tracks: Tracks, place: Option<(Scene, Setting)>) -> Self {
        let in_space = tracks.spots.iter().any(|spot| spot.place.z != 0.0);
        let (mut scene, mut setting) = place.unwrap_or_else(|| {
            let setting = Setting { title: name.into(), in_space, ..tracks.setting.clone() };
            (Scene { title: name.into(), ..Scene::default() }, setting)
        });
        setting.origin =
            if setting.origin == DVec2::ZERO { tracks.spots[0].place.truncate().round() } else { setting.origin };
        if let Some(groups) = group_of(&tracks, &setting) {
            tracks.spots.iter_mut().for_each(|spot| spot.group = groups[spot.group as usize]);
        }
        let spots = tracks.spots;
        let (turned, moments, total) = follow(&spots);
        scene.time.step = period(&spots, &moments);
        scene.time.limit = (moments.len().max(2) - 1) as f64 * scene.time.step;
        let fastest =
            spots.iter().map(|spot| spot.velocity.length()).filter(|speed| speed.is_finite()).fold(0.0, f32::max);
        Self {
            name: name.into(),
            scene: Arc::new(scene),
            setting: Arc::new(setting),
            spots,
            turned,
            moments,
            total,
            fastest,
        }
    }

    /// How many moments there are, at least 1.
    pub fn count(&self) -> usize {
        self.moments.len()
    }

    /// When a moment was, seconds; of those after the last, when that was.
    pub fn time(&self, moment: usize) -> f64 {
        self.spots[self.at(moment).spots.start].time
    }

    fn at(&self, moment: usize) -> &Moment {
        &self.moments[moment.min(self.moments.len() - 1)]
    }

    /// Makes `frame` show a moment.
    pub fn capture(&self, moment: usize, frame: &mut Frame) {
        let at = self.at(moment);
        frame.time = self.time(moment);
        (frame.arrived, frame.total) = (at.arrived, self.total);
        frame.bodies.clear();
        frame.bodies.extend(self.spots[at.spots.clone()].iter().map(|spot| self.body(spot)));
    }

    fn body(&self, spot: &Spot) -> Body {
        Body {
            number: spot.number,
            group: spot.group,
            goal: None,
            position: spot.place.truncate(),
            altitude: spot.place.z as f32,
            velocity: spot.velocity.truncate(),
            climb: spot.velocity.z,
            heading: spot.heading,
            basis: None,
            radius: spot.radius,
            core: glam::Vec2::ZERO,
            preferred_speed: self.fastest,
            status: spot.status,
        }
    }

    /// The box that holds the place, and everybody at every moment.
    pub(super) fn bounds(&self) -> WorldBox {
        let everywhere = Frame { bodies: self.spots.iter().map(|spot| self.body(spot)).collect(), ..Frame::default() };
        let one = WorldBox { min: DVec2::ZERO, max: DVec2::ONE };
        WorldBox::of(&self.setting, &everywhere).unwrap_or(one)
    }

    fn observe(&self, moment: usize) -> Observed {
        let (at, origin) = (self.at(moment), self.setting.origin);
        let being = |index: usize| {
            let spot = &self.spots[index];
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
            arrived: at.arrived,
            guarded: f64::NAN,
            beings: at.spots.clone().map(being).collect(),
        }
    }
}

/// A scene, with its setting; `None` if it cannot be built.
fn place(name: &str, scene: &Scene) -> Option<(Scene, Setting)> {
    let (world, built) = caught(|| scene.build()).ok()?.ok()?;
    let setting = moment::setting(&world, &built, title(scene, name));
    Some((scene.clone(), setting))
}

/// Which groups of the setting those of the tracks are; `None` if it has not all of them. Groups without a name are called
/// by their index.
fn group_of(tracks: &Tracks, setting: &Setting) -> Option<Vec<u32>> {
    let called = |index: usize, name: &str| {
        let own = &setting.groups[index];
        own == name || own.is_empty() && name == index.to_string()
    };
    let find = |name: &String| (0..setting.groups.len()).find(|&index| called(index, name)).map(|index| index as u32);
    tracks.setting.groups.iter().map(find).collect()
}

/// Along all spots: how far everybody has turned by then, the moments, and how many there are in all.
fn follow(spots: &[Spot]) -> (Vec<f32>, Vec<Moment>, usize) {
    let mut last: HashMap<u32, (f32, f32)> = HashMap::new();
    let (mut turned, mut moments) = (Vec::with_capacity(spots.len()), Vec::new());
    for at in spots.chunk_by(|a, b| a.time == b.time) {
        let start = turned.len();
        for spot in at {
            let (heading, so_far) = last.get(&spot.number).copied().unwrap_or((spot.heading, 0.0));
            let by = (spot.heading - heading + PI).rem_euclid(TAU) - PI;
            turned.push(so_far + by.abs());
            last.insert(spot.number, (spot.heading, so_far + by.abs()));
        }
        // who is not in the file any more has gone through an exit
        let there = at.iter().filter(|spot| spot.status != Status::Arrived).count();
        moments.push(Moment { spots: start..turned.len(), arrived: last.len().saturating_sub(there) });
    }
    (turned, moments, last.len())
}

/// Seconds between most moments.
fn period(spots: &[Spot], moments: &[Moment]) -> f64 {
    let time = |moment: &Moment| spots[moment.spots.start].time;
    let mut periods: Vec<f64> = moments.windows(2).map(|pair| time(&pair[1]) - time(&pair[0])).collect();
    periods.sort_by(f64::total_cmp);
    periods.get(periods.len() / 2).copied().filter(|period| *period > 0.0).unwrap_or(0.04)
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
        let at = self.reel.at(self.at);
        Arc::new(Summary { agents: self.reel.total, arrived: at.arrived, time: self.time(), ..Summary::default() })
    }

    fn reel(&self) -> Option<Arc<Reel>> {
        Some(self.reel.clone())
    }
}

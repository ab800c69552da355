//! People for tests of formats.

use super::{Figure, Figures};
use crate::{Body, Choice, Format, Frame, Output, OutputError, Setting};
use glam::DVec2;
use std::path::Path;
use throng_figure::measure::FeetMeasure;
use throng_figure::{JOINTS, Person, Placed, Sample, Skeleton, Walk};

/// Returns three people: one walks straight on, one in a circle, one stops and goes.
pub(crate) fn walkers() -> Vec<Frame> {
    let place = |number: u32, time: f64| match number {
        0 => (DVec2::new(1.3 * time, 0.0), 0.0),
        1 => (DVec2::new(0.0, 5.0) + DVec2::from_angle(time) * 1.2, time + std::f64::consts::FRAC_PI_2),
        _ => (DVec2::new(0.6 * (time - time.sin()), -5.0), 0.0),
    };
    let frame = |k: u32| {
        let time = 0.04 * f64::from(k);
        let body = |number: u32| {
            let (at, heading) = place(number, time);
            Body { heading: heading as f32, ..Body::walking(number, at) }
        };
        Frame { time: 3.0 + time, bodies: (0..3).map(body).collect(), ..Frame::default() }
    };
    (0..400).map(frame).collect()
}

/// People, one of them with a body from a file.
#[cfg(feature = "glb")]
pub(crate) struct Dressed {
    /// The [walkers]; the second is of group 1.
    pub(crate) frames: Vec<Frame>,
    pub(crate) setting: Setting,
    /// The body of group 1.
    pub(crate) body: std::sync::Arc<throng_figure::Character>,
    /// The walk of the person with that body.
    pub(crate) walk: Walk,
}

#[cfg(feature = "glb")]
impl Dressed {
    pub(crate) fn new() -> Self {
        use crate::formats::glb::character::{self, tests::blocks};
        let blocks = blocks::Blocks {
            thigh: 0.5,
            hip: 0.14,
            drop: 0.7,
            turned: true,
            names: blocks::Names::Vrm,
            ..blocks::Blocks::default()
        };
        let body = std::sync::Arc::new(character::read(&blocks.glb()).unwrap());
        let mut frames = walkers();
        frames.iter_mut().for_each(|frame| frame.bodies[1].group = 1);
        let groups = vec!["plain".to_owned(), "blocks".to_owned()];
        let setting = Setting { groups, characters: vec![None, Some(body.clone())], ..Setting::default() };
        let sample = |frame: &Frame| {
            let body = frame.bodies[1];
            Sample { time: frame.time, position: body.position, heading: f64::from(body.heading) }
        };
        let samples: Vec<Sample> = frames.iter().map(sample).collect();
        let walk = Walk::recorded(&body.person(Person::new(0, 1)), &samples).unwrap();
        Self { frames, setting, body, walk }
    }

    /// Returns the bytes of a file with the people. The ending of the name selects the format.
    pub(crate) fn written(&self, name: &str) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        write(&path, &self.setting, &Choice::default(), &self.frames).unwrap();
        std::fs::read(path).unwrap()
    }

    /// Checks that the person with the body of the file is where its walk is, up to `error` metres, with its legs. `begin`
    /// is the time of the first frame in seconds of the figures.
    pub(crate) fn assert_walks(&self, figure: &Figure, begin: f64, error: f64) {
        let person = self.walk.person();
        let skeleton = self.body.skeleton(person.height);
        for frame in &self.frames {
            let want = skeleton.world(&self.walk.pose(frame.time));
            for (found, want) in figure.joints(frame.time - self.frames[0].time + begin).unwrap().iter().zip(&want) {
                assert!(found.position.distance(want.position) < error, "{found:?} {want:?}");
            }
        }
        let mut feet = FeetMeasure::new(&figure.person);
        for moment in 0..1500 {
            let second = f64::from(moment) / 100.0;
            feet.push(second, &figure.joints(second + begin).unwrap());
        }
        let report = feet.report();
        assert!(report.steps > 15 && report.mean_slide < 0.003 && report.largest_slide < 0.01, "{report:?}");
    }
}

/// Returns every `step`th frame: a recording of people with few moments a second.
pub(crate) fn seldom(frames: &[Frame], step: usize) -> Vec<Frame> {
    frames.iter().step_by(step).cloned().collect()
}

/// Returns recordings that are hard to walk: a single sample, a jump of 10 m, an agent for one moment, and an agent that
/// comes back.
pub(crate) fn hard() -> Vec<Vec<Frame>> {
    let one = |k: u32, x: f64| Frame {
        time: f64::from(k) * 0.1,
        bodies: vec![Body::walking(7, DVec2::new(x, 1.0))],
        ..Frame::default()
    };
    let jump = (0..60).map(|k| one(k, f64::from(k) * 0.13 + if k < 30 { 0.0 } else { 10.0 })).collect();
    let mut moment: Vec<Frame> = (0..40).map(|k| one(k, f64::from(k) * 0.1)).collect();
    moment[20].bodies.push(Body::walking(8, DVec2::ZERO));
    let mut back: Vec<Frame> = (0..60).map(|k| one(k, f64::from(k) * 0.1)).collect();
    back[20..40].iter_mut().for_each(|frame| frame.bodies.clear());
    vec![vec![one(0, 3.0)], jump, moment, back]
}

/// Writes frames to a file. The ending of the name selects the format.
pub(crate) fn write(path: &Path, setting: &Setting, choice: &Choice, frames: &[Frame]) -> Result<(), OutputError> {
    let format = Format::of(path).unwrap();
    let mut writer = choice.create(format, Output::create(path)?, setting, || false).unwrap()?;
    frames.iter().try_for_each(|frame| writer.push(frame))?;
    writer.finish()
}

/// Returns where the joints of an agent are at each frame, without any file: in the walk along its samples.
pub(crate) fn planned(figure: &Figure, number: u32, frames: &[Frame]) -> Vec<(f64, [Placed; JOINTS])> {
    let body = |frame: &Frame| frame.bodies.iter().find(|body| body.number == number).copied();
    let sample = |frame: &Frame| {
        let body = body(frame)?;
        Some(Sample { time: frame.time, position: body.position, heading: f64::from(body.heading) })
    };
    let samples: Vec<Sample> = frames.iter().filter_map(sample).collect();
    let person = Person::new(0, u64::from(number));
    let known = figure.person;
    assert!(known.build == person.build && (known.height - person.height).abs() < 1e-4, "{known:?} {person:?}");
    let (walk, skeleton) = (Walk::recorded(&person, &samples).unwrap(), Skeleton::new(&person));
    samples.iter().map(|sample| (sample.time, skeleton.world(&walk.pose(sample.time)))).collect()
}

/// Checks that feet stand still, at four times the frames of the file.
pub(crate) fn assert_feet_stand(figures: &Figures) {
    for figure in &figures.all {
        let mut feet = FeetMeasure::new(&figure.person);
        let [from, to] = figure.seconds;
        let step = figures.period / 4.0;
        for second in (0..=((to - from) / step).round() as u32).map(|k| from + step * f64::from(k)) {
            feet.push(second, &figure.joints(second.min(to)).unwrap());
        }
        let report = feet.report();
        assert!(report.steps > 15, "{report:?}");
        assert!(report.mean_slide <= 0.003 && report.largest_slide <= 0.01, "{report:?}");
        assert!(report.penetration <= 0.005, "{report:?}");
    }
}
